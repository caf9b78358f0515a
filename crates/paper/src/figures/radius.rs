//! Figure 5: the contact stress against the radius.

use super::{Claim, HERTZ, Redrawn, printed, single};
use crate::PaperError;
use crate::case::{PRINTED_PA, RADIUS_M, coupled, hertz, kmax};
use figure::{Axis, Panel, Style};
use impact::Impact;
use rayon::prelude::*;

/// Radii in m.
const RADII_M: [f64; 2] = [2e-3, 12e-3];

/// Points of a curve.
const POINTS: u32 = 24;

/// Kmax over the radius in mm.
fn curve(
    impact: impl Fn(f64) -> Result<Impact, PaperError> + Sync,
) -> Result<Vec<(f64, f64)>, PaperError> {
    let [low, high] = RADII_M;
    let points = (0..=POINTS).into_par_iter().map(|i| {
        let radius_m = low * (high / low).powf(f64::from(i) / f64::from(POINTS));
        let run = impact(radius_m)?.solve()?;
        Ok((1e3 * radius_m, kmax(run.peak_force_n, radius_m)))
    });
    points.collect()
}

/// Slope between the ends, on logarithmic axes.
fn slope(points: &[(f64, f64)]) -> f64 {
    match (points.first(), points.last()) {
        (Some(a), Some(b)) => (b.1 / a.1).ln() / (b.0 / a.0).ln(),
        _ => f64::NAN,
    }
}

/// Fig. 5.
pub(super) fn dependence() -> Result<Redrawn, PaperError> {
    let alone = curve(|radius_m| hertz(PRINTED_PA, radius_m))?;
    let on_block = curve(|radius_m| coupled(PRINTED_PA, radius_m))?;
    let (of_hertz, of_block) = (slope(&alone), slope(&on_block));
    let radius = Axis::logarithmic("radius r_{0}")
        .unit("mm")
        .range(1e3 * RADII_M[0], 1e3 * RADII_M[1]);
    let panel = Panel::new(radius, Axis::logarithmic("K_{max}"))
        .height(420.0)
        .line(HERTZ, Style::Plain, alone)
        .line(
            "coupled with the half-space, 129 GPa",
            Style::Plain,
            on_block,
        )
        .layer(printed(1e3 * RADIUS_M, 15.97, "15.97"))
        .layer(printed(1e3 * RADIUS_M, 14.11, "14.11"));
    Ok(Redrawn {
        name: "fig-05",
        title: "Fig. 5: K_max against the radius r0",
        figure: single(
            "Fig. 5: K_{max} = P_{max}/S/R_{m} against the radius",
            "mass and velocity as in the paper; stars: values printed in the paper",
            panel,
        ),
        caption: "The radius is that of the rod, its tip and the disc; the mass stays.",
        claims: vec![Claim::new(
            "Kmax goes as r0 to the power -9/5",
            (of_hertz + 1.8).abs() < 1e-6,
            format!(
                "{of_hertz:.4} for Hertz; coupled with the half-space {of_block:.3} between 2 and 12 mm, because the disc's static deflection stiffens with its radius"
            ),
        )],
    })
}
