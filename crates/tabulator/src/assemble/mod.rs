//! Assembly: from rows to content, measured errors (`verify`) and the file under its final name.

mod verify;

use crate::block::{PointKind, Row};
use crate::error::BuildError;
use crate::numbers::NUMBERS_REVISION;
use crate::rows::TableWork;
use lookup::{Accuracy, BadTable, Between, Content, Origin, Slice, Table, Verification, schema};
use output::{Output, OutputFault};
use rayon::prelude::*;
use std::fs::File;
use std::path::Path;
use std::time::{Instant, SystemTime, UNIX_EPOCH};

/// Summary of a build.
#[derive(Debug, Clone, PartialEq)]
pub struct BuildSummary {
    /// Hash of the settings.
    pub id: String,
    /// SHA-256 of the content.
    pub content_sha256: String,
    /// Number of nodes of all slices.
    pub points: usize,
    /// Size of the file in bytes.
    pub bytes: u64,
    /// Elapsed time in s.
    pub wall_s: f64,
    /// Number of blocks from an interrupted run.
    pub resumed_blocks: usize,
    /// Relative errors by field, on slices and between them, for each pulse length.
    pub accuracy: Vec<Accuracy>,
}

/// Writes the table of all rows under its final name.
pub(crate) fn complete(
    work: &TableWork<'_>,
    rows: Vec<Row>,
    output: &Output,
    started: Instant,
) -> Result<BuildSummary, BuildError> {
    let content = assemble(work, rows)?;
    let staged = output.stage_made(|name| write_checked(&content, name))?;
    let bytes = staged.bytes;
    staged.commit()?;
    Ok(BuildSummary {
        id: lookup::settings_id(&content.origin.grid),
        content_sha256: lookup::stated_hash(&output.real)?,
        points: content.r.len() * content.z.len() * content.slices.len(),
        bytes,
        wall_s: started.elapsed().as_secs_f64(),
        resumed_blocks: 0,
        accuracy: content.accuracy(),
    })
}

/// Writes a table, reads it back and compares.
fn write_checked(content: &Content, name: &Path) -> Result<File, OutputFault> {
    let held = lookup::write(name, content)
        .and_then(|file| Ok(lookup::holds(name, content)?.then_some(file)));
    let wrong = match held.map_err(|error| error.what) {
        Ok(Some(file)) => return Ok(file),
        Ok(None) => "reading it back returned other content".to_owned(),
        // without the path, which is that of a temporary file
        Err(BadTable::Unwritable(detail)) => detail,
        Err(other) => other.to_string(),
    };
    Err(wrong.into())
}

/// The content of the rows, with errors measured between the nodes.
///
/// # Errors
/// [`BuildError`] if the numbers are not a table, or a probe cannot be looked up.
pub(crate) fn assemble(work: &TableWork<'_>, rows: Vec<Row>) -> Result<Content, BuildError> {
    let mut of_kind =
        PointKind::ALL.map(|kind| vec![Vec::new(); work.points[kind as usize].0.len()]);
    for (block, row) in work.blocks.iter().zip(rows) {
        of_kind[block.kind as usize][block.slice].push(row);
    }
    let [nodes, probes, between] = of_kind;
    let table = Table::new(unmeasured(work, nodes)?)?;
    let steps = probes.len() + between.len();
    work.progress.total("verification", steps as u64);
    let measure = |kind: PointKind, rows: &[Vec<Row>]| {
        let ratios = work.points[kind as usize].0.iter();
        let each = ratios.zip(rows).map(|(&poisson_ratio, rows)| {
            let verification = verify::verify(&table, work, kind, poisson_ratio, rows)?;
            work.progress.slice(poisson_ratio);
            work.progress.advance(1);
            Ok(Between {
                poisson_ratio,
                verification,
            })
        });
        each.collect::<Result<Vec<_>, BuildError>>()
    };
    let on = measure(PointKind::Probes, &probes)?;
    let between = measure(PointKind::Between, &between)?;
    let mut content = table.into_content();
    content.between = between;
    for (slice, measured) in content.slices.iter_mut().zip(on) {
        slice.verification = measured.verification;
    }
    let accuracy = content.accuracy();
    let worst = |errors: &Accuracy| lookup::worst(&errors.on_slices).1.p99;
    content.origin.accuracy_reached = accuracy.iter().map(worst).collect();
    Ok(content)
}

/// The content without measured errors, from the rows of nodes of each slice.
fn unmeasured(work: &TableWork<'_>, nodes: Vec<Vec<Row>>) -> Result<Content, BuildError> {
    let TableWork { grid, known, .. } = *work;
    let older = known.map(|known| known.content.origin.numbers_revision);
    let [(_, [r, z]), (_, probes), (ratios, between)] = work.points.clone();
    let [between_r, between_z] = if ratios.is_empty() {
        Default::default()
    } else {
        between
    };
    let places: usize = probes.iter().map(Vec::len).product();
    let zeros = vec![0.0; places * grid.pulse_lengths.len() * 6];
    let slices = nodes.into_par_iter().zip(grid.slices());
    let slice = |(rows, (poisson_ratio, role)): (Vec<Row>, _)| {
        let joined = |i: usize| rows.iter().map(|row| &row[i][..]).collect::<Vec<_>>();
        Slice {
            poisson_ratio,
            role,
            cells: work.cells,
            remainder: joined(0).concat(),
            moment: joined(1).concat(),
            curvature: joined(2).concat(),
            tail: joined(3).concat(),
            verification: Verification {
                direct: zeros.clone(),
                looked_up: zeros.clone(),
                error: zeros.clone(),
            },
        }
    };
    Ok(Content {
        origin: Origin {
            grid: grid.to_toml()?,
            format_version: schema::FORMAT_VERSION_VALUE.to_owned(),
            software_version: env!("CARGO_PKG_VERSION").to_owned(),
            numbers_revision: older.unwrap_or(NUMBERS_REVISION).min(NUMBERS_REVISION),
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
        pulse_lengths: grid.pulse_lengths.clone(),
        slices: slices.map(slice).collect(),
        between_r,
        between_z,
        between: Vec::new(),
    })
}

/// `SOURCE_DATE_EPOCH` if it is set, so that a build can be repeated byte by byte; otherwise the present time.
fn creation_time() -> u64 {
    let stated = std::env::var("SOURCE_DATE_EPOCH").ok();
    let now = || SystemTime::now().duration_since(UNIX_EPOCH);
    stated
        .and_then(|text| text.parse().ok())
        .unwrap_or_else(|| now().map_or(0, |time| time.as_secs()))
}
