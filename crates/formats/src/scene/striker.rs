//! The section `[striker]`: a mass with a tip, a ball or a rod, and its velocity.

use super::body::body;
use super::section::Section;
use crate::error::SceneError;
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

pub(super) fn read_strike(section: &Section<'_>, library: &Library) -> Result<Strike, SceneError> {
    section.allow_keys_of("striker")?;
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
        mass_kg: section.needed("mass_kg")?,
        tip_radius_m: section.needed("tip_radius_m")?,
        length_m: section.number("length_m")?,
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
    let diameter_m = section.needed("diameter_m")?;
    let shape = match form {
        Form::Ball => Shape::Ball { diameter_m },
        Form::Rod => Shape::Rod {
            length_m: section.needed("length_m")?,
            diameter_m,
            tip_radius_m: section.number("tip_radius_m")?,
        },
    };
    let hint = "the mass of a shape follows from its density";
    Striker::of_shape(body(section, library)?, shape).map_err(|error| match error {
        BodyError::NoDensity { .. } => section.missing("density_kg_m3", hint),
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
    match section.number("drop_height_m")? {
        None => section.needed("velocity_m_s"),
        Some(_) if section.value("velocity_m_s").is_some() => Err(SceneError::Superfluous {
            key: section.key("velocity_m_s"),
            beside: section.key("drop_height_m"),
            reason: "the velocity follows from the height of the fall",
        }),
        Some(height_m) => Ok(fall_velocity_m_s(height_m)),
    }
}
