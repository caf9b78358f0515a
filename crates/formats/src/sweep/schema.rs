//! Names and versions on disk.

/// Value of the attribute `file_type`.
pub const FILE_TYPE: &str = "hertzlamb sweep";
/// Version of the format: the first number changes when a reader of the old one would fail.
pub const FORMAT_VERSION: &str = "1.3";
/// Group of the keys that vary.
pub const AXES: &str = "axes";
/// Name of the axis of keys that vary together.
pub const LIST: &str = "list";
/// Name of the axis of random draws.
pub const SAMPLE: &str = "sample";
/// What the scale of keys that vary together holds.
pub const NUMBERED: &str = "number of the values that belong together, from 0";
/// Group of the results.
pub const RESULTS: &str = "results";
/// The model that was used, as an index into the attribute `names` of the dataset.
pub const MODEL: (&str, &str, &str) = (
    "model",
    "1",
    "index of the contact model in the attribute names; 255 for a failed scene",
);
/// Which failure a scene has, as an index into `/failures`.
pub const FAILURE: (&str, &str, &str) = (
    "failure",
    "1",
    "index of the reason in /failures; -1 where the scene succeeded",
);
/// Reasons of failed scenes.
pub const FAILURES: (&str, &str, &str) = ("failures", "", "reasons of failed scenes");
/// Text attributes of the root.
pub const TEXTS: [&str; 4] = ["file_type", "format_version", "software_version", "sweep"];
/// Number attributes of the root.
pub const COUNTS: [&str; 2] = ["rows", "failed"];
