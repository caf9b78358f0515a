//! Quadrature of a function whose singularities are all known.
//!
//! The interval is cut at the singularities that lie on it; toward a cut the variable is squared, which
//! turns square roots into smooth functions. A panel is accepted when every singularity lies outside a
//! Bernstein ellipse large enough for a Gauss rule to reach the accuracy asked for, else it is halved.
//! So the number of nodes follows from the geometry, and nothing is evaluated twice.

use crate::gauss;
use num_complex::Complex64;

/// Panels are halved rather than given more nodes than this.
const MOST_NODES: usize = 20;

/// A panel narrower than this share of its piece is taken as it is.
const NARROWEST: f64 = 1e-9;

/// An interval of a smooth variable with everything that is not smooth near it.
#[derive(Debug, Default)]
pub(crate) struct Landscape {
    /// Points of the interval at which it is cut: square-root or logarithmic singularities.
    pub(crate) cuts: Vec<f64>,
    /// All other singularities, complex or outside the interval.
    pub(crate) singularities: Vec<Complex64>,
}

impl Landscape {
    /// Adds a singularity: a cut if it lies on (from, to), a nearby point otherwise.
    pub(crate) fn add(&mut self, point: Complex64, from: f64, to: f64) {
        /// A singularity this close to the interval is worth a cut: the squared variable resolves it sooner.
        const CLOSE: f64 = 0.02;
        let inside = point.re > from && point.re < to;
        if inside && point.im.abs() < CLOSE {
            self.cuts.push(point.re);
        }
        let distance = (from - point.re).max(point.re - to).max(0.0);
        if (!inside || point.im != 0.0) && distance < 2.0 && point.im.abs() < 2.0 {
            self.singularities.push(point);
        }
    }

    /// Sorts the cuts, with the ends of the interval, and merges equal ones.
    pub(crate) fn ends(&mut self, from: f64, to: f64) -> Vec<f64> {
        self.cuts.sort_by(f64::total_cmp);
        self.cuts.dedup_by(|b, a| *b - *a < 1e-15);
        let mut ends = vec![from];
        ends.extend(self.cuts.iter().copied().filter(|&c| c > from && c < to));
        ends.push(to);
        ends
    }
}

/// A squared or plain variable on a piece of the interval: v = origin + scale s or origin + scale s^2.
#[derive(Debug, Clone, Copy)]
enum Map {
    Plain { origin: f64, scale: f64 },
    Squared { origin: f64, scale: f64 },
}

/// Visits nodes (v, weight) of a rule on [from, to] accurate to exp(-`digits`) of the size of the integrand.
///
/// `cut_from` and `cut_to` tell which ends are cuts.
pub(crate) fn visit(
    (from, to): (f64, f64),
    landscape: &Landscape,
    digits: f64,
    f: &mut impl FnMut(f64, f64),
) {
    let is_cut = |end: f64| landscape.cuts.contains(&end);
    match (is_cut(from), is_cut(to)) {
        (false, false) => {
            let map = Map::Plain {
                origin: from,
                scale: to - from,
            };
            map.visit(landscape, digits, f);
        }
        (true, false) => Map::squared(from, to).visit(landscape, digits, f),
        (false, true) => Map::squared(to, from).visit(landscape, digits, f),
        (true, true) => {
            let middle = 0.5 * (from + to);
            Map::squared(from, middle).visit(landscape, digits, f);
            Map::squared(to, middle).visit(landscape, digits, f);
        }
    }
}

impl Map {
    fn squared(origin: f64, end: f64) -> Self {
        Self::Squared {
            origin,
            scale: end - origin,
        }
    }

    fn visit(self, landscape: &Landscape, digits: f64, f: &mut impl FnMut(f64, f64)) {
        let images = self.images(landscape);
        let mut stack = vec![(0.0, 1.0)];
        while let Some((s0, s1)) = stack.pop() {
            let ellipse = smallest_ellipse(&images, s0, s1);
            let nodes = (digits / (2.0 * ellipse.ln())).ceil() + 1.0;
            let n = if nodes <= MOST_NODES as f64 {
                (nodes as usize).max(3)
            } else if s1 - s0 > NARROWEST {
                let middle = 0.5 * (s0 + s1);
                stack.push((middle, s1));
                stack.push((s0, middle));
                continue;
            } else {
                MOST_NODES
            };
            for (s, weight) in gauss::rule(n).on(s0, s1) {
                match self {
                    Self::Plain { origin, scale } => f(origin + scale * s, weight * scale.abs()),
                    Self::Squared { origin, scale } => {
                        f(origin + scale * s * s, 2.0 * weight * s * scale.abs());
                    }
                }
            }
        }
    }

    /// Singularities in the variable s.
    fn images(self, landscape: &Landscape) -> Vec<Complex64> {
        let cuts = landscape.cuts.iter().map(|&c| Complex64::new(c, 0.0));
        let all = cuts.chain(landscape.singularities.iter().copied());
        match self {
            Self::Plain { origin, scale } => all.map(|v| (v - origin) / scale).collect(),
            Self::Squared { origin, scale } => all
                .filter(|v| (v - origin).norm() > 1e-15)
                .flat_map(|v| {
                    let s = ((v - origin) / scale).sqrt();
                    [s, -s]
                })
                .collect(),
        }
    }
}

/// Sum of half axes of the smallest ellipse with foci s0, s1 through a singularity, focal distance 2.
fn smallest_ellipse(images: &[Complex64], s0: f64, s1: f64) -> f64 {
    let (middle, inverse) = (0.5 * (s0 + s1), 2.0 / (s1 - s0));
    let mut least = 40.0_f64;
    for image in images {
        let (x, y2) = ((image.re - middle) * inverse, (image.im * inverse).powi(2));
        let sum = ((x - 1.0).powi(2) + y2).sqrt() + ((x + 1.0).powi(2) + y2).sqrt();
        least = least.min(sum);
    }
    let half = 0.5 * least.max(2.0);
    half + (half * half - 1.0).sqrt().max(1e-9)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn integral(landscape: &mut Landscape, f: impl Fn(f64) -> f64) -> (f64, usize) {
        let (mut sum, mut count) = (0.0, 0);
        let ends = landscape.ends(0.0, 1.0);
        for pair in ends.windows(2) {
            visit((pair[0], pair[1]), landscape, 28.0, &mut |v, w| {
                sum += w * f(v);
                count += 1;
            });
        }
        (sum, count)
    }

    #[test]
    fn square_roots_at_cuts_are_integrated() {
        let mut landscape = Landscape::default();
        landscape.add(Complex64::new(0.3, 0.0), 0.0, 1.0);
        let (sum, count) = integral(&mut landscape, |v| (v - 0.3).abs().sqrt());
        let exact = (0.3_f64.powf(1.5) + 0.7_f64.powf(1.5)) / 1.5;
        assert!((sum - exact).abs() < 1e-14, "{sum} {exact}");
        assert!(count < 12, "{count} nodes");
    }

    #[test]
    fn a_near_pole_is_resolved() {
        for gap in [0.3, 1e-2, 1e-4, 1e-7] {
            let mut landscape = Landscape::default();
            landscape.add(Complex64::new(0.4, gap), 0.0, 1.0);
            let (sum, count) = integral(&mut landscape, |v| gap / ((v - 0.4).powi(2) + gap * gap));
            let exact = (0.6 / gap).atan() + (0.4 / gap).atan();
            // the distance to the pole carries the rounding error of its place
            let noise = 1e-13 + 1e-16 / gap;
            assert!((sum - exact).abs() < noise, "{gap}: {sum} {exact}");
            assert!(count < 1500, "{count} nodes");
        }
    }
}
