//! A kernel table in memory: validated once, immutable, shared by any number of threads.

use crate::content::{Content, FIELDS, Slice, centres};
use crate::error::{LookupError, TableError};
use crate::ratio::ratio_coordinate;
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
    ratio_coordinates: Vec<f64>,
    kernels: Vec<Kernel>,
}

impl Table {
    /// Reads the table at `path` into memory and validates it.
    ///
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
        let ratio_coordinates = content
            .slices
            .iter()
            .map(|slice| ratio_coordinate(slice.poisson_ratio))
            .collect::<Result<_, _>>()?;
        Ok(Self {
            id: hash::settings_id(&content.origin.grid),
            poisson_ratios: content
                .slices
                .iter()
                .map(|slice| slice.poisson_ratio)
                .collect(),
            ratio_coordinates,
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

    /// Width of a time cell in r0/c1.
    #[must_use]
    pub fn cell_width(&self) -> f64 {
        self.content.cell_width
    }

    /// Largest radius in r0; the smallest is 0.
    #[must_use]
    pub fn r_max(&self) -> f64 {
        self.content.r[self.content.r.len() - 1]
    }

    /// Largest depth in r0; the smallest is 0.
    #[must_use]
    pub fn z_max(&self) -> f64 {
        self.content.z[self.content.z.len() - 1]
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

    /// [`ratio_coordinate`] of each slice.
    pub(crate) fn ratio_coordinates(&self) -> &[f64] {
        &self.ratio_coordinates
    }

    /// The exact kernels of slice `index`.
    pub(crate) fn kernel(&self, index: usize) -> &Kernel {
        &self.kernels[index]
    }

    /// The error of a point outside: axis, value and range.
    pub(crate) fn outside(&self, r: f64, z: f64) -> LookupError {
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
    content
        .slices
        .iter()
        .try_for_each(|slice| validate_slice(content, slice))
}

fn validate_slice(content: &Content, slice: &Slice) -> Result<(), TableError> {
    let nodes = content.r.len() * content.z.len();
    let probes = centres(&content.r).len()
        * centres(&content.z).len()
        * content.pulse_lengths.len()
        * FIELDS;
    let name = |dataset| {
        format!(
            "slices/{}/{dataset}",
            schema::slice_name(slice.poisson_ratio)
        )
    };
    let terms = slice.tail_terms(nodes);
    for (dataset, array, needed) in [
        (
            schema::REMAINDER,
            &slice.remainder,
            nodes * FIELDS * slice.cells.max(1),
        ),
        (
            schema::MOMENT,
            &slice.moment,
            nodes * FIELDS * slice.cells.max(1),
        ),
        (schema::TAIL, &slice.tail, nodes * FIELDS * terms.max(1)),
        (schema::PROBE_DIRECT, &slice.verification.direct, probes),
        (
            schema::PROBE_LOOKED_UP,
            &slice.verification.looked_up,
            probes,
        ),
        (schema::PROBE_ERROR, &slice.verification.error, probes),
    ] {
        if array.len() != needed {
            return Err(shape(name(dataset), needed, array.len()));
        }
        if let Some(index) = array.iter().position(|x| !x.is_finite()) {
            let item = format!("{}[{index}]", name(dataset));
            return Err(value(item, f64::from(array[index]), "finite numbers"));
        }
    }
    Ok(())
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
