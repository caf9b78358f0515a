//! A run of rows with their results.

use super::Spec;
use super::axis::place;
use super::collide::{Collided, Collider};
use super::responses::Responses;
use super::schema::{NO_MODEL, NUMBERS};
use super::template::{Scratch, Templates};
use crate::scene::{Load, MODELS};
use rayon::prelude::*;

/// Results of consecutive rows.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Block {
    /// First row.
    pub start: usize,
    /// Results in the order of [`NUMBERS`], NaN for a failed scene.
    pub numbers: Vec<[f64; NUMBERS.len()]>,
    /// Model of each row as an index into [`MODELS`].
    pub models: Vec<u8>,
    /// Failed rows and why.
    pub failures: Vec<(usize, String)>,
}

/// Rows that one thread takes at a time.
const GRAIN: usize = 256;

impl Block {
    /// Computes the rows from `start` to `end`.
    pub(crate) fn compute(
        spec: &Spec,
        templates: &Templates<'_>,
        responses: &Responses,
        start: usize,
        end: usize,
    ) -> Self {
        let grains: Vec<Self> = (start..end)
            .into_par_iter()
            .step_by(GRAIN)
            .map(|from| {
                let mut grain = Self {
                    start: from,
                    ..Self::default()
                };
                let mut collider = Collider::new(responses);
                let (mut scratch, mut places) = (Scratch::default(), Vec::new());
                for row in from..(from + GRAIN).min(end) {
                    place(&spec.axes, row, &mut places);
                    let done = row_result(templates, &places, &mut scratch, &mut collider);
                    grain.push(row, done);
                }
                grain
            })
            .collect();
        let mut block = Self {
            start,
            ..Self::default()
        };
        for grain in grains {
            block.numbers.extend(grain.numbers);
            block.models.extend(grain.models);
            block.failures.extend(grain.failures);
        }
        block
    }

    fn push(&mut self, row: usize, done: Result<Collided, String>) {
        match done {
            Ok(found) => {
                self.numbers.push(found.numbers());
                let model = MODELS.iter().position(|(_, m)| *m == found.model);
                self.models.push(model.map_or(NO_MODEL, |i| i as u8));
            }
            Err(reason) => {
                self.numbers.push([f64::NAN; NUMBERS.len()]);
                self.models.push(NO_MODEL);
                self.failures.push((row, reason));
            }
        }
    }
}

fn row_result(
    templates: &Templates<'_>,
    place: &[usize],
    scratch: &mut Scratch,
    collider: &mut Collider<'_>,
) -> Result<Collided, String> {
    let scene = templates
        .scene(place, scratch)
        .map_err(|error| error.to_string())?;
    match &scene.load {
        Load::Strike(striker) => collider
            .collide(scene, striker)
            .map_err(|error| error.to_string()),
        Load::Prescribed(_) => Err("a sweep needs a striker".to_owned()),
    }
}

impl Collided {
    /// In the order of [`NUMBERS`].
    #[must_use]
    pub fn numbers(&self) -> [f64; NUMBERS.len()] {
        [
            self.peak_force_n,
            self.peak_force_time_s,
            self.contact_time_s,
            self.rebound_velocity_m_s,
            self.summary.restitution,
            self.summary.loss,
            self.peak_displacement_m,
            self.peak_deflection_m,
            self.impulse_n_s,
            self.initial_energy_j,
            self.contact_radius_m,
            self.summary.contacts as f64,
            self.march_steps,
            self.relative_error_estimate,
        ]
    }
}
