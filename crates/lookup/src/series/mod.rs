//! The remainder at one point in time: table cells with their moments, wider cells, the tail.
//!
//! Between nodes (`stencil`, `gather`), between samples (`smooth`), after the last cell (`tail`).

pub(crate) mod gather;
pub(crate) mod smooth;
pub(crate) mod stencil;
pub(crate) mod tail;

use crate::content::FIELDS;
use crate::series::tail::{Integrals, Tail};
use halfspace::Six;

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

/// The remainder at one point in all its fields: averages, moments and curvatures of the table's cells, tails.
#[derive(Debug, Clone)]
pub struct Series {
    width: f64,
    stored: usize,
    averages: Vec<f64>,
    moments: Vec<f64>,
    curvatures: Vec<f64>,
    tails: Vec<Tail>,
    integrals: Integrals,
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
        let terms = (numbers.tail.len() / FIELDS).max(1);
        let end = cells as f64 * width;
        let tails: Vec<Tail> = numbers
            .tail
            .chunks_exact(terms)
            .map(|c| Tail::new(end, c))
            .collect();
        Self {
            width,
            stored: numbers.averages.len() / FIELDS,
            integrals: Integrals::new(&tails),
            tails,
            averages: numbers.averages,
            moments: numbers.moments,
            curvatures: numbers.curvatures,
        }
    }

    /// Width of a table cell in r0/c1.
    #[must_use]
    pub fn width(&self) -> f64 {
        self.width
    }

    /// Fills `cells` with averages over 2^`coarsening` table cells, corrected as `smoothness` says.
    pub fn fill(&self, smoothness: Smoothness, coarsening: u32, cells: &mut [Six]) {
        let fine = 1_usize << coarsening;
        let whole = (self.stored / fine).min(cells.len());
        for field in 0..FIELDS {
            let averages = self.row(&self.averages, field);
            for (j, cell) in cells[..whole].iter_mut().enumerate() {
                cell[field] = match fine {
                    1 => averages[j],
                    _ => pairwise(&averages[j * fine..(j + 1) * fine]) / fine as f64,
                };
            }
        }
        self.continue_from(whole, fine, cells);
        match smoothness {
            Smoothness::Linear => {}
            Smoothness::Smooth => self.correct(fine, cells),
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
        // a width that is a power of two of cells to rounding is exactly that
        let whole = part.round();
        let part = if (part - whole).abs() < 1e-9 * part {
            whole
        } else {
            part
        };
        let mut found = Moments::zero(count);
        for (field, tail) in self.tails.iter().enumerate() {
            let rows =
                [&self.averages, &self.moments, &self.curvatures].map(|v| self.row(v, field));
            for j in 0..count {
                let (from, to) = (j as f64 * part, (j + 1) as f64 * part);
                let [average, first, second] = self.over(rows, tail, from, to);
                found.averages[j][field] = average;
                found.first[j][field] = first;
                found.second[j][field] = second;
            }
        }
        found
    }

    /// The three numbers of one field over [from, to], in table cells.
    fn over(&self, rows: [&[f64]; 3], tail: &Tail, from: f64, to: f64) -> [f64; 3] {
        let (width, centre) = (to - from, 0.5 * (from + to));
        let stored = self.stored as f64;
        let mut sums = [0.0; 3];
        let mut add = |x: f64, part: f64, [average, moment, bend]: [f64; 3]| {
            sums[0] += part * average;
            sums[1] += part * (x * average + part * moment);
            sums[2] += part
                * (x * x * average
                    + 2.0 * x * part * moment
                    + part * part * (bend + average / 12.0));
        };
        let mut k = from.min(stored) as usize;
        while (k as f64) < to && k < self.stored {
            let (start, end) = (from.max(k as f64), to.min((k + 1) as f64));
            let numbers = [rows[0][k], rows[1][k], rows[2][k]];
            let x = 0.5 * (start + end) - centre;
            if end - start == 1.0 {
                add(x, 1.0, numbers);
            } else if end > start {
                add(
                    x,
                    end - start,
                    of_part(numbers, start - k as f64, end - k as f64),
                );
            }
            k += 1;
        }
        if to > stored {
            let start = from.max(stored);
            let edges = thirds(start, to - start, self.width);
            let [a, b, c] = [0, 1, 2].map(|i| tail.average(edges[i], edges[i + 1]));
            add(0.5 * (start + to) - centre, to - start, of_thirds(a, b, c));
        }
        let average = sums[0] / width;
        [
            average,
            sums[1] / (width * width),
            sums[2] / (width * width * width) - average / 12.0,
        ]
    }

    fn correct(&self, fine: usize, cells: &mut [Six]) {
        let count = cells.len() + smooth::BEYOND;
        // Of these cells a part is stored, of those after them none.
        let mixed = self.stored.div_ceil(fine);
        let (mut moments, mut curvatures) =
            (vec![[0.0; FIELDS]; count], vec![[0.0; FIELDS]; count]);
        for (field, tail) in self.tails.iter().enumerate() {
            for j in 0..count.min(mixed) {
                [moments[j][field], curvatures[j][field]] = self.moments_of(field, tail, j, fine);
            }
        }
        self.continue_moments(mixed, fine, &mut moments, &mut curvatures);
        smooth::absorb(cells, &moments, &curvatures);
    }

    /// Fills the moments of the cells from `first` on, which the tail has whole: all fields at once, each edge once.
    fn continue_moments(
        &self,
        first: usize,
        fine: usize,
        moments: &mut [Six],
        curvatures: &mut [Six],
    ) {
        let mut near = None;
        for j in first..moments.len() {
            let [t0, t1, t2, t3] = thirds((j * fine) as f64, fine as f64, self.width);
            let g0 = near.unwrap_or_else(|| self.integrals.at(t0));
            let [g1, g2, g3] = [t1, t2, t3].map(|t| self.integrals.at(t));
            for f in 0..FIELDS {
                let a = self.integrals.average(g0[f] - g1[f], t1 - t0);
                let b = self.integrals.average(g1[f] - g2[f], t2 - t1);
                let c = self.integrals.average(g2[f] - g3[f], t3 - t2);
                [_, moments[j][f], curvatures[j][f]] = of_thirds(a, b, c);
            }
            near = Some(g3);
        }
    }

    fn row<'a>(&self, values: &'a [f64], field: usize) -> &'a [f64] {
        &values[field * self.stored..(field + 1) * self.stored]
    }

    /// Fills the cells from `whole` on, of which the tail has all or a part: all fields at once, each edge once.
    fn continue_from(&self, whole: usize, fine: usize, cells: &mut [Six]) {
        let mut near = None;
        for (j, cell) in cells.iter_mut().enumerate().skip(whole) {
            let (from, to) = (j * fine, (j + 1) * fine);
            let start = from.max(self.stored) as f64 * self.width;
            let end = to as f64 * self.width;
            let before = near.unwrap_or_else(|| self.integrals.at(start));
            let after = self.integrals.at(end);
            for field in 0..FIELDS {
                let stored = self.row(&self.averages, field);
                let sum = pairwise(&stored[from.min(self.stored)..]);
                let tail = self
                    .integrals
                    .average(before[field] - after[field], end - start);
                cell[field] =
                    (sum * self.width + tail * (end - start)) / (fine as f64 * self.width);
            }
            near = Some(after);
        }
    }

    /// First and second moment over coarse cell `j` from its parts.
    ///
    /// With s = (x + y)/F, x the centre of a part and y within it, both in table cells.
    fn moments_of(&self, field: usize, tail: &Tail, j: usize, fine: usize) -> [f64; 2] {
        let (from, to) = (j * fine, (j + 1) * fine);
        let averages = self.row(&self.averages, field);
        let (moments, curvatures) = (
            self.row(&self.moments, field),
            self.row(&self.curvatures, field),
        );
        let inside = from.min(self.stored)..to.min(self.stored);
        let width = fine as f64;
        if fine == 1 && inside.len() == 1 {
            return [moments[j], curvatures[j]];
        }
        let (mut first, mut second) = (0.0, 0.0);
        let mut add = |x: f64, part: f64, average: f64, moment: f64, curvature: f64| {
            // int R s ds and int R (s^2 - 1/12) ds over a part that is `part` table cells wide
            first += part * (x * average + part * moment) / width;
            let square = x * x * average
                + 2.0 * x * part * moment
                + part * part * (curvature + average / 12.0);
            second += part * (square / (width * width) - average / 12.0);
        };
        let centre = 0.5 * (from + to) as f64;
        for k in inside {
            add(
                k as f64 + 0.5 - centre,
                1.0,
                averages[k],
                moments[k],
                curvatures[k],
            );
        }
        if to > self.stored {
            // After the last arrival R is smooth: differences of thirds.
            let start = from.max(self.stored) as f64;
            let part = to as f64 - start;
            let edges = thirds(start, part, self.width);
            let [a, b, c] = [0, 1, 2].map(|i| tail.average(edges[i], edges[i + 1]));
            let [average, moment, curvature] = of_thirds(a, b, c);
            add(
                start + 0.5 * part - centre,
                part,
                average,
                moment,
                curvature,
            );
        }
        [first / width, second / width]
    }
}

/// The three numbers of the part [from, to] of a cell [0, 1] from those of the whole.
fn of_part([average, moment, bend]: [f64; 3], from: f64, to: f64) -> [f64; 3] {
    let (x, width) = (0.5 * (from + to) - 0.5, to - from);
    // R = average + 12 moment y + 180 bend (y^2 - 1/12)
    let (slope, curve) = (12.0 * moment, 180.0 * bend);
    [
        average + slope * x + curve * (x * x + (width * width - 1.0) / 12.0),
        (slope + 2.0 * curve * x) * width / 12.0,
        curve * width * width / 180.0,
    ]
}

/// Times of the ends and the thirds of a part of a cell, `start` and `part` in table cells.
fn thirds(start: f64, part: f64, width: f64) -> [f64; 4] {
    [0.0, 1.0, 2.0, 3.0].map(|i| (start + part * i / 3.0) * width)
}

/// Average, first and second moment from the averages over thirds.
fn of_thirds(a: f64, b: f64, c: f64) -> [f64; 3] {
    [(a + b + c) / 3.0, (c - a) / 8.0, (a - 2.0 * b + c) / 40.0]
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
        for width in [0.37, 1.0, 1.9, 4.0] {
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
        for fine in [1, 2, 4, 8] {
            for j in 0..16 / fine {
                let width = fine as f64;
                let centre = (j as f64 + 0.5) * width;
                let [first, second] = series.moments_of(2, &series.tails[2], j, fine);
                assert!((first - centre * width / 6.0).abs() < 1e-11);
                assert!((second - width * width / 180.0).abs() < 1e-11);
            }
        }
    }
}
