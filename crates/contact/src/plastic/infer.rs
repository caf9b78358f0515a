//! Yield pressure or velocity from what was measured of a contact that yields.
//!
//! The unknown is bracketed between the onset of yield and far beyond, and the bracket halved in its logarithm.
//! The band is what the measure's error makes of it; what the law leaves out is not in it.

use crate::collision::Collision;
use crate::error::ContactError;
use crate::model::{Plasticity, Settings};
use crate::names::{Choice, choice};
use crate::responses::Exact;
use crate::results::Results;
use crate::solver::Solver;
use fault::{Class, Culprit, Fault};
use thiserror::Error;

choice! {
    /// What was measured.
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
    /// What is to be found.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Unknown {
        /// Mean pressure of the flow in Pa.
        YieldPressure = "yield_pressure_pa",
        /// Velocity of approach in m/s.
        Velocity = "velocity_m_s",
    }
}

/// What was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inferred {
    /// The unknown.
    pub value: f64,
    /// What the error of the measure makes of it, ascending; an end is missing where no contact that yields has such a
    /// measure.
    pub band: [Option<f64>; 2],
    /// Results with that value.
    pub results: Results,
}

/// Why nothing was found.
#[derive(Debug, Error)]
pub enum InferError {
    /// The contact failed.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// Nothing that a rebound can be inferred from.
    #[error("{0}")]
    Given(String),
    /// No law of flow with that unknown.
    #[error(
        "plasticity = \"{law}\" has no {unknown} to be found: take \"thornton\" or \"recovery\", for velocity_m_s also \"jackson_green\""
    )]
    NoLaw {
        /// Name of the law.
        law: &'static str,
        /// What was sought.
        unknown: &'static str,
    },
    /// A measure that no contact has that yields.
    #[error(
        "{measure} = {} is outside [{:.4e}, {:.4e}], the range of contacts that yield", fault::number(*value), limits[0], limits[1]
    )]
    Outside {
        /// What was measured.
        measure: &'static str,
        /// Its value.
        value: f64,
        /// The smallest and the largest.
        limits: [f64; 2],
    },
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
            } => Culprit {
                limits: Some(*limits),
                ..culprit.key(measure).number(*value)
            },
        }
    }
}

/// Velocity of approach over that of yield, at most.
const MOST: f64 = 1000.0;

/// Halvings of the bracket: to 1e-11 of the unknown.
const HALVINGS: usize = 40;

/// The yield pressure or the velocity of a contact that gives a measured value, with the band of its absolute error.
///
/// What is not sought is that of the collision and its settings.
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
    let (law, by_velocity) = (settings.plasticity, unknown == Unknown::Velocity);
    if law == Plasticity::None || law == Plasticity::JacksonGreen && !by_velocity {
        let (law, unknown) = (law.name(), unknown.name());
        return Err(InferError::NoLaw { law, unknown });
    }
    // the contact with a value of the unknown, and what is measured of it
    let at = |x: f64| -> Result<(Results, f64), ContactError> {
        let (mut collision, mut settings) = (*collision, *settings);
        match unknown {
            Unknown::YieldPressure => settings.yield_pressure_pa = Some(x),
            Unknown::Velocity => collision.velocity_m_s = x,
        }
        let solved = Solver::new(&Exact).solve(&collision, &settings)?;
        let results = Results::new(&collision, &settings, &solved).checked()?;
        let measured = match measure {
            Measure::Restitution => results.restitution,
            Measure::ContactTime => results.contact_time_s,
            Measure::PeakForce => results.peak_force_n,
        };
        Ok((results, measured))
    };
    let start = match unknown {
        Unknown::YieldPressure => settings.yield_pressure_pa.unwrap_or(1e9),
        Unknown::Velocity => collision.velocity_m_s,
    };
    // s goes with V and with p_y^-2.5
    let ratio = at(start)?.0.plastic.velocity_over_yield.unwrap_or(1.0);
    let at_ratio = |s: f64| match unknown {
        Unknown::YieldPressure => start * (ratio / s).powf(0.4),
        Unknown::Velocity => start * s / ratio,
    };
    let mut most = MOST;
    while most > 1.01 && at(at_ratio(most)).is_err() {
        // a velocity that no contact law serves
        most = most.sqrt();
    }
    let bracket = [1.0, most].map(at_ratio);
    let ends = [at(bracket[0])?.1, at(bracket[1])?.1];
    // nothing outside the bracket
    let halved = |value: f64| -> Result<Option<f64>, ContactError> {
        if (value - ends[0]) * (value - ends[1]) > 0.0 {
            return Ok(None);
        }
        let [mut near, mut far] = bracket.map(f64::ln);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (near + far);
            if (at(middle.exp())?.1 > value) == (ends[0] > ends[1]) {
                near = middle;
            } else {
                far = middle;
            }
        }
        Ok(Some((0.5 * (near + far)).exp()))
    };
    let found = halved(value)?.ok_or(InferError::Outside {
        measure: measure.name(),
        value,
        limits: [ends[0].min(ends[1]), ends[0].max(ends[1])],
    })?;
    let mut band = [halved(value - error)?, halved(value + error)?];
    // rising with the measure, or falling
    if (ends[1] > ends[0]) != (bracket[1] > bracket[0]) {
        band.reverse();
    }
    Ok(Inferred {
        value: found,
        band,
        results: at(found)?.0,
    })
}
