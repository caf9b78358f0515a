//! Question 2: how to compute an impact.
//!
//! One value is one impact; its error is the largest over peak force, contact time, restitution and
//! peak displacement against the converged march of the fullest model of its family.

use super::marching::{Order, Results, errors, march, results};
use crate::measure::{Effort, Run, Scene};
use crate::record::{Question, Record};
use crate::scenes::{ROD_RADIUS_M, TABLE_1_PA, ball, collision, paper};
use contact::law::area_dashpot::AreaDashpot;
use contact::law::hertz::CONTACT_TIME;
use contact::law::quasi_static::{quasi_static, quasi_static_radiation};
use contact::law::radiation::radiation;
use contact::{
    Accuracy, Collision, FixedDisc, GrowingContact, History, MarchError, Model, PunchWaves,
    ResponseTable, Settings, Solver, StaticShare, Summary, Tabulated, Workspace, march_explicit,
    march_growing, march_implicit, refine, solve_disc, solve_growing,
};
use fault::AnyError;
use halfspace::{Deflection, Medium, SurfaceResponse};
use std::cell::{Cell, RefCell};
use std::hint::black_box;

/// The paper's fixed disc.
pub(crate) const DISC: &str = "copper rod on steel, fixed disc";

/// A ball whose contact follows the load.
pub(crate) const BALL: &str = "steel ball on steel at 1 m/s, growing contact";

/// Measures every method in both scenes.
pub(crate) fn measure(effort: Effort, advance: &dyn Fn()) -> Result<Vec<Record>, AnyError> {
    let mut records = Vec::new();
    let mut measure = |name, exact, methods: &dyn Fn(Scene<'_, _>) -> Result<(), AnyError>| {
        let scene = Scene {
            effort,
            question: Question::Force,
            name,
            values: 1.0,
            errors: &|found: &Results| Ok(errors(found, &exact).to_vec()),
            records: &mut records,
        };
        methods(scene)?;
        advance();
        Ok::<_, AnyError>(())
    };
    let collided = paper(TABLE_1_PA)?;
    let medium = Medium::new(collided.target_poisson_ratio)?;
    let response = SurfaceResponse::new(&medium, Deflection::Centre);
    let disc = collided.fixed_disc(&response, ROD_RADIUS_M, StaticShare::Full);
    let reference = refine(|step| march_implicit(&disc, step), 0.02, 2e-11)?;
    measure(DISC, results(&reference.summary), &|mut scene| {
        on_disc(&mut scene, &disc)?;
        to_tolerance(&mut scene, &disc)?;
        let settings = Settings {
            model: Model::Wave,
            static_share: StaticShare::Full,
            disc_radius_m: Some(ROD_RADIUS_M),
            ..Settings::default()
        };
        from_series(&mut scene, &collided, settings)
    })?;

    let collision = collision(&ball("steel", 1.0)?);
    let medium = Medium::new(collision.target_poisson_ratio)?;
    let waves = PunchWaves::new(&medium);
    let growing = collision.growing_contact(&waves);
    // itself measured against superposition in time (tests/reference/growing.csv)
    let reference = solve_growing(&growing, &Accuracy::of_contact(1e-10, None))?;
    measure(BALL, results(&reference.summary), &|mut scene| {
        let response = SurfaceResponse::new(&medium, Deflection::Centre);
        following(&mut scene, &growing, collision.lag(&response))?;
        let settings = Settings {
            model: Model::Growing,
            ..Settings::default()
        };
        from_series(&mut scene, &collision, settings)
    })?;
    Ok(records)
}

/// Steps of a march times the cells of its memory.
fn work(history: &History, memory: f64) -> u64 {
    let steps = history.force.len() as u64;
    steps * steps.min((memory / history.step).ceil() as u64 + 1)
}

/// The marches of a fixed disc by their numbers of steps, and the closed forms.
fn on_disc(scene: &mut Scene<'_, Results>, disc: &FixedDisc<'_>) -> Result<(), AnyError> {
    type March = fn(&FixedDisc<'_>, f64) -> Run<Results>;
    let marches: [(&str, March, &[usize], &[usize]); 4] = [
        (
            "wave implicit",
            |disc, step| {
                let history = march_implicit(disc, step)?;
                let work = work(&history, disc.memory());
                Ok((results(&Summary::new(&history)?), Some(work)))
            },
            &[16, 64, 256],
            &[12, 16, 24, 32, 64, 128, 256, 512, 1024, 2048],
        ),
        (
            "implicit of order 1",
            |disc, step| Ok(march(disc, step, Order::First)),
            &[32, 256],
            &[16, 64, 256, 1024, 4096],
        ),
        (
            "implicit of order 2",
            |disc, step| Ok(march(disc, step, Order::Second)),
            &[32, 256],
            &[16, 64, 256, 1024, 4096],
        ),
        (
            "wave explicit (the paper's)",
            |disc, step| {
                let (history, summary) = march_explicit(disc, step)?;
                Ok((results(&summary), Some(work(&history, disc.memory()))))
            },
            &[54, 200, 800],
            &[20, 54, 100, 200, 400, 800, 1600, 3200, 6400],
        ),
    ];
    let duration = quasi_static(disc.coupling).0.contact_time;
    for (method, march, quick, full) in marches {
        for &n in scene.effort.pick(quick, full) {
            // the program halves its step instead: nobody tells it how many are enough
            scene.add(method, format!("{n} steps"), || {
                march(disc, duration / n as f64)
            })?;
        }
    }
    closed(scene, "hertz", "closed form", || radiation(black_box(0.0)))?;
    let lag = disc.coupling * disc.wave_time * disc.response.relaxation_time();
    for (method, lag) in [
        ("two springs, no waves", 0.0),
        ("two springs, first-order loss", lag),
    ] {
        let found = || quasi_static_radiation(black_box(disc.coupling), lag);
        closed(scene, method, "closed form", found)?.default_path = true;
    }
    Ok(())
}

/// A closed form.
fn closed<'a>(
    scene: &'a mut Scene<'_, Results>,
    method: &'static str,
    setting: &str,
    found: impl Fn() -> Summary,
) -> Result<&'a mut Record, AnyError> {
    scene.add(method, setting, || Ok((results(&found()), Some(1))))
}

/// A march whose step is halved until a tolerance is met, over a contact of some duration with some memory.
fn halved<'a>(
    scene: &'a mut Scene<'_, Results>,
    method: &'static str,
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
        Ok((results(&found.summary), Some(total.get())))
    })
}

/// A tolerance as a setting.
fn at(tolerance: f64) -> String {
    format!("tolerance {tolerance:.0e}")
}

/// Tolerances of so many digits.
fn tolerances(digits: impl IntoIterator<Item = i32>) -> impl Iterator<Item = f64> {
    digits.into_iter().map(|digits| 10.0_f64.powi(-digits))
}

/// The marches whose step is halved until a tolerance is met: for one scene, and for the scenes of a sweep.
fn to_tolerance(scene: &mut Scene<'_, Results>, disc: &FixedDisc<'_>) -> Result<(), AnyError> {
    let (duration, memory) = (quasi_static(disc.coupling).0.contact_time, disc.memory());
    let table = ResponseTable::new(disc.response);
    for tolerance in tolerances(3..=scene.effort.pick(5, 9)) {
        let method = "wave implicit, step halved to tolerance";
        let march = |step| march_implicit(disc, step);
        halved(scene, method, tolerance, [duration, memory], march)?.default_path = true;
        let workspace = RefCell::new(Workspace::default());
        let tabulated = FixedDisc {
            response: &table,
            coupling: disc.coupling,
            wave_time: disc.wave_time,
            share: disc.share,
        };
        let in_sweep = || {
            let accuracy = Accuracy::of_contact(tolerance, None);
            let found = solve_disc(&mut workspace.borrow_mut(), &tabulated, None, accuracy)?;
            // each halving doubles steps and cells
            let step = found.step.unwrap_or(f64::INFINITY);
            let steps = found.summary.contact_time / step;
            let cells = (memory / step).ceil() + 1.0;
            let work = (4.0 / 3.0 * steps * cells) as u64;
            Ok((results(&found.summary), Some(work)))
        };
        let method = "wave implicit, as in sweeps";
        scene.add(method, at(tolerance), in_sweep)?.default_path = true;
    }
    Ok(())
}

/// What sweeps do with many contacts of two materials: series for a million alike, made before they are timed.
fn from_series(
    scene: &mut Scene<'_, Results>,
    collision: &Collision,
    settings: Settings,
) -> Result<(), AnyError> {
    const CONTACTS: usize = 1_000_000;
    let responses = Tabulated::default();
    for tolerance in tolerances(3..=scene.effort.pick(4, 8)) {
        let settings = Settings {
            tolerance,
            ..settings
        };
        let some = std::iter::once((*collision, settings));
        let outcomes = Solver::new(&responses).outcomes(CONTACTS, some);
        let solver = RefCell::new(Solver::sharing(&responses, &outcomes));
        let solve = || {
            let solved = solver.borrow_mut().solve(collision, &settings)?;
            Ok((results(&solved.summary), None))
        };
        solve()?;
        let method = "series, as in large sweeps";
        scene.add(method, at(tolerance), solve)?.default_path = true;
    }
    Ok(())
}

/// A contact that follows the load: closed forms, the march with a uniform step, polynomial pieces.
fn following(
    scene: &mut Scene<'_, Results>,
    growing: &GrowingContact<'_>,
    lag: f64,
) -> Result<(), AnyError> {
    let terms = AreaDashpot::new(growing.target_share, growing.wave_time, growing.waves);
    let hertz = || radiation(black_box(0.0));
    closed(scene, "hertz", "closed form", hertz)?.default_path = true;
    let first = || radiation(black_box(lag));
    closed(scene, "radiation", "first order", first)?.default_path = true;
    let third = "third order in the memory";
    let dashpot = || black_box(terms).summary();
    closed(scene, "area dashpot", third, dashpot)?.default_path = true;
    let memory = growing.waves.memory * growing.wave_time;
    let (quick, full): (&[usize], &[usize]) = (&[16, 64], &[12, 16, 24, 32, 64, 128, 256, 512]);
    for &n in scene.effort.pick(quick, full) {
        scene.add("growing", format!("{n} steps"), || {
            let history = march_growing(growing, CONTACT_TIME / n as f64)?;
            let work = work(&history, memory);
            Ok((results(&Summary::new(&history)?), Some(work)))
        })?;
    }
    for tolerance in tolerances(3..=scene.effort.pick(4, 5)) {
        // what is left where the pieces do not serve
        let method = "growing, step halved to tolerance";
        let march = |step| march_growing(growing, step);
        halved(scene, method, tolerance, [CONTACT_TIME, memory], march)?;
    }
    let (quick, full): (&[i32], &[i32]) = (&[4, 6], &[3, 4, 5, 6, 7, 8]);
    for tolerance in tolerances(scene.effort.pick(quick, full).iter().copied()) {
        let solve = || {
            let accuracy = Accuracy::of_contact(tolerance, None);
            let solved = solve_growing(growing, &accuracy)?;
            Ok((results(&solved.summary), Some(solved.pieces() as u64)))
        };
        let method = "growing, polynomial pieces";
        scene.add(method, at(tolerance), solve)?.default_path = true;
    }
    Ok(())
}
