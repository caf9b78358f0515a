//! A prescribed force.

use super::contact_run::CLOSED_FORM;
use super::fields::{Load, all_fields};
use super::grid::Grid;
use super::source::{described, source};
use super::strike::surface_deflection;
use super::{Choices, ImpactError, KernelChoice, Outcome, Results, Series};
use crate::convolve::between_samples;
use crate::energy::work;
use crate::march::StaticShare;
use crate::scene::{DEFLECTIONS, PrescribedForce, SHARES, Scene, name_of};
use crate::units::KernelUnits;
use halfspace::{Medium, SurfaceResponse};

/// A prescribed force: no striker, only fields.
pub(super) fn prescribed(
    scene: &Scene,
    force: &PrescribedForce,
    kernels: &KernelChoice,
) -> Result<Outcome, ImpactError> {
    let medium = Medium::new(scene.target.poisson_ratio)?;
    // the reader has made sure that the disc is given
    let disc_radius_m = scene.contact.disc_radius_m.unwrap_or(1.0);
    let nu = scene.target.poisson_ratio;
    let modulus = scene.target.shear_modulus_pa();
    let units = KernelUnits {
        disc_radius_m,
        longitudinal_speed_m_s: (modulus * (2.0 - 2.0 * nu)
            / (1.0 - 2.0 * nu)
            / scene.target_density_kg_m3)
            .sqrt(),
        shear_modulus_pa: modulus,
    };
    let end_s = force.end_s();
    let start_s = force.time_s.first().copied().unwrap_or(0.0);
    let pulse_s = (end_s - start_s).max(f64::MIN_POSITIVE);
    let chosen = source(scene, kernels, &medium, &units, end_s, pulse_s)?;
    let kernel_source = chosen.as_ref().map(|chosen| &chosen.source);
    let grid = Grid::new(scene, kernel_source, &units, &medium, end_s, pulse_s)?;
    let time_s: Vec<f64> = (0..grid.count).map(|i| i as f64 * grid.step_s).collect();
    let force_n: Vec<f64> = time_s.iter().map(|&t| force.at(t)).collect();
    let response = SurfaceResponse::new(&medium, scene.contact.deflection);
    let deflection_m = surface_deflection(scene, &response, &units, &grid, &force_n);
    let load = chosen.as_ref().map(|chosen| Load {
        source: &chosen.source,
        units: &units,
        medium: &medium,
        grid: &grid,
        force_n: &force_n,
        force_error: 0.0,
        between_samples: between_samples(&force_n),
    });
    let (fields, map, convolution) = all_fields(scene, load.as_ref())?;
    let mut notes = Vec::new();
    let gap = force
        .time_s
        .windows(2)
        .map(|t| t[1] - t[0])
        .fold(f64::INFINITY, f64::min);
    if gap < grid.step_s {
        notes.push(format!(
            "samples of the force are as close as {gap:.3e} s, the output step is {:.3e} s: steeper parts are smoothed over a step; give a smaller contact.step_s",
            grid.step_s
        ));
    }
    if force.force_n.iter().any(|&p| p < 0.0) {
        notes.push("the force is negative in places: it pulls there".to_owned());
    }
    let mut peak = (0.0, 0.0);
    let mut impulse_n_s = 0.0;
    for (&t, &p) in force.time_s.iter().zip(&force.force_n) {
        if p > peak.1 {
            peak = (t, p);
        }
    }
    for (t, p) in force.time_s.windows(2).zip(force.force_n.windows(2)) {
        impulse_n_s += 0.5 * (t[1] - t[0]) * (p[0] + p[1]);
    }
    let (kernel, kernel_reason, table) = described(chosen.as_ref());
    Ok(Outcome {
        choices: Choices {
            model: "prescribed",
            scheme: CLOSED_FORM,
            static_share: name_of(&SHARES, StaticShare::Full),
            deflection: name_of(&DEFLECTIONS, scene.contact.deflection),
            reason: "the force is given".to_owned(),
        },
        kernel,
        kernel_reason,
        convolution,
        table,
        march_steps: 0,
        march_step_s: grid.step_s,
        results: Results {
            peak_force_n: peak.1,
            peak_force_time_s: peak.0,
            contact_time_s: pulse_s,
            rebound_velocity_m_s: 0.0,
            restitution: 0.0,
            peak_displacement_m: 0.0,
            peak_deflection_m: deflection_m.iter().copied().fold(0.0, f64::max),
            impulse_n_s,
            initial_energy_j: 0.0,
            radiated_energy_j: joules(&force_n, &deflection_m),
            energy_residual: 0.0,
            contacts: 0,
        },
        series: Series {
            displacement_m: vec![0.0; time_s.len()],
            velocity_m_s: vec![0.0; time_s.len()],
            time_s,
            force_n,
            deflection_m,
        },
        fields,
        map,
        disc_radius_m,
        relative_error_estimate: 0.0,
        warnings: notes,
        resolved_scene: scene.resolved(),
    })
}

/// int P dw in J.
fn joules(force_n: &[f64], deflection_m: &[f64]) -> f64 {
    work(force_n, deflection_m) / 2.5
}
