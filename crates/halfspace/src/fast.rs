//! Slownesses below one: waves that travel as plane fronts, felt only while they pass.

use crate::compact::{compact, passed};
use crate::field::Field;
use crate::fronts::{self, Point, Sense};
use crate::kernel::{Kernel, Sum, fields, set_traction};
use crate::landscape::{Fold, Landscape, Strength};
use crate::panels::ROUNDING;
use crate::shallow;
use crate::spectrum::{self, Wave};
use num_complex::Complex64;

/// Slowness zero, where the argument of the potentials is infinite.
const ORIGIN: Complex64 = Complex64::new(0.0, 0.0);

impl Kernel {
    /// Adds one wave in one sense over 0 < x < 1.
    pub(crate) fn fast<const ORDER: i32>(
        &self,
        at: Point,
        wave: Wave,
        sense: Sense,
        sum: &mut Sum,
    ) {
        let limit = at.r + self.profile().radius();
        let shallow = shallow::applies::<ORDER>(self.profile(), at);
        match sense {
            Sense::Outgoing if at.t >= self.last_fast(at, wave, limit) => {
                if ORDER == 1 {
                    sum.add(
                        1.0,
                        ROUNDING,
                        [0.0, self.passed[wave as usize], 0.0, 0.0, 0.0, 0.0],
                    );
                } else if ORDER == 2 {
                    self.add_passed::<ORDER>(at, wave, (0.0, 1.0), sum);
                }
                return;
            }
            Sense::Image if at.t >= limit => return,
            Sense::Image if !shallow && at.t + at.z * self.vertical_at_one(wave) >= limit => return,
            Sense::Outgoing | Sense::Image => {}
        }
        let mut landscape = Landscape::new(
            &self.fixed.fast,
            ORIGIN,
            self.strength::<ORDER>(),
            Fold::Upper,
        )
        .with_rounding(self.front_rounding(at));
        fronts::add_fast(
            &mut landscape,
            at,
            self.profile().radius(),
            self.k,
            wave,
            sense,
        );
        if shallow {
            let (above, radius) = (shallow::above(at), self.profile().radius());
            fronts::add_fast(&mut landscape, above, radius, self.k, wave, sense);
        }
        for interval in landscape.intervals() {
            let (x, p, _) = half_angle(0.5 * (interval.0 + interval.1));
            let eta = self.eta(at, wave, sense, x, p);
            let at_surface = sense.sign() * at.t / x;
            if eta.abs() < limit || shallow && at_surface.abs() < limit {
                landscape.visit(
                    interval,
                    self.digits(at, shallow),
                    &mut |u, weight, share| {
                        let (x, p, jacobian) = half_angle(u);
                        let eta = self.eta(at, wave, sense, x, p);
                        let mut psi = compact::<ORDER>(self.profile(), eta, at.r);
                        if ORDER == 1 {
                            // int dt = -+x int d eta; the order below b3 is -b2
                            let step = sense.sign() * x;
                            psi = psi.map(|v| step * v);
                            psi.g_lower = -psi.g_lower;
                        } else if ORDER == 2 {
                            psi = psi.map(|v| x * x * v);
                            psi.g_lower = -psi.g_lower;
                        } else if ORDER < 0 {
                            psi = psi.map(|v| sense.sign() / x * v);
                        }
                        let amplitudes = spectrum::fast(wave, self.k, x, p);
                        let mut term = fields(&amplitudes, &psi, at.r);
                        if shallow {
                            let root = match wave {
                                Wave::P => p,
                                Wave::S => (self.k - x * x).sqrt(),
                            };
                            let (surface, step) = (sense.sign() * at.t / x, at.z * root / x);
                            let difference = shallow::compact_difference(surface, step, eta, at.r);
                            set_traction(&mut term, &amplitudes, difference, at.r);
                        }
                        sum.add(weight * jacobian, share, term);
                    },
                );
            } else if ORDER >= 1 && eta < 0.0 {
                self.add_passed::<ORDER>(at, wave, interval, sum);
            }
        }
    }

    /// int of the amplitude of w times x/2 dx over the whole fast interval: the time integral of a wave
    /// that has passed.
    pub(crate) fn passed_whole(&self, wave: Wave) -> f64 {
        let mut sum = Sum::default();
        let anywhere = Point {
            r: 1.0,
            z: 0.0,
            t: 0.0,
        };
        self.add_passed::<1>(anywhere, wave, (0.0, 1.0), &mut sum);
        sum.value[Field::DisplacementZ.index()]
    }

    /// Adds an outgoing wave that has passed on an interval.
    fn add_passed<const ORDER: i32>(
        &self,
        at: Point,
        wave: Wave,
        interval: (f64, f64),
        sum: &mut Sum,
    ) {
        let mut landscape = Landscape::new(
            &self.fixed.fast,
            Complex64::i(),
            Strength::Bounded,
            Fold::Upper,
        );
        landscape.visit(interval, self.digits(at, false), &mut |u, weight, share| {
            let (x, p, jacobian) = half_angle(u);
            let eta = self.eta(at, wave, Sense::Outgoing, x, p);
            let step = if ORDER == 1 { -x } else { x * x };
            let psi = passed::<ORDER>(eta).map(|v| step * v);
            let amplitudes = spectrum::fast(wave, self.k, x, p);
            sum.add(weight * jacobian, share, fields(&amplitudes, &psi, at.r));
        });
    }

    /// Time after which the outgoing wave has passed at every slowness below one.
    fn last_fast(&self, at: Point, wave: Wave, limit: f64) -> f64 {
        let slowness = self.slowness(wave);
        let reach = at.z.hypot(limit);
        if limit * slowness <= reach {
            slowness * reach
        } else {
            at.z * self.vertical_at_one(wave) + limit
        }
    }

    /// 1 for P, sqrt(K) for S.
    fn slowness(&self, wave: Wave) -> f64 {
        match wave {
            Wave::P => 1.0,
            Wave::S => self.k.sqrt(),
        }
    }

    /// gamma^ at x = 1.
    fn vertical_at_one(&self, wave: Wave) -> f64 {
        match wave {
            Wave::P => 0.0,
            Wave::S => (self.k - 1.0).sqrt(),
        }
    }

    /// eta = (z gamma^ -+ t)/x, accurate where the difference is small and x too.
    #[inline]
    fn eta(&self, at: Point, wave: Wave, sense: Sense, x: f64, p: f64) -> f64 {
        let (vertical, root) = match wave {
            Wave::P => (1.0, p),
            Wave::S => (self.k.sqrt(), (self.k - x * x).sqrt()),
        };
        // gamma^ = vertical - x^2/(vertical + gamma^)
        (at.z * vertical + sense.sign() * at.t) / x - at.z * x / (vertical + root)
    }
}

/// x, p and dx/du at the half-angle u.
#[inline]
fn half_angle(u: f64) -> (f64, f64, f64) {
    let inverse = 1.0 / (1.0 + u * u);
    let p = (1.0 - u) * (1.0 + u) * inverse;
    (2.0 * u * inverse, p, 2.0 * p * inverse)
}
