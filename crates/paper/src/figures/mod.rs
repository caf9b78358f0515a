//! Figures 4 to 11.

mod contact;
mod fields;
mod radius;
mod step;

use crate::claim::Claim;
use crate::error::PaperError;
use crate::runs::Runs;
use figure::Figure;

/// A figure of the paper, redrawn, or one that explains it.
#[derive(Debug, Clone, PartialEq)]
pub struct Redrawn {
    /// Name of its files.
    pub name: &'static str,
    /// Its number in the paper, and its subject.
    pub title: &'static str,
    /// What is drawn.
    pub figure: Figure,
    /// Sentences below it.
    pub caption: &'static str,
    /// What the paper says of it.
    pub claims: Vec<Claim>,
}

/// All of them, in order.
pub(crate) fn all(runs: &Runs) -> Result<Vec<Redrawn>, PaperError> {
    let mut all = vec![
        contact::history(runs),
        radius::dependence()?,
        contact::stress(runs),
    ];
    all.extend(fields::figures(runs)?);
    all.push(step::dependence()?);
    Ok(all)
}

/// Name of the curves of the paper's model with Table 1.
const CONVERGED: &str = "converged, 123 GPa";

/// Name of the curves of the paper's scheme.
const SCHEME: &str = "paper's scheme, 129 GPa";

/// Name of the curves without the half-space's deflection.
const HERTZ: &str = "Hertz, 129 GPa";

/// Name of the curves of a contact that counts the static deflection once.
const GROWING: &str = "radius follows the load, 123 GPa";
