//! The parts of a table on disk that impacts have needed, kept for the next ones.

use impact::source::{TableFault, Tables};
use lookup::{BadTable, LookupError, Table, TableError, TableFile};
use std::path::Path;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

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
    pub(crate) fn whole(&self) -> Result<Arc<Table>, TableError> {
        if let Some(table) = self.whole.get() {
            return Ok(Arc::clone(table));
        }
        let table = self.same(Table::open(self.path()))?;
        Ok(Arc::clone(self.whole.get_or_init(|| table)))
    }

    /// A table that was read, if its file is the one that was opened.
    fn same(&self, read: Result<Table, TableError>) -> Result<Arc<Table>, TableError> {
        let table = read?;
        if table.id() == self.id() {
            Ok(Arc::new(table))
        } else {
            Err(BadTable::Changed.of(self.path()))
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
