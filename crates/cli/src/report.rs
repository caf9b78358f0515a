//! The results of an impact as text.

use crate::failure::lines;
use contact::{Choice, Material, Shape};
use formats::{choices, kernel_name};
use impact::{
    Cause, Load, Outcome, ProbeFields, RecordResults, Scene, SectionFields, SensorHistory, Treated,
};
use std::ops::Range;

/// The results as text for people.
pub(crate) fn text_report(scene: &Scene, outcome: &Outcome) -> String {
    let [model, scheme, share, deflection, reason] = choices(scene, outcome);
    let mut told = vec![
        ("impact", understood(scene)),
        ("model", format!("{model} ({reason})")),
    ];
    match &outcome.cause {
        Cause::Contact { results, .. } => {
            let mut scheme = scheme.to_owned();
            if scene.settings.disc_radius_m.is_some() {
                scheme += &format!(", static share {share}, deflection {deflection}");
            }
            told.push(("scheme", scheme));
            told.extend(of_contact(results));
        }
        Cause::Record(results) => {
            let treated = scene.record().and_then(|record| record.treated);
            told.extend(treated.map(|done| ("treatment", treatment(&done))));
            told.extend(of_record(results));
        }
    }
    told.extend(of_output(outcome));
    lines(told)
}

/// The impact as the program understood it.
pub(crate) fn understood(scene: &Scene) -> String {
    let metres = |length_m| short(length_m, "m");
    let load = match &scene.load {
        Load::Strike(strike) => {
            let striker = &strike.striker;
            let name = named(&striker.material);
            let body = match striker.shape {
                Some(Shape::Ball { diameter_m }) => format!("ball of {}", metres(diameter_m)),
                Some(Shape::Rod {
                    diameter_m,
                    length_m,
                    ..
                }) => format!("rod of {} by {}", metres(diameter_m), metres(length_m)),
                None => format!("tip of {} radius", metres(striker.tip_radius_m)),
            };
            let mass = short(1e3 * striker.mass_kg, "g");
            let velocity = short(strike.velocity_m_s, "m/s");
            format!("{name}{body}, {mass}, at {velocity}")
        }
        Load::Record(record) => {
            let [from, to] = record.span_s().map(|time_s| short(time_s, "s"));
            let count = record.time_s().len();
            let radius = metres(scene.settings.disc_radius_m.unwrap_or(0.0));
            format!("force of {count} samples from {from} to {to}, over a disc of {radius} radius")
        }
    };
    let target = scene.target.material();
    format!(
        "{load}, on {}E {}, nu {}, {} kg/m3",
        named(target).replace(' ', ": "),
        short(target.youngs_modulus_pa, "Pa"),
        (1e4 * target.poisson_ratio).round() / 1e4,
        (1e2 * scene.target.density_kg_m3()).round() / 1e2
    )
}

/// The name of a material followed by a blank, if it has a name.
fn named(material: &Material) -> String {
    match material.name.as_str() {
        "given" => String::new(),
        name => format!("{name} "),
    }
}

fn peak(force_n: f64, time_s: f64) -> (&'static str, String) {
    let at = format!("{} at {}", si(force_n, "N"), si(time_s, "s"));
    ("peak force", at)
}

fn of_contact(r: &contact::Results) -> Vec<(&'static str, String)> {
    let rebound = si(r.rebound_velocity_m_s, "m/s");
    let rebound = format!("{rebound}, restitution {:.6}", r.restitution);
    let energies = [r.radiated_energy_j, r.initial_energy_j];
    let ([radiated, initial], missing) = (energies.map(|x| si(x, "J")), r.energy_residual);
    let radiated = format!("{radiated} of {initial}; {missing:.1e} of it unaccounted for");
    let mut told = vec![
        peak(r.peak_force_n, r.peak_force_time_s),
        ("contact time", si(r.contact_time_s, "s")),
        ("rebound", rebound),
        ("displacement", si(r.peak_displacement_m, "m")),
        ("deflection", si(r.peak_deflection_m, "m")),
        ("radiated", radiated),
    ];
    let flow = &r.plastic;
    let flowed = || {
        Some(format!(
            "onset at {}; plastic work {}, residual indentation {}",
            si(flow.yield_velocity_m_s?, "m/s"),
            si(flow.plastic_work_j?, "J"),
            si(flow.residual_indentation_m?, "m")
        ))
    };
    told.extend(flowed().map(|flowed| ("yield", flowed)));
    let error = r.relative_error_estimate;
    told.push(("error estimate", format!("{error:.1e} relative")));
    told
}

/// The treatment of a force record.
fn treatment(done: &Treated) -> String {
    let baseline = done.baseline_s.map(|length_s| {
        let (mean, length) = (si(done.baseline_n, "N"), si(length_s, "s"));
        format!("baseline {mean}, the mean of the first {length}, removed")
    });
    let low_pass = done.low_pass_hz.map(|cutoff_hz| {
        let (cutoff, rms) = (si(cutoff_hz, "Hz"), si(done.removed_rms_n, "N"));
        format!(
            "low pass at {cutoff} (Butterworth, fourth order, forwards and backwards), removed {rms} rms"
        )
    });
    let parts: Vec<String> = baseline.into_iter().chain(low_pass).collect();
    parts.join("; ")
}

fn of_record(r: &RecordResults) -> [(&'static str, String); 4] {
    let [duration, impulse] = [si(r.duration_s, "s"), si(r.impulse_n_s, "N s")];
    [
        peak(r.peak_force_n, r.peak_force_time_s),
        ("pulse", format!("{duration}, {impulse}")),
        ("deflection", si(r.peak_deflection_m, "m")),
        ("radiated", si(r.radiated_energy_j, "J")),
    ]
}

fn of_output(outcome: &Outcome) -> Vec<(&'static str, String)> {
    let probes = outcome.probes.as_ref().map_or(0, |fields| fields.r_m.len());
    let written = format!(
        "{} steps of {}, {probes} probe{}, kernel {}",
        outcome.series.time_s.len().saturating_sub(1),
        si(outcome.step_s(), "s"),
        if probes == 1 { "" } else { "s" },
        kernel_name(outcome)
    );
    let mut told = vec![("output", written)];
    if let Some(section) = &outcome.section {
        let scales = [&section.r_m, &section.z_m, &section.time_s];
        let [r, z, frames] = scales.map(Vec::len);
        told.push(("section", format!("{r} x {z} points, {frames} frames")));
        told.push(("section errors", section_errors(section)));
    }
    if let Some(used) = &outcome.used {
        let (kernel, convolution) = (used.kernel(), used.convolution.name());
        let how = format!("{kernel} ({}), {convolution}", used.reason);
        told.push(("fields", how));
    }
    if let Some(fields) = &outcome.probes {
        told.push(("field errors", field_errors(fields)));
        told.extend(validity(fields).map(|until| ("valid until", until)));
    }
    told.extend(outcome.sensors.iter().map(|own| ("sensor", of_sensor(own))));
    told
}

/// Peak of a sensor's output with its error.
fn of_sensor(own: &SensorHistory) -> String {
    let larger = |most: f64, x: &f64| if x.abs() > most.abs() { *x } else { most };
    let [peak, error] = [&own.output, &own.output_error].map(|all| all.iter().fold(0.0, larger));
    let unit = own.sensor.output_unit();
    format!(
        "{} at r = {}, z = {}: peak {}, error up to {}",
        own.sensor.measured.name(),
        short(own.sensor.r_m, "m"),
        short(own.sensor.z_m, "m"),
        short(peak, unit),
        short(error, unit)
    )
}

/// The largest estimated errors at the probes, relative to the largest value of the same kind at the same probe.
fn field_errors(fields: &ProbeFields) -> String {
    let peak = |field: usize, probe: usize| {
        let samples = fields.values[field][probe].iter();
        samples.fold(0.0_f64, |m, v| m.max(v.abs()))
    };
    let of = |kind: &str, range: Range<usize>| {
        let ratios = ratios(range, fields.r_m.len(), &fields.errors, peak);
        let (error, probe) = ratios.last().copied().unwrap_or_default();
        format!("{error:.1e} of the largest {kind} at probe {}", probe + 1)
    };
    let [displacement, stress] = [of("displacement", 0..2), of("stress", 2..6)];
    format!("at most {displacement}, {stress}")
}

/// The median and the largest estimated error on a section, relative to the largest value of the same kind at the same
/// point. Largest values are over all samples if these were recorded, over the frames otherwise.
fn section_errors(fields: &SectionFields) -> String {
    let (width, size) = (fields.r_m.len(), fields.r_m.len() * fields.z_m.len());
    let peak = |field: usize, place: usize| match &fields.peaks {
        Some(peaks) => peaks[field].values[place].abs(),
        None => {
            let frames = fields.values[field].iter().skip(place).step_by(size);
            f64::from(frames.fold(0.0_f32, |m, v| m.max(v.abs())))
        }
    };
    let of = |kind: &str, range: Range<usize>| {
        let ratios = ratios(range, size, &fields.errors, peak);
        let middle = ratios.get(ratios.len() / 2).copied().unwrap_or_default();
        let (error, place) = ratios.last().copied().unwrap_or_default();
        let [r, z] = [fields.r_m[place % width], fields.z_m[place / width]].map(|x| short(x, "m"));
        format!(
            "{:.1e} of the largest {kind} at half of the points, at most {error:.1e} at r = {r}, z = {z}",
            middle.0
        )
    };
    let [displacement, stress] = [of("displacement", 0..2), of("stress", 2..6)];
    format!("{displacement}; {stress}")
}

/// The largest error of some fields relative to their largest value at each place, with the number of the place, in
/// ascending order. Places where the fields vanish are left out.
fn ratios(
    fields: Range<usize>,
    places: usize,
    errors: &[Vec<f64>],
    peak: impl Fn(usize, usize) -> f64,
) -> Vec<(f64, usize)> {
    let of = |place: usize| {
        let largest = |of: &dyn Fn(usize) -> f64| fields.clone().map(of).fold(0.0, f64::max);
        let peak = largest(&|field| peak(field, place));
        let error = largest(&|field| errors[field][place]);
        (peak > 0.0).then_some((error / peak, place))
    };
    let mut found: Vec<_> = (0..places).filter_map(of).collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found
}

/// Arrival of the first echo at the probes, if the block has finite dimensions.
fn validity(fields: &ProbeFields) -> Option<String> {
    const SHOWN: usize = 4;
    let known = fields.valid_until_s.iter().enumerate();
    let known: Vec<String> = known
        .filter(|(_, valid_s)| valid_s.is_finite())
        .map(|(i, &valid_s)| format!("{} at probe {}", si(valid_s, "s"), i + 1))
        .collect();
    let more = if known.len() > SHOWN { ", ..." } else { "" };
    let shown = known[..known.len().min(SHOWN)].join(", ");
    let what = match fields.echoes.names.is_empty() {
        true => "first echo",
        false => "first echo that is left out",
    };
    (!known.is_empty()).then(|| format!("{shown}{more} ({what})"))
}

/// A number with seven digits and an SI prefix.
pub(crate) fn si(value: f64, unit: &str) -> String {
    /// From 1e9 down in factors of 1000.
    const PREFIXES: [&str; 8] = ["G", "M", "k", "", "m", "u", "n", "p"];
    let size = value.abs();
    if size == 0.0 {
        return format!("0 {unit}");
    }
    let scales = (-4..=3).rev().map(|power| 1e3_f64.powi(power));
    let mut scales = scales.zip(PREFIXES);
    match scales.find(|(scale, _)| size >= *scale) {
        Some((scale, prefix)) if size < 1e12 => {
            let scaled = value / scale;
            let decimals = 6 - (scaled.abs().log10() as usize).min(2);
            format!("{scaled:.decimals$} {prefix}{unit}")
        }
        Some(_) | None => format!("{value:.6e} {unit}"),
    }
}

/// A number with four digits at most and an SI prefix.
pub(crate) fn short(value: f64, unit: &str) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    let long = si(rounded, unit);
    let (digits, unit) = long.split_once(' ').unwrap_or((&long, ""));
    if !digits.contains('.') || digits.contains('e') {
        return long;
    }
    let digits = digits.trim_end_matches('0').trim_end_matches('.');
    format!("{digits} {unit}")
}
