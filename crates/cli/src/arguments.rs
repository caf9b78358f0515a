//! Arguments that several commands share: source of the kernels, handling of existing outputs, and memory limit.

use crate::failure::{Failure, lines, show};
use clap::{Args, ValueEnum};
use formats::sweep::Spec;
use formats::{Existing, Output, OutputError};
use impact::KernelChoice;
use lookup::TableFile;
use output::{Role, apart};
use serde::Serialize;
use std::fmt::{self, Display, Formatter};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Source of the kernels of the fields.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum KernelOption {
    /// Compute the kernels for each probe, without a table.
    Direct,
    /// Look the kernels up in the table given with --table.
    Table,
    /// Choose between table and computation: for one impact by the estimated cost and error of both, for the rows of a sweep by the error alone.
    Auto,
}

#[derive(Debug, Args)]
pub(crate) struct KernelOptions {
    /// Kernel table for the fields at probes.
    #[arg(long, value_name = "FILE")]
    pub(crate) table: Option<PathBuf>,
    /// Source of the kernels of the fields.
    #[arg(long, value_enum, default_value_t = KernelOption::Auto)]
    kernel: KernelOption,
}

impl KernelOptions {
    /// The table, as one of the input files of the command.
    pub(crate) fn input(&self) -> Option<Role> {
        Some(("the kernel table", self.table.clone()?))
    }

    /// Path of the table, if kernels may be looked up.
    fn looked_up(&self) -> Result<Option<&Path>, Failure> {
        match (self.kernel, self.table.as_deref()) {
            (KernelOption::Table, None) => Err(Failure::input(NO_TABLE)),
            (KernelOption::Direct, _) => Ok(None),
            (_, table) => Ok(table),
        }
    }

    /// Choice of kernels for one impact.
    pub(crate) fn choice(&self) -> Result<KernelChoice, Failure> {
        let table = self.table.as_deref().map(open_table);
        let table = table.transpose()?.map(Arc::new);
        match (self.kernel, table) {
            (KernelOption::Table, None) => Err(Failure::input(NO_TABLE)),
            (KernelOption::Direct, _) | (KernelOption::Auto, None) => Ok(KernelChoice::Direct),
            (KernelOption::Table, Some(table)) => Ok(KernelChoice::Table(table)),
            (KernelOption::Auto, Some(table)) => Ok(KernelChoice::Auto(table)),
        }
    }

    /// Whether computed kernels are allowed in an existing result, and the id of the table that is allowed in it.
    pub(crate) fn allowed(&self) -> Result<(bool, Option<String>), Failure> {
        let table = self.looked_up()?.map(open_table).transpose()?;
        let id = table.map(|table| table.id().to_owned());
        Ok((id.is_none() || self.kernel != KernelOption::Table, id))
    }

    /// Adds the fields to a sweep whose base scene has probes.
    pub(crate) fn with_fields(&self, spec: Spec) -> Result<Spec, Failure> {
        if !spec.has_probes() {
            return match (self.kernel, &self.table) {
                (KernelOption::Auto, None) => Ok(spec),
                _ => Err(Failure::input(
                    "--table and --kernel apply only to fields at probes, but the base scene of the sweep has no [[probe]]: remove them or add a [[probe]]",
                )),
            };
        }
        Ok(spec.with_fields(self.looked_up()?, self.kernel == KernelOption::Auto)?)
    }
}

const NO_TABLE: &str =
    "--kernel table requires a table: pass --table FILE, made with hertzlamb tabulate";

/// Opens the kernel table at `path`.
pub(crate) fn open_table(path: &Path) -> Result<TableFile, Failure> {
    TableFile::open(path).map_err(Failure::input)
}

/// The flag --force, the same in every command.
#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct Overwrite {
    /// Replace existing outputs.
    #[arg(long)]
    pub(crate) force: bool,
}

impl Overwrite {
    pub(crate) fn existing(self) -> Existing {
        Existing::replaced(self.force)
    }

    /// Claims the only output of a command that reads `inputs`, before any work.
    pub(crate) fn claim(self, path: &Path, inputs: &[Role]) -> Result<Output, Failure> {
        apart(&[path], inputs)?;
        Ok(Output::claim(path, self.existing())?)
    }
}

/// Checks that the file extension names a format for rows that this program can write.
pub(crate) fn check_rows(path: &Path) -> Result<(), Failure> {
    const BUILD: &str =
        ": build it with `cargo build --release --package hertzlamb-cli --features parquet`";
    formats::sweep::check_rows(path).map_err(|error| {
        let unbuilt = matches!(error, OutputError::Unbuilt(..));
        Failure::from(error)
            .hint_if(unbuilt, BUILD)
            .hint_if(is_text(path), AS_TEXT)
    })
}

/// Hint for an output whose name asks for text.
pub(crate) const AS_TEXT: &str = "; --csv OUT.csv writes text";

/// Whether the file extension of an output is that of text.
pub(crate) fn is_text(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending == "csv")
}

/// Report of `--skip-complete` if nothing is left to do.
#[derive(Serialize)]
struct Complete {
    output: String,
    complete: bool,
}

impl Display for Complete {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let text = format!("{}, nothing to do", self.output);
        f.write_str(&lines([("complete", text)]))
    }
}

/// Prints that an output exists already and is complete.
pub(crate) fn say_complete(output: &Path, json: bool) -> Result<(), Failure> {
    let report = Complete {
        output: output.display().to_string(),
        complete: true,
    };
    show(json, &report)
}

/// The flag --max-memory, the same in every command that may need much memory.
#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct MemoryLimit {
    /// Memory limit in GB. Default: the free memory of the machine.
    #[arg(long, value_name = "GB", value_parser = gigabytes)]
    max_memory: Option<f64>,
}

impl MemoryLimit {
    /// The limit in bytes.
    pub(crate) fn bytes(self) -> f64 {
        self.max_memory
            .map_or_else(output::free_memory, |gigabytes| 1e9 * gigabytes)
    }

    /// Rejects work that needs more.
    pub(crate) fn check(self, needed: f64, what: &str, change: &str) -> Result<(), Failure> {
        let limit = self.bytes();
        if needed <= limit {
            return Ok(());
        }
        let [needed, limit] = [needed, limit].map(|bytes| 1e-9 * bytes);
        Err(Failure::input(format!(
            "{what} needs about {needed:.3} GB of memory, more than the {limit:.3} GB allowed: {change}, or pass --max-memory GB"
        )))
    }
}

fn gigabytes(text: &str) -> Result<f64, &'static str> {
    let number = text.parse().ok();
    let number = number.filter(|x: &f64| *x > 0.0 && x.is_finite());
    number.ok_or("it is outside (0, inf)")
}
