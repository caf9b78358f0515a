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
        let arrival = (r - 1.0).max(0.0).hypot(z);
        let quiet = ((arrival / self.width) as usize).min(self.cells);
        let quantum = quantum(&rest);
        for j in quiet..self.cells {
            let moment = match smooth_moment(&point.averages, j, &quantum) {
                Some(moment) => moment,
                None => self.moment(r, z, j)?,
            };
            point.moments[j] =
                std::array::from_fn(|f| (moment[f] / quantum[f]).round() * quantum[f]);
        }
        self.tail(r, z, &mut point)?;
        self.check(r, z, &point)?;
        Ok(point)
    }

    /// First moment of cell `j` from the integral S of R and the integral of S, also where a front crosses
    /// it: width (S_0 + S_1)/2 - int S dt, over width^2.
    fn moment(&self, r: f64, z: f64, j: usize) -> Result<Six, BuildError> {
        let (start, end) = (j as f64 * self.width, (j + 1) as f64 * self.width);
        let first = [start, end].map(|t| self.kernel.step_integral(r, z, t));
        let second = [start, end].map(|t| self.kernel.second_integral(r, z, t));
        let ([from, to], [below, above]) = (first, second);
        let (from, to, below, above) = (from?.value, to?.value, below?.value, above?.value);
        Ok(std::array::from_fn(|f| {
            // relative to S at the start, which may hold a large constant
            let trapezoid = 0.5 * self.width * (to[f] - from[f]);
            let area = above[f] - below[f] - self.width * from[f];
            (trapezoid - area) / (self.width * self.width)
        }))
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

/// First moment of cell `j` to fourth order from the averages around it, where R is smooth over five cells.
fn smooth_moment(averages: &[Six], j: usize, quantum: &Six) -> Option<Six> {
    if j < 2 || j + 2 >= averages.len() {
        return None;
    }
    let mut moment = [0.0; 6];
    for f in 0..6 {
        let near = averages[j + 1][f] - averages[j - 1][f];
        let far = averages[j + 2][f] - averages[j - 2][f];
        moment[f] = near * 41.0 / 720.0 - far * 11.0 / 1440.0;
        if (moment[f] - near / 24.0).abs() > 8.0 * quantum[f] {
            return None;
        }
    }
    Some(moment)
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
