//! Warnings, with their numbers, where a scene leaves the range of its model.
//!
//! Theory: `docs/theory.md` (T57).

use crate::bodies::material::Material;
use crate::bodies::shape::Shape;
use crate::bodies::{HalfSpace, Striker};
use crate::collision::Collision;
use crate::disc::CENTRE_COUPLING;
use crate::names::Choice;
use crate::results::Results;
use crate::settings::{Model, Settings, StaticShare};
use crate::solve::choose::{Chosen, fixed_disc_m};
use halfspace::Deflection;
use std::f64::consts::PI;

/// alpha_A = sqrt(pi rho r^3/m) (V0/c1)^(3/2): the weight of the super-seismic stage.
pub fn super_seismic(half_space: &HalfSpace, collision: &Collision, radius_m: f64) -> f64 {
    (PI * half_space.density_kg_m3() * radius_m.powi(3) / collision.mass_kg).sqrt()
        * (collision.velocity_m_s / half_space.longitudinal_speed_m_s()).powf(1.5)
}

/// Mass over that of a ball of the tip's radius below which the two hint at a slip in a unit.
const LIGHT: f64 = 1e-3;

/// Usual ranges of the numbers of bodies: field, least and most, unit, and a unit that is often taken for it with its size.
const USUAL: [(&str, [f64; 2], &str, &str, f64); 8] = [
    ("youngs_modulus_pa", [1e3, 2e12], "Pa", "GPa", 1e9),
    ("density_kg_m3", [10.0, 3e4], "kg/m3", "g/cm3", 1e3),
    ("yield_strength_pa", [1e3, 1e12], "Pa", "MPa", 1e6),
    ("tensile_strength_pa", [1e3, 1e12], "Pa", "MPa", 1e6),
    ("diameter_m", [1e-8, 1.0], "m", "mm", 1e-3),
    ("length_m", [1e-8, 30.0], "m", "mm", 1e-3),
    ("tip_radius_m", [1e-9, 10.0], "m", "mm", 1e-3),
    ("mass_kg", [1e-20, 1e5], "kg", "g", 1e-3),
];

/// Doubts about the numbers of two bodies, by field.
pub fn doubts(half_space: &HalfSpace, striker: &Striker) -> Vec<String> {
    let target = half_space.material();
    let of_material = |body, material: &Material| {
        [
            (body, "youngs_modulus_pa", Some(material.youngs_modulus_pa)),
            (body, "density_kg_m3", material.density_kg_m3),
            (body, "yield_strength_pa", material.yield_strength_pa),
            (body, "tensile_strength_pa", material.tensile_strength_pa),
        ]
    };
    let lengths = match striker.shape {
        Some(Shape::Ball { diameter_m } | Shape::Rod { diameter_m, .. }) => [
            ("diameter_m", Some(diameter_m)),
            ("length_m", striker.length_m),
        ],
        None => [
            ("tip_radius_m", Some(striker.tip_radius_m)),
            ("mass_kg", Some(striker.mass_kg)),
        ],
    };
    let lengths = lengths.map(|(field, value)| ("striker", field, value));
    let numbers = of_material("striker", &striker.material).into_iter();
    let numbers = numbers.chain(lengths).chain(of_material("target", target));
    let unusual = numbers.filter_map(|(body, field, value)| {
        let (_, [least, most], unit, name, size) = USUAL.into_iter().find(|row| row.0 == field)?;
        let value = value.filter(|value| !(least..=most).contains(value))?;
        let meant = if (least..=most).contains(&(value * size)) {
            format!("did you mean {}, for {value} {name}?", plain(value * size))
        } else {
            format!("is it in {unit}?")
        };
        Some(format!(
            "{body}.{field} = {} is outside the usual range of {} to {} {unit}: {meant}",
            fault::number(value),
            plain(least),
            plain(most)
        ))
    });
    unusual.chain(doubt(striker)).collect()
}

/// A number with four digits at most, with an exponent unless it is of a moderate size.
fn plain(value: f64) -> String {
    let rounded = fault::rounded(value);
    match value.abs() {
        1e-2..1e5 => rounded,
        _ => format!("{:e}", rounded.parse().unwrap_or(value)),
    }
}

/// A doubt about the mass: one that no body with such a tip has, or that of a ball of half the radius.
fn doubt(striker: &Striker) -> Option<String> {
    let (mass_kg, radius_m) = (striker.mass_kg, striker.tip_radius_m);
    let ball_kg = 4.0 / 3.0 * PI * radius_m.powi(3) * striker.material.density_kg_m3?;
    let share = mass_kg / ball_kg;
    if share < LIGHT {
        return Some(format!(
            "tip_radius_m = {radius_m:.4e} m and mass_kg = {mass_kg:.4e} kg: a ball of that radius has a mass of {ball_kg:.4e} kg, {:.1e} times as much; is the radius in m and the mass in kg?",
            1.0 / share
        ));
    }
    ((8.0 * share - 1.0).abs() < 0.02).then(|| {
        format!(
            "mass_kg = {mass_kg:.4e} kg is that of a ball of {:.4e} m radius, half of tip_radius_m = {radius_m:.4e} m: is that the diameter?",
            0.5 * radius_m
        )
    })
}

/// Warnings about the bodies, the settings, the model and its results: sentences with their numbers, none where
/// all is well.
pub fn warnings(
    half_space: &HalfSpace,
    striker: &Striker,
    collision: &Collision,
    settings: &Settings,
    chosen: &Chosen,
    results: &Results,
) -> Vec<String> {
    let mut found = Vec::new();
    let disc_radius_m = fixed_disc_m(chosen.model, settings, collision);
    let hertz_radius = results.contact_radius_m;
    let radius = disc_radius_m.unwrap_or(hertz_radius);
    let alpha = super_seismic(half_space, collision, radius);
    if alpha > 0.1 {
        found.push(format!(
            "alpha_A = {alpha:.3} is not small compared with 1: the contact spreads faster than waves during a large part of the impact"
        ));
    }
    let tip = striker.tip_radius_m;
    if hertz_radius > tip {
        found.push(format!(
            "the contact radius reaches {hertz_radius:.3e} m, more than the limit tip_radius_m = {tip:.3e} m: the contact would be wider than the sphere, so Hertz's law does not apply"
        ));
    } else if hertz_radius > 0.5 * tip {
        found.push(format!(
            "the contact radius reaches {hertz_radius:.3e} m, more than half of tip_radius_m = {tip:.3e} m: Hertz's law applies to small contacts"
        ));
    }
    if let Some(disc) = disc_radius_m {
        let ratio = disc / hertz_radius;
        if !(0.5..=2.0).contains(&ratio) {
            found.push(format!(
                "disc_radius_m = {disc:.3e} m is {ratio:.2} times the largest contact radius {hertz_radius:.3e} m: the fixed disc does not resemble the contact"
            ));
        }
    }
    of_the_materials(collision, results, &mut found);
    of_the_flow(collision, settings, results, &mut found);
    let contact_time_s = results.contact_time_s;
    let material = &striker.material;
    if let (Some(length), Some(density)) = (striker.length_m, material.density_kg_m3) {
        let period = 2.0 * length / (material.youngs_modulus_pa / density).sqrt();
        let ratio = contact_time_s / period;
        if ratio < 10.0 {
            found.push(format!(
                "the contact lasts {contact_time_s:.3e} s, {ratio:.2} times the longest period of the striker's own vibrations, {period:.3e} s: below a ratio of 10 waves in the striker matter, which are not modelled"
            ));
        }
    }
    // the contact on a plate knows its echo
    let deep = match half_space.echoing() {
        None => half_space.thickness_m.map(|size| ("thickness_m", size)),
        Some(_) => None,
    };
    let wide = half_space.radius_m.map(|size| ("radius_m", size));
    let faces = deep.into_iter().chain(wide);
    let nearest = faces.reduce(|one, other| if other.1 < one.1 { other } else { one });
    let echo = nearest.map(|(_, size)| 2.0 * size / half_space.longitudinal_speed_m_s());
    if let (Some((key, size)), Some(echo)) = (nearest, echo.filter(|&echo| echo < contact_time_s)) {
        found.push(format!(
            "the echo from {key} = {size:.3e} m returns after {echo:.3e} s, before the contact ends at {contact_time_s:.3e} s: the block does not act as a half-space"
        ));
    }
    found.extend(doubts(half_space, striker));
    of_the_model(settings, chosen, results, &mut found);
    found
}

fn of_the_materials(collision: &Collision, results: &Results, found: &mut Vec<String>) {
    let loading = &results.loading;
    let stress = loading.mean_pressure_pa;
    let mut borne = Vec::new();
    for (body, strength) in ["striker", "target"].into_iter().zip(&collision.strengths) {
        let onset = strength.yield_pressure_pa.filter(|&onset| stress > onset);
        if let (Some(onset), Some(limit)) = (onset, strength.yield_strength_pa) {
            borne.push(format!(
                "{:.2} times the yield strength of the {body}, {limit:.4e} Pa (yielding begins at {:.2} times)",
                stress / limit,
                onset / limit
            ));
        }
        // a brittle body bears more pressure than tension, until it cracks
        let brittle = strength.fracture_toughness_pa_sqrt_m.is_some();
        let tensile = strength.tensile_strength_pa.filter(|_| !brittle);
        if let Some(limit) = tensile.filter(|&limit| stress > limit) {
            borne.push(format!(
                "{:.2} times the tensile strength of the {body}, {limit:.4e} Pa",
                stress / limit
            ));
        }
        let force_n = results.peak_force_n;
        let contact = [collision.tip_radius_m, collision.effective_modulus_pa];
        let crack = strength.cone_crack_force_n(contact);
        if let Some(crack_n) = crack.filter(|&crack_n| force_n > crack_n) {
            found.push(format!(
                "the peak force {} N is {:.2} times {} N, at which a cone crack in the {body} is expected (Auerbach's law, accurate to about one significant digit)",
                fault::rounded(force_n),
                force_n / crack_n,
                fault::rounded(crack_n)
            ));
        }
    }
    // a plasticity law describes the contact beyond the onset
    if !borne.is_empty() && results.plastic.yield_pressure_pa.is_none() {
        found.push(format!(
            "the mean contact stress {stress:.4e} Pa is {}: the impact is not elastic, unless the strength is higher under such a short load",
            borne.join("; ")
        ));
    }
}

fn of_the_flow(
    collision: &Collision,
    settings: &Settings,
    results: &Results,
    found: &mut Vec<String>,
) {
    let over = results.plastic.velocity_over_trusted;
    if let Some(over) = over.filter(|&over| over > 1.0) {
        let (velocity, law) = (collision.velocity_m_s, settings.plasticity.name());
        found.push(format!(
            "velocity_m_s = {} is {over:.1} times the {} m/s up to which plasticity = \"{law}\" is valid: restitution and indentation may have large errors, which the error estimate does not include; use \"thornton\" or \"recovery\", or a lower velocity",
            fault::rounded(velocity),
            fault::rounded(velocity / over)
        ));
    }
}

fn of_the_model(settings: &Settings, chosen: &Chosen, results: &Results, found: &mut Vec<String>) {
    let paper = (chosen.model, settings.static_share, settings.deflection);
    let of_centre = paper == (Model::Wave, StaticShare::Full, Deflection::Centre);
    let centre = chosen.regime.coupling;
    if of_centre && centre > CENTRE_COUPLING {
        found.push(format!(
            "the disc is {centre:.1} times as compliant as the contact, more than {CENTRE_COUPLING}: the deflection of its centre is not conjugate to the pressure and may feed energy back; set deflection = \"mean\""
        ));
    }
    let (error, tolerance) = (results.relative_error_estimate, settings.tolerance);
    if error > tolerance && results.march_steps > 0 && settings.step_s.is_none() {
        found.push(format!(
            "the tolerance {tolerance:.1e} is not reached: the estimated error is {error:.1e}"
        ));
    }
    if results.contacts > 1 {
        found.push(format!(
            "the surface strikes again: there are {} contacts, and contact_time_s is that of the first",
            results.contacts
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_no_body_has_are_told_by_field() {
        let steel = Material::named("steel").unwrap_or_else(|error| panic!("{error}"));
        let glass = Material {
            youngs_modulus_pa: 70.0,
            density_kg_m3: Some(2.5),
            ..steel.clone()
        };
        let ball = |diameter_m| {
            let made = Striker::of_shape(steel.clone(), Shape::Ball { diameter_m });
            made.unwrap_or_else(|error| panic!("{error}"))
        };
        let target = |material| HalfSpace::new(material).unwrap_or_else(|error| panic!("{error}"));
        assert!(doubts(&target(steel.clone()), &ball(3e-3)).is_empty());
        let found = doubts(&target(glass), &ball(3.0));
        let told = [
            "striker.diameter_m = 3 is outside the usual range of 1e-8 to 1 m: did you mean 3e-3, for 3 mm?",
            "target.youngs_modulus_pa = 70 is outside the usual range of 1000 to 2e12 Pa: did you mean 7e10, for 70 GPa?",
            "target.density_kg_m3 = 2.5 is outside the usual range of 10 to 30000 kg/m3: did you mean 2500, for 2.5 g/cm3?",
        ];
        assert_eq!(found, told);
    }

    #[test]
    fn slips_in_units_are_told_with_their_numbers() {
        let doubt = |tip_radius_m: f64, mass_kg: f64| {
            let material = Material::named("steel").unwrap_or_else(|error| panic!("{error}"));
            doubt(&Striker {
                material,
                mass_kg,
                tip_radius_m,
                length_m: None,
                shape: None,
            })
        };
        // a ball of 1.2 mm, its radius in mm taken for m, its diameter for the radius
        let ball_kg = 5.65e-5;
        assert_eq!(doubt(1.2e-3, ball_kg), None);
        let metres = doubt(1.2, ball_kg).unwrap_or_default();
        assert!(
            metres.contains("1.2000e0 m") && metres.contains("1.0e9 times"),
            "{metres}"
        );
        let diameter = doubt(2.4e-3, ball_kg).unwrap_or_default();
        assert!(
            diameter.contains("half of tip_radius_m = 2.4000e-3"),
            "{diameter}"
        );
        // a rod with a round end
        assert_eq!(doubt(4e-3, 0.0122), None);
    }
}
