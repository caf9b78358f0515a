//! The frequency response of a point: one integral over wave number on a path around the singularities.
//!
//! ```text
//! u(r,z) = int_0^inf Z_H(k) F(k, z) J_n(k r) k dk
//! ```
//!
//! The path has three parts. An arc from zero to beyond the Rayleigh wave number passes above the branch points and the pole. On
//! the real axis it continues to where Bessel functions have their asymptotic form. There the integrand is divided into two waves
//! e^(+-ikd - kz), and each continues on the ray on which it falls fastest, so that neither a shallow point nor a near edge needs
//! many nodes.
//!
//! Theory: `docs/theory.md` (T77).

use crate::attenuation::Attenuation;
use crate::domain::{DomainError, check, check_place_under};
use crate::field::Six;
use crate::kernel::Kernel;
use crate::medium::Medium;
use crate::numeric::bessel::{LEAST_HANKEL, scaled_bessel, scaled_hankel};
use crate::numeric::gauss;
use crate::profile::Profile;
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Largest frequency times distance in c1; beyond it the number of nodes, which is proportional to it, is too large.
const MOST_WAVES: f64 = 1e4;

/// End of the arc over the Rayleigh wave number, and its largest height over its length.
const ARC: f64 = 1.5;
const HEIGHT: f64 = 0.25;

/// Height of the arc times the distance from the axis: Bessel functions grow by its exponential.
const GROWTH: f64 = 3.0;

/// Least wave number times the radius of the disc at which its load is divided into two waves: below it they cancel.
const DIVIDED: f64 = 2.0;

/// Ratio of rounding errors, over the integral of the modulus, to the unit of rounding
/// (`spectra_are_within_their_estimates`).
const ROUNDING: f64 = 4.0;

type Fields = [Complex64; 6];

/// The six fields of one frequency, in the order of [`FIELDS`](crate::FIELDS), and their estimated errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spectrum {
    /// Complex amplitudes under the force e^{i omega t}.
    pub value: [Complex64; 6],
    /// Likely bounds on the modulus of the error of each.
    pub error: Six,
}

impl Kernel {
    /// The fields at (r, z) under a force e^{i omega t} of unit amplitude, omega = 2 pi times `frequency`.
    ///
    /// Units: frequency c1/r0, displacement P/(mu r0), stress P/r0^2, with the shear modulus mu at the reference frequency
    /// if there is attenuation. A velocity is i omega times a displacement. At frequency zero it is the static field.
    ///
    /// Valid for frequency times distance (from the farthest edge of the disc) up to 1e4 c1; attenuation needs a frequency
    /// above zero. The kernel's tolerance has no effect.
    ///
    /// Accuracy: 1e-11 of the field of the same kind without attenuation at the same distance, at any depth, also on the surface and near the
    /// edge of the disc; 1e-9 of stresses under a punch within 1e-3 of its edge.
    ///
    /// ```
    /// use halfspace::{Attenuation, Field, Kernel, Medium, Profile};
    /// // mu r G on the surface at omega r/c2 = 3, Q = 20 at this frequency: direct integral of an independent program
    /// let medium = Medium::new(0.25)?;
    /// let kernel = Kernel::new(&medium, Profile::Point, 1e-10)?;
    /// let frequency = 3.0 * medium.kappa() / std::f64::consts::TAU;
    /// let damped = Attenuation::new(20.0, frequency)?;
    /// let found = kernel.spectrum(1.0, 0.0, frequency, Some(&damped))?;
    /// let w = found.value[Field::DisplacementZ.index()];
    /// assert!((w.re + 1.063594356415e-1).abs() < 1e-10);
    /// assert!((w.im - 6.746642474715e-2).abs() < 1e-10);
    /// # Ok::<(), halfspace::DomainError>(())
    /// ```
    ///
    /// # Errors
    /// [`DomainError`] for a place, a frequency or their product outside its range, at a point force itself and at the edge
    /// of a punch.
    pub fn spectrum(
        &self,
        r: f64,
        z: f64,
        frequency: f64,
        attenuation: Option<&Attenuation>,
    ) -> Result<Spectrum, DomainError> {
        let profile = self.profile();
        check_place_under(profile, r, z)?;
        let waves = frequency * (r + profile.radius()).hypot(z);
        let (least, range) = match attenuation {
            None => (0.0, "[0, 1e4 c1/distance]"),
            Some(_) => (f64::MIN_POSITIVE, "(0, 1e4 c1/distance]"),
        };
        check(
            frequency >= least && waves <= MOST_WAVES,
            "frequency",
            frequency,
            range,
        )?;
        if frequency == 0.0 {
            let value = self.static_field(r, z)?.map(Complex64::from);
            let error = value.map(|v| 8.0 * f64::EPSILON * v.norm());
            return Ok(Spectrum { value, error });
        }
        let factor = attenuation.map_or(Complex64::from(1.0), |law| law.speed_factor(frequency));
        let integrand = Integrand::new(self.medium(), profile, [r, z], TAU * frequency / factor);
        let Sum { value, error, .. } = integrand.integral();
        let over = [0, 1].map(|_| (factor * factor).inv());
        let scale = |f: usize| over.get(f).copied().unwrap_or(Complex64::from(1.0));
        Ok(Spectrum {
            value: std::array::from_fn(|f| value[f] * scale(f)),
            error: std::array::from_fn(|f| error[f] * scale(f).norm()),
        })
    }
}

/// The integrand at one place and frequency.
struct Integrand {
    profile: Profile,
    r: f64,
    z: f64,
    /// Squares of the wave numbers of P and S waves.
    squares: [Complex64; 2],
    /// Modulus of the Rayleigh wave number.
    rayleigh: f64,
}

/// A sum over nodes, with the integral of the modulus of each field.
#[derive(Default)]
struct Sum {
    value: Fields,
    modulus: Six,
    error: Six,
}

impl Sum {
    fn add(&mut self, fields: &Fields, weight: Complex64) {
        for (f, field) in fields.iter().enumerate() {
            let term = weight * field;
            self.value[f] += term;
            self.modulus[f] += term.norm();
        }
    }
}

impl Integrand {
    fn new(medium: &Medium, profile: Profile, [r, z]: [f64; 2], omega: Complex64) -> Self {
        let square = omega * omega;
        Self {
            profile,
            r,
            z,
            squares: [square, square * medium.shear_slowness_squared()],
            rayleigh: omega.norm() / medium.rayleigh_speed(),
        }
    }

    /// The whole path.
    fn integral(&self) -> Sum {
        let mut sum = Sum::default();
        let (radius, end) = (self.profile.radius(), ARC * self.rayleigh);
        // Hankel functions where waves travel outwards from the load, Bessel functions below it
        let outside = match self.profile {
            Profile::Point => 2.0 * self.r > self.z,
            Profile::Hertz | Profile::Punch => self.r > radius,
        };
        let divided = if outside { LEAST_HANKEL / self.r } else { 0.0 };
        let turn = end
            .max(divided)
            .max(if radius > 0.0 { DIVIDED } else { 0.0 });
        let height = (GROWTH / (self.r + radius)).min(HEIGHT * end);
        let arc = |s: f64| {
            let (sin, cos) = (PI * s).sin_cos();
            let k = Complex64::new(0.5 * end * (1.0 - cos), height * sin);
            (k, PI * Complex64::new(0.5 * end * sin, height * cos))
        };
        let line = |s: f64| {
            let ratio = turn / end;
            let k = end * ratio.powf(s);
            (Complex64::from(k), Complex64::from(k * ratio.ln()))
        };
        self.follow(&mut sum, &arc, end * (self.r + self.z + radius));
        if turn > end {
            self.follow(&mut sum, &line, turn * (self.r + self.z + radius));
        }
        let along = match (self.profile, outside) {
            (Profile::Point, false) => vec![(0.0, Road::Bessel(None))],
            (Profile::Hertz | Profile::Punch, false) => {
                let angle = (radius - self.r).atan2(self.z);
                [1.0, -1.0]
                    .map(|side| (side * angle, Road::Bessel(Some(side))))
                    .to_vec()
            }
            (_, true) => {
                let angle = (self.r - radius).atan2(self.z);
                [1.0, -1.0]
                    .map(|side| (side * angle, Road::Hankel(side)))
                    .to_vec()
            }
        };
        for (angle, road) in along {
            self.ray(&mut sum, turn, angle, road);
        }
        for f in 0..6 {
            sum.error[f] += ROUNDING * f64::EPSILON * sum.modulus[f];
        }
        sum
    }

    /// Adds the integral along a course of s in [0, 1], by panels that are halved until they have all digits.
    fn follow(&self, sum: &mut Sum, course: &dyn Fn(f64) -> (Complex64, Complex64), phase: f64) {
        /// Phase of a panel at first, and nodes of a panel and of the rule that checks it.
        const PHASE: f64 = 6.0;
        const NODES: usize = 16;
        const FEWER: usize = 10;
        /// Difference of the rules over the modulus at which a panel is accepted, in which case the error of the finer
        /// rule is below rounding; and how often a panel is halved.
        const ACCEPTED: f64 = 1e-9;
        const HALVINGS: u32 = 40;
        let rules = [gauss::rule(NODES), gauss::rule(FEWER)];
        let count = (phase / PHASE).ceil().max(2.0) as usize;
        let at = |i: usize| i as f64 / count as f64;
        let mut panels: Vec<_> = (0..count).map(|i| (at(i), at(i + 1), 0)).collect();
        let mut largest = Six::default();
        while let Some((from, to, halvings)) = panels.pop() {
            let [fine, coarse] = [0, 1].map(|rule| {
                let mut own = Sum::default();
                for (s, weight) in rules[rule].on(from, to) {
                    let (k, slope) = course(s);
                    let fields = self.full(k);
                    own.add(&fields, slope * weight);
                }
                own
            });
            for (f, largest) in largest.iter_mut().enumerate() {
                *largest = largest.max(fine.modulus[f] / (to - from));
            }
            let differs = (0..6).any(|f| {
                let scale = (sum.modulus[f] + fine.modulus[f]).max(largest[f] * (to - from));
                (fine.value[f] - coarse.value[f]).norm() > ACCEPTED * scale
            });
            if differs && halvings < HALVINGS {
                let middle = 0.5 * (from + to);
                panels.extend([(from, middle, halvings + 1), (middle, to, halvings + 1)]);
                continue;
            }
            for f in 0..6 {
                let difference = (fine.value[f] - coarse.value[f]).norm();
                sum.value[f] += fine.value[f];
                sum.modulus[f] += fine.modulus[f];
                if differs {
                    sum.error[f] += difference;
                }
            }
        }
    }

    /// Adds the integral along a ray from `turn`, on which the integrand falls like an exponential or a power, by the
    /// double exponential rule.
    fn ray(&self, sum: &mut Sum, turn: f64, angle: f64, road: Road) {
        /// Step of the rule and its ends: the weights fall to 1e-17 before them for the powers of a stress at the edge.
        const STEP: f64 = 1.0 / 16.0;
        const ENDS: [i32; 2] = [-64, 52];
        let direction = Complex64::from_polar(1.0, angle);
        let reach = match self.profile {
            Profile::Point => self.r.hypot(self.z),
            Profile::Hertz | Profile::Punch => (self.r - 1.0).hypot(self.z),
        };
        // where the exponential has fallen, or a power of the distance from the start
        let scale = turn.min(1.0 / reach);
        let mut coarse = Sum::default();
        let mut own = Sum::default();
        for i in ENDS[0]..=ENDS[1] {
            let x = STEP * f64::from(i);
            let distance = scale * (FRAC_PI_2 * x.sinh()).exp();
            let weight = STEP * FRAC_PI_2 * x.cosh() * distance;
            let k = turn + distance * direction;
            if !(distance * reach < 1e3) {
                break;
            }
            let fields = self.divided(k, road);
            own.add(&fields, direction * weight);
            if i % 2 == 0 {
                coarse.add(&fields, 2.0 * direction * weight);
            }
        }
        for f in 0..6 {
            let difference = (own.value[f] - coarse.value[f]).norm();
            sum.value[f] += own.value[f];
            sum.modulus[f] += own.modulus[f];
            // halving the step squares the error
            let size = own.modulus[f].max(f64::MIN_POSITIVE);
            sum.error[f] += difference * difference / size;
        }
    }

    /// The integrand.
    fn full(&self, k: Complex64) -> Fields {
        self.divided(k, Road::Bessel(None))
    }

    /// The integrand, or one of its waves.
    fn divided(&self, k: Complex64, road: Road) -> Fields {
        let i = Complex64::i();
        match road {
            Road::Bessel(side) => {
                let ([zero, one], growth) = scaled_bessel(k * self.r);
                let over = match self.r == 0.0 {
                    true => 0.5 * k,
                    false => one / self.r,
                };
                let (load, phase) = match side {
                    Some(side) => (one_sided(self.profile, k, side), i * side * k),
                    None => (load(self.profile, k), Complex64::default()),
                };
                self.fields(k, &[zero, one, over].map(|j| j * load), growth + phase)
            }
            Road::Hankel(side) => {
                // the second function is the conjugate of the first at the conjugate
                let mirrored = |x: Complex64| if side > 0.0 { x } else { x.conj() };
                let [zero, one] = scaled_hankel(mirrored(k * self.r)).map(|h| 0.5 * mirrored(h));
                let load = far_load(self.profile, k, side);
                let phase = i * side * k * (self.r - self.profile.radius());
                self.fields(k, &[zero, one, one / self.r].map(|h| h * load), phase)
            }
        }
    }

    /// The fields from the radial factors; `lift` is an exponent that is added to those of the depth.
    fn fields(&self, k: Complex64, radial: &[Complex64; 3], lift: Complex64) -> Fields {
        let [zero, one, one_over_r] = *radial;
        let [p2, s2] = self.squares;
        let k2 = k * k;
        let (a, b) = ((k2 - p2).sqrt(), (k2 - s2).sqrt());
        // none of these cancel for wave numbers far above those of the waves
        let over = (s2 - p2) / (a + b);
        let g = 2.0 * k2 - s2;
        let rayleigh = s2 * s2 - 4.0 * k2 * b * over;
        let shear = (lift - b * self.z).exp();
        let between = -over * self.z;
        let difference = match between.norm() > 1.0 {
            true => (lift - a * self.z).exp() - shear,
            false => shear * 2.0 * (0.5 * between).sinh() * (0.5 * between).exp(),
        };
        let long = difference + shear;
        let unit = k / rayleigh;
        let axial = a * (g * difference - s2 * shear) * unit;
        let outward = k * (g * difference + (s2 - 2.0 * b * over) * shear) * unit;
        let pressure = -(g * g * difference + rayleigh * shear) * unit;
        let traction = -2.0 * a * k * g * difference * unit;
        let dilation = (s2 - 2.0 * p2) * g * long * unit;
        let hoop = 2.0 * outward * one_over_r;
        [
            outward * one,
            axial * zero,
            dilation * zero + 2.0 * outward * k * zero - hoop,
            dilation * zero + hoop,
            pressure * zero,
            traction * one,
        ]
    }
}

/// The form of the integrand on a ray.
#[derive(Clone, Copy)]
enum Road {
    /// Bessel functions with the part e^(i side k) of the load, or with all of it.
    Bessel(Option<f64>),
    /// The Hankel function of e^(i side k r) with all of the load.
    Hankel(f64),
}

/// Z_H(k).
fn load(profile: Profile, k: Complex64) -> Complex64 {
    /// Wave number up to which the series is used.
    const SMALL: f64 = 0.7;
    let k2 = k * k;
    let sinc = |k: Complex64| {
        if k.norm() == 0.0 {
            Complex64::from(1.0)
        } else {
            k.sin() / k
        }
    };
    match profile {
        Profile::Point => Complex64::from(0.5 / PI),
        Profile::Punch => 0.5 / PI * sinc(k),
        Profile::Hertz if k.norm() < SMALL => {
            // 3 (sin k - k cos k)/k^3 = sum (-k^2)^n 6 (n + 1)/(2n + 3)!
            let (mut term, mut sum) = (Complex64::from(1.0), Complex64::from(1.0));
            for n in 1..9 {
                let n = f64::from(n);
                term *= -k2 * (n + 1.0) / (n * (2.0 * n + 2.0) * (2.0 * n + 3.0));
                sum += term;
            }
            0.5 / PI * sum
        }
        Profile::Hertz => 1.5 / PI * (k.sin() - k * k.cos()) / (k2 * k),
    }
}

/// The part of Z_H(k) that contains e^(i side k), without this factor.
fn one_sided(profile: Profile, k: Complex64, side: f64) -> Complex64 {
    let i = Complex64::i();
    match profile {
        Profile::Point => Complex64::from(0.5 / PI),
        Profile::Punch => 0.5 / PI * side / (2.0 * i * k),
        Profile::Hertz => 1.5 / PI * (side / (2.0 * i) - 0.5 * k) / (k * k * k),
    }
}

/// Z_H(k) without the factor e^(-i side k), where that is the larger one.
fn far_load(profile: Profile, k: Complex64, side: f64) -> Complex64 {
    let phase = Complex64::i() * side * k;
    match profile {
        Profile::Point => one_sided(profile, k, side),
        // the two waves would cancel
        Profile::Punch | Profile::Hertz if k.norm() < DIVIDED => load(profile, k) * phase.exp(),
        Profile::Punch | Profile::Hertz => {
            one_sided(profile, k, -side) + one_sided(profile, k, side) * (2.0 * phase).exp()
        }
    }
}
