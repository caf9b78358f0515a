//! Contact laws, one file each: closed forms, and the branches of a contact that yields.
//!
//! In reading order: [`radiation`], [`quasi_static`] the same on a disc with a static spring of its own, [`area_dashpot`] to
//! the next orders; `cut` and `fit`, the laws of flow, `branch` a law over the radius of contact, `yielding` the branches that
//! follow each other.

pub mod area_dashpot;
pub(crate) mod branch;
pub(crate) mod cut;
pub(crate) mod fit;
pub mod quasi_static;
pub mod radiation;
#[cfg(test)]
pub(crate) mod reference;
pub(crate) mod yielding;

/// Hertz's closed form (45)-(47): no waves, restitution 1.
///
/// In collision units everything is a constant.
///
/// Theory: `docs/theory.md` (T38).
pub mod hertz {
    /// Hertz's contact time in units of alpha/V0: 2 int_0^1 dx/sqrt(1 - x^(5/2)), the 2.94 of (47).
    ///
    /// ```text
    /// (4/5) sqrt(pi) Gamma(2/5)/Gamma(9/10)
    /// ```
    pub const CONTACT_TIME: f64 = 2.943_275_184_324_705;
}
