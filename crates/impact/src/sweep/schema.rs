//! Names and versions on disk.

/// Value of the attribute `file_type`.
pub const FILE_TYPE: &str = "hertzlamb sweep";
/// Version of the format: the first number changes when a reader of the old one would fail.
pub const FORMAT_VERSION: &str = "1.0";
/// Group of the keys that vary.
pub const AXES: &str = "axes";
/// Name of the axis of keys that vary together.
pub const LIST: &str = "list";
/// Name of the axis of random draws.
pub const SAMPLE: &str = "sample";
/// Group of the results.
pub const RESULTS: &str = "results";
/// Results that are numbers, with unit and description.
pub const NUMBERS: [(&str, &str, &str); 14] = [
    ("peak_force_n", "N", "largest contact force"),
    ("peak_force_time_s", "s", "when it is reached"),
    ("contact_time_s", "s", "duration of the first contact"),
    (
        "rebound_velocity_m_s",
        "m/s",
        "velocity of departure, positive away from the half-space",
    ),
    (
        "restitution",
        "1",
        "velocity of departure over velocity of approach",
    ),
    (
        "loss",
        "1",
        "kinetic energy lost over kinetic energy before, 1 - restitution^2",
    ),
    (
        "peak_displacement_m",
        "m",
        "largest displacement of the striker",
    ),
    (
        "peak_deflection_m",
        "m",
        "largest deflection of the half-space in the contact law",
    ),
    ("impulse_n_s", "N s", "momentum given to the striker"),
    ("initial_energy_j", "J", "kinetic energy before"),
    (
        "contact_radius_m",
        "m",
        "contact radius of Hertz's law at the largest force",
    ),
    ("contacts", "1", "number of contacts"),
    (
        "march_steps",
        "1",
        "steps of the march over the contact, 0 without a march",
    ),
    (
        "relative_error_estimate",
        "1",
        "estimated relative error of peak force, contact time, restitution and displacement",
    ),
];
/// The model that was used, as an index into the attribute `names` of the dataset.
pub const MODEL: (&str, &str, &str) = (
    "model",
    "1",
    "index of the contact model in the attribute names; 255 for a failed scene",
);
/// The model of a failed scene.
pub const NO_MODEL: u8 = u8::MAX;
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
