//! Which derivative or integral in time of the step response is meant, as a type.
//!
//! The integral over slowness is the same for all of them: one more integration in time raises the order of every
//! potential by one. The order is a type so that each instance is compiled for itself, and an enum so that a `match`
//! names all three.

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

impl Order {
    /// Number of integrations in time: -1 for the impulse response.
    pub(crate) const fn integrations(self) -> i32 {
        match self {
            Self::Impulse => -1,
            Self::Step => 0,
            Self::StepIntegral => 1,
        }
    }
}

/// An [`Order`] as a type.
pub(crate) trait TimeOrder {
    const ORDER: Order;
}

/// [`Order::Impulse`].
pub(crate) struct Impulse;

/// [`Order::Step`].
pub(crate) struct Step;

/// [`Order::StepIntegral`].
pub(crate) struct StepIntegral;

impl TimeOrder for Impulse {
    const ORDER: Order = Order::Impulse;
}

impl TimeOrder for Step {
    const ORDER: Order = Order::Step;
}

impl TimeOrder for StepIntegral {
    const ORDER: Order = Order::StepIntegral;
}
