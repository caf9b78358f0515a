//! What can be shown.

use contact::Choice;
use formats::stored::FileKind;
use std::fmt;

/// What a picture shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Force, displacement and velocity of an impact, and its first probes.
    Impact,
    /// Histories at the probes.
    Probes,
    /// Amplitude spectrum of the force.
    Spectrum,
    /// Frames of the section.
    Waves,
    /// Largest values over time in the section.
    Peak,
    /// Distance along the surface against time.
    Surface,
    /// Depth on the axis against time.
    Depth,
    /// The section's axis at some instants, beside the static field.
    Axis,
    /// Results over the keys of a sweep.
    Sweep,
    /// Energy lost over the velocity of approach.
    Loss,
    /// Histograms of results.
    Histogram,
    /// Measured errors of a kernel table.
    Errors,
}

impl Choice for Kind {
    const ALL: &'static [Self] = &[
        Self::Impact,
        Self::Probes,
        Self::Spectrum,
        Self::Waves,
        Self::Peak,
        Self::Surface,
        Self::Depth,
        Self::Axis,
        Self::Sweep,
        Self::Loss,
        Self::Histogram,
        Self::Errors,
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Impact => "impact",
            Self::Probes => "probes",
            Self::Spectrum => "spectrum",
            Self::Waves => "waves",
            Self::Peak => "peak",
            Self::Surface => "x-t",
            Self::Depth => "depth-t",
            Self::Axis => "axis",
            Self::Sweep => "sweep",
            Self::Loss => "loss",
            Self::Histogram => "histogram",
            Self::Errors => "errors",
        }
    }
}

impl Kind {
    /// The file that it shows.
    pub fn file(self) -> FileKind {
        match self {
            Self::Impact
            | Self::Probes
            | Self::Spectrum
            | Self::Waves
            | Self::Peak
            | Self::Surface
            | Self::Depth
            | Self::Axis => FileKind::Impact,
            Self::Sweep | Self::Loss | Self::Histogram => FileKind::Sweep,
            Self::Errors => FileKind::Table,
        }
    }

    /// Names of all kinds that show a file.
    pub fn of(file: FileKind) -> Vec<&'static str> {
        let kinds = Self::ALL.iter().filter(|kind| kind.file() == file);
        kinds.map(|kind| kind.name()).collect()
    }

    /// What it shows, in a few words.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Impact => "force beside Hertz's, displacement, velocity, and the first probes",
            Self::Probes => "histories at the probes with arrivals and error bands",
            Self::Spectrum => "amplitude spectrum of the force, its corner frequency and its zeros",
            Self::Waves => {
                "frames of the section until the first wave leaves it; .gif: all of them"
            }
            Self::Peak => "largest value over time at every place of the section",
            Self::Surface => "distance along the surface against time, with fronts",
            Self::Depth => "depth on the axis against time, with fronts",
            Self::Axis => "the section's axis at some instants, beside the static field",
            Self::Sweep => "results of a sweep: lines over one key, a heat map over two",
            Self::Loss => "energy lost over the velocity of approach, with the slope 3/5",
            Self::Histogram => "histograms of a sweep's draws with their quantiles",
            Self::Errors => "errors of a kernel table, measured off its grid",
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
