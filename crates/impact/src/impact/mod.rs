//! A striker and a half-space: from two bodies and a velocity to an excitation.
//!
//! `run` is a contact solved on its half-space, `plate` on the surface of a plate that its echo moves.

mod plate;
mod run;

use crate::scene::{Scene, Strike};
use contact::{
    Choice, Collision, ContactError, Exact, HalfSpace, Model, Plasticity, Responses, Results,
    Settings, Solver, StaticShare, Striker, warnings,
};
use plate::with_echo;
pub use run::Run;
use run::solve_once;

/// Relative change of the peak force above which the effect of the full static share causes a warning.
const NOTABLE: f64 = 0.01;

/// Smallest visible difference of two restitutions with three digits.
const TOLD: f64 = 1e-3;

/// A striker that hits a half-space.
///
/// ```
/// use impact::{HalfSpace, Impact, Material, Striker};
/// let granite = HalfSpace::new(Material::named("granite")?)?;
/// let ball = Striker::ball(Material::named("bearing-steel")?, 0.001)?;
/// let run = Impact::new(granite, ball, 2.0).solve()?;
/// assert!(run.peak_force_n > 20.0 && run.restitution < 1.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Impact {
    /// The half-space.
    pub half_space: HalfSpace,
    /// The striker.
    pub striker: Striker,
    /// Velocity of approach in m/s.
    pub velocity_m_s: f64,
    /// Settings of the contact.
    pub settings: Settings,
}

/// Solves a contact with a solver's responses, without warnings.
pub(crate) fn solve<S: Responses>(
    solver: &mut Solver<'_, S>,
    half_space: &HalfSpace,
    collision: &Collision,
    settings: &Settings,
) -> Result<Run, ContactError> {
    collision.check_step(settings)?;
    let run = solve_once(solver, half_space, collision, settings)?;
    let task = (half_space, collision, settings);
    let solved = with_echo(task, run, |motion| {
        solver.on_surface(Some(motion));
        solve_once(solver, half_space, collision, settings)
    });
    solver.on_surface(None);
    solved
}

impl Impact {
    /// An impact with the default settings: model `auto` at a tolerance of 1e-4.
    pub fn new(half_space: HalfSpace, striker: Striker, velocity_m_s: f64) -> Self {
        Self {
            half_space,
            striker,
            velocity_m_s,
            settings: Settings::default(),
        }
    }

    /// The impact of a scene by its striker.
    pub fn of(scene: &Scene, strike: &Strike) -> Self {
        Self {
            half_space: scene.target.clone(),
            striker: strike.striker.clone(),
            velocity_m_s: strike.velocity_m_s,
            settings: scene.settings,
        }
    }

    /// The same bodies under Hertz's law alone: elastic, without waves and without a disc.
    #[must_use]
    pub fn without_waves(self) -> Self {
        let settings = Settings {
            model: Model::Hertz,
            ..Settings::default()
        };
        Self { settings, ..self }
    }

    /// Sets the relative tolerance of the results.
    #[must_use]
    pub fn to_tolerance(mut self, tolerance: f64) -> Self {
        self.settings.tolerance = tolerance;
        self
    }

    /// The collision that determines the contact.
    pub fn collision(&self) -> Collision {
        Collision::new(&self.half_space, &self.striker, self.velocity_m_s)
    }

    /// Solves the contact; returns the force over time and the warnings as well.
    ///
    /// The history takes most of the time if the model has a closed form. For the results alone use
    /// [`Solver::solve`](contact::Solver::solve), for many impacts [`sweep::collide`](crate::sweep::collide), which
    /// shares their common parts.
    ///
    /// # Errors
    /// [`ContactError`].
    pub fn solve(&self) -> Result<Run, ContactError> {
        let settings = &self.settings;
        let collision = self.collision();
        let mut solver = Solver::new(&Exact);
        let mut run = solve(&mut solver, &self.half_space, &collision, settings)?;
        let (block, striker) = (&self.half_space, &self.striker);
        let (plan, results) = (&run.solved.chosen, &run.results);
        let mut found = warnings(block, striker, &collision, settings, plan, results);
        found.extend(self.would_yield(&mut solver, &collision, results));
        found.extend(self.counted_twice(&mut solver, &collision, &run));
        run.warnings = found;
        Ok(run)
    }

    /// A warning with the restitution by Thornton's law, if an elastic contact exceeds the onset of yield.
    fn would_yield(
        &self,
        solver: &mut Solver<'_, Exact>,
        collision: &Collision,
        results: &Results,
    ) -> Option<String> {
        let yields = results.loading.yield_onset.is_some_and(|onset| onset > 1.0);
        if self.settings.plasticity.yields() || !yields {
            return None;
        }
        let plasticity = Plasticity::Thornton;
        let settings = Settings {
            plasticity,
            ..Settings::default()
        };
        let restitution = solver.solve(collision, &settings).ok()?.summary.restitution;
        let elastic = results.restitution;
        ((elastic - restitution).abs() >= TOLD).then(|| {
            format!(
                "the contact yields, which plasticity = \"none\" ignores: its restitution is {elastic:.3}, but {restitution:.3} with \"{}\"",
                plasticity.name()
            )
        })
    }

    /// A warning if the full static share of a fixed disc changes the force by more than [`NOTABLE`], compared with a
    /// contact radius that follows the load.
    ///
    /// Hertz's law includes the static compliance of the half-space already; the paper's disc adds it again.
    fn counted_twice(
        &self,
        solver: &mut Solver<'_, Exact>,
        collision: &Collision,
        run: &Run,
    ) -> Option<String> {
        if !run.solved.chosen.model.on_disc() || self.settings.static_share != StaticShare::Full {
            return None;
        }
        let following = Settings {
            tolerance: 1e-3,
            ..Settings::default()
        };
        let free = solver.solve(collision, &following).ok()?;
        let force_n = free.summary.peak_force * collision.units().force_n;
        let change = run.peak_force_n / force_n - 1.0;
        (change.abs() > NOTABLE).then(|| {
            format!(
                "the full static share includes the static deflection of the half-space twice, in Hertz's law and in the disc: the peak force deviates by {:+.0} % from {} N, that of a contact radius that follows the load",
                100.0 * change,
                fault::rounded(force_n)
            )
        })
    }
}
