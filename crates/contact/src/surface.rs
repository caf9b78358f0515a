//! The few numbers of a surface response on which the choice of a model depends.

use crate::response::disc::DiscResponse;
use halfspace::Deflection;

/// What the dimensionless groups of an impact need of a surface response, in 1/(mu r0) and r0/c1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// Static deflection under unit force.
    pub static_compliance: f64,
    /// int (1 - W) dt.
    pub relaxation_time: f64,
    /// Time after which the response is static.
    pub memory: f64,
    deflection: Deflection,
}

impl Surface {
    /// Of a response.
    #[must_use]
    pub fn of(response: &impl DiscResponse) -> Self {
        Self {
            static_compliance: response.static_compliance(),
            relaxation_time: response.relaxation_time(),
            memory: response.memory(),
            deflection: response.deflection(),
        }
    }

    /// Memory of a flat punch in a/c1: the slowest wave across its diameter.
    #[must_use]
    pub fn punch_memory(&self) -> f64 {
        match self.deflection {
            Deflection::Centre => 2.0 * self.memory,
            Deflection::Mean => self.memory,
        }
    }
}
