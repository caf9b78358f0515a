//! Where the fields of a sweep have their kernels from.

use crate::error::SceneError;
use impact::{KernelChoice, Shared};
use lookup::{Table, TableError, TableFile, stated_hash};
use std::path::{Path, PathBuf};
use std::sync::Arc;

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

impl Kernels {
    /// Those of a table or, where there is none, computed ones; `or_computed` where the estimated error of the table is
    /// beyond the tolerance of a row.
    pub(super) fn new(
        path: Option<&Path>,
        or_computed: bool,
        many: bool,
    ) -> Result<Self, TableError> {
        let mut identity = toml::Table::new();
        let name = match path {
            None => "direct",
            Some(_) if or_computed => "auto",
            Some(_) => "table",
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
            choice: match or_computed {
                true => KernelChoice::Within(tables),
                false => KernelChoice::Table(tables),
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
