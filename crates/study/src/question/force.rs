//! Question 2: how to compute an impact.
//!
//! One value is one impact; its error is the largest over peak force, contact time, restitution and
//! peak displacement against the converged march of the fullest model of its family.

use super::marching::{Order, Results, errors, march, results};
use crate::measure::{Candidate, Effort, Run, Scene};
use crate::record::{Question, Record};
use crate::scenes::{ROD_RADIUS_M, TABLE_1_PA, ball, collision, paper};
use contact::law::area_dashpot::AreaDashpot;
use contact::law::hertz::CONTACT_TIME;
use contact::law::quasi_static::{quasi_static, quasi_static_radiation};
use contact::law::radiation::radiation;
use contact::{
    Accuracy, Collision, ExactDisc, FixedDisc, GrowingContact, History, MarchError, Model,
    Outcomes, PunchWaves, Ratios, ResponseTable, Settings, Solver, StaticShare, Summary, Tabulated,
    Workspace, march_explicit, march_growing, march_implicit, refine, solve_disc, solve_growing,
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
    let mut measure = |scene, exact: &Summary, candidates: Vec<Candidate<'_, Results>>| {
        let scene = Scene {
            question: Question::Force,
            name: scene,
            values: 1.0,
            errors: &|found: &Results| Ok(errors(found, &results(exact)).to_vec()),
        };
        for candidate in candidates {
            records.push(scene.measure(effort, &candidate)?);
        }
        advance();
        Ok::<_, AnyError>(())
    };
    let collided = paper(TABLE_1_PA)?;
    let medium = Medium::new(collided.target_poisson_ratio)?;
    let response = SurfaceResponse::new(&medium, Deflection::Centre);
    let disc = collided.fixed_disc(&response, ROD_RADIUS_M, StaticShare::Full);
    let reference = refine(|step| march_implicit(&disc, step), 0.02, 2e-11)?;
    let table = ResponseTable::new(&response);
    let responses = Tabulated::new(Ratios::Few);
    let settings = Settings {
        model: Model::Wave,
        static_share: StaticShare::Full,
        disc_radius_m: Some(ROD_RADIUS_M),
        ..Settings::default()
    };
    let made = series(&responses, (collided, settings), effort);
    let mut candidates = on_disc(&disc, effort);
    candidates.extend(to_tolerance(&disc, &table, effort));
    candidates.extend(from_series(&responses, &made, &collided)?);
    measure(DISC, &reference.summary, candidates)?;

    let collision = collision(&ball("steel", 1.0)?);
    let medium = Medium::new(collision.target_poisson_ratio)?;
    let response = SurfaceResponse::new(&medium, Deflection::Centre);
    let waves = PunchWaves::new(&medium);
    let growing = collision.growing_contact(&waves);
    // itself measured against superposition in time (tests/reference/growing.csv)
    let reference = solve_growing(&growing, &Accuracy::of_contact(1e-10, None))?;
    let lag = collision.lag(&response);
    let terms = AreaDashpot::new(growing.target_share, growing.wave_time, &waves);
    let settings = Settings {
        model: Model::Growing,
        ..Settings::default()
    };
    let made = series(&responses, (collision, settings), effort);
    let mut candidates = growing_contact(&growing, lag, terms, effort);
    candidates.extend(by_pieces(growing, effort));
    candidates.extend(from_series(&responses, &made, &collision)?);
    measure(BALL, reference.summary(), candidates)?;
    Ok(records)
}

/// Steps of a march times the cells of its memory.
fn work(history: &History, memory: f64) -> u64 {
    let steps = history.force.len() as u64;
    steps * steps.min((memory / history.step).ceil() as u64 + 1)
}

/// A closed form.
fn closed<'a>(
    method: &'static str,
    setting: &str,
    found: impl Fn() -> Results + 'a,
) -> Candidate<'a, Results> {
    Candidate::new(method, setting, move || Ok((found(), Some(1))))
}

fn hertz<'a>() -> Candidate<'a, Results> {
    closed("hertz", "closed form", || {
        results(&radiation(black_box(0.0)))
    })
}

/// A march over a number of steps.
fn stepped<'a>(
    method: &'static str,
    n: usize,
    duration: f64,
    march: impl Fn(f64) -> Run<Results> + 'a,
) -> Candidate<'a, Results> {
    // the program halves its step instead: nobody tells it how many are enough
    let setting = format!("{n} steps");
    Candidate::new(method, setting, move || march(duration / n as f64))
}

fn on_disc<'a>(disc: &'a ExactDisc<'a>, effort: Effort) -> Vec<Candidate<'a, Results>> {
    type March = fn(&ExactDisc<'_>, f64) -> Run<Results>;
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
    let duration = quasi_static(disc.coupling).contact_time;
    let mut list = Vec::new();
    for (method, march, quick, full) in marches {
        for &n in effort.pick(quick, full) {
            list.push(stepped(method, n, duration, move |step| march(disc, step)));
        }
    }
    list.push(hertz());
    let lag = disc.coupling * disc.wave_time * disc.response.relaxation_time();
    for (method, lag) in [
        ("two springs, no waves", 0.0),
        ("two springs, first-order loss", lag),
    ] {
        let found = move || results(&quasi_static_radiation(black_box(disc.coupling), lag));
        list.push(closed(method, "closed form", found).default_path(true));
    }
    list
}

/// A march whose step is halved until a tolerance is met, over a contact of some duration with some memory.
fn halved<'a>(
    method: &'static str,
    tolerance: f64,
    duration: f64,
    memory: f64,
    march: impl Fn(f64) -> Result<History, MarchError> + 'a,
) -> Candidate<'a, Results> {
    Candidate::new(method, format!("tolerance {tolerance:.0e}"), move || {
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

/// The marches whose step is halved until a tolerance is met: for one scene, and for the scenes of a sweep.
fn to_tolerance<'a>(
    disc: &'a ExactDisc<'a>,
    table: &'a ResponseTable,
    effort: Effort,
) -> Vec<Candidate<'a, Results>> {
    let (duration, memory) = (quasi_static(disc.coupling).contact_time, disc.memory());
    let mut list = Vec::new();
    for digits in 3..=effort.pick(5, 9) {
        let tolerance = 10.0_f64.powi(-digits);
        let method = "wave implicit, step halved to tolerance";
        let march = |step| march_implicit(disc, step);
        list.push(halved(method, tolerance, duration, memory, march).default_path(true));
        let workspace = RefCell::new(Workspace::default());
        let tabulated = FixedDisc {
            response: table,
            coupling: disc.coupling,
            wave_time: disc.wave_time,
            share: disc.share,
        };
        let in_sweep = move || {
            let accuracy = Accuracy::of_contact(tolerance, None);
            let found = solve_disc(&mut workspace.borrow_mut(), &tabulated, None, accuracy)?;
            // each halving doubles steps and cells
            let step = found.step.unwrap_or(f64::INFINITY);
            let steps = found.summary.contact_time / step;
            let cells = (memory / step).ceil() + 1.0;
            let work = (4.0 / 3.0 * steps * cells) as u64;
            Ok((results(&found.summary), Some(work)))
        };
        let setting = format!("tolerance {tolerance:.0e}");
        let method = "wave implicit, as in sweeps";
        list.push(Candidate::new(method, setting, in_sweep).default_path(true));
    }
    list
}

/// The growing contact by polynomial pieces: what the program does.
fn by_pieces(contact: GrowingContact<'_>, effort: Effort) -> Vec<Candidate<'_, Results>> {
    let at = |&digits: &i32| {
        let setting = format!("tolerance 1e-{digits}");
        let solve = move || {
            let accuracy = Accuracy::of_contact(10.0_f64.powi(-digits), None);
            let solved = solve_growing(&contact, &accuracy)?;
            Ok((results(solved.summary()), Some(solved.pieces() as u64)))
        };
        Candidate::new("growing, polynomial pieces", setting, solve).default_path(true)
    };
    let digits: &[i32] = effort.pick(&[4, 6], &[3, 4, 5, 6, 7, 8]);
    digits.iter().map(at).collect()
}

/// Series for a million contacts alike, by tolerance.
fn series(
    responses: &Tabulated,
    (collision, settings): (Collision, Settings),
    effort: Effort,
) -> Vec<(Settings, Outcomes)> {
    const CONTACTS: usize = 1_000_000;
    let at = |digits: i32| {
        let tolerance = 10.0_f64.powi(-digits);
        let settings = Settings {
            tolerance,
            ..settings
        };
        let some = std::iter::once((collision, settings));
        (settings, Solver::new(responses).outcomes(CONTACTS, some))
    };
    (3..=effort.pick(4, 8)).map(at).collect()
}

/// What sweeps do with many contacts of two materials: a series through marches, made before it is timed.
fn from_series<'a>(
    responses: &'a Tabulated,
    made: &'a [(Settings, Outcomes)],
    collision: &'a Collision,
) -> Result<Vec<Candidate<'a, Results>>, AnyError> {
    let mut list = Vec::new();
    for (settings, outcomes) in made {
        let solver = RefCell::new(Solver::sharing(responses, outcomes));
        let solve = move || {
            let solved = solver.borrow_mut().solve(collision, settings)?;
            Ok((results(&solved.summary), None))
        };
        solve()?;
        let setting = format!("tolerance {:.0e}", settings.tolerance);
        list.push(Candidate::new("series, as in large sweeps", setting, solve).default_path(true));
    }
    Ok(list)
}

fn growing_contact<'a>(
    growing: &'a GrowingContact<'a>,
    lag: f64,
    terms: AreaDashpot,
    effort: Effort,
) -> Vec<Candidate<'a, Results>> {
    let memory = growing.waves.memory() * growing.wave_time;
    let radiation = move || results(&radiation(black_box(lag)));
    let dashpot = move || results(&black_box(terms).summary());
    let mut list: Vec<Candidate<'_, Results>> = vec![
        hertz().default_path(true),
        closed("radiation", "first order", radiation).default_path(true),
        closed("area dashpot", "third order in the memory", dashpot).default_path(true),
    ];
    let steps: &[usize] = effort.pick(&[16, 64], &[12, 16, 24, 32, 64, 128, 256, 512]);
    for &n in steps {
        list.push(stepped("growing", n, CONTACT_TIME, move |step| {
            let history = march_growing(growing, step)?;
            let work = work(&history, memory);
            Ok((results(&Summary::new(&history)?), Some(work)))
        }));
    }
    for digits in 3..=effort.pick(4, 5) {
        // what is left where the pieces do not serve
        list.push(halved(
            "growing, step halved to tolerance",
            10.0_f64.powi(-digits),
            CONTACT_TIME,
            memory,
            |step| march_growing(growing, step),
        ));
    }
    list
}
