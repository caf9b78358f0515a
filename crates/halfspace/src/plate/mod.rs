//! A plate with two free faces: what its echoes add to the response of the half-space.
//!
//! Waves that have run over m legs between the faces are a sum over n of waves that were longitudinal over n legs and
//! shear over m - n, in any order (generalized rays). In the scaling of the half-space each is the same single integral
//!
//! ```text
//! f(t) = 1/pi Im int dq/q G(q) [Psi(Gamma - qt) + Psi(Gamma + qt)],     Gamma = (n a + (m - n) b) H + (a or b) zeta
//! ```
//!
//! with the potentials Psi of the half-space. The path runs to the right of the poles at q = 0 and q = ic, whose order
//! grows with the legs, and left of the fronts; from q = i kappa on it is the imaginary axis.
//!
//! Theory: `docs/theory.md` (T68, T69).

mod cuts;
mod integrand;
mod quadrature;
mod rays;
mod reflection;

use crate::domain::{DomainError, check, check_hertz, check_place, check_time};
use crate::field::{Estimate, Field, Point, Six};
use crate::kernel::Kernel;
use crate::trace::{Signal, Trace};
use cuts::{pieces, root_of_falling, roots_of_concave};

use integrand::{Integrand, Part};
use quadrature::Panels;
pub use rays::{Echo, Rays};
use rays::{Place, arrival, head, passed};
use reflection::MOST_LEGS;
use std::f64::consts::PI;

/// A plate of infinite width with free faces, under a Hertz load on the upper one.
///
/// Reduced units as those of [`Kernel`]; the thickness H is in r0.
///
/// Accuracy, over 1/R for displacements and 1/R^2 for stresses with R = 1 + sqrt(r^2 + H^2): to six transits H/c1 errors are below
/// a fifth of a tolerance of 1e-4 and below one of 1e-6, at 400 random points of plates of 0.1 to 1,000 radii. The waves of each m
/// grow and cancel, so that digits are lost with time: to 1.5e-5 at 12 transits and 1e-2 at 16, and far out along a plate, beyond
/// ten thicknesses, earlier. [`Estimate::error`] counts that. One or two fields in a hundred are above it, by up to fifty times,
/// most of them where the error is far below the tolerance (`cargo test -p hertzlamb-halfspace estimates_are -- --nocapture`).
///
/// ```
/// use halfspace::{Field, Kernel, Medium, Plate, Profile};
/// let kernel = Kernel::new(&Medium::new(0.25)?, Profile::Hertz, 1e-8)?;
/// let plate = Plate::new(&kernel, 4.0)?;
/// let w = Field::DisplacementZ.index();
/// // opposite the load the first P wave of a half-space is about doubled by the free face
/// let alone = kernel.static_field(0.0, 4.0)?[w] + kernel.remainder(0.0, 4.0, 4.01)?.value[w];
/// let echo = plate.echoes(0.0, 4.0, 4.01)?.value[w];
/// assert!((echo / alone - 1.0).abs() < 0.02);
/// # Ok::<(), halfspace::DomainError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Plate {
    kernel: Kernel,
    rays: Rays,
}

/// Errors of a panel over the tolerance, and the finest tolerance that is reached at late times.
const OF_TOLERANCE: f64 = 0.1;
const FINEST: f64 = 1e-8;

/// Part of the way to the fronts at which the path begins, and the farthest begin: nearer to the poles rounding errors grow, to
/// 1e-2 at 12 transits with a farthest begin of 0.35; `echoes_do_not_depend_on_the_path` fails at 0.85, and the second at 2.
const SAFE: f64 = 0.75;
const FARTHEST: f64 = 1.0;

/// Pieces of an interval in which no front is narrow.
const QUARTERS: [f64; 4] = [0.0, 0.25, 0.5, 0.75];

/// Width of a front on the path below which it is a break, widths from it to the breaks around it, and distance of breaks.
const NARROW: f64 = 0.1;
const WIDE: f64 = 3.0;
const SAME_BREAK: f64 = 1e-3;

impl Plate {
    /// Most legs of a wave, and the latest time in transits H/c1.
    pub const MOST_LEGS: usize = MOST_LEGS;

    /// Of the material, load and accuracy of a kernel.
    ///
    /// # Errors
    /// [`DomainError`] for a thickness outside (0, 1e20], and for a profile other than Hertz.
    pub fn new(kernel: &Kernel, thickness: f64) -> Result<Self, DomainError> {
        check(
            thickness > 0.0 && thickness <= 1e20,
            "thickness",
            thickness,
            "(0, 1e20]",
        )?;
        check_hertz(kernel.profile(), "a plate")?;
        Ok(Self {
            kernel: kernel.clone(),
            rays: Rays {
                thickness,
                legs: MOST_LEGS,
                shear: kernel.medium().shear_slowness_squared(),
            },
        })
    }

    /// With waves of so many legs between the faces at most; 16 otherwise, which is the largest number.
    ///
    /// The sum is exact until a wave with one leg more arrives.
    #[must_use]
    pub fn up_to(mut self, legs: usize) -> Self {
        self.rays.legs = legs.min(MOST_LEGS);
        self
    }

    /// The latest time of an echo in r0/c1.
    pub fn latest(&self) -> f64 {
        MOST_LEGS as f64 * self.rays.thickness
    }

    /// The echoes at (r, z) until `end`, with the accuracy needed for a force that changes by at most `rise` of its peak within a
    /// time: as [`Kernel::trace_under`], relative to the fields of the half-space where these are larger.
    ///
    /// After [`Self::latest`] they keep the last value.
    ///
    /// # Errors
    /// [`DomainError`] for a place outside the plate.
    pub fn trace_under(
        &self,
        r: f64,
        z: f64,
        end: f64,
        (tolerance, rise): (Six, &dyn Fn(f64) -> Six),
    ) -> Result<Trace, DomainError> {
        /// Segments of a trace with all fronts of 16 legs: several hundred.
        const MOST_SEGMENTS: usize = 2000;
        self.check_inside(r, z)?;
        check_time(end)?;
        let last = end.min(self.latest());
        let waves = self.waves(r, z, last);
        let below = r < self.kernel.profile().radius();
        let mut fronts = vec![];
        for Waves {
            distances,
            arrivals,
            ..
        } in &waves
        {
            fronts.extend(arrivals);
            fronts.extend(below.then(|| arrival(0.0, *distances, self.rays.shear)));
            if distances[0] == 0.0 {
                let heads = self
                    .edges(r)
                    .map(|e| head(e, distances[1], self.rays.shear));
                fronts.extend(heads.into_iter().flatten());
            }
        }
        fronts.sort_by(f64::total_cmp);
        let first = fronts.first().copied().unwrap_or(f64::INFINITY);
        fronts.retain(|t| *t < last);
        let signal = Signal {
            fronts,
            passing: None,
            first,
            before: Six::default(),
            size: self.kernel.static_field(r, z)?,
            most_segments: MOST_SEGMENTS,
        };
        let value = |t: f64| {
            let t = t.min(self.latest());
            Ok(self.echoes_of(&waves, Point { r, z, t }))
        };
        Trace::of(signal, end, (tolerance, rise), value)
    }

    fn check_inside(&self, r: f64, z: f64) -> Result<(), DomainError> {
        check_place(r, z)?;
        check(z <= self.rays.thickness, "z", z, "[0, thickness]")
    }

    /// The echoes at (r, z) at a time, which add to the step response of the half-space: on the lower face the reflection of
    /// the wave that arrives there is one of them.
    ///
    /// # Errors
    /// [`DomainError`] for a place outside the plate, and for a time after 16 transits H/c1.
    pub fn echoes(&self, r: f64, z: f64, t: f64) -> Result<Estimate, DomainError> {
        self.check_inside(r, z)?;
        check_time(t)?;
        check(
            t <= self.latest(),
            "t",
            t,
            "up to 16 transits of the plate by P waves",
        )?;
        Ok(self.echoes_of(&self.waves(r, z, t), Point { r, z, t }))
    }

    /// The echoes of waves that are known.
    fn echoes_of(&self, waves: &[Waves], at: Point) -> Estimate {
        let panels = self.sum(at, SAFE, waves);
        let mut found = Estimate::default();
        for f in 0..6 {
            found.value[f] = panels.value[f] / PI;
            found.error[f] = panels.error[f] / PI;
        }
        // on the upper face both tractions of the half-space are those of the load already
        if self.rays.place(at.z) == Place::Upper {
            for field in [Field::StressZz, Field::StressRz] {
                found.value[field.index()] = 0.0;
                found.error[field.index()] = 0.0;
            }
        }
        found
    }

    /// All waves at a place that can arrive until a time, and perhaps more.
    fn waves(&self, r: f64, z: f64, until: f64) -> Vec<Waves> {
        let edges = self.edges(r);
        let of = |(m, n, wave): (usize, usize, usize)| {
            let distances = self.rays.distances(m, n, z, wave);
            Waves {
                m,
                n,
                wave,
                distances,
                arrivals: edges.map(|e| arrival(e, distances, self.rays.shear)),
            }
        };
        let may_arrive = |&(m, ..): &(usize, usize, usize)| self.rays.distance(m, z) < until;
        self.rays.groups(z).take_while(may_arrive).map(of).collect()
    }

    /// Distances along the plate from the nearest and the farthest edge of the load.
    fn edges(&self, r: f64) -> [f64; 2] {
        let radius = self.kernel.profile().radius();
        [(r - radius).abs(), r + radius]
    }

    /// The sum over all waves that have arrived; the path keeps to a part `safe` of the way to the fronts.
    fn sum(&self, at: Point, safe: f64, waves: &[Waves]) -> Panels {
        let mut panels = Panels::default();
        let size = 1.0 + at.r.hypot(self.rays.thickness);
        let own = OF_TOLERANCE * self.kernel.tolerance().max(FINEST);
        let mut allowed: Six = [own / (size * size); 6];
        (allowed[0], allowed[1]) = (own / size, own / size);
        let across = (at.r - self.kernel.profile().radius()).max(0.0);
        let arrived = |m: &usize| across.hypot(self.rays.distance(*m, at.z)) < at.t;
        let counted = (1..=self.rays.legs).filter(|m| self.rays.counts(*m, at.z));
        for m in counted.take_while(arrived) {
            let waves = || waves.iter().filter(move |waves| waves.m == m);
            let (delta, breaks) = self.path(at, safe, waves());
            let path = Integrand {
                plate: self,
                at,
                m,
                delta,
                part: Part::Path,
            };
            let slow = Integrand {
                part: Part::Slow,
                ..path
            };
            for piece in breaks.windows(2) {
                panels.add([piece[0], piece[1]], &allowed, |nodes| path.values(nodes));
            }
            for begin in QUARTERS {
                panels.add([begin, begin + 0.25], &allowed, |nodes| slow.values(nodes));
            }
            for waves in waves() {
                if waves.distances[0] == 0.0 {
                    self.shear(&path, waves, &allowed, &mut panels);
                }
                self.fast(&path, waves, &allowed, &mut panels);
            }
        }
        panels
    }

    /// How far to the right of the imaginary axis the path begins, right of the poles and left of the fronts, and its pieces: one
    /// panel may miss the narrow peak beside a front.
    fn path<'w>(
        &self,
        at: Point,
        safe: f64,
        waves: impl Iterator<Item = &'w Waves>,
    ) -> (f64, Vec<f64>) {
        let kappa = self.kernel.medium().kappa();
        let edges = self.edges(at.r);
        let mut fronts = vec![];
        for waves in waves {
            for (e, arrival) in edges.into_iter().zip(waves.arrivals) {
                if arrival < at.t {
                    fronts.extend(passed(e, waves.distances, at.t, self.rays.shear));
                }
            }
        }
        // the others pass on the right of its end
        fronts.retain(|q| q.im < kappa);
        let nearest = fronts.iter().map(|q| q.re).fold(f64::INFINITY, f64::min);
        let delta = FARTHEST.min(safe * nearest);
        let mut breaks = vec![];
        for q in fronts {
            let part = q.im / kappa;
            let place = 1.0 - (1.0 - part).sqrt();
            let apart = q.re - delta * (1.0 - part.powi(6));
            let width = apart / (2.0 * kappa * (1.0 - place));
            if width < NARROW {
                let around = [-WIDE, 0.0, WIDE].map(|w| place + w * width);
                breaks.extend(around.into_iter().filter(|v| *v > 0.0 && *v < 1.0));
            }
        }
        breaks.sort_by(f64::total_cmp);
        breaks.dedup_by(|b, a| *b - *a < SAME_BREAK);
        breaks.extend(QUARTERS);
        breaks.push(1.0);
        breaks.sort_by(f64::total_cmp);
        (delta, breaks)
    }

    /// Adds the waves that were shear over all of their way, at slownesses between one and 1/kappa.
    fn shear(&self, path: &Integrand<'_>, waves: &Waves, allowed: &Six, panels: &mut Panels) {
        let at = path.at;
        let span = (self.rays.shear - 1.0).sqrt();
        let place = |v: f64| {
            let inverse = 1.0 / (1.0 + v * v);
            let (sin, cos) = (2.0 * v * inverse, (1.0 - v * v) * inverse);
            let x = (1.0 + (span * sin).powi(2)).sqrt();
            (x, span * cos * waves.distances[1])
        };
        let own = Integrand {
            part: Part::Shear,
            ..*path
        };
        let cuts = [-1.0, 1.0].map(|sense| self.cuts(at, waves, place, sense));
        for piece in pieces(cuts.concat()) {
            panels.add([0.0, 1.0], allowed, |nodes| own.on(piece, nodes));
        }
    }

    /// Adds waves at slownesses below one.
    fn fast(&self, path: &Integrand<'_>, waves: &Waves, allowed: &Six, panels: &mut Panels) {
        let (at, [as_p, as_s]) = (path.at, waves.distances);
        let place = |u: f64| {
            let inverse = 1.0 / (1.0 + u * u);
            let (x, p) = (2.0 * u * inverse, (1.0 - u * u) * inverse);
            (x, as_p * p + as_s * (self.rays.shear - x * x).sqrt())
        };
        let Waves { n, wave, .. } = *waves;
        for sense in [-1.0, 1.0] {
            let own = Integrand {
                part: Part::Fast { n, wave, sense },
                ..*path
            };
            for piece in pieces(self.cuts(at, waves, place, sense)) {
                let (x, vertical) = place(0.5 * (piece[0] + piece[1]));
                if ((vertical + sense * at.t) / x).abs() < self.edges(at.r)[1] {
                    panels.add([0.0, 1.0], allowed, |nodes| own.on(piece, nodes));
                }
            }
        }
    }

    /// Places in [0, 1] at which the fronts `vertical + sense t = e x` of a wave pass; `place` gives x and `vertical`.
    fn cuts(
        &self,
        at: Point,
        waves: &Waves,
        place: impl Fn(f64) -> (f64, f64),
        sense: f64,
    ) -> Vec<f64> {
        let mut found = vec![];
        for (e, arrival) in self.edges(at.r).into_iter().zip(waves.arrivals) {
            for e in [-e, e] {
                // a wave that comes is latest at its arrival
                if sense < 0.0 && e <= 0.0 && arrival <= at.t {
                    continue;
                }
                let height = |v: f64| {
                    let (x, vertical) = place(v);
                    vertical + sense * at.t - e * x
                };
                match sense < 0.0 && e < 0.0 {
                    true => roots_of_concave(&height, &mut found),
                    false => found.extend(root_of_falling(&height)),
                }
            }
        }
        found
    }
}

/// Waves of m legs, n of them as P, whose last part is P (0) or S (1), at a place.
struct Waves {
    m: usize,
    n: usize,
    wave: usize,
    /// Vertical, as P and as S.
    distances: [f64; 2],
    /// From the nearest and the farthest edge of the load.
    arrivals: [f64; 2],
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::medium::Medium;
    use crate::numeric::random::Stream;
    use crate::profile::Profile;

    /// Between the poles and the fronts the integral does not depend on the path: 200 points of random plates, on both faces
    /// and inside, to ten transits.
    #[test]
    fn echoes_do_not_depend_on_the_path() {
        let mut random = Stream::new(7);
        let mut count = 0;
        while count < 200 {
            let thickness = 10_f64.powf(1.5 * random.next() - 0.3);
            let medium = Medium::new(0.05 + 0.42 * random.next()).unwrap();
            let kernel = Kernel::new(&medium, Profile::Hertz, 1e-8).unwrap();
            let plate = Plate::new(&kernel, thickness).unwrap();
            let places = [0.0, thickness, thickness * random.next()];
            let z = places[(3.0 * random.next()) as usize];
            let r = 10_f64.powf(2.0 * random.next() - 0.7);
            let t = r + thickness * (1.0 + 9.0 * random.next());
            if t > 10.0 * thickness {
                continue;
            }
            count += 1;
            let [one, other] = [0.7, 0.78].map(|safe| {
                plate
                    .sum(Point { r, z, t }, safe, &plate.waves(r, z, t))
                    .value
            });
            let size = 1.0 + r.hypot(thickness);
            for f in 0..6 {
                let unit = if f < 2 { size } else { size * size };
                let off = (one[f] - other[f]).abs() * unit;
                assert!(
                    off < 1e-5,
                    "field {f} at {r}, {z}, {t} of {thickness}: {off:.1e}"
                );
            }
        }
    }

    /// Of random plates, places and instants how many fields are above their estimate, by how much, and the median of estimate
    /// over error; the reference has another path and a finer tolerance.
    #[test]
    fn estimates_are_those_of_the_errors() {
        for (tolerance, last) in [
            (1e-4, 6.0),
            (1e-6, 6.0),
            (1e-6, 12.0),
            (1e-8, 12.0),
            (1e-6, 16.0),
        ] {
            let mut random = Stream::new(11);
            let (mut below, mut worst, mut largest) = (0, 0.0_f64, 0.0_f64);
            let mut ratios = vec![];
            for _ in 0..400 {
                let thickness = 10_f64.powf(4.0 * random.next() - 1.0);
                let medium = Medium::new(0.48 * random.next()).unwrap();
                let of = |tolerance: f64| {
                    let kernel = Kernel::new(&medium, Profile::Hertz, tolerance).unwrap();
                    Plate::new(&kernel, thickness).unwrap()
                };
                let plate = of(tolerance);
                let places = [0.0, thickness, thickness * random.next()];
                let z = places[(3.0 * random.next()) as usize];
                let r = if random.next() < 0.1 {
                    0.0
                } else {
                    thickness.max(1.0) * 10_f64.powf(2.5 * random.next() - 1.5)
                };
                let t = thickness * (last - 3.0 * random.next());
                let found = plate.echoes(r, z, t).unwrap();
                let exact = of(1e-9).sum(Point { r, z, t }, 0.68, &plate.waves(r, z, t));
                let size = 1.0 + r.hypot(thickness);
                let fields = if plate.rays.place(z) == Place::Upper {
                    0..4
                } else {
                    0..6
                };
                for f in fields {
                    let off = (found.value[f] - exact.value[f] / PI).abs();
                    assert!(off.is_finite() && found.error[f].is_finite());
                    let bound = found.error[f] + exact.error[f] / PI;
                    if off > bound {
                        below += 1;
                        worst = worst.max(off / bound);
                    }
                    largest = largest.max(off * if f < 2 { size } else { size * size });
                    if off > 0.0 {
                        ratios.push(found.error[f] / off);
                    }
                }
            }
            ratios.sort_by(f64::total_cmp);
            assert!(20 * below < ratios.len() && ratios[ratios.len() / 2] > 10.0);
            println!(
                "tolerance {tolerance:e} to {last} transits: {} fields, {below} above the estimate, by {worst:.1}, largest error {largest:.1e}, estimate over error {:.0}",
                ratios.len(),
                ratios[ratios.len() / 2]
            );
        }
    }
}
