//! The mean of fields over a face, from those at points or by the means of the kernels.
//!
//! Theory: `docs/theory.md` (T71).

use super::discs::Discs;
use super::loads::Forcing;
use super::sums::{PointKernels, Sums};
use super::{Convolution, Trace, tuning};
use crate::error::ImpactError;
use crate::face::{FaceDiscs, MeanPlan};
use crate::kernels::{Cells, KernelSource};
use crate::quantity::Quantity;
use halfspace::{Arc, Face, Six};
use rayon::prelude::*;

/// A face at a depth, in m.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FaceAt {
    pub(crate) r_m: f64,
    pub(crate) z_m: f64,
    pub(crate) radius_m: f64,
}

impl FaceAt {
    /// Its nearest place to the load.
    fn nearest_m(self) -> [f64; 2] {
        [(self.r_m - self.radius_m).max(0.0), self.z_m]
    }

    /// In a unit of length.
    fn over(self, unit_m: f64) -> Result<Face, ImpactError> {
        Ok(Face::new(self.r_m / unit_m, self.radius_m / unit_m)?)
    }
}

impl Convolution<'_> {
    /// The means of the six fields over a face and then of the rates among the quantities, Cartesian at its centre.
    ///
    /// # Errors
    /// [`ImpactError`] for a part of the face outside the half-space or the table.
    pub(crate) fn mean(&self, face: FaceAt, plan: &MeanPlan) -> Result<Vec<Trace>, ImpactError> {
        match *plan {
            MeanPlan::Point => self.at(face.r_m, face.z_m),
            MeanPlan::Exact => self.exact_mean(face),
            MeanPlan::Discs(ref discs) => {
                let mut found = self.by_discs(face, discs)?;
                for trace in &mut found {
                    trace.error += discs.error * trace.peak().abs();
                }
                Ok(found)
            }
            MeanPlan::Circles(count, error) if error.is_finite() => {
                let mut found = self.mean_of(face, count)?;
                for trace in &mut found {
                    trace.error += error * trace.peak().abs();
                }
                Ok(found)
            }
            MeanPlan::Circles(count, _) => {
                let coarse = self.mean_of(face, count / 2)?;
                let mut found = self.mean_of(face, count)?;
                for (trace, coarse) in found.iter_mut().zip(coarse) {
                    let apart = trace.samples.iter().zip(coarse.samples);
                    let apart = apart.map(|(one, other)| (one - other).abs());
                    trace.error += apart.fold(0.0, f64::max);
                }
                Ok(found)
            }
        }
    }

    /// A sum over circles.
    fn mean_of(&self, face: FaceAt, count: usize) -> Result<Vec<Trace>, ImpactError> {
        let mut sum: Vec<Trace> = Vec::new();
        let arcs = face.over(1.0)?.arcs(count);
        let found = (arcs.par_iter()).map(|arc| self.at(arc.r, face.z_m));
        let found: Vec<Vec<Trace>> = found.collect::<Result<_, _>>()?;
        for (arc, own) in arcs.iter().zip(found) {
            if sum.is_empty() {
                let blank = |trace: &Trace| Trace::new(vec![0.0; trace.samples.len()], 0.0);
                sum = own.iter().map(blank).collect();
            }
            self.add(arc, &own, &mut sum);
        }
        Ok(sum)
    }

    /// Adds the fields on a circle, and their errors as if they had one sign.
    fn add(&self, arc: &Arc, own: &[Trace], sum: &mut [Trace]) {
        for i in 0..own[0].samples.len() {
            let mut mean = Six::default();
            arc.add(&std::array::from_fn(|f| own[f].samples[i]), &mut mean);
            for (sum, mean) in sum.iter_mut().zip(mean) {
                sum.samples[i] += mean;
            }
        }
        let mut errors = Six::default();
        arc.add(&std::array::from_fn(|f| own[f].error), &mut errors);
        for (sum, error) in sum.iter_mut().zip(errors) {
            sum.error += error.abs();
        }
        for (k, quantity) in self.quantities.iter().enumerate() {
            let (own, sum) = (&own[6 + k], &mut sum[6 + k]);
            let weight = match quantity {
                Quantity::VelocityR | Quantity::AccelerationR => arc.odd,
                _ => arc.even,
            };
            for (sum, own) in sum.samples.iter_mut().zip(&own.samples) {
                *sum += weight * own;
            }
            sum.error += weight.abs() * own.error;
        }
    }

    /// By larger discs that stand for the load and the face, at the centre of the face.
    fn by_discs(&self, face: FaceAt, stand_in: &FaceDiscs) -> Result<Vec<Trace>, ImpactError> {
        let unit_m = self.grid.excitation.units().disc_radius_m;
        let radii: Vec<f64> = stand_in.radii_m.iter().map(|x| x / unit_m).collect();
        let discs = Discs::with_shares(&radii, &stand_in.shares);
        let place_m = [face.r_m, face.z_m];
        let ratio = self.grid.excitation.medium().poisson_ratio();
        let cells = radii.iter().map(|&over| {
            let (place, disc_radius_m, wanted) = self.wanted_of(place_m, over, tuning::KERNELS);
            self.source.cells(ratio, place, disc_radius_m, wanted)
        });
        let cells: Vec<Cells> = cells.collect::<Result<_, _>>()?;
        self.summed(&discs, (face.nearest_m(), None), cells)
    }

    /// The fields and quantities by the kernels of discs that do not follow the load.
    fn summed(
        &self,
        discs: &Discs,
        nearest_m: ([f64; 2], Option<[f64; 2]>),
        cells: Vec<Cells>,
    ) -> Result<Vec<Trace>, ImpactError> {
        let kernels = PointKernels::new(&self.forcings[0], discs, nearest_m, cells);
        let of = |forcing: &Forcing<'_>| {
            let loads = forcing.loads_of(discs);
            let mut sums = Sums::new(forcing, &loads, &kernels)?;
            sums.integrate_zones(forcing, &loads, &kernels, |_| false);
            Ok(self.traces(forcing, &sums))
        };
        let sums = self.forcings.iter().map(of);
        let sums: Vec<[Trace; 6]> = sums.collect::<Result<_, ImpactError>>()?;
        Ok(self.with_quantities(sums))
    }

    /// By the mean of the kernel of a disc of fixed radius.
    fn exact_mean(&self, face: FaceAt) -> Result<Vec<Trace>, ImpactError> {
        let FaceAt { r_m, z_m, .. } = face;
        let KernelSource::Direct(kernel) = self.source else {
            return self.mean_of(face, 1);
        };
        let discs = self.sets.get(0);
        // until the last front has left the face
        let farthest_m = [r_m + face.radius_m, z_m];
        let (_, disc_radius_m, wanted) = self.wanted_of(farthest_m, discs.radii[0], 1.0);
        let domain = |source| ImpactError::OutsideBlock { r_m, z_m, source };
        let (over, z) = (face.over(disc_radius_m)?, z_m / disc_radius_m);
        let static_part = kernel.static_mean(&over, z).map_err(domain)?;
        let trace = wanted.trace(&static_part, |end, wanted| {
            kernel.mean_trace_under(&over, z, end, wanted)
        });
        let trace = trace.map_err(domain)?;
        let cells = Cells::of_trace(trace, static_part, &wanted);
        self.summed(
            discs,
            (face.nearest_m(), None),
            vec![cells.map_err(domain)?],
        )
    }
}
