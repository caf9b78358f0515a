//! The common error interface: a sentence for people, and a [`Culprit`] for programs.
//!
//! Each error describes its cause in addition to its sentence. The exit codes of the command, its JSON errors and the
//! exceptions of the Python package follow from that description.
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

/// An error with a sentence only.
pub type AnyError = Box<dyn std::error::Error + Send + Sync>;

/// An error with a sentence and a [`Culprit`].
pub trait Fault: Debug + Display {
    /// Description of the cause, for programs.
    fn culprit(&self) -> Culprit<'_>;
}

/// Class of an error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Class {
    /// A scene, sweep or grid, or an argument or option of the command.
    Scene,
    /// A number outside its physical range.
    Domain,
    /// A query outside a kernel table.
    OutsideTable,
    /// The file of a kernel table.
    Table,
    /// An impact without results.
    Impact,
    /// Too little memory.
    Memory,
    /// An output that exists already.
    Exists,
    /// An output that cannot be written.
    Output,
    /// Any other failure.
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

/// Remedy for an error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Remedy {
    /// Change the input.
    Change,
    /// None known: the work itself failed.
    #[default]
    Unknown,
    /// Retry later.
    Wait,
}

/// Description of an error for programs; fields that do not apply are none.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Culprit<'a> {
    pub class: Class,
    pub remedy: Remedy,
    /// Full name of the key, argument or axis at fault.
    pub key: Option<Cow<'a, str>>,
    /// The rejected number.
    pub number: Option<f64>,
    /// The rejected word.
    pub word: Option<Cow<'a, str>>,
    /// The allowed range in interval notation, or the allowed names.
    pub range: Option<Cow<'a, str>>,
    /// The allowed range as two numbers.
    pub limits: Option<[f64; 2]>,
    /// The nearest valid name.
    pub suggestion: Option<Cow<'a, str>>,
    pub file: Option<Cow<'a, Path>>,
}

impl<'a> Culprit<'a> {
    /// A description with only a class. Failed work has no known remedy; for all other classes the input can be changed.
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

    /// Sets the remedy to unknown.
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

/// A number for sentences: with an exponent if it would otherwise contain many zeros.
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

/// A computed number with four digits.
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

/// A sentence without a description.
impl<T: AsRef<str> + Debug + Display> Fault for T {
    fn culprit(&self) -> Culprit<'_> {
        Culprit::default()
    }
}
