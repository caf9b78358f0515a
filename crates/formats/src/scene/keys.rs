//! The keys of a scene, each listed once: where it stands, what a number may be, what is told where it is missing, and how
//! a sweep sets it in a scene that is parsed already.

use contact::{Material, Settings, Shape, fall_velocity_m_s};
use impact::{Load, Scene, Strike};

/// A range of numbers.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Range {
    /// In interval notation.
    pub(crate) name: &'static str,
    pub(crate) holds: fn(f64) -> bool,
}

pub(crate) const POSITIVE: Range = Range {
    name: "(0, inf)",
    holds: |x| x > 0.0 && x < f64::INFINITY,
};
pub(crate) const FINITE: Range = Range {
    name: "(-inf, inf)",
    holds: f64::is_finite,
};
pub(crate) const NOT_NEGATIVE: Range = Range {
    name: "[0, inf)",
    holds: |x| (0.0..f64::INFINITY).contains(&x),
};
pub(crate) const SIGN: Range = Range {
    name: "{-1, 1}",
    holds: |x| x == 1.0 || x == -1.0,
};
pub(crate) const POISSON: Range = Range {
    name: "(-1, 0.5)",
    holds: |x| x > -1.0 && x < 0.5,
};
pub(crate) const TOLERANCE: Range = Range {
    name: "[1e-9, 0.1]",
    holds: |x| (1e-9..=0.1).contains(&x),
};

/// A key of a scene.
#[derive(Debug)]
pub(crate) struct Key {
    /// Its section; `body` for both bodies.
    section: &'static str,
    pub(crate) name: &'static str,
    /// None for words, lists and flags.
    pub(crate) range: Option<Range>,
    /// What to give, where it is needed.
    pub(crate) hint: &'static str,
    /// A number that stands in for it while a scene is parsed, and how it is set afterwards.
    pub(crate) set: Option<(f64, Set)>,
}

/// Where a plain number goes.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Set {
    Settings(fn(&mut Settings, f64)),
    Strike(fn(&mut Strike, f64)),
    Body(fn(&mut Material, Option<&mut Shape>, f64)),
    /// The mass of a striker follows from it, and it is plain for a ball only.
    Ball(fn(&mut Material, Option<&mut Shape>, f64)),
}
use Set::{Ball, Body, Settings as Setting, Strike as Approach};

macro_rules! keys {
    ($($section:ident.$name:ident $(: $range:ident)? $(($hint:literal))? $([$stand_in:literal] $set:expr)?;)*) => {
        &[$(Key {
            section: stringify!($section),
            name: stringify!($name),
            range: keys!(@some $($range)?),
            hint: concat!("", $($hint)?),
            set: keys!(@some $(($stand_in, $set))?),
        },)*]
    };
    (@some) => { None };
    (@some $value:expr) => { Some($value) };
}

/// All of them, in the order in which messages list them: section, name, range, hint, stand-in, setter.
const KEYS: &[Key] = keys! {
    target.material;
    target.thickness_m: POSITIVE;
    target.radius_m: POSITIVE;
    striker.material;
    striker.shape;
    striker.diameter_m: POSITIVE ("the diameter of the striker") [1.0] Ball(|_, shape, x| {
        if let Some(Shape::Ball { diameter_m }) = shape {
            *diameter_m = x;
        }
    });
    striker.length_m: POSITIVE ("the length of the rod");
    striker.mass_kg: POSITIVE ("the mass of the striker; or shape = \"ball\" with diameter_m") [1.0] Approach(|s, x| s.striker.mass_kg = x);
    striker.tip_radius_m: POSITIVE ("the radius of the striker's tip") [1.0] Approach(|s, x| s.striker.tip_radius_m = x);
    striker.velocity_m_s: POSITIVE ("the velocity of approach, or drop_height_m for a fall from rest") [1.0] Approach(|s, x| s.velocity_m_s = x);
    striker.drop_height_m: POSITIVE [1.0] Approach(|s, x| s.velocity_m_s = fall_velocity_m_s(x));
    body.youngs_modulus_pa: POSITIVE [1.0] Body(|m, _, x| m.youngs_modulus_pa = x);
    body.poisson_ratio: POISSON [0.25] Body(|m, _, x| m.poisson_ratio = x);
    body.density_kg_m3: POSITIVE [1.0] Ball(|m, _, x| m.density_kg_m3 = Some(x));
    body.longitudinal_speed_m_s: POSITIVE;
    body.shear_speed_m_s: POSITIVE;
    body.yield_strength_pa: NOT_NEGATIVE;
    body.tensile_strength_pa: NOT_NEGATIVE;
    body.fracture_toughness_pa_sqrt_m: NOT_NEGATIVE;
    contact.disc_radius_m: POSITIVE [1.0] Setting(|s, x| s.disc_radius_m = Some(x));
    contact.model;
    contact.scheme;
    contact.static_share;
    contact.deflection;
    contact.tolerance: TOLERANCE [1e-4] Setting(|s, x| s.tolerance = x);
    contact.loss_tolerance: TOLERANCE [1e-3] Setting(|s, x| s.loss_tolerance = Some(x));
    contact.step_s: POSITIVE;
    contact.plasticity;
    contact.yield_pressure_pa: POSITIVE [1e9] Setting(|s, x| s.yield_pressure_pa = Some(x));
    force.file;
    force.columns;
    force.units;
    force.start_s: FINITE;
    force.end_s: FINITE;
    force.sign: SIGN;
    force.low_pass_hz: POSITIVE;
    force.baseline_s: POSITIVE;
    probe.r_m: NOT_NEGATIVE ("the distance from the axis");
    probe.z_m: NOT_NEGATIVE ("the depth below the surface");
    map.r_max_m: POSITIVE ("the width of the section");
    map.z_max_m: POSITIVE ("the depth of the section");
    map.points;
    map.frames;
    output.duration_s: POSITIVE;
    output.quantities;
    output.peaks;
    materials.file;
};

/// The sections, in the order in which messages list them.
pub(crate) const SECTIONS: [&str; 8] = [
    "target",
    "striker",
    "contact",
    "force",
    "probe",
    "map",
    "output",
    "materials",
];

/// The keys of a section; those of an elastic body follow the others.
pub(crate) fn keys_of(section: &str) -> impl Iterator<Item = &'static Key> {
    let bodies = ["target", "striker"].contains(&section);
    KEYS.iter()
        .filter(move |key| key.section == section || (bodies && key.section == "body"))
}

/// A key with its section, where one has a key of this name.
pub(super) fn full_name(name: &str) -> Option<String> {
    let key = number(name)?;
    let section = if key.section == "body" {
        "target"
    } else {
        key.section
    };
    Some(format!("{section}.{name}"))
}

/// A number of a scene; its name means the same in every section.
pub(super) fn number(name: &str) -> Option<&'static Key> {
    KEYS.iter().find(|key| key.name == name)
}

/// The sections of a contact that have a key of this name.
///
/// ```
/// use formats::scene::sections_of;
/// assert_eq!(sections_of("velocity_m_s"), ["striker"]);
/// assert_eq!(sections_of("poisson_ratio"), ["target", "striker"]);
/// ```
#[must_use]
pub fn sections_of(key: &str) -> Vec<&'static str> {
    let has = |section: &&str| keys_of(section).any(|known| known.name == key);
    SECTIONS[..3].iter().copied().filter(has).collect()
}

impl Set {
    /// Sets a number that is in its range; false where it makes no body.
    pub(crate) fn apply(self, scene: &mut Scene, section: &str, x: f64) -> bool {
        if let (Self::Body(set) | Self::Ball(set), "target") = (self, section) {
            return scene
                .target
                .change(|material| set(material, None, x))
                .is_ok();
        }
        match (self, &mut scene.load) {
            (Self::Settings(set), _) => set(&mut scene.settings, x),
            (Self::Strike(set), Load::Strike(strike)) => set(strike, x),
            (Self::Body(set), Load::Strike(strike)) => set(&mut strike.striker.material, None, x),
            (Self::Ball(set), Load::Strike(strike)) => {
                let changed =
                    (strike.striker).change_shape(|material, shape| set(material, shape, x));
                return changed.is_ok();
            }
            // the first template was checked for a striker
            (Self::Strike(_) | Self::Body(_) | Self::Ball(_), Load::Record(_)) => {}
        }
        true
    }
}
