//! What a kernel table consists of, before it is a file and after it was read.

use crate::schema;
use std::ops::Range;

/// Number of fields.
pub(crate) const FIELDS: usize = 6;

/// The whole content of a table. Arrays are row-major in the order of the dimensions named.
#[derive(Debug, Clone, PartialEq)]
pub struct Content {
    /// Where the numbers come from.
    pub origin: Origin,
    /// Radial nodes from 0, ascending, in r0, a few of them beyond `r_max` for the stencils there.
    pub r: Vec<f64>,
    /// Depth nodes from 0, ascending, in r0, a few of them beyond `z_max`.
    pub z: Vec<f64>,
    /// Largest radius served, a node.
    pub r_max: f64,
    /// Largest depth served, a node.
    pub z_max: f64,
    /// Width of a time cell in r0/c1 at nu = 0.3; that of a slice is in proportion to its Rayleigh slowness,
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

/// Who made a table, with which settings.
#[derive(Debug, Clone, PartialEq)]
pub struct Origin {
    /// The resolved grid as TOML: all settings that the numbers depend on.
    pub grid: String,
    /// Version of the format of the file that was read; [`crate::schema::FORMAT_VERSION_VALUE`] for a new table.
    pub format_version: String,
    /// Version of the program.
    pub software_version: String,
    /// Revision of the numbers that the program computes; 1 where a file does not say.
    pub numbers_revision: u64,
    /// Git revision of the program, or `unknown`.
    pub git_revision: String,
    /// Creation time in seconds since 1970; not part of the content hash.
    pub created_unix_s: u64,
    /// Tolerance asked of the exact kernels.
    pub accuracy_asked: f64,
    /// 99 % quantile of the relative error of the worst field, for each pulse length; see [`Content::accuracy`].
    pub accuracy_reached: Vec<f64>,
}

/// Whom a slice serves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Its own ratio and, with its neighbours, those between them.
    Grid,
    /// Its own ratio alone.
    Exact,
}

impl Role {
    /// The name in the file.
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
    /// Whom the slice serves.
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
    /// What was measured off the grid.
    pub verification: Verification,
}

/// What was measured in the middle between two slices.
#[derive(Debug, Clone, PartialEq)]
pub struct Between {
    /// Poisson's ratio of the probes.
    pub poisson_ratio: f64,
    /// Measured at [`Content::between_r`] and [`Content::between_z`], shape (r, z, pulse, field).
    pub verification: Verification,
}

/// Exact and looked-up responses at probes, shape (r, z, pulse, field).
///
/// The probes of a slice are the centres of the grid's meshes.
///
/// The force is sin^4(pi t/T) on [0, T] with unit peak.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Verification {
    /// Peak in time of the exact response, with its sign.
    pub direct: Vec<f32>,
    /// Looked-up response at the instant of that peak.
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

    /// Appends some of the entries of another.
    pub fn extend(&mut self, other: &Self, entries: Range<usize>) {
        let from = entries.clone();
        self.direct.extend_from_slice(&other.direct[from.clone()]);
        self.looked_up.extend_from_slice(&other.looked_up[from]);
        self.error.extend_from_slice(&other.error[entries]);
    }
}

impl Content {
    /// Radii and depths of the probes of a slice: centres of the meshes that are served.
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
