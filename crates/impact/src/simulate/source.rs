//! Where the kernels of the fields come from: computed, or looked up.

use super::{ImpactError, KernelChoice};
use crate::convolve::KernelSource;
use crate::scene::Scene;
use crate::units::KernelUnits;
use halfspace::Medium;
use lookup::{Table, TableFile};
use std::sync::Arc;

/// The source chosen and why.
pub(super) struct Chosen {
    pub(super) source: KernelSource,
    pub(super) reason: String,
}

/// Seconds that one cell of six fields takes when it is computed, on one thread.
const DIRECT_CELL_S: f64 = 8e-6;

/// Computed fields that cost less are not worth a table's error.
const CHEAP_S: f64 = 0.2;

/// Computed fields that cost more are not worth waiting for, whatever a table's error.
const DEAR_S: f64 = 10.0;

/// The source of the fields of a scene; none when it asks for none.
pub(super) fn source(
    scene: &Scene,
    kernels: &KernelChoice,
    medium: &Medium,
    units: &KernelUnits,
    load_end_s: f64,
    pulse_s: f64,
) -> Result<Option<Chosen>, ImpactError> {
    let points = places(scene);
    if points.is_empty() {
        return Ok(None);
    }
    let direct = |reason: String| -> Result<Option<Chosen>, ImpactError> {
        let tolerance = (1e-3 * scene.contact.tolerance).clamp(1e-12, 1e-8);
        Ok(Some(Chosen {
            source: KernelSource::direct(medium, tolerance)?,
            reason,
        }))
    };
    let looked_up = |table: &Arc<Table>, reason: String| {
        Some(Chosen {
            source: KernelSource::Table(Arc::clone(table)),
            reason,
        })
    };
    let radius = units.disc_radius_m;
    let farthest = points.iter().fold([0.0_f64; 2], |far, &(r_m, z_m)| {
        [far[0].max(r_m / radius), far[1].max(z_m / radius)]
    });
    let load = |file: &TableFile| {
        file.part(medium.poisson_ratio(), farthest)
            .map(Arc::new)
            .map_err(|source| ImpactError::Table {
                path: file.path().to_owned(),
                source,
            })
    };
    match kernels {
        KernelChoice::Direct => direct("asked for, or no table is given".to_owned()),
        KernelChoice::Table(file) => Ok(looked_up(&load(file)?, "asked for".to_owned())),
        KernelChoice::Auto(file) => {
            let cells = super::grid::cells(scene, units, medium, load_end_s, pulse_s);
            let count: usize =
                scene.probes.len() + scene.map.map_or(0, |map| map.points[0] * map.points[1]);
            let threads = rayon::current_num_threads() as f64;
            let cost_s = count as f64 * cells * DIRECT_CELL_S / threads;
            let cost =
                format!("{count} points of {cells:.0} cells take about {cost_s:.1e} s to compute");
            if cost_s <= CHEAP_S {
                return direct(format!("{cost}: computed"));
            }
            let table = load(file)?;
            let error = match table_error(&table, medium, units, &points, pulse_s) {
                Err(outside) => return direct(format!("{outside}: computed")),
                Ok(error) => error,
            };
            let tolerance = scene.contact.tolerance;
            if error > tolerance && cost_s <= DEAR_S {
                direct(format!(
                    "{cost}, and the table's error {error:.1e} is above the tolerance {tolerance:.1e}: computed"
                ))
            } else {
                Ok(looked_up(
                    &table,
                    format!("{cost}; the table's error is {error:.1e}: looked up"),
                ))
            }
        }
    }
}

/// All probes and the corners and edges of the map: (r, z) in m.
fn places(scene: &Scene) -> Vec<(f64, f64)> {
    let probes = scene.probes.iter().map(|probe| (probe.r_m, probe.z_m));
    let map = scene.map.iter().flat_map(|map| {
        let at = |i: u32, j: u32| {
            (
                map.r_max_m * f64::from(i) / 4.0,
                map.z_max_m * f64::from(j) / 4.0,
            )
        };
        (0..5).flat_map(move |i| (0..5).map(move |j| at(i, j)))
    });
    probes.chain(map).collect()
}

/// Largest estimated error at some places, over the largest static field of its kind there.
fn table_error(
    table: &Table,
    medium: &Medium,
    units: &KernelUnits,
    places: &[(f64, f64)],
    pulse_s: f64,
) -> Result<f64, lookup::LookupError> {
    let (nu, radius) = (medium.poisson_ratio(), units.disc_radius_m);
    let (mut errors, mut sizes) = ([0.0_f64; 2], [0.0_f64; 2]);
    for &(r_m, z_m) in places {
        let (r, z) = (r_m / radius, z_m / radius);
        let error = table.error(nu, r, z, pulse_s / units.time_s())?;
        let still = table.trace(nu, r, z, 0, &mut [])?.static_part;
        for field in 0..6 {
            // displacements and stresses
            let kind = usize::from(field >= 2);
            errors[kind] = errors[kind].max(error[field]);
            sizes[kind] = sizes[kind].max(still[field].abs());
        }
    }
    let relative = |kind: usize| errors[kind] / sizes[kind].max(f64::MIN_POSITIVE);
    Ok(relative(0).max(relative(1)))
}

/// Name of the kernel in results, with the table's id and format version.
pub(super) fn described(
    chosen: Option<&Chosen>,
) -> (&'static str, String, Option<(String, String)>) {
    match chosen {
        None => ("none", String::new(), None),
        Some(Chosen { source, reason }) => match source {
            KernelSource::Direct(_) => ("direct", reason.clone(), None),
            KernelSource::Table(table) => (
                "table",
                reason.clone(),
                Some((table.id().to_owned(), table.format_version().to_owned())),
            ),
        },
    }
}
