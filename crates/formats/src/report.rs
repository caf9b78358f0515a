//! The results of an impact as JSON.

use crate::quantities::{Kind, QUANTITIES};
use crate::schema::results::TREATMENT;
use contact::{Choice, Collision, GRAVITY_M_S2, InferError, Inferred, Material, Measure, Unknown};
use impact::{Cause, Outcome, Scene, SensorHistory};
use lookup::schema::FIELD_NAMES;
use lookup::{Accuracy, Quantiles, Table};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::Path;

/// Name of the scheme if no time stepping is needed.
const CLOSED_FORM: &str = "closed form";

/// The choices in a computed scene, by name: model (never "auto"; "prescribed" for a given force), scheme ("closed
/// form" without time steps), static share, deflection, and the reason for the model.
pub fn choices<'a>(scene: &Scene, outcome: &'a Outcome) -> [&'a str; 5] {
    let settings = &scene.settings;
    let deflection = settings.deflection.name();
    match &outcome.cause {
        Cause::Contact {
            model,
            scheme,
            reason,
            ..
        } => [
            model.name(),
            scheme.map_or(CLOSED_FORM, Choice::name),
            settings.static_share.name(),
            deflection,
            reason,
        ],
        Cause::Record(_) => [
            "prescribed",
            CLOSED_FORM,
            "full",
            deflection,
            "the force is given",
        ],
    }
}

/// Treatment of a force record, by the names of files; empty if there was none.
pub(crate) fn treatment(scene: &Scene) -> Vec<(&'static str, Option<f64>)> {
    let Some(done) = scene.record().and_then(|record| record.treated) else {
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
pub fn kernel_name(outcome: &Outcome) -> &'static str {
    let used = outcome.used.as_ref();
    used.map_or("none", |used| used.kernel())
}

/// Infers `unknown` of a scene from a measured rebound and returns it with its report. `name` and `values` are one
/// number of a [`Measure`], or `bounces` with two times in s between three bounces; `error` is their absolute error.
///
/// # Errors
/// [`InferError`].
pub fn infer(
    scene: &Scene,
    (name, values): (&str, &[f64]),
    mut error: f64,
    unknown: Unknown,
) -> Result<(Inferred, Value), InferError> {
    let refused = |what: String| Err(InferError::Given(what));
    let Some(strike) = scene.strike() else {
        return refused(
            "a force record has no rebound: replace [force] by a [striker] in the scene".to_owned(),
        );
    };
    let mut velocity_m_s = strike.velocity_m_s;
    let (measure, value) = match (Measure::named(name), values) {
        (Some(measure), &[value]) => (measure, value),
        // the ratio of the times is the restitution of the middle bounce, whose velocity follows from the first time
        (None, &[first, second]) => {
            if let Some(doubt) = doubt_of_bounces(first, second) {
                return refused(doubt);
            }
            velocity_m_s = 0.5 * GRAVITY_M_S2 * first;
            error *= (1.0 + (second / first).powi(2)).sqrt() / first;
            (Measure::Restitution, second / first)
        }
        _ => {
            return refused(format!(
                "{name} has {} times, but two are required",
                values.len()
            ));
        }
    };
    let positive = |x: f64| x > 0.0 && x.is_finite();
    if !(positive(value) && positive(velocity_m_s) && error >= 0.0 && error.is_finite()) {
        return refused(format!(
            "{name} = {} with an error of {} is outside (0, inf) and [0, inf)",
            fault::number(value),
            fault::number(error)
        ));
    }
    let collision = Collision::new(&scene.target, &strike.striker, velocity_m_s);
    let found = contact::infer(
        &collision,
        &scene.settings,
        unknown,
        measure,
        [value, error],
    )?;
    let ([low, high], results) = (found.band, &found.results);
    let report = json!({
        "unknown": unknown.name(),
        "value": found.value,
        "low": low,
        "high": high,
        "elastic": found.elastic,
        "velocity_over_yield": results.plastic.velocity_over_yield,
        "yield_velocity_m_s": results.plastic.yield_velocity_m_s,
        "velocity_over_trusted": results.plastic.velocity_over_trusted,
        "restitution": results.restitution,
        "contact_time_s": results.contact_time_s,
        "peak_force_n": results.peak_force_n,
    });
    Ok((found, report))
}

/// Longest accepted time between two bounces in s: 10 s correspond to a fall from 123 m.
const LONGEST_BOUNCE_S: f64 = 10.0;

/// A sentence about implausible times between bounces, such as times in ms.
fn doubt_of_bounces(first: f64, second: f64) -> Option<String> {
    let written = |per_s: f64| {
        let times = [first, second].map(|time| fault::number(time / per_s));
        times.join(",")
    };
    let change = match first <= 1e3 * LONGEST_BOUNCE_S {
        true => format!("; if they are in ms, use {}", written(1e3)),
        false => String::new(),
    };
    (first > LONGEST_BOUNCE_S && first.is_finite()).then(|| {
        format!(
            "bounces = {} is outside (0, {LONGEST_BOUNCE_S}] s: the first is a fall from {:.0} m{change}",
            written(1.0),
            GRAVITY_M_S2 * first * first / 8.0
        )
    })
}

/// The full report of a scene, with its computing time in s.
pub fn json_report(scene: &Scene, outcome: &Outcome, wall_s: f64) -> Value {
    let [model, scheme, static_share, deflection, reason] = choices(scene, outcome);
    let used = outcome.used.as_ref();
    let table = used.and_then(|used| used.table.as_ref());
    let mut report = json!({
        "model": model,
        "scheme": scheme,
        "static_share": static_share,
        "deflection": deflection,
        "reason": reason,
        "kernel": kernel_name(outcome),
        "kernel_reason": used.map_or("", |used| &used.reason),
        "convolution": used.map_or("", |used| used.convolution.name()),
        "table_id": table.map(|[id, _]| id),
        "steps": outcome.series.time_s.len().saturating_sub(1),
        "step_s": outcome.step_s(),
        "output_low_pass_hz": scene.low_pass_hz,
    });
    for quantity in &QUANTITIES {
        report[quantity.name] = match (quantity.of(outcome), quantity.kind) {
            (None, _) => Value::Null,
            (Some(x), Kind::Real) => x.into(),
            (Some(x), Kind::Count) => (x as u64).into(),
        };
    }
    let probes = outcome.probes.as_ref();
    let section = outcome.section.as_ref();
    report["probes"] = probes.map_or(0, |fields| fields.r_m.len()).into();
    let sensor = |own: &SensorHistory| {
        json!({
            "r_m": own.sensor.r_m,
            "z_m": own.sensor.z_m,
            "face_radius_m": own.sensor.face_radius_m,
            "quantity": own.sensor.measured.name(),
            "unit": own.sensor.measured.unit(),
            "output_unit": own.sensor.output_unit(),
            "face_mean": own.face.name(),
            "mean_peak": own.mean.peak(),
            "mean_error": own.mean.error,
            "output_peak": peak_of(&own.output),
            "output_error": peak_of(&own.output_error),
            "first_arrival_s": own.arrival_s[0],
            "valid_until_s": Some(own.valid_until_s).filter(|t| t.is_finite()),
        })
    };
    report["sensors"] = outcome.sensors.iter().map(sensor).collect();
    report["map"] = section.map_or(Value::Null, |s| {
        json!([s.time_s.len(), s.z_m.len(), s.r_m.len()])
    });
    report["wall_s"] = wall_s.into();
    report["warnings"] = json!(outcome.warnings);
    report["force_treatment"] = Value::Null;
    for (name, number) in treatment(scene) {
        report["force_treatment"][name] = number.into();
    }
    report
}

/// The sample of the largest magnitude, with its sign.
fn peak_of(samples: &[f64]) -> f64 {
    let larger = |most: f64, x: &f64| if x.abs() > most.abs() { *x } else { most };
    samples.iter().fold(0.0, larger)
}

/// A material with its wave speeds.
pub fn material_report(m: &Material) -> Value {
    json!({
        "name": m.name,
        "group": m.group,
        "youngs_modulus_pa": m.youngs_modulus_pa,
        "poisson_ratio": m.poisson_ratio,
        "density_kg_m3": m.density_kg_m3,
        "longitudinal_speed_m_s": m.longitudinal_speed_m_s(),
        "shear_speed_m_s": m.shear_speed_m_s(),
        "yield_strength_pa": m.yield_strength_pa,
        "tensile_strength_pa": m.tensile_strength_pa,
        "fracture_toughness_pa_sqrt_m": m.fracture_toughness_pa_sqrt_m,
        "source": m.source,
    })
}

/// Range, origin and accuracy of a kernel table.
pub fn table_report(path: &Path, table: &Table) -> Value {
    let content = table.content();
    let origin = &content.origin;
    json!({
        "file": path.to_string_lossy(),
        "bytes": std::fs::metadata(path).map_or(0, |data| data.len()),
        "id": table.id(),
        "format_version": origin.format_version,
        "software_version": origin.software_version,
        "git_revision": origin.git_revision,
        "created_unix_s": origin.created_unix_s,
        "content_sha256": lookup::content_hash(content),
        "poisson_ratios": table.poisson_ratios(),
        "r_nodes": content.r.len(),
        "z_nodes": content.z.len(),
        "r_max": content.r_max,
        "z_max": content.z_max,
        "cell_width": content.cell_width,
        "cells": content.slices.iter().map(|slice| slice.cells).collect::<Vec<_>>(),
        "stencil_points": content.stencil_points,
        "accuracy_asked": origin.accuracy_asked,
        "pulse_lengths": content.pulse_lengths,
        "p99_relative_error": origin.accuracy_reached,
        "relative_errors": accuracy_report(&content.accuracy()),
        "grid": origin.grid,
    })
}

/// Relative errors of a table between its grid points, by pulse length, region and field.
pub fn accuracy_report(accuracy: &[Accuracy]) -> Value {
    let fields = |errors: &[Quantiles; 6]| {
        let of = |&Quantiles { p50, p99, max }: &Quantiles| json!({ "p50": p50, "p99": p99, "max": max });
        let named: BTreeMap<_, _> = FIELD_NAMES.into_iter().zip(errors.iter().map(of)).collect();
        json!(named)
    };
    let measured = accuracy.iter().map(|measured| {
        let mut of_length = json!({
            "pulse_length": measured.pulse_length,
            "on_slices": fields(&measured.on_slices),
        });
        if let Some(between) = &measured.between_slices {
            of_length["between_slices"] = fields(between);
        }
        of_length
    });
    measured.collect()
}
