//! The paper's route in one scene: transforms by Hankel quadrature at the nodes of an inversion.

use crate::hankel::Hankel;
use crate::inversion::{Framework, Window};
use crate::surface::SurfaceTransform;
use halfspace::{Medium, Six};
use num_complex::Complex64;

/// Fields in the Laplace domain; at the centre of the surface only w over its static value.
#[derive(Debug)]
pub(crate) enum Route {
    Interior(Hankel),
    Surface(SurfaceTransform),
}

/// Whether an inversion needs Re s <= 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Path {
    RightHalf,
    Continued,
}

impl Route {
    /// At (r, z), to `digits` decimal digits.
    pub(crate) fn new(medium: &Medium, r: f64, z: f64, digits: f64) -> Self {
        if z > 0.0 {
            Self::Interior(Hankel::new(medium, r, z, digits))
        } else {
            debug_assert_eq!(r, 0.0, "on the surface only the centre");
            Self::Surface(SurfaceTransform::new(medium, digits))
        }
    }

    /// Integrand evaluations so far.
    pub(crate) fn evaluations(&self) -> u64 {
        match self {
            Self::Interior(hankel) => hankel.evaluations(),
            Self::Surface(surface) => surface.evaluations(),
        }
    }

    /// Step responses at many s.
    fn values(&self, nodes: &[Complex64], path: Path) -> Vec<[Complex64; 6]> {
        match (self, path) {
            (Self::Surface(surface), _) => nodes
                .iter()
                .map(|&s| {
                    let mut fields = [Complex64::default(); 6];
                    fields[1] = surface.step(s);
                    fields
                })
                .collect(),
            (Self::Interior(hankel), Path::Continued) => {
                nodes.iter().map(|&s| hankel.continued(s)).collect()
            }
            (Self::Interior(hankel), Path::RightHalf) => {
                let least = nodes.iter().map(|s| s.re).fold(f64::INFINITY, f64::min);
                let widest = nodes.iter().map(|s| s.im.abs()).fold(0.0, f64::max);
                let shared = hankel.nodes(least, widest);
                nodes.iter().map(|&s| hankel.step(&shared, s)).collect()
            }
        }
    }

    /// Fields at the time t by a method of the Abate-Whitt framework.
    pub(crate) fn framework(&self, rule: &Framework, t: f64, path: Path) -> Six {
        let nodes: Vec<Complex64> = rule.nodes.iter().map(|&node| node / t).collect();
        let mut values = self.values(&nodes, path).into_iter();
        rule.invert(t, |_| values.next().unwrap_or_default())
    }

    /// Fields at many times by a series method, whose samples are shared.
    pub(crate) fn series(
        &self,
        window: &Window,
        times: &[f64],
        sum: impl Fn(&Window, &[Complex64], &[f64]) -> Vec<f64>,
    ) -> Vec<Six> {
        let nodes: Vec<Complex64> = (0..window.samples).map(|k| window.node(k)).collect();
        let samples = self.values(&nodes, Path::RightHalf);
        let columns: [Vec<Complex64>; 6] =
            std::array::from_fn(|f| samples.iter().map(|s| s[f]).collect());
        let values = columns.map(|column| {
            if column.iter().any(|v| v.norm_sqr() > 0.0) {
                sum(window, &column, times)
            } else {
                vec![0.0; times.len()]
            }
        });
        (0..times.len())
            .map(|i| std::array::from_fn(|f| values[f][i]))
            .collect()
    }
}
