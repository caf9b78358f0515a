//! From a scene to all that it gives: an excitation, then series and fields.

use crate::cost::forecast::{Allowance, Forecast, TooMuch};
use crate::energy::EnergySeries;
use crate::error::FieldsError;
use crate::evaluator::convolve::{Method, rises};
use crate::evaluator::projection::Projection;
use crate::evaluator::{self, Evaluator};
use crate::excitation::Excitation;
use crate::fields::probes::{ProbeFields, SectionFields, at_probes, frames, on_section};
use crate::finite::{NotFinite, checked};
use crate::grid::{Grid, TooManySamples, Wanted};
use crate::impact::Impact;
use crate::kernels::KernelSource;
use crate::kernels::place::FieldError;
use crate::kernels::source::{Chosen, KernelChoice, SourceError, TableFault, choose_source};
use crate::outcome::{
    Cause, FieldsUsed, KernelsUsed, Outcome, RecordResults, Series, StrikerSeries,
};
use crate::record::ForceRecord;
use crate::record::plausible::doubts;
use crate::scene::{Load, Scene, Strike};
use crate::watch::Watch;
use contact::{Collision, ContactError, Model, Scheme, StaticShare};
use fault::{Class, Culprit, Fault};
use halfspace::{Deflection, DomainError};
use thiserror::Error;

/// Why a scene could not be computed.
#[derive(Debug, Error)]
pub enum ImpactError {
    /// The contact failed.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// The contact failed, between bodies whose numbers hint at slips.
    #[error("{error}; {}", doubts.join("; "))]
    Doubtful {
        /// Why the contact failed.
        error: ContactError,
        /// What hints at slips.
        doubts: Vec<String>,
    },
    /// The kernels could not be had.
    #[error(transparent)]
    Source(#[from] SourceError),
    /// A field failed.
    #[error(transparent)]
    Fields(#[from] FieldsError),
    /// More samples than memory should hold.
    #[error(transparent)]
    TooManySamples(#[from] TooManySamples),
    /// More memory or work than there is.
    #[error(transparent)]
    TooMuch(#[from] TooMuch),
    /// A result that is no number.
    #[error(transparent)]
    NotFinite(#[from] NotFinite),
    /// A number is outside the physics.
    #[error(transparent)]
    Domain(#[from] DomainError),
    /// A record without the disc that it loads.
    #[error("a force record needs the radius of the disc that it loads: set disc_radius_m")]
    NoDisc,
    /// A disc so large beside the record that only rounding would be left.
    #[error(
        "disc_radius_m = {radius_m} is outside (0, {largest_m:.3e}]: waves cross too little of a larger disc while the record lasts"
    )]
    TooWide {
        /// Radius of the disc in m.
        radius_m: f64,
        /// The largest for this record in m.
        largest_m: f64,
    },
}

impl Fault for ImpactError {
    fn culprit(&self) -> Culprit<'_> {
        use contact::MarchError as M;
        let culprit = Culprit::of(Class::Impact);
        let contact = match self {
            Self::Contact(error) | Self::Doubtful { error, .. } => Some(error),
            _ => None,
        };
        match contact {
            Some(ContactError::March(
                M::NoSolution { .. }
                | M::TooLong { .. }
                | M::NotConverged { .. }
                | M::Unstable { .. },
            )) => return culprit.unmendable(),
            Some(ContactError::TooFast { velocity_m_s, .. }) => {
                return culprit.key("velocity_m_s").number(*velocity_m_s);
            }
            Some(ContactError::OutOfRange { quantity, value }) => {
                return culprit.key(quantity).number(*value).range("[1e-30, 1e30]");
            }
            _ => {}
        }
        match self {
            Self::Fields(FieldsError::Field(FieldError::Table { source, .. })) => source.culprit(),
            Self::Fields(FieldsError::Field(FieldError::Domain { source, .. }))
            | Self::Fields(FieldsError::Domain(source))
            | Self::Source(SourceError::Domain(source))
            | Self::Domain(source) => source.culprit(),
            Self::Source(SourceError::Table(fault)) => of_table(fault),
            Self::TooMuch(TooMuch::Memory(_)) => Culprit::of(Class::Memory),
            Self::Contact(_)
            | Self::Doubtful { .. }
            | Self::Fields(FieldsError::TooManySamples(_))
            | Self::TooManySamples(_)
            | Self::TooMuch(_)
            | Self::NotFinite(_) => culprit,
            Self::NoDisc => culprit.key("disc_radius_m"),
            Self::TooWide {
                radius_m,
                largest_m,
            } => Culprit {
                limits: Some([0.0, *largest_m]),
                ..culprit.key("disc_radius_m").number(*radius_m)
            },
        }
    }
}

/// A table that could not be loaded is something to change, whatever is wrong with it.
#[cfg_attr(not(feature = "hdf5"), allow(unused_variables))]
fn of_table(fault: &TableFault) -> Culprit<'_> {
    let culprit = Culprit::of(Class::Table);
    #[cfg(feature = "hdf5")]
    if let Some(lookup::TableError { path, .. }) = fault.downcast_ref() {
        return culprit.file(path);
    }
    culprit
}

/// Contact radii within which the fields are not those of a yielding block.
const CLOSE: f64 = 2.0;

/// Computes a scene.
pub fn simulate(scene: &Scene, kernels: &KernelChoice) -> Result<Outcome, ImpactError> {
    simulate_within(scene, kernels, &Allowance::default())
}

/// [`simulate`], telling `watch` how far the fields are.
pub fn simulate_watched(
    scene: &Scene,
    kernels: &KernelChoice,
    watch: &dyn Watch,
) -> Result<Outcome, ImpactError> {
    let allowance = Allowance {
        watch,
        ..Allowance::default()
    };
    simulate_within(scene, kernels, &allowance)
}

/// Computes a scene that takes no more than it may.
///
/// What it takes is forecast twice: from the scene alone, before the contact is solved, and before the fields.
///
/// # Errors
/// [`ImpactError`], [`ImpactError::TooMuch`] before anything long is begun.
pub fn simulate_within(
    scene: &Scene,
    kernels: &KernelChoice,
    allowance: &Allowance<'_>,
) -> Result<Outcome, ImpactError> {
    Forecast::least(scene)
        .check(scene, allowance.memory_bytes)
        .map_err(TooMuch::Memory)?;
    let asked = Asked {
        scene,
        kernels,
        allowance,
    };
    let outcome = match &scene.load {
        Load::Strike(strike) => of_strike(scene, strike, asked)?,
        Load::Record(record) => of_record(scene, record, asked)?,
    };
    Ok(checked(outcome)?)
}

/// The fields that are asked for, from which kernels, what they may take and who is told of them.
#[derive(Clone, Copy)]
struct Asked<'a> {
    scene: &'a Scene,
    kernels: &'a KernelChoice,
    allowance: &'a Allowance<'a>,
}

fn of_strike(scene: &Scene, strike: &Strike, asked: Asked<'_>) -> Result<Outcome, ImpactError> {
    let impact = Impact {
        half_space: scene.target.clone(),
        striker: strike.striker.clone(),
        velocity_m_s: strike.velocity_m_s,
        settings: scene.settings,
    };
    let run =
        impact.solve().map_err(
            |error| match contact::doubts(&scene.target, &strike.striker) {
                doubts if doubts.is_empty() => ImpactError::Contact(error),
                doubts => ImpactError::Doubtful { error, doubts },
            },
        )?;
    let excitation = run.excitation();
    let computed = Computed::new(asked, excitation)?;
    let marched = (run.solved.plan.model, run.solved.scheme);
    let mut deflection_m = None;
    if marched == (Model::Wave, Some(Scheme::Implicit)) {
        // Anew on the output's step: the march's own step may be coarser than the disc's memory.
        let settings = &scene.settings;
        deflection_m = Some(computed.disc_deflection_m(settings.deflection, settings.static_share));
    }
    let mut striker = StrikerSeries::default();
    let mut law_m = Vec::new();
    for &time_s in &computed.time_s {
        if let Some(motion) = excitation.motion(time_s) {
            striker.displacement_m.push(motion.displacement_m);
            striker.velocity_m_s.push(motion.velocity_m_s);
            law_m.push(motion.deflection_m);
        }
    }
    let mut warnings = run.warnings.clone();
    warnings.extend(computed.warnings());
    if run.solved.flow.is_some() {
        warnings.extend(scene.beside(CLOSE * run.results.contact_radius_m));
    }
    let cause = Cause::Contact {
        model: run.solved.plan.model,
        scheme: run.solved.scheme,
        reason: run.solved.plan.reason(&scene.settings),
        results: run.results,
    };
    let collision = Collision::new(&scene.target, &strike.striker, strike.velocity_m_s);
    let plan = &run.solved.plan;
    let energy = EnergySeries::of_striker(excitation, &collision, plan, &computed.time_s);
    Ok(computed.outcome(
        cause,
        deflection_m.unwrap_or(law_m),
        (Some(striker), energy),
        warnings,
    ))
}

/// What longitudinal waves have to cross of a disc while a record lasts, over its radius: less of it is lost in rounding,
/// by 2e-4 at this and by 4e-2 at a tenth of it.
const CROSSED: f64 = 1e-5;

fn of_record(
    scene: &Scene,
    record: &ForceRecord,
    asked: Asked<'_>,
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
    let computed = Computed::new(asked, &excitation)?;
    let deflection_m = computed.disc_deflection_m(scene.settings.deflection, StaticShare::Full);
    let energy = EnergySeries::of_record(&excitation, &computed.grid, &computed.force_n);
    let mut warnings = computed.warnings();
    warnings.extend(doubts(record));
    let left_n = computed.left_n();
    let relative_error = left_n / record.largest_n().max(f64::MIN_POSITIVE);
    if relative_error > scene.settings.tolerance {
        warnings.push(format!(
            "on the output's step of {:.3e} s, the cells miss the force by up to {left_n:.3e} N, {relative_error:.1e} of its largest: the errors of the fields count it, a smaller step_s lowers it",
            computed.grid.step_s
        ));
    }
    warnings.extend(record.lost_before_zero());
    if record.force_n().iter().any(|&p| p < 0.0) {
        warnings.push("the force is negative in places: it pulls there".to_owned());
    }
    let (peak_force_time_s, peak_force_n) = record.peak();
    let cause = Cause::Record(RecordResults {
        peak_force_n,
        peak_force_time_s,
        duration_s: record.span_s()[1] - record.span_s()[0],
        relative_error_estimate: relative_error,
        disc_radius_m: radius_m,
        impulse_n_s: record.impulse_n_s(),
        peak_deflection_m: deflection_m.iter().copied().fold(0.0, f64::max),
        radiated_energy_j: energy.radiated_at_last_j(),
    });
    Ok(computed.outcome(cause, deflection_m, (None, Some(energy)), warnings))
}

/// What follows from an excitation, whatever has caused it.
struct Computed<'a> {
    excitation: &'a Excitation,
    grid: Grid,
    time_s: Vec<f64>,
    force_n: Vec<f64>,
    used: Option<FieldsUsed>,
    probes: Option<ProbeFields>,
    section: Option<SectionFields>,
}

impl<'a> Computed<'a> {
    fn new(asked: Asked<'_>, excitation: &'a Excitation) -> Result<Self, ImpactError> {
        let Asked {
            scene, allowance, ..
        } = asked;
        let chosen = choose_source(scene, asked.kernels, excitation)?;
        let source = chosen.as_ref().map(|chosen| &chosen.source);
        let grid = Grid::new(&Wanted::of(scene), excitation, source)?;
        let forecast = Forecast::new(
            scene,
            excitation,
            &grid,
            source,
            rayon::current_num_threads(),
        )?;
        forecast
            .check(scene, allowance.memory_bytes)
            .map_err(TooMuch::Memory)?;
        if !(allowance.go_on)(&forecast) {
            let seconds = forecast.seconds;
            return Err(TooMuch::GivenUp { seconds }.into());
        }
        let time_s: Vec<f64> = grid.times_s().collect();
        let force_n = time_s.iter().map(|&t| excitation.force_n(t)).collect();
        let mut computed = Self {
            excitation,
            grid,
            time_s,
            force_n,
            used: None,
            probes: None,
            section: None,
        };
        if let Some(chosen) = chosen {
            computed.add_fields(asked, chosen)?;
        }
        Ok(computed)
    }

    fn add_fields(&mut self, asked: Asked<'_>, chosen: Chosen) -> Result<(), FieldsError> {
        let Chosen { source, reason } = chosen;
        let scene = asked.scene;
        asked.allowance.watch.points(scene.points());
        let material = scene.target.material();
        let evaluator = |wanted| {
            Evaluator::new(evaluator::Asked {
                excitation: self.excitation,
                source: &source,
                grid: &self.grid,
                wanted,
                quantities: &scene.quantities,
                elastic: [material.youngs_modulus_pa, material.poisson_ratio],
                tolerance: scene.settings.tolerance,
                watch: asked.allowance.watch,
            })
        };
        let mut convolution = Method::Direct;
        let all: Vec<usize> = (0..self.force_n.len()).collect();
        if !scene.probes.is_empty() {
            let evaluator = evaluator(&all)?;
            self.probes = Some(at_probes(&evaluator, &scene.target, &scene.probes)?);
            convolution = evaluator.method();
        }
        if let Some(section) = &scene.section {
            let at = frames(section, self.force_n.len());
            let (wanted, shown) = if scene.peaks {
                (&all, at.clone())
            } else {
                (&at, (0..at.len()).collect())
            };
            let evaluator = evaluator(wanted)?;
            self.section = Some(on_section(&evaluator, (section, &shown), scene.peaks)?);
            convolution = evaluator.method();
        }
        self.used = Some(FieldsUsed {
            kernels: used(&source),
            reason,
            convolution,
        });
        Ok(())
    }

    /// The most in N that the cells leave of the force.
    fn left_n(&self) -> f64 {
        let step_s = self.grid.step_s;
        let parts = self.grid.split(&self.force_n).into_iter();
        let left = parts.map(|(run, force_n)| {
            let nodes = self.excitation.cell_nodes(&run, step_s);
            let rises = rises(run.base_n, force_n);
            let projection = Projection::new(force_n, &rises, &nodes, f64::INFINITY);
            projection.left.most_n
        });
        left.fold(0.0, f64::max)
    }

    /// What the user should know of the times of the output.
    fn warnings(&self) -> Vec<String> {
        let Grid {
            step_s, wanted_s, ..
        } = self.grid;
        let coarse = (step_s > wanted_s).then(|| {
            format!(
                "the output's step is {step_s:.3e} s, that of the table's cells, where {wanted_s:.3e} s or less was wanted"
            )
        });
        let end_s = self.time_s.last().copied().unwrap_or(0.0);
        let echoes = self.probes.as_ref().and_then(|probes| probes.echoes(end_s));
        coarse.into_iter().chain(echoes).collect()
    }

    fn disc_deflection_m(&self, deflection: Deflection, share: StaticShare) -> Vec<f64> {
        let step_s = self.grid.step_s;
        let parts = self.grid.split(&self.force_n).into_iter();
        parts
            .flat_map(|(run, force_n)| {
                self.excitation
                    .deflection_m(deflection, share, step_s, run.base_n, force_n)
            })
            .collect()
    }

    fn outcome(
        self,
        cause: Cause,
        deflection_m: Vec<f64>,
        (striker, energy): (Option<StrikerSeries>, Option<EnergySeries>),
        warnings: Vec<String>,
    ) -> Outcome {
        Outcome {
            cause,
            used: self.used,
            series: Series {
                time_s: self.time_s,
                force_n: self.force_n,
                deflection_m,
                striker,
                energy,
            },
            probes: self.probes,
            section: self.section,
            warnings,
        }
    }
}

fn used(source: &KernelSource) -> KernelsUsed {
    match source {
        KernelSource::Direct(_) => KernelsUsed::Direct,
        KernelSource::Table(table) => KernelsUsed::Table {
            id: table.id().to_owned(),
            format_version: table.format_version().to_owned(),
        },
    }
}
