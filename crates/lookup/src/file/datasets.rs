//! The datasets of the format: name, dimensions, unit and meaning of each.

use crate::schema;

/// One dataset.
pub(super) struct Described {
    pub(super) name: &'static str,
    pub(super) units: &'static str,
    pub(super) long_name: &'static str,
}

/// Unit of everything that holds displacements beside stresses.
const FIELD_UNITS: &str = "displacement_r, displacement_z: P/(mu r0); stresses: P/r0^2";

/// Root scales.
pub(super) const R: Described = Described {
    name: schema::R,
    units: "r0",
    long_name: "distance from the axis",
};
/// Root scales.
pub(super) const Z: Described = Described {
    name: schema::Z,
    units: "r0",
    long_name: "depth below the surface",
};
/// Root scales.
pub(super) const PROBE_R: Described = Described {
    name: schema::PROBE_R,
    units: "r0",
    long_name: "distance of the verification probes from the axis",
};
/// Root scales.
pub(super) const PROBE_Z: Described = Described {
    name: schema::PROBE_Z,
    units: "r0",
    long_name: "depth of the verification probes",
};
/// Root scales.
pub(super) const PULSE_LENGTH: Described = Described {
    name: schema::PULSE_LENGTH,
    units: "r0/c1",
    long_name: "length T of the verification pulse sin^4(pi t/T)",
};
/// Root scales.
pub(super) const FIELD: Described = Described {
    name: schema::FIELD,
    units: "1",
    long_name: "name of the field",
};
/// Root scales.
pub(super) const TERM: Described = Described {
    name: schema::TERM,
    units: "1",
    long_name: "order k of the Chebyshev polynomial",
};
/// Root scales.
pub(super) const BETWEEN_R: Described = Described {
    name: schema::BETWEEN_R,
    units: "r0",
    long_name: "distance of the probes between slices from the axis",
};
/// Root scales.
pub(super) const BETWEEN_Z: Described = Described {
    name: schema::BETWEEN_Z,
    units: "r0",
    long_name: "depth of the probes between slices",
};
/// Slice scale.
pub(super) const TIME: Described = Described {
    name: schema::TIME,
    units: "r0/c1",
    long_name: "start of the time cell",
};
/// Slice data.
pub(super) const REMAINDER: Described = Described {
    name: schema::REMAINDER,
    units: FIELD_UNITS,
    long_name: "average over the time cell of the step response less its static part",
};
/// Slice data.
pub(super) const MOMENT: Described = Described {
    name: schema::MOMENT,
    units: FIELD_UNITS,
    long_name: "first moment of the remainder about the centre of the time cell, divided by the squared cell width",
};
/// Slice data.
pub(super) const CURVATURE: Described = Described {
    name: schema::CURVATURE,
    units: FIELD_UNITS,
    long_name: "second moment of the remainder about the centre of the time cell less 1/12 of the average, divided by the cubed cell width",
};
/// Slice data.
pub(super) const TAIL: Described = Described {
    name: schema::TAIL,
    units: FIELD_UNITS,
    long_name: "coefficients c_k of the remainder u^2 sum c_k T_k(2u - 1), u = time_end/t, after the last cell",
};
/// Slice data.
pub(super) const PROBE_DIRECT: Described = Described {
    name: schema::PROBE_DIRECT,
    units: FIELD_UNITS,
    long_name: "peak in time of the exact response to the verification pulse",
};
/// Slice data.
pub(super) const PROBE_LOOKED_UP: Described = Described {
    name: schema::PROBE_LOOKED_UP,
    units: FIELD_UNITS,
    long_name: "looked-up response at the instant of the exact peak",
};
/// Slice data.
pub(super) const PROBE_ERROR: Described = Described {
    name: schema::PROBE_ERROR,
    units: FIELD_UNITS,
    long_name: "largest difference in time between the looked-up and the exact response",
};
