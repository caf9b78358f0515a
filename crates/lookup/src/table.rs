//! Kernel table in memory: validated once, immutable, shared by any number of threads.

use crate::content::Content;
use crate::error::{ContentError, LookupError};
use crate::ratio::{Served, cell_scale};
use crate::series::stencil::locate;
use crate::{hash, validate};

/// A loaded kernel table.
///
/// Lookups take no lock and change nothing: share a table by reference or in an `Arc`.
#[derive(Debug)]
pub struct Table {
    content: Content,
    id: String,
    /// Poisson's ratios and roles of the slices.
    pub(crate) served: Vec<Served>,
    /// Indices in r and z of the first mesh, and after the last one, that can be looked up; the first is not 0 for some
    /// parts.
    first: [usize; 2],
    pub(crate) meshes: [usize; 2],
    decoded_bytes: u64,
    reach: [f64; 2],
}

impl Table {
    /// A table with this content.
    ///
    /// # Errors
    /// [`ContentError`] if an axis does not ascend, a list has the wrong length, or a value is not finite.
    pub fn new(content: Content) -> Result<Self, ContentError> {
        validate::frame(&content)?;
        let reach = [content.r_max, content.z_max];
        Self::part(content, [0; 2], 0, reach)
    }

    /// A table with a part of the content of another: the meshes from `first` on in r and z, of a table that ends at
    /// `reach`.
    /// The frame of `content` is valid.
    pub(crate) fn part(
        content: Content,
        first: [usize; 2],
        decoded_bytes: u64,
        reach: [f64; 2],
    ) -> Result<Self, ContentError> {
        validate::slices(&content)?;
        let slices = content.slices.iter();
        let served = slices.map(|slice| Served::new(slice.poisson_ratio, slice.role));
        let served = served.collect::<Result<_, _>>()?;
        let meshes = content.probes().map(|places| places.len());
        Ok(Self {
            first,
            meshes,
            decoded_bytes,
            reach,
            id: hash::settings_id(&content.origin.grid),
            served,
            content,
        })
    }

    /// Hash of the settings of the table, 16 hexadecimal digits.
    pub fn id(&self) -> &str {
        &self.id
    }

    /// Bytes of numbers that were decoded to load this part of a file; 0 for any other table.
    pub fn decoded_bytes(&self) -> u64 {
        self.decoded_bytes
    }

    /// Largest r and z of the table in r0; for a part, of the whole table.
    pub fn reach(&self) -> [f64; 2] {
        self.reach
    }

    /// Tabulated Poisson ratios, ascending.
    pub fn poisson_ratios(&self) -> Vec<f64> {
        self.served.iter().map(|slice| slice.ratio).collect()
    }

    /// Width of a time cell in r0/c1 at a Poisson ratio, see [`cell_scale`].
    ///
    /// # Errors
    /// [`LookupError::Domain`] for a ratio outside (-1, 0.5).
    pub fn cell_width(&self, poisson_ratio: f64) -> Result<f64, LookupError> {
        Ok(self.content.cell_width * cell_scale(poisson_ratio)?)
    }

    /// Content of the table.
    pub fn content(&self) -> &Content {
        &self.content
    }

    /// Converts the table to its content.
    pub fn into_content(self) -> Content {
        self.content
    }

    /// Index in r and z of the mesh that contains a point.
    ///
    /// # Errors
    /// [`LookupError::Outside`].
    pub(crate) fn mesh(&self, [r, z]: [f64; 2]) -> Result<[usize; 2], LookupError> {
        let content = &self.content;
        let mut mesh = [0; 2];
        let axes = [("r/r0", &content.r, r), ("z/r0", &content.z, z)];
        for (axis, (name, nodes, value)) in axes.into_iter().enumerate() {
            let (first, last) = (self.first[axis], self.meshes[axis]);
            let found = locate(&nodes[first..=last], value);
            let outside = || LookupError::outside(name, value, [0.0, nodes[last]]);
            mesh[axis] = first + found.ok_or_else(outside)?;
        }
        Ok(mesh)
    }
}
