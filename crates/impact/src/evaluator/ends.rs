//! The parts of a contact that its samples do not resolve: its beginning and its end, where the force has the power 3/2.
//!
//! Cells take the rate of the force as a parabola over a step, which is wrong there; it shows where the kernel is not
//! smooth either, beside fronts. For these samples the cells of a zone are replaced by the integral itself,
//!
//! ```text
//! int F'(t') R(t - t') dt' = int dF/dx R(t - t0 - x^2) dx,      t' = t0 + x^2 after a beginning, t0 - x^2 before an end
//! ```
//!
//! with F a polynomial in x, and R read from the trace of the point between its fronts.
//!
//! Theory: `docs/theory.md` (T24).

use super::projection::Projection;
use halfspace::{Six, Trace, chebyshev_each, gauss};
use lookup::Moments;
use std::f64::consts::PI;
use std::ops::Range;
use std::sync::LazyLock;

/// Rates that are left over a cell count from this part of the tolerance of the steepest rise on.
const SMOOTH: f64 = 0.02;

/// Rise of the force that the integrals over a zone may lose, over its largest over a cell.
const LOST: f64 = 3e-3;

/// Terms of the force in the root of time.
const DEGREE: usize = 12;

/// How far beside a jump its sides are read: parts of its time and of the zone.
const ROUNDING: f64 = 4e-15;
const START: f64 = 1e-10;

/// Nodes of the rule, side by side.
const NODES: usize = 10;

/// Cells that are replaced together.
pub(crate) struct Zone {
    /// Each ends at the sample of its number.
    pub(crate) cells: Range<usize>,
    parts: Vec<Part>,
    /// When the pair of forces jumps, in s, and by how much, such as the rate of a contact that begins to yield.
    jumps: Vec<(f64, [f64; 2])>,
}

/// A part of a zone on one side of a beginning or an end.
struct Part {
    origin_s: f64,
    /// Of time from the origin: 1 after a beginning, -1 before an end.
    sign: f64,
    /// Roots of the times in s from the origin between which it lies.
    roots: [f64; 2],
    /// dF/dx as Chebyshev series in x between them, of each of a pair of forces.
    series: [[f64; 2]; DEGREE],
}

/// The zones of a force during a run, with those of another beside it; `steepest` is its largest rise over a step, in
/// tolerances.
pub(crate) fn zones(
    contacts: &[[f64; 2]],
    span_s: &dyn Fn(&Range<usize>) -> [f64; 2],
    projection: &Projection,
    (count, steepest): (usize, f64),
    force: impl Fn(f64) -> [f64; 2],
) -> Vec<Zone> {
    let mut zones: Vec<Zone> = Vec::new();
    let sure = SMOOTH * steepest;
    for cell in (1..count).filter(|&cell| projection.taken(cell).left > sure) {
        match zones.last_mut() {
            Some(zone) if zone.cells.end == cell => zone.cells.end = cell + 1,
            Some(_) | None => zones.push(Zone {
                cells: cell..cell + 1,
                parts: Vec::new(),
                jumps: Vec::new(),
            }),
        }
    }
    let mut ends: Vec<f64> = contacts.as_flattened().to_vec();
    ends.dedup();
    let within = |[from_s, to_s]: [f64; 2]| {
        let all = ends.iter().copied();
        all.filter(move |at_s| from_s <= *at_s && *at_s < to_s)
    };
    // elsewhere cells lose less than the integral does, as long as they follow the force to the tolerance
    zones.retain(|zone| {
        let mut left = zone.cells.clone().map(|cell| projection.taken(cell).left);
        within(span_s(&zone.cells)).next().is_some() || left.any(|left| left > steepest)
    });
    for zone in &mut zones {
        let [from_s, to_s] = span_s(&zone.cells);
        for at_s in within([from_s, to_s]) {
            let beside_s = ROUNDING * at_s + START * (to_s - from_s);
            // free of what grows as the root of the distance
            let side = |s: f64| [force(at_s + s), force(at_s + 4.0 * s)];
            let sides = [beside_s, -beside_s].map(side);
            let [after, before] = sides.map(|[near, far]| [0, 1].map(|k| 2.0 * near[k] - far[k]));
            let jump = [0, 1].map(|k| after[k] - before[k]);
            zone.jumps.push((at_s, jump));
        }
        for &[begin_s, end_s] in contacts {
            let [low, high] = [from_s.max(begin_s), to_s.min(end_s)];
            if low >= high {
                continue;
            }
            let middle = match (low == begin_s, high == end_s) {
                (true, true) => 0.5 * (low + high),
                (false, true) => low,
                (_, false) => high,
            };
            for side in [(low, 1.0), (high, -1.0)] {
                let roots = [0.0, (middle - side.0).abs().sqrt()];
                if roots[1] > 0.0 {
                    Part::push(side, roots, &force, sure, &mut zone.parts);
                }
            }
        }
    }
    // where a force has edges that nobody has named, such as a rate where pieces of a march meet, cells serve, too
    let rises = (1..count).map(|cell| projection.taken(cell).rise.abs());
    let most = LOST * rises.fold(0.0, f64::max);
    zones.retain(|zone| {
        let [before, after] = span_s(&zone.cells).map(&force);
        let of_parts = zone.parts.iter().map(|part| part.rises(part.roots).1);
        let of_parts = of_parts.map(|rises| rises.map(|own| own.iter().sum()));
        let jumps = zone.jumps.iter().map(|one| one.1);
        let found: Vec<[f64; 2]> = of_parts.chain(jumps).collect();
        let lost = |k: usize| after[k] - before[k] - found.iter().map(|r| r[k]).sum::<f64>();
        lost(0).abs().max(lost(1).abs()) <= most
    });
    zones
}

impl Part {
    /// Adds what lies on a side of an origin, halved until a polynomial follows the force.
    fn push(
        (origin_s, sign): (f64, f64),
        roots: [f64; 2],
        force: &impl Fn(f64) -> [f64; 2],
        allowed: f64,
        parts: &mut Vec<Self>,
    ) {
        /// Parts are halved no more once there are so many.
        const MOST: usize = 16;
        let (middle, half) = (0.5 * (roots[0] + roots[1]), 0.5 * (roots[1] - roots[0]));
        let cosines = &*COSINES;
        let values: [[f64; 2]; DEGREE] = std::array::from_fn(|i| {
            let x = middle + half * cosines[1][i];
            force(origin_s + sign * x * x)
        });
        let term = |k: usize, j: usize| {
            let terms = values.iter().zip(cosines[j]);
            2.0 * terms.map(|(value, cosine)| value[k] * cosine).sum::<f64>() / DEGREE as f64
        };
        let left = |k| term(k, DEGREE - 1).abs() + term(k, DEGREE - 2).abs();
        if left(0).max(left(1)) > allowed && parts.len() < MOST {
            for roots in [[roots[0], middle], [middle, roots[1]]] {
                Self::push((origin_s, sign), roots, force, allowed, parts);
            }
            return;
        }
        // the derivative of each series, by its recurrence
        let mut series = [[0.0; 2]; DEGREE];
        for j in (1..DEGREE).rev() {
            let above = series.get(j + 1).copied().unwrap_or_default();
            let scale = 2.0 * j as f64 * sign / half;
            series[j - 1] = [0, 1].map(|k| above[k] + scale * term(k, j));
        }
        series[0] = series[0].map(|slope| 0.5 * slope);
        parts.push(Self {
            origin_s,
            sign,
            roots,
            series,
        });
    }

    /// Nodes between two roots, and what the forces rise at each, in the sense of time.
    fn rises(&self, [from, to]: [f64; 2]) -> ([f64; NODES], [[f64; NODES]; 2]) {
        let [low, high] = self.roots;
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let x = RULE.map(|[y, _]| middle + half * y);
        let y = x.map(|x| (2.0 * x - low - high) / (high - low));
        let slopes = chebyshev_each(&self.series, y);
        let weighted = |own: [f64; NODES]| std::array::from_fn(|n| half * RULE[n][1] * own[n]);
        (x, slopes.map(weighted))
    }

    /// Adds the integrals over some of the past at a time; the trace has its times in `unit_s`.
    fn add(
        &self,
        time_s: f64,
        [from_s, to_s]: [f64; 2],
        (trace, unit_s): (&Trace, f64),
        sums: &mut [Six; 2],
    ) {
        let since_s = time_s - self.origin_s;
        let x_of = |s: f64| (self.sign * (since_s - s)).max(0.0).sqrt();
        // nothing after the instant itself
        if from_s >= time_s {
            return;
        }
        let ends = [from_s, to_s.min(time_s)].map(|t| x_of(time_s - t));
        let low = self.roots[0].max(ends[0].min(ends[1]));
        let high = self.roots[1].min(ends[0].max(ends[1]));
        if low >= high {
            return;
        }
        let mut cuts: Vec<f64> = (trace.breaks())
            .map(|at| x_of(at * unit_s))
            .filter(|x| low < *x && *x < high)
            .chain([low, high])
            .collect();
        cuts.sort_by(f64::total_cmp);
        for pair in cuts.windows(2) {
            let (x, rises) = self.rises([pair[0], pair[1]]);
            let values = trace.at_each(x.map(|x| (since_s - self.sign * x * x) / unit_s));
            for (sum, rises) in sums.iter_mut().zip(rises) {
                if rises == [0.0; NODES] {
                    continue;
                }
                for (sum, values) in sum.iter_mut().zip(&values) {
                    *sum += rises
                        .iter()
                        .zip(values)
                        .map(|(rise, value)| rise * value)
                        .sum::<f64>();
                }
            }
        }
    }
}

/// Chebyshev's polynomials, each at the nodes of the series.
static COSINES: LazyLock<[[f64; DEGREE]; DEGREE]> = LazyLock::new(|| {
    let angle = |i: usize| PI * (i as f64 + 0.5) / DEGREE as f64;
    std::array::from_fn(|j| std::array::from_fn(|i| (j as f64 * angle(i)).cos()))
});

/// Gauss's rule on [-1, 1] in the angle: exact beside roots at both ends.
static RULE: LazyLock<[[f64; 2]; NODES]> = LazyLock::new(|| {
    let mut angles = gauss::rule(NODES).on(0.0, PI);
    std::array::from_fn(|_| {
        let (angle, weight) = angles.next().unwrap_or_default();
        [-angle.cos(), weight * angle.sin()]
    })
});

impl Zone {
    /// What the integrals over some of the past bring at a time.
    pub(crate) fn by_trace(
        &self,
        time_s: f64,
        past_s: [f64; 2],
        (trace, unit_s): (&Trace, f64),
    ) -> [Six; 2] {
        let mut sums = [Six::default(); 2];
        for part in &self.parts {
            part.add(time_s, past_s, (trace, unit_s), &mut sums);
        }
        let [from_s, to_s] = [past_s[0], past_s[1].min(time_s)];
        for (at_s, jump) in self
            .jumps
            .iter()
            .filter(|one| from_s <= one.0 && one.0 < to_s)
        {
            let value = trace.at((time_s - at_s) / unit_s);
            for (sum, jump) in sums.iter_mut().zip(jump) {
                for f in 0..6 {
                    sum[f] += jump * value[f];
                }
            }
        }
        sums
    }
}

/// How far the kernel may depart within each cell from the parabola that its moments give.
///
/// Of a front that passes within a cell it is of the order of the cell's average, of a smooth kernel of that of its third
/// difference.
pub(crate) fn open(moments: &Moments) -> Vec<Six> {
    let averages = &moments.averages;
    let (first, second, last) = (&moments.first, &moments.second, averages.len() - 1);
    let of = |j: usize| -> Six {
        let [before, after] = [j.saturating_sub(1), (j + 1).min(last)].map(|j| averages[j]);
        std::array::from_fn(|f| {
            let bend = 180.0 * second[j][f] - 0.5 * (after[f] - 2.0 * averages[j][f] + before[f]);
            let tilt = 12.0 * first[j][f] - 0.5 * (after[f] - before[f]);
            bend.abs().max(tilt.abs()) / 3.0
        })
    };
    (0..=last).map(of).collect()
}
