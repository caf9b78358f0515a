//! Grids with names.

use crate::error::BuildError;
use crate::grid::Axis;
use crate::grid::{Grid, bisect, defaults};

/// Names that [`Grid::preset`] knows.
pub const PRESETS: [&str; 3] = ["demo", "standard", "wide"];

/// `count` ratios from `first` to `last` at equal steps of [`lookup::ratio_coordinate`], to three decimals.
fn ratios(first: f64, last: f64, count: usize) -> Result<Vec<f64>, BuildError> {
    let (start, end) = (
        lookup::ratio_coordinate(first)?,
        lookup::ratio_coordinate(last)?,
    );
    (0..count)
        .map(|i| {
            let wanted = start + (end - start) * i as f64 / (count - 1) as f64;
            Ok((1000.0 * bisect(first, last, wanted)?).round() / 1000.0)
        })
        .collect()
}

impl Grid {
    /// One slice at nu = 0.30, r and z to 6 r0: built in seconds.
    #[must_use]
    pub fn demo() -> Self {
        Self {
            poisson_ratios: vec![0.3],
            exact_ratios: Vec::new(),
            cell_width: defaults::cell_width(),
            time_factor: defaults::time_factor(),
            tail_terms: defaults::tail_terms(),
            stencil_points: defaults::stencil_points(),
            tolerance: defaults::tolerance(),
            pulse_lengths: defaults::pulse_lengths(),
            r: Axis::graded(6.0, 0.15, 1.0, 0.04, 0.15),
            z: Axis::graded(6.0, 0.15, 0.0, 0.04, 0.15),
        }
    }

    /// Every Poisson ratio from 0 to 0.45, r and z to 6 r0: minutes.
    ///
    /// # Errors
    /// [`BuildError::Domain`], which no ratio of the preset causes.
    pub fn standard() -> Result<Self, BuildError> {
        Ok(Self {
            poisson_ratios: ratios(0.0, 0.45, 11)?,
            cell_width: 0.125,
            r: Axis::graded(6.0, 0.1, 1.0, 0.025, 0.12),
            z: Axis::graded(6.0, 0.1, 0.0, 0.02, 0.12),
            ..Self::demo()
        })
    }

    /// [`Self::standard`] to 12 r0, with fewer nodes to a length.
    ///
    /// # Errors
    /// As [`Self::standard`].
    pub fn wide() -> Result<Self, BuildError> {
        Ok(Self {
            r: Axis::graded(12.0, 0.15, 1.0, 0.04, 0.12),
            z: Axis::graded(12.0, 0.15, 0.0, 0.03, 0.12),
            ..Self::standard()?
        })
    }

    /// The preset called `name`.
    ///
    /// # Errors
    /// As [`Self::standard`].
    pub fn preset(name: &str) -> Result<Option<Self>, BuildError> {
        Ok(match name {
            "demo" => Some(Self::demo()),
            "standard" => Some(Self::standard()?),
            "wide" => Some(Self::wide()?),
            _ => None,
        })
    }
}
