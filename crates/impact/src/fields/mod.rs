//! Fields of an excitation at points of the half-space.
//!
//! `probes` has those at the probes of a scene and on its section, `peaks` their largest values over time; `faces` warns of the faces of a block that a half-space does
//! not have.

pub(crate) mod faces;
pub(crate) mod peaks;
pub(crate) mod probes;
pub(crate) mod sensors;

use crate::convolution::{Convolution, Past, Trace};
use crate::error::ImpactError;
use crate::excitation::Excitation;
use crate::grid::{Grid, Wanted};
use crate::kernels::KernelSource;
use halfspace::{DomainError, Field, Six};
use std::ops::Index;

/// Fields of an excitation, asked for point by point.
#[derive(Debug, Clone)]
pub struct Fields<'a> {
    excitation: &'a Excitation,
    source: KernelSource,
    /// Relative tolerance that the samples in time are as dense as.
    tolerance: f64,
    duration_s: Option<f64>,
}

impl Excitation {
    /// The fields by kernels computed to a relative tolerance in [1e-14, 0.1].
    ///
    /// # Errors
    /// [`DomainError`] for a tolerance outside its range.
    pub fn fields(&self, tolerance: f64) -> Result<Fields<'_>, DomainError> {
        let source = KernelSource::direct(self.medium(), tolerance)?;
        Ok(self.fields_from(source))
    }

    /// The six fields at one instant under a contact, in m and Pa: an integral over the force's past to about `tolerance`
    /// of their peaks, without cells, discs or tables; none for a record, and none with attenuation.
    ///
    /// Slow compared with [`Fields::at`]: about a millisecond per time, but exact where that is an approximation.
    /// Fields are in the order of [`halfspace::FIELDS`]; stresses are positive in tension.
    ///
    /// # Errors
    /// [`ImpactError`] for a point outside the half-space.
    pub fn instant(
        &self,
        place_m: [f64; 2],
        time_s: f64,
        tolerance: f64,
    ) -> Result<Option<Six>, ImpactError> {
        if self.record().is_some() || self.attenuation.is_some() {
            return Ok(None);
        }
        Ok(Some(Past::new(self, tolerance)?.at(place_m, time_s)?))
    }

    /// The fields by kernels of a source, such as a table.
    pub fn fields_from(&self, source: KernelSource) -> Fields<'_> {
        Fields {
            excitation: self,
            source,
            tolerance: 1e-4,
            duration_s: None,
        }
    }
}

impl Fields<'_> {
    /// With samples until a time in s; otherwise until the last wave has passed a point.
    #[must_use]
    pub fn until(mut self, duration_s: f64) -> Self {
        self.duration_s = Some(duration_s);
        self
    }

    /// With samples in time as dense as a relative tolerance needs, 1e-4 otherwise.
    #[must_use]
    pub fn to_tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// The six fields over time at the distance `r_m` from the axis and the depth `z_m`.
    ///
    /// # Errors
    /// [`ImpactError`] for a point outside the half-space or the table.
    pub fn at(&self, r_m: f64, z_m: f64) -> Result<FieldHistory, ImpactError> {
        let wanted = Wanted {
            tolerance: self.tolerance,
            step_s: None,
            duration_s: self.duration_s,
            frames: None,
            farthest_m: Some(r_m.hypot(z_m)),
            plate_s: None,
            low_pass_hz: None,
        };
        let grid = Grid::new(&wanted, self.excitation, Some(&self.source))?;
        let time_s: Vec<f64> = grid.times_s().collect();
        let all: Vec<usize> = (0..time_s.len()).collect();
        let convolution = Convolution::new(&self.source, &grid, &all, (&[], None), &|| {})?;
        Ok(FieldHistory {
            traces: convolution.at(r_m, z_m)?,
            time_s,
            arrival_s: self.excitation.arrivals_s([r_m, z_m]),
        })
    }
}

/// The fields over time at one point.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldHistory {
    /// Times in s.
    pub time_s: Vec<f64>,
    /// First P, S and Rayleigh arrival in s; infinite for a Rayleigh wave where there is none.
    pub arrival_s: [f64; 3],
    traces: Vec<Trace>,
}

impl Index<Field> for FieldHistory {
    type Output = Trace;

    fn index(&self, field: Field) -> &Trace {
        &self.traces[field.index()]
    }
}
