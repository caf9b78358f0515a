//! The remainder at any point of a table: interpolated cells, tail, exact static part.

use crate::content::{FIELDS, Slice};
use crate::error::LookupError;
use crate::stencil::Stencil;
use crate::table::Table;
use crate::tail::Tail;
use halfspace::{Kernel, Medium, Profile, Six};

/// Largest coarsening: a cell of 2^20 table cells.
const MAX_COARSENING: u32 = 20;

/// What comes with the cells of a trace.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TraceInfo {
    /// Static field under a unit force, closed form.
    pub static_part: Six,
    /// Width of the cells filled, in r0/c1.
    pub cell_width: f64,
    /// Estimated absolute error of the response to a unit-peak pulse ten cells long; longer pulses
    /// have less, see [`Table::error`].
    pub error: Six,
}

/// What is assumed of the force between samples one cell apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Smoothness {
    /// Linear between samples: the cells are plain averages and the sum is exact.
    Linear,
    /// A smooth function of time: the first moments of the cells correct for its curvature.
    ///
    /// ```text
    /// cell_j = Rbar_j - (M_{j+1} - M_{j-1})/2,   cell_0 = Rbar_0 - M_0 - M_1/2,   cell_1 = Rbar_1 + M_0 - M_2/2
    /// ```
    ///
    /// Used in the same sum, they leave an error of third order in the cell width where linear
    /// samples leave second order, also where a front crosses a cell.
    Smooth,
}

impl Table {
    /// Fills `cells[j]` with the average of R over [j w, (j + 1) w], w = 2^`coarsening` table cells.
    ///
    /// Any number of cells may be asked for: beyond the tabulated ones the tail continues them.
    ///
    /// Cells before the first arrival are minus the static part only to the interpolation error. They are
    /// not set to it: around a front the errors of neighbouring cells cancel, because the time integral
    /// of R is smooth in space behind the front, and exact cells ahead of it would break that balance
    /// (error for pulses of 40 r0/c1: 1e-4 instead of 1e-7).
    ///
    /// # Errors
    /// [`LookupError`] when a coordinate, Poisson's ratio or the coarsening is outside the table.
    pub fn trace(
        &self,
        poisson_ratio: f64,
        r: f64,
        z: f64,
        coarsening: u32,
        cells: &mut [Six],
    ) -> Result<TraceInfo, LookupError> {
        self.trace_for(Smoothness::Linear, poisson_ratio, r, z, coarsening, cells)
    }

    /// [`Self::trace`] with the cells that suit what is known of the force.
    ///
    /// # Errors
    /// As [`Self::trace`].
    pub fn trace_for(
        &self,
        smoothness: Smoothness,
        poisson_ratio: f64,
        r: f64,
        z: f64,
        coarsening: u32,
        cells: &mut [Six],
    ) -> Result<TraceInfo, LookupError> {
        if coarsening > MAX_COARSENING {
            return Err(LookupError::Coarsening {
                value: coarsening,
                max: MAX_COARSENING,
            });
        }
        let points = self.content().stencil_points;
        let across = Stencil::mirrored(&self.content().r, r, points);
        let down = Stencil::one_sided(&self.content().z, z, points);
        let (across, down) = across.zip(down).ok_or_else(|| self.outside(r, z))?;
        let weights = self.slice_weights(poisson_ratio)?;
        let static_part = match weights.as_slice() {
            [(index, _)] => self.kernel(*index).static_field(r, z)?,
            _ => Kernel::new(&Medium::new(poisson_ratio)?, Profile::Hertz, 1e-6)?
                .static_field(r, z)?,
        };
        let cell_width = self.cell_width() * f64::from(1_u32 << coarsening);
        let error = self.error(poisson_ratio, r, z, 10.0 * cell_width)?;

        cells.fill([0.0; FIELDS]);
        let mut moments = vec![[0.0; FIELDS]; moment_count(smoothness, cells.len())];
        let wanted = cells
            .len()
            .max(moments.len())
            .saturating_mul(1 << coarsening);
        for (index, weight) in weights {
            let slice = &self.content().slices[index];
            let place = Place {
                table: self,
                slice,
                across: &across,
                down: &down,
            };
            place
                .series(wanted, smoothness)
                .add(weight, coarsening, cells, &mut moments);
        }
        finish(smoothness, cells, &moments);
        Ok(TraceInfo {
            static_part,
            cell_width,
            error,
        })
    }
}

/// The remainder at one point in all its fields: table cells, their first moments, tails.
#[derive(Debug, Clone)]
pub struct Series {
    width: f64,
    stored: usize,
    averages: Vec<f64>,
    moments: Vec<f64>,
    tails: Vec<Tail>,
}

impl Series {
    /// A series from its numbers, each of shape (field, time) or (field, term); `width` is that of a cell.
    #[must_use]
    pub fn new(
        width: f64,
        cells: usize,
        averages: Vec<f64>,
        moments: Vec<f64>,
        tail: &[f64],
    ) -> Self {
        let terms = (tail.len() / FIELDS).max(1);
        let end = cells as f64 * width;
        let tails = tail
            .chunks_exact(terms)
            .map(|c| Tail::new(end, c))
            .collect();
        let stored = averages.len() / FIELDS;
        Self {
            width,
            stored,
            averages,
            moments,
            tails,
        }
    }

    /// Fills `cells` with averages over 2^`coarsening` table cells, corrected as `smoothness` says.
    pub fn fill(&self, smoothness: Smoothness, coarsening: u32, cells: &mut [Six]) {
        cells.fill([0.0; FIELDS]);
        let mut moments = vec![[0.0; FIELDS]; moment_count(smoothness, cells.len())];
        self.add(1.0, coarsening, cells, &mut moments);
        finish(smoothness, cells, &moments);
    }

    /// Adds `weight` times the cells, and moments if `moments` is not empty.
    fn add(&self, weight: f64, coarsening: u32, cells: &mut [Six], moments: &mut [Six]) {
        let fine = 1_usize << coarsening;
        for (field, tail) in self.tails.iter().enumerate() {
            let row = field * self.stored..(field + 1) * self.stored;
            let average = &self.averages[row.clone()];
            for (j, cell) in cells.iter_mut().enumerate() {
                cell[field] += weight * coarse_average(average, tail, j, fine, self.width);
            }
            for (j, cell) in moments.iter_mut().enumerate() {
                let moment = &self.moments[row.clone()];
                cell[field] += weight * coarse_moment(average, moment, tail, j, fine, self.width);
            }
        }
    }
}

/// Moments needed for the correction of `cells` cells: one more than the cells.
fn moment_count(smoothness: Smoothness, cells: usize) -> usize {
    match smoothness {
        Smoothness::Linear => 0,
        Smoothness::Smooth => cells + 1,
    }
}

fn finish(smoothness: Smoothness, cells: &mut [Six], moments: &[Six]) {
    match smoothness {
        Smoothness::Linear => {}
        Smoothness::Smooth => correct_for_curvature(cells, moments),
    }
}

/// One point of one slice.
struct Place<'a> {
    table: &'a Table,
    slice: &'a Slice,
    across: &'a Stencil,
    down: &'a Stencil,
}

impl Place<'_> {
    /// The interpolated series, as much of it as `wanted` cells need.
    fn series(&self, wanted: usize, smoothness: Smoothness) -> Series {
        let cells = self.slice.cells;
        let stored = wanted.min(cells);
        let moments = match smoothness {
            Smoothness::Linear => Vec::new(),
            Smoothness::Smooth => self.interpolate(&self.slice.moment, cells, stored),
        };
        let averages = self.interpolate(&self.slice.remainder, cells, stored);
        let terms = self
            .slice
            .tail_terms(self.table.content().r.len() * self.table.content().z.len());
        let tail = self.interpolate(&self.slice.tail, terms, terms);
        Series::new(self.table.cell_width(), cells, averages, moments, &tail)
    }

    /// Weighted sum over the stencil of the first `used` of `length` values, for each field in turn.
    fn interpolate(&self, values: &[f32], length: usize, used: usize) -> Vec<f64> {
        let mut sums = vec![0.0; FIELDS * used];
        if used == 0 {
            return sums;
        }
        let depth = self.table.content().z.len();
        for (field, sum) in sums.chunks_exact_mut(used).enumerate() {
            let across = if halfspace::FIELDS[field].is_odd_in_r() {
                self.across.odd()
            } else {
                self.across.even()
            };
            for (&i, &wr) in self.across.nodes().iter().zip(across) {
                for (&k, &wz) in self.down.nodes().iter().zip(self.down.even()) {
                    let weight = wr * wz;
                    let start = ((i * depth + k) * FIELDS + field) * length;
                    for (s, &v) in sum.iter_mut().zip(&values[start..start + used]) {
                        *s += weight * f64::from(v);
                    }
                }
            }
        }
        sums
    }
}

/// Average over coarse cell `j` of `fine` cells, of which the stored ones come first.
fn coarse_average(stored: &[f64], tail: &Tail, j: usize, fine: usize, width: f64) -> f64 {
    let (from, to) = (j * fine, (j + 1) * fine);
    let inside = from.min(stored.len())..to.min(stored.len());
    let sum = pairwise(&stored[inside.clone()]);
    if inside.len() == fine {
        return sum / fine as f64;
    }
    let start = from.max(stored.len()) as f64 * width;
    let end = to as f64 * width;
    (sum * width + tail.average(start, end) * (end - start)) / (fine as f64 * width)
}

/// Sum by halves: a coarse cell is then exactly the mean of its two halves.
fn pairwise(values: &[f64]) -> f64 {
    match values {
        [] => 0.0,
        [one] => *one,
        _ => {
            let (left, right) = values.split_at(values.len().next_power_of_two() / 2);
            pairwise(left) + pairwise(right)
        }
    }
}

/// First moment over coarse cell `j` from the averages and moments of its parts.
fn coarse_moment(
    averages: &[f64],
    moments: &[f64],
    tail: &Tail,
    j: usize,
    fine: usize,
    width: f64,
) -> f64 {
    let (from, to) = (j * fine, (j + 1) * fine);
    let coarse = fine as f64 * width;
    let centre = (from + to) as f64 * 0.5 * width;
    let mut sum = 0.0;
    for k in from.min(averages.len())..to.min(averages.len()) {
        sum +=
            width * width * moments[k] + width * averages[k] * ((k as f64 + 0.5) * width - centre);
    }
    if to > averages.len() {
        // After the last arrival R is smooth: a sixth of the step between the halves.
        let (start, end) = (from.max(averages.len()) as f64 * width, to as f64 * width);
        let (middle, part) = (0.5 * (start + end), end - start);
        let (left, right) = (tail.average(start, middle), tail.average(middle, end));
        sum += part * part * (right - left) / 6.0 + part * 0.5 * (left + right) * (middle - centre);
    }
    sum / (coarse * coarse)
}

/// Turns averages into the cells of [`Smoothness::Smooth`]; `moments` has one more entry than `cells`.
pub fn correct_for_curvature(cells: &mut [Six], moments: &[Six]) {
    for f in 0..FIELDS {
        for (j, cell) in cells.iter_mut().enumerate() {
            let before = if j == 0 {
                2.0 * moments[0][f]
            } else {
                moments[j - 1][f]
            };
            let sign = if j == 0 { -1.0 } else { 1.0 };
            cell[f] -= 0.5 * (moments[j + 1][f] - sign * before);
            if j == 1 {
                cell[f] += 0.5 * moments[0][f];
            }
        }
    }
}
