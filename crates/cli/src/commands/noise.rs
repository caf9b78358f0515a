//! `hertzlamb noise`: ground motion of many impacts.

use crate::arguments::Overwrite;
use crate::failure::{Failure, lines, show};
use crate::process;
use crate::progress::Bar;
use crate::report::si;
use clap::Args;
use formats::noise::{NoiseResults, NoiseSpec, stage_noise};
use formats::{Existing, Output, OutputError};
use noise::Motion;
use output::{HDF5, apart, behind};
use serde::Serialize;
use std::fmt::{self, Display, Formatter};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use tabulator::Progress;

const EXAMPLES: &str = "Examples:
  hertzlamb noise scenes/gravel.toml -o gravel.h5

Traces that were interrupted are resumed by the same command.";

/// Noise that takes longer shows its progress.
const PATIENCE: Duration = Duration::from_secs(1);

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Noise file (TOML, see data-schema/noise.md).
    noise: PathBuf,
    /// Results file (HDF5, see data-schema/noise.md).
    #[arg(short, long, value_name = "OUT.h5")]
    output: PathBuf,
    #[command(flatten)]
    overwrite: Overwrite,
    /// Print one JSON object instead of text.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let start = Instant::now();
    let spec = NoiseSpec::from_file(&arguments.noise)?;
    let (output, part) = claim(arguments, &spec)?;
    let place = part.clone();
    process::say_then(move || match place.exists() {
        true => format!(
            "finished tiles are kept in {}; run the same command again to resume",
            place.display()
        ),
        false => "nothing was written".to_owned(),
    });
    let (bar, mut stage) = (Bar::after(PATIENCE), "");
    let drops = arguments.overwrite.existing() == Existing::Replace;
    let results = spec.compute(Some((&part, drops)), |name, done, all| {
        if stage != name {
            stage = name;
            bar.total(name, all as u64);
        }
        bar.set(done as u64);
        true
    });
    let begun = |error: &_| {
        matches!(
            error,
            formats::noise::NoiseFault::Output(OutputError::Begun(..))
        )
    };
    let results = results.map_err(|error| {
        let is_begun = begun(&error);
        Failure::from(error).hint_if(
            is_begun,
            "; pass --force to drop it, or choose another output to keep it",
        )
    })?;
    drop(bar);
    let results = results.ok_or_else(|| Failure::work("the noise was stopped"))?;
    stage_noise(&output, &spec, &results)?.commit()?;
    if spec.recording.is_some() {
        let _ = std::fs::remove_file(&part);
    }
    let wall_s = start.elapsed().as_secs_f64();
    show(
        arguments.json,
        &NoiseReport::new(&results, &arguments.output, wall_s),
    )
}

/// Claims the output, and the name of its journal.
fn claim(arguments: &Arguments, spec: &NoiseSpec) -> Result<(Output, PathBuf), Failure> {
    HDF5.check(&arguments.output)?;
    let mut part = behind(&arguments.output)?.into_os_string();
    part.push(".part");
    let part = PathBuf::from(part);
    apart(&[arguments.output.as_path(), &part], &spec.inputs)?;
    Ok((
        Output::claim(&arguments.output, arguments.overwrite.existing())?,
        part,
    ))
}

/// Report of some noise.
#[derive(Serialize)]
struct NoiseReport {
    output: String,
    impacts: usize,
    solved_contacts: usize,
    rate_per_s: f64,
    radiated_power_w: f64,
    receivers: Vec<Loudest>,
    wall_s: f64,
}

/// The vertical velocity of a receiver.
#[derive(Serialize)]
struct Loudest {
    name: String,
    /// Where its power is the largest, and the power with its relative error.
    frequency_hz: f64,
    velocity_power_m2_s: f64,
    error: f64,
    /// Distance from within which half of it comes.
    half_within_m: f64,
}

impl NoiseReport {
    fn new(results: &NoiseResults, output: &Path, wall_s: f64) -> Self {
        let NoiseResults { noise, spectra, .. } = results;
        let of = |i: usize| {
            let power = spectra.power(i, Motion::Vertical, 1);
            let loudest = (0..power.len())
                .max_by(|&a, &b| power[a].total_cmp(&power[b]))
                .unwrap_or(0);
            let share = spectra.share(i).nth(loudest).unwrap_or(&[]);
            let half = share.iter().position(|part| *part >= 0.5);
            let edges = &spectra.distance_m[i];
            Loudest {
                name: noise.receivers[i].name.clone(),
                frequency_hz: spectra.frequency_hz[loudest],
                velocity_power_m2_s: power[loudest],
                error: spectra
                    .errors(i)
                    .nth(loudest)
                    .map_or(0.0, noise::Errors::total),
                half_within_m: edges[half.unwrap_or(edges.len() - 1)],
            }
        };
        Self {
            output: output.display().to_string(),
            impacts: noise.blows.len(),
            solved_contacts: noise.pulses.solved(),
            rate_per_s: noise.rate_per_s(),
            radiated_power_w: noise.radiated_w(),
            receivers: (0..noise.receivers.len()).map(of).collect(),
            wall_s,
        }
    }
}

impl Display for NoiseReport {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let impacts = format!(
            "{}, {} of them solved in full",
            self.impacts, self.solved_contacts
        );
        let mut text = vec![
            ("impacts", impacts),
            ("rate", format!("{:.6} per s", self.rate_per_s)),
            ("radiated", si(self.radiated_power_w, "W")),
        ];
        text.extend(self.receivers.iter().map(|one| {
            let told = format!(
                "{}: loudest at {}, {:.4e} (m/s)^2/Hz +- {:.1} %, half of it from within {}",
                one.name,
                si(one.frequency_hz, "Hz"),
                one.velocity_power_m2_s,
                100.0 * one.error,
                si(one.half_within_m, "m")
            );
            ("receiver", told)
        }));
        text.extend([
            ("time", format!("{:.2} s", self.wall_s)),
            ("written", self.output.clone()),
        ]);
        f.write_str(&lines(text))
    }
}
