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
}

impl Choice for Kind {
    const ALL: &'static [Self] = &[Self::Impact, Self::Probes];

    fn name(self) -> &'static str {
        match self {
            Self::Impact => "impact",
            Self::Probes => "probes",
        }
    }
}

impl Kind {
    /// The file that it shows.
    #[must_use]
    pub fn file(self) -> FileKind {
        match self {
            Self::Impact | Self::Probes => FileKind::Impact,
        }
    }

    /// Names of all kinds that show a file.
    #[must_use]
    pub fn of(file: FileKind) -> Vec<&'static str> {
        let kinds = Self::ALL.iter().filter(|kind| kind.file() == file);
        kinds.map(|kind| kind.name()).collect()
    }

    /// What it shows, in a few words.
    #[must_use]
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Impact => "force beside Hertz's, displacement, velocity, and the first probes",
            Self::Probes => "histories at the probes with arrivals and error bands",
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
