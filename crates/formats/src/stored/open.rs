//! Kind of a file, opening, and reading with size limits.

use crate::error::SceneError;
use crate::quantities::Described;
use crate::scene::section::parse;
use crate::schema::sweep::{TEXTS, part};
use crate::schema::{results, sweep};
use crate::sweep::{Footer, MAGIC, Part, Precision, WrittenResults, stored_columns};
use ledger::{Dataset, Group, H5Type, HdfError, HdfFile};
use std::fmt;
use std::io::{self, Read};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Largest number of bytes that are read from a dataset at once.
const MOST_BYTES_AT_ONCE: u64 = 1 << 29;

/// Major version of the files that can be read.
const MAJOR: &str = "1";

/// Kind of a file of the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileKind {
    /// Results of a scene.
    Impact,
    /// Results of a sweep.
    Sweep,
    /// Some rows of a sweep.
    SweepPart,
    /// A kernel table.
    Table,
}

impl FileKind {
    /// The kind with a value of the attribute `file_type`.
    fn of_type(found: &str) -> Option<Self> {
        Some(match found {
            results::FILE_TYPE => Self::Impact,
            sweep::FILE_TYPE => Self::Sweep,
            part::FILE_TYPE => Self::SweepPart,
            lookup::schema::FILE_TYPE_VALUE => Self::Table,
            _ => return None,
        })
    }

    /// Description of the kind, and the minor version since which its files have a checksum trailer.
    fn row(self) -> (&'static str, u32) {
        match self {
            Self::Impact => ("the results of an impact", results::SEALED_FROM),
            Self::Sweep => ("a sweep", 6),
            Self::SweepPart => ("a part of a sweep", 2),
            Self::Table => ("a kernel table", lookup::schema::SEALED_FROM),
        }
    }
}

impl fmt::Display for FileKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.row().0)
    }
}

/// An open file of a known kind.
#[derive(Debug, Clone)]
pub(crate) struct Stored {
    pub(super) path: PathBuf,
    pub(super) file: HdfFile,
}

impl Stored {
    /// Opens a file of the wanted kind and a known version.
    pub(super) fn open(path: &Path, wanted: FileKind) -> Result<Self, SceneError> {
        check_kind(path, file_kind(path)?, wanted)?;
        let stored = Self {
            path: path.to_owned(),
            file: open_hdf5(path)?,
        };
        let version = stored.text("format_version")?;
        check_version(&stored.path, &version)?;
        let minor = version.split('.').nth(1).map(str::parse::<u32>);
        let sealed = !matches!(minor, Some(Ok(minor)) if minor < wanted.row().1);
        if sealed != stored.file.is_sealed() {
            return Err(stored.damaged(
                "its checksum trailer is missing: it was truncated, or changed after it was written",
            ));
        }
        // damaged content may look absent, so the whole file is checked; parts are large and are checked when they are
        // read
        if wanted != FileKind::SweepPart {
            stored.check()?;
        }
        Ok(stored)
    }

    /// Checks all bytes of a file that has a checksum trailer.
    pub(super) fn check(&self) -> Result<(), SceneError> {
        self.file.check().map_err(|error| self.damaged(error))
    }

    /// The error for a damaged file: a required part is missing or wrong.
    pub(super) fn damaged(&self, what: impl fmt::Display) -> SceneError {
        SceneError::damaged(&self.path, what)
    }

    /// The result of reading a path of the file.
    fn read<T>(&self, path: &str, read: Result<T, HdfError>) -> Result<T, SceneError> {
        read.map_err(|error| self.damaged(format!("{path} cannot be read: {error}")))
    }

    /// A text attribute of the root.
    pub(crate) fn text(&self, name: &str) -> Result<String, SceneError> {
        let text = self.file.root.text(name);
        text.map_err(|_| self.damaged(format!("the text attribute {name} is missing")))
    }

    /// A number of the root, if it exists.
    pub(super) fn number(&self, name: &str) -> Option<f64> {
        let real = self.file.root.number::<f64>(name).ok();
        real.or_else(|| Some(self.file.root.number::<u64>(name).ok()? as f64))
    }

    /// A group, if it exists.
    pub(super) fn group(&self, path: &str) -> Option<Group> {
        self.file.root.group(path).ok()
    }

    /// A dataset, if it exists.
    pub(super) fn dataset(&self, path: &str) -> Option<Dataset> {
        self.file.root.dataset(path).ok()
    }

    /// Name, unit and meaning of the datasets of a group with a given shape, in the order of the file.
    pub(super) fn quantities(&self, group: &str, shape: &[usize]) -> Vec<Described> {
        let names = self.group(group).and_then(|group| group.members().ok());
        let names = names.into_iter().flatten();
        let found = names.filter_map(|name| {
            let dataset = self.dataset(&format!("{group}/{name}"))?;
            let described = |attribute| dataset.text(attribute).unwrap_or_default();
            (dataset.shape() == shape).then(|| Described {
                unit: described("units"),
                meaning: described("long_name"),
                name,
            })
        });
        found.collect()
    }

    /// All numbers of a dataset with a given shape.
    pub(super) fn numbers(&self, path: &str, shape: &[usize]) -> Result<Vec<f64>, SceneError> {
        self.read(path, self.of_shape(path, shape)?.as_f64(MOST_BYTES_AT_ONCE))
    }

    /// All numbers of a list.
    pub(super) fn vector(&self, path: &str) -> Result<Vec<f64>, SceneError> {
        self.read(path, self.list(path)?.as_f64(MOST_BYTES_AT_ONCE))
    }

    /// All texts of a list.
    pub(super) fn texts(&self, path: &str) -> Result<Vec<String>, SceneError> {
        self.read(path, self.list(path)?.texts(MOST_BYTES_AT_ONCE))
    }

    /// A dataset with one dimension.
    fn list(&self, path: &str) -> Result<Dataset, SceneError> {
        let list = self.dataset(path).filter(|found| found.shape().len() == 1);
        list.ok_or_else(|| self.damaged(format!("the list {path} is missing")))
    }

    /// The values of a dataset with a given shape in a range of its first dimension.
    pub(super) fn some<T: H5Type>(
        &self,
        path: &str,
        shape: &[usize],
        first: Range<usize>,
    ) -> Result<Vec<T>, SceneError> {
        let mut block: Vec<_> = shape.iter().map(|&n| 0..n).collect();
        block[0] = first;
        self.read(
            path,
            self.of_shape(path, shape)?
                .block(&block, MOST_BYTES_AT_ONCE),
        )
    }

    /// The results of a group as datasets of a given shape, with their precision.
    pub(super) fn fields(
        &self,
        group: &str,
        shape: &[usize],
    ) -> Result<WrittenResults, SceneError> {
        let mut fields = WrittenResults::all(self.probed()?);
        let (mut single, mut double) = (true, true);
        fields.retain(|name| {
            let dataset = self.dataset(&format!("{group}/{name}"));
            let dataset = dataset.filter(|found| found.shape() == shape);
            if let Some(dataset) = &dataset {
                single &= dataset.holds::<f32>();
                double &= dataset.holds::<f64>();
            }
            dataset.is_some()
        });
        if single && !double {
            fields.precision = Precision::Single;
        } else if !double {
            return Err(self.damaged("its results differ in precision"));
        }
        Ok(fields)
    }

    /// The probe columns of a sweep or of a part.
    fn probed(&self) -> Result<Vec<Described>, SceneError> {
        let Ok(sweep) = self.text(TEXTS[3]) else {
            return Ok(Vec::new());
        };
        let sweep = parse(&sweep).and_then(|sweep| stored_columns(&sweep));
        sweep.map_err(|error| self.damaged(format!("its sweep cannot be read: {error}")))
    }

    /// A dataset with a given shape.
    fn of_shape(&self, path: &str, shape: &[usize]) -> Result<Dataset, SceneError> {
        match self.dataset(path) {
            Some(found) if found.shape() == shape => Ok(found),
            Some(found) => Err(self.damaged(format!(
                "{path} has the shape {:?} instead of {shape:?}",
                found.shape()
            ))),
            None => Err(self.damaged(format!("{path} is missing"))),
        }
    }
}

/// The first bytes of a regular file.
fn head(path: &Path) -> io::Result<Vec<u8>> {
    // checked before opening: a pipe would block, and files of /proc claim to be empty
    let there = std::fs::metadata(path)?;
    if !there.is_file() {
        return Err(io::Error::other("it is not a file"));
    }
    let (file, mut head) = (std::fs::File::open(path)?, Vec::new());
    file.take(there.len().min(256)).read_to_end(&mut head)?;
    Ok(head)
}

/// Opens a Parquet file with all or some rows of a sweep, and checks its checksum and length; rows are read one group
/// at a time.
fn open_parquet(path: &Path) -> Result<Option<(FileKind, Footer, Part)>, SceneError> {
    if !head(path).is_ok_and(|head| head.starts_with(MAGIC)) {
        return Ok(None);
    }
    let foreign = || SceneError::is(path, "is a Parquet file, but not one of hertzlamb");
    let found = Footer::read(path).map_err(|what| SceneError::damaged(path, what))?;
    let (footer, part) = found.ok_or_else(foreign)?;
    check_version(path, &footer.format_version)?;
    let kind = FileKind::of_type(&footer.file_type);
    Ok(Some((kind.ok_or_else(foreign)?, footer, part)))
}

/// [`open_parquet`] for a file of the wanted kind.
pub(super) fn parquet_of_kind(
    path: &Path,
    wanted: FileKind,
) -> Result<Option<(Footer, Part)>, SceneError> {
    let of_kind = |(kind, footer, part)| {
        check_kind(path, kind, wanted)?;
        Ok((footer, part))
    };
    open_parquet(path)?.map(of_kind).transpose()
}

fn check_kind(path: &Path, found: FileKind, wanted: FileKind) -> Result<(), SceneError> {
    if found == wanted {
        return Ok(());
    }
    Err(SceneError::is(path, format!("is {found}, not {wanted}")))
}

fn check_version(path: &Path, found: &str) -> Result<(), SceneError> {
    if found.split('.').next() == Some(MAJOR) {
        return Ok(());
    }
    let what = format!("has the format version {found}, but this program reads versions {MAJOR}.x");
    Err(SceneError::is(path, what))
}

/// The kind of the file at `path`.
///
/// # Errors
/// [`SceneError`] for a file that the program did not write.
pub fn file_kind(path: &Path) -> Result<FileKind, SceneError> {
    if let Some((kind, ..)) = open_parquet(path)? {
        return Ok(kind);
    }
    let found = open_hdf5(path)?.root.text("file_type").ok();
    let known = found.and_then(|found| FileKind::of_type(&found));
    known.ok_or_else(|| SceneError::is(path, "is an HDF5 file, but not one of hertzlamb"))
}

/// Opens any HDF5 file, with its checksum trailer.
fn open_hdf5(path: &Path) -> Result<HdfFile, SceneError> {
    let head = head(path).map_err(|error| SceneError::unreadable(path, error))?;
    let not = |found| SceneError::is(path, format!("is {found}, not a file of results in HDF5"));
    if !head.starts_with(b"\x89HDF\r\n\x1a\n") {
        let is_text = !head.is_empty() && std::str::from_utf8(&head).is_ok();
        return Err(not(match head.len() {
            0 => "empty",
            _ if head.starts_with(MAGIC) => "a Parquet file",
            _ if is_text => "text",
            _ => "not an HDF5 file",
        }));
    }
    HdfFile::open(path).map_err(|error| match error {
        HdfError::Damaged(what) => SceneError::damaged(path, what),
        _ => not("a damaged HDF5 file"),
    })
}
