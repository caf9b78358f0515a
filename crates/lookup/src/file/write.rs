//! Content to file.

use super::datasets::{self, Described};
use super::error::{BadTable, TableError};
use super::labels::{attach_scale, new_file, reason, set_scale, text};
use crate::accuracy::Quantiles;
use crate::content::{Content, FIELDS, Slice, Verification};
use crate::hash::{content_hash, settings_id};
use crate::ratio::cell_scale;
use crate::schema;
use hdf5::types::FixedAscii;
use hdf5::{Dataset, File, Group, H5Type};
use std::path::Path;

/// Compression level: higher ones gain a few per cent and cost several times the time.
const DEFLATE: u8 = 2;
/// Nodes in r and in z that share a chunk, all their times and fields with them.
const PATCH: usize = 8;

/// Writes `content` to `path`, replacing what is there, and seals it.
///
/// The bytes depend on the content and the creation time alone.
///
/// # Errors
/// [`BadTable::Unwritable`] with what the system or the HDF5 library says.
pub fn write(path: &Path, content: &Content) -> Result<(), TableError> {
    let failed = |detail: String| BadTable::Unwritable(detail).of(path);
    write_file(path, content).map_err(|error| failed(reason(&error)))?;
    ledger::seal(path).map_err(|error| failed(error.to_string()))
}

fn write_file(path: &Path, content: &Content) -> Result<(), hdf5::Error> {
    let file = new_file().create(path)?;
    write_attributes(&file, content)?;
    let scale = |described: &Described, values: &[f64]| make_scale(&file, described, values);
    let [probe_r, probe_z] = content.probes();
    let probe_r = scale(&datasets::PROBE_R, &probe_r)?;
    let probe_z = scale(&datasets::PROBE_Z, &probe_z)?;
    let pulse = scale(&datasets::PULSE_LENGTH, &content.pulse_lengths)?;
    let names =
        schema::FIELD_NAMES.map(|name| FixedAscii::<16>::from_ascii(name).unwrap_or_default());
    let field = make_scale(&file, &datasets::FIELD, &names)?;
    let r = scale(&datasets::R, &content.r)?;
    let z = scale(&datasets::Z, &content.z)?;
    let nodes = content.r.len() * content.z.len();
    let terms = content
        .slices
        .first()
        .map_or(0, |slice| slice.tail_terms(nodes));
    let orders: Vec<f64> = (0..terms).map(|k| k as f64).collect();
    let term = scale(&datasets::TERM, &orders)?;
    let axes = Axes {
        at_nodes: [&r, &z, &field, &term],
        at_probes: [&probe_r, &probe_z, &pulse, &field],
    };
    let slices = file.create_group(schema::SLICES)?;
    for slice in &content.slices {
        let group = slices.create_group(&schema::slice_name(slice.poisson_ratio))?;
        write_slice(&group, content, slice, &axes)?;
    }
    let between_r = scale(&datasets::BETWEEN_R, &content.between_r)?;
    let between_z = scale(&datasets::BETWEEN_Z, &content.between_z)?;
    let between = file.create_group(schema::BETWEEN)?;
    for place in &content.between {
        let group = between.create_group(&schema::slice_name(place.poisson_ratio))?;
        number(&group, schema::POISSON_RATIO, place.poisson_ratio)?;
        let scales = [&between_r, &between_z, &pulse, &field];
        write_verification(&group, &place.verification, &scales)?;
    }
    file.flush()?;
    file.close()
}

/// Scales that slices share.
struct Axes<'a> {
    /// r, z, field, term.
    at_nodes: [&'a Dataset; 4],
    /// r, z, pulse, field of the probes.
    at_probes: [&'a Dataset; 4],
}

fn write_slice(
    group: &Group,
    content: &Content,
    slice: &Slice,
    axes: &Axes<'_>,
) -> Result<(), hdf5::Error> {
    // The ratio of a slice was accepted by the physics.
    let scale = cell_scale(slice.poisson_ratio).map_err(|error| error.to_string())?;
    let width = content.cell_width * scale;
    number(group, schema::POISSON_RATIO, slice.poisson_ratio)?;
    text(group, schema::ROLE, slice.role.name())?;
    number(group, schema::CELL_WIDTH, width)?;
    number(group, schema::TIME_END, slice.cells as f64 * width)?;
    let starts: Vec<f64> = (0..slice.cells).map(|j| j as f64 * width).collect();
    let time = make_scale(group, &datasets::TIME, &starts)?;
    let (rows, columns) = (content.r.len(), content.z.len());
    let [r, z, field, term] = axes.at_nodes;
    let shape = [rows, columns, FIELDS, slice.cells];
    for (described, values) in [
        (&datasets::REMAINDER, &slice.remainder),
        (&datasets::MOMENT, &slice.moment),
        (&datasets::CURVATURE, &slice.curvature),
    ] {
        make_data(group, described, &shape, values, &[r, z, field, &time])?;
    }
    let shape = [rows, columns, FIELDS, slice.tail_terms(rows * columns)];
    make_data(
        group,
        &datasets::TAIL,
        &shape,
        &slice.tail,
        &[r, z, field, term],
    )?;
    write_verification(group, &slice.verification, &axes.at_probes)
}

fn number(place: &Group, name: &str, value: f64) -> Result<(), hdf5::Error> {
    place.new_attr::<f64>().create(name)?.write_scalar(&value)
}

fn write_verification(
    group: &Group,
    probes: &Verification,
    scales: &[&Dataset; 4],
) -> Result<(), hdf5::Error> {
    let shape = scales.map(|scale| scale.size());
    for (described, values) in [
        (&datasets::PROBE_DIRECT, &probes.direct),
        (&datasets::PROBE_LOOKED_UP, &probes.looked_up),
        (&datasets::PROBE_ERROR, &probes.error),
    ] {
        make_data(group, described, &shape, values, scales)?;
    }
    Ok(())
}

fn write_attributes(file: &File, content: &Content) -> Result<(), hdf5::Error> {
    let origin = &content.origin;
    text(file, schema::FILE_TYPE, schema::FILE_TYPE_VALUE)?;
    text(file, schema::FORMAT_VERSION, schema::FORMAT_VERSION_VALUE)?;
    text(file, schema::SOFTWARE_VERSION, &origin.software_version)?;
    text(file, schema::GIT_REVISION, &origin.git_revision)?;
    for (name, value) in [
        (schema::NUMBERS_REVISION, origin.numbers_revision),
        (schema::CREATED, origin.created_unix_s),
        (schema::STENCIL_POINTS, content.stencil_points as u64),
    ] {
        file.new_attr::<u64>().create(name)?.write_scalar(&value)?;
    }
    text(file, schema::ID, &settings_id(&origin.grid))?;
    text(file, schema::GRID, &origin.grid)?;
    text(file, schema::CONTENT_SHA256, &content_hash(content))?;
    for (name, value) in [
        (schema::CELL_WIDTH, content.cell_width),
        (schema::R_MAX, content.r_max),
        (schema::Z_MAX, content.z_max),
        (schema::ACCURACY_ASKED, origin.accuracy_asked),
    ] {
        number(file, name, value)?;
    }
    let reached = &origin.accuracy_reached;
    file.new_attr::<f64>()
        .shape([reached.len()])
        .create(schema::ACCURACY_REACHED)?
        .write(reached)?;
    let accuracy = content.accuracy();
    let on: Vec<_> = accuracy.iter().map(|a| a.on_slices).collect();
    write_errors(file, schema::ERROR_ON_SLICES, &on)?;
    let between: Vec<_> = accuracy.iter().filter_map(|a| a.between_slices).collect();
    if between.is_empty() {
        return Ok(());
    }
    write_errors(file, schema::ERROR_BETWEEN_SLICES, &between)
}

/// Quantiles of relative errors, shape (pulse, field, quantile).
fn write_errors(file: &File, name: &str, errors: &[[Quantiles; 6]]) -> Result<(), hdf5::Error> {
    let numbers: Vec<f64> = errors
        .iter()
        .flatten()
        .flat_map(|of_field| [of_field.p50, of_field.p99, of_field.max])
        .collect();
    file.new_attr::<f64>()
        .shape([errors.len(), FIELDS, 3])
        .create(name)?
        .write_raw(&numbers)
}

fn make_scale<T: H5Type>(
    group: &Group,
    described: &Described,
    values: &[T],
) -> Result<Dataset, hdf5::Error> {
    let dataset = group
        .new_dataset::<T>()
        .shape([values.len()])
        .obj_track_times(false)
        .create(described.name)?;
    dataset.write_raw(values)?;
    set_scale(&dataset, described.name)?;
    describe(&dataset, described)?;
    Ok(dataset)
}

fn make_data(
    group: &Group,
    described: &Described,
    shape: &[usize; 4],
    values: &[f32],
    scales: &[&Dataset],
) -> Result<(), hdf5::Error> {
    let [rows, columns, third, fourth] = *shape;
    let dataset = group
        .new_dataset::<f32>()
        .shape(shape)
        .chunk((rows.min(PATCH), columns.min(PATCH), third, fourth))
        .shuffle()
        .deflate(DEFLATE)
        .fletcher32()
        .obj_track_times(false)
        .create(described.name)?;
    let view = ndarray::ArrayView4::from_shape(*shape, values)?;
    dataset.write(view)?;
    for (index, scale) in scales.iter().enumerate() {
        attach_scale(&dataset, scale, index)?;
    }
    describe(&dataset, described)
}

fn describe(dataset: &Dataset, described: &Described) -> Result<(), hdf5::Error> {
    text(dataset, schema::UNITS, described.units)?;
    text(dataset, schema::LONG_NAME, described.long_name)
}
