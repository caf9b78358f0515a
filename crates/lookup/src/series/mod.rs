//! The remainder at one point in time: table cells with their moments, wider cells, the tail.
//!
//! Between nodes (`stencil`, `gather`), between samples (`smooth`), after the last cell (`tail`).

pub(crate) mod gather;
pub(crate) mod smooth;
pub(crate) mod stencil;
pub(crate) mod tail;

use crate::content::FIELDS;
use crate::series::tail::Tail;
use halfspace::Six;
use pulp::{Arch, Simd, WithSimd};

/// What is assumed of the force between samples one cell apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Smoothness {
    /// Linear between samples: the cells are plain averages and the sum is exact.
    Linear,
    /// A smooth function of time: first and second moments of the cells account for its slope and curvature
    /// within a cell.
    ///
    /// Used in the same sum, the cells leave an error of fourth order in the cell width where linear
    /// samples leave second order, also where a front crosses a cell.
    Smooth,
}

/// The remainder at one point in all its fields: averages, moments and curvatures of the table's cells, and the tail.
#[derive(Debug, Clone)]
pub struct Series {
    width: f64,
    /// Averages, moments and curvatures, cell by cell; the last two may be empty.
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
    /// Second moments about a twelfth, in squares of cell widths.
    pub second: Vec<Six>,
}

impl Moments {
    /// Of a field that is zero.
    #[must_use]
    pub fn zero(count: usize) -> Self {
        Self {
            averages: vec![[0.0; FIELDS]; count],
            first: vec![[0.0; FIELDS]; count],
            second: vec![[0.0; FIELDS]; count],
        }
    }

    /// The cells but for the last [`smooth::BEYOND`], with what their moments are worth under a smooth force.
    #[must_use]
    pub fn absorbed(&self) -> Vec<Six> {
        let count = self.averages.len().saturating_sub(smooth::BEYOND);
        let mut cells = self.averages[..count].to_vec();
        smooth::absorb(&mut cells, &self.first, &self.second);
        cells
    }
}

/// The numbers of a [`Series`], each of shape (field, time) or (field, term).
///
/// Moments and curvatures may be left empty where only [`Smoothness::Linear`] is asked for.
#[derive(Debug, Clone, Default)]
pub struct Numbers {
    /// Averages over the cells.
    pub averages: Vec<f64>,
    /// First moments of the cells.
    pub moments: Vec<f64>,
    /// Second moments of the cells.
    pub curvatures: Vec<f64>,
    /// Coefficients of the tail.
    pub tail: Vec<f64>,
}

impl Series {
    /// A series from its numbers; `width` is that of a cell, and the tail follows after `cells` of them.
    #[must_use]
    pub fn new(width: f64, cells: usize, numbers: Numbers) -> Self {
        let lists = [numbers.averages, numbers.moments, numbers.curvatures];
        let by_cell = |list: Vec<f64>| -> Vec<Six> {
            let count = list.len() / FIELDS;
            let cell = |k| std::array::from_fn(|field| list[field * count + k]);
            (0..count).map(cell).collect()
        };
        Self {
            width,
            cells: lists.map(by_cell),
            tail: Tail::new(cells as f64 * width, &numbers.tail),
        }
    }

    /// Width of a table cell in r0/c1.
    #[must_use]
    pub fn width(&self) -> f64 {
        self.width
    }

    /// Fills `cells` with averages over 2^`coarsening` table cells, corrected as `smoothness` says.
    pub fn fill(&self, smoothness: Smoothness, coarsening: u32, cells: &mut [Six]) {
        let part = f64::from(coarsening).exp2();
        match smoothness {
            Smoothness::Linear => {
                self.for_each_cell::<1>(part, cells.len(), |j, [average]| cells[j] = average);
            }
            Smoothness::Smooth => {
                let count = cells.len() + smooth::BEYOND;
                let moments = self.moments(part * self.width, count);
                cells.copy_from_slice(&moments.absorbed());
            }
        }
    }

    /// Averages, first and second moments over `count` cells of any width, in r0/c1.
    ///
    /// ```text
    /// int R ds,   int R s ds,   int R (s^2 - 1/12) ds,   s from -1/2 to 1/2 over a cell
    /// ```
    ///
    /// Where an edge cuts a table cell, R is the parabola of its three numbers there.
    #[must_use]
    pub fn moments(&self, width: f64, count: usize) -> Moments {
        let part = width / self.width;
        // a width that is a whole number of cells to rounding is exactly that
        let whole = part.round();
        let part = if (part - whole).abs() < 1e-9 * part {
            whole
        } else {
            part
        };
        /// In vector registers; the same bits on every machine.
        struct Work<'a>(&'a Series, f64, usize);
        impl WithSimd for Work<'_> {
            type Output = Moments;

            #[inline(always)]
            fn with_simd<S: Simd>(self, _: S) -> Moments {
                let Self(series, part, count) = self;
                let mut found = Moments::zero(count);
                series.for_each_cell(part, count, |j, [average, first, second]| {
                    found.averages[j] = average;
                    found.first[j] = first;
                    found.second[j] = second;
                });
                found
            }
        }
        Arch::new().dispatch(Work(self, part, count))
    }

    /// Tells `keep` the first `N` numbers of each of `count` cells that are `part` table cells wide.
    #[inline(always)]
    fn for_each_cell<const N: usize>(
        &self,
        part: f64,
        count: usize,
        mut keep: impl FnMut(usize, [Six; N]),
    ) {
        let stored = self.cells[0].len() as f64;
        // the tail's integral where the cell before ended
        let mut near = None;
        for j in 0..count {
            let (from, to) = (j as f64 * part, (j + 1) as f64 * part);
            let mut sums = [[0.0; FIELDS]; N];
            let (width, centre) = (to - from, 0.5 * (from + to));
            let mut start = from;
            while start < to.min(stored) {
                let k = start as usize;
                let edge = (k + 1) as f64;
                let end = to.min(edge);
                let place = [
                    (0.5 * (start + end) - centre) / width,
                    (end - start) / width,
                ];
                let own = std::array::from_fn(|i| self.cells[i][k]);
                if end - start == 1.0 {
                    add(place, &own, &mut sums);
                } else {
                    let within = [start - k as f64, end - k as f64];
                    add(place, &of_part(&own, within), &mut sums);
                }
                start = end;
            }
            if to > stored {
                // after the last arrival R is smooth: differences of thirds
                let start = from.max(stored);
                let edge = |i: f64| (start + (to - start) * i / 3.0) * self.width;
                let at = |i: f64| self.tail.integral(edge(i));
                let begun = near.unwrap_or_else(|| at(0.0));
                let ended = at(3.0);
                let over = |[from, to]: [&Six; 2], [start, end]: [f64; 2]| -> Six {
                    let duration = edge(end) - edge(start);
                    std::array::from_fn(|f| self.tail.average(from[f] - to[f], duration))
                };
                let mut own = [[0.0; FIELDS]; N];
                let (duration, nominal) = (edge(3.0) - edge(0.0), (to - start) * self.width);
                own[0] = over([&begun, &ended], [0.0, 3.0]).map(|a| a * duration / nominal);
                if N > 1 {
                    let (second, third) = (at(1.0), at(2.0));
                    let a = over([&begun, &second], [0.0, 1.0]);
                    let b = over([&second, &third], [1.0, 2.0]);
                    let c = over([&third, &ended], [2.0, 3.0]);
                    own[1] = std::array::from_fn(|f| (c[f] - a[f]) / 8.0);
                    own[2] = std::array::from_fn(|f| (a[f] - 2.0 * b[f] + c[f]) / 40.0);
                }
                near = Some(ended);
                let place = [(0.5 * (start + to) - centre) / width, (to - start) / width];
                add(place, &own, &mut sums);
            }
            keep(j, sums);
        }
    }
}

/// Adds to the numbers of a cell those of a part of it that lies `x` cells from its centre and is `part` of a cell wide.
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

/// The numbers of the part [from, to] of a cell [0, 1] from those of the whole.
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
        let per_field = |f: fn(f64) -> f64| -> Vec<f64> {
            (0..FIELDS)
                .flat_map(|_| (0..16).map(move |j| f(f64::from(j) + 0.5)))
                .collect()
        };
        let numbers = Numbers {
            averages: per_field(|t| t * t + 1.0 / 12.0),
            moments: per_field(|t| t / 6.0),
            curvatures: per_field(|_| 1.0 / 180.0),
            tail: vec![0.0; FIELDS],
        };
        let series = Series::new(1.0, 16, numbers);
        // any width, also where edges cut table cells
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
