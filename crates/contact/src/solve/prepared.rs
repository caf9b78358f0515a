//! The half-space of the latest contact, which contacts with the same Poisson's ratio share.

use crate::waves::cache::Responses;
use crate::waves::punch::PunchWaves;
use crate::waves::response::DiscResponse;
use halfspace::{Deflection, DomainError};
use std::cell::OnceCell;
use std::sync::Arc;

/// Responses of a half-space, taken from a cache once.
///
/// A solver keeps its own: threads that count the references to a shared one together wait for each other.
#[derive(Debug)]
pub(crate) struct Prepared<D> {
    poisson_ratio: f64,
    /// Response of a disc, for the deflection of the settings.
    pub(crate) disc: Arc<D>,
    /// Waves under a punch, once they are needed.
    waves: OnceCell<Arc<PunchWaves>>,
}

impl<D: DiscResponse> Prepared<D> {
    /// The latest one where it is that of the ratio and the deflection, otherwise another in its place.
    ///
    /// # Errors
    /// [`DomainError`] for a Poisson's ratio outside the physics.
    pub(crate) fn of<'l>(
        latest: &'l mut Option<Self>,
        responses: &impl Responses<Disc = D>,
        poisson_ratio: f64,
        deflection: Deflection,
    ) -> Result<&'l Self, DomainError> {
        let same_ratio = |one: &Self| one.poisson_ratio.to_bits() == poisson_ratio.to_bits();
        let is_kept = |one: &Self| same_ratio(one) && one.disc.disc().deflection == deflection;
        let kept = latest.take();
        let one = match kept {
            Some(one) if is_kept(&one) => one,
            other => Self {
                poisson_ratio,
                disc: responses.disc(poisson_ratio, deflection)?,
                waves: other
                    .filter(same_ratio)
                    .map(|one| one.waves)
                    .unwrap_or_default(),
            },
        };
        Ok(latest.insert(one))
    }

    /// The waves under a punch.
    ///
    /// # Errors
    /// [`DomainError`] for a Poisson's ratio outside the physics.
    pub(crate) fn waves(
        &self,
        responses: &impl Responses<Disc = D>,
    ) -> Result<&PunchWaves, DomainError> {
        match self.waves.get() {
            Some(waves) => Ok(waves),
            None => {
                let made = responses.waves(self.poisson_ratio)?;
                Ok(self.waves.get_or_init(|| made))
            }
        }
    }
}
