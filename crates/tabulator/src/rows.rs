//! All rows of a table: the existing ones, and the others, computed on all threads.

use crate::block::{PointKind, Row, TableBlock, positions};
use crate::error::BuildError;
use crate::grid::Grid;
use crate::journal::{kept, parsed};
use crate::known::Known;
use crate::progress::Progress;
use output::{Journal, Title};
use rayon::prelude::*;
use std::collections::HashMap;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// Work on the table of a grid.
pub(crate) struct TableWork<'a> {
    pub(crate) grid: &'a Grid,
    /// Smaller table with some of the numbers.
    pub(crate) known: Option<&'a Known>,
    pub(crate) progress: &'a dyn Progress,
    /// Number of cells of a slice.
    pub(crate) cells: usize,
    /// Poisson's ratios, radii and depths of each kind of points.
    pub(crate) points: [(Vec<f64>, [Vec<f64>; 2]); 3],
    /// Blocks in the order of storage.
    pub(crate) blocks: Vec<TableBlock>,
}

impl<'a> TableWork<'a> {
    /// The work on all blocks of a grid.
    ///
    /// # Errors
    /// [`BuildError::Domain`], which does not occur for a valid grid.
    pub(crate) fn new(
        grid: &'a Grid,
        known: Option<&'a Known>,
        progress: &'a dyn Progress,
    ) -> Result<Self, BuildError> {
        let slices: Vec<f64> = grid.slices().iter().map(|slice| slice.0).collect();
        let between = grid.between()?;
        let points = PointKind::ALL.map(|kind| {
            let ratios = match kind {
                PointKind::Nodes | PointKind::Probes => &slices,
                PointKind::Between => &between,
            };
            (ratios.clone(), positions(kind, grid))
        });
        let of = |slice, kind: PointKind| {
            let rows = 0..points[kind as usize].1[0].len();
            rows.map(move |row| TableBlock { slice, kind, row })
        };
        let on = |slice| of(slice, PointKind::Nodes).chain(of(slice, PointKind::Probes));
        let on = (0..slices.len()).flat_map(on);
        let between = (0..between.len()).flat_map(|slice| of(slice, PointKind::Between));
        let blocks = on.chain(between).collect();
        Ok(Self {
            grid,
            known,
            progress,
            cells: grid.cells()?,
            points,
            blocks,
        })
    }

    /// Poisson's ratio, radius and depths of the points of a block.
    pub(crate) fn place(&self, block: TableBlock) -> (f64, f64, &[f64]) {
        let (ratios, [r, z]) = &self.points[block.kind as usize];
        (ratios[block.slice], r[block.row], z)
    }

    /// Number of values of a point in each list of a row.
    fn each(&self) -> [usize; 4] {
        [self.cells, self.cells, self.cells, self.grid.tail_terms].map(|n| 6 * n)
    }

    /// Opens or creates a journal and returns the finished rows. A journal with other settings is replaced if `drops`
    /// accepts them.
    pub(crate) fn open(
        &self,
        path: &Path,
        title: &Title,
        drops: impl Fn(&str) -> bool,
    ) -> Result<(Mutex<Journal>, HashMap<TableBlock, Row>), BuildError> {
        let mut found = HashMap::new();
        let drops = |other: &Title| drops(&other.about);
        let take = |_, kept: &[u8]| self.take(&mut found, kept);
        let journal = Journal::open(path, title, drops, take)?;
        Ok((Mutex::new(journal), found))
    }

    /// Adds the row of a record if this work can use it; returns false if the record is invalid.
    ///
    /// Skipped are blocks that are not in the grid, rows of another length, and rows with blanks: an extension leaves
    /// probes blank if it knows their errors, and without the older table these probes are missing.
    pub(crate) fn take(&self, found: &mut HashMap<TableBlock, Row>, kept: &[u8]) -> bool {
        let Some((block, row)) = parsed(kept) else {
            return false;
        };
        let (ratios, [r, z]) = &self.points[block.kind as usize];
        let each = self.each();
        let mut sized = row.iter().zip(each);
        let whole = block.slice < ratios.len()
            && block.row < r.len()
            && sized.all(|(array, each)| array.len() == each * z.len());
        let there = |(k, &z): (usize, &f64)| {
            let arrays = row.iter().zip(each);
            let mut parts = arrays.map(|(array, each)| &array[k * each..(k + 1) * each]);
            parts.all(|part| part.iter().all(|x| x.is_finite())) || self.measured(block, z)
        };
        if whole && z.iter().enumerate().all(there) {
            found.insert(block, row);
        }
        true
    }

    /// Whether the errors at a point of a block are known.
    fn measured(&self, block: TableBlock, z: f64) -> bool {
        let (ratio, r, _) = self.place(block);
        let known = self.known;
        known.is_some_and(|known| known.probe(block.kind, ratio, [r, z]).is_some())
    }

    /// Adds the rows that need no computation: rows of known nodes, and empty rows for probes whose errors are all
    /// known.
    pub(crate) fn add_known(&self, finished: &mut HashMap<TableBlock, Row>) {
        for &block in &self.blocks {
            let (ratio, r, z) = self.place(block);
            let row = match (block.kind, self.known) {
                (PointKind::Nodes, Some(known)) => known.nodes(ratio, self.cells, r, z),
                (_, _) => (z.iter().all(|&z| self.measured(block, z))).then(Row::default),
            };
            finished.extend(row.map(|row| (block, row)));
        }
    }

    /// All rows in the order of the blocks. Rows that are not in `finished` are computed and recorded in the journal,
    /// if there is one.
    ///
    /// # Errors
    /// [`BuildError`] if the exact kernels reject a point, or the journal cannot be written.
    pub(crate) fn rows(
        &self,
        mut finished: HashMap<TableBlock, Row>,
        journal: Option<&Mutex<Journal>>,
    ) -> Result<Vec<Row>, BuildError> {
        let mut missing = self.blocks.clone();
        missing.retain(|block| !finished.contains_key(block));
        self.progress.total("kernels", missing.len() as u64);
        let computed: Vec<(TableBlock, Row)> = missing
            .par_iter()
            .with_max_len(1)
            .map(|&block| {
                let row = self.row(block)?;
                if let Some(journal) = journal {
                    let kept = kept(block, &row);
                    let mut journal = journal.lock().unwrap_or_else(PoisonError::into_inner);
                    journal.append(&kept)?;
                }
                self.progress.advance(1);
                Ok((block, row))
            })
            .collect::<Result<_, BuildError>>()?;
        finished.extend(computed);
        let blocks = self.blocks.iter();
        Ok(blocks.filter_map(|block| finished.remove(block)).collect())
    }

    /// Computes a row; known cells keep their numbers, and probes whose errors are known stay blank.
    fn row(&self, block: TableBlock) -> Result<Row, BuildError> {
        let (ratio, r, depths) = self.place(block);
        let plan = match block.kind {
            PointKind::Nodes => self.grid.point(ratio)?,
            PointKind::Probes | PointKind::Between => self.grid.probe(ratio)?,
        };
        self.progress.slice(ratio);
        let mut row = Row::default();
        for &z in depths {
            if self.measured(block, z) {
                for (list, each) in row.iter_mut().zip(self.each()) {
                    list.resize(list.len() + each, f32::NAN);
                }
                continue;
            }
            let mut point = plan.compute(r, z)?;
            lookup::round(&mut point);
            if let (PointKind::Nodes, Some(known)) = (block.kind, self.known) {
                known.keep(ratio, [r, z], &mut point);
            }
            for field in 0..6 {
                for (list, values) in row.iter_mut().zip(&point) {
                    list.extend(values.iter().map(|six| six[field] as f32));
                }
            }
        }
        Ok(row)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::journal::title;
    use crate::progress::Silent;
    use output::OutputError;

    #[test]
    fn what_is_unfinished_is_kept_until_it_may_go() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.journal");
        let small = Grid::demo();
        let work = TableWork::new(&small, None, &Silent).unwrap();
        let grid = small.to_toml().unwrap();
        let other = grid.replace("0.3", "0.25");
        let (block, (.., z)) = (work.blocks[0], work.place(work.blocks[0]));
        let row = work.each().map(|each| vec![0.0; each * z.len()]);
        let of = |there: &Title, wanted: &Title, goes: &str| {
            let _ = std::fs::remove_file(&path);
            let (mut journal, _) = work.open(&path, there, |_| false).unwrap();
            let journal = journal.get_mut().unwrap();
            journal.append(&kept(block, &row)).unwrap();
            let opened = work.open(&path, wanted, |settings| settings == goes);
            opened.map(|(_, rows)| rows.len())
        };
        let kept = |found| matches!(found, Err(BuildError::Output(OutputError::Begun(..))));
        let (build, extension) = (title(&grid, None), title(&grid, Some("1")));
        assert_eq!(of(&build, &build, "").unwrap(), 1);
        assert!(kept(of(&build, &title(&other, None), "")));
        assert!(kept(of(&extension, &build, "")));
        assert!(kept(of(&extension, &title(&grid, Some("2")), &other)));
        assert_eq!(of(&extension, &build, &grid).unwrap(), 0);
        assert_eq!(of(&build, &title(&other, Some("1")), &grid).unwrap(), 0);
    }
}
