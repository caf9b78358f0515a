//! Validation of the content of a table: axes, sizes and values, before any of them is used as an index.

use crate::content::{Content, FIELDS, Slice, Verification, centres};
use crate::error::{ContentError, shape, value};
use crate::schema;
use crate::series::stencil::MAX_POINTS;

/// Checks the data that reading and interpolation need: axes, stencil, pulses, and the probes between slices.
pub(crate) fn frame(content: &Content) -> Result<(), ContentError> {
    axis("r", &content.r)?;
    axis("z", &content.z)?;
    for (name, nodes, max) in [
        ("r", &content.r, content.r_max),
        ("z", &content.z, content.z_max),
    ] {
        if !nodes.contains(&max) || centres(nodes, max).is_empty() {
            return Err(value(
                &format!("{name}_max"),
                max,
                "one of the nodes other than 0",
            ));
        }
    }
    if !(1e-4..=1e2).contains(&content.cell_width) {
        return Err(value("cell_width", content.cell_width, "[1e-4, 100]"));
    }
    if content.pulse_lengths.is_empty() {
        return Err(shape("pulse_length", 1, 0));
    }
    ascending("pulse_length", &content.pulse_lengths)?;
    let shortest = content.pulse_lengths[0];
    if shortest <= 0.0 {
        return Err(value("pulse_length[0]", shortest, "(0, inf)"));
    }
    let points = content.stencil_points;
    if !(2..=MAX_POINTS).contains(&points) || points % 2 == 1 {
        return Err(value("stencil_points", points as f64, "2, 4, 6 or 8"));
    }
    for (name, length) in [("r", content.r.len()), ("z", content.z.len())] {
        if length < points {
            return Err(shape(name, points, length));
        }
    }
    between(content)
}

/// Checks the errors measured between slices.
fn between(content: &Content) -> Result<(), ContentError> {
    ascending("between_r", &content.between_r)?;
    ascending("between_z", &content.between_z)?;
    let ratios: Vec<f64> = content.between.iter().map(|b| b.poisson_ratio).collect();
    ascending("between: poisson_ratio", &ratios)?;
    let places = content.between_r.len() * content.between_z.len();
    if places == 0 && !content.between.is_empty() {
        return Err(shape("between_r and between_z", 1, 0));
    }
    content.between.iter().try_for_each(|between| {
        let group = format!("between/{}", schema::slice_name(between.poisson_ratio));
        probes(content, &group, &between.verification, places)
    })
}

/// Checks the slices against the axes and against each other.
pub(crate) fn slices(content: &Content) -> Result<(), ContentError> {
    let Some(first) = content.slices.first() else {
        return Err(shape("slices", 1, 0));
    };
    let ratios: Vec<f64> = content.slices.iter().map(|s| s.poisson_ratio).collect();
    ascending("poisson_ratio", &ratios)?;
    for slice in &content.slices {
        let [own, needed] = [slice, first].map(|slice| size(content, slice));
        same_size(slice.poisson_ratio, own, needed)?;
        fits(content, slice)?;
        finite(content, slice)?;
    }
    Ok(())
}

/// Number of cells and number of tail terms of a slice.
fn size(content: &Content, slice: &Slice) -> [usize; 2] {
    let nodes = content.r.len() * content.z.len();
    [slice.cells, slice.tail_terms(nodes)]
}

/// Checks that the slice of a ratio has `needed` cells and tail terms: slices are interpolated cell by cell and term by
/// term.
pub(crate) fn same_size(
    poisson_ratio: f64,
    size: [usize; 2],
    needed: [usize; 2],
) -> Result<(), ContentError> {
    let names = [schema::TIME, schema::TERM];
    for ((name, found), needed) in names.into_iter().zip(size).zip(needed) {
        if found != needed.max(1) {
            let item = format!("{}/{name}", group(poisson_ratio));
            return Err(shape(&item, needed.max(1), found));
        }
    }
    Ok(())
}

/// Path of the group that contains the slice of a ratio.
pub(crate) fn group(poisson_ratio: f64) -> String {
    format!("slices/{}", schema::slice_name(poisson_ratio))
}

/// Checks the lengths of the lists of a slice, and its measured errors.
fn fits(content: &Content, slice: &Slice) -> Result<(), ContentError> {
    let group = group(slice.poisson_ratio);
    let nodes = content.r.len() * content.z.len();
    let [cells, terms] = size(content, slice);
    for ((dataset, list), each) in slice.lists().into_iter().zip([cells, cells, cells, terms]) {
        let needed = product(&[nodes, FIELDS, each]);
        if list.len() != needed {
            let item = format!("{group}/{dataset}");
            return Err(shape(&item, needed, list.len()));
        }
    }
    let places = content.probes().map(|places| places.len()).iter().product();
    probes(content, &group, &slice.verification, places)
}

/// Checks that the numbers of a slice are finite.
fn finite(content: &Content, slice: &Slice) -> Result<(), ContentError> {
    let nodes = content.r.len() * content.z.len();
    for (dataset, list) in slice.lists() {
        if let Some(bad) = list.iter().position(|x| !x.is_finite()) {
            let node = bad / (list.len() / nodes);
            let (i, k) = (node / content.z.len(), node % content.z.len());
            let place = format!("(r/r0 = {}, z/r0 = {})", content.r[i], content.z[k]);
            let item = format!("{}/{dataset} {place}", group(slice.poisson_ratio));
            return Err(value(&item, f64::from(list[bad]), "finite numbers"));
        }
    }
    Ok(())
}

/// Checks the errors measured at a number of places.
pub(crate) fn probes(
    content: &Content,
    group: &str,
    probes: &Verification,
    places: usize,
) -> Result<(), ContentError> {
    let needed = product(&[places, content.pulse_lengths.len(), FIELDS]);
    for (dataset, array) in probes.lists() {
        let (least, range) = match dataset {
            schema::PROBE_ERROR => (0.0, "[0, inf)"),
            _ => (f32::MIN, "finite numbers"),
        };
        let name = format!("{group}/{dataset}");
        if array.len() != needed {
            return Err(shape(&name, needed, array.len()));
        }
        let bad = |x: &f32| !x.is_finite() || *x < least;
        if let Some(index) = array.iter().position(bad) {
            let item = format!("{name}[{index}]");
            return Err(value(&item, f64::from(array[index]), range));
        }
    }
    Ok(())
}

/// The product, or the largest integer if it overflows.
pub(crate) fn product(factors: &[usize]) -> usize {
    factors.iter().fold(1, |all, &x| all.saturating_mul(x))
}

fn axis(name: &'static str, nodes: &[f64]) -> Result<(), ContentError> {
    ascending(name, nodes)?;
    match nodes.first() {
        Some(&first) if first != 0.0 => Err(value(&format!("{name}[0]"), first, "0")),
        Some(_) | None => Ok(()),
    }
}

/// Checks that the values are finite and ascend strictly.
pub(crate) fn ascending(name: &'static str, values: &[f64]) -> Result<(), ContentError> {
    for (index, &x) in values.iter().enumerate() {
        if !x.is_finite() || index > 0 && x <= values[index - 1] {
            let range = "finite, strictly ascending";
            return Err(value(&format!("{name}[{index}]"), x, range));
        }
    }
    Ok(())
}
