//! The intervals of slowness, their angles, and the panels on which everything is fitted.

use std::f64::consts::FRAC_PI_2;

/// The two intervals of slowness on which the density is smooth in an angle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Zone {
    /// 0 < x < 1, x = sin(angle).
    Fast = 0,
    /// 1 < x < 1/kappa, x^2 = 1 + (K - 1) sin^2(angle).
    Slow = 1,
}

impl Zone {
    pub(super) fn of(x: f64, shear_slowness: f64) -> Option<Self> {
        if x < 1.0 {
            Some(Self::Fast)
        } else if x < shear_slowness {
            Some(Self::Slow)
        } else {
            None
        }
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

/// Ends of the panels of a zone as fractions of pi/2, ascending.
///
/// They shrink by halves toward slowness zero (the chord function scales as t/x), toward slowness one
/// (a zero of the Rayleigh function on the neighbouring sheet reaches it at nu = 0, and for nu near
/// 1/2 the whole fast zone is a speck beside the shear slowness), and a little toward the shear
/// slowness, beyond which the Rayleigh pole stands.
pub(super) const PANEL_HALVINGS: i32 = 16;

impl Zone {
    /// How often the panels halve toward the upper end of the zone.
    pub(super) fn upper_halvings(self) -> i32 {
        match self {
            Self::Fast => PANEL_HALVINGS,
            Self::Slow => 3,
        }
    }
}

pub(super) fn panel_ends(zone: Zone) -> Vec<f64> {
    let shrink = |j: i32| 0.5_f64.powi(j);
    let lower = (1..=PANEL_HALVINGS).rev().map(shrink);
    let upper = (2..=zone.upper_halvings()).map(|j| 1.0 - shrink(j));
    let octaves: Vec<f64> = [0.0]
        .into_iter()
        .chain(lower)
        .chain(upper)
        .chain([1.0])
        .collect();
    let halves = octaves
        .windows(2)
        .flat_map(|pair| [pair[0], 0.5 * (pair[0] + pair[1])]);
    halves
        .chain([1.0])
        .map(|fraction| fraction * FRAC_PI_2)
        .collect()
}

/// Index and ends of the panel of [`panel_ends`] that holds a fraction in [0, 1].
pub(super) fn panel_of(zone: Zone, fraction: f64) -> (usize, f64, f64) {
    let shrink = |j: i32| 0.5_f64.powi(j);
    let octave =
        |f: f64, last: i32| (-f.max(f64::MIN_POSITIVE).log2().ceil() as i32).clamp(1, last);
    let (index, from, to) = if fraction < 0.5 {
        let j = octave(fraction, PANEL_HALVINGS);
        let from = if j == PANEL_HALVINGS {
            0.0
        } else {
            shrink(j + 1)
        };
        (PANEL_HALVINGS - j, from, shrink(j))
    } else {
        let upper = zone.upper_halvings();
        let j = octave(1.0 - fraction, upper);
        let to = if j == upper { 1.0 } else { 1.0 - shrink(j + 1) };
        (PANEL_HALVINGS + j - 1, 1.0 - shrink(j), to)
    };
    let middle = 0.5 * (from + to);
    if fraction < middle {
        (2 * index as usize, from, middle)
    } else {
        (2 * index as usize + 1, middle, to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_fraction_finds_its_panel() {
        for zone in [Zone::Fast, Zone::Slow] {
            let ends = panel_ends(zone);
            for pair in ends.windows(2) {
                for part in [1e-9, 0.3, 0.999_999] {
                    let fraction = (pair[0] + part * (pair[1] - pair[0])) / FRAC_PI_2;
                    let (panel, from, to) = panel_of(zone, fraction);
                    assert!((from - ends[panel] / FRAC_PI_2).abs() < 1e-15);
                    assert!((to - ends[panel + 1] / FRAC_PI_2).abs() < 1e-15);
                    assert!((from..=to).contains(&fraction));
                }
            }
        }
    }
}
