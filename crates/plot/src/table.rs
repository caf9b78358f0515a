//! The error map of a kernel table.

use crate::error::{PlotError, chosen};
use crate::request::Request;
use crate::words::{digits, of_quantity, stem};
use figure::{Axis, ColourMap, Figure, Image, Layer, Panel, Sharing};
use formats::quantities::Described;
use formats::quantities::FIELDS;
use lookup::{Content, Slice};
use std::path::Path;

/// Poisson's ratio of the shown slice; the nearest slice is shown.
const RATIO: f64 = 0.3;

/// Errors of a table between its grid points, one panel per length of the verification pulse.
///
/// An error is the largest difference over time relative to the largest exact response over time, at each place for the
/// worst of the requested fields.
pub(crate) fn of_table(path: &Path, request: &Request) -> Result<Figure, PlotError> {
    let content = lookup::read(path)?;
    let (known, all) = (FIELDS.map(Described::from), FIELDS.map(|field| field.0));
    let fields = chosen(path, &known, &request.quantities, &all)?;
    let distance = |slice: &&Slice| (slice.poisson_ratio - RATIO).abs();
    let slice = content
        .slices
        .iter()
        .min_by(|a, b| distance(a).total_cmp(&distance(b)))
        .ok_or_else(|| PlotError::NoSlice(path.to_owned()))?;
    let what = match fields.as_slice() {
        [one] => of_quantity(FIELDS[*one].0),
        _ => "worst field".to_owned(),
    };
    let colours = Axis::logarithmic(&format!("relative error, {what}"));
    let title = format!("Errors of the kernel table {}", stem(path));
    let subtitle = format!(
        "Poisson's ratio {}, at the centres of the grid cells, by pulse length",
        digits(slice.poisson_ratio)
    );
    let pulses = 0..content.pulse_lengths.len();
    let columns = pulses.len().clamp(1, 3);
    let panels = pulses.map(|pulse| panel(&content, slice, pulse, &fields, &colours));
    let mut figure = request.figure(&title, &subtitle, columns).panels(panels);
    figure.has_common_bar = true;
    Ok(figure.width(1040.0).sharing(Sharing::Both))
}

fn panel(
    content: &Content,
    slice: &Slice,
    pulse: usize,
    fields: &[usize],
    colours: &Axis,
) -> Panel {
    let [r, z] = content.probes();
    let pulses = content.pulse_lengths.len();
    let measured = &slice.verification;
    let error = |i: usize, k: usize| {
        let place = ((i * z.len() + k) * pulses + pulse) * FIELDS.len();
        let of = |field: &usize| {
            let error = measured.error.get(place + field)?;
            let exact = measured.direct.get(place + field)?;
            // a field that is zero throughout has no relative error
            (*exact != 0.0).then(|| f64::from(*error) / f64::from(exact.abs()))
        };
        fields.iter().filter_map(of).fold(f64::NAN, f64::max)
    };
    let mut values = Vec::with_capacity(r.len() * z.len());
    for k in 0..z.len() {
        values.extend((0..r.len()).map(|i| error(i, k)));
    }
    let axis = |name, end| Axis::linear(name).unit("r_{0}").range(0.0, end);
    let distance = axis("distance from the axis", content.r_max);
    let length = digits(content.pulse_lengths[pulse]);
    Panel::new(distance, axis("depth", content.z_max).reversed())
        .title(&format!("pulse of {length} r_{{0}}/c_{{1}}"))
        .height(280.0)
        .layer(Layer::Image(Image {
            has_cells: true,
            ..Image::new(r, z, values, colours.clone(), ColourMap::Sequential)
        }))
}
