//! The results of an impact for people and for machines.

use crate::quantities::{Kind, QUANTITIES};
use crate::results::schema::TREATMENT;
use contact::Choice;
use impact::{Cause, KernelsUsed, Load, Outcome, Scene};
use serde_json::{Map, Value, json};

/// Names of the choices made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Choices<'a> {
    /// Model, never "auto"; "prescribed" for a force that was given.
    pub model: &'static str,
    /// Scheme; "closed form" where nothing was marched.
    pub scheme: &'static str,
    /// Static share.
    pub static_share: &'static str,
    /// Deflection.
    pub deflection: &'static str,
    /// Why this model.
    pub reason: &'a str,
}

/// Name of the scheme where nothing is marched.
const CLOSED_FORM: &str = "closed form";

/// What a scene was computed with.
#[must_use]
pub fn choices<'a>(scene: &Scene, outcome: &'a Outcome) -> Choices<'a> {
    let settings = &scene.settings;
    let deflection = settings.deflection.name();
    match &outcome.cause {
        Cause::Contact {
            model,
            scheme,
            reason,
            ..
        } => Choices {
            model: model.name(),
            scheme: scheme.map_or(CLOSED_FORM, Choice::name),
            static_share: settings.static_share.name(),
            deflection,
            reason,
        },
        Cause::Record(_) => Choices {
            model: "prescribed",
            scheme: CLOSED_FORM,
            static_share: "full",
            deflection,
            reason: "the force is given",
        },
    }
}

/// What was done to a force record, by the names of files: empty where nothing was.
pub(crate) fn treatment(scene: &Scene) -> Vec<(&'static str, Option<f64>)> {
    let Load::Record(record) = &scene.load else {
        return Vec::new();
    };
    let Some(done) = record.treated else {
        return Vec::new();
    };
    let low_passed = |value: f64| done.low_pass_hz.map(|_| value);
    let values = [
        done.baseline_s,
        done.baseline_s.map(|_| done.baseline_n),
        done.low_pass_hz,
        low_passed(done.removed_rms_n),
        low_passed(done.before_zero_n_s),
    ];
    TREATMENT.into_iter().zip(values).collect()
}

/// Kernel of the fields: "none", "direct" or "table".
#[must_use]
pub fn kernel_name(outcome: &Outcome) -> &'static str {
    let used = outcome.used.as_ref();
    used.map_or("none", |used| used.kernels.name())
}

/// All that is reported of a scene, with the time that it took in s.
#[must_use]
pub fn json_report(scene: &Scene, outcome: &Outcome, wall_s: f64) -> Value {
    let choices = choices(scene, outcome);
    let used = outcome.used.as_ref();
    let table_id = match used.map(|used| &used.kernels) {
        Some(KernelsUsed::Table { id, .. }) => Some(id.as_str()),
        Some(KernelsUsed::Direct) | None => None,
    };
    let time_s = &outcome.series.time_s;
    let section = outcome.section.as_ref();
    let head = json!({
        "model": choices.model,
        "scheme": choices.scheme,
        "static_share": choices.static_share,
        "deflection": choices.deflection,
        "reason": choices.reason,
        "kernel": kernel_name(outcome),
        "kernel_reason": used.map_or("", |used| &used.reason),
        "convolution": used.map_or("", |used| used.convolution.name()),
        "table_id": table_id,
        "steps": time_s.len().saturating_sub(1),
        "step_s": outcome.step_s(),
    });
    let treated = treatment(scene).into_iter();
    let treated: Map<_, _> = treated
        .map(|(name, x)| (name.to_owned(), x.into()))
        .collect();
    let tail = json!({
        "probes": outcome.probes.as_ref().map_or(0, |fields| fields.r_m.len()),
        "map": section.map(|s| [s.time_s.len(), s.z_m.len(), s.r_m.len()]),
        "wall_s": wall_s,
        "warnings": outcome.warnings,
        "force_treatment": (!treated.is_empty()).then_some(treated),
    });
    let quantities = QUANTITIES.iter().map(|quantity| {
        let value = quantity
            .of(outcome)
            .map_or(Value::Null, |x| match quantity.kind {
                Kind::Real => Value::from(x),
                Kind::Count => Value::from(x as u64),
            });
        (quantity.name.to_owned(), value)
    });
    let pairs = |value: Value| match value {
        Value::Object(map) => map,
        _ => Map::new(),
    };
    Value::Object(
        pairs(head)
            .into_iter()
            .chain(quantities)
            .chain(pairs(tail))
            .collect(),
    )
}
