//! The sweep file.

use super::axis::{Axis, Column, Values, rows};
use super::correlation::Correlations;
use super::drawn::Drawn;
use super::fields::Fields;
use super::files::Files;
use super::fingerprint::{fingerprint, hexadecimal};
use super::kernels::Kernels;
use super::probed::stored_columns;
use super::random::Distribution;
use super::schema::{LIST, SAMPLE};
use super::shard::BLOCK;
use crate::error::SceneError;
use crate::section::{FINITE, POSITIVE, Section, parse};
use crate::text::read_text;
use contact::Choice;
use output::Role;
use std::path::{Path, PathBuf};
use toml::{Table, Value};

/// A sweep: a base scene and the axes along which it varies.
#[derive(Debug, Clone, PartialEq)]
pub struct Spec {
    /// The base scene.
    pub(crate) scene: Table,
    /// Where the files it names are.
    pub(crate) directory: PathBuf,
    /// Axes: the product's in alphabetical order, then the list's, then that of the draws.
    pub axes: Vec<Axis>,
    /// Everything spelled out, as TOML.
    pub(crate) resolved: String,
    /// What was read beside it.
    pub(crate) files: Files,
    /// What makes two sweeps the same: SHA-256 of everything that is asked and was read, and of the program's version and numbers.
    pub(crate) fingerprint: [u8; 32],
    /// What of the results is written.
    pub fields: Fields,
    /// Where the fields at probes have their kernels from, where they are asked for.
    pub(crate) kernels: Option<Kernels>,
}

/// Rows of a sweep at most: a place in a file of them is counted exactly.
const MOST_ROWS: usize = 1_000_000_000_000;

/// Values of an axis at most, but for draws: they are held in memory.
const MOST_VALUES: usize = 10_000_000;

/// Memory in bytes that a run takes beside the values of the axes: a block and the columns made of it, or a group of
/// Parquet, and its tables.
const RUN_BYTES: usize = 120_000_000;

impl Spec {
    /// Reads a sweep file; the scene it names is looked for beside it.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn from_file(path: &Path) -> Result<Self, SceneError> {
        let text = read_text(path)?;
        let directory = path.parent().unwrap_or(Path::new("."));
        Self::from_toml(&text, directory).map_err(|error| error.in_file(path))
    }

    /// Reads a sweep; the scene it names is looked for in `directory`.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn from_toml(text: &str, directory: &Path) -> Result<Self, SceneError> {
        Self::from_table(&parse(text)?, directory)
    }

    /// Reads a sweep from a parsed table; the scene it names is looked for in `directory`.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn from_table(table: &Table, directory: &Path) -> Result<Self, SceneError> {
        let root = Section::root(table);
        root.allow(&["scene", "product", "list", "random"])?;
        let (scene, directory, file) = base(&root, table, directory)?;
        let axes = axes(&root)?;
        let mut files = Files::read(&scene, &axes, &directory)?;
        files.inputs.extend(file);
        let mut resolved = table.clone();
        resolved.insert("scene".into(), Value::Table(scene.clone()));
        let resolved = resolved.to_string();
        Ok(Self {
            fingerprint: fingerprint(&resolved, &files.texts, &[]),
            scene,
            directory,
            axes,
            resolved,
            files,
            fields: Fields::default(),
            kernels: None,
        })
    }

    /// The sweep that a file holds, with everything spelled out: its axes and rows, not what computes them.
    pub(crate) fn of_stored(resolved: &str, fingerprint: [u8; 32]) -> Result<Self, SceneError> {
        let table = parse(resolved)?;
        let axes = axes(&Section::root(&table))?;
        let probed = stored_columns(&table)?;
        Ok(Self {
            scene: Table::new(),
            directory: PathBuf::new(),
            axes,
            resolved: resolved.to_owned(),
            files: Files::default(),
            fingerprint,
            fields: Fields::all(probed),
            kernels: None,
        })
    }

    /// The sweep of a scene some keys of which take values together, as those of a list do.
    ///
    /// The values are not spelled out in [`Self::resolved`]: they may be millions.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn of_columns(
        scene: &Table,
        directory: &Path,
        columns: Vec<Column>,
    ) -> Result<Self, SceneError> {
        let axes = vec![together(columns)?];
        check(&axes)?;
        let files = Files::read(scene, &axes, directory)?;
        let resolved = scene.to_string();
        Ok(Self {
            fingerprint: fingerprint(&resolved, &files.texts, &axes),
            resolved,
            scene: scene.clone(),
            directory: directory.to_owned(),
            axes,
            files,
            fields: Fields::default(),
            kernels: None,
        })
    }

    /// [`Self::of_columns`] of a scene in a text.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn of_columns_in_text(
        text: &str,
        directory: &Path,
        columns: Vec<Column>,
    ) -> Result<Self, SceneError> {
        Self::of_columns(&parse(text)?, directory, columns)
    }

    /// [`Self::of_columns`] of a scene in a file.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn of_columns_in_file(path: &Path, columns: Vec<Column>) -> Result<Self, SceneError> {
        let text = read_text(path)?;
        let directory = path.parent().unwrap_or(Path::new("."));
        let spec = Self::of_columns_in_text(&text, directory, columns);
        spec.map_err(|error| error.in_file(path))
    }

    /// Everything spelled out, as TOML.
    #[must_use]
    pub fn resolved(&self) -> &str {
        &self.resolved
    }

    /// The files that were read beside the sweep itself: its base scene and its materials.
    #[must_use]
    pub fn inputs(&self) -> &[Role] {
        &self.files.inputs
    }

    /// SHA-256, in hexadecimal, of everything that is asked and was read and of the program's version and numbers: two sweeps with
    /// the same have the same rows.
    #[must_use]
    pub fn sha256(&self) -> String {
        hexadecimal(&self.fingerprint)
    }

    /// Memory in bytes that a run takes, about: it does not depend on the number of rows.
    #[must_use]
    pub fn memory_bytes(&self) -> f64 {
        let columns = self.axes.iter().flat_map(|axis| &axis.columns);
        let values: usize = (columns.map(|column| &column.values))
            .filter(|values| !matches!(values, Values::Drawn(_)))
            .map(Values::len)
            .sum();
        let probed = 2 * BLOCK * self.fields.probed.len();
        (RUN_BYTES + (values + probed) * 8) as f64
    }

    /// Number of scenes.
    #[must_use]
    pub fn rows(&self) -> usize {
        rows(&self.axes).unwrap_or(0)
    }
}

/// The axes that the sections of a sweep say.
fn axes(root: &Section<'_>) -> Result<Vec<Axis>, SceneError> {
    let mut axes = Vec::new();
    if let Some(product) = root.section("product")? {
        for column in columns(&product, &[])? {
            axes.push(Axis {
                name: column.name(),
                len: column.values.len(),
                columns: vec![column],
            });
        }
    }
    if let Some(list) = root.section("list")? {
        axes.push(together(columns(&list, &[])?)?);
    }
    if let Some(random) = root.section("random")? {
        axes.push(drawn(&random)?);
    }
    check(&axes)?;
    Ok(axes)
}

/// The base scene, from a file or in place, where its own files are, and the file.
fn base(
    root: &Section<'_>,
    table: &Table,
    directory: &Path,
) -> Result<(Table, PathBuf, Option<Role>), SceneError> {
    if let Some(Value::Table(scene)) = table.get("scene") {
        return Ok((scene.clone(), directory.to_owned(), None));
    }
    let file = root
        .text("scene")?
        .ok_or_else(|| root.missing("scene", "name a scene file, or give a section [scene]"))?;
    let path = directory.join(file);
    let scene = parse(&read_text(&path)?).map_err(|error| error.in_file(&path))?;
    let directory = path.parent().unwrap_or(Path::new(".")).to_owned();
    let role = Role::new("the base scene", &path);
    Ok((scene, directory, Some(role)))
}

/// The scene keys below a section of the sweep, with their values.
fn columns(section: &Section<'_>, other: &[&str]) -> Result<Vec<Column>, SceneError> {
    let mut found = Vec::new();
    for (name, keys) in section.subsections(other)? {
        for key in keys.names() {
            found.push(Column {
                section: name.clone(),
                key: key.to_owned(),
                values: values(&keys, key)?,
            });
        }
    }
    if found.is_empty() {
        return Err(section.missing(
            "striker.velocity_m_s",
            "give at least one scene key, such as this one",
        ));
    }
    Ok(found)
}

/// Values of a key: a list, or from, to, count and spacing.
fn values(section: &Section<'_>, key: &str) -> Result<Values, SceneError> {
    if let Some(range) = section.inner(key) {
        return spaced(&range).map(Values::Numbers);
    }
    Values::read(section, key)
}

/// How values lie between two ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Spacing {
    Linear,
    Log,
}

impl Choice for Spacing {
    const ALL: &'static [Self] = &[Self::Linear, Self::Log];

    fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Log => "log",
        }
    }
}

fn spaced(range: &Section<'_>) -> Result<Vec<f64>, SceneError> {
    range.allow(&["from", "to", "count", "spacing"])?;
    let spacing = range.choice("spacing")?.unwrap_or(Spacing::Linear);
    let allowed = match spacing {
        Spacing::Linear => FINITE,
        Spacing::Log => POSITIVE,
    };
    let from = range.required("from", allowed, "the first value")?;
    let to = range.required("to", allowed, "the last value")?;
    let count = range
        .count("count", 2, MOST_VALUES, "[2, 10000000]")?
        .ok_or_else(|| range.missing("count", "how many values"))?;
    let last = (count - 1) as f64;
    Ok((0..count)
        .map(|i| {
            let fraction = i as f64 / last;
            if i + 1 == count {
                return to;
            }
            match spacing {
                Spacing::Linear => from + fraction * (to - from),
                Spacing::Log => from * (to / from).powf(fraction),
            }
        })
        .collect())
}

/// The axis of keys that vary together.
fn together(columns: Vec<Column>) -> Result<Axis, SceneError> {
    let len = columns[0].values.len();
    if let Some(other) = columns.iter().find(|c| c.values.len() != len) {
        return Err(SceneError::Conflict {
            first: format!("list.{} of {len} values", columns[0].name()),
            second: format!("list.{} of {}", other.name(), other.values.len()),
            reason: "the keys of a list vary together and need as many values each",
        });
    }
    Ok(Axis {
        name: LIST.to_owned(),
        columns,
        len,
    })
}

/// The axis of random draws.
fn drawn(random: &Section<'_>) -> Result<Axis, SceneError> {
    let samples = random
        .count("samples", 1, MOST_ROWS, "[1, 1e12]")?
        .ok_or_else(|| random.missing("samples", "how many draws"))?;
    let seed = random
        .count("seed", 0, usize::MAX, "[0, 2^63)")?
        .unwrap_or(0) as u64;
    let (mut places, mut drawn) = (Vec::new(), Vec::new());
    for (name, keys) in random.subsections(&["samples", "seed", "correlation"])? {
        for key in keys.names() {
            let inner = keys.inner(key).ok_or_else(|| SceneError::Missing {
                key: format!("{}.distribution", keys.key(key)),
                hint: "a random key is a table such as { distribution = \"normal\", mean = 1.0, deviation = 0.1 }".to_owned(),
            })?;
            drawn.push((format!("{name}.{key}"), Distribution::read(&inner)?));
            places.push((name.clone(), key.to_owned()));
        }
    }
    let names: Vec<String> = drawn.iter().map(|(name, _)| name.clone()).collect();
    let correlations = Correlations::read(random, &names)?;
    let draws = Drawn::of(seed, samples, &drawn, correlations);
    let columns: Vec<Column> = (places.into_iter().zip(draws))
        .map(|((section, key), drawn)| Column {
            section,
            key,
            values: Values::Drawn(drawn),
        })
        .collect();
    if columns.is_empty() {
        return Err(random.missing(
            "striker.velocity_m_s",
            "give at least one scene key with a distribution",
        ));
    }
    Ok(Axis {
        name: SAMPLE.to_owned(),
        columns,
        len: samples,
    })
}

/// No key twice, at least one axis, not too many rows, numbers alone.
fn check(axes: &[Axis]) -> Result<(), SceneError> {
    for column in axes.iter().flat_map(|axis| &axis.columns) {
        let infinite = match &column.values {
            Values::Numbers(numbers) => numbers.iter().copied().find(|x| !x.is_finite()),
            Values::Texts(_) => None,
            Values::Drawn(drawn) => drawn.infinite(),
        };
        if let Some(value) = infinite {
            return Err(SceneError::OutOfRange {
                key: column.name(),
                value,
                range: FINITE.name,
            });
        }
    }
    if axes.is_empty() {
        return Err(SceneError::Missing {
            key: "[product], [list] or [random]".to_owned(),
            hint: "say in one of these sections which keys vary".to_owned(),
        });
    }
    let names: Vec<String> = axes
        .iter()
        .flat_map(|axis| axis.columns.iter().map(Column::name))
        .collect();
    for (i, name) in names.iter().enumerate() {
        if names[..i].contains(name) {
            return Err(SceneError::Conflict {
                first: name.clone(),
                second: name.clone(),
                reason: "a key varies along one axis only",
            });
        }
    }
    match rows(axes) {
        Some(rows) if rows <= MOST_ROWS => Ok(()),
        rows => Err(SceneError::OutOfRange {
            key: "the number of rows".to_owned(),
            value: rows.map_or(f64::INFINITY, |n| n as f64),
            range: "[1, 1e12]",
        }),
    }
}
