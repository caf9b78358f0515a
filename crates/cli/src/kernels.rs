//! Where the kernels of fields come from: the arguments of every command that computes fields.

use crate::failure::Failure;
use clap::{Args, ValueEnum};
use formats::sweep::{FieldKernels, Spec};
use impact::KernelChoice;
use lookup::TableFile;
use output::Role;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Where the kernels of the fields come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Kernel {
    /// Computed for each probe, no table.
    Direct,
    /// Looked up in the table given with --table.
    Table,
    /// The table or computed: for one impact by the estimated cost and error of both, for rows of a sweep by the error alone.
    Auto,
}

#[derive(Debug, Args)]
pub(crate) struct Kernels {
    /// Kernel table for the fields at probes.
    #[arg(long, value_name = "FILE")]
    pub(crate) table: Option<PathBuf>,
    /// Where the kernels of the fields come from.
    #[arg(long, value_enum, default_value_t = Kernel::Auto)]
    kernel: Kernel,
}

impl Kernels {
    /// The table among the files that are read.
    pub(crate) fn inputs(&self) -> impl Iterator<Item = Role> {
        let table = self.table.iter();
        table.map(|table| Role::new("the kernel table", table))
    }

    /// Of one impact.
    pub(crate) fn choice(&self) -> Result<KernelChoice, Failure> {
        let table = match &self.table {
            Some(path) => Some(Arc::new(open_table(path)?)),
            None => None,
        };
        match (self.kernel, table) {
            (Kernel::Table, None) => Err(no_table()),
            (Kernel::Direct, _) | (Kernel::Auto, None) => Ok(KernelChoice::Direct),
            (Kernel::Table, Some(table)) => Ok(KernelChoice::Table(table)),
            (Kernel::Auto, Some(table)) => Ok(KernelChoice::Auto(table)),
        }
    }

    /// Which kernels a finished result may have.
    pub(crate) fn allowed(&self) -> Result<Option<(Kernel, String)>, Failure> {
        match &self.table {
            Some(path) if self.kernel != Kernel::Direct => {
                let table = open_table(path)?;
                Ok(Some((self.kernel, table.id().to_owned())))
            }
            Some(_) | None => Ok(None),
        }
    }

    /// A sweep with its fields, where its base scene has probes.
    pub(crate) fn with_fields(&self, spec: Spec) -> Result<Spec, Failure> {
        if !spec.has_probes() {
            return match (self.kernel, &self.table) {
                (Kernel::Auto, None) => Ok(spec),
                (_, _) => Err(Failure::input(
                    "--table and --kernel are for the fields at probes, and the base scene of the sweep has no [[probe]]",
                )),
            };
        }
        let kernels = match (self.kernel, self.table.as_deref()) {
            (Kernel::Table, None) => return Err(no_table()),
            (Kernel::Direct, _) | (Kernel::Auto, None) => FieldKernels::Direct,
            (Kernel::Table, Some(path)) => FieldKernels::Table(path),
            (Kernel::Auto, Some(path)) => FieldKernels::Within(path),
        };
        Ok(spec.with_fields(kernels)?)
    }
}

fn no_table() -> Failure {
    Failure::input("--kernel table needs a table: give --table FILE, made with hertzlamb tabulate")
}

/// The table at `path`.
pub(crate) fn open_table(path: &Path) -> Result<TableFile, Failure> {
    TableFile::open(path).map_err(Failure::input)
}
