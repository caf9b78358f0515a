//! Quadrature of a function all of whose singularities are known.
//!
//! The interval [0, 1] is cut at the singularities on it. Toward a cut the variable is squared, which turns square
//! roots into smooth functions. The pieces are integrated by Gauss rules on panels.
//!
//! Theory: `docs/theory.md` (T18).

use crate::integral::panels::{
    IntervalEnd, PanelNodes, SingularityStrength, TERM_ROUNDING, panels,
};
use crate::numeric::lanes::{ComplexMap, Points};
use crate::numeric::scalar::{Complex, Scalar};
use arrayvec::ArrayVec;
use num_complex::Complex64;

/// Power of the variable toward a cut of a single singularity.
const SQUARE: i32 = 2;

/// Power of the variable toward a cut where singularities meet.
const HIGH: i32 = 6;

/// Relative distance below which two cuts count as one.
const SAME_CUT: f64 = 1e-13;

/// Smallest place in the comparison of cuts; the product with [`SAME_CUT`] is then negligible.
const LEAST_PLACE: f64 = 1e-14;

/// Whether two places in [0, 1] count as one; just after a plane front, cuts of 1e-16 differ from zero.
fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME_CUT * a.max(b).max(LEAST_PLACE)
}

/// Largest number of cuts of an integrand.
const CAPACITY: usize = 64;

/// The interval [0, 1] of a smooth variable, with all singularities on and near it.
#[derive(Debug, Clone)]
pub(crate) struct Singularities {
    cuts: ArrayVec<f64, CAPACITY>,
    /// All singularities, including the cuts.
    points: Points,
    /// Place at which the integrand grows as a pole of high order.
    pub(crate) pole: Complex64,
    strength: SingularityStrength,
    /// Ends of the interval at which the variable is the square root of the distance in slowness.
    root_ends: &'static [f64],
    rounding: f64,
    /// The points, mapped to the last piece of the interval.
    images: Points,
}

impl Singularities {
    /// An interval with a pole and the given singularities of a bounded integrand, which is a function of the root of the
    /// distance in slowness from `root_ends`.
    pub(crate) fn new(
        fixed: impl IntoIterator<Item = Complex64>,
        pole: Complex64,
        root_ends: &'static [f64],
    ) -> Self {
        let mut singularities = Self {
            cuts: ArrayVec::new(),
            points: Points::default(),
            pole,
            strength: SingularityStrength::Bounded,
            root_ends,
            rounding: TERM_ROUNDING,
            images: Points::default(),
        };
        fixed.into_iter().for_each(|point| singularities.add(point));
        singularities
    }

    /// Copies cuts, points and pole of another interval. The integrand has singularities of the given strength at its
    /// cuts, and `times` the usual rounding error where it is unbounded.
    #[inline]
    pub(crate) fn take(&mut self, fixed: &Self, strength: SingularityStrength, times: f64) {
        self.cuts.clone_from(&fixed.cuts);
        self.points.copy(&fixed.points);
        (self.pole, self.root_ends) = (fixed.pole, fixed.root_ends);
        (self.strength, self.rounding) = (strength, times * TERM_ROUNDING);
    }

    /// Adds a singularity: a cut if it lies on the interval, otherwise a point to avoid.
    ///
    /// Of a conjugate pair one point is enough.
    pub(crate) fn add(&mut self, point: Complex64) {
        /// Distance of a singularity from the interval below which a cut is made: the squared variable resolves it with
        /// fewer nodes.
        const CUT_DISTANCE: f64 = 0.02;
        /// Distance beyond which a singularity needs no additional node.
        const COSTLESS_DISTANCE: f64 = 1.5;
        let clear = (point.re - 0.5).abs() - 0.5;
        if !(clear < COSTLESS_DISTANCE && point.im.abs() < COSTLESS_DISTANCE) {
            return;
        }
        if clear < CUT_DISTANCE && point.im.abs() < CUT_DISTANCE {
            let cut = point.re.clamp(0.0, 1.0);
            self.cuts.push(cut);
            self.points.push(cut.into());
        }
        if clear > 0.0 || point.im != 0.0 {
            self.points.push(Complex64::new(point.re, point.im.abs()));
        }
    }

    /// The intervals between cuts, in order.
    pub(crate) fn intervals(&mut self) -> ArrayVec<(f64, f64), { CAPACITY + 1 }> {
        self.cuts.sort_unstable_by(f64::total_cmp);
        let (mut intervals, mut from) = (ArrayVec::new(), 0.0);
        for &cut in &self.cuts {
            if !same(cut, from) {
                intervals.push((from, cut));
                from = cut;
            }
        }
        match intervals.last_mut() {
            Some(last) if same(from, 1.0) => last.1 = 1.0,
            _ => intervals.push((from, 1.0)),
        }
        intervals
    }

    /// Passes on the nodes of a rule on one interval, a panel at a time; the error is exp(-`digits`) of the size of the
    /// integrand.
    #[inline(always)]
    pub(crate) fn visit(
        &mut self,
        (from, to): (f64, f64),
        digits: f64,
        f: &mut impl FnMut(&PanelNodes),
    ) {
        match (self.power(from), self.power(to)) {
            (power, 1) => self.visit_piece(from, to, power, digits, f),
            (1, power) => self.visit_piece(to, from, power, digits, f),
            (lower, upper) => {
                let middle = 0.5 * (from + to);
                self.visit_piece(from, middle, lower, digits, f);
                self.visit_piece(to, middle, upper, digits, f);
            }
        }
    }

    /// The power of the variable that smooths the end of an interval.
    #[inline]
    fn power(&self, end: f64) -> i32 {
        match self.cuts.iter().filter(|&&cut| same(cut, end)).count() {
            0 => 1,
            1 => SQUARE,
            _ => HIGH,
        }
    }

    /// v = start + (end - start) s^power.
    fn visit_piece(
        &mut self,
        start: f64,
        end: f64,
        power: i32,
        digits: f64,
        f: &mut impl FnMut(&PanelNodes),
    ) {
        let scale = end - start;
        let is_cut = power > 1;
        let strength = self.strength;
        let image = LocalCoordinate {
            start,
            scale,
            // the power accounts for the singularity of the cut itself
            least: if is_cut { SAME_CUT } else { 0.0 },
            square: power == SQUARE,
        };
        self.images.copy(&self.points);
        self.images.map(&image);
        let mut pole = (self.pole - start) / scale;
        if power == SQUARE {
            pole = pole.root();
        } else if is_cut {
            let exponent = 1.0 / f64::from(power);
            self.images.replace(|point| point.powf(exponent));
            pole = pole.powf(exponent);
        }
        let place_error = if is_cut && strength != SingularityStrength::Bounded {
            self.place_error(start)
        } else {
            0.0
        };
        // a power times a logarithm remains at s = 0: a Gauss rule gains 2 power digits per doubling there
        let least = if power == HIGH {
            (0.7 * digits) as usize
        } else {
            3
        };
        let piece = IntervalEnd {
            start,
            scale,
            power,
            strength,
            place_error,
        };
        panels((&self.images, pole), (digits, least), piece, f);
    }

    /// Largest distance of a cut from its front due to rounding, if the integrand is unbounded.
    ///
    /// A front and its neighbour are roots of one quadratic equation: the closer two roots, the worse their condition.
    /// The same holds for a slowness and its mirror image at an end where the variable is a root.
    fn place_error(&self, cut: f64) -> f64 {
        /// Factor for merged fronts, since the interval between them is ignored.
        const MERGED: f64 = 1e7;
        /// Relative distance within which a neighbour may be the other root of the quadratic equation.
        const OTHER_ROOT: f64 = 0.1;
        // rounding moves a root by at most its square root
        let by = |distance: f64| self.rounding / distance.max(self.rounding.sqrt());
        let own = || self.cuts.iter().filter(|&&other| same(other, cut));
        if own().count() > 1 || own().any(|&other| other != cut) {
            return MERGED;
        }
        let squares = self.points.iter().map(|point| (point - cut).norm_sqr());
        let least = SAME_CUT * cut.max(LEAST_PLACE);
        let others = squares.filter(|square| *square > least * least);
        let nearest = others.fold(1.0, f64::min).sqrt();
        let neighbour = if nearest < OTHER_ROOT * cut {
            by(nearest)
        } else {
            0.0
        };
        let mirror: f64 = self.root_ends.iter().map(|end| by((end - cut).abs())).sum();
        // under a disc the plane front is exact even for a small place; a point force has no plane front
        let place = match self.strength {
            SingularityStrength::FinitePart => 1.0,
            SingularityStrength::Bounded | SingularityStrength::InverseRoot => cut,
        };
        // a mirror image moves a small cut by no more than a fraction of itself
        self.rounding * place + neighbour + mirror.min(cut)
    }
}

/// (v - `start`)/`scale` or its principal square root, except for points nearer than `least` to zero.
struct LocalCoordinate {
    start: f64,
    scale: f64,
    least: f64,
    square: bool,
}

impl ComplexMap for LocalCoordinate {
    #[inline(always)]
    fn at<C: Complex>(&self, v: C) -> C {
        let re = v.re();
        let scale = re.constant(self.scale);
        let image = C::new((re - self.start) / scale, v.im() / scale);
        let least = re.constant(self.least * self.least);
        let nowhere = re.constant(Points::NOWHERE);
        let nowhere = C::new(nowhere, nowhere);
        let found = C::where_below(image.norm_sqr(), least, nowhere, image);
        if self.square { found.root() } else { found }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOWHERE: Complex64 = Complex64::new(1e99, 0.0);

    fn integral(singularity: Complex64, f: impl Fn(f64) -> f64) -> (f64, usize) {
        let mut singularities = Singularities::new([singularity], NOWHERE, &[1.0]);
        let (mut sum, mut count) = (0.0, 0);
        for interval in singularities.intervals() {
            singularities.visit(interval, 28.0, &mut |nodes| {
                sum += nodes
                    .iter()
                    .map(|(place, weight, _)| weight * f(place))
                    .sum::<f64>();
                count += nodes.iter().count();
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
        let mut singularities = Singularities::new([0.3.into(), 0.3.into()], NOWHERE, &[1.0]);
        let mut sum = 0.0;
        for interval in singularities.intervals() {
            singularities.visit(interval, 28.0, &mut |nodes| {
                let terms = nodes
                    .iter()
                    .map(|(place, weight, _)| weight * (place - 0.3).abs().ln());
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
            // the distance to the pole has the rounding error of its place
            let noise = 1e-13 + 1e-16 / gap;
            assert!((sum - exact).abs() < noise, "{gap}: {sum} {exact}");
            assert!(count < 1500, "{count} nodes");
        }
    }
}
