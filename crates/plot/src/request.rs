//! What can be shown, and what is asked for.

use contact::{Choice, choice};
use figure::Figure;
use formats::stored::FileKind;
use std::fmt;

macro_rules! kinds {
    ($($kind:ident $name:literal of $file:ident => $meaning:literal;)*) => {
        choice! {
            /// What a picture shows.
            #[derive(Debug, Clone, Copy, PartialEq, Eq)]
            pub enum Kind { $(#[doc = $meaning] $kind = $name,)* }
        }

        impl Kind {
            /// The file that it shows.
            pub fn file(self) -> FileKind {
                match self { $(Self::$kind => FileKind::$file),* }
            }

            /// What it shows, in a few words.
            pub fn meaning(self) -> &'static str {
                match self { $(Self::$kind => $meaning),* }
            }
        }
    };
}

// kind, its name, the file that it shows, and what it shows
kinds! {
    Impact "impact" of Impact => "force beside Hertz's, displacement, velocity, and the first probes";
    Loop "loop" of Impact => "force against approach: the area inside is the energy lost";
    Probes "probes" of Impact => "histories at the probes with arrivals and error bands";
    Spectrum "spectrum" of Impact => "amplitude spectrum of the force, its corner frequency (half of the amplitude at 0 Hz), its zeros";
    Waves "waves" of Impact => "frames of the section until the first wave leaves it; .gif: all of them";
    Peak "peak" of Impact => "largest value over time at every place of the section";
    Surface "x-t" of Impact => "distance along the surface against time, with fronts";
    Depth "depth-t" of Impact => "depth on the axis against time, with fronts";
    Axis "axis" of Impact => "the section's axis at some instants, beside the static field";
    Sweep "sweep" of Sweep => "results of a sweep: lines over one key, a heat map over two";
    Loss "loss" of Sweep => "energy lost over the velocity of approach, with the slope 3/5";
    Restitution "restitution" of Sweep => "restitution over the velocity of approach over that of yield, with the slope -1/4";
    Histogram "histogram" of Sweep => "histograms of a sweep's draws with their quantiles";
    Errors "errors" of Table => "errors of a kernel table, measured off its grid";
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// What is asked for; the default suits every file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Request {
    /// What is shown; none: what suits the file.
    pub kind: Option<Kind>,
    /// Quantities by their names in the file; none: those that suit the kind.
    pub quantities: Vec<String>,
    /// Times in s at which fields are shown; none: times at which waves are seen.
    pub times_s: Vec<f64>,
    /// Frames of a section; none: four in a picture, and each of the file in an animation.
    pub frames: Option<usize>,
    /// The key along x of a sweep; none: the one with the most numbers.
    pub along: Option<String>,
    /// Keys of a sweep with the values at which they are held.
    pub at: Vec<(String, String)>,
    /// From and to which values colours run, or else the y axis, in SI units; none: those that suit what is shown.
    pub limits: Option<(f64, f64)>,
    /// Whether colours, or else the y axis, show sizes by their ratios.
    pub logarithmic: bool,
    /// Title; none: one that says what the scene is.
    pub title: Option<String>,
}

impl Request {
    /// A figure without panels, with the title that is asked for or else the usual one.
    pub(crate) fn figure(&self, usual: &str, subtitle: &str, columns: usize) -> Figure {
        let width = if columns == 1 { 760.0 } else { 1040.0 };
        let figure = Figure::new(self.title.as_deref().unwrap_or(usual)).subtitle(subtitle);
        figure.columns(columns).width(width)
    }
}
