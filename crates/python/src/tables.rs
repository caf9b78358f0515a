//! The parts of a table on disk that impacts have needed, kept for the next ones.

use impact::source::{TableFault, Tables};
use lookup::{LookupError, Table, TableError, TableFile};
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Why a table cannot be had.
#[derive(Debug)]
pub(crate) enum Fault {
    /// Its file is none.
    Table(TableError),
    /// The file has been replaced or extended since it was opened.
    Changed(PathBuf),
}

impl std::error::Error for Fault {}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Table(error) => error.fmt(f),
            Self::Changed(path) => write!(
                f,
                "{} is another table than when it was opened: open it again",
                path.display()
            ),
        }
    }
}

/// A part that was loaded.
#[derive(Debug)]
struct Part {
    poisson_ratio: f64,
    farthest: [f64; 2],
    table: Arc<Table>,
}

/// A table on disk with what was loaded of it.
#[derive(Debug)]
pub(crate) struct Opened {
    file: TableFile,
    /// The part of the last impact: a part answers as the whole does.
    part: Mutex<Option<Part>>,
    whole: OnceLock<Arc<Table>>,
}

impl Opened {
    pub(crate) fn new(file: TableFile) -> Self {
        Self {
            file,
            part: Mutex::new(None),
            whole: OnceLock::new(),
        }
    }

    pub(crate) fn path(&self) -> &Path {
        self.file.path()
    }

    /// Identity of the settings that it was made with.
    pub(crate) fn id(&self) -> &str {
        self.file.id()
    }

    /// All of it, loaded once.
    pub(crate) fn whole(&self) -> Result<Arc<Table>, Fault> {
        if let Some(table) = self.whole.get() {
            return Ok(Arc::clone(table));
        }
        let table = self.same(Table::open(self.path()))?;
        Ok(Arc::clone(self.whole.get_or_init(|| table)))
    }

    /// A table that was read, if its file is the one that was opened.
    fn same(&self, read: Result<Table, TableError>) -> Result<Arc<Table>, Fault> {
        let table = read.map_err(Fault::Table)?;
        if table.id() == self.id() {
            Ok(Arc::new(table))
        } else {
            Err(Fault::Changed(self.path().to_owned()))
        }
    }
}

impl Tables for Opened {
    fn part(&self, poisson_ratio: f64, farthest: [f64; 2]) -> Result<Arc<Table>, TableFault> {
        let mut kept = self.part.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(part) = &*kept
            && part.poisson_ratio.to_bits() == poisson_ratio.to_bits()
            && part
                .farthest
                .iter()
                .zip(farthest)
                .all(|(&has, wants)| wants <= has)
        {
            return Ok(Arc::clone(&part.table));
        }
        let table = self.same(self.file.part(poisson_ratio, farthest))?;
        *kept = Some(Part {
            poisson_ratio,
            farthest,
            table: Arc::clone(&table),
        });
        Ok(table)
    }

    fn refusal(
        &self,
        poisson_ratio: f64,
        farthest: [f64; 2],
    ) -> Result<Option<LookupError>, TableFault> {
        Tables::refusal(&self.file, poisson_ratio, farthest)
    }
}
