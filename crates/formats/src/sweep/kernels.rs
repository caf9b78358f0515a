//! Where the fields of a sweep have their kernels from.

use crate::error::SceneError;
use impact::{KernelChoice, Shared};
use lookup::{Table, TableError, TableFile, stated_hash};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What a sweep with probes asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FieldKernels<'a> {
    /// Kernels that are computed.
    Direct,
    /// Those of a table.
    Table(&'a Path),
    /// Those of a table where its estimated error is within the tolerance of a row, else computed.
    Within(&'a Path),
}

/// Kernels that are ready.
#[derive(Debug, Clone)]
pub(crate) struct Kernels {
    pub(super) choice: KernelChoice,
    /// What is looked at while rows are computed.
    shared: Option<Arc<Shared>>,
    path: PathBuf,
    /// What identifies them, as TOML.
    pub(super) identity: toml::Table,
}

impl PartialEq for Kernels {
    fn eq(&self, other: &Self) -> bool {
        self.identity == other.identity
    }
}

impl Kernels {
    pub(super) fn new(asked: FieldKernels<'_>, many: bool) -> Result<Self, TableError> {
        let mut identity = toml::Table::new();
        let (name, path) = match asked {
            FieldKernels::Direct => ("direct", None),
            FieldKernels::Table(path) => ("table", Some(path)),
            FieldKernels::Within(path) => ("auto", Some(path)),
        };
        identity.insert("kernel".to_owned(), name.into());
        let Some(path) = path else {
            return Ok(Self {
                choice: KernelChoice::Direct,
                shared: None,
                path: PathBuf::new(),
                identity,
            });
        };
        let file = TableFile::open(path)?;
        identity.insert("table_id".to_owned(), file.id().into());
        identity.insert("table_sha256".to_owned(), stated_hash(path)?.into());
        let (tables, shared): (Arc<dyn impact::Tables>, _) = if many {
            (Arc::new(Arc::new(Table::open(path)?)), None)
        } else {
            let shared = Arc::new(Shared::new(Arc::new(file)));
            (Arc::clone(&shared) as _, Some(shared))
        };
        Ok(Self {
            choice: match asked {
                FieldKernels::Direct => KernelChoice::Direct,
                FieldKernels::Table(_) => KernelChoice::Table(tables),
                FieldKernels::Within(_) => KernelChoice::Within(tables),
            },
            shared,
            path: path.to_owned(),
            identity,
        })
    }

    /// Fails where the table could not be read while rows were computed.
    pub(super) fn check(&self) -> Result<(), SceneError> {
        let fault = self.shared.as_ref().and_then(|shared| shared.fault());
        fault.map_or(Ok(()), |reason| {
            Err(SceneError::unreadable(&self.path, reason))
        })
    }
}
