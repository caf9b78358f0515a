//! The sweep file: HDF5, as `data-schema/sweep.md` writes it down.

use super::axis::{Axis, Column, Values};
use super::block::Block;
use super::schema;
use super::spec::Spec;
use crate::hdf::{
    attach_all, attach_scale, new_file, numbers, reason, scale, set_scale, text, texts,
};
use crate::quantities::QUANTITIES;
use crate::results::schema::COORDINATES;
use contact::{Choice, Model};
use hdf5::{Dataset, File, Group};
use output::{Existing, Output, OutputError, Staged};
use std::collections::HashMap;
use std::path::Path;

/// Writes the results of a sweep whose blocks are all there, in order.
///
/// # Errors
/// [`OutputError`].
pub fn write_sweep(
    path: &Path,
    spec: &Spec,
    blocks: &[Block],
    existing: Existing,
) -> Result<(), OutputError> {
    let output = Output::claim(path, existing)?;
    stage_sweep(&output, spec, blocks)?.commit()
}

/// The same into an output that was claimed before the work, under its name when it is committed.
///
/// # Errors
/// [`OutputError`].
pub fn stage_sweep<'a>(
    output: &'a Output,
    spec: &Spec,
    blocks: &[Block],
) -> Result<Staged<'a>, OutputError> {
    output.stage(|part| write_file(part, spec, blocks).map_err(|error| reason(&error)))
}

fn write_file(path: &Path, spec: &Spec, blocks: &[Block]) -> Result<(), hdf5::Error> {
    let file = new_file().create(path)?;
    let values = [
        schema::FILE_TYPE,
        schema::FORMAT_VERSION,
        env!("CARGO_PKG_VERSION"),
        &spec.resolved,
    ];
    for (name, value) in schema::TEXTS.into_iter().zip(values) {
        text(&file, name, value)?;
    }
    let failed: usize = blocks.iter().map(|block| block.failures.len()).sum();
    for (name, count) in schema::COUNTS.into_iter().zip([spec.rows(), failed]) {
        file.new_attr::<u64>()
            .create(name)?
            .write_scalar(&(count as u64))?;
    }
    write_axes(&file, &spec.axes)?;
    let shape: Vec<usize> = spec.axes.iter().map(|axis| axis.len).collect();
    let group = file.create_group(schema::RESULTS)?;
    let Scales { scales, beside } = write_scales(&group, &spec.axes)?;
    let scales: Vec<&Dataset> = scales.iter().collect();
    let attach = |dataset: &Dataset| -> Result<(), hdf5::Error> {
        attach_all(dataset, &scales, 0)?;
        if beside.is_empty() {
            return Ok(());
        }
        text(dataset, COORDINATES, &beside.join(" "))
    };
    for (k, quantity) in QUANTITIES.iter().enumerate() {
        let column: Vec<f64> = blocks
            .iter()
            .flat_map(|block| block.numbers.iter().map(|row| row[k]))
            .collect();
        let described = (quantity.name, quantity.unit, quantity.meaning);
        attach(&numbers(&group, &described, &shape, &column)?)?;
    }
    let models: Vec<u8> = blocks
        .iter()
        .flat_map(|block| block.models.iter().copied())
        .collect();
    let dataset = numbers(&group, &schema::MODEL, &shape, &models)?;
    let names: Vec<&str> = Model::ALL.iter().map(|m| m.name()).collect();
    text(&dataset, "names", &names.join(" "))?;
    attach(&dataset)?;
    let (indices, reasons) = failures(spec.rows(), blocks);
    attach(&numbers(&group, &schema::FAILURE, &shape, &indices)?)?;
    let failures = texts(&file, &schema::FAILURES, &reasons)?;
    set_scale(&failures, schema::FAILURES.0)?;
    file.flush()?;
    file.close()
}

/// The keys that vary, each with the axis that it belongs to.
fn write_axes(file: &File, axes: &[Axis]) -> Result<(), hdf5::Error> {
    let group = file.create_group(schema::AXES)?;
    for axis in axes {
        for column in &axis.columns {
            let dataset = write_column(&group, column)?;
            set_scale(&dataset, &column.name())?;
            text(&dataset, "axis", &axis.name)?;
        }
    }
    Ok(())
}

/// The scales of the results.
struct Scales {
    /// One a dimension.
    scales: Vec<Dataset>,
    /// Names of the keys that vary along a dimension with others.
    beside: Vec<String>,
}

/// One scale for each dimension beside the results: a group is opened by itself.
///
/// Of keys that vary together the scale is their number, and each of them a list over it.
fn write_scales(group: &Group, axes: &[Axis]) -> Result<Scales, hdf5::Error> {
    let mut found = Scales {
        scales: Vec::new(),
        beside: Vec::new(),
    };
    for axis in axes {
        if let [only] = axis.columns.as_slice()
            && only.name() == axis.name
        {
            let dataset = write_column(group, only)?;
            set_scale(&dataset, &axis.name)?;
            found.scales.push(dataset);
            continue;
        }
        let numbered: Vec<i64> = (0..axis.len as i64).collect();
        let described = (axis.name.as_str(), "1", schema::NUMBERED);
        let along = scale(group, &described, &numbered)?;
        for column in &axis.columns {
            attach_scale(&write_column(group, column)?, &along, 0)?;
            found.beside.push(column.name());
        }
        found.scales.push(along);
    }
    Ok(found)
}

fn write_column(group: &Group, column: &Column) -> Result<Dataset, hdf5::Error> {
    let name = column.name();
    let meaning = format!("scene key {name}");
    let described = (name.as_str(), unit(&column.key), meaning.as_str());
    match &column.values {
        Values::Numbers(values) => numbers(group, &described, &[values.len()], values),
        Values::Texts(values) => texts(group, &described, values),
    }
}

/// The unit that a scene key carries in its name.
fn unit(key: &str) -> &'static str {
    const UNITS: [(&str, &str); 6] = [
        ("_kg_m3", "kg/m^3"),
        ("_m_s", "m/s"),
        ("_kg", "kg"),
        ("_pa", "Pa"),
        ("_m", "m"),
        ("_s", "s"),
    ];
    UNITS
        .iter()
        .find(|(ending, _)| key.ends_with(ending))
        .map_or("1", |(_, unit)| unit)
}

/// Index of each row's reason, -1 without one, and the distinct reasons.
fn failures(rows: usize, blocks: &[Block]) -> (Vec<i32>, Vec<String>) {
    let mut indices = vec![-1; rows];
    let mut reasons: Vec<String> = Vec::new();
    let mut known: HashMap<&str, i32> = HashMap::new();
    for (row, reason) in blocks.iter().flat_map(|block| &block.failures) {
        let next = reasons.len() as i32;
        let index = *known.entry(reason).or_insert(next);
        if index == next {
            reasons.push(reason.clone());
        }
        indices[*row] = index;
    }
    (indices, reasons)
}
