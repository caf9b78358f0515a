//! The error map of a kernel table.

use crate::error::PlotError;
use crate::request::{Drawn, Request};
use crate::words::{digits, of_quantity, stem};
use figure::{Axis, ColourMap, Figure, Image, Layer, Panel, Sharing};
use formats::results::schema::FIELDS;
use lookup::{Content, Slice};
use std::path::Path;

/// Poisson's ratio whose slice is shown, unless there is none near it.
const RATIO: f64 = 0.3;

/// Errors off the grid of a table, a panel for each length of the verification pulse.
///
/// An error is the largest difference in time over the largest exact response in time, at each place for the worst of
/// the fields that are asked for.
pub(crate) fn of_table(path: &Path, request: &Request) -> Result<Drawn, PlotError> {
    let content = lookup::read(path)?;
    let fields = fields(path, request)?;
    let distance = |slice: &&Slice| (slice.poisson_ratio - RATIO).abs();
    let slice = content
        .slices
        .iter()
        .min_by(|a, b| distance(a).total_cmp(&distance(b)))
        .ok_or_else(|| {
            let hint = "hertzlamb table verify says what is wrong with it";
            PlotError::absent(path, "slice", hint)
        })?;
    let what = match fields.as_slice() {
        [one] => of_quantity(FIELDS[*one].0),
        _ => "worst field".to_owned(),
    };
    let colours = Axis::logarithmic(&format!("relative error, {what}"));
    let usual = || format!("Errors of the kernel table {}", stem(path));
    let title = request.title.clone().unwrap_or_else(usual);
    let mut figure = Figure::new(&title)
        .subtitle(&format!(
            "Poisson's ratio {}, at the centres of the meshes, by the length of the pulse",
            digits(slice.poisson_ratio)
        ))
        .columns(content.pulse_lengths.len().clamp(1, 3))
        .width(1040.0)
        .sharing(Sharing::Both)
        .common_colour_bar();
    for pulse in 0..content.pulse_lengths.len() {
        figure = figure.panel(panel(&content, slice, pulse, &fields, &colours));
    }
    Ok(Drawn {
        figure,
        notes: Vec::new(),
    })
}

/// Indices of the fields that are asked for; of all without.
fn fields(path: &Path, request: &Request) -> Result<Vec<usize>, PlotError> {
    let find = |name: &String| {
        let mut all = FIELDS.iter().map(|field| field.0);
        let found = all.clone().position(|field| field == name);
        found.ok_or_else(|| PlotError::unknown(path, name, name, &mut all))
    };
    if request.quantities.is_empty() {
        return Ok((0..FIELDS.len()).collect());
    }
    request.quantities.iter().map(find).collect()
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
            // where a field is zero throughout it says nothing
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
