//! Rows as HDF5, as `data-schema/sweep.md` writes it down: all of a sweep in its dimensions, some of them as a part, or all
//! of them by reference to their parts.
//!
//! The datasets are reserved through the library and filled a block at a time.

use super::block::{Block, Blocks};
use super::columns::{Cells, Column, What, columns, each_of, key_unit, rows_of};
use crate::hdf::{
    attach_all, attach_scale, describe, new_file, numbers, reason, reserve, scalar, set_scale,
    some_at_a_time, text, texts,
};
use crate::quantities::{Labels, QUANTITIES};
use crate::results::schema::COORDINATES;
use crate::sweep::axes::{Axis, Column as Key, Values};
use crate::sweep::fields::Precision;
use crate::sweep::journal::results as kept_results;
use crate::sweep::schema::{self, part};
use crate::sweep::shard::Selection;
use crate::sweep::spec::Spec;
use contact::{Choice, Model};
use hdf5::{Dataset, Group, H5Type, Hyperslab, SliceOrIndex};
use output::{Fault, Output, OutputError, Staged};
use std::collections::HashMap;
use std::fs::File;
use std::io::{Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::Path;

/// Reasons of failures that a file has at most: drawn numbers may make each its own, and all are in memory together.
const MOST_REASONS: usize = 100_000;
/// What stands for all later ones.
const OTHER_REASON: &str = "a reason unlike the first 100000: compute the row by itself";

/// Writes rows, whose blocks are all there in order, into an output that was claimed before the work: a selection as a part, or
/// all of them.
///
/// With `sources` the results of the whole lie in files that have some of the rows each, with their paths seen from the folder
/// of the output: only which failure a scene has is copied, because each of them counts its own, and nothing but the failures
/// is taken of the blocks. What is not there when it is read is NaN, and model 255.
///
/// No more than a block is in memory, and the bytes do not depend on how rows are divided into blocks.
pub(crate) fn stage_hdf5<'a>(
    output: &'a Output,
    spec: &Spec,
    selection: Option<&Selection>,
    sources: Option<&[(String, Range<usize>)]>,
    blocks: &(impl Blocks + ?Sized),
) -> Result<Staged<'a>, OutputError> {
    output.stage(|path| {
        let told = |error: hdf5::Error| Fault::from(reason(&error));
        let file = new_file().create(path).map_err(told)?;
        let mut table = Table {
            spec,
            reserved: Vec::new(),
        };
        let begun = match selection {
            Some(selection) => table.begin_part(&file, selection),
            None => table.begin_whole(&file, sources),
        };
        begun.map_err(told)?;
        let (failed, reasons) = table.fill(path, &rows_of(spec, selection), blocks)?;
        finish(file, failed, &reasons).map_err(told)?;
        ledger::seal(path).map_err(Fault::from)
    })
}

/// What is known once all rows are written.
fn finish(file: hdf5::File, failed: usize, reasons: &[String]) -> Result<(), hdf5::Error> {
    scalar(&file, schema::FAILED, failed as u64)?;
    let reasons = texts(&file, &schema::FAILURES, reasons)?;
    set_scale(&reasons, schema::FAILURES.0)?;
    file.flush()?;
    file.close()
}

/// Bytes that a row takes in a part, and in the journal while it is computed.
#[must_use]
pub fn row_bytes(spec: &Spec) -> (usize, usize) {
    let words = |key: &Key| if key.values.texts().is_some() { 4 } else { 8 };
    let keys: usize = spec.columns().map(words).sum();
    let fields = &spec.fields;
    let results = fields.precision.bytes() * fields.places.len() + 1;
    let kept = kept_results(fields).count_ones() as usize + fields.width() - QUANTITIES.len();
    (8 + keys + results + 4, 8 * kept + 1)
}

/// A file that is being written: the columns that are reserved in it, with the places of their numbers.
struct Table<'a> {
    spec: &'a Spec,
    reserved: Vec<(What<'a>, Option<u64>)>,
}

impl<'a> Table<'a> {
    /// Everything of a whole sweep but the rows.
    fn begin_whole(
        &mut self,
        file: &hdf5::File,
        sources: Option<&[(String, Range<usize>)]>,
    ) -> Result<(), hdf5::Error> {
        let spec = self.spec;
        write_texts(file, spec, schema::FILE_TYPE, schema::FORMAT_VERSION)?;
        scalar(file, schema::ROWS, spec.rows() as u64)?;
        write_axes(file, &spec.axes)?;
        let shape: Vec<usize> = spec.axes.iter().map(|axis| axis.len).collect();
        let group = file.create_group(schema::RESULTS)?;
        let (scales, beside) = write_scales(&group, &spec.axes)?;
        let scales: Vec<&Dataset> = scales.iter().collect();
        for column in columns(spec) {
            let labels = column.described.labels();
            let dataset = match (column.what, sources, spec.fields.precision) {
                (What::Row | What::Key { .. }, _, _) => continue,
                (What::Failure, _, _) | (_, None, _) => {
                    self.reserve(column.what, &group, &labels, &shape)?
                }
                (What::Model, Some(from), _) => refer(&group, &labels, &shape, from, u8::MAX)?,
                (What::Number(_), Some(from), Precision::Double) => {
                    refer(&group, &labels, &shape, from, f64::NAN)?
                }
                (What::Number(_), Some(from), Precision::Single) => {
                    refer(&group, &labels, &shape, from, f32::NAN)?
                }
            };
            name_models(&dataset, column.what)?;
            attach_all(&dataset, &scales, 0)?;
            if !beside.is_empty() {
                text(&dataset, COORDINATES, &beside.join(" "))?;
            }
        }
        sources.map_or(Ok(()), |sources| {
            let places: Vec<&str> = sources.iter().map(|(path, _)| path.as_str()).collect();
            text(file, part::PARTS, &places.join("\n"))
        })
    }

    /// Everything of a part but the rows.
    fn begin_part(&mut self, file: &hdf5::File, selection: &Selection) -> Result<(), hdf5::Error> {
        let spec = self.spec;
        write_texts(file, spec, part::FILE_TYPE, part::FORMAT_VERSION)?;
        let shard = selection.shard.map(|shard| shard.to_string());
        text(file, part::SHARD, &shard.unwrap_or_default())?;
        scalar(file, part::SWEEP_ROWS, spec.rows() as u64)?;
        scalar(file, part::FIRST_ROW, selection.rows.start as u64)?;
        scalar(file, schema::ROWS, selection.rows.len() as u64)?;
        let shape = [selection.rows.len()];
        let group = file.create_group(schema::RESULTS)?;
        let words = file.create_group(part::WORDS)?;
        let (mut row, mut keys) = (None, Vec::new());
        for Column { described, what } in columns(spec) {
            let (name, unit, mut meaning) = (described.name, described.unit, described.meaning);
            if let Some(values) = what.words() {
                texts(&words, &(&name, "1", "words of a scene key"), values)?;
                meaning = format!("index of the {meaning} in /{}/{name}", part::WORDS);
            }
            let dataset = self.reserve(what, &group, &(&name, &unit, &meaning), &shape)?;
            let Some(row) = &row else {
                set_scale(&dataset, part::ROW.0)?;
                row = Some(dataset);
                continue;
            };
            name_models(&dataset, what)?;
            attach_scale(&dataset, row, 0)?;
            if let What::Key { .. } = what {
                keys.push(name);
            } else {
                text(&dataset, COORDINATES, &keys.join(" "))?;
            }
        }
        Ok(())
    }

    /// Makes the dataset of a column.
    fn reserve(
        &mut self,
        what: What<'a>,
        group: &Group,
        labels: &Labels<'_>,
        shape: &[usize],
    ) -> Result<Dataset, hdf5::Error> {
        let (dataset, place) = match (what, self.spec.fields.precision) {
            (What::Row, _) => reserve::<i64>(group, labels, shape)?,
            (What::Key { .. }, _) if what.words().is_some() => {
                reserve::<u32>(group, labels, shape)?
            }
            (What::Key { .. }, _) | (What::Number(_), Precision::Double) => {
                reserve::<f64>(group, labels, shape)?
            }
            (What::Number(_), Precision::Single) => reserve::<f32>(group, labels, shape)?,
            (What::Model, _) => reserve::<u8>(group, labels, shape)?,
            (What::Failure, _) => reserve::<i32>(group, labels, shape)?,
        };
        self.reserved.push((what, place));
        Ok(dataset)
    }

    /// Writes all rows into the file at `path`, which the library has open: it writes to other places of it. Gives the
    /// number of failed rows, and the distinct reasons in the order in which they come.
    fn fill(
        &self,
        path: &Path,
        rows: &Range<usize>,
        blocks: &(impl Blocks + ?Sized),
    ) -> Result<(usize, Vec<String>), Fault> {
        let mut file = File::options().write(true).open(path)?;
        let (mut reasons, mut known) = (Vec::new(), HashMap::new());
        let failed = each_of(rows, blocks, &mut |block| {
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
            for (what, place) in &self.reserved {
                let Some(place) = place else { continue };
                let (bytes, width) = self.bytes(*what, block, &known)?;
                let before = (block.start - rows.start) * width;
                file.seek(SeekFrom::Start(place + before as u64))?;
                file.write_all(&bytes)?;
            }
            Ok(())
        })?;
        Ok((failed, reasons))
    }

    /// The bytes of a column's rows, and of one of them.
    fn bytes(
        &self,
        what: What<'_>,
        block: &Block,
        reasons: &HashMap<String, i32>,
    ) -> Result<(Vec<u8>, usize), Fault> {
        fn all<T, const N: usize>(
            values: impl IntoIterator<Item = T>,
            bytes: fn(T) -> [u8; N],
        ) -> (Vec<u8>, usize) {
            (values.into_iter().flat_map(bytes).collect(), N)
        }
        let cells = what.cells(self.spec, block, 0..block.len())?;
        Ok(match cells {
            Cells::Whole(values) => all(values, i64::to_ne_bytes),
            Cells::Double(values) => all(values, f64::to_ne_bytes),
            Cells::Single(values) => all(values, f32::to_ne_bytes),
            Cells::Words(values) => all(values, u32::to_ne_bytes),
            Cells::Models(models) => (models.to_vec(), 1),
            Cells::Reasons(values) => {
                let of = |reason: &str| reasons.get(reason).copied();
                let index = |reason: Option<&str>| {
                    reason.map_or(-1, |reason| of(reason).unwrap_or(MOST_REASONS as i32))
                };
                all(values.into_iter().map(index), i32::to_ne_bytes)
            }
        })
    }
}

/// The texts of the root.
fn write_texts(
    file: &hdf5::File,
    spec: &Spec,
    file_type: &str,
    version: &str,
) -> Result<(), hdf5::Error> {
    let software = env!("CARGO_PKG_VERSION");
    let values = [file_type, version, software, &spec.resolved, &spec.sha256];
    let mut named = schema::TEXTS.into_iter().zip(values);
    named.try_for_each(|(name, value)| text(file, name, value))
}

/// The models by their indices, divided by blanks, at the column of models.
fn name_models(dataset: &Dataset, what: What<'_>) -> Result<(), hdf5::Error> {
    let What::Model = what else {
        return Ok(());
    };
    let names: Vec<&str> = Model::ALL.iter().map(|m| m.name()).collect();
    text(dataset, schema::NAMES, &names.join(" "))
}

/// The keys that vary, each with the axis that it belongs to.
fn write_axes(file: &hdf5::File, axes: &[Axis]) -> Result<(), hdf5::Error> {
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

/// One scale for each dimension beside the results: a group is opened by itself; and the names of the keys that vary along
/// a dimension with others.
///
/// Of keys that vary together the scale is their number, and each of them a list over it.
fn write_scales(group: &Group, axes: &[Axis]) -> Result<(Vec<Dataset>, Vec<String>), hdf5::Error> {
    let (mut scales, mut beside) = (Vec::new(), Vec::new());
    for axis in axes {
        if let [only] = axis.columns.as_slice()
            && only.name() == axis.name
        {
            let dataset = write_key(group, only)?;
            set_scale(&dataset, &axis.name)?;
            scales.push(dataset);
            continue;
        }
        let labels = (axis.name.as_str(), "1", schema::NUMBERED);
        let along = some_at_a_time(group, &labels, axis.len, |i| i as i64)?;
        set_scale(&along, &axis.name)?;
        for key in &axis.columns {
            attach_scale(&write_key(group, key)?, &along, 0)?;
            beside.push(key.name());
        }
        scales.push(along);
    }
    Ok((scales, beside))
}

fn write_key(group: &Group, key: &Key) -> Result<Dataset, hdf5::Error> {
    let name = key.name();
    let meaning = format!("scene key {name}");
    let labels = (name.as_str(), key_unit(&key.key).0, meaning.as_str());
    match &key.values {
        Values::Numbers(values) => numbers(group, &labels, &[values.len()], values),
        Values::Texts(values) => texts(group, &labels, values),
        Values::Drawn(drawn) => some_at_a_time(group, &labels, drawn.count(), |i| drawn.at(i)),
    }
}

/// A dataset of the numbers in the parts.
fn refer<T: H5Type + Copy + Into<hdf5::types::OwnedDynValue>>(
    group: &Group,
    labels: &Labels<'_>,
    shape: &[usize],
    sources: &[(String, Range<usize>)],
    missing: T,
) -> Result<Dataset, hdf5::Error> {
    let mut builder = group
        .new_dataset::<T>()
        .shape(shape)
        .fill_value(missing)
        .obj_track_times(false);
    for (path, rows) in sources {
        let name = format!("/{}/{}", schema::RESULTS, labels.0);
        let mut from = 0;
        for ranges in boxes(shape, rows.clone()) {
            let count: usize = ranges.iter().map(ExactSizeIterator::len).product();
            let slices: Vec<SliceOrIndex> = ranges.into_iter().map(SliceOrIndex::from).collect();
            // the library takes %b for the number of a file
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

/// Boxes that hold the rows of a range in their order, each once: ranges along the dimensions, the last of which runs
/// fastest; twice as many as dimensions at most.
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

    /// Rows of a box in their order.
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
