//! The calls of the page: a scene as text in, a report as JSON and lists of numbers out.

use contact::{Library, Model, Plasticity};
use fault::{Class, Culprit, Fault};
use formats::quantities::labels_of;
use formats::{json_report, material_report, parse_scene};
use halfspace::Medium;
use impact::{Impact, ImpactError, KernelChoice, Scene, Strike, simulate, simulate_rows};
use serde_json::{Value, json};
use std::ops::Range;
use std::path::Path;

/// A JSON object and the numbers to which its `lists` point, each by its first number and its length.
#[derive(Debug, Default)]
pub struct Answer {
    /// The object.
    pub json: Value,
    /// All lists, one after the other.
    pub numbers: Vec<f64>,
}

impl Answer {
    fn new(json: Value) -> Self {
        let mut answer = Self {
            json,
            ..Self::default()
        };
        answer.json["lists"] = json!({});
        answer
    }

    fn list(&mut self, name: &str, numbers: impl IntoIterator<Item = f64>) {
        let first = self.numbers.len();
        self.numbers.extend(numbers);
        self.json["lists"][name] = json!([first, self.numbers.len() - first]);
    }

    /// An error as the command prints it with `--json`.
    fn error(error: &dyn Fault) -> Self {
        let Culprit {
            class,
            key,
            range,
            suggestion,
            ..
        } = error.culprit();
        let message = error.to_string();
        Self::new(json!({ "error": {
            "message": message, "class": class.name(), "key": key, "range": range, "suggestion": suggestion
        } }))
    }
}

/// A fault of the page itself.
fn unknown(call: &str) -> Answer {
    Answer::new(
        json!({ "error": { "message": format!("{call} is no call"), "class": Class::Work.name() } }),
    )
}

/// Answers a call by its name; `range` is that of the rows of `rows`.
pub fn answer(call: &str, text: &str, range: Range<usize>) -> Answer {
    if call == "materials" {
        return materials();
    }
    let scene = match parse_scene(text, Path::new("")) {
        Ok(scene) => scene,
        Err(error) => return Answer::error(&error),
    };
    let found = match call {
        "impact" => impact(&scene),
        "rows" => rows(&scene, range),
        "curve" => curve(&scene),
        _ => return unknown(call),
    };
    found.unwrap_or_else(|error| Answer::error(&error))
}

/// All of a scene but its section.
fn impact(scene: &Scene) -> Result<Answer, ImpactError> {
    let scene = &Scene {
        section: None,
        sensors: Vec::new(),
        ..scene.clone()
    };
    let outcome = simulate(scene, &KernelChoice::Direct)?;
    let mut answer = Answer::new(json_report(scene, &outcome, 0.0));
    let material = scene.target.material();
    let medium = Medium::new(material.poisson_ratio)?;
    let longitudinal_m_s = scene.target.longitudinal_speed_m_s();
    answer.json["speeds_m_s"] =
        json!([1.0, medium.kappa(), medium.rayleigh_speed()].map(|part| part * longitudinal_m_s));
    let series = &outcome.series;
    answer.list("time_s", series.time_s.iter().copied());
    answer.list("force_n", series.force_n.iter().copied());
    if let Some(hertz) = scene
        .strike()
        .and_then(|strike| without_waves(scene, strike))
    {
        let excitation = hertz.excitation();
        answer.list(
            "hertz_n",
            series.time_s.iter().map(|&t| excitation.force_n(t)),
        );
    }
    if let Some(probes) = &outcome.probes {
        let mut shown = Vec::new();
        for (i, (name, unit, meaning)) in labels_of(&probes.quantities).enumerate() {
            let values = probes.values[i].first().into_iter().flatten().copied();
            answer.list(name, values);
            let error = probes.errors[i].first();
            shown.push(json!({ "name": name, "unit": unit, "meaning": meaning, "error": error }));
        }
        answer.json["probe"] = json!({
            "quantities": shown,
            "arrival_s": probes.arrival_s.first(),
            "valid_until_s": probes.valid_until_s.first().filter(|s| s.is_finite()),
        });
    }
    Ok(answer)
}

/// The force of the same bodies without waves, as `hertzlamb plot` draws it; none where the scene is that.
fn without_waves(scene: &Scene, strike: &Strike) -> Option<impact::Run> {
    if scene.settings.model == Model::Hertz {
        return None;
    }
    Impact::of(scene, strike).without_waves().solve().ok()
}

/// The last quantity of a scene, its first field where it asks for none, on some rows of its section, the deepest first.
fn rows(scene: &Scene, range: Range<usize>) -> Result<Answer, ImpactError> {
    let fields = simulate_rows(scene, range)?;
    let place = fields.values.len() - 1;
    let Some((name, unit, meaning)) = labels_of(&fields.quantities).nth(place) else {
        return Err(ImpactError::NoRows);
    };
    let mut answer = Answer::new(json!({ "name": name, "unit": unit, "meaning": meaning }));
    answer.list("time_s", fields.time_s.iter().copied());
    answer.list(
        "values",
        fields.values[place].iter().copied().map(f64::from),
    );
    answer.list("errors", fields.errors[place].iter().copied());
    Ok(answer)
}

/// The restitution of the bodies of a scene over the velocity, with its plasticity and elastic.
fn curve(scene: &Scene) -> Result<Answer, ImpactError> {
    /// Velocities, from a hundredth of the scene's to a hundred times it.
    const VELOCITIES: i32 = 41;
    const DECADES: f64 = 4.0;
    let mut answer = Answer::new(json!({}));
    let Some(strike) = scene.strike() else {
        return Ok(answer);
    };
    let part = |i: i32| f64::from(i) / f64::from(VELOCITIES - 1) - 0.5;
    let velocities: Vec<f64> = (0..VELOCITIES)
        .map(|i| strike.velocity_m_s * 10_f64.powf(DECADES * part(i)))
        .collect();
    let restitution = |plasticity: Plasticity| {
        let mut one = Impact::of(scene, strike);
        one.settings.plasticity = plasticity;
        velocities.iter().map(move |&velocity_m_s| {
            one.velocity_m_s = velocity_m_s;
            // too fast for the law, or for the waves
            one.solve().map_or(f64::NAN, |run| run.results.restitution)
        })
    };
    answer.list("velocity_m_s", velocities.iter().copied());
    answer.list("elastic", restitution(Plasticity::None));
    if scene.settings.plasticity != Plasticity::None {
        answer.list("plastic", restitution(scene.settings.plasticity));
    }
    Ok(answer)
}

fn materials() -> Answer {
    let all: Vec<Value> = Library::built_in().iter().map(material_report).collect();
    Answer::new(json!({ "materials": all }))
}
