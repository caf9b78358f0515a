//! File to content.

use super::error::{BadTable, TableError};
use super::open::open;
use super::source::{Place, Source};
use crate::content::{Between, Content, FIELDS, Origin, Role, Slice, Verification};
use crate::hash::content_hash;
use crate::table::Table;
use crate::{schema, validate};
use std::path::Path;

impl Table {
    /// Reads the table at `path` into memory and validates it; [`TableFile`](crate::TableFile) reads parts.
    ///
    /// Every byte that is read is compared with the seal of the file or, in a format before 2.4, all of the content with
    /// the hash that the file states.
    ///
    /// # Errors
    /// [`TableError`]: the file is absent, not a kernel table, of an unknown version, damaged, or
    /// holds values that cannot be right.
    pub fn open(path: &Path) -> Result<Self, TableError> {
        let source = open(path)?;
        let content = source.everything()?;
        source.compare(&content)?;
        Self::new(content).map_err(|error| source.content(error))
    }
}

/// Reads the content of the table at `path`, with axes that ascend and lists as long as they demand;
/// [`Table::new`] then judges the numbers, and [`check_hash`] compares them.
///
/// # Errors
/// [`TableError`] when the file is absent, of another kind or version, incomplete or damaged.
pub fn read(path: &Path) -> Result<Content, TableError> {
    open(path)?.everything()
}

/// Compares the SHA-256 that the file at `path` states with that of its `content`.
///
/// # Errors
/// [`BadTable::Checksum`] when they differ, or the reading errors of [`read`].
pub fn check_hash(path: &Path, content: &Content) -> Result<(), TableError> {
    open(path)?.same_hash(content)
}

/// Compares every byte of the table at `path` with its seal or, where it has none, its content with the hash that it states;
/// gives how it was made.
///
/// # Errors
/// As [`read`], and [`BadTable::Checksum`].
pub fn check_whole(path: &Path) -> Result<Origin, TableError> {
    let source = open(path)?;
    if source.is_sealed() {
        source.check_seal()?;
        return Ok(source.head()?.0.origin);
    }
    let content = source.everything()?;
    source.same_hash(&content)?;
    Ok(content.origin)
}

/// The SHA-256 that the file at `path` states.
pub fn stated_hash(path: &Path) -> Result<String, TableError> {
    let source = open(path)?;
    source.text(&source.root(), schema::CONTENT_SHA256)
}

/// The nodes and meshes from 0 on that are read.
#[derive(Debug, Clone, Copy)]
pub(super) struct Nodes {
    /// Nodes in the file, in r and z.
    pub(super) stored: [usize; 2],
    /// Meshes in the file, of which probes tell the error.
    pub(super) stored_meshes: [usize; 2],
    /// Nodes read.
    pub(super) nodes: [usize; 2],
    /// Meshes read.
    pub(super) meshes: [usize; 2],
}

impl Nodes {
    /// All of a table.
    pub(super) fn all(content: &Content) -> Self {
        let stored = [content.r.len(), content.z.len()];
        let meshes = content.probes().map(|places| places.len());
        Self {
            stored,
            stored_meshes: meshes,
            nodes: stored,
            meshes,
        }
    }
}

/// A slice's Poisson ratio, role and place in the file.
pub(super) struct Listed {
    pub(super) ratio: f64,
    pub(super) role: Role,
    pub(super) place: Place,
}

impl Source {
    /// All of the table, and every byte of the file compared with its seal.
    pub(super) fn everything(&self) -> Result<Content, TableError> {
        self.check_seal()?;
        let (mut content, listed) = self.head()?;
        let whole = Nodes::all(&content);
        for slice in &listed {
            content.slices.push(self.slice(&content, slice, &whole)?);
        }
        Ok(content)
    }

    /// Compares the content of a file whose bytes nothing else covers.
    pub(super) fn compare(&self, content: &Content) -> Result<(), TableError> {
        if self.is_sealed() {
            Ok(())
        } else {
            self.same_hash(content)
        }
    }

    fn same_hash(&self, content: &Content) -> Result<(), TableError> {
        let stated = self.text(&self.root(), schema::CONTENT_SHA256)?;
        let found = content_hash(content);
        if stated == found {
            Ok(())
        } else {
            Err(BadTable::Checksum { stated, found }.of(self.path()))
        }
    }

    /// Everything but the slices, valid, and their list by ascending ratio.
    pub(super) fn head(&self) -> Result<(Content, Vec<Listed>), TableError> {
        let root = self.root();
        let mut content = Content {
            origin: self.origin(&root)?,
            r: self.list(&root, schema::R)?,
            z: self.list(&root, schema::Z)?,
            r_max: self.number(&root, schema::R_MAX)?,
            z_max: self.number(&root, schema::Z_MAX)?,
            cell_width: self.number(&root, schema::CELL_WIDTH)?,
            stencil_points: self.number::<u64>(&root, schema::STENCIL_POINTS)? as usize,
            pulse_lengths: self.list(&root, schema::PULSE_LENGTH)?,
            slices: Vec::new(),
            between_r: self.list(&root, schema::BETWEEN_R)?,
            between_z: self.list(&root, schema::BETWEEN_Z)?,
            between: Vec::new(),
        };
        content.between = self.between(&root, &content)?;
        validate::frame(&content).map_err(|error| self.content(error))?;
        let reached = &content.origin.accuracy_reached;
        if reached.len() != content.pulse_lengths.len() || reached.iter().any(|x| !x.is_finite()) {
            let item = root.item(schema::ACCURACY_REACHED);
            return Err(self.item(&item, "it is no list of numbers, one for each pulse length"));
        }
        let listed = self.listed(&root)?;
        let ratios: Vec<f64> = listed.iter().map(|slice| slice.ratio).collect();
        validate::ascending("poisson_ratio", &ratios).map_err(|error| self.content(error))?;
        Ok((content, listed))
    }

    fn origin(&self, root: &Place) -> Result<Origin, TableError> {
        Ok(Origin {
            grid: self.text(root, schema::GRID)?,
            format_version: self.text(root, schema::FORMAT_VERSION)?,
            software_version: self.text(root, schema::SOFTWARE_VERSION)?,
            numbers_revision: self.number(root, schema::NUMBERS_REVISION).unwrap_or(1),
            git_revision: self.text(root, schema::GIT_REVISION)?,
            created_unix_s: self.number(root, schema::CREATED)?,
            accuracy_asked: self.number(root, schema::ACCURACY_ASKED)?,
            accuracy_reached: self.numbers(root, schema::ACCURACY_REACHED)?,
        })
    }

    /// What was measured between slices, by ascending ratio.
    fn between(&self, root: &Place, content: &Content) -> Result<Vec<Between>, TableError> {
        let places = [content.between_r.len(), content.between_z.len()];
        let needed = [places[0], places[1], content.pulse_lengths.len(), FIELDS];
        let all = self.group(root, schema::BETWEEN)?;
        let mut between = Vec::new();
        for place in self.groups(&all)? {
            between.push(Between {
                poisson_ratio: self.number(&place, schema::POISSON_RATIO)?,
                verification: self.verification(&place, needed, places)?,
            });
        }
        between.sort_by(|a, b| a.poisson_ratio.total_cmp(&b.poisson_ratio));
        Ok(between)
    }

    /// The slices by ascending ratio.
    pub(super) fn listed(&self, root: &Place) -> Result<Vec<Listed>, TableError> {
        let all = self.group(root, schema::SLICES)?;
        let mut listed = Vec::new();
        for place in self.groups(&all)? {
            let role = self.text(&place, schema::ROLE)?;
            listed.push(Listed {
                ratio: self.number(&place, schema::POISSON_RATIO)?,
                role: Role::from_name(&role).ok_or_else(|| {
                    let detail = format!("{role:?} is neither grid nor exact");
                    self.item(&place.item(schema::ROLE), &detail)
                })?,
                place,
            });
        }
        listed.sort_by(|a, b| a.ratio.total_cmp(&b.ratio));
        Ok(listed)
    }

    /// A slice at the nodes wanted, with lists as long as the axes demand.
    pub(super) fn slice(
        &self,
        content: &Content,
        listed: &Listed,
        wanted: &Nodes,
    ) -> Result<Slice, TableError> {
        let place = &listed.place;
        let [rows, columns] = wanted.stored;
        let [.., cells] = self.dimensions(place, schema::REMAINDER)?;
        let [.., terms] = self.dimensions(place, schema::TAIL)?;
        let at_nodes = |name, last| {
            let needed = [rows, columns, FIELDS, last];
            self.corner(place, name, needed, wanted.nodes)
        };
        let [across, down] = wanted.stored_meshes;
        let probes = [across, down, content.pulse_lengths.len(), FIELDS];
        Ok(Slice {
            poisson_ratio: listed.ratio,
            role: listed.role,
            cells,
            remainder: at_nodes(schema::REMAINDER, cells)?,
            moment: at_nodes(schema::MOMENT, cells)?,
            curvature: at_nodes(schema::CURVATURE, cells)?,
            tail: at_nodes(schema::TAIL, terms)?,
            verification: self.verification(place, probes, wanted.meshes)?,
        })
    }

    /// What was measured at the first `count` places of a grid of them, of the dimensions `needed`.
    fn verification(
        &self,
        place: &Place,
        needed: [usize; 4],
        count: [usize; 2],
    ) -> Result<Verification, TableError> {
        let of = |name| self.corner(place, name, needed, count);
        Ok(Verification {
            direct: of(schema::PROBE_DIRECT)?,
            looked_up: of(schema::PROBE_LOOKED_UP)?,
            error: of(schema::PROBE_ERROR)?,
        })
    }
}
