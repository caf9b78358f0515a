//! Noise of many impacts: `read` reads the file that describes it, `write` writes the results, and traces are kept tile by tile in a
//! journal until all are computed.

mod read;
mod write;

pub use write::{Described, Dimension, stage_noise};

use crate::error::SceneError;
use crate::quantities::QUANTITIES;
use crate::sweep::{Memory, Spec, Templates, compute_columns};
use contact::{Resampler, Solver, Tabulated};
use fault::{Culprit, Fault};
use ledger::Identity;
use noise::{
    Blow, Ground, Noise, NoiseError, Pulse, Pulses, Receiver, Recording, Source, Spectra, Tiles,
};
use output::{Journal, OutputError, Role, Title, packed, unpacked};
use std::path::Path;
use thiserror::Error;

/// The description of some noise.
#[derive(Debug, Clone)]
pub struct NoiseSpec {
    /// The bodies of the impacts as rows of a sweep.
    bodies: Spec,
    source: Source,
    nearest_m: f64,
    receivers: Vec<Receiver>,
    /// Frequencies of the spectra in Hz, ascending.
    pub frequency_hz: Vec<f64>,
    /// Traces, if they are asked for.
    pub recording: Option<Recording>,
    /// The description as TOML.
    pub text: String,
    /// The files that were read.
    pub inputs: Vec<Role>,
    /// SHA-256, in hexadecimal, of the description, of all files that were read, and of the program's version and numbers.
    pub sha256: String,
}

/// Why there is no noise.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum NoiseFault {
    /// The description.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The computation.
    #[error(transparent)]
    Noise(#[from] NoiseError),
    /// The journal.
    #[error(transparent)]
    Output(#[from] OutputError),
}

impl Fault for NoiseFault {
    fn culprit(&self) -> Culprit<'_> {
        match self {
            Self::Scene(error) => error.culprit(),
            Self::Noise(error) => error.culprit(),
            Self::Output(error) => error.culprit(),
        }
    }
}

/// The results of some noise.
#[derive(Debug)]
pub struct NoiseResults {
    /// Impacts and receivers.
    pub noise: Noise,
    /// Spectra.
    pub spectra: Spectra,
    /// Traces of all receivers in m/s, one after the other.
    pub traces: Option<Vec<f64>>,
}

/// Results of a sweep that an impact needs.
const NEEDED: [&str; 5] = [
    "impulse_n_s",
    "contact_time_s",
    "peak_force_time_s",
    "radiated_energy_j",
    "contact_radius_m",
];

impl NoiseSpec {
    /// Computes contacts, spectra and traces. Tiles of traces are kept in a journal at `part`, if there is one; one of another
    /// description is replaced if `drops`. `watch` is called with a stage, its work done and all of it; if it returns false, nothing
    /// is returned.
    ///
    /// # Errors
    /// [`NoiseFault`].
    pub fn compute(
        &self,
        part: Option<(&Path, bool)>,
        mut watch: impl FnMut(&'static str, usize, usize) -> bool,
    ) -> Result<Option<NoiseResults>, NoiseFault> {
        let Some(noise) = self.impacts(&mut watch)? else {
            return Ok(None);
        };
        if !watch("spectra", 0, 1) {
            return Ok(None);
        }
        let spectra = noise.spectra(&self.frequency_hz)?;
        let traces = match self.recording {
            None => None,
            Some(recording) => {
                let Some(traces) = self.traces(&noise, recording, part, &mut watch)? else {
                    return Ok(None);
                };
                Some(traces)
            }
        };
        Ok(Some(NoiseResults {
            noise,
            spectra,
            traces,
        }))
    }

    /// Solves the contacts.
    fn impacts(
        &self,
        watch: &mut impl FnMut(&'static str, usize, usize) -> bool,
    ) -> Result<Option<Noise>, NoiseFault> {
        let (bodies, rows) = (&self.bodies, self.bodies.rows());
        let templates = Templates::new(bodies)?;
        let mut memory = Memory::default();
        let target = templates.scene(0, &mut memory)?.target.clone();
        let places = NEEDED.map(|name| {
            QUANTITIES
                .iter()
                .position(|one| one.name == name)
                .unwrap_or(0)
        });
        let held = compute_columns(bodies, 0, 1, rows, places.to_vec(), |done, _| {
            watch("impacts", done, rows)
        })?;
        let Some(held) = held else { return Ok(None) };
        if let Some((row, reason)) = held.failures.first() {
            let (row, reason) = (*row, reason.clone());
            return Err(NoiseError::Impact { row, reason }.into());
        }
        let number = |column: usize, row: usize| held.numbers[column * rows + row];
        let blow = |row: usize| Blow {
            impulse_n_s: number(0, row),
            contact_time_s: number(1, row),
            peak_at: number(2, row) / number(1, row),
            radiated_energy_j: number(3, row),
            contact_radius_m: number(4, row),
        };
        let blows: Vec<Blow> = (0..rows).map(blow).collect();
        let responses = Tabulated::default();
        let mut solver = Solver::new(&responses);
        let pulses = Pulses::new(&blows, |row| {
            let (collision, settings) = templates.contact(row, &mut memory)?;
            let solved = solver.solve_with_history(&collision, &settings);
            let (solved, history) = solved.map_err(|error| NoiseError::Impact {
                row,
                reason: error.to_string(),
            })?;
            let (contact, contact_time) = (Resampler::new(history), solved.summary.contact_time);
            let force = |t: f64| contact.force(t * contact_time)[0];
            Ok::<_, NoiseFault>(Pulse::new(force, contact.end() / contact_time))
        })?;
        Ok(Some(Noise {
            ground: Ground::new(&target)?,
            source: self.source.clone(),
            nearest_m: self.nearest_m,
            receivers: self.receivers.clone(),
            blows,
            pulses,
        }))
    }

    /// The traces, tile by tile.
    fn traces(
        &self,
        noise: &Noise,
        recording: Recording,
        part: Option<(&Path, bool)>,
        watch: &mut impl FnMut(&'static str, usize, usize) -> bool,
    ) -> Result<Option<Vec<f64>>, NoiseFault> {
        let tiles = Tiles::new(noise, recording)?;
        let size = tiles.length() * noise.receivers.len();
        let mut records = vec![None; tiles.count()];
        let mut journal = None;
        if let Some((path, drops)) = part {
            journal = Some(Journal::open(
                path,
                &self.title(),
                |_| drops,
                |record, kept| {
                    let place = unpacked::<1>(kept).filter(|(_, rest)| rest.len() == 8 * size);
                    let slot = place.and_then(|([tile], _)| records.get_mut(tile));
                    slot.map(|slot| *slot = Some(record)).is_some()
                },
            )?);
        }
        let mut traces = vec![0.0; tiles.samples() * noise.receivers.len()];
        for (i, record) in records.into_iter().enumerate() {
            if !watch("traces", i, tiles.count()) {
                return Ok(None);
            }
            let velocity_m_s = match (record, &mut journal) {
                (Some(record), Some(journal)) => {
                    let mut kept = Vec::new();
                    let read = journal.read(record, &mut kept);
                    read.map_err(|error| {
                        OutputError::Unreadable(Path::new("the journal").into(), error.to_string())
                    })?;
                    kept[8..]
                        .as_chunks()
                        .0
                        .iter()
                        .map(|bytes| f64::from_le_bytes(*bytes))
                        .collect()
                }
                (_, journal) => {
                    let own = tiles.tile(i)?;
                    if let Some(journal) = journal {
                        let mut bytes = packed([i]);
                        bytes.extend(own.iter().flat_map(|x| x.to_le_bytes()));
                        journal.append(&bytes)?;
                    }
                    own
                }
            };
            tiles.add(i, &velocity_m_s, &mut traces);
        }
        Ok(Some(traces))
    }

    /// The title of the journal.
    fn title(&self) -> Title {
        Title {
            kind: "noise",
            identity: Identity::default().with("noise", &self.sha256).hex(),
            about: self.sha256.clone(),
        }
    }
}
