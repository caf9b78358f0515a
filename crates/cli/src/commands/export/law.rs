//! The force laws in the input of a code: between the two bodies, and between two balls of the same material.

use crate::commands::export::case::Case;
use crate::commands::export::motion::{Damping, Rebound};
use crate::failure::Failure;
use crate::report::{short, si};
use contact::{BodyError, HalfSpace, Material, Model, Plasticity, Striker};
use impact::{Impact, Run};
use serde::Serialize;

/// Relative error of the area dashpot's loss divided by the square of the memory in collision times. Measured for
/// Poisson's ratios from 0 to 0.45 and a share of 0.02 to 0.99 of the compliance in the block: 0.146 at most, and below
/// 0.01 with a third of the compliance in the block. The next constant is the largest memory for which this holds.
const LEFT_OUT: f64 = 0.15;
const LARGEST_MEMORY: f64 = 0.5;

/// Relative error of the loss within which one restitution serves other velocities: 10 %, minus the 1e-3 that the time
/// steps of a code may change (`scripts/check-exports` runs both ends).
const OFF: f64 = 0.1 - 1e-3;

/// Largest ratio of such a velocity to the velocity of the scene, the ratio of two trial velocities, and the factor by
/// which an end is moved inwards, larger than the rounding to four digits in print.
const FURTHEST: f64 = 100.0;
const FACTOR: f64 = 1.1;
const RANGE_MARGIN: f64 = 1e-3;

/// Results of the force law of a file, and the velocities in m/s between which it holds.
#[derive(Debug, Serialize)]
pub(super) struct LawReport {
    contact_time_s: f64,
    peak_force_n: f64,
    from_m_s: Option<f64>,
    to_m_s: Option<f64>,
}

/// A particle code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Code {
    Lammps,
    Yade,
}

impl Code {
    /// Whether the damping force may be tensile at the end of a contact; the other code cuts the force at zero.
    fn pulls(self) -> bool {
        self == Self::Lammps
    }
}

/// A law: Hertz's spring with E*, and its damping.
#[derive(Debug, Clone, Copy)]
pub(super) struct PairLaw {
    pub(super) modulus_pa: f64,
    /// Restitution at the velocity of the scene.
    pub(super) restitution: f64,
    /// C = J/(mu c2) in m s/N of the area dashpot; zero without one.
    pub(super) lag_m_s_n: f64,
    /// Damping ratio of a law with the same restitution at all velocities.
    pub(super) ratio: f64,
}

/// The laws of a file.
pub(super) struct Laws {
    /// Between striker and target.
    pub(super) both: PairLaw,
    /// Between two balls of the striker's material, and of the target's if the target is a ball.
    pub(super) like: Vec<PairLaw>,
    /// Contact time of `both` at the velocity of the scene in s.
    pub(super) contact_time_s: f64,
    /// Largest force of `both` at the velocity of the scene in N.
    pub(super) peak_force_n: f64,
    /// Velocities in m/s between which the loss of one restitution holds.
    range_m_s: Option<[f64; 2]>,
    pub(super) notes: Vec<String>,
}

impl Laws {
    /// The laws of a case in a code.
    pub(super) fn new(case: &Case, code: Code) -> Result<Self, Failure> {
        let (collision, v) = (case.impact.collision(), case.impact.velocity_m_s);
        let units = collision.units();
        let damping = damping(case, code);
        let lag = match damping {
            Damping::Area(lag) => lag,
            Damping::None | Damping::Ratio(_) => 0.0,
        };
        let both = PairLaw {
            modulus_pa: collision.effective_modulus_pa,
            restitution: case.run.restitution,
            lag_m_s_n: lag * units.length_m * units.time_s / units.force_n,
            ratio: ratio(damping),
        };
        let range_m_s =
            (ratio(damping) > 0.0).then(|| range(v, case.run.loss, |v| case.at(v, false)));
        let pulls = code.pulls() && range_m_s.is_some();
        let found = damping.rebound(pulls);
        let depth_m = found.depth * units.length_m;
        // if a centre passes the other body, a code sees a contact from the other side
        let deepest_m: f64 = case.balls.iter().map(|[radius_m, _]| radius_m).sum();
        if depth_m >= deepest_m {
            return Err(Failure::input(format!(
                "the indentation is {} at {}, but a particle code loses a contact deeper than {}: use a lower striker.velocity_m_s",
                short(depth_m, "m"),
                short(v, "m/s"),
                short(deepest_m, "m")
            )));
        }
        let mut laws = Self {
            both,
            like: Vec::new(),
            contact_time_s: found.contact_time * units.time_s,
            peak_force_n: found.peak_force * units.force_n,
            range_m_s,
            notes: Vec::new(),
        };
        laws.notes.push(laws.text(case));
        let bodies = [
            &case.impact.striker.material,
            case.impact.half_space.material(),
        ];
        let names = ["striker", "target"];
        for ((name, material), ball) in names.into_iter().zip(bodies).zip(&case.balls) {
            let (law, note) = alike(case, code, name, material, *ball)?;
            laws.like.push(law);
            laws.notes.push(note);
        }
        laws.notes
            .push(outcome(v, &found, laws.contact_time_s, laws.peak_force_n));
        Ok(laws)
    }

    /// The numbers for the report.
    pub(super) fn report(&self) -> LawReport {
        LawReport {
            contact_time_s: self.contact_time_s,
            peak_force_n: self.peak_force_n,
            from_m_s: self.range_m_s.map(|range| range[0]),
            to_m_s: self.range_m_s.map(|range| range[1]),
        }
    }

    /// The law of striker and target and its range of validity.
    fn text(&self, case: &Case) -> String {
        let (here, memory) = (
            short(case.impact.velocity_m_s, "m/s"),
            case.run.solved.chosen.regime.memory,
        );
        let dashpot = "law: F = 4/3 E* sqrt(R) d^1.5 + 4 C E*^2 R d d' >= 0";
        if let Some(range) = self.range_m_s {
            let kind = match case.run.solved.flow {
                Some(_) => "plastic contact",
                None => "contact with waves",
            };
            return format!(
                "law: F = 4/3 E* sqrt(R) d^1.5 with the restitution of the {kind} at {here}; {}; for other velocities use the format table",
                held(range)
            );
        }
        if self.both.lag_m_s_n == 0.0 {
            return "law: F = 4/3 E* sqrt(R) d^1.5 (Hertz), exact below yield; no energy is lost to waves".to_owned();
        }
        if memory > LARGEST_MEMORY {
            return format!(
                "{dashpot}, not accurate at {here}: the waves cross the contact in {memory:.2} collision times, more than {LARGEST_MEMORY}"
            );
        }
        let target = match case.balls.len() {
            1 => "a thick block of this material",
            _ => "this target",
        };
        let error = LEFT_OUT * memory * memory;
        let below = case.impact.velocity_m_s * ((1e-3 / LEFT_OUT).sqrt() / memory).powf(5.0 / 3.0);
        format!(
            "{dashpot}, for balls of the striker's material and any radius on {target}; the relative error of its loss is {error:.1e} at {here} and below 1e-3 at velocities under {}",
            short(below, "m/s")
        )
    }
}

/// Damping of the law of striker and target: the area dashpot if the code supports it.
fn damping(case: &Case, code: Code) -> Damping {
    let (flows, lag) = (case.run.solved.flow.is_some(), case.lag());
    let has_area = match code {
        // a force on each ball from a plane; LAMMPS supports only stock models for pairs
        Code::Lammps => case.balls.len() == 1,
        Code::Yade => true,
    };
    if !flows && lag == 0.0 {
        Damping::None
    } else if !flows && has_area {
        Damping::Area(lag)
    } else {
        Damping::of_restitution(case.run.restitution, code.pulls())
    }
}

fn ratio(damping: Damping) -> f64 {
    match damping {
        Damping::Ratio(ratio) => ratio,
        Damping::None | Damping::Area(_) => 0.0,
    }
}

fn held([from, to]: [f64; 2]) -> String {
    let [from, to] = [from, to].map(|v| short(v, "m/s"));
    format!("its loss is accurate to 10 % from {from} to {to}")
}

fn outcome(v: f64, found: &Rebound, contact_time_s: f64, peak_force_n: f64) -> String {
    format!(
        "this file at {}: restitution {:.8}, loss {:.6e}, contact time {}, peak force {}",
        short(v, "m/s"),
        found.restitution,
        1.0 - found.restitution * found.restitution,
        si(contact_time_s, "s"),
        si(peak_force_n, "N")
    )
}

/// The velocities in m/s between which the loss at v is within [`OFF`] of the loss of the contact.
fn range<E>(v: f64, loss: f64, at: impl Fn(f64) -> Result<Run, E>) -> [f64; 2] {
    let holds = |v| at(v).is_ok_and(|run| (loss - run.loss).abs() <= OFF * run.loss);
    [1.0 / FACTOR, FACTOR].map(|factor| {
        let (mut inside, mut outside) = (v, v * factor);
        while holds(outside) {
            (inside, outside) = (outside, outside * factor);
            if (outside / v).ln().abs() > FURTHEST.ln() {
                return inside;
            }
        }
        // to a relative 3e-6
        for _ in 0..15 {
            let middle = (inside * outside).sqrt();
            *if holds(middle) {
                &mut inside
            } else {
                &mut outside
            } = middle;
        }
        match factor < 1.0 {
            true => (inside * (1.0 + RANGE_MARGIN)).min(v),
            false => (inside * (1.0 - RANGE_MARGIN)).max(v),
        }
    })
}

/// The law of two balls of one material and similar size, and a sentence on it.
///
/// Echoes cross such balls many times in a contact, so nothing is radiated. If the scene has a plasticity law, the
/// balls follow it with the strength of their own material.
fn alike(
    case: &Case,
    code: Code,
    name: &str,
    material: &Material,
    ball: [f64; 2],
) -> Result<(PairLaw, String), Failure> {
    let modulus_pa = 0.5 * material.plane_modulus_pa();
    let elastic = PairLaw {
        modulus_pa,
        restitution: 1.0,
        lag_m_s_n: 0.0,
        ratio: 0.0,
    };
    let begin = format!(
        "{name} on {name}: F = 4/3 E* sqrt(R) d^1.5 with E* = {}",
        short(modulus_pa, "Pa")
    );
    let v = case.impact.velocity_m_s;
    let here = short(v, "m/s");
    let pair = pair(case, material, ball)?;
    let run = match pair.settings.plasticity {
        Plasticity::None => Ok(None),
        Plasticity::Thornton | Plasticity::Recovery | Plasticity::JacksonGreen => {
            pair.solve().map(Some)
        }
    };
    let run = match run {
        Ok(Some(run)) if run.solved.flow.is_some() => run,
        Ok(_) => {
            let note = format!(
                "{begin}, elastic at {here}; no energy is lost, because echoes return the energy of the waves in balls of similar size"
            );
            return Ok((elastic, note));
        }
        Err(error) => {
            let note = format!("{begin}, elastic, because their plasticity is unknown: {error}");
            return Ok((elastic, note));
        }
    };
    let law = PairLaw {
        restitution: run.restitution,
        ratio: ratio(Damping::of_restitution(run.restitution, code.pulls())),
        ..elastic
    };
    let at = |velocity_m_s| {
        let mut pair = pair.clone();
        pair.velocity_m_s = velocity_m_s;
        pair.solve()
    };
    let note = format!(
        "{begin} and the restitution {:.8} of their own plastic contact at {here}; {}",
        run.restitution,
        held(range(v, run.loss, at))
    );
    Ok((law, note))
}

/// Two balls of a material at the velocity of the scene, without waves: one with the reduced radius and mass strikes.
fn pair(
    case: &Case,
    material: &Material,
    [radius_m, mass_kg]: [f64; 2],
) -> Result<Impact, Failure> {
    let mut material = material.clone();
    // without waves the density does not matter
    material
        .density_kg_m3
        .get_or_insert(case.impact.half_space.density_kg_m3());
    let strength = material.yield_strength_pa;
    let bodies = [
        &case.impact.striker.material,
        case.impact.half_space.material(),
    ];
    let mut others = bodies.into_iter().filter_map(|body| body.yield_strength_pa);
    let is_softest = strength.is_some_and(|own| others.all(|other| own <= other));
    let striker = Striker::new(material.clone(), 0.5 * mass_kg, 0.5 * radius_m);
    let failed = |error: BodyError| Failure::input(error.to_string());
    let half_space = HalfSpace::new(material).map_err(failed)?;
    let striker = striker.map_err(failed)?;
    let mut pair = Impact::new(half_space, striker, case.impact.velocity_m_s);
    pair.settings = case.impact.settings;
    (pair.settings.model, pair.settings.step_s) = (Model::Hertz, None);
    if !is_softest {
        // the given pressure belongs to the softer body
        pair.settings.yield_pressure_pa = None;
    }
    Ok(pair)
}
