//! The folder of a chart: rows, pictures, report.

use crate::StudyError;
use crate::chart::Chart;
use crate::files::whole;
use crate::picture::Picture;
use crate::{csv_file, hdf_file, report};
use figure::{svg_to_png, to_svg};
use std::path::Path;

/// Pixels of a PNG for each of the SVG's.
const SCALE: f32 = 1.5;

impl Chart {
    /// Writes chart.csv, chart.h5, report.md and the pictures into a folder.
    ///
    /// # Errors
    /// [`StudyError::Unwritable`] with the file and the reason, [`StudyError::Picture`] with the picture.
    pub fn write(&self, folder: &Path) -> Result<(), StudyError> {
        csv_file::write(&folder.join("chart.csv"), &self.records)?;
        hdf_file::write(&folder.join("chart.h5"), self)?;
        for picture in self.diagrams.iter().chain(&self.maps) {
            draw(folder, picture)?;
        }
        let text = report::markdown(self);
        whole(&folder.join("report.md"), |part| {
            std::fs::write(part, text).map_err(|e| e.to_string())
        })
    }
}

/// Draws a picture as SVG and as PNG.
fn draw(folder: &Path, picture: &Picture) -> Result<(), StudyError> {
    let failed = |source| StudyError::Picture {
        name: picture.name,
        source,
    };
    let svg = to_svg(&picture.figure()).map_err(failed)?;
    let png = svg_to_png(&svg, SCALE).map_err(failed)?;
    for (ending, bytes) in [("svg", svg.as_bytes()), ("png", &png)] {
        whole(&folder.join(format!("{}.{ending}", picture.name)), |part| {
            std::fs::write(part, bytes).map_err(|e| e.to_string())
        })?;
    }
    Ok(())
}
