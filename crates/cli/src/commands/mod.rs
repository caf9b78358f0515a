//! One file per subcommand; the arguments, the call of the library, and what is printed.

use crate::failure::Failure;
use ::impact::{Load, Scene, Strike};

pub(crate) mod chart;
pub(crate) mod completions;
pub(crate) mod demo;
pub(crate) mod export;
pub(crate) mod impact;
pub(crate) mod infer;
pub(crate) mod materials;
pub(crate) mod paper;
pub(crate) mod plot;
pub(crate) mod sweep;
pub(crate) mod table;
pub(crate) mod tabulate;

/// What strikes in a scene.
fn strike(scene: &Scene) -> Result<&Strike, Failure> {
    match &scene.load {
        Load::Strike(strike) => Ok(strike),
        Load::Record(_) => Err(Failure::input(
            "a force record has no rebound: give the scene a [striker]",
        )),
    }
}
