//! How much is computed: a look in under a minute, or everything.

use crate::measure::Clock;
use std::time::Duration;

/// How much is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Effort {
    /// Few settings, few times, coarse maps.
    Quick,
    /// All of them.
    Full,
}

impl Effort {
    /// One of two numbers.
    pub(crate) fn pick<T>(self, quick: T, full: T) -> T {
        match self {
            Self::Quick => quick,
            Self::Full => full,
        }
    }

    pub(crate) fn clock(self) -> Clock {
        if cfg!(test) {
            // tests look at errors and work counts, never at times
            return Clock::new(1, Duration::ZERO, Duration::ZERO);
        }
        Clock::new(
            self.pick(5, 11),
            Duration::from_micros(self.pick(500, 5_000)),
            Duration::from_millis(self.pick(60, 1_500)),
        )
    }
}
