//! Choice of the spacing of a grid so that interpolation errors stay below a tolerance.

use crate::assemble::assemble;
use crate::error::BuildError;
use crate::grid::{Grid, within};
use crate::progress::Progress;
use crate::rows::TableWork;
use std::collections::HashMap;

/// Largest number of trials.
const MOST_TRIALS: usize = 8;

/// The grid whose errors for pulses of length `pulse_length` in r0/c1 are below `tolerance`, and a line about each
/// trial.
///
/// All spacings of `grid` are scaled by the same factor, and the pulse is added to the verification pulses. A trial is
/// the whole slice with the largest Poisson ratio, which has the shortest waves, verified as in the table.
///
/// # Errors
/// [`BuildError::Refused`] for a tolerance outside [1e-7, 0.1] or a length outside [0.5, 1000], or if no allowed spacing is
/// fine enough; other [`BuildError`]s of the exact kernels.
pub fn refine(
    grid: &Grid,
    tolerance: f64,
    pulse_length: f64,
    progress: &dyn Progress,
) -> Result<(Grid, Vec<String>), BuildError> {
    within("tol", tolerance, [1e-7, 0.1], "[1e-7, 0.1]")?;
    within("pulse", pulse_length, [0.5, 1000.0], "[0.5, 1000]")?;
    let mut grid = grid.clone();
    if !grid.pulse_lengths.contains(&pulse_length) {
        grid.pulse_lengths.push(pulse_length);
        grid.pulse_lengths.sort_by(f64::total_cmp);
    }
    let grid = &grid;
    grid.validate()?;
    let (mut trials, mut best) = (Vec::new(), f64::INFINITY);
    let mut factor = 0.25 / grid.r.spacing.max(grid.z.spacing);
    for _ in 0..MOST_TRIALS {
        let scaled = scale(grid, factor);
        if scaled.validate().is_err() {
            break;
        }
        let error = measure(&scaled, pulse_length, progress)?;
        let [r, z] = scaled.nodes();
        trials.push(format!(
            "spacing {:.4} r0: {} nodes a slice, error {error:.1e} for pulses of {pulse_length} r0/c1",
            scaled.r.spacing.max(scaled.z.spacing),
            r.len() * z.len()
        ));
        best = error.min(best);
        if error <= tolerance {
            return Ok((scaled, trials));
        }
        // the spacing expected from the order of the stencil, and a little less
        let order = grid.stencil_points as f64;
        factor *= (0.95 * (tolerance / error).powf(1.0 / order)).clamp(0.5, 0.95);
    }
    let sentence = format!(
        "an error of {tolerance} for pulses of {pulse_length} r0/c1 is not reached: {best:.1e} at the finest spacing tried; a smaller cell_width or a longer pulse is needed"
    );
    Err(BuildError::refused(None, sentence))
}

/// The error of the slice of `grid` with the largest Poisson ratio.
fn measure(grid: &Grid, pulse_length: f64, progress: &dyn Progress) -> Result<f64, BuildError> {
    let last = grid.poisson_ratios.len() - 1;
    let slice = Grid {
        poisson_ratios: vec![grid.poisson_ratios[last]],
        exact_ratios: Vec::new(),
        ..grid.clone()
    };
    let work = TableWork::new(&slice, None, progress)?;
    let content = assemble(&work, work.rows(HashMap::new(), None)?)?;
    let is_asked = |&length: &f64| length == pulse_length;
    let index = content.pulse_lengths.iter().position(is_asked);
    Ok(index.map_or(f64::NAN, |i| content.origin.accuracy_reached[i]))
}

fn scale(grid: &Grid, factor: f64) -> Grid {
    let mut scaled = grid.clone();
    for axis in [&mut scaled.r, &mut scaled.z] {
        axis.spacing *= factor;
        axis.focus_spacing = axis.focus_spacing.map(|spacing| spacing * factor);
    }
    scaled
}
