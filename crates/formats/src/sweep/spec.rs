//! Definition of a sweep: base scene, keys that vary, and selection of results.

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
    /// Folder of the files that the scene names.
    pub(super) directory: PathBuf,
    /// Axes: those of the product in alphabetical order, then the list, then the draws.
    pub axes: Vec<SweepAxis>,
    /// The sweep as TOML with everything spelled out.
    pub resolved: String,
    /// The files that were read in addition to the sweep file: base scene and materials.
    pub inputs: Vec<Role>,
    /// Materials by the name of their file, with its text: rows are computed from them even if the files change.
    libraries: Libraries,
    /// SHA-256, in hexadecimal, of the full definition, of all files that were read, and of the program's version and
    /// numbers: sweeps with the same hash have the same rows.
    pub sha256: String,
    /// Selection of the results that are written.
    pub fields: WrittenResults,
    /// Source of the kernels for fields at probes, if there are any.
    pub(crate) kernels: Option<Kernels>,
    /// Rows that are computed as a part; none for the whole sweep in its own shape.
    pub selection: Option<Selection>,
}

type Libraries = BTreeMap<String, (Library, String)>;

/// Largest number of rows of a sweep: an offset in a file of them is represented exactly.
const MOST_ROWS: usize = 1_000_000_000_000;

/// Memory in bytes of a run in addition to the values of the axes: a block and its columns, or a group of Parquet, and
/// its tables.
const RUN_BYTES: usize = 120_000_000;

/// Largest number of distinct Poisson's ratios of targets for which each has its own response and its own part of a
/// table.
const FEW_RATIOS: usize = 256;

impl Spec {
    /// Reads a sweep file; the path of its scene is relative to its folder.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn from_file(path: &Path) -> Result<Self, SceneError> {
        let text = read_text(path)?;
        let directory = path.parent().unwrap_or(Path::new("."));
        Self::from_toml(&text, directory).map_err(|error| error.in_file(path))
    }

    /// Reads a sweep from standard input; the path of its scene is relative to the current folder.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn from_standard_input() -> Result<Self, SceneError> {
        let read = || Self::from_toml(&read_standard()?, Path::new("."));
        read().map_err(|error| error.in_file(Path::new("standard input")))
    }

    /// Reads a sweep; the path of its scene is relative to `directory`.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn from_toml(text: &str, directory: &Path) -> Result<Self, SceneError> {
        Self::from_table(&parse(text)?, directory)
    }

    /// Reads a sweep from a parsed table; the path of its scene is relative to `directory`.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn from_table(table: &Table, directory: &Path) -> Result<Self, SceneError> {
        let root = TomlSection::root(table);
        if !table.contains_key("scene") && SECTIONS.iter().any(|name| table.contains_key(*name)) {
            let hint = "this is a scene; a sweep contains scene = \"FILE\", or the sections of a scene as in [scene.target], and lists the keys that vary in [product], [list] or [random]";
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

    /// A sweep of contacts only; `spelled` decides whether its text includes the values of its axes.
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

    /// The sweep stored in a file, with everything spelled out: axes and rows, without the data for computing them.
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

    /// The sweep of a scene in which some keys vary together, like those of a list.
    ///
    /// The values are not spelled out in [`Self::resolved`](Self#structfield.resolved): there may be millions.
    /// A value that is not finite makes its row fail.
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

    /// Approximate memory in bytes of a run, independent of the number of rows.
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

    /// The dimensions of the selected rows: the axes, or the only one of a part.
    pub fn shape(&self) -> Vec<usize> {
        match &self.selection {
            Some(selection) => vec![selection.rows.len()],
            None => self.axes.iter().map(|axis| axis.len).collect(),
        }
    }

    /// Selects the rows of a shard.
    pub fn select_shard(&mut self, shard: Shard) {
        let rows = shard.range(self.rows(), grain(&self.fields));
        let shard = Some(shard);
        self.selection = Some(Selection { rows, shard });
    }

    /// Selects the rows of a half-open range.
    ///
    /// # Errors
    /// [`SceneError`] if the range exceeds the sweep.
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

    /// The selected rows.
    pub fn selected(&self) -> Range<usize> {
        let selection = self.selection.as_ref();
        selection.map_or(0..self.rows(), |selection| selection.rows.clone())
    }

    /// The axes, each with the number of rows between consecutive values: the last varies fastest.
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

    /// Whether the base scene has probes, whose fields require [`Self::with_fields`].
    pub fn has_probes(&self) -> bool {
        self.scene.contains_key("probe")
    }

    /// Adds the peaks of the fields at the probes of the base scene, which become part of the identity of the sweep.
    ///
    /// The kernels are those of the table at `path`, or computed if there is none. With `or_computed` they are also
    /// computed if the estimated error of the table exceeds the tolerance of a row. Select the results after this call.
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

    /// Whether the targets have too many Poisson's ratios for each to have its own response.
    pub(super) fn has_many_ratios(&self) -> bool {
        let of_ratio = |column: &SweptKey| {
            column.section == "target"
                && (column.key == "poisson_ratio" || column.key.ends_with("_speed_m_s"))
        };
        let mut axes = self.axes.iter();
        axes.any(|axis| axis.len > FEW_RATIOS && axis.columns.iter().any(of_ratio))
    }
}

/// Default selection of results: plastic results only with a plasticity law.
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

/// Hash of the program's version, the revision of its numbers, the format, the resolved sweep, the files that were
/// read, and the values of axes that are not spelled out.
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

/// The axes in the sections of a sweep.
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

/// The base scene, from a file or inline, with the folder of its files and its own file.
fn base(
    root: &TomlSection<'_>,
    table: &Table,
    directory: &Path,
) -> Result<(Table, PathBuf, Option<Role>), SceneError> {
    if let Some(Value::Table(scene)) = table.get("scene") {
        return Ok((scene.clone(), directory.to_owned(), None));
    }
    let hint = "name a scene file, or add a section [scene]";
    let file = root.needed_text("scene", hint)?;
    let path = directory.join(file);
    let scene = parse(&read_text(&path)?).map_err(|error| error.in_file(&path))?;
    let directory = path.parent().unwrap_or(Path::new(".")).to_owned();
    Ok((scene, directory, Some(("the base scene", path))))
}

/// The scene keys below a section of the sweep with their values; at most `most` rows if each varies independently.
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
        let hint = "add at least one scene key, such as this one";
        return Err(section.missing("striker.velocity_m_s", hint));
    }
    Ok(found)
}

/// The axis of keys that vary together.
fn together(columns: Vec<SweptKey>) -> Result<SweepAxis, SceneError> {
    let Some(len) = columns.first().map(|column| column.values.count()) else {
        return Err(SceneError::missing(
            "a key that varies",
            "add at least one scene key with its values",
        ));
    };
    if let Some(other) = columns.iter().find(|c| c.values.count() != len) {
        return Err(SceneError::conflict(
            format!("list.{} of {len} values", columns[0].name()),
            format!("list.{} of {}", other.name(), other.values.count()),
            "the keys of a list vary together and need the same number of values",
        ));
    }
    let name = LIST.to_owned();
    Ok(SweepAxis { name, columns, len })
}

/// The axis of random draws.
fn drawn(random: &TomlSection<'_>) -> Result<SweepAxis, SceneError> {
    let len = random
        .count("samples", 1..=MOST_ROWS, "[1, 1e12]")?
        .ok_or_else(|| random.missing("samples", "the number of draws"))?;
    let draws = Drawn::read(random, len)?.into_iter();
    let columns = draws.map(|(section, key, drawn)| SweptKey {
        section,
        key,
        values: Values::Drawn(drawn),
    });
    let columns: Vec<SweptKey> = columns.collect();
    if columns.is_empty() {
        let hint = "add at least one scene key with a distribution";
        return Err(random.missing("striker.velocity_m_s", hint));
    }
    let name = SAMPLE.to_owned();
    Ok(SweepAxis { name, columns, len })
}

/// Checks that numbers of a product and of a list are in range; a draw out of range is a row that fails.
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

/// Checks that written numbers are finite; in arrays of a program others mark unknown values, whose rows fail.
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

/// Checks for duplicate keys, at least one axis, and the number of rows.
fn check(axes: &[SweepAxis]) -> Result<(), SceneError> {
    if axes.is_empty() {
        return Err(SceneError::missing(
            "[product], [list] or [random]",
            "list the keys that vary in one of these sections",
        ));
    }
    let mut names = BTreeSet::new();
    let mut columns = axes.iter().flat_map(|axis| &axis.columns);
    if let Some(twice) = columns.find(|column| !names.insert(column.name())) {
        let reason = "a key can vary along one axis only";
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
