//! Deflection of the loaded surface under its own load: closed spectral form, finite memory.
//!
//! The impact equation needs one number of the half-space, the deflection under the striker.
//! At z = 0 the single integral of the kernels collapses to a positive measure over slowness,
//!
//! ```text
//! 1 - W(t) = int phi(t/x) dmu(x),   dmu = 2 K/(pi (1 - nu)) Re[p/R] dx  on 0 < x < 1/kappa,
//!                                       + m_R delta(x - 1/c),   m_R = 2 a c K/((1 - nu) D'(c))
//! p = sqrt(1 - x^2),  y = sqrt(K - x^2),  K = 1/kappa^2,  R = (2 x^2 - K)^2 + 4 x^2 p y,  a = sqrt(1 - c^2)
//! ```
//!
//! of total mass one.
//! phi is the chord function of the load: 1 - eta^2 on [0, 1] for the centre of a Hertz disc
//! and (2 - eta)^3 (eta^2 + 6 eta + 4)/32 on [0, 2] for its pressure-weighted mean.
//! Since phi has bounded support the response is exactly static after the last Rayleigh wave.

use crate::gauss;
use crate::medium::Medium;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::OnceLock;

/// Which deflection of the loaded disc is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Deflection {
    /// w(0, 0, t), the centre of the disc: the paper's choice.
    Centre,
    /// The pressure-weighted mean of w(r, 0, t) over the disc: work-conjugate to the force.
    Mean,
}

/// Step response of the deflection of a Hertz-loaded disc on the surface of a half-space.
///
/// Time is reduced by r0/c1, deflection by P/(mu r0).
/// The deflection under a suddenly applied unit force is
/// [`static_compliance`](Self::static_compliance) times [`step`](Self::step).
///
/// Accuracy: 1e-13 for nu in [-0.5, 0.4999], tested against the closed form of Kausel (2012).
///
/// ```
/// use halfspace::{Deflection, Medium, SurfaceResponse};
/// let medium = Medium::new(0.25)?;
/// let centre = SurfaceResponse::new(&medium, Deflection::Centre);
/// // W(T = 1) = 0.924305551263 with T = c2 t/r0, from the closed form of Kausel (2012)
/// assert!((centre.step(1.0 / medium.kappa()) - 0.924305551263).abs() < 1e-11);
/// # Ok::<(), halfspace::DomainError>(())
/// ```
#[derive(Debug, Clone)]
pub struct SurfaceResponse {
    deflection: Deflection,
    static_compliance: f64,
    shear_slowness: f64,
    rayleigh_slowness: f64,
    rayleigh_mass: f64,
    relaxation_time: f64,
    /// Step response and its integral, for each zone.
    curves: [[Curve; 2]; 2],
    /// Impulse response for each zone, fitted when it is first asked for.
    impulse: OnceLock<[Curve; 2]>,
    medium: Medium,
}

impl SurfaceResponse {
    /// Prepares the response of `medium`: some hundred microseconds, then nanoseconds a value.
    #[must_use]
    pub fn new(medium: &Medium, deflection: Deflection) -> Self {
        let spectrum = Spectrum::new(medium);
        let chord = Chord::new(deflection);
        let total = spectrum.total();
        let relaxation_time = chord.integral(chord.support) * total[0];
        let curves = [Zone::Fast, Zone::Slow].map(|zone| {
            let fit = |f: &dyn Fn(f64, &Moments) -> f64| {
                Curve::fit(zone, |panel, angle| {
                    let t = chord.support * zone.slowness(spectrum.k, angle);
                    f(t, &spectrum.above(zone, panel, angle))
                })
            };
            let step = fit(&|t, above| 1.0 - chord.overlap(t, above));
            let integral = fit(&|t, above| t - chord.overlap_integral(t, &total, above));
            [step, integral]
        });
        Self {
            deflection,
            static_compliance: chord.static_share * (1.0 - medium.poisson_ratio()),
            shear_slowness: spectrum.k.sqrt(),
            rayleigh_slowness: spectrum.rayleigh_slowness,
            rayleigh_mass: spectrum.rayleigh_mass,
            relaxation_time,
            curves,
            impulse: OnceLock::new(),
            medium: medium.clone(),
        }
    }

    /// Which deflection this is.
    #[must_use]
    pub fn deflection(&self) -> Deflection {
        self.deflection
    }

    /// Static deflection under unit force, in 1/(mu r0): 3 (1 - nu)/8 at the centre, 4/5 of it in the mean.
    #[must_use]
    pub fn static_compliance(&self) -> f64 {
        self.static_compliance
    }

    /// Time after which the response is exactly static, in r0/c1: c1/c_R at the centre, twice that in the mean.
    #[must_use]
    pub fn memory(&self) -> f64 {
        self.chord().support * self.rayleigh_slowness
    }

    /// int_0^inf (1 - W) dt in r0/c1: the first-order memory of the half-space.
    ///
    /// The J of the radiation law is kappa times [`Self::static_compliance`] times this.
    #[must_use]
    pub fn relaxation_time(&self) -> f64 {
        self.relaxation_time
    }

    /// W(t): step response over its static value; 0 for t <= 0, 1 for t >= [`Self::memory`].
    #[must_use]
    pub fn step(&self, t: f64) -> f64 {
        if t.is_nan() || t <= 0.0 {
            return 0.0;
        }
        self.fitted(t, 0).unwrap_or_else(|| {
            1.0 - self.rayleigh_mass * self.chord().value(t / self.rayleigh_slowness)
        })
    }

    /// int_0^t W dt; t - [`Self::relaxation_time`] once the response is static.
    #[must_use]
    pub fn step_integral(&self, t: f64) -> f64 {
        if t.is_nan() || t <= 0.0 {
            return 0.0;
        }
        self.fitted(t, 1).unwrap_or_else(|| {
            let chord = self.chord();
            let late = chord.integral(chord.support) - chord.integral(t / self.rayleigh_slowness);
            t - self.relaxation_time + self.rayleigh_mass * self.rayleigh_slowness * late
        })
    }

    /// W'(t), in c1/r0: the impulse response over its integral, the static value.
    ///
    /// ```text
    /// W'(t) = -int phi'(t/x) dmu(x)/x = -sum_k k a_k t^(k-1) M_k(t),   M_k(t) = int_{x > t/support} x^(-k) dmu
    /// ```
    ///
    /// The limit from above at t = 0, where [`Self::static_compliance`] times it is kappa^2 Z(0) for
    /// the centre, (32); 0 for t < 0 and for t >= [`Self::memory`], where the centre jumps.
    /// The sampled kernel of the paper's scheme (41).
    /// The first call takes as long as [`Self::new`]. Accuracy 1e-11 of the value at t = 0.
    #[must_use]
    pub fn impulse(&self, t: f64) -> f64 {
        if t.is_nan() || t < 0.0 {
            return 0.0;
        }
        let chord = self.chord();
        let x = t / chord.support;
        let Some(zone) = Zone::of(x, self.shear_slowness) else {
            let eta = t / self.rayleigh_slowness;
            return if eta < chord.support {
                let terms = chord.terms(eta).filter(|&(k, _)| k > 0);
                let slope: f64 = terms.map(|(k, term)| f64::from(k) * term / eta).sum();
                -self.rayleigh_mass * slope / self.rayleigh_slowness
            } else {
                0.0
            };
        };
        let curves = self.impulse.get_or_init(|| {
            let spectrum = Spectrum::new(&self.medium);
            [Zone::Fast, Zone::Slow].map(|zone| {
                Curve::fit(zone, |panel, angle| {
                    let t = chord.support * zone.slowness(spectrum.k, angle);
                    let above = spectrum.above(zone, panel, angle);
                    let terms = chord.terms(t).zip(&above[1..]);
                    -terms
                        .map(|((k, term), moment)| f64::from(k) * term * moment)
                        .sum::<f64>()
                        / t
                })
            })
        });
        curves[zone as usize].value(zone, zone.angle(self.shear_slowness, x))
    }

    /// The fitted curve at t, or nothing where only the Rayleigh wave is left.
    fn fitted(&self, t: f64, which: usize) -> Option<f64> {
        let x = t / self.chord().support;
        let zone = Zone::of(x, self.shear_slowness)?;
        let angle = zone.angle(self.shear_slowness, x);
        Some(self.curves[zone as usize][which].value(zone, angle))
    }

    fn chord(&self) -> Chord {
        Chord::new(self.deflection)
    }
}

/// Powers of 1/x whose integrals over slowness carry every chord function.
const POWERS: [i32; 5] = [-1, 0, 2, 3, 5];

/// int x^{-k} dmu for the k of [`POWERS`].
type Moments = [f64; POWERS.len()];

/// The chord function phi(eta) = sum a_k eta^k of a deflection on [0, support].
#[derive(Debug, Clone, Copy)]
struct Chord {
    support: f64,
    static_share: f64,
    /// a_k for the k of [`POWERS`].
    coefficients: Moments,
}

impl Chord {
    fn new(deflection: Deflection) -> Self {
        match deflection {
            Deflection::Centre => Self {
                support: 1.0,
                static_share: 3.0 / 8.0,
                coefficients: [0.0, 1.0, -1.0, 0.0, 0.0],
            },
            // (2 - eta)^3 (eta^2 + 6 eta + 4)/32, the chord function convolved with itself
            Deflection::Mean => Self {
                support: 2.0,
                static_share: 3.0 / 10.0,
                coefficients: [0.0, 1.0, -5.0 / 4.0, 5.0 / 8.0, -1.0 / 32.0],
            },
        }
    }

    /// phi(eta) for eta >= 0; phi(0) = 1, zero beyond the support.
    fn value(&self, eta: f64) -> f64 {
        if eta < self.support {
            self.overlap(eta, &[1.0; POWERS.len()])
        } else {
            0.0
        }
    }

    /// int_0^eta phi for eta >= 0.
    fn integral(&self, eta: f64) -> f64 {
        let e = eta.min(self.support);
        self.terms(e)
            .map(|(k, term)| term * e / (f64::from(k) + 1.0))
            .sum()
    }

    /// int phi(t/x) dmu from the moments above x = t/support.
    fn overlap(&self, t: f64, above: &Moments) -> f64 {
        self.terms(t)
            .zip(&above[1..])
            .map(|((_, term), m)| term * m)
            .sum()
    }

    /// int_0^t of [`Self::overlap`].
    fn overlap_integral(&self, t: f64, total: &Moments, above: &Moments) -> f64 {
        let passed = self.integral(self.support) * (total[0] - above[0]);
        let passing = self.terms(t).zip(&above[1..]);
        passed
            + passing
                .map(|((k, term), m)| term * t / (f64::from(k) + 1.0) * m)
                .sum::<f64>()
    }

    /// The terms (k, a_k eta^k), k >= 0.
    fn terms(&self, eta: f64) -> impl Iterator<Item = (i32, f64)> + '_ {
        let terms = POWERS.into_iter().zip(self.coefficients).skip(1);
        terms.map(move |(k, a)| (k, a * eta.powi(k)))
    }
}

/// The two intervals of slowness on which the density is smooth in an angle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Zone {
    /// 0 < x < 1, x = sin(angle).
    Fast = 0,
    /// 1 < x < 1/kappa, x^2 = 1 + (K - 1) sin^2(angle).
    Slow = 1,
}

impl Zone {
    fn of(x: f64, shear_slowness: f64) -> Option<Self> {
        if x < 1.0 {
            Some(Self::Fast)
        } else if x < shear_slowness {
            Some(Self::Slow)
        } else {
            None
        }
    }

    fn slowness(self, k: f64, angle: f64) -> f64 {
        let s = angle.sin();
        match self {
            Self::Fast => s,
            Self::Slow => (1.0 + (k - 1.0) * s * s).sqrt(),
        }
    }

    fn angle(self, shear_slowness: f64, x: f64) -> f64 {
        match self {
            Self::Fast => x.asin(),
            Self::Slow => {
                let far = (shear_slowness - x) * (shear_slowness + x);
                ((x - 1.0) * (x + 1.0) / far).sqrt().atan()
            }
        }
    }
}

/// Ends of the panels of a zone as fractions of pi/2, ascending.
///
/// They shrink by halves toward slowness zero (the chord function scales as t/x), toward slowness one
/// (a zero of the Rayleigh function on the neighbouring sheet reaches it at nu = 0, and for nu near
/// 1/2 the whole fast zone is a speck beside the shear slowness), and a little toward the shear
/// slowness, beyond which the Rayleigh pole stands.
const PANEL_HALVINGS: i32 = 16;

impl Zone {
    /// How often the panels halve toward the upper end of the zone.
    fn upper_halvings(self) -> i32 {
        match self {
            Self::Fast => PANEL_HALVINGS,
            Self::Slow => 3,
        }
    }
}

fn panel_ends(zone: Zone) -> Vec<f64> {
    let shrink = |j: i32| 0.5_f64.powi(j);
    let lower = (1..=PANEL_HALVINGS).rev().map(shrink);
    let upper = (2..=zone.upper_halvings()).map(|j| 1.0 - shrink(j));
    let octaves: Vec<f64> = [0.0]
        .into_iter()
        .chain(lower)
        .chain(upper)
        .chain([1.0])
        .collect();
    let halves = octaves
        .windows(2)
        .flat_map(|pair| [pair[0], 0.5 * (pair[0] + pair[1])]);
    halves
        .chain([1.0])
        .map(|fraction| fraction * FRAC_PI_2)
        .collect()
}

/// Index and ends of the panel of [`panel_ends`] that holds a fraction in [0, 1].
fn panel_of(zone: Zone, fraction: f64) -> (usize, f64, f64) {
    let shrink = |j: i32| 0.5_f64.powi(j);
    let octave =
        |f: f64, last: i32| (-f.max(f64::MIN_POSITIVE).log2().ceil() as i32).clamp(1, last);
    let (index, from, to) = if fraction < 0.5 {
        let j = octave(fraction, PANEL_HALVINGS);
        let from = if j == PANEL_HALVINGS {
            0.0
        } else {
            shrink(j + 1)
        };
        (PANEL_HALVINGS - j, from, shrink(j))
    } else {
        let upper = zone.upper_halvings();
        let j = octave(1.0 - fraction, upper);
        let to = if j == upper { 1.0 } else { 1.0 - shrink(j + 1) };
        (PANEL_HALVINGS + j - 1, 1.0 - shrink(j), to)
    };
    let middle = 0.5 * (from + to);
    if fraction < middle {
        (2 * index as usize, from, middle)
    } else {
        (2 * index as usize + 1, middle, to)
    }
}

/// The measure mu with its moments summed panel by panel from the slow end.
struct Spectrum {
    k: f64,
    scale: f64,
    rayleigh_slowness: f64,
    rayleigh_mass: f64,
    ends: [Vec<f64>; 2],
    /// Moments above the upper end of each panel.
    beyond: [Vec<Moments>; 2],
}

impl Spectrum {
    fn new(medium: &Medium) -> Self {
        let k = medium.shear_slowness_squared();
        let c = medium.rayleigh_speed();
        let share = k / (1.0 - medium.poisson_ratio());
        let mut spectrum = Self {
            k,
            scale: 2.0 / PI * share,
            rayleigh_slowness: 1.0 / c,
            rayleigh_mass: 2.0 * (1.0 - c * c).sqrt() * c * share / medium.rayleigh_slope(),
            ends: [panel_ends(Zone::Fast), panel_ends(Zone::Slow)],
            beyond: [vec![], vec![]],
        };
        let mut sum = POWERS.map(|power| spectrum.rayleigh_mass * c.powi(power));
        for zone in [Zone::Slow, Zone::Fast] {
            let ends = spectrum.ends[zone as usize].clone();
            let mut beyond = vec![];
            for pair in ends.windows(2).rev() {
                beyond.push(sum);
                // The first panel reaches slowness zero, where only the moments up to the mass exist.
                spectrum.add(zone, pair[0], pair[1], &mut sum);
            }
            beyond.reverse();
            spectrum.beyond[zone as usize] = beyond;
        }
        spectrum
    }

    /// Moments above slowness zero; only the first two exist there.
    fn total(&self) -> Moments {
        let mut sum = self.beyond[0][0];
        self.add(Zone::Fast, 0.0, self.ends[0][1], &mut sum);
        sum
    }

    /// Moments above an angle within a panel.
    fn above(&self, zone: Zone, panel: usize, angle: f64) -> Moments {
        let mut sum = self.beyond[zone as usize][panel];
        let (mut from, end) = (angle, self.ends[zone as usize][panel + 1]);
        while 2.0 * from < end {
            self.add(zone, from, 2.0 * from, &mut sum);
            from *= 2.0;
        }
        self.add(zone, from, end, &mut sum);
        sum
    }

    /// Adds the moments between two angles of a zone.
    fn add(&self, zone: Zone, from: f64, to: f64, sum: &mut Moments) {
        for (angle, weight) in gauss::rule(16).on(from, to) {
            let mass = weight * self.density(zone, angle);
            let inverse = 1.0 / zone.slowness(self.k, angle);
            for (moment, power) in sum.iter_mut().zip(POWERS) {
                *moment += mass * inverse.powi(power);
            }
        }
    }

    /// Density in the angle of a zone.
    fn density(&self, zone: Zone, angle: f64) -> f64 {
        let k = self.k;
        let s = angle.sin();
        // cos from the distance to pi/2, which the panels near slowness one resolve
        let c = (FRAC_PI_2 - angle).sin();
        self.scale
            * match zone {
                Zone::Fast => {
                    let g = 2.0 * s * s - k;
                    let y = (k - s * s).sqrt();
                    c * c / (g * g + 4.0 * s * s * c * y)
                }
                Zone::Slow => {
                    // p = -i p^, so Re[p/R] = 4 x^2 p^2 y/((2 x^2 - K)^4 + 16 x^4 p^2 y^2)
                    let p2 = (k - 1.0) * s * s;
                    let x2 = 1.0 + p2;
                    let g = 2.0 * x2 - k;
                    let y2 = (k - 1.0) * c * c;
                    let density =
                        4.0 * x2 * p2 * y2.sqrt() / (g.powi(4) + 16.0 * x2 * x2 * p2 * y2);
                    density * (k - 1.0) * s * c / x2.sqrt()
                }
            }
    }
}

/// A function of the angle of a zone: one Chebyshev series a panel.
#[derive(Debug, Clone)]
struct Curve {
    series: Vec<Vec<f64>>,
}

impl Curve {
    const TERMS: usize = 24;

    /// Fits f(panel, angle).
    fn fit(zone: Zone, f: impl Fn(usize, f64) -> f64) -> Self {
        let n = Self::TERMS;
        let cosine = |i: usize, k: usize| (PI * k as f64 * (i as f64 + 0.5) / n as f64).cos();
        let series = panel_ends(zone)
            .windows(2)
            .enumerate()
            .map(|(panel, ends)| {
                let (mid, half) = (0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0]));
                let values: Vec<f64> = (0..n)
                    .map(|i| f(panel, mid + half * cosine(i, 1)))
                    .collect();
                let mut coefficients: Vec<f64> = (0..n)
                    .map(|k| {
                        let sum: f64 = values
                            .iter()
                            .enumerate()
                            .map(|(i, v)| v * cosine(i, k))
                            .sum();
                        sum * if k == 0 { 1.0 } else { 2.0 } / n as f64
                    })
                    .collect();
                let size = coefficients[0].abs();
                while coefficients.len() > 2
                    && coefficients.last().is_some_and(|c| c.abs() < 1e-17 * size)
                {
                    coefficients.pop();
                }
                coefficients
            })
            .collect();
        Self { series }
    }

    /// Clenshaw's sum on the panel that holds the angle.
    fn value(&self, zone: Zone, angle: f64) -> f64 {
        let (panel, from, to) = panel_of(zone, angle / FRAC_PI_2);
        let u = (2.0 * angle / FRAC_PI_2 - from - to) / (to - from);
        let coefficients = &self.series[panel];
        let (mut b1, mut b2) = (0.0, 0.0);
        for &c in coefficients[1..].iter().rev() {
            (b1, b2) = (2.0 * u * b1 - b2 + c, b1);
        }
        u * b1 - b2 + coefficients[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_measure_has_mass_one() {
        for nu in [
            -0.9,
            -0.5,
            0.0,
            0.01,
            0.25,
            0.263_082_06,
            0.3,
            0.4,
            0.45,
            0.49,
            0.499,
            0.4999,
        ] {
            let mass = Spectrum::new(&Medium::new(nu).unwrap()).total()[1];
            assert!((mass - 1.0).abs() < 1e-13, "nu = {nu}: {mass}");
        }
    }

    #[test]
    fn every_fraction_finds_its_panel() {
        for zone in [Zone::Fast, Zone::Slow] {
            let ends = panel_ends(zone);
            for pair in ends.windows(2) {
                for share in [1e-9, 0.3, 0.999_999] {
                    let fraction = (pair[0] + share * (pair[1] - pair[0])) / FRAC_PI_2;
                    let (panel, from, to) = panel_of(zone, fraction);
                    assert!((from - ends[panel] / FRAC_PI_2).abs() < 1e-15);
                    assert!((to - ends[panel + 1] / FRAC_PI_2).abs() < 1e-15);
                    assert!((from..=to).contains(&fraction));
                }
            }
        }
    }

    #[test]
    fn the_impulse_is_the_slope_of_the_step() {
        for nu in [-0.5, 0.0, 0.25, 0.3, 0.45, 0.499] {
            let medium = Medium::new(nu).unwrap();
            for deflection in [Deflection::Centre, Deflection::Mean] {
                let response = SurfaceResponse::new(&medium, deflection);
                let size = response.impulse(0.0);
                let memory = response.memory();
                for share in [0.003, 0.07, 0.2, 0.33, 0.57, 0.81, 0.93, 0.999] {
                    let (t, h) = (share * memory, 1e-5 * memory);
                    let slope = (response.step(t + h) - response.step(t - h)) / (2.0 * h);
                    let error = (response.impulse(t) - slope).abs();
                    assert!(error < 3e-6 * size, "nu = {nu}, t = {t}: {error}");
                }
                assert_eq!(response.impulse(-1e-9), 0.0);
                assert_eq!(response.impulse(memory), 0.0);
            }
            // (32): G(0+) = kappa^2 Z(0), Z(0) = 3/(2 pi)
            let centre = SurfaceResponse::new(&medium, Deflection::Centre);
            let start = centre.static_compliance() * centre.impulse(0.0);
            let expected = medium.kappa().powi(2) * 1.5 / PI;
            assert!((start / expected - 1.0).abs() < 1e-9, "nu = {nu}: {start}");
        }
    }
}
