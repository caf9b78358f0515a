//! The results of an impact for people and for machines.

use impact::Outcome;
use serde::Serialize;

/// The JSON object of `impact --json`.
#[derive(Debug, Serialize)]
pub(crate) struct Report<'a> {
    model: &'a str,
    scheme: &'a str,
    static_share: &'a str,
    deflection: &'a str,
    reason: &'a str,
    kernel: &'a str,
    kernel_reason: &'a str,
    convolution: &'a str,
    table_id: Option<&'a str>,
    steps: usize,
    step_s: f64,
    march_steps: usize,
    march_step_s: f64,
    peak_force_n: f64,
    peak_force_time_s: f64,
    contact_time_s: f64,
    contacts: usize,
    rebound_velocity_m_s: f64,
    restitution: f64,
    peak_displacement_m: f64,
    peak_deflection_m: f64,
    impulse_n_s: f64,
    initial_energy_j: f64,
    radiated_energy_j: f64,
    energy_residual: f64,
    disc_radius_m: f64,
    relative_error_estimate: f64,
    probes: usize,
    map: Option<[usize; 3]>,
    wall_s: f64,
    warnings: &'a [String],
}

impl<'a> Report<'a> {
    pub(crate) fn new(outcome: &'a Outcome, wall_s: f64) -> Self {
        let (choices, r) = (&outcome.choices, &outcome.results);
        let time = &outcome.series.time_s;
        Self {
            model: choices.model,
            scheme: choices.scheme,
            static_share: choices.static_share,
            deflection: choices.deflection,
            reason: &choices.reason,
            kernel: outcome.kernel,
            kernel_reason: &outcome.kernel_reason,
            convolution: outcome.convolution,
            table_id: outcome.table.as_ref().map(|(id, _)| id.as_str()),
            steps: time.len().saturating_sub(1),
            step_s: time.get(1).copied().unwrap_or(0.0),
            march_steps: outcome.march_steps,
            march_step_s: outcome.march_step_s,
            peak_force_n: r.peak_force_n,
            peak_force_time_s: r.peak_force_time_s,
            contact_time_s: r.contact_time_s,
            contacts: r.contacts,
            rebound_velocity_m_s: r.rebound_velocity_m_s,
            restitution: r.restitution,
            peak_displacement_m: r.peak_displacement_m,
            peak_deflection_m: r.peak_deflection_m,
            impulse_n_s: r.impulse_n_s,
            initial_energy_j: r.initial_energy_j,
            radiated_energy_j: r.radiated_energy_j,
            energy_residual: r.energy_residual,
            disc_radius_m: outcome.disc_radius_m,
            relative_error_estimate: outcome.relative_error_estimate,
            probes: outcome.fields.as_ref().map_or(0, |f| f.r_m.len()),
            map: outcome
                .map
                .as_ref()
                .map(|m| [m.time_s.len(), m.z_m.len(), m.r_m.len()]),
            wall_s,
            warnings: &outcome.warnings,
        }
    }

    /// The same as text.
    pub(crate) fn text(&self) -> String {
        let mut lines = vec![format!("model          {} ({})", self.model, self.reason)];
        if self.model != "prescribed" {
            lines.push(format!(
                "scheme         {}, {} share, {} deflection",
                self.scheme, self.static_share, self.deflection
            ));
        }
        lines.push(format!(
            "peak force     {} at {}",
            si(self.peak_force_n, "N"),
            si(self.peak_force_time_s, "s")
        ));
        if self.model == "prescribed" {
            lines.push(format!(
                "pulse          {}, {}",
                si(self.contact_time_s, "s"),
                si(self.impulse_n_s, "N s")
            ));
        } else {
            lines.push(format!("contact time   {}", si(self.contact_time_s, "s")));
            lines.push(format!(
                "rebound        {}, restitution {:.6}",
                si(self.rebound_velocity_m_s, "m/s"),
                self.restitution
            ));
            lines.push(format!(
                "displacement   {}",
                si(self.peak_displacement_m, "m")
            ));
        }
        lines.push(format!(
            "deflection     {}",
            si(self.peak_deflection_m, "m")
        ));
        if self.model == "prescribed" {
            lines.push(format!(
                "radiated       {}",
                si(self.radiated_energy_j, "J")
            ));
        } else {
            lines.push(format!(
                "radiated       {} of {}, ledger residual {:.1e}",
                si(self.radiated_energy_j, "J"),
                si(self.initial_energy_j, "J"),
                self.energy_residual
            ));
            lines.push(format!(
                "error estimate {:.1e} relative",
                self.relative_error_estimate
            ));
        }
        lines.push(format!(
            "output         {} steps of {}, {} probe{}, kernel {}",
            self.steps,
            si(self.step_s, "s"),
            self.probes,
            if self.probes == 1 { "" } else { "s" },
            self.kernel
        ));
        if let Some([frames, deep, wide]) = self.map {
            lines.push(format!(
                "section        {wide} x {deep} points, {frames} frames"
            ));
        }
        if self.kernel != "none" {
            lines.push(format!(
                "fields         {} ({}), {}",
                self.kernel, self.kernel_reason, self.convolution
            ));
        }
        lines.join("\n")
    }
}

/// A number with seven digits and an SI prefix.
fn si(value: f64, unit: &str) -> String {
    const PREFIXES: [(f64, &str); 7] = [
        (1e9, "G"),
        (1e6, "M"),
        (1e3, "k"),
        (1.0, ""),
        (1e-3, "m"),
        (1e-6, "u"),
        (1e-9, "n"),
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
