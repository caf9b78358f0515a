//! Yield pressure or velocity from what was measured of a contact that yields.
//!
//! Each measure moves one way with either unknown, so that the unknown is bracketed between the onset of yield and far
//! beyond, and halved in its logarithm.
//! The band is what the measure's error makes of it; what the law leaves out is not in it.

use crate::scene::Strike;
use contact::{
    Choice, Collision, ContactError, Exact, HalfSpace, Plasticity, Results, Settings, Solver,
    choice,
};
use thiserror::Error;

/// What was measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Measure {
    /// Velocity of departure over that of approach.
    Restitution,
    /// Duration of the contact in s.
    ContactTime,
    /// Largest force in N.
    PeakForce,
}

choice!(Measure: Restitution = "restitution", ContactTime = "contact_time_s", PeakForce = "peak_force_n");

/// What is to be found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unknown {
    /// Mean pressure of the flow in Pa.
    YieldPressure,
    /// Velocity of approach in m/s.
    Velocity,
}

choice!(Unknown: YieldPressure = "yield_pressure_pa", Velocity = "velocity_m_s");

/// What was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inferred {
    /// The unknown.
    pub value: f64,
    /// What the error of the measure makes of it; an end is missing where no contact that yields has such a measure.
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
    /// No law of flow.
    #[error("[contact] plasticity has to name a law: \"thornton\" or \"recovery\"{}", if *velocity { ", or \"jackson_green\"" } else { "" })]
    NoLaw {
        /// Whether the velocity is sought.
        velocity: bool,
    },
    /// A measure that no contact has that yields.
    #[error(
        "{measure} = {value} is outside ({low:.4e}, {high:.4e}), what a contact has that yields up to {MOST} times the yield velocity"
    )]
    Outside {
        /// What was measured.
        measure: &'static str,
        /// Its value.
        value: f64,
        /// The smallest.
        low: f64,
        /// The largest.
        high: f64,
    },
}

/// Velocity of approach over that of yield, at most.
const MOST: f64 = 1000.0;

/// Halvings of the bracket: to 1e-10 of the unknown.
const HALVINGS: usize = 40;

/// Finds the unknown that gives a measured value, with the band of an absolute error.
///
/// # Errors
/// [`InferError`].
pub fn infer(
    target: &HalfSpace,
    strike: &Strike,
    settings: &Settings,
    unknown: Unknown,
    (measure, [value, error]): (Measure, [f64; 2]),
) -> Result<Inferred, InferError> {
    let velocity = unknown == Unknown::Velocity;
    let law = settings.plasticity;
    if law == Plasticity::None || law == Plasticity::JacksonGreen && !velocity {
        return Err(InferError::NoLaw { velocity });
    }
    let mut solver = Solver::new(&Exact);
    let mut results = |x: f64| {
        let (mut settings, mut velocity_m_s) = (*settings, strike.velocity_m_s);
        match unknown {
            Unknown::YieldPressure => settings.yield_pressure_pa = Some(x),
            Unknown::Velocity => velocity_m_s = x,
        }
        let collision = Collision::new(target, &strike.striker, velocity_m_s);
        let solved = solver.solve(&collision, &settings)?;
        let radiated = solver.radiated(&collision, &settings, &solved)?;
        Results::new(&collision, &settings, &solved, radiated).checked()
    };
    let of = |results: &Results| match measure {
        Measure::Restitution => results.restitution,
        Measure::ContactTime => results.contact_time_s,
        Measure::PeakForce => results.peak_force_n,
    };
    let start = match unknown {
        Unknown::YieldPressure => settings.yield_pressure_pa.unwrap_or(1e9),
        Unknown::Velocity => strike.velocity_m_s,
    };
    // s goes with V and with p_y^-2.5
    let ratio = results(start)?.plastic.velocity_over_yield.unwrap_or(1.0);
    let [onset, far] = match unknown {
        Unknown::YieldPressure => [ratio, ratio / MOST].map(|s| start * s.powf(0.4)),
        Unknown::Velocity => [1.0, MOST].map(|s| start * s / ratio),
    };
    let mut far = far;
    let mut ends = [of(&results(onset)?), 0.0];
    // a velocity that no contact law serves
    ends[1] = loop {
        match results(far) {
            Ok(found) => break of(&found),
            Err(error) if far <= onset => return Err(error.into()),
            Err(_) => far = (far * onset).sqrt(),
        }
    };
    let [low, high] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
    let mut find = |value: f64| -> Result<Option<f64>, ContactError> {
        if !(low..=high).contains(&value) {
            return Ok(None);
        }
        let (mut near, mut beyond) = (onset.ln(), far.ln());
        for _ in 0..HALVINGS {
            let middle = 0.5 * (near + beyond);
            if (of(&results(middle.exp())?) > value) == (ends[0] > ends[1]) {
                near = middle;
            } else {
                beyond = middle;
            }
        }
        Ok(Some((0.5 * (near + beyond)).exp()))
    };
    let Some(found) = find(value)? else {
        return Err(InferError::Outside {
            measure: measure.name(),
            value,
            low,
            high,
        });
    };
    let mut band = [find(value - error)?, find(value + error)?];
    if matches!(band, [Some(a), Some(b)] if a > b)
        || band[0].is_none() && band[1].is_some_and(|b| b < found)
        || band[1].is_none() && band[0].is_some_and(|a| a > found)
    {
        band.reverse();
    }
    Ok(Inferred {
        value: found,
        band,
        results: results(found)?,
    })
}
