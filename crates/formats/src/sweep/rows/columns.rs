//! The columns of a file of rows in any format, and their values.

use super::block::{Block, Blocks};
use crate::quantities::Described;
use crate::scene::keys::{SECTIONS, keys_of};
use crate::schema::sweep::{FAILURE, MODEL, part};
use crate::sweep::axes::{SweptKey, Values};
use crate::sweep::fields::Precision;
use crate::sweep::spec::Spec;
use output::OutputFault;
use std::ops::Range;

/// Content of a column.
#[derive(Debug, Clone, Copy)]
pub(crate) enum What<'a> {
    /// The number of the row in the sweep.
    Row,
    /// The value of a key that varies.
    Key {
        /// Rows between consecutive values of the axis.
        stride: usize,
        values: &'a Values,
    },
    /// A result, by its index.
    Number(usize),
    Model,
    /// The reason of a failure.
    Failure,
}

/// A column of a file of rows.
#[derive(Debug)]
pub(crate) struct Column<'a> {
    pub(crate) described: Described,
    pub(crate) what: What<'a>,
}

/// The values of a column in some rows.
#[derive(Debug, PartialEq)]
pub(crate) enum Cells<'b> {
    Whole(Vec<i64>),
    Double(Vec<f64>),
    Single(Vec<f32>),
    /// Indices of words.
    Words(Vec<u32>),
    /// Indices of models.
    Models(&'b [u8]),
    Reasons(Vec<Option<&'b str>>),
}

/// All columns: number of the row, keys that vary, results, model and reason of a failure.
pub(crate) fn columns(spec: &Spec) -> Vec<Column<'_>> {
    let fixed = |described, what| Column { described, what };
    let mut found = vec![fixed(part::ROW.into(), What::Row)];
    for (stride, axis) in spec.strides() {
        for key in &axis.columns {
            let values = &key.values;
            found.push(fixed(described(key), What::Key { stride, values }));
        }
    }
    let numbers = spec.fields.quantities();
    found.extend(numbers.map(|(place, result)| fixed(result.clone(), What::Number(place))));
    found.push(fixed(MODEL.into(), What::Model));
    found.push(fixed(FAILURE.into(), What::Failure));
    found
}

/// Description of a key that varies.
pub(super) fn described(key: &SweptKey) -> Described {
    of_key(key.name())
}

/// Description of a key, by its name with its section.
fn of_key(name: String) -> Described {
    Described {
        meaning: format!("scene key {name}"),
        unit: key_unit(&name).0.to_owned(),
        name,
    }
}

/// Descriptions of all keys of a scene.
pub fn described_keys() -> impl Iterator<Item = Described> {
    SECTIONS.into_iter().flat_map(|section| {
        keys_of(section).map(move |key| of_key(format!("{section}.{}", key.name)))
    })
}

/// Names of the columns of a part.
pub fn column_names(spec: &Spec) -> Vec<String> {
    let columns = columns(spec).into_iter();
    columns.map(|column| column.described.name).collect()
}

impl What<'_> {
    /// The words of a key, if its values are words.
    pub(crate) fn words(&self) -> Option<&Vec<String>> {
        match self {
            Self::Key { values, .. } => values.texts(),
            Self::Row | Self::Number(_) | Self::Model | Self::Failure => None,
        }
    }

    /// The values of some rows of a block, counted from its first.
    pub(crate) fn cells<'b>(
        &self,
        spec: &Spec,
        block: &'b Block,
        some: Range<usize>,
    ) -> Result<Cells<'b>, OutputFault> {
        let rows = block.start + some.start..block.start + some.end;
        Ok(match *self {
            Self::Row => Cells::Whole(rows.map(|row| row as i64).collect()),
            Self::Key { stride, values } => {
                let places = rows.map(|row| row / stride % values.count());
                match values {
                    Values::Numbers(numbers) => Cells::Double(places.map(|i| numbers[i]).collect()),
                    Values::Drawn(drawn) => Cells::Double(places.map(|i| drawn.at(i)).collect()),
                    Values::Texts(_) => Cells::Words(places.map(|i| i as u32).collect()),
                }
            }
            Self::Number(k) => {
                let numbers = some.map(|row| block.numbers[row * block.width + k]);
                match spec.fields.precision {
                    Precision::Double => Cells::Double(numbers.collect()),
                    Precision::Single => {
                        let name = &spec.fields.known[k].name;
                        let rounded = numbers.zip(rows).map(|(x, row)| single(x, row, name));
                        Cells::Single(rounded.collect::<Result<_, _>>()?)
                    }
                }
            }
            Self::Model => Cells::Models(&block.models[some]),
            Self::Failure => {
                let mut reasons = vec![None; some.len()];
                for (row, reason) in block.failures_of(&some) {
                    reasons[row - rows.start] = Some(reason.as_str());
                }
                Cells::Reasons(reasons)
            }
        })
    }
}

/// A number in single precision, if it is in range.
fn single(number: f64, row: usize, name: &str) -> Result<f32, OutputFault> {
    let rounded = number as f32;
    if rounded.is_infinite() && number.is_finite() {
        return Err(OutputFault::from(format!(
            "{name} = {number} in row {row} is outside [-3.4e38, 3.4e38] of single precision"
        )));
    }
    Ok(rounded)
}

/// Visits blocks, which must be all selected rows in order; returns the number of failed rows.
pub(super) fn each_of(
    spec: &Spec,
    blocks: &(impl Blocks + ?Sized),
    visit: &mut dyn FnMut(&Block) -> Result<(), OutputFault>,
) -> Result<usize, OutputFault> {
    let rows = spec.selected();
    let (mut next, mut failed) = (rows.start, 0);
    let missing = |row: usize| OutputFault::from(format!("row {row} is missing"));
    blocks.each(&mut |block| {
        let end = block.start + block.len();
        if block.start != next || end > rows.end {
            return Err(missing(next));
        }
        visit(block)?;
        failed += block.failures.len();
        next = end;
        Ok(())
    })?;
    if next == rows.end {
        Ok(failed)
    } else {
        Err(missing(next))
    }
}

/// The unit at the end of a key's name, and that suffix; `1` and an empty suffix for dimensionless keys.
pub fn key_unit(key: &str) -> (&'static str, &'static str) {
    // longest suffix first
    const KEY_UNITS: [(&str, &str); 9] = [
        ("Pa m^(1/2)", "_pa_sqrt_m"),
        ("kg/m^3", "_kg_m3"),
        ("m/s", "_m_s"),
        ("kg", "_kg"),
        ("Pa", "_pa"),
        ("Hz", "_hz"),
        ("m", "_m"),
        ("s", "_s"),
        ("N", "_n"),
    ];
    let found = KEY_UNITS.iter().find(|(_, ending)| key.ends_with(ending));
    found.copied().unwrap_or(("1", ""))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_is_the_longest_ending() {
        for (key, expected) in [
            ("target.fracture_toughness_pa_sqrt_m", "Pa m^(1/2)"),
            ("target.density_kg_m3", "kg/m^3"),
            ("striker.tip_radius_m", "m"),
            ("target.poisson_ratio", "1"),
            ("force.low_pass_hz", "Hz"),
            ("force.force_n", "N"),
        ] {
            let (unit, ending) = key_unit(key);
            assert!(unit == expected && key.ends_with(ending), "{key}: {unit}");
        }
    }
}
