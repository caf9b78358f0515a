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

use super::tuning;
use crate::sampled::projection::Projection;
use halfspace::{Six, Trace, chebyshev_each, gauss};
use lookup::Moments;
use std::f64::consts::PI;
use std::ops::Range;
use std::sync::LazyLock;

/// Terms of the force in the root of time.
const DEGREE: usize = 12;

/// Distance from a jump at which its sides are read: parts of its time and of the zone.
const ROUNDING: f64 = 4e-15;
const START: f64 = 1e-10;

/// Nodes of the rule, side by side.
const NODES: usize = 10;

/// Cells that are replaced together by an integral.
pub(crate) struct Zone {
    /// Each ends at the sample of its number.
    pub(crate) cells: Range<usize>,
    /// The force on each disc within them.
    discs: Vec<DiscZone>,
}

/// The force on a disc within a zone.
#[derive(Default)]
struct DiscZone {
    parts: Vec<ZonePart>,
    /// When it jumps, in s, and by how much, such as the rate of a contact that begins to yield.
    jumps: Vec<(f64, f64)>,
}

/// A part of a zone on one side of a beginning or an end.
struct ZonePart {
    origin_s: f64,
    /// Of time from the origin: 1 after a beginning, -1 before an end.
    sign: f64,
    /// Roots of the times in s from the origin between which it lies.
    roots: [f64; 2],
    /// dF/dx as a Chebyshev series in x between them.
    series: [[f64; 1]; DEGREE],
}

/// When contacts begin and end and their force has kinks, in s, within a span.
pub(crate) fn ends_within([from_s, to_s]: [f64; 2], smooth_s: &[[f64; 2]]) -> Vec<f64> {
    let mut ends: Vec<f64> = smooth_s.as_flattened().to_vec();
    ends.dedup();
    ends.retain(|at_s| from_s <= *at_s && *at_s < to_s);
    ends
}

/// Ranges of the cells of a run of `count` samples that a parabola does not follow; `steepest` is the largest rise over a
/// step times the tolerance. Where no contact begins or ends cells serve as long as they follow the force to the tolerance.
pub(crate) fn unresolved(
    projection: &Projection,
    (count, steepest): (usize, f64),
    has_end: impl Fn(&Range<usize>) -> bool,
) -> Vec<Range<usize>> {
    let mut found: Vec<Range<usize>> = Vec::new();
    let left = |cell: usize| projection.taken(cell).left;
    let is_open = |&cell: &usize| left(cell) > tuning::UNRESOLVED * steepest;
    for cell in (1..count).filter(is_open) {
        match found.last_mut() {
            Some(last) if last.end == cell => last.end = cell + 1,
            Some(_) | None => found.push(cell..cell + 1),
        }
    }
    found.retain(|cells| has_end(cells) || cells.clone().any(|cell| left(cell) > steepest));
    found
}

impl Zone {
    /// Of some cells and their span in s, with the forces on so many discs, which rise by `rise` at most over a cell; none where the
    /// integral would be no better than the cells.
    pub(crate) fn new(
        (cells, span): (Range<usize>, [f64; 2]),
        smooth_s: &[[f64; 2]],
        (rise, tolerance): (f64, f64),
        count: usize,
        force: impl Fn(usize, f64) -> f64,
    ) -> Option<Self> {
        let ends = ends_within(span, smooth_s);
        let lost = tuning::LOST * rise;
        let allowed = tuning::UNRESOLVED * tolerance * rise;
        let of = |k: usize| DiscZone::new(span, &ends, smooth_s, allowed, |t| force(k, t));
        let discs: Vec<DiscZone> = (0..count).map(of).collect();
        // where a force has edges that nobody has named, such as a rate where pieces of a march meet, cells serve, too
        let is_whole = |(k, disc): (usize, &DiscZone)| {
            let [before, after] = span.map(|t| force(k, t));
            (after - before - disc.rise()).abs() <= lost
        };
        let all = discs.iter().enumerate().all(is_whole);
        all.then_some(Self { cells, discs })
    }

    /// The integral over some of the past at a time, under disc `k`.
    pub(crate) fn by_trace(
        &self,
        k: usize,
        time_s: f64,
        past_s: [f64; 2],
        (trace, unit_s): (&Trace, f64),
    ) -> Six {
        let mut sum = Six::default();
        for part in &self.discs[k].parts {
            part.add(time_s, past_s, (trace, unit_s), &mut sum);
        }
        let [from_s, to_s] = [past_s[0], past_s[1].min(time_s)];
        let jumps = self.discs[k].jumps.iter();
        for (at_s, jump) in jumps.filter(|one| from_s <= one.0 && one.0 < to_s) {
            let value = trace.at((time_s - at_s) / unit_s);
            for (sum, value) in sum.iter_mut().zip(value) {
                *sum += jump * value;
            }
        }
        sum
    }
}

impl DiscZone {
    fn new(
        [from_s, to_s]: [f64; 2],
        ends: &[f64],
        smooth_s: &[[f64; 2]],
        allowed: f64,
        force: impl Fn(f64) -> f64,
    ) -> Self {
        let mut found = Self::default();
        for &at_s in ends {
            let beside_s = ROUNDING * at_s + START * (to_s - from_s);
            // free of a part that grows as the root of the distance
            let side = |s: f64| 2.0 * force(at_s + s) - force(at_s + 4.0 * s);
            found.jumps.push((at_s, side(beside_s) - side(-beside_s)));
        }
        for &[begin_s, end_s] in smooth_s {
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
                    ZonePart::push(side, roots, &force, allowed, &mut found.parts);
                }
            }
        }
        found
    }

    /// By how much the force changes over the zone.
    fn rise(&self) -> f64 {
        let parts = self
            .parts
            .iter()
            .map(|part| part.rises(part.roots).1.iter().sum::<f64>());
        parts.chain(self.jumps.iter().map(|one| one.1)).sum()
    }
}

impl ZonePart {
    /// Adds the part on one side of an origin, halved until a polynomial follows the force.
    fn push(
        (origin_s, sign): (f64, f64),
        roots: [f64; 2],
        force: &impl Fn(f64) -> f64,
        allowed: f64,
        parts: &mut Vec<Self>,
    ) {
        let (middle, half) = (0.5 * (roots[0] + roots[1]), 0.5 * (roots[1] - roots[0]));
        let cosines = &*COSINES;
        let values: [f64; DEGREE] = std::array::from_fn(|i| {
            let x = middle + half * cosines[1][i];
            force(origin_s + sign * x * x)
        });
        let term = |j: usize| {
            let terms = values.iter().zip(cosines[j]);
            2.0 * terms.map(|(value, cosine)| value * cosine).sum::<f64>() / DEGREE as f64
        };
        let last = term(DEGREE - 1).abs() + term(DEGREE - 2).abs();
        if last > allowed && parts.len() < tuning::MOST_PARTS {
            for roots in [[roots[0], middle], [middle, roots[1]]] {
                Self::push((origin_s, sign), roots, force, allowed, parts);
            }
            return;
        }
        // the derivative of each series, by its recurrence
        let mut series = [[0.0; 1]; DEGREE];
        for j in (1..DEGREE).rev() {
            let above = series.get(j + 1).copied().unwrap_or_default();
            series[j - 1] = [above[0] + 2.0 * j as f64 * sign / half * term(j)];
        }
        series[0][0] *= 0.5;
        parts.push(Self {
            origin_s,
            sign,
            roots,
            series,
        });
    }

    /// Nodes between two roots, and the rise of the force at each, in the sense of time.
    fn rises(&self, [from, to]: [f64; 2]) -> ([f64; NODES], [f64; NODES]) {
        let [low, high] = self.roots;
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let x = RULE.map(|[y, _]| middle + half * y);
        let y = x.map(|x| (2.0 * x - low - high) / (high - low));
        let [slopes] = chebyshev_each(&self.series, y);
        (x, std::array::from_fn(|n| half * RULE[n][1] * slopes[n]))
    }

    /// Adds the integrals over some of the past at a time; the trace has its times in `unit_s`.
    fn add(
        &self,
        time_s: f64,
        [from_s, to_s]: [f64; 2],
        (trace, unit_s): (&Trace, f64),
        sum: &mut Six,
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
            for (sum, values) in sum.iter_mut().zip(&values) {
                let terms = rises.iter().zip(values);
                *sum += terms.map(|(rise, value)| rise * value).sum::<f64>();
            }
        }
    }
}

/// Chebyshev's polynomials, each at the nodes of the series.
static COSINES: LazyLock<[[f64; DEGREE]; DEGREE]> = LazyLock::new(|| {
    let angle = |i: usize| PI * (i as f64 + 0.5) / DEGREE as f64;
    std::array::from_fn(|j| std::array::from_fn(|i| (j as f64 * angle(i)).cos()))
});

/// Gauss's rule on [-1, 1] in the angle: exact next to roots at both ends.
static RULE: LazyLock<[[f64; 2]; NODES]> = LazyLock::new(|| {
    let mut angles = gauss::rule(NODES).on(0.0, PI);
    std::array::from_fn(|_| {
        let (angle, weight) = angles.next().unwrap_or_default();
        [-angle.cos(), weight * angle.sin()]
    })
});

/// How far the kernel may depart within each cell from the parabola that its moments give.
///
/// Of a front that passes within a cell it is of the order of the cell's average, of a smooth kernel of that of its third
/// difference.
pub(crate) fn departures(moments: &Moments) -> Vec<Six> {
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
