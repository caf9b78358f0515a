//! Quadrature of a function whose singularities are all known.
//!
//! The interval [0, 1] is cut at the singularities that lie on it; toward a cut the variable is squared,
//! which turns square roots into smooth functions. The pieces are integrated by Gauss rules on panels.
//!
//! Theory: `docs/theory.md` (T18).

use crate::complex::root;
use crate::list::{CAPACITY, List};
use crate::panels::{Images, ROUNDING, Rule, panels};
use crate::strength::{RelativeError, Strength};
use num_complex::Complex64;

/// Power of the variable toward a cut of a single singularity.
const SQUARE: i32 = 2;

/// Power toward a cut where singularities meet.
const HIGH: i32 = 6;

/// Cuts at a relative distance below this are one.
const SAME: f64 = 1e-13;

/// Smaller places are as good as zero once multiplied by [`SAME`].
const SMALLEST: f64 = 1e-14;

/// Whether two places in [0, 1] are one: just after a plane front cuts of 1e-16 are distinct from zero.
fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME * a.max(b).max(SMALLEST)
}

/// The interval [0, 1] of a smooth variable with everything that is not smooth near it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Landscape {
    cuts: List<f64>,
    singularities: List<Complex64>,
    /// What the rule at hand keeps away from, in its own variable.
    images: List<Complex64>,
    /// Where the integrand grows as a pole of high order.
    pole: Complex64,
    strength: Strength,
    fold: Fold,
    rounding: f64,
}

/// The ends at which a smooth variable stands for the square root of the distance in slowness.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Fold {
    Upper,
    Both,
}

impl Landscape {
    /// An interval with nothing but a pole and the given singularities, none of them on it.
    pub(crate) fn new(
        fixed: &[Complex64],
        pole: Complex64,
        strength: Strength,
        fold: Fold,
    ) -> Self {
        let mut landscape = Self {
            cuts: List::new(),
            singularities: List::new(),
            images: List::new(),
            pole,
            strength,
            fold,
            rounding: ROUNDING,
        };
        for &point in fixed {
            landscape.add(point);
        }
        landscape
    }

    /// Multiplies the assumed rounding error of unbounded integrands by `times`.
    pub(crate) fn with_rounding(mut self, times: f64) -> Self {
        self.rounding *= times;
        self
    }

    /// Adds a singularity: a cut if it lies on the interval, a point to keep away from otherwise.
    ///
    /// Of a conjugate pair one is enough.
    pub(crate) fn add(&mut self, point: Complex64) {
        /// A singularity this close to the interval is worth a cut: the squared variable resolves it sooner.
        const CLOSE: f64 = 0.02;
        /// Beyond this distance a singularity costs no node.
        const FAR: f64 = 1.5;
        let clear = (point.re - 0.5).abs() - 0.5;
        if !(clear < FAR && point.im.abs() < FAR) {
            return;
        }
        if clear < CLOSE && point.im.abs() < CLOSE {
            self.cuts.push(point.re.clamp(0.0, 1.0));
        }
        if clear > 0.0 || point.im != 0.0 {
            self.singularities
                .push(Complex64::new(point.re, point.im.abs()));
        }
    }

    /// The cuts in order, between the ends of the interval.
    pub(crate) fn intervals(&mut self) -> impl Iterator<Item = (f64, f64)> + use<> {
        let cuts = self.cuts.as_mut_slice();
        cuts.sort_unstable_by(f64::total_cmp);
        let mut ends = [0.0; CAPACITY + 2];
        let mut last = 0;
        for &cut in cuts.iter() {
            if !same(cut, ends[last]) {
                last += 1;
                ends[last] = cut;
            }
        }
        if !same(ends[last], 1.0) {
            last += 1;
        }
        ends[last] = 1.0;
        (0..last).map(move |i| (ends[i], ends[i + 1]))
    }

    /// Visits nodes (v, weight, relative error) of a rule on one interval, accurate to exp(-`digits`) of the size of
    /// the integrand.
    pub(crate) fn visit(
        &mut self,
        (from, to): (f64, f64),
        digits: f64,
        f: &mut impl FnMut(f64, f64, RelativeError),
    ) {
        match (self.power(from), self.power(to)) {
            (None, None) => {
                let rule = Rule {
                    finite_part: false,
                    caution: self.strength.caution(),
                };
                let images = self.images(|_| false, |v| (v - from) / (to - from));
                panels(&images, digits, 3.0, rule, &mut |s, weight, error| {
                    f(from + (to - from) * s, weight * (to - from), error.into());
                });
            }
            (Some(power), None) => self.visit_power(from, to, power, digits, f),
            (None, Some(power)) => self.visit_power(to, from, power, digits, f),
            (Some(lower), Some(upper)) => {
                let middle = 0.5 * (from + to);
                self.visit_power(from, middle, lower, digits, f);
                self.visit_power(to, middle, upper, digits, f);
            }
        }
    }

    /// The power of the variable that smooths the end of an interval, if it is a cut.
    fn power(&self, end: f64) -> Option<i32> {
        let cuts = self.cuts.as_slice().iter();
        match cuts.filter(|&&cut| same(cut, end)).count() {
            0 => None,
            1 => Some(SQUARE),
            _ => Some(HIGH),
        }
    }

    /// v = cut + (end - cut) s^power.
    fn visit_power(
        &mut self,
        cut: f64,
        end: f64,
        power: i32,
        digits: f64,
        f: &mut impl FnMut(f64, f64, RelativeError),
    ) {
        let scale = end - cut;
        // the singularity of the cut itself is what the power is for
        let reach = (SAME * scale).powi(2);
        let own = |v: Complex64| (v - cut).norm_sqr() <= reach;
        let (blur, strength) = (self.blur(cut), self.strength);
        let images = self.images(own, |v| {
            let distance = (v - cut) / scale;
            if power == SQUARE {
                root(distance)
            } else {
                distance.powf(1.0 / f64::from(power))
            }
        });
        // A power of a logarithm is left at s = 0: Gauss's rule gains 2 power digits a doubling there.
        let least = if power == SQUARE { 3.0 } else { 0.7 * digits };
        panels(
            &images,
            digits,
            least,
            Rule {
                finite_part: strength == Strength::FinitePart,
                caution: strength.caution(),
            },
            &mut |s, weight, error| {
                let v = cut + scale * s.powi(power);
                if v != cut {
                    f(
                        v,
                        weight * scale.abs() * f64::from(power) * s.powi(power - 1),
                        strength.at_front(error, blur, (v - cut).abs(), s),
                    );
                }
            },
        );
    }

    /// How far a cut may be from the front it stands for, by rounding, where the integrand is unbounded.
    ///
    /// A front and its neighbour are roots of one quadratic: the closer two roots, the worse conditioned each is. The same
    /// holds for a slowness and its mirror image at an end where the variable folds.
    fn blur(&self, cut: f64) -> f64 {
        /// Fronts that were taken for one leave out what lies between them.
        const MERGED: f64 = 1e7;
        /// A neighbour within this fraction of the place may be the other root of the quadratic.
        const TWIN: f64 = 0.1;
        if self.strength == Strength::Bounded {
            return 0.0;
        }
        // beyond its root rounding does not move a root
        let by = |distance: f64| self.rounding / distance.max(self.rounding.sqrt());
        let mut nearest = 1.0_f64;
        let mut own = 0;
        for &other in self.cuts.as_slice() {
            if same(other, cut) {
                own += 1;
                if other != cut {
                    return MERGED;
                }
            } else {
                nearest = nearest.min((other - cut).abs());
            }
        }
        if own > 1 {
            return MERGED;
        }
        for point in self.singularities.as_slice() {
            let distance = (point - cut).norm();
            if distance > SAME * cut.max(SMALLEST) {
                nearest = nearest.min(distance);
            }
        }
        let twin = if nearest < TWIN * cut {
            by(nearest)
        } else {
            0.0
        };
        let fold = match self.fold {
            Fold::Upper => by(1.0 - cut),
            Fold::Both => by(1.0 - cut) + by(cut),
        };
        // under a disc the plane front is exact however small its place; a point force has none
        let place = match self.strength {
            Strength::FinitePart => 1.0,
            Strength::Bounded | Strength::InverseRoot => cut,
        };
        // a fold moves a small cut by no more than a fraction of itself
        self.rounding * place + twin + fold.min(cut)
    }

    /// Singularities in another variable, but for those that `drop` names.
    fn images(
        &mut self,
        drop: impl Fn(Complex64) -> bool,
        to_variable: impl Fn(Complex64) -> Complex64,
    ) -> Images<'_> {
        self.images.clear();
        let cuts = self.cuts.as_slice().iter().map(|&c| Complex64::new(c, 0.0));
        let others = self.singularities.as_slice().iter().copied();
        for point in cuts.chain(others) {
            if !drop(point) {
                self.images.push(to_variable(point));
            }
        }
        Images {
            all: self.images.as_slice(),
            pole: to_variable(self.pole),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOWHERE: Complex64 = Complex64::new(1e99, 0.0);

    fn integral(singularity: Complex64, f: impl Fn(f64) -> f64) -> (f64, usize) {
        let mut landscape = Landscape::new(&[singularity], NOWHERE, Strength::Bounded, Fold::Upper);
        let (mut sum, mut count) = (0.0, 0);
        for interval in landscape.intervals() {
            landscape.visit(interval, 28.0, &mut |v, w, _| {
                sum += w * f(v);
                count += 1;
            });
        }
        (sum, count)
    }

    #[test]
    fn square_roots_at_cuts_are_integrated() {
        let (sum, count) = integral(0.3.into(), |v| (v - 0.3).abs().sqrt());
        let exact = (0.3_f64.powf(1.5) + 0.7_f64.powf(1.5)) / 1.5;
        assert!((sum - exact).abs() < 1e-14, "{sum} {exact}");
        assert!(count < 20, "{count} nodes");
    }

    #[test]
    fn logarithms_at_double_cuts_are_integrated() {
        let mut landscape = Landscape::new(
            &[0.3.into(), 0.3.into()],
            NOWHERE,
            Strength::Bounded,
            Fold::Upper,
        );
        let mut sum = 0.0;
        for interval in landscape.intervals() {
            landscape.visit(interval, 28.0, &mut |v, w, _| {
                sum += w * (v - 0.3).abs().ln();
            });
        }
        let exact = 0.3 * 0.3_f64.ln() + 0.7 * 0.7_f64.ln() - 1.0;
        assert!((sum - exact).abs() < 1e-12, "{sum} {exact}");
    }

    #[test]
    fn a_near_pole_is_resolved() {
        for gap in [0.3, 1e-2, 1e-4, 1e-7] {
            let pole = Complex64::new(0.4, gap);
            let (sum, count) = integral(pole, |v| gap / ((v - 0.4).powi(2) + gap * gap));
            let exact = (0.6 / gap).atan() + (0.4 / gap).atan();
            // the distance to the pole carries the rounding error of its place
            let noise = 1e-13 + 1e-16 / gap;
            assert!((sum - exact).abs() < noise, "{gap}: {sum} {exact}");
            assert!(count < 1500, "{count} nodes");
        }
    }
}
