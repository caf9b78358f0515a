//! File to content.

use crate::content::{Between, Content, FIELDS, Origin, Role, Slice, Verification};
use crate::error::TableError;
use crate::hash::content_hash;
use crate::schema;
use hdf5::types::VarLenUnicode;
use hdf5::{File, Group, H5Type, Location};
use std::path::Path;

/// A file that is being read, with its path for messages.
pub(crate) struct Source<'a> {
    path: &'a Path,
    pub(crate) file: File,
}

/// Reads the content of the table at `path`; [`crate::Table::new`] then judges the values.
///
/// # Errors
/// [`TableError`] when the file is absent, of another kind or version, incomplete or damaged.
pub fn read(path: &Path) -> Result<Content, TableError> {
    read_chosen(path, |slices| (0..slices.len()).collect())
}

/// [`read`] of those slices that `choose` names by their place in the list, which ascends.
pub(crate) fn read_chosen(
    path: &Path,
    choose: impl FnOnce(&[(f64, Role)]) -> Vec<usize>,
) -> Result<Content, TableError> {
    let source = open(path)?;
    let root: &Group = &source.file;
    let slices = source.group(root, schema::SLICES)?;
    let mut content = Content {
        origin: Origin {
            grid: source.text(root, schema::GRID)?,
            software_version: source.text(root, schema::SOFTWARE_VERSION)?,
            git_revision: source.text(root, schema::GIT_REVISION)?,
            created_unix_s: source.number(root, schema::CREATED)?,
            accuracy_asked: source.number(root, schema::ACCURACY_ASKED)?,
            accuracy_reached: source.numbers(root, schema::ACCURACY_REACHED)?,
        },
        r: source.array(root, schema::R)?.0,
        z: source.array(root, schema::Z)?.0,
        r_max: source.number(root, schema::R_MAX)?,
        z_max: source.number(root, schema::Z_MAX)?,
        cell_width: source.number(root, schema::CELL_WIDTH)?,
        stencil_points: source.number::<u64>(root, schema::STENCIL_POINTS)? as usize,
        pulse_lengths: source.array(root, schema::PULSE_LENGTH)?.0,
        slices: Vec::new(),
        between_r: source.array(root, schema::BETWEEN_R)?.0,
        between_z: source.array(root, schema::BETWEEN_Z)?.0,
        between: Vec::new(),
    };
    let names = slices
        .member_names()
        .map_err(|error| source.item(schema::SLICES, &error))?;
    let mut groups = Vec::new();
    for name in names {
        let group = source.group(&slices, &name)?;
        let ratio: f64 = source.number(&group, schema::POISSON_RATIO)?;
        groups.push((ratio, source.role(&group)?, group));
    }
    groups.sort_by(|a, b| a.0.total_cmp(&b.0));
    let list: Vec<(f64, Role)> = groups.iter().map(|group| (group.0, group.1)).collect();
    for index in choose(&list) {
        let slice = source.slice(&groups[index].2, content.r.len(), content.z.len())?;
        content.slices.push(slice);
    }
    let between = source.group(root, schema::BETWEEN)?;
    let names = between
        .member_names()
        .map_err(|error| source.item(schema::BETWEEN, &error))?;
    for name in names {
        let group = source.group(&between, &name)?;
        content.between.push(Between {
            poisson_ratio: source.number(&group, schema::POISSON_RATIO)?,
            verification: source.verification(&group)?,
        });
    }
    content
        .between
        .sort_by(|a, b| a.poisson_ratio.total_cmp(&b.poisson_ratio));
    Ok(content)
}

/// Compares the SHA-256 that the file at `path` states with that of its `content`.
///
/// # Errors
/// [`TableError::Checksum`] when they differ, or the reading errors of [`read`].
pub fn check_hash(path: &Path, content: &Content) -> Result<(), TableError> {
    let stated = stated_hash(path)?;
    let found = content_hash(content);
    if stated == found {
        Ok(())
    } else {
        Err(TableError::Checksum {
            path: path.to_owned(),
            stated,
            found,
        })
    }
}

/// The SHA-256 that the file at `path` states.
///
/// # Errors
/// As [`read`].
pub fn stated_hash(path: &Path) -> Result<String, TableError> {
    let source = open(path)?;
    source.text(&source.file, schema::CONTENT_SHA256)
}

pub(crate) fn open(path: &Path) -> Result<Source<'_>, TableError> {
    std::fs::File::open(path)
        .and_then(|file| file.metadata())
        .and_then(|data| {
            if data.is_file() {
                Ok(())
            } else {
                Err(std::io::Error::other("it is not a file"))
            }
        })
        .map_err(|source| TableError::Unreadable {
            path: path.to_owned(),
            source,
        })?;
    let file = File::open(path).map_err(|error| TableError::NotHdf5 {
        path: path.to_owned(),
        detail: first_line(&error),
    })?;
    let source = Source { path, file };
    let found = source
        .text(&source.file, schema::FILE_TYPE)
        .unwrap_or_default();
    if found != schema::FILE_TYPE_VALUE {
        return Err(TableError::Foreign {
            path: path.to_owned(),
            found,
        });
    }
    let found = source.text(&source.file, schema::FORMAT_VERSION)?;
    let major = found
        .split('.')
        .next()
        .and_then(|major| major.parse::<u32>().ok());
    if major != Some(schema::MAJOR_READ) {
        return Err(TableError::Version {
            path: path.to_owned(),
            found,
        });
    }
    Ok(source)
}

impl Source<'_> {
    fn slice(&self, group: &Group, rows: usize, columns: usize) -> Result<Slice, TableError> {
        let (remainder, shape) = self.array(group, schema::REMAINDER)?;
        let cells = shape.get(3).copied().unwrap_or(0);
        self.expect(
            group,
            schema::REMAINDER,
            &shape,
            &[rows, columns, FIELDS, cells],
        )?;
        let (tail, shape) = self.array(group, schema::TAIL)?;
        let terms = shape.get(3).copied().unwrap_or(0);
        self.expect(group, schema::TAIL, &shape, &[rows, columns, FIELDS, terms])?;
        Ok(Slice {
            poisson_ratio: self.number(group, schema::POISSON_RATIO)?,
            role: self.role(group)?,
            cells,
            remainder,
            moment: self.array(group, schema::MOMENT)?.0,
            curvature: self.array(group, schema::CURVATURE)?.0,
            tail,
            verification: self.verification(group)?,
        })
    }

    fn role(&self, group: &Group) -> Result<Role, TableError> {
        let role = self.text(group, schema::ROLE)?;
        Role::from_name(&role).ok_or_else(|| TableError::Item {
            path: self.path.to_owned(),
            item: format!("{}/{}", group.name(), schema::ROLE),
            detail: format!("{role:?} is neither grid nor exact"),
        })
    }

    fn verification(&self, group: &Group) -> Result<Verification, TableError> {
        Ok(Verification {
            direct: self.array(group, schema::PROBE_DIRECT)?.0,
            looked_up: self.array(group, schema::PROBE_LOOKED_UP)?.0,
            error: self.array(group, schema::PROBE_ERROR)?.0,
        })
    }

    fn expect(
        &self,
        group: &Group,
        name: &str,
        shape: &[usize],
        needed: &[usize],
    ) -> Result<(), TableError> {
        if shape == needed {
            return Ok(());
        }
        let item = format!("{}/{name}", group.name());
        Err(TableError::Shape {
            item,
            needed: needed.iter().product(),
            found: shape.iter().product(),
        })
    }

    pub(crate) fn group(&self, parent: &Group, name: &str) -> Result<Group, TableError> {
        parent.group(name).map_err(|error| self.item(name, &error))
    }

    pub(crate) fn array<T: H5Type>(
        &self,
        group: &Group,
        name: &str,
    ) -> Result<(Vec<T>, Vec<usize>), TableError> {
        group
            .dataset(name)
            .and_then(|dataset| Ok((dataset.read_raw::<T>()?, dataset.shape())))
            .map_err(|error| self.item(&format!("{}/{name}", group.name()), &error))
    }

    fn text(&self, place: &Location, name: &str) -> Result<String, TableError> {
        place
            .attr(name)
            .and_then(|attribute| attribute.read_scalar::<VarLenUnicode>())
            .map(|text| text.as_str().to_owned())
            .map_err(|error| self.item(name, &error))
    }

    pub(crate) fn number<T: H5Type>(&self, place: &Location, name: &str) -> Result<T, TableError> {
        place
            .attr(name)
            .and_then(|attribute| attribute.read_scalar())
            .map_err(|error| self.item(name, &error))
    }

    fn numbers(&self, place: &Location, name: &str) -> Result<Vec<f64>, TableError> {
        place
            .attr(name)
            .and_then(|attribute| attribute.read_raw())
            .map_err(|error| self.item(name, &error))
    }

    pub(crate) fn item(&self, item: &str, error: &hdf5::Error) -> TableError {
        TableError::Item {
            path: self.path.to_owned(),
            item: item.to_owned(),
            detail: first_line(error),
        }
    }
}

pub(crate) fn first_line(error: &hdf5::Error) -> String {
    error
        .to_string()
        .lines()
        .next()
        .unwrap_or_default()
        .to_owned()
}
