//! Parameters of the integral over slowness, apart from the point: half-space, profile and tolerance.

use crate::field::Point;
use crate::integral::branch_points::FixedSingularities;
use crate::integral::spectrum::{Pole, Wave, pole};
use crate::medium::Medium;
use crate::profile::Profile;

/// Half-space, load profile and accuracy, with derived quantities that are the same for every point.
#[derive(Debug, Clone)]
pub(crate) struct Setting {
    pub(crate) medium: Medium,
    pub(crate) profile: Profile,
    pub(crate) tolerance: f64,
    /// Relative accuracy of each quadrature rule away from the surface, see [`Self::digits`].
    pub(crate) deep_digits: f64,
    /// 1/kappa^2.
    pub(crate) k: f64,
    /// 1/kappa.
    pub(crate) root_k: f64,
    /// sqrt(1/kappa^2 - 1).
    pub(crate) span: f64,
    pub(crate) fixed: FixedSingularities,
    /// Rayleigh poles for P and S.
    pub(crate) poles: [Pole; 2],
    /// int of the amplitude of w times x/2 over the fast interval for P and S: the time integral of a wave that has
    /// passed.
    pub(crate) passed: [f64; 2],
}

impl Setting {
    pub(crate) fn new(medium: &Medium, profile: Profile, tolerance: f64) -> Self {
        let k = medium.shear_slowness_squared();
        let mut setting = Self {
            medium: medium.clone(),
            profile,
            tolerance,
            deep_digits: digits(tolerance),
            k,
            root_k: k.sqrt(),
            span: (k - 1.0).sqrt(),
            fixed: FixedSingularities::new(medium),
            poles: [Wave::P, Wave::S].map(|wave| pole(wave, medium)),
            passed: [0.0; 2],
        };
        setting.passed = [Wave::P, Wave::S].map(|wave| setting.passed_whole(wave));
        setting
    }

    /// Relative accuracy of each quadrature rule, as minus its natural logarithm.
    ///
    /// It is a little better than the tolerance, because the waves cancel in the sum.
    /// Just below the surface (`shallow`) the terms are of order z/t and the peak of the field is of order sqrt(z).
    pub(crate) fn digits(&self, at: Point, shallow: bool) -> f64 {
        if shallow {
            digits(self.tolerance * (at.t / at.z.sqrt()).min(1.0))
        } else {
            self.deep_digits
        }
    }

    /// Rounding error of the distance to the nearest edge, in units of the rounding error of a number of that size.
    pub(crate) fn front_rounding(&self, at: Point) -> f64 {
        let radius = self.profile.radius();
        match self.profile {
            Profile::Hertz | Profile::Punch => {
                let gap = at.r - radius;
                3.0 * (at.r + radius) / (gap * gap + at.z * at.z).sqrt().max(f64::EPSILON)
            }
            Profile::Point => 30.0,
        }
    }

    /// Slowness of a body wave: 1 for P, 1/kappa for S.
    pub(crate) fn slowness(&self, wave: Wave) -> f64 {
        [1.0, self.root_k][wave as usize]
    }
}

fn digits(tolerance: f64) -> f64 {
    const DIGITS_MARGIN: f64 = 0.1;
    // beyond the last digit of a double, and the accuracy of 24 nodes next to a finite part
    const MOST_DIGITS: f64 = 40.0;
    (-(DIGITS_MARGIN * tolerance).ln()).min(MOST_DIGITS)
}
