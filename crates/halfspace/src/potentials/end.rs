//! One end of a chord: the antiderivative chains E_n and F_n in closed form.
//!
//! Theory: `docs/theory.md` (T13).

use crate::numeric::complex::{logarithm, reciprocal, root_with_circle};
use crate::potentials::Potentials;
use crate::potentials::order::Order;
use num_complex::Complex64;

/// E and F/r of the orders m and m - 1, m the number of integrations in time: the potentials of a point force.
#[inline]
pub(crate) fn end_orders<const N: i32>(zeta: Complex64, r: f64) -> Potentials<Complex64> {
    let m = N;
    let by_end = |end: End| Potentials {
        a_upper: end.e(m),
        a_lower: end.e(m - 1),
        g_upper: end.f(m),
        g_lower: end.f(m - 1),
    };
    let roots = || {
        let rho = End::without_log(zeta, r).rho;
        (rho, reciprocal(rho), reciprocal(rho + zeta))
    };
    match Order::of(N) {
        Order::Impulse => by_end(End::without_log(zeta, r)),
        Order::Step => {
            let (_, inverse, sum) = roots();
            let cube = inverse * inverse * inverse;
            Potentials {
                a_upper: inverse,
                a_lower: zeta * cube,
                g_upper: inverse * sum,
                g_lower: cube,
            }
        }
        Order::StepIntegral => {
            let (rho, inverse, sum) = roots();
            Potentials {
                a_upper: -logarithm(rho + zeta),
                a_lower: inverse,
                g_upper: sum,
                g_lower: inverse * sum,
            }
        }
    }
}

/// One end of a chord: zeta, rho = sqrt(zeta^2 + r^2) with Re rho >= 0, L = log(zeta + rho).
pub(crate) struct End {
    zeta: Complex64,
    rho: Complex64,
    log: Complex64,
    r: f64,
}

impl End {
    /// Re zeta >= 0; on the imaginary axis the limit from the right is taken.
    #[inline]
    pub(crate) fn new(zeta: Complex64, r: f64) -> Self {
        let mut end = Self::without_log(zeta, r);
        let Self { rho, .. } = end;
        end.log = if zeta.re == 0.0 && rho.re != 0.0 {
            Complex64::new(r.ln(), (zeta.im / r).clamp(-1.0, 1.0).asin())
        } else {
            logarithm(zeta + rho)
        };
        end
    }

    /// An end of which only orders up to zero are used, which need no logarithm.
    #[inline]
    fn without_log(zeta: Complex64, r: f64) -> Self {
        let mut rho = root_with_circle(zeta, r);
        if rho.norm_sqr() == 0.0 {
            // a node that rounds to the very front: as near as rounding lets it be
            rho.re = f64::EPSILON.sqrt() * r;
        }
        Self {
            zeta,
            rho,
            log: Complex64::default(),
            r,
        }
    }

    /// E_n(zeta), -2 <= n <= 4.
    #[inline]
    pub(crate) fn e(&self, n: i32) -> Complex64 {
        let Self { zeta, rho, log, r } = *self;
        let r2 = r * r;
        match n {
            -2 => (2.0 * zeta * zeta - r2) / (rho * rho * rho * rho * rho),
            -1 => zeta / (rho * rho * rho),
            0 => 1.0 / rho,
            1 => -log,
            2 => zeta * log - rho,
            3 => 0.75 * zeta * rho + (0.25 * r2 - 0.5 * zeta * zeta) * log,
            4 => {
                let z2 = zeta * zeta;
                zeta * (z2 / 6.0 - 0.25 * r2) * log + (r2 / 9.0 - 11.0 / 36.0 * z2) * rho
            }
            _ => unreachable!("potentials use orders -2 to 4"),
        }
    }

    /// F_n(zeta)/r with F_n = int k^{-n} J1(kr) e^{-k zeta} dk, -2 <= n <= 4; smooth at r = 0.
    #[inline]
    pub(crate) fn f(&self, n: i32) -> Complex64 {
        let Self { zeta, rho, log, r } = *self;
        let mut sum = rho + zeta;
        if sum.norm_sqr() == 0.0 {
            // the very singularity on the axis: any finite value will do
            sum.re = 1e-100;
        }
        match n {
            -2 => 3.0 * zeta / (rho * rho * rho * rho * rho),
            -1 => 1.0 / (rho * rho * rho),
            0 => 1.0 / (rho * sum),
            1 => 1.0 / sum,
            2 => -0.5 * (zeta / sum + log),
            3 => 0.5 * ((rho * sum + zeta * zeta) / (3.0 * sum) + zeta * log - rho),
            4 => {
                let cubic = zeta * (rho * sum + zeta * zeta) / (12.0 * sum);
                0.5 * (0.625 * zeta * rho - cubic + (0.125 * r * r - 0.5 * zeta * zeta) * log)
            }
            _ => unreachable!("potentials use orders -2 to 4"),
        }
    }
}
