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
/// Halvings of a cell that a front crosses.
const DEEPEST: u32 = 6;

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
                None => self.moment(r, z, j, &quantum)?,
            };
            point.moments[j] =
                std::array::from_fn(|f| (moment[f] / quantum[f]).round() * quantum[f]);
        }
        self.tail(r, z, &mut point)?;
        self.check(r, z, &point)?;
        Ok(point)
    }

    fn integral(&self, r: f64, z: f64, t: f64) -> Result<Six, BuildError> {
        Ok(self.kernel.step_integral(r, z, t)?.value)
    }

    /// First moment of cell `j` from the integral S of R, also where a front crosses it:
    /// width (S_0 + S_1)/2 - int S dt, over width^2.
    fn moment(&self, r: f64, z: f64, j: usize, quantum: &Six) -> Result<Six, BuildError> {
        let (start, end) = (j as f64 * self.width, (j + 1) as f64 * self.width);
        let from = self.integral(r, z, start)?;
        let middle = self.integral(r, z, 0.5 * (start + end))?;
        let to = self.integral(r, z, end)?;
        let area = self.area(r, z, [start, end], [from, middle, to], quantum, DEEPEST)?;
        Ok(std::array::from_fn(|f| {
            // Relative to S at the start, which may hold a large constant.
            let trapezoid = 0.5 * self.width * (to[f] - from[f]);
            (trapezoid - (area[f] - self.width * from[f])) / (self.width * self.width)
        }))
    }

    /// int S dt over [a, b] by adaptive Simpson.
    fn area(
        &self,
        r: f64,
        z: f64,
        [a, b]: [f64; 2],
        [first, middle, last]: [Six; 3],
        quantum: &Six,
        depth: u32,
    ) -> Result<Six, BuildError> {
        let quarter = 0.25 * (b - a);
        let left = self.integral(r, z, a + quarter)?;
        let right = self.integral(r, z, b - quarter)?;
        let (mut sum, mut agree) = ([0.0; 6], true);
        for f in 0..6 {
            let coarse = (b - a) / 6.0 * (first[f] + 4.0 * middle[f] + last[f]);
            let fine = (b - a) / 12.0
                * (first[f] + 4.0 * left[f] + 2.0 * middle[f] + 4.0 * right[f] + last[f]);
            sum[f] = fine + (fine - coarse) / 15.0;
            agree &= (fine - coarse).abs() < quantum[f] * self.width * self.width;
        }
        if agree || depth == 0 {
            return Ok(sum);
        }
        let half = a + 2.0 * quarter;
        let lower = self.area(r, z, [a, half], [first, left, middle], quantum, depth - 1)?;
        let upper = self.area(r, z, [half, b], [middle, right, last], quantum, depth - 1)?;
        Ok(std::array::from_fn(|f| lower[f] + upper[f]))
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
