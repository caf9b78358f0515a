//! Content to file.

use crate::content::{Content, FIELDS, Verification};
use crate::error::TableError;
use crate::file::{self, Described};
use crate::hash::{content_hash, settings_id};
use crate::labels::{attach_scale, set_scale, text};
use crate::ratio::cell_scale;
use crate::read::first_line;
use crate::schema;
use hdf5::types::FixedAscii;
use hdf5::{Dataset, File, Group, H5Type};
use std::path::Path;

/// Compression level: higher ones gain a few per cent and cost several times the time.
const DEFLATE: u8 = 2;
/// Nodes in r and in z that share a chunk, all their times and fields with them.
const PATCH: usize = 8;

/// Writes `content` to `path`, replacing what is there.
///
/// The bytes depend on the content and the creation time alone.
///
/// # Errors
/// [`TableError::Unwritable`] with what the HDF5 library says.
pub fn write(path: &Path, content: &Content) -> Result<(), TableError> {
    write_file(path, content).map_err(|error| TableError::Unwritable {
        path: path.to_owned(),
        detail: detail(&error),
    })
}

/// What the system said, if it did, else the first line of what the library says.
fn detail(error: &hdf5::Error) -> String {
    let frames: Vec<String> = error
        .stack()
        .iter()
        .flat_map(|stack| stack.iter().map(|frame| frame.desc().to_owned()))
        .collect();
    let system = frames
        .iter()
        .find_map(|text| text.split_once("error message = '")?.1.split_once('\''));
    match system {
        Some((message, _)) => message.to_owned(),
        None => first_line(error),
    }
}

fn write_file(path: &Path, content: &Content) -> Result<(), hdf5::Error> {
    let file = File::create(path)?;
    write_attributes(&file, content)?;
    let scale = |described: &Described, values: &[f64]| make_scale(&file, described, values);
    let [probe_r, probe_z] = content.probes();
    let probe_r = scale(&file::PROBE_R, &probe_r)?;
    let probe_z = scale(&file::PROBE_Z, &probe_z)?;
    let pulse = scale(&file::PULSE_LENGTH, &content.pulse_lengths)?;
    let names =
        schema::FIELD_NAMES.map(|name| FixedAscii::<16>::from_ascii(name).unwrap_or_default());
    let field = make_scale(&file, &file::FIELD, &names)?;
    let r = scale(&file::R, &content.r)?;
    let z = scale(&file::Z, &content.z)?;
    let nodes = content.r.len() * content.z.len();
    let terms = content
        .slices
        .first()
        .map_or(0, |slice| slice.tail_terms(nodes));
    let orders: Vec<f64> = (0..terms).map(|k| k as f64).collect();
    let term = scale(&file::TERM, &orders)?;

    let slices = file.create_group(schema::SLICES)?;
    for slice in &content.slices {
        let group = slices.create_group(&schema::slice_name(slice.poisson_ratio))?;
        // The ratio of a slice was accepted by the physics.
        let width = content.cell_width
            * cell_scale(slice.poisson_ratio).map_err(|error| error.to_string())?;
        let end = slice.cells as f64 * width;
        group
            .new_attr::<f64>()
            .create(schema::POISSON_RATIO)?
            .write_scalar(&slice.poisson_ratio)?;
        text(&group, schema::ROLE, slice.role.name())?;
        group
            .new_attr::<f64>()
            .create(schema::CELL_WIDTH)?
            .write_scalar(&width)?;
        group
            .new_attr::<f64>()
            .create(schema::TIME_END)?
            .write_scalar(&end)?;
        let starts: Vec<f64> = (0..slice.cells).map(|j| j as f64 * width).collect();
        let time = make_scale(&group, &file::TIME, &starts)?;
        let (rows, columns) = (content.r.len(), content.z.len());
        let shape = [rows, columns, FIELDS, slice.cells];
        for (described, values) in [
            (&file::REMAINDER, &slice.remainder),
            (&file::MOMENT, &slice.moment),
            (&file::CURVATURE, &slice.curvature),
        ] {
            make_data(&group, described, &shape, values, &[&r, &z, &field, &time])?;
        }
        let shape = [rows, columns, FIELDS, slice.tail_terms(rows * columns)];
        let scales = [&r, &z, &field, &term];
        make_data(&group, &file::TAIL, &shape, &slice.tail, &scales)?;
        let scales = [&probe_r, &probe_z, &pulse, &field];
        write_verification(&group, &slice.verification, &scales)?;
    }
    let between_r = scale(&file::BETWEEN_R, &content.between_r)?;
    let between_z = scale(&file::BETWEEN_Z, &content.between_z)?;
    let between = file.create_group(schema::BETWEEN)?;
    for place in &content.between {
        let group = between.create_group(&schema::slice_name(place.poisson_ratio))?;
        group
            .new_attr::<f64>()
            .create(schema::POISSON_RATIO)?
            .write_scalar(&place.poisson_ratio)?;
        let scales = [&between_r, &between_z, &pulse, &field];
        write_verification(&group, &place.verification, &scales)?;
    }
    file.flush()?;
    file.close()
}

fn write_verification(
    group: &Group,
    probes: &Verification,
    scales: &[&Dataset; 4],
) -> Result<(), hdf5::Error> {
    let shape = scales.map(|scale| scale.size());
    for (described, values) in [
        (&file::PROBE_DIRECT, &probes.direct),
        (&file::PROBE_LOOKED_UP, &probes.looked_up),
        (&file::PROBE_ERROR, &probes.error),
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
    file.new_attr::<u64>()
        .create(schema::CREATED)?
        .write_scalar(&origin.created_unix_s)?;
    text(file, schema::ID, &settings_id(&origin.grid))?;
    text(file, schema::GRID, &origin.grid)?;
    text(file, schema::CONTENT_SHA256, &content_hash(content))?;
    for (name, value) in [
        (schema::CELL_WIDTH, content.cell_width),
        (schema::R_MAX, content.r_max),
        (schema::Z_MAX, content.z_max),
    ] {
        file.new_attr::<f64>().create(name)?.write_scalar(&value)?;
    }
    file.new_attr::<u64>()
        .create(schema::STENCIL_POINTS)?
        .write_scalar(&(content.stencil_points as u64))?;
    file.new_attr::<f64>()
        .create(schema::ACCURACY_ASKED)?
        .write_scalar(&origin.accuracy_asked)?;
    let reached = &origin.accuracy_reached;
    file.new_attr::<f64>()
        .shape([reached.len()])
        .create(schema::ACCURACY_REACHED)?
        .write(reached)
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
