//! The contact of a scene in the terms of a particle code.

use crate::failure::Failure;
use crate::report::{short, si, understood};
use contact::law::radiation::LOSS;
use contact::{Choice, ContactError, Model, Plasticity, Results, Scheme, Shape, Striker};
use impact::{Impact, ImpactError, Run, Scene};

/// Default relative error of the loss of an elastic contact; a plastic contact loses a fraction of order one.
const LOSS_TOLERANCE: f64 = 1e-4;

/// A contact, solved at the velocity of its scene.
pub(super) struct Case {
    /// The bodies. Two balls are reduced to one striker with their reduced mass and radius.
    pub(super) impact: Impact,
    pub(super) run: Run,
    /// Radius in m and mass in kg of each ball, the striker first.
    pub(super) balls: Vec<[f64; 2]>,
    /// Time in s at which the first echo returns, if the target is a ball.
    echo_s: Option<f64>,
    /// Whether waves carry energy away: no echo returns during the contact.
    radiates: bool,
    /// Description of the case and its range of validity, in sentences.
    pub(super) notes: Vec<String>,
}

impl Case {
    /// The case of a scene; with `target_diameter_m` the target is a ball.
    pub(super) fn new(scene: &Scene, target_diameter_m: Option<f64>) -> Result<Self, Failure> {
        let strike = scene.strike().ok_or_else(|| {
            Failure::input(
                "a force record has no rebound: replace [force] by a [striker] in the scene",
            )
        })?;
        let settings = &scene.settings;
        let on_disc = settings.model.on_disc() && settings.model != Model::Auto;
        if on_disc || settings.disc_radius_m.is_some() || settings.scheme == Scheme::Explicit {
            return Err(Failure::input(
                "the contact area of a particle code changes with the load: remove contact.disc_radius_m, and use a model and a scheme without a fixed disc",
            ));
        }
        let (block, striker) = (scene.target.clone(), strike.striker.clone());
        let mut impact = Impact::new(block, striker, strike.velocity_m_s);
        impact.settings = *settings;
        let mut balls = vec![[impact.striker.tip_radius_m, impact.striker.mass_kg]];
        let mut notes = vec![understood(scene)];
        let mut echo_s = None;
        if let Some(diameter_m) = target_diameter_m {
            notes.push(onto_ball(&mut impact, &mut balls, diameter_m)?);
            echo_s = Some(2.0 * diameter_m / impact.half_space.longitudinal_speed_m_s());
        }
        let half_space = solve(&impact).map_err(ImpactError::from)?;
        let echoes = echo_s.is_some_and(|echo_s| echo_s <= half_space.contact_time_s);
        let mut case = Self {
            radiates: impact.settings.model != Model::Hertz && !echoes,
            impact,
            run: half_space,
            balls,
            echo_s,
            notes,
        };
        if let Some(echo_s) = echo_s {
            let waves = case.waves(echo_s);
            case.notes.push(waves);
            case.run = case.at(case.impact.velocity_m_s, false)?;
        }
        case.notes.extend(case.onset());
        case.notes.push(case.outcome());
        Ok(case)
    }

    /// The same contact at another velocity in m/s, elastic or with the plasticity of the scene.
    ///
    /// If the target is a ball, it radiates only if the first echo arrives after the contact.
    pub(super) fn at(&self, velocity_m_s: f64, elastic: bool) -> Result<Run, Failure> {
        let mut impact = self.impact.clone();
        impact.velocity_m_s = velocity_m_s;
        if elastic {
            impact.settings.plasticity = Plasticity::None;
            impact.settings.yield_pressure_pa = None;
        }
        let mut run = solve(&impact).map_err(ImpactError::from)?;
        if self
            .echo_s
            .is_some_and(|echo_s| echo_s <= run.contact_time_s)
        {
            impact.settings.model = Model::Hertz;
            run = solve(&impact).map_err(ImpactError::from)?;
        }
        Ok(run)
    }

    /// The lag c of the waves in collision times; zero if nothing is radiated.
    pub(super) fn lag(&self) -> f64 {
        match self.radiates {
            true => self.run.solved.chosen.regime.lag,
            false => 0.0,
        }
    }

    /// Coefficient of v^(3/5) in the first-order elastic loss, in SI units; zero without waves.
    pub(super) fn loss_factor(&self) -> f64 {
        LOSS * self.lag() / self.impact.velocity_m_s.powf(0.6)
    }

    /// For a radiating ball as target: the velocity in m/s below which echoes return during the contact.
    pub(super) fn echoes_below_m_s(&self) -> Option<f64> {
        // Hertz's contact time goes with v^(-1/5)
        let longer = self.run.contact_time_s / self.echo_s?;
        Some(self.impact.velocity_m_s * longer.powi(5))
    }

    /// A sentence on whether a ball as target radiates, from the contact on a half-space.
    fn waves(&self, echo_s: f64) -> String {
        if self.impact.settings.model == Model::Hertz {
            return "waves: none in the model \"hertz\"".to_owned();
        }
        let contact_s = self.run.contact_time_s;
        let [touch, echo] = [contact_s, echo_s].map(|time_s| short(time_s, "s"));
        if self.radiates {
            let below = self.echoes_below_m_s().map(|v| short(v, "m/s"));
            return format!(
                "waves: the first echo in the target returns after {echo}, after the contact of {touch}: the target radiates like a half-space, as at all velocities above about {}",
                below.unwrap_or_default()
            );
        }
        format!(
            "waves: echoes cross the target {:.0} times during the contact of {touch} and return their energy: a half-space would radiate {:.2e} of the energy, this file radiates nothing",
            contact_s / echo_s,
            self.run.radiated_energy_j / self.run.initial_energy_j
        )
    }

    /// A sentence on the velocity at which yielding begins, if a strength is known.
    fn onset(&self) -> Option<String> {
        let law = self.impact.settings.plasticity;
        let (results, v) = (&self.run.results, self.impact.velocity_m_s);
        // Hertz's pressure goes with v^(2/5)
        let onset = results.loading.yield_onset.map(|over| v * over.powf(-2.5));
        Some(match results.plastic.yield_velocity_m_s {
            Some(onset) => {
                let over = results.plastic.velocity_over_trusted;
                let trusted =
                    over.map(|over| format!("; the law is valid up to {}", short(v / over, "m/s")));
                format!(
                    "yield: begins at {} in the plasticity \"{}\"; the contact is elastic at lower velocities{}",
                    short(onset, "m/s"),
                    law.name(),
                    trusted.unwrap_or_default()
                )
            }
            None => format!(
                "yield: begins under the surface at {}; at higher velocities the elastic restitution is only an upper bound: set contact.plasticity",
                short(onset?, "m/s")
            ),
        })
    }

    /// The results of the model, which the particle code reproduces only in part.
    fn outcome(&self) -> String {
        let (run, velocity) = (&self.run, short(self.impact.velocity_m_s, "m/s"));
        let [time, force] = [si(run.contact_time_s, "s"), si(run.peak_force_n, "N")];
        let flows = match run.solved.flow {
            Some(_) => format!(" with {}", self.impact.settings.plasticity.name()),
            None => String::new(),
        };
        format!(
            "model {}{flows} at {velocity}: restitution {:.8}, loss {:.6e}, contact time {time}, peak force {force}; estimated relative error {:.1e}",
            run.solved.chosen.model.name(),
            run.restitution,
            run.loss,
            run.relative_error_estimate
        )
    }
}

/// Solves a contact; an elastic one to [`LOSS_TOLERANCE`] if its scene sets no tolerance of the loss.
fn solve(impact: &Impact) -> Result<Run, ContactError> {
    let settings = &impact.settings;
    if settings.plasticity != Plasticity::None || settings.loss_tolerance.is_some() {
        let run = impact.solve()?;
        if run.solved.flow.is_some() || settings.loss_tolerance.is_some() {
            return Ok(run);
        }
    }
    let mut elastic = impact.clone();
    elastic.settings.loss_tolerance = Some(LOSS_TOLERANCE);
    elastic.solve()
}

/// Replaces the target by a free ball: Hertz's law with the reduced radius and mass.
fn onto_ball(
    impact: &mut Impact,
    balls: &mut Vec<[f64; 2]>,
    diameter_m: f64,
) -> Result<String, Failure> {
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
    Ok(format!(
        "the target is a ball of {diameter} and {own}: Hertz's law with R = R1 R2/(R1 + R2) = {radius} and m = m1 m2/(m1 + m2) = {mass}"
    ))
}

/// Results at a velocity, with their names in the report and in the columns of a table.
pub(super) fn named(results: &Results) -> [(&'static str, f64); 5] {
    [
        ("restitution", results.restitution),
        ("loss", results.loss),
        ("contact_time_s", results.contact_time_s),
        ("peak_force_n", results.peak_force_n),
        ("relative_error_estimate", results.relative_error_estimate),
    ]
}
