//! Names and versions of cases of Lamb's problem and of their histories.

/// Value of the attribute `file_type`.
pub const FILE_TYPE: &str = "hertzlamb lamb";
/// Version of the format. The first number changes when older readers would fail.
pub const FORMAT_VERSION: &str = "1.0";
/// Times of all histories.
pub const TIME: (&str, &str, &str) = ("time", "s", "time after the zero of the time function");
/// Attribute of a history: estimated largest absolute error over time, in its unit.
pub const ERROR: &str = "error";
/// Attribute of the root: the text of the case.
pub const CASE: &str = "case";

/// Sections of a case.
pub const SECTIONS: [&str; 5] = ["target", "materials", "source", "receiver", "output"];
/// Keys of the source.
pub const SOURCE: [&str; 9] = [
    "profile",
    "radius_m",
    "force_n",
    "time_function",
    "frequency_hz",
    "delay_s",
    "file",
    "columns",
    "units",
];
/// Keys of a receiver.
pub const RECEIVER: [&str; 5] = ["name", "r_m", "x_m", "y_m", "z_m"];
/// Keys of the output.
pub const OUTPUT: [&str; 3] = ["end_s", "step_s", "quantities"];

/// Names and meanings of the histories of a receiver.
pub const HISTORIES: [(&str, &str); 12] = [
    ("ux", "displacement along x"),
    ("uy", "displacement along y"),
    ("ur", "radial displacement, outward"),
    ("uz", "vertical displacement, into the block"),
    ("vx", "velocity along x"),
    ("vy", "velocity along y"),
    ("vr", "radial velocity, outward"),
    ("vz", "vertical velocity, into the block"),
    ("srr", "radial stress, tension positive"),
    ("stt", "hoop stress, tension positive"),
    ("szz", "vertical stress, tension positive"),
    ("srz", "shear stress"),
];
