//! Thornton's contact with a dashpot in three parts that need no march.
//!
//! ```text
//! rise    x = sqrt(u):  v^2 = 1 - x^5 - (45/4) c int x^3 v dx,  t = int 2 x dx/v     Gauss and Picard
//! flow    p = k X + c k^2 v,  X'' = -(5/4) p,  k = (3/2) y                         a damped oscillator
//! fall    Hertz's contact from rest, of the lag c a^1.5 alone                        series, made once
//! ```
//!
//! Theory: `docs/theory.md` (T66).

use crate::model::Plasticity;
use crate::numeric::quadrature::chebyshev;
use crate::plastic::Yielding;
use crate::plastic::branch::Branch;
use crate::plastic::march::March;
use crate::plastic::problem::Waves;
use crate::plastic::solved::Flow;
use crate::summary::{EndOfContact, Summary};
use crate::units::INVERSE_MASS;
use std::f64::consts::PI;
use std::sync::OnceLock;

/// Nodes of a panel of the rise, and the part of the way to Hertz's turning point that it takes.
const NODES: usize = 8;
const PART: f64 = 0.6;

/// Largest lag of the fall, and terms of its series.
const LARGEST_LAG: f64 = 0.1;
const TERMS: usize = 20;

/// Results to 1e-9 for a lag; nothing for other laws, for a lag beyond the series, where waves keep the contact from
/// yielding, and where the force is largest before it does.
pub(crate) fn quick(yielding: &Yielding, lag: f64) -> Option<(Summary, Flow)> {
    if yielding.law != Plasticity::Thornton {
        return None;
    }
    let edge = yielding.edge();
    let (v0, t0, mut radiated) = rise(edge, lag)?;
    let stiffness = 1.5 * edge;
    let (square, damping) = (
        INVERSE_MASS * stiffness,
        0.5 * INVERSE_MASS * lag * stiffness * stiffness,
    );
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
    let ((peak_time, peak_force), (turn, far)) = (extremum(push, rate), extremum(place, v0));
    let depth = edge * edge + far - place;
    let top = depth.sqrt();
    radiated += v0 * v0 - INVERSE_MASS * stiffness * (far - place) * (far + place);
    let (back, _) = yielding.unloading(top);
    let own_lag = lag * depth.sqrt() * top.sqrt();
    if own_lag > LARGEST_LAG || own_lag.is_nan() {
        return None;
    }
    let length = depth / back.flatter();
    let x = 2.0 * own_lag / LARGEST_LAG - 1.0;
    let [speed, duration, pulled] = fall().each_ref().map(|series| chebyshev(series, x));
    let v = speed * length * top.sqrt();
    radiated += 2.0 * INVERSE_MASS * back.given_back(top) - v * v;
    Some((
        Summary {
            peak_force,
            peak_force_time: t0 + peak_time,
            contact_time: t0 + turn + duration / top.sqrt(),
            restitution: v,
            loss: (1.0 - v) * (1.0 + v),
            peak_displacement: depth,
            peak_deflection: 1.5 * lag * pulled * length * depth.sqrt() * top.sqrt(),
            impulse: (1.0 + v) / INVERSE_MASS,
            contacts: 1,
            end: EndOfContact::Layer(0.0),
        },
        Flow::new(yielding, top, radiated),
    ))
}

/// Velocity, time and radiated energy where the radius of contact reaches that of yield.
fn rise(edge: f64, lag: f64) -> Option<(f64, f64, f64)> {
    let rule = panel();
    let (mut from, mut time, mut lost) = (0.0, 0.0, 0.0);
    let factor = 11.25 * lag;
    while from < edge {
        let to = edge.min(from + PART * (1.0 - from));
        let width = to - from;
        let x: [f64; NODES] = std::array::from_fn(|i| from + width * rule.places[i]);
        let rest = x.map(|x| 1.0 - x * x * x * x * x - factor * lost);
        let mut v = rest.map(f64::sqrt);
        for _ in 0..ITERATIONS {
            let moved: [f64; NODES] = std::array::from_fn(|j| width * x[j] * x[j] * x[j] * v[j]);
            let mut change = 0.0_f64;
            for i in 0..NODES {
                let sum: f64 = (0..NODES).map(|j| rule.integral[i][j] * moved[j]).sum();
                let next = (rest[i] - factor * sum).sqrt();
                change = change.max((next - v[i]).abs());
                v[i] = next;
            }
            if change < 1e-12 {
                break;
            }
        }
        let over =
            |f: &dyn Fn(usize) -> f64| -> f64 { (0..NODES).map(|j| rule.weights[j] * f(j)).sum() };
        time += width * over(&|j| 2.0 * x[j] / v[j]);
        lost += width * over(&|j| x[j] * x[j] * x[j] * v[j]);
        from = to;
    }
    let square = 1.0 - edge.powi(5) - factor * lost;
    (square > 0.0 && time.is_finite()).then(|| (square.sqrt(), time, factor * lost))
}

/// Iterations of Picard at most: each is smaller by about the lag.
const ITERATIONS: usize = 30;

/// Gauss's rule on [0, 1] with the integrals up to each node.
struct Panel {
    places: [f64; NODES],
    weights: [f64; NODES],
    integral: [[f64; NODES]; NODES],
}

fn panel() -> &'static Panel {
    static MADE: OnceLock<Panel> = OnceLock::new();
    MADE.get_or_init(|| {
        let rule = crate::numeric::quadrature::GAUSS_8;
        let lagrange = |x: f64, j: usize| -> f64 {
            let others = (0..NODES).filter(|&k| k != j);
            others
                .map(|k| (x - rule[k].0) / (rule[j].0 - rule[k].0))
                .product()
        };
        Panel {
            places: rule.map(|node| node.0),
            weights: rule.map(|node| node.1),
            integral: std::array::from_fn(|i| {
                std::array::from_fn(|j| {
                    let upto = rule[i].0;
                    let parts = rule.iter().map(|&(x, w)| w * lagrange(upto * x, j));
                    upto * parts.sum::<f64>()
                })
            }),
        }
    })
}

/// Velocity, duration and the largest radius times velocity of Hertz's contact from rest at radius one, over its lag:
/// Chebyshev series in 2 c/[`LARGEST_LAG`] - 1.
fn fall() -> &'static [[f64; TERMS]; 3] {
    static MADE: OnceLock<[[f64; TERMS]; 3]> = OnceLock::new();
    MADE.get_or_init(|| {
        let angle = |i: usize| PI * (i as f64 + 0.5) / TERMS as f64;
        let values: [[f64; 3]; TERMS] = std::array::from_fn(|i| {
            let lag = 0.5 * LARGEST_LAG * (1.0 + angle(i).cos());
            March::from_rest(Branch::Hertz, Waves::Dashpot(lag)).unwrap_or([f64::NAN; 3])
        });
        std::array::from_fn(|k| {
            std::array::from_fn(|n| {
                let terms = (0..TERMS).map(|i| values[i][k] * (n as f64 * angle(i)).cos());
                terms.sum::<f64>() * if n == 0 { 1.0 } else { 2.0 } / TERMS as f64
            })
        })
    })
}
