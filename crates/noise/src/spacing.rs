//! Nodes whose distance grows from a part of their value to a constant, and cubic interpolation between them.

/// Nodes at equal steps of ln x + x `linear`: close to zero their distance is a part `step` of x, far out step/linear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spacing {
    start: f64,
    step: f64,
    linear: f64,
    /// Number of nodes.
    pub(crate) count: usize,
}

impl Spacing {
    /// Covers an interval above zero.
    pub(crate) fn new([low, high]: [f64; 2], step: f64, linear: f64) -> Self {
        let [from, to] = [low, high].map(|x| x.ln() + linear * x);
        let cells = ((to - from) / step).max(0.0).ceil();
        Self {
            start: from - step,
            step,
            linear,
            count: cells as usize + 4,
        }
    }

    /// A node; between nodes for a fraction.
    pub(crate) fn node(&self, place: f64) -> f64 {
        let wanted = self.start + self.step * place;
        // Newton's method in ln x, from above the root of a convex function
        let mut log = wanted.min((wanted.max(1.0) / self.linear).ln());
        for _ in 0..60 {
            let far = self.linear * log.exp();
            let change = (log + far - wanted) / (1.0 + far);
            log -= change;
            if change.abs() < 1e-14 {
                break;
            }
        }
        log.exp()
    }

    /// The first of the four nodes around x, and their weights; outside of the interval those of its end.
    pub(crate) fn at(&self, x: f64) -> (usize, [f64; 4]) {
        let place = (x.ln() + self.linear * x - self.start) / self.step;
        let place = place.clamp(1.0, (self.count - 2) as f64);
        let first = (place as usize - 1).min(self.count - 4);
        (first, cubic(place - first as f64 - 1.0))
    }
}

/// Weights of the values at -1, 0, 1 and 2 of the cubic through them, at t.
pub(crate) fn cubic(t: f64) -> [f64; 4] {
    let [before, after, beyond] = [t + 1.0, t - 1.0, t - 2.0];
    [
        -t * after * beyond / 6.0,
        before * after * beyond / 2.0,
        -before * t * beyond / 2.0,
        before * t * after / 6.0,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_of_the_coordinate_is_exact() {
        let spacing = Spacing::new([1e-3, 300.0], 0.1, 0.2);
        let coordinate = |x: f64| x.ln() + 0.2 * x;
        let value = |x: f64| {
            1.0 + coordinate(x) - 0.02 * coordinate(x).powi(2) + 1e-4 * coordinate(x).powi(3)
        };
        for x in [1e-3, 2.2e-3, 0.5, 7.7, 120.0, 300.0] {
            let (first, weights) = spacing.at(x);
            let sum: f64 = (0..4)
                .map(|i| weights[i] * value(spacing.node((first + i) as f64)))
                .sum();
            assert!(
                (sum / value(x) - 1.0).abs() < 1e-12,
                "{x} {sum} {}",
                value(x)
            );
            assert!(spacing.node(first as f64) <= x && spacing.node((first + 3) as f64) >= x);
        }
    }
}
