//! All names of the kernel-table format.
//!
//! `data-schema/kernel-table.md` describes them; a test compares the two.

/// Value of [`FILE_TYPE`] in every kernel table.
pub const FILE_TYPE_VALUE: &str = "hertzlamb kernel table";
/// Version of the format that this program writes: major.minor.
pub const FORMAT_VERSION_VALUE: &str = "2.4";
/// First minor version whose files have a checksum trailer (seal).
pub const SEALED_FROM: u32 = 4;
/// Major versions that this program reads.
pub const MAJOR_READ: u32 = 2;

/// Root attribute: kind of the file.
pub const FILE_TYPE: &str = "file_type";
/// Root attribute: format version, `major.minor`.
pub const FORMAT_VERSION: &str = "format_version";
/// Root attribute: version of the program that wrote the file.
pub const SOFTWARE_VERSION: &str = "software_version";
/// Root attribute: revision of the numbers; 1 if it is missing.
pub const NUMBERS_REVISION: &str = "numbers_revision";
/// Root attribute: git revision of that program, or `unknown`.
pub const GIT_REVISION: &str = "git_revision";
/// Root attribute: creation time, seconds since 1970 (UTC). Not part of the content hash.
pub const CREATED: &str = "created_unix_s";
/// Root attribute: hash of the settings, 16 hexadecimal digits.
pub const ID: &str = "id";
/// Root attribute: the grid with all defaults, as TOML.
pub const GRID: &str = "grid";
/// Root attribute: SHA-256 of the content, 64 hexadecimal digits.
pub const CONTENT_SHA256: &str = "content_sha256";
/// Root attribute: width of a time cell in r0/c1 at nu = 0.3. Slice attribute: width of the slice's cells.
pub const CELL_WIDTH: &str = "cell_width";
/// Root attribute: number of interpolation points along each axis.
pub const STENCIL_POINTS: &str = "stencil_points";
/// Root attribute: requested tolerance of the exact kernels.
pub const ACCURACY_ASKED: &str = "accuracy_asked";
/// Root attribute: 99 % quantile of the relative error of the worst field, per pulse length.
pub const ACCURACY_REACHED: &str = "accuracy_reached";

/// Root attribute: quantiles of the relative error on slices, shape (pulse, field, quantile).
pub const ERROR_ON_SLICES: &str = "error_on_slices";
/// Root attribute: quantiles of the relative error between slices; absent if only one slice is interpolated.
pub const ERROR_BETWEEN_SLICES: &str = "error_between_slices";
/// Root attribute: largest distance from the axis in r0 that can be looked up.
pub const R_MAX: &str = "r_max";
/// Root attribute: largest depth in r0 that can be looked up.
pub const Z_MAX: &str = "z_max";

/// Dataset and scale: radial nodes.
pub const R: &str = "r";
/// Dataset and scale: depth nodes.
pub const Z: &str = "z";
/// Dataset and scale: orders of the polynomials of a tail.
pub const TERM: &str = "term";
/// Dataset and scale: names of the fields.
pub const FIELD: &str = "field";
/// Dataset and scale: radii of the verification probes.
pub const PROBE_R: &str = "probe_r";
/// Dataset and scale: depths of the verification probes.
pub const PROBE_Z: &str = "probe_z";
/// Dataset and scale: lengths of the verification pulses.
pub const PULSE_LENGTH: &str = "pulse_length";
/// Dataset and scale: radii of the probes between slices.
pub const BETWEEN_R: &str = "between_r";
/// Dataset and scale: depths of the probes between slices.
pub const BETWEEN_Z: &str = "between_z";
/// Group: one subgroup for each interval between slices.
pub const BETWEEN: &str = "between";
/// Group: one subgroup for each Poisson ratio.
pub const SLICES: &str = "slices";

/// Slice attribute: Poisson's ratio.
pub const POISSON_RATIO: &str = "poisson_ratio";
/// Slice attribute: `grid` if the slice takes part in interpolation between ratios, otherwise `exact`.
pub const ROLE: &str = "role";
/// Slice attribute: end of the last time cell.
pub const TIME_END: &str = "time_end";
/// Slice dataset and scale: start of each time cell.
pub const TIME: &str = "time";
/// Slice dataset: cell averages of the remainder.
pub const REMAINDER: &str = "remainder";
/// Slice dataset: first moments of the remainder in each cell.
pub const MOMENT: &str = "moment";
/// Slice dataset: second moments of the remainder in each cell.
pub const CURVATURE: &str = "curvature";
/// Slice dataset: Chebyshev coefficients of the decay after the last cell.
pub const TAIL: &str = "tail";
/// Slice dataset: peak of the exact response at each probe.
pub const PROBE_DIRECT: &str = "probe_direct";
/// Slice dataset: looked-up response at the time of that peak.
pub const PROBE_LOOKED_UP: &str = "probe_looked_up";
/// Slice dataset: largest difference in time between the two responses.
pub const PROBE_ERROR: &str = "probe_error";

/// Attribute of every dataset: its unit.
pub const UNITS: &str = "units";
/// Attribute of every dataset: its description.
pub const LONG_NAME: &str = "long_name";

/// Names of the six fields in the order of [`halfspace::FIELDS`].
pub const FIELD_NAMES: [&str; 6] = [
    "displacement_r",
    "displacement_z",
    "stress_rr",
    "stress_tt",
    "stress_zz",
    "stress_rz",
];

/// Name of the group of one slice: `nu_` and the shortest decimal form of Poisson's ratio.
pub fn slice_name(poisson_ratio: f64) -> String {
    format!("nu_{poisson_ratio}")
}
