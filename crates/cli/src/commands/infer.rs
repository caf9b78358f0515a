//! `hertzlamb infer`: yield pressure or velocity from a measured rebound.

use crate::failure::{Failure, lines, show};
use crate::report::si;
use clap::builder::PossibleValuesParser;
use clap::{ArgGroup, Args};
use contact::{Choice, Inferred, Measure, Unknown};
use formats::read_scene;
use serde::{Serialize, Serializer};
use serde_json::Value;
use std::fmt::{self, Display, Formatter};
use std::path::PathBuf;

const EXAMPLES: &str = "Examples:
  hertzlamb infer scenes/plastic-drop.toml --restitution 0.56 --error 0.01
  hertzlamb infer scenes/plastic-drop.toml --bounces 0.32,0.18
  hertzlamb infer scenes/plastic-drop.toml --peak-force 120 --error 3 --unknown velocity_m_s";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, group(ArgGroup::new("measured").required(true)))]
pub(crate) struct Arguments {
    /// Scene file (TOML) with contact.plasticity; its value of the unknown is ignored.
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
    /// Absolute error of the measured value; for bounces, of each of the two times.
    #[arg(long, default_value_t = 0.0)]
    error: f64,
    /// Scene key to infer.
    #[arg(long, value_name = "KEY", default_value = "yield_pressure_pa", value_parser = PossibleValuesParser::new(Unknown::ALL.iter().map(|unknown| unknown.name())))]
    unknown: String,
    /// Print one JSON object instead of text.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let scene = read_scene(&arguments.scene)?;
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
