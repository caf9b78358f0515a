//! A kernel table in memory: validated once, immutable, shared by any number of threads.

use crate::content::{Between, Content, FIELDS, Role, Slice, Verification, centres};
use crate::error::{LookupError, TableError};
use crate::ratio::{self, Served, cell_scale};
use crate::stencil::locate;
use crate::{hash, schema};
use halfspace::{Kernel, Medium, Profile};
use std::path::Path;

/// A loaded kernel table.
///
/// Reads take no lock and change nothing: share it by reference or in an `Arc`.
#[derive(Debug)]
pub struct Table {
    content: Content,
    id: String,
    poisson_ratios: Vec<f64>,
    served: Vec<Served>,
    kernels: Vec<Kernel>,
    meshes: [usize; 2],
}

impl Table {
    /// Reads the table at `path` into memory and validates it.
    ///
    /// [`TableFile`](crate::TableFile) reads parts.
    /// The HDF5 library checks a Fletcher-32 sum of every chunk while it reads; [`crate::read`] with
    /// [`crate::content_hash`] checks the stated SHA-256 as well.
    ///
    /// # Errors
    /// [`TableError`]: the file is absent, not a kernel table, of an unknown version, damaged, or
    /// holds values that cannot be right.
    pub fn open(path: &Path) -> Result<Self, TableError> {
        Self::new(crate::read(path)?)
    }

    /// Accepts `content` as a table.
    ///
    /// # Errors
    /// [`TableError`] when an axis does not ascend, a size does not fit or a value is not finite.
    pub fn new(content: Content) -> Result<Self, TableError> {
        validate(&content)?;
        let kernels = content
            .slices
            .iter()
            .map(|slice| Kernel::new(&Medium::new(slice.poisson_ratio)?, Profile::Hertz, 1e-6))
            .collect::<Result<_, _>>()?;
        let served = content
            .slices
            .iter()
            .map(|slice| Served::new(slice.poisson_ratio, slice.role))
            .collect::<Result<_, _>>()?;
        let meshes = content.probes().map(|places| places.len());
        Ok(Self {
            meshes,
            id: hash::settings_id(&content.origin.grid),
            poisson_ratios: content
                .slices
                .iter()
                .map(|slice| slice.poisson_ratio)
                .collect(),
            served,
            kernels,
            content,
        })
    }

    /// Identity of the settings that the table was made with: 16 hexadecimal digits.
    #[must_use]
    pub fn id(&self) -> &str {
        &self.id
    }

    /// Version of the format in memory: that of this program, whatever older version the file had.
    #[must_use]
    pub fn format_version(&self) -> &str {
        schema::FORMAT_VERSION_VALUE
    }

    /// Poisson ratios tabulated, ascending.
    #[must_use]
    pub fn poisson_ratios(&self) -> &[f64] {
        &self.poisson_ratios
    }

    /// Width of a time cell in r0/c1 at a Poisson ratio, see [`cell_scale`].
    ///
    /// # Errors
    /// [`LookupError::Domain`] for a ratio outside (-1, 0.5).
    pub fn cell_width(&self, poisson_ratio: f64) -> Result<f64, LookupError> {
        Ok(self.content.cell_width * cell_scale(poisson_ratio)?)
    }

    /// Largest radius in r0; the smallest is 0.
    #[must_use]
    pub fn r_max(&self) -> f64 {
        self.content.r_max
    }

    /// Largest depth in r0; the smallest is 0.
    #[must_use]
    pub fn z_max(&self) -> f64 {
        self.content.z_max
    }

    /// Everything that the table holds.
    #[must_use]
    pub fn content(&self) -> &Content {
        &self.content
    }

    /// Gives the content back.
    #[must_use]
    pub fn into_content(self) -> Content {
        self.content
    }

    /// Slices that serve a Poisson ratio, with their weights.
    pub(crate) fn slice_weights(
        &self,
        poisson_ratio: f64,
    ) -> Result<Vec<(usize, f64)>, LookupError> {
        ratio::weights(&self.served, poisson_ratio)?.ok_or_else(|| {
            let grid = self.served.iter().filter(|slice| slice.role == Role::Grid);
            let (min, max) = grid.fold((f64::NAN, f64::NAN), |(min, max), slice| {
                (slice.ratio.min(min), slice.ratio.max(max))
            });
            LookupError::Outside {
                axis: "poisson_ratio",
                value: poisson_ratio,
                min,
                max,
            }
        })
    }

    /// Coordinate of slice `index` across Poisson's ratios.
    pub(crate) fn coordinate(&self, index: usize) -> f64 {
        self.served[index].coordinate
    }

    /// What was measured between the slices around a ratio.
    pub(crate) fn between(&self, poisson_ratio: f64) -> Option<&Between> {
        ratio::between(&self.content, &self.served, poisson_ratio)
    }

    /// The exact kernels of slice `index`.
    pub(crate) fn kernel(&self, index: usize) -> &Kernel {
        &self.kernels[index]
    }

    /// Numbers of meshes served in r and z.
    pub(crate) fn meshes(&self) -> [usize; 2] {
        self.meshes
    }

    /// The mesh that holds a point.
    ///
    /// # Errors
    /// [`LookupError::Outside`].
    pub(crate) fn mesh(&self, r: f64, z: f64) -> Result<(usize, usize), LookupError> {
        let [columns, rows] = self.meshes;
        let i = locate(&self.content.r[..=columns], r);
        let k = locate(&self.content.z[..=rows], z);
        i.zip(k).ok_or_else(|| self.outside(r, z))
    }

    /// The error of a point outside: axis, value and range.
    fn outside(&self, r: f64, z: f64) -> LookupError {
        let (axis, value, max) = if r >= 0.0 && r <= self.r_max() {
            ("z/r0", z, self.z_max())
        } else {
            ("r/r0", r, self.r_max())
        };
        LookupError::Outside {
            axis,
            value,
            min: 0.0,
            max,
        }
    }
}

fn validate(content: &Content) -> Result<(), TableError> {
    axis("r", &content.r)?;
    axis("z", &content.z)?;
    for (name, nodes, max) in [
        ("r", &content.r, content.r_max),
        ("z", &content.z, content.z_max),
    ] {
        if !nodes.contains(&max) || centres(nodes, max).is_empty() {
            return Err(value(format!("{name}_max"), max, "one of the nodes but 0"));
        }
    }
    positive("cell_width", content.cell_width)?;
    ascending("pulse_length", &content.pulse_lengths)?;
    if content.pulse_lengths.is_empty() {
        return Err(shape("pulse_length", 1, 0));
    }
    if !(2..=crate::stencil::MAX_POINTS).contains(&content.stencil_points)
        || content.stencil_points % 2 == 1
    {
        return Err(value(
            "stencil_points",
            content.stencil_points as f64,
            "2, 4, 6 or 8",
        ));
    }
    for (name, length) in [("r", content.r.len()), ("z", content.z.len())] {
        if length < content.stencil_points {
            return Err(shape(name, content.stencil_points, length));
        }
    }
    if content.slices.is_empty() {
        return Err(shape("slices", 1, 0));
    }
    let ratios: Vec<f64> = content
        .slices
        .iter()
        .map(|slice| slice.poisson_ratio)
        .collect();
    ascending("poisson_ratio", &ratios)?;
    for slice in &content.slices {
        validate_slice(content, slice)?;
        // Slices are interpolated cell by cell.
        let (cells, first) = (slice.cells, content.slices[0].cells);
        if cells != first {
            let group = schema::slice_name(slice.poisson_ratio);
            return Err(shape(format!("slices/{group}/time"), first, cells));
        }
    }
    let places = content.between_r.len() * content.between_z.len();
    if places > 0 {
        ascending("between_r", &content.between_r)?;
        ascending("between_z", &content.between_z)?;
    }
    content.between.iter().try_for_each(|between| {
        let group = format!("between/{}", schema::slice_name(between.poisson_ratio));
        validate_probes(content, &group, &between.verification, places.max(1))
    })
}

fn validate_slice(content: &Content, slice: &Slice) -> Result<(), TableError> {
    let nodes = content.r.len() * content.z.len();
    let group = format!("slices/{}", schema::slice_name(slice.poisson_ratio));
    let stored = nodes * FIELDS * slice.cells.max(1);
    let terms = slice.tail_terms(nodes);
    for (dataset, array, needed) in [
        (schema::REMAINDER, &slice.remainder, stored),
        (schema::MOMENT, &slice.moment, stored),
        (schema::CURVATURE, &slice.curvature, stored),
        (schema::TAIL, &slice.tail, nodes * FIELDS * terms.max(1)),
    ] {
        let each = array.len() / nodes;
        numbers(&group, dataset, array, needed).map_err(|error| match error {
            TableError::Value { value, range, .. } => {
                let bad = array.iter().position(|x| !x.is_finite()).unwrap_or(0);
                let node = bad / each.max(1);
                let (i, k) = (node / content.z.len(), node % content.z.len());
                TableError::Value {
                    item: format!(
                        "{group}/{dataset} (r/r0 = {}, z/r0 = {})",
                        content.r[i], content.z[k]
                    ),
                    value,
                    range,
                }
            }
            other => other,
        })?;
    }
    let probes = content.probes().map(|places| places.len()).iter().product();
    validate_probes(content, &group, &slice.verification, probes)
}

fn validate_probes(
    content: &Content,
    group: &str,
    probes: &Verification,
    places: usize,
) -> Result<(), TableError> {
    let needed = places * content.pulse_lengths.len() * FIELDS;
    for (dataset, array) in [
        (schema::PROBE_DIRECT, &probes.direct),
        (schema::PROBE_LOOKED_UP, &probes.looked_up),
        (schema::PROBE_ERROR, &probes.error),
    ] {
        numbers(group, dataset, array, needed)?;
    }
    Ok(())
}

/// So many numbers, all finite.
fn numbers(group: &str, dataset: &str, array: &[f32], needed: usize) -> Result<(), TableError> {
    let name = || format!("{group}/{dataset}");
    if array.len() != needed {
        return Err(shape(name(), needed, array.len()));
    }
    match array.iter().position(|x| !x.is_finite()) {
        Some(index) => {
            let item = format!("{}[{index}]", name());
            Err(value(item, f64::from(array[index]), "finite numbers"))
        }
        None => Ok(()),
    }
}

fn axis(name: &'static str, nodes: &[f64]) -> Result<(), TableError> {
    ascending(name, nodes)?;
    match nodes.first() {
        Some(&first) if first != 0.0 => Err(value(format!("{name}[0]"), first, "0")),
        _ => Ok(()),
    }
}

fn ascending(name: &'static str, values: &[f64]) -> Result<(), TableError> {
    for (index, &x) in values.iter().enumerate() {
        if !x.is_finite() || index > 0 && x <= values[index - 1] {
            return Err(value(
                format!("{name}[{index}]"),
                x,
                "finite, strictly ascending",
            ));
        }
    }
    Ok(())
}

fn positive(name: &'static str, x: f64) -> Result<(), TableError> {
    if x > 0.0 && x.is_finite() {
        Ok(())
    } else {
        Err(value(name, x, "(0, inf)"))
    }
}

fn value(item: impl Into<String>, value: f64, range: &'static str) -> TableError {
    TableError::Value {
        item: item.into(),
        value,
        range,
    }
}

fn shape(item: impl Into<String>, needed: usize, found: usize) -> TableError {
    TableError::Shape {
        item: item.into(),
        needed,
        found,
    }
}
