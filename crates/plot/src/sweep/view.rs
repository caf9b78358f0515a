//! Selection of the data of a sweep: values over one key, for some settings of the others, with quantiles of the draws.

use crate::error::PlotError;
use crate::request::Request;
use crate::words::{of_key, with_unit};
use formats::stored::StoredSweep;
use formats::sweep::{SweptKey, Values};

/// Quantiles at the lower end of the band, its middle and its upper end.
const SHARES: [f64; 3] = [0.05, 0.5, 0.95];

/// A choice along every axis that is not shown.
#[derive(Debug, Clone)]
pub(super) struct SweepSlice {
    /// Words for the choice; empty if there is nothing to choose.
    pub(super) label: String,
    /// Index along each axis; none along the shown axes.
    pub(super) fixed: Vec<Option<usize>>,
}

/// The axes of a sweep and their roles.
pub(super) struct View<'a> {
    pub(super) sweep: &'a StoredSweep,
    /// Axis of random draws.
    pub(super) drawn: Option<usize>,
    /// Index along each axis that the request fixes.
    pub(super) fixed: Vec<Option<usize>>,
}

impl<'a> View<'a> {
    pub(super) fn new(sweep: &'a StoredSweep, request: &Request) -> Result<Self, PlotError> {
        let mut fixed = vec![None; sweep.axes.len()];
        for (key, value) in &request.at {
            let (axis, column) = find(sweep, key)?;
            fixed[axis] = Some(index_of(sweep, column, value)?);
        }
        let is_drawn = |i: &usize| sweep.axes[*i].is_drawn() && fixed[*i].is_none();
        Ok(Self {
            sweep,
            drawn: (0..sweep.axes.len()).find(is_drawn),
            fixed,
        })
    }

    /// Axes that still vary, except the draws.
    pub(super) fn free(&self) -> Vec<usize> {
        let axes = 0..self.sweep.axes.len();
        axes.filter(|&i| {
            self.fixed[i].is_none() && Some(i) != self.drawn && self.sweep.axes[i].len > 1
        })
        .collect()
    }

    /// The numbers along an axis: those of the requested key, or of the first key with numbers.
    pub(super) fn numbers(&self, axis: usize, asked: Option<&str>) -> Option<(&SweptKey, &[f64])> {
        let columns = self.sweep.axes[axis].columns.iter();
        let mut asked = columns.filter(|column| asked.is_none_or(|name| name == column.name()));
        asked.find_map(|column| match &column.values {
            Values::Numbers(values) => Some((column, values.as_slice())),
            Values::Texts(_) | Values::Drawn(_) => None,
        })
    }

    /// The x axis: that of the requested key, or the longest with numbers.
    pub(super) fn along(&self, asked: Option<&str>) -> Result<Option<usize>, PlotError> {
        if let Some(key) = asked {
            let (axis, column) = find(self.sweep, key)?;
            return match &column.values {
                Values::Numbers(_) | Values::Drawn(_) => Ok(Some(axis)),
                Values::Texts(_) => Err(PlotError::no_numbers(key)),
            };
        }
        let free = self.free().into_iter();
        let with_numbers = free.filter(|&i| self.numbers(i, None).is_some());
        // the first of the longest
        Ok(with_numbers.rev().max_by_key(|&i| self.sweep.axes[i].len))
    }

    /// Shown rows: those at the fixed values, including all draws and all values of free axes.
    pub(super) fn shown(&self) -> Vec<usize> {
        let axes = &self.sweep.axes;
        let rows: usize = axes.iter().map(|axis| axis.len).product();
        let is_shown = |row: &usize| {
            let mut rest = *row;
            let mut backwards = axes.iter().zip(&self.fixed).rev();
            backwards.all(|(axis, fixed)| {
                let index = rest % axis.len;
                rest /= axis.len;
                fixed.is_none_or(|fixed| fixed == index)
            })
        };
        (0..rows).filter(is_shown).collect()
    }

    /// An example `key=value` that fixes a free axis which is not shown.
    pub(super) fn example(&self, shown: &[usize]) -> Option<String> {
        let mut free = self.free().into_iter().filter(|axis| !shown.contains(axis));
        let column = self.sweep.axes[free.next()?].columns.first()?;
        let value = match &column.values {
            Values::Texts(words) => words.first()?.clone(),
            values @ (Values::Numbers(_) | Values::Drawn(_)) => values.number(0)?.to_string(),
        };
        Some(format!("{}={value}", column.name()))
    }

    /// All choices along the free axes that are not shown.
    pub(super) fn slices(&self, shown: &[usize]) -> Vec<SweepSlice> {
        let mut found = vec![SweepSlice {
            label: String::new(),
            fixed: self.fixed.clone(),
        }];
        for axis in self.free().into_iter().filter(|axis| !shown.contains(axis)) {
            let count = self.sweep.axes[axis].len;
            let at = |(slice, index): (&SweepSlice, usize)| {
                let mut slice = slice.clone();
                slice.fixed[axis] = Some(index);
                let comma = if slice.label.is_empty() { "" } else { ", " };
                slice.label += &format!("{comma}{}", self.name(axis, index));
                slice
            };
            let all = found
                .iter()
                .flat_map(|slice| (0..count).map(move |i| (slice, i)));
            found = all.map(at).collect();
        }
        found
    }

    /// Words for the fixed values; none if there are none.
    pub(super) fn held(&self) -> Option<String> {
        let fixed = self.fixed.iter().enumerate();
        let held = fixed.filter_map(|(axis, index)| Some(self.name(axis, (*index)?)));
        let held: Vec<String> = held.collect();
        (!held.is_empty()).then(|| held.join(", "))
    }

    /// Words for a place of an axis: `granite`, `tip radius 2 mm`.
    fn name(&self, axis: usize, index: usize) -> String {
        let parts = self.sweep.axes[axis].columns.iter().map(|column| {
            let (name, unit) = of_key(&column.name());
            match &column.values {
                Values::Texts(values) => values[index].clone(),
                values @ (Values::Numbers(_) | Values::Drawn(_)) => {
                    let number = values.number(index).unwrap_or(f64::NAN);
                    format!("{name} {}", with_unit(number, unit))
                }
            }
        });
        parts.collect::<Vec<_>>().join(", ")
    }

    /// The rows of a slice at a place along the shown axes, over all draws.
    pub(super) fn rows(&self, slice: &SweepSlice, at: &[(usize, usize)]) -> Vec<usize> {
        let axes = &self.sweep.axes;
        let index = |i: usize, draw: usize| {
            let shown = at.iter().find(|(axis, _)| *axis == i);
            let shown = shown.map(|(_, index)| *index);
            let own = (Some(i) == self.drawn).then_some(draw);
            shown.or(own).or(slice.fixed[i]).unwrap_or(0)
        };
        let draws = self.drawn.map_or(1, |axis| axes[axis].len);
        let row = |draw| (0..axes.len()).fold(0, |row, i| row * axes[i].len + index(i, draw));
        (0..draws).map(row).collect()
    }
}

/// The axis and the column of a key.
fn find<'a>(sweep: &'a StoredSweep, key: &str) -> Result<(usize, &'a SweptKey), PlotError> {
    let axes = sweep.axes.iter().enumerate();
    let mut all = axes.flat_map(|(i, axis)| axis.columns.iter().map(move |c| (i, c)));
    let names: Vec<String> = all.clone().map(|(_, column)| column.name()).collect();
    let names = names.iter().map(String::as_str);
    let found = all.find(|(_, column)| column.name() == key);
    found.ok_or_else(|| PlotError::unknown(sweep.path(), format!("the key {key}"), key, names))
}

/// The index of a value of a key; numbers are compared to nine digits.
fn index_of(sweep: &StoredSweep, column: &SweptKey, value: &str) -> Result<usize, PlotError> {
    /// Largest number of values in a message.
    const MOST_NUMBERS_SHOWN: usize = 12;
    let key = column.name();
    if let Values::Texts(words) = &column.values {
        let found = words.iter().position(|word| word == value);
        let words = words.iter().map(String::as_str);
        let said = || format!("{key} = {value}");
        return found.ok_or_else(|| PlotError::unknown(sweep.path(), said(), value, words));
    }
    let numbers = (0..column.values.count()).filter_map(|i| column.values.number(i));
    let wanted = value.parse::<f64>().unwrap_or(f64::NAN);
    let is_wanted = |number: f64| (number - wanted).abs() <= 1e-9 * number.abs();
    if let Some(found) = numbers.clone().position(is_wanted) {
        return Ok(found);
    }
    let allowed = if column.values.count() <= MOST_NUMBERS_SHOWN {
        let numbers: Vec<String> = numbers.map(|number| number.to_string()).collect();
        numbers.join(", ")
    } else {
        let low = numbers.clone().fold(f64::INFINITY, f64::min);
        let high = numbers.fold(f64::NEG_INFINITY, f64::max);
        format!("{} values from {low} to {high}", column.values.count())
    };
    let (path, file) = (sweep.path(), sweep.path().display());
    let sentence = format!("{key} = {value} does not exist in {file}; choose one of {allowed}");
    Err(PlotError::refused(Some(path), sentence))
}

/// 5 %, 50 % and 95 % quantiles of values, without NaN.
pub(super) fn quantiles(values: impl Iterator<Item = f64>) -> Option<[f64; 3]> {
    let mut known: Vec<f64> = values.filter(|v| v.is_finite()).collect();
    if known.is_empty() {
        return None;
    }
    known.sort_by(f64::total_cmp);
    let last = (known.len() - 1) as f64;
    Some(SHARES.map(|share| {
        let place = share * last;
        let (low, part) = (place.floor() as usize, place.fract());
        let high = (low + 1).min(known.len() - 1);
        known[low] + part * (known[high] - known[low])
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_between_values() {
        let found = quantiles([4.0, f64::NAN, 0.0, 1.0, 2.0, 3.0].into_iter());
        assert_eq!(found, Some([0.2, 2.0, 3.8]));
        assert_eq!(quantiles([f64::NAN].into_iter()), None);
    }
}
