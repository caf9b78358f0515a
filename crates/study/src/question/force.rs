//! Question 2: how to compute an impact.
//!
//! One value is one impact; its error is the largest over peak force, contact time, restitution and
//! peak displacement against the converged march of the fullest model of its family.

use super::marching::{MarchOrder, errors, march};
use crate::measure::{Effort, Found, MeasuredScene, Rows, at};
use crate::method::ComparedMethod;
use crate::record::{Question, Record};
use crate::scenes::{ball, paper_disc, paper_response};
use contact::law::area_dashpot::AreaDashpot;
use contact::law::quasi_static::{quasi_static, quasi_static_radiation};
use contact::law::radiation::radiation;
use contact::{
    Accuracy, FixedDisc, GrowingContact, History, MarchError, Model, PunchWaves, ResponseTable,
    Solver, Summary, Tabulated, march_explicit, march_implicit, refine, solve_disc, solve_growing,
};
use fault::AnyError;
use halfspace::{Deflection, Medium, SurfaceResponse};
use impact::Impact;
use paper::{RADIUS_M, TABLE_1_PA, coupled};
use std::cell::{Cell, RefCell};
use std::hint::black_box;

/// The paper's fixed disc.
pub(crate) const DISC: &str = "copper rod on steel, fixed disc";

/// A ball whose contact follows the load.
pub(crate) const BALL: &str = "steel ball on steel at 1 m/s, growing contact";

/// Measures every method in both scenes.
pub(crate) fn measure(effort: Effort, advance: &dyn Fn()) -> Rows {
    let response = paper_response()?;
    let disc = paper_disc(TABLE_1_PA, &response)?;
    let on_disc_exact = refine(|step| march_implicit(&disc, step), 0.02, 2e-11)?.summary;

    let mut ball = ball("steel", 1.0)?;
    ball.settings.model = Model::Growing;
    let collision = ball.collision();
    let medium = Medium::new(collision.target_poisson_ratio)?;
    let waves = PunchWaves::new(&medium);
    let growing = collision.growing_contact(&waves);
    // this reference is compared with superposition in time in tests/reference/growing.csv
    let growing_exact = solve_growing(&growing, &Accuracy::of_contact(1e-10, None))?.summary;

    let mut records = Vec::new();
    let mut scene = MeasuredScene {
        effort,
        question: Question::Force,
        name: DISC,
        values: 1.0,
        errors: &|found| Ok(errors(found, &on_disc_exact).to_vec()),
        records: &mut records,
    };
    on_disc(&mut scene, &disc)?;
    to_tolerance(&mut scene, &disc)?;
    from_series(&mut scene, &coupled(TABLE_1_PA, RADIUS_M)?)?;
    advance();

    let against_growing = |found: &Summary| Ok(errors(found, &growing_exact).to_vec());
    scene.name = BALL;
    scene.errors = &against_growing;
    let response = SurfaceResponse::new(&medium, Deflection::Centre);
    let lag = collision.lag(growing.wave_time, &response);
    following(&mut scene, &growing, lag)?;
    from_series(&mut scene, &ball)?;
    advance();
    Ok(records)
}

/// Steps of a march times the cells of its memory.
fn work(history: &History, memory: f64) -> u64 {
    let steps = history.force.len() as u64;
    steps * steps.min((memory / history.step).ceil() as u64 + 1)
}

/// The results of a march with the given memory, and its work.
fn measured(history: &History, memory: f64) -> Found<Summary> {
    Ok((Summary::new(history)?, Some(work(history, memory))))
}

/// A march with given numbers of steps over a duration.
///
/// The program halves its step instead, since the number of steps needed is not known.
fn stepped(
    scene: &mut MeasuredScene<'_, Summary>,
    method: ComparedMethod,
    duration: f64,
    [quick, full]: [&[usize]; 2],
    march: impl Fn(f64) -> Found<Summary>,
) -> Result<(), AnyError> {
    for &n in scene.effort.pick(quick, full) {
        scene.add(method, format!("{n} steps"), || march(duration / n as f64))?;
    }
    Ok(())
}

/// The marches of a fixed disc by their numbers of steps, and the closed forms.
fn on_disc(scene: &mut MeasuredScene<'_, Summary>, disc: &FixedDisc<'_>) -> Result<(), AnyError> {
    let (duration, memory) = (quasi_static(disc.coupling).0.contact_time, disc.memory());
    let steps: [&[usize]; 2] = [
        &[16, 64, 256],
        &[12, 16, 24, 32, 64, 128, 256, 512, 1024, 2048],
    ];
    let implicit = |step| measured(&march_implicit(disc, step)?, memory);
    stepped(
        scene,
        ComparedMethod::WaveImplicit,
        duration,
        steps,
        implicit,
    )?;
    for (method, order) in [
        (ComparedMethod::ImplicitFirst, MarchOrder::First),
        (ComparedMethod::ImplicitSecond, MarchOrder::Second),
    ] {
        let steps: [&[usize]; 2] = [&[32, 256], &[16, 64, 256, 1024, 4096]];
        let march = |step| Ok(march(disc, step, order));
        stepped(scene, method, duration, steps, march)?;
    }
    let steps: [&[usize]; 2] = [
        &[54, 200, 800],
        &[20, 54, 100, 200, 400, 800, 1600, 3200, 6400],
    ];
    let explicit = |step| {
        let (history, summary) = march_explicit(disc, step)?;
        Ok((summary, Some(work(&history, memory))))
    };
    let method = ComparedMethod::WaveExplicit;
    stepped(scene, method, duration, steps, explicit)?;
    closed(scene, ComparedMethod::Hertz, "closed form", || {
        radiation(black_box(0.0))
    })?;
    let lag = disc.coupling * disc.wave_time * disc.response.disc.relaxation_time;
    for (method, lag) in [
        (ComparedMethod::TwoSprings, 0.0),
        (ComparedMethod::TwoSpringsWithLoss, lag),
    ] {
        let found = || quasi_static_radiation(black_box(disc.coupling), lag);
        closed(scene, method, "closed form", found)?.default_path = true;
    }
    Ok(())
}

/// A closed form.
fn closed<'a>(
    scene: &'a mut MeasuredScene<'_, Summary>,
    method: ComparedMethod,
    setting: &str,
    found: impl Fn() -> Summary,
) -> Result<&'a mut Record, AnyError> {
    scene.add(method, setting, || Ok((found(), Some(1))))
}

/// A march whose step is halved until a tolerance is met, over a contact of some duration with some memory.
fn halved<'a>(
    scene: &'a mut MeasuredScene<'_, Summary>,
    method: ComparedMethod,
    tolerance: f64,
    [duration, memory]: [f64; 2],
    march: impl Fn(f64) -> Result<History, MarchError>,
) -> Result<&'a mut Record, AnyError> {
    scene.add(method, at(tolerance), || {
        let accuracy = Accuracy::from(tolerance);
        let total = Cell::new(0);
        let counted = |step| {
            let history = march(step)?;
            total.set(total.get() + work(&history, memory));
            Ok(history)
        };
        let found = refine(counted, duration / accuracy.first_steps(), accuracy)?;
        Ok((found.summary, Some(total.get())))
    })
}

/// Tolerances from numbers of digits.
fn tolerances(digits: impl IntoIterator<Item = i32>) -> impl Iterator<Item = f64> {
    digits.into_iter().map(|digits| 10.0_f64.powi(-digits))
}

/// The marches whose step is halved until a tolerance is met: for one scene, and for the scenes of a sweep.
fn to_tolerance(
    scene: &mut MeasuredScene<'_, Summary>,
    disc: &FixedDisc<'_>,
) -> Result<(), AnyError> {
    let (duration, memory) = (quasi_static(disc.coupling).0.contact_time, disc.memory());
    let table = ResponseTable::new(disc.response);
    for tolerance in tolerances(3..=scene.effort.pick(5, 9)) {
        let method = ComparedMethod::WaveHalved;
        let march = |step| march_implicit(disc, step);
        halved(scene, method, tolerance, [duration, memory], march)?.default_path = true;
        let history = RefCell::new(History::default());
        let tabulated = FixedDisc {
            response: &table,
            coupling: disc.coupling,
            wave_time: disc.wave_time,
            share: disc.share,
        };
        let in_sweep = || {
            let accuracy = Accuracy::of_contact(tolerance, None);
            let found = solve_disc(&mut history.borrow_mut(), &tabulated, None, accuracy)?;
            // each halving doubles steps and cells
            let step = found.step.unwrap_or(f64::INFINITY);
            let steps = found.summary.contact_time / step;
            let cells = (memory / step).ceil() + 1.0;
            let work = (4.0 / 3.0 * steps * cells) as u64;
            Ok((found.summary, Some(work)))
        };
        let method = ComparedMethod::WaveInSweeps;
        let row = scene.add(method, at(tolerance), in_sweep)?;
        row.default_path = true;
    }
    Ok(())
}

/// The method of large sweeps: series for contacts of two materials; the series are computed before the timing.
fn from_series(scene: &mut MeasuredScene<'_, Summary>, impact: &Impact) -> Result<(), AnyError> {
    const CONTACTS: usize = 1_000_000;
    let (collision, responses) = (impact.collision(), Tabulated::default());
    for tolerance in tolerances(3..=scene.effort.pick(4, 8)) {
        let settings = impact.clone().to_tolerance(tolerance).settings;
        let some = std::iter::once((collision, settings));
        let outcomes = Solver::new(&responses).outcomes(CONTACTS, some);
        let solver = RefCell::new(Solver::sharing(&responses, &outcomes));
        let solve = || {
            let solved = solver.borrow_mut().solve(&collision, &settings)?;
            Ok((solved.summary, None))
        };
        solve()?;
        let method = ComparedMethod::Series;
        scene.add(method, at(tolerance), solve)?.default_path = true;
    }
    Ok(())
}

/// A contact that follows the load: closed forms and polynomial pieces.
fn following(
    scene: &mut MeasuredScene<'_, Summary>,
    growing: &GrowingContact<'_>,
    lag: f64,
) -> Result<(), AnyError> {
    let terms = AreaDashpot::new(growing);
    let hertz = || radiation(black_box(0.0));
    closed(scene, ComparedMethod::Hertz, "closed form", hertz)?.default_path = true;
    let first = || radiation(black_box(lag));
    closed(scene, ComparedMethod::Radiation, "first order", first)?.default_path = true;
    let third = "third order in the memory";
    let dashpot = || black_box(terms).summary();
    closed(scene, ComparedMethod::AreaDashpot, third, dashpot)?.default_path = true;
    let digits = scene.effort.pick(vec![4, 6], vec![3, 4, 5, 6, 7, 8]);
    for tolerance in tolerances(digits) {
        let solve = || {
            let accuracy = Accuracy::of_contact(tolerance, None);
            let solved = solve_growing(growing, &accuracy)?;
            Ok((solved.summary, Some(solved.pieces() as u64)))
        };
        let method = ComparedMethod::GrowingPieces;
        scene.add(method, at(tolerance), solve)?.default_path = true;
    }
    Ok(())
}
