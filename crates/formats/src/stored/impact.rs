//! Reads the results of a scene back.

use super::open::{FileKind, Stored};
use crate::error::SceneError;
use crate::quantities::Described;
use crate::scene::bodies_of;
use crate::scene::section::{as_number, parse};
use crate::schema::results::{
    ENERGIES, ENERGY, ERROR_SUFFIX, MAP, MAP_SCALES, OUTPUTS, PEAK_SUFFIXES, PLACES, PROBES, SCENE,
    SENSORS, SERIES, WARNINGS,
};
use contact::{Choice, HalfSpace};
use impact::{EnergySeries, Measured, Series, Strike, StrikerSeries};
use std::path::Path;
use toml::{Table, Value};

/// An open results file with its time series; probes and section are read on request.
#[derive(Debug, Clone)]
pub struct StoredImpact {
    pub(crate) stored: Stored,
    /// Contact model.
    pub model: String,
    /// Static share: `full` or `dynamic`.
    pub static_share: String,
    /// The half-space.
    pub target: HalfSpace,
    /// The striker; none for a prescribed force.
    pub strike: Option<Strike>,
    /// The resolved scene.
    scene: Table,
    /// Time series.
    pub series: Series,
}

impl StoredImpact {
    /// Opens a results file.
    ///
    /// # Errors
    /// [`SceneError`], which contains the actual kind of the file.
    pub fn open(path: &Path) -> Result<Self, SceneError> {
        let stored = Stored::open(path, FileKind::Impact)?;
        let unread = |error| stored.damaged(format!("its scene cannot be read: {error}"));
        let scene = parse(&stored.text(SCENE)?).map_err(unread)?;
        let (target, strike) = bodies_of(&scene).map_err(unread)?;
        let time_s = stored.vector(SERIES[0].0)?;
        if time_s.len() < 2 {
            return Err(stored.damaged("it has fewer than 2 samples"));
        }
        let column = |i: usize| stored.numbers(SERIES[i].0, &[time_s.len()]);
        let striker = match stored.dataset(SERIES[2].0) {
            Some(_) => Some(StrikerSeries {
                displacement_m: column(2)?,
                velocity_m_s: column(3)?,
            }),
            None => None,
        };
        let series = Series {
            force_n: column(1)?,
            deflection_m: column(4)?,
            striker,
            energy: energy_of(&stored, time_s.len())?,
            time_s,
        };
        let (model, static_share) = (stored.text("model")?, stored.text("static_share")?);
        // every results file has this attribute
        stored.text(WARNINGS)?;
        Ok(Self {
            model,
            static_share,
            target,
            strike,
            scene,
            series,
            stored,
        })
    }

    /// Path of the file.
    pub fn path(&self) -> &Path {
        &self.stored.path
    }

    /// A scalar result by its name, if the file has it.
    pub fn number(&self, name: &str) -> Option<f64> {
        self.stored.number(name)
    }

    /// All keys of the scene with their values, such as `striker.velocity_m_s` and `2.5`, in alphabetical order: words,
    /// and numbers in the units of their keys.
    ///
    /// Lists are left out: the probes and the points of a section.
    pub fn keys(&self) -> Vec<(String, Value)> {
        let mut found = Vec::new();
        for (section, keys) in &self.scene {
            for (key, value) in keys.as_table().into_iter().flatten() {
                let value = match value {
                    Value::String(_) => Some(value.clone()),
                    _ => as_number(value).map(Value::Float),
                };
                found.extend(value.map(|value| (format!("{section}.{key}"), value)));
            }
        }
        found
    }

    /// The probes; none for a scene without probes.
    ///
    /// # Errors
    /// [`SceneError`] for a damaged file.
    pub fn probes(&self) -> Result<Option<StoredProbes>, SceneError> {
        let stored = self.stored.clone();
        if stored.group(PROBES).is_none() {
            return Ok(None);
        }
        let path = |name: &str| format!("{PROBES}/{name}");
        let r_m = stored.vector(&path(PLACES[0].0))?;
        let z_m = stored.numbers(&path(PLACES[1].0), &[r_m.len()])?;
        Ok(Some(StoredProbes {
            samples: self.series.time_s.len(),
            r_m,
            z_m,
            stored,
        }))
    }

    /// The sensors with their histories; empty for a scene without sensors.
    ///
    /// # Errors
    /// [`SceneError`] for a damaged file.
    pub fn sensors(&self) -> Result<Vec<StoredSensor>, SceneError> {
        let listed = self.scene.get("sensor").and_then(Value::as_array);
        let tables: Vec<&Table> = listed
            .into_iter()
            .flatten()
            .filter_map(Value::as_table)
            .collect();
        let shape = [tables.len(), self.series.time_s.len()];
        let damaged = || {
            self.stored
                .damaged("its sensors are not those of its scene")
        };
        let of = |(i, table): (usize, &&Table)| {
            let number = |key: &str| table.get(key).and_then(as_number).ok_or_else(damaged);
            let word = |table: &Table, key: &str| table.get(key)?.as_str().map(str::to_owned);
            let quantity = word(table, "quantity").ok_or_else(damaged)?;
            let measured = Measured::named(&quantity).ok_or_else(damaged)?;
            let response = table.get("response").and_then(Value::as_table);
            let samples = |name: &str| {
                self.stored
                    .some(&format!("{SENSORS}/{name}"), &shape, i..i + 1)
            };
            Ok(StoredSensor {
                r_m: number("r_m")?,
                z_m: number("z_m")?,
                face_radius_m: number("face_radius_m")?,
                unit: response
                    .and_then(|own| word(own, "unit"))
                    .unwrap_or_else(|| measured.unit().to_owned()),
                quantity,
                has_response: response.is_some(),
                output: samples(OUTPUTS[2].0)?,
                output_error: samples(OUTPUTS[3].0)?,
            })
        };
        tables.iter().enumerate().map(of).collect()
    }

    /// The section; none for a scene without a section.
    ///
    /// # Errors
    /// [`SceneError`] for a damaged file.
    pub fn section(&self) -> Result<Option<StoredSection>, SceneError> {
        let stored = self.stored.clone();
        if stored.group(MAP).is_none() {
            return Ok(None);
        }
        let scale = |i: usize| stored.vector(&format!("{MAP}/{}", MAP_SCALES[i].0));
        let (time_s, z_m, r_m) = (scale(0)?, scale(1)?, scale(2)?);
        let rising = |x: &[f64]| x.windows(2).all(|pair| pair[0] < pair[1]);
        let falling = z_m.windows(2).all(|pair| pair[0] > pair[1]);
        if !rising(&time_s) || !rising(&r_m) || !falling || r_m.len() < 2 || z_m.len() < 2 {
            return Err(stored.damaged("the axes of its section are not in order"));
        }
        Ok(Some(StoredSection {
            stored,
            r_m,
            z_m,
            time_s,
        }))
    }
}

/// The energy over time; none in files of older versions.
fn energy_of(stored: &Stored, samples: usize) -> Result<Option<EnergySeries>, SceneError> {
    if stored.group(ENERGY).is_none() {
        return Ok(None);
    }
    let path = |i: usize| format!("{ENERGY}/{}", ENERGIES[i].0);
    let column = |i: usize| stored.numbers(&path(i), &[samples]);
    let existing = |i: usize| stored.dataset(&path(i)).map(|_| column(i)).transpose();
    Ok(Some(EnergySeries {
        kinetic_j: existing(0)?,
        work_j: existing(1)?,
        stored_j: column(2)?,
        radiated_j: column(3)?,
        plastic_j: existing(4)?,
    }))
}

/// A sensor of a results file with its output at the times of the results.
#[derive(Debug, Clone)]
pub struct StoredSensor {
    /// Distance of its centre from the axis in m.
    pub r_m: f64,
    /// Depth in m.
    pub z_m: f64,
    /// Radius of its face in m.
    pub face_radius_m: f64,
    /// Measured quantity.
    pub quantity: String,
    /// Whether it has a response.
    pub has_response: bool,
    /// Unit of the output.
    pub unit: String,
    /// Output.
    pub output: Vec<f64>,
    /// Estimated error of each sample.
    pub output_error: Vec<f64>,
}

/// Positions of the probes of a results file; traces are read on request.
#[derive(Debug, Clone)]
pub struct StoredProbes {
    stored: Stored,
    samples: usize,
    /// Distances from the axis in m.
    pub r_m: Vec<f64>,
    /// Depths in m.
    pub z_m: Vec<f64>,
}

impl StoredProbes {
    /// The stored histories at the probes.
    pub fn quantities(&self) -> Vec<Described> {
        self.stored
            .quantities(PROBES, &[self.r_m.len(), self.samples])
    }

    /// A quantity over time at a probe, at the times of the results.
    ///
    /// # Errors
    /// [`SceneError`] for a quantity that the file does not have.
    pub fn trace(&self, quantity: &str, probe: usize) -> Result<Vec<f64>, SceneError> {
        let path = format!("{PROBES}/{quantity}");
        let (shape, end) = ([self.r_m.len(), self.samples], probe.saturating_add(1));
        self.stored.some(&path, &shape, probe..end)
    }

    /// The estimated error of a quantity at a probe, if the file has it.
    pub fn error(&self, quantity: &str, probe: usize) -> Option<f64> {
        let path = format!("{PROBES}/{quantity}{ERROR_SUFFIX}");
        let errors = self.stored.numbers(&path, &[self.r_m.len()]).ok()?;
        errors.get(probe).copied()
    }
}

/// The section of a results file: grid and times; frames are read on request.
///
/// A frame runs over depths, the deepest first, and within a depth over the distances from the axis.
#[derive(Debug, Clone)]
pub struct StoredSection {
    stored: Stored,
    /// Distances from the axis in m, ascending.
    pub r_m: Vec<f64>,
    /// Depths in m, descending.
    pub z_m: Vec<f64>,
    /// Times of the frames in s.
    pub time_s: Vec<f64>,
}

impl StoredSection {
    /// The stored quantities of a frame.
    pub fn quantities(&self) -> Vec<Described> {
        self.stored.quantities(MAP, &self.shape())
    }

    /// A quantity in a frame.
    ///
    /// # Errors
    /// [`SceneError`] for a quantity or a frame that the file does not have.
    pub fn frame(&self, quantity: &str, frame: usize) -> Result<Vec<f32>, SceneError> {
        if frame >= self.time_s.len() {
            let what = format!("frame {frame} is outside [0, {}]", self.time_s.len() - 1);
            return Err(self.stored.damaged(what));
        }
        let path = format!("{MAP}/{quantity}");
        self.stored.some(&path, &self.shape(), frame..frame + 1)
    }

    /// The largest value of a quantity over all samples at each point, if the file has it.
    pub fn peak(&self, quantity: &str) -> Option<Vec<f64>> {
        let path = format!("{MAP}/{quantity}{}", PEAK_SUFFIXES[0]);
        let [_, z, r] = self.shape();
        self.stored.numbers(&path, &[z, r]).ok()
    }

    fn shape(&self) -> [usize; 3] {
        [self.time_s.len(), self.z_m.len(), self.r_m.len()]
    }
}
