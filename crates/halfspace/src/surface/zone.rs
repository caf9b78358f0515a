//! The intervals of slowness, their angles, and the panels on which everything is fitted.

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

/// How often the panels halve toward slowness zero and, of the fast zone, toward slowness one.
const PANEL_HALVINGS: i32 = 16;

/// Parts of one that are halved so often toward zero and toward one: their ends, ascending.
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
/// They shrink by halves toward slowness zero (the chord function scales as t/x), toward slowness one
/// (a zero of the Rayleigh function on the neighbouring sheet reaches it at nu = 0, and for nu near
/// 1/2 the whole fast zone is a speck beside the shear slowness), and a little toward the shear
/// slowness, beyond which the Rayleigh pole stands.
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

/// Index of the panel between `ends` that holds a fraction in [0, 1].
pub(super) fn panel_of(ends: &[f64], fraction: f64) -> usize {
    let above = ends.partition_point(|&end| end <= fraction);
    above.clamp(1, ends.len() - 1) - 1
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
                    let fraction = pair[0] + part * (pair[1] - pair[0]);
                    let panel = panel_of(&ends, fraction);
                    assert_eq!(ends[panel..][..2], *pair);
                    assert!((ends[panel]..=ends[panel + 1]).contains(&fraction));
                }
            }
        }
    }
}
