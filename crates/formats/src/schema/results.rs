//! Names and versions of a results file.

use crate::quantities::{Described, Labels, labels, labels_of};
use impact::{EnergySeries, ProbeFields, Series};

/// Value of the attribute `file_type`.
pub const FILE_TYPE: &str = "hertzlamb results";
/// Version of the format. The first number changes when older readers would fail.
pub const FORMAT_VERSION: &str = "1.11";
/// Minor version since which files have a checksum trailer.
pub(crate) const SEALED_FROM: u32 = 8;
/// Datasets in the root, with unit and description.
pub const SERIES: [(&str, &str, &str); 5] = labels! {
    "time", "s", "time since the first touch";
    FORCE, "N", "contact force, positive in compression";
    "displacement", "m", "displacement of the striker, positive into the half-space";
    "velocity", "m/s", "velocity of the striker, positive into the half-space";
    "deflection", "m", "deflection of the half-space in the contact law, positive inwards";
};
/// The force in [`SERIES`].
pub const FORCE: &str = "force";
/// Numbers at `/force` of a treated record.
pub const TREATMENT: [&str; 5] = [
    "baseline_s",
    "baseline_n",
    "low_pass_hz",
    "removed_rms_n",
    "before_zero_n_s",
];
/// Group of the energy over time.
pub const ENERGY: &str = "energy";
/// Datasets of the energy; the first only with a striker, the second only without one.
pub const ENERGIES: [(&str, &str, &str); 5] = labels! {
    "kinetic", "J", "kinetic energy of the striker, by its momentum";
    "work", "J", "work of the force on the half-space";
    "stored", "J", "recoverable elastic energy";
    "radiated", "J", "work on the deflection that lags behind the force";
    "plastic", "J", "work of the plastic flow";
};
/// Group of the probes.
pub const PROBES: &str = "probes";
/// Number of each probe, the scale of their dimension.
pub const PROBE: (&str, &str, &str) = ("probe", "1", "number of the probe, from 1");
/// Names of the waves, the scale of the arrivals.
pub const WAVE: (&str, &str, &str) = ("wave", "1", "longitudinal, shear and Rayleigh wave");
/// The names in it.
pub const WAVES: [&str; 3] = ["P", "S", "R"];
/// Attribute with the names of the coordinates of a dataset in addition to its scales, as in the CF conventions.
pub const COORDINATES: &str = "coordinates";
/// Coordinates of the probes.
pub const PLACES: [(&str, &str, &str); 2] = labels! {
    "r", "m", "distance from the axis";
    "z", "m", "depth below the surface";
};
/// Suffix of a field: the estimate of its error.
pub const ERROR_SUFFIX: &str = "_error";
/// Suffixes of a quantity: its largest value over time, the time of it, and the error of it.
pub const PEAK_SUFFIXES: [&str; 3] = ["_peak", "_peak_time", "_peak_error"];
/// Arrivals of the first P, S and Rayleigh wave.
pub const ARRIVALS: (&str, &str, &str) = (
    "arrival",
    "s",
    "arrival time of the first P, S and Rayleigh wave; infinite if there is no Rayleigh wave",
);
/// Arrival of the first echo from the faces of the block.
pub const VALID_UNTIL: (&str, &str, &str) = (
    "valid_until",
    "s",
    "arrival time of the first echo from the faces of the block; infinite if the block has no faces",
);
/// Names of the waves of a plate, the scale of their arrivals; in the file of a plate only.
pub const ECHO: (&str, &str, &str) = (
    "echo",
    "1",
    "P or S for each leg of a wave between the faces of the plate, and for its last part",
);
/// Arrivals of these waves.
pub const ECHO_ARRIVALS: (&str, &str, &str) = (
    "echo_arrival",
    "s",
    "first arrival time of each wave that has run between the faces of the plate; infinite if it does not arrive",
);
/// Group of the sensors.
pub const SENSORS: &str = "sensors";
/// Number of each sensor, the scale of their dimension.
pub const SENSOR: (&str, &str, &str) = ("sensor", "1", "number of the sensor, from 1");
/// Numbers of the sensors, one a sensor.
pub const FACES: [(&str, &str, &str); 3] = labels! {
    "r", "m", "distance of the centre of the face from the axis";
    "z", "m", "depth of the face below the surface";
    "face_radius", "m", "radius of the face; 0 for a point";
};
/// Words of the sensors, one a sensor.
pub const SENSED: [(&str, &str, &str); 4] = labels! {
    "quantity", "1", "measured quantity";
    "unit", "1", "unit of the mean";
    "output_unit", "1", "unit of the output";
    "face_mean", "1", "method of the mean over the face: point, discs, circles or kernels";
};
/// Means over the faces, their errors, the outputs and theirs; the units are those of `unit` and `output_unit`.
pub const OUTPUTS: [(&str, &str, &str); 4] = labels! {
    "mean", "1", "mean of the measured quantity over the face, in its unit";
    "mean_error", "1", "estimated absolute error of the mean, in its unit";
    "output", "1", "output of the sensor, in output_unit";
    "output_error", "1", "estimated absolute error of the output, in output_unit";
};
/// Text attribute of the root: warnings about the results, one per line.
pub const WARNINGS: &str = "warnings";
/// Attribute of the root: cutoff in Hz of the low pass through which the fields are seen; in files of such scenes only.
pub const LOW_PASS: &str = "output_low_pass_hz";
/// Text attribute with the resolved scene.
pub const SCENE: &str = "scene";
/// Text attribute with the hash of the scene, which does not depend on the kernels.
pub const SCENE_SHA256: &str = "scene_sha256";
/// Group of the section.
pub const MAP: &str = "map";
/// Scales of the section in the order of its dimensions.
pub const MAP_SCALES: [(&str, &str, &str); 3] = labels! {
    "time", "s", "time of each frame since the first touch";
    "z", "m", "depth below the surface, descending";
    "r", "m", "distance from the axis";
};
/// Group that ParaView and pyvista read.
pub const VTK: &str = "VTKHDF";
/// Group of the fields in it.
pub const VTK_POINTS: &str = "PointData";
/// Scale of datasets with one value for all time steps.
pub const WHOLE: (&str, &str, &str) = ("whole", "1", "all samples in time together");
/// Group with the offsets of the steps of a field.
pub const VTK_OFFSETS: &str = "PointDataOffsets";

/// Datasets that accompany a quantity: the estimate of its error, its largest value over time, the time of it, and the
/// error of it; `at` is the place, if any.
pub(crate) fn beside(name: &str, (_, unit, meaning): Labels<'_>, at: &str) -> [Described; 4] {
    [
        (ERROR_SUFFIX, unit, "estimated absolute error"),
        (PEAK_SUFFIXES[0], unit, "largest in magnitude over time"),
        (PEAK_SUFFIXES[1], "s", "when it is largest in magnitude"),
        (
            PEAK_SUFFIXES[2],
            unit,
            "estimated absolute error of the largest in magnitude over time",
        ),
    ]
    .map(|(suffix, unit, what)| Described {
        name: format!("{name}{suffix}"),
        unit: unit.to_owned(),
        meaning: format!("{what}{at}: {meaning}"),
    })
}

/// The samples of [`SERIES`], without those of the striker if there is no striker.
pub fn samples(series: &Series) -> impl Iterator<Item = (&'static Labels<'static>, &[f64])> {
    let striker = series.striker.as_ref();
    let samples = [
        Some(&series.time_s),
        Some(&series.force_n),
        striker.map(|striker| &striker.displacement_m),
        striker.map(|striker| &striker.velocity_m_s),
        Some(&series.deflection_m),
    ];
    let rows = SERIES.iter().zip(samples);
    rows.filter_map(|(row, samples)| Some((row, samples?.as_slice())))
}

/// The samples of the existing [`ENERGIES`].
pub fn energies(energy: &EnergySeries) -> impl Iterator<Item = (&'static Labels<'static>, &[f64])> {
    let samples = [
        energy.kinetic_j.as_ref(),
        energy.work_j.as_ref(),
        Some(&energy.stored_j),
        Some(&energy.radiated_j),
        energy.plastic_j.as_ref(),
    ];
    let rows = ENERGIES.iter().zip(samples);
    rows.filter_map(|(row, samples)| Some((row, samples?.as_slice())))
}

/// Histories at the probes with their errors.
pub fn histories(
    fields: &ProbeFields,
) -> impl Iterator<Item = (Labels<'static>, &Vec<Vec<f64>>, &Vec<f64>)> {
    let found = fields.values.iter().zip(&fields.errors);
    labels_of(&fields.quantities)
        .zip(found)
        .map(|(row, (values, errors))| (row, values, errors))
}
