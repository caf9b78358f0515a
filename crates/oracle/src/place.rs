//! The step response at one place under one disc, in SI units.

use crate::error::OracleError;
use contact::HalfSpace;
use halfspace::{Arrivals, Kernel, Medium, Profile, Six};

/// A place under a disc that carries a force.
pub(crate) struct Place {
    kernel: Kernel,
    r: f64,
    z: f64,
    /// Unit of time r0/c1 in s.
    time_s: f64,
    /// Units of displacements, P/(mu r0), and of stresses, P/r0^2.
    units: [f64; 2],
    rest: Six,
    /// Whether stresses are integrated over time.
    integrated: bool,
    /// Arrivals of waves in s, ascending.
    pub(crate) fronts_s: Vec<f64>,
}

impl Place {
    /// The response at r_m, z_m to a step of `force_n` on a disc. For a point force the unit of length is the distance.
    ///
    /// With `integrated` the stresses are time integrals, which are functions under any profile.
    pub(crate) fn new(
        block: &HalfSpace,
        (profile, radius_m, force_n): (Profile, f64, f64),
        [r_m, z_m]: [f64; 2],
        integrated: bool,
        tolerance: f64,
    ) -> Result<Self, OracleError> {
        let unit_m = match profile {
            Profile::Point => r_m.hypot(z_m),
            Profile::Hertz | Profile::Punch => radius_m,
        };
        let (r, z) = (r_m / unit_m, z_m / unit_m);
        let medium = Medium::new(block.material().poisson_ratio)?;
        let kernel = Kernel::new(&medium, profile, tolerance)?;
        let arrivals = Arrivals::new(&medium, profile, r, z)?;
        let first = arrivals.first();
        let time_s = unit_m / block.longitudinal_speed_m_s();
        let displacement_m = force_n / (block.material().shear_modulus_pa() * unit_m);
        let fronts = arrivals.sorted().into_iter().filter(|&t| t >= first);
        Ok(Self {
            rest: kernel.static_field(r, z)?,
            kernel,
            r,
            z,
            time_s,
            units: [displacement_m, force_n / (unit_m * unit_m)],
            integrated,
            fronts_s: fronts.map(|t| t * time_s).collect(),
        })
    }

    /// Values in SI units of values in reduced units.
    fn in_si(&self, found: Six) -> Six {
        std::array::from_fn(|f| self.units[usize::from(f >= 2)] * found[f])
    }

    /// The first arrival in s.
    pub(crate) fn first_s(&self) -> f64 {
        self.fronts_s[0]
    }

    /// Sizes of the static fields, those of the same unit alike; of integrated stresses until the first arrival.
    pub(crate) fn sizes(&self) -> Six {
        let rest = self.in_si(self.rest);
        let largest = |part: &[f64]| part.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let span_s = if self.integrated { self.first_s() } else { 1.0 };
        let [u, s] = [largest(&rest[..2]), span_s * largest(&rest[2..])];
        [u, u, s, s, s, s]
    }

    /// The six fields at a time after a step of the force; stresses are their integrals since the step if they are `integrated`.
    pub(crate) fn step(&self, after_s: f64) -> Result<Six, OracleError> {
        let t = after_s / self.time_s;
        let remainder = self.kernel.remainder(self.r, self.z, t)?.value;
        let mut found: Six = std::array::from_fn(|f| self.rest[f] + remainder[f]);
        if self.integrated {
            // it is -t times the static field before the first arrival, so that it begins at zero
            let integral = self.kernel.step_integral(self.r, self.z, t)?.value;
            for f in 2..6 {
                found[f] = self.time_s * (self.rest[f] * t + integral[f]);
            }
        }
        Ok(self.in_si(found))
    }

    /// Velocities u and w in m/s at a time after a step of the force.
    pub(crate) fn step_velocity(&self, after_s: f64) -> Result<[f64; 2], OracleError> {
        let t = after_s / self.time_s;
        let found = self.kernel.displacement_impulse(self.r, self.z, t)?;
        Ok(found.map(|v| v * self.units[0] / self.time_s))
    }
}
