//! Variation of a force within the cells of a convolution.
//!
//! Cells of the remainder hold an average, a first and a second moment. They are multiplied by the rise of the force
//! over a cell, its slope and its bend, which [`lookup::absorb`] computes from the neighbouring rises. This is exact to
//! fourth order for a smooth force, but wrong where a contact begins and ends with the power 3/2 or a record has
//! corners. Therefore slope and bend are projected from the force itself, and the part that the cells have not absorbed
//! is added:
//!
//! ```text
//! rate over a cell = rise + slope s + bend (s^2 - 1/12) + what is left,     s from -1/2 to 1/2, growing into the past
//! ```
//!
//! A force is read at nodes within each cell of a run, so that its integrals are exact.
//!
//! Theory: `docs/theory.md` (T24).

use super::convolve::{Transform, weighted_sum};
use halfspace::Six;
use lookup::{Moments, absorbed};
use std::ops::Range;

/// Slope and bend of one cell of the force that the cells have not absorbed.
#[derive(Debug, Clone, Copy)]
struct Unabsorbed {
    cell: isize,
    slope: f64,
    bend: f64,
}

/// The variation of a sampled force in addition to its rises.
#[derive(Default)]
pub(crate) struct Projection {
    /// For the newest cell, the previous one, and all others: their slopes use different neighbours.
    unabsorbed: [Vec<Unabsorbed>; 3],
    /// Slopes and bends of the others as transforms, if there are as many as in noise.
    transforms: Option<[Transform; 2]>,
    /// Residual of the force after rise, slope and bend.
    pub(crate) left: Departure,
    /// Projection of each cell of the force; the first cell ends at sample 1.
    taken: Vec<Taken>,
}

/// Number of cells of the remainder that see a cell of the force through its five neighbours.
const BEFORE: isize = 2;

impl Projection {
    /// Of a force with equidistant `samples`, of which some are needed; values below `negligible` are omitted.
    pub(crate) fn new(
        samples: &[f64],
        rises: &[f64],
        nodes: &CellNodes,
        (wanted, negligible): (usize, f64),
    ) -> Self {
        let mut found = Self {
            taken: Vec::with_capacity(samples.len()),
            ..Self::default()
        };
        for cell in -BEFORE..samples.len() as isize {
            let [slope, bend] = match usize::try_from(cell) {
                Ok(m) if m > 0 => {
                    let own = taken(samples, nodes, m);
                    found.left.add(own.most);
                    found.taken.push(own);
                    [own.slope, own.bend]
                }
                Ok(_) | Err(_) => [0.0; 2],
            };
            for (own, list) in found.unabsorbed.iter_mut().enumerate() {
                let [taken, bent] = absorbed(rises, cell, own);
                // s increases backwards in time
                let missing = Unabsorbed {
                    cell,
                    slope: -slope - taken,
                    bend: bend - bent,
                };
                if missing.slope.abs().max(missing.bend.abs()) > negligible {
                    list.push(missing);
                }
            }
        }
        let (count, others) = (samples.len(), &mut found.unabsorbed[2]);
        if Transform::is_faster(count, others.len(), wanted) {
            let mut series = [vec![0.0; count], vec![0.0; count]];
            for one in others.drain(..) {
                let place = (one.cell + BEFORE) as usize;
                if place < count {
                    (series[0][place], series[1][place]) = (one.slope, one.bend);
                }
            }
            found.transforms = Some(series.map(|own| Transform::new(&own)));
        }
        found
    }

    /// Adds the part that the cells have not absorbed to the fields at the samples `wanted`.
    pub(crate) fn add(&self, cells: &Moments, wanted: &[usize], out: &mut [Vec<f64>; 6]) {
        // of each list, where the cells of a sample begin and end
        let mut spans = [[0; 2]; 3];
        for (place, &n) in wanted.iter().enumerate() {
            let mut sum = Six::default();
            let newest = n as isize;
            for (own, (list, span)) in self.unabsorbed.iter().zip(&mut spans).enumerate() {
                let last = newest - own as isize;
                let first = if own == 2 { isize::MIN } else { last };
                // as far as there are cells
                let first = first.max(newest + 1 - cells.first.len() as isize);
                let after = |place: usize, until: isize| {
                    let later = list[place..].iter();
                    place + later.take_while(|missing| missing.cell < until).count()
                };
                *span = [after(span[0], first), after(span[1], last + 1)];
                let list = &list[span[0]..span[1].max(span[0])];
                let of = |missing: &Unabsorbed| (newest - missing.cell) as usize;
                let slopes = list.iter().map(|one| (one.slope, &cells.first[of(one)]));
                let bends = list.iter().map(|one| (one.bend, &cells.second[of(one)]));
                for part in [weighted_sum(slopes), weighted_sum(bends)] {
                    sum = std::array::from_fn(|f| sum[f] + part[f]);
                }
            }
            for (samples, s) in out.iter_mut().zip(sum) {
                samples[place] += s;
            }
        }
        let moments = [&cells.first, &cells.second];
        for (transform, moments) in self.transforms.iter().flatten().zip(moments) {
            let moments = moments.get(BEFORE as usize..).unwrap_or_default();
            let found = transform.convolve(moments, self.taken.len() + 1, wanted);
            for (samples, found) in out.iter_mut().flatten().zip(found.iter().flatten()) {
                *samples += found;
            }
        }
    }

    /// The projection of the cell that ends at sample `m`, from 1 on.
    pub(crate) fn taken(&self, m: usize) -> &Taken {
        &self.taken[m - 1]
    }

    /// The contribution of some of the cells to sample n, in kernel units times the force.
    pub(crate) fn by_cells(&self, n: usize, part: &Range<usize>, cells: &Moments) -> Six {
        let mut sum = Six::default();
        for cell in part.start..part.end.min(n + 1) {
            let (taken, j) = (self.taken(cell), n - cell);
            for (f, sum) in sum.iter_mut().enumerate() {
                *sum += taken.rise * cells.averages[j][f] - taken.slope * cells.first[j][f]
                    + taken.bend * cells.second[j][f];
            }
        }
        sum
    }
}

/// Projection of a force onto a cell, and its residual.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Taken {
    pub(crate) rise: f64,
    /// Slope and bend in time.
    pub(crate) slope: f64,
    pub(crate) bend: f64,
    /// Largest residual of the force, and of its rate over a cell.
    most: f64,
    pub(crate) left: f64,
}

impl Taken {
    /// The rise of the parabola between two positions in the cell, from -1/2 to 1/2 in time.
    pub(crate) fn between(&self, from: f64, to: f64) -> f64 {
        let until = |x: f64| {
            self.rise * x + 0.5 * self.slope * x * x + self.bend * (x * x * x / 3.0 - x / 12.0)
        };
        until(to) - until(from)
    }
}

/// The projection for the cell that ends at sample `m`: integration by parts gives slope and bend from the mean and the
/// first moment of the force.
///
/// ```text
/// slope = 12 [(P0 + P1)/2 - int P dx],     bend = 180 [(P1 - P0)/6 - 2 int P x dx]
/// ```
fn taken(samples: &[f64], nodes: &CellNodes, m: usize) -> Taken {
    taken_between([samples[m - 1], samples[m]], nodes.of(m - 1))
}

/// The projection from the forces at the ends of the cell and at its nodes.
pub(crate) fn taken_between([before, after]: [f64; 2], nodes: &[Node]) -> Taken {
    let (mut mean, mut moment) = (0.0, 0.0);
    for node in nodes {
        // minus the line between the ends, which avoids cancellation
        let line = before + (after - before) * (node.x + 0.5);
        let above = node.weight * (node.force - line);
        mean += above;
        moment += node.x * above;
    }
    let (slope, bend) = (-12.0 * mean, -360.0 * moment);
    let left = |node: &Node| {
        let x = node.x;
        let followed = before
            + (after - before) * (x + 0.5)
            + slope * (0.5 * x * x - 0.125)
            + bend * (x * x * x / 3.0 - x / 12.0);
        node.force - followed
    };
    let mut found = Taken {
        rise: after - before,
        slope,
        bend,
        most: 0.0,
        left: 0.0,
    };
    let (mut place, mut earlier) = (-0.5, 0.0);
    let last = Node {
        x: 0.5,
        weight: 0.0,
        force: after,
    };
    for node in nodes.iter().chain([&last]) {
        let own = left(node);
        found.most = found.most.max(own.abs());
        if node.x > place {
            found.left = found.left.max(((own - earlier) / (node.x - place)).abs());
        }
        (place, earlier) = (node.x, own);
    }
    found
}

/// A node in a cell: x from -1/2 to 1/2 in time, its weight in a mean over the cell, and the force there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Node {
    pub(crate) x: f64,
    pub(crate) weight: f64,
    pub(crate) force: f64,
}

/// Nodes of quadrature in the cells between the samples of a run.
#[derive(Debug, Clone, Default)]
pub(crate) struct CellNodes {
    /// First node of each cell, and the end.
    starts: Vec<usize>,
    nodes: Vec<Node>,
}

impl CellNodes {
    /// Of `cells` cells, filled one by one.
    pub(crate) fn new(cells: usize, mut fill: impl FnMut(usize, &mut Vec<Node>)) -> Self {
        let mut found = Self::default();
        for cell in 0..cells {
            found.starts.push(found.nodes.len());
            fill(cell, &mut found.nodes);
        }
        found.starts.push(found.nodes.len());
        found
    }

    /// Sets the force at each node, as a function of its index.
    pub(crate) fn read(&mut self, force: impl Fn(usize) -> f64) {
        for (i, node) in self.nodes.iter_mut().enumerate() {
            node.force = force(i);
        }
    }

    /// The same nodes with other forces, as a function of their index.
    pub(crate) fn with(&self, force: impl Fn(usize) -> f64) -> Self {
        let mut found = self.clone();
        found.read(force);
        found
    }

    /// Times of all nodes, of a run that starts at a time and has steps of a length.
    pub(crate) fn times_s(&self, start_s: f64, step_s: f64) -> Vec<f64> {
        let cells = self.starts.windows(2).enumerate();
        let places = cells.flat_map(|(cell, ends)| {
            let own = self.nodes[ends[0]..ends[1]].iter();
            own.map(move |node| cell as f64 + 0.5 + node.x)
        });
        places.map(|place| start_s + place * step_s).collect()
    }

    /// The nodes of one cell.
    pub(crate) fn of(&self, cell: usize) -> &[Node] {
        &self.nodes[self.starts[cell]..self.starts[cell + 1]]
    }
}

/// Largest magnitude.
pub(crate) fn largest(samples: &[f64]) -> f64 {
    samples.iter().fold(0.0, |most, v| most.max(v.abs()))
}

/// Residual of a force after joining its samples by straight lines, in N.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Departure {
    /// Largest difference.
    pub(crate) most_n: f64,
    /// Sum over the cells of the largest difference in each.
    pub(crate) sum_n: f64,
}

impl Departure {
    /// Counts a cell.
    pub(crate) fn add(&mut self, cell_n: f64) {
        self.most_n = self.most_n.max(cell_n);
        self.sum_n += cell_n;
    }

    pub(crate) fn join(&mut self, other: Self) {
        self.most_n = self.most_n.max(other.most_n);
        self.sum_n += other.sum_n;
    }

    /// Largest effect on a response that varies by `variation` in total and by `step` over a cell.
    pub(crate) fn moves(&self, [variation, step]: [f64; 2]) -> f64 {
        (self.most_n * variation).min(self.sum_n * step)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use halfspace::gauss;

    /// Polynomials of a force and of the remainder: the projected sum is the convolution.
    #[test]
    fn a_force_with_corners_is_convolved_exactly_with_parabolas() {
        let step = 1.0;
        let force = |t: f64| if t < 1.3 { t } else { (2.6 - t).max(0.0) };
        let rest = |t: f64| 0.3 - 0.2 * t + 0.05 * t * t;
        let count = 9;
        let samples: Vec<f64> = (0..count).map(|i| force(f64::from(i) * step)).collect();
        let rises: Vec<f64> = (0..samples.len())
            .map(|i| samples[i] - if i > 0 { samples[i - 1] } else { 0.0 })
            .collect();
        let nodes = CellNodes::new(samples.len() - 1, |m, nodes| {
            let corners =
                [m as f64, 1.3, 2.6, (m + 1) as f64].map(|t| t.clamp(m as f64, (m + 1) as f64));
            for pair in corners.windows(2) {
                for (t, weight) in gauss::rule(3).on(pair[0], pair[1]) {
                    nodes.push(Node {
                        x: t - m as f64 - 0.5,
                        weight,
                        force: force(t),
                    });
                }
            }
        });
        let cells = samples.len() + lookup::BEYOND;
        let mut moments = Moments::with_capacity(cells);
        for j in 0..cells {
            let mut cell = [[0.0; 6]; 3];
            for (t, weight) in gauss::rule(4).on(j as f64, (j + 1) as f64) {
                let s = t - j as f64 - 0.5;
                cell[0][0] += weight * rest(t);
                cell[1][0] += weight * s * rest(t);
                cell[2][0] += weight * (s * s - 1.0 / 12.0) * rest(t);
            }
            moments.push(cell);
        }
        let projection = Projection::new(&samples, &rises, &nodes, (count as usize, 1e-15));
        let wanted: Vec<usize> = (0..samples.len()).collect();
        let mut out: [Vec<f64>; 6] = std::array::from_fn(|_| vec![0.0; samples.len()]);
        let smooth = moments.absorbed();
        for n in 0..samples.len() {
            out[0][n] = (0..=n).map(|m| rises[m] * smooth[n - m][0]).sum();
        }
        projection.add(&moments, &wanted, &mut out);
        for (n, found) in out[0].iter().enumerate() {
            let t = n as f64;
            let mut exact = 0.0;
            let corners = [0.0, 1.3, 2.6].map(|c: f64| c.min(t));
            for (pair, slope) in corners.windows(2).zip([1.0, -1.0]) {
                for (at, weight) in gauss::rule(4).on(pair[0], pair[1]) {
                    exact += weight * slope * rest(t - at);
                }
            }
            assert!((found - exact).abs() < 1e-13, "{n}: {found} {exact}");
        }
    }

    /// Noise of which no cell absorbs anything: transforms bring what the sums bring.
    #[test]
    fn noise_is_transformed_as_it_is_summed() {
        let noise = |i: usize, k: usize| ((i * i + k) as f64).sin();
        let samples: Vec<f64> = (0..2048).map(|i| noise(i, 0)).collect();
        let rises = crate::sampled::convolve::rises(0.0, &samples);
        let nodes = CellNodes::new(samples.len() - 1, |m, nodes| {
            let rule = gauss::rule(3).on(-0.5, 0.5);
            nodes.extend(rule.enumerate().map(|(k, (x, weight))| Node {
                x,
                weight,
                force: noise(m, k + 1),
            }));
        });
        let wanted: Vec<usize> = (0..samples.len()).collect();
        let of = |count: usize, cells: usize| {
            let mut moments = Moments::with_capacity(cells);
            for j in 0..cells {
                moments.push([[noise(j, 4); 6], [noise(j, 5); 6], [noise(j, 6); 6]]);
            }
            let projection = Projection::new(&samples, &rises, &nodes, (count, 1e-15));
            assert_eq!(projection.transforms.is_some(), count > 0);
            let mut out: [Vec<f64>; 6] = std::array::from_fn(|_| vec![0.0; samples.len()]);
            projection.add(&moments, &wanted, &mut out);
            out
        };
        for cells in [samples.len() + lookup::BEYOND, 500] {
            let [summed, transformed] = [0, samples.len()].map(|count| of(count, cells));
            for (a, b) in summed.iter().flatten().zip(transformed.iter().flatten()) {
                assert!((a - b).abs() < 1e-10, "{a} {b}");
            }
        }
    }
}
