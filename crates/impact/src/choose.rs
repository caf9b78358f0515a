//! `auto`: the cheapest rung of a family of models that meets the tolerance.
//!
//! Within a family (fixed disc or growing contact) the rungs are quasi-static, quasi-static with the
//! first-order radiated loss, and full memory; each is the limit of the next as the memory over the
//! contact time goes to zero.
//! What a rung leaves out is bounded by what the next one adds:
//!
//! ```text
//! quasi-static   relative change of the results of first order in the lag c
//! radiation      terms of second order in c and of first order in c times the memory
//! ```

use crate::contact::radiation::LOSS;

/// A rung of the ladder.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Rung {
    /// No waves at all.
    QuasiStatic,
    /// First-order radiated loss.
    Radiation,
    /// Full memory.
    FullMemory,
}

/// The rung chosen and why.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// The rung.
    pub rung: Rung,
    /// Estimated relative error of that rung.
    pub error: f64,
    /// The reason in words.
    pub reason: String,
}

/// Bound of what radiation leaves out, over lag times (lag + memory); from 1,000 random scenes.
const SECOND_ORDER: f64 = 40.0;

/// Chooses for a lag c and a memory (both in collision units) of a contact without extra springs.
///
/// `loss_tolerance` is relative to the loss 1 - e^2.
#[must_use]
pub fn choose(lag: f64, memory: f64, tolerance: f64, loss_tolerance: Option<f64>) -> Choice {
    let first = 0.5 * LOSS * lag;
    let second = SECOND_ORDER * lag * (lag + memory);
    let second_loss = SECOND_ORDER * (lag + memory);
    if first <= tolerance && loss_tolerance.is_none() {
        return Choice {
            rung: Rung::QuasiStatic,
            error: first,
            reason: format!(
                "radiation changes the results by {first:.1e}, below the tolerance {tolerance:.1e}: no waves needed"
            ),
        };
    }
    if second <= tolerance && loss_tolerance.is_none_or(|asked| second_loss <= asked) {
        return Choice {
            rung: Rung::Radiation,
            error: second,
            reason: format!(
                "radiation changes the results by {first:.1e}; what its first order leaves out, {second:.1e}, is below the tolerance {tolerance:.1e}"
            ),
        };
    }
    Choice {
        rung: Rung::FullMemory,
        error: 0.0,
        reason: format!(
            "the first order of radiation would leave out {second:.1e}, above the tolerance {tolerance:.1e}: full memory"
        ),
    }
}
