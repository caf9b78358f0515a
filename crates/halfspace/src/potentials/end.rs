//! One end of a chord: the antiderivative chains E_n and F_n in closed form.
//!
//! Theory: `docs/theory.md` (T13).

use crate::numeric::scalar::{Complex, Scalar};

/// One end of a chord: zeta with Re zeta >= 0, rho = sqrt(zeta^2 + r^2) with Re rho >= 0, zeta + rho and its logarithm.
pub(crate) struct End<C> {
    zeta: C,
    rho: C,
    sum: C,
    log: C,
    r: f64,
}

impl<C: Complex> End<C> {
    #[inline(always)]
    pub(crate) fn new(zeta: C, rho: C, sum: C, log: C, r: f64) -> Self {
        Self {
            zeta,
            rho,
            sum,
            log,
            r,
        }
    }

    /// E_n(zeta), -2 <= n <= 4.
    #[inline(always)]
    pub(crate) fn e(&self, n: i32) -> C {
        let Self { zeta, rho, log, .. } = *self;
        let r2 = self.r * self.r;
        let square = zeta * zeta;
        let inverse = rho.reciprocal();
        let cube = inverse * inverse * inverse;
        match n {
            -2 => (square * 2.0 - r2) * cube * inverse * inverse,
            -1 => zeta * cube,
            0 => inverse,
            1 => log * -1.0,
            2 => zeta * log - rho,
            3 => zeta * rho * 0.75 + (square * -0.5 + 0.25 * r2) * log,
            4 => {
                let of_log = zeta * (square * (1.0 / 6.0) - 0.25 * r2) * log;
                of_log - (square * (11.0 / 36.0) - r2 / 9.0) * rho
            }
            _ => unreachable!("potentials use orders -2 to 4"),
        }
    }

    /// F_n(zeta)/r with F_n = int k^{-n} J1(kr) e^{-k zeta} dk, -2 <= n <= 4; smooth at r = 0.
    #[inline(always)]
    pub(crate) fn f(&self, n: i32) -> C {
        let Self {
            zeta,
            rho,
            sum,
            log,
            r,
        } = *self;
        let square = zeta * zeta;
        let inverse = rho.reciprocal();
        let cube = inverse * inverse * inverse;
        let least = sum.re().constant(f64::MIN_POSITIVE);
        // at the singularity itself any finite value may be used
        let held = C::where_below(sum.norm_sqr(), least, sum.constant(1e-100), sum);
        let over = held.reciprocal();
        match n {
            -2 => zeta * cube * inverse * inverse * 3.0,
            -1 => cube,
            0 => inverse * over,
            1 => over,
            2 => (zeta * over + log) * -0.5,
            3 => ((rho * sum + square) * over * (1.0 / 3.0) + zeta * log - rho) * 0.5,
            4 => {
                let cubic = zeta * (rho * sum + square) * over * (1.0 / 12.0);
                (zeta * rho * 0.625 - cubic - (square * 0.5 - 0.125 * r * r) * log) * 0.5
            }
            _ => unreachable!("potentials use orders -2 to 4"),
        }
    }
}
