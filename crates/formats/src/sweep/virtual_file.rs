//! The sweep file whose results lie in its parts: HDF5 with virtual datasets.

use super::blocks::Blocks;
use super::boxes::boxes;
use super::columns::{Columns, What};
use super::fields::Precision;
use super::file::{begin, finish};
use super::schema::{self, part};
use super::spec::Spec;
use crate::hdf::{describe, reason, text};
use hdf5::{Dataset, Group, H5Type, Hyperslab, SliceOrIndex};
use output::{Fault, Output, OutputError, Staged};
use std::ops::Range;

/// A file with some of the rows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Source {
    /// Where it lies, seen from the folder of the output.
    pub(crate) path: String,
    /// Its rows.
    pub(crate) rows: Range<usize>,
}

/// Writes the file of a whole sweep that refers to its parts; only which failure a scene has is copied, because each part
/// counts its own. Of the blocks nothing but the failures is taken.
///
/// What is not there when it is read is NaN, and model 255.
///
/// # Errors
/// [`OutputError`].
pub(crate) fn stage_virtual<'a>(
    output: &'a Output,
    spec: &Spec,
    sources: &[Source],
    blocks: &(impl Blocks + ?Sized),
) -> Result<Staged<'a>, OutputError> {
    output.stage(|path| {
        let mut columns = Columns::new(spec);
        let mut make =
            |what: What, group: &Group, described: &(&str, &str, &str), shape: &[usize]| match what
            {
                What::Failure => columns.add(what, group, described, shape),
                What::Model => refer(group, described, shape, sources, u8::MAX),
                What::Row | What::Key { .. } | What::Number(_) => match spec.fields.precision {
                    Precision::Double => refer(group, described, shape, sources, f64::NAN),
                    Precision::Single => refer(group, described, shape, sources, f32::NAN),
                },
            };
        let file = begin(path, spec, &mut make).map_err(|error| reason(&error))?;
        let places: Vec<&str> = sources.iter().map(|source| source.path.as_str()).collect();
        text(&file, part::PARTS, &places.join("\n")).map_err(|error| reason(&error))?;
        let failures = columns.fill(path, &(0..spec.rows()), blocks)?;
        finish(file, &failures).map_err(|error| Fault::from(reason(&error)))
    })
}

/// A dataset of the numbers in the parts.
fn refer<T: H5Type + Copy + Into<hdf5::types::OwnedDynValue>>(
    group: &Group,
    described: &(&str, &str, &str),
    shape: &[usize],
    sources: &[Source],
    missing: T,
) -> Result<Dataset, hdf5::Error> {
    let mut builder = group
        .new_dataset::<T>()
        .shape(shape)
        .fill_value(missing)
        .obj_track_times(false);
    for source in sources {
        let name = format!("/{}/{}", schema::RESULTS, described.0);
        let mut from = 0;
        for ranges in boxes(shape, source.rows.clone()) {
            let count: usize = ranges.iter().map(ExactSizeIterator::len).product();
            let slices: Vec<SliceOrIndex> = ranges.into_iter().map(SliceOrIndex::from).collect();
            // the library takes %b for the number of a file
            builder = builder.virtual_map(
                source.path.replace('%', "%%"),
                &name,
                [source.rows.len()],
                from..from + count,
                shape,
                Hyperslab::from(slices),
            );
            from += count;
        }
    }
    let dataset = builder.create(described.0)?;
    describe(&dataset, described)?;
    Ok(dataset)
}
