//! The files of a report, each a name and its bytes: tables as CSV, figures as SVG and PNG.

use fault::AnyError;
use figure::{Figure, FigureError, to_png, to_svg};

/// Pixels of a PNG for each of the SVG's.
const SCALE: f32 = 1.5;

/// A table as CSV.
///
/// # Errors
/// None for as many columns as a row has.
pub fn csv_file<const N: usize>(
    name: &str,
    columns: &str,
    rows: impl IntoIterator<Item = [String; N]>,
) -> Result<(String, Vec<u8>), AnyError> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(columns.split(' '))?;
    for row in rows {
        writer.write_record(row)?;
    }
    let bytes = writer.into_inner();
    Ok((
        name.to_owned(),
        bytes.map_err(csv::IntoInnerError::into_error)?,
    ))
}

/// A figure as SVG and as PNG.
///
/// # Errors
/// [`FigureError`] for a figure that cannot be drawn.
pub fn drawn(name: &str, figure: &Figure) -> Result<[(String, Vec<u8>); 2], FigureError> {
    let (svg, png) = (to_svg(figure)?, to_png(figure, SCALE)?);
    Ok([
        (format!("{name}.svg"), svg.into_bytes()),
        (format!("{name}.png"), png),
    ])
}
