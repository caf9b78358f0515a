//! Remainder at one point over time: table cells with their moments, wider cells, and the tail.
//!
//! Modules: interpolation between nodes (`stencil`, `gather`), forces between samples (`smooth`), and the time after
//! the last cell (`tail`).

pub(crate) mod gather;
pub(crate) mod smooth;
pub(crate) mod stencil;
pub(crate) mod tail;

use crate::content::FIELDS;
use crate::series::tail::Tail;
use halfspace::Six;
use pulp::{Arch, Simd, WithSimd};
use std::ops::Range;

/// Assumption about the force between samples one cell apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Smoothness {
    /// Linear between samples; the cells are plain averages and the sum is exact.
    Linear,
    /// A smooth function of time; the first and second moments of the cells account for its slope and curvature within
    /// a cell.
    ///
    /// In the same sum the error is then of fourth order in the cell width instead of second, also if a front crosses a
    /// cell.
    Smooth,
}

/// All fields of the remainder at one point: averages, moments and curvatures of the table's cells, and the tail.
#[derive(Debug, Clone)]
pub struct Series {
    width: f64,
    /// Averages, moments and curvatures by cell; the last two may be empty.
    cells: [Vec<Six>; 3],
    tail: Tail,
}

/// Averages, first and second moments of the remainder over consecutive cells, see [`Series::moments`].
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Moments {
    /// Averages.
    pub averages: Vec<Six>,
    /// First moments, in cell widths.
    pub first: Vec<Six>,
    /// Second moments minus a twelfth of the averages, in squares of cell widths.
    pub second: Vec<Six>,
}

impl Moments {
    /// No cells, with room for `count` of them.
    pub fn with_capacity(count: usize) -> Self {
        let [averages, first, second] = [(); 3].map(|()| Vec::with_capacity(count));
        Self {
            averages,
            first,
            second,
        }
    }

    /// Appends a cell.
    pub fn push(&mut self, [average, first, second]: [Six; 3]) {
        self.averages.push(average);
        self.first.push(first);
        self.second.push(second);
    }

    /// The averages corrected with the moments for a smooth force, without the last [`smooth::BEYOND`] cells.
    pub fn absorbed(&self) -> Vec<Six> {
        let count = self.averages.len().saturating_sub(smooth::BEYOND);
        let mut cells = self.averages[..count].to_vec();
        smooth::absorb(&mut cells, &self.first, &self.second);
        cells
    }
}

/// Numbers of a [`Series`] in the order of [`Slice::lists`](crate::Slice::lists): averages, first and second moments by
/// cell, and the coefficients of the tail by term.
///
/// The moments may be empty if only [`Smoothness::Linear`] is used.
pub type Numbers = [Vec<Six>; 4];

/// Rounds numbers to the precision of a table.
pub fn round(numbers: &mut Numbers) {
    for field in 0..FIELDS {
        let quantum = resolution(&numbers[0], field);
        for six in &mut numbers[0] {
            six[field] = (six[field] / quantum).round() * quantum;
        }
    }
    for value in numbers.iter_mut().flatten().flatten() {
        *value = f64::from(*value as f32);
    }
}

/// Resolution of stored averages of a field: that of single precision at its largest average in time.
///
/// All averages have this absolute resolution, and therefore compress better.
fn resolution(averages: &[Six], field: usize) -> f64 {
    /// Number of bits after the leading one.
    const BITS: i32 = 24;
    let most = averages
        .iter()
        .fold(0.0_f64, |most, six| most.max(six[field].abs()));
    most.max(f64::from(f32::MIN_POSITIVE)).log2().floor().exp2() * 0.5_f64.powi(BITS)
}

impl Series {
    /// A series from its numbers; `width` is the width of a cell in r0/c1, and the tail begins after `cells` cells.
    pub fn new(width: f64, cells: usize, [averages, first, second, tail]: Numbers) -> Self {
        Self {
            width,
            cells: [averages, first, second],
            tail: Tail::new(cells as f64 * width, &tail),
        }
    }

    /// Width of a table cell in r0/c1.
    pub fn width(&self) -> f64 {
        self.width
    }

    /// Fills `cells` with averages over 2^`coarsening` table cells, corrected for the `smoothness` of the force.
    pub fn fill(&self, smoothness: Smoothness, coarsening: u32, cells: &mut [Six]) {
        let (part, count) = (f64::from(coarsening).exp2(), cells.len());
        match smoothness {
            Smoothness::Linear => {
                self.fill_averages(part, cells);
            }
            Smoothness::Smooth => {
                let moments = self.moments(part * self.width, count + smooth::BEYOND);
                cells.copy_from_slice(&moments.absorbed());
            }
        }
    }

    /// Averages, first and second moments over `count` cells of any `width` in r0/c1.
    ///
    /// ```text
    /// int R ds,   int R s ds,   int R (s^2 - 1/12) ds,   s from -1/2 to 1/2 over a cell
    /// ```
    ///
    /// If an edge cuts a table cell, R is the parabola that has the three numbers of that cell.
    pub fn moments(&self, width: f64, count: usize) -> Moments {
        let part = self.part(width);
        let mut found = Moments::with_capacity(count);
        // the moments may be empty
        let whole = self.whole(part, count).min(self.cells[1].len());
        found.averages.extend_from_slice(&self.cells[0][..whole]);
        found.first.extend_from_slice(&self.cells[1][..whole]);
        found.second.extend_from_slice(&self.cells[2][..whole]);
        self.dispatch(part, whole..count, |_, cell| found.push(cell));
        found
    }

    /// Averages over `count` cells of any `width` in r0/c1.
    pub fn averages(&self, width: f64, count: usize) -> Vec<Six> {
        let mut found = vec![Six::default(); count];
        self.fill_averages(self.part(width), &mut found);
        found
    }

    /// Fills `cells` with averages over cells that are `part` table cells wide.
    fn fill_averages(&self, part: f64, cells: &mut [Six]) {
        let count = cells.len();
        let whole = self.whole(part, count);
        cells[..whole].copy_from_slice(&self.cells[0][..whole]);
        let keep = |j: usize, [average]: [Six; 1]| cells[j] = average;
        self.dispatch(part, whole..count, keep);
    }

    /// A width over that of a table cell; made exact if it is a whole number up to rounding.
    fn part(&self, width: f64) -> f64 {
        let part = width / self.width;
        let whole = part.round();
        if (part - whole).abs() < 1e-9 * part {
            whole
        } else {
            part
        }
    }

    /// Number of the first of `count` cells, `part` table cells wide, that equal cells of the table.
    fn whole(&self, part: f64, count: usize) -> usize {
        let stored = if part == 1.0 { self.cells[0].len() } else { 0 };
        stored.min(count)
    }

    /// [`Self::for_each_cell`] in vector registers; the result is bit-identical on every machine.
    fn dispatch<const N: usize>(
        &self,
        part: f64,
        cells: Range<usize>,
        keep: impl FnMut(usize, [Six; N]),
    ) {
        struct EachCell<'a, F, const N: usize>(&'a Series, f64, Range<usize>, F);
        impl<F: FnMut(usize, [Six; N]), const N: usize> WithSimd for EachCell<'_, F, N> {
            type Output = ();

            #[inline(always)]
            fn with_simd<S: Simd>(self, _: S) {
                self.0.for_each_cell(self.1, self.2, self.3);
            }
        }
        Arch::new().dispatch(EachCell(self, part, cells, keep));
    }

    /// Passes `keep` the first `N` numbers of each of some cells that are `part` table cells wide.
    #[inline(always)]
    fn for_each_cell<const N: usize>(
        &self,
        part: f64,
        cells: Range<usize>,
        mut keep: impl FnMut(usize, [Six; N]),
    ) {
        let stored = self.cells[0].len() as f64;
        let ends = |j: usize| [j as f64 * part, (j + 1) as f64 * part];
        // after the last arrival R is smooth: moments follow from differences of thirds
        let parts = if N > 1 { 3 } else { 1 };
        let first = cells.clone().find(|&j| ends(j)[1] > stored);
        let first = first.unwrap_or(cells.end);
        let edge = |n: usize| {
            let [from, to] = ends(first + n / parts);
            let start = from.max(stored);
            (start + (to - start) * (n % parts) as f64 / parts as f64) * self.width
        };
        let mut edges = vec![0.0; 1 + (cells.end - first) * parts];
        for (n, own) in edges.iter_mut().enumerate() {
            *own = edge(n);
        }
        let integrals = self.tail.integrals(&edges);
        for j in cells {
            let [from, to] = ends(j);
            let mut sums = [[0.0; FIELDS]; N];
            let (width, centre) = (to - from, 0.5 * (from + to));
            let mut start = from;
            while start < to.min(stored) {
                let k = start as usize;
                let end = to.min((k + 1) as f64);
                let place = [
                    (0.5 * (start + end) - centre) / width,
                    (end - start) / width,
                ];
                // the moments may be empty
                let own =
                    std::array::from_fn(|i| self.cells[i].get(k).copied().unwrap_or_default());
                if end - start == 1.0 {
                    add(place, &own, &mut sums);
                } else {
                    let within = [start - k as f64, end - k as f64];
                    add(place, &of_part(&own, within), &mut sums);
                }
                start = end;
            }
            if to > stored {
                let start = from.max(stored);
                let n = (j - first) * parts;
                let over = |n: usize, end: usize, duration: f64| -> Six {
                    let (scale, from, to) =
                        (self.tail.scale(duration), &integrals[n], &integrals[end]);
                    std::array::from_fn(|f| scale * (from[f] - to[f]))
                };
                let mut own = [[0.0; FIELDS]; N];
                own[0] = over(n, n + parts, (to - start) * self.width);
                if N > 1 {
                    let third = |n: usize| over(n, n + 1, edges[n + 1] - edges[n]);
                    let [a, b, c] = [n, n + 1, n + 2].map(third);
                    own[1] = std::array::from_fn(|f| (c[f] - a[f]) / 8.0);
                    own[2] = std::array::from_fn(|f| (a[f] - 2.0 * b[f] + c[f]) / 40.0);
                }
                let place = [(0.5 * (start + to) - centre) / width, (to - start) / width];
                add(place, &own, &mut sums);
            }
            keep(j, sums);
        }
    }
}

/// Adds a part of a cell, `x` cells from its centre and `part` of a cell wide, to the numbers of the cell.
#[inline(always)]
fn add<const N: usize>([x, part]: [f64; 2], own: &[Six; N], sums: &mut [Six; N]) {
    for f in 0..FIELDS {
        let average = own[0][f];
        sums[0][f] += part * average;
        if N > 1 {
            let (moment, bend) = (own[1][f], own[2][f]);
            let (square, wide) = (x * x, part * part);
            sums[1][f] += part * (x * average + part * moment);
            sums[2][f] += part
                * (2.0 * x * part * moment
                    + wide * bend
                    + (square + (wide - 1.0) / 12.0) * average);
        }
    }
}

/// The numbers of the part [from, to] of a cell [0, 1], from those of the whole cell.
#[inline(always)]
fn of_part<const N: usize>(whole: &[Six; N], [from, to]: [f64; 2]) -> [Six; N] {
    let (x, width) = (0.5 * (from + to) - 0.5, to - from);
    let mut part = *whole;
    if N > 1 {
        for f in 0..FIELDS {
            // R = average + 12 moment y + 180 bend (y^2 - 1/12)
            let (slope, curve) = (12.0 * whole[1][f], 180.0 * whole[2][f]);
            part[0][f] += slope * x + curve * (x * x + (width * width - 1.0) / 12.0);
            part[1][f] = (slope + 2.0 * curve * x) * width / 12.0;
            part[2][f] = curve * width * width / 180.0;
        }
    }
    part
}

#[cfg(test)]
mod tests {
    use super::*;

    /// R = t^2 in cells of width 1, no tail: moments of wide cells against the integrals.
    #[test]
    fn moments_of_wide_cells_are_those_of_the_function() {
        let per_field = |f: fn(f64) -> f64| -> Vec<Six> {
            (0..16).map(|j| [f(f64::from(j) + 0.5); FIELDS]).collect()
        };
        let numbers = [
            per_field(|t| t * t + 1.0 / 12.0),
            per_field(|t| t / 6.0),
            per_field(|_| 1.0 / 180.0),
            vec![[0.0; FIELDS]],
        ];
        let series = Series::new(1.0, 16, numbers);
        // any width, also widths whose edges cut table cells
        for width in [0.37, 1.0, 1.9, 2.0, 4.0, 8.0] {
            let count = (15.9 / width) as usize;
            let found = series.moments(width, count);
            for j in 0..count {
                let centre = (j as f64 + 0.5) * width;
                let square = width * width;
                let exact = [
                    centre * centre + square / 12.0,
                    centre * width / 6.0,
                    square / 180.0,
                ];
                let own = [found.averages[j][1], found.first[j][1], found.second[j][1]];
                for (a, b) in own.iter().zip(exact) {
                    assert!((a - b).abs() < 1e-10, "{width} {j}: {own:?} {exact:?}");
                }
            }
        }
    }
}
