//! Where the model leaves what it was made for: warnings with their numbers.

use crate::contact::Collision;
use crate::scene::{Scene, Striker};
use std::f64::consts::PI;

/// Results that the checks look at, in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Reached {
    pub(crate) peak_force_n: f64,
    pub(crate) contact_time_s: f64,
    /// Radius of a fixed disc; none for a contact that follows the load.
    pub(crate) disc_radius_m: Option<f64>,
    pub(crate) contacts: usize,
    /// Coupling of a march with the deflection of the centre and its full static share; zero otherwise.
    pub(crate) centre_coupling: f64,
}

/// Coupling up to which the deflection of the centre takes more energy than it gives, for any Poisson's ratio
/// between 0 and 0.45: its compliance at some frequencies is real and down to -0.14 of the static one.
const CENTRE_COUPLING: f64 = 5.0;

/// alpha_A = sqrt(pi rho r^3/m) (V0/c1)^(3/2): the weight of the super-seismic stage.
#[must_use]
pub fn super_seismic(scene: &Scene, striker: &Striker, radius_m: f64) -> f64 {
    let speed = scene
        .target
        .longitudinal_speed_m_s()
        .unwrap_or(f64::INFINITY);
    (PI * scene.target_density_kg_m3 * radius_m.powi(3) / striker.mass_kg).sqrt()
        * (striker.velocity_m_s / speed).powf(1.5)
}

pub(crate) fn warnings(
    scene: &Scene,
    striker: &Striker,
    collision: &Collision,
    reached: &Reached,
) -> Vec<String> {
    let mut found = Vec::new();
    let hertz_radius = collision.contact_radius_m(reached.peak_force_n);
    let radius = reached.disc_radius_m.unwrap_or(hertz_radius);

    let alpha = super_seismic(scene, striker, radius);
    if alpha > 0.1 {
        found.push(format!(
            "alpha_A = {alpha:.3} is not small against 1: the contact spreads faster than waves for a good part of the impact"
        ));
    }
    if hertz_radius > 0.5 * striker.tip_radius_m {
        found.push(format!(
            "the contact radius reaches {hertz_radius:.3e} m, more than half of tip_radius_m = {:.3e} m: Hertz's law is for small contacts",
            striker.tip_radius_m
        ));
    }
    if let Some(disc) = reached.disc_radius_m {
        let ratio = disc / hertz_radius;
        if !(0.5..=2.0).contains(&ratio) {
            found.push(format!(
                "disc_radius_m = {disc:.3e} m is {ratio:.2} times the largest contact radius {hertz_radius:.3e} m: the fixed disc does not resemble the contact"
            ));
        }
    }
    let stress = reached.peak_force_n / (PI * radius * radius);
    for (body, material) in [("striker", &striker.material), ("target", &scene.target)] {
        for (name, strength) in [
            ("yield strength", material.yield_strength_pa),
            ("tensile strength", material.tensile_strength_pa),
        ] {
            if let Some(strength) = strength.filter(|&s| stress > s) {
                found.push(format!(
                    "the mean contact stress {:.4e} Pa is {:.2} times the {name} {strength:.4e} Pa of the {body} (the ratio Kmax): the impact is not elastic unless the dynamic strength is that high",
                    stress,
                    stress / strength
                ));
            }
        }
    }
    if let Some(length) = striker.length_m {
        let density = striker.material.density_kg_m3;
        if let Some(density) = density {
            let period = 2.0 * length / (striker.material.youngs_modulus_pa / density).sqrt();
            let ratio = reached.contact_time_s / period;
            if ratio < 10.0 {
                found.push(format!(
                    "the contact lasts {ratio:.2} periods {period:.3e} s of the striker's longest free oscillation, less than 10: waves in the striker matter and are not modelled"
                ));
            }
        }
    }
    if let Some(thickness) = scene.target_thickness_m {
        let speed = collision.target_longitudinal_speed_m_s;
        let echo = 2.0 * thickness / speed;
        if echo < reached.contact_time_s {
            found.push(format!(
                "the echo from thickness_m = {thickness:.3e} m returns after {echo:.3e} s, before the contact ends at {:.3e} s: the block is not a half-space",
                reached.contact_time_s
            ));
        }
    }
    if reached.centre_coupling > CENTRE_COUPLING {
        found.push(format!(
            "the disc gives way {:.1} times as much as the contact, more than {CENTRE_COUPLING}: the deflection of its centre is not conjugate to the pressure and may feed energy back; set deflection = \"mean\"",
            reached.centre_coupling
        ));
    }
    if reached.contacts > 1 {
        found.push(format!(
            "the surface strikes again: {} contacts; contact_time_s is that of the first",
            reached.contacts
        ));
    }
    found
}
