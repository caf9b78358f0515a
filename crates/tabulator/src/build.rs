//! From a grid to a complete, verified file.

use crate::blocks::{self, Block, Kind, Row};
use crate::error::BuildError;
use crate::grid::Grid;
use crate::journal::{self, Journal};
use crate::known::Known;
use crate::point::PointPlan;
use crate::progress::Progress;
use crate::verify;
use lookup::{Between, Content, Origin, Slice, Table, Verification};
use rayon::prelude::*;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{Instant, SystemTime, UNIX_EPOCH};

/// What a build did.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// Identity of the settings.
    pub id: String,
    /// SHA-256 of the content.
    pub content_sha256: String,
    /// Points of the grid over all slices.
    pub points: usize,
    /// Size of the file.
    pub bytes: u64,
    /// Time taken.
    pub wall_s: f64,
    /// Blocks that an interrupted run had computed already.
    pub resumed_blocks: usize,
    /// Lengths of the verification pulses in r0/c1.
    pub pulse_lengths: Vec<f64>,
    /// p99 over all probes and fields of error over peak, for each pulse length.
    pub p99_error: Vec<f64>,
}

/// What to do when the output exists already.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Existing {
    /// Leave it and report [`BuildError::Exists`].
    Keep,
    /// Replace it when the new table is complete and verified.
    Replace,
}

/// Builds the table of `grid` at `path`, which must not exist.
///
/// # Errors
/// [`BuildError`]: a setting outside its range, a file in the way, a value that cannot be computed, a full disk.
pub fn build(grid: &Grid, path: &Path, progress: &dyn Progress) -> Result<Summary, BuildError> {
    build_over(grid, path, Existing::Keep, progress)
}

/// [`build`] with a choice of what happens to a file that is there already.
///
/// # Errors
/// As [`build`].
pub fn build_over(
    grid: &Grid,
    path: &Path,
    existing: Existing,
    progress: &dyn Progress,
) -> Result<Summary, BuildError> {
    let started = Instant::now();
    grid.validate()?;
    refuse(path, existing)?;
    let work = blocks::all(grid);
    let (journal, finished) = Journal::open(&beside(path, ".journal"), &grid.to_toml()?)?;
    // Another run may have finished the table before this one had the journal.
    if let Err(error) = refuse(path, existing) {
        journal.remove()?;
        return Err(error);
    }
    let resumed_blocks = finished.len();
    let journal = Mutex::new(journal);
    let rows = compute(grid, &work, finished, Some(&journal), None, progress)?;
    let summary = complete(grid, rows, path, None, progress)?;
    journal
        .into_inner()
        .unwrap_or_else(PoisonError::into_inner)
        .remove()?;
    Ok(Summary {
        resumed_blocks,
        wall_s: started.elapsed().as_secs_f64(),
        ..summary
    })
}

/// Computes part `index` of `count` (from 1) of the blocks of `grid` into the file `path`, to be joined by [`merge`].
///
/// Given again, it goes on where it stopped; when all blocks of the part are there it does nothing.
///
/// # Errors
/// As [`build`]; [`BuildError::Setting`] when `index` is not in 1 ..= `count`.
pub fn build_shard(
    grid: &Grid,
    index: usize,
    count: usize,
    path: &Path,
    progress: &dyn Progress,
) -> Result<usize, BuildError> {
    grid.validate()?;
    if index < 1 || index > count {
        let key = "shard".to_owned();
        return Err(BuildError::Setting {
            key,
            value: index as f64,
            range: "1 .. the number of shards",
        });
    }
    let work: Vec<Block> = blocks::all(grid)
        .into_iter()
        .skip(index - 1)
        .step_by(count)
        .collect();
    let (journal, finished) = Journal::open(path, &grid.to_toml()?)?;
    compute(
        grid,
        &work,
        finished,
        Some(&Mutex::new(journal)),
        None,
        progress,
    )?;
    Ok(work.len())
}

/// Joins the shards at `parts` into a table at `path`.
///
/// # Errors
/// [`BuildError`]: a file that is no shard, shards of different settings, blocks that are missing, or as [`build`].
pub fn merge(
    parts: &[PathBuf],
    path: &Path,
    existing: Existing,
    progress: &dyn Progress,
) -> Result<Summary, BuildError> {
    let started = Instant::now();
    refuse(path, existing)?;
    let mut settings: Option<String> = None;
    let mut finished = HashMap::new();
    for part in parts {
        let (grid, rows) = journal::read(part)?;
        if settings.as_ref().is_some_and(|first| *first != grid) {
            return Err(BuildError::Mixed {
                first: parts[0].clone(),
                second: part.clone(),
            });
        }
        settings = Some(grid);
        finished.extend(rows);
    }
    let text = settings.unwrap_or_default();
    let grid: Grid = toml::from_str(&text).map_err(|error| BuildError::GridFile {
        path: parts.first().cloned().unwrap_or_default(),
        detail: error.to_string(),
    })?;
    let work = blocks::all(&grid);
    let missing: Vec<&Block> = work
        .iter()
        .filter(|block| !finished.contains_key(block))
        .collect();
    if let Some(first) = missing.first() {
        return Err(BuildError::Incomplete {
            missing: missing.len(),
            total: work.len(),
            poisson_ratio: grid.slices()[first.slice].0,
            row: first.row,
        });
    }
    let rows = work
        .iter()
        .filter_map(|block| finished.remove(block))
        .collect();
    let summary = complete(&grid, rows, path, None, progress)?;
    Ok(Summary {
        wall_s: started.elapsed().as_secs_f64(),
        ..summary
    })
}

fn refuse(path: &Path, existing: Existing) -> Result<(), BuildError> {
    match existing {
        Existing::Keep if path.exists() => Err(BuildError::Exists {
            path: path.to_owned(),
        }),
        Existing::Keep | Existing::Replace => Ok(()),
    }
}

/// From all rows to the file under its name.
pub(crate) fn complete(
    grid: &Grid,
    rows: Vec<Row>,
    path: &Path,
    known: Option<&Known>,
    progress: &dyn Progress,
) -> Result<Summary, BuildError> {
    let content = assemble(grid, &blocks::all(grid), rows, known, progress)?;
    let bytes = finish(&content, path)?;
    Ok(Summary {
        id: lookup::settings_id(&content.origin.grid),
        content_sha256: lookup::content_hash(&content),
        points: content.r.len() * content.z.len() * content.slices.len(),
        bytes,
        wall_s: 0.0,
        resumed_blocks: 0,
        pulse_lengths: content.pulse_lengths.clone(),
        p99_error: content.origin.accuracy_reached,
    })
}

/// All rows in the order of `work`: those finished before, and the others computed and, with a journal, recorded now.
pub(crate) fn compute(
    grid: &Grid,
    work: &[Block],
    mut finished: HashMap<Block, Row>,
    journal: Option<&Mutex<Journal>>,
    known: Option<&Known>,
    progress: &dyn Progress,
) -> Result<Vec<Row>, BuildError> {
    let plans = Plans::new(grid)?;
    let positions =
        [Kind::Nodes, Kind::Probes, Kind::Between].map(|kind| blocks::positions(kind, grid));
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
            let [r, z] = &positions[block.kind as usize];
            let row = blocks::compute(plans.of(block), block.kind, r[block.row], z, known)?;
            if let Some(journal) = journal {
                let mut journal = journal.lock().unwrap_or_else(PoisonError::into_inner);
                journal.record(block, &row)?;
            }
            progress.slice(plans.of(block).kernel().medium().poisson_ratio());
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

/// What is computed in each slice and between them.
struct Plans {
    slices: Vec<PointPlan>,
    between: Vec<PointPlan>,
}

impl Plans {
    fn new(grid: &Grid) -> Result<Self, BuildError> {
        let slices = grid.slices();
        Ok(Self {
            slices: slices
                .iter()
                .map(|&(nu, _)| plan(grid, nu))
                .collect::<Result<_, _>>()?,
            between: (0..grid.poisson_ratios.len() - 1)
                .map(|interval| plan(grid, grid.between(interval)?))
                .collect::<Result<_, _>>()?,
        })
    }

    fn of(&self, block: Block) -> &PointPlan {
        match block.kind {
            Kind::Nodes | Kind::Probes => &self.slices[block.slice],
            Kind::Between => &self.between[block.slice],
        }
    }
}

/// What is computed at every point of one slice.
pub(crate) fn plan(grid: &Grid, poisson_ratio: f64) -> Result<PointPlan, BuildError> {
    let width = grid.cell_width * lookup::cell_scale(poisson_ratio)?;
    PointPlan::new(
        poisson_ratio,
        grid.tolerance,
        width,
        grid.cells()?,
        grid.tail_terms,
    )
}

/// Puts the rows in their places and measures the errors off the grid.
pub(crate) fn assemble(
    grid: &Grid,
    work: &[Block],
    rows: Vec<Row>,
    known: Option<&Known>,
    progress: &dyn Progress,
) -> Result<Content, BuildError> {
    let [r, z] = grid.nodes();
    let [probe_r, probe_z] = blocks::positions(Kind::Probes, grid);
    let pulse_lengths = grid.pulse_lengths.clone();
    let blank = |places: usize| {
        let zeros = vec![0.0; places * pulse_lengths.len() * 6];
        Verification {
            direct: zeros.clone(),
            looked_up: zeros.clone(),
            error: zeros,
        }
    };
    let cells = grid.cells()?;
    let mut slices: Vec<Slice> = grid
        .slices()
        .into_iter()
        .map(|(poisson_ratio, role)| Slice {
            poisson_ratio,
            role,
            cells,
            remainder: Vec::new(),
            moment: Vec::new(),
            curvature: Vec::new(),
            tail: Vec::new(),
            verification: blank(probe_r.len() * probe_z.len()),
        })
        .collect();
    let intervals = grid.poisson_ratios.len() - 1;
    let mut exact: Vec<Vec<Row>> = vec![Vec::new(); slices.len()];
    let mut exact_between: Vec<Vec<Row>> = vec![Vec::new(); intervals];
    for (block, row) in work.iter().zip(rows) {
        match block.kind {
            Kind::Nodes => {
                let slice = &mut slices[block.slice];
                slice.remainder.extend(row.remainder);
                slice.moment.extend(row.moment);
                slice.curvature.extend(row.curvature);
                slice.tail.extend(row.tail);
            }
            Kind::Probes => exact[block.slice].push(row),
            Kind::Between => exact_between[block.slice].push(row),
        }
    }
    let [between_r, between_z] = if intervals > 0 {
        blocks::positions(Kind::Between, grid)
    } else {
        Default::default()
    };
    let table = Table::new(Content {
        origin: Origin {
            grid: grid.to_toml()?,
            software_version: env!("CARGO_PKG_VERSION").to_owned(),
            git_revision: env!("HERTZLAMB_GIT_REVISION").to_owned(),
            created_unix_s: creation_time(),
            accuracy_asked: grid.tolerance,
            accuracy_reached: Vec::new(),
        },
        r,
        z,
        r_max: grid.r.end(),
        z_max: grid.z.end(),
        cell_width: grid.cell_width,
        stencil_points: grid.stencil_points,
        pulse_lengths,
        slices,
        between_r: between_r.clone(),
        between_z: between_z.clone(),
        between: Vec::new(),
    })?;
    progress.total("verification", (exact.len() + intervals) as u64);
    let mut measured = Vec::new();
    for (&nu, rows) in table.poisson_ratios().iter().zip(&exact) {
        measured.push(verify::verify(
            &table,
            nu,
            Kind::Probes,
            [&probe_r, &probe_z],
            rows,
            known,
        )?);
        progress.slice(nu);
        progress.advance(1);
    }
    let mut between = Vec::new();
    for (interval, rows) in exact_between.iter().enumerate() {
        let poisson_ratio = grid.between(interval)?;
        let places = [between_r.as_slice(), between_z.as_slice()];
        between.push(Between {
            poisson_ratio,
            verification: verify::verify(
                &table,
                poisson_ratio,
                Kind::Between,
                places,
                rows,
                known,
            )?,
        });
        progress.slice(poisson_ratio);
        progress.advance(1);
    }
    let mut content = table.into_content();
    content.between = between;
    for (slice, verification) in content.slices.iter_mut().zip(measured) {
        slice.verification = verification;
    }
    let all: Vec<&Verification> = content.slices.iter().map(|s| &s.verification).collect();
    content.origin.accuracy_reached = (0..content.pulse_lengths.len())
        .map(|pulse| {
            let mut all: Vec<f64> = (0..6)
                .flat_map(|field| verify::relative_errors(&content, &all, pulse, field, 1e-3))
                .collect();
            all.sort_by(f64::total_cmp);
            verify::quantile(&all, 0.99)
        })
        .collect();
    Ok(content)
}

/// Writes under `NAME.part`, reads back, compares, renames. Returns the size of the file.
fn finish(content: &Content, path: &Path) -> Result<u64, BuildError> {
    let part = beside(path, ".part");
    let done = write_checked(content, &part, path);
    if done.is_err() {
        // What could be written takes room and is of no use; the journal has all of it.
        let _ = std::fs::remove_file(&part);
    }
    done
}

fn write_checked(content: &Content, part: &Path, path: &Path) -> Result<u64, BuildError> {
    let failed = |action, path: &Path| {
        let path = path.to_owned();
        move |source| BuildError::File {
            action,
            path,
            source,
        }
    };
    lookup::write(part, content)?;
    let back = lookup::read(part)?;
    lookup::check_hash(part, &back)?;
    let file = std::fs::File::open(part).map_err(failed("open", part))?;
    file.sync_all().map_err(failed("flush", part))?;
    std::fs::rename(part, path).map_err(failed("rename the finished table to", path))?;
    let data = std::fs::metadata(path).map_err(failed("look at", path))?;
    Ok(data.len())
}

/// `path` with `suffix` appended to its name.
pub(crate) fn beside(path: &Path, suffix: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(suffix);
    PathBuf::from(name)
}

/// `SOURCE_DATE_EPOCH` if it is set, so that a build can be repeated byte by byte, else now.
fn creation_time() -> u64 {
    std::env::var("SOURCE_DATE_EPOCH")
        .ok()
        .and_then(|text| text.parse().ok())
        .or_else(|| {
            SystemTime::now()
                .duration_since(UNIX_EPOCH)
                .ok()
                .map(|time| time.as_secs())
        })
        .unwrap_or(0)
}
