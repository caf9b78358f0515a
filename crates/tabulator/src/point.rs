//! All numbers of one point: cell averages, first moments and tail.

use crate::error::BuildError;
use crate::tail_fit::TailFit;
use halfspace::{Kernel, Medium, Profile, Six};

/// What is asked of every point of a slice.
#[derive(Debug, Clone)]
pub struct PointPlan {
    kernel: Kernel,
    width: f64,
    cells: usize,
    fit: TailFit,
}

/// The numbers of one point in double precision, field by field.
#[derive(Debug, Clone)]
pub struct PointKernels {
    /// Cell averages of R.
    pub averages: Vec<Six>,
    /// First moments of R in each cell.
    pub moments: Vec<Six>,
    /// Tail coefficients.
    pub tail: Vec<Six>,
}

/// Moments are computed and stored to this share of the largest static displacement or stress there:
/// they enter with the second difference of the force, far below one.
const MOMENT_SHARE: f64 = 1e-5;

impl PointPlan {
    /// Plan for `cells` cells of `width` at one Poisson ratio.
    ///
    /// # Errors
    /// [`BuildError::Domain`] when the exact kernels refuse the ratio or the tolerance.
    pub fn new(
        poisson_ratio: f64,
        tolerance: f64,
        width: f64,
        cells: usize,
        tail_terms: usize,
    ) -> Result<Self, BuildError> {
        let kernel = Kernel::new(&Medium::new(poisson_ratio)?, Profile::Hertz, tolerance)?;
        Ok(Self {
            kernel,
            width,
            cells,
            fit: TailFit::new(tail_terms),
        })
    }

    /// The exact kernels.
    #[must_use]
    pub fn kernel(&self) -> &Kernel {
        &self.kernel
    }

    /// Computes the numbers of the point (r, z).
    ///
    /// # Errors
    /// [`BuildError`] when the exact kernels refuse the point or a value is not finite.
    pub fn compute(&self, r: f64, z: f64) -> Result<PointKernels, BuildError> {
        let mut point = PointKernels {
            averages: vec![[0.0; 6]; self.cells],
            moments: vec![[0.0; 6]; self.cells],
            tail: Vec::new(),
        };
        self.kernel
            .cell_averages(r, z, self.width, &mut point.averages)?;
        let rest = self.kernel.static_field(r, z)?;
        let quantum = quantum(&rest);
        let PointKernels {
            averages, moments, ..
        } = &mut point;
        self.kernel
            .cell_moments(r, z, self.width, averages, &quantum, moments)?;
        for moment in moments {
            for (m, q) in moment.iter_mut().zip(quantum) {
                *m = (*m / q).round() * q;
            }
        }
        self.tail(r, z, &mut point)?;
        self.check(r, z, &point)?;
        Ok(point)
    }

    fn tail(&self, r: f64, z: f64, point: &mut PointKernels) -> Result<(), BuildError> {
        let end = self.cells as f64 * self.width;
        let mut samples: [Vec<f64>; 6] = Default::default();
        for &u in self.fit.samples() {
            let value = self.kernel.remainder(r, z, end / u)?.value;
            for (list, x) in samples.iter_mut().zip(value) {
                list.push(x);
            }
        }
        for (f, list) in samples.iter().enumerate() {
            for (k, c) in self.fit.coefficients(list).enumerate() {
                if point.tail.len() <= k {
                    point.tail.push([0.0; 6]);
                }
                point.tail[k][f] = c;
            }
        }
        Ok(())
    }

    fn check(&self, r: f64, z: f64, point: &PointKernels) -> Result<(), BuildError> {
        for (quantity, values) in [
            ("cell average", &point.averages),
            ("moment", &point.moments),
            ("tail", &point.tail),
        ] {
            for value in values {
                if let Some(f) = value.iter().position(|x| !x.is_finite()) {
                    return Err(BuildError::NotFinite {
                        poisson_ratio: self.kernel.medium().poisson_ratio(),
                        r,
                        z,
                        quantity,
                        field: lookup::schema::FIELD_NAMES[f],
                    });
                }
            }
        }
        Ok(())
    }
}

/// Step to which moments are rounded: a power of two near [`MOMENT_SHARE`] of the local scale.
///
/// Away from fronts most of their digits are then zero and cost nothing in a compressed file.
fn quantum(rest: &Six) -> Six {
    let displacement = rest[0].abs().max(rest[1].abs());
    let stress = rest[2..].iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    std::array::from_fn(|f| {
        let scale = if f < 2 { displacement } else { stress };
        (MOMENT_SHARE * scale.max(1e-6)).log2().floor().exp2()
    })
}
