//! The remainder at one place as a function of time: polynomials on segments between the fronts.
//!
//! A cell average computed as a difference of int R dt has the rounding error of int R dt over the width of the cell.
//! Far from the load, where R is small and cells are short compared with the time of travel, no digit remains. Here R
//! itself is interpolated on segments between the fronts, which are halved if one polynomial is not enough. Their
//! number depends on the fronts and on the accuracy, not on the cells.
//!
//! `interpolation` divides a trace into segments, and `segment` is one of them.

mod interpolation;
mod segment;

use crate::arrivals::Arrivals;
use crate::damping::{Damping, Group};
use crate::domain::{
    DomainError, FARTHEST, NEAREST, check, check_hertz, check_place_under, check_time,
};
use crate::field::{Estimate, Six};
use crate::kernel::Kernel;
use crate::trace::interpolation::segments;
use crate::trace::segment::Segment;

/// Factor for the truncation error of a polynomial: the error has both signs, and so has its product with the rate of
/// the force.
const OSCILLATES: f64 = 0.45;

/// Largest number of segments; no place of a half-space needs as many. The estimate includes the error of segments that are not
/// halved further.
const MOST_SEGMENTS: usize = 200;

/// Duration of a Rayleigh wave in r0/c1 above which the waves from the edges of the disc cannot be distinguished.
const DEEP: f64 = 1.0;

/// R(t) at one place up to an end time: values, and moments over any intervals.
///
/// [`Kernel::trace`] returns it. Its cost depends on the place and the tolerance, not on its use: a value takes tens of
/// nanoseconds, an interval some hundred.
///
/// ```
/// use halfspace::{Field, Kernel, Medium, Profile};
/// let kernel = Kernel::new(&Medium::new(0.3)?, Profile::Hertz, 1e-8)?;
/// // 200 radii out on the surface, where the Rayleigh wave passes at t = 402
/// let trace = kernel.trace(200.0, 0.0, 420.0)?;
/// let [average, _first, _second] = trace.cell(400.0, 400.1)?;
/// let middle = kernel.remainder(200.0, 0.0, 400.05)?;
/// let w = Field::DisplacementZ.index();
/// assert!((average[w] - middle.value[w]).abs() < 1e-6);
/// assert!((trace.at(400.05)[w] - middle.value[w]).abs() < 1e-7);
/// # Ok::<(), halfspace::DomainError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Trace {
    first_arrival: f64,
    end: f64,
    before: Six,
    segments: Vec<Segment>,
    breaks: Vec<f64>,
    /// When fronts arrive, ascending.
    fronts: Vec<f64>,
    /// Estimated error of the response to the force for which the trace was made, over the peak of the force.
    pub error: Six,
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
        let rise = |length: f64| [length.min(1.0); 6];
        self.trace_under(r, z, end, ([self.tolerance(); 6], &rise))
    }

    /// R(t) with the accuracy needed for a force that changes by at most `rise` of its peak within a time. Tolerance
    /// and rise are given for each field, since some uses, such as the response to the rate of a force, need the
    /// displacements only.
    ///
    /// Accuracy: errors of responses to that force are below `tolerance` of their peaks, and typically a hundredth of
    /// it. R itself is less accurate near fronts, during times in which the force hardly changes.
    ///
    /// # Errors
    /// As [`Self::trace`].
    pub fn trace_under(
        &self,
        r: f64,
        z: f64,
        end: f64,
        (tolerance, rise): (Six, &dyn Fn(f64) -> Six),
    ) -> Result<Trace, DomainError> {
        check_place_under(self.profile(), r, z)?;
        check_time(end)?;
        check_hertz(self.profile(), "a trace")?;
        // a depth of the size of a rounding error is zero
        let z = if z < NEAREST { 0.0 } else { z };
        let mut arrivals = Arrivals::new(self.medium(), self.profile(), r, z)?;
        // below the surface the Rayleigh wave has no front, and its duration is of the order of the depth
        let medium = self.medium();
        let slownesses = [medium.rayleigh_speed(), medium.kappa()].map(|c| 1.0 / (c * c));
        let duration = z * (slownesses[0] - slownesses[1]).sqrt();
        let passing = (duration > DEEP).then(|| {
            arrivals.rayleigh = arrivals.s;
            [r / medium.rayleigh_speed(), duration]
        });
        let static_field = self.static_field(r, z)?;
        let signal = Signal {
            fronts: arrivals.sorted(),
            passing,
            first: self.first_arrival(r, z),
            before: static_field.map(|s| -s),
            size: static_field,
            most_segments: MOST_SEGMENTS,
        };
        Trace::of(signal, end, (tolerance, rise), |t| self.remainder(r, z, t))
    }
}

/// A function of time that a trace follows.
pub(crate) struct Signal {
    /// When fronts arrive, ascending.
    pub(crate) fronts: Vec<f64>,
    /// When a wave without a front passes, and for how long.
    pub(crate) passing: Option<[f64; 2]>,
    /// The first arrival.
    pub(crate) first: f64,
    /// The value before it.
    pub(crate) before: Six,
    /// The least that tolerances are relative to.
    pub(crate) size: Six,
    /// Largest number of segments.
    pub(crate) most_segments: usize,
}

impl Trace {
    /// Of the values of a signal until an end, for a force that changes by at most `rise` within a time.
    pub(crate) fn of(
        signal: Signal,
        end: f64,
        (tolerance, rise): (Six, &dyn Fn(f64) -> Six),
        value: impl Fn(f64) -> Result<Estimate, DomainError>,
    ) -> Result<Self, DomainError> {
        let segments = segments(&signal, end, (tolerance, rise), value)?;
        // each segment is weighted with the change of the force during it
        let mut error = signal.before.map(|s| f64::EPSILON * s.abs());
        let mut truncation = Six::default();
        for segment in &segments {
            let part = rise(segment.times[1] - segment.times[0]);
            for f in 0..6 {
                error[f] += part[f] * segment.error[f];
                truncation[f] = truncation[f].max(OSCILLATES * part[f] * segment.truncation[f]);
            }
        }
        for (error, truncation) in error.iter_mut().zip(truncation) {
            *error += truncation;
        }
        Ok(Self {
            first_arrival: signal.first,
            end,
            before: signal.before,
            breaks: segments.iter().flat_map(Segment::breaks).collect(),
            fronts: signal.fronts,
            segments,
            error,
        })
    }

    /// The remainder in a body with attenuation, until an end: what is added to `static_part`, the static field of the elastic body
    /// to which this trace is added, is the damped step response.
    ///
    /// `reference` is the reference frequency in the trace's unit of time, instead of that of the law; tolerance and rise are
    /// those of [`Kernel::trace_under`]. This trace must reach [`Damping::reach`] of the end.
    ///
    /// The response is causal: zero until slightly before the first arrival, by a time that vanishes with 1/Q. It does not become
    /// static: displacements grow as t^(2 g), which their remainder contains.
    ///
    /// # Errors
    /// [`DomainError`] if this trace ends too early.
    pub fn damped(
        &self,
        static_part: &Six,
        (damping, reference): (&Damping, f64),
        end: f64,
        wanted: (Six, &dyn Fn(f64) -> Six),
    ) -> Result<Self, DomainError> {
        let reach = damping.reach(end, reference);
        check(
            reach <= self.end,
            "end",
            end,
            "[0, end of the elastic trace)",
        )?;
        let breaks: Vec<f64> = self.segments.iter().map(|s| s.times[0]).collect();
        let [_, first] = damping.arrival(self.first_arrival, reference);
        let signal = Signal {
            fronts: (self.fronts.iter())
                .map(|tau| damping.arrival(*tau, reference)[0])
                .collect(),
            passing: None,
            first,
            before: static_part.map(|s| -s),
            size: static_part.map(f64::abs),
            most_segments: MOST_SEGMENTS,
        };
        let value = |t: f64| {
            let mut sums = Six::default();
            damping.for_each_group((t, reference), (self.first_arrival, &breaks), |group| {
                self.add_group(static_part, group, &mut sums);
            });
            let creep = damping.creep(t, reference);
            let factor = |f: usize| if f < 2 { creep } else { 1.0 };
            let value = std::array::from_fn(|f| factor(f) * sums[f] - static_part[f]);
            Ok(Estimate {
                value,
                error: value.map(|v| damping.tolerance() * v.abs()),
            })
        };
        let mut damped = Self::of(signal, end, wanted, value)?;
        let creep = damping.creep(end, reference).max(1.0);
        for (all, own) in damped.error.iter_mut().zip(self.error) {
            *all += creep * own;
        }
        Ok(damped)
    }

    /// Adds the weighted step responses of a group of instants between two breaks.
    fn add_group(&self, static_part: &Six, group: &Group, sums: &mut Six) {
        let rest = self.at_each(group.tau);
        for (f, sum) in sums.iter_mut().enumerate() {
            let weights = &group.weights[usize::from(f >= 2)];
            let terms = weights.iter().zip(&rest[f]);
            *sum += terms
                .map(|(weight, rest)| weight * (static_part[f] + rest))
                .sum::<f64>();
        }
    }

    /// Ascending times, including fronts, between which R is a polynomial of few terms in the root of the time from a
    /// front.
    pub fn breaks(&self) -> impl Iterator<Item = f64> {
        self.breaks.iter().copied()
    }

    /// R at a time; after the end of the trace, the value at the end.
    pub fn at(&self, t: f64) -> Six {
        self.at_each([t]).map(|[value]| value)
    }

    /// R at several times that lie between the same two breaks.
    #[must_use]
    pub fn at_each<const N: usize>(&self, times: [f64; N]) -> [[f64; N]; 6] {
        let t = times[N / 2];
        let after = self.segments.partition_point(|s| s.times[1] < t);
        match self.segments.get(after).or(self.segments.last()) {
            Some(segment) if t > self.first_arrival => segment.at(times),
            Some(_) | None => self.before.map(|v| [v; N]),
        }
    }

    /// Average, first and second moment of R over a cell from `from` to `to`.
    ///
    /// ```text
    /// 1/width int R dt          1/width int s R dt          1/width int (s^2 - 1/12) R dt,     s = (t - centre)/width
    /// ```
    ///
    /// # Errors
    /// [`DomainError`] for a cell that is empty or ends after the trace.
    pub fn cell(&self, from: f64, to: f64) -> Result<[Six; 3], DomainError> {
        check(from >= 0.0, "from", from, "[0, to)")?;
        check(to > from, "to", to, "(from, end of the trace]")?;
        check(to <= self.end, "to", to, "(from, end of the trace]")?;
        let next = self
            .segments
            .partition_point(|segment| segment.times[1] <= from);
        Ok(self.cell_from(next, from, to))
    }

    /// Estimated error of the average over a cell; the error of the first moment is half as large.
    pub fn cell_error(&self, from: f64, to: f64) -> Six {
        let before = self.first_arrival.clamp(from, to) - from;
        let mut error = self.before.map(|s| f64::EPSILON * s.abs() * before);
        let first = self.segments.partition_point(|s| s.times[1] <= from);
        for segment in self.segments[first..]
            .iter()
            .take_while(|s| s.times[0] < to)
        {
            let length = to.min(segment.times[1]) - from.max(segment.times[0]);
            for (f, error) in error.iter_mut().enumerate() {
                *error += length * (segment.error[f] + OSCILLATES * segment.truncation[f]);
            }
        }
        error.map(|e| e / (to - from))
    }

    /// Average, first and second moment of a cell; `first` is the index of the first segment in it.
    fn cell_from(&self, first: usize, from: f64, to: f64) -> [Six; 3] {
        /// Width of a cell, in units of the rounding error of its time, below which it counts as an instant.
        const INSTANT: f64 = 1e4;
        let (width, centre) = (to - from, 0.5 * (from + to));
        if width < INSTANT * f64::EPSILON * to {
            return [self.at(centre), Six::default(), Six::default()];
        }
        let mut sums = [Six::default(); 3];
        if from < self.first_arrival {
            let until = to.min(self.first_arrival);
            let (length, arm) = (until - from, 0.5 * (until + from) - centre);
            for (f, value) in self.before.into_iter().enumerate() {
                let area = length * value;
                sums[0][f] += area;
                sums[1][f] += arm * area;
                sums[2][f] += (arm * arm + length * length / 12.0) * area;
            }
        }
        for segment in &self.segments[first..] {
            if segment.times[0] >= to {
                break;
            }
            let part = [from.max(segment.times[0]), to.min(segment.times[1])];
            if part[1] > part[0] {
                segment.add(part[0], part[1], centre, &mut sums);
            }
        }
        let [area, moment, second] = sums;
        let average = area.map(|v| v / width);
        [
            average,
            moment.map(|v| v / (width * width)),
            std::array::from_fn(|f| second[f] / width.powi(3) - average[f] / 12.0),
        ]
    }

    /// Calls `f` with the index and the average, first and second moment of each of `count` cells of `width`, from time
    /// zero.
    ///
    /// # Errors
    /// [`DomainError`] for a width outside [1e-20, 1e20], or for cells that end after the trace.
    pub fn for_each_cell(
        &self,
        width: f64,
        count: usize,
        mut f: impl FnMut(usize, [Six; 3]),
    ) -> Result<(), DomainError> {
        let range = NEAREST..=FARTHEST;
        check(range.contains(&width), "width", width, "[1e-20, 1e20]")?;
        let end = count as f64 * width;
        check(end <= self.end, "t", end, "[0, end of the trace]")?;
        let mut first = 0;
        for j in 0..count {
            let (from, to) = (j as f64 * width, (j + 1) as f64 * width);
            while first < self.segments.len() && self.segments[first].times[1] <= from {
                first += 1;
            }
            f(j, self.cell_from(first, from, to));
        }
        Ok(())
    }
}
