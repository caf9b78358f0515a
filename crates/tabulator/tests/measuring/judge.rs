//! Whether the error estimate of a table is true, judged by values of R alone.
//!
//! A table is built and verified from traces of R: averages, moments and tails of cells, and pulses summed from them.
//! Here R itself, [`Kernel::remainder`], is integrated against the rate of the force by Gauss's rules between the arrivals,
//! so that kernels are shared and nothing else:
//!
//! ```text
//! u(t) = P(t) u_static + int P'(t - s) R(s) ds
//! ```

use super::observe::Observation;
use super::uniform;
use halfspace::gauss::rule;
use halfspace::{Arrivals, Kernel, Medium, Profile, Six};
use lookup::{Series, Smoothness, Table};
use rayon::prelude::*;
use std::f64::consts::PI;
use tabulator::BuildError;

/// Where places are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Region {
    /// Anywhere in the table, between its slices.
    Between,
    /// Anywhere, on its slices.
    Slices,
    /// Within a quarter of the radius from the axis, on slices and between them.
    Axis,
    /// Within a tenth of the radius below the surface, and on it, on slices and between them.
    Surface,
}

impl Region {
    /// All of them.
    pub(crate) const ALL: [Self; 4] = [Self::Between, Self::Slices, Self::Axis, Self::Surface];

    /// (nu, r, z) from five numbers in [0, 1).
    fn place(self, table: &Table, draws: [f64; 5]) -> [f64; 3] {
        const NEAR_AXIS: f64 = 0.25;
        const SHALLOW: f64 = 0.1;
        let ratios = table.poisson_ratios();
        let (low, high) = (ratios[0], ratios[ratios.len() - 1]);
        let between = low + (high - low) * draws[0];
        let slice = ratios[((draws[0] * ratios.len() as f64) as usize).min(ratios.len() - 1)];
        let either = if draws[3] < 0.5 { slice } else { between };
        let (r, z) = (
            draws[1] * table.content().r_max,
            draws[2] * table.content().z_max,
        );
        match self {
            Self::Between => [between, r, z],
            Self::Slices => [slice, r, z],
            Self::Axis => [either, NEAR_AXIS * draws[1], z],
            Self::Surface => {
                let depth = if draws[4] < 0.3 {
                    0.0
                } else {
                    SHALLOW * draws[2]
                };
                [either, r, depth]
            }
        }
    }
}

/// Judges `places` random places of a region, each with `pulses` pulses sin^4 of 1 to 100 r0/c1.
///
/// The force is taken as it is where it is smooth on the table's cells. Where it is shorter, what a cell's width leaves of
/// it is no error of the table: there averages and moments of the cells, from the same values of R, take the table's place
/// in its own sum. The same `seed` gives the same places.
///
/// # Errors
/// [`BuildError`] where the exact kernels or the table refuse a place.
pub(crate) fn judge(
    table: &Table,
    region: Region,
    places: usize,
    pulses: usize,
    seed: u64,
) -> Result<Vec<Observation>, BuildError> {
    let stride = 5 + pulses as u64;
    let found: Vec<Vec<Observation>> = (0..places as u64)
        .into_par_iter()
        .map(|i| {
            let draw = |k: u64| uniform(seed, i * stride + k);
            let place = region.place(table, [0, 1, 2, 3, 4].map(draw));
            let values = Values::new(table, place)?;
            let exact = values.exact_cells();
            (0..pulses as u64)
                .map(|k| values.observe(table, &exact, 100.0_f64.powf(draw(5 + k))))
                .collect()
        })
        .collect::<Result<_, BuildError>>()?;
    Ok(found.into_iter().flatten().collect())
}

/// R at the nodes of a quadrature over time at one place, up to `end`.
struct Values {
    place: [f64; 3],
    rest: Six,
    width: f64,
    cells: usize,
    /// Time, weight and R.
    nodes: Vec<(f64, f64, Six)>,
    /// First node of each cell.
    firsts: Vec<usize>,
}

impl Values {
    fn new(table: &Table, place: [f64; 3]) -> Result<Self, BuildError> {
        /// Time after the last arrival.
        const AFTER: f64 = 8.0;
        const TOLERANCE: f64 = 1e-9;
        let [nu, r, z] = place;
        let medium = Medium::new(nu)?;
        let kernel = Kernel::new(&medium, Profile::Hertz, TOLERANCE)?;
        let arrivals = Arrivals::new(&medium, Profile::Hertz, r, z)?;
        let width = table.cell_width(nu)?;
        let cells = ((arrivals.last() + AFTER) / width).ceil() as usize;
        let (mut nodes, mut firsts) = (Vec::new(), Vec::new());
        // a smooth force needs two cells more
        for j in 0..cells + 2 {
            firsts.push(nodes.len());
            let cell = [j as f64 * width, (j + 1) as f64 * width];
            let mut ends = cell.to_vec();
            let inside = |a: &f64| *a > cell[0] && *a < cell[1];
            ends.extend(arrivals.sorted().into_iter().filter(inside));
            ends.sort_by(f64::total_cmp);
            for pair in ends.windows(2) {
                let (middle, half) = (0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0]));
                // roots and logarithms at fronts are flattened, and those of a front in a cell beside felt
                let near = |a: f64| (a - middle).abs() < 3.0 * width;
                let count = if arrivals.sorted().into_iter().any(near) {
                    16
                } else {
                    6
                };
                for (x, weight) in rule(count).on(-1.0, 1.0) {
                    let (q, bend) = (x * x, if count == 6 { 0.0 } else { 0.5 });
                    let s = middle + half * x * (1.0 + bend * (1.0 - q));
                    let weight = weight * half * (1.0 + bend * (1.0 - 3.0 * q));
                    nodes.push((s, weight, kernel.remainder(r, z, s)?.value));
                }
            }
        }
        firsts.push(nodes.len());
        Ok(Self {
            place,
            rest: kernel.static_field(r, z)?,
            width,
            cells,
            nodes,
            firsts,
        })
    }

    /// Averages and moments of the cells, and the cells that a smooth force needs.
    fn exact_cells(&self) -> Vec<Six> {
        let stored = self.firsts.len() - 1;
        let mut numbers = [(); 3].map(|()| vec![[0.0; 6]; stored]);
        for j in 0..stored {
            for &(s, weight, value) in &self.nodes[self.firsts[j]..self.firsts[j + 1]] {
                let place = s / self.width - (j as f64 + 0.5);
                let weight = weight / self.width;
                let factors = [
                    weight,
                    weight * place,
                    weight * (place * place - 1.0 / 12.0),
                ];
                for (list, factor) in numbers.iter_mut().zip(factors) {
                    for f in 0..6 {
                        list[j][f] += factor * value[f];
                    }
                }
            }
        }
        let [averages, moments, curvatures] = numbers;
        // the cells do not reach it
        let tail = vec![[0.0; 6]];
        let numbers = [averages, moments, curvatures, tail];
        let mut cells = vec![[0.0; 6]; self.cells];
        Series::new(self.width, stored, numbers).fill(Smoothness::Smooth, 0, &mut cells);
        cells
    }

    /// int P'(t - s) R(s) ds for each field at the end of cell `n - 1`.
    fn integral(&self, pulse: Pulse, n: usize) -> Six {
        let t = n as f64 * self.width;
        let mut sum = Six::default();
        for &(s, weight, value) in &self.nodes[..self.firsts[n]] {
            let rate = weight * pulse.rate(t - s);
            for f in 0..6 {
                sum[f] += rate * value[f];
            }
        }
        sum
    }

    fn observe(
        &self,
        table: &Table,
        exact: &[Six],
        length: f64,
    ) -> Result<Observation, BuildError> {
        /// Cells in a pulse from which on it is smooth on them, to 1e-8 of a response.
        const SMOOTH: f64 = 250.0;
        let [nu, r, z] = self.place;
        let pulse = Pulse { length };
        let mut looked_up = vec![[0.0; 6]; self.cells];
        let info = table.trace(Smoothness::Smooth, nu, r, z, 0, &mut looked_up)?;
        let (mut peak, mut error) = ([0.0_f64; 6], [0.0_f64; 6]);
        // every third sample: errors last longer than a cell
        for n in (1..=self.cells).step_by(3) {
            let t = n as f64 * self.width;
            let rise = |j: usize| {
                pulse.force(t - j as f64 * self.width)
                    - pulse.force(t - (j + 1) as f64 * self.width)
            };
            let sum = |cells: &[Six], f: usize| (0..n).map(|j| rise(j) * cells[j][f]).sum::<f64>();
            let integral = (length > SMOOTH * self.width).then(|| self.integral(pulse, n));
            for f in 0..6 {
                let exact = integral.map_or_else(|| sum(exact, f), |six| six[f]);
                let force = pulse.force(t);
                peak[f] = peak[f].max((force * self.rest[f] + exact).abs());
                let fixed = force * (info.static_part[f] - self.rest[f]);
                error[f] = error[f].max((sum(&looked_up, f) + fixed - exact).abs());
            }
        }
        Ok(Observation {
            poisson_ratio: nu,
            r,
            z,
            pulse_length: length,
            peak,
            error,
            estimate: table.error(nu, r, z, length)?,
        })
    }
}

/// sin^4(pi t/length).
#[derive(Clone, Copy)]
struct Pulse {
    length: f64,
}

impl Pulse {
    fn force(self, t: f64) -> f64 {
        if t > 0.0 && t < self.length {
            (PI * t / self.length).sin().powi(4)
        } else {
            0.0
        }
    }

    fn rate(self, t: f64) -> f64 {
        if t > 0.0 && t < self.length {
            let (sin, cos) = (PI * t / self.length).sin_cos();
            4.0 * PI / self.length * sin.powi(3) * cos
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tabulator::{Axis, Grid, Silent, build};

    #[test]
    fn values_of_r_give_the_averages_that_its_integrals_give() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.h5");
        let grid = Grid {
            cell_width: 0.25,
            r: Axis::uniform(0.875, 0.125),
            z: Axis::uniform(0.875, 0.125),
            ..Grid::demo()
        };
        build(&grid, &path, &Silent).unwrap();
        let table = Table::open(&path).unwrap();
        for [r, z] in [[0.0, 0.3], [0.5, 0.6], [0.8, 0.01], [0.3, 0.0]] {
            let values = Values::new(&table, [0.3, r, z]).unwrap();
            let kernel = Kernel::new(&Medium::new(0.3).unwrap(), Profile::Hertz, 1e-11).unwrap();
            let integral = |t: f64| kernel.step_integral(r, z, t).unwrap().value;
            for j in 0..values.cells {
                let [before, after] = [j, j + 1].map(|j| integral(j as f64 * values.width));
                let cell: [f64; 6] = std::array::from_fn(|f| (after[f] - before[f]) / values.width);
                let nodes = &values.nodes[values.firsts[j]..values.firsts[j + 1]];
                for f in 0..6 {
                    let sum: f64 = nodes.iter().map(|(_, weight, six)| weight * six[f]).sum();
                    let gap = (sum / values.width - cell[f]).abs();
                    assert!(gap < 1e-7, "r {r} z {z} cell {j} field {f}: {gap:e}");
                }
            }
        }
    }
}
