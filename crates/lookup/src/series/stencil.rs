//! Lagrange interpolation on one axis, with the mirror image across r = 0.

use halfspace::lagrange;

/// Largest number of points of a stencil.
pub(crate) const MAX_POINTS: usize = 8;

/// Index i of the interval [nodes\[i\], nodes\[i+1\]] that contains `x`; the last interval is closed.
///
/// `nodes` ascend strictly and have at least two entries. The result is `None` outside, and for NaN.
pub fn locate(nodes: &[f64], x: f64) -> Option<usize> {
    let last = *nodes.last()?;
    if !(x >= nodes[0] && x <= last) {
        return None;
    }
    let above = nodes.partition_point(|&node| node <= x);
    Some(above.clamp(1, nodes.len() - 1) - 1)
}

/// Nodes of an interpolation and their weights.
///
/// At a node the weights are exactly one and zero, so that a table returns its stored values there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stencil {
    points: usize,
    node: [usize; MAX_POINTS],
    even: [f64; MAX_POINTS],
    odd: [f64; MAX_POINTS],
}

impl Stencil {
    /// Stencil of `points` (at most 8, at most the number of nodes) around `x` in `interval`, one-sided at both ends.
    pub fn one_sided(nodes: &[f64], interval: usize, x: f64, points: usize) -> Self {
        Self::from_node(0, nodes, interval, x, points)
    }

    /// Stencil around `x` in `interval` on an axis that starts at r = 0, continued to negative r by its mirror image.
    ///
    /// A mirrored node -nodes\[i\] adds its weight to node i: with its sign for even fields
    /// ([`Self::even`]) and against it for odd ones ([`Self::odd`]).
    pub fn mirrored(nodes: &[f64], interval: usize, x: f64, points: usize) -> Self {
        Self::from_node(isize::MIN, nodes, interval, x, points)
    }

    /// Stencil that begins with the node `least`, or after it; nodes before the first are mirrored.
    fn from_node(least: isize, nodes: &[f64], interval: usize, x: f64, points: usize) -> Self {
        let points = points.min(nodes.len()).min(MAX_POINTS);
        let first = (interval as isize + 1 - (points / 2) as isize).max(least);
        let first = first.min((nodes.len() - points) as isize);
        let position = |j: usize| {
            let i = first + j as isize;
            if i < 0 {
                -nodes[i.unsigned_abs()]
            } else {
                nodes[i.unsigned_abs()]
            }
        };
        let base = first.max(0) as usize;
        let mut stencil = Self {
            points: 0,
            node: [0; MAX_POINTS],
            even: [0.0; MAX_POINTS],
            odd: [0.0; MAX_POINTS],
        };
        for k in 0..points {
            let index = first + k as isize;
            let weight = lagrange(position, points, k, x);
            let slot = index.unsigned_abs() - base;
            stencil.node[slot] = index.unsigned_abs();
            stencil.even[slot] += weight;
            stencil.odd[slot] += if index < 0 { -weight } else { weight };
            stencil.points = stencil.points.max(slot + 1);
        }
        stencil
    }

    /// Indices of the nodes, ascending.
    pub fn nodes(&self) -> &[usize] {
        &self.node[..self.points]
    }

    /// Weights of a field that is even across r = 0.
    pub fn even(&self) -> &[f64] {
        &self.even[..self.points]
    }

    /// Weights of a field that is odd across r = 0.
    pub fn odd(&self) -> &[f64] {
        &self.odd[..self.points]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis() -> Vec<f64> {
        (0..13)
            .map(|i| 0.125 * i as f64 + 0.01 * (i * i) as f64)
            .collect()
    }

    fn sum(weights: &[f64], nodes: &[usize], f: impl Fn(usize) -> f64) -> f64 {
        weights.iter().zip(nodes).map(|(w, &i)| w * f(i)).sum()
    }

    #[test]
    fn polynomials_of_the_stencils_degree_are_exact() {
        let axis = axis();
        for points in [2, 4, 6, 8] {
            for step in 0..=300 {
                let x = axis[12] * f64::from(step) / 300.0;
                let interval = locate(&axis, x).unwrap();
                let one_sided = Stencil::one_sided(&axis, interval, x, points);
                let mirrored = Stencil::mirrored(&axis, interval, x, points);
                for degree in 0..points as i32 {
                    let f = |i: usize| axis[i].powi(degree);
                    let exact = x.powi(degree);
                    let scale = 1e-11 * axis[12].powi(degree);
                    assert!((sum(one_sided.even(), one_sided.nodes(), f) - exact).abs() < scale);
                    let weights = if degree % 2 == 0 {
                        mirrored.even()
                    } else {
                        mirrored.odd()
                    };
                    assert!((sum(weights, mirrored.nodes(), f) - exact).abs() < scale);
                }
            }
        }
    }

    #[test]
    fn nodes_are_returned_exactly() {
        let axis = axis();
        for (i, &x) in axis.iter().enumerate() {
            let interval = locate(&axis, x).unwrap();
            for stencil in [
                Stencil::one_sided(&axis, interval, x, 6),
                Stencil::mirrored(&axis, interval, x, 6),
            ] {
                for ((&node, &even), &odd) in stencil
                    .nodes()
                    .iter()
                    .zip(stencil.even())
                    .zip(stencil.odd())
                {
                    let expected = if node == i { 1.0 } else { 0.0 };
                    assert_eq!(even, expected);
                    assert_eq!(odd, expected);
                }
            }
        }
    }

    #[test]
    fn the_range_is_closed_and_one_ulp_beyond_is_outside() {
        let axis = axis();
        let last = axis[12];
        assert_eq!(locate(&axis, 0.0), Some(0));
        assert_eq!(locate(&axis, -0.0), Some(0));
        assert_eq!(locate(&axis, last), Some(11));
        assert_eq!(locate(&axis, last.next_down()), Some(11));
        for x in [
            last.next_up(),
            (0.0_f64).next_down(),
            f64::NAN,
            f64::INFINITY,
            -1.0,
        ] {
            assert_eq!(locate(&axis, x), None);
        }
    }
}
