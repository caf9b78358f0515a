//! First and second moments of R in the time cells of one point, also where fronts cross them.

use crate::error::BuildError;
use halfspace::{Arrivals, Kernel, Profile, Six};

/// What the moments of a point follow from.
pub(crate) struct Cells<'a> {
    pub(crate) kernel: &'a Kernel,
    /// (r, z).
    pub(crate) place: [f64; 2],
    pub(crate) width: f64,
    /// Cells that end before the first arrival; their moments are zero.
    pub(crate) quiet: usize,
    /// Averages of R.
    pub(crate) averages: &'a [Six],
    /// S = int R dt at the edges of the cells from `quiet` on.
    pub(crate) integrals: &'a [Six],
}

impl Cells<'_> {
    /// Moments m1 = int R s ds and m2 = int R (s^2 - 1/12) ds over each cell, s = (t - t_mid)/width, rounded to
    /// multiples of `quantum`.
    ///
    /// Where R is smooth over five cells they follow from the averages, elsewhere from S and Q = int S dt.
    pub(crate) fn moments(&self, quantum: &Six) -> Result<(Vec<Six>, Vec<Six>), BuildError> {
        let count = self.averages.len();
        let (mut first, mut second) = (vec![[0.0; 6]; count], vec![[0.0; 6]; count]);
        let arrivals = Arrivals::new(
            self.kernel.medium(),
            Profile::Hertz,
            self.place[0],
            self.place[1],
        )?
        .sorted();
        // Q at the edge where the cell before ended, if that cell needed it.
        let mut shared: Option<(usize, Six)> = None;
        for j in self.quiet..count {
            let [m1, m2] = match self.smooth(j, quantum, &arrivals) {
                Some(moments) => moments,
                None => {
                    let below = match shared {
                        Some((edge, value)) if edge == j => value,
                        Some(_) | None => self.second_integral(j as f64 * self.width)?,
                    };
                    let above = self.second_integral((j + 1) as f64 * self.width)?;
                    shared = Some((j + 1, above));
                    self.exact(j, &below, &above, &arrivals)?
                }
            };
            let round = |m: &Six| std::array::from_fn(|f| (m[f] / quantum[f]).round() * quantum[f]);
            (first[j], second[j]) = (round(&m1), round(&m2));
        }
        Ok((first, second))
    }

    fn second_integral(&self, t: f64) -> Result<Six, BuildError> {
        let [r, z] = self.place;
        Ok(self.kernel.second_integral(r, z, t)?.value)
    }

    /// The moments of cell `j` with Q at its ends.
    ///
    /// With S and Q less their values and slopes at the start of the cell,
    /// m1 = (S_1 width/2 - Q_1)/width^2 and m2 = (S_1/6 - Q_1/width + 2/width^2 int Q dt)/width.
    fn exact(
        &self,
        j: usize,
        below: &Six,
        above: &Six,
        arrivals: &[f64],
    ) -> Result<[Six; 2], BuildError> {
        let w = self.width;
        let (from, to) = (
            &self.integrals[j - self.quiet],
            &self.integrals[j - self.quiet + 1],
        );
        let start = j as f64 * w;
        let relative = |value: &Six, tau: f64| -> Six {
            std::array::from_fn(|f| value[f] - below[f] - tau * from[f])
        };
        let end = relative(above, w);
        let mut area = [0.0; 6];
        let mut left = (0.0, [0.0; 6]);
        for cut in cuts(arrivals, start, w) {
            let right = if cut == w {
                end
            } else {
                relative(&self.second_integral(start + cut)?, cut)
            };
            let middle = 0.5 * (left.0 + cut);
            let centre = relative(&self.second_integral(start + middle)?, middle);
            for f in 0..6 {
                area[f] += (cut - left.0) / 6.0 * (left.1[f] + 4.0 * centre[f] + right[f]);
            }
            left = (cut, right);
        }
        let moment = std::array::from_fn(|f| (0.5 * w * (to[f] - from[f]) - end[f]) / (w * w));
        let curvature = std::array::from_fn(|f| {
            ((to[f] - from[f]) / 6.0 - end[f] / w + 2.0 / (w * w) * area[f]) / w
        });
        Ok([moment, curvature])
    }

    /// Both moments of cell `j` from the averages around it, to fourth order, where the differences of the
    /// second-order ones show that R is smooth there.
    fn smooth(&self, j: usize, quantum: &Six, arrivals: &[f64]) -> Option<[Six; 2]> {
        if j < 2 || j + 2 >= self.averages.len() {
            return None;
        }
        let (from, to) = ((j - 2) as f64 * self.width, (j + 3) as f64 * self.width);
        let doubt_allowed = if arrivals.iter().any(|&t| t > from && t < to) {
            DOUBT_AT_FRONT
        } else {
            DOUBT
        };
        let around = &self.averages[j - 2..j + 3];
        let (mut first, mut second) = ([0.0; 6], [0.0; 6]);
        for f in 0..6 {
            let [a, b, c, d, e] = [0, 1, 2, 3, 4].map(|i: usize| around[i][f]);
            first[f] = (d - b) * 41.0 / 720.0 - (e - a) * 11.0 / 1440.0;
            second[f] = (b + d) / 252.0 - (a + e) / 3360.0 - c * 37.0 / 5040.0;
            let doubt = (first[f] - (d - b) / 24.0)
                .abs()
                .max((second[f] - (b - 2.0 * c + d) / 360.0).abs());
            if doubt > doubt_allowed * quantum[f] {
                return None;
            }
        }
        Some([first, second])
    }
}

/// Difference between second and fourth order, in quanta, up to which the fourth is taken where no front is near.
const DOUBT: f64 = 30.0;
/// The same where a front is in one of the five cells: all orders then err alike.
const DOUBT_AT_FRONT: f64 = 2.0;

/// Ends of the parts of a cell that starts at `start`: the fronts in it and its end.
fn cuts(arrivals: &[f64], start: f64, width: f64) -> Vec<f64> {
    /// Parts shorter than this fraction of the cell are not worth their evaluations.
    const SHORTEST: f64 = 1e-3;
    let mut cuts = Vec::new();
    let mut last = 0.0;
    for t in arrivals {
        let cut = t - start;
        if cut > last + SHORTEST * width && cut < (1.0 - SHORTEST) * width {
            cuts.push(cut);
            last = cut;
        }
    }
    cuts.push(width);
    cuts
}
