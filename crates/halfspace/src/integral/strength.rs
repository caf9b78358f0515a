//! How singular an integrand is at the fronts, and the relative error that follows from it.

use crate::numeric::scalar::Real;
use crate::potentials::order::Order;
use crate::profile::Profile;

/// How strong the singularities at the cuts of an integration interval are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Strength {
    /// The integrand stays finite.
    Bounded,
    /// The inverse square root.
    InverseRoot,
    /// The power -3/2, taken as Hadamard's finite part.
    FinitePart,
}

impl Strength {
    /// Of a profile and an order in time.
    ///
    /// The step response of stress to a point force has fronts of power -3/2, to a punch of power -1/2, and each
    /// derivative takes one off.
    pub(crate) fn of<const N: i32>(profile: Profile) -> Self {
        match (profile, Order::of(N)) {
            (Profile::Point, Order::Impulse | Order::Step) => Self::FinitePart,
            (Profile::Hertz, Order::Step | Order::StepIntegral)
            | (Profile::Punch, Order::StepIntegral) => Self::Bounded,
            (Profile::Hertz, Order::Impulse)
            | (Profile::Punch, Order::Impulse | Order::Step)
            | (Profile::Point, Order::StepIntegral) => Self::InverseRoot,
        }
    }

    /// Relative errors of displacements and stresses near a cut, from those of the quadrature rule.
    ///
    /// `place_error` is the rounding error of the place of the cut, `distance` the distance
    /// from it in slowness and `s` in the variable that smooths the singularity.
    #[inline(always)]
    pub(crate) fn at_front<T: Real>(
        self,
        [displacement, stress]: [T; 2],
        place_error: f64,
        distance: T,
        s: T,
    ) -> [T; 2] {
        /// All nodes beside a front share the error of its place: their errors add up, where squares are added.
        const SHARED: f64 = 5.0;
        let front = s.constant(SHARED * place_error) / distance;
        match self {
            Self::Bounded => [displacement, stress],
            // displacements have a root there
            Self::InverseRoot => [displacement + front * s, stress + front],
            Self::FinitePart => [displacement + front, stress + front * 3.0],
        }
    }

    /// Error of a Gauss rule over the sum of rho^(-2n) of all singularities near it.
    ///
    /// Calibrated on the random points of `tests/estimate.rs`, judged at others by `tests/estimate_by_region.rs`.
    pub(crate) fn caution(self) -> f64 {
        const BOUNDED: f64 = 56.0;
        match self {
            Self::Bounded => BOUNDED,
            Self::InverseRoot => 3.0 * BOUNDED,
            Self::FinitePart => 60.0 * BOUNDED,
        }
    }
}
