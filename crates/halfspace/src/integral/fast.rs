//! Slownesses below one: waves that travel as plane fronts and act only while they pass.
//!
//! Theory: `docs/theory.md` (T17).

use crate::field::{Field, Point, Sense, Six};
use crate::integral::fronts;
use crate::integral::panels::TERM_ROUNDING;
use crate::integral::setting::Setting;
use crate::integral::singularities::Singularities;
use crate::integral::spectrum::{self, Wave, half_angle};
use crate::integral::sum::Sum;
use crate::numeric::scalar::Real;
use crate::potentials::compact::{PASSED, compact};
use crate::potentials::{Order, Potentials, STEP_INTEGRAL, shallow};
use num_complex::Complex64;

impl Setting {
    /// Adds one wave in one sense over 0 < x < 1.
    pub(crate) fn fast<const N: i32>(
        &self,
        at: Point,
        wave: Wave,
        sense: Sense,
        singularities: &mut Singularities,
        sum: &mut Sum,
    ) {
        let limit = at.r + self.profile.radius();
        let shallow = shallow::applies::<N>(self.profile, at);
        match sense {
            Sense::Outgoing if at.t >= self.last_fast(at, wave, limit) => {
                if N == STEP_INTEGRAL {
                    let passed = self.passed[wave as usize];
                    sum.add(1.0, [TERM_ROUNDING; 2], [0.0, passed, 0.0, 0.0, 0.0, 0.0]);
                }
                return;
            }
            Sense::Image if at.t >= limit => return,
            Sense::Image if !shallow && at.t + at.z * self.vertical_at_one(wave) >= limit => return,
            Sense::Outgoing | Sense::Image => {}
        }
        fronts::singular::<N>(self, at, wave, Some(sense), singularities);
        for interval in singularities.intervals() {
            let (x, p, _) = half_angle(0.5 * (interval.0 + interval.1));
            let eta = self.eta(at, wave, sense, x, p);
            let at_surface = sense.sign() * at.t / x;
            if eta.abs() < limit || shallow && at_surface.abs() < limit {
                singularities.visit(interval, self.digits(at, shallow), &mut |nodes| {
                    self.add_nodes::<N>(at, wave, Some(sense), nodes, shallow, sum);
                });
            } else if eta < 0.0 && N == STEP_INTEGRAL {
                self.add_passed(at.r, wave, interval, sum);
            }
        }
    }

    /// dx/du and the integrand at the half-angle u.
    #[inline(always)]
    pub(crate) fn fast_term<const N: i32, T: Real>(
        &self,
        (at, digits): (Point, f64),
        (wave, sense): (Wave, Sense),
        u: T,
    ) -> (T, [T; 6]) {
        let (x, p, jacobian) = half_angle(u);
        let eta = self.eta(at, wave, sense, x, p);
        let psi = compact::<N, T>(self.profile, eta, (at.r, digits));
        let amplitudes = spectrum::fast(wave, self.k, x, p);
        (
            jacobian,
            amplitudes.fields(&in_time::<N, T>(psi, sense, x), at.r),
        )
    }

    /// Replaces the tractions by their differences from the surface.
    pub(crate) fn set_fast_traction(
        &self,
        at: Point,
        (wave, sense): (Wave, Sense),
        u: f64,
        term: &mut Six,
    ) {
        let (x, p, _) = half_angle(u);
        let root = match wave {
            Wave::P => p,
            Wave::S => (self.k - x * x).sqrt(),
        };
        let eta = self.eta(at, wave, sense, x, p);
        let (surface, step) = (sense.sign() * at.t / x, at.z * root / x);
        let (a, g) = shallow::compact_difference(surface, step, eta, at.r);
        spectrum::fast(wave, self.k, x, p).set_traction(term, a, g, at.r);
    }

    /// int of the amplitude of w times x/2 dx over the whole fast interval: the time integral of a wave
    /// that has passed.
    pub(crate) fn passed_whole(&self, wave: Wave) -> f64 {
        let mut sum = Sum::default();
        self.add_passed(1.0, wave, (0.0, 1.0), &mut sum);
        sum.value()[Field::DisplacementZ.index()]
    }

    /// Adds the time integral of an outgoing wave that has passed on an interval.
    fn add_passed(&self, r: f64, wave: Wave, interval: (f64, f64), sum: &mut Sum) {
        let mut singularities = self.fixed.fast.clone();
        singularities.pole = Complex64::i();
        singularities.visit(interval, self.deep_digits, &mut |nodes| {
            for (place, weight, error) in nodes.iter() {
                let (x, p, jacobian) = half_angle(place);
                let psi = PASSED.map(|v| -x * v);
                let term = spectrum::fast(wave, self.k, x, p).fields(&psi, r);
                sum.add(weight * jacobian, error, term);
            }
        });
    }

    /// Time after which the outgoing wave has passed at every slowness below one.
    fn last_fast(&self, at: Point, wave: Wave, limit: f64) -> f64 {
        let slowness = self.slowness(wave);
        let reach = (at.z * at.z + limit * limit).sqrt();
        if limit * slowness <= reach {
            slowness * reach
        } else {
            at.z * self.vertical_at_one(wave) + limit
        }
    }

    /// gamma^ at x = 1.
    fn vertical_at_one(&self, wave: Wave) -> f64 {
        [0.0, self.span][wave as usize]
    }

    /// eta = (z gamma^ -+ t)/x, accurate where the difference is small and x too.
    #[inline(always)]
    pub(crate) fn eta<T: Real>(&self, at: Point, wave: Wave, sense: Sense, x: T, p: T) -> T {
        let (vertical, root) = match wave {
            Wave::P => (1.0, p),
            Wave::S => (self.root_k, (-(x * x) + self.k).sqrt()),
        };
        // gamma^ = vertical - x^2/(vertical + gamma^)
        x.constant(at.z * vertical + sense.sign() * at.t) / x - x * at.z / (root + vertical)
    }
}

/// Derivatives and integrals in t of functions of eta = (z gamma^ -+ t)/x, from those in eta.
#[inline(always)]
fn in_time<const N: i32, T: Real>(psi: Potentials<T>, sense: Sense, x: T) -> Potentials<T> {
    match Order::of(N) {
        Order::Impulse => {
            let over = x.constant(sense.sign()) / x;
            psi.map(|v| over * v)
        }
        Order::Step => psi,
        Order::StepIntegral => {
            // int dt = -+x int d eta; the order below b3 is -b2
            let step = x * sense.sign();
            let mut psi = psi.map(|v| step * v);
            psi.g_lower = -psi.g_lower;
            psi
        }
    }
}
