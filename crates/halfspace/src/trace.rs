//! The remainder at one place as a function of time: polynomials on panels that halve toward the fronts.
//!
//! A cell average taken as a difference of int R dt carries the rounding of int R dt over the width of the cell; far from
//! the load, where R is small and cells are short beside the time of travel, nothing is left of it. Here R itself is
//! interpolated. Between two fronts a < b
//!
//! ```text
//! t = a + (b - a)/2 s^2   and   t = b - (b - a)/2 s^2,     0 < s < 1
//! ```
//!
//! turn the roots at the fronts into smooth functions of s, and what is left of logarithms is confined to ever
//! smaller panels. The number of panels depends on the fronts and on the tolerance, not on the cells.

use crate::arrivals::Arrivals;
use crate::chebyshev;
use crate::domain::{check_hertz, check_place_under, check_time};
use crate::error::DomainError;
use crate::field::{Estimate, Six};
use crate::gauss;
use crate::kernel::Kernel;

/// Panels are halved no more once there are so many, which no place needs; what is left out is in the estimate.
const MOST_PANELS: usize = 1000;

/// Error of an integral over a cell over the mean estimate of the values at the nodes: errors of values are well below
/// their estimates and of any sign.
const NOISE: f64 = 0.2;

/// Terms of a series.
const TERMS: usize = 16;

/// R(t) at one place up to an end, ready for averages and first moments over any intervals.
///
/// Made by [`Kernel::trace`]. Its cost depends on the place and the tolerance, not on the number of intervals; an
/// interval then takes less than a microsecond.
///
/// ```
/// use halfspace::{Field, Kernel, Medium, Profile};
/// let kernel = Kernel::new(&Medium::new(0.3)?, Profile::Hertz, 1e-8)?;
/// // 200 radii out on the surface, where the Rayleigh wave passes at t = 402
/// let trace = kernel.trace(200.0, 0.0, 420.0)?;
/// let (average, _moment) = trace.cell(400.0, 400.1)?;
/// let middle = kernel.remainder(200.0, 0.0, 400.05)?;
/// let w = Field::DisplacementZ.index();
/// assert!((average.value[w] - middle.value[w]).abs() < 1e-6);
/// # Ok::<(), halfspace::DomainError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Trace {
    first_arrival: f64,
    end: f64,
    static_field: Six,
    panels: Vec<Panel>,
}

/// A piece of the trace: a series in s on `s`, t = anchor + scale s^2.
#[derive(Debug, Clone)]
struct Panel {
    times: [f64; 2],
    anchor: f64,
    scale: f64,
    s: [f64; 2],
    series: [Six; TERMS],
    error: Six,
}

impl Kernel {
    /// R(t) at (r, z) for t from 0 to `end`.
    ///
    /// Accuracy: the kernel's tolerance, as a fraction of each field's peak over the time of the trace, at any distance
    /// to 1e4.
    ///
    /// # Errors
    /// [`DomainError`] for r, z or end outside [0, 1e20], and for a profile other than Hertz, whose stresses are infinite
    /// at fronts.
    pub fn trace(&self, r: f64, z: f64, end: f64) -> Result<Trace, DomainError> {
        check_place_under(self.profile(), r, z)?;
        check_time(end)?;
        check_hertz(self.profile(), "a trace")?;
        let arrivals = Arrivals::new(self.medium(), self.profile(), r, z)?;
        let static_field = self.static_field(r, z)?;
        let first_arrival = self.first_arrival(r, z);
        let mut build = Build {
            kernel: self,
            place: [r, z],
            static_field,
            peak: static_field.map(f64::abs),
            panels: vec![],
        };
        let pieces = pieces(&arrivals.sorted(), first_arrival, end);
        let mut stack = vec![];
        for piece in pieces.iter().rev() {
            stack.push(build.panel(*piece)?);
        }
        while let Some(panel) = stack.pop() {
            if build.panels.len() + stack.len() >= MOST_PANELS || build.accepts(&panel) {
                build.panels.push(panel);
            } else {
                let (early, late) = panel.piece().halves();
                stack.push(build.panel(late)?);
                stack.push(build.panel(early)?);
            }
        }
        Ok(Trace {
            first_arrival,
            end,
            static_field,
            panels: build.panels,
        })
    }
}

/// An interval of time as one of s.
#[derive(Debug, Clone, Copy)]
struct Piece {
    anchor: f64,
    scale: f64,
    s: [f64; 2],
}

impl Piece {
    fn time(&self, s: f64) -> f64 {
        self.anchor + self.scale * s * s
    }

    /// Its halves in s, the earlier first.
    fn halves(self) -> (Self, Self) {
        let middle = 0.5 * (self.s[0] + self.s[1]);
        let (low, high) = (
            Self {
                s: [self.s[0], middle],
                ..self
            },
            Self {
                s: [middle, self.s[1]],
                ..self
            },
        );
        if self.scale > 0.0 {
            (low, high)
        } else {
            (high, low)
        }
    }
}

/// The intervals between fronts, halved, in the order of time.
fn pieces(arrivals: &[f64], first: f64, end: f64) -> Vec<Piece> {
    /// Fronts this close to each other are one.
    const SAME: f64 = 1e-13;
    let mut fronts = vec![first];
    for &arrival in arrivals {
        let last = fronts[fronts.len() - 1];
        if arrival - last > SAME * arrival {
            fronts.push(arrival);
        }
    }
    let mut pieces = vec![];
    for (i, &from) in fronts.iter().enumerate() {
        if from >= end {
            break;
        }
        match fronts.get(i + 1) {
            None => pieces.push(Piece {
                anchor: from,
                scale: end - from,
                s: [0.0, 1.0],
            }),
            Some(&to) => {
                let half = 0.5 * (to - from);
                let until = |reach: f64| (reach / half).clamp(0.0, 1.0).sqrt();
                pieces.push(Piece {
                    anchor: from,
                    scale: half,
                    s: [0.0, until(end - from)],
                });
                if end > from + half {
                    pieces.push(Piece {
                        anchor: to,
                        scale: -half,
                        s: [until(to - end), 1.0],
                    });
                }
            }
        }
    }
    pieces
}

struct Build<'a> {
    kernel: &'a Kernel,
    place: [f64; 2],
    static_field: Six,
    /// Largest magnitude of each field met so far.
    peak: Six,
    panels: Vec<Panel>,
}

impl Build<'_> {
    fn panel(&mut self, piece: Piece) -> Result<Panel, DomainError> {
        let [r, z] = self.place;
        let (middle, half) = (
            0.5 * (piece.s[0] + piece.s[1]),
            0.5 * (piece.s[1] - piece.s[0]),
        );
        let mut values = [Six::default(); TERMS];
        let mut error = Six::default();
        for (i, value) in values.iter_mut().enumerate() {
            let t = piece.time(middle + half * chebyshev::node(i, TERMS));
            let found = self.kernel.remainder(r, z, t)?;
            *value = found.value;
            for f in 0..6 {
                error[f] += NOISE * found.error[f] / TERMS as f64;
                self.peak[f] = self.peak[f].max((found.value[f] + self.static_field[f]).abs());
            }
        }
        let series = chebyshev::fit(&values);
        let times = piece.s.map(|s| piece.time(s));
        let times = [times[0].min(times[1]), times[0].max(times[1])];
        // a time is known to its rounding error
        let blur = 4.0 * f64::EPSILON * times[1] / (times[1] - times[0]);
        for f in 0..6 {
            let variation: f64 = series[1..].iter().map(|c| c[f].abs()).sum();
            error[f] += blur * variation;
        }
        Ok(Panel {
            times,
            anchor: piece.anchor,
            scale: piece.scale,
            s: piece.s,
            series,
            error,
        })
    }

    /// Whether the series is as good as its values, or the panel as short as rounding lets it be.
    fn accepts(&self, panel: &Panel) -> bool {
        /// Shortest panel in units of the rounding error of its time.
        const SHORTEST: f64 = 64.0;
        let length = panel.times[1] - panel.times[0];
        if length <= SHORTEST * f64::EPSILON * panel.times[1] {
            return true;
        }
        let left = panel.truncation();
        (0..6).all(|f| {
            let goal = (self.kernel.tolerance() * self.peak[f]).max(panel.error[f]);
            // a short panel counts for no more than its length
            left[f] * length.min(1.0) <= goal
        })
    }
}

impl Panel {
    fn piece(&self) -> Piece {
        Piece {
            anchor: self.anchor,
            scale: self.scale,
            s: self.s,
        }
    }

    /// Truncation error of the series, from its last terms.
    fn truncation(&self) -> Six {
        /// Beside a front the terms fall as a power, and many of the same size follow the last.
        const CAUTION: f64 = 3.0;
        std::array::from_fn(|f| {
            let last = self.series[TERMS - 3..].iter().map(|c| c[f].abs());
            CAUTION * last.sum::<f64>()
        })
    }

    /// R at a time of the panel.
    fn at(&self, t: f64) -> Estimate {
        let s = ((t - self.anchor) / self.scale).max(0.0).sqrt();
        let (middle, half) = (0.5 * (self.s[0] + self.s[1]), 0.5 * (self.s[1] - self.s[0]));
        let x = ((s - middle) / half).clamp(-1.0, 1.0);
        let truncation = self.truncation();
        Estimate {
            value: chebyshev::value(&self.series, x),
            error: std::array::from_fn(|f| self.error[f] + truncation[f]),
        }
    }

    /// Adds int R dt, int (t - centre) R dt and the error over a part of the panel.
    fn add(&self, from: f64, to: f64, centre: f64, sums: &mut [Six; 3]) {
        /// A part of the panel this short is smooth enough for a short rule.
        const SHORT: f64 = 0.05;
        let place = |t: f64| ((t - self.anchor) / self.scale).max(0.0).sqrt();
        let [mut low, mut high] = [place(from), place(to)].map(|s| s.clamp(self.s[0], self.s[1]));
        if low > high {
            (low, high) = (high, low);
        }
        let (middle, half) = (0.5 * (self.s[0] + self.s[1]), 0.5 * (self.s[1] - self.s[0]));
        // exact for the series times dt/ds times t
        let nodes = if high - low < SHORT * 2.0 * half {
            4
        } else {
            TERMS / 2 + 2
        };
        for (s, weight) in gauss::rule(nodes).on(low, high) {
            let value = chebyshev::value(&self.series, (s - middle) / half);
            let weight = weight * 2.0 * self.scale.abs() * s;
            let arm = (self.anchor - centre) + self.scale * s * s;
            for f in 0..6 {
                sums[0][f] += weight * value[f];
                sums[1][f] += weight * arm * value[f];
            }
        }
        let truncation = self.truncation();
        for f in 0..6 {
            sums[2][f] += (to - from) * (self.error[f] + truncation[f]);
        }
    }
}

impl Trace {
    /// Average and first moment of R over a cell from `from` to `to`.
    ///
    /// ```text
    /// 1/width int R dt          1/width^2 int (t - centre) R dt
    /// ```
    ///
    /// # Errors
    /// [`DomainError`] for a cell that is empty or reaches beyond the trace.
    pub fn cell(&self, from: f64, to: f64) -> Result<(Estimate, Estimate), DomainError> {
        use crate::domain::check;
        check(from >= 0.0, "from", from, "[0, to)")?;
        check(to > from, "to", to, "(from, end of the trace]")?;
        check(to <= self.end, "to", to, "(from, end of the trace]")?;
        let next = self.panels.partition_point(|panel| panel.times[1] <= from);
        Ok(self.cell_from(next, from, to))
    }

    /// The same from a panel known to be the first that the cell meets.
    fn cell_from(&self, first: usize, from: f64, to: f64) -> (Estimate, Estimate) {
        /// A cell this short in units of the rounding error of its time is an instant.
        const INSTANT: f64 = 1e4;
        let (width, centre) = (to - from, 0.5 * (from + to));
        if width < INSTANT * f64::EPSILON * to {
            return self.instant(first, centre);
        }
        let mut sums = [Six::default(); 3];
        if from < self.first_arrival {
            let until = to.min(self.first_arrival);
            let (length, arm) = (until - from, 0.5 * (until + from) - centre);
            for f in 0..6 {
                let area = -length * self.static_field[f];
                sums[0][f] += area;
                sums[1][f] += arm * area;
                sums[2][f] += f64::EPSILON * area.abs();
            }
        }
        for panel in &self.panels[first..] {
            if panel.times[0] >= to {
                break;
            }
            let part = [from.max(panel.times[0]), to.min(panel.times[1])];
            if part[1] > part[0] {
                panel.add(part[0], part[1], centre, &mut sums);
            }
        }
        let [area, moment, error] = sums;
        let average = Estimate {
            value: area.map(|v| v / width),
            error: error.map(|v| v / width),
        };
        // |t - centre| is at most half the width
        let moment = Estimate {
            value: moment.map(|v| v / (width * width)),
            error: error.map(|v| 0.5 * v / width),
        };
        (average, moment)
    }

    /// R at an instant, as average, and no moment.
    fn instant(&self, first: usize, t: f64) -> (Estimate, Estimate) {
        let before = || Estimate {
            value: self.static_field.map(|v| -v),
            error: self.static_field.map(|v| f64::EPSILON * v.abs()),
        };
        let average = match self.panels.get(first) {
            Some(panel) if t > self.first_arrival => panel.at(t),
            Some(_) | None => before(),
        };
        let moment = Estimate {
            value: Six::default(),
            error: average.error,
        };
        (average, moment)
    }

    /// Calls `f` with the average and first moment of each of `count` cells of `width`, from time zero.
    pub(crate) fn for_each_cell(
        &self,
        width: f64,
        count: usize,
        mut f: impl FnMut(usize, Estimate, Estimate),
    ) {
        let mut first = 0;
        for j in 0..count {
            let (from, to) = (j as f64 * width, (j + 1) as f64 * width);
            while first < self.panels.len() && self.panels[first].times[1] <= from {
                first += 1;
            }
            let (average, moment) = self.cell_from(first, from, to);
            f(j, average, moment);
        }
    }
}
