//! A contact solved on its half-space.

use crate::excitation::{Excitation, PressureRadius};
use contact::{
    Collision, ContactError, HalfSpace, Responses, Results, Settings, Solved, Solver, fixed_disc_m,
};
use std::ops::Deref;

/// A solved impact: its [`Results`], and the excitation of the half-space.
#[derive(Debug, Clone)]
pub struct Run {
    /// Model, scheme and results in collision units.
    pub solved: Solved,
    /// Results in SI units.
    pub results: Results,
    /// Warnings for the user.
    pub warnings: Vec<String>,
    excitation: Excitation,
}

impl Deref for Run {
    type Target = Results;

    fn deref(&self) -> &Results {
        &self.results
    }
}

impl Run {
    /// The force on the half-space.
    pub fn excitation(&self) -> &Excitation {
        &self.excitation
    }

    /// Adds a relative error that the solver does not know, to the results and to the force.
    pub(crate) fn add_error(&mut self, relative: f64) {
        self.solved.error += relative;
        self.results.relative_error_estimate += relative;
        self.excitation.relative_error += relative;
    }
}

/// Solves a contact with a solver's responses, without warnings.
pub(crate) fn solve_once<S: Responses>(
    solver: &mut Solver<'_, S>,
    half_space: &HalfSpace,
    collision: &Collision,
    settings: &Settings,
) -> Result<Run, ContactError> {
    let (solved, history) = solver.solve_with_history(collision, settings)?;
    let results = Results::new(collision, settings, &solved).checked()?;
    let radius = match fixed_disc_m(solved.chosen.model, settings, collision) {
        Some(radius_m) => PressureRadius::Fixed(radius_m),
        None => PressureRadius::Following {
            largest_m: results.disc_radius_m,
            largest_n: results.peak_force_n,
        },
    };
    let (units, duration_s) = (collision.units(), results.contact_time_s);
    let excitation = Excitation::of_contact(half_space, radius, history, units, duration_s)?;
    Ok(Run {
        solved,
        results,
        warnings: Vec::new(),
        excitation,
    })
}
