//! Jackson and Green's fit of finite elements: force and residual depth of a contact that yields.

use std::f64::consts::PI;

/// Jackson and Green's fit of finite elements (2005), with the residual depth of Jackson, Green and Marghitu (2010).
///
/// ```text
/// w = u/w_c,  p/p_c = exp(-w^(5/12)/4) w^1.5 + (4 H/C) (1 - exp(-w^(5/9)/25)) w      w > 1.9
/// H = 2.84 (1 - exp(-0.82 (a/R)^-0.7)),   a/R = (pi C e_y/2) sqrt(w (w/1.9)^B)
/// w_r = 1.02 w (1 - ((w + 5.9)/6.9)^-0.54)
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fit {
    /// w_c in collision units.
    pub(crate) critical: f64,
    /// C = 1.295 exp(0.736 nu).
    pub(crate) shape: f64,
    /// e_y = S_y/E*.
    pub(crate) strain: f64,
    /// B of the contact's area, R u (w/1.9)^B.
    pub(crate) spread: f64,
    /// ln(pi C e_y/2)
    edge: f64,
}

/// Indentation over the critical one from which the fit leaves Hertz's law.
pub(crate) const FITTED: f64 = 1.9;
const LOG_FITTED: f64 = 0.641_853_886_172_394_7;

impl Fit {
    pub(crate) fn new(critical: f64, shape: f64, strain: f64) -> Self {
        Self {
            critical,
            shape,
            strain,
            spread: 0.14 * (23.0 * strain).exp(),
            edge: (0.5 * PI * shape * strain).ln(),
        }
    }

    /// Force and its slope at an indentation beyond 1.9 w_c.
    pub(crate) fn force(&self, depth: f64) -> [f64; 2] {
        let w = depth / self.critical;
        let log = w.ln();
        let spread = self.spread;
        let area = (1.0 + spread) * log - spread * LOG_FITTED;
        let by_radius = (-0.7 * (self.edge + 0.5 * area)).exp();
        let soft = (-0.82 * by_radius).exp();
        let hardness = 2.84 * (1.0 - soft);
        let hardening = -2.84 * soft * 0.82 * 0.7 * by_radius * 0.5 * (1.0 + spread) / w;
        let [slow, fast] = [5.0 / 12.0, 5.0 / 9.0].map(|power: f64| (power * log).exp());
        let (elastic, flowing) = ((-0.25 * slow).exp(), (-0.04 * fast).exp());
        let hertz = w * w.sqrt();
        let per = 4.0 / self.shape;
        let force = elastic * hertz + per * hardness * (1.0 - flowing) * w;
        let slope = elastic * w.sqrt() * (1.5 - 5.0 / 48.0 * slow)
            + per * hardness * (1.0 - flowing + fast * flowing / 45.0)
            + per * hardening * (1.0 - flowing) * w;
        let unit = self.critical.sqrt();
        [force * unit * self.critical, slope * unit]
    }

    /// Indentation from which on nothing is given back: the depth that is left reaches it where 1.02 (1 - x^-0.54) is one.
    pub(crate) fn deepest(&self) -> f64 {
        self.critical * (6.9 * (1.0_f64 - 1.0 / 1.02).powf(-1.0 / 0.54) - 5.9)
    }

    /// Depth that is left after an indentation.
    pub(crate) fn left(&self, depth: f64) -> f64 {
        let w = depth / self.critical;
        let rest = 1.0 - ((w + 5.9) / 6.9).powf(-0.54);
        self.critical * (1.02 * w * rest).max(0.0)
    }
}
