//! Names and versions of the file of a force behind traces.

use crate::quantities::labels;

/// Value of the attribute `file_type`.
pub const FILE_TYPE: &str = "hertzlamb force";
/// Version of the format. The first number changes when older readers would fail.
pub const FORMAT_VERSION: &str = "1.0";
/// Numbers at the root.
pub const NUMBERS: [&str; 14] = [
    "peak_force_n",
    "peak_force_sd_n",
    "contact_time_s",
    "contact_time_sd_s",
    "start_s",
    "start_sd_s",
    "impulse_n_s",
    "impulse_sd_n_s",
    "history_impulse_n_s",
    "history_impulse_sd_n_s",
    "variance_reduction",
    "chi_squared",
    "degrees_of_freedom",
    "lambda",
];
/// The history of the force with its band.
pub const HISTORY: [(&str, &str, &str); 4] = labels! {
    "time", "s", "time in the clock of the traces";
    "force", "N", "force, not negative, linear between samples";
    "force_low", "N", "lower end of the 95 % band";
    "force_high", "N", "upper end of the 95 % band";
};
/// Group of the L-curve.
pub const L_CURVE: &str = "l_curve";
/// Its columns.
pub const L_CURVES: [(&str, &str, &str); 3] = labels! {
    "lambda", "1/N^2", "weight of the squared second differences";
    "residual", "1", "norm of the residual in units of the noise";
    "roughness", "N", "norm of the second differences of the force";
};
/// Group of the traces.
pub const TRACES: &str = "traces";
/// Number of each sensor, the scale of their dimension.
pub const SENSOR: (&str, &str, &str) = ("sensor", "1", "number of the sensor, from 1");
/// The traces that the force history explains.
pub const PREDICTED: (&str, &str, &str) = (
    "predicted",
    "1",
    "trace that the force history explains, in the unit of the sensor's output",
);
