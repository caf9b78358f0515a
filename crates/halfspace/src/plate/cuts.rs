//! Where the fronts of a wave cut an interval of slowness.

use crate::numeric::bisected;

/// The parts of [0, 1] between some cuts.
pub(crate) fn pieces(mut cuts: Vec<f64>) -> Vec<[f64; 2]> {
    const SAME: f64 = 1e-13;
    cuts.extend([0.0, 1.0]);
    cuts.sort_by(f64::total_cmp);
    cuts.dedup_by(|b, a| *b - *a < SAME);
    cuts.windows(2).map(|pair| [pair[0], pair[1]]).collect()
}

/// The root in [0, 1] of a function that falls where it is positive.
pub(crate) fn root_of_falling(height: &impl Fn(f64) -> f64) -> Option<f64> {
    (height(0.0) > 0.0 && height(1.0) < 0.0).then(|| root(height, 0.0, 1.0))
}

/// Adds the roots in [0, 1] of a function that rises, falls, or rises and then falls.
pub(crate) fn roots_of_concave(height: &impl Fn(f64) -> f64, roots: &mut Vec<f64>) {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let (from, to) = (0.0, 1.0);
    let ends = [height(from), height(to)];
    if ends[0] * ends[1] < 0.0 {
        roots.push(root(height, from, to));
        return;
    }
    if ends[0] > 0.0 {
        return;
    }
    // both ends are below: a root on each side of the largest value, if that is above
    let [mut low, mut high] = [from, to];
    for _ in 0..60 {
        let (a, b) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
        let (at_a, at_b) = (height(a), height(b));
        if at_a > 0.0 || at_b > 0.0 {
            let top = if at_a > at_b { a } else { b };
            roots.push(root(height, from, top));
            roots.push(root(height, top, to));
            return;
        }
        if at_a > at_b {
            high = b;
        } else {
            low = a;
        }
    }
}

fn root(height: &impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    let rising = height(to) > height(from);
    bisected(from, to, |v| (height(v) > 0.0) != rising)
}
