//! Lookups near the disc's edge and at the fronts, for pulses of 1 to 100 r0/c1.
//!
//! The errors are those that a table carries of itself: measured at the centre of every mesh, the worst place
//! between its nodes.

use crate::measure::Effort;
use crate::picture::Picture;
use crate::question::kernels::POISSON_RATIO;
use crate::scenes::Density;
use fault::AnyError;
use figure::{Axis, Interval, Style};
use halfspace::Medium;
use lookup::Table;

const CLASSES: [&str; 5] = [
    "below 1e-6",
    "1e-6 to 1e-5",
    "1e-5 to 1e-4",
    "1e-4 to 1e-3",
    "above 1e-3",
];

/// Error over peak at the mesh centre next to (r, z) for measured pulse `pulse`, the largest of the fields.
///
/// Fields that stay below 1e-3 of their largest peak in the table are left out.
fn error_at(table: &Table, i: usize, k: usize, pulse: usize) -> f64 {
    let content = table.content();
    let probes = &content.slices[0].verification;
    let pulses = content.pulse_lengths.len();
    let depths = content.probes()[1].len();
    let at = |i: usize, k: usize, f: usize| ((i * depths + k) * pulses + pulse) * 6 + f;
    (0..6).fold(0.0, |most, f| {
        let largest = (f + 6 * pulse..probes.direct.len())
            .step_by(6 * pulses)
            .fold(0.0_f32, |a, n| a.max(probes.direct[n].abs()));
        let peak = probes.direct[at(i, k, f)].abs();
        if peak > 1e-3 * largest {
            f64::max(most, f64::from(probes.error[at(i, k, f)] / peak))
        } else {
            most
        }
    })
}

/// One picture for the first mesh below the surface and one for half a radius down.
pub(crate) fn figures(densities: &[Density], effort: Effort) -> Result<Vec<Picture>, AnyError> {
    let Some(density) = densities.iter().find(|d| d.is_default(Density::points())) else {
        return Ok(Vec::new());
    };
    let table = density.with_stencil(Density::points())?;
    let content = table.content();
    let kappa = Medium::new(POISSON_RATIO)?.kappa();
    let radii = content.probes()[0].len();
    let mut figures = Vec::new();
    for (name, depth) in [("lookups-surface", 0.05), ("lookups-depth", 0.55)] {
        let k = lookup::locate(&content.z, depth).unwrap_or(0);
        let centre = 0.5 * (content.z[k] + content.z[k + 1]);
        let lengths = &content.pulse_lengths;
        let last = lengths.len() - 1;
        let plane = [
            Interval::linear(0.0, table.r_max()),
            Interval::logarithmic(lengths[0], lengths[last]),
        ];
        let mut figure = Picture::new(
            name,
            &format!("Looked-up fields, {centre:.3} r0 below the surface"),
            Axis::over(plane[0], "distance from the axis").unit("r0"),
            Axis::over(plane[1], "length of the pulse").unit("r0/c1"),
        );
        figure.map(
            plane,
            [effort.pick(40, 100), effort.pick(20, 40)],
            &CLASSES,
            |r, length| {
                let i = lookup::locate(&content.r, r).unwrap_or(0).min(radii - 1);
                // between the measured lengths, in logarithms
                let upper = lengths.partition_point(|&x| x < length).clamp(1, last);
                let share =
                    (length / lengths[upper - 1]).ln() / (lengths[upper] / lengths[upper - 1]).ln();
                let [a, b] = [upper - 1, upper].map(|p| error_at(&table, i, k, p).max(1e-12));
                let error = a.powf(1.0 - share) * b.powf(share);
                ((error.log10() + 7.0).ceil().clamp(1.0, 5.0) - 1.0) as usize
            },
        );
        let widest = content
            .r
            .windows(2)
            .map(|p| p[1] - p[0])
            .fold(0.0, f64::max);
        let resolved = 8.0 * widest / kappa;
        figure.curve(
            "theory: shortest shear wave spans four nodes",
            Style::HeavyDashed,
            vec![(0.0, resolved), (table.r_max(), resolved)],
        );
        figure.mark(1.0, "edge of the disc");
        figure.caption = "The remainder is smooth behind its fronts, and for slow pulses the fronts cancel: errors fall \
            with the length of the pulse everywhere. Just outside the edge of the disc they are largest at every length, \
            because the first waves from the edge are not smooth across a mesh; the static part, which is steep there, is \
            exact. For pulses shorter than a few r0/c1 the fronts themselves are narrower than a mesh: the certificate \
            says so, and direct evaluation is the way."
            .to_owned();
        figures.push(figure);
    }
    Ok(figures)
}
