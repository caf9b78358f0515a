//! The settings that a table's numbers depend on.

use crate::axis::Axis;
use crate::error::BuildError;
use halfspace::Medium;
use lookup::{Content, Role};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// A grid: which Poisson ratios, which points, which times, how exact.
///
/// Its TOML form is stored in the table and decides the table's id.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Grid {
    /// Poisson ratios, one slice each, ascending, in (-1, 0.5).
    pub poisson_ratios: Vec<f64>,
    /// Poisson ratios that have a slice of their own and take no part in interpolation, ascending.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub exact_ratios: Vec<f64>,
    /// Width of a time cell in r0/c1 at nu = 0.3; in proportion to the Rayleigh slowness elsewhere.
    #[serde(default = "defaults::cell_width")]
    pub cell_width: f64,
    /// The cells end at this multiple of the last arrival at the farthest point; then the tail takes over.
    #[serde(default = "defaults::time_factor")]
    pub time_factor: f64,
    /// Coefficients of a tail.
    #[serde(default = "defaults::tail_terms")]
    pub tail_terms: usize,
    /// Interpolation points along each axis: 2, 4, 6 or 8.
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

/// The ratio in [`low`, `high`] whose coordinate is `wanted`.
fn bisect(mut low: f64, mut high: f64, wanted: f64) -> Result<f64, BuildError> {
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

mod defaults {
    pub(super) fn cell_width() -> f64 {
        0.1
    }
    pub(super) fn time_factor() -> f64 {
        1.5
    }
    pub(super) fn tail_terms() -> usize {
        12
    }
    pub(super) fn stencil_points() -> usize {
        8
    }
    pub(super) fn tolerance() -> f64 {
        1e-8
    }
    pub(super) fn pulse_lengths() -> Vec<f64> {
        crate::verify::PULSE_LENGTHS.to_vec()
    }
    pub(super) fn are_usual(lengths: &[f64]) -> bool {
        lengths == crate::verify::PULSE_LENGTHS
    }
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

    /// Reads a grid from a TOML file.
    ///
    /// # Errors
    /// [`BuildError`] when the file cannot be read, has unknown keys or values outside their ranges.
    pub fn from_file(path: &Path) -> Result<Self, BuildError> {
        let text = std::fs::read_to_string(path).map_err(|source| BuildError::File {
            action: "read",
            path: path.to_owned(),
            source,
        })?;
        let grid: Self = toml::from_str(&text).map_err(|error| BuildError::GridFile {
            path: path.to_owned(),
            detail: error.to_string(),
        })?;
        grid.validate()?;
        Ok(grid)
    }

    /// The grid that a table was made with.
    ///
    /// # Errors
    /// [`BuildError::Settings`] when the table's text is not a grid.
    pub fn of(content: &Content) -> Result<Self, BuildError> {
        toml::from_str(&content.origin.grid).map_err(|error| BuildError::Settings {
            detail: error.message().to_owned(),
        })
    }

    /// The resolved settings as TOML.
    ///
    /// # Errors
    /// [`BuildError::Unwritable`], which no grid causes.
    pub fn to_toml(&self) -> Result<String, BuildError> {
        Ok(toml::to_string(self)?)
    }

    /// Nodes in r and z, with those beyond the largest values served that the stencils there need.
    #[must_use]
    pub fn nodes(&self) -> [Vec<f64>; 2] {
        let beyond = self.stencil_points / 2 - 1;
        [self.r.padded(beyond), self.z.padded(beyond)]
    }

    /// Number of time cells, the same in every slice.
    ///
    /// # Errors
    /// [`BuildError::Domain`], which no grid causes.
    pub fn cells(&self) -> Result<usize, BuildError> {
        let farthest = self.r.end().hypot(self.z.end()) + 1.0;
        let end = self.time_factor * farthest / Medium::new(0.3)?.rayleigh_speed();
        Ok((end / self.cell_width).ceil() as usize)
    }

    /// Poisson ratios of all slices, ascending, with their roles.
    #[must_use]
    pub fn slices(&self) -> Vec<(f64, Role)> {
        let grid = self.poisson_ratios.iter().map(|&nu| (nu, Role::Grid));
        let exact = self.exact_ratios.iter().map(|&nu| (nu, Role::Exact));
        let mut slices: Vec<(f64, Role)> = grid.chain(exact).collect();
        slices.sort_by(|a, b| a.0.total_cmp(&b.0));
        slices
    }

    /// The Poisson ratio in the middle between slices `interval` and the next of [`Self::poisson_ratios`].
    ///
    /// # Errors
    /// [`BuildError::Domain`] for a ratio outside (-1, 0.5).
    pub fn between(&self, interval: usize) -> Result<f64, BuildError> {
        let [low, high] = [
            self.poisson_ratios[interval],
            self.poisson_ratios[interval + 1],
        ];
        let middle = 0.5 * (lookup::ratio_coordinate(low)? + lookup::ratio_coordinate(high)?);
        bisect(low, high, middle)
    }

    /// Checks every setting.
    ///
    /// # Errors
    /// [`BuildError::Setting`] naming the first key outside its range.
    pub fn validate(&self) -> Result<(), BuildError> {
        let setting = |key: &str, value: f64, good: bool, range| {
            if good {
                Ok(())
            } else {
                Err(BuildError::Setting {
                    key: key.to_owned(),
                    value,
                    range,
                })
            }
        };
        let within = |key: &str, x: f64, low: f64, high: f64, range| {
            setting(key, x, x >= low && x <= high, range)
        };
        within("cell_width", self.cell_width, 0.005, 1.0, "[0.005, 1]")?;
        within("time_factor", self.time_factor, 1.1, 10.0, "[1.1, 10]")?;
        within("tail_terms", self.tail_terms as f64, 2.0, 20.0, "[2, 20]")?;
        within("tolerance", self.tolerance, 1e-12, 1e-3, "[1e-12, 1e-3]")?;
        let even = self.stencil_points.is_multiple_of(2) && (2..=8).contains(&self.stencil_points);
        setting(
            "stencil_points",
            self.stencil_points as f64,
            even,
            "{2, 4, 6, 8}",
        )?;
        let lengths = &self.pulse_lengths;
        let none = lengths.is_empty();
        setting("pulse_lengths", f64::NAN, !none, "a list of at least one")?;
        for (i, &length) in lengths.iter().enumerate() {
            within("pulse_lengths", length, 0.5, 1000.0, "[0.5, 1000]")?;
            let ascends = i == 0 || length > lengths[i - 1];
            setting(
                "pulse_lengths",
                length,
                ascends,
                "strictly ascending values",
            )?;
        }
        let first = self.poisson_ratios.first().copied().unwrap_or(f64::NAN);
        setting(
            "poisson_ratios",
            first,
            !self.poisson_ratios.is_empty(),
            "a list of at least one",
        )?;
        for (i, &nu) in self.poisson_ratios.iter().enumerate() {
            within("poisson_ratios", nu, -0.95, 0.495, "[-0.95, 0.495]")?;
            let ascends = i == 0 || nu > self.poisson_ratios[i - 1];
            setting("poisson_ratios", nu, ascends, "strictly ascending values")?;
        }
        for (i, &nu) in self.exact_ratios.iter().enumerate() {
            within("exact_ratios", nu, -0.95, 0.495, "[-0.95, 0.495]")?;
            let ascends = i == 0 || nu > self.exact_ratios[i - 1];
            setting("exact_ratios", nu, ascends, "strictly ascending values")?;
            let new = !self.poisson_ratios.contains(&nu);
            setting("exact_ratios", nu, new, "ratios that poisson_ratios lacks")?;
        }
        for (name, axis) in [("r", &self.r), ("z", &self.z)] {
            within(&format!("{name}.max"), axis.max, 0.25, 100.0, "[0.25, 100]")?;
            within(
                &format!("{name}.spacing"),
                axis.spacing,
                0.005,
                1.0,
                "[0.005, 1]",
            )?;
            for (key, value, low, high, range) in [
                ("focus", axis.focus, 0.0, axis.max, "[0, max]"),
                (
                    "focus_spacing",
                    axis.focus_spacing,
                    0.001,
                    axis.spacing,
                    "[0.001, spacing]",
                ),
                ("growth", axis.growth, 0.01, 1.0, "[0.01, 1]"),
                (
                    "extended_to",
                    axis.extended_to,
                    axis.max,
                    100.0,
                    "[max, 100]",
                ),
            ] {
                if let Some(value) = value {
                    within(&format!("{name}.{key}"), value, low, high, range)?;
                }
            }
            let nodes = axis.nodes().len();
            setting(
                &format!("{name}: number of nodes"),
                nodes as f64,
                (8..=2000).contains(&nodes),
                "[8, 2000]",
            )?;
        }
        Ok(())
    }
}
