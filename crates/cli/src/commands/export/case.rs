//! The contact of a scene as a particle code has it.

use crate::failure::Failure;
use crate::report::{short, si, understood};
use contact::law::radiation::LOSS;
use contact::{Choice, Model, Plasticity, Results, Scheme, Shape, Striker};
use impact::{Impact, ImpactError, Run, Scene};

/// The area dashpot's relative error in the loss over the square of the memory in collision times, and the memory up to
/// which that holds: for Poisson's ratios from 0 to 0.45 and 0.02 to 0.99 of the compliance in the block 0.146 at most,
/// below 0.01 where the block has a third of it.
const LEFT_OUT: f64 = 0.15;
const LARGEST_MEMORY: f64 = 0.5;

/// Relative error of the loss where the scene asks for none.
const LOSS_TOLERANCE: f64 = 1e-4;

/// A contact, solved at the velocity of its scene.
pub(super) struct Case {
    /// The bodies; of two balls one with the reduced mass and radius strikes.
    pub(super) impact: Impact,
    pub(super) run: Run,
    /// Radius in m and mass in kg of each ball, the striker first.
    pub(super) balls: Vec<[f64; 2]>,
    /// What it is and where it holds, in sentences.
    pub(super) notes: Vec<String>,
}

impl Case {
    /// Of a scene, whose target may be a ball of a diameter in m.
    pub(super) fn new(scene: &Scene, target_diameter_m: Option<f64>) -> Result<Self, Failure> {
        let strike = scene.strike().ok_or_else(|| {
            Failure::input("a force record has no rebound: give the scene a [striker]")
        })?;
        let settings = &scene.settings;
        let on_disc = settings.model.row().1 && settings.model != Model::Auto;
        if on_disc || settings.disc_radius_m.is_some() || settings.scheme == Scheme::Explicit {
            return Err(Failure::input(
                "the contact of a particle code follows the load: leave contact.disc_radius_m, and a model or scheme of a fixed disc, out",
            ));
        }
        let (block, striker) = (scene.target.clone(), strike.striker.clone());
        let mut impact = Impact::new(block, striker, strike.velocity_m_s);
        impact.settings = *settings;
        impact.settings.loss_tolerance.get_or_insert(LOSS_TOLERANCE);
        let mut balls = vec![[impact.striker.tip_radius_m, impact.striker.mass_kg]];
        let mut notes = vec![understood(scene)];
        if let Some(diameter_m) = target_diameter_m {
            notes.extend(onto_ball(&mut impact, &mut balls, diameter_m)?);
        }
        let run = impact.solve().map_err(ImpactError::from)?;
        let mut case = Self {
            impact,
            run,
            balls,
            notes,
        };
        let law = case.law(case.run.solved.plan.groups.memory)?;
        let told = [Some(law), case.onset(), Some(case.outcome())];
        case.notes.extend(told.into_iter().flatten());
        Ok(case)
    }

    /// The same contact at another velocity in m/s, elastic or as the scene has it.
    pub(super) fn at(&self, velocity_m_s: f64, elastic: bool) -> Result<Run, Failure> {
        let mut impact = self.impact.clone();
        impact.velocity_m_s = velocity_m_s;
        if elastic {
            impact.settings.plasticity = Plasticity::None;
            impact.settings.yield_pressure_pa = None;
        }
        Ok(impact.solve().map_err(ImpactError::from)?)
    }

    /// The lag of the waves in collision times; zero without waves.
    fn lag(&self) -> f64 {
        match self.impact.settings.model {
            Model::Hertz => 0.0,
            _ => self.run.solved.plan.groups.lag,
        }
    }

    /// C = J/(mu c2) of the area dashpot in m s/N; none of a contact that flows, of which a code has the restitution.
    pub(super) fn lag_m_s_n(&self) -> Option<f64> {
        let units = self.impact.collision().units();
        let lag = self.lag() * units.length_m * units.time_s / units.force_n;
        self.run.solved.flow.is_none().then_some(lag)
    }

    /// The loss to first order over v^(3/5), in SI units; zero without waves.
    pub(super) fn loss_factor(&self) -> f64 {
        LOSS * self.lag() / self.impact.velocity_m_s.powf(0.6)
    }

    /// The law that a code is given, with the memory of the half-space in collision times.
    fn law(&self, memory: f64) -> Result<String, Failure> {
        let v = self.impact.velocity_m_s;
        let here = short(v, "m/s");
        Ok(match self.lag_m_s_n() {
            Some(0.0) => "law: F = 4/3 E* sqrt(R) d^1.5, Hertz's, exact while nothing yields; no energy is lost to waves".to_owned(),
            Some(_) if memory > LARGEST_MEMORY => format!(
                "law: F = 4/3 E* sqrt(R) d^1.5 + 4 C E*^2 R d d' >= 0, not to be trusted at {here}: the waves cross the contact in {memory:.2} collision times, more than {LARGEST_MEMORY}"
            ),
            Some(_) => format!(
                "law: F = 4/3 E* sqrt(R) d^1.5 + 4 C E*^2 R d d' >= 0, for balls of any radius on a thick block of this material; its loss is within {:.1e} of that with full memory at {here}, and within 1e-3 below {}",
                LEFT_OUT * memory * memory,
                short(v * ((1e-3 / LEFT_OUT).sqrt() / memory).powf(5.0 / 3.0), "m/s")
            ),
            None => {
                let of = |v| Ok::<_, Failure>(self.at(v, false)?.loss.ln());
                let slope = (of(1.01 * v)? - of(v / 1.01)?) / (2.0 * 1.01_f64.ln());
                let [low, high] = [0.9_f64, 1.1]
                    .map(|off| short(v * off.powf(1.0 / slope).clamp(0.5, 2.0), "m/s"));
                format!(
                    "law: F = 4/3 E* sqrt(R) d^1.5 with the restitution of the plastic contact at {here}; the loss is within 10 % from {low} to {high}, and the table format has other velocities"
                )
            }
        })
    }

    /// From which velocity on the contact yields, where a strength is known.
    fn onset(&self) -> Option<String> {
        let law = self.impact.settings.plasticity;
        let (results, v) = (&self.run.results, self.impact.velocity_m_s);
        // Hertz's pressure goes with v^(2/5)
        let onset = results.loading.yield_onset.map(|over| v * over.powf(-2.5));
        Some(match results.plastic.yield_velocity_m_s {
            Some(onset) => {
                let over = results.plastic.velocity_over_trusted;
                let trusted =
                    over.map(|over| format!("; trusted up to {}", short(v / over, "m/s")));
                format!(
                    "yield: begins at {} by the plasticity \"{}\"; below it the contact is elastic{}",
                    short(onset, "m/s"),
                    law.name(),
                    trusted.unwrap_or_default()
                )
            }
            None => format!(
                "yield: begins under the surface at {}, and from there on the elastic restitution is an upper bound; set contact.plasticity",
                short(onset?, "m/s")
            ),
        })
    }

    fn outcome(&self) -> String {
        let (run, velocity) = (&self.run, short(self.impact.velocity_m_s, "m/s"));
        let [time, force] = [si(run.contact_time_s, "s"), si(run.peak_force_n, "N")];
        format!(
            "at {velocity}: restitution {:.8}, loss {:.6e}, contact time {time}, peak force {force}; estimated relative error {:.1e}",
            run.restitution, run.loss, run.relative_error_estimate
        )
    }
}

/// Makes the target a ball, free to move: Hertz's law of the reduced radius and mass, and waves where no echo comes back
/// before the contact ends.
fn onto_ball(
    impact: &mut Impact,
    balls: &mut Vec<[f64; 2]>,
    diameter_m: f64,
) -> Result<[String; 2], Failure> {
    let shape = Shape::Ball { diameter_m };
    let other = Striker::of_shape(impact.half_space.material().clone(), shape)
        .map_err(|error| Failure::input(format!("--target-diameter: {error}")))?;
    let [radius_m, mass_kg] = [
        [impact.striker.tip_radius_m, other.tip_radius_m],
        [impact.striker.mass_kg, other.mass_kg],
    ]
    .map(|[one, two]| one / (one + two) * two);
    balls.push([other.tip_radius_m, other.mass_kg]);
    let material = impact.striker.material.clone();
    impact.striker = Striker::new(material, mass_kg, radius_m)
        .map_err(|error| Failure::input(format!("--target-diameter: {error}")))?;
    (impact.half_space.thickness_m, impact.half_space.radius_m) = (None, None);
    let [diameter, radius] = [diameter_m, radius_m].map(|length_m| short(length_m, "m"));
    let [own, mass] = [other.mass_kg, mass_kg].map(|mass_kg| short(1e3 * mass_kg, "g"));
    let geometry = format!(
        "the target is a ball of {diameter} and {own}: Hertz's law with R = R1 R2/(R1 + R2) = {radius} and m = m1 m2/(m1 + m2) = {mass}"
    );
    let half_space = impact.solve().map_err(ImpactError::from)?;
    let echo_s = 2.0 * diameter_m / impact.half_space.longitudinal_speed_m_s();
    let contact_s = half_space.contact_time_s;
    let touch = short(contact_s, "s");
    let waves = if echo_s > contact_s {
        format!(
            "waves: the first echo in the target returns after {}, when the contact of {touch} has ended: it radiates as a half-space",
            short(echo_s, "s")
        )
    } else {
        impact.settings.model = Model::Hertz;
        format!(
            "waves: echoes cross the target {:.0} times in the contact of {touch} and bring their energy back: the law of a half-space, which would radiate {:.2e} of the energy, does not apply, and nothing is radiated here",
            contact_s / echo_s,
            half_space.radiated_energy_j / half_space.initial_energy_j
        )
    };
    Ok([geometry, waves])
}

/// Results of a velocity, with their names.
pub(super) fn named(results: &Results) -> [(&'static str, f64); 5] {
    [
        ("restitution", results.restitution),
        ("loss", results.loss),
        ("contact_time_s", results.contact_time_s),
        ("peak_force_n", results.peak_force_n),
        ("relative_error_estimate", results.relative_error_estimate),
    ]
}
