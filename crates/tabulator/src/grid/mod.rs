//! Settings that determine the numbers of a table: axes (`axis`), ranges (`limits`) and named grids (`presets`).

mod axis;
mod limits;
mod presets;

pub use axis::Axis;
pub(crate) use limits::within;
pub use presets::PRESETS;

use crate::error::BuildError;
use halfspace::Medium;
use lookup::Role;
use serde::{Deserialize, Serialize};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Default lengths of the verification pulses in r0/c1.
pub const PULSE_LENGTHS: [f64; 6] = [1.0, 3.0, 10.0, 20.0, 40.0, 100.0];

/// Grid of a table: Poisson ratios, points, times and accuracy.
///
/// Its TOML form is stored in the table and determines the id of the table.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Grid {
    /// Poisson ratios of the interpolated slices, ascending, in [-0.95, 0.495].
    pub poisson_ratios: Vec<f64>,
    /// Poisson ratios of exact slices, which take no part in interpolation, ascending, in [-0.95, 0.495].
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub exact_ratios: Vec<f64>,
    /// Width of a time cell in r0/c1 at nu = 0.3; at other ratios it is proportional to the Rayleigh slowness.
    #[serde(default = "defaults::cell_width")]
    pub cell_width: f64,
    /// End of the time cells as a multiple of the last arrival at the farthest point; the tail follows.
    #[serde(default = "defaults::time_factor")]
    pub time_factor: f64,
    /// Number of coefficients of a tail, 2 to 20.
    #[serde(default = "defaults::tail_terms")]
    pub tail_terms: usize,
    /// Number of interpolation points along each axis: 2, 4, 6 or 8.
    #[serde(default = "defaults::stencil_points")]
    pub stencil_points: usize,
    /// Tolerance of the exact kernels.
    #[serde(default = "defaults::tolerance")]
    pub tolerance: f64,
    /// Lengths of the verification pulses in r0/c1, ascending.
    #[serde(
        default = "defaults::pulse_lengths",
        skip_serializing_if = "defaults::are_usual"
    )]
    pub pulse_lengths: Vec<f64>,
    /// Radial nodes.
    pub r: Axis,
    /// Depth nodes.
    pub z: Axis,
}

impl Grid {
    /// Reads a grid from a TOML file.
    ///
    /// # Errors
    /// [`BuildError`] if the file cannot be read, has unknown keys, or has values outside their ranges.
    pub fn from_file(path: &Path) -> Result<Self, BuildError> {
        let unreadable = |error| format!("cannot read {}: {error}", path.display());
        let refused = |error| BuildError::refused(Some(path), unreadable(error));
        let text = read(path).map_err(refused)?;
        Self::parse(&text).map_err(|error| error.in_file(path))
    }

    /// Reads a grid from TOML.
    ///
    /// # Errors
    /// [`BuildError::Refused`] for text that is not a grid, with the line, or for a value outside its range.
    pub fn parse(text: &str) -> Result<Self, BuildError> {
        let grid: Self = toml::from_str(text).map_err(|error| {
            let before = error.span().map_or(0, |span| span.start).min(text.len());
            let line = text.as_bytes()[..before].split(|&b| b == b'\n').count();
            let message = error.message().replace('\n', " ");
            let sentence = format!("the settings are not a grid: line {line}: {message}");
            BuildError::refused(None, sentence)
        })?;
        grid.validate()?;
        Ok(grid)
    }

    /// The grid with other Poisson ratios, largest radius, largest depth and multiple of the last arrival, as far as
    /// given.
    #[must_use]
    pub fn with(mut self, nu: Option<Vec<f64>>, most: [Option<f64>; 3]) -> Self {
        if let Some(mut ratios) = nu {
            ratios.sort_by(f64::total_cmp);
            ratios.dedup();
            self.poisson_ratios = ratios;
            self.exact_ratios.clear();
        }
        let own = [&mut self.r.max, &mut self.z.max, &mut self.time_factor];
        for (own, most) in own.into_iter().zip(most) {
            *own = most.unwrap_or(*own);
        }
        self
    }

    /// All settings, with defaults, as TOML.
    ///
    /// # Errors
    /// [`BuildError::Unwritable`], which does not occur for a grid.
    pub fn to_toml(&self) -> Result<String, BuildError> {
        Ok(toml::to_string(self)?)
    }

    /// Nodes in r and z, including those beyond the largest values that the stencils there need.
    pub fn nodes(&self) -> [Vec<f64>; 2] {
        let beyond = self.stencil_points / 2 - 1;
        [self.r.padded(beyond), self.z.padded(beyond)]
    }

    /// Number of time cells, the same in every slice.
    ///
    /// # Errors
    /// [`BuildError::Domain`], which does not occur for a valid grid.
    pub fn cells(&self) -> Result<usize, BuildError> {
        let farthest = self.r.end().hypot(self.z.end()) + 1.0;
        let end = self.time_factor * farthest / Medium::new(0.3)?.rayleigh_speed();
        Ok((end / self.cell_width).ceil() as usize)
    }

    /// Poisson ratios of all slices, ascending, with their roles.
    pub fn slices(&self) -> Vec<(f64, Role)> {
        let grid = self.poisson_ratios.iter().map(|&nu| (nu, Role::Grid));
        let exact = self.exact_ratios.iter().map(|&nu| (nu, Role::Exact));
        let mut slices: Vec<(f64, Role)> = grid.chain(exact).collect();
        slices.sort_by(|a, b| a.0.total_cmp(&b.0));
        slices
    }

    /// The Poisson ratios midway between neighbouring interpolated slices.
    ///
    /// # Errors
    /// [`BuildError::Domain`] for a ratio outside (-1, 0.5).
    pub(crate) fn between(&self) -> Result<Vec<f64>, BuildError> {
        let middle = |pair: &[f64]| {
            let [low, high] = [pair[0], pair[1]];
            let ends = lookup::ratio_coordinate(low)? + lookup::ratio_coordinate(high)?;
            bisect(low, high, 0.5 * ends)
        };
        self.poisson_ratios.windows(2).map(middle).collect()
    }
}

/// The text of a regular file; a pipe would block, and a device may never end.
fn read(path: &Path) -> io::Result<String> {
    /// Largest size in bytes.
    const MOST_FILE_BYTES: u64 = 1 << 20;
    if !std::fs::metadata(path)?.is_file() {
        return Err(io::Error::other("it is not a regular file"));
    }
    let mut text = String::new();
    File::open(path)?
        .take(MOST_FILE_BYTES + 1)
        .read_to_string(&mut text)?;
    if text.len() as u64 > MOST_FILE_BYTES {
        return Err(io::Error::other("it has more than 1 MB"));
    }
    Ok(text)
}

/// The ratio in [`low`, `high`] whose coordinate is `wanted`.
pub(crate) fn bisect(mut low: f64, mut high: f64, wanted: f64) -> Result<f64, BuildError> {
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if lookup::ratio_coordinate(middle)? < wanted {
            low = middle;
        } else {
            high = middle;
        }
    }
    Ok(high)
}

/// Defaults of the optional settings of a grid file.
pub(crate) mod defaults {
    pub(crate) fn cell_width() -> f64 {
        0.1
    }
    pub(crate) fn time_factor() -> f64 {
        1.5
    }
    pub(crate) fn tail_terms() -> usize {
        12
    }
    pub(crate) fn stencil_points() -> usize {
        8
    }
    pub(crate) fn tolerance() -> f64 {
        1e-8
    }
    pub(crate) fn pulse_lengths() -> Vec<f64> {
        super::PULSE_LENGTHS.to_vec()
    }
    pub(crate) fn are_usual(lengths: &[f64]) -> bool {
        lengths == super::PULSE_LENGTHS
    }
}
