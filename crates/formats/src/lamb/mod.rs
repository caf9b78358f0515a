//! Cases of Lamb's problem and their histories, and comparisons of files of histories.
//!
//! `read` reads a case, `write` writes its histories, `columns` compares columns of two texts.

mod columns;
mod read;
mod write;

pub use columns::{Compared, compare_files};
pub use read::read_lamb;
pub use write::stage_lamb;

use contact::HalfSpace;
use oracle::{COMPONENTS, Load, OracleError, Quantity, TimeFunction, histories};
use output::Role;
use rayon::prelude::*;

/// A case: a force on a half-space, and receivers.
#[derive(Debug, Clone)]
pub struct LambCase {
    /// The half-space.
    pub target: HalfSpace,
    /// Distribution of the force.
    pub load: Load,
    /// Its function of time.
    pub force: TimeFunction,
    /// The receivers.
    pub receivers: Vec<Receiver>,
    /// Times of the histories in s.
    pub times_s: Vec<f64>,
    /// Requested quantities.
    pub quantities: Vec<Quantity>,
    /// The text of the case.
    pub text: String,
    /// All input files.
    pub inputs: Vec<Role>,
}

/// A receiver.
#[derive(Debug, Clone, PartialEq)]
pub struct Receiver {
    /// Its name.
    pub name: String,
    /// Distance from the axis and depth in m.
    pub place_m: [f64; 2],
    /// Coordinates x and y in m, if they are given.
    pub xy_m: Option<[f64; 2]>,
}

/// One component at one receiver.
#[derive(Debug, Clone, PartialEq)]
pub struct LambHistory {
    /// Number of the receiver, from 0.
    pub receiver: usize,
    /// Its name, as in the files.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Values at the times of the case.
    pub values: Vec<f64>,
    /// Estimated largest absolute error over time.
    pub error: f64,
}

impl LambHistory {
    /// Largest absolute value.
    pub fn peak(&self) -> f64 {
        self.values.iter().fold(0.0, |most, x| most.max(x.abs()))
    }
}

impl LambCase {
    /// The histories of all receivers, in their order; receivers are computed in parallel.
    ///
    /// # Errors
    /// [`OracleError`], with the name of the receiver.
    pub fn run(&self) -> Result<Vec<LambHistory>, OracleError> {
        let at = |(i, receiver): (usize, &Receiver)| {
            let found = histories(
                &self.target,
                self.load,
                &self.force,
                receiver.place_m,
                &self.times_s,
                &self.quantities,
            );
            let found = found.map_err(|error| {
                OracleError::new("receiver", format!("{}: {error}", receiver.name))
            })?;
            let component = |c: usize, factor: f64, name| LambHistory {
                receiver: i,
                name,
                unit: COMPONENTS[c].2,
                values: found
                    .values
                    .iter()
                    .map(|values| factor * values[c])
                    .collect(),
                error: factor.abs() * found.errors[c],
            };
            let asked = (0..8).filter(|&c| self.quantities.contains(&COMPONENTS[c].0));
            let mut all: Vec<LambHistory> =
                asked.map(|c| component(c, 1.0, COMPONENTS[c].1)).collect();
            for (quantity, c, names) in [
                (Quantity::Displacement, 0, ["ux", "uy"]),
                (Quantity::Velocity, 6, ["vx", "vy"]),
            ] {
                if let Some(xy_m) = receiver
                    .xy_m
                    .filter(|_| self.quantities.contains(&quantity))
                {
                    let r_m = receiver.place_m[0];
                    let part = |x_m: f64| if r_m > 0.0 { x_m / r_m } else { 0.0 };
                    all.extend([0, 1].map(|i| component(c, part(xy_m[i]), names[i])));
                }
            }
            Ok::<_, OracleError>(all)
        };
        let all: Result<Vec<_>, _> = self.receivers.par_iter().enumerate().map(at).collect();
        Ok(all?.concat())
    }

    /// Warning about a force that does not begin at zero, if there is one.
    pub fn warning(&self) -> Option<String> {
        /// Part of the largest force that a wave code would see as a step.
        const BEGINS: f64 = 1e-5;
        let TimeFunction::Smooth { force_n, .. } = self.force else {
            return None;
        };
        let part = self.force.smooth_n(0.0).abs() / force_n.abs();
        (part > BEGINS).then(|| format!("the force is {part:.1e} of its peak at time 0, and not zero before: a code that begins at time 0 has a step there; use a longer source.delay_s"))
    }
}
