//! Content of a kernel table, in memory.

use crate::schema;
use std::ops::Range;

/// Number of fields.
pub(crate) const FIELDS: usize = 6;

/// The whole content of a table. Arrays are row-major, in the order of the dimensions given.
#[derive(Debug, Clone, PartialEq)]
pub struct Content {
    /// Settings and program that made the table.
    pub origin: Origin,
    /// Radial nodes in r0, ascending from 0; a few lie beyond `r_max`, for the stencils near it.
    pub r: Vec<f64>,
    /// Depth nodes in r0, ascending from 0; a few lie beyond `z_max`.
    pub z: Vec<f64>,
    /// Largest distance from the axis that can be looked up, in r0; one of the nodes.
    pub r_max: f64,
    /// Largest depth that can be looked up, in r0; one of the nodes.
    pub z_max: f64,
    /// Width of a time cell in r0/c1 at nu = 0.3; the width of a slice is proportional to its Rayleigh slowness,
    /// see [`crate::cell_scale`].
    pub cell_width: f64,
    /// Interpolation points along each axis.
    pub stencil_points: usize,
    /// Lengths of the verification pulses in r0/c1, ascending.
    pub pulse_lengths: Vec<f64>,
    /// One entry for each Poisson ratio, ascending.
    pub slices: Vec<Slice>,
    /// Radii of the probes between slices in r0.
    pub between_r: Vec<f64>,
    /// Depths of the probes between slices in r0.
    pub between_z: Vec<f64>,
    /// One entry for each interval between adjacent slices, ascending; may be empty.
    pub between: Vec<Between>,
}

/// Settings and program that made a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Origin {
    /// The grid with all defaults as TOML: every setting that the numbers depend on.
    pub grid: String,
    /// Version of the format of the file that was read; [`crate::schema::FORMAT_VERSION_VALUE`] for a new table.
    pub format_version: String,
    /// Version of the program.
    pub software_version: String,
    /// Revision of the numbers that the program computes; 1 for files without one.
    pub numbers_revision: u64,
    /// Git revision of the program, or `unknown`.
    pub git_revision: String,
    /// Creation time in seconds since 1970; not part of the content hash.
    pub created_unix_s: u64,
    /// Requested tolerance of the exact kernels.
    pub accuracy_asked: f64,
    /// 99 % quantile of the relative error of the worst field, for each pulse length; see [`Content::accuracy`].
    pub accuracy_reached: Vec<f64>,
}

/// Role of a slice in lookups.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Serves its own ratio and takes part in interpolation between ratios.
    Grid,
    /// Serves its own ratio only.
    Exact,
}

impl Role {
    /// Name in the file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Grid => "grid",
            Self::Exact => "exact",
        }
    }

    #[cfg(feature = "hdf5")]
    pub(crate) fn from_name(name: &str) -> Option<Self> {
        [Self::Grid, Self::Exact]
            .into_iter()
            .find(|role| role.name() == name)
    }
}

/// The kernels of one Poisson ratio.
#[derive(Debug, Clone, PartialEq)]
pub struct Slice {
    /// Poisson's ratio.
    pub poisson_ratio: f64,
    /// Role of the slice in lookups.
    pub role: Role,
    /// Number of time cells; the first starts at 0.
    pub cells: usize,
    /// Averages of R over the cells, shape (r, z, field, time).
    pub remainder: Vec<f32>,
    /// First moments (1/width^2) int R (t - t_mid) dt of the cells, shape (r, z, field, time).
    pub moment: Vec<f32>,
    /// Second moments (1/width^3) int R ((t - t_mid)^2 - width^2/12) dt of the cells, shape (r, z, field, time).
    pub curvature: Vec<f32>,
    /// Coefficients of the tail, shape (r, z, field, term); see `docs/theory.md` (T21).
    pub tail: Vec<f32>,
    /// Errors measured between the nodes of the grid.
    pub verification: Verification,
}

/// Errors measured midway between two slices.
#[derive(Debug, Clone, PartialEq)]
pub struct Between {
    /// Poisson's ratio of the probes.
    pub poisson_ratio: f64,
    /// Errors at [`Content::between_r`] and [`Content::between_z`], shape (r, z, pulse, field).
    pub verification: Verification,
}

/// Exact and looked-up responses at probes, shape (r, z, pulse, field).
///
/// The probes of a slice are the centres of the meshes of the grid.
///
/// The force is sin^4(pi t/T) on [0, T] with unit peak.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Verification {
    /// Peak in time of the exact response, with its sign.
    pub direct: Vec<f32>,
    /// Looked-up response at the time of that peak.
    pub looked_up: Vec<f32>,
    /// Largest difference in time between the two.
    pub error: Vec<f32>,
}

impl Slice {
    /// The numbers at the nodes, with the names of their datasets.
    pub fn lists(&self) -> [(&'static str, &[f32]); 4] {
        [
            (schema::REMAINDER, &self.remainder),
            (schema::MOMENT, &self.moment),
            (schema::CURVATURE, &self.curvature),
            (schema::TAIL, &self.tail),
        ]
    }

    /// Number of coefficients of a tail, given the number of nodes of the grid.
    pub fn tail_terms(&self, nodes: usize) -> usize {
        self.tail.len() / (nodes * FIELDS).max(1)
    }
}

impl Verification {
    /// The numbers with the names of their datasets.
    pub fn lists(&self) -> [(&'static str, &[f32]); 3] {
        [
            (schema::PROBE_DIRECT, &self.direct),
            (schema::PROBE_LOOKED_UP, &self.looked_up),
            (schema::PROBE_ERROR, &self.error),
        ]
    }

    /// Appends a range of the entries of another verification.
    pub fn extend(&mut self, other: &Self, entries: Range<usize>) {
        let from = entries.clone();
        self.direct.extend_from_slice(&other.direct[from.clone()]);
        self.looked_up.extend_from_slice(&other.looked_up[from]);
        self.error.extend_from_slice(&other.error[entries]);
    }
}

impl Content {
    /// Radii and depths of the probes of a slice: the centres of all meshes up to `r_max` and `z_max`.
    pub fn probes(&self) -> [Vec<f64>; 2] {
        [centres(&self.r, self.r_max), centres(&self.z, self.z_max)]
    }
}

/// Centres of the intervals between `nodes` up to `max`.
pub fn centres(nodes: &[f64], max: f64) -> Vec<f64> {
    nodes
        .windows(2)
        .filter(|pair| pair[1] <= max)
        .map(|pair| 0.5 * (pair[0] + pair[1]))
        .collect()
}
