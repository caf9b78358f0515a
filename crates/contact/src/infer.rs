//! Yield pressure or velocity from a measured restitution, contact time or peak force of a contact that yields.
//!
//! The unknown is bracketed between the onset of yield and as far beyond as the law goes, and the bracket halved in its
//! logarithm.
//! The interval reflects the error of the measure only, not the error of the law.
//! An elastic contact has the same measure whatever the yield pressure, as long as it is high enough: there the interval has no
//! upper end.

use crate::collision::Collision;
use crate::error::ContactError;
use crate::names::{Choice, choice};
use crate::results::Results;
use crate::settings::Settings;
use crate::solve::Solver;
use crate::waves::cache::Exact;
use fault::{Class, Culprit, Fault};
use thiserror::Error;

choice! {
    /// Measured quantity.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub enum Measure {
        /// Velocity of departure over that of approach.
        Restitution = "restitution",
        /// Duration of the contact in s.
        ContactTime = "contact_time_s",
        /// Largest force in N.
        PeakForce = "peak_force_n",
    }
}

choice! {
    /// Unknown quantity.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Unknown {
        /// Mean pressure of the flow in Pa.
        YieldPressure = "yield_pressure_pa",
        /// Velocity of approach in m/s.
        Velocity = "velocity_m_s",
    }
}

impl Unknown {
    /// Its unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::YieldPressure => "Pa",
            Self::Velocity => "m/s",
        }
    }

    /// Name in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::YieldPressure => "yield pressure",
            Self::Velocity => "velocity",
        }
    }
}

/// An unknown that was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inferred {
    /// The unknown.
    pub value: f64,
    /// The unknown for the measured value minus and plus its error, ascending; an end is missing if no yielding contact
    /// gives such a value.
    pub band: [Option<f64>; 2],
    /// Whether the measured value is that of an elastic contact, within its error or the tolerance of the results: any
    /// yield pressure above the lower end gives it, and the interval has no upper end.
    pub elastic: bool,
    /// Results with that value.
    pub results: Results,
}

/// Errors of [`infer`].
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum InferError {
    /// The contact failed.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// The input does not allow an inference.
    #[error("{0}")]
    Given(String),
    /// The plasticity law does not determine the unknown.
    #[error(
        "plasticity = \"{law}\" does not determine {unknown}: use \"thornton\" or \"recovery\", for velocity_m_s also \"jackson_green\""
    )]
    NoLaw {
        /// Name of the law.
        law: &'static str,
        /// Name of the unknown.
        unknown: &'static str,
    },
    /// A measured value that is impossible for a yielding contact.
    #[error(
        "{measure} = {} is outside [{}, {}], the range possible for a yielding contact with this law, {}", fault::number(*value), fault::rounded(limits[0]), fault::rounded(limits[1]), reach(*most)
    )]
    Outside {
        /// Name of the measure.
        measure: &'static str,
        /// Its value.
        value: f64,
        /// The smallest and the largest.
        limits: [f64; 2],
        /// Velocity of approach over that of yield at the other end of the range.
        most: f64,
    },
}

/// The range of velocities over that of yield, in words.
fn reach(most: f64) -> String {
    format!(
        "from the velocity at the onset of yield to {} times it: check the unit of the measured value, and the scene",
        fault::rounded(most)
    )
}

impl Fault for InferError {
    fn culprit(&self) -> Culprit<'_> {
        let culprit = Culprit::of(Class::Impact);
        match self {
            Self::Contact(_) => culprit,
            Self::Given(_) => Culprit::of(Class::Scene),
            Self::NoLaw { law, .. } => Culprit {
                word: Some((*law).into()),
                ..culprit.key("plasticity")
            },
            Self::Outside {
                measure,
                value,
                limits,
                ..
            } => Culprit {
                limits: Some(*limits),
                ..culprit.key(measure).number(*value)
            },
        }
    }
}

/// Velocity of approach over that of yield, at most: the restitution of `thornton` is 0.006 there.
///
/// `tests/beyond.rs` (`every_rebound_is_inferred_that_an_impact_gives`) goes near it.
const MOST_OVER_YIELD: f64 = 1e9;

/// Bisections of the logarithm of that ratio, where the law ends before it: to a thousandth.
const BISECTIONS: usize = 15;

/// Halvings of the bracket: to 2e-11 of the unknown.
const HALVINGS_OF_BRACKET: usize = 40;

/// A contact that varies with one unknown.
struct Varied<'a> {
    collision: &'a Collision,
    settings: &'a Settings,
    unknown: Unknown,
    measure: Measure,
}

impl Varied<'_> {
    /// The contact with a value of the unknown, and its measure.
    fn at(&self, x: f64) -> Result<(Results, f64), ContactError> {
        let (mut collision, mut settings) = (*self.collision, *self.settings);
        match self.unknown {
            Unknown::YieldPressure => settings.yield_pressure_pa = Some(x),
            Unknown::Velocity => collision.velocity_m_s = x,
        }
        let solved = Solver::new(&Exact).solve(&collision, &settings)?;
        let results = Results::new(&collision, &settings, &solved).checked()?;
        let measured = match self.measure {
            Measure::Restitution => results.restitution,
            Measure::ContactTime => results.contact_time_s,
            Measure::PeakForce => results.peak_force_n,
        };
        Ok((results, measured))
    }

    /// The largest velocity over that of yield: where the law, or a velocity that any contact law serves, ends.
    fn most(&self, by_ratio: impl Fn(f64) -> f64) -> f64 {
        if self.at(by_ratio(MOST_OVER_YIELD)).is_ok() {
            return MOST_OVER_YIELD;
        }
        let [mut near, mut far] = [0.0, MOST_OVER_YIELD.ln()];
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (near + far);
            match self.at(by_ratio(middle.exp())) {
                Ok(_) => near = middle,
                Err(_) => far = middle,
            }
        }
        near.exp()
    }

    /// The unknown as a function of the velocity over that of yield, s, which goes with V and with p_y^-2.5.
    fn by_ratio(&self) -> Result<impl Fn(f64) -> f64, ContactError> {
        let unknown = self.unknown;
        let start = match unknown {
            Unknown::YieldPressure => self.settings.yield_pressure_pa.unwrap_or(1e9),
            Unknown::Velocity => self.collision.velocity_m_s,
        };
        let (mut collision, mut settings) = (*self.collision, *self.settings);
        match unknown {
            Unknown::YieldPressure => settings.yield_pressure_pa = Some(start),
            Unknown::Velocity => collision.velocity_m_s = start,
        }
        collision.check()?;
        let yielding = collision.yielding(&settings)?;
        let ratio = yielding.map_or(1.0, |yielding| yielding.velocity_ratio());
        Ok(move |s: f64| match unknown {
            Unknown::YieldPressure => start * (ratio / s).powf(0.4),
            Unknown::Velocity => start * s / ratio,
        })
    }
}

/// The yield pressure or the velocity of a contact that gives a measured value, with the interval of its absolute error.
///
/// All other numbers are those of the collision and its settings.
///
/// # Errors
/// [`InferError`].
pub fn infer(
    collision: &Collision,
    settings: &Settings,
    unknown: Unknown,
    measure: Measure,
    [value, error]: [f64; 2],
) -> Result<Inferred, InferError> {
    let law = settings.plasticity;
    let is_had = match unknown {
        Unknown::YieldPressure => law.has_pressure(),
        Unknown::Velocity => law.yields(),
    };
    if !is_had {
        let (law, unknown) = (law.name(), unknown.name());
        return Err(InferError::NoLaw { law, unknown });
    }
    let varied = Varied {
        collision,
        settings,
        unknown,
        measure,
    };
    let by_ratio = varied.by_ratio()?;
    let at = |x: f64| varied.at(x);
    let most = varied.most(&by_ratio);
    let bracket = [1.0, most].map(&by_ratio);
    let (onset, end) = (at(bracket[0])?, at(bracket[1])?.1);
    let ends = [onset.1, end];
    // nothing outside the bracket
    let halved = |value: f64| -> Result<Option<f64>, ContactError> {
        if (value - ends[0]) * (value - ends[1]) > 0.0 {
            return Ok(None);
        }
        let [mut near, mut far] = bracket.map(f64::ln);
        for _ in 0..HALVINGS_OF_BRACKET {
            let middle = 0.5 * (near + far);
            if (at(middle.exp())?.1 > value) == (ends[0] > ends[1]) {
                near = middle;
            } else {
                far = middle;
            }
        }
        Ok(Some((0.5 * (near + far)).exp()))
    };
    // how far a measure is beyond that of an elastic contact, away from those that yield
    let beyond = |value: f64| (value - ends[0]) * (ends[0] - ends[1]).signum();
    let relative = settings.tolerance.max(onset.0.relative_error_estimate);
    let slack = error.max(relative * ends[0]);
    let elastic = unknown == Unknown::YieldPressure && beyond(value).abs() <= slack;
    let inside = |value: f64| match elastic && beyond(value) > 0.0 {
        true => ends[0],
        false => value,
    };
    let found = halved(inside(value))?.ok_or(InferError::Outside {
        measure: measure.name(),
        value,
        limits: [ends[0].min(ends[1]), ends[0].max(ends[1])],
        most,
    })?;
    let mut band = [value - error, value + error].map(|value| halved(inside(value)));
    // rising with the measure, or falling
    if (ends[1] > ends[0]) != (bracket[1] > bracket[0]) {
        band.reverse();
    }
    let [low, high] = band;
    Ok(Inferred {
        value: found,
        band: [low?, high?.filter(|_| !elastic)],
        elastic,
        results: at(found)?.0,
    })
}
