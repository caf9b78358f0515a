//! The echoes of a plate as kernels of their own, in addition to those of the half-space.
//!
//! They are traces like those of the half-space, with no static part, on discs of their own: their waves have come far.
//!
//! Theory: `docs/theory.md` (T68, T69).

use crate::error::ImpactError;
use crate::kernels::{CellPlan, Cells, KernelSource};
use contact::{Echoing, HalfSpace};
use halfspace::{DomainError, Kernel, Medium, Plate, Six};
use std::sync::Arc;

/// A plate whose echoes are summed.
#[derive(Debug, Clone)]
pub(crate) struct PlateEchoes {
    kernel: Arc<Kernel>,
    plate: Echoing,
}

impl PlateEchoes {
    /// Of a block, for fields of a relative tolerance; none without a plate.
    pub(crate) fn of(
        block: &HalfSpace,
        medium: &Medium,
        tolerance: f64,
    ) -> Result<Option<Self>, DomainError> {
        let Some(plate) = block.echoing() else {
            return Ok(None);
        };
        let kernel = KernelSource::for_fields(medium, tolerance)?;
        Ok(Some(Self { kernel, plate }))
    }

    /// The plate in radii of a disc.
    fn over(&self, disc_radius_m: f64) -> Result<Plate, DomainError> {
        let plate = Plate::new(&self.kernel, self.plate.thickness_m / disc_radius_m)?;
        Ok(plate.up_to(self.plate.legs))
    }

    /// Where the waves of a place have come from, see [`image_m`].
    pub(crate) fn image_m(&self, place_m: [f64; 2]) -> [f64; 2] {
        image_m(place_m, self.plate.thickness_m)
    }

    /// The kernels of a disc at a place.
    pub(crate) fn cells(
        &self,
        [r_m, z_m]: [f64; 2],
        disc_radius_m: f64,
        wanted: &CellPlan<'_>,
    ) -> Result<Cells, ImpactError> {
        let domain = |source| ImpactError::OutsideBlock { r_m, z_m, source };
        let plate = self.over(disc_radius_m).map_err(domain)?;
        let [r, z] = [r_m, z_m].map(|x| x / disc_radius_m);
        let static_part = Six::default();
        let trace = wanted.trace(&static_part, |end, wanted| {
            plate.trace_under(r, z, end, wanted)
        });
        let trace = trace.map_err(domain)?;
        Cells::of_trace(trace, static_part, wanted).map_err(domain)
    }
}

/// A place in the half-space as far from the load as the first echo that arrives at a place of a plate.
pub(crate) fn image_m([r_m, z_m]: [f64; 2], thickness_m: f64) -> [f64; 2] {
    [r_m, (2.0 * thickness_m - z_m).max(thickness_m)]
}
