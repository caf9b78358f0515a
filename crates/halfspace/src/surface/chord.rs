//! Chord functions of the two deflections, and their overlap with a measure given by its moments.
//!
//! Theory: `docs/theory.md` (T27).

use super::Deflection;

/// Powers of 1/x whose integrals over slowness are needed for the chord functions.
pub(super) const POWERS: [i32; 5] = [-1, 0, 2, 3, 5];

/// int x^{-k} dmu for the k of [`POWERS`].
pub(super) type Moments = [f64; POWERS.len()];

/// The chord function phi(eta) = sum a_k eta^k of a deflection on [0, support].
#[derive(Debug, Clone, Copy)]
pub(super) struct Chord {
    pub(super) support: f64,
    /// Static deflection under unit force over 1 - nu.
    pub(super) static_factor: f64,
    /// a_k for the k of [`POWERS`].
    pub(super) coefficients: Moments,
}

impl Chord {
    pub(super) fn new(deflection: Deflection) -> Self {
        match deflection {
            Deflection::Centre => Self {
                support: 1.0,
                static_factor: 3.0 / 8.0,
                coefficients: [0.0, 1.0, -1.0, 0.0, 0.0],
            },
            // (2 - eta)^3 (eta^2 + 6 eta + 4)/32, the chord function convolved with itself
            Deflection::Mean => Self {
                support: 2.0,
                static_factor: 3.0 / 10.0,
                coefficients: [0.0, 1.0, -5.0 / 4.0, 5.0 / 8.0, -1.0 / 32.0],
            },
        }
    }

    /// phi(eta) for eta >= 0; phi(0) = 1, zero beyond the support.
    pub(super) fn value(&self, eta: f64) -> f64 {
        if eta < self.support {
            self.overlap(eta, &[1.0; POWERS.len()])
        } else {
            0.0
        }
    }

    /// int_0^eta phi for eta >= 0.
    pub(super) fn integral(&self, eta: f64) -> f64 {
        let e = eta.min(self.support);
        self.terms(e)
            .map(|(k, term)| term * e / (f64::from(k) + 1.0))
            .sum()
    }

    /// int phi(t/x) dmu from the moments above x = t/support.
    pub(super) fn overlap(&self, t: f64, above: &Moments) -> f64 {
        self.terms(t)
            .zip(&above[1..])
            .map(|((_, term), m)| term * m)
            .sum()
    }

    /// int_0^t of [`Self::overlap`].
    pub(super) fn overlap_integral(&self, t: f64, total: &Moments, above: &Moments) -> f64 {
        let passed = self.integral(self.support) * (total[0] - above[0]);
        let passing = self.terms(t).zip(&above[1..]);
        passed
            + passing
                .map(|((k, term), m)| term * t / (f64::from(k) + 1.0) * m)
                .sum::<f64>()
    }

    /// The terms (k, a_k eta^k), k >= 0.
    pub(super) fn terms(&self, eta: f64) -> impl Iterator<Item = (i32, f64)> + '_ {
        let terms = POWERS.into_iter().zip(self.coefficients).skip(1);
        terms.map(move |(k, a)| (k, a * eta.powi(k)))
    }
}
