//! Where the kernels of the fields come from: computed, or looked up.

use crate::cost::Cost;
use crate::error::ImpactError;
use crate::evaluator::discs::Discs;
use crate::excitation::Excitation;
use crate::grid::Wanted;
use crate::kernels::{self, KernelSource};
use crate::scene::Scene;
use fault::AnyError;
use lookup::{LookupError, Table};
use std::collections::HashMap;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

/// Something that has kernel tables: one in memory, or a file of which the part that is needed is loaded.
pub trait Tables: fmt::Debug + Send + Sync {
    /// A table for a Poisson's ratio that reaches to r and z in disc radii.
    ///
    /// # Errors
    /// Why it cannot be loaded.
    fn part(&self, poisson_ratio: f64, farthest: [f64; 2]) -> Result<Arc<Table>, AnyError>;

    /// Why there is no such table, as far as that is known without loading one.
    ///
    /// # Errors
    /// Why that cannot be told.
    fn refusal(
        &self,
        _poisson_ratio: f64,
        _farthest: [f64; 2],
    ) -> Result<Option<LookupError>, AnyError> {
        Ok(None)
    }
}

impl Tables for Arc<Table> {
    fn part(&self, _: f64, _: [f64; 2]) -> Result<Arc<Table>, AnyError> {
        Ok(Self::clone(self))
    }
}

#[cfg(feature = "hdf5")]
impl Tables for lookup::TableFile {
    fn part(&self, poisson_ratio: f64, farthest: [f64; 2]) -> Result<Arc<Table>, AnyError> {
        Ok(Arc::new(Self::part(self, poisson_ratio, farthest)?))
    }

    fn refusal(
        &self,
        poisson_ratio: f64,
        farthest: [f64; 2],
    ) -> Result<Option<LookupError>, AnyError> {
        Ok(self.serves(poisson_ratio, farthest)?.err())
    }
}

/// Tables a part of which is loaded once for each Poisson's ratio, as far as it reaches.
///
/// What it gives does not depend on who asked before.
/// A ratio takes the memory of a slice, so that it is for a few of them; [`Arc<Table>`] serves any number.
#[derive(Debug)]
pub struct Shared {
    tables: Arc<dyn Tables>,
    parts: Mutex<HashMap<u64, Part>>,
    fault: Mutex<Option<String>>,
}

/// What is known of a ratio.
type Part = Result<Arc<Table>, LookupError>;

impl Shared {
    /// Of some tables; nothing is loaded yet.
    #[must_use]
    pub fn new(tables: Arc<dyn Tables>) -> Self {
        Self {
            tables,
            parts: Mutex::default(),
            fault: Mutex::default(),
        }
    }

    /// Why a part could not be read, where that has happened: what was computed since may lack it.
    #[must_use]
    pub fn fault(&self) -> Option<String> {
        let fault = self.fault.lock().unwrap_or_else(PoisonError::into_inner);
        fault.clone()
    }

    fn known(&self, poisson_ratio: f64) -> Result<Part, AnyError> {
        let mut parts = self.parts.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(part) = parts.get(&poisson_ratio.to_bits()) {
            return Ok(part.clone());
        }
        let found = self.load(poisson_ratio).map_err(|error| {
            let mut fault = self.fault.lock().unwrap_or_else(PoisonError::into_inner);
            fault.get_or_insert(error.to_string());
            AnyError::from(error.to_string())
        })?;
        parts.insert(poisson_ratio.to_bits(), found.clone());
        Ok(found)
    }

    fn load(&self, poisson_ratio: f64) -> Result<Part, AnyError> {
        if let Some(outside) = self.tables.refusal(poisson_ratio, [0.0; 2])? {
            return Ok(Err(outside));
        }
        let part = self.tables.part(poisson_ratio, [f64::INFINITY; 2])?;
        Ok(Ok(part))
    }
}

impl Tables for Shared {
    fn part(&self, poisson_ratio: f64, _: [f64; 2]) -> Result<Arc<Table>, AnyError> {
        Ok(self.known(poisson_ratio)??)
    }

    fn refusal(&self, poisson_ratio: f64, _: [f64; 2]) -> Result<Option<LookupError>, AnyError> {
        Ok(self.known(poisson_ratio)?.err())
    }
}

/// Which kernels the fields shall have.
#[derive(Debug, Clone)]
pub enum KernelChoice {
    /// Computed for each probe.
    Direct,
    /// A table's.
    Table(Arc<dyn Tables>),
    /// A table's or computed, by the estimated cost and error of both.
    Auto(Arc<dyn Tables>),
    /// A table's where its estimated error is within the tolerance, else computed: what a row of a sweep has depends on
    /// the row alone, not on the threads that share the work.
    Within(Arc<dyn Tables>),
}

/// Computed fields that cost less are not worth a table's error.
const CHEAP_S: f64 = 0.2;

/// Computed fields that cost more are not worth waiting for, whatever a table's error.
const DEAR_S: f64 = 10.0;

/// The source of the fields of a scene and why it is this one; none when it asks for none.
pub(crate) fn choose_source(
    scene: &Scene,
    kernels: &KernelChoice,
    excitation: &Excitation,
) -> Result<Option<(KernelSource, String)>, ImpactError> {
    let points = places(scene);
    if points.is_empty() {
        return Ok(None);
    }
    let (medium, tolerance) = (excitation.medium(), scene.settings.tolerance);
    let direct = |reason: String| -> Result<Option<(KernelSource, String)>, ImpactError> {
        // far away the waves of a slow contact nearly cancel
        let tolerance = (1e-1 * tolerance).clamp(1e-12, 1e-3);
        let source = KernelSource::direct(medium, tolerance)?;
        Ok(Some((source, reason)))
    };
    let looked_up = |table: Arc<Table>, reason: String| Some((KernelSource::Table(table), reason));
    let radius = excitation.units().disc_radius_m;
    let farthest = farthest(&points, radius);
    let load = |tables: &Arc<dyn Tables>| {
        // as far as the smallest disc that stands for the load sees the places
        let smallest = Discs::looked_up(excitation.radius())[0].smallest();
        tables
            .part(medium.poisson_ratio(), farthest.map(|far| far / smallest))
            .map_err(ImpactError::Table)
    };
    let (tables, cost) = match kernels {
        KernelChoice::Direct => return direct("asked for, or no table is given".to_owned()),
        KernelChoice::Table(tables) => return Ok(looked_up(load(tables)?, "asked for".to_owned())),
        KernelChoice::Within(tables) => (tables, None),
        KernelChoice::Auto(tables) => {
            let cells = Wanted::of(scene).cells(excitation);
            let count = scene.points();
            let threads = rayon::current_num_threads() as f64;
            let cost_s = Cost::new(scene, excitation, cells).computed_s() / threads;
            let cost =
                format!("{count} points of {cells:.0} cells take about {cost_s:.1e} s to compute");
            if cost_s <= CHEAP_S {
                return direct(format!("{cost}: computed"));
            }
            (tables, Some((cost, cost_s)))
        }
    };
    let refusal = tables.refusal(medium.poisson_ratio(), farthest);
    if let Some(outside) = refusal.map_err(ImpactError::Table)? {
        return direct(format!("{outside}: computed"));
    }
    let table = load(tables)?;
    let error = match table_error(&table, excitation, &points) {
        Err(outside) => return direct(format!("{outside}: computed")),
        Ok(error) => error,
    };
    let before = |by: &str| {
        let cost = cost.as_ref();
        cost.map_or_else(String::new, |(cost, _)| format!("{cost}{by}"))
    };
    let is_dear = cost.as_ref().is_some_and(|(_, cost_s)| *cost_s > DEAR_S);
    if error > tolerance && !is_dear {
        return direct(format!(
            "{}the table's error {error:.1e} is above the tolerance {tolerance:.1e}: computed",
            before(", and ")
        ));
    }
    let reason = format!(
        "{}the table's error is {error:.1e}: looked up",
        before("; ")
    );
    Ok(looked_up(table, reason))
}

/// All probes and the corners and edges of the section: (r, z) in m.
fn places(scene: &Scene) -> Vec<(f64, f64)> {
    let probes = scene.probes.iter().map(|probe| (probe.r_m, probe.z_m));
    let section = scene.section.iter().flat_map(|section| {
        let at = |i: u32, j: u32| {
            (
                section.r_max_m * f64::from(i) / 4.0,
                section.z_max_m * f64::from(j) / 4.0,
            )
        };
        (0..5).flat_map(move |i| (0..5).map(move |j| at(i, j)))
    });
    probes.chain(section).collect()
}

/// The largest r and z of some places, in radii.
fn farthest(places: &[(f64, f64)], radius: f64) -> [f64; 2] {
    places.iter().fold([0.0_f64; 2], |far, &(r_m, z_m)| {
        [far[0].max(r_m / radius), far[1].max(z_m / radius)]
    })
}

/// Largest estimated error at some places, over the largest static field of its kind there.
fn table_error(
    table: &Table,
    excitation: &Excitation,
    places: &[(f64, f64)],
) -> Result<f64, LookupError> {
    let (nu, units) = (excitation.medium().poisson_ratio(), excitation.units());
    let (mut errors, mut sizes) = ([0.0_f64; 2], [0.0_f64; 2]);
    for &(r_m, z_m) in places {
        let (r, z) = (r_m / units.disc_radius_m, z_m / units.disc_radius_m);
        let error = kernels::table_error(table, nu, [r, z], excitation.pulse(1.0))?;
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
