//! The half-space under a vertical point force at one frequency, as a function of distance.
//!
//! With omega = 2 pi f, the shear wave speed c2 and m the factor of the moduli by attenuation (1 without), a displacement is
//!
//! ```text
//! G(r, z, f) = omega/(mu c) H(x, zeta),    x = omega r/c,  zeta = omega z/c,  c = c2 sqrt|m|,  mu |m| for mu
//! ```
//!
//! H depends on x and zeta alone, because the phase of m is the same at all frequencies: on the surface one table serves all
//! frequencies. Tabulated is H without the phase of the Rayleigh wave and without its spreading, which is smooth.

use crate::error::NoiseError;
use crate::spacing::Spacing;
use contact::HalfSpace;
use halfspace::{Attenuation, Kernel, Medium, Profile};
use num_complex::Complex64;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// A displacement for a unit force: away from the force, and down.
pub type Response = [Complex64; 2];

/// Steps between nodes: a part of x close to the force, and in x far out. Cubic interpolation is within 5e-4 then
/// (`responses_are_those_of_the_kernel`, which fails with twice these).
const STEP: f64 = 0.15;
const FAR_STEP: f64 = 0.75;

/// x from which a surface response is a Rayleigh wave: body waves are below 4e-3 of it (`responses_are_those_of_the_kernel`).
const RAYLEIGH_ONLY: f64 = 500.0;

/// Every so many intervals a table is compared with the kernel.
const CHECKED: usize = 7;

/// Part of the depth of a receiver within which responses do not depend on distance: they change by its square.
pub(crate) const ABOVE: f64 = 1e-3;

/// Part of the largest tabulated value below which an error is not relative to the value itself.
const FLOOR: f64 = 1e-4;

/// Most nodes at one depth, which take some minutes.
const MOST_NODES: f64 = 3e5;

/// A half-space, perhaps with attenuation.
#[derive(Debug, Clone)]
pub struct Ground {
    kernel: Kernel,
    shear_modulus_pa: f64,
    shear_speed_m_s: f64,
    attenuation: Option<Attenuation>,
    /// The attenuation where omega/c is 1, at which |m| is 1.
    unit_law: Option<Attenuation>,
}

impl Ground {
    /// Of a half-space with its attenuation.
    ///
    /// # Errors
    /// [`NoiseError`] for a Poisson's ratio outside the physics.
    pub fn new(block: &HalfSpace) -> Result<Self, NoiseError> {
        /// The tolerance has no effect on spectra.
        const TOLERANCE: f64 = 1e-10;
        let medium = Medium::new(block.material().poisson_ratio)?;
        let kernel = Kernel::new(&medium, Profile::Point, TOLERANCE)?;
        let attenuation = block.attenuation;
        let unit_law =
            attenuation.map(|law| Attenuation::new(law.quality_factor(), unit_frequency(&medium)));
        Ok(Self {
            shear_modulus_pa: block.material().shear_modulus_pa(),
            shear_speed_m_s: block.longitudinal_speed_m_s() * medium.kappa(),
            kernel,
            attenuation,
            unit_law: unit_law.transpose()?,
        })
    }

    /// The Rayleigh wave speed in m/s at a frequency in Hz.
    pub fn rayleigh_speed_m_s(&self, frequency_hz: f64) -> f64 {
        self.speed_m_s(frequency_hz) / self.rayleigh_slowness()
    }

    /// Slowness of the Rayleigh wave in that of the shear wave.
    fn rayleigh_slowness(&self) -> f64 {
        let medium = self.kernel.medium();
        medium.kappa() / medium.rayleigh_speed()
    }

    /// c in m/s.
    fn speed_m_s(&self, frequency_hz: f64) -> f64 {
        let factor = self
            .attenuation
            .map_or(1.0, |law| law.speed_factor(frequency_hz).norm());
        self.shear_speed_m_s * factor
    }

    /// omega/c in 1/m.
    pub(crate) fn wave_number(&self, frequency_hz: f64) -> f64 {
        TAU * frequency_hz / self.speed_m_s(frequency_hz)
    }

    /// omega/(mu |m| c) in m/N.
    fn unit_m_n(&self, frequency_hz: f64) -> f64 {
        let speed = self.speed_m_s(frequency_hz);
        let stiffer = (speed / self.shear_speed_m_s).powi(2);
        TAU * frequency_hz / (self.shear_modulus_pa * stiffer * speed)
    }

    /// H(x, zeta) of the kernel with its estimated error.
    fn exact(&self, x: f64, depth: f64) -> Result<(Response, f64), NoiseError> {
        let frequency = unit_frequency(self.kernel.medium());
        let found = self
            .kernel
            .spectrum(x, depth, frequency, self.unit_law.as_ref())?;
        Ok((
            [found.value[0], found.value[1]],
            found.error[0].max(found.error[1]),
        ))
    }
}

/// The frequency in c1/r0 at which omega r0/c2 is 1.
fn unit_frequency(medium: &Medium) -> f64 {
    medium.kappa() / TAU
}

/// H as a function of x at one zeta.
#[derive(Debug, Clone)]
pub(crate) struct Curve {
    spacing: Spacing,
    /// H e^{i k x} x/sqrt(1 + x) at the nodes, with k the Rayleigh wave number over that of the shear wave, and R for x in
    /// the fraction, R^2 = x^2 + zeta^2.
    nodes: Vec<Response>,
    lowest: f64,
    /// End of the table, and the factor of the values per unit of x behind it.
    end: f64,
    decay: Complex64,
    /// Largest relative error of a value in the table, and behind it.
    errors: [f64; 2],
}

impl Curve {
    /// Between two x at a depth.
    pub(crate) fn new(
        ground: &Ground,
        depth: f64,
        [low, high]: [f64; 2],
    ) -> Result<Self, NoiseError> {
        let low = low.max(ABOVE * depth).min(high);
        let end = if depth > 0.0 {
            high
        } else {
            high.min(RAYLEIGH_ONLY.max(low))
        };
        let spacing = Spacing::new([low, end], STEP, STEP / FAR_STEP);
        let loss = ground.unit_law.map_or(Complex64::from(1.0), |law| {
            law.speed_factor(unit_frequency(ground.kernel.medium()))
                .inv()
        });
        let slowness = ground.rayleigh_slowness();
        let mut curve = Self {
            spacing,
            nodes: Vec::new(),
            lowest: low,
            end,
            decay: -Complex64::i() * slowness * (loss - 1.0),
            errors: [0.0; 2],
        };
        let scaled = |x: f64| -> Result<(Response, f64), NoiseError> {
            let (value, error) = ground.exact(x, depth)?;
            let factor = scale(x, depth) * Complex64::from_polar(1.0, slowness * x);
            Ok((value.map(|h| h * factor), error * scale(x, depth)))
        };
        let nodes = (0..spacing.count).into_par_iter();
        let nodes: Result<Vec<_>, NoiseError> = nodes
            .map(|i| Ok(scaled(spacing.node(i as f64))?.0))
            .collect();
        let far = [1.5, 4.0].map(|part| high.min(part * end));
        let far = far.into_iter().filter(|x| *x > end).collect::<Vec<f64>>();
        let between = (1..spacing.count - 2).into_par_iter().step_by(CHECKED);
        let between = between.map(|i| spacing.node(i as f64 + 0.5));
        let places = between.filter(|x| *x <= end).chain(far);
        let checks: Result<Vec<_>, NoiseError> = places.map(|x| Ok((x, scaled(x)?))).collect();
        let (nodes, checks) = (nodes?, checks?);
        curve.nodes = nodes;
        let (inside, behind): (Vec<_>, Vec<_>) = checks.into_iter().partition(|(x, _)| *x <= end);
        curve.errors = [inside, behind].map(|checks| curve.worst(&checks, |x| curve.scaled(x)));
        Ok(curve)
    }

    /// Largest relative error of found values at some places where the true ones are known, with their error.
    fn worst(&self, checks: &[(f64, (Response, f64))], found: impl Fn(f64) -> Response) -> f64 {
        let size = |value: &Response| value[0].norm().hypot(value[1].norm());
        let largest = self
            .nodes
            .iter()
            .map(size)
            .fold(f64::MIN_POSITIVE, f64::max);
        let errors = checks.iter().map(|(x, (value, error))| {
            let found = found(*x);
            let off = size(&[found[0] - value[0], found[1] - value[1]]) + error;
            off / size(value).max(FLOOR * largest)
        });
        errors.fold(0.0, f64::max)
    }

    /// Relative error of a value.
    fn error(&self, x: f64) -> f64 {
        self.errors[usize::from(x > self.end)]
    }

    /// A tabulated value.
    fn scaled(&self, x: f64) -> Response {
        let (first, weights) = self.spacing.at(x.clamp(self.lowest, self.end));
        let mut sum = Response::default();
        for (node, weight) in self.nodes[first..].iter().zip(weights) {
            sum[0] += weight * node[0];
            sum[1] += weight * node[1];
        }
        if x > self.end {
            let decay = (self.decay * (x - self.end)).exp();
            sum = sum.map(|value| value * decay);
        }
        sum
    }
}

/// The responses at one depth, as functions of distance and frequency.
#[derive(Debug)]
pub(crate) struct Sheet {
    pub(crate) depth_m: f64,
    slowness: f64,
    /// The nodes in zeta; none on the surface.
    depths: Option<Spacing>,
    curves: Vec<Curve>,
    /// Relative error of values between the nodes in zeta.
    error: f64,
}

impl Sheet {
    /// Between two frequencies in Hz and two distances in m.
    pub(crate) fn new(
        ground: &Ground,
        depth_m: f64,
        frequencies_hz: [f64; 2],
        distances_m: [f64; 2],
    ) -> Result<Self, NoiseError> {
        let [from, to] = frequencies_hz.map(|f| ground.wave_number(f));
        let ends = [from * distances_m[0], to * distances_m[1]];
        let depths = (depth_m > 0.0)
            .then(|| Spacing::new([from * depth_m, to * depth_m], STEP, STEP / FAR_STEP));
        // a node serves the frequencies up to two nodes away
        let around = |nodes: &Spacing, i: f64| {
            let low = nodes.node(i - 2.0) * distances_m[0];
            [
                low / depth_m,
                nodes.node(i + 2.0) * distances_m[1] / depth_m,
            ]
        };
        let of_curve = |nodes: &Spacing, i: usize| around(nodes, i as f64)[1] / FAR_STEP;
        let nodes = depths.map_or(0.0, |all| (0..all.count).map(|i| of_curve(&all, i)).sum());
        NoiseError::unless(
            nodes <= MOST_NODES,
            format!("the number of responses at z_m = {depth_m}"),
            nodes,
            "[0, 3e5]",
            ": use lower frequencies, a smaller area, or z_m = 0",
        )?;
        let curves = match &depths {
            None => vec![Curve::new(ground, 0.0, ends)?],
            Some(nodes) => {
                let ends = |i: usize| around(nodes, i as f64);
                let curves =
                    (0..nodes.count).map(|i| Curve::new(ground, nodes.node(i as f64), ends(i)));
                curves.collect::<Result<_, _>>()?
            }
        };
        let mut sheet = Self {
            depth_m,
            slowness: ground.rayleigh_slowness(),
            depths,
            curves,
            error: 0.0,
        };
        if let Some(nodes) = depths {
            // at other places the values are those of a curve in between
            let place = nodes.count as f64 - 2.5;
            let middle = nodes.node(place);
            let ends = distances_m.map(|r| r * middle / depth_m);
            let other = Curve::new(ground, middle, ends)?;
            let at = sheet.at(middle / depth_m, 1.0);
            let checks = (0..other.spacing.count).step_by(CHECKED);
            let checks = checks.map(|i| other.spacing.node(i as f64));
            let checks = checks.filter(|x| (ends[0]..=ends[1]).contains(x));
            let checks = checks.map(|x| (x, (other.scaled(x), 0.0)));
            sheet.error = other.worst(&checks.collect::<Vec<_>>(), |x| at.scaled(x));
        }
        Ok(sheet)
    }

    /// At a wave number omega/c in 1/m, with the unit of displacement in m/N.
    fn at(&self, wave_number: f64, unit_m_n: f64) -> AtFrequency<'_> {
        let depth = wave_number * self.depth_m;
        let (first, weights) = match &self.depths {
            None => (0, [1.0, 0.0, 0.0, 0.0]),
            Some(nodes) => nodes.at(depth),
        };
        AtFrequency {
            sheet: self,
            curves: self.curves[first..].iter().zip(weights).collect(),
            depth,
            wave_number,
            unit_m_n,
        }
    }

    /// At a frequency in Hz.
    pub(crate) fn at_frequency(&self, ground: &Ground, frequency_hz: f64) -> AtFrequency<'_> {
        self.at(
            ground.wave_number(frequency_hz),
            ground.unit_m_n(frequency_hz),
        )
    }
}

/// The responses at one frequency and depth, as functions of distance.
#[derive(Debug)]
pub(crate) struct AtFrequency<'a> {
    sheet: &'a Sheet,
    curves: Vec<(&'a Curve, f64)>,
    depth: f64,
    pub(crate) wave_number: f64,
    unit_m_n: f64,
}

impl AtFrequency<'_> {
    /// Without phase and spreading.
    fn scaled(&self, x: f64) -> Response {
        let mut sum = Response::default();
        for (curve, weight) in &self.curves {
            let value = curve.scaled(x);
            sum = [0, 1].map(|c| sum[c] + *weight * value[c]);
        }
        sum
    }

    /// Relative error of |G|^2.
    pub(crate) fn error(&self, distance_m: f64) -> f64 {
        2.0 * (self.curves[0].0.error(self.wave_number * distance_m) + self.sheet.error)
    }

    /// |G|^2 in (m/N)^2, away from the force and down.
    pub(crate) fn power(&self, distance_m: f64) -> [f64; 2] {
        let x = self.wave_number * distance_m;
        let unit = self.unit_m_n / scale(x.max(self.curves[0].0.lowest), self.depth);
        self.scaled(x).map(|value| value.norm_sqr() * unit * unit)
    }

    /// G in m/N.
    pub(crate) fn value(&self, distance_m: f64) -> Response {
        let x = self.wave_number * distance_m;
        let unit = self.unit_m_n / scale(x.max(self.curves[0].0.lowest), self.depth);
        let factor = Complex64::from_polar(unit, -self.sheet.slowness * x);
        self.scaled(x).map(|value| value * factor)
    }
}

/// The spreading that is removed, R/sqrt(1 + R).
fn scale(x: f64, depth: f64) -> f64 {
    let distance = x.hypot(depth);
    distance / (1.0 + distance).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use contact::Material;
    use halfspace::random::Stream;

    fn ground(poisson_ratio: f64, quality_factor: Option<f64>) -> Ground {
        let mut rock = Material::named("granite").unwrap();
        rock.poisson_ratio = poisson_ratio;
        let mut block = HalfSpace::new(rock).unwrap();
        block.attenuation = quality_factor.map(|q| Attenuation::new(q, 10.0).unwrap());
        Ground::new(&block).unwrap()
    }

    /// mu |G| c2/omega of an independent program (a complex integral over wave number): elastic and nu 0.25.
    #[test]
    fn the_response_is_that_of_the_reference() {
        let ground = ground(0.25, None);
        let sheet = Sheet::new(&ground, 0.0, [1.0, 1.0], [1.0, 1e5]).unwrap();
        let at = sheet.at(1.0, 1.0);
        for (kr, known) in [
            (0.1, 1.298523),
            (0.3, 0.4334266),
            (1.0, 0.1319925),
            (3.0, 0.04900194),
            (6.0, 0.03002806),
            (10.0, 0.02243527),
            (20.0, 0.01713442),
            (30.0, 0.01457482),
            (60.0, 0.01049811),
        ] {
            let found = at.power(kr / ground.rayleigh_slowness())[1].sqrt();
            println!("kr {kr}: {found:.7} {known:.7}");
            assert!((found / known - 1.0).abs() < 1e-5, "{kr}");
        }
    }

    /// Tables against the kernel at other places, and their own estimates.
    #[test]
    fn responses_are_those_of_the_kernel() {
        let mut random = Stream::new(7);
        for (quality, depth, allowed) in [
            (None, 0.0, 5e-4),
            (Some(20.0), 0.0, 5e-4),
            (Some(100.0), 0.0, 5e-4),
            (None, 1.0, 5e-4),
            (Some(20.0), 1.0, 5e-4),
        ] {
            let ground = ground(0.3, quality);
            let high = if depth > 0.0 { 20.0 } else { 700.0 };
            // frequencies at which the depth and the distances are these
            let unit_hz = 1.0 / ground.wave_number(1.0);
            let frequencies = if depth > 0.0 { [0.3, 3.0] } else { [1.0; 2] };
            let frequencies = frequencies.map(|f| f * unit_hz);
            let sheet = Sheet::new(&ground, depth, frequencies, [1e-3, high]).unwrap();
            let mut worst = 0.0_f64;
            for _ in 0..100 {
                let x = random.log(1e-3_f64.max(2.0 * ABOVE * depth), high);
                let factor = random.log(0.5, 2.0);
                let (x, depth) = if depth > 0.0 {
                    (x * factor, factor)
                } else {
                    (x, depth)
                };
                let (exact, _) = ground.exact(x, depth).unwrap();
                let at = sheet.at(if depth > 0.0 { depth } else { 1.0 }, 1.0);
                let found = at.value(x / at.wave_number);
                let off = (found[0] - exact[0])
                    .norm()
                    .hypot((found[1] - exact[1]).norm());
                let size = exact[0].norm().hypot(exact[1].norm());
                let elastic = 0.1 * (1.0 + x).sqrt() / x.hypot(depth);
                let floor = if x > RAYLEIGH_ONLY { 4e-3 } else { allowed };
                worst = worst.max(off / size.max(FLOOR * elastic) / floor * allowed);
            }
            let stated = sheet.error + sheet.curves[0].errors[0];
            println!("Q {quality:?}, depth {depth}: {worst:.1e}, stated {stated:.1e}");
            assert!(worst < allowed && stated < 5.0 * allowed);
        }
    }
}
