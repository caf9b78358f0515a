//! The files of a report: tables as CSV, figures as SVG and PNG.

use figure::{Figure, FigureError, to_png, to_svg};
use output::{NewFile, OutputError};
use std::path::Path;

/// Pixels of a PNG for each of the SVG's.
const SCALE: f32 = 1.5;

/// A table as CSV.
///
/// # Errors
/// With the name of the file.
pub fn csv_file<const N: usize>(
    name: &str,
    columns: &str,
    rows: impl IntoIterator<Item = [String; N]>,
) -> Result<NewFile<'static>, OutputError> {
    let write = || {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(columns.split(' '))?;
        for row in rows {
            writer.write_record(row)?;
        }
        let flushed = writer.into_inner();
        flushed.map_err(|error| csv::Error::from(error.into_error()))
    };
    let failed = |error: csv::Error| OutputError::writing(Path::new(name), error.to_string());
    Ok(NewFile::of(name, write().map_err(failed)?))
}

/// A figure as SVG and as PNG.
///
/// # Errors
/// [`FigureError`] for a figure that cannot be drawn.
pub fn drawn(name: &str, figure: &Figure) -> Result<[NewFile<'static>; 2], FigureError> {
    let png = to_png(figure, SCALE)?;
    Ok([
        NewFile::of(format!("{name}.svg"), to_svg(figure)?),
        NewFile::of(format!("{name}.png"), png),
    ])
}
