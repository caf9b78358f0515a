//! The one face of every error: a sentence for people, a [`Culprit`] for programs.
//!
//! Each error says itself what it is about, beside its sentence; exit codes of the command, its errors as JSON and the
//! exceptions of Python follow from that.
//!
//! ```
//! use fault::{Class, Culprit, Fault, Remedy};
//!
//! #[derive(Debug)]
//! struct TooHeavy(f64);
//!
//! impl std::fmt::Display for TooHeavy {
//!     fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
//!         write!(f, "mass_kg = {} is outside (0, 1e6]", self.0)
//!     }
//! }
//!
//! impl Fault for TooHeavy {
//!     fn culprit(&self) -> Culprit<'_> {
//!         Culprit::of(Class::Scene).key("mass_kg").number(self.0).range("(0, 1e6]")
//!     }
//! }
//!
//! let culprit = TooHeavy(1e9).culprit();
//! assert_eq!((culprit.key.as_deref(), culprit.remedy), (Some("mass_kg"), Remedy::Change));
//! ```

use std::borrow::Cow;
use std::fmt::{Debug, Display};
use std::path::Path;

/// An error of which only the sentence is told.
pub type AnyError = Box<dyn std::error::Error + Send + Sync>;

/// An error with one face.
pub trait Fault: Debug + Display {
    /// What it is about.
    fn culprit(&self) -> Culprit<'_>;
}

/// Which kind of thing is at fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Class {
    /// A scene, a sweep, a grid or an argument.
    Scene,
    /// A number outside the physics.
    Domain,
    /// A question outside a kernel table.
    OutsideTable,
    /// The file of a kernel table.
    Table,
    /// An impact that has no results.
    Impact,
    /// Memory that is not there.
    Memory,
    /// An output that exists already.
    Exists,
    /// An output that cannot be written.
    Output,
    /// Anything else that failed.
    #[default]
    Work,
}

impl Class {
    /// Its name for programs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Scene => "scene",
            Self::Domain => "domain",
            Self::OutsideTable => "outside_table",
            Self::Table => "table",
            Self::Impact => "impact",
            Self::Memory => "memory",
            Self::Exists => "exists",
            Self::Output => "output",
            Self::Work => "work",
        }
    }
}

/// What can be done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Remedy {
    /// Change what was given.
    Change,
    /// Nothing that is known: the work itself failed.
    #[default]
    Unknown,
    /// Try the same again later.
    Wait,
}

/// What a program can use of an error; none where it has no such thing.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Culprit<'a> {
    pub class: Class,
    pub remedy: Remedy,
    /// Full name of the key, the argument or the axis at fault.
    pub key: Option<Cow<'a, str>>,
    /// The number found.
    pub number: Option<f64>,
    /// The word found.
    pub word: Option<Cow<'a, str>>,
    /// What is allowed, in interval notation or as names.
    pub range: Option<Cow<'a, str>>,
    /// The same as two numbers.
    pub limits: Option<[f64; 2]>,
    /// The nearest name that exists.
    pub suggestion: Option<Cow<'a, str>>,
    pub file: Option<Cow<'a, Path>>,
}

impl<'a> Culprit<'a> {
    /// One of whom no more is known: failed work has no remedy, everything else can be changed.
    pub fn of(class: Class) -> Self {
        Self {
            class,
            remedy: match class {
                Class::Work => Remedy::Unknown,
                Class::Scene
                | Class::Domain
                | Class::OutsideTable
                | Class::Table
                | Class::Impact
                | Class::Memory
                | Class::Exists
                | Class::Output => Remedy::Change,
            },
            ..Self::default()
        }
    }

    /// The same where nothing that is known helps.
    pub fn unmendable(self) -> Self {
        let remedy = Remedy::Unknown;
        Self { remedy, ..self }
    }

    pub fn key(self, key: &'a str) -> Self {
        let key = Some(key.into());
        Self { key, ..self }
    }

    pub fn number(self, number: f64) -> Self {
        let number = Some(number);
        Self { number, ..self }
    }

    pub fn range(self, range: &'a str) -> Self {
        let range = Some(range.into());
        Self { range, ..self }
    }

    pub fn file(self, file: &'a Path) -> Self {
        let file = Some(file.into());
        Self { file, ..self }
    }
}

/// A number as sentences have it: with an exponent where it would be a row of zeros.
///
/// ```
/// assert_eq!([-0.25, 1e300].map(fault::number), ["-0.25", "1e300"]);
/// ```
pub fn number(value: f64) -> String {
    match value.abs() {
        0.0 | 1e-7..1e16 => value.to_string(),
        _ => format!("{value:e}"),
    }
}

/// A number that was computed, with four digits.
///
/// ```
/// assert_eq!([1.0, 0.022_414_4, 3.0e-9].map(fault::rounded), ["1", "0.02241", "3e-9"]);
/// ```
pub fn rounded(value: f64) -> String {
    let text = format!("{value:.3e}");
    match text.parse::<f64>() {
        Ok(rounded) if rounded.is_finite() => number(rounded),
        // rounded up beyond the largest number
        Ok(_) | Err(_) => text,
    }
}

/// A sentence alone.
impl<T: AsRef<str> + Debug + Display> Fault for T {
    fn culprit(&self) -> Culprit<'_> {
        Culprit::default()
    }
}
