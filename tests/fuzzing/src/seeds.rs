//! Good inputs to start from.

use crate::stand_in::content;
use crate::target::{Target, of_sweep, sweep, without_seal};
use formats::sweep::{Selection, check_rows, stage_rows};
use formats::{parse_scene, write_results};
use impact::{KernelChoice, simulate};
use output::{Existing, Output};
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use tabulator::{Grid, Shard, Silent};

/// Good inputs of all targets, and the folder where scenes find what they name.
#[derive(Debug)]
pub struct Seeds {
    folder: PathBuf,
    of: Vec<Vec<Vec<u8>>>,
}

/// A grid whose shard takes no time.
const GRID: &str = "poisson_ratios = [0.3]\ncell_width = 1.0\npulse_lengths = [20.0]\nstencil_points = 2\n\
    [r]\nmax = 1.0\nspacing = 0.14\n[z]\nmax = 1.0\nspacing = 0.14\n";

impl Seeds {
    /// Those of `corpus`, a folder with one for each target, and those of the formats that are made here; `folder` takes
    /// the files.
    ///
    /// # Errors
    /// What the system or the program says.
    pub fn new(corpus: &Path, folder: &Path) -> Result<Self, Box<dyn Error>> {
        for name in ["pulse.csv", "materials.toml", "base.toml"] {
            fs::copy(corpus.join("named").join(name), folder.join(name))?;
        }
        let mut of = Vec::new();
        for target in Target::ALL {
            let mut inputs = texts(&corpus.join(target.name()))?;
            inputs.extend(made(target, folder)?);
            if inputs.is_empty() {
                return Err(format!("no seed of {}", target.name()).into());
            }
            of.push(inputs);
        }
        Ok(Self {
            folder: folder.to_owned(),
            of,
        })
    }

    /// Where files go.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Those of a target.
    #[must_use]
    pub fn of(&self, target: Target) -> &[Vec<u8>] {
        let index = Target::ALL.iter().position(|other| *other == target);
        index.map_or(&[], |index| &self.of[index])
    }
}

/// The files of a folder, by name; none where there is no folder.
fn texts(folder: &Path) -> Result<Vec<Vec<u8>>, Box<dyn Error>> {
    let Ok(entries) = fs::read_dir(folder) else {
        return Ok(Vec::new());
    };
    let mut paths: Vec<PathBuf> = entries
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<Result<_, _>>()?;
    paths.sort();
    let read = |path: &PathBuf| fs::read(path).map_err(Into::into);
    paths.iter().map(read).collect()
}

/// Seeds that are no text.
fn made(target: Target, folder: &Path) -> Result<Vec<Vec<u8>>, Box<dyn Error>> {
    match target {
        Target::Results => results(folder),
        Target::Journal => journal(folder),
        Target::Part => parts(folder),
        Target::Shard => shard(folder),
        Target::Table => tables(folder),
        Target::Sealed => Ok(tables(folder)?.into_iter().take(1).collect()),
        Target::Scene
        | Target::Impact
        | Target::Sweep
        | Target::Grid
        | Target::Materials
        | Target::Record
        | Target::Response => Ok(Vec::new()),
    }
}

/// The results of an impact, which are a force record.
fn results(folder: &Path) -> Result<Vec<Vec<u8>>, Box<dyn Error>> {
    let text = "[target]\nmaterial = \"steel\"\n[striker]\nmaterial = \"steel\"\nmass_kg = 0.004\n\
        tip_radius_m = 0.005\nvelocity_m_s = 1.0\n[contact]\ntolerance = 0.05\n";
    let scene = parse_scene(text, folder)?;
    let outcome = simulate(&scene, &KernelChoice::Direct)?;
    let path = folder.join("results.h5");
    write_results(&path, &scene, &outcome, Existing::Replace)?;
    Ok(vec![fs::read(path)?])
}

/// The journal of a sweep all rows of which are done.
fn journal(folder: &Path) -> Result<Vec<Vec<u8>>, Box<dyn Error>> {
    let path = folder.join("seed.part");
    let _ = fs::remove_file(&path);
    let _ = sweep(&path, folder, usize::MAX)?;
    Ok(vec![fs::read(path)?])
}

/// The rows of a sweep as parts: HDF5 and, where it is built in, Parquet.
fn parts(folder: &Path) -> Result<Vec<Vec<u8>>, Box<dyn Error>> {
    let journal = folder.join("seed.part");
    let _ = fs::remove_file(&journal);
    let done = sweep(&journal, folder, usize::MAX)?.ok_or("the sweep was stopped")?;
    let (mut spec, names) = (of_sweep(folder)?, ["part.h5", "part.parquet"]);
    let (rows, shard) = (0..spec.rows(), None);
    spec.selection = Some(Selection { rows, shard });
    let built = names.iter().map(|name| folder.join(name));
    built
        .filter(|path| check_rows(path).is_ok())
        .map(|path| {
            let output = Output::claim(&path, Existing::Replace)?;
            stage_rows(&output, &spec, &done)?.commit()?;
            Ok(fs::read(path)?)
        })
        .collect()
}

/// The first of two shards.
fn shard(folder: &Path) -> Result<Vec<Vec<u8>>, Box<dyn Error>> {
    let path = folder.join("seed.shard");
    let shard = Shard { index: 1, count: 2 };
    tabulator::build_shard(&Grid::parse(GRID)?, shard, &path, &Silent)?;
    Ok(vec![fs::read(path)?])
}

/// A sealed table, and the same without its seal as one of an older format.
fn tables(folder: &Path) -> Result<Vec<Vec<u8>>, Box<dyn Error>> {
    let path = folder.join("seed.h5");
    // a table is written where nothing is
    let _ = fs::remove_file(&path);
    lookup::write(&path, &content())?;
    let sealed = fs::read(&path)?;
    let mut older = without_seal(&sealed).to_vec();
    let version = lookup::schema::FORMAT_VERSION_VALUE.as_bytes();
    if let Some(at) = older.windows(3).position(|three| three == version) {
        older[at + 2] = b'1';
    }
    Ok(vec![sealed, older])
}
