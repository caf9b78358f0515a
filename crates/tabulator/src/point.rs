//! All numbers of one point: cell averages, first and second moments, and the tail.

use crate::error::BuildError;
use crate::grid::Grid;
use halfspace::{Kernel, Medium, Profile, Six};
use lookup::{Moments, Numbers};
use std::f64::consts::PI;

/// Specification of the numbers at every point of a slice; lengths in r0, times in r0/c1.
#[derive(Debug, Clone)]
pub struct PointPlan {
    kernel: Kernel,
    width: f64,
    cells: usize,
    tail_terms: usize,
}

/// Relative accuracy of moments; it can be low, since they are multiplied with the second difference of the force,
/// which is far below one.
const MOMENT_ACCURACY: f64 = 1e-5;

/// Ratio of the tolerance of the trace to that of the kernels. Most errors of averages are a hundredth of the
/// tolerance, so that at 25 times 1e-8 the 99th percentile stays below the rounding to single precision.
const TRACE: f64 = 25.0;

/// Ratio of the tolerance at the verification probes to that at the nodes. The error of the probes adds to the measured
/// errors: a ratio of 30 affects errors of 1e-8, a ratio of 100 errors of 1e-7.
const PROBE_TOLERANCE: f64 = 30.0;

impl Grid {
    /// The plan for the nodes of a slice.
    ///
    /// # Errors
    /// [`BuildError::Domain`] if the exact kernels reject the ratio.
    pub fn point(&self, poisson_ratio: f64) -> Result<PointPlan, BuildError> {
        self.plan(poisson_ratio, self.tolerance)
    }

    /// The plan for the verification probes of a slice, which need fewer digits.
    pub(crate) fn probe(&self, poisson_ratio: f64) -> Result<PointPlan, BuildError> {
        self.plan(poisson_ratio, (PROBE_TOLERANCE * self.tolerance).min(0.1))
    }

    fn plan(&self, poisson_ratio: f64, tolerance: f64) -> Result<PointPlan, BuildError> {
        let width = self.cell_width * lookup::cell_scale(poisson_ratio)?;
        let (cells, terms) = (self.cells()?, self.tail_terms);
        PointPlan::new(poisson_ratio, tolerance, width, cells, terms)
    }
}

impl PointPlan {
    /// Plan for `cells` cells of `width` at one Poisson ratio.
    ///
    /// # Errors
    /// [`BuildError::Domain`] if the exact kernels reject the ratio or the tolerance.
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
            tail_terms,
        })
    }

    /// The exact kernels.
    pub fn kernel(&self) -> &Kernel {
        &self.kernel
    }

    /// Computes the numbers of the point (r, z).
    ///
    /// Between the fronts R is a series of polynomials, and averages and moments are its integrals.
    ///
    /// # Errors
    /// [`BuildError`] if the exact kernels reject the point, or a value is not finite.
    pub fn compute(&self, r: f64, z: f64) -> Result<Numbers, BuildError> {
        let end = self.cells as f64 * self.width;
        // an interval shorter than a cell counts in proportion to its length
        let part = |length: f64| [(length / self.width).min(1.0); 6];
        let tolerance = [TRACE * self.kernel.tolerance(); 6];
        let trace = self.kernel.trace_under(r, z, end, (tolerance, &part))?;
        let tail = self.tail(r, z, end)?;
        let mut cells = Moments::with_capacity(self.cells);
        trace.for_each_cell(self.width, self.cells, |_, cell| cells.push(cell))?;
        let mut point = [cells.averages, cells.first, cells.second, tail];
        let quantum = quantum(&point[0], &self.kernel.static_field(r, z)?);
        for m in point[1..3].iter_mut().flatten() {
            *m = std::array::from_fn(|f| (m[f] / quantum[f]).round() * quantum[f]);
        }
        self.check(r, z, &point)?;
        Ok(point)
    }

    /// Coefficients c_k of the tail R = u^2 sum_k c_k T_k(2u - 1), u = `end`/t.
    fn tail(&self, r: f64, z: f64, end: f64) -> Result<Vec<Six>, BuildError> {
        let count = self.tail_terms;
        let mut tail = vec![[0.0; 6]; count];
        let angle = |i: usize| PI * (i as f64 + 0.5) / count as f64;
        for i in 0..count {
            let u = 0.5 * (1.0 + angle(i).cos());
            let value = self.kernel.remainder(r, z, end / u)?.value;
            for (k, c) in tail.iter_mut().enumerate() {
                let factor = if k == 0 { 1.0 } else { 2.0 } / (count as f64 * u * u);
                let weight = factor * (k as f64 * angle(i)).cos();
                for (c, value) in c.iter_mut().zip(value) {
                    *c += weight * value;
                }
            }
        }
        Ok(tail)
    }

    fn check(&self, r: f64, z: f64, point: &Numbers) -> Result<(), BuildError> {
        let quantities = ["cell average", "moment", "curvature", "tail"];
        for (quantity, values) in quantities.into_iter().zip(point) {
            for value in values {
                if let Some(f) = value.iter().position(|x| !x.is_finite()) {
                    let nu = self.kernel.medium().poisson_ratio();
                    let field = lookup::schema::FIELD_NAMES[f];
                    return Err(BuildError::NotFinite(format!(
                        "poisson_ratio = {nu}, r/r0 = {r}, z/r0 = {z}: {quantity} of field {field}"
                    )));
                }
            }
        }
        Ok(())
    }
}

/// Rounding step of moments: a power of two near [`MOMENT_ACCURACY`] times the largest average of the field, or the
/// static displacement or stress, whichever is less.
///
/// Away from fronts most of their digits are then zero, which saves space in a compressed file.
fn quantum(averages: &[Six], rest: &Six) -> Six {
    let most = averages.iter().fold([1e-12_f64; 6], |most, six| {
        std::array::from_fn(|f| most[f].max(six[f].abs()))
    });
    let largest = |fields: &[f64]| fields.iter().fold(1e-12_f64, |a, b| a.max(b.abs()));
    let (displacement, stress) = (largest(&rest[..2]), largest(&rest[2..]));
    std::array::from_fn(|f| {
        let scale = most[f].min(if f < 2 { displacement } else { stress });
        (MOMENT_ACCURACY * scale).log2().floor().exp2()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use lookup::quantile;

    /// Average, first and second moment by the midpoint rule with 4000 intervals in a cell, for comparison.
    fn summed(kernel: &Kernel, r: f64, z: f64, width: f64, j: usize) -> [Six; 3] {
        const MIDPOINTS: usize = 4000;
        let mut sums = [[0.0; 6]; 3];
        for i in 0..MIDPOINTS {
            let fraction = (i as f64 + 0.5) / MIDPOINTS as f64;
            let t = (j as f64 + fraction) * width;
            let value = kernel.remainder(r, z, t).unwrap().value;
            let s = fraction - 0.5;
            for (sum, weight) in sums.iter_mut().zip([1.0, s, s * s - 1.0 / 12.0]) {
                for f in 0..6 {
                    sum[f] += weight * value[f] / MIDPOINTS as f64;
                }
            }
        }
        sums
    }

    #[test]
    fn averages_and_moments_agree_with_sums_over_the_remainder() {
        let width = 0.1;
        let plan = PointPlan::new(0.3, 1e-9, width, 80, 12).unwrap();
        // cells with the first, shear, head and Rayleigh fronts, quiet cells and late cells
        for (r, z) in [(0.4, 0.3), (0.95, 0.0), (1.3, 0.1), (0.06, 3.0), (2.0, 1.0)] {
            let point = plan.compute(r, z).unwrap();
            let rest = plan.kernel().static_field(r, z).unwrap();
            let size = rest.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
            for j in [0, 2, 3, 4, 6, 9, 13, 17, 22, 30, 31, 41, 56, 79] {
                let found = [point[0][j], point[1][j], point[2][j]];
                let exact = summed(plan.kernel(), r, z, width, j);
                for (order, (found, exact)) in found.iter().zip(exact).enumerate() {
                    for f in 0..6 {
                        // the sum resolves a front of height one to 1/4000; deep on the axis a front is 25 times the
                        // static field
                        let error = (found[f] - exact[f]).abs() / size;
                        assert!(
                            error < 1e-4 * z.max(1.0).powi(2),
                            "({r}, {z}) cell {j} field {f} moment {order}: {} against {}",
                            found[f],
                            exact[f]
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn the_tail_agrees_with_the_kernels() {
        for nu in [0.0, 0.3, 0.45] {
            let medium = Medium::new(nu).unwrap();
            let kernel = Kernel::new(&medium, Profile::Hertz, 1e-12).unwrap();
            for (r, z) in [(0.0, 0.5), (0.9, 0.0), (1.1, 0.2), (3.0, 4.0), (6.0, 0.1)] {
                let arrivals = halfspace::Arrivals::new(&medium, Profile::Hertz, r, z).unwrap();
                let end = 1.5 * arrivals.last();
                let rest = kernel.static_field(r, z).unwrap();
                let size = rest.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
                let plan = PointPlan::new(nu, 1e-12, end, 1, 12).unwrap();
                let tail = plan.tail(r, z, end).unwrap();
                for t in [end, 1.1 * end, 3.0 * end, 50.0 * end] {
                    let exact = kernel.remainder(r, z, t).unwrap().value;
                    let u = end / t;
                    for f in 0..6 {
                        let column: Vec<f64> = tail.iter().map(|six| six[f]).collect();
                        let found = u * u * halfspace::chebyshev(&column, 2.0 * u - 1.0);
                        let error = (found - exact[f]).abs() / size;
                        assert!(
                            error < 5e-8,
                            "nu {nu} r {r} z {z} t {t} field {f}: {error:.1e}"
                        );
                    }
                }
            }
        }
    }

    /// Errors of cells relative to the largest cell of the field, compared with a tolerance of 1e-12.
    #[test]
    fn cells_are_within_the_rounding_to_single_precision() {
        let rounding = 0.5 * f64::from(f32::EPSILON);
        for nu in [0.0, 0.3, 0.49] {
            let [plan, exact] = [1e-8, 1e-12]
                .map(|tolerance| PointPlan::new(nu, tolerance, 0.125, 230, 12).unwrap());
            let mut errors = Vec::new();
            for i in 1..=60 {
                let [r, z] = [0.618_034, 0.754_878].map(|step| 6.0 * (step * f64::from(i)).fract());
                let z = z * z / 6.0;
                let [found, exact] = [&plan, &exact].map(|plan| plan.compute(r, z).unwrap());
                for f in 0..6 {
                    let largest = exact[0]
                        .iter()
                        .fold(0.0, |most: f64, v| most.max(v[f].abs()));
                    let pairs = found[0].iter().zip(&exact[0]);
                    errors.extend(pairs.map(|(a, b)| (a[f] - b[f]).abs() / largest));
                }
            }
            errors.sort_by(f64::total_cmp);
            let [half, most, all] = [0.5, 0.99, 1.0].map(|part| quantile(&errors, part));
            println!("nu {nu}: median {half:.1e}, 99 % {most:.1e}, largest {all:.1e}");
            assert!(
                most < rounding && all < 20.0 * rounding,
                "nu {nu}: {most:e}, {all:e}"
            );
        }
    }
}
