//! The six integrands of waves of m legs at a place on the path.
//!
//! Theory: `docs/theory.md` (T68, T69).

use crate::field::Point;
use crate::numeric::lanes::{Lanes, dispatch};
use crate::numeric::scalar::{Complex, Real, Scalar};
use crate::plate::quadrature::{NODES, Values};
use crate::plate::reflection::{Legs, Reflection, add_fields};
use crate::plate::{Place, Plate};
use crate::potentials::closed_form::potentials;
use crate::potentials::compact::compact;
use crate::potentials::far_front::ROUNDING_DIGITS;
use crate::potentials::{Potentials, STEP};
use crate::profile::Profile;
use pulp::{Simd, WithSimd};
use std::f64::consts::PI;

/// Which waves an integrand has.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Part {
    /// All, from q = delta to i kappa.
    Path,
    /// All but shear waves, from q = i kappa to i.
    Slow,
    /// The shear wave of m legs there.
    Shear,
    /// One wave beyond q = i, in one sense.
    Fast { n: usize, wave: usize, sense: f64 },
}

/// The integrands of one part.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Integrand<'a> {
    pub(crate) plate: &'a Plate,
    pub(crate) at: Point,
    /// Legs.
    pub(crate) m: usize,
    /// How far to the right of the imaginary axis the path begins.
    pub(crate) delta: f64,
    pub(crate) part: Part,
}

impl Integrand<'_> {
    /// At the nodes of a panel.
    pub(crate) fn values(&self, nodes: &[f64; NODES]) -> Values {
        dispatch(Nodes {
            integrand: self,
            nodes,
        })
    }

    /// Over a piece between two fronts, where the integrand has roots.
    pub(crate) fn on(&self, [from, to]: [f64; 2], nodes: &[f64; NODES]) -> Values {
        let mut places = [0.0; NODES];
        let mut slopes = [0.0; NODES];
        for (i, s) in nodes.iter().enumerate() {
            let rest = 1.0 - s;
            places[i] = if *s < 0.5 {
                from + (to - from) * s * s * (3.0 - 2.0 * s)
            } else {
                to - (to - from) * rest * rest * (3.0 - 2.0 * rest)
            };
            slopes[i] = (to - from) * 6.0 * s * rest;
        }
        let mut values = self.values(&places);
        for values in &mut values {
            for (value, slope) in values.iter_mut().zip(&slopes) {
                *value *= slope;
            }
        }
        values
    }

    /// The integrands at a place.
    #[inline(always)]
    fn at<T: Real>(&self, v: T) -> [T; 8] {
        match self.part {
            Part::Path => self.along_path(v),
            Part::Slow => self.slow(v, false),
            Part::Shear => self.slow(v, true),
            Part::Fast { n, wave, sense } => self.fast(v, n, wave, sense),
        }
    }

    #[inline(always)]
    fn along_path<T: Real>(&self, v: T) -> [T; 8] {
        let kappa = self.plate.kernel.medium().kappa();
        let one = v.constant(1.0);
        let part = v * (-v + 2.0);
        let slope = (one - v) * 2.0;
        let p2 = part * part;
        let p5 = p2 * p2 * part;
        let q = T::Complex::new((one - p5 * part) * self.delta, part * kappa);
        let dq = T::Complex::new(p5 * slope * (-6.0 * self.delta), slope * kappa);
        let k = self.plate.kernel.medium().shear_slowness_squared();
        let square = q * q;
        let roots = [(square + 1.0).root(), (square * k + 1.0).root()];
        self.complex(q, dq * q.reciprocal(), roots, false, false)
    }

    #[inline(always)]
    fn slow<T: Real>(&self, v: T, shear: bool) -> [T; 8] {
        let k = self.plate.kernel.medium().shear_slowness_squared();
        let span = (k - 1.0).sqrt();
        let inverse = v.constant(1.0) / (v * v + 1.0);
        let (sin, cos, slope) = (v * inverse * 2.0, (-(v * v) + 1.0) * inverse, inverse * 2.0);
        let (p, y) = (sin * span, cos * span);
        let x = (p * p + 1.0).sqrt();
        let over = v.constant(1.0) / x;
        let zero = v.constant(0.0);
        let roots = [
            T::Complex::new(p * over, zero),
            T::Complex::new(zero, y * over),
        ];
        let q = T::Complex::new(zero, over);
        let dq = T::Complex::new(p * y * over * over * slope, zero);
        self.complex(q, dq, roots, shear, true)
    }

    /// Sum over the waves at a complex q, without the shear wave on the imaginary axis, or that alone.
    #[inline(always)]
    fn complex<T: Real>(
        &self,
        q: T::Complex,
        dq_over_q: T::Complex,
        roots: [T::Complex; 2],
        shear: bool,
        on_axis: bool,
    ) -> [T; 8] {
        let Self { plate, at, m, .. } = *self;
        let k = plate.kernel.medium().shear_slowness_squared();
        let reflection = Reflection::complex(k, q, roots);
        let mut sum = [q.re().constant(0.0); 8];
        let place = plate.rays.place(at.z);
        let qt = q * at.t;
        let least = usize::from(on_axis && !shear && place != Place::Inside);
        let most = if shear { 0 } else { m };
        let legs = reflection.after(m, [least, most]);
        for n in least..=most {
            for wave in 0..2 {
                let is_inside = place == Place::Inside;
                // on a face both waves have run the same distance; on the axis the shear wave has an integral of its own
                if !is_inside && wave == 1 || is_inside && on_axis && (n == 0 && wave == 1) != shear
                {
                    continue;
                }
                let row = self.row(&reflection, &legs, n, wave);
                let [as_p, as_s] = plate.rays.distances(m, n, at.z, wave);
                let gamma = roots[0] * as_p + roots[1] * as_s;
                let load = (at.r, ROUNDING_DIGITS);
                let profile = plate.kernel.profile();
                let minus = continued::<T>(profile, gamma - qt, load, shear);
                let plus = potentials::<STEP, T::Complex>(profile, gamma + qt, load, shear);
                let a3 = (minus.a_upper + plus.a_upper) * dq_over_q;
                let a2 = (minus.a_lower + plus.a_lower) * dq_over_q;
                let g3 = (minus.g_upper + plus.g_upper) * dq_over_q;
                let g2 = (minus.g_lower + plus.g_lower) * dq_over_q;
                let [u, w, rr, tt, zz, rz] = row;
                let terms = [
                    (u * g3).im(),
                    (w * a3).im(),
                    (rr * a2).im(),
                    (tt * a2).im(),
                    (zz * a2).im(),
                    (rz * g2).im(),
                ];
                add_fields(terms, at.r, &mut sum);
            }
        }
        sum
    }

    /// What multiplies the potentials of the waves with n legs as P: on a face of those that arrive and leave, except for the
    /// first to arrive, which the half-space has; inside of one wave, P or S.
    #[inline(always)]
    fn row<X: Scalar>(
        &self,
        reflection: &Reflection<X>,
        legs: &Legs<X>,
        n: usize,
        wave: usize,
    ) -> [X; 6] {
        let up = !self.m.is_multiple_of(2);
        let mut row = [legs.leaving[n][0].constant(0.0); 6];
        if self.plate.rays.place(self.at.z) == Place::Inside {
            reflection.add(wave, legs.leaving[n][wave], up, &mut row);
            return row;
        }
        for wave in 0..2 {
            if self.m > 1 {
                reflection.add(wave, legs.arriving[n][wave], !up, &mut row);
            }
            reflection.add(wave, legs.leaving[n][wave], up, &mut row);
        }
        row
    }

    #[inline(always)]
    fn fast<T: Real>(&self, u: T, n: usize, wave: usize, sense: f64) -> [T; 8] {
        let Self { plate, at, m, .. } = *self;
        let k = plate.kernel.medium().shear_slowness_squared();
        let one = u.constant(1.0);
        let inverse = one / (u * u + 1.0);
        let p = (one - u) * (one + u) * inverse;
        let x = u * inverse * 2.0;
        let y = (-(x * x) + k).sqrt();
        let over = one / x;
        // dx/x
        let slope = p * inverse * 2.0 * over;
        let reflection = Reflection::fast(k, [x, p, y]);
        let legs = reflection.after(m, [n, n]);
        let row = self.row(&reflection, &legs, n, wave);
        let [as_p, as_s] = plate.rays.distances(m, n, at.z, wave);
        let eta = (p * as_p + y * as_s + sense * at.t) * over;
        let psi = compact::<STEP, T>(plate.kernel.profile(), eta, (at.r, ROUNDING_DIGITS));
        let terms = [
            row[0] * psi.g_upper * slope,
            row[1] * psi.a_upper * slope,
            row[2] * psi.a_lower * slope,
            row[3] * psi.a_lower * slope,
            row[4] * psi.a_lower * slope,
            row[5] * psi.g_lower * slope,
        ];
        let mut sum = [u.constant(0.0); 8];
        add_fields(terms, at.r, &mut sum);
        sum
    }
}

/// The potentials of the step response, also at an argument that has crossed the imaginary axis between the fronts, where
/// Re xi < 0. With x = -xi on the right
///
/// ```text
///            beside the disc             under it
/// A_3(xi)    A_3(x)                      3/4 (1 + x^2 - r^2/2) - A_3(x)
/// A_2(xi)    -A_2(x)                     3/2 x + A_2(x)
/// B_3(xi)/r  1/(pi r^2) - B_3(x)/r       3/4 x + B_3(x)/r
/// B_2(xi)/r  B_2(x)/r                    3/4 - B_2(x)/r
/// ```
///
/// Own derivation: A_3 is harmonic in (r, xi), known on the axis, and the others are its derivatives and integral.
#[inline(always)]
fn continued<T: Real>(
    profile: Profile,
    xi: T::Complex,
    load: (f64, f64),
    on_axis: bool,
) -> Potentials<T::Complex> {
    if on_axis {
        return potentials::<STEP, T::Complex>(profile, xi, load, on_axis);
    }
    let (side, zero, r) = (xi.re(), xi.re().constant(0.0), load.0);
    let x = T::Complex::where_below(side, zero, xi * -1.0, xi);
    let right = potentials::<STEP, T::Complex>(profile, x, load, false);
    let left = if r > profile.radius() {
        Potentials {
            a_lower: right.a_lower * -1.0,
            g_upper: xi.constant(1.0 / (PI * r * r)) - right.g_upper,
            ..right
        }
    } else {
        Potentials {
            a_upper: (x * x + (1.0 - 0.5 * r * r)) * 0.75 - right.a_upper,
            a_lower: x * 1.5 + right.a_lower,
            g_upper: x * 0.75 + right.g_upper,
            g_lower: xi.constant(0.75) - right.g_lower,
        }
    };
    Potentials {
        a_upper: T::Complex::where_below(side, zero, left.a_upper, right.a_upper),
        a_lower: T::Complex::where_below(side, zero, left.a_lower, right.a_lower),
        g_upper: T::Complex::where_below(side, zero, left.g_upper, right.g_upper),
        g_lower: T::Complex::where_below(side, zero, left.g_lower, right.g_lower),
    }
}

struct Nodes<'a> {
    integrand: &'a Integrand<'a>,
    nodes: &'a [f64; NODES],
}

impl WithSimd for Nodes<'_> {
    type Output = Values;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Values {
        let mut values = [[0.0; NODES]; 8];
        for (i, node) in Lanes::registers(simd, self.nodes).enumerate() {
            let found = self.integrand.at(node);
            for (values, found) in values.iter_mut().zip(found) {
                for lane in 0..S::F64_LANES {
                    values[i * S::F64_LANES + lane] = found.get(lane);
                }
            }
        }
        values
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_complex::Complex64;

    /// On both sides of the imaginary axis the potentials are one analytic function: their series about a point on it.
    #[test]
    fn potentials_are_continued_between_the_fronts() {
        for r in [0.0, 0.05, 0.4, 1.7, 4.0, 40.0] {
            let at =
                |xi: Complex64| continued::<f64>(Profile::Hertz, xi, (r, ROUNDING_DIGITS), false);
            let gap = (r - 1.0_f64).abs();
            let centre = Complex64::new(0.0, 0.3 * gap);
            let reach = 0.3 * gap;
            // the mean over a circle is the value in its centre
            let points = 64;
            let mut mean = Potentials::all(Complex64::default());
            for i in 0..points {
                let angle = 2.0 * PI * (f64::from(i) + 0.5) / f64::from(points);
                let own = at(centre + Complex64::from_polar(reach, angle));
                mean = mean.zip(own, |sum, own| sum + own / f64::from(points));
            }
            let centre = centre + Complex64::new(1e-12, 0.0);
            let off = mean.zip(at(centre), |mean, own| (mean - own).norm());
            let size = 1.0 + r;
            for off in [off.a_upper, off.a_lower, off.g_upper, off.g_lower] {
                assert!(off * size < 1e-10, "{r}: {off:.1e}");
            }
        }
    }
}
