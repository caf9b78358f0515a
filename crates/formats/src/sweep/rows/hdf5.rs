//! Rows as HDF5, as `data-schema/sweep.md` describes them: a whole sweep in its dimensions, some rows as a part, or a
//! whole sweep that refers to its parts.
//!
//! The library reserves the datasets; they are filled one block at a time.

use super::block::{Blocks, NO_MODEL};
use super::columns::{Cells, Column, What, columns, described, each_of};
use crate::hdf::{
    attach_scales, describe, new_file, numbers, reason, reserve, scalar, set_scale, some_at_a_time,
    text, texts,
};
use crate::quantities::{Labels, QUANTITIES};
use crate::schema::results::COORDINATES;
use crate::schema::sweep::{self as schema, part};
use crate::sweep::axes::{SweepAxis, SweptKey, Values};
use crate::sweep::fields::Precision;
use crate::sweep::journal::results as kept_results;
use crate::sweep::spec::Spec;
use contact::{Choice, Model};
use hdf5::types::OwnedDynValue;
use hdf5::{Dataset, Group, Hyperslab, SliceOrIndex};
use output::{Output, OutputError, OutputFault, Staged};
use std::collections::HashMap;
use std::fs::File;
use std::io;
#[cfg(not(unix))]
use std::io::{Seek, Write};
use std::ops::Range;

/// Largest number of failure reasons in a file: random numbers may make each reason unique, and all are in memory
/// together.
const MOST_REASONS: usize = 100_000;
/// Replacement for all later reasons.
const OTHER_REASON: &str = "a reason other than the first 100000: compute this row alone";

/// Writes rows, whose blocks must be complete and in order, into an output that was claimed before the work: the
/// selected rows as a part, or all rows.
///
/// With `sources` the results remain in other files, whose paths are relative to the folder of the output. Only the
/// indices of failures are copied, because each part counts its own reasons, and only the failures of the blocks are
/// used. Results that are missing when the file is read are NaN, and the model is 255.
///
/// Only one block is in memory, and the bytes do not depend on the division into blocks.
pub(crate) fn stage_hdf5<'a>(
    output: &'a Output,
    spec: &Spec,
    sources: Option<&[(String, Range<usize>)]>,
    blocks: &(impl Blocks + ?Sized),
) -> Result<Staged<'a>, OutputError> {
    output.stage_made(|name| {
        new_file(name, |library, file| {
            let told = |error: hdf5::Error| OutputFault::from(reason(&error));
            let reserved = begin(library, spec, sources).map_err(told)?;
            let (failed, reasons) = fill(file, spec, &reserved, blocks)?;
            finish(library, failed, &reasons).map_err(told)
        })
    })
}

/// Writes the data that are known only after all rows.
fn finish(file: &hdf5::File, failed: usize, reasons: &[String]) -> Result<(), hdf5::Error> {
    scalar(file, schema::FAILED, failed as u64)?;
    let reasons = texts(file, &schema::FAILURES, reasons)?;
    set_scale(&reasons, schema::FAILURES.0)
}

/// Bytes per row in a part, and in the journal during the computation.
pub fn row_bytes(spec: &Spec) -> (usize, usize) {
    let fields = &spec.fields;
    let cells = columns(spec).into_iter();
    let cells = cells.map(|column| missing(column.what, fields.precision));
    let kept = kept_results(fields).count_ones() as usize + fields.width() - QUANTITIES.len();
    let bytes = cells.map(|cell| cell.type_descriptor().size()).sum();
    (bytes, 8 * kept + 1)
}

/// Value of a missing number in a column, with the type of the column.
fn missing(what: What<'_>, precision: Precision) -> OwnedDynValue {
    match (what, precision) {
        (What::Row, _) => 0_i64.into(),
        (What::Key { .. }, _) if what.words().is_some() => 0_u32.into(),
        (What::Key { .. }, _) | (What::Number(_), Precision::Double) => f64::NAN.into(),
        (What::Number(_), Precision::Single) => f32::NAN.into(),
        (What::Model, _) => NO_MODEL.into(),
        (What::Failure, _) => (-1_i32).into(),
    }
}

/// A column that is reserved in a file, with its offset.
type Reserved<'a> = (What<'a>, Option<u64>);

/// Writes all data except the rows: of a whole sweep, with its keys along the dimensions of the results, or of a part,
/// with its keys as columns.
fn begin<'a>(
    file: &hdf5::File,
    spec: &'a Spec,
    sources: Option<&[(String, Range<usize>)]>,
) -> Result<Vec<Reserved<'a>>, hdf5::Error> {
    write_root(file, spec)?;
    let group = file.create_group(schema::RESULTS)?;
    let words = spec.selection.as_ref();
    let words = words.map(|_| file.create_group(part::WORDS)).transpose()?;
    let (mut scales, mut beside) = match words {
        Some(_) => (Vec::new(), Vec::new()),
        None => write_scales(&group, &spec.axes)?,
    };
    let shape = spec.shape();
    let mut reserved = Vec::new();
    for Column {
        mut described,
        what,
    } in columns(spec)
    {
        let is_key = matches!(what, What::Key { .. });
        if words.is_none() && (is_key || matches!(what, What::Row)) {
            continue;
        }
        let name = described.name.clone();
        if let (Some(words), Some(values)) = (&words, what.words()) {
            texts(words, &(&name, "1", "words of a scene key"), values)?;
            let of_key = described.meaning;
            described.meaning = format!("index of the {of_key} in /{}/{name}", part::WORDS);
        }
        let (labels, missing) = (described.labels(), missing(what, spec.fields.precision));
        let dataset = match (sources, what) {
            (Some(from), What::Number(_) | What::Model) => {
                refer(&group, &labels, &shape, from, missing)?
            }
            _ => {
                let (dataset, place) = reserve(&group, &labels, &shape, missing.type_descriptor())?;
                reserved.push((what, place));
                dataset
            }
        };
        if let What::Row = what {
            set_scale(&dataset, &name)?;
            scales.push(dataset);
            continue;
        }
        if let What::Model = what {
            // by their indices, separated by blanks
            let names: Vec<&str> = Model::ALL.iter().map(|m| m.name()).collect();
            text(&dataset, schema::NAMES, &names.join(" "))?;
        }
        attach_scales(&dataset, &scales)?;
        if is_key {
            beside.push(name);
        } else if !beside.is_empty() {
            text(&dataset, COORDINATES, &beside.join(" "))?;
        }
    }
    // programs that are given no group open the root
    for name in group.member_names()? {
        file.link_hard(&format!("{}/{name}", schema::RESULTS), &name)?;
    }
    if let Some(sources) = sources {
        let places: Vec<&str> = sources.iter().map(|(path, _)| path.as_str()).collect();
        text(file, part::PARTS, &places.join("\n"))?;
    }
    Ok(reserved)
}

/// Writes all rows into a file that the library has open, at offsets that the library does not touch. Returns the
/// number of failed rows, and the distinct reasons in order of appearance.
fn fill(
    file: &File,
    spec: &Spec,
    reserved: &[Reserved<'_>],
    blocks: &(impl Blocks + ?Sized),
) -> Result<(usize, Vec<String>), OutputFault> {
    let (mut reasons, mut known) = (Vec::new(), HashMap::new());
    let failed = each_of(spec, blocks, &mut |block| {
        for (_, reason) in &block.failures {
            if known.contains_key(reason) || reasons.len() > MOST_REASONS {
                continue;
            }
            if reasons.len() == MOST_REASONS {
                reasons.push(OTHER_REASON.to_owned());
            } else {
                known.insert(reason.clone(), reasons.len() as i32);
                reasons.push(reason.clone());
            }
        }
        for (what, place) in reserved {
            let Some(place) = place else { continue };
            let (bytes, width) = bytes(what.cells(spec, block, 0..block.len())?, &known);
            let before = (block.start - spec.selected().start) * width;
            write_at(file, place + before as u64, &bytes)?;
        }
        Ok(())
    })?;
    Ok((failed, reasons))
}

/// Writes bytes at an offset without moving the library's file position.
fn write_at(file: &File, place: u64, bytes: &[u8]) -> io::Result<()> {
    #[cfg(unix)]
    return std::os::unix::fs::FileExt::write_all_at(file, bytes, place);
    #[cfg(not(unix))]
    {
        let mut file = file;
        file.seek(io::SeekFrom::Start(place))?;
        file.write_all(bytes)
    }
}

/// The bytes of some cells, and the size of one; reasons are written as their indices.
fn bytes(cells: Cells<'_>, reasons: &HashMap<String, i32>) -> (Vec<u8>, usize) {
    fn all<T, const N: usize>(
        values: impl IntoIterator<Item = T>,
        bytes: fn(T) -> [u8; N],
    ) -> (Vec<u8>, usize) {
        (values.into_iter().flat_map(bytes).collect(), N)
    }
    match cells {
        Cells::Whole(values) => all(values, i64::to_ne_bytes),
        Cells::Double(values) => all(values, f64::to_ne_bytes),
        Cells::Single(values) => all(values, f32::to_ne_bytes),
        Cells::Words(values) => all(values, u32::to_ne_bytes),
        Cells::Models(models) => (models.to_vec(), 1),
        Cells::Reasons(values) => {
            let other = MOST_REASONS as i32;
            let number = |reason| reasons.get(reason).copied().unwrap_or(other);
            let numbers = values.into_iter().map(|reason| reason.map_or(-1, number));
            all(numbers, i32::to_ne_bytes)
        }
    }
}

/// Writes the attributes of the root of a sweep or part, and the axes of a whole sweep.
fn write_root(file: &hdf5::File, spec: &Spec) -> Result<(), hdf5::Error> {
    let [file_type, version] = match spec.selection {
        Some(_) => [part::FILE_TYPE, part::FORMAT_VERSION],
        None => [schema::FILE_TYPE, schema::FORMAT_VERSION],
    };
    let software = env!("CARGO_PKG_VERSION");
    let values = [file_type, version, software, &spec.resolved, &spec.sha256];
    for (name, value) in schema::TEXTS.into_iter().zip(values) {
        text(file, name, value)?;
    }
    let rows = spec.selected();
    let Some(selection) = &spec.selection else {
        scalar(file, schema::ROWS, rows.len() as u64)?;
        return write_axes(file, &spec.axes);
    };
    let shard = selection.shard.map(|shard| shard.to_string());
    text(file, part::SHARD, &shard.unwrap_or_default())?;
    scalar(file, part::SWEEP_ROWS, spec.rows() as u64)?;
    scalar(file, part::FIRST_ROW, rows.start as u64)?;
    scalar(file, schema::ROWS, rows.len() as u64)
}

/// Writes the keys that vary, each with the name of its axis.
fn write_axes(file: &hdf5::File, axes: &[SweepAxis]) -> Result<(), hdf5::Error> {
    let group = file.create_group(schema::AXES)?;
    for axis in axes {
        for key in &axis.columns {
            let dataset = write_key(&group, key)?;
            set_scale(&dataset, &key.name())?;
            text(&dataset, "axis", &axis.name)?;
        }
    }
    Ok(())
}

/// Writes a scale for each dimension into the group of results, which may be opened on its own, and the names of the
/// keys that share a dimension.
///
/// Of keys that vary together the scale is their number, and each of them a list over it.
fn write_scales(
    group: &Group,
    axes: &[SweepAxis],
) -> Result<(Vec<Dataset>, Vec<String>), hdf5::Error> {
    let (mut scales, mut beside) = (Vec::new(), Vec::new());
    for axis in axes {
        let own = axis.columns.iter().find(|key| key.name() == axis.name);
        let along = match own {
            Some(key) => write_key(group, key)?,
            None => {
                let labels = (axis.name.as_str(), "1", schema::NUMBERED);
                some_at_a_time(group, &labels, axis.len, |i| i as i64)?
            }
        };
        set_scale(&along, &axis.name)?;
        for key in axis.columns.iter().filter(|_| own.is_none()) {
            attach_scales(&write_key(group, key)?, &[&along])?;
            beside.push(key.name());
        }
        scales.push(along);
    }
    Ok((scales, beside))
}

fn write_key(group: &Group, key: &SweptKey) -> Result<Dataset, hdf5::Error> {
    let described = described(key);
    let labels = described.labels();
    match &key.values {
        Values::Numbers(values) => numbers(group, &labels, &[values.len()], values),
        Values::Texts(values) => texts(group, &labels, values),
        Values::Drawn(drawn) => some_at_a_time(group, &labels, drawn.count(), |i| drawn.at(i)),
    }
}

/// A dataset that refers to the numbers in the parts.
fn refer(
    group: &Group,
    labels: &Labels<'_>,
    shape: &[usize],
    sources: &[(String, Range<usize>)],
    missing: OwnedDynValue,
) -> Result<Dataset, hdf5::Error> {
    let mut builder = group
        .new_dataset_builder()
        .empty_as(missing.type_descriptor())
        .shape(shape)
        .fill_value(missing)
        .obj_track_times(false);
    for (path, rows) in sources {
        let name = format!("/{}/{}", schema::RESULTS, labels.0);
        let mut from = 0;
        for ranges in boxes(shape, rows.clone()) {
            let count: usize = ranges.iter().map(ExactSizeIterator::len).product();
            let slices: Vec<SliceOrIndex> = ranges.into_iter().map(SliceOrIndex::from).collect();
            // the library reads %b as the number of a file
            builder = builder.virtual_map(
                path.replace('%', "%%"),
                &name,
                [rows.len()],
                from..from + count,
                shape,
                Hyperslab::from(slices),
            );
            from += count;
        }
    }
    let dataset = builder.create(labels.0)?;
    describe(&dataset, labels)?;
    Ok(dataset)
}

/// Boxes that contain the rows of a range in order, each row once: ranges along the dimensions, of which the last
/// varies fastest. Their number is at most twice the number of dimensions.
fn boxes(shape: &[usize], rows: Range<usize>) -> Vec<Vec<Range<usize>>> {
    let (mut found, mut at) = (Vec::new(), rows.start);
    while at < rows.end {
        // the largest slices that begin here and fit, and as many as follow each other along their dimension
        let (mut along, mut slice) = (shape.len() - 1, 1);
        while along > 0 {
            let larger = slice * shape[along];
            if at % larger != 0 || at + larger > rows.end {
                break;
            }
            (along, slice) = (along - 1, larger);
        }
        let first = at / slice % shape[along];
        let count = ((rows.end - at) / slice).min(shape[along] - first);
        let mut ranges: Vec<_> = shape.iter().map(|&length| 0..length).collect();
        ranges[along] = first..first + count;
        let mut outer = at / slice / shape[along];
        for range in ranges[..along].iter_mut().rev() {
            let (place, length) = (outer % range.end, range.end);
            (*range, outer) = (place..place + 1, outer / length);
        }
        found.push(ranges);
        at += count * slice;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows of a box in order.
    fn rows(shape: &[usize], ranges: &[Range<usize>]) -> Vec<usize> {
        let mut found = vec![0];
        for (length, range) in shape.iter().zip(ranges) {
            found = (found.iter())
                .flat_map(|row| range.clone().map(move |i| row * length + i))
                .collect();
        }
        found
    }

    #[test]
    fn boxes_are_the_rows_in_their_order() {
        for shape in [
            &[7][..],
            &[3, 5],
            &[2, 3, 4],
            &[3, 1, 4],
            &[1, 1],
            &[2, 2, 3, 2],
        ] {
            let all: usize = shape.iter().product();
            for start in 0..=all {
                for end in start..=all {
                    let found = boxes(shape, start..end);
                    assert!(found.len() <= 2 * shape.len(), "{shape:?} {start}..{end}");
                    let found: Vec<usize> = found
                        .iter()
                        .flat_map(|ranges| rows(shape, ranges))
                        .collect();
                    assert_eq!(found, (start..end).collect::<Vec<_>>(), "{shape:?}");
                }
            }
        }
    }
}
