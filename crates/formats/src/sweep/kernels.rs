//! Source of the kernels for the fields of a sweep.

use crate::error::SceneError;
use impact::{KernelChoice, Shared, Tables};
use lookup::{Table, TableError, TableFile, stated_hash};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Kernels that are ready.
#[derive(Debug, Clone)]
pub(crate) struct Kernels {
    pub(super) choice: KernelChoice,
    /// The table that is read while rows are computed, and its file.
    shared: Option<(Arc<Shared>, PathBuf)>,
    /// Identity of the kernels, as TOML.
    pub(super) identity: toml::Table,
}

impl Kernels {
    /// Kernels of a table, or computed ones if there is no table. With `or_computed` they are also computed if the
    /// estimated error of the table exceeds the tolerance of a row.
    pub(super) fn new(
        path: Option<&Path>,
        or_computed: bool,
        many: bool,
    ) -> Result<Self, TableError> {
        let mut kernels = Self {
            choice: KernelChoice::Direct,
            shared: None,
            identity: toml::Table::new(),
        };
        let mut says = |key: &str, word: &str| kernels.identity.insert(key.to_owned(), word.into());
        let Some(path) = path else {
            says("kernel", "direct");
            return Ok(kernels);
        };
        let file = TableFile::open(path)?;
        says("kernel", if or_computed { "auto" } else { "table" });
        says("table_id", file.id());
        says("table_sha256", &stated_hash(path)?);
        let tables: Arc<dyn Tables> = if many {
            Arc::new(Arc::new(Table::open(path)?))
        } else {
            let shared = Arc::new(Shared::new(Arc::new(file)));
            kernels.shared = Some((Arc::clone(&shared), path.to_owned()));
            shared
        };
        kernels.choice = match or_computed {
            true => KernelChoice::Within(tables),
            false => KernelChoice::Table(tables),
        };
        Ok(kernels)
    }

    /// Fails if the table could not be read while rows were computed.
    pub(super) fn check(&self) -> Result<(), SceneError> {
        let shared = self.shared.as_ref();
        let fault = shared.and_then(|(shared, path)| Some((path, shared.fault()?)));
        fault.map_or(Ok(()), |(path, reason)| {
            Err(SceneError::unreadable(path, reason))
        })
    }
}
