//! Windows of time in which short waves of a growing contact pass a point: known from geometry, before any kernel is.
//!
//! A contact begins and ends with a small radius, and its waves then are as short as it is small. They pass a point as the
//! fronts of longitudinal, shear and Rayleigh's waves from the centre. Kinks of the force, as where a block begins to yield,
//! have fronts from the nearest to the farthest edge.
//!
//! Theory: `docs/theory.md` (T60).

use super::tuning;
use crate::excitation::{Excitation, PressureRadius};
use crate::quantity::Derivative;
use std::f64::consts::PI;

/// A point of a growing contact, in units of the largest radius a and of a/c_R.
pub(crate) struct Fronts<'a> {
    excitation: &'a Excitation,
    place_m: [f64; 2],
    /// Distance from the centre.
    pub(crate) distance: f64,
    /// a/c_R over the duration of the contact.
    pub(crate) chi: f64,
    /// a/c_R in s.
    crossing_s: f64,
    /// Arrivals in s of longitudinal, shear and Rayleigh's waves from the centre.
    arrivals_s: [f64; 3],
    /// The first arrival from the largest contact, in s.
    pub(crate) first_s: f64,
    /// Arrivals in s of the same waves from the nearest and the farthest edge of the largest contact.
    edges_s: [[f64; 3]; 2],
}

impl<'a> Fronts<'a> {
    /// Of a point in m.
    pub(crate) fn new(excitation: &'a Excitation, place_m: [f64; 2]) -> Self {
        let units = excitation.units();
        let crossing_s = units.time_s() / excitation.medium().rayleigh_speed();
        let [r_m, z_m] = place_m;
        let from = |distance_m: f64| excitation.speeds().arrivals_s(distance_m, z_m, 0.0);
        Self {
            excitation,
            place_m,
            distance: r_m.hypot(z_m) / units.disc_radius_m,
            chi: crossing_s / excitation.end_s(),
            crossing_s,
            first_s: excitation.arrivals_s(place_m)[0],
            arrivals_s: from(r_m),
            edges_s: [
                (r_m - units.disc_radius_m).max(0.0),
                r_m + units.disc_radius_m,
            ]
            .map(from),
        }
    }

    /// Whether the waves of all of a contact are too short for discs, as seen from close to it.
    pub(crate) fn is_fast(&self, tolerance: f64) -> bool {
        let most = tuning::FAST * (tolerance / 1e-3).powf(tuning::FAST_POWER);
        self.distance < tuning::CLOSE && self.chi > most * self.distance
    }

    fn is_shallow(&self) -> bool {
        self.place_m[1] < tuning::SHALLOW * self.place_m[0]
    }

    /// Error of looked-up fields by the waves of the first and last instants that are shorter than the smallest disc and than a
    /// step, over the largest of their kind, displacements or stresses: that of most fields, and of the worst sample. On a fixed disc the
    /// sums count the worst themselves. `power` is that of the load in the time since the contact began.
    pub(crate) fn looked_up_errors(&self, smallest: f64, step_s: f64, power: f64) -> [f64; 2] {
        let excitation = self.excitation;
        let grows = matches!(excitation.radius(), PressureRadius::Following { .. });
        if excitation.record().is_some() {
            return [0.0; 2];
        }
        let reached = |part: f64| (PI * part).powf(power);
        let of_cells = tuning::LOOKED_UP_CELLS * reached(step_s / excitation.end_s());
        if !grows {
            return [of_cells, 0.0];
        }
        let worst = match self.is_shallow() {
            true => tuning::LOOKED_UP_SHALLOW,
            false => tuning::LOOKED_UP_DEEP * smallest * smallest,
        };
        [tuning::LOOKED_UP_MOSTLY, worst].map(|own| own * reached(self.chi) + of_cells)
    }

    /// The same of the echoes of a plate, whose discs are nearly points but have no windows: of displacements or their rates, and
    /// of stresses.
    pub(crate) fn echo_errors(&self, derivative: Derivative) -> [f64; 2] {
        let reached = |power: f64| tuning::LOOKED_UP_MOSTLY * (PI * self.chi).powf(power);
        match derivative {
            Derivative::Field => [2.5, 1.5].map(reached),
            Derivative::First => [1.5; 2].map(reached),
            Derivative::Second => [0.5; 2].map(reached),
        }
    }

    /// Half-widths in a/c_R of the windows around the fronts of longitudinal, shear and Rayleigh's waves in which so many discs
    /// do not serve; `power` is that of the load in the time since the contact began.
    pub(crate) fn widths(&self, discs: usize, tolerance: f64, power: f64) -> [f64; 3] {
        let short = self.chi.powf(power) / tolerance;
        let between = tuning::BETWEEN_FRONTS * short;
        // the term left out falls with the time since the front as its derivative of order 2 N does
        let falls = 2.0 * discs as f64 - power;
        let broad = if between > 1.0 {
            between.powf(1.0 / falls)
        } else {
            0.0
        };
        let sharp = tuning::AT_FRONT.map(|own| (own * short).min(tuning::WIDEST_FRONT));
        let deep = sharp[0].max(broad);
        if !self.is_shallow() {
            return [deep; 3];
        }
        let depth = self.place_m[1] / self.excitation.units().disc_radius_m;
        let rayleigh = sharp[1].max(depth.min(tuning::WIDEST_FRONT));
        [deep, sharp[1].max(broad), rayleigh.max(broad)]
    }

    /// Whether a front of the first or last instants of a contact, or of a kink, passes within these half-widths at a time.
    pub(crate) fn pass(&self, time_s: f64, widths: [f64; 3]) -> bool {
        let mut ends_s = self.excitation.contacts_s().iter().flatten();
        let of_ends = ends_s.any(|end_s| {
            let mut fronts = self.arrivals_s.iter().zip(widths);
            fronts
                .any(|(front_s, width)| (time_s - end_s - front_s).abs() < width * self.crossing_s)
        });
        of_ends || self.of_kink(time_s)
    }

    /// The part at a time of the error that looked-up fields have at fronts of the first and last instants: so many discs leave out a
    /// term that falls with the time from a front as its derivative.
    pub(crate) fn falls(&self, time_s: f64, discs: usize) -> f64 {
        if self.of_kink(time_s) {
            return 1.0;
        }
        let ends_s = self.excitation.contacts_s().iter().flatten();
        let apart_s = |end_s: &f64| {
            let fronts = self.arrivals_s.iter();
            let apart = fronts.map(|front_s| (time_s - end_s - front_s).abs());
            apart.fold(f64::INFINITY, f64::min)
        };
        let apart = ends_s.map(apart_s).fold(f64::INFINITY, f64::min) / self.crossing_s;
        apart.max(1.0).powi(2 - 2 * discs as i32)
    }

    fn of_kink(&self, time_s: f64) -> bool {
        let [near_s, far_s] = self.edges_s;
        let mut kinks_s = self.excitation.kinks_s().iter();
        kinks_s.any(|kink_s| {
            let mut fronts = near_s.iter().zip(far_s);
            fronts.any(|(near_s, far_s)| {
                let since_s = time_s - kink_s;
                near_s - self.crossing_s < since_s && since_s < far_s + self.crossing_s
            })
        })
    }

    /// Whether waves of a time come from the first or last instants of a contact, seen from close to it: the whole contact is
    /// integrated then.
    ///
    /// Their fronts are as sharp as the contact is small, and the waves behind them, too.
    pub(crate) fn are_of_small_contact(&self, time_s: f64, tolerance: f64) -> bool {
        // all of these: `scripts/check-close` counts the fields above their estimates
        /// Times over the radius and the speed of each wave before and after a front.
        const PASSING: [f64; 2] = [0.05, 0.8];
        /// Fraction of the tolerance that the force has reached when a wave has crossed a radius, below which nothing shows.
        const SHOWS: f64 = 0.3;
        let excitation = self.excitation;
        let shows = (PI * self.chi).powf(1.5) > SHOWS * tolerance;
        if self.distance > tuning::CLOSE || !shows {
            return false;
        }
        let medium = excitation.medium();
        let slowness =
            [1.0, medium.kappa(), medium.rayleigh_speed()].map(|c| excitation.units().time_s() / c);
        let [before, after] = PASSING;
        let passes = |end_s: &f64| {
            let mut fronts = self.arrivals_s.iter().zip(slowness);
            fronts.any(|(front_s, unit_s)| {
                let since = (time_s - end_s - front_s) / unit_s;
                -before < since && since < after
            })
        };
        excitation.contacts_s().iter().flatten().any(passes)
    }
}
