//! Kinds of pictures and the request for one.

use crate::error::PlotError;
use contact::{Choice, choice};
use figure::{Figure, Scale};
use formats::stored::FileKind;
use std::fmt;

choice! {
    /// A part of a [`Request`] that not all kinds of picture use.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub(crate) enum Wish {
        /// [`Request::quantities`], one of them.
        Quantity = "quantity",
        /// [`Request::quantities`], any number of them.
        Quantities = "several quantities",
        /// [`Request::times_s`].
        Times = "times",
        /// [`Request::frames`].
        Frames = "frames",
        /// [`Request::span_s`].
        Span = "span",
        /// [`Request::along`].
        Along = "along",
        /// [`Request::at`].
        At = "at",
        /// [`Request::scale`].
        Scale = "log or linear",
    }
}

macro_rules! kinds {
    ($($kind:ident $name:literal of $file:ident uses [$($wish:ident),*] => $meaning:literal;)*) => {
        choice! {
            /// Kind of a picture.
            #[derive(Debug, Clone, Copy, PartialEq, Eq)]
            pub enum PictureKind { $(#[doc = $meaning] $kind = $name,)* }
        }

        impl PictureKind {
            /// Kind of file that the picture shows.
            pub fn file(self) -> FileKind {
                match self { $(Self::$kind => FileKind::$file),* }
            }

            /// Content of the picture in a few words.
            pub fn meaning(self) -> &'static str {
                match self { $(Self::$kind => $meaning),* }
            }

            /// Parts of a [`Request`] that it uses; all use limits and a title.
            fn wishes(self) -> &'static [Wish] {
                match self { $(Self::$kind => &[$(Wish::$wish),*]),* }
            }
        }
    };
}

// kind, its name, kind of file, used parts of a request, and content
kinds! {
    Impact "impact" of Impact uses [Quantity, Quantities, Span, Scale] => "force compared with Hertz's, displacement, velocity, and the first probes; or the chosen quantities";
    Loop "loop" of Impact uses [] => "force over approach; the enclosed area is the energy loss";
    Probes "probes" of Impact uses [Quantity, Quantities, Span, Scale] => "histories at the probes with arrivals and error bands";
    Sensors "sensors" of Impact uses [Span] => "outputs of the sensors with arrivals and error bands";
    Spectrum "spectrum" of Impact uses [Quantity, Quantities, Scale] => "amplitude spectra of the force, with its corner frequency (-3 dB) and zeros, and of the histories at the first probes or sensors";
    Waves "waves" of Impact uses [Quantity, Times, Frames, Span, Scale] => "frames of the section until the first wave leaves it; as .gif all frames";
    Peak "peak" of Impact uses [Quantity, Scale] => "largest value at every point of the section; over all samples if the scene has [output] peaks, over the frames otherwise";
    Surface "x-t" of Impact uses [Quantity, Span, Scale] => "distance along the surface over time, with wave fronts";
    Depth "depth-t" of Impact uses [Quantity, Span, Scale] => "depth on the axis over time, with wave fronts";
    Axis "axis" of Impact uses [Quantity, Times, Scale] => "field on the axis of the section at some times, compared with the static field";
    Sweep "sweep" of Sweep uses [Quantity, Quantities, Along, At, Scale] => "results of a sweep: lines over one key, a heat map over two";
    Loss "loss" of Sweep uses [At] => "energy loss over velocity of approach, with the slope 3/5";
    Restitution "restitution" of Sweep uses [At] => "restitution over velocity of approach relative to the onset of yield, with the slope -1/4";
    Histogram "histogram" of Sweep uses [Quantity, Quantities, At, Scale] => "histograms of a sweep's results, with quantiles of random draws";
    Errors "errors" of Table uses [Quantity, Quantities, Scale] => "errors of a kernel table between its grid points";
}

impl fmt::Display for PictureKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Request for a picture; the default suits every file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Request {
    /// Kind of picture. Default: the one that suits the file.
    pub kind: Option<PictureKind>,
    /// Quantities by their names in the file. Default: those that suit the kind.
    pub quantities: Vec<String>,
    /// Times in s at which fields are shown. Default: times at which waves are visible.
    pub times_s: Vec<f64>,
    /// Number of frames of a section. Default: four in a picture, all frames of the file in an animation.
    pub frames: Option<usize>,
    /// Limits in s of the time axis or the frames. Default: those that suit the content.
    pub span_s: Option<(f64, f64)>,
    /// Key of a sweep on the x axis. Default: the key with the most numbers.
    pub along: Option<String>,
    /// Keys of a sweep with their fixed values.
    pub at: Vec<(String, String)>,
    /// Limits of the colour scale, or of the y axis if there are no colours, in SI units. Default: those that suit the
    /// content.
    pub limits: Option<(f64, f64)>,
    /// Scale of the colours, or of the axis of values if there are no colours. Default: the one that suits the content.
    pub scale: Option<Scale>,
    /// Title. Default: a description of the scene.
    pub title: Option<String>,
}

impl Request {
    /// The requested kind, or else the one that suits the file.
    ///
    /// # Errors
    /// [`PlotError`] if the request has a part that the kind does not use.
    pub(crate) fn kind_or(&self, suits: PictureKind) -> Result<PictureKind, PlotError> {
        let kind = self.kind.unwrap_or(suits);
        let used = kind.wishes();
        match self.wishes().find(|wish| !used.contains(wish)) {
            Some(wish) => Err(not_used(kind, wish)),
            None => Ok(kind),
        }
    }

    /// All parts of the request.
    fn wishes(&self) -> impl Iterator<Item = Wish> {
        let asked = |wish: &Wish| match wish {
            Wish::Quantity => !self.quantities.is_empty(),
            Wish::Quantities => self.quantities.len() > 1,
            Wish::Times => !self.times_s.is_empty(),
            Wish::Frames => self.frames.is_some(),
            Wish::Span => self.span_s.is_some(),
            Wish::Along => self.along.is_some(),
            Wish::At => !self.at.is_empty(),
            Wish::Scale => self.scale.is_some(),
        };
        Wish::ALL.iter().copied().filter(asked)
    }

    /// The requested time span within the times of the file, or else all times.
    ///
    /// # Errors
    /// [`PlotError`] for a span outside the times of the file.
    pub(crate) fn span_within(&self, [first_s, last_s]: [f64; 2]) -> Result<[f64; 2], PlotError> {
        let Some((from_s, to_s)) = self.span_s else {
            return Ok([first_s, last_s]);
        };
        let why = match () {
            () if from_s >= to_s => "the first must be before the second",
            () if to_s <= first_s || from_s >= last_s => "it contains no data",
            () => return Ok([from_s, to_s]),
        };
        let [from, to, first, last] = [from_s, to_s, first_s, last_s].map(fault::rounded);
        let there = format!("the times of the file are {first} to {last} s");
        let sentence = format!("the span {from}:{to} s cannot be shown, {why}: {there}");
        Err(PlotError::refused(None, sentence))
    }

    /// A figure without panels, with the requested title or else the usual one.
    pub(crate) fn figure(&self, usual: &str, subtitle: &str, columns: usize) -> Figure {
        let width = if columns == 1 { 760.0 } else { 1040.0 };
        let figure = Figure::new(self.title.as_deref().unwrap_or(usual)).subtitle(subtitle);
        figure.columns(columns).width(width)
    }
}

/// The only element, or an error for several.
pub(crate) fn only<T>(given: &[T], kind: PictureKind) -> Result<&T, PlotError> {
    match given {
        [only] => Ok(only),
        several => {
            let given = several.len();
            let sentence = format!("the picture {kind} shows one file, but {given} were given");
            Err(PlotError::refused(None, sentence))
        }
    }
}

/// The error for a part of a request that a kind does not use.
fn not_used(kind: PictureKind, wish: Wish) -> PlotError {
    let same = |other: &&PictureKind| other.file() == kind.file() && other.wishes().contains(&wish);
    let using = PictureKind::ALL.iter().filter(same).map(|kind| kind.name());
    let using = match using.collect::<Vec<_>>().as_slice() {
        [] => format!("no picture of {} does", kind.file()),
        [only] => format!("only {only} does"),
        [first @ .., last] => format!("{} and {last} do", first.join(", ")),
    };
    let wish = wish.name();
    PlotError::refused(
        None,
        format!("the picture {kind} does not use {wish}: {using}"),
    )
}
