//! The folder of a chart: rows, pictures, report.

use crate::StudyError;
use crate::chart::Chart;
use crate::picture::Picture;
use crate::{csv_file, hdf_file, report};
use figure::{to_png, to_svg};
use output::{Folder, NewFile};

/// Pixels of a PNG for each of the SVG's.
const SCALE: f32 = 1.5;

impl Chart {
    /// Writes chart.csv, chart.h5, report.md and the pictures into a folder.
    ///
    /// # Errors
    /// [`StudyError::Output`] with the file and the reason, [`StudyError::Picture`] with the picture; no file has
    /// changed then.
    pub fn write(&self, folder: &Folder) -> Result<(), StudyError> {
        let mut files = vec![
            NewFile::new("chart.csv", |part| csv_file::write(part, &self.records)),
            NewFile::new("chart.h5", |part| hdf_file::write(part, self)),
        ];
        for picture in self.diagrams.iter().chain(&self.maps) {
            files.extend(draw(picture)?);
        }
        files.push(NewFile::of("report.md", report::markdown(self)));
        Ok(folder.write(files)?)
    }
}

/// A picture as SVG and as PNG.
fn draw(picture: &Picture) -> Result<[NewFile<'static>; 2], StudyError> {
    let failed = |source| StudyError::Picture {
        name: picture.name,
        source,
    };
    let figure = picture.figure();
    let svg = to_svg(&figure).map_err(failed)?;
    let png = to_png(&figure, SCALE).map_err(failed)?;
    let file =
        |ending: &str, bytes: Vec<u8>| NewFile::of(format!("{}.{ending}", picture.name), bytes);
    Ok([file("svg", svg.into_bytes()), file("png", png)])
}
