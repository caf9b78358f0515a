//! Reading: from file to content.

use super::error::TableError;
use super::open::open;
use super::source::TableSource;
use crate::content::{Between, Content, FIELDS, Origin, Role, Slice, Verification};
use crate::hash::content_hash;
use crate::table::Table;
use crate::{schema, validate};
use ledger::Group;
use std::ops::Range;
use std::path::Path;

impl Table {
    /// Reads the table at `path` into memory and validates it; [`TableFile`](crate::TableFile) reads parts.
    ///
    /// Every byte that is read is compared with the seal of the file. In formats before 2.4, which have no seal, the
    /// whole content is compared with the hash stated in the file.
    ///
    /// # Errors
    /// [`TableError`]: the file does not exist, is not a kernel table, has an unknown version, is damaged, or contains
    /// invalid values.
    pub fn open(path: &Path) -> Result<Self, TableError> {
        let source = open(path)?;
        Self::new(source.proven()?).map_err(|error| source.wrong(error))
    }
}

/// Reads the content of the table at `path` and checks that axes ascend and lists have the right lengths;
/// [`Table::new`]
/// checks the numbers.
///
/// # Errors
/// [`TableError`] if the file does not exist, is of another kind or version, or is incomplete or damaged.
pub fn read(path: &Path) -> Result<Content, TableError> {
    open(path)?.everything()
}

/// Whether the table at `path` has exactly this content; reads one slice at a time into memory.
///
/// # Errors
/// As [`read`].
pub fn holds(path: &Path, content: &Content) -> Result<bool, TableError> {
    let source = open(path)?;
    source.check_seal()?;
    let (head, listed) = source.head()?;
    let numbers = |c: &Content| [c.r_max, c.z_max, c.cell_width, c.stencil_points as f64];
    let mut same = head.origin == content.origin
        && numbers(&head) == numbers(content)
        && [&head.r, &head.z, &head.pulse_lengths]
            == [&content.r, &content.z, &content.pulse_lengths]
        && [&head.between_r, &head.between_z] == [&content.between_r, &content.between_z]
        && head.between == content.between
        && listed.len() == content.slices.len();
    let whole = Window::all(&head);
    for (listed, slice) in listed.iter().zip(&content.slices) {
        same &= source.slice(&head, listed, &whole)? == *slice;
    }
    Ok(same)
}

/// Compares every byte of the table at `path` with its seal, or the content with the stated hash if there is no seal;
/// returns the origin of the table.
///
/// # Errors
/// As [`read`], and [`BadTable::Wrong`](crate::BadTable::Wrong).
pub fn check_whole(path: &Path) -> Result<Origin, TableError> {
    let source = open(path)?;
    if source.file.is_sealed() {
        source.check_seal()?;
        return Ok(source.head()?.0.origin);
    }
    Ok(source.proven()?.origin)
}

/// The hash of `content`, which was read from the table at `path`, after comparison with the stated one.
///
/// # Errors
/// As [`read`], and [`BadTable::Wrong`](crate::BadTable::Wrong) if the hashes differ.
pub fn same_hash(path: &Path, content: &Content) -> Result<String, TableError> {
    open(path)?.same_hash(content)
}

/// The SHA-256 stated in the file at `path`.
pub fn stated_hash(path: &Path) -> Result<String, TableError> {
    let source = open(path)?;
    source.text(&source.file.root, schema::CONTENT_SHA256)
}

/// Ranges in r and z of the nodes to read, and of the meshes whose probes are read.
#[derive(Debug, Clone)]
pub(super) struct Window {
    pub(super) nodes: [Range<usize>; 2],
    pub(super) meshes: [Range<usize>; 2],
}

impl Window {
    /// The window of a whole table.
    pub(super) fn all(content: &Content) -> Self {
        Self {
            nodes: [content.r.len(), content.z.len()].map(|count| 0..count),
            meshes: content.probes().map(|places| 0..places.len()),
        }
    }
}

/// Poisson's ratio, role and group of a slice in the file.
pub(super) struct Listed {
    pub(super) ratio: f64,
    pub(super) role: Role,
    pub(super) place: Group,
}

impl TableSource {
    /// The whole content; every byte of the file is compared with its seal.
    pub(super) fn everything(&self) -> Result<Content, TableError> {
        self.check_seal()?;
        let (mut content, listed) = self.head()?;
        let whole = Window::all(&content);
        let slice = |slice| self.slice(&content, slice, &whole);
        content.slices = listed.iter().map(slice).collect::<Result<_, _>>()?;
        Ok(content)
    }

    /// The whole content, compared with the seal or, if there is none, with the stated hash.
    pub(super) fn proven(&self) -> Result<Content, TableError> {
        let content = self.everything()?;
        if !self.file.is_sealed() {
            self.same_hash(&content)?;
        }
        Ok(content)
    }

    /// The hash of the content, after comparison with the stated one.
    pub(super) fn same_hash(&self, content: &Content) -> Result<String, TableError> {
        let stated = self.text(&self.file.root, schema::CONTENT_SHA256)?;
        let found = content_hash(content);
        if stated == found {
            return Ok(found);
        }
        let wrong = format!("content hash {found}, stated {stated}: the content was changed");
        Err(self.wrong(wrong))
    }

    /// The validated content without slices, and the list of slices by ascending ratio.
    pub(super) fn head(&self) -> Result<(Content, Vec<Listed>), TableError> {
        let root = &self.file.root;
        let mut content = Content {
            origin: self.origin()?,
            r: self.list(root, schema::R)?,
            z: self.list(root, schema::Z)?,
            r_max: self.number(root, schema::R_MAX)?,
            z_max: self.number(root, schema::Z_MAX)?,
            cell_width: self.number(root, schema::CELL_WIDTH)?,
            stencil_points: self.number::<u64>(root, schema::STENCIL_POINTS)? as usize,
            pulse_lengths: self.list(root, schema::PULSE_LENGTH)?,
            slices: Vec::new(),
            between_r: self.list(root, schema::BETWEEN_R)?,
            between_z: self.list(root, schema::BETWEEN_Z)?,
            between: Vec::new(),
        };
        content.between = self.between(&content)?;
        validate::frame(&content).map_err(|error| self.wrong(error))?;
        let reached = &content.origin.accuracy_reached;
        if reached.len() != content.pulse_lengths.len() || reached.iter().any(|x| !x.is_finite()) {
            let item = root.item(schema::ACCURACY_REACHED);
            return Err(self.item(
                &item,
                "it is not a list of numbers, one for each pulse length",
            ));
        }
        let listed = self.listed()?;
        let ratios: Vec<f64> = listed.iter().map(|slice| slice.ratio).collect();
        validate::ascending("poisson_ratio", &ratios).map_err(|error| self.wrong(error))?;
        Ok((content, listed))
    }

    fn origin(&self) -> Result<Origin, TableError> {
        let root = &self.file.root;
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

    /// The errors measured between slices, by ascending ratio.
    fn between(&self, content: &Content) -> Result<Vec<Between>, TableError> {
        let places = [content.between_r.len(), content.between_z.len()];
        let all = places.map(|count| 0..count);
        let mut between = Vec::new();
        for place in self.groups(&self.group(&self.file.root, schema::BETWEEN)?)? {
            between.push(Between {
                poisson_ratio: self.number(&place, schema::POISSON_RATIO)?,
                verification: self.verification(&place, content, places, &all)?,
            });
        }
        between.sort_by(|a, b| a.poisson_ratio.total_cmp(&b.poisson_ratio));
        Ok(between)
    }

    /// The list of slices by ascending ratio.
    pub(super) fn listed(&self) -> Result<Vec<Listed>, TableError> {
        let all = self.group(&self.file.root, schema::SLICES)?;
        let mut listed = Vec::new();
        for place in self.groups(&all)? {
            let role = self.text(&place, schema::ROLE)?;
            listed.push(Listed {
                ratio: self.number(&place, schema::POISSON_RATIO)?,
                role: Role::from_name(&role).ok_or_else(|| {
                    let detail = format!("{role:?} is neither \"grid\" nor \"exact\"");
                    self.item(&place.item(schema::ROLE), detail)
                })?,
                place,
            });
        }
        listed.sort_by(|a, b| a.ratio.total_cmp(&b.ratio));
        Ok(listed)
    }

    /// A slice at the wanted nodes, with lists of the right lengths.
    pub(super) fn slice(
        &self,
        content: &Content,
        listed: &Listed,
        wanted: &Window,
    ) -> Result<Slice, TableError> {
        Ok(Slice {
            verification: self.errors(content, listed, wanted)?,
            ..self.sum(content, &[(listed, 1.0)], wanted)?
        })
    }

    /// The weighted sum of slices at the wanted nodes, without measured errors.
    pub(super) fn sum(
        &self,
        content: &Content,
        slices: &[(&Listed, f64)],
        wanted: &Window,
    ) -> Result<Slice, TableError> {
        let first = slices[0].0;
        let size = |listed: &Listed| -> Result<[usize; 2], TableError> {
            let (_, [_, _, _, cells]) = self.dataset(&listed.place, schema::REMAINDER)?;
            let (_, [_, _, _, terms]) = self.dataset(&listed.place, schema::TAIL)?;
            Ok([cells, terms])
        };
        let [cells, terms] = size(first)?;
        for (listed, _) in &slices[1..] {
            validate::same_size(listed.ratio, size(listed)?, [cells, terms])
                .map_err(|error| self.wrong(error))?;
        }
        let list = |name, last| {
            let needed = [content.r.len(), content.z.len(), FIELDS, last];
            let read = |listed: &Listed| self.block(&listed.place, name, needed, &wanted.nodes);
            if let [(one, _)] = slices {
                return read(one);
            }
            let mut sums = Vec::new();
            for (listed, weight) in slices {
                let values = read(listed)?;
                sums.resize(values.len(), 0.0);
                for (sum, value) in sums.iter_mut().zip(values) {
                    *sum += weight * f64::from(value);
                }
            }
            Ok(sums.into_iter().map(|sum| sum as f32).collect())
        };
        Ok(Slice {
            poisson_ratio: first.ratio,
            role: first.role,
            cells,
            remainder: list(schema::REMAINDER, cells)?,
            moment: list(schema::MOMENT, cells)?,
            curvature: list(schema::CURVATURE, cells)?,
            tail: list(schema::TAIL, terms)?,
            verification: Verification::default(),
        })
    }

    /// The measured errors of a slice at the wanted meshes.
    pub(super) fn errors(
        &self,
        content: &Content,
        listed: &Listed,
        wanted: &Window,
    ) -> Result<Verification, TableError> {
        let places = content.probes().map(|places| places.len());
        let found = self.verification(&listed.place, content, places, &wanted.meshes)?;
        let count = wanted.meshes.iter().map(Range::len).product();
        validate::probes(content, &validate::group(listed.ratio), &found, count)
            .map_err(|error| self.wrong(error))?;
        Ok(found)
    }

    /// The measured errors at some of a grid of places.
    fn verification(
        &self,
        place: &Group,
        content: &Content,
        [across, down]: [usize; 2],
        wanted: &[Range<usize>; 2],
    ) -> Result<Verification, TableError> {
        let needed = [across, down, content.pulse_lengths.len(), FIELDS];
        let of = |name| self.block(place, name, needed, wanted);
        Ok(Verification {
            direct: of(schema::PROBE_DIRECT)?,
            looked_up: of(schema::PROBE_LOOKED_UP)?,
            error: of(schema::PROBE_ERROR)?,
        })
    }
}
