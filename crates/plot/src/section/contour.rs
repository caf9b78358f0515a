//! Contour line of a field on a grid.

use super::frames::SectionGrid;

/// The contour of a value, piece by piece, each followed by a point of NaN, which interrupts a curve.
///
/// The field is linear within each triangle, half of a cell: a piece is the straight line between two of its sides.
pub(super) fn contour(grid: &SectionGrid, level: f64) -> Vec<(f64, f64)> {
    let width = grid.r_m.len();
    let node = |i: usize, k: usize| {
        let above = grid.values[k * width + i] - level;
        ((grid.r_m[i], grid.z_m[k]), above)
    };
    let mut points = Vec::new();
    for k in 1..grid.z_m.len() {
        for i in 1..width {
            let [a, b] = [node(i - 1, k - 1), node(i, k)];
            for third in [node(i, k - 1), node(i - 1, k)] {
                let crossed: Vec<_> = [(a, b), (b, third), (third, a)]
                    .into_iter()
                    .filter_map(|(from, to)| crossing(from, to))
                    .collect();
                if let [from, to] = crossed[..] {
                    points.extend([from, to, (f64::NAN, f64::NAN)]);
                }
            }
        }
    }
    points
}

/// A place and the difference of its value from the level.
type Node = ((f64, f64), f64);

/// Point on a side with the value of the level, if it lies between the ends.
fn crossing((from, a): Node, (to, b): Node) -> Option<(f64, f64)> {
    let part = a / (a - b);
    let on = |from: f64, to: f64| from + part * (to - from);
    ((a < 0.0) != (b < 0.0)).then(|| (on(from.0, to.0), on(from.1, to.1)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_contour_of_a_cone_is_a_circle() {
        let side: Vec<f64> = (0..=40).map(|i| 0.1 * f64::from(i)).collect();
        let places = side
            .iter()
            .flat_map(|z| side.iter().map(move |r| r.hypot(*z)));
        let grid = SectionGrid {
            values: places.collect(),
            r_m: side.clone(),
            z_m: side.clone(),
        };
        let found = contour(&grid, 2.35);
        let known = || found.iter().filter(|p| p.0.is_finite());
        assert!(known().count() > 80);
        // a chord of a cell's diagonal deviates by at most 0.1^2/4/2.35 from the circle
        assert!(known().all(|p| (p.0.hypot(p.1) - 2.35).abs() < 2e-3));
        assert!(contour(&grid, 9.0).is_empty());
    }
}
