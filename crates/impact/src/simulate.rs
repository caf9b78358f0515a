//! From a scene to all that it gives: an excitation, then series and fields.

use crate::convolution::Convolution;
use crate::cost::{Allowance, Forecast, busy};
use crate::energy::EnergySeries;
use crate::error::ImpactError;
use crate::excitation::Excitation;
use crate::face::plans;
use crate::fields::faces;
use crate::fields::probes::{SectionFields, at_probes, frames, on_rows};
use crate::fields::sensors::{at_sensors, outside};
use crate::grid::{Grid, Wanted};
use crate::impact::Impact;
use crate::kernels::KernelSource;
use crate::outcome::{Cause, FieldsUsed, Outcome, RecordResults, Series, StrikerSeries, checked};
use crate::record::ForceRecord;
use crate::sampled::convolve::{Method, rises};
use crate::sampled::projection::Projection;
use crate::scene::{Load, Scene, Strike};
use crate::source::{KernelChoice, choose_source};
use contact::{Model, Scheme, StaticShare};
use halfspace::Medium;
use std::ops::Range;

/// Contact radii within which the fields are not those of a yielding block.
const CLOSE: f64 = 2.0;

/// Computes a scene: contact, time series, and fields at its probes and on its section.
///
/// There is no limit on its memory; [`simulate_within`] has one.
///
/// # Errors
/// [`ImpactError`]:
/// - the contact has no solution, or a result is not finite;
/// - the table cannot be loaded, or a point is outside it and `kernels` is [`KernelChoice::Table`];
/// - a point or frame lies outside the domain of the fields, or a force record has no disc or one that is too large;
/// - the output has too many samples.
pub fn simulate(scene: &Scene, kernels: &KernelChoice) -> Result<Outcome, ImpactError> {
    simulate_within(scene, kernels, &Allowance::default())
}

/// Computes a scene within limits of memory and work.
///
/// Both are forecast twice: from the scene alone, before the contact is solved, and again before the fields.
///
/// # Errors
/// As [`simulate`], and [`ImpactError::TooMuchMemory`] or [`ImpactError::GivenUp`] before the long part of the work starts.
pub fn simulate_within(
    scene: &Scene,
    kernels: &KernelChoice,
    allowance: &Allowance<'_>,
) -> Result<Outcome, ImpactError> {
    Forecast::least(scene).check(scene, allowance.memory_bytes)?;
    let outcome = match &scene.load {
        Load::Strike(strike) => of_strike(scene, strike, kernels, allowance)?,
        Load::Record(record) => of_record(scene, record, kernels, allowance)?,
    };
    checked(outcome)
}

/// The fields on some rows of a scene's section, counted from its deepest, by computed kernels: for a caller that divides the
/// section among its own workers. Of all rows they are those of [`simulate()`].
///
/// # Errors
/// [`ImpactError`]; a scene without a striker or without a section has no rows.
pub fn simulate_rows(scene: &Scene, rows: Range<usize>) -> Result<SectionFields, ImpactError> {
    let (Some(strike), Some(section)) = (scene.strike(), &scene.section) else {
        return Err(ImpactError::NoRows);
    };
    let run = Impact::of(scene, strike).solve()?;
    let source = choose_source(scene, &KernelChoice::Direct, run.excitation())?;
    let (source, _) = source.ok_or(ImpactError::NoRows)?;
    let grid = Grid::new(&Wanted::of(scene), run.excitation(), Some(&source))?;
    let time_s: Vec<f64> = grid.times_s().collect();
    let wanted = frames(section, &time_s)?;
    let shown: Vec<usize> = (0..wanted.len()).collect();
    let asked = (&scene.quantities[..], Some(&scene.target));
    let fields = Convolution::new(&source, &grid, &wanted, asked, &|| {})?;
    on_rows(&fields, (section, &shown), rows, false)
}

fn of_strike(
    scene: &Scene,
    strike: &Strike,
    kernels: &KernelChoice,
    allowance: &Allowance<'_>,
) -> Result<Outcome, ImpactError> {
    let impact = Impact::of(scene, strike);
    let medium = Medium::new(scene.target.material().poisson_ratio)?;
    let rayleigh_m_s = medium.rayleigh_speed() * scene.target.longitudinal_speed_m_s();
    Wanted::of(scene).check_step(&impact.collision(), rayleigh_m_s)?;
    let run =
        impact.solve().map_err(
            |error| match contact::doubts(&scene.target, &strike.striker) {
                doubts if doubts.is_empty() => ImpactError::Contact(error),
                doubts => ImpactError::Doubtful { error, doubts },
            },
        )?;
    let excitation = run.excitation();
    let (plan, scheme) = (&run.solved.chosen, run.solved.scheme);
    let cause = Cause::Contact {
        model: plan.model,
        scheme,
        reason: plan.reason(&scene.settings),
        results: run.results,
    };
    let warnings = run.warnings.clone();
    let (grid, mut outcome) = begin(scene, kernels, allowance, excitation, (cause, warnings))?;
    let series = &mut outcome.series;
    let mut striker = StrikerSeries::default();
    for motion in series.time_s.iter().filter_map(|&t| excitation.motion(t)) {
        striker.displacement_m.push(motion.displacement_m);
        striker.velocity_m_s.push(motion.velocity_m_s);
        series.deflection_m.push(motion.deflection_m);
    }
    series.striker = Some(striker);
    series.energy = EnergySeries::of_striker(excitation, plan, &series.time_s);
    if (plan.model, scheme) == (Model::Wave, Some(Scheme::Implicit)) {
        // anew on the output's step: the march's own step may be coarser than the disc's memory
        let (disc, share) = (scene.settings.deflection, scene.settings.static_share);
        series.deflection_m = grid.deflection_m(disc, share, &series.force_n);
    }
    if run.solved.flow.is_some() {
        let beside = scene.beside(CLOSE * run.results.contact_radius_m);
        outcome.warnings.extend(beside);
    }
    Ok(outcome)
}

/// Distance that longitudinal waves travel during a record, relative to the radius of its disc. Below this ratio
/// rounding errors are too large: 2e-4 at this ratio and 4e-2 at a tenth of it.
const CROSSED: f64 = 1e-5;

fn of_record(
    scene: &Scene,
    record: &ForceRecord,
    kernels: &KernelChoice,
    allowance: &Allowance<'_>,
) -> Result<Outcome, ImpactError> {
    let radius_m = scene.settings.disc_radius_m.ok_or(ImpactError::NoDisc)?;
    let excitation = Excitation::of_record(&scene.target, radius_m, record.clone())?;
    let [start_s, end_s] = record.span_s();
    let largest_m = (end_s - start_s) * excitation.units().longitudinal_speed_m_s / CROSSED;
    if radius_m > largest_m {
        return Err(ImpactError::TooWide {
            radius_m,
            largest_m,
        });
    }
    // the results follow from the series
    let cause = Cause::Record(RecordResults::default());
    let (grid, mut outcome) = begin(scene, kernels, allowance, &excitation, (cause, Vec::new()))?;
    let (series, warnings) = (&mut outcome.series, &mut outcome.warnings);
    let (disc, share) = (scene.settings.deflection, StaticShare::Full);
    series.deflection_m = grid.deflection_m(disc, share, &series.force_n);
    let energy = EnergySeries::of_record(&grid, &series.force_n);
    warnings.extend(record.doubts());
    let left_n = left_n(&grid, &series.force_n);
    let relative_error = left_n / record.largest_n().max(f64::MIN_POSITIVE);
    if relative_error > scene.settings.tolerance {
        warnings.push(format!(
            "with the output step of {:.3e} s the force is approximated to {} N, a relative error of {relative_error:.1e}, which the errors of the fields include: use a smaller step_s to reduce it",
            grid.step_s,
            fault::rounded(left_n)
        ));
    }
    warnings.extend(record.lost_before_zero());
    warnings.extend(rates_of_jumps(scene, record, grid.step_s));
    let (peak_force_time_s, peak_force_n) = record.peak();
    outcome.cause = Cause::Record(RecordResults {
        peak_force_n,
        peak_force_time_s,
        duration_s: record.blow_s(),
        relative_error_estimate: relative_error,
        disc_radius_m: radius_m,
        impulse_n_s: record.impulse_n_s(),
        peak_deflection_m: series.deflection_m.iter().copied().fold(0.0, f64::max),
        radiated_energy_j: energy.radiated_at_last_j(),
    });
    series.energy = Some(energy);
    Ok(outcome)
}

/// A sentence where velocities or accelerations are asked for under a jump of the force that counts.
fn rates_of_jumps(scene: &Scene, record: &ForceRecord, step_s: f64) -> Option<String> {
    let jump_n = record.largest_jump_n();
    let counts = scene.rates() > 0 && jump_n > scene.settings.tolerance * record.largest_n();
    counts.then(|| {
        format!(
            "the force jumps by up to {} N: velocities and accelerations are means over the output step of {step_s:.3e} s, and at the wave fronts of the jump they grow without limit as the step decreases",
            fault::rounded(jump_n)
        )
    })
}

/// Output times, force and fields of any excitation.
fn begin<'e>(
    scene: &Scene,
    kernels: &KernelChoice,
    allowance: &Allowance<'_>,
    excitation: &'e Excitation,
    (cause, mut warnings): (Cause, Vec<String>),
) -> Result<(Grid<'e>, Outcome), ImpactError> {
    let planned = |source: Option<&KernelSource>| {
        let grid = Grid::new(&Wanted::of(scene), excitation, source)?;
        let forecast = Forecast::new(scene, &grid, source, busy(scene.points()));
        forecast.check(scene, allowance.memory_bytes)?;
        Ok::<_, ImpactError>((grid, forecast))
    };
    let chosen = choose_source(scene, kernels, excitation)?;
    let source = chosen.as_ref().map(|(source, _)| source);
    let (grid, forecast) = planned(source)?;
    if !(allowance.go_on)(&forecast) {
        let seconds = forecast.seconds;
        return Err(ImpactError::GivenUp { seconds });
    }
    let time_s: Vec<f64> = grid.times_s().collect();
    if excitation.attenuation.is_some() {
        warnings.push(
            "target.quality_factor damps the waves in the block; the contact is that of an elastic block"
                .to_owned(),
        );
    }
    if grid.step_s > grid.wanted_s {
        warnings.push(format!(
                "the output step is {:.3e} s, the width of the table's time cells, although at most {:.3e} s was requested",
                grid.step_s, grid.wanted_s
            ));
    }
    let mut outcome = Outcome {
        cause,
        used: None,
        series: Series {
            force_n: time_s.iter().map(|&t| excitation.force_n(t)).collect(),
            time_s,
            ..Series::default()
        },
        probes: None,
        sensors: Vec::new(),
        section: None,
        warnings,
    };
    if let Some(chosen) = chosen {
        add_fields(scene, allowance, &grid, chosen, &mut outcome)?;
    }
    Ok((grid, outcome))
}

fn add_fields(
    scene: &Scene,
    allowance: &Allowance<'_>,
    grid: &Grid<'_>,
    (source, reason): (KernelSource, String),
    outcome: &mut Outcome,
) -> Result<(), ImpactError> {
    let (asked, watch) = (
        (&scene.quantities[..], Some(&scene.target)),
        allowance.watch,
    );
    let of = |wanted| Convolution::new(&source, grid, wanted, asked, watch);
    let mut method = Method::Direct;
    let all: Vec<usize> = (0..outcome.series.time_s.len()).collect();
    let end_s = outcome.series.time_s.last().copied().unwrap_or(0.0);
    if !scene.probes.is_empty() {
        let fields = of(&all)?;
        let found = at_probes(&fields, &scene.target, (&scene.probes, scene.peaks))?;
        (outcome.warnings).extend(faces::of_probes(scene, &found, end_s));
        outcome.probes = Some(found);
        method = fields.method();
    }
    if !scene.sensors.is_empty() {
        let plans = plans(scene, grid, source.table_reach().is_none());
        let asked = (&scene.measured_rates()[..], Some(&scene.target));
        let fields = Convolution::new(&source, grid, &all, asked, &|| {})?;
        let found = at_sensors(&fields, scene, (&plans, watch))?;
        let warnings = faces::of_sensors(scene, &found, end_s);
        outcome.warnings.extend(warnings);
        outcome.warnings.extend(outside(&found, grid.step_s));
        outcome.sensors = found;
        method = fields.method();
    }
    if let Some(section) = &scene.section {
        let at = frames(section, &outcome.series.time_s)?;
        let (wanted, shown) = match scene.peaks {
            true => (&all, at.clone()),
            false => (&at, (0..at.len()).collect()),
        };
        let fields = of(wanted)?;
        let rows = 0..section.points[1];
        let warnings = faces::of_section(&fields, &scene.target, section, end_s);
        outcome.warnings.extend(warnings);
        outcome.section = Some(on_rows(&fields, (section, &shown), rows, scene.peaks)?);
        method = fields.method();
    }
    let table = match source {
        KernelSource::Direct(_) => None,
        KernelSource::Table(table) => {
            Some([table.id(), &table.content().origin.format_version].map(str::to_owned))
        }
    };
    outcome.used = Some(FieldsUsed {
        table,
        reason,
        convolution: method,
    });
    Ok(())
}

/// The most in N that the cells leave of the force.
fn left_n(grid: &Grid<'_>, force_n: &[f64]) -> f64 {
    let left = grid.continuous(force_n).into_iter().map(|(run, force_n)| {
        let nodes = grid.excitation.cell_nodes(&run, grid.step_s, &force_n);
        let rises = rises(run.base_n, &force_n);
        let projection = Projection::new(&force_n, &rises, &nodes, (0, f64::INFINITY));
        projection.left.most_n
    });
    left.fold(0.0, f64::max)
}
