//! Waves between the free faces of a plate: how they reflect, and which fields they carry.
//!
//! At one wave number a wave is a pair of amplitudes (P, S) of the potentials. Where it has run over m legs between the
//! faces it is a polynomial in e^{-kaH} and e^{-kbH}: its term n has run over n legs as P and over m - n as S.
//!
//! With s = kq all amplitudes depend on q alone:
//!
//! ```text
//! source           d = (-g, -2a)/D                                     D = g^2 - 4ab
//! free face        R = -1/D [[g^2 + 4ab, -4bg], [4ag, -(g^2 + 4ab)]]
//! ```
//!
//! Theory: `docs/theory.md` (T7, T68).

use crate::numeric::scalar::{Complex, Real, Scalar};

/// Most legs that are counted.
pub(crate) const MOST_LEGS: usize = 16;

/// Roots and reflection at one q, with the numbers of a real or complex kind.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reflection<X> {
    /// P to P, S to P, P to S; S to S is the negative of the first.
    coefficients: [X; 3],
    source: [X; 2],
    /// Of P and of S, in the order of the fields: what multiplies the potentials of u, w, rr, tt, zz and rz.
    rows: [[X; 6]; 2],
}

/// Waves after some legs: amplitudes of P and S by the number of legs as P.
pub(crate) type ByLegs<X> = [[X; 2]; MOST_LEGS + 1];

impl<C: Complex> Reflection<C> {
    /// At a complex q; `k` is 1/kappa^2.
    #[inline(always)]
    pub(crate) fn complex(k: f64, q: C, [a, b]: [C; 2]) -> Self {
        let square = q * q;
        let g = square * k + 2.0;
        let (own, both) = (g * g, a * b * 4.0);
        let inverse = (own - both).reciprocal();
        let ratio = (own + both) * inverse;
        Self {
            coefficients: [ratio * -1.0, b * g * inverse * 4.0, a * g * inverse * -4.0],
            source: [g * inverse * -1.0, a * inverse * -2.0],
            rows: [
                [
                    q.constant(-1.0),
                    a * -1.0,
                    square * (k - 2.0) + -2.0,
                    square * (k - 2.0),
                    g,
                    a * 2.0,
                ],
                [
                    b,
                    q.constant(1.0),
                    b * 2.0,
                    q.constant(0.0),
                    b * -2.0,
                    g * -1.0,
                ],
            ],
        }
    }
}

impl<T: Real> Reflection<T> {
    /// At a real slowness x < 1, with p = sqrt(1 - x^2) and y = sqrt(K - x^2).
    ///
    /// The amplitude of S is over i, that of w and rz is over i as well: all numbers are real then.
    #[inline(always)]
    pub(crate) fn fast(k: f64, [x, p, y]: [T; 3]) -> Self {
        let (x2, over) = (x * x, x.constant(1.0) / x);
        let g = x2 * 2.0 - k;
        let (own, both) = (g * g, x2 * p * y * 4.0);
        let inverse = x.constant(1.0) / (own + both);
        let over2 = over * over;
        let zero = x.constant(0.0);
        Self {
            coefficients: [
                (both - own) * inverse,
                y * g * x * inverse * -4.0,
                p * g * x * inverse * -4.0,
            ],
            source: [-(g * x2) * inverse, p * x2 * x * inverse * -2.0],
            rows: [
                [
                    -x.constant(1.0),
                    -(p * over),
                    -(over2 * (k - 2.0) + 2.0),
                    -(over2 * (k - 2.0)),
                    g * over2,
                    p * over * 2.0,
                ],
                [
                    -(y * over),
                    x.constant(1.0),
                    y * over * -2.0,
                    zero,
                    y * over * 2.0,
                    -(g * over2),
                ],
            ],
        }
    }
}

/// Waves on their way between the faces.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Legs<X> {
    /// The wave that arrives at a face, and the one that leaves it.
    pub(crate) arriving: ByLegs<X>,
    pub(crate) leaving: ByLegs<X>,
}

impl<X: Scalar> Reflection<X> {
    /// The waves after m legs; only those that can still become the ones of `wanted` legs as P are right.
    #[inline(always)]
    pub(crate) fn after(&self, m: usize, wanted: [usize; 2]) -> Legs<X> {
        let [pp, sp, ps] = self.coefficients;
        let zero = pp.constant(0.0);
        let mut legs = Legs {
            arriving: [[zero; 2]; MOST_LEGS + 1],
            leaving: [[zero; 2]; MOST_LEGS + 1],
        };
        legs.leaving[0] = self.source;
        let [least, most] = wanted;
        for leg in 1..=m {
            let first = least.saturating_sub(m - leg);
            let last = most.min(leg);
            for n in first..=last {
                let p = if n > 0 { legs.leaving[n - 1][0] } else { zero };
                let s = if n < leg { legs.leaving[n][1] } else { zero };
                legs.arriving[n] = [p, s];
            }
            for n in first..=last {
                let [p, s] = legs.arriving[n];
                legs.leaving[n] = [pp * p + sp * s, ps * p - pp * s];
            }
        }
        legs
    }

    /// Adds the six numbers that multiply the potentials, for an amplitude of P or of S; `turned` for a wave that runs
    /// against z.
    #[inline(always)]
    pub(crate) fn add(&self, wave: usize, amplitude: X, turned: bool, sum: &mut [X; 6]) {
        let row = &self.rows[wave];
        let against = if turned { -1.0 } else { 1.0 };
        sum[0] = sum[0] + row[0] * amplitude;
        sum[1] = sum[1] + row[1] * amplitude * against;
        sum[2] = sum[2] + row[2] * amplitude;
        sum[3] = sum[3] + row[3] * amplitude;
        sum[4] = sum[4] + row[4] * amplitude;
        sum[5] = sum[5] + row[5] * amplitude * against;
    }
}

/// Adds six fields from six products of numbers and potentials, and the magnitudes of those of displacements and stresses.
#[inline(always)]
pub(crate) fn add_fields<T: Real>([u, w, rr, tt, zz, rz]: [T; 6], r: f64, sum: &mut [T; 8]) {
    let hoop = u * 2.0;
    sum[0] = sum[0] + u * r;
    sum[1] = sum[1] + w;
    sum[2] = sum[2] + rr - hoop;
    sum[3] = sum[3] + tt + hoop;
    sum[4] = sum[4] + zz;
    sum[5] = sum[5] + rz * r;
    sum[6] = sum[6] + (u * r).abs() + w.abs();
    sum[7] = sum[7] + rr.abs() + tt.abs() + zz.abs() + (rz * r).abs() + hoop.abs();
}
