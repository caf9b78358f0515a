//! `hertzlamb impact`: one scene.

use crate::arguments::{AS_TEXT, KernelOptions, MemoryLimit, Overwrite, is_text, say_complete};
use crate::failure::{Failure, lines, say, show};
use crate::progress::Bar;
use crate::report::{text_report, understood};
use clap::Args;
use formats::{check_results, json_report, read_with_inputs, stage_results, stage_results_csv};
use impact::{Allowance, Forecast, ImpactError, Outcome, Place, Road, Scene, simulate_within};
use output::{CSV, Ending, Existing, HDF5, Output, Role, Staged, apart};
use serde::{Serialize, Serializer};
use std::cell::RefCell;
use std::fmt::{self, Display, Formatter};
use std::iter;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use tabulator::Progress;

/// An impact that takes longer shows its progress.
const PATIENCE: Duration = Duration::from_secs(1);

#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  hertzlamb impact scenes/first-impact.toml -o impact.h5\n  hertzlamb impact scenes/copper-on-steel.toml --table kernels.h5 -o impact.h5 --json"
)]
pub(crate) struct Arguments {
    /// Scene file (TOML, see data-schema/scene.md); - is standard input.
    scene: PathBuf,
    #[command(flatten)]
    kernels: KernelOptions,
    /// Results file (HDF5, see data-schema/results.md).
    #[arg(short, long, value_name = "OUT.h5")]
    output: Option<PathBuf>,
    /// Also write the time series and the traces of the probes as text, one line per sample.
    #[arg(long, value_name = "OUT.csv")]
    csv: Option<PathBuf>,
    /// If the output exists: succeed at once if it is complete and of the same scene, kernels and version, fail with exit code 1 otherwise.
    #[arg(long, requires = "output", conflicts_with = "force")]
    skip_complete: bool,
    #[command(flatten)]
    overwrite: Overwrite,
    #[command(flatten)]
    memory: MemoryLimit,
    /// Solve the contact only and print the time, memory and disk space that the fields would need.
    #[arg(long, conflicts_with_all = ["output", "csv"])]
    dry_run: bool,
    /// Print one JSON object instead of text.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let start = Instant::now();
    let (scene, inputs) = read_with_inputs(&arguments.scene)?;
    if let Some(output) = complete(arguments, &scene)? {
        return say_complete(output, arguments.json);
    }
    let [output, csv] = outputs(arguments, &scene, inputs)?;
    let kernels = arguments.kernels.choice()?;
    let forecast = RefCell::new(Forecast::least(&scene));
    let progress = Bar::after(PATIENCE);
    let allowance = Allowance {
        memory_bytes: arguments.memory.bytes(),
        go_on: &|found| {
            forecast.replace(found.clone());
            if found.seconds > LONG_S && !arguments.dry_run {
                say(takes(found));
            }
            progress.total("fields", found.points as u64);
            !arguments.dry_run
        },
        watch: &|| progress.advance(1),
    };
    let outcome = match simulate_within(&scene, &kernels, &allowance) {
        Err(ImpactError::GivenUp { .. }) => return plan(arguments, &scene, &forecast.borrow()),
        found => found?,
    };
    drop(progress);
    // all outputs get their names, or none if one fails
    let stage = |output| stage_results(output, &scene, &outcome);
    let results = output.as_ref().map(stage).transpose()?;
    let stage = |csv| stage_results_csv(csv, &scene, &outcome);
    let text = csv.as_ref().map(stage).transpose()?;
    let mut staged = results.into_iter().chain(text);
    staged.try_for_each(Staged::commit)?;
    for warning in &outcome.warnings {
        say(format!("warning: {warning}"));
    }
    let report = ImpactReport {
        scene: &scene,
        outcome: &outcome,
        wall_s: start.elapsed().as_secs_f64(),
    };
    show(arguments.json, &report)
}

/// Results of a scene.
struct ImpactReport<'a> {
    scene: &'a Scene,
    outcome: &'a Outcome,
    wall_s: f64,
}

impl Serialize for ImpactReport<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        json_report(self.scene, self.outcome, self.wall_s).serialize(serializer)
    }
}

impl Display for ImpactReport<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&text_report(self.scene, self.outcome))
    }
}

/// Prints the cost of a scene.
fn plan(arguments: &Arguments, scene: &Scene, forecast: &Forecast) -> Result<(), Failure> {
    let report = ScenePlan {
        points: forecast.points,
        samples: forecast.samples,
        seconds: forecast.seconds,
        memory_bytes: forecast.memory_bytes,
        disk_bytes: forecast.disk_bytes,
        threads: std::thread::available_parallelism().map_or(1, usize::from),
        text: format!(
            "{}\n{}",
            lines([("impact", understood(scene))]),
            iter::once(takes(forecast))
                .chain(forecast.roads.iter().map(along))
                .collect::<Vec<_>>()
                .join("\n")
        ),
        roads: forecast.roads.iter().map(PlannedRoad::from).collect(),
    };
    show(arguments.json, &report)
}

/// Time, memory and disk space that a scene needs.
#[derive(Serialize)]
struct ScenePlan {
    points: usize,
    samples: f64,
    seconds: f64,
    memory_bytes: f64,
    disk_bytes: f64,
    threads: usize,
    roads: Vec<PlannedRoad>,
    #[serde(skip)]
    text: String,
}

/// Method for the fields of a probe (numbered from 1) or of the section.
#[derive(Serialize)]
struct PlannedRoad {
    probe: Option<usize>,
    sensor: Option<usize>,
    points: usize,
    discs: usize,
    looked_up: bool,
    samples: usize,
    integrated: f64,
    seconds: f64,
}

impl From<&Road> for PlannedRoad {
    fn from(road: &Road) -> Self {
        Self {
            probe: match road.place {
                Place::Probe(probe) => Some(probe + 1),
                Place::Sensor(_) | Place::MeanOfKernels(_) | Place::Section => None,
            },
            sensor: match road.place {
                Place::Sensor(sensor) | Place::MeanOfKernels(sensor) => Some(sensor + 1),
                Place::Probe(_) | Place::Section => None,
            },
            points: road.points,
            discs: road.discs,
            looked_up: road.looked_up,
            samples: road.samples,
            integrated: road.integrated,
            seconds: road.seconds,
        }
    }
}

/// One line about the method for a probe or the section.
fn along(road: &Road) -> String {
    let name = match road.place {
        Place::Probe(probe) => format!("probe {}", probe + 1),
        Place::Sensor(sensor) if road.points > 1 => {
            format!("sensor {}, {} circles", sensor + 1, road.points)
        }
        Place::Sensor(sensor) => format!("sensor {}", sensor + 1),
        Place::MeanOfKernels(sensor) => format!("sensor {}, averaged kernels", sensor + 1),
        Place::Section => format!("section, {} points", road.points),
    };
    let discs = match (road.discs, road.looked_up) {
        (1, false) => "1 disc".to_owned(),
        (1, true) => "1 disc looked up".to_owned(),
        (discs, looked_up) => {
            format!("{discs} discs{}", if looked_up { " looked up" } else { "" })
        }
    };
    let each = road.integrated / road.points.max(1) as f64;
    let integrated = match road.place {
        _ if each == 0.0 => String::new(),
        Place::Probe(_) | Place::Sensor(_) | Place::MeanOfKernels(_) => {
            format!("; {each:.0} of {} samples integrated", road.samples)
        }
        Place::Section => format!(
            "; {each:.1} of {} samples of a point integrated",
            road.samples
        ),
    };
    let time = match road.seconds {
        short if short < 1.0 => format!("{:.0} ms", (1e3 * short).max(1.0)),
        long => format!("{long:.1} s"),
    };
    format!("{name}: {discs}{integrated}; {time} on one thread")
}

impl Display for ScenePlan {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// The output, if `--skip-complete` is set and the output exists as this command would write it.
fn complete<'a>(arguments: &'a Arguments, scene: &Scene) -> Result<Option<&'a Path>, Failure> {
    let may_stay = |path: &&Path| arguments.skip_complete && path.exists();
    let Some(output) = arguments.output.as_deref().filter(may_stay) else {
        return Ok(None);
    };
    HDF5.check(output)?;
    // also removes temporary files that a killed run has left next to them
    for path in iter::once(output).chain(arguments.csv.as_deref()) {
        Output::claim(path, Existing::Replace)?;
    }
    let (direct, id) = arguments.kernels.allowed()?;
    check_results(output, scene, direct, id.as_deref()).map_err(Failure::work)?;
    match &arguments.csv {
        Some(csv) if !csv.exists() => Err(Failure::work(format!(
            "{} is complete, but {} does not exist: leave --skip-complete out to add it",
            output.display(),
            csv.display()
        ))),
        Some(_) | None => Ok(Some(output)),
    }
}

/// Whether the first of two outputs exists and is complete and the second does not exist. A run that was killed between
/// the two renames, or could not write the second, leaves this state, and the same command may resume from it.
fn is_half_done(arguments: &Arguments, scene: &Scene) -> bool {
    let (Some(output), Some(csv)) = (&arguments.output, &arguments.csv) else {
        return false;
    };
    let one_of_two = !arguments.overwrite.force && output.exists() && !csv.exists();
    one_of_two
        && arguments
            .kernels
            .allowed()
            .is_ok_and(|(direct, id)| check_results(output, scene, direct, id.as_deref()).is_ok())
}

/// Claims the results file and the text file, as far as they are requested.
fn outputs(
    arguments: &Arguments,
    scene: &Scene,
    mut read: Vec<Role>,
) -> Result<[Option<Output>; 2], Failure> {
    read.extend(arguments.kernels.input());
    let existing = match is_half_done(arguments, scene) {
        true => Existing::KeepUnlessSame,
        false => arguments.overwrite.existing(),
    };
    let mut claim = |path: &Option<PathBuf>, ending: Ending| {
        let claimed = path.as_ref().map(|path| {
            let told = |error| Failure::from(error).hint_if(is_text(path), AS_TEXT);
            ending.check(path).map_err(told)?;
            apart(&[path], &read)?;
            read.push(("another output", path.clone()));
            Output::claim(path, existing).map_err(Failure::from)
        });
        claimed.transpose()
    };
    // claims both, even if one is rejected: claiming removes temporary files that a killed run has left next to the output
    let (output, csv) = (claim(&arguments.output, HDF5), claim(&arguments.csv, CSV));
    Ok([output?, csv?])
}

/// A scene that takes more seconds than this prints its cost first.
const LONG_S: f64 = 5.0;

fn takes(forecast: &Forecast) -> String {
    let (points, samples, seconds) = (forecast.points, forecast.samples, forecast.seconds);
    let ending = if points == 1 { "" } else { "s" };
    let decimals = if seconds > LONG_S { 0 } else { 2 };
    let [memory, disk] = [forecast.memory_bytes, forecast.disk_bytes].map(|bytes| 1e-9 * bytes);
    format!(
        "{points} point{ending} of {samples:.0} samples: about {seconds:.decimals$} s, {memory:.3} GB of memory, {disk:.3} GB in a results file"
    )
}
