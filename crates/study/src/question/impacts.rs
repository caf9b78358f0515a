//! Question 4: how to compute the fields of a whole impact at a probe.
//!
//! One value is the contact with its six fields at one point. The error is the largest over time and fields, relative
//! to the peak of each field; the reference is an integral over the past of a force that was solved to 1e-9.

use super::fields;
use super::kernels::POISSON_RATIO;
use crate::measure::{Effort, MeasuredScene, Rows, at};
use crate::method::ComparedMethod;
use crate::record::{Question, peaks};
use crate::scenes::Density;
use contact::Model;
use fault::AnyError;
use halfspace::{FIELDS, Medium, Six};
use impact::convolve::Convolver;
use impact::{Excitation, Impact, KernelSource};
use lookup::Table;
use paper::{RADIUS_M, TABLE_1_PA, coupled, growing};
use std::sync::Arc;

/// An impact and a point.
struct Probed {
    name: &'static str,
    impact: Impact,
    place_m: [f64; 2],
    /// Reference, solved to [`CONVERGED`].
    reference: Excitation,
    /// Peak of each field at the point.
    peaks: Six,
}

/// Tolerance of the force of the reference, and of its fields.
const CONVERGED: f64 = 1e-9;
const FIELDS_CONVERGED: f64 = 1e-8;

/// Measures every method in every scene.
pub(crate) fn measure(effort: Effort, densities: &[Density], advance: &dyn Fn()) -> Rows {
    let own = densities.iter().find(|d| d.is_default(Density::points()));
    let mut records = Vec::new();
    for probed in scenes()? {
        let mut scene = MeasuredScene {
            effort,
            question: Question::Impacts,
            name: probed.name,
            values: 1.0,
            errors: &|found: &Vec<(f64, Six)>| probed.errors(effort, found),
            records: &mut records,
        };
        let tolerances: &[f64] = effort.pick(&[1e-3, 1e-5], &[1e-2, 1e-3, 1e-4, 1e-5, 1e-6]);
        for &tolerance in tolerances {
            let run = || Ok((probed.computed(tolerance)?, None));
            scene
                .add(ComparedMethod::Computed, at(tolerance), run)?
                .default_path = true;
        }
        if probed.impact.settings.model == Model::Wave {
            for halvings in effort.pick(vec![3], vec![1, 3, 5, 7]) {
                let width = 0.5_f64.powi(halvings);
                let run = || Ok((probed.cells_alone(width)?, None));
                scene.add(
                    ComparedMethod::CellsAlone,
                    format!("step {width} r0/c1"),
                    run,
                )?;
            }
        }
        if let Some(density) = own {
            let table = Arc::new(density.with_stencil(Density::points())?);
            let tolerances: &[f64] = effort.pick(&[1e-3], &[1e-2, 1e-3, 1e-4]);
            for &tolerance in tolerances.iter().filter(|_| probed.is_within(&table)) {
                let source = KernelSource::Table(table.clone());
                let run = || Ok((probed.fields(tolerance, source.clone())?, None));
                let row = scene.add(ComparedMethod::LookedUp, at(tolerance), run)?;
                row.default_path = true;
            }
        }
        advance();
    }
    Ok(records)
}

/// A copper rod with a round tip on steel, on a fixed disc and with a contact that grows, near it and far away.
fn scenes() -> Result<Vec<Probed>, AnyError> {
    let (fixed, growing) = (coupled(TABLE_1_PA, RADIUS_M)?, growing()?);
    let scenes = [
        ("fixed disc, near", 100.0, &fixed, [0.004, 0.003]),
        ("fixed disc, far", 100.0, &fixed, [0.08, 0.06]),
        ("growing contact, near", 10.0, &growing, [0.0008, 0.0006]),
        ("growing contact, far", 10.0, &growing, [0.08, 0.06]),
    ];
    let probed = scenes.map(|(name, velocity_m_s, impact, place_m)| {
        let mut impact = impact.clone().to_tolerance(CONVERGED);
        impact.velocity_m_s = velocity_m_s;
        let mut probed = Probed {
            name,
            reference: impact.solve()?.excitation().clone(),
            impact,
            place_m,
            peaks: [0.0; 6],
        };
        let fields = probed.computed(1e-5)?.into_iter().map(|(_, fields)| fields);
        probed.peaks = peaks(&fields.collect::<Vec<_>>());
        Ok(probed)
    });
    probed.into_iter().collect()
}

impl Probed {
    fn is_within(&self, table: &Table) -> bool {
        let radius_m = self.reference.units().disc_radius_m;
        let [r, z] = self.place_m.map(|x| x / radius_m);
        r <= table.content().r_max && z <= table.content().z_max
    }

    /// Fields of the program with kernels computed for the point: times in s, fields in m and Pa.
    fn computed(&self, tolerance: f64) -> Result<Vec<(f64, Six)>, AnyError> {
        let medium = Medium::new(POISSON_RATIO)?;
        // as in the program
        let source = KernelSource::direct(&medium, 0.1 * tolerance)?;
        self.fields(tolerance, source)
    }

    /// Fields of the program with any source of kernels.
    fn fields(&self, tolerance: f64, source: KernelSource) -> Result<Vec<(f64, Six)>, AnyError> {
        let run = self.impact.clone().to_tolerance(tolerance).solve()?;
        let fields = run.excitation().fields_from(source).to_tolerance(tolerance);
        let history = fields.at(self.place_m[0], self.place_m[1])?;
        let at = |n: usize| FIELDS.map(|field| history[field].samples[n]);
        let times = history.time_s.iter().enumerate();
        Ok(times.map(|(n, &time)| (time, at(n))).collect())
    }

    /// Fields from cells of a kernel computed for the point and samples of the force, without integration at the ends
    /// of the contact.
    fn cells_alone(&self, width: f64) -> Result<Vec<(f64, Six)>, AnyError> {
        let run = self.impact.clone().to_tolerance(1e-6).solve()?;
        let excitation = run.excitation();
        let units = *excitation.units();
        let step_s = width * units.time_s();
        let end_s = self.end_s(excitation);
        let count = (end_s / step_s).ceil() as usize;
        let force = (0..count).map(|n| excitation.force_n(n as f64 * step_s));
        let force: Vec<f64> = force.collect();
        let source = KernelSource::direct(excitation.medium(), 1e-8)?;
        let place = self.place_m.map(|x| x / units.disc_radius_m);
        let length = excitation.end_s() / units.time_s();
        let cells = fields::computed(&source, place, (count, width), length, 1e-8)?;
        let found = Convolver::new(&force).fields(&cells.static_part, &cells.smooth);
        let scale = [units.displacement_m_per_n(), units.stress_pa_per_n()];
        let at = |n: usize| std::array::from_fn(|f| scale[usize::from(f >= 2)] * found[f][n]);
        Ok((0..count).map(|n| (n as f64 * step_s, at(n))).collect())
    }

    /// Time in s at which the slowest wave of the contact has passed.
    fn end_s(&self, excitation: &Excitation) -> f64 {
        let arrivals = excitation.arrivals_s(self.place_m);
        let last = arrivals.into_iter().filter(|t| t.is_finite());
        last.fold(0.0, f64::max) + 1.2 * excitation.end_s()
    }

    /// Errors of all fields relative to their peaks, at times from the first arrival on.
    fn errors(&self, effort: Effort, found: &[(f64, Six)]) -> Result<Vec<f64>, AnyError> {
        let count = effort.pick(12, 40);
        let [first, ..] = self.reference.arrivals_s(self.place_m);
        let end = self.end_s(&self.reference);
        let mut errors = Vec::new();
        for i in 0..count {
            // denser after the arrival
            let x = (f64::from(i) + 0.5) / f64::from(count);
            let time = first + (end - first) * x * x;
            let after = found.partition_point(|(t, _)| *t < time);
            let Some((time, fields)) = found.get(after) else {
                continue;
            };
            let reference = &self.reference;
            let exact = reference.instant(self.place_m, *time, FIELDS_CONVERGED)?;
            let exact = exact.unwrap_or([f64::NAN; 6]);
            let error = |f: usize| (fields[f] - exact[f]) / self.peaks[f].max(f64::MIN_POSITIVE);
            errors.push(std::array::from_fn(error));
        }
        Ok(peaks(&errors).to_vec())
    }
}
