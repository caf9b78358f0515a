//! Helpers for the HDF5 library: datasets with units and descriptions, texts, dimension scales.

use crate::quantities::Labels;
use hdf5::dataset::{AllocTime, FillTime};
use hdf5::types::TypeDescriptor;
use hdf5::{Dataset, File, Group, H5Type};
use lookup::labels::unicode;
pub(crate) use lookup::labels::{array, attach_scales, scalar, set_scale, text};
pub(crate) use lookup::new::{new_file, reason};
use output::{Output, OutputError, OutputFault, Staged};

/// Writes a file into an output that was claimed before the work: its type and the version of its format, then the rest.
///
/// # Errors
/// [`OutputError`].
pub(crate) fn stage<'a>(
    output: &'a Output,
    [file_type, format_version]: [&str; 2],
    fill: impl FnOnce(&File) -> Result<(), hdf5::Error>,
) -> Result<Staged<'a>, OutputError> {
    let all = |file: &File| {
        text(file, "file_type", file_type)?;
        text(file, "format_version", format_version)?;
        text(file, "software_version", env!("CARGO_PKG_VERSION"))?;
        fill(file)
    };
    output.stage_made(|name| {
        new_file(name, |file, _| {
            all(file).map_err(|error| OutputFault::from(reason(&error)))
        })
    })
}

/// A dataset of one dimension.
pub(crate) fn vector<T: H5Type>(
    group: &Group,
    described: &Labels<'_>,
    samples: &[T],
) -> Result<Dataset, hdf5::Error> {
    numbers(group, described, &[samples.len()], samples)
}

/// A dataset of any shape; `described` has its name, unit and meaning.
pub(crate) fn numbers<T: H5Type>(
    group: &Group,
    described: &Labels<'_>,
    shape: &[usize],
    samples: &[T],
) -> Result<Dataset, hdf5::Error> {
    filled::<T>(group, described, shape, |dataset| {
        dataset.write_raw(samples)
    })
}

fn filled<T: H5Type>(
    group: &Group,
    described: &Labels<'_>,
    shape: &[usize],
    fill: impl FnOnce(&Dataset) -> Result<(), hdf5::Error>,
) -> Result<Dataset, hdf5::Error> {
    let dataset = group
        .new_dataset::<T>()
        .shape(shape)
        .obj_track_times(false)
        .create(described.0)?;
    fill(&dataset)?;
    describe(&dataset, described)?;
    Ok(dataset)
}

/// Numbers of a list that are computed and written together.
const AT_A_TIME: usize = 1 << 20;

/// Writes a list of numbers in blocks; `of` returns the number at an index.
pub(crate) fn some_at_a_time<T: H5Type>(
    group: &Group,
    described: &Labels<'_>,
    length: usize,
    number: impl Fn(usize) -> T,
) -> Result<Dataset, hdf5::Error> {
    filled::<T>(group, described, &[length], |dataset| {
        (0..length).step_by(AT_A_TIME).try_for_each(|start| {
            let end = (start + AT_A_TIME).min(length);
            let some: Vec<T> = (start..end).map(&number).collect();
            dataset.write_slice(&some, start..end)
        })
    })
}

/// Creates a described dataset for numbers that are written later; returns their offset in the file, none for an empty
/// dataset.
pub(crate) fn reserve(
    group: &Group,
    described: &Labels<'_>,
    shape: &[usize],
    of: &TypeDescriptor,
) -> Result<(Dataset, Option<u64>), hdf5::Error> {
    let dataset = group
        .new_dataset_builder()
        .empty_as(of)
        .shape(shape)
        .alloc_time(Some(AllocTime::Early))
        .fill_time(FillTime::Never)
        .obj_track_times(false)
        .create(described.0)?;
    describe(&dataset, described)?;
    let place = dataset.offset();
    if place.is_none() && dataset.size() > 0 {
        return Err(hdf5::Error::from("the HDF5 library reserved no space"));
    }
    Ok((dataset, place))
}

/// A list of texts.
pub(crate) fn texts(
    group: &Group,
    described: &Labels<'_>,
    values: &[String],
) -> Result<Dataset, hdf5::Error> {
    let values = values.iter().map(|value| unicode(value));
    let values = values.collect::<Result<Vec<_>, _>>()?;
    vector(group, described, &values)
}

/// A dimension scale of numbers.
pub(crate) fn scale<T: H5Type>(
    group: &Group,
    described: &Labels<'_>,
    values: &[T],
) -> Result<Dataset, hdf5::Error> {
    let dataset = vector(group, described, values)?;
    set_scale(&dataset, described.0)?;
    Ok(dataset)
}

pub(crate) fn describe(dataset: &Dataset, described: &Labels<'_>) -> Result<(), hdf5::Error> {
    text(dataset, "units", described.1)?;
    text(dataset, "long_name", described.2)
}
