//! `hertzlamb infer`: yield pressure or velocity from a measured rebound, or the force from traces of sensors.

use crate::arguments::Overwrite;
use crate::failure::{Failure, lines, say, show};
use crate::report::{short, si};
use clap::builder::PossibleValuesParser;
use clap::{ArgGroup, Args};
use contact::{Choice, Inferred, Measure, Unknown};
use formats::traces::{
    Given, InferredForce, KnownOf, force_report, infer_force, read_traces, stage_force,
};
use formats::{read_scene, resolved};
use impact::Scene;
use inverse::Estimate;
use output::{HDF5, Role};
use serde::{Serialize, Serializer};
use serde_json::Value;
use std::fmt::{self, Display, Formatter};
use std::path::PathBuf;

const EXAMPLES: &str = "Examples:
  hertzlamb infer scenes/plastic-drop.toml --restitution 0.56 --error 0.01
  hertzlamb infer scenes/plastic-drop.toml --bounces 0.32,0.18
  hertzlamb infer scenes/plastic-drop.toml --peak-force 120 --error 3 --unknown velocity_m_s
  hertzlamb infer scenes/sensor-face.toml --trace trace.csv -o force.h5";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, group(ArgGroup::new("measured").required(true)))]
pub(crate) struct Arguments {
    /// Scene file (TOML): with contact.plasticity, and its value of the unknown is ignored; or with the sensors of the traces.
    scene: PathBuf,
    /// Measured ratio of the rebound velocity to the impact velocity.
    #[arg(long, group = "measured", value_name = "E")]
    restitution: Option<f64>,
    /// Measured times in s between three bounces. Their ratio is the restitution of the middle bounce, whose velocity
    /// follows from the first time.
    #[arg(long, group = "measured", value_name = "T1,T2", value_delimiter = ',')]
    bounces: Option<Vec<f64>>,
    /// Measured duration of the contact in s.
    #[arg(long, group = "measured", value_name = "SECONDS")]
    contact_time: Option<f64>,
    /// Measured largest force in N.
    #[arg(long, group = "measured", value_name = "NEWTONS")]
    peak_force: Option<f64>,
    /// Trace of the scene's sensors: text with a column of times and one for each sensor. Infers the force. Give the option
    /// again for each repeated drop; the drops are aligned and averaged.
    #[arg(long, group = "measured", value_name = "TRACE")]
    trace: Vec<PathBuf>,
    /// Absolute error of the measured value; for bounces, of each of the two times.
    #[arg(long, default_value_t = 0.0)]
    error: f64,
    /// Scene key to infer.
    #[arg(long, value_name = "KEY", default_value = "yield_pressure_pa", value_parser = PossibleValuesParser::new(Unknown::ALL.iter().map(|unknown| unknown.name())))]
    unknown: String,
    /// Print one JSON object instead of text.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    force: ForceArguments,
}

/// Options for a force from traces.
#[derive(Debug, Args)]
#[command(next_help_heading = "With --trace")]
struct ForceArguments {
    /// File to write the force to (HDF5). Default: none.
    #[arg(short, long, requires = "trace", value_name = "FILE")]
    output: Option<PathBuf>,
    /// Standard deviation of white noise, one for all sensors or one for each, in the units of the traces. Default: the noise
    /// before the first arrival.
    #[arg(long, requires = "trace", value_name = "SIGMA", value_delimiter = ',')]
    noise: Vec<f64>,
    /// Sensors, numbered from 1, whose gain is not known.
    #[arg(
        long,
        requires = "trace",
        value_name = "SENSORS",
        value_delimiter = ','
    )]
    unknown_gains: Vec<usize>,
    /// Known impulse in N s and its standard deviation.
    #[arg(
        long,
        requires = "trace",
        value_name = "VALUE,SD",
        value_parser = pair
    )]
    impulse: Option<[f64; 2]>,
    /// Times in s of the traces between which the force may differ from zero. Default: 1.3 fitted contact times.
    #[arg(
        long,
        requires = "trace",
        value_name = "FROM,TO",
        value_parser = pair,
        allow_hyphen_values = true
    )]
    window: Option<[f64; 2]>,
    /// Weight of the squared second differences of the force in 1/N^2. Default: the most likely one.
    #[arg(long, requires = "trace", value_name = "LAMBDA")]
    lambda: Option<f64>,
    /// Property of the striker that is trusted: the others follow from the force.
    #[arg(long, requires = "trace", value_name = "PROPERTY", value_parser = PossibleValuesParser::new(KnownOf::ALL.iter().map(|one| one.name())))]
    known: Option<String>,
    /// Known restitution, by which the impulse is a momentum.
    #[arg(long = "of-restitution", requires = "trace", value_name = "E")]
    of_restitution: Option<f64>,
    #[command(flatten)]
    overwrite: Overwrite,
}

/// Two numbers with a comma between them.
fn pair(text: &str) -> Result<[f64; 2], String> {
    let numbers: Option<Vec<f64>> = text
        .split(',')
        .map(|part| part.trim().parse().ok())
        .collect();
    let pair = numbers.and_then(|numbers| <[f64; 2]>::try_from(numbers).ok());
    pair.ok_or_else(|| "two numbers are required, such as 1e-5,3e-5".to_owned())
}

/// The force behind traces.
fn run_traces(arguments: &Arguments, scene: &Scene) -> Result<(), Failure> {
    let own = &arguments.force;
    let mut read: Vec<Role> = vec![("the scene", arguments.scene.clone())];
    read.extend(arguments.trace.iter().map(|path| ("a trace", path.clone())));
    let claim = |path: &PathBuf| {
        HDF5.check(path)?;
        own.overwrite.claim(path, &read)
    };
    let output = own.output.as_ref().map(claim).transpose()?;
    let blows = arguments.trace.iter().map(|path| read_traces(path));
    let blows = blows.collect::<Result<Vec<_>, _>>()?;
    let given = Given {
        noise: own.noise.clone(),
        unknown_gains: own.unknown_gains.clone(),
        impulse_n_s: own.impulse,
        lambda: own.lambda,
        window_s: own.window,
        known: own.known.as_deref().and_then(KnownOf::named),
        restitution: own.of_restitution,
    };
    let force = infer_force(scene, &blows, &given)?;
    if let Some(output) = &output {
        stage_force(output, &resolved(scene), &force)?.commit()?;
    }
    for warning in &force.warnings {
        say(format!("warning: {warning}"));
    }
    show(arguments.json, &ForceReport(force))
}

/// The force behind traces.
struct ForceReport(InferredForce);

impl Serialize for ForceReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        force_report(&self.0).serialize(serializer)
    }
}

impl Display for ForceReport {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (fit, history) = (&self.0.found.fit, &self.0.found.history);
        let of = |own: &Estimate, unit: &str| {
            format!("{} +- {}", si(own.value, unit), short(own.sd, unit))
        };
        let mut text = vec![
            ("peak force", of(&fit.peak_n, "N")),
            ("contact time", of(&fit.duration_s, "s")),
            ("start", of(&self.0.blow_start_s(), "s")),
            ("impulse", of(&fit.impulse_n_s, "N s")),
            (
                "history",
                format!(
                    "peak {}, impulse {}, {} samples",
                    of(&history.peak_n, "N"),
                    of(&history.impulse_n_s, "N s"),
                    history.force_n.len()
                ),
            ),
            (
                "agreement",
                format!(
                    "{:.4} % of the variance; chi-squared {:.3} a degree of freedom with the history, {:.3} with the fit",
                    100.0 * history.variance_reduction,
                    history.chi_squared / history.degrees_of_freedom,
                    fit.chi_squared / fit.degrees_of_freedom.max(1) as f64
                ),
            ),
        ];
        for (i, noise) in (1..).zip(&self.0.found.noise) {
            let how = match (&noise.quiet, noise.order) {
                (None, _) => "given".to_owned(),
                (Some(quiet), 0) => format!("white, of {} quiet samples", quiet.len()),
                (Some(quiet), order) => {
                    format!("coloured (order {order}), of {} quiet samples", quiet.len())
                }
            };
            text.push((
                "noise",
                format!(
                    "sensor {i}: standard deviation {:.3e}, {how}; signal to noise {:.0}",
                    noise.sigma, noise.signal_to_noise
                ),
            ));
        }
        if let Some(own) = &self.0.ball {
            let mass_g = Estimate {
                value: 1e3 * own.mass_kg.value,
                sd: 1e3 * own.mass_kg.sd,
            };
            text.push((
                "ball",
                format!(
                    "radius {}, mass {}, velocity {}",
                    of(&own.radius_m, "m"),
                    of(&mass_g, "g"),
                    of(&own.velocity_m_s, "m/s")
                ),
            ));
        }
        text.extend(
            self.0
                .momentum_n_s
                .iter()
                .map(|own| ("momentum", of(own, "N s"))),
        );
        f.write_str(&lines(text))
    }
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let scene = read_scene(&arguments.scene)?;
    if !arguments.trace.is_empty() {
        return run_traces(arguments, &scene);
    }
    let unknown = Unknown::named(&arguments.unknown).unwrap_or(Unknown::YieldPressure);
    let mut one = [
        (Measure::Restitution, arguments.restitution),
        (Measure::ContactTime, arguments.contact_time),
        (Measure::PeakForce, arguments.peak_force),
    ]
    .into_iter();
    let given = one.find_map(|(measure, value)| Some((measure.name(), vec![value?])));
    let (name, values) =
        given.unwrap_or_else(|| ("bounces", arguments.bounces.clone().unwrap_or_default()));
    let (found, report) = formats::infer(&scene, (name, &values), arguments.error, unknown)?;
    let law = scene.settings.plasticity.name();
    let report = InferReport {
        unknown,
        found,
        law,
        value: report,
    };
    show(arguments.json, &report)
}

/// The inferred yield pressure or velocity.
struct InferReport {
    unknown: Unknown,
    found: Inferred,
    /// Name of the plasticity law.
    law: &'static str,
    value: Value,
}

impl Serialize for InferReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.value.serialize(serializer)
    }
}

impl Display for InferReport {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (found, unknown) = (&self.found, self.unknown);
        let results = &found.results;
        let in_units = |x| si(x, unknown.unit());
        let end = |end: Option<f64>, none: &str| end.map_or(none.to_owned(), in_units);
        let [low, high] = found.band;
        let (low, high) = (end(low, "no lower bound"), end(high, "no upper bound"));
        let value = in_units(found.value);
        let over = results.plastic.velocity_over_yield.unwrap_or(1.0);
        let yields = si(results.plastic.yield_velocity_m_s.unwrap_or(0.0), "m/s");
        let mut text = vec![
            (unknown.words(), format!("{value} ({low} to {high})")),
            (
                "yield",
                format!("{over:.4} times the onset velocity, {yields}"),
            ),
            ("restitution", format!("{:.6}", results.restitution)),
            ("contact time", si(results.contact_time_s, "s")),
            ("peak force", si(results.peak_force_n, "N")),
        ];
        if found.elastic {
            let told = "the measured value is that of an elastic contact: any higher yield pressure gives it";
            text.push(("note", told.to_owned()));
        }
        if let Some(over) = results
            .plastic
            .velocity_over_trusted
            .filter(|&over| over > 1.0)
        {
            let told = format!(
                "{over:.1} times the largest velocity for which plasticity = \"{}\" is valid",
                self.law
            );
            text.push(("note", told));
        }
        f.write_str(&lines(text))
    }
}
