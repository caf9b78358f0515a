//! Slownesses between one and 1/kappa: longitudinal waves bound to the surface, shear waves that travel.

use crate::fronts::{self, Point};
use crate::kernel::{Kernel, Sum, real_fields};
use crate::panels::Landscape;
use crate::potential::{Potentials, potentials};
use crate::spectrum::{self, Wave};
use num_complex::Complex64;

/// One slowness with the vertical slownesses that belong to it.
#[derive(Debug, Clone, Copy)]
struct Slowness {
    x: f64,
    p_abs: f64,
    y: f64,
}

impl Kernel {
    /// Adds both senses of one wave over 1 < x < 1/kappa.
    pub(crate) fn slow<const ORDER: i32>(&self, at: Point, wave: Wave, sum: &mut Sum) {
        let span = (self.k - 1.0).sqrt();
        let mut landscape = Landscape::new(&self.fixed.slow);
        fronts::add_slow(&mut landscape, at, self.profile().radius(), self.k, wave);
        for interval in landscape.intervals() {
            landscape.visit(interval, self.digits(), &mut |q, weight| {
                let inverse = 1.0 / (1.0 + q * q);
                let p_abs = span * 2.0 * q * inverse;
                let y = span * (1.0 - q) * (1.0 + q) * inverse;
                let x = (1.0 + p_abs * p_abs).sqrt();
                let psi = self.both_senses::<ORDER>(at, wave, Slowness { x, p_abs, y });
                let amplitudes = spectrum::slow(wave, self.k, x, p_abs, y);
                // dx = p^ dp^/x, dp^ = 2 y/(1 + q^2) dq
                let jacobian = p_abs * 2.0 * y * inverse / x;
                sum.add(weight * jacobian, real_fields(&amplitudes, &psi, at.r));
            });
        }
    }

    /// Psi(xi-) + Psi(xi+), or i x times their difference for the time integral.
    #[inline]
    fn both_senses<const ORDER: i32>(
        &self,
        at: Point,
        wave: Wave,
        Slowness { x, p_abs, y }: Slowness,
    ) -> Potentials<Complex64> {
        match wave {
            Wave::P => {
                // xi+ is the conjugate of xi-, and so are the potentials
                let xi = Complex64::new(at.z * p_abs / x, -at.t / x);
                let psi = potentials::<ORDER>(self.profile(), xi, at.r);
                psi.map(|v| (2.0 * if ORDER == 0 { v.re } else { x * v.im }).into())
            }
            Wave::S => {
                let outgoing = Complex64::new(0.0, (at.z * y - at.t) / x);
                let image = Complex64::new(0.0, (at.z * y + at.t) / x);
                let minus = potentials::<ORDER>(self.profile(), outgoing, at.r);
                let plus = potentials::<ORDER>(self.profile(), image, at.r);
                let fold = |m: Complex64, p: Complex64| {
                    if ORDER == 0 {
                        m + p
                    } else {
                        Complex64::new(x * (m.im - p.im), x * (p.re - m.re))
                    }
                };
                Potentials {
                    a_upper: fold(minus.a_upper, plus.a_upper),
                    a_lower: fold(minus.a_lower, plus.a_lower),
                    g_upper: fold(minus.g_upper, plus.g_upper),
                    g_lower: fold(minus.g_lower, plus.g_lower),
                }
            }
        }
    }
}
