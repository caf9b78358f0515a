//! Quadrature of a function whose singularities are all known.
//!
//! The interval [0, 1] is cut at the singularities that lie on it; toward a cut the variable is squared,
//! which turns square roots into smooth functions. The pieces are integrated by Gauss rules on panels.
//!
//! Theory: `docs/theory.md` (T18).

use crate::integral::panels::{Images, Node, ROUNDING, Rule, panels};
use crate::integral::strength::Strength;
use crate::numeric::complex::root;
use crate::numeric::lanes::{Map, Pair, Points};
use crate::numeric::scalar::Scalar;
use arrayvec::ArrayVec;
use num_complex::Complex64;
use pulp::Simd;

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

/// Most cuts or singularities that an integrand of this crate has.
const CAPACITY: usize = 64;

/// The interval [0, 1] of a smooth variable with everything that is not smooth near it.
#[derive(Debug, Clone)]
pub(crate) struct Landscape {
    cuts: ArrayVec<f64, CAPACITY>,
    singularities: ArrayVec<Complex64, CAPACITY>,
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
    ///
    /// Unbounded integrands have a rounding error of `times` the usual one.
    pub(crate) fn new(
        fixed: &[Complex64],
        pole: Complex64,
        strength: Strength,
        (fold, times): (Fold, f64),
    ) -> Self {
        let mut landscape = Self {
            cuts: ArrayVec::new(),
            singularities: ArrayVec::new(),
            pole,
            strength,
            fold,
            rounding: times * ROUNDING,
        };
        for &point in fixed {
            landscape.add(point);
        }
        landscape
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
        let cuts = &mut self.cuts;
        cuts.sort_unstable_by(f64::total_cmp);
        let mut ends: ArrayVec<f64, { CAPACITY + 2 }> = ArrayVec::new();
        ends.push(0.0);
        for &cut in cuts.iter() {
            if !same(cut, ends[ends.len() - 1]) {
                ends.push(cut);
            }
        }
        if same(ends[ends.len() - 1], 1.0) {
            ends.pop();
        }
        ends.push(1.0);
        (1..ends.len()).map(move |i| (ends[i - 1], ends[i]))
    }

    /// Passes on the nodes of a rule on one interval a panel at a time, accurate to exp(-`digits`) of the size of the
    /// integrand.
    pub(crate) fn visit(&self, (from, to): (f64, f64), digits: f64, f: &mut impl FnMut(&[Node])) {
        match (self.power(from), self.power(to)) {
            (None, None) => {
                let rule = Rule {
                    finite_part: false,
                    caution: self.strength.caution(),
                };
                let images = self.images(from, to - from, 0.0);
                panels(&images, digits, 3.0, rule, &mut |nodes| {
                    for node in nodes.iter_mut() {
                        node.place = from + (to - from) * node.place;
                        node.weight *= to - from;
                    }
                    f(nodes);
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
        let cuts = self.cuts.iter();
        match cuts.filter(|&&cut| same(cut, end)).count() {
            0 => None,
            1 => Some(SQUARE),
            _ => Some(HIGH),
        }
    }

    /// v = cut + (end - cut) s^power.
    fn visit_power(
        &self,
        cut: f64,
        end: f64,
        power: i32,
        digits: f64,
        f: &mut impl FnMut(&[Node]),
    ) {
        let scale = end - cut;
        let (blur, strength) = (self.blur(cut), self.strength);
        // the singularity of the cut itself is what the power is for
        let mut images = self.images(cut, scale, SAME);
        images.toward(power);
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
            &mut |nodes| {
                let mut count = 0;
                for i in 0..nodes.len() {
                    let Node {
                        place: s,
                        weight,
                        error,
                    } = nodes[i];
                    let below = if power == SQUARE {
                        s
                    } else {
                        (s * s) * (s * s) * s
                    };
                    let v = cut + scale * (below * s);
                    if v != cut {
                        nodes[count] = Node {
                            place: v,
                            weight: weight * scale.abs() * f64::from(power) * below,
                            error: strength.at_front(error, blur, (v - cut).abs(), s),
                        };
                        count += 1;
                    }
                }
                f(&nodes[..count]);
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
        for &other in &self.cuts {
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
        for point in &self.singularities {
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

    /// Singularities and pole in the variable (v - `from`)/`scale`, but for those nearer than `least`.
    fn images(&self, from: f64, scale: f64, least: f64) -> Images {
        let mut all = Points::new();
        for &cut in &self.cuts {
            all.push(cut.into());
        }
        for &point in &self.singularities {
            all.push(point);
        }
        all.map(&Scaled { from, scale, least });
        Images {
            all,
            pole: (self.pole - from) / scale,
        }
    }
}

/// (v - `from`)/`scale`, but for what is nearer than `least` to zero.
struct Scaled {
    from: f64,
    scale: f64,
    least: f64,
}

impl Map for Scaled {
    #[inline(always)]
    fn at<S: Simd>(&self, v: Pair<S>) -> Pair<S> {
        let scale = v.re.constant(self.scale);
        let image = Pair {
            re: (v.re - self.from) / scale,
            im: v.im / scale,
        };
        let least = v.re.constant(self.least * self.least);
        let nowhere = Pair {
            re: v.re.constant(Points::NOWHERE),
            im: v.re.constant(Points::NOWHERE),
        };
        Pair::where_below(image.norm_sqr(), least, nowhere, image)
    }
}

impl Images {
    /// In the variable of which this one is a power.
    fn toward(&mut self, power: i32) {
        if power == SQUARE {
            self.all.map(&Root);
            self.pole = root(self.pole);
        } else {
            let exponent = 1.0 / f64::from(power);
            let mut all = Points::new();
            for point in self.all.iter() {
                all.push(point.powf(exponent));
            }
            self.all = all;
            self.pole = self.pole.powf(exponent);
        }
    }
}

/// The principal square root.
struct Root;

impl Map for Root {
    #[inline(always)]
    fn at<S: Simd>(&self, v: Pair<S>) -> Pair<S> {
        v.root()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOWHERE: Complex64 = Complex64::new(1e99, 0.0);

    fn integral(singularity: Complex64, f: impl Fn(f64) -> f64) -> (f64, usize) {
        let mut landscape = Landscape::new(
            &[singularity],
            NOWHERE,
            Strength::Bounded,
            (Fold::Upper, 1.0),
        );
        let (mut sum, mut count) = (0.0, 0);
        for interval in landscape.intervals() {
            landscape.visit(interval, 28.0, &mut |nodes| {
                sum += nodes.iter().map(|n| n.weight * f(n.place)).sum::<f64>();
                count += nodes.len();
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
            (Fold::Upper, 1.0),
        );
        let mut sum = 0.0;
        for interval in landscape.intervals() {
            landscape.visit(interval, 28.0, &mut |nodes| {
                let terms = nodes.iter().map(|n| n.weight * (n.place - 0.3).abs().ln());
                sum += terms.sum::<f64>();
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
