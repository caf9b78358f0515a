//! The section `[striker]`: a mass with a tip, a ball or a rod, and its velocity.

use crate::body::{body, with_elastic};
use crate::error::SceneError;
use crate::section::{POSITIVE, Section};
use contact::{BodyError, Choice, Library, Shape, Striker, fall_velocity_m_s};
use impact::Strike;

/// What a striker is said to be, where mass and tip follow from it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Form {
    Ball,
    Rod,
}

impl Choice for Form {
    const ALL: &'static [Self] = &[Self::Ball, Self::Rod];

    fn name(self) -> &'static str {
        match self {
            Self::Ball => "ball",
            Self::Rod => "rod",
        }
    }
}

/// All keys of the section but the elastic ones.
pub(super) const KEYS: [&str; 8] = [
    "material",
    "shape",
    "diameter_m",
    "length_m",
    "mass_kg",
    "tip_radius_m",
    "velocity_m_s",
    "drop_height_m",
];

pub(crate) fn read_strike(section: &Section<'_>, library: &Library) -> Result<Strike, SceneError> {
    section.allow(&with_elastic(&KEYS))?;
    let striker = match section.choice("shape")? {
        None => plain(section, library)?,
        Some(form) => of_form(section, library, form)?,
    };
    Ok(Strike {
        striker,
        velocity_m_s: velocity(section)?,
    })
}

/// A mass with a tip.
fn plain(section: &Section<'_>, library: &Library) -> Result<Striker, SceneError> {
    if section.value("diameter_m").is_some() {
        return Err(section.missing("shape", "say whose diameter_m it is: \"ball\" or \"rod\""));
    }
    Ok(Striker {
        material: body(section, library)?,
        mass_kg: section.required(
            "mass_kg",
            POSITIVE,
            "the mass of the striker; or shape = \"ball\" with diameter_m",
        )?,
        tip_radius_m: section.required(
            "tip_radius_m",
            POSITIVE,
            "the radius of the striker's tip",
        )?,
        length_m: section.number("length_m", POSITIVE)?,
        shape: None,
    })
}

/// A body whose mass follows from lengths and a density.
fn of_form(section: &Section<'_>, library: &Library, form: Form) -> Result<Striker, SceneError> {
    let (superfluous, reason): (&[&str], _) = match form {
        Form::Ball => (
            &["mass_kg", "tip_radius_m", "length_m"],
            "mass and tip of a ball follow from diameter_m and the density",
        ),
        Form::Rod => (
            &["mass_kg"],
            "the mass of a rod follows from length_m, diameter_m, tip_radius_m and the density",
        ),
    };
    if let Some(key) = superfluous.iter().find(|key| section.value(key).is_some()) {
        return Err(SceneError::Superfluous {
            key: section.key(key),
            beside: format!("shape = \"{}\"", form.name()),
            reason,
        });
    }
    let diameter_m = section.required("diameter_m", POSITIVE, "the diameter of the striker")?;
    let shape = match form {
        Form::Ball => Shape::Ball { diameter_m },
        Form::Rod => Shape::Rod {
            length_m: section.required("length_m", POSITIVE, "the length of the rod")?,
            diameter_m,
            tip_radius_m: section.number("tip_radius_m", POSITIVE)?,
        },
    };
    Striker::of_shape(body(section, library)?, shape).map_err(|error| match error {
        BodyError::NoDensity { .. } => section.missing(
            "density_kg_m3",
            "the mass of a shape follows from its density",
        ),
        BodyError::OutOfRange {
            quantity,
            value,
            range,
        } => SceneError::OutOfRange {
            key: section.key(quantity),
            value,
            range,
        },
    })
}

/// Velocity of approach in m/s: as given, or after a fall.
fn velocity(section: &Section<'_>) -> Result<f64, SceneError> {
    match section.number("drop_height_m", POSITIVE)? {
        None => section.required(
            "velocity_m_s",
            POSITIVE,
            "the velocity of approach, or drop_height_m for a fall from rest",
        ),
        Some(_) if section.value("velocity_m_s").is_some() => Err(SceneError::Superfluous {
            key: section.key("velocity_m_s"),
            beside: section.key("drop_height_m"),
            reason: "the velocity follows from the height of the fall",
        }),
        Some(height_m) => Ok(fall_velocity_m_s(height_m)),
    }
}
