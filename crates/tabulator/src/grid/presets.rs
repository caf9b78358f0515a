//! Named grids.

use crate::grid::{Axis, Grid, defaults};

/// Names for [`Grid::preset`].
pub const PRESETS: [&str; 3] = ["demo", "standard", "wide"];

/// Poisson ratios at equal steps of [`lookup::ratio_coordinate`], rounded to three decimals.
const RATIOS: [f64; 11] = [
    0.0, 0.099, 0.176, 0.237, 0.286, 0.327, 0.361, 0.389, 0.413, 0.433, 0.45,
];

impl Grid {
    /// One slice at nu = 0.30, r and z to 6 r0; takes seconds.
    pub fn demo() -> Self {
        Self {
            poisson_ratios: vec![0.3],
            exact_ratios: Vec::new(),
            cell_width: defaults::cell_width(),
            time_factor: defaults::time_factor(),
            tail_terms: defaults::tail_terms(),
            stencil_points: defaults::stencil_points(),
            tolerance: defaults::tolerance(),
            pulse_lengths: defaults::pulse_lengths(),
            r: Axis::graded(6.0, 0.15, 1.0, 0.04, 0.15),
            z: Axis::graded(6.0, 0.15, 0.0, 0.04, 0.15),
        }
    }

    /// Poisson ratios from 0 to 0.45, r and z to 6 r0; takes minutes.
    pub fn standard() -> Self {
        Self {
            poisson_ratios: RATIOS.to_vec(),
            cell_width: 0.125,
            r: Axis::graded(6.0, 0.1, 1.0, 0.025, 0.12),
            z: Axis::graded(6.0, 0.1, 0.0, 0.02, 0.12),
            ..Self::demo()
        }
    }

    /// As [`Self::standard`], but with r and z to 12 r0 and a larger spacing.
    pub fn wide() -> Self {
        Self {
            r: Axis::graded(12.0, 0.15, 1.0, 0.04, 0.12),
            z: Axis::graded(12.0, 0.15, 0.0, 0.03, 0.12),
            ..Self::standard()
        }
    }

    /// The preset of a name, if there is one.
    pub fn preset(name: &str) -> Option<Self> {
        match name {
            "demo" => Some(Self::demo()),
            "standard" => Some(Self::standard()),
            "wide" => Some(Self::wide()),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::bisect;

    #[test]
    fn ratios_are_at_equal_steps() {
        let [start, end] = [0.0, 0.45].map(|nu| lookup::ratio_coordinate(nu).unwrap());
        for (i, ratio) in RATIOS.into_iter().enumerate() {
            let wanted = start + (end - start) * i as f64 / 10.0;
            let found = bisect(0.0, 0.45, wanted).unwrap();
            assert_eq!((1000.0 * found).round() / 1000.0, ratio);
        }
    }
}
