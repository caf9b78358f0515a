//! The results of a scene, read back.

use super::error::ReadError;
use super::kind::FileKind;
use super::open::Stored;
use super::probes::StoredProbes;
use super::scene::StoredScene;
use super::section::StoredSection;
use crate::results::schema::{ENERGIES, ENERGY, MAP, PROBES, SCENE_SHA256, SERIES};
use impact::{EnergySeries, Series, StrikerSeries};
use std::path::Path;

/// Major version of the results that are read.
const MAJOR: &str = "1";

/// An open results file with its time series; probes and section are read when they are asked for.
#[derive(Debug, Clone)]
pub struct StoredImpact {
    stored: Stored,
    /// Contact model.
    pub model: String,
    /// Static share: `full` or `dynamic`.
    pub static_share: String,
    /// Warnings, one a line.
    pub warnings: String,
    /// The resolved scene.
    pub scene: StoredScene,
    /// Time series.
    pub series: Series,
}

impl StoredImpact {
    /// Opens a results file.
    ///
    /// # Errors
    /// [`ReadError`], which says what the file is instead.
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        let stored = Stored::open(path, FileKind::Impact, MAJOR)?;
        let scene = StoredScene::new(&stored.text("scene")?)
            .map_err(|error| stored.damaged(format!("its scene cannot be read: {error}")))?;
        let time_s = stored.vector(SERIES[0].0)?;
        if time_s.len() < 2 {
            return Err(stored.damaged("it has fewer than 2 samples"));
        }
        let column = |i: usize| stored.numbers(SERIES[i].0, &[time_s.len()]);
        let striker = match stored.shape(SERIES[2].0) {
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
        Ok(Self {
            model: stored.text("model")?,
            static_share: stored.text("static_share")?,
            warnings: stored.text("warnings")?,
            scene,
            series,
            stored,
        })
    }

    /// Where it lies.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.stored.path
    }

    /// Which scene it is of, whatever the kernels; nothing in files of versions before 1.7.
    #[must_use]
    pub fn scene_sha256(&self) -> Option<String> {
        self.stored.text(SCENE_SHA256).ok()
    }

    /// The kernels of its fields, `none` without any, and the id of their table, empty without one.
    ///
    /// # Errors
    /// [`ReadError::Damaged`].
    pub fn kernels(&self) -> Result<(String, String), ReadError> {
        Ok((self.stored.text("kernel")?, self.stored.text("table_id")?))
    }

    /// Fails where the fields were cut short.
    ///
    /// # Errors
    /// [`ReadError`].
    pub fn check_whole(&self) -> Result<(), ReadError> {
        let Some(probes) = self.probes()? else {
            return self.section().map(drop);
        };
        for quantity in probes.quantities() {
            for probe in 0..probes.r_m.len() {
                probes.trace(&quantity.name, probe)?;
            }
        }
        self.section().map(drop)
    }

    /// A scalar result by its name, where the file has it.
    #[must_use]
    pub fn number(&self, name: &str) -> Option<f64> {
        self.stored.number(name)
    }

    /// The probes; none for a scene without.
    ///
    /// # Errors
    /// [`ReadError`] for a file that is not as it was written.
    pub fn probes(&self) -> Result<Option<StoredProbes>, ReadError> {
        self.stored
            .group(PROBES)
            .map(|_| StoredProbes::new(self.stored.clone(), &self.series.time_s))
            .transpose()
    }

    /// The section; none for a scene without.
    ///
    /// # Errors
    /// [`ReadError`] for a file that is not as it was written.
    pub fn section(&self) -> Result<Option<StoredSection>, ReadError> {
        self.stored
            .group(MAP)
            .map(|_| StoredSection::new(self.stored.clone()))
            .transpose()
    }
}

/// Where the energy is; none in files from before it was written.
fn energy_of(stored: &Stored, samples: usize) -> Result<Option<EnergySeries>, ReadError> {
    if stored.group(ENERGY).is_none() {
        return Ok(None);
    }
    let path = |i: usize| format!("{ENERGY}/{}", ENERGIES[i].0);
    let column = |i: usize| stored.numbers(&path(i), &[samples]);
    let existing = |i: usize| stored.shape(&path(i)).map(|_| column(i)).transpose();
    Ok(Some(EnergySeries {
        kinetic_j: existing(0)?,
        work_j: existing(1)?,
        stored_j: column(2)?,
        radiated_j: column(3)?,
    }))
}
