//! The implicit scheme on a disc of fixed radius: the default.
//!
//! Each step solves A y^3 + y^2 = B for y = p^(1/3), where A collects what the newest force does to
//! the striker and to the half-space, and B all that is known.
//! The striker moves by Numerov's sum with the 3/2-power start taken out, the half-space answers by
//! product integration that is exact for a force linear in each cell and corrected for its curvature:
//! the scheme is of an order between 2 and 4 where the force is smooth, and stable at any step.

use super::edge::Edge;
use super::flight::{Flight, STARTING, Start, starting_roots};
use super::lag::{Lag, RESOLVED, lag};
use super::weights::Weights;
use super::{Budget, History, MarchError, StaticShare};
use halfspace::SurfaceResponse;

/// An impact on a disc of fixed radius, in dimensionless groups.
#[derive(Debug, Clone)]
pub struct FixedDisc<'a> {
    /// Step response of the deflection of the disc.
    pub response: &'a SurfaceResponse,
    /// Static deflection of the disc under Hertz's largest force over Hertz's largest approach.
    pub coupling: f64,
    /// r0/c1 in collision times.
    pub wave_time: f64,
    /// Which part of the deflection enters.
    pub share: StaticShare,
}

impl FixedDisc<'_> {
    /// Memory of the half-space in collision times.
    #[must_use]
    pub fn memory(&self) -> f64 {
        self.response.memory() * self.wave_time
    }
}

/// Marches with a fixed step (collision units).
///
/// # Errors
/// [`MarchError::NoSolution`] where the `dynamic` share is not well posed,
/// [`MarchError::TooLong`] when the work is out of bounds.
pub fn march_implicit(impact: &FixedDisc<'_>, step: f64) -> Result<History, MarchError> {
    // before the weights, which need one evaluation a cell
    let budget = Budget::of_memory(impact.memory(), step)?;
    let weights = Weights::of(impact, impact.response, step);
    let mut history = History::at_touch(step, 256);
    let lag = lag(impact.response, impact.coupling, impact.wave_time / step);
    advance(&lag, impact.share, &weights, &budget, &mut history)?;
    history.separate(&lag);
    Ok(history)
}

/// Marches a history that holds the touch until the striker has left for good.
pub(crate) fn advance(
    lag: &Lag<impl Fn(f64) -> f64>,
    share: StaticShare,
    weights: &Weights,
    budget: &Budget,
    history: &mut History,
) -> Result<(), MarchError> {
    let (step, coupling) = (history.step, lag.coupling);
    let newest_lag = weights.lag[0];
    let elastic = coupling * (share.factor() - newest_lag);
    let roots = starting_roots(step, elastic);
    let start = Start::new(step, elastic, &roots);
    let missed = missed(lag, weights, &Edge::touch(elastic.max(0.0), step), &roots);
    let mut flight = Flight::new(step, start);
    let inertia = flight.newest_weight();
    history.start = start.force;
    let compliance = inertia + elastic;
    history.compliance = compliance;
    history.elastic = elastic;
    // the last five roots, newest first: the guess is the polynomial through them
    let mut roots = [0.0_f64; 5];
    let mut free_since = 0;
    loop {
        let n = history.force.len();
        let newest = history.force[n - 1];
        let past = weights.past(&history.force) + missed.get(n - 1).copied().unwrap_or(0.0);
        let known_deflection = coupling * (newest_lag * newest - past);
        let free = flight.free_displacement();
        let known = free - known_deflection;
        let guess = 5.0 * (roots[0] - roots[3]) + 10.0 * (roots[2] - roots[1]) + roots[4];
        let solved = solve(compliance, known, guess).ok_or(MarchError::NoSolution {
            time: n as f64 * step,
            coupling,
        })?;
        roots = [solved, roots[0], roots[1], roots[2], roots[3]];
        let force = solved * solved * solved;
        history.push(
            force,
            free - inertia * force,
            known_deflection + elastic * force,
        );
        flight.push(force);
        if force > 0.0 {
            free_since = 0;
        } else {
            free_since += 1;
            if free_since >= weights.lag.len() && history.last_velocity() <= 0.0 {
                return Ok(());
            }
        }
        if n.is_multiple_of(1024) {
            budget.check(n)?;
        }
    }
}

/// What the weights miss of the lagging deflection at the first samples.
///
/// They follow a parabola through the samples, the force at the touch has the roots of `edge`.
fn missed(
    lag: &Lag<impl Fn(f64) -> f64>,
    weights: &Weights,
    edge: &Edge,
    roots: &[f64; STARTING],
) -> [f64; STARTING] {
    if lag.memory > RESOLVED {
        return [0.0; STARTING];
    }
    let mut force = [0.0; STARTING + 1];
    std::array::from_fn(|i| {
        let y = roots[i];
        force[i + 1] = y * y * y;
        edge.lagging_at_touch(lag, y) - weights.lagging(&force[..i + 2])
    })
}

/// The smallest y >= 0 of a y^3 + y^2 = b, relative error below 1e-12; zero where b <= 0, nothing where there is none.
pub(crate) fn solve(a: f64, b: f64, guess: f64) -> Option<f64> {
    if b.is_nan() {
        return None;
    }
    if b <= 0.0 {
        return Some(0.0);
    }
    // For a >= 0 the left side and its derivatives rise, so that Halley's method finds its root from any y > 0.
    if a >= 0.0 && guess > 0.0 {
        let mut y = guess;
        for _ in 0..8 {
            let value = (a * y + 1.0) * y * y - b;
            let slope = (3.0 * a * y + 2.0) * y;
            let change = value * slope / (slope * slope - value * (3.0 * a * y + 1.0));
            y -= change;
            // the relative error is cubed each time, with a factor below 1/2
            if change.abs() <= 1e-4 * y {
                return Some(y);
            }
            if y <= 0.0 || y.is_nan() {
                break;
            }
        }
    }
    // The root lies below sqrt(b) for a > 0, and below the fold 2/(3 |a|) for a < 0.
    let (mut low, mut high) = if a >= 0.0 {
        (0.0, b.sqrt())
    } else {
        let fold = -2.0 / (3.0 * a);
        if fold * fold * (1.0 + a * fold) < b {
            return None;
        }
        (b.sqrt().min(fold), fold)
    };
    let mut y = if guess > low && guess < high {
        guess
    } else {
        high
    };
    for _ in 0..100 {
        let value = (a * y + 1.0) * y * y - b;
        if value > 0.0 {
            high = y;
        } else {
            low = y;
        }
        let newton = y - value / ((3.0 * a * y + 2.0) * y);
        let next = if newton >= low && newton <= high {
            newton
        } else {
            0.5 * (low + high)
        };
        // Newton's error is squared each time: the next one would be below the last digit
        if (next - y).abs() <= 1e-8 * y {
            return Some(next);
        }
        y = next;
    }
    Some(y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cubic_is_solved_on_its_physical_branch() {
        for a in [-0.9, -0.3, 0.0, 1e-9, 0.1, 10.0, 1e9] {
            for y in [1e-12, 1e-3, 0.1, 0.7] {
                let b: f64 = (a * y + 1.0) * y * y;
                for guess in [0.0, y, 0.5, -1.0, f64::NAN] {
                    let found = solve(a, b, guess).unwrap();
                    assert!((found / y - 1.0).abs() < 1e-12, "{a} {y} {found}");
                }
            }
        }
        assert_eq!(solve(-0.9, 0.3, 0.5), None);
        assert_eq!(solve(0.3, -1.0, 0.5), Some(0.0));
        assert_eq!(solve(0.3, f64::NAN, 0.5), None);
    }
}
