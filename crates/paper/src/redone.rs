//! Everything together, and the folder that it is written into.

use crate::csv_file;
use crate::error::PaperError;
use crate::figures::{self, Redrawn};
use crate::numbers::Numbers;
use crate::report;
use crate::runs::Runs;
use figure::{to_png, to_svg};
use output::{Folder, NewFile, OutputError};
use std::path::Path;

/// Pixels of a PNG for each of the SVG's.
const SCALE: f32 = 1.5;

/// The paper redone.
#[derive(Debug, Clone, PartialEq)]
pub struct Redone {
    /// Its numbers.
    pub numbers: Numbers,
    /// Its figures 4 to 11.
    pub figures: Vec<Redrawn>,
}

impl Redone {
    /// Solves the contacts and computes the fields.
    ///
    /// # Errors
    /// [`PaperError`] where something that must work does not.
    pub fn compute() -> Result<Self, PaperError> {
        let runs = Runs::solve()?;
        Ok(Self {
            numbers: Numbers::of(&runs)?,
            figures: figures::all(&runs)?,
        })
    }

    /// The report as Markdown; the figures are named as they are beside it.
    #[must_use]
    pub fn report(&self) -> String {
        report::markdown(&self.numbers, &self.figures)
    }

    /// Writes report.md, numbers.csv, claims.csv, and of each figure SVG, PNG and the CSV of its curves.
    ///
    /// # Errors
    /// [`PaperError::Output`] with the file and the reason, [`PaperError::Picture`] with the figure; no file has changed then.
    pub fn write(&self, folder: &Folder) -> Result<(), PaperError> {
        let as_text = |name: &str, bytes: Result<Vec<u8>, csv::Error>| {
            let failed =
                |error: csv::Error| OutputError::writing(Path::new(name), error.to_string());
            Ok::<_, OutputError>(NewFile::of(name, bytes.map_err(failed)?))
        };
        let mut files = vec![
            NewFile::of("report.md", self.report()),
            as_text("numbers.csv", csv_file::numbers(&self.numbers))?,
            as_text("claims.csv", csv_file::claims(&self.figures))?,
        ];
        for redrawn in &self.figures {
            let name = redrawn.name;
            let failed = |source| PaperError::Picture { name, source };
            let svg = to_svg(&redrawn.figure).map_err(failed)?;
            let png = to_png(&redrawn.figure, SCALE).map_err(failed)?;
            files.push(NewFile::of(format!("{name}.svg"), svg));
            files.push(NewFile::of(format!("{name}.png"), png));
            files.push(as_text(&format!("{name}.csv"), csv_file::curves(redrawn))?);
        }
        Ok(folder.write(files)?)
    }
}
