//! The four potentials from which the six fields follow.
//!
//! Theory: `docs/theory.md` (T12 to T14).
//!
//! In reading order: the order of time integration ([`Order`]), the closed forms of a chord and of its ends
//! (`closed_form`, `chord_integral`, `end`), the real parts that begin and end with a wave (`compact`), and their
//! replacements far from the disc (`multipole`), at a distant front (`far_front`) and just below the surface
//! (`shallow`).

pub(crate) mod chord_integral;
pub(crate) mod closed_form;
pub(crate) mod compact;
pub(crate) mod end;
pub(crate) mod far_front;
pub(crate) mod multipole;
pub(crate) mod shallow;

/// Potentials A_n and B_n/r of two neighbouring orders n.
///
/// The upper order is 3 + m and the lower 2 + m, where m is the number of integrations in time, see [`Order`].
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Potentials<T> {
    /// A_{3 + m}, for w.
    pub(crate) a_upper: T,
    /// A_{2 + m}, for the normal stresses.
    pub(crate) a_lower: T,
    /// B_{3 + m}/r, for u and the hoop terms.
    pub(crate) g_upper: T,
    /// B_{2 + m}/r, for the shear stress.
    pub(crate) g_lower: T,
}

impl<T: Copy> Potentials<T> {
    /// Four equal values.
    #[inline(always)]
    pub(crate) fn all(value: T) -> Self {
        Self {
            a_upper: value,
            a_lower: value,
            g_upper: value,
            g_lower: value,
        }
    }
}

impl<T> Potentials<T> {
    /// The potentials with every value replaced.
    #[inline(always)]
    pub(crate) fn map<U>(self, f: impl Fn(T) -> U) -> Potentials<U> {
        Potentials {
            a_upper: f(self.a_upper),
            a_lower: f(self.a_lower),
            g_upper: f(self.g_upper),
            g_lower: f(self.g_lower),
        }
    }

    /// Each potential combined with its counterpart.
    #[inline(always)]
    pub(crate) fn zip<U, V>(self, other: Potentials<U>, f: impl Fn(T, U) -> V) -> Potentials<V> {
        Potentials {
            a_upper: f(self.a_upper, other.a_upper),
            a_lower: f(self.a_lower, other.a_lower),
            g_upper: f(self.g_upper, other.g_upper),
            g_lower: f(self.g_lower, other.g_lower),
        }
    }
}

/// Derivative or integral in time of the step response, by its number of integrations.
///
/// The integral over slowness has the same form for all of them: an integration in time raises the order of every
/// potential by one. The number is a const parameter, so that each instance is compiled separately; this enum lets a
/// `match` name all three.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Order {
    /// d/dt, the response to a unit impulse.
    Impulse,
    /// The step response itself.
    Step,
    /// int dt.
    StepIntegral,
}

/// Integrations in time of [`Order::Impulse`].
pub(crate) const IMPULSE: i32 = -1;

/// Integrations in time of [`Order::Step`].
pub(crate) const STEP: i32 = 0;

/// Integrations in time of [`Order::StepIntegral`].
pub(crate) const STEP_INTEGRAL: i32 = 1;

impl Order {
    /// The order with a number of integrations in time.
    pub(crate) const fn of(integrations: i32) -> Self {
        match integrations {
            IMPULSE => Self::Impulse,
            STEP => Self::Step,
            STEP_INTEGRAL => Self::StepIntegral,
            _ => panic!("no such order"),
        }
    }
}
