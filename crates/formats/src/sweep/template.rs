//! From a row's place to its scene: parsed once for all rows that differ in plain numbers only.

use super::axis::{Column, Values};
use super::spec::Spec;
use crate::error::SceneError;
use crate::scene::Form;
use crate::scene::scene_with;
use crate::section::{POISSON, POSITIVE, Range, TOLERANCE};
use contact::{Choice, HalfSpace, Settings, Shape, Striker, fall_velocity_m_s};
use impact::{Load, Scene, Strike};
use std::collections::BTreeSet;
use toml::Value;

/// A key that is a plain number of a parsed scene.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Plain {
    Velocity,
    DropHeight,
    Mass,
    TipRadius,
    BallDiameter,
    BallDensity,
    DiscRadius,
    Tolerance,
    LossTolerance,
    StrikerModulus,
    StrikerRatio,
    TargetModulus,
    TargetRatio,
    TargetDensity,
}

const PLAIN: [(&str, Plain, Range, f64); 14] = [
    ("striker.velocity_m_s", Plain::Velocity, POSITIVE, 1.0),
    ("striker.drop_height_m", Plain::DropHeight, POSITIVE, 1.0),
    ("striker.mass_kg", Plain::Mass, POSITIVE, 1.0),
    ("striker.tip_radius_m", Plain::TipRadius, POSITIVE, 1.0),
    ("striker.diameter_m", Plain::BallDiameter, POSITIVE, 1.0),
    ("striker.density_kg_m3", Plain::BallDensity, POSITIVE, 1.0),
    ("contact.disc_radius_m", Plain::DiscRadius, POSITIVE, 1.0),
    ("contact.tolerance", Plain::Tolerance, TOLERANCE, 1e-4),
    (
        "contact.loss_tolerance",
        Plain::LossTolerance,
        TOLERANCE,
        1e-3,
    ),
    (
        "striker.youngs_modulus_pa",
        Plain::StrikerModulus,
        POSITIVE,
        1.0,
    ),
    ("striker.poisson_ratio", Plain::StrikerRatio, POISSON, 0.25),
    (
        "target.youngs_modulus_pa",
        Plain::TargetModulus,
        POSITIVE,
        1.0,
    ),
    ("target.poisson_ratio", Plain::TargetRatio, POISSON, 0.25),
    ("target.density_kg_m3", Plain::TargetDensity, POSITIVE, 1.0),
];

/// A column of plain numbers: its axis, what it is, its values.
#[derive(Debug)]
struct Fast<'a> {
    axis: usize,
    plain: Plain,
    range: Range,
    name: String,
    values: &'a Values,
}

/// Parsed scenes of a sweep.
#[derive(Debug)]
pub(crate) struct Templates<'a> {
    spec: &'a Spec,
    fast: Vec<Fast<'a>>,
    /// Axes with a column that needs parsing.
    slow: Vec<usize>,
    /// The templates where there are not too many of them.
    ready: Vec<Result<Scene, SceneError>>,
}

/// The scene of the row before, which the next one likely shares.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    id: Option<usize>,
    scene: Option<Result<Scene, SceneError>>,
}

/// What a row is computed from.
pub(crate) type Row<'s> = (&'s HalfSpace, &'s Strike, &'s Settings);

/// Templates that are parsed ahead.
const READY: usize = 4096;

impl<'a> Templates<'a> {
    /// Parses the first template, so that a misspelt key is an error of the sweep and not of each row.
    pub(crate) fn new(spec: &'a Spec) -> Result<Self, SceneError> {
        let mut templates = Self {
            spec,
            fast: Vec::new(),
            slow: Vec::new(),
            ready: Vec::new(),
        };
        for (index, axis) in spec.axes.iter().enumerate() {
            let mut slow = false;
            for column in &axis.columns {
                match fast(spec, index, column) {
                    Some(found) => templates.fast.push(found),
                    None => slow = true,
                }
            }
            if slow {
                templates.slow.push(index);
            }
        }
        let origin = vec![0; spec.axes.len()];
        match templates.parse(&origin) {
            Ok(scene) => contact_only(&scene, spec.kernels.is_some())?,
            Err(
                error @ (SceneError::OutOfRange { .. }
                | SceneError::Inconsistent { .. }
                | SceneError::Conflict { .. }),
            ) => drop(error),
            Err(error) => return Err(error),
        }
        templates.check_words()?;
        let count = templates
            .slow
            .iter()
            .try_fold(1_usize, |n, &axis| n.checked_mul(spec.axes[axis].len))
            .filter(|&n| n <= READY);
        if let Some(count) = count {
            templates.ready = (0..count)
                .map(|id| templates.parse(&templates.place(id)))
                .collect();
        }
        Ok(templates)
    }

    /// Refuses a word of any list that is not known: it would be a row that fails, after hours perhaps.
    fn check_words(&self) -> Result<(), SceneError> {
        for (index, axis) in self.spec.axes.iter().enumerate() {
            let lists = axis
                .columns
                .iter()
                .filter_map(|column| match &column.values {
                    Values::Texts(texts) => Some(texts),
                    Values::Numbers(_) | Values::Drawn(_) => None,
                });
            let lists: Vec<_> = lists.collect();
            let mut known = BTreeSet::new();
            let rows = if lists.is_empty() { 0 } else { axis.len };
            for i in 0..rows {
                let words: Vec<&str> = lists.iter().map(|texts| texts[i].as_str()).collect();
                if !known.insert(words) {
                    continue;
                }
                let mut place = vec![0; self.spec.axes.len()];
                place[index] = i;
                let parsed = self.parse(&place);
                if let Err(
                    error @ (SceneError::UnknownMaterial { .. }
                    | SceneError::UnknownChoice { .. }
                    | SceneError::WrongKind { .. }),
                ) = parsed
                {
                    return Err(error);
                }
            }
        }
        Ok(())
    }

    /// The bodies and settings of a row at a place along all axes.
    pub(crate) fn contact<'s>(
        &self,
        place: &[usize],
        scratch: &'s mut Scratch,
    ) -> Result<Row<'s>, SceneError> {
        let scene = self.scene(place, scratch)?;
        match &scene.load {
            Load::Strike(strike) => Ok((&scene.target, strike, &scene.settings)),
            Load::Record(_) => Err(contacts_only("[force]")),
        }
    }

    /// The scene of a row at a place along all axes.
    pub(crate) fn scene<'s>(
        &self,
        place: &[usize],
        scratch: &'s mut Scratch,
    ) -> Result<&'s Scene, SceneError> {
        let id = self.slow.iter().fold(0_usize, |id, &axis| {
            id.wrapping_mul(self.spec.axes[axis].len)
                .wrapping_add(place[axis])
        });
        if scratch.id != Some(id) {
            scratch.scene = Some(match self.ready.get(id) {
                Some(template) => template.clone(),
                None => self.parse(place),
            });
            scratch.id = Some(id);
        }
        let scene = match &mut scratch.scene {
            Some(Ok(scene)) => scene,
            Some(Err(error)) => return Err(error.clone()),
            None => unreachable!("it was just put there"),
        };
        for fast in &self.fast {
            let number = fast.values.number(place[fast.axis]);
            fast.set(scene, number.unwrap_or(f64::NAN))?;
        }
        Ok(scene)
    }

    /// The place along all axes of a template; zero along the fast ones.
    fn place(&self, id: usize) -> Vec<usize> {
        let mut place = vec![0; self.spec.axes.len()];
        let mut rest = id;
        for &axis in self.slow.iter().rev() {
            let len = self.spec.axes[axis].len;
            place[axis] = rest % len;
            rest /= len;
        }
        place
    }

    fn parse(&self, place: &[usize]) -> Result<Scene, SceneError> {
        let mut table = self.spec.scene.clone();
        for (axis, &index) in self.spec.axes.iter().zip(place) {
            for column in &axis.columns {
                let name = column.name();
                let plain = self.fast.iter().any(|f| f.name == name);
                let value = match PLAIN.iter().find(|p| p.0 == name) {
                    Some((_, _, _, stand_in)) if plain => Value::Float(*stand_in),
                    Some(_) | None => column.values.get(index),
                };
                column.put(&mut table, value)?;
            }
        }
        scene_with(
            &table,
            &self.spec.directory,
            self.spec.files.library(&table),
        )
    }
}

/// A sweep is about contacts, and what probes see of them where their kernels are known.
fn contact_only(scene: &Scene, observed: bool) -> Result<(), SceneError> {
    let found = if matches!(scene.load, Load::Record(_)) {
        "[force]"
    } else if !scene.probes.is_empty() && !observed {
        "[[probe]]"
    } else if scene.section.is_some() {
        "[map]"
    } else {
        return Ok(());
    };
    Err(contacts_only(found))
}

fn contacts_only(found: &str) -> SceneError {
    SceneError::Conflict {
        first: "a sweep".to_owned(),
        second: found.to_owned(),
        reason: "it computes contacts only; leave this section out of its scene",
    }
}

/// The column as plain numbers, if that is what it is.
fn fast<'a>(spec: &'a Spec, axis: usize, column: &'a Column) -> Option<Fast<'a>> {
    let name = column.name();
    let &(_, plain, range, _) = PLAIN.iter().find(|p| p.0 == name)?;
    if matches!(column.values, Values::Texts(_)) {
        return None;
    }
    if matches!(plain, Plain::BallDiameter | Plain::BallDensity) && !always_ball(spec) {
        return None;
    }
    // wave speeds have to be compared with the moduli, which reading a scene does
    let speed = |key: &str| key.ends_with("_speed_m_s");
    let in_scene = match spec.scene.get(&column.section) {
        Some(Value::Table(section)) => section.keys().any(|key| speed(key)),
        Some(_) | None => false,
    };
    let varies = spec
        .axes
        .iter()
        .flat_map(|a| &a.columns)
        .any(|other| other.section == column.section && speed(&other.key));
    (!in_scene && !varies).then_some(Fast {
        axis,
        plain,
        range,
        name,
        values: &column.values,
    })
}

/// Whether the striker of every row is a ball.
fn always_ball(spec: &Spec) -> bool {
    let ball = match spec.scene.get("striker") {
        Some(Value::Table(striker)) => {
            striker.get("shape").and_then(Value::as_str) == Some(Form::Ball.name())
        }
        Some(_) | None => false,
    };
    let mut columns = spec.axes.iter().flat_map(|axis| &axis.columns);
    ball && columns.all(|column| column.name() != "striker.shape")
}

impl Fast<'_> {
    fn set(&self, scene: &mut Scene, value: f64) -> Result<(), SceneError> {
        if !(self.range.holds)(value) {
            return Err(SceneError::OutOfRange {
                key: self.name.clone(),
                value,
                range: self.range.name,
            });
        }
        let settings = &mut scene.settings;
        match (self.plain, &mut scene.load) {
            (Plain::DiscRadius, _) => settings.disc_radius_m = Some(value),
            (Plain::LossTolerance, _) => settings.loss_tolerance = Some(value),
            (Plain::Tolerance, _) => settings.tolerance = value,
            (Plain::TargetDensity | Plain::TargetModulus | Plain::TargetRatio, _) => {
                self.of_target(&mut scene.target, value);
            }
            (_, Load::Strike(strike)) => return self.of_strike(strike, value),
            // the first template was checked for a striker
            (_, Load::Record(_)) => {}
        }
        Ok(())
    }

    fn of_strike(&self, strike: &mut Strike, value: f64) -> Result<(), SceneError> {
        let striker = &mut strike.striker;
        match self.plain {
            Plain::Velocity => strike.velocity_m_s = value,
            Plain::DropHeight => strike.velocity_m_s = fall_velocity_m_s(value),
            Plain::Mass => striker.mass_kg = value,
            Plain::TipRadius => striker.tip_radius_m = value,
            Plain::StrikerModulus => striker.material.youngs_modulus_pa = value,
            Plain::StrikerRatio => striker.material.poisson_ratio = value,
            Plain::BallDiameter | Plain::BallDensity => return self.reshape(striker, value),
            Plain::DiscRadius
            | Plain::Tolerance
            | Plain::LossTolerance
            | Plain::TargetModulus
            | Plain::TargetRatio
            | Plain::TargetDensity => {}
        }
        Ok(())
    }

    /// A ball of another diameter or density: its mass follows.
    fn reshape(&self, striker: &mut Striker, value: f64) -> Result<(), SceneError> {
        let changed = striker.change_shape(|material, shape| match (self.plain, shape) {
            (Plain::BallDiameter, Some(Shape::Ball { diameter_m })) => *diameter_m = value,
            (_, _) => material.density_kg_m3 = Some(value),
        });
        changed.map_err(|_| SceneError::OutOfRange {
            key: self.name.clone(),
            value,
            range: "what makes a mass of the ball",
        })
    }

    /// The range has been checked, so that the change is a half-space again.
    fn of_target(&self, target: &mut HalfSpace, value: f64) {
        let changed = target.change(|material| match self.plain {
            Plain::TargetModulus => material.youngs_modulus_pa = value,
            Plain::TargetRatio => material.poisson_ratio = value,
            Plain::TargetDensity
            | Plain::Velocity
            | Plain::DropHeight
            | Plain::Mass
            | Plain::TipRadius
            | Plain::BallDiameter
            | Plain::BallDensity
            | Plain::DiscRadius
            | Plain::Tolerance
            | Plain::LossTolerance
            | Plain::StrikerModulus
            | Plain::StrikerRatio => material.density_kg_m3 = Some(value),
        });
        debug_assert!(changed.is_ok());
    }
}
