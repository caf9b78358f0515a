//! Estimated time, memory and size of a table, before it is built.

use crate::block::{PointKind, TableBlock};
use crate::error::BuildError;
use crate::grid::Grid;
use crate::point::PointPlan;
use crate::progress::Silent;
use crate::rows::TableWork;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::time::Instant;

/// Estimated cost of building a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TableCost {
    /// Number of points at which kernels are computed: nodes and verification probes.
    pub points: usize,
    /// Number of blocks, which are divided among shards.
    pub blocks: usize,
    /// Number of points computed for this estimate.
    pub measured_points: usize,
    /// Time in s for all points on one thread.
    pub seconds: f64,
    /// Memory in bytes while the table is assembled.
    pub memory_bytes: f64,
    /// Size of the numbers of the table in bytes; the compressed file is smaller.
    pub most_bytes: f64,
}

impl Grid {
    /// Estimates the cost from kernels at some points of the grid, for about `measured_s` seconds of the clock `now`,
    /// in s.
    ///
    /// # Errors
    /// [`BuildError`] for a grid that cannot be built.
    pub fn cost(
        &self,
        measured_s: f64,
        now: impl Fn() -> Option<f64>,
    ) -> Result<TableCost, BuildError> {
        /// Smallest number of points to measure; some take ten times as long as others.
        const FEWEST_POINTS: usize = 32;
        let memory_bytes = self.memory_bytes()?;
        let work = TableWork::new(self, None, &Silent)?;
        let depths = |block: &TableBlock| work.place(*block).2.len();
        let points: usize = work.blocks.iter().map(depths).sum();
        // equidistributed over blocks and over depths
        let part = |k: usize, step: f64| (k as f64 * step).fract();
        let mut plans: HashMap<(bool, u64), PointPlan> = HashMap::new();
        let (began, began_s) = (Instant::now(), now());
        let passed_s = || match now().zip(began_s) {
            Some((now_s, began_s)) => now_s - began_s,
            None => began.elapsed().as_secs_f64(),
        };
        let mut count = 0;
        while count < points && (count < FEWEST_POINTS || passed_s() < measured_s) {
            let place = part(count, 0.618_033_988_749_895) * work.blocks.len() as f64;
            let block = work.blocks[place as usize];
            let (ratio, r, depths) = work.place(block);
            let z = depths[(part(count, 0.754_877_666_246_693) * depths.len() as f64) as usize];
            let is_node = block.kind == PointKind::Nodes;
            let plan = match plans.entry((is_node, ratio.to_bits())) {
                Entry::Occupied(plan) => plan.into_mut(),
                Entry::Vacant(none) => none.insert(match is_node {
                    true => self.point(ratio)?,
                    false => self.probe(ratio)?,
                }),
            };
            plan.compute(r, z)?;
            count += 1;
        }
        Ok(TableCost {
            points,
            blocks: work.blocks.len(),
            measured_points: count,
            seconds: passed_s() * points as f64 / count.max(1) as f64,
            memory_bytes,
            most_bytes: self.bytes()?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Axis;

    #[test]
    fn a_plan_counts_points_and_scales_with_them() {
        let grid = Grid {
            cell_width: 0.5,
            tolerance: 1e-6,
            r: Axis::uniform(0.875, 0.125),
            z: Axis::uniform(0.875, 0.125),
            ..Grid::demo()
        };
        let one = grid.cost(0.0, || None).unwrap();
        let two = grid.clone().with(Some(vec![0.1, 0.3]), [None; 3]);
        let two = two.cost(0.0, || None).unwrap();
        // two slices have probes between them in addition
        assert!(two.points > 2 * one.points && one.points > 64);
        assert_eq!(two.most_bytes, 2.0 * one.most_bytes);
        assert!(one.measured_points >= 32 && one.seconds > 0.0);
    }
}
