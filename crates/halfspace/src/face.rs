//! Mean over a circular face: of a sensor that does not stand on a point.
//!
//! The load is symmetric about its axis, so the mean over a face is one integral over the distance from the axis, weighted with the
//! arc of each circle that lies on the face. Components are Cartesian at the centre of the face, as a sensor measures them.
//!
//! Theory: `docs/theory.md` (T71).

use crate::arrivals::Arrivals;
use crate::domain::{DomainError, FARTHEST, check, check_place_under, check_time};
use crate::field::{Estimate, Field, Six};
use crate::kernel::Kernel;
use crate::numeric::gauss;
use crate::profile::Profile;
use crate::trace::{Signal, Trace};
use std::f64::consts::PI;

/// A circular face parallel to the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    /// Distance of its centre from the axis of the load.
    r: f64,
    radius: f64,
}

/// The circle around the axis of the load at one distance, with the weights of its arc on the face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arc {
    /// Distance from the axis.
    pub r: f64,
    /// Weight of w and szz.
    pub even: f64,
    /// Weight of u and srz, along the direction from the axis to the centre.
    pub odd: f64,
    /// Weights of srr and stt in the normal stress along that direction.
    pub along: [f64; 2],
}

impl Arc {
    /// Adds the fields on the circle to their means.
    pub fn add(&self, fields: &Six, mean: &mut Six) {
        let [u, w, rr, tt, zz, rz] = *fields;
        let [cosine, sine] = self.along;
        let own = [
            self.odd * u,
            self.even * w,
            cosine * rr + sine * tt,
            sine * rr + cosine * tt,
            self.even * zz,
            self.odd * rz,
        ];
        for (mean, own) in mean.iter_mut().zip(own) {
            *mean += own;
        }
    }
}

/// Distance of the centre, in radii of the face, from which on one rule serves that is made for plane waves; nearer to the axis
/// the arcs are not a smooth function of the distance times that of a chord.
const BESIDE: f64 = 1.5;

impl Face {
    /// A face of a radius > 0 whose centre is at a distance r >= 0 from the axis.
    ///
    /// # Errors
    /// [`DomainError`] for r outside [0, 1e20] or a radius outside (0, 1e20].
    pub fn new(r: f64, radius: f64) -> Result<Self, DomainError> {
        check((0.0..=FARTHEST).contains(&r), "r", r, "[0, 1e20]")?;
        let is_wide = radius > 0.0 && radius <= FARTHEST;
        check(is_wide, "face radius", radius, "(0, 1e20]")?;
        Ok(Self { r, radius })
    }

    /// The smallest and the largest distance from the axis of a point of its edge.
    pub fn edges(&self) -> [f64; 2] {
        [(self.r - self.radius).abs(), self.r + self.radius]
    }

    /// The smallest distance from the axis of a point of the face.
    pub fn nearest(&self) -> f64 {
        (self.r - self.radius).max(0.0)
    }

    /// Circles whose weighted sum is the mean of fields that are smooth over the face: `count` > 0 of them beside the axis, up to
    /// twice as many around it.
    ///
    /// Of a plane wave of k radius = x the sum is exact to about (x/2)^(2 count)/(2 count)!: 9e-8 of the amplitude for four circles at
    /// x = 1.
    pub fn arcs(&self, count: usize) -> Vec<Arc> {
        if self.r < BESIDE * self.radius {
            let [inner, outer] = self.edges();
            return self.between(&[self.nearest(), inner, outer], count);
        }
        let gaps = count as f64 + 1.0;
        let arc = |j: usize| {
            let angle = PI * (j + 1) as f64 / gaps;
            self.arc(
                self.radius * angle.cos(),
                self.radius * angle.sin() * PI / gaps,
            )
        };
        (0..count).map(arc).collect()
    }

    /// The circle at a distance beyond the centre, for an interval of distances.
    fn arc(&self, beyond: f64, interval: f64) -> Arc {
        let (r, radius) = (self.r + beyond, self.radius);
        // half of the angle of the arc, by its sine, which stays accurate at the edges
        let sine = (radius - beyond) * (radius + beyond) / (4.0 * r * self.r);
        let half = 2.0 * sine.clamp(0.0, 1.0).sqrt().asin();
        let unit = 2.0 * r * interval / (PI * radius * radius);
        let [mean, swing] = [0.5 * half, 0.25 * (2.0 * half).sin()];
        Arc {
            r,
            even: unit * half,
            odd: unit * half.sin(),
            along: [unit * (mean + swing), unit * (mean - swing)],
        }
    }

    /// Circles between ascending distances at which the fields, or the arcs, are not smooth, so many between two.
    ///
    /// The substitution r = middle - half cos(angle) takes away inverse roots at the ends.
    fn between(&self, breaks: &[f64], count: usize) -> Vec<Arc> {
        let rule = gauss::rule(count);
        let mut found = Vec::with_capacity(count * breaks.len());
        for pair in breaks.windows(2).filter(|pair| pair[1] > pair[0]) {
            let (middle, half) = (0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0]));
            for (angle, weight) in rule.on(0.0, PI) {
                let beyond = middle - half * angle.cos() - self.r;
                found.push(self.arc(beyond, weight * half * angle.sin()));
            }
        }
        found
    }

    /// Distances from the axis at which waves of a disc arrive at a depth and time, those of the edges of the face and of the disc,
    /// ascending.
    fn breaks(&self, kernel: &Kernel, z: f64, t: f64) -> Vec<f64> {
        let (medium, disc) = (kernel.medium(), kernel.profile().radius());
        let span = (medium.shear_slowness_squared() - 1.0).sqrt();
        let reached = |speed: f64| ((speed * t - z) * (speed * t + z)).max(0.0).sqrt();
        let waves = [
            reached(1.0),
            reached(medium.kappa()),
            t - z * span,
            medium.rayleigh_speed() * t,
        ];
        let [inner, outer] = self.edges();
        let mut found = vec![self.nearest(), inner, outer, disc];
        found.extend(waves.iter().flat_map(|e| [e - disc, disc - e, e + disc]));
        found.sort_by(f64::total_cmp);
        found.dedup_by(|one, other| (*one - *other).abs() < SHORTEST * outer);
        let mut graded = graded(&found);
        graded.retain(|r| (self.nearest()..=outer).contains(r));
        graded
    }
}

/// Shortest distance between two fronts that are told apart, over the largest distance of the face from the axis.
const SHORTEST: f64 = 1e-12;

/// Most that an interval is longer than the one next to it: a front just outside an interval is nearly a singularity in it.
/// `means_are_those_of_an_independent_integral` fails at 100.
const GROWS: f64 = 6.0;

/// Ascending places with more between them, so that no interval is much longer than its neighbour.
fn graded(places: &[f64]) -> Vec<f64> {
    let mut found = places.to_vec();
    for i in 1..places.len().saturating_sub(2) {
        let [before, from, to, after] = [i - 1, i, i + 1, i + 2].map(|k| places[k]);
        let half = 0.5 * (to - from);
        let steps = |gap: f64| {
            let sums = std::iter::successors(Some(GROWS * gap), |step| Some(step * GROWS));
            sums.take_while(move |step| *step < half)
        };
        found.extend(steps(from - before).map(|step| from + step));
        found.extend(steps(after - to).map(|step| to - step));
    }
    found.sort_by(f64::total_cmp);
    found
}

/// Circles between two fronts, and more for each digit of the tolerance: `tests/face.rs` fails with half as many.
const CIRCLES: f64 = 5.0;
const CIRCLES_A_DIGIT: f64 = 1.1;

impl Kernel {
    /// The mean of the static fields over a face at depth z.
    ///
    /// # Errors
    /// [`DomainError`] for z outside [0, 1e20], for a punch, and for a point force on the face.
    pub fn static_mean(&self, face: &Face, z: f64) -> Result<Six, DomainError> {
        self.check_face(face, z)?;
        let mut mean = Six::default();
        // no front has left the disc
        for arc in face.between(&face.breaks(self, z, 0.0), self.circles()) {
            arc.add(&self.static_field(arc.r, z)?, &mut mean);
        }
        Ok(mean)
    }

    /// The mean of R(t) over a face at depth z, like [`Kernel::trace_under`] at a point, to about the kernel's tolerance.
    ///
    /// It costs some tens of kernels for each kernel of a point. Where the force has no waves as short as the face,
    /// [`Face::arcs`] is cheaper.
    ///
    /// # Errors
    /// As [`Kernel::static_mean`], and for an end outside [0, 1e20].
    pub fn mean_trace_under(
        &self,
        face: &Face,
        z: f64,
        end: f64,
        wanted: (Six, &dyn Fn(f64) -> Six),
    ) -> Result<Trace, DomainError> {
        /// Its fronts are those of two edges of the face.
        const MOST_SEGMENTS: usize = 1000;
        let mean = self.static_mean(face, z)?;
        check_time(end)?;
        let (medium, disc) = (self.medium(), self.profile().radius());
        let mut fronts = vec![];
        for edge in face.edges().into_iter().chain([face.nearest()]) {
            fronts.extend(Arrivals::new(medium, self.profile(), edge, z)?.sorted());
        }
        fronts.sort_by(f64::total_cmp);
        fronts.dedup();
        let signal = Signal {
            first: (face.nearest() - disc).max(0.0).hypot(z),
            fronts,
            passing: None,
            before: mean.map(|s| -s),
            size: mean,
            most_segments: MOST_SEGMENTS,
        };
        Trace::of(signal, end, wanted, |t| {
            self.mean_remainder(face, z, t, &mean)
        })
    }

    /// The mean of R at a time, to an error in addition to those of the kernels.
    fn mean_remainder(
        &self,
        face: &Face,
        z: f64,
        t: f64,
        size: &Six,
    ) -> Result<Estimate, DomainError> {
        let mut found = Estimate {
            value: Six::default(),
            error: size.map(|s| self.tolerance() * s.abs()),
        };
        for arc in face.between(&face.breaks(self, z, t), self.circles()) {
            let own = self.remainder(arc.r, z, t)?;
            arc.add(&own.value, &mut found.value);
            arc.add(&own.error, &mut found.error);
        }
        for field in [Field::StressZz, Field::StressRz] {
            if z == 0.0 {
                found.value[field.index()] = 0.0;
            }
        }
        found.error = found.error.map(f64::abs);
        Ok(found)
    }

    fn circles(&self) -> usize {
        (CIRCLES - CIRCLES_A_DIGIT * self.tolerance().log10()) as usize
    }

    /// Rejects faces under which a field of the profile is infinite.
    fn check_face(&self, face: &Face, z: f64) -> Result<(), DomainError> {
        check_place_under(Profile::Hertz, face.r, z)?;
        let allowed = match self.profile() {
            Profile::Hertz => true,
            Profile::Punch => false,
            Profile::Point => z > 0.0 || face.r > face.radius,
        };
        let range = "r - radius > 0 for a point force on the surface; no face under a punch";
        check(allowed, "r", face.r, range)
    }
}
