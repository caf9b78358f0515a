//! What fields take in time: the one model by which kernels are chosen and a forecast is made.
//!
//! Its constants are seconds of one thread, measured with the jobs of `scripts/time-impacts`.
//!
//! What a whole scene takes is a `forecast`.

pub(crate) mod forecast;

use crate::evaluator::convolve::{direct_ns, transform_ns};
use crate::evaluator::discs::Discs;
use crate::excitation::{Excitation, PressureRadius};
use crate::scene::{Scene, Section};

/// What any output takes, and the opening of a table.
const OUTPUT_S: f64 = 1.4e-2;
const TABLE_S: f64 = 6e-2;

/// A kernel beside a disc, and one of the smaller discs of a contact that follows its load, which are farther.
const KERNEL_S: f64 = 7e-6;
const SMALL_DISC: f64 = 1.7;

/// Kernels of a trace whatever its tolerance, and for each digit; for fields with rates so many times more.
const KERNELS: f64 = 20.0;
const KERNELS_A_DIGIT: f64 = 18.0;
const WITH_RATES: f64 = 1.5;

/// Moments of a cell, and what it takes to look it up.
const CELL_S: f64 = 4e-7;
const LOOKED_UP_S: f64 = 1e-6;

/// Samples of a point that are integrated over the radii, over the square of the digits, and kernels of each.
const OPEN: f64 = 0.8;
const KERNELS_OF_OPEN: f64 = 100.0;

/// What the rates of a contact that follows its load take beside its fields.
const FOLLOWING_RATES: f64 = 2.0;

/// What the fields of a scene depend on.
pub(crate) struct Cost<'a> {
    excitation: &'a Excitation,
    points: [f64; 2],
    /// Samples at a probe and at a point of the section.
    wanted: [f64; 2],
    cells: f64,
    tolerance: f64,
    rates: f64,
}

impl<'a> Cost<'a> {
    /// Of a scene whose output has so many samples.
    pub(crate) fn new(scene: &Scene, excitation: &'a Excitation, samples: f64) -> Self {
        let frames = match &scene.section {
            Some(Section { frames, .. }) if !scene.peaks => *frames as f64,
            Some(_) | None => samples,
        };
        let probes = scene.probes.len();
        Self {
            excitation,
            points: [probes, scene.points() - probes].map(|n| n as f64),
            wanted: [samples, frames.min(samples)],
            cells: samples,
            tolerance: scene.settings.tolerance,
            rates: scene.rates() as f64,
        }
    }

    /// Seconds of one thread with kernels that are computed.
    pub(crate) fn computed_s(&self) -> f64 {
        let radius = self.excitation.radius();
        let following = matches!(radius, PressureRadius::Following { .. });
        let discs = Discs::computed(radius, self.tolerance)[0].radii.len() as f64;
        let digits = -self.tolerance.log10();
        let kernels = KERNELS + KERNELS_A_DIGIT * digits;
        let more = if self.rates > 0.0 { WITH_RATES } else { 1.0 };
        let small = if following { SMALL_DISC } else { 1.0 };
        let trace_s = kernels * more * small * KERNEL_S + self.cells * CELL_S;
        let points_s = self.sum(|wanted| {
            let past_s = if following {
                let open = OPEN * digits.powi(2) * wanted / self.cells;
                open * KERNELS_OF_OPEN * SMALL_DISC * KERNEL_S
            } else {
                0.0
            };
            let each = discs * self.convolved_s(wanted) + past_s;
            let rates = if following { FOLLOWING_RATES } else { 1.0 };
            discs * trace_s + each * (1.0 + rates * self.rates)
        });
        OUTPUT_S + points_s
    }

    /// The same with kernels that are looked up.
    pub(crate) fn looked_up_s(&self) -> f64 {
        let discs = Discs::looked_up(self.excitation.radius())[0].radii.len() as f64;
        let points_s = self.sum(|wanted| {
            discs * (self.cells * LOOKED_UP_S + (1.0 + self.rates) * self.convolved_s(wanted))
        });
        TABLE_S + points_s
    }

    fn convolved_s(&self, wanted: f64) -> f64 {
        1e-9 * direct_ns(wanted, self.cells).min(transform_ns(2.0 * self.cells))
    }

    fn sum(&self, of_point: impl Fn(f64) -> f64) -> f64 {
        let each = self.points.iter().zip(self.wanted);
        each.map(|(points, wanted)| points * of_point(wanted)).sum()
    }
}
