//! The results of an impact as text.

use contact::{Material, Shape};
use formats::{choices, kernel_name};
use impact::{Cause, Load, Outcome, ProbeFields, RecordResults, Scene, Strike, Treated};

/// The results for people.
pub(crate) fn text_report(scene: &Scene, outcome: &Outcome) -> String {
    let [model, scheme, share, deflection, reason] = choices(scene, outcome);
    let mut lines = vec![
        understood(scene),
        format!("model          {model} ({reason})"),
    ];
    match &outcome.cause {
        Cause::Contact { results, .. } => {
            let mut scheme = format!("scheme         {scheme}");
            if scene.settings.disc_radius_m.is_some() {
                scheme.push_str(&format!(", static share {share}, deflection {deflection}"));
            }
            lines.push(scheme);
            lines.extend(contact_lines(results));
        }
        Cause::Record(results) => {
            let treated = scene.record().and_then(|record| record.treated);
            lines.extend(treated.iter().map(treated_line));
            lines.extend(record_lines(results));
        }
    }
    lines.extend(output_lines(outcome));
    lines.join("\n")
}

/// What is computed, as it was understood.
pub(crate) fn understood(scene: &Scene) -> String {
    let load = match &scene.load {
        Load::Strike(Strike {
            striker,
            velocity_m_s,
        }) => {
            let name = named(&striker.material);
            let body = match striker.shape {
                Some(Shape::Ball { diameter_m }) => {
                    format!("{name}ball of {}", short(diameter_m, "m"))
                }
                Some(Shape::Rod {
                    diameter_m,
                    length_m,
                    ..
                }) => format!(
                    "{name}rod of {} by {}",
                    short(diameter_m, "m"),
                    short(length_m, "m")
                ),
                None => format!("{name}tip of {} radius", short(striker.tip_radius_m, "m")),
            };
            let mass = short(1e3 * striker.mass_kg, "g");
            format!("{body}, {mass}, at {}", short(*velocity_m_s, "m/s"))
        }
        Load::Record(record) => {
            let [from_s, to_s] = record.span_s();
            let radius_m = scene.settings.disc_radius_m.unwrap_or(0.0);
            format!(
                "force of {} samples from {} to {}, over a disc of {} radius",
                record.time_s().len(),
                short(from_s, "s"),
                short(to_s, "s"),
                short(radius_m, "m")
            )
        }
    };
    let target = scene.target.material();
    format!(
        "impact         {load}, on {}E {}, nu {}, {} kg/m3",
        named(target).replace(' ', ": "),
        short(target.youngs_modulus_pa, "Pa"),
        (1e4 * target.poisson_ratio).round() / 1e4,
        (1e2 * scene.target.density_kg_m3()).round() / 1e2
    )
}

/// The name of a material that has one, with a blank.
fn named(material: &Material) -> String {
    match material.name.as_str() {
        "given" => String::new(),
        name => format!("{name} "),
    }
}

fn peak_line(force_n: f64, time_s: f64) -> String {
    format!("peak force     {} at {}", si(force_n, "N"), si(time_s, "s"))
}

fn contact_lines(r: &contact::Results) -> Vec<String> {
    let mut lines = vec![
        peak_line(r.peak_force_n, r.peak_force_time_s),
        format!("contact time   {}", si(r.contact_time_s, "s")),
        format!(
            "rebound        {}, restitution {:.6}",
            si(r.rebound_velocity_m_s, "m/s"),
            r.restitution
        ),
        format!("displacement   {}", si(r.peak_displacement_m, "m")),
        format!("deflection     {}", si(r.peak_deflection_m, "m")),
        format!(
            "radiated       {} of {}; {:.1e} of it unaccounted for",
            si(r.radiated_energy_j, "J"),
            si(r.initial_energy_j, "J"),
            r.energy_residual
        ),
    ];
    let flow = &r.plastic;
    if let (Some(from_m_s), Some(work_j), Some(left_m)) = (
        flow.yield_velocity_m_s,
        flow.plastic_work_j,
        flow.residual_indentation_m,
    ) {
        lines.push(format!(
            "yield          from {} on; {} of plastic work, an indentation of {} remains",
            si(from_m_s, "m/s"),
            si(work_j, "J"),
            si(left_m, "m")
        ));
    }
    let error = r.relative_error_estimate;
    lines.push(format!("error estimate {error:.1e} relative"));
    lines
}

/// What was done to a record.
fn treated_line(done: &Treated) -> String {
    let baseline = done.baseline_s.map(|length_s| {
        format!(
            "baseline {}, the mean of the first {}, taken away",
            si(done.baseline_n, "N"),
            si(length_s, "s")
        )
    });
    let low_pass = done.low_pass_hz.map(|cutoff_hz| {
        format!(
            "low pass at {} (Butterworth, fourth order, forwards and backwards), took away {} rms",
            si(cutoff_hz, "Hz"),
            si(done.removed_rms_n, "N")
        )
    });
    let parts: Vec<String> = baseline.into_iter().chain(low_pass).collect();
    format!("treatment      {}", parts.join("; "))
}

fn record_lines(r: &RecordResults) -> Vec<String> {
    vec![
        peak_line(r.peak_force_n, r.peak_force_time_s),
        format!(
            "pulse          {}, {}",
            si(r.duration_s, "s"),
            si(r.impulse_n_s, "N s")
        ),
        format!("deflection     {}", si(r.peak_deflection_m, "m")),
        format!("radiated       {}", si(r.radiated_energy_j, "J")),
    ]
}

fn output_lines(outcome: &Outcome) -> Vec<String> {
    let time_s = &outcome.series.time_s;
    let probes = outcome.probes.as_ref().map_or(0, |fields| fields.r_m.len());
    let mut lines = vec![format!(
        "output         {} steps of {}, {probes} probe{}, kernel {}",
        time_s.len().saturating_sub(1),
        si(outcome.step_s(), "s"),
        if probes == 1 { "" } else { "s" },
        kernel_name(outcome)
    )];
    if let Some(section) = &outcome.section {
        lines.push(format!(
            "section        {} x {} points, {} frames",
            section.r_m.len(),
            section.z_m.len(),
            section.time_s.len()
        ));
    }
    if let Some(used) = &outcome.used {
        lines.push(format!(
            "fields         {} ({}), {}",
            used.kernel(),
            used.reason,
            used.convolution.name()
        ));
    }
    if let Some(fields) = &outcome.probes {
        lines.push(format!("field errors   {}", field_errors(fields)));
        lines.extend(validity(fields));
    }
    lines
}

/// The largest estimated errors at the probes, over the largest value of their kind at the same probe.
fn field_errors(fields: &ProbeFields) -> String {
    let of = |kind: &str, range: std::ops::Range<usize>| {
        let mut worst = (0.0, 0);
        for probe in 0..fields.r_m.len() {
            let values = fields.values[range.clone()].iter();
            let peak = values
                .flat_map(|rows| &rows[probe])
                .fold(0.0_f64, |m, v| m.max(v.abs()));
            let errors = fields.errors[range.clone()].iter();
            let error = errors.fold(0.0_f64, |m, rows| m.max(rows[probe]));
            if peak > 0.0 && error / peak > worst.0 {
                worst = (error / peak, probe);
            }
        }
        format!(
            "{:.1e} of the largest {kind} at probe {}",
            worst.0,
            worst.1 + 1
        )
    };
    format!(
        "at most {}, {}",
        of("displacement", 0..2),
        of("stress", 2..6)
    )
}

/// When the first echo comes to the probes, where the block has faces.
fn validity(fields: &ProbeFields) -> Option<String> {
    const SHOWN: usize = 4;
    let known = fields.valid_until_s.iter().enumerate();
    let known: Vec<String> = known
        .filter(|(_, valid_s)| valid_s.is_finite())
        .map(|(i, &valid_s)| format!("{} at probe {}", si(valid_s, "s"), i + 1))
        .collect();
    let more = if known.len() > SHOWN { ", ..." } else { "" };
    let shown = known[..known.len().min(SHOWN)].join(", ");
    (!known.is_empty()).then(|| format!("valid until    {shown}{more} (first echo)"))
}

/// A number with seven digits and an SI prefix.
pub(crate) fn si(value: f64, unit: &str) -> String {
    const PREFIXES: [(f64, &str); 8] = [
        (1e9, "G"),
        (1e6, "M"),
        (1e3, "k"),
        (1.0, ""),
        (1e-3, "m"),
        (1e-6, "u"),
        (1e-9, "n"),
        (1e-12, "p"),
    ];
    let size = value.abs();
    if size == 0.0 {
        return format!("0 {unit}");
    }
    match PREFIXES.iter().find(|(scale, _)| size >= *scale) {
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
    match digits.split_once('.') {
        Some(_) if !digits.contains('e') => {
            let digits = digits.trim_end_matches('0').trim_end_matches('.');
            format!("{digits} {unit}")
        }
        _ => long,
    }
}
