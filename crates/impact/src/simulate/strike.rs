//! A striker: its contact, then the series and the fields.

use super::contact_run::{Run, contact_run};
use super::fields::{Load, all_fields};
use super::grid::Grid;
use super::plan::disc_radius_m;
use super::source::{described, source};
use super::{Choices, ImpactError, KernelChoice, Outcome, Results, Series};
use crate::contact::Collision;
use crate::convolve::between_samples;
use crate::energy::Ledger;
use crate::march::{StaticShare, Weights};
use crate::resample::Resampler;
use crate::scene::{DEFLECTIONS, MODELS, Model, SHARES, Scene, Scheme, Striker, name_of};
use crate::units::{CollisionUnits, KernelUnits};
use crate::validity::{Reached, warnings};
use halfspace::{Deflection, Medium, SurfaceResponse};

pub(super) fn strike(
    scene: &Scene,
    striker: &Striker,
    kernels: &KernelChoice,
) -> Result<Outcome, ImpactError> {
    let contact = &scene.contact;
    let collision = Collision::new(scene, striker);
    let units = collision.units();
    let medium = Medium::new(scene.target.poisson_ratio)?;
    let response = SurfaceResponse::new(&medium, contact.deflection);
    let run = contact_run(scene, striker, &collision, &response, &medium)?;
    let fixed = match run.model {
        Model::Growing | Model::Hertz | Model::Radiation => contact.disc_radius_m,
        Model::Wave | Model::QuasiStatic | Model::QuasiStaticRadiation | Model::Auto => {
            Some(disc_radius_m(contact, striker))
        }
    };
    let peak_force_n = run.summary.peak_force * units.force_n;
    let loaded_radius_m = fixed.unwrap_or_else(|| collision.contact_radius_m(peak_force_n));
    let results = scale(&run, &collision, &units);
    let mut notes = warnings(
        scene,
        striker,
        &collision,
        &Reached {
            peak_force_n,
            contact_time_s: results.contact_time_s,
            disc_radius_m: fixed,
            contacts: run.summary.contacts,
            centre_coupling: match (run.model, contact.static_share, contact.deflection) {
                (Model::Wave, StaticShare::Full, Deflection::Centre) => {
                    let disc = disc_radius_m(contact, striker);
                    collision.disc_groups(response.static_compliance(), disc).0
                }
                _ => 0.0,
            },
        },
    );
    let kernel_units = collision.kernel_units(loaded_radius_m);
    let chosen = source(
        scene,
        kernels,
        &medium,
        &kernel_units,
        results.contact_time_s,
        results.contact_time_s,
    )?;
    if fixed.is_none() && chosen.is_some() {
        notes.push(format!(
            "the fields are those of a disc of the largest contact radius, {loaded_radius_m:.3e} m, throughout"
        ));
    }
    let grid = Grid::new(
        scene,
        chosen.as_ref().map(|chosen| &chosen.source),
        &kernel_units,
        &medium,
        results.contact_time_s,
        results.contact_time_s,
    )?;
    let resampler = Resampler::new(&run.history);
    let mut series = Series::default();
    for i in 0..grid.count {
        let time_s = i as f64 * grid.step_s;
        let now = resampler.at(time_s / units.time_s);
        series.time_s.push(time_s);
        series.force_n.push(now.force * units.force_n);
        series
            .displacement_m
            .push(now.displacement * units.length_m);
        series
            .velocity_m_s
            .push(now.velocity * units.velocity_m_s());
        series.deflection_m.push(now.deflection * units.length_m);
    }
    if run.model == Model::Wave && contact.scheme == Scheme::Implicit {
        // Anew on the output's step: the march's own step may be coarser than the disc's memory.
        series.deflection_m =
            surface_deflection(scene, &response, &kernel_units, &grid, &series.force_n);
    }
    let load = chosen.as_ref().map(|chosen| Load {
        source: &chosen.source,
        units: &kernel_units,
        medium: &medium,
        grid: &grid,
        force_n: &series.force_n,
        force_error: run.error,
        between_samples: between_samples(&series.force_n),
    });
    let (fields, map, convolution) = all_fields(scene, load.as_ref())?;
    let (kernel, kernel_reason, table) = described(chosen.as_ref());
    Ok(Outcome {
        choices: Choices {
            model: name_of(&MODELS, run.model),
            scheme: run.scheme,
            static_share: name_of(&SHARES, contact.static_share),
            deflection: name_of(&DEFLECTIONS, contact.deflection),
            reason: run.reason,
        },
        kernel,
        kernel_reason,
        convolution,
        table,
        march_steps: run.steps,
        march_step_s: run.history.step * units.time_s,
        results,
        series,
        fields,
        map,
        disc_radius_m: loaded_radius_m,
        relative_error_estimate: run.error,
        warnings: notes,
        resolved_scene: scene.resolved(),
    })
}

fn scale(run: &Run, collision: &Collision, units: &CollisionUnits) -> Results {
    let s = &run.summary;
    let ledger = Ledger::new(s.restitution, run.radiated);
    Results {
        peak_force_n: s.peak_force * units.force_n,
        peak_force_time_s: s.peak_force_time * units.time_s,
        contact_time_s: s.contact_time * units.time_s,
        rebound_velocity_m_s: s.restitution * collision.velocity_m_s,
        restitution: s.restitution,
        peak_displacement_m: s.peak_displacement * units.length_m,
        peak_deflection_m: s.peak_deflection * units.length_m,
        impulse_n_s: s.impulse * units.force_n * units.time_s,
        initial_energy_j: collision.energy_j(),
        radiated_energy_j: run.radiated * collision.energy_j(),
        energy_residual: ledger.residual,
        contacts: s.contacts,
    }
}

/// Deflection of the disc under a sampled force, with the share that the scene asks for.
pub(super) fn surface_deflection(
    scene: &Scene,
    response: &SurfaceResponse,
    units: &KernelUnits,
    grid: &Grid,
    force_n: &[f64],
) -> Vec<f64> {
    let weights = Weights::new(response, grid.step_s, units.time_s());
    let static_m_per_n = response.static_compliance() * units.displacement_m_per_n();
    let share = scene.contact.static_share.factor();
    (0..force_n.len())
        .map(|n| static_m_per_n * (share * force_n[n] - weights.lagging(&force_n[..=n])))
        .collect()
}
