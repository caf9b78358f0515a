//! An impact on a disc of fixed radius, in dimensionless groups, and its marches.
//!
//! In reading order: `implicit` is the march, with the half-space's memory in `weights`, the striker's motion in `striker`,
//! the force next to the ends of contact in `edge`, the end itself and the work in `separation`, and the work that it may
//! take in `bounds`; `explicit` is the paper's scheme; `measured` has the results of the samples, `refine` chooses the step,
//! `radiated` has the energy of the waves; `stability` tells whether there is a contact at all.

pub(crate) mod bounds;
pub(crate) mod edge;
pub(crate) mod explicit;
pub(crate) mod implicit;
pub(crate) mod measured;
pub(crate) mod radiated;
pub(crate) mod refine;
pub(crate) mod separation;
pub(crate) mod stability;
pub(crate) mod striker;
pub(crate) mod weights;

use crate::settings::StaticShare;
use crate::waves::response::DiscResponse;
use halfspace::SurfaceResponse;

/// Coupling up to which the deflection of the centre takes more energy than it gives, for any Poisson's ratio
/// between 0 and 0.45: its compliance at some frequencies is real and down to -0.14 of the static one.
pub const CENTRE_COUPLING: f64 = 5.0;

/// An impact on a disc of fixed radius, in dimensionless groups; the response is exact, or tabulated where that is said.
#[derive(Debug, Clone)]
pub struct FixedDisc<'a, R = SurfaceResponse> {
    /// Step response of the deflection of the disc.
    pub response: &'a R,
    /// Static deflection of the disc under Hertz's largest force over Hertz's largest approach.
    pub coupling: f64,
    /// r0/c1 in collision times.
    pub wave_time: f64,
    /// Part of the static deflection that enters.
    pub share: StaticShare,
}

impl<R: DiscResponse> FixedDisc<'_, R> {
    /// Memory of the half-space in collision times.
    pub fn memory(&self) -> f64 {
        self.response.disc().memory * self.wave_time
    }

    /// Coupling of the static spring in the contact law: none for the dynamic share.
    pub(crate) fn static_coupling(&self) -> f64 {
        self.coupling * self.share.factor()
    }
}
