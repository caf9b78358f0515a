//! What a sweep is: a base scene, the keys that vary, and what of the results is written.

use super::axes::{SweepAxis, SweptKey, Values, rows};
use super::draws::Drawn;
use super::error::SweepError;
use super::fields::{WrittenResults, columns_of_probes, stored_columns};
use super::kernels::Kernels;
use super::shard::{BLOCK, Selection, grain};
use crate::error::SceneError;
use crate::quantities::{Described, QUANTITIES};
use crate::scene::body::parse_materials;
use crate::scene::keys::{FINITE, SECTIONS, keys_of};
use crate::scene::section::{TomlSection, parse, read_standard, read_text};
use crate::schema::sweep::{FIELDS, FORMAT_VERSION, LIST, SAMPLE};
use contact::{Choice, Library, NUMBERS_REVISION, Plasticity};
use impact::numbers::FIELDS_REVISION;
use ledger::{Identity, Shard};
use output::Role;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::{Path, PathBuf};
use toml::{Table, Value};

/// A sweep: a base scene and the axes along which it varies.
#[derive(Debug, Clone, Default)]
pub struct Spec {
    /// The base scene.
    pub(crate) scene: Table,
    /// Where the files it names are.
    pub(super) directory: PathBuf,
    /// Axes: the product's in alphabetical order, then the list's, then that of the draws.
    pub axes: Vec<SweepAxis>,
    /// Everything spelled out, as TOML.
    pub resolved: String,
    /// The files that were read beside the sweep itself: its base scene and its materials.
    pub inputs: Vec<Role>,
    /// Materials by the name of their file, with its text: rows are computed from them, whatever becomes of the files.
    libraries: Libraries,
    /// SHA-256, in hexadecimal, of everything that is asked and was read and of the program's version and numbers: two sweeps
    /// with the same have the same rows.
    pub sha256: String,
    /// What of the results is written.
    pub fields: WrittenResults,
    /// Where the fields at probes have their kernels from, where they are asked for.
    pub(crate) kernels: Option<Kernels>,
    /// The rows that are asked for as a part, where they are not the whole sweep in its own shape.
    pub selection: Option<Selection>,
}

type Libraries = BTreeMap<String, (Library, String)>;

/// Rows of a sweep at most: a place in a file of them is counted exactly.
const MOST_ROWS: usize = 1_000_000_000_000;

/// Memory in bytes that a run takes beside the values of the axes: a block and the columns made of it, or a group of
/// Parquet, and its tables.
const RUN_BYTES: usize = 120_000_000;

/// Distinct Poisson's ratios of targets up to which each has its own response, and its own part of a table.
const FEW_RATIOS: usize = 256;

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

    /// Reads a sweep from standard input; the scene it names is looked for in the current folder.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn from_standard_input() -> Result<Self, SceneError> {
        let read = || Self::from_toml(&read_standard()?, Path::new("."));
        read().map_err(|error| error.in_file(Path::new("standard input")))
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
        let root = TomlSection::root(table);
        if !table.contains_key("scene") && SECTIONS.iter().any(|name| table.contains_key(*name)) {
            let hint = "this is a scene; a sweep names its file, scene = \"FILE\", or has its sections below it, as in [scene.target], and says in [product], [list] or [random] which keys vary";
            return Err(root.missing("scene", hint));
        }
        root.allow(["scene", "product", "list", "random"])?;
        let (scene, directory, file) = base(&root, table, directory)?;
        let axes = axes(&root)?;
        in_range(&axes)?;
        let mut resolved = table.clone();
        resolved.insert("scene".into(), Value::Table(scene.clone()));
        let mut spec = Self::new(scene, &directory, axes, resolved.to_string(), true)?;
        spec.inputs.extend(file);
        Ok(spec)
    }

    /// One of a contact alone; whether its text spells out the values of its axes.
    fn new(
        scene: Table,
        directory: &Path,
        axes: Vec<SweepAxis>,
        resolved: String,
        is_spelled: bool,
    ) -> Result<Self, SceneError> {
        let (mut inputs, mut libraries) = (Vec::new(), Libraries::new());
        for name in material_files(&scene, &axes) {
            let path = directory.join(name);
            let text = read_text(&path)?;
            let own = parse_materials(&text).map_err(|error| error.in_file(&path))?;
            let library = Library::built_in().clone().extended(&own);
            libraries.insert(name.to_owned(), (library, text));
            inputs.push(("a materials file", path));
        }
        let unspelled = if is_spelled { &[] } else { &axes[..] };
        Ok(Self {
            sha256: identity(&resolved, &libraries, unspelled),
            fields: own_fields(&scene, &axes, Vec::new()),
            directory: directory.to_owned(),
            scene,
            axes,
            resolved,
            inputs,
            libraries,
            kernels: None,
            selection: None,
        })
    }

    /// The sweep that a file holds, with everything spelled out: its axes and rows, not what computes them.
    pub(crate) fn of_stored(resolved: &str, sha256: String) -> Result<Self, SceneError> {
        let table = parse(resolved)?;
        let axes = axes(&TomlSection::root(&table))?;
        let probed = stored_columns(&table)?;
        Ok(Self {
            axes,
            resolved: resolved.to_owned(),
            sha256,
            fields: WrittenResults::all(probed),
            ..Self::default()
        })
    }

    /// The sweep of a scene some keys of which take values together, as those of a list do.
    ///
    /// The values are not spelled out in [`Self::resolved`](Self#structfield.resolved): they may be millions.
    /// One that is not finite is a row that fails.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn of_columns(
        scene: &Table,
        directory: &Path,
        columns: Vec<SweptKey>,
    ) -> Result<Self, SceneError> {
        let axes = vec![together(columns)?];
        check(&axes)?;
        Self::new(scene.clone(), directory, axes, scene.to_string(), false)
    }

    /// The materials of a scene.
    pub(super) fn library(&self, scene: &Table) -> &Library {
        let own = word(scene, "materials", "file").and_then(|name| self.libraries.get(name));
        own.map_or(Library::built_in(), |(library, _)| library)
    }

    /// Memory in bytes that a run takes, about: it does not depend on the number of rows.
    pub fn memory_bytes(&self) -> f64 {
        let values: usize = (self.columns().map(|column| &column.values))
            .filter(|values| !matches!(values, Values::Drawn(_)))
            .map(Values::count)
            .sum();
        let probed = 2 * BLOCK * (self.fields.width() - QUANTITIES.len());
        (RUN_BYTES + (values + probed) * 8) as f64
    }

    /// Number of scenes.
    pub fn rows(&self) -> usize {
        rows(&self.axes).unwrap_or(0)
    }

    /// The dimensions of what is asked for: the axes, or the one of a part.
    pub fn shape(&self) -> Vec<usize> {
        match &self.selection {
            Some(selection) => vec![selection.rows.len()],
            None => self.axes.iter().map(|axis| axis.len).collect(),
        }
    }

    /// Asks for the rows of a shard alone.
    pub fn select_shard(&mut self, shard: Shard) {
        let rows = shard.range(self.rows(), grain(&self.fields));
        let shard = Some(shard);
        self.selection = Some(Selection { rows, shard });
    }

    /// Asks for rows from one on up to another alone, which is not among them.
    ///
    /// # Errors
    /// [`SceneError`] beyond the end.
    pub fn select_rows(&mut self, rows: Range<usize>) -> Result<(), SceneError> {
        if rows.end > self.rows() {
            return Err(SceneError::out_of_range(
                "the end of the rows",
                rows.end as f64,
                &format!("[0, {}], the rows of the sweep", self.rows()),
            ));
        }
        self.selection = Some(Selection { rows, shard: None });
        Ok(())
    }

    /// The rows that are asked for.
    pub fn selected(&self) -> Range<usize> {
        let selection = self.selection.as_ref();
        selection.map_or(0..self.rows(), |selection| selection.rows.clone())
    }

    /// The axes, each with the rows from one of its values to the next: the last runs fastest.
    pub(super) fn strides(&self) -> impl Iterator<Item = (usize, &SweepAxis)> {
        let mut stride = self.rows().max(1);
        self.axes.iter().map(move |axis| {
            stride /= axis.len.max(1);
            (stride, axis)
        })
    }

    /// The keys that vary.
    pub(super) fn columns(&self) -> impl Iterator<Item = &SweptKey> {
        self.axes.iter().flat_map(|axis| &axis.columns)
    }

    /// Whether its base scene has probes, whose fields need [`Self::with_fields`].
    pub fn has_probes(&self) -> bool {
        self.scene.contains_key("probe")
    }

    /// With the peaks of the fields at the probes of its base scene, which are then part of what makes two sweeps the same.
    ///
    /// Their kernels are those of the table at `path` or, where there is none, computed; with `or_computed` also where the
    /// estimated error of the table is beyond the tolerance of a row.
    /// Which results are written is chosen after it.
    ///
    /// # Errors
    /// [`SweepError`].
    pub fn with_fields(
        mut self,
        path: Option<&Path>,
        or_computed: bool,
    ) -> Result<Self, SweepError> {
        let kernels = Kernels::new(path, or_computed, self.has_many_ratios())?;
        self.fields = own_fields(&self.scene, &self.axes, columns_of_probes(&self.scene)?);
        let mut table = parse(&self.resolved)?;
        table.insert(FIELDS.into(), Value::Table(kernels.identity.clone()));
        self.resolved = table.to_string();
        self.sha256 = Identity::default()
            .with("sweep", self.sha256)
            .with("numbers of fields", FIELDS_REVISION.to_le_bytes())
            .with("kernels", kernels.identity.to_string())
            .hex();
        self.kernels = Some(kernels);
        Ok(self)
    }

    /// Whether the targets have more Poisson's ratios than have responses of their own each.
    pub(super) fn has_many_ratios(&self) -> bool {
        let of_ratio = |column: &SweptKey| {
            column.section == "target"
                && (column.key == "poisson_ratio" || column.key.ends_with("_speed_m_s"))
        };
        let mut axes = self.axes.iter();
        axes.any(|axis| axis.len > FEW_RATIOS && axis.columns.iter().any(of_ratio))
    }
}

/// What is written unless columns are chosen: what flow brings only where a law of flow is asked for.
fn own_fields(scene: &Table, axes: &[SweepAxis], probed: Vec<Described>) -> WrittenResults {
    let law = word(scene, "contact", "plasticity");
    let mut columns = axes.iter().flat_map(|axis| &axis.columns);
    let yields = law.is_some_and(|law| law != Plasticity::None.name())
        || columns.any(|column| column.name() == "contact.plasticity");
    let mut fields = WrittenResults::all(probed);
    let elastic = |name: &str| !QUANTITIES.iter().any(|q| q.is_of_flow && q.name == name);
    fields.retain(|name| yields || elastic(name));
    fields
}

/// Of the program's version, the revision of its numbers, the format, everything spelled out, the files that were read, and
/// axes whose values are not spelled out.
fn identity(resolved: &str, libraries: &Libraries, axes: &[SweepAxis]) -> String {
    let mut identity = Identity::default()
        .with("software", env!("CARGO_PKG_VERSION"))
        .with("numbers", NUMBERS_REVISION.to_le_bytes())
        .with("format", FORMAT_VERSION)
        .with("sweep", resolved);
    for (_, text) in libraries.values() {
        identity = identity.with("materials", text);
    }
    for column in axes.iter().flat_map(|axis| &axis.columns) {
        let values = match &column.values {
            Values::Numbers(numbers) => numbers.iter().flat_map(|x| x.to_le_bytes()).collect(),
            // the distribution is spelled out
            Values::Drawn(_) => Vec::new(),
            Values::Texts(words) => words.join("\n").into_bytes(),
        };
        identity = identity.with(&column.name(), values);
    }
    identity.hex()
}

/// The materials files of a base scene, and those that vary.
fn material_files<'a>(scene: &'a Table, axes: &'a [SweepAxis]) -> BTreeSet<&'a str> {
    let columns = axes.iter().flat_map(|axis| &axis.columns);
    let varied = columns.filter(|column| column.name() == "materials.file");
    let varied = varied.filter_map(|column| column.values.texts()).flatten();
    let named = word(scene, "materials", "file").into_iter();
    named.chain(varied.map(String::as_str)).collect()
}

/// The word of a key in a scene.
pub(super) fn word<'a>(scene: &'a Table, section: &str, key: &str) -> Option<&'a str> {
    scene.get(section)?.get(key)?.as_str()
}

/// The axes that the sections of a sweep say.
fn axes(root: &TomlSection<'_>) -> Result<Vec<SweepAxis>, SceneError> {
    let mut axes = Vec::new();
    if let Some(product) = root.section("product")? {
        for column in columns(&product, MOST_ROWS as f64)? {
            axes.push(SweepAxis {
                name: column.name(),
                len: column.values.count(),
                columns: vec![column],
            });
        }
    }
    if let Some(list) = root.section("list")? {
        axes.push(together(columns(&list, f64::INFINITY)?)?);
    }
    if let Some(random) = root.section("random")? {
        axes.push(drawn(&random)?);
    }
    finite(&axes)?;
    check(&axes)?;
    Ok(axes)
}

/// The base scene, from a file or in place, where its own files are, and the file.
fn base(
    root: &TomlSection<'_>,
    table: &Table,
    directory: &Path,
) -> Result<(Table, PathBuf, Option<Role>), SceneError> {
    if let Some(Value::Table(scene)) = table.get("scene") {
        return Ok((scene.clone(), directory.to_owned(), None));
    }
    let hint = "name a scene file, or give a section [scene]";
    let file = root.needed_text("scene", hint)?;
    let path = directory.join(file);
    let scene = parse(&read_text(&path)?).map_err(|error| error.in_file(&path))?;
    let directory = path.parent().unwrap_or(Path::new(".")).to_owned();
    Ok((scene, directory, Some(("the base scene", path))))
}

/// The scene keys below a section of the sweep, with their values, so many rows at most where each varies by itself.
fn columns(section: &TomlSection<'_>, most: f64) -> Result<Vec<SweptKey>, SceneError> {
    let (mut found, mut rows) = (Vec::new(), 1.0);
    for keys in section.subsections(&[])? {
        for key in keys.names() {
            let values = Values::read(&keys, key)?;
            rows *= values.count() as f64;
            if rows > most {
                return Err(too_many(rows));
            }
            found.push(SweptKey {
                section: keys.name.to_owned(),
                key: key.to_owned(),
                values,
            });
        }
    }
    if found.is_empty() {
        let hint = "give at least one scene key, such as this one";
        return Err(section.missing("striker.velocity_m_s", hint));
    }
    Ok(found)
}

/// The axis of keys that vary together.
fn together(columns: Vec<SweptKey>) -> Result<SweepAxis, SceneError> {
    let Some(len) = columns.first().map(|column| column.values.count()) else {
        return Err(SceneError::missing(
            "a key that varies",
            "give at least one scene key with its values",
        ));
    };
    if let Some(other) = columns.iter().find(|c| c.values.count() != len) {
        return Err(SceneError::conflict(
            format!("list.{} of {len} values", columns[0].name()),
            format!("list.{} of {}", other.name(), other.values.count()),
            "the keys of a list vary together and need as many values each",
        ));
    }
    let name = LIST.to_owned();
    Ok(SweepAxis { name, columns, len })
}

/// The axis of random draws.
fn drawn(random: &TomlSection<'_>) -> Result<SweepAxis, SceneError> {
    let len = random
        .count("samples", 1..=MOST_ROWS, "[1, 1e12]")?
        .ok_or_else(|| random.missing("samples", "how many draws"))?;
    let draws = Drawn::read(random, len)?.into_iter();
    let columns = draws.map(|(section, key, drawn)| SweptKey {
        section,
        key,
        values: Values::Drawn(drawn),
    });
    let columns: Vec<SweptKey> = columns.collect();
    if columns.is_empty() {
        let hint = "give at least one scene key with a distribution";
        return Err(random.missing("striker.velocity_m_s", hint));
    }
    let name = SAMPLE.to_owned();
    Ok(SweepAxis { name, columns, len })
}

/// Numbers of a product and of a list are in the ranges of their keys; a draw outside is a row that fails.
fn in_range(axes: &[SweepAxis]) -> Result<(), SceneError> {
    for column in axes.iter().flat_map(|axis| &axis.columns) {
        let known = keys_of(&column.section).find(|key| key.name == column.key);
        if let (Some(range), Values::Numbers(numbers)) =
            (known.and_then(|key| key.range), &column.values)
            && let Some(&value) = numbers.iter().find(|x| !(range.holds)(**x))
        {
            return Err(SceneError::out_of_range(column.name(), value, range.name));
        }
    }
    Ok(())
}

/// What is written down is numbers; in arrays of a program others stand for what is not known, and their rows fail.
fn finite(axes: &[SweepAxis]) -> Result<(), SceneError> {
    for column in axes.iter().flat_map(|axis| &axis.columns) {
        let infinite = match &column.values {
            Values::Numbers(numbers) => numbers.iter().copied().find(|x| !x.is_finite()),
            Values::Texts(_) => None,
            Values::Drawn(drawn) => drawn.infinite(),
        };
        if let Some(value) = infinite {
            return Err(SceneError::out_of_range(column.name(), value, FINITE.name));
        }
    }
    Ok(())
}

/// No key twice, at least one axis, not too many rows.
fn check(axes: &[SweepAxis]) -> Result<(), SceneError> {
    if axes.is_empty() {
        return Err(SceneError::missing(
            "[product], [list] or [random]",
            "say in one of these sections which keys vary",
        ));
    }
    let mut names = BTreeSet::new();
    let mut columns = axes.iter().flat_map(|axis| &axis.columns);
    if let Some(twice) = columns.find(|column| !names.insert(column.name())) {
        let reason = "a key varies along one axis only";
        return Err(SceneError::conflict(twice.name(), twice.name(), reason));
    }
    match rows(axes) {
        Some(rows) if rows <= MOST_ROWS => Ok(()),
        rows => Err(too_many(rows.map_or(f64::INFINITY, |rows| rows as f64))),
    }
}

fn too_many(rows: f64) -> SceneError {
    SceneError::out_of_range("the number of rows", rows, "[1, 1e12]")
}
