//! Figures 4 to 11: `contact` has 4 and 6, `dependence` 5 and what explains them, `fields` 7 to 11.

mod contact;
mod dependence;
mod fields;

use crate::case::Runs;
use fault::AnyError;
use figure::{Figure, Panel};

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

/// A sentence of the paper that has no number, and the numbers that it is judged by here.
#[derive(Debug, Clone, PartialEq)]
pub struct Claim {
    /// What the paper says.
    pub says: &'static str,
    /// What is found here.
    pub found: String,
    /// Whether that is so.
    pub holds: bool,
}

/// All of them, in order.
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
