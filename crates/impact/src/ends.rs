//! The ends of a contact where the kernels change within a cell.
//!
//! A contact's force begins and ends with the power 3/2, so that its rate is not linear over the first and the last cells.
//! Where a front passes a point in less than a cell, as it does far from the load and just below the surface, that shows:
//!
//! ```text
//! u_n misses int L'(t') R(t_n - t') dt',      L = P - (rise, slope and bend of the cell)
//! ```
//!
//! which is bounded by the largest L' and the largest departure of R from a line in the cell.
//!
//! Theory: `docs/theory.md` (T24).

use crate::nodes::CellNodes;
use crate::projection::{followed, slope_and_bend};
use halfspace::Six;
use lookup::Moments;

/// A cell of a force whose rate its rise, slope and bend do not follow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rough {
    /// It ends at this sample.
    pub(crate) cell: usize,
    /// Force in N at both ends.
    ends: [f64; 2],
    slope: f64,
    bend: f64,
    /// The most that is left of the rate, in N over a cell.
    pub(crate) rate_n: f64,
}

impl Rough {
    /// Those of the force `map(P)` with `samples` of P in which more than `negligible` in N over a cell is left of the rate.
    ///
    /// `bends` says whether the cells of the kernel have second moments.
    pub(crate) fn all(
        samples: &[f64],
        nodes: &CellNodes,
        map: impl Fn(f64) -> f64,
        negligible: f64,
        bends: bool,
    ) -> Vec<Self> {
        /// A force that changes by more than this over a cell is near an end of contact.
        const STEEP: f64 = 0.6;
        let of = |cell: usize| {
            let ends = [map(samples[cell - 1]), map(samples[cell])];
            let own = nodes.of(cell - 1);
            let [slope, bend] = slope_and_bend(ends, own, &map);
            let mut rough = Self {
                cell,
                ends,
                slope,
                bend: if bends { bend } else { 0.0 },
                rate_n: 0.0,
            };
            let mut places: Vec<[f64; 2]> = own
                .iter()
                .map(|node| [node.x, rough.left(map(node.force), node.x)])
                .chain([[-0.5, 0.0], [0.5, 0.0]])
                .collect();
            places.sort_by(|a, b| a[0].total_cmp(&b[0]));
            let rates = places
                .windows(2)
                .filter(|pair| pair[1][0] > pair[0][0])
                .map(|pair| ((pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0])).abs());
            rough.rate_n = rates.fold(0.0, f64::max);
            rough
        };
        let near_end = |&cell: &usize| {
            let [low, high] = [
                samples[cell - 1].min(samples[cell]),
                samples[cell - 1].max(samples[cell]),
            ];
            low < STEEP * high
        };
        (1..samples.len())
            .filter(near_end)
            .map(of)
            .filter(|rough| rough.rate_n > negligible)
            .collect()
    }

    /// What is left of a force at x from -1/2 to 1/2 in time.
    fn left(&self, force: f64, x: f64) -> f64 {
        force - followed(self.ends, [self.slope, self.bend], x)
    }
}

/// How far the kernel may depart within each cell from the line that its average and first moment give.
///
/// Of a front that passes within a cell it is of the order of the cell's average, of a smooth kernel of the order of its
/// second difference.
pub(crate) fn unresolved(moments: &Moments) -> Vec<Six> {
    let (averages, first) = (&moments.averages, &moments.first);
    let count = averages.len();
    let of = |j: usize| -> Six {
        let [before, after] = [
            averages[j.saturating_sub(1)],
            averages[(j + 1).min(count - 1)],
        ];
        std::array::from_fn(|f| {
            let bend = 0.5 * (after[f] - 2.0 * averages[j][f] + before[f]).abs();
            let tilt = 4.0 * (first[j][f] - (after[f] - before[f]) / 24.0).abs();
            bend.max(tilt)
        })
    };
    (0..count).map(of).collect()
}
