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
//! Theory: `docs/theory.md` (T79).

use crate::attenuation::Attenuation;
use crate::domain::{DomainError, check, check_place_under};
use crate::field::Six;
use crate::kernel::Kernel;
use crate::medium::Medium;
use crate::numeric::bessel::{LARGE, LEAST_HANKEL, scaled_bessel, scaled_hankel};
use crate::numeric::gauss;
use crate::profile::Profile;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// Largest distance in lengths of the Rayleigh wave; beyond it the number of nodes, which is proportional to it, is too large.
const MOST_WAVES: f64 = 1e4;

/// Distance in lengths of the Rayleigh wave below which the static field is exact to rounding.
const STATIC: f64 = 1e-17;

/// Shape of the arc from zero to beyond the Rayleigh wave number.
#[derive(Clone, Copy)]
struct Arc {
    /// Its end over the Rayleigh wave number; at 1 the pole would lie on the path.
    end: f64,
    /// Its height times the distance from the axis, since Bessel functions grow by the exponential of that.
    growth: f64,
}

impl Arc {
    /// Any other gives the same values (`spectra_are_within_their_estimates`); near this one the number of nodes is smallest.
    const USUAL: Self = Self {
        end: 1.5,
        growth: 3.0,
    };

    /// Largest height over the length.
    const HEIGHT: f64 = 0.25;
}

/// Least wave number times the radius of the disc at which its load is divided into two waves: below it they cancel.
const DIVIDED: f64 = 2.0;

/// Distances from the axis in radii of the disc between which its near edge is close: elsewhere the wave of the far edge does not
/// oscillate while that of the near edge falls.
const EDGE: [f64; 2] = [0.5, 2.0];

/// Rounding errors over the integral of the modulus, without those of phases, in units of rounding
/// (`spectra_are_within_their_estimates`).
const ROUNDING: f64 = 16.0;

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
    /// Valid up to a distance (from the farthest edge of the disc) of 1e4 lengths of the Rayleigh wave; attenuation needs a frequency
    /// above zero. The kernel's tolerance has no effect.
    ///
    /// Accuracy: 1e-12 of the largest field of the same kind without attenuation, at any depth, also on the surface and near the
    /// edge of the disc. Where waves are damped by more than a factor of a thousand, less of them is left than of the error.
    /// The time is proportional to the distance from about 10 wave lengths on: 0.2 ms there, 1 s at 1e4.
    /// Stresses of a punch of high frequency have 1e-7, close to its edge and at the surface below it.
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
        let one = Complex64::from(1.0);
        let factor = match attenuation {
            Some(law) if frequency > 0.0 => law.speed_factor(frequency),
            Some(_) | None => one,
        };
        let speed = self.medium().rayleigh_speed() * factor.norm();
        let waves = frequency * (r + profile.radius()).hypot(z) / speed;
        let (least, range) = match attenuation {
            None => (0.0, "[0, 1e4 Rayleigh speeds over the distance]"),
            Some(_) => (
                f64::MIN_POSITIVE,
                "(0, 1e4 Rayleigh speeds over the distance]",
            ),
        };
        check(
            frequency >= least && waves <= MOST_WAVES,
            "frequency",
            frequency,
            range,
        )?;
        let Sum { value, error, .. } = if waves < STATIC {
            let value = self.static_field(r, z)?.map(Complex64::from);
            let error = value.map(|v| 8.0 * f64::EPSILON * v.norm());
            Sum {
                value,
                error,
                ..Sum::default()
            }
        } else {
            let omega = TAU * frequency / factor;
            Integrand::new(self.medium(), profile, [r, z], omega).integral(Arc::USUAL)
        };
        let scale = |f: usize| if f < 2 { (factor * factor).inv() } else { one };
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
    fn integral(&self, shape: Arc) -> Sum {
        /// Phase of a panel at first.
        const PHASE: f64 = 6.0;
        let mut sum = Sum::default();
        let (radius, end) = (self.profile.radius(), shape.end * self.rayleigh);
        let form = Form::of(self.profile, self.r, self.z);
        let turn = end.max(match form {
            Form::Axial => self.z.recip(),
            Form::Outside => LEAST_HANKEL / self.r,
            Form::Inside => DIVIDED,
            Form::Edge => DIVIDED.max(LARGE / self.r),
        });
        let height = (shape.growth / (self.r + radius)).min(Arc::HEIGHT * end);
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
        let panels = |k: f64| (k * (self.r + self.z + radius) / PHASE).ceil().max(2.0) as usize;
        let whole = Road::Bessel(None);
        self.follow(&mut sum, &arc, panels(end), whole);
        if turn > end {
            self.follow(&mut sum, &line, panels(turn), whole);
        }
        let sides = [1.0, -1.0];
        let waves = match form {
            Form::Axial => vec![(0.0, whole)],
            Form::Inside => sides
                .map(|load| (load * (radius - self.r), Road::Bessel(Some(load))))
                .to_vec(),
            Form::Outside => sides
                .map(|hankel| (hankel * (self.r - radius), Road::Hankel(hankel)))
                .to_vec(),
            Form::Edge => sides
                .into_iter()
                .flat_map(|hankel| {
                    sides.map(|load| (hankel * self.r + load * radius, Road::Both([hankel, load])))
                })
                .collect(),
        };
        for (distance, road) in waves {
            self.ray(&mut sum, turn, distance, road);
        }
        // a phase has the rounding error of its size
        let rounding = ROUNDING + self.rayleigh * (self.r + self.z + radius);
        for f in 0..6 {
            sum.error[f] += rounding * f64::EPSILON * sum.modulus[f];
        }
        sum
    }

    /// Adds the integral along a course of s in [0, 1], by panels that are halved until they have all digits.
    fn follow(
        &self,
        sum: &mut Sum,
        course: &dyn Fn(f64) -> (Complex64, Complex64),
        count: usize,
        road: Road,
    ) {
        /// Nodes of a panel.
        const NODES: usize = 16;
        /// Last coefficients of a panel's Legendre series over its mean at which it is accepted. The error of Gauss's rule is
        /// of the order of their square; and how often a panel is halved.
        const ACCEPTED: f64 = 1e-6;
        const HALVINGS: u32 = 40;
        /// Panels for each one at first, and some more, after which none is halved: only noise is left then.
        const MOST_PANELS: [usize; 2] = [20, 500];
        let rule = gauss::rule(NODES);
        let last: Vec<[f64; 2]> = (rule.nodes().iter())
            .map(|&x| {
                [1, 2].map(|n| gauss::legendre(NODES - n, x).0 * (2 * (NODES - n) + 1) as f64)
            })
            .collect();
        let at = |i: usize| i as f64 / count as f64;
        let mut panels: Vec<_> = (0..count).rev().map(|i| (at(i), at(i + 1), 0)).collect();
        let mut left = MOST_PANELS[0] * count + MOST_PANELS[1];
        while let Some((from, to, halvings)) = panels.pop() {
            left = left.saturating_sub(1);
            let mut own = Sum::default();
            let mut rest = [Fields::default(); 2];
            for ((s, weight), last) in rule.on(from, to).zip(&last) {
                let (k, slope) = course(s);
                let fields = self.divided(k, road);
                own.add(&fields, slope * weight);
                for (rest, last) in rest.iter_mut().zip(last) {
                    for (rest, field) in rest.iter_mut().zip(fields) {
                        *rest += slope * weight * *last * field;
                    }
                }
            }
            let rest: Six = std::array::from_fn(|f| rest[0][f].norm() + rest[1][f].norm());
            let scale: Six = std::array::from_fn(|f| {
                own.modulus[f]
                    .max((to - from) * sum.modulus[f])
                    .max(f64::MIN_POSITIVE)
            });
            let differs = (0..6).any(|f| rest[f] > ACCEPTED * scale[f]);
            if differs && halvings < HALVINGS && left > 0 {
                let middle = 0.5 * (from + to);
                panels.extend([(middle, to, halvings + 1), (from, middle, halvings + 1)]);
                continue;
            }
            for f in 0..6 {
                sum.error[f] += rest[f] * rest[f] / scale[f];
                sum.value[f] += own.value[f];
                sum.modulus[f] += own.modulus[f];
            }
        }
    }

    /// Adds the integral of a wave e^(ik distance - kz) along the ray from `turn` on which it falls fastest: like an exponential, or
    /// a power near an edge.
    fn ray(&self, sum: &mut Sum, turn: f64, distance: f64, road: Road) {
        /// Exponent at which the exponential has fallen, and logarithm of the wave number over `turn` at which a power has.
        const FALLEN: f64 = 45.0;
        const FARTHEST: f64 = 75.0;
        /// Logarithm of the ratio of wave numbers of a panel at first.
        const LONG: f64 = 1.5;
        let reach = distance.hypot(self.z);
        let length = (FALLEN / (reach * turn)).ln_1p().min(FARTHEST);
        let direction = Complex64::from_polar(1.0, distance.atan2(self.z));
        let course = |s: f64| {
            let distance = turn * (length * s).exp_m1();
            let slope = length * (turn + distance);
            (turn + distance * direction, slope * direction)
        };
        self.follow(sum, &course, (length / LONG).ceil() as usize, road);
    }

    /// The integrand, or one of its waves.
    fn divided(&self, k: Complex64, road: Road) -> Fields {
        let i = Complex64::i();
        // the second Hankel function is the conjugate of the first at the conjugate
        let hankel = |side: f64| {
            let mirrored = |x: Complex64| if side > 0.0 { x } else { x.conj() };
            scaled_hankel(mirrored(k * self.r)).map(|h| 0.5 * mirrored(h))
        };
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
                let [zero, one] = hankel(side);
                let load = far_load(self.profile, k, side);
                let phase = i * side * k * (self.r - self.profile.radius());
                self.fields(k, &[zero, one, one / self.r].map(|h| h * load), phase)
            }
            Road::Both([side, load]) => {
                let [zero, one] = hankel(side);
                let part = one_sided(self.profile, k, load);
                let phase = i * k * (side * self.r + load * self.profile.radius());
                self.fields(k, &[zero, one, one / self.r].map(|h| h * part), phase)
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

/// The division of the integrand into waves beyond the arc.
#[derive(Clone, Copy)]
enum Form {
    /// None: it falls with depth on the real axis.
    Axial,
    /// Below a disc: the two waves of its load.
    Inside,
    /// Outside the load: the waves of the two Hankel functions.
    Outside,
    /// Near the edge of a disc: each wave of its load with each Hankel function.
    Edge,
}

impl Form {
    fn of(profile: Profile, r: f64, z: f64) -> Self {
        let radius = profile.radius();
        match () {
            () if 2.0 * (r + radius) <= z => Self::Axial,
            () if r > EDGE[1] * radius => Self::Outside,
            () if r > EDGE[0] * radius => Self::Edge,
            () => Self::Inside,
        }
    }
}

/// The form of the integrand on a ray.
#[derive(Clone, Copy)]
enum Road {
    /// Bessel functions with the part e^(i side k) of the load, or with all of it.
    Bessel(Option<f64>),
    /// The Hankel function of e^(i side k r) with all of the load.
    Hankel(f64),
    /// The same with the part e^(i side k) of the load: both sides.
    Both([f64; 2]),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::random::Stream;

    /// Values along two paths differ by no more than their estimates, which are not a thousand times wider in the median.
    #[test]
    fn spectra_are_within_their_estimates() {
        let mut random = Stream::new(3);
        let mut ratios = vec![];
        let other = Arc {
            end: 2.1,
            growth: 1.2,
        };
        for i in 0..600 {
            let profile = [Profile::Hertz, Profile::Punch, Profile::Point][i % 3];
            let medium = Medium::new(random.within(-0.4, 0.49)).unwrap();
            let r = match i % 7 {
                3 => 1.0 + random.log(1e-8, 0.5) * if i % 2 == 0 { 1.0 } else { -1.0 },
                _ => random.log(1e-3, 1e2),
            };
            let z = if i % 5 == 0 {
                0.0
            } else {
                random.log(1e-3, 1e2)
            };
            let omega = random.log(1e-3, 1e2) / (1.0 + r.hypot(z)).sqrt();
            let turn = if i % 2 == 0 {
                0.0
            } else {
                -random.log(1e-4, 0.3)
            };
            let omega = Complex64::from_polar(omega, turn);
            let integrand = Integrand::new(&medium, profile, [r, z], omega);
            let [own, check] = [Arc::USUAL, other].map(|shape| integrand.integral(shape));
            for f in 0..6 {
                let off = (own.value[f] - check.value[f]).norm();
                let allowed = own.error[f] + check.error[f];
                // tractions of the surface are not zero but by rounding
                if allowed > 0.0 {
                    ratios.push((off / allowed, i, f));
                }
            }
        }
        ratios.sort_by(|a, b| a.0.total_cmp(&b.0));
        let above = ratios.iter().filter(|own| own.0 > 1.0).count();
        let median = ratios[ratios.len() / 2].0;
        println!(
            "above {above} of {}, median {median:.1e}, {:?}",
            ratios.len(),
            &ratios[ratios.len() - 12..]
        );
        assert!(above == 0, "{above}");
        assert!(median > 1e-3, "{median}");
    }
}
