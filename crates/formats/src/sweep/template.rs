//! The scene of a row: parsed once for all rows that differ in plain numbers only.

use super::axes::{SweepAxis, SweptKey, Values};
use super::spec::{Spec, word};
use crate::error::SceneError;
use crate::scene::keys::{Range, Set, keys_of};
use crate::scene::{Form, scene_with};
use contact::{Choice, Collision, Settings};
use impact::Scene;
use std::collections::BTreeSet;
use toml::Value;

/// A column of plain numbers, which are set in a scene that was parsed with a placeholder.
#[derive(Debug)]
struct Fast<'a> {
    /// Rows between consecutive numbers.
    stride: usize,
    column: &'a SweptKey,
    range: Range,
    stand_in: f64,
    set: Set,
}

/// Parsed scenes of a sweep.
#[derive(Debug)]
pub(crate) struct Templates<'a> {
    spec: &'a Spec,
    fast: Vec<Fast<'a>>,
    /// Axes with a column that requires parsing, with their strides.
    slow: Vec<(usize, &'a SweepAxis)>,
    /// The parsed templates, if there are not too many.
    ready: Vec<Result<Scene, SceneError>>,
}

/// Template and scene of a thread's previous row, which the next row usually shares.
pub(crate) type Memory = Option<(usize, Result<Scene, SceneError>)>;

/// Largest number of templates that are parsed ahead.
const READY: usize = 4096;

impl<'a> Templates<'a> {
    /// Parses the first template, so that a misspelt key is an error of the sweep and not of each row.
    pub(crate) fn new(spec: &'a Spec) -> Result<Self, SceneError> {
        let (mut fast, mut slow) = (Vec::new(), Vec::new());
        for (stride, axis) in spec.strides() {
            let before = fast.len();
            let columns = axis.columns.iter();
            fast.extend(columns.filter_map(|column| as_numbers(spec, stride, column)));
            if fast.len() - before < axis.columns.len() {
                slow.push((stride, axis));
            }
        }
        let mut templates = Self {
            spec,
            fast,
            slow,
            ready: Vec::new(),
        };
        match templates.parse(0) {
            Ok(scene) => contact_only(&scene, spec.kernels.is_some())?,
            // a row that fails
            Err(error) if error.is_of_numbers() => {}
            Err(error) => return Err(error),
        }
        templates.check_words()?;
        let mut lengths = templates.slow.iter().map(|(_, axis)| axis.len);
        let count = lengths.try_fold(1_usize, usize::checked_mul);
        if let Some(count) = count.filter(|&n| n <= READY) {
            let parsed = (0..count).map(|id| templates.parse(templates.first_row(id)));
            templates.ready = parsed.collect();
        }
        Ok(templates)
    }

    /// Rejects unknown words in lists, which would otherwise make rows fail, perhaps after hours.
    fn check_words(&self) -> Result<(), SceneError> {
        for (stride, axis) in self.spec.strides() {
            let columns = axis.columns.iter().map(|column| &column.values);
            let lists: Vec<_> = columns.filter_map(Values::texts).collect();
            let mut known = BTreeSet::new();
            let rows = if lists.is_empty() { 0 } else { axis.len };
            for i in 0..rows {
                let words: Vec<&str> = lists.iter().map(|texts| texts[i].as_str()).collect();
                if known.insert(words)
                    && let Err(error) = self.parse(i * stride)
                    && error.is_of_words()
                {
                    return Err(error);
                }
            }
        }
        Ok(())
    }

    /// The contact of a row.
    pub(crate) fn contact(
        &self,
        row: usize,
        memory: &mut Memory,
    ) -> Result<(Collision, Settings), SceneError> {
        let scene = self.scene(row, memory)?;
        let strike = scene.strike().ok_or_else(|| contacts_only("[force]"))?;
        let collision = Collision::new(&scene.target, &strike.striker, strike.velocity_m_s);
        Ok((collision, scene.settings))
    }

    /// The scene of a row.
    pub(crate) fn scene<'m>(
        &self,
        row: usize,
        memory: &'m mut Memory,
    ) -> Result<&'m Scene, SceneError> {
        let id = self.slow.iter().fold(0_usize, |id, (stride, axis)| {
            let place = row / stride % axis.len;
            id.wrapping_mul(axis.len).wrapping_add(place)
        });
        let template = || match self.ready.get(id) {
            Some(template) => template.clone(),
            None => self.parse(row),
        };
        if memory.as_ref().is_none_or(|(known, _)| *known != id) {
            *memory = None;
        }
        let (_, scene) = memory.get_or_insert_with(|| (id, template()));
        let scene = scene.as_mut().map_err(|error| error.clone())?;
        for fast in &self.fast {
            let values = &fast.column.values;
            let number = values.number(row / fast.stride % values.count());
            fast.set(scene, number.unwrap_or(f64::NAN))?;
        }
        Ok(scene)
    }

    /// The first row of a template.
    fn first_row(&self, id: usize) -> usize {
        let mut rest = id;
        let slow = self.slow.iter().rev().map(|(stride, axis)| {
            let place = rest % axis.len;
            rest /= axis.len;
            place * stride
        });
        slow.sum()
    }

    fn parse(&self, row: usize) -> Result<Scene, SceneError> {
        let mut table = self.spec.scene.clone();
        for (stride, axis) in self.spec.strides() {
            for column in &axis.columns {
                let is_of = |fast: &&Fast<'_>| std::ptr::eq(fast.column, column);
                let value = match self.fast.iter().find(is_of) {
                    Some(fast) => Value::Float(fast.stand_in),
                    None => column.values.get(row / stride % axis.len.max(1)),
                };
                column.put(&mut table, value)?;
            }
        }
        let library = self.spec.library(&table);
        scene_with(&table, &self.spec.directory, library)
    }
}

/// Checks that a scene of a sweep has a contact only, and probes only if their kernels are known.
fn contact_only(scene: &Scene, observed: bool) -> Result<(), SceneError> {
    let sections = [
        ("[force]", scene.record().is_some()),
        ("[[probe]]", !scene.probes.is_empty() && !observed),
        ("[[sensor]]", !scene.sensors.is_empty()),
        ("[map]", scene.section.is_some()),
    ];
    if scene.target.echoing().is_some() && scene.probes.is_empty() {
        return Err(SceneError::conflict(
            "a sweep without probes",
            "the echoes of a plate".to_owned(),
            "its contacts are those of a half-space: remove echoes (until_s), or add a [[probe]]",
        ));
    }
    let found = sections.into_iter().find(|(_, is_there)| *is_there);
    found.map_or(Ok(()), |(name, _)| Err(contacts_only(name)))
}

fn contacts_only(found: &str) -> SceneError {
    SceneError::conflict(
        "a sweep",
        found.to_owned(),
        "a sweep computes contacts only: remove this section from its scene",
    )
}

/// The column as plain numbers, if its key can be set directly.
fn as_numbers<'a>(spec: &'a Spec, stride: usize, column: &'a SweptKey) -> Option<Fast<'a>> {
    let key = keys_of(&column.section).find(|key| key.name == column.key)?;
    let (set, stand_in, range) = (key.set?, key.stand_in?, key.range?);
    let needs_ball = matches!(set, Set::Ball(_)) && column.section == "striker";
    if matches!(column.values, Values::Texts(_)) || needs_ball && !always_ball(spec) {
        return None;
    }
    // wave speeds are compared with the moduli only when a scene is read
    let speed = |key: &str| key.ends_with("_speed_m_s");
    let section = spec.scene.get(&column.section).and_then(Value::as_table);
    let in_scene = section.is_some_and(|section| section.keys().any(|key| speed(key)));
    let varies = (spec.columns()).any(|other| other.section == column.section && speed(&other.key));
    (!in_scene && !varies).then_some(Fast {
        stride,
        column,
        range,
        stand_in,
        set,
    })
}

/// Whether the striker of every row is a ball.
fn always_ball(spec: &Spec) -> bool {
    let mut columns = spec.columns();
    word(&spec.scene, "striker", "shape") == Some(Form::Ball.name())
        && columns.all(|column| column.name() != "striker.shape")
}

impl Fast<'_> {
    fn set(&self, scene: &mut Scene, value: f64) -> Result<(), SceneError> {
        let range = if !(self.range.holds)(value) {
            self.range.name
        } else if !self.set.apply(scene, &self.column.section, value) {
            "the range with a valid mass of the ball"
        } else {
            return Ok(());
        };
        Err(SceneError::out_of_range(self.column.name(), value, range))
    }
}
