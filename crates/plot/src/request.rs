//! What can be shown, and what is asked for.

use crate::error::PlotError;
use contact::{Choice, choice};
use figure::{Figure, Scale};
use formats::stored::FileKind;
use std::fmt;

choice! {
    /// One thing that a [`Request`] may ask for and that not every kind of picture uses.
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
            /// What a picture shows.
            #[derive(Debug, Clone, Copy, PartialEq, Eq)]
            pub enum PictureKind { $(#[doc = $meaning] $kind = $name,)* }
        }

        impl PictureKind {
            /// The file that it shows.
            pub fn file(self) -> FileKind {
                match self { $(Self::$kind => FileKind::$file),* }
            }

            /// What it shows, in a few words.
            pub fn meaning(self) -> &'static str {
                match self { $(Self::$kind => $meaning),* }
            }

            /// What of a [`Request`] it uses; all use limits and a title.
            fn wishes(self) -> &'static [Wish] {
                match self { $(Self::$kind => &[$(Wish::$wish),*]),* }
            }
        }
    };
}

// kind, its name, the file that it shows, what of a request it uses, and its meaning
kinds! {
    Impact "impact" of Impact uses [Quantity, Quantities, Span, Scale] => "force beside Hertz's, displacement, velocity, and the first probes; or the quantities asked for";
    Loop "loop" of Impact uses [] => "force against approach: the area inside is the energy lost";
    Probes "probes" of Impact uses [Quantity, Quantities, Span, Scale] => "histories at the probes with arrivals and error bands";
    Spectrum "spectrum" of Impact uses [Scale] => "amplitude spectrum of the force, its corner frequency (half of the amplitude at 0 Hz), its zeros";
    Waves "waves" of Impact uses [Quantity, Times, Frames, Span, Scale] => "frames of the section until the first wave leaves it; .gif: all of them";
    Peak "peak" of Impact uses [Quantity, Scale] => "largest value at every place of the section: over all samples with [output] peaks, else over the frames";
    Surface "x-t" of Impact uses [Quantity, Span, Scale] => "distance along the surface against time, with fronts";
    Depth "depth-t" of Impact uses [Quantity, Span, Scale] => "depth on the axis against time, with fronts";
    Axis "axis" of Impact uses [Quantity, Times, Scale] => "the section's axis at some instants, beside the static field";
    Sweep "sweep" of Sweep uses [Quantity, Quantities, Along, At, Scale] => "results of a sweep: lines over one key, a heat map over two";
    Loss "loss" of Sweep uses [At] => "energy lost over the velocity of approach, with the slope 3/5";
    Restitution "restitution" of Sweep uses [At] => "restitution over the velocity of approach over that of yield, with the slope -1/4";
    Histogram "histogram" of Sweep uses [Quantity, Quantities, At, Scale] => "histograms of a sweep's results, with quantiles where they are draws";
    Errors "errors" of Table uses [Quantity, Quantities, Scale] => "errors of a kernel table, measured off its grid";
}

impl fmt::Display for PictureKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// What is asked for; the default suits every file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Request {
    /// What is shown; none: what suits the file.
    pub kind: Option<PictureKind>,
    /// Quantities by their names in the file; none: those that suit the kind.
    pub quantities: Vec<String>,
    /// Times in s at which fields are shown; none: times at which waves are seen.
    pub times_s: Vec<f64>,
    /// Frames of a section; none: four in a picture, and each of the file in an animation.
    pub frames: Option<usize>,
    /// Times in s from and to which the time axis or the frames run; none: those that suit what is shown.
    pub span_s: Option<(f64, f64)>,
    /// The key along x of a sweep; none: the one with the most numbers.
    pub along: Option<String>,
    /// Keys of a sweep with the values at which they are held.
    pub at: Vec<(String, String)>,
    /// From and to which values colours run, or else the y axis, in SI units; none: those that suit what is shown.
    pub limits: Option<(f64, f64)>,
    /// Scale of the colours, or else of the axis of values; none: the one that suits what is shown.
    pub scale: Option<Scale>,
    /// Title; none: one that says what the scene is.
    pub title: Option<String>,
}

impl Request {
    /// The kind that is asked for, or else the one that suits the file.
    ///
    /// # Errors
    /// [`PlotError`] where something is asked for that the kind does not use.
    pub(crate) fn kind_or(&self, suits: PictureKind) -> Result<PictureKind, PlotError> {
        let kind = self.kind.unwrap_or(suits);
        let used = kind.wishes();
        match self.wishes().find(|wish| !used.contains(wish)) {
            Some(wish) => Err(not_used(kind, wish)),
            None => Ok(kind),
        }
    }

    /// Everything that is asked for.
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

    /// The span that is asked for within the times that there are, or else all of them.
    ///
    /// # Errors
    /// [`PlotError`] for a span that has none of them.
    pub(crate) fn span_within(&self, [first_s, last_s]: [f64; 2]) -> Result<[f64; 2], PlotError> {
        let Some((from_s, to_s)) = self.span_s else {
            return Ok([first_s, last_s]);
        };
        let why = match () {
            () if from_s >= to_s => "the first has to be before the second",
            () if to_s <= first_s || from_s >= last_s => "there is nothing",
            () => return Ok([from_s, to_s]),
        };
        let [from, to, first, last] = [from_s, to_s, first_s, last_s].map(fault::number);
        let there = format!("the times of the file are {first} to {last} s");
        let sentence = format!("the span {from}:{to} s cannot be shown, {why}: {there}");
        Err(PlotError::refused(None, sentence))
    }

    /// A figure without panels, with the title that is asked for or else the usual one.
    pub(crate) fn figure(&self, usual: &str, subtitle: &str, columns: usize) -> Figure {
        let width = if columns == 1 { 760.0 } else { 1040.0 };
        let figure = Figure::new(self.title.as_deref().unwrap_or(usual)).subtitle(subtitle);
        figure.columns(columns).width(width)
    }
}

/// The only one of some files or paths.
pub(crate) fn only<T>(given: &[T], kind: PictureKind) -> Result<&T, PlotError> {
    match given {
        [only] => Ok(only),
        several => {
            let given = several.len();
            let sentence = format!("the picture {kind} shows one file, and {given} were given");
            Err(PlotError::refused(None, sentence))
        }
    }
}

/// A kind does not use something that is asked for.
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
