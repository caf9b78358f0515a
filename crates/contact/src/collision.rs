//! A collision of two elastic bodies and its dimensionless groups.
//!
//! Theory: `docs/theory.md` (T36, T39, T49).

use crate::bodies::strength::{Loading, Strength};
use crate::bodies::{HalfSpace, Striker};
use crate::disc::FixedDisc;
use crate::error::ContactError;
use crate::law::fit::{FITTED, Fit};
use crate::law::hertz::CONTACT_TIME;
use crate::law::yielding::{FlowLaw, Yielding};
use crate::names::Choice;
use crate::settings::{Plasticity, Settings, StaticShare};
use crate::units::{CollisionUnits, KernelUnits};
use crate::waves::punch::{GrowingContact, PunchWaves};
use crate::waves::response::DiscResponse;
use halfspace::Medium;
use std::f64::consts::PI;

/// Mean pressure of full plasticity over the yield strength.
pub const CONSTRAINT: f64 = 2.8;

/// Range of the numbers of bodies in SI units, whose powers and products stay numbers.
const PHYSICAL: [f64; 2] = [1e-30, 1e30];

/// Steps of a march over Hertz's contact at most and at least, from where it cannot be one.
const STEPS_OF_MARCH: [f64; 2] = [1e-3, 1e9];

/// A striker with a spherical tip that meets an elastic half-space, in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Collision {
    /// Mass of the striker in kg.
    pub mass_kg: f64,
    /// Velocity of approach in m/s.
    pub velocity_m_s: f64,
    /// Radius of the tip in m.
    pub tip_radius_m: f64,
    /// E* in Pa: 1/E* = (1 - nu1^2)/E1 + (1 - nu^2)/E.
    pub effective_modulus_pa: f64,
    /// Plane modulus E/(1 - nu^2) of the half-space in Pa.
    pub target_plane_modulus_pa: f64,
    /// Shear modulus of the half-space in Pa.
    pub target_shear_modulus_pa: f64,
    /// Longitudinal wave speed of the half-space in m/s.
    pub target_longitudinal_speed_m_s: f64,
    /// Poisson's ratio of the half-space.
    pub target_poisson_ratio: f64,
    /// Strengths of the striker and the half-space.
    pub strengths: [Strength; 2],
}

impl Collision {
    /// The collision of a striker with a half-space at a velocity of approach in m/s.
    pub fn new(half_space: &HalfSpace, striker: &Striker, velocity_m_s: f64) -> Self {
        let (one, two) = (&striker.material, half_space.material());
        let compliance = 1.0 / one.plane_modulus_pa() + 1.0 / two.plane_modulus_pa();
        Self {
            mass_kg: striker.mass_kg,
            velocity_m_s,
            tip_radius_m: striker.tip_radius_m,
            effective_modulus_pa: 1.0 / compliance,
            target_plane_modulus_pa: two.plane_modulus_pa(),
            target_shear_modulus_pa: two.shear_modulus_pa(),
            target_longitudinal_speed_m_s: half_space.longitudinal_speed_m_s(),
            target_poisson_ratio: two.poisson_ratio,
            strengths: [one, two].map(Strength::new),
        }
    }

    /// Whether the numbers are those of bodies, and the approach slower than the half-space's Rayleigh wave.
    ///
    /// # Errors
    /// [`ContactError::OutOfRange`], [`ContactError::TooFast`], and a Poisson's ratio outside the physics.
    pub fn check(&self) -> Result<(), ContactError> {
        let outside = |quantity, value| Err(ContactError::OutOfRange { quantity, value });
        let (plane_pa, speed_m_s) = (
            self.target_plane_modulus_pa,
            self.target_longitudinal_speed_m_s,
        );
        for (quantity, value) in [
            ("mass_kg", self.mass_kg),
            ("tip_radius_m", self.tip_radius_m),
            ("the effective modulus in Pa", self.effective_modulus_pa),
            ("the half-space's plane modulus in Pa", plane_pa),
            ("the half-space's wave speed in m/s", speed_m_s),
        ] {
            if !(PHYSICAL[0]..=PHYSICAL[1]).contains(&value) {
                return outside(quantity, value);
            }
        }
        let velocity_m_s = self.velocity_m_s;
        // Rayleigh's wave has at least 0.68 of the shear wave's speed: the root is only looked for where it matters
        let nu = self.target_poisson_ratio;
        let shear = speed_m_s * ((0.5 - nu) / (1.0 - nu)).sqrt();
        if velocity_m_s >= 0.5 * shear {
            let limit_m_s = Medium::new(nu)?.rayleigh_speed() * speed_m_s;
            if velocity_m_s >= limit_m_s {
                return Err(ContactError::TooFast {
                    velocity_m_s,
                    limit_m_s,
                });
            }
        }
        if velocity_m_s >= PHYSICAL[0] {
            return Ok(());
        }
        outside("velocity_m_s", velocity_m_s)
    }

    /// Whether a step that is given can be one of a march over this contact.
    ///
    /// # Errors
    /// [`ContactError::Step`], whatever [`check`](Self::check) refuses.
    pub fn check_step(&self, settings: &Settings) -> Result<(), ContactError> {
        let Some(step_s) = settings.step_s else {
            return Ok(());
        };
        self.check()?;
        let hertz_s = CONTACT_TIME * self.units().time_s;
        if (STEPS_OF_MARCH[0]..=STEPS_OF_MARCH[1]).contains(&(hertz_s / step_s)) {
            return Ok(());
        }
        Err(ContactError::Step { step_s, hertz_s })
    }

    /// How the contact yields by its settings; none where no body does.
    ///
    /// The softer of both bodies flows. Without a pressure given it is [`CONSTRAINT`] times the yield strength.
    ///
    /// # Errors
    /// [`ContactError::NoStrength`] where nothing says when it yields.
    pub fn yielding(&self, settings: &Settings) -> Result<Option<Yielding>, ContactError> {
        let law = settings.plasticity;
        let missing = ContactError::NoStrength { law: law.name() };
        let known = self.strengths.iter().filter_map(Strength::yields);
        // indentation at which the maximum of Hertz's pressure is this one
        let depth_of = |maximum: f64| {
            let angle = 0.5 * PI * maximum / self.effective_modulus_pa;
            angle * angle * self.tip_radius_m / self.units().length_m
        };
        let cut = |law| {
            let softest = known.clone().map(|(strength, _)| strength).reduce(f64::min);
            let taken = softest.map(|strength| CONSTRAINT * strength);
            let pressure_pa = settings.yield_pressure_pa.or(taken)?;
            Some((pressure_pa, depth_of(pressure_pa), law))
        };
        let fitted = || {
            let shaped = known.clone();
            let shaped = shaped.map(|(strength, nu)| (strength, 1.295 * (0.736 * nu).exp()));
            let softer = |a: (f64, f64), b: (f64, f64)| if b.0 * b.1 < a.0 * a.1 { b } else { a };
            let (strength, shape) = shaped.reduce(softer)?;
            let critical = depth_of(strength * shape);
            let fit = Fit::new(critical, shape, strength / self.effective_modulus_pa);
            // the mean of Hertz's pressure whose maximum is C S_y
            let pressure_pa = 2.0 / 3.0 * shape * strength;
            Some((pressure_pa, FITTED * critical, FlowLaw::Fit(fit)))
        };
        let found = match law {
            Plasticity::None => return Ok(None),
            Plasticity::Thornton => cut(FlowLaw::Thornton),
            Plasticity::Recovery => cut(FlowLaw::Recovery),
            Plasticity::JacksonGreen => fitted(),
        };
        let (yield_pressure_pa, depth, law) = found.ok_or(missing)?;
        if depth.is_nan() || depth <= 0.0 {
            return Err(ContactError::NotFinite {
                quantity: "yield depth",
                value: depth,
            });
        }
        Ok(Some(Yielding {
            law,
            yield_pressure_pa,
            depth,
        }))
    }

    /// Units of the collision: Hertz's largest approach and force, K = (4/3) E* sqrt(R), (37).
    pub fn units(&self) -> CollisionUnits {
        let stiffness_n_m32 = 4.0 / 3.0 * self.effective_modulus_pa * self.tip_radius_m.sqrt();
        CollisionUnits::new(stiffness_n_m32, self.mass_kg, self.velocity_m_s)
    }

    /// Units of the half-space's kernels for a disc.
    pub fn kernel_units(&self, disc_radius_m: f64) -> KernelUnits {
        KernelUnits {
            disc_radius_m,
            longitudinal_speed_m_s: self.target_longitudinal_speed_m_s,
            shear_modulus_pa: self.target_shear_modulus_pa,
        }
    }

    /// Kinetic energy before, in J.
    pub(crate) fn energy_j(&self) -> f64 {
        0.5 * self.mass_kg * self.velocity_m_s * self.velocity_m_s
    }

    /// Contact radius a = sqrt(R alpha) in m under a force in N: (3 P R/(4 E*))^(1/3).
    pub fn contact_radius_m(&self, force_n: f64) -> f64 {
        (0.75 * force_n * self.tip_radius_m / self.effective_modulus_pa).cbrt()
    }

    /// Loading of the bodies by a largest force in N on a disc of a radius in m, over their strengths.
    pub(crate) fn loading(&self, force_n: f64, disc_radius_m: f64) -> Loading {
        let pressure = force_n / (PI * disc_radius_m * disc_radius_m);
        let contact = [self.tip_radius_m, self.effective_modulus_pa];
        let over = |load: f64, of: &dyn Fn(&Strength) -> Option<f64>| {
            let limits = self.strengths.iter().filter_map(of);
            limits.reduce(f64::min).map(|limit| load / limit)
        };
        Loading {
            mean_pressure_pa: pressure,
            yield_onset: over(pressure, &|body| body.yield_pressure_pa),
            pressure_over_yield: over(pressure, &|body| body.yield_strength_pa),
            pressure_over_tensile: over(pressure, &|body| body.tensile_strength_pa),
            cone_crack_onset: over(force_n, &|body| body.cone_crack_force_n(contact)),
        }
    }

    /// phi: the half-space's part of the contact's compliance, E* (1 - nu^2)/E in (0, 1).
    pub fn target_share(&self) -> f64 {
        self.effective_modulus_pa / self.target_plane_modulus_pa
    }

    /// The groups of an impact on a fixed disc.
    pub fn fixed_disc<'a, R: DiscResponse>(
        &self,
        response: &'a R,
        disc_radius_m: f64,
        share: StaticShare,
    ) -> FixedDisc<'a, R> {
        let (units, kernel) = (self.units(), self.kernel_units(disc_radius_m));
        let compliance = response.disc().static_compliance * kernel.displacement_m_per_n();
        FixedDisc {
            response,
            coupling: compliance * units.force_n / units.length_m,
            wave_time: kernel.time_s() / units.time_s,
            share,
        }
    }

    /// The groups of an impact whose contact radius follows the load.
    pub fn growing_contact<'w>(&self, waves: &'w PunchWaves) -> GrowingContact<'w> {
        GrowingContact {
            waves,
            target_share: self.target_share(),
            wave_time: self.contact_wave_time(),
        }
    }

    /// a/c1 in collision times, a = sqrt(R alpha) the contact radius at Hertz's largest approach.
    pub fn contact_wave_time(&self) -> f64 {
        let units = self.units();
        let radius = (self.tip_radius_m * units.length_m).sqrt();
        radius / self.target_longitudinal_speed_m_s / units.time_s
    }

    /// c of the radiation model in collision units: w = -c p' to first order, for any load; with a/c1 at hand.
    pub fn lag(&self, contact_wave_time: f64, response: &impl DiscResponse) -> f64 {
        // phi (2/3) a J_p with the punch's J, which is the same for any disc
        // (the Hertz disc's mean deflection has another static part and another relaxation, the same product)
        let centre = response.disc().static_compliance * response.disc().relaxation_time
            / (0.375 * (1.0 - self.target_poisson_ratio));
        self.target_share() * contact_wave_time * centre
    }
}
