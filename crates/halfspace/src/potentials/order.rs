//! Which derivative or integral in time of the step response is meant: by its number of integrations.
//!
//! The integral over slowness is the same for all of them: one more integration in time raises the order of every
//! potential by one. The number is a parameter of types so that each instance is compiled for itself, and an [`Order`] so
//! that a `match` names all three.

/// Derivative or integral in time of the step response.
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
    /// The one of a number of integrations in time.
    pub(crate) const fn of(integrations: i32) -> Self {
        match integrations {
            IMPULSE => Self::Impulse,
            STEP => Self::Step,
            STEP_INTEGRAL => Self::StepIntegral,
            _ => panic!("no such order"),
        }
    }
}
