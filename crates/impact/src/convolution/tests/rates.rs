//! Velocities and accelerations under a contact that follows its load beside differences of (T55) over small steps.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use crate::convolution::discs::Discs;
use crate::convolution::loads::Forcing;
use crate::convolution::tests::contact;
use crate::convolution::{Convolution, Past};
use crate::grid::{Grid, Wanted};
use crate::kernels::KernelSource;
use crate::quantity::Derivative;
use crate::quantity::Quantity;

/// A displacement's rate at an instant, from the sum over the radii, and how sure it is.
struct Reference<'a> {
    sum: Past<'a>,
    place: [f64; 2],
}

impl Reference<'_> {
    fn displacement(&self, time: f64) -> [f64; 2] {
        if time <= 0.0 {
            return [0.0; 2];
        }
        let found = self.sum.at(self.place, time).unwrap();
        [found[0], found[1]]
    }

    fn difference(&self, time: f64, apart: f64) -> [f64; 2] {
        let (after, before) = (
            self.displacement(time + apart),
            self.displacement(time - apart),
        );
        [0, 1].map(|c| (after[c] - before[c]) / (2.0 * apart))
    }

    /// Values and doubts, extrapolated from two differences.
    fn velocity(&self, time: f64) -> [[f64; 2]; 2] {
        const APART: f64 = 2e-3;
        let (wide, narrow) = (
            self.difference(time, APART),
            self.difference(time, 0.5 * APART),
        );
        [
            [0, 1].map(|c| (4.0 * narrow[c] - wide[c]) / 3.0),
            [0, 1].map(|c| (narrow[c] - wide[c]).abs()),
        ]
    }

    fn rate(&self, order: Derivative, time: f64, step: f64) -> [[f64; 2]; 2] {
        match order {
            Derivative::Field | Derivative::First => self.velocity(time),
            Derivative::Second => {
                let (after, before) = (
                    self.velocity(time + 0.5 * step),
                    self.velocity(time - 0.5 * step),
                );
                [
                    [0, 1].map(|c| (after[0][c] - before[0][c]) / step),
                    [0, 1].map(|c| (after[1][c] + before[1][c]) / step),
                ]
            }
        }
    }
}

/// The largest error over its estimate at a place, and the estimate over the peak, the worse of both components.
fn worst(order: Derivative, duration: f64, place: [f64; 2], tolerance: f64) -> [f64; 2] {
    let excitation = contact(0.29, duration);
    let source = KernelSource::direct(excitation.medium(), 1e-1 * tolerance).unwrap();
    // deep below the surface there is no Rayleigh wave
    let arrivals: Vec<f64> = (excitation.arrivals_s(place).into_iter())
        .filter(|at| at.is_finite())
        .collect();
    let latest = arrivals.iter().fold(0.0, |most: f64, &at| most.max(at));
    let last = latest + duration + 5.0;
    let wanted = Wanted {
        tolerance,
        step_s: None,
        duration_s: Some(last),
        frames: None,
        farthest_m: Some(place[0].hypot(place[1])),
        plate_s: None,
        low_pass_hz: None,
    };
    let grid = Grid::new(&wanted, &excitation, Some(&source)).unwrap();
    let times: Vec<f64> = grid.times_s().collect();
    let all: Vec<usize> = (0..times.len()).collect();
    let quantities = match order {
        Derivative::Field | Derivative::First => [Quantity::VelocityR, Quantity::VelocityZ],
        Derivative::Second => [Quantity::AccelerationR, Quantity::AccelerationZ],
    };
    let convolution = Convolution::new(&source, &grid, &all, (&quantities, None), &|| {});
    let found = convolution.unwrap().at(place[0], place[1]).unwrap();
    let rates = &found[6..];
    let reference = Reference {
        sum: Past::new(&excitation, 1e-8).unwrap(),
        place,
    };
    let step = grid.step_s;
    // samples beside the waves of the first and the last instants, some between
    let near = |t: f64| {
        let fronts = arrivals
            .iter()
            .flat_map(|&at| [at, at + 1.0, at + duration]);
        fronts
            .map(|at| t - at)
            .any(|past| -0.6 * step < past && past < 1.6 * step)
    };
    let mut found = [0.0_f64; 2];
    for (n, &time) in times.iter().enumerate() {
        if time + 2.0 * step > last || !(near(time) || n % 11 == 0) {
            continue;
        }
        let [exact, doubt] = reference.rate(order, time, step);
        for c in 0..2 {
            let peak = rates[c]
                .samples
                .iter()
                .fold(0.0, |m: f64, v| m.max(v.abs()));
            if peak == 0.0 {
                continue;
            }
            let error = (rates[c].samples[n] - exact[c]).abs() - doubt[c];
            if error > rates[c].error {
                println!(
                    "{order:?} T {duration} {place:?} component {c} t {time:.4}: off by {:.2e} of the peak, estimated {:.2e}",
                    error / peak,
                    rates[c].error / peak
                );
            }
            found[0] = found[0].max(error / rates[c].error);
            found[1] = found[1].max(rates[c].error / peak);
        }
    }
    found
}

#[test]
fn rates_of_growing_contacts_are_within_their_estimates() {
    // at 8 radii on the surface the velocity behind the Rayleigh wave varies over a twentieth of a step; under a short
    // contact most samples far away are beside fronts
    for (order, duration, place, most) in [
        (Derivative::First, 30.0, [20.0, 0.0], 0.01),
        (Derivative::First, 300.0, [40.0, 1.0], 0.01),
        (Derivative::First, 300.0, [0.6, 1.2], 0.01),
        (Derivative::First, 300.0, [8.0, 0.0], 0.01),
        (Derivative::Second, 300.0, [3.0, 4.0], 0.1),
        (Derivative::Second, 300.0, [8.0, 0.0], 0.1),
    ] {
        let [over, estimate] = worst(order, duration, place, 1e-3);
        println!(
            "{order:?} T {duration} {place:?}: error over estimate {over:.2}, estimate over peak {estimate:.1e}"
        );
        assert!(over < 1.0 && estimate < most, "{order:?} {place:?}");
    }
}

/// Rates of the discs' forces against differences of P phi(a^2).
#[test]
fn rates_of_shares_are_those_of_their_forces() {
    const APART: f64 = 1e-3;
    let (duration, tolerance) = (30.0, 1e-3);
    let excitation = contact(0.29, duration);
    let wanted = Wanted {
        tolerance,
        step_s: None,
        duration_s: Some(duration),
        frames: None,
        farthest_m: Some(1.0),
        plate_s: None,
        low_pass_hz: None,
    };
    let grid = Grid::new(&wanted, &excitation, None).unwrap();
    let [forces, rates] = [Derivative::Field, Derivative::First]
        .map(|derivative| Forcing::new(&grid, &[], derivative, (1, None)));
    let discs = Discs::between(0.04, 6);
    for k in 0..discs.count() {
        for t in [0.1, 0.23, 0.4, 0.61, 0.9].map(|part| part * duration) {
            let [after, before] = [t + APART, t - APART].map(|t| forces.on_disc(&discs, k, t));
            let (found, exact) = (
                rates.on_disc(&discs, k, t),
                (after - before) / (2.0 * APART),
            );
            // forces of one over a contact of 30 have rates of 0.1
            assert!((found - exact).abs() < 1e-5, "{k} {t}: {found} {exact}");
        }
    }
}
