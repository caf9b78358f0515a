//! Tolerances of the results of a contact, and results with their error.

use crate::summary::Summary;

/// Tolerances of the results.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Accuracy {
    /// Relative tolerance on peak force, contact time, restitution and largest displacement.
    pub tolerance: f64,
    /// Relative tolerance on the loss 1 - e^2, if it has one.
    pub loss: Option<f64>,
    /// Relative tolerance on the largest deflection, if it has one.
    pub deflection: Option<f64>,
}

impl From<f64> for Accuracy {
    /// A tolerance on the contact's results and on the largest deflection.
    fn from(tolerance: f64) -> Self {
        Self {
            deflection: Some(tolerance),
            ..Self::of_contact(tolerance, None)
        }
    }
}

impl Accuracy {
    /// On the results of the contact only, as in sweeps.
    pub fn of_contact(tolerance: f64, loss: Option<f64>) -> Self {
        Self {
            tolerance,
            loss,
            deflection: None,
        }
    }

    /// The largest error over its tolerance: that of the contact's results, given so, of the loss and of the largest
    /// deflection.
    pub(crate) fn excess(&self, contact: f64, loss: f64, deflection: f64) -> f64 {
        let loss = self.loss.map_or(0.0, |asked| loss / asked);
        let deflection = self.deflection.map_or(0.0, |asked| deflection / asked);
        contact.max(loss).max(deflection)
    }
}

/// Results of a scheme, in collision units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// Results.
    pub summary: Summary,
    /// Estimated relative error of peak force, contact time, restitution and displacement.
    pub error: f64,
    /// Step of the finest march; none without a march.
    pub step: Option<f64>,
}

impl Found {
    pub(crate) fn new(summary: Summary, error: f64, step: Option<f64>) -> Self {
        Self {
            summary,
            error,
            step,
        }
    }
}
