//! What a kernel table consists of, before it is a file and after it was read.

/// Number of fields.
pub(crate) const FIELDS: usize = 6;

/// The whole content of a table. Arrays are row-major in the order of the dimensions named.
#[derive(Debug, Clone, PartialEq)]
pub struct Content {
    /// Where the numbers come from.
    pub origin: Origin,
    /// Radial nodes from 0, ascending, in r0.
    pub r: Vec<f64>,
    /// Depth nodes from 0, ascending, in r0.
    pub z: Vec<f64>,
    /// Width of a time cell in r0/c1.
    pub cell_width: f64,
    /// Interpolation points along each axis.
    pub stencil_points: usize,
    /// Lengths of the verification pulses in r0/c1, ascending.
    pub pulse_lengths: Vec<f64>,
    /// One entry for each Poisson ratio, ascending.
    pub slices: Vec<Slice>,
}

/// Who made a table, with which settings.
#[derive(Debug, Clone, PartialEq)]
pub struct Origin {
    /// The resolved grid as TOML: all settings that the numbers depend on.
    pub grid: String,
    /// Version of the program.
    pub software_version: String,
    /// Git revision of the program, or `unknown`.
    pub git_revision: String,
    /// Creation time in seconds since 1970; not part of the content hash.
    pub created_unix_s: u64,
    /// Tolerance asked of the exact kernels.
    pub accuracy_asked: f64,
    /// p99 over all probes and fields of error over peak, for each pulse length.
    pub accuracy_reached: Vec<f64>,
}

/// The kernels of one Poisson ratio.
#[derive(Debug, Clone, PartialEq)]
pub struct Slice {
    /// Poisson's ratio.
    pub poisson_ratio: f64,
    /// Number of time cells; the first starts at 0.
    pub cells: usize,
    /// Averages of R over the cells, shape (r, z, field, time).
    pub remainder: Vec<f32>,
    /// First moments (1/width^2) int R (t - t_mid) dt of the cells, shape (r, z, field, time).
    pub moment: Vec<f32>,
    /// Coefficients of the tail, shape (r, z, field, term); see [`crate::Tail`].
    pub tail: Vec<f32>,
    /// What was measured off the grid.
    pub verification: Verification,
}

/// Exact and looked-up responses at the centres of the grid's meshes, shape (r - 1, z - 1, pulse, field).
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
    /// End of the last cell.
    #[must_use]
    pub fn time_end(&self, cell_width: f64) -> f64 {
        self.cells as f64 * cell_width
    }

    /// Number of coefficients of a tail, given the number of nodes of the grid.
    #[must_use]
    pub fn tail_terms(&self, nodes: usize) -> usize {
        self.tail.len() / (nodes * FIELDS).max(1)
    }
}

/// Centres of the intervals of an axis: where the verification probes lie.
pub(crate) fn centres(nodes: &[f64]) -> Vec<f64> {
    nodes
        .windows(2)
        .map(|pair| 0.5 * (pair[0] + pair[1]))
        .collect()
}
