//! All rows of a table: those that are there already, and the others computed on all threads.

use crate::block::{Block, Kind, Row, positions};
use crate::error::BuildError;
use crate::grid::Grid;
use crate::journal::kept;
use crate::known::Known;
use crate::point::PointPlan;
use crate::progress::Progress;
use output::Journal;
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

/// All rows in the order of `work`: those finished before, and the others computed and, with a journal, recorded now.
///
/// # Errors
/// [`BuildError`] when the exact kernels refuse a point or the journal cannot be written.
pub(crate) fn rows(
    grid: &Grid,
    work: &[Block],
    mut finished: HashMap<Block, Row>,
    journal: Option<&Mutex<Journal>>,
    known: Option<&Known>,
    progress: &dyn Progress,
) -> Result<Vec<Row>, BuildError> {
    let places = Kind::ALL.map(|kind| positions(kind, grid));
    let missing: Vec<Block> = work
        .iter()
        .filter(|block| !finished.contains_key(block))
        .copied()
        .collect();
    progress.total("kernels", missing.len() as u64);
    let computed: Vec<(Block, Row)> = missing
        .par_iter()
        .with_max_len(1)
        .map(|&block| {
            let [r, z] = &places[block.kind as usize];
            let ratio = grid.ratio_of(block)?;
            let plan = match block.kind {
                Kind::Nodes => grid.point(ratio)?,
                Kind::Probes | Kind::Between => grid.probe(ratio)?,
            };
            progress.slice(ratio);
            let row = row(&plan, block.kind, r[block.row], z, known)?;
            if let Some(journal) = journal {
                let kept = kept(block, &row);
                let mut journal = journal.lock().unwrap_or_else(PoisonError::into_inner);
                journal.append(&kept)?;
            }
            progress.advance(1);
            Ok((block, row))
        })
        .collect::<Result<_, BuildError>>()?;
    finished.extend(computed);
    Ok(work
        .iter()
        .filter_map(|block| finished.remove(block))
        .collect())
}

/// Computes one row of points (`r`, `depths`), of which known cells keep their numbers.
///
/// Probes whose errors are known are left blank.
fn row(
    plan: &PointPlan,
    kind: Kind,
    r: f64,
    depths: &[f64],
    known: Option<&Known>,
) -> Result<Row, BuildError> {
    let nu = plan.kernel().medium().poisson_ratio();
    let mut row = Row::default();
    for &z in depths {
        let is_known = known.is_some_and(|known| known.measured(kind, nu, [r, z]));
        let mut point = if is_known {
            plan.blank()
        } else {
            plan.compute(r, z)?
        };
        point.round();
        if let (Kind::Nodes, Some(known)) = (kind, known) {
            known.keep(nu, [r, z], &mut point);
        }
        for field in 0..6 {
            for (list, values) in row.iter_mut().zip(point.lists()) {
                list.extend(values.iter().map(|six| six[field] as f32));
            }
        }
    }
    Ok(row)
}

/// Those of the rows found in a journal or in shards that this work can use.
///
/// Left out are blocks that the grid does not have, rows of another length, and rows with blanks: an extension leaves
/// probes blank whose errors it knows, and without that knowledge they are not there.
///
/// # Errors
/// [`BuildError::Domain`], which no valid grid causes.
pub(crate) fn usable(
    grid: &Grid,
    work: &[Block],
    mut found: HashMap<Block, Row>,
    known: Option<&Known>,
) -> Result<HashMap<Block, Row>, BuildError> {
    let places = Kind::ALL.map(|kind| positions(kind, grid));
    let each = [grid.cells()?, grid.cells()?, grid.cells()?, grid.tail_terms].map(|n| 6 * n);
    let mut usable = HashMap::new();
    for &block in work {
        let Some(row) = found.remove(&block) else {
            continue;
        };
        let [r, z] = &places[block.kind as usize];
        let mut sized = row.iter().zip(each);
        let whole = sized.all(|(array, each)| array.len() == each * z.len());
        let ratio = grid.ratio_of(block)?;
        let there = |(k, &z): (usize, &f64)| {
            let arrays = row.iter().zip(each);
            let mut parts = arrays.map(|(array, each)| &array[k * each..(k + 1) * each]);
            parts.all(|part| part.iter().all(|x| x.is_finite()))
                || known.is_some_and(|known| known.measured(block.kind, ratio, [r[block.row], z]))
        };
        if whole && z.iter().enumerate().all(there) {
            usable.insert(block, row);
        }
    }
    Ok(usable)
}
