//! Implicit marches of known order for the impact on a disc, for comparison with the program's march.
//!
//! ```text
//! d'' = -(5/4) p,   p^(2/3) = d - w,   w_n = sigma [p_n - sum_j g_j (p_{n-j} - p_{n-j-1})]
//! order 1   force constant in a cell:  g_j = 1 - W((j + 1) h)
//! order 2   force linear in a cell:    g_j = 1 - (1/h) int W over the cell
//! ```
//!
//! Product integration after Linz (1985); collision units as in [`contact::CollisionUnits`].

use contact::{FixedDisc, Summary};

/// Shape of the force within a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum MarchOrder {
    First,
    Second,
}

/// Differences of peak force, contact time, restitution and peak displacement from a reference: absolute for the
/// restitution, relative for the others.
pub(crate) fn errors(found: &Summary, exact: &Summary) -> [f64; 4] {
    let relative = |found: f64, exact: f64| match found - exact {
        0.0 => 0.0,
        difference => difference / exact,
    };
    [
        relative(found.peak_force, exact.peak_force),
        relative(found.contact_time, exact.contact_time),
        found.restitution - exact.restitution,
        relative(found.peak_displacement, exact.peak_displacement),
    ]
}

/// Marches until the first separation; returns the results for [`errors`] and the work, steps times cells of memory.
pub(crate) fn march(
    impact: &FixedDisc<'_>,
    step: f64,
    order: MarchOrder,
) -> (Summary, Option<u64>) {
    const MOST_STEPS: usize = 1_000_000;
    let cell = step / impact.wave_time;
    let cells = (impact.response.disc.memory / cell).ceil() as usize + 1;
    let response = impact.response;
    let followed = |from: f64, to: f64| match order {
        MarchOrder::First => response.step(to),
        MarchOrder::Second => (response.step_integral(to) - response.step_integral(from)) / cell,
    };
    let lag = |j: usize| 1.0 - followed(j as f64 * cell, (j + 1) as f64 * cell);
    let lag: Vec<f64> = (0..cells).map(lag).collect();
    // effect of the newest force on v h and on d
    let (swing, push) = match order {
        MarchOrder::First => ([0.0, 1.0], [0.0, 0.5]),
        MarchOrder::Second => ([0.5, 0.5], [1.0 / 3.0, 1.0 / 6.0]),
    };
    let inertia = 1.25 * step * step;
    let compliance = inertia * push[1] + impact.coupling * (1.0 - lag[0]);
    let (mut d, mut v) = (0.0, 1.0);
    let mut force = vec![0.0_f64];
    let mut displacement = vec![0.0];
    let mut work = 0;
    loop {
        let n = force.len();
        let before = force[n - 1];
        let terms = (1..cells.min(n)).map(|j| lag[j] * (force[n - j] - force[n - j - 1]));
        let past: f64 = terms.sum();
        work += cells.min(n) as u64;
        let free = d + step * v - inertia * push[0] * before;
        let known = impact.coupling * (lag[0] * before - past);
        let p = solve(compliance, free - known);
        if p <= 0.0 || n > MOST_STEPS {
            // the gap closes linearly over the last step
            let (inside, outside) = (before.cbrt().powi(2), known - free);
            let share = inside / (inside + outside.max(f64::MIN_POSITIVE));
            let velocity = v - 1.25 * step * share * swing[0] * before;
            let found = Summary {
                peak_force: peak(&force),
                contact_time: (n as f64 - 1.0 + share) * step,
                restitution: -velocity,
                peak_displacement: peak(&displacement),
                ..Summary::default()
            };
            return (found, Some(work));
        }
        d = free - inertia * push[1] * p;
        v -= 1.25 * step * (swing[0] * before + swing[1] * p);
        force.push(p);
        displacement.push(d);
    }
}

/// p of a p + p^(2/3) = b, a >= 0; zero for b <= 0.
fn solve(a: f64, b: f64) -> f64 {
    if b <= 0.0 {
        return 0.0;
    }
    let mut y = b.sqrt();
    for _ in 0..60 {
        let next = y - ((a * y + 1.0) * y * y - b) / ((3.0 * a * y + 2.0) * y);
        if (next - y).abs() <= 1e-15 * y {
            return next.powi(3);
        }
        y = next;
    }
    y.powi(3)
}

/// Largest value of the parabola through the largest sample and its neighbours.
fn peak(samples: &[f64]) -> f64 {
    let larger = |&a: &usize, &b: &usize| samples[a].total_cmp(&samples[b]);
    let top = (0..samples.len()).max_by(larger).unwrap_or(0);
    if top == 0 || top + 1 >= samples.len() {
        return samples[top];
    }
    let [a, b, c] = [samples[top - 1], samples[top], samples[top + 1]];
    let bend = a - 2.0 * b + c;
    let rise = (c - a).powi(2) / (8.0 * bend);
    if bend < 0.0 { b - rise } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;
    use contact::{StaticShare, march_implicit, refine};
    use halfspace::{Deflection, Medium, SurfaceResponse};

    #[test]
    fn each_march_converges_with_its_order() {
        let response = SurfaceResponse::new(&Medium::new(0.3).unwrap(), Deflection::Centre);
        let impact = FixedDisc {
            response: &response,
            coupling: 0.14,
            wave_time: 0.08,
            share: StaticShare::Full,
        };
        let exact = refine(|step| march_implicit(&impact, step), 0.02, 1e-9).unwrap();
        let exact = exact.summary;
        let own = Summary::new(&march_implicit(&impact, 0.01).unwrap()).unwrap();
        assert!((own.peak_force / exact.peak_force - 1.0).abs() < 1e-5);
        for (order, least) in [(MarchOrder::First, 0.9), (MarchOrder::Second, 1.7)] {
            let error = |step: f64| {
                let errors = errors(&march(&impact, step, order).0, &exact);
                errors.iter().fold(0.0_f64, |a, e| a.max(e.abs()))
            };
            for step in [0.02, 0.01, 0.005] {
                let observed = (error(step) / error(0.5 * step)).log2();
                assert!(observed > least, "{order:?} at {step}: {observed}");
            }
        }
    }
}
