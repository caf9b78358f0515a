//! One slice from several: numbers interpolated at a Poisson ratio, with the errors that go with them.

use crate::certificate::{Added, SAFETY};
use crate::content::{Content, FIELDS, Role, Slice, Verification};
use crate::error::ContentError;
use crate::ratio::{self, Served};
use crate::validate;

/// A weighted sum of slices, of which one at a time is in memory.
pub(super) struct Blend<'a> {
    content: &'a Content,
    served: &'a [Served],
    poisson_ratio: f64,
    /// Numbers of cells and terms of the first slice, which the others have as well.
    size: Option<[usize; 2]>,
    /// Sums of averages, moments, curvatures and tails.
    sums: [Vec<f64>; 4],
    coordinates: Vec<f64>,
    beside: Vec<(f64, Verification)>,
}

impl<'a> Blend<'a> {
    /// Nothing yet, at a ratio that slices of the axes of `content` serve.
    pub(super) fn new(content: &'a Content, served: &'a [Served], poisson_ratio: f64) -> Self {
        Self {
            content,
            served,
            poisson_ratio,
            size: None,
            sums: Default::default(),
            coordinates: Vec::new(),
            beside: Vec::new(),
        }
    }

    /// Adds the slice of index `index` among those served; a number that is not finite is found in the sum.
    ///
    /// # Errors
    /// [`ContentError`] when it does not fit the axes or the slices before it.
    pub(super) fn add(
        &mut self,
        index: usize,
        weight: f64,
        slice: Slice,
    ) -> Result<(), ContentError> {
        let size = validate::size(self.content, &slice);
        validate::same_size(self.content, &slice, *self.size.get_or_insert(size))?;
        validate::fits(self.content, &slice)?;
        for (sum, (_, values)) in self.sums.iter_mut().zip(slice.lists()) {
            sum.resize(values.len(), 0.0);
            for (s, &value) in sum.iter_mut().zip(values) {
                *s += weight * f64::from(value);
            }
        }
        let distance = slice.poisson_ratio - self.poisson_ratio;
        self.coordinates.push(self.served[index].coordinate);
        self.beside.push((distance, slice.verification));
        Ok(())
    }

    /// The slice at the ratio.
    ///
    /// # Errors
    /// [`ContentError`] for a ratio outside the physics, or when nothing was added.
    pub(super) fn finish(mut self) -> Result<Slice, ContentError> {
        let verification = self.errors()?;
        let [remainder, moment, curvature, tail] = self
            .sums
            .map(|sum| sum.into_iter().map(|x| x as f32).collect());
        Ok(Slice {
            poisson_ratio: self.poisson_ratio,
            role: Role::Exact,
            cells: self.size.map_or(0, |[cells, _]| cells),
            remainder,
            moment,
            curvature,
            tail,
            verification,
        })
    }

    /// Errors of the interpolated numbers: the larger of the slices beside and, in proportion to the node polynomial,
    /// what was measured between them.
    fn errors(&mut self) -> Result<Verification, ContentError> {
        let mut found = larger_beside(std::mem::take(&mut self.beside));
        let content = self.content;
        let Some(between) = ratio::between(content, self.served, self.poisson_ratio) else {
            return Ok(found);
        };
        let added = Added::new(content, between, &self.coordinates, self.poisson_ratio)?;
        let [across, down] = content.probes();
        let places = across
            .iter()
            .flat_map(|&r| down.iter().map(move |&z| (r, z)));
        let pulses = content.pulse_lengths.len();
        for (place, (r, z)) in places.enumerate() {
            let around = added.around([r, z]);
            for pulse in 0..pulses {
                for field in 0..FIELDS {
                    let index = (place * pulses + pulse) * FIELDS + field;
                    found.error[index] += (added.most(&around, pulse, field) / SAFETY) as f32;
                }
            }
        }
        Ok(found)
    }
}

/// The larger of the errors of the two slices beside a ratio, and of their peaks; each with its distance from it.
fn larger_beside(mut slices: Vec<(f64, Verification)>) -> Verification {
    slices.sort_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
    let above = slices.iter().position(|(distance, _)| *distance > 0.0);
    let below = slices.iter().position(|(distance, _)| *distance < 0.0);
    let mut beside = [above, below].into_iter().flatten().map(|i| &slices[i].1);
    let mut found = beside.next().cloned().unwrap_or_default();
    for slice in beside {
        for (i, &error) in slice.error.iter().enumerate() {
            found.error[i] = found.error[i].max(error);
            if slice.direct[i].abs() > found.direct[i].abs() {
                (found.direct[i], found.looked_up[i]) = (slice.direct[i], slice.looked_up[i]);
            }
        }
    }
    found
}
