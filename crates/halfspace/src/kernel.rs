//! The step response of the half-space: static part and remainder, by one integral over slowness.
//!
//! ```text
//! H(r,z,t) = static(r,z) + R(r,z,t)
//! R = 2/(c D'(c)) Re sum_{P,S} N Psi(gamma z - i c t)
//!     + (1/pi) Re int_0^{1/kappa} dx sum_{P,S} amplitude(x) [ Psi(xi-) + Psi(xi+) ],   xi-+ = i (z gamma^ -+ t)/x
//! ```
//!
//! with gamma^ = sqrt(1 - x^2) for P and sqrt(1/kappa^2 - x^2) for S. Below x = 1 only the compact parts of
//! the potentials enter, so each wave and each direction of travel has an interval of its own; above it the
//! potentials are taken whole. All singularities of the integrands are known in closed form: the fronts,
//! z gamma^ -+ t = e x with e = +-1 +- r, and the zeros of the Rayleigh function on neighbouring sheets.

use crate::compact::compact;
use crate::error::DomainError;
use crate::field::{Estimate, Field, Six};
use crate::medium::Medium;
use crate::panels::{self, Landscape};
use crate::potential::{Potentials, potentials};
use crate::profile::Profile;
use crate::spectrum::{self, Amplitudes, Pole, Wave};
use crate::statics;
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, PI};

/// The exact kernels of one half-space under one load profile.
///
/// Reduced units: length r0, time r0/c1, displacement P/(mu r0), stress P/r0^2.
#[derive(Debug, Clone)]
pub struct Kernel {
    medium: Medium,
    profile: Profile,
    tolerance: f64,
    k: f64,
    poles: [Pole; 2],
    /// Singularities of the amplitudes in the angle of the fast and of the slow interval.
    fast_fixed: Vec<Complex64>,
    slow_fixed: Vec<Complex64>,
}

/// Direction of travel of a wave through the plane of the observer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sense {
    /// xi- = i (z gamma^ - t)/x: the wave that comes down from the load.
    Outgoing,
    /// xi+ = i (z gamma^ + t)/x: its image in time, which makes the sum causal.
    Image,
}

impl Sense {
    fn sign(self) -> f64 {
        match self {
            Self::Outgoing => -1.0,
            Self::Image => 1.0,
        }
    }
}

/// One evaluation point.
#[derive(Debug, Clone, Copy)]
struct Point {
    r: f64,
    z: f64,
    t: f64,
}

/// Running sum of six fields and of their absolute contributions.
#[derive(Debug, Clone, Copy, Default)]
struct Sum {
    value: Six,
    size: Six,
}

impl Sum {
    #[inline]
    fn add(&mut self, weight: f64, term: Six) {
        for ((value, size), t) in self.value.iter_mut().zip(&mut self.size).zip(term) {
            let x = weight * t;
            *value += x;
            *size += x.abs();
        }
    }
}

impl Kernel {
    /// Kernels of `medium` under `profile`, to a relative error of about `tolerance` in [1e-14, 0.1].
    ///
    /// # Errors
    /// [`DomainError`] when the tolerance is outside its range.
    pub fn new(medium: &Medium, profile: Profile, tolerance: f64) -> Result<Self, DomainError> {
        DomainError::unless(
            (1e-14..=0.1).contains(&tolerance),
            "tolerance",
            tolerance,
            "[1e-14, 0.1]",
        )?;
        let k = medium.shear_slowness_squared();
        let mut kernel = Self {
            medium: medium.clone(),
            profile,
            tolerance,
            k,
            poles: [spectrum::pole(Wave::P, medium), spectrum::pole(Wave::S, medium)],
            fast_fixed: vec![],
            slow_fixed: vec![],
        };
        kernel.find_fixed_singularities();
        Ok(kernel)
    }

    /// The half-space.
    #[must_use]
    pub fn medium(&self) -> &Medium {
        &self.medium
    }

    /// The load profile.
    #[must_use]
    pub fn profile(&self) -> Profile {
        self.profile
    }

    /// The static fields under a unit force (Huber's solution for the Hertz profile), closed form.
    ///
    /// # Errors
    /// [`DomainError`] for r or z negative or not finite.
    pub fn static_field(&self, r: f64, z: f64) -> Result<Six, DomainError> {
        check_place(r, z)?;
        Ok(statics::static_field(&self.medium, self.profile, r, z))
    }

    /// R(r,z,t): step response less its static part; minus the static part before the first arrival.
    ///
    /// # Errors
    /// [`DomainError`] for r, z or t negative or not finite.
    pub fn remainder(&self, r: f64, z: f64, t: f64) -> Result<Estimate, DomainError> {
        check_place(r, z)?;
        DomainError::unless(t >= 0.0 && t.is_finite(), "t", t, "[0, inf)")?;
        let rest = statics::static_field(&self.medium, self.profile, r, z);
        if t <= self.first_arrival(r, z) {
            return Ok(Estimate {
                value: rest.map(|s| -s),
                error: rest.map(|s| f64::EPSILON * s.abs()),
            });
        }
        let mut estimate = self.integrate::<0>(Point { r, z, t });
        self.impose_surface(z, &mut estimate);
        Ok(estimate)
    }

    /// int R dt up to t, with a constant of integration that is the same for all t at one (r, z).
    ///
    /// # Errors
    /// [`DomainError`] for r, z or t negative or not finite.
    pub fn step_integral(&self, r: f64, z: f64, t: f64) -> Result<Estimate, DomainError> {
        check_place(r, z)?;
        DomainError::unless(t >= 0.0 && t.is_finite(), "t", t, "[0, inf)")?;
        let arrival = self.first_arrival(r, z);
        let mut estimate = self.integrate::<1>(Point {
            r,
            z,
            t: t.max(arrival),
        });
        self.impose_surface(z, &mut estimate);
        if t < arrival {
            let rest = statics::static_field(&self.medium, self.profile, r, z);
            for (value, s) in estimate.value.iter_mut().zip(rest) {
                *value += s * (arrival - t);
            }
        }
        Ok(estimate)
    }

    /// Fills `cells[j]` with the average of R over [j width, (j + 1) width]; returns an error per field.
    ///
    /// # Errors
    /// [`DomainError`] for r or z negative or not finite, or a width that is not positive and finite.
    pub fn cell_averages(
        &self,
        r: f64,
        z: f64,
        width: f64,
        cells: &mut [Six],
    ) -> Result<Six, DomainError> {
        check_place(r, z)?;
        DomainError::unless(width > 0.0 && width.is_finite(), "width", width, "(0, inf)")?;
        let rest = statics::static_field(&self.medium, self.profile, r, z);
        let arrival = self.first_arrival(r, z);
        let mut error = rest.map(|s| f64::EPSILON * s.abs());
        let mut before: Option<Estimate> = None;
        for (j, cell) in cells.iter_mut().enumerate() {
            let (from, to) = (j as f64 * width, (j + 1) as f64 * width);
            if to <= arrival {
                *cell = rest.map(|s| -s);
                continue;
            }
            let start = match before {
                Some(start) => start,
                None => self.step_integral(r, z, from)?,
            };
            let end = self.step_integral(r, z, to)?;
            for f in 0..6 {
                cell[f] = (end.value[f] - start.value[f]) / width;
                error[f] = error[f].max((end.error[f] + start.error[f]) / width);
            }
            before = Some(end);
        }
        Ok(error)
    }

    /// Time of the first arrival at (r, z): the distance to the nearest point of the disc.
    fn first_arrival(&self, r: f64, z: f64) -> f64 {
        (r - self.profile.radius()).max(0.0).hypot(z)
    }

    /// On the surface sigma_zz is the load and sigma_rz is zero from the start.
    fn impose_surface(&self, z: f64, estimate: &mut Estimate) {
        if z == 0.0 {
            for field in [Field::StressZz, Field::StressRz] {
                estimate.value[field.index()] = 0.0;
                estimate.error[field.index()] = 0.0;
            }
        }
    }

    fn integrate<const ORDER: i32>(&self, at: Point) -> Estimate {
        let mut total = self.pole_terms::<ORDER>(at);
        // Singularities are integrable powers, so the rules do better than the ellipse alone promises.
        let digits = -self.tolerance.ln();
        let mut spectrum = Sum::default();
        for wave in [Wave::P, Wave::S] {
            for sense in [Sense::Outgoing, Sense::Image] {
                self.fast::<ORDER>(at, wave, sense, digits, &mut spectrum);
            }
            self.slow::<ORDER>(at, wave, digits, &mut spectrum);
        }
        total.add(1.0 / PI, spectrum.value);
        let mut error = Six::default();
        for f in 0..6 {
            error[f] = self.tolerance * spectrum.size[f] / PI
                + 4.0 * f64::EPSILON * (total.size[f] + spectrum.size[f]);
        }
        Estimate {
            value: total.value,
            error,
        }
    }

    /// The Rayleigh wave.
    fn pole_terms<const ORDER: i32>(&self, at: Point) -> Sum {
        let c = self.medium.rayleigh_speed();
        let mut sum = Sum::default();
        for pole in &self.poles {
            let xi = Complex64::new(pole.decay * at.z, -c * at.t);
            let mut psi = potentials::<ORDER>(self.profile, xi, at.r);
            if ORDER == 1 {
                // d/dt of order n + 1 is i c times order n
                psi = times(psi, Complex64::new(0.0, -1.0 / c));
            }
            let real = Potentials {
                a_upper: psi.a_upper.re,
                a_lower: psi.a_lower.re,
                g_upper: psi.g_upper.re,
                g_lower: psi.g_lower.re,
            };
            sum.add(1.0, fields(&pole.amplitudes, &real, at.r));
        }
        sum
    }

    /// One wave in one sense over slownesses below one, x = sin(angle).
    fn fast<const ORDER: i32>(
        &self,
        at: Point,
        wave: Wave,
        sense: Sense,
        digits: f64,
        sum: &mut Sum,
    ) {
        let (k, limit) = (self.k, at.r + self.profile.radius());
        let mut landscape = Landscape::default();
        for root in self.fronts(at, wave, sense) {
            match wave {
                Wave::P => landscape.add(root, 0.0, FRAC_PI_2),
                Wave::S => {
                    let (x, y) = (root.sin() * k.sqrt(), root.cos());
                    if y.re > 0.0 {
                        let angle = if x.im == 0.0 && x.re.abs() <= 1.0 {
                            x.re.asin().into()
                        } else {
                            x.asin()
                        };
                        landscape.add(angle, 0.0, FRAC_PI_2);
                        landscape.add(PI - angle, 0.0, FRAC_PI_2);
                    }
                }
            }
        }
        landscape.singularities.extend_from_slice(&self.fast_fixed);
        let ends = landscape.ends(0.0, FRAC_PI_2);
        for pair in ends.windows(2) {
            let (x, p) = (0.5 * (pair[0] + pair[1])).sin_cos();
            let eta = self.eta(at, wave, sense, x, p);
            let passed = ORDER == 1 && eta <= -limit;
            if eta.abs() >= limit && !passed {
                continue;
            }
            panels::visit((pair[0], pair[1]), &landscape, digits, &mut |angle, weight| {
                let (x, p) = angle.sin_cos();
                let amplitudes = spectrum::fast(wave, k, x, p);
                let mut psi = if passed {
                    Potentials {
                        a_upper: -0.5,
                        ..Potentials::default()
                    }
                } else {
                    compact::<ORDER>(self.profile, self.eta(at, wave, sense, x, p), at.r)
                };
                if ORDER == 1 {
                    // int dt = -+x int d eta; the order below b3 is -b2
                    let step = sense.sign() * x;
                    psi = Potentials {
                        a_upper: step * psi.a_upper,
                        a_lower: step * psi.a_lower,
                        g_upper: step * psi.g_upper,
                        g_lower: -step * psi.g_lower,
                    };
                }
                sum.add(weight * p, fields(&amplitudes, &psi, at.r));
            });
        }
    }

    /// Both senses of one wave over slownesses between one and 1/kappa, x^2 = 1 + (K - 1) sin^2(angle).
    fn slow<const ORDER: i32>(&self, at: Point, wave: Wave, digits: f64, sum: &mut Sum) {
        let span = self.k - 1.0;
        let root_span = span.sqrt();
        let mut landscape = Landscape::default();
        for sense in [Sense::Outgoing, Sense::Image] {
            for root in self.fronts(at, wave, sense) {
                let angles = match wave {
                    // p = cos(root) = -i sqrt(K - 1) sin(angle)
                    Wave::P => {
                        let angle = (Complex64::i() * root.cos() / root_span).asin();
                        [angle, PI - angle]
                    }
                    // y = sqrt(K) cos(root) = sqrt(K - 1) cos(angle)
                    Wave::S => {
                        let cosine = root.cos() * (self.k.sqrt() / root_span);
                        let angle = if cosine.im == 0.0 && cosine.re.abs() <= 1.0 {
                            cosine.re.acos().into()
                        } else {
                            cosine.acos()
                        };
                        [angle, -angle]
                    }
                };
                for angle in angles {
                    landscape.add(angle, 0.0, FRAC_PI_2);
                }
            }
        }
        if at.z == 0.0 && wave == Wave::P {
            // On the surface both waves are singular at x = t/|e|, where p is imaginary.
            for e in self.edges(at.r) {
                let s2 = ((at.t / e).powi(2) - 1.0) / span;
                if (0.0..=1.0).contains(&s2) {
                    landscape.add(s2.sqrt().asin().into(), 0.0, FRAC_PI_2);
                }
            }
        }
        landscape.singularities.extend_from_slice(&self.slow_fixed);
        let ends = landscape.ends(0.0, FRAC_PI_2);
        for pair in ends.windows(2) {
            panels::visit((pair[0], pair[1]), &landscape, digits, &mut |angle, weight| {
                let (s, c) = angle.sin_cos();
                let (p_abs, y) = (root_span * s, root_span * c);
                let x = (1.0 + p_abs * p_abs).sqrt();
                let amplitudes = spectrum::slow(wave, self.k, x, p_abs, y);
                let psi = self.both_senses::<ORDER>(at, wave, x, p_abs, y);
                // dx = (K - 1) sin cos/x d angle
                sum.add(weight * p_abs * y / x, real_fields(&amplitudes, &psi, at.r));
            });
        }
    }

    /// Psi(xi-) + Psi(xi+), or i x times their difference for the time integral.
    #[inline]
    fn both_senses<const ORDER: i32>(
        &self,
        at: Point,
        wave: Wave,
        x: f64,
        p_abs: f64,
        y: f64,
    ) -> Potentials<Complex64> {
        match wave {
            Wave::P => {
                // xi+ is the conjugate of xi-, and so are the potentials
                let xi = Complex64::new(at.z * p_abs / x, -at.t / x);
                let psi = potentials::<ORDER>(self.profile, xi, at.r);
                let fold = |v: Complex64| {
                    Complex64::new(2.0 * if ORDER == 0 { v.re } else { x * v.im }, 0.0)
                };
                Potentials {
                    a_upper: fold(psi.a_upper),
                    a_lower: fold(psi.a_lower),
                    g_upper: fold(psi.g_upper),
                    g_lower: fold(psi.g_lower),
                }
            }
            Wave::S => {
                let outgoing = Complex64::new(0.0, (at.z * y - at.t) / x);
                let image = Complex64::new(0.0, (at.z * y + at.t) / x);
                let minus = potentials::<ORDER>(self.profile, outgoing, at.r);
                let plus = potentials::<ORDER>(self.profile, image, at.r);
                let fold = |m: Complex64, p: Complex64| {
                    if ORDER == 0 {
                        m + p
                    } else {
                        Complex64::new(0.0, x) * (p - m)
                    }
                };
                Potentials {
                    a_upper: fold(minus.a_upper, plus.a_upper),
                    a_lower: fold(minus.a_lower, plus.a_lower),
                    g_upper: fold(minus.g_upper, plus.g_upper),
                    g_lower: fold(minus.g_lower, plus.g_lower),
                }
            }
        }
    }

    /// eta = (z gamma^ -+ t)/x, accurate where the difference is small and x too.
    #[inline]
    fn eta(&self, at: Point, wave: Wave, sense: Sense, x: f64, p: f64) -> f64 {
        let (vertical, root) = match wave {
            Wave::P => (1.0, p),
            Wave::S => (self.k.sqrt(), (self.k - x * x).sqrt()),
        };
        // gamma^ = vertical - x^2/(vertical + gamma^)
        (at.z * vertical + sense.sign() * at.t) / x - at.z * x / (vertical + root)
    }

    /// The values |e| of the front equation.
    fn edges(&self, r: f64) -> impl Iterator<Item = f64> {
        let radius = self.profile.radius();
        [radius + r, (radius - r).abs()].into_iter()
    }

    /// Solutions psi of the front equation z gamma^ -+ t = e x, x = sin(psi)/speed, for e = +-1 +- r.
    fn fronts(&self, at: Point, wave: Wave, sense: Sense) -> impl Iterator<Item = Complex64> {
        let speed = match wave {
            Wave::P => 1.0,
            Wave::S => self.medium.kappa(),
        };
        let (z, time) = (at.z, speed * at.t);
        self.edges(at.r)
            .flat_map(|e| [e, -e])
            .filter(move |&e| z > 0.0 || e != 0.0)
            .flat_map(move |e| {
                let (distance, tilt) = (z.hypot(e), e.atan2(z));
                // acos(t/distance), from the difference so that it is sharp near the arrival
                let gap = (distance - time) / (2.0 * distance);
                let opening = if gap >= 0.0 {
                    Complex64::new(2.0 * gap.sqrt().asin(), 0.0)
                } else {
                    Complex64::new(0.0, 2.0 * (-gap).sqrt().asinh())
                };
                let angle = match sense {
                    Sense::Outgoing => opening,
                    Sense::Image => PI - opening,
                };
                [-tilt + angle, -tilt - angle]
            })
    }

    /// Zeros of the Rayleigh function near the two intervals, and the branch points between them.
    fn find_fixed_singularities(&mut self) {
        let (k, span) = (self.k, self.k - 1.0);
        let near = |v: &Complex64| {
            (-1.0..=FRAC_PI_2 + 1.0).contains(&v.re) && v.im.abs() < 2.0 && v.im.is_finite()
        };
        let both_signs = |v: Complex64| [v, -v, PI - v, PI + v];
        let mut fast = vec![Complex64::default()];
        let branch = k.sqrt().acosh();
        fast.extend([Complex64::new(FRAC_PI_2, branch), Complex64::new(FRAC_PI_2, -branch)]);
        let mut slow = vec![];
        let zero = (1.0 / span.sqrt()).asinh();
        slow.extend([Complex64::new(0.0, zero), Complex64::new(0.0, -zero)]);
        for root in self.medium.rayleigh_cubic_roots() {
            let x2 = root * k;
            for angle in both_signs(x2.sqrt().asin()) {
                let (s, c) = (angle.sin(), angle.cos());
                let s2 = s * s;
                let value = (2.0 * s2 - k).powi(2) + 4.0 * s2 * c * (k - s2).sqrt();
                if value.norm() < 1e-6 * k * k {
                    fast.push(angle);
                }
            }
            for angle in both_signs(((x2 - 1.0) / span).sqrt().asin()) {
                let (s, c) = (angle.sin(), angle.cos());
                let square = (2.0 * x2 - k).powi(2);
                let value = square - Complex64::new(0.0, 4.0 * span) * x2 * s * c;
                if value.norm() < 1e-6 * k * k {
                    slow.push(angle);
                }
            }
        }
        fast.retain(near);
        slow.retain(near);
        self.fast_fixed = fast;
        self.slow_fixed = slow;
    }
}

pub(crate) fn check_place(r: f64, z: f64) -> Result<(), DomainError> {
    DomainError::unless(r >= 0.0 && r.is_finite(), "r", r, "[0, inf)")?;
    DomainError::unless(z >= 0.0 && z.is_finite(), "z", z, "[0, inf)")?;
    Ok(())
}

fn times(psi: Potentials<Complex64>, factor: Complex64) -> Potentials<Complex64> {
    Potentials {
        a_upper: psi.a_upper * factor,
        a_lower: psi.a_lower * factor,
        g_upper: psi.g_upper * factor,
        g_lower: psi.g_lower * factor,
    }
}

/// The six fields from real amplitudes and potentials.
#[inline]
fn fields(m: &Amplitudes<f64>, psi: &Potentials<f64>, r: f64) -> Six {
    let hoop = 2.0 * m.u * psi.g_upper;
    [
        m.u * psi.g_upper * r,
        m.w * psi.a_upper,
        m.rr * psi.a_lower - hoop,
        m.tt * psi.a_lower + hoop,
        m.zz * psi.a_lower,
        m.rz * psi.g_lower * r,
    ]
}

/// The real parts of the six fields from complex amplitudes and potentials.
#[inline]
fn real_fields(m: &Amplitudes<Complex64>, psi: &Potentials<Complex64>, r: f64) -> Six {
    let re = |a: Complex64, b: Complex64| a.re * b.re - a.im * b.im;
    let hoop = 2.0 * re(m.u, psi.g_upper);
    [
        0.5 * hoop * r,
        re(m.w, psi.a_upper),
        re(m.rr, psi.a_lower) - hoop,
        re(m.tt, psi.a_lower) + hoop,
        re(m.zz, psi.a_lower),
        re(m.rz, psi.g_lower) * r,
    ]
}
