//! How the mean over a sensor's face is computed: known from the force and the place before any kernel is.
//!
//! The mean over a face under a load is the field at its centre under the load spread over a disc as large as the face: a load
//! around the axis whose transform is that of the load times 2 J1(kb)/(kb). A few Hertz discs of about that radius stand for it at all
//! wave numbers, so that fronts that cross the face need no care. Their shares are fitted to the waves that the force has, and what
//! the fit leaves of these is the error.
//!
//! Where it leaves too much, the kernels themselves are averaged if the disc of the load is fixed and kernels are computed, and the
//! fields on circles otherwise.
//!
//! Theory: `docs/theory.md` (T71).

use crate::excitation::{Excitation, PressureRadius};
use crate::grid::Grid;
use crate::quantity::Derivative;
use crate::scene::{Scene, Sensor};
use contact::HalfSpace;
use num_complex::Complex64;
use realfft::RealFftPlanner;
use std::f64::consts::{PI, TAU};

/// Error of a mean by the stand-in for a face, over the tolerance, up to which it serves.
const OF_TOLERANCE: f64 = 0.5;

/// Peak of an error over its root mean square, both relative to those of the mean, of displacements, velocities and accelerations:
/// short waves pass at fronts. `means_over_faces_are_within_their_estimates` fails with a third of each.
const CREST: [f64; 3] = [3.0, 20.0, 60.0];

/// Radii of discs that stand for a face, over its radius: alone, and for the ratio of the radius of the load to it added so many
/// times. Optimised for waves whose amplitude falls with the power 1 to 2 of the wave number, and ratios up to 1/2.
const ALONE: [f64; 2] = [1.25, 1.0];
const TWO: [[f64; 2]; 2] = [[0.8, -0.2], [1.04, 0.4]];
const THREE: [[f64; 2]; 3] = [[0.6, -0.3], [0.9, -0.1], [1.02, 0.5]];
const FIVE: [[f64; 2]; 5] = [
    [0.45, 0.0],
    [0.7, 0.0],
    [0.9, 0.1],
    [1.0, 0.25],
    [1.013, 0.8],
];

/// Largest ratio of the radius of the load to that of the face for which discs stand for both.
const LARGEST_LOAD: f64 = 1.0;

/// Squared radii of a growing contact, over its largest, at which shares are fitted; between them they are parabolas.
const GROWN: [f64; 3] = [0.0, 0.5, 1.0];

/// The most circles.
const MOST_CIRCLES: usize = 24;

/// Samples of a force by which its spectrum is known: the fewest, which resolve its beginning and end, and the most.
const SAMPLES: [usize; 2] = [1024, 1 << 17];

/// Wave numbers times the radius of the face at which the fit is made: bounds, and how many to a decade.
const NUMBERS: [f64; 2] = [1e-3, 150.0];
const A_DECADE: f64 = 30.0;

/// Circles of the rule around the axis over those of the rule beside it, for the same error.
const AROUND: f64 = 0.6;

/// A share of the force as a polynomial in the squared radius of the load over the largest.
pub(crate) type Share = [f64; 3];

/// Whether discs may stand for a face under a load of a radius.
pub(crate) fn stands_in(radius_m: f64, face_m: f64) -> bool {
    face_m > 0.0 && radius_m <= LARGEST_LOAD * face_m
}

/// The smallest and the largest radius in m of discs that stand for a face under a load of a radius.
pub(crate) fn stand_in_radii(face_m: f64, radius_m: f64) -> [f64; 2] {
    let [[low, _], ..] = FIVE;
    [low * face_m, ALONE[0].sqrt() * face_m + radius_m]
}

/// Discs that stand for a load and a face.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FaceDiscs {
    pub(crate) radii_m: Vec<f64>,
    /// Of the force, of sum 1.
    pub(crate) shares: Vec<Share>,
    /// Relative to the peak of a mean.
    pub(crate) error: f64,
}

/// How a mean over a face is computed.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum MeanPlan {
    /// The face is a point.
    Point,
    /// Discs stand for the load and the face.
    Discs(FaceDiscs),
    /// A sum over so many circles, with this error relative to the peak; infinite where it is not known before.
    Circles(usize, f64),
    /// The kernels are averaged themselves.
    Exact,
}

/// The spectrum of the rate of a force: frequencies in Hz, amplitudes.
pub(crate) struct Content {
    parts: Vec<[f64; 2]>,
    rayleigh_m_s: f64,
    /// Of the load.
    radius_m: f64,
    follows: bool,
    /// Of the output, over which accelerations are means.
    step_s: f64,
}

/// Waves over the face.
struct Waves {
    /// Wave numbers times its radius, with the squared amplitudes of those near each.
    parts: Vec<[f64; 2]>,
    /// Their means over the face.
    means: Vec<f64>,
    crest: f64,
}

impl Content {
    /// Of the force of an excitation, for an output of some step.
    pub(crate) fn of(excitation: &Excitation, step_s: f64) -> Self {
        let (from_s, to_s) = (excitation.first_s(), excitation.end_s());
        let rows = excitation
            .record()
            .map_or(0, |record| record.time_s().len());
        let count = (2 * rows).clamp(SAMPLES[0], SAMPLES[1]);
        let gap_s = (to_s - from_s) / count as f64;
        let force_n = |i: usize| excitation.force_n(from_s + i as f64 * gap_s);
        // with as many zeros, so that the ends do not meet
        let mut rises = vec![0.0; 2 * count];
        for (i, rise) in rises[..count].iter_mut().enumerate() {
            *rise = force_n(i + 1) - force_n(i);
        }
        let transform = RealFftPlanner::new().plan_fft_forward(rises.len());
        let mut spectrum = vec![Complex64::ZERO; count + 1];
        // the lengths are those of the plan
        let done = transform.process(&mut rises, &mut spectrum).is_ok();
        let unit_hz = 1.0 / (2.0 * count as f64 * gap_s);
        let parts = spectrum.iter().enumerate().skip(1);
        let parts = parts.map(|(i, value)| [unit_hz * i as f64, value.norm()]);
        Self {
            parts: parts.filter(|_| done).collect(),
            rayleigh_m_s: excitation.speeds().rayleigh,
            radius_m: excitation.units().disc_radius_m,
            follows: matches!(excitation.radius(), PressureRadius::Following { .. }),
            step_s,
        }
    }

    /// Waves over a face, of displacements or their rates, and as much of a static field from a distance.
    fn waves(&self, face_m: f64, far_m: f64, derivative: Derivative) -> Waves {
        // Rayleigh waves grow with the root of the frequency
        let power = match derivative {
            Derivative::Field => -0.5,
            Derivative::First => 0.5,
            Derivative::Second => 1.5,
        };
        let decades = (NUMBERS[1] / NUMBERS[0]).log10();
        let count = (A_DECADE * decades) as usize;
        let number = |i: usize| NUMBERS[0] * 10_f64.powf((i as f64 + 0.5) / A_DECADE);
        let mut bins: Vec<[f64; 2]> = (0..count).map(|i| [number(i), 0.0]).collect();
        for &[frequency_hz, amplitude] in &self.parts {
            let number = TAU * frequency_hz * face_m / self.rayleigh_m_s;
            let place = (A_DECADE * (number / NUMBERS[0]).log10()).clamp(0.0, count as f64 - 1.0);
            let mean = match derivative {
                Derivative::First if self.follows => 1.0,
                Derivative::Field => 1.0,
                Derivative::First | Derivative::Second => {
                    (1.0 / (PI * frequency_hz * self.step_s)).min(1.0)
                }
            };
            // shorter ones are averaged as these at most
            let short = (NUMBERS[1] / number).min(1.0);
            let own = amplitude * frequency_hz.powf(power) * mean * short;
            bins[place as usize][1] += own * own;
        }
        let far = far_m / face_m;
        let rest = |number: f64| number / (1.0 + (number * far).powi(4));
        let [waves, still] = [
            bins.iter().map(|bin| bin[1]).sum::<f64>(),
            bins.iter().map(|bin| rest(bin[0])).sum::<f64>(),
        ];
        if derivative == Derivative::Field && still > 0.0 {
            for bin in &mut bins {
                bin[1] += waves / still * rest(bin[0]);
            }
        }
        Waves::new(bins, CREST[derivative as usize])
    }

    /// The plan of a face at a place in m, for derivatives of the displacement to a tolerance.
    pub(crate) fn plan(
        &self,
        [r_m, z_m]: [f64; 2],
        face_m: f64,
        (derivative, tolerance): (Derivative, f64),
        has_exact: bool,
    ) -> MeanPlan {
        if face_m == 0.0 {
            return MeanPlan::Point;
        }
        let allowed = OF_TOLERANCE * tolerance;
        let far_m = (r_m - face_m).max(0.0).hypot(z_m).max(0.1 * face_m);
        let waves = self.waves(face_m, far_m, derivative);
        let found = if stands_in(self.radius_m, face_m) {
            self.discs(&waves, face_m, allowed)
        } else {
            None
        };
        if let Some(discs) = found.as_ref().filter(|discs| discs.error <= allowed) {
            return MeanPlan::Discs(discs.clone());
        }
        let is_beside = r_m > 1.5 * face_m;
        let bends = bends_of(r_m, z_m, face_m, self.radius_m);
        let error = |count: usize| {
            let circles = count as f64 * if is_beside { 1.0 } else { AROUND };
            waves.beyond_circles(circles) + bends.powf(-2.0 * circles)
        };
        match (
            (1..=MOST_CIRCLES).find(|&count| error(count) <= allowed),
            found,
        ) {
            (Some(count), _) => MeanPlan::Circles(count, error(count)),
            // rates of records are means over steps, and no better
            (None, _) if has_exact && derivative == Derivative::Field => MeanPlan::Exact,
            (None, Some(discs)) => MeanPlan::Discs(discs),
            (None, None) => MeanPlan::Circles(MOST_CIRCLES, f64::INFINITY),
        }
    }

    /// The fewest discs that serve, or else the best.
    fn discs(&self, waves: &Waves, face_m: f64, allowed: f64) -> Option<FaceDiscs> {
        let load = self.radius_m / face_m;
        let alone = (ALONE[0] + ALONE[1] * load * load).sqrt();
        let sets: [&[[f64; 2]]; 4] = [&[[alone, 0.0]], &TWO, &THREE, &FIVE];
        let made = |set: &[[f64; 2]]| {
            let radii: Vec<f64> = set.iter().map(|[own, more]| own + more * load).collect();
            let (shares, left) = match self.follows {
                true => waves.fit_growing(&radii, load),
                false => {
                    let (shares, left) = waves.fit(&radii, load);
                    (
                        shares.into_iter().map(|own| [own, 0.0, 0.0]).collect(),
                        left,
                    )
                }
            };
            FaceDiscs {
                radii_m: radii.iter().map(|radius| radius * face_m).collect(),
                shares,
                error: waves.crest * left,
            }
        };
        let mut best: Option<FaceDiscs> = None;
        for discs in sets.into_iter().map(made) {
            if best.as_ref().is_none_or(|best| discs.error < best.error) {
                best = Some(discs);
            }
            if best.as_ref().is_some_and(|best| best.error <= allowed) {
                break;
            }
        }
        best
    }
}

impl Waves {
    fn new(parts: Vec<[f64; 2]>, crest: f64) -> Self {
        Self {
            means: parts.iter().map(|[x, _]| face(*x)).collect(),
            parts,
            crest,
        }
    }

    /// Root mean square of some numbers, one for each wave number, over that of the waves.
    fn mean(&self, of: impl IntoIterator<Item = f64>) -> f64 {
        let squares = self.parts.iter().map(|[_, square]| square);
        let sum: f64 = squares
            .clone()
            .zip(of)
            .map(|(square, own)| square * own * own)
            .sum();
        let all: f64 = squares.sum();
        if all > 0.0 { (sum / all).sqrt() } else { 0.0 }
    }

    /// Shares of the force on discs of some radii over that of the face that stand best for it under a load of such a radius, and the
    /// root mean square of what is left of the waves.
    fn fit(&self, radii: &[f64], load: f64) -> (Vec<f64>, f64) {
        /// Weight of the condition that the shares add up to 1, over all other rows.
        const WHOLE: f64 = 1e4;
        let all: f64 = self.parts.iter().map(|[_, square]| square).sum();
        let spread = |radius: f64| -> Vec<f64> {
            self.parts.iter().map(|[x, _]| disc(radius * x)).collect()
        };
        let weighted = |values: &[f64]| -> Vec<f64> {
            let rows = self.parts.iter().zip(values);
            let rows = rows.map(|([_, square], value)| square.sqrt() * value);
            rows.chain([WHOLE * all.sqrt()]).collect()
        };
        let mut left: Vec<f64> = spread(load)
            .iter()
            .zip(&self.means)
            .map(|(a, b)| a * b)
            .collect();
        let discs: Vec<Vec<f64>> = radii.iter().map(|&radius| spread(radius)).collect();
        let columns = discs.iter().map(|disc| weighted(disc)).collect();
        let shares = least_squares(columns, &weighted(&left));
        for (share, disc) in shares.iter().zip(&discs) {
            left.iter_mut()
                .zip(disc)
                .for_each(|(left, own)| *left -= share * own);
        }
        (shares, self.mean(left))
    }

    /// The same under a load that grows to such a radius: shares by its squared radius, and the largest that is left.
    fn fit_growing(&self, radii: &[f64], load: f64) -> (Vec<Share>, f64) {
        let [(none, first), (half, second), (whole, third)] =
            GROWN.map(|square| self.fit(radii, load * square.sqrt()));
        let parabola = |k: usize| {
            let [none, half, whole] = [&none, &half, &whole].map(|shares| shares[k]);
            let bend = 2.0 * (whole - 2.0 * half + none);
            [none, whole - none - bend, bend]
        };
        let shares = (0..radii.len()).map(parabola).collect();
        (shares, first.max(second).max(third))
    }

    /// Error of a sum over circles: (x/2)^(2 n)/(2 n)! of a wave.
    fn beyond_circles(&self, circles: f64) -> f64 {
        let order = 2.0 * circles;
        // Stirling
        let factorial = order * (order.ln() - 1.0) + 0.5 * (TAU * order).ln();
        let of = |x: f64| (order * (0.5 * x).ln() - factorial).exp().min(1.0);
        self.crest * self.mean(self.parts.iter().map(|[x, _]| of(*x)))
    }
}

/// Mean of a plane wave over a face of radius 1: 2 J1(x)/x, by the Gauss rule of its chords.
fn face(x: f64) -> f64 {
    let count = (0.5 * x) as usize + 16;
    let gap = PI / (count as f64 + 1.0);
    let term = |j: usize| {
        let angle = gap * (j + 1) as f64;
        angle.sin().powi(2) * (x * angle.cos()).cos()
    };
    2.0 / (count as f64 + 1.0) * (0..count).map(term).sum::<f64>()
}

/// Hertz's pressure on a disc of radius 1: 3 j1(x)/x.
fn disc(x: f64) -> f64 {
    const SMALL: f64 = 0.02;
    if x.abs() < SMALL {
        return 1.0 - x * x / 10.0;
    }
    3.0 * (x.sin() - x * x.cos()) / (x * x * x)
}

/// The combination of some columns that is nearest to another, by Gram and Schmidt's orthogonalisation, twice.
fn least_squares(columns: Vec<Vec<f64>>, wanted: &[f64]) -> Vec<f64> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let count = columns.len();
    let (mut units, mut upper): (Vec<Vec<f64>>, _) = (vec![], vec![vec![0.0; count]; count]);
    for (k, mut column) in columns.into_iter().enumerate() {
        for _ in 0..2 {
            for (j, unit) in units.iter().enumerate() {
                let part = dot(unit, &column);
                upper[j][k] += part;
                column
                    .iter_mut()
                    .zip(unit)
                    .for_each(|(x, y)| *x -= part * y);
            }
        }
        let length = dot(&column, &column).sqrt().max(f64::MIN_POSITIVE);
        upper[k][k] = length;
        column.iter_mut().for_each(|x| *x /= length);
        units.push(column);
    }
    let mut found = vec![0.0; count];
    for k in (0..count).rev() {
        let known: f64 = (k + 1..count).map(|j| upper[k][j] * found[j]).sum();
        found[k] = (dot(&units[k], wanted) - known) / upper[k][k];
    }
    found
}

/// How fast the error of a sum over circles falls with each, by the static field: the sum of half-axes of the ellipse around the face
/// on which the nearest edge of the load lies, in radii of the face.
fn bends_of(r_m: f64, z_m: f64, face_m: f64, radius_m: f64) -> f64 {
    let edge = [r_m - radius_m, r_m + radius_m];
    let of = |r_m: f64| {
        let place = Complex64::new(r_m, z_m) / face_m;
        let root = (place * place - 1.0).sqrt();
        (place + root).norm().max((place - root).norm())
    };
    edge.map(of).into_iter().fold(f64::INFINITY, f64::min)
}

/// Whether the mean of a kernel itself can be computed: under a disc of fixed radius, on a half-space.
pub(crate) fn has_exact(excitation: &Excitation, is_computed: bool, block: &HalfSpace) -> bool {
    let is_fixed = matches!(excitation.radius(), PressureRadius::Fixed(_));
    is_fixed && is_computed && block.echoing().is_none()
}

/// Plans of the means over the faces of a scene's sensors, by computed kernels or a table's.
pub(crate) fn plans(scene: &Scene, grid: &Grid<'_>, is_computed: bool) -> Vec<MeanPlan> {
    let faces = scene.sensors.iter().map(|sensor| sensor.face_radius_m);
    if faces.fold(0.0, f64::max) == 0.0 {
        return vec![MeanPlan::Point; scene.sensors.len()];
    }
    let content = Content::of(grid.excitation, grid.step_s);
    let has_exact = has_exact(grid.excitation, is_computed, &scene.target);
    let plan = |sensor: &Sensor| {
        let place_m = [sensor.r_m, sensor.z_m];
        let asked = (sensor.measured.derivative(), grid.tolerance);
        content.plan(place_m, sensor.face_radius_m, asked, has_exact)
    };
    scene.sensors.iter().map(plan).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 2 J1(1) and 2 J1(2)/2, and the first zero of J1.
    #[test]
    fn a_face_is_a_bessel_function() {
        assert!((face(1.0) - 0.880_101_171_5).abs() < 1e-10);
        assert!((face(2.0) - 0.576_724_807_8).abs() < 1e-10);
        assert!(face(3.831_705_970_2).abs() < 1e-10);
        // far out: sqrt(8/pi) x^-1.5 cos(x - 3 pi/4)
        let far = (8.0 / PI).sqrt() * 100_f64.powf(-1.5) * (100.0 - 0.75 * PI).cos();
        assert!((face(100.0) - far).abs() < 1e-5);
    }

    /// Five discs stand for a face at all wave numbers.
    #[test]
    fn discs_stand_for_a_face() {
        let numbers = (0..3000).map(|i| 0.05 * (f64::from(i) + 0.5));
        let parts = numbers.map(|x| [x, 1.0 / (1.0 + x * x).powi(2)]);
        let waves = Waves::new(parts.collect(), 1.0);
        for (load, most) in [(0.0, 2e-5), (0.1, 3e-5), (0.3, 5e-5)] {
            let radii: Vec<f64> = FIVE.iter().map(|[own, more]| own + more * load).collect();
            let (shares, left) = waves.fit(&radii, load);
            assert!(
                (shares.iter().sum::<f64>() - 1.0).abs() < 1e-6,
                "{shares:?}"
            );
            assert!(left < most, "{load} {left:e} {shares:?}");
        }
    }
}
