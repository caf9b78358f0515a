//! Numbers and curves as CSV.

use crate::claim::Claim;
use crate::figures::Redrawn;
use crate::numbers::Numbers;
use csv::{Error, Writer};
use figure::Layer;

/// The rows of all sections.
pub(crate) fn numbers(numbers: &Numbers) -> Result<Vec<u8>, Error> {
    let mut writer = Writer::from_writer(Vec::new());
    let header = [
        "section",
        "place",
        "what",
        "unit",
        "paper",
        "here",
        "relative_difference",
        "why",
    ];
    writer.write_record(header)?;
    for section in &numbers.sections {
        for row in &section.rows {
            let number = |x: f64| x.to_string();
            writer.write_record([
                section.title,
                row.place,
                row.what,
                row.unit,
                &number(row.paper),
                &number(row.here),
                &number(row.difference()),
                row.why,
            ])?;
        }
    }
    finished(writer)
}

/// What the text says of the figures.
pub(crate) fn claims(figures: &[Redrawn]) -> Result<Vec<u8>, Error> {
    let mut writer = Writer::from_writer(Vec::new());
    writer.write_record(["figure", "says", "holds", "found"])?;
    for figure in figures {
        for Claim { says, found, holds } in &figure.claims {
            writer.write_record([figure.name, says, &holds.to_string(), found])?;
        }
    }
    finished(writer)
}

/// The curves of a figure: times in s, lengths in m, forces in N, speeds in m/s.
pub(crate) fn curves(redrawn: &Redrawn) -> Result<Vec<u8>, Error> {
    let mut writer = Writer::from_writer(Vec::new());
    writer.write_record(["abscissa", "ordinate", "curve", "x", "y"])?;
    for panel in &redrawn.figure.panels {
        for layer in &panel.layers {
            let (name, points) = match layer {
                Layer::Line(line) => (line.name.as_str(), line.points.clone()),
                Layer::Point(point) => ("printed in the paper", vec![(point.x, point.y)]),
                Layer::Band(_)
                | Layer::Classes(_)
                | Layer::Histogram(_)
                | Layer::Image(_)
                | Layer::Mark(_) => continue,
            };
            for (x, y) in points {
                let (abscissa, ordinate) = (&panel.x.quantity, &panel.y.quantity);
                writer.write_record([abscissa, ordinate, name, &x.to_string(), &y.to_string()])?;
            }
        }
    }
    finished(writer)
}

fn finished(writer: Writer<Vec<u8>>) -> Result<Vec<u8>, Error> {
    writer
        .into_inner()
        .map_err(|error| error.into_error().into())
}
