//! Kernel tables: opened once, used often. The part that the latest impact needed stays in memory for the next one.

use crate::errors::{self, raise, whole_in};
use crate::values::{Array, fields, from_json, frozen, numbers};
use crate::work::{Threads, Ticker, run};
use fault::AnyError;
use formats::table_report;
use impact::Tables;
use lookup::{BadTable, LookupError, Smoothness, TableError, TableFile, TraceInfo};
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use rayon::prelude::*;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use tabulator::Progress;

/// Number of points that a thread looks up at a time.
const GRAIN: usize = 16;

/// A kernel table on disk.
#[pyclass(module = "hertzlamb._core", frozen)]
pub(crate) struct Table {
    pub(crate) opened: Arc<Opened>,
}

#[pymethods]
impl Table {
    /// Opens the table of a file.
    #[staticmethod]
    fn open(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let file = run(py, None, None, move |_| TableFile::open(&path))?.map_err(raise)?;
        let opened = Arc::new(Opened {
            file,
            part: Mutex::default(),
            whole: OnceLock::new(),
        });
        Ok(Self { opened })
    }

    /// Path of the file.
    #[getter]
    fn path(&self) -> PathBuf {
        self.opened.file.path().to_owned()
    }

    /// Settings and measured errors, with the keys of `hertzlamb table info --json`.
    fn info<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let opened = Arc::clone(&self.opened);
        let info = move |_: &Ticker| Ok(table_report(opened.file.path(), &*opened.whole()?));
        let found: Result<_, TableError> = run(py, None, None, info)?;
        from_json(py, &found.map_err(raise)?)
    }

    /// Hash of the settings of the table.
    #[getter]
    fn id(&self) -> &str {
        self.opened.file.id()
    }

    /// Step responses at the places (r, z): means over time cells (place, cell, 6), static fields and errors (place, 6),
    /// and the width of a cell.
    #[pyo3(signature = (nu, r, z, coarsening, cells, smooth, threads=None, progress=None))]
    fn trace<'py>(
        &self,
        py: Python<'py>,
        nu: f64,
        r: PyReadonlyArray1<'py, f64>,
        z: PyReadonlyArray1<'py, f64>,
        coarsening: &Bound<'py, PyAny>,
        cells: Option<&Bound<'py, PyAny>>,
        smooth: bool,
        threads: Option<Threads>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(Array<'py>, Array<'py>, Array<'py>, f64)> {
        let coarsening =
            whole_in("coarsening", coarsening, 0..=u32::MAX as usize, "[0, 20]")? as u32;
        let cells = cells.map(|cells| whole_in("cells", cells, 1..=usize::MAX, "[1, inf)"));
        let cells = cells.transpose()?;
        let places = numbers(&r).into_iter().zip(numbers(&z));
        let points: Vec<[f64; 2]> = places.map(|(r, z)| [r, z]).collect();
        let smoothness = match smooth {
            true => Smoothness::Smooth,
            false => Smoothness::Linear,
        };
        let rows = points.len();
        let opened = Arc::clone(&self.opened);
        let table = run(py, threads, None, move |_| opened.whole())?.map_err(raise)?;
        let held = table.content().slices.iter().map(|slice| slice.cells).max();
        let cells = cells.unwrap_or((held.unwrap_or(0) >> coarsening.min(31)).max(1));
        // reserved first, since an allocation that fails would abort the process
        let mut values = Vec::new();
        let all = rows.checked_mul(cells);
        if all.is_none_or(|all| values.try_reserve_exact(all).is_err()) {
            let message = format!(
                "{rows} points of {cells} cells need {:.3} GB of memory, more than there is: pass fewer points or cells, or a larger coarsening",
                48e-9 * rows as f64 * cells as f64
            );
            return Err(errors::plain("TooMuchMemory", &message));
        }
        // (point, cell, field); each task has GRAIN points
        let found = run(py, threads, progress, move |ticker| {
            ticker.total("points", rows as u64);
            values.resize(rows * cells, [0.0; 6]);
            let mut infos = vec![TraceInfo::default(); rows];
            let chunks = values.par_chunks_mut((GRAIN * cells).max(1));
            let chunks = chunks.zip(infos.par_chunks_mut(GRAIN));
            let parts = chunks.zip(points.par_chunks(GRAIN));
            let traced = parts.try_for_each(|((values, infos), points)| {
                ticker.advance(points.len() as u64);
                table.traces(smoothness, nu, points, coarsening, values, infos)?;
                for (row, info) in values.chunks_exact_mut(cells).zip(infos) {
                    for six in row {
                        for (value, still) in six.iter_mut().zip(info.static_part) {
                            *value += still;
                        }
                    }
                }
                Ok::<_, LookupError>(())
            });
            traced.map(|()| (values, infos))
        })?;
        let file = Some(self.opened.file.path());
        let (values, infos) = found.map_err(|error| errors::raised_in(error, file))?;
        let width = infos.first().map_or(f64::NAN, |info| info.cell_width);
        let (still, limits) = infos.iter().map(|i| (i.static_part, i.error)).unzip();
        let values = frozen(py, values.into_flattened(), &[rows, cells, 6])?;
        Ok((values, fields(py, still)?, fields(py, limits)?, width))
    }
}

/// A loaded part of a table: its Poisson's ratio, its span of r and z in r0, and the part.
#[derive(Debug)]
struct Part(f64, [[f64; 2]; 2], Arc<lookup::Table>);

/// A table on disk with the parts that are in memory.
#[derive(Debug)]
pub(crate) struct Opened {
    pub(crate) file: TableFile,
    /// Part for the latest impact; its values equal those of the whole table.
    part: Mutex<Option<Part>>,
    whole: OnceLock<Arc<lookup::Table>>,
}

impl Opened {
    /// The whole table, loaded at the first call.
    pub(crate) fn whole(&self) -> Result<Arc<lookup::Table>, TableError> {
        if let Some(table) = self.whole.get() {
            return Ok(Arc::clone(table));
        }
        let table = lookup::Table::open(self.file.path())?;
        if table.id() != self.file.id() {
            return Err(BadTable::Changed.of(self.file.path()));
        }
        Ok(Arc::clone(self.whole.get_or_init(|| Arc::new(table))))
    }
}

impl Tables for Opened {
    fn reach(&self) -> [f64; 2] {
        self.file.reach()
    }

    fn part(
        &self,
        poisson_ratio: f64,
        span: [[f64; 2]; 2],
    ) -> Result<Arc<lookup::Table>, AnyError> {
        let mut kept = self.part.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(Part(ratio, [first, last], table)) = &*kept
            && ratio.to_bits() == poisson_ratio.to_bits()
            && (0..2).all(|axis| first[axis] <= span[0][axis] && span[1][axis] <= last[axis])
        {
            return Ok(Arc::clone(table));
        }
        let table = Arc::new(self.file.part(poisson_ratio, span)?);
        *kept = Some(Part(poisson_ratio, span, Arc::clone(&table)));
        Ok(table)
    }

    fn refusal(
        &self,
        poisson_ratio: f64,
        farthest: [f64; 2],
    ) -> Result<Option<LookupError>, AnyError> {
        Tables::refusal(&self.file, poisson_ratio, farthest)
    }
}
