//! Hertz's closed form (45)-(47): no waves, restitution 1.
//!
//! In collision units everything is a constant.
//!
//! Theory: `docs/theory.md` (T38).

/// Hertz's contact time in units of alpha/V0: 2 int_0^1 dx/sqrt(1 - x^(5/2)), the 2.94 of (47).
///
/// ```text
/// (4/5) sqrt(pi) Gamma(2/5)/Gamma(9/10)
/// ```
pub const CONTACT_TIME: f64 = 2.943_275_184_324_705;

/// Momentum given to the striker: its velocity changes from 1 to -1.
pub const IMPULSE: f64 = 1.6;
