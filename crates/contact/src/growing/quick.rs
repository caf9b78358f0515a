//! A contact with a dashpot that yields, in three parts that need no march.
//!
//! ```text
//! rise    x = sqrt(u):  v^2 = 1 - x^5 - (45/4) c int x^3 v dx,  t = int 2 x dx/v     Gauss and Picard
//! flow    Thornton's line: p = k X + c k^2 v,  X'' = -(5/4) p,  k = (3/2) y         a damped oscillator
//!         the fit: v = V cos(angle),  du = V^2 sin cos d(angle)/((5/4) p)            Gragg and Bulirsch
//! fall    from rest at radius one, with a lag c a^1.5; of a cut pressure also y/a    series, made once
//! ```
//!
//! Theory: `docs/theory.md` (T65).

use crate::growing::equations::March;
use crate::growing::nodes::RadauNodes;
use crate::law::branch::Branch;
use crate::law::fit::Fit;
use crate::law::yielding::{Flow, FlowLaw, Yielding};
use crate::numeric::series::PlaneSeries;
use crate::summary::Summary;
use crate::units::INVERSE_MASS;
use std::f64::consts::FRAC_PI_2;
use std::sync::OnceLock;

/// Nodes of a panel, and the part of the way to Hertz's turning point that one of the rise takes.
const NODES_OF_RISE: usize = 8;
const PART_OF_RISE: f64 = 0.6;

/// Longest step of the flow of the fit in the logarithm of the angle, and columns of its extrapolation.
const LONGEST_STEP: f64 = 0.65;
const COLUMNS_OF_STEP: usize = 5;

/// Results to 1e-9 for a lag, of the fit to 1e-8; nothing for a lag beyond the series, where waves keep the contact from yielding, and where
/// the force is largest before it does.
pub(crate) fn quick(yielding: &Yielding, lag: f64) -> Option<(Summary, Flow)> {
    let edge = yielding.edge();
    let (v0, t0, lost) = rise(edge, lag)?;
    let ([depth, time, flowing], [peak_force, peak_force_time]) = match yielding.law {
        FlowLaw::Thornton | FlowLaw::Recovery => turned_on_line(edge, lag, v0)?,
        FlowLaw::Fit(fit) => turned_on_fit(&fit, yielding.depth, lag, v0),
    };
    let top = depth.sqrt();
    let (back, from) = yielding.unloading(top);
    if from.is_nan() || from <= 0.0 {
        return None;
    }
    let own_lag = lag * from * from.sqrt();
    let fifth = from.powi(5);
    let ([speed, duration, pulled, stored], by) = match back {
        Branch::Truncated { edge, top } => (fall_of_cut(edge / top, own_lag)?, 1.0),
        Branch::Hertzian { flatter, .. } => (fall(own_lag)?, 1.0 / flatter),
        // no law unloads along these
        Branch::Line { .. } | Branch::Fit(_) | Branch::OnSpring { .. } => return None,
    };
    let (v, stored) = (by * speed * fifth.sqrt(), by * by * stored * fifth);
    let spent = lost + flowing + 2.0 * INVERSE_MASS * stored;
    let plastic_work = match yielding.law {
        FlowLaw::Thornton | FlowLaw::Recovery => 2.0 * INVERSE_MASS * (yielding.work(top) - stored),
        FlowLaw::Fit(_) => 1.0 - spent,
    };
    Some((
        Summary {
            peak_force,
            peak_force_time: t0 + peak_force_time,
            contact_time: t0 + time + duration / from.sqrt(),
            peak_displacement: depth,
            peak_deflection: 1.5 * lag * by * pulled * from * fifth.sqrt(),
            ..Summary::rebound(v)
        },
        Flow::new(yielding, top, [plastic_work, spent - v * v]),
    ))
}

/// State of the flow on Thornton's line where the indentation turns, from a velocity at its beginning: indentation,
/// time since then and energy radiated meanwhile, and the largest force with its time; nothing where the force falls at
/// once.
fn turned_on_line(edge: f64, lag: f64, v0: f64) -> Option<([f64; 3], [f64; 2])> {
    let stiffness = 1.5 * edge;
    let square = INVERSE_MASS * stiffness;
    let damping = 0.5 * lag * stiffness * square;
    let frequency = (square - damping * damping).sqrt();
    // place and size of the extremum of a damped oscillation with a value and a slope
    let extremum = |value: f64, slope: f64| {
        let angle = (slope * frequency).atan2(damping * slope + square * value);
        let time = angle / frequency;
        let (sine, cosine) = angle.sin_cos();
        let size = value * cosine + (slope + damping * value) / frequency * sine;
        (time, (-damping * time).exp() * size)
    };
    let place = edge * edge / 1.5;
    let push = stiffness * place + lag * stiffness * stiffness * v0;
    let rate = stiffness * v0 - INVERSE_MASS * lag * stiffness * stiffness * push;
    if frequency.is_nan() || rate <= 0.0 {
        return None;
    }
    let (peak_force_time, peak_force) = extremum(push, rate);
    let (time, far) = extremum(place, v0);
    let radiated = v0 * v0 - INVERSE_MASS * stiffness * (far - place) * (far + place);
    let turned = [edge * edge + far - place, time, radiated];
    Some((turned, [peak_force, peak_force_time]))
}

/// The same on the fit, from the indentation where it leaves Hertz's law and the velocity there.
fn turned_on_fit(fit: &Fit, depth: f64, lag: f64, v0: f64) -> ([f64; 3], [f64; 2]) {
    let energy = v0 * v0 + depth.powf(2.5);
    let speed = energy.sqrt();
    let pressed = |depth: f64, v: f64| {
        let [force, stiffness] = fit.force(depth);
        let damped = lag * stiffness * stiffness * v;
        (force + damped, damped)
    };
    // in the logarithm of the angle
    let rates = |log: f64, [depth, ..]: &[f64; 3]| {
        let (sine, cosine) = log.exp().sin_cos();
        let (force, damped) = pressed(*depth, speed * cosine);
        let time = speed * sine * log.exp() / (INVERSE_MASS * force);
        let risen = time * speed * cosine;
        [risen, time, 2.0 * INVERSE_MASS * damped * risen]
    };
    // no difference of near numbers: however small, the angle is no zero, whose logarithm would take steps without end
    let from = depth.powf(1.25).atan2(v0).ln();
    let steps = ((FRAC_PI_2.ln() - from) / LONGEST_STEP).ceil();
    let step = (FRAC_PI_2.ln() - from) / steps;
    let turned = (0..steps as usize).fold([depth, 0.0, 0.0], |state, i| {
        extrapolated(rates, from + i as f64 * step, step, state)
    });
    // back over the velocity to the largest force, where it is of first order in the lag
    let [depth, time, _] = turned;
    let [force, stiffness] = fit.force(depth);
    let v = INVERSE_MASS * lag * stiffness * force;
    let back = |v: f64, [depth, _]: &[f64; 2]| {
        let slowing = INVERSE_MASS * pressed(*depth, v).0;
        [-v / slowing, -1.0 / slowing]
    };
    let [before, at] = extrapolated(back, 0.0, v, [depth, time]);
    (turned, [pressed(before, v).0, at])
}

/// A step of an ordinary equation by Gragg's midpoint rule, extrapolated to the order of twice its columns.
fn extrapolated<const N: usize>(
    rates: impl Fn(f64, &[f64; N]) -> [f64; N],
    from: f64,
    step: f64,
    state: [f64; N],
) -> [f64; N] {
    let moved = |state: &[f64; N], by: f64, rates: [f64; N]| {
        std::array::from_fn(|i| state[i] + by * rates[i])
    };
    let first = rates(from, &state);
    let mut table = [[0.0; N]; COLUMNS_OF_STEP];
    for k in 0..COLUMNS_OF_STEP {
        let parts = 2 * (k + 1);
        let part = step / parts as f64;
        let (mut before, mut now) = (state, moved(&state, part, first));
        for i in 1..parts {
            let next = moved(&before, 2.0 * part, rates(from + i as f64 * part, &now));
            (before, now) = (now, next);
        }
        let end = moved(&before, part, rates(from + step, &now));
        table[k] = std::array::from_fn(|i| 0.5 * (now[i] + end[i]));
        for j in (0..k).rev() {
            let ratio = (k + 1) as f64 / (j + 1) as f64;
            let (coarse, fine) = (table[j], table[j + 1]);
            let change = std::array::from_fn(|i| fine[i] - coarse[i]);
            table[j] = moved(&fine, 1.0 / (ratio * ratio - 1.0), change);
        }
    }
    table[0]
}

/// Velocity, time and radiated energy where the radius of contact reaches that of yield.
fn rise(edge: f64, lag: f64) -> Option<(f64, f64, f64)> {
    static COLUMNS_OF_STEP: OnceLock<[[f64; NODES_OF_RISE]; NODES_OF_RISE]> = OnceLock::new();
    let rule = RadauNodes::of(NODES_OF_RISE, false);
    let column = |j| std::array::from_fn(|i| rule.integral[i + 1][j]);
    let columns = COLUMNS_OF_STEP.get_or_init(|| std::array::from_fn(column));
    let (mut from, mut time, mut lost) = (0.0, 0.0, 0.0);
    let factor = 11.25 * lag;
    while from < edge {
        let to = edge.min(from + PART_OF_RISE * (1.0 - from));
        let width = to - from;
        let x: [f64; NODES_OF_RISE] = std::array::from_fn(|i| from + width * rule.places[i + 1]);
        let rest = x.map(|x| 1.0 - x * x * x * x * x - factor * lost);
        let (mut v, mut before) = (rest.map(f64::sqrt), 1.0);
        for _ in 0..MOST_ITERATIONS {
            let lost: [f64; NODES_OF_RISE] =
                std::array::from_fn(|j| factor * width * x[j].powi(3) * v[j]);
            let mut square = rest;
            for (weights, lost) in columns.iter().zip(lost) {
                let each = square.iter_mut().zip(weights);
                each.for_each(|(square, weight)| *square -= lost * weight);
            }
            let next = square.map(f64::sqrt);
            let changes = next.iter().zip(v).map(|(x, y)| (x - y).abs());
            let change = changes.fold(0.0, f64::max);
            v = next;
            // what the next iteration would change
            if change * change < 1e-12 * before {
                break;
            }
            before = change;
        }
        for (weight, (x, v)) in rule.integral[NODES_OF_RISE].iter().zip(x.iter().zip(v)) {
            time += 2.0 * width * weight * x / v;
            lost += width * weight * x * x * x * v;
        }
        from = to;
    }
    let square = 1.0 - edge.powi(5) - factor * lost;
    (square > 0.0 && time.is_finite()).then(|| (square.sqrt(), time, factor * lost))
}

/// Iterations of Picard at most: each is smaller by about the lag.
const MOST_ITERATIONS: usize = 30;

/// Largest lag of the fall, and terms of its series.
const LARGEST_LAG: f64 = 0.25;
const TERMS_OF_FALL: usize = 24;

/// Nodes of the series of a cut pressure in the lag and in the logarithm of the angle asin(y/a).
const NODES_OF_CUT: [usize; 2] = [8, 32];

/// Range of the angle, and the largest lag: the contact ends with less than the radius where the pressure was cut.
const ANGLES_OF_CUT: [f64; 2] = [0.02, 1.3];
const LARGEST_LAG_OF_CUT: f64 = 0.1;

/// Part of a result below which the last coefficients are left out.
const LEAST_COEFFICIENT: f64 = 1e-12;

/// Velocity, duration and the largest radius times velocity of Hertz's contact from rest at radius one, and the work that
/// it gives back without a lag.
fn fall(lag: f64) -> Option<[f64; 4]> {
    static MADE: OnceLock<Option<PlaneSeries<4>>> = OnceLock::new();
    let made = MADE.get_or_init(|| {
        let lag = |x: f64| 0.5 * LARGEST_LAG * (1.0 + x);
        let at = |[_, x]: [f64; 2]| March::from_rest(Branch::HERTZ, lag(x));
        PlaneSeries::through([1, TERMS_OF_FALL], LEAST_COEFFICIENT, at)
    });
    let x = 2.0 * lag / LARGEST_LAG - 1.0;
    Some(made.as_ref().filter(|_| lag <= LARGEST_LAG)?.at([0.0, x]))
}

/// The same of the unloading of a cut pressure, by the radius at yield; nothing beyond the series.
fn fall_of_cut(edge: f64, lag: f64) -> Option<[f64; 4]> {
    static MADE: OnceLock<Option<PlaneSeries<4>>> = OnceLock::new();
    let [low, high] = ANGLES_OF_CUT.map(f64::ln);
    let made = MADE.get_or_init(|| {
        PlaneSeries::through(NODES_OF_CUT, LEAST_COEFFICIENT, |[x, y]| {
            let edge = (low + 0.5 * (high - low) * (1.0 + y)).exp().sin();
            let branch = Branch::Truncated { edge, top: 1.0 };
            let lag = 0.5 * LARGEST_LAG_OF_CUT * (1.0 + x);
            let [speed, duration, pulled, stored] = March::from_rest(branch, lag)?;
            let root = edge.sqrt();
            Some([speed / root, duration * root, pulled / root, stored / edge])
        })
    });
    let y = 2.0 * (edge.asin().ln() - low) / (high - low) - 1.0;
    let x = 2.0 * lag / LARGEST_LAG_OF_CUT - 1.0;
    if !(y.abs() <= 1.0 && x <= 1.0) {
        return None;
    }
    let [speed, duration, pulled, stored] = made.as_ref()?.at([x, y]);
    let root = edge.sqrt();
    Some([speed * root, duration / root, pulled * root, stored * edge])
}
