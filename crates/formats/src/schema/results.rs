//! Names and versions of a results file.

use crate::quantities::{Described, Labels, labels, labels_of};
use impact::{EnergySeries, ProbeFields, Series};

/// Value of the attribute `file_type`.
pub const FILE_TYPE: &str = "hertzlamb results";
/// Version of the format: the first number changes when a reader of the old one would fail.
pub const FORMAT_VERSION: &str = "1.9";
/// Minor version from which on files end with their checksums.
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
/// Numbers at `/force` of a record that was treated.
pub const TREATMENT: [&str; 5] = [
    "baseline_s",
    "baseline_n",
    "low_pass_hz",
    "removed_rms_n",
    "before_zero_n_s",
];
/// Group of the energy over time.
pub const ENERGY: &str = "energy";
/// Datasets in it; the first where there is a striker, the second where there is none.
pub const ENERGIES: [(&str, &str, &str); 5] = labels! {
    "kinetic", "J", "kinetic energy of the striker, by its momentum";
    "work", "J", "work of the force on the half-space";
    "stored", "J", "elastic energy that is given back";
    "radiated", "J", "work on the part of the deflection that lags behind the force";
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
/// Attribute that names the coordinates of a dataset beside its scales, as the CF conventions have it.
pub const COORDINATES: &str = "coordinates";
/// Coordinates of the probes.
pub const PLACES: [(&str, &str, &str); 2] = labels! {
    "r", "m", "distance from the axis";
    "z", "m", "depth below the surface";
};
/// Appended to the name of a field: the estimate of its error.
pub const ERROR_SUFFIX: &str = "_error";
/// Appended to the name of a quantity: its largest value over time, and when it is reached.
pub const PEAK_SUFFIXES: [&str; 2] = ["_peak", "_peak_time"];
/// Arrivals of the first P, S and Rayleigh wave.
pub const ARRIVALS: (&str, &str, &str) = (
    "arrival",
    "s",
    "time at which the first P, S and Rayleigh wave arrive; infinite for a Rayleigh wave where there is none",
);
/// When the first echo from the faces of the block arrives.
pub const VALID_UNTIL: (&str, &str, &str) = (
    "valid_until",
    "s",
    "time at which the first echo from the faces of the block arrives; infinite where no face is known",
);
/// Text attribute of the root: what is to be known of the results, one a line.
pub const WARNINGS: &str = "warnings";
/// The one that has the resolved scene.
pub const SCENE: &str = "scene";
/// The text attribute that says which scene it is, whatever the kernels.
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
/// The scale of what has one value for all steps in it.
pub const WHOLE: (&str, &str, &str) = ("whole", "1", "all samples in time together");
/// Where in a field of it each step begins.
pub const VTK_OFFSETS: &str = "PointDataOffsets";

/// What a file has under a name beside a quantity: the estimate of its error, its largest value over time, and when that is
/// reached; `at` says where, if anywhere.
pub(crate) fn beside(name: &str, (_, unit, meaning): Labels<'_>, at: &str) -> [Described; 3] {
    [
        (ERROR_SUFFIX, unit, "estimated absolute error"),
        (PEAK_SUFFIXES[0], unit, "largest in magnitude over time"),
        (PEAK_SUFFIXES[1], "s", "when it is largest in magnitude"),
    ]
    .map(|(suffix, unit, what)| Described {
        name: format!("{name}{suffix}"),
        unit: unit.to_owned(),
        meaning: format!("{what}{at}: {meaning}"),
    })
}

/// The samples of [`SERIES`], without those of a striker where there is none.
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

/// The samples of [`ENERGIES`] that there are.
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

/// What probes have, over time at each, with its error at each.
pub fn histories(
    fields: &ProbeFields,
) -> impl Iterator<Item = (Labels<'static>, &Vec<Vec<f64>>, &Vec<f64>)> {
    let found = fields.values.iter().zip(&fields.errors);
    labels_of(&fields.quantities)
        .zip(found)
        .map(|(row, (values, errors))| (row, values, errors))
}
