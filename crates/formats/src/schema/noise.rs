//! Keys of a noise file, and names and versions of its results.

use crate::quantities::labels;

/// Sections of a noise file in addition to those of the scene of an impact.
pub const SECTIONS: [&str; 5] = ["random", "area", "impacts", "receiver", "output"];
/// Sections of the scene of an impact.
pub const SCENE: [&str; 4] = ["target", "striker", "contact", "materials"];
/// Keys of `[area]`; each shape has some of them.
pub const AREA: [&str; 9] = [
    "shape",
    "rate_per_m2_s",
    "x_m",
    "y_m",
    "radius_m",
    "inner_radius_m",
    "length_m",
    "width_m",
    "azimuth_deg",
];
/// Keys of `[impacts]`.
pub const IMPACTS: [&str; 1] = ["file"];
/// Keys of `[[receiver]]`.
pub const RECEIVER: [&str; 4] = ["name", "x_m", "y_m", "z_m"];
/// Keys of `[output]`.
pub const OUTPUT: [&str; 5] = [
    "frequencies_hz",
    "nearest_m",
    "duration_s",
    "step_s",
    "seed",
];
/// Columns of a file of impacts in addition to keys of the striker.
pub const COLUMNS: [&str; 3] = ["time_s", "x_m", "y_m"];

/// Value of the attribute `file_type`.
pub const FILE_TYPE: &str = "hertzlamb noise";
/// Version of the format. The first number changes when older readers would fail.
pub const FORMAT_VERSION: &str = "1.0";
/// Numbers at the root.
pub const NUMBERS: [&str; 4] = [
    "rate_per_s",
    "radiated_power_w",
    "impacts",
    "solved_contacts",
];

/// Scales of the dimensions: receivers, frequencies, distances, times of traces.
pub const RECEIVERS: (&str, &str, &str) = ("receiver", "1", "name of the receiver");
pub const FREQUENCY: (&str, &str, &str) = ("frequency", "Hz", "frequency");
pub const EDGE: (&str, &str, &str) = ("edge", "1", "number of the distance, from 0");
pub const TIME: (&str, &str, &str) = ("time", "s", "time");
/// Places of receivers.
pub const PLACES: [(&str, &str, &str); 3] = labels! {
    "x", "m", "place of the receiver";
    "y", "m", "place of the receiver";
    "z", "m", "depth of the receiver";
};
/// Power of the forces.
pub const FORCE: (&str, &str, &str) = (
    "force",
    "N^2 s^2",
    "mean of |F(f)|^2 over the impacts, F the integral of force e^(-2 pi i f t) over time",
);
/// Spectra by receiver and frequency, each with the number of time derivatives: vertical, then horizontal.
pub const POWERS: [(&str, &str, &str); 6] = labels! {
    "vertical_displacement", "m^2/Hz", "one-sided power spectral density of the vertical displacement";
    "vertical_velocity", "(m/s)^2/Hz", "one-sided power spectral density of the vertical velocity";
    "vertical_acceleration", "(m/s^2)^2/Hz", "one-sided power spectral density of the vertical acceleration";
    "horizontal_displacement", "m^2/Hz", "one-sided power spectral density of the horizontal displacement, both components";
    "horizontal_velocity", "(m/s)^2/Hz", "one-sided power spectral density of the horizontal velocity, both components";
    "horizontal_acceleration", "(m/s^2)^2/Hz", "one-sided power spectral density of the horizontal acceleration, both components";
};
/// Relative errors of the vertical power by receiver and frequency.
pub const ERRORS: [(&str, &str, &str); 6] = labels! {
    "error", "1", "sum of the relative errors of the vertical power";
    "error_sampling", "1", "relative standard deviation for the number of drawn impacts";
    "error_pulses", "1", "relative error of force spectra between solved contacts";
    "error_contact_size", "1", "relative error of the point force";
    "error_response", "1", "relative error of the response of the half-space";
    "error_quadrature", "1", "relative error of the sum over distances";
};
/// Distances and the share of nearer impacts.
pub const DISTANCE: (&str, &str, &str) = ("distance", "m", "distance from the receiver");
pub const SHARE: (&str, &str, &str) = (
    "share",
    "1",
    "part of the vertical power from impacts within the distance",
);
/// Group of the traces.
pub const TRACES: &str = "traces";
/// Traces.
pub const VELOCITY: (&str, &str, &str) = (
    "velocity",
    "m/s",
    "vertical velocity, positive down, without frequencies above half of the sampling rate",
);
