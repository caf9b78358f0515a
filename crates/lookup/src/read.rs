//! File to content.

use crate::content::{Between, Content, FIELDS, Origin, Role, Slice, Verification};
use crate::error::TableError;
use crate::hash::content_hash;
use crate::schema;
use hdf5::types::VarLenUnicode;
use hdf5::{File, Group, H5Type, Location};
use ndarray::s;
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
    let source = open(path)?;
    let (mut content, groups) = source.head()?;
    let whole = Nodes::all(&content);
    for (_, _, group) in &groups {
        content.slices.push(source.slice(group, &whole)?);
    }
    Ok(content)
}

/// The nodes and meshes from 0 on that are read.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Nodes {
    /// Nodes in the file, in r and z.
    pub(crate) stored: [usize; 2],
    /// Nodes read.
    pub(crate) nodes: [usize; 2],
    /// Meshes read, of which probes tell the error.
    pub(crate) meshes: [usize; 2],
}

impl Nodes {
    /// All of a table.
    pub(crate) fn all(content: &Content) -> Self {
        let stored = [content.r.len(), content.z.len()];
        Self {
            stored,
            nodes: stored,
            meshes: content.probes().map(|places| places.len()),
        }
    }
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

/// A slice's Poisson ratio, role and place in the file.
pub(crate) type Listed = (f64, Role, Group);

impl Source<'_> {
    /// Everything but the slices, and their list by ascending ratio.
    pub(crate) fn head(&self) -> Result<(Content, Vec<Listed>), TableError> {
        let root: &Group = &self.file;
        let slices = self.group(root, schema::SLICES)?;
        let mut content = Content {
            origin: Origin {
                grid: self.text(root, schema::GRID)?,
                software_version: self.text(root, schema::SOFTWARE_VERSION)?,
                git_revision: self.text(root, schema::GIT_REVISION)?,
                created_unix_s: self.number(root, schema::CREATED)?,
                accuracy_asked: self.number(root, schema::ACCURACY_ASKED)?,
                accuracy_reached: self.numbers(root, schema::ACCURACY_REACHED)?,
            },
            r: self.array(root, schema::R)?.0,
            z: self.array(root, schema::Z)?.0,
            r_max: self.number(root, schema::R_MAX)?,
            z_max: self.number(root, schema::Z_MAX)?,
            cell_width: self.number(root, schema::CELL_WIDTH)?,
            stencil_points: self.number::<u64>(root, schema::STENCIL_POINTS)? as usize,
            pulse_lengths: self.array(root, schema::PULSE_LENGTH)?.0,
            slices: Vec::new(),
            between_r: self.array(root, schema::BETWEEN_R)?.0,
            between_z: self.array(root, schema::BETWEEN_Z)?.0,
            between: Vec::new(),
        };
        let mut groups = Vec::new();
        for name in self.members(&slices, schema::SLICES)? {
            let group = self.group(&slices, &name)?;
            let ratio: f64 = self.number(&group, schema::POISSON_RATIO)?;
            groups.push((ratio, self.role(&group)?, group));
        }
        groups.sort_by(|a, b| a.0.total_cmp(&b.0));
        let between = self.group(root, schema::BETWEEN)?;
        for name in self.members(&between, schema::BETWEEN)? {
            let group = self.group(&between, &name)?;
            content.between.push(Between {
                poisson_ratio: self.number(&group, schema::POISSON_RATIO)?,
                verification: Verification {
                    direct: self.array(&group, schema::PROBE_DIRECT)?.0,
                    looked_up: self.array(&group, schema::PROBE_LOOKED_UP)?.0,
                    error: self.array(&group, schema::PROBE_ERROR)?.0,
                },
            });
        }
        content
            .between
            .sort_by(|a, b| a.poisson_ratio.total_cmp(&b.poisson_ratio));
        Ok((content, groups))
    }

    fn members(&self, group: &Group, name: &str) -> Result<Vec<String>, TableError> {
        group
            .member_names()
            .map_err(|error| self.item(name, &error))
    }

    /// A slice at the nodes wanted.
    pub(crate) fn slice(&self, group: &Group, wanted: &Nodes) -> Result<Slice, TableError> {
        let [rows, columns] = wanted.stored;
        let mut lengths = [0; 2];
        for (length, name) in lengths.iter_mut().zip([schema::REMAINDER, schema::TAIL]) {
            let shape = self.shape(group, name)?;
            *length = shape.get(3).copied().unwrap_or(0);
            self.expect(group, name, &shape, &[rows, columns, FIELDS, *length])?;
        }
        let at_nodes = |name| self.corner(group, name, wanted.nodes);
        let of_meshes = |name| self.corner(group, name, wanted.meshes);
        Ok(Slice {
            poisson_ratio: self.number(group, schema::POISSON_RATIO)?,
            role: self.role(group)?,
            cells: lengths[0],
            remainder: at_nodes(schema::REMAINDER)?,
            moment: at_nodes(schema::MOMENT)?,
            curvature: at_nodes(schema::CURVATURE)?,
            tail: at_nodes(schema::TAIL)?,
            verification: Verification {
                direct: of_meshes(schema::PROBE_DIRECT)?,
                looked_up: of_meshes(schema::PROBE_LOOKED_UP)?,
                error: of_meshes(schema::PROBE_ERROR)?,
            },
        })
    }

    fn shape(&self, group: &Group, name: &str) -> Result<Vec<usize>, TableError> {
        group
            .dataset(name)
            .map(|dataset| dataset.shape())
            .map_err(|error| self.item(&format!("{}/{name}", group.name()), &error))
    }

    /// The first `count` entries along r and z of a dataset over (r, z, .., ..); fewer where it has no more.
    fn corner(&self, group: &Group, name: &str, count: [usize; 2]) -> Result<Vec<f32>, TableError> {
        let shape = self.shape(group, name)?;
        let [rows, columns, ..] = shape[..] else {
            return Ok(self.array(group, name)?.0);
        };
        if shape.len() != 4 || (count[0] >= rows && count[1] >= columns) {
            return Ok(self.array(group, name)?.0);
        }
        let (rows, columns) = (rows.min(count[0]), columns.min(count[1]));
        group
            .dataset(name)
            .and_then(|dataset| {
                dataset.read_slice::<f32, _, ndarray::Ix4>(s![..rows, ..columns, .., ..])
            })
            .map(|array| array.into_raw_vec_and_offset().0)
            .map_err(|error| self.item(&format!("{}/{name}", group.name()), &error))
    }

    fn role(&self, group: &Group) -> Result<Role, TableError> {
        let role = self.text(group, schema::ROLE)?;
        Role::from_name(&role).ok_or_else(|| TableError::Item {
            path: self.path.to_owned(),
            item: format!("{}/{}", group.name(), schema::ROLE),
            detail: format!("{role:?} is neither grid nor exact"),
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
