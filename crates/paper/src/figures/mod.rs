//! Figures 4 to 11: `contact` has 4 and 6, `dependence` 5 and the dependence on the step, `fields` 7 to 11.

mod contact;
mod dependence;
mod fields;

use crate::case::Runs;
use fault::AnyError;
use figure::{Figure, Panel};

/// A redrawn figure of the paper, or a figure that explains one.
#[derive(Debug, Clone, PartialEq)]
pub struct Redrawn {
    /// Name of its files.
    pub name: &'static str,
    /// Its number in the paper, and its subject.
    pub title: &'static str,
    /// The figure.
    pub figure: Figure,
    /// Sentences below it.
    pub caption: &'static str,
    /// Claims of the paper about the figure.
    pub claims: Vec<Claim>,
}

/// A qualitative statement of the paper, and the numbers by which it is judged.
#[derive(Debug, Clone, PartialEq)]
pub struct Claim {
    /// Statement of the paper.
    pub says: &'static str,
    /// Our finding.
    pub found: String,
    /// Whether the statement holds.
    pub holds: bool,
}

/// All figures, in order.
pub(crate) fn all(runs: &Runs) -> Result<Vec<Redrawn>, AnyError> {
    let mut all = vec![
        contact::history(runs),
        dependence::on_radius()?,
        contact::stress(runs),
    ];
    all.extend(fields::figures(runs)?);
    all.push(dependence::on_step()?);
    Ok(all)
}

/// Width of a picture in pixels.
const WIDTH: f64 = 1020.0;

/// Name of the curves of the paper's model with Table 1.
const CONVERGED: &str = "converged, 123 GPa";

/// Name of the curves of the paper's scheme.
const SCHEME: &str = "paper's scheme, 129 GPa";

/// Name of the curves without the half-space's deflection.
const HERTZ_CURVE: &str = "Hertz, 129 GPa";

/// Name of the curves of a contact that counts the static deflection once.
const GROWING: &str = "radius follows the load, 123 GPa";

/// A figure of one panel.
fn single(title: &str, subtitle: &str, panel: Panel) -> Figure {
    let figure = Figure::new(title).subtitle(subtitle);
    figure.width(WIDTH).panel(panel)
}
