//! Question 2: how to compute an impact.
//!
//! One value is one impact; its error is the largest over peak force, contact time, restitution and
//! peak displacement against the converged march of the fullest model of its family.

use crate::StudyError;
use crate::effort::Effort;
use crate::marching::{Order, Results, march};
use crate::record::{Error, Question, Record};
use crate::scenes::{ROD_RADIUS_M, TABLE_1_PA, ball, collision, paper};
use contact::law::area_dashpot::AreaDashpot;
use contact::law::hertz::CONTACT_TIME;
use contact::law::quasi_static::{quasi_static, quasi_static_radiation};
use contact::law::radiation::radiation;
use contact::{
    Accuracy, ContactError, ExactDisc, FixedDisc, GrowingContact, History, MarchError, PunchWaves,
    ResponseTable, StaticShare, Summary, Workspace, march_explicit, march_growing, march_implicit,
    refine, solve_disc, solve_growing,
};
use halfspace::{Deflection, Medium, SurfaceResponse};
use std::cell::{Cell, RefCell};
use std::hint::black_box;

/// The paper's fixed disc.
pub(crate) const DISC: &str = "copper rod on steel, fixed disc";

/// A ball whose contact follows the load.
pub(crate) const BALL: &str = "steel ball on steel at 1 m/s, growing contact";

type Outcome = Result<(Results, u64), ContactError>;

struct Candidate<'a> {
    method: &'static str,
    setting: String,
    default_path: bool,
    run: Box<dyn Fn() -> Outcome + 'a>,
}

/// Measures every method in both scenes.
pub(crate) fn measure(effort: Effort, advance: &dyn Fn()) -> Result<Vec<Record>, StudyError> {
    let mut records = Vec::new();
    let collided = paper(TABLE_1_PA)?;
    let medium = Medium::new(collided.target_poisson_ratio)?;
    let response = SurfaceResponse::new(&medium, Deflection::Centre);
    let disc = collided.fixed_disc(&response, ROD_RADIUS_M, StaticShare::Full);
    let reference = refine(|step| march_implicit(&disc, step), 0.02, 2e-11)?;
    let table = ResponseTable::new(&response);
    let mut candidates = on_disc(&disc, effort);
    candidates.extend(to_tolerance(&disc, &table, effort));
    for candidate in candidates {
        records.push(take(effort, DISC, &(&reference.summary).into(), &candidate));
    }
    advance();

    let collision = collision(&ball("steel", 1.0)?);
    let medium = Medium::new(collision.target_poisson_ratio)?;
    let response = SurfaceResponse::new(&medium, Deflection::Centre);
    let waves = PunchWaves::new(&medium);
    let growing = collision.growing_contact(&waves);
    // itself measured against superposition in time (tests/reference/growing.csv)
    let reference = solve_growing(&growing, &Accuracy::of_contact(1e-10, None))?;
    let lag = collision.lag(&response);
    let terms = AreaDashpot::new(growing.target_share, growing.wave_time, &waves);
    let mut candidates = growing_contact(&growing, lag, terms, effort);
    candidates.extend(by_pieces(growing, effort));
    for candidate in candidates {
        records.push(take(effort, BALL, &reference.summary().into(), &candidate));
    }
    advance();
    Ok(records)
}

fn take(effort: Effort, scene: &'static str, exact: &Results, candidate: &Candidate<'_>) -> Record {
    let outcome = (candidate.run)();
    let cost = effort.clock().time(1.0, || {
        let _ = black_box((candidate.run)());
    });
    let (error, work, refusal) = match outcome {
        Ok((found, work)) => (Error::of(&found.errors(exact)), Some(work as f64), None),
        Err(error) => (Error::of(&[f64::NAN]), None, Some(error.to_string())),
    };
    Record {
        question: Question::Force,
        scene,
        method: candidate.method,
        setting: candidate.setting.clone(),
        default_path: candidate.default_path,
        cost,
        error,
        work,
        refusal,
    }
}

/// Steps of a march times the cells of its memory.
fn work(history: &History, memory: f64) -> u64 {
    let steps = history.force.len() as u64;
    steps * steps.min((memory / history.step).ceil() as u64 + 1)
}

fn on_disc<'a>(disc: &'a ExactDisc<'a>, effort: Effort) -> Vec<Candidate<'a>> {
    let duration = quasi_static(disc.coupling).contact_time;
    let memory = disc.memory();
    let steps = move |n: usize| duration / n as f64;
    let mut list = Vec::new();
    for n in effort.pick(
        vec![16, 64, 256],
        vec![12, 16, 24, 32, 64, 128, 256, 512, 1024, 2048],
    ) {
        list.push(Candidate {
            method: "wave implicit",
            setting: format!("{n} steps"),
            // the program halves its step instead: nobody tells it how many are enough
            default_path: false,
            run: Box::new(move || {
                let history = march_implicit(disc, steps(n))?;
                let summary = Summary::new(&history)?;
                Ok(((&summary).into(), work(&history, memory)))
            }),
        });
    }
    for (order, method) in [
        (Order::First, "implicit of order 1"),
        (Order::Second, "implicit of order 2"),
    ] {
        for n in effort.pick(vec![32, 256], vec![16, 64, 256, 1024, 4096]) {
            list.push(Candidate {
                method,
                setting: format!("{n} steps"),
                default_path: false,
                run: Box::new(move || Ok(march(disc, steps(n), order))),
            });
        }
    }
    for n in effort.pick(
        vec![54, 200, 800],
        vec![20, 54, 100, 200, 400, 800, 1600, 3200, 6400],
    ) {
        list.push(Candidate {
            method: "wave explicit (the paper's)",
            setting: format!("{n} steps"),
            default_path: false,
            run: Box::new(move || {
                let (history, summary) = march_explicit(disc, steps(n))?;
                Ok(((&summary).into(), work(&history, memory)))
            }),
        });
    }
    list.push(hertz());
    let lag = disc.coupling * disc.wave_time * disc.response.relaxation_time();
    for (method, lag) in [
        ("two springs, no waves", 0.0),
        ("two springs, first-order loss", lag),
    ] {
        list.push(Candidate {
            method,
            setting: "closed form".to_owned(),
            default_path: true,
            run: Box::new(move || {
                let found = quasi_static_radiation(black_box(disc.coupling), lag);
                Ok(((&found).into(), 1))
            }),
        });
    }
    list
}

/// A march whose step is halved until a tolerance is met, over a contact of some duration with some memory.
fn halved<'a>(
    method: &'static str,
    tolerance: f64,
    (duration, memory): (f64, f64),
    march: impl Fn(f64) -> Result<History, MarchError> + 'a,
) -> Candidate<'a> {
    Candidate {
        method,
        setting: format!("tolerance {tolerance:.0e}"),
        default_path: true,
        run: Box::new(move || {
            let accuracy = Accuracy::from(tolerance);
            let total = Cell::new(0);
            let counted = |step| {
                let history = march(step)?;
                total.set(total.get() + work(&history, memory));
                Ok(history)
            };
            let found = refine(counted, duration / accuracy.first_steps(), accuracy)?;
            Ok(((&found.summary).into(), total.get()))
        }),
    }
}

/// The marches whose step is halved until a tolerance is met: for one scene, and for the scenes of a sweep.
fn to_tolerance<'a>(
    disc: &'a ExactDisc<'a>,
    table: &'a ResponseTable,
    effort: Effort,
) -> Vec<Candidate<'a>> {
    let duration = quasi_static(disc.coupling).contact_time;
    let memory = disc.memory();
    let mut list = Vec::new();
    for digits in 3..=effort.pick(5, 9) {
        let tolerance = 10.0_f64.powi(-digits);
        list.push(halved(
            "wave implicit, step halved to tolerance",
            tolerance,
            (duration, memory),
            |step| march_implicit(disc, step),
        ));
        let workspace = RefCell::new(Workspace::default());
        let tabulated = FixedDisc {
            response: table,
            coupling: disc.coupling,
            wave_time: disc.wave_time,
            share: disc.share,
        };
        list.push(Candidate {
            method: "wave implicit, as in sweeps",
            setting: format!("tolerance {tolerance:.0e}"),
            default_path: true,
            run: Box::new(move || {
                let accuracy = Accuracy::of_contact(tolerance, None);
                let room = &mut *workspace.borrow_mut();
                let found = solve_disc(room, &tabulated, None, accuracy)?;
                // each halving doubles steps and cells
                let step = found.step.unwrap_or(f64::INFINITY);
                let steps = found.summary.contact_time / step;
                let cells = (memory / step).ceil() + 1.0;
                Ok(((&found.summary).into(), (4.0 / 3.0 * steps * cells) as u64))
            }),
        });
    }
    list
}

fn hertz<'a>() -> Candidate<'a> {
    Candidate {
        method: "hertz",
        setting: "closed form".to_owned(),
        default_path: false,
        run: Box::new(|| Ok(((&radiation(black_box(0.0))).into(), 1))),
    }
}

/// The growing contact by polynomial pieces: what the program does.
fn by_pieces(contact: GrowingContact<'_>, effort: Effort) -> Vec<Candidate<'_>> {
    let digits = effort.pick(vec![4, 6], vec![3, 4, 5, 6, 7, 8]);
    let at = |digits: i32| Candidate {
        method: "growing, polynomial pieces",
        setting: format!("tolerance 1e-{digits}"),
        default_path: true,
        run: Box::new(move || {
            let accuracy = Accuracy::of_contact(10.0_f64.powi(-digits), None);
            let solved = solve_growing(&contact, &accuracy)?;
            Ok((solved.summary().into(), solved.pieces() as u64))
        }),
    };
    digits.into_iter().map(at).collect()
}

fn growing_contact<'a>(
    growing: &'a GrowingContact<'a>,
    lag: f64,
    terms: AreaDashpot,
    effort: Effort,
) -> Vec<Candidate<'a>> {
    let memory = growing.waves.memory() * growing.wave_time;
    let mut list = vec![
        Candidate {
            default_path: true,
            ..hertz()
        },
        Candidate {
            method: "radiation",
            setting: "first order".to_owned(),
            default_path: true,
            run: Box::new(move || Ok(((&radiation(black_box(lag))).into(), 1))),
        },
        Candidate {
            method: "area dashpot",
            setting: "third order in the memory".to_owned(),
            default_path: true,
            run: Box::new(move || Ok(((&black_box(terms).summary()).into(), 1))),
        },
    ];
    for n in effort.pick(vec![16, 64], vec![12, 16, 24, 32, 64, 128, 256, 512]) {
        list.push(Candidate {
            method: "growing",
            setting: format!("{n} steps"),
            default_path: false,
            run: Box::new(move || {
                let history = march_growing(growing, CONTACT_TIME / n as f64)?;
                let summary = Summary::new(&history)?;
                Ok(((&summary).into(), work(&history, memory)))
            }),
        });
    }
    for digits in 3..=effort.pick(4, 5) {
        let tolerance = 10.0_f64.powi(-digits);
        list.push(halved(
            "growing, step halved to tolerance",
            tolerance,
            (CONTACT_TIME, memory),
            |step| march_growing(growing, step),
        ));
        if let Some(last) = list.last_mut() {
            // what is left where the pieces do not serve
            last.default_path = false;
        }
    }
    list
}
