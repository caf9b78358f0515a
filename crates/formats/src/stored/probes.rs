//! The probes of a results file.

use super::error::ReadError;
use super::open::{Stored, StoredQuantity};
use crate::results::schema::{ARRIVALS, ERROR_SUFFIX, PLACES, PROBES};

/// The probes of a results file: places and arrivals; traces are read when they are asked for.
#[derive(Debug, Clone)]
pub struct StoredProbes {
    stored: Stored,
    samples: usize,
    /// Distances from the axis in m.
    pub r_m: Vec<f64>,
    /// Depths in m.
    pub z_m: Vec<f64>,
    /// Times of the first P, S and Rayleigh wave in s, one row a probe; infinite for a
    /// Rayleigh wave where there is none (files before version 1.6: of a load that begins at time zero, on the surface).
    pub arrival_s: Vec<[f64; 3]>,
}

impl StoredProbes {
    pub(super) fn new(stored: Stored, time_s: &[f64]) -> Result<Self, ReadError> {
        let path = |name: &str| format!("{PROBES}/{name}");
        let r_m = stored.vector(&path(PLACES[0].0))?;
        let z_m = stored.numbers(&path(PLACES[1].0), &[r_m.len()])?;
        let arrivals = stored.numbers(&path(ARRIVALS.0), &[r_m.len(), 3])?;
        Ok(Self {
            samples: time_s.len(),
            arrival_s: arrivals
                .chunks_exact(3)
                .map(|t| [t[0], t[1], t[2]])
                .collect(),
            r_m,
            z_m,
            stored,
        })
    }

    /// What was stored at each probe over time.
    #[must_use]
    pub fn quantities(&self) -> Vec<StoredQuantity> {
        self.stored
            .quantities(PROBES, &[self.r_m.len(), self.samples])
    }

    /// A quantity over time at a probe, at the times of the results.
    ///
    /// # Errors
    /// [`ReadError`] for a quantity that is not there.
    pub fn trace(&self, quantity: &str, probe: usize) -> Result<Vec<f64>, ReadError> {
        let path = format!("{PROBES}/{quantity}");
        self.stored
            .slab(&path, &[self.r_m.len(), self.samples], probe)
    }

    /// The estimated error of a quantity at a probe, where it is there.
    #[must_use]
    pub fn error(&self, quantity: &str, probe: usize) -> Option<f64> {
        let path = format!("{PROBES}/{quantity}{ERROR_SUFFIX}");
        let errors = self.stored.numbers(&path, &[self.r_m.len()]).ok()?;
        errors.get(probe).copied()
    }
}
