//! Names and versions of a sweep and of its parts.

/// Value of the attribute `file_type`.
pub const FILE_TYPE: &str = "hertzlamb sweep";
/// Version of the format. The first number changes when older readers would fail.
pub const FORMAT_VERSION: &str = "1.7";

/// Section of the stored sweep with the source of the kernels of its fields.
pub const FIELDS: &str = "fields";
/// Group of the keys that vary.
pub const AXES: &str = "axes";
/// Name of the axis of keys that vary together.
pub const LIST: &str = "list";
/// Name of the axis of random draws.
pub const SAMPLE: &str = "sample";
/// Description of the scale of keys that vary together.
pub const NUMBERED: &str = "number of the values that belong together, from 0";
/// Group of the results.
pub const RESULTS: &str = "results";
/// The model that was used, as an index into the attribute `names` of the dataset.
pub const MODEL: (&str, &str, &str) = (
    "model",
    "1",
    "index of the contact model in the attribute names; 255 for a failed scene",
);
/// Failure of a scene, as an index into `/failures`.
pub const FAILURE: (&str, &str, &str) = (
    "failure",
    "1",
    "index of the reason in /failures; -1 if the scene succeeded",
);
/// Reasons of failed scenes.
pub const FAILURES: (&str, &str, &str) = ("failures", "", "reasons of failed scenes");
/// Text attributes of the root.
pub const TEXTS: [&str; 5] = [
    "file_type",
    "format_version",
    "software_version",
    "sweep",
    SHA256,
];
/// Text attribute with the hash that identifies the sweep.
pub const SHA256: &str = "sweep_sha256";
/// Number attribute of the root: number of rows.
pub const ROWS: &str = "rows";
/// Results whose rows above one are counted, even if the results are not written.
pub const COUNTED: [&str; 3] = ["yield_onset", "cone_crack_onset", "velocity_over_trusted"];
/// Number attribute of the root: number of failed rows.
pub const FAILED: &str = "failed";
/// Attribute of the models: their names.
pub const NAMES: &str = "names";

/// Names and versions of a file that holds some rows of a sweep.
pub mod part {
    /// Value of the attribute `file_type`.
    pub const FILE_TYPE: &str = "hertzlamb sweep part";
    /// Version of the format. The first number changes when older readers would fail.
    pub const FORMAT_VERSION: &str = "1.3";

    /// Text attribute of the root: I/N of the I-th of N shards, empty for other rows.
    pub const SHARD: &str = "shard";
    /// Number attribute: rows of the whole sweep.
    pub const SWEEP_ROWS: &str = "sweep_rows";
    /// Number attribute: the first row.
    pub const FIRST_ROW: &str = "first_row";
    /// Text attribute of a sweep whose results remain in its parts: their paths, one per line.
    pub const PARTS: &str = "parts";
    /// The only dimension.
    pub const ROW: (&str, &str, &str) = ("row", "1", "number of the row in the sweep, from 0");
    /// Group of the words of keys.
    pub const WORDS: &str = "words";
}
