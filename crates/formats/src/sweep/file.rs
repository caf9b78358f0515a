//! The sweep file: HDF5, as `data-schema/sweep.md` writes it down.

use super::axis::{Axis, Column, Values};
use super::blocks::Blocks;
use super::columns::{Columns, Failures, What};
use super::fields::Fields;
use super::schema;
use super::spec::Spec;
use crate::hdf::{
    attach_all, attach_scale, new_file, numbers, reason, set_scale, some_at_a_time, text, texts,
};
use crate::results::schema::COORDINATES;
use contact::{Choice, Model};
use hdf5::{Dataset, File, Group};
use output::{Existing, Fault, Output, OutputError, Staged};
use std::path::Path;

/// Name, unit and meaning.
type Described<'a> = (&'a str, &'static str, &'a str);

/// Writes the results of a sweep whose blocks are all there, in order.
///
/// # Errors
/// [`OutputError`].
pub fn write_sweep(
    path: &Path,
    spec: &Spec,
    blocks: &(impl Blocks + ?Sized),
    existing: Existing,
) -> Result<(), OutputError> {
    let output = Output::claim(path, existing)?;
    stage_sweep(&output, spec, blocks)?.commit()
}

/// The same into an output that was claimed before the work, under its name when it is committed.
///
/// No more than a block is in memory, and the bytes do not depend on how rows are divided into blocks.
///
/// # Errors
/// [`OutputError`].
pub fn stage_sweep<'a>(
    output: &'a Output,
    spec: &Spec,
    blocks: &(impl Blocks + ?Sized),
) -> Result<Staged<'a>, OutputError> {
    output.stage(|part| {
        let mut columns = Columns::new(spec);
        let mut make =
            |what: What, group: &Group, described: &(&str, &str, &str), shape: &[usize]| {
                columns.add(what, group, described, shape)
            };
        let file = begin(part, spec, &mut make).map_err(|error| reason(&error))?;
        let failures = columns.fill(part, &(0..spec.rows()), blocks)?;
        finish(file, &failures).map_err(|error| Fault::from(reason(&error)))
    })
}

/// Makes the dataset of a column in a group, by its name, unit and meaning, of a shape.
type Make<'m> =
    dyn FnMut(What, &Group, &(&str, &str, &str), &[usize]) -> Result<Dataset, hdf5::Error> + 'm;

/// Everything but the rows.
pub(super) fn begin(path: &Path, spec: &Spec, make: &mut Make<'_>) -> Result<File, hdf5::Error> {
    let file = new_file().create(path)?;
    let sha256 = spec.sha256();
    let values = [
        schema::FILE_TYPE,
        schema::version(&spec.fields),
        env!("CARGO_PKG_VERSION"),
        &spec.resolved,
        &sha256,
    ];
    for (name, value) in schema::TEXTS.into_iter().zip(values) {
        text(&file, name, value)?;
    }
    count(&file, schema::ROWS, spec.rows())?;
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
    for (described, what) in results(&spec.fields) {
        let dataset = make(what, &group, &described, &shape)?;
        if let What::Model = what {
            text(&dataset, schema::NAMES, &models())?;
        }
        attach(&dataset)?;
    }
    Ok(file)
}

/// What is known once all rows are written.
pub(super) fn finish(file: File, failures: &Failures) -> Result<(), hdf5::Error> {
    count(&file, schema::FAILED, failures.failed)?;
    let reasons = texts(&file, &schema::FAILURES, &failures.reasons)?;
    set_scale(&reasons, schema::FAILURES.0)?;
    file.flush()?;
    file.close()
}

/// A count of the root.
pub(super) fn count(file: &File, name: &str, count: usize) -> Result<(), hdf5::Error> {
    let attribute = file.new_attr::<u64>().create(name)?;
    attribute.write_scalar(&(count as u64))
}

/// The columns of results, in the order of the file.
pub(super) fn results(fields: &Fields) -> impl Iterator<Item = (Described<'_>, What)> {
    let numbers = fields.quantities().map(|(k, quantity)| {
        let described = (quantity.name, quantity.unit, quantity.meaning);
        (described, What::Number(k))
    });
    let rest = [
        (schema::MODEL, What::Model),
        (schema::FAILURE, What::Failure),
    ];
    numbers.chain(rest)
}

/// The models by their indices, divided by blanks.
pub(super) fn models() -> String {
    let names: Vec<&str> = Model::ALL.iter().map(|m| m.name()).collect();
    names.join(" ")
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
        let described = (axis.name.as_str(), "1", schema::NUMBERED);
        let along = some_at_a_time(group, &described, axis.len, |i| i as i64)?;
        set_scale(&along, described.0)?;
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
        Values::Drawn(drawn) => some_at_a_time(group, &described, drawn.len(), |i| drawn.at(i)),
    }
}

/// The unit that a scene key carries in its name.
pub(super) fn unit(key: &str) -> &'static str {
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
