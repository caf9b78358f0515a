//! Writing: from content to file.

use super::chunks::write_chunks;
use super::error::{BadTable, TableError};
use super::labels::{array, attach_scales, scalar, set_scale, text};
use super::new::{new_file, reason};
use crate::accuracy::Quantiles;
use crate::content::{Content, FIELDS, Slice, Verification};
use crate::hash::{content_hash, settings_id};
use crate::ratio::cell_scale;
use crate::schema;
use hdf5::types::FixedAscii;
use hdf5::{Dataset, File, Group, H5Type};
use std::path::Path;

/// Compression level; higher levels save a few per cent of the size and take several times as long.
const DEFLATE: u8 = 2;
/// Number of nodes in r and in z that share a chunk, with all their times and fields.
const PATCH: usize = 8;

/// Writes `content` to a new file at `path` and seals it; returns its handle.
///
/// The bytes depend only on the content and the creation time.
///
/// # Errors
/// [`BadTable::Unwritable`] with the message of the system or of the HDF5 library.
pub fn write(path: &Path, content: &Content) -> Result<std::fs::File, TableError> {
    let fill = |file: &File, _: &_| fill(file, content).map_err(|error| reason(&error));
    new_file(path, fill).map_err(|detail| BadTable::Unwritable(detail).of(path))
}

fn fill(file: &File, content: &Content) -> Result<(), hdf5::Error> {
    write_attributes(file, content)?;
    let scale = |name, values: &[f64]| make_scale(file, name, values);
    let [probe_r, probe_z] = content.probes();
    let probe_r = scale(schema::PROBE_R, &probe_r)?;
    let probe_z = scale(schema::PROBE_Z, &probe_z)?;
    let pulse = scale(schema::PULSE_LENGTH, &content.pulse_lengths)?;
    let names =
        schema::FIELD_NAMES.map(|name| FixedAscii::<16>::from_ascii(name).unwrap_or_default());
    let field = make_scale(file, schema::FIELD, &names)?;
    let r = scale(schema::R, &content.r)?;
    let z = scale(schema::Z, &content.z)?;
    let nodes = content.r.len() * content.z.len();
    let first = content.slices.first();
    let terms = first.map_or(0, |slice| slice.tail_terms(nodes));
    let orders: Vec<f64> = (0..terms).map(|k| k as f64).collect();
    let term = scale(schema::TERM, &orders)?;
    let at_nodes = [&r, &z, &field, &term];
    let at_probes = [&probe_r, &probe_z, &pulse, &field];
    let slices = file.create_group(schema::SLICES)?;
    for slice in &content.slices {
        let group = slices.create_group(&schema::slice_name(slice.poisson_ratio))?;
        write_slice(&group, content, slice, [at_nodes, at_probes])?;
    }
    let between_r = scale(schema::BETWEEN_R, &content.between_r)?;
    let between_z = scale(schema::BETWEEN_Z, &content.between_z)?;
    let between = file.create_group(schema::BETWEEN)?;
    for place in &content.between {
        let group = between.create_group(&schema::slice_name(place.poisson_ratio))?;
        scalar(&group, schema::POISSON_RATIO, place.poisson_ratio)?;
        let scales = [&between_r, &between_z, &pulse, &field];
        write_verification(&group, &place.verification, &scales)?;
    }
    Ok(())
}

/// Writes a slice with scales that all slices share: r, z, field and term, and r, z, pulse and field of the probes.
fn write_slice(
    group: &Group,
    content: &Content,
    slice: &Slice,
    [at_nodes, at_probes]: [[&Dataset; 4]; 2],
) -> Result<(), hdf5::Error> {
    // the ratio of a slice was validated before
    let scale = cell_scale(slice.poisson_ratio).map_err(|error| error.to_string())?;
    let width = content.cell_width * scale;
    scalar(group, schema::POISSON_RATIO, slice.poisson_ratio)?;
    text(group, schema::ROLE, slice.role.name())?;
    scalar(group, schema::CELL_WIDTH, width)?;
    scalar(group, schema::TIME_END, slice.cells as f64 * width)?;
    let starts: Vec<f64> = (0..slice.cells).map(|j| j as f64 * width).collect();
    let time = make_scale(group, schema::TIME, &starts)?;
    let (rows, columns) = (content.r.len(), content.z.len());
    let [r, z, field, term] = at_nodes;
    for (name, values) in slice.lists() {
        let (last, scale) = match name {
            schema::TAIL => (slice.tail_terms(rows * columns), term),
            _ => (slice.cells, &time),
        };
        let shape = [rows, columns, FIELDS, last];
        make_data(group, name, &shape, values, &[r, z, field, scale])?;
    }
    write_verification(group, &slice.verification, &at_probes)
}

fn write_verification(
    group: &Group,
    probes: &Verification,
    scales: &[&Dataset; 4],
) -> Result<(), hdf5::Error> {
    let shape = scales.map(|scale| scale.size());
    for (name, values) in probes.lists() {
        make_data(group, name, &shape, values, scales)?;
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
        scalar(file, name, value)?;
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
        scalar(file, name, value)?;
    }
    let reached = &origin.accuracy_reached;
    array(file, schema::ACCURACY_REACHED, &[reached.len()], reached)?;
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
    let of_field = |&Quantiles { p50, p99, max }: &Quantiles| [p50, p99, max];
    let numbers: Vec<f64> = errors.iter().flatten().flat_map(of_field).collect();
    array(file, name, &[errors.len(), FIELDS, 3], &numbers)
}

fn make_scale<T: H5Type>(group: &Group, name: &str, values: &[T]) -> Result<Dataset, hdf5::Error> {
    let dataset = group
        .new_dataset::<T>()
        .shape([values.len()])
        .obj_track_times(false)
        .create(name)?;
    dataset.write_raw(values)?;
    set_scale(&dataset, name)?;
    describe(&dataset, name)?;
    Ok(dataset)
}

fn make_data(
    group: &Group,
    name: &str,
    shape: &[usize; 4],
    values: &[f32],
    scales: &[&Dataset],
) -> Result<(), hdf5::Error> {
    let [rows, columns, third, fourth] = *shape;
    let patch = [rows, columns].map(|count| count.min(PATCH));
    let dataset = group
        .new_dataset::<f32>()
        .shape(shape)
        .chunk((patch[0], patch[1], third, fourth))
        .shuffle()
        .deflate(DEFLATE)
        .fletcher32()
        .obj_track_times(false)
        .create(name)?;
    let view = ndarray::ArrayView4::from_shape(*shape, values)?;
    write_chunks(&dataset, &view, patch, DEFLATE)?;
    attach_scales(&dataset, scales)?;
    describe(&dataset, name)
}

fn describe(dataset: &Dataset, name: &str) -> Result<(), hdf5::Error> {
    /// Unit of datasets that contain both displacements and stresses.
    const FIELD_UNITS: &str = "displacement_r, displacement_z: P/(mu r0); stresses: P/r0^2";
    let (units, long_name) = match name {
        schema::R => ("r0", "distance from the axis"),
        schema::Z => ("r0", "depth below the surface"),
        schema::PROBE_R => ("r0", "distance of the verification probes from the axis"),
        schema::PROBE_Z => ("r0", "depth of the verification probes"),
        schema::PULSE_LENGTH => ("r0/c1", "length T of the verification pulse sin^4(pi t/T)"),
        schema::FIELD => ("1", "name of the field"),
        schema::TERM => ("1", "order k of the Chebyshev polynomial"),
        schema::BETWEEN_R => ("r0", "distance of the probes between slices from the axis"),
        schema::BETWEEN_Z => ("r0", "depth of the probes between slices"),
        schema::TIME => ("r0/c1", "start of the time cell"),
        schema::REMAINDER => (
            FIELD_UNITS,
            "average over the time cell of the step response less its static part",
        ),
        schema::MOMENT => (
            FIELD_UNITS,
            "first moment of the remainder about the centre of the time cell, divided by the squared cell width",
        ),
        schema::CURVATURE => (
            FIELD_UNITS,
            "second moment of the remainder about the centre of the time cell less 1/12 of the average, divided by the cubed cell width",
        ),
        schema::TAIL => (
            FIELD_UNITS,
            "coefficients c_k of the remainder u^2 sum c_k T_k(2u - 1), u = time_end/t, after the last cell",
        ),
        schema::PROBE_DIRECT => (
            FIELD_UNITS,
            "peak in time of the exact response to the verification pulse",
        ),
        schema::PROBE_LOOKED_UP => (
            FIELD_UNITS,
            "looked-up response at the instant of the exact peak",
        ),
        schema::PROBE_ERROR => (
            FIELD_UNITS,
            "largest difference in time between the looked-up and the exact response",
        ),
        _ => return Err(hdf5::Error::from("a dataset without a description")),
    };
    text(dataset, schema::UNITS, units)?;
    text(dataset, schema::LONG_NAME, long_name)
}
