//! The measure over slowness with its moments, and the intervals, angles and panels of the fits.
//!
//! Theory: `docs/theory.md` (T25, T26).

use super::chord::{Moments, POWERS};
use crate::medium::Medium;
use crate::numeric::gauss;
use std::f64::consts::{FRAC_PI_2, PI};

/// Number of Gauss nodes on a panel, and between two of the angles at which a panel is fitted.
const WHOLE: usize = 16;
const FITTED_NODES: usize = 8;

/// The measure mu, with moments summed panel by panel from the slow end.
#[derive(Debug, Clone)]
pub(super) struct SurfaceMeasure {
    pub(super) medium: Medium,
    pub(super) rayleigh_slowness: f64,
    pub(super) rayleigh_mass: f64,
    /// Ends of the panels of both zones, as angles.
    ends: [Vec<f64>; 2],
    /// Moments above the upper end of each panel.
    beyond: [Vec<Moments>; 2],
}

/// Slownesses in 1/c1 and masses of the measure mu, of total mass one, Rayleigh's wave last.
///
/// They are those of Gauss rules with `nodes` nodes on panels of the two intervals, 0 < x < 1, x = sin(angle), and 1 <
/// x < 1/kappa, x^2 = 1 + (K - 1) sin^2(angle). `halvings` are the numbers of halvings of the panels toward angle 0 and
/// toward pi/2, for each interval.
pub fn surface_measure(medium: &Medium, halvings: [[i32; 2]; 2], nodes: usize) -> Vec<(f64, f64)> {
    let mut found = vec![];
    for (zone, halvings) in ZONES.into_iter().zip(halvings) {
        for pair in halved(halvings).windows(2) {
            let panel = [pair[0], pair[1]].map(|part| FRAC_PI_2 * part);
            found.extend(points(medium, zone, panel, nodes));
        }
    }
    found.push(rayleigh(medium));
    found
}

/// Slowness and mass of Rayleigh's wave.
fn rayleigh(medium: &Medium) -> (f64, f64) {
    let c = medium.rayleigh_speed();
    let share = medium.shear_slowness_squared() / (1.0 - medium.poisson_ratio());
    let mass = 2.0 * ((1.0 - c) * (1.0 + c)).sqrt() * c * share / medium.rayleigh_slope();
    (1.0 / c, mass)
}

/// Slownesses and masses between two angles of a zone.
fn points(
    medium: &Medium,
    zone: Zone,
    [from, to]: [f64; 2],
    nodes: usize,
) -> impl Iterator<Item = (f64, f64)> {
    let k = medium.shear_slowness_squared();
    let scale = 2.0 / PI * k / (1.0 - medium.poisson_ratio());
    gauss::rule(nodes).on(from, to).map(move |(angle, weight)| {
        // the cosine, from the distance to pi/2, which the panels near slowness one resolve
        let (s, c) = (angle.sin(), (FRAC_PI_2 - angle).sin());
        let density = match zone {
            Zone::Fast => {
                let g = 2.0 * s * s - k;
                let y = (k - s * s).sqrt();
                c * c / (g * g + 4.0 * s * s * c * y)
            }
            Zone::Slow => {
                // p = -i p^, so Re[p/R] = 4 x^2 p^2 y/((2 x^2 - K)^4 + 16 x^4 p^2 y^2)
                let p2 = (k - 1.0) * s * s;
                let x2 = 1.0 + p2;
                let g = 2.0 * x2 - k;
                let y2 = (k - 1.0) * c * c;
                let density = 4.0 * x2 * p2 * y2.sqrt() / (g.powi(4) + 16.0 * x2 * x2 * p2 * y2);
                density * (k - 1.0) * s * c / x2.sqrt()
            }
        };
        (zone.slowness(k, s), weight * scale * density)
    })
}

impl SurfaceMeasure {
    pub(super) fn new(medium: &Medium) -> Self {
        let (rayleigh_slowness, rayleigh_mass) = rayleigh(medium);
        let mut measure = Self {
            medium: medium.clone(),
            rayleigh_slowness,
            rayleigh_mass,
            ends: ZONES.map(|zone| panel_ends(zone).iter().map(|end| end * FRAC_PI_2).collect()),
            beyond: [vec![], vec![]],
        };
        let c = medium.rayleigh_speed();
        let mut sum = POWERS.map(|power| measure.rayleigh_mass * c.powi(power));
        for zone in [Zone::Slow, Zone::Fast] {
            let ends = measure.ends[zone as usize].clone();
            let mut beyond = vec![];
            for pair in ends.windows(2).rev() {
                beyond.push(sum);
                // the first panel begins at slowness zero, where only the moments up to the mass exist
                measure.add(zone, pair[0], pair[1], &mut sum, WHOLE);
            }
            beyond.reverse();
            measure.beyond[zone as usize] = beyond;
        }
        measure
    }

    /// Moments above slowness zero; only the first two exist there.
    pub(super) fn total(&self) -> Moments {
        let mut sum = self.beyond[0][0];
        self.add(Zone::Fast, 0.0, self.ends[0][1], &mut sum, WHOLE);
        sum
    }

    /// Moments above each of some angles within a panel; the angles descend.
    pub(super) fn above<const N: usize>(
        &self,
        zone: Zone,
        panel: usize,
        angles: &[f64; N],
    ) -> [Moments; N] {
        let mut sum = self.beyond[zone as usize][panel];
        let mut end = self.ends[zone as usize][panel + 1];
        angles.map(|angle| {
            while 2.0 * angle < end {
                self.add(zone, 0.5 * end, end, &mut sum, WHOLE);
                end *= 0.5;
            }
            self.add(zone, angle, end, &mut sum, FITTED_NODES);
            end = angle;
            sum
        })
    }

    /// Adds the moments between two angles of a zone, with `nodes` nodes.
    fn add(&self, zone: Zone, from: f64, to: f64, sum: &mut Moments, nodes: usize) {
        for (slowness, mass) in points(&self.medium, zone, [from, to], nodes) {
            let inverse = 1.0 / slowness;
            for (moment, power) in sum.iter_mut().zip(POWERS) {
                *moment += mass * inverse.powi(power);
            }
        }
    }
}

/// The two intervals of slowness on which the density is smooth in an angle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Zone {
    /// 0 < x < 1, x = sin(angle).
    Fast = 0,
    /// 1 < x < 1/kappa, x^2 = 1 + (K - 1) sin^2(angle).
    Slow = 1,
}

/// Both zones, by their index.
pub(super) const ZONES: [Zone; 2] = [Zone::Fast, Zone::Slow];

impl Zone {
    pub(super) fn of(x: f64, shear_slowness: f64) -> Option<Self> {
        (x < shear_slowness).then_some(if x < 1.0 { Self::Fast } else { Self::Slow })
    }

    /// The slowness at an angle whose sine is s.
    pub(super) fn slowness(self, k: f64, s: f64) -> f64 {
        match self {
            Self::Fast => s,
            Self::Slow => (1.0 + (k - 1.0) * s * s).sqrt(),
        }
    }

    pub(super) fn angle(self, shear_slowness: f64, x: f64) -> f64 {
        match self {
            Self::Fast => x.asin(),
            Self::Slow => {
                let far = (shear_slowness - x) * (shear_slowness + x);
                ((x - 1.0) * (x + 1.0) / far).sqrt().atan()
            }
        }
    }
}

/// Number of halvings of the panels toward slowness zero and, in the fast zone, toward slowness one.
const PANEL_HALVINGS: i32 = 16;

/// Ends of the parts of [0, 1] after repeated halving toward zero and toward one, ascending.
pub(super) fn halved([lower, upper]: [i32; 2]) -> Vec<f64> {
    let shrink = |j: i32| 0.5_f64.powi(j);
    let mut ends = vec![0.0];
    ends.extend((1..=lower).rev().map(shrink));
    ends.extend((2..=upper).map(|j| 1.0 - shrink(j)));
    ends.push(1.0);
    ends
}

/// Ends of the panels of a zone as fractions of pi/2, ascending.
///
/// The panels are halved toward slowness zero (the chord function scales as t/x), toward slowness one (a zero of the
/// Rayleigh function on the neighbouring sheet reaches it at nu = 0, and for nu near 1/2 the whole fast zone is tiny
/// compared with the shear slowness), and a few times toward the shear slowness, beyond which the Rayleigh pole lies.
pub(super) fn panel_ends(zone: Zone) -> Vec<f64> {
    let upper_halvings = match zone {
        Zone::Fast => PANEL_HALVINGS,
        Zone::Slow => 3,
    };
    let octaves = halved([PANEL_HALVINGS, upper_halvings]);
    let pairs = octaves.windows(2);
    let halves = pairs.flat_map(|pair| [pair[0], 0.5 * (pair[0] + pair[1])]);
    halves.chain([1.0]).collect()
}

/// Index of the panel between `ends` that contains a fraction in [0, 1].
pub(super) fn panel_of(ends: &[f64], fraction: f64) -> usize {
    let above = ends.partition_point(|&end| end <= fraction);
    above.clamp(1, ends.len() - 1) - 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_measure_has_mass_one() {
        for nu in [
            -0.9,
            -0.5,
            0.0,
            0.01,
            0.25,
            0.263_082_06,
            0.3,
            0.4,
            0.45,
            0.49,
            0.499,
            0.4999,
        ] {
            let mass = SurfaceMeasure::new(&Medium::new(nu).unwrap()).total()[1];
            assert!((mass - 1.0).abs() < 1e-13, "nu = {nu}: {mass}");
        }
    }

    #[test]
    fn every_fraction_finds_its_panel() {
        for zone in [Zone::Fast, Zone::Slow] {
            let ends = panel_ends(zone);
            for pair in ends.windows(2) {
                for part in [1e-9, 0.3, 0.999_999] {
                    let fraction = pair[0] + part * (pair[1] - pair[0]);
                    let panel = panel_of(&ends, fraction);
                    assert_eq!(ends[panel..][..2], *pair);
                    assert!((ends[panel]..=ends[panel + 1]).contains(&fraction));
                }
            }
        }
    }
}
