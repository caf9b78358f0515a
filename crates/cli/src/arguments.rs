//! What several commands are told alike: where kernels come from, what happens to an existing output, and how much memory
//! may be taken.

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

/// Where the kernels of the fields come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum KernelOption {
    /// Computed for each probe, no table.
    Direct,
    /// Looked up in the table given with --table.
    Table,
    /// The table or computed: for one impact by the estimated cost and error of both, for rows of a sweep by the error alone.
    Auto,
}

#[derive(Debug, Args)]
pub(crate) struct KernelOptions {
    /// Kernel table for the fields at probes.
    #[arg(long, value_name = "FILE")]
    pub(crate) table: Option<PathBuf>,
    /// Where the kernels of the fields come from.
    #[arg(long, value_enum, default_value_t = KernelOption::Auto)]
    kernel: KernelOption,
}

impl KernelOptions {
    /// The table among the files that are read.
    pub(crate) fn input(&self) -> Option<Role> {
        Some(("the kernel table", self.table.clone()?))
    }

    /// The table, where kernels may be looked up.
    fn looked_up(&self) -> Result<Option<&Path>, Failure> {
        match (self.kernel, self.table.as_deref()) {
            (KernelOption::Table, None) => Err(Failure::input(NO_TABLE)),
            (KernelOption::Direct, _) => Ok(None),
            (_, table) => Ok(table),
        }
    }

    /// Of one impact.
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

    /// Whether a finished result may have computed kernels, and the id of the table whose kernels it may have.
    pub(crate) fn allowed(&self) -> Result<(bool, Option<String>), Failure> {
        let table = self.looked_up()?.map(open_table).transpose()?;
        let id = table.map(|table| table.id().to_owned());
        Ok((id.is_none() || self.kernel != KernelOption::Table, id))
    }

    /// A sweep with its fields, where its base scene has probes.
    pub(crate) fn with_fields(&self, spec: Spec) -> Result<Spec, Failure> {
        if !spec.has_probes() {
            return match (self.kernel, &self.table) {
                (KernelOption::Auto, None) => Ok(spec),
                _ => Err(Failure::input(
                    "--table and --kernel are for the fields at probes, and the base scene of the sweep has no [[probe]]",
                )),
            };
        }
        Ok(spec.with_fields(self.looked_up()?, self.kernel == KernelOption::Auto)?)
    }
}

const NO_TABLE: &str =
    "--kernel table needs a table: give --table FILE, made with hertzlamb tabulate";

/// The table at `path`.
pub(crate) fn open_table(path: &Path) -> Result<TableFile, Failure> {
    TableFile::open(path).map_err(Failure::input)
}

/// Replacing what is there: one flag, the same in every command.
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

    /// Claims the one output of a command that reads `inputs`, before any work.
    pub(crate) fn claim(self, path: &Path, inputs: &[Role]) -> Result<Output, Failure> {
        apart(&[path], inputs)?;
        Ok(Output::claim(path, self.existing())?)
    }
}

/// Whether a name is that of a file of rows that this program can write.
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

/// What is said of an output that was to be text.
pub(crate) const AS_TEXT: &str = "; --csv OUT.csv writes text";

/// Whether the name of an output is that of text.
pub(crate) fn is_text(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending == "csv")
}

/// Report of `--skip-complete` where nothing is left to do.
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

/// Prints that an output is there already.
pub(crate) fn say_complete(output: &Path, json: bool) -> Result<(), Failure> {
    let report = Complete {
        output: output.display().to_string(),
        complete: true,
    };
    show(json, &report)
}

/// One flag, the same in every command that can take much.
#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct MemoryLimit {
    /// Memory that the work may take in GB; what the machine has free otherwise.
    #[arg(long, value_name = "GB", value_parser = gigabytes)]
    max_memory: Option<f64>,
}

impl MemoryLimit {
    /// The limit in bytes.
    pub(crate) fn bytes(self) -> f64 {
        self.max_memory
            .map_or_else(output::free_memory, |gigabytes| 1e9 * gigabytes)
    }

    /// Refuses work that takes more.
    pub(crate) fn check(self, needed: f64, what: &str, change: &str) -> Result<(), Failure> {
        let limit = self.bytes();
        if needed <= limit {
            return Ok(());
        }
        let [needed, limit] = [needed, limit].map(|bytes| 1e-9 * bytes);
        Err(Failure::input(format!(
            "{what} needs about {needed:.3} GB of memory, more than the {limit:.3} GB allowed: {change}, or give --max-memory GB"
        )))
    }
}

fn gigabytes(text: &str) -> Result<f64, &'static str> {
    let number = text.parse().ok();
    let number = number.filter(|x: &f64| *x > 0.0 && x.is_finite());
    number.ok_or("it is outside (0, inf)")
}
