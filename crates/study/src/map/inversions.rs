//! Error of every inversion over time, from before the first arrival to long after the last.

use crate::StudyError;
use crate::inversion::{ExtendedWeights, Inversion};
use crate::measure::Effort;
use crate::picture::Picture;
use crate::question::kernels::{KernelScene, POISSON_RATIO};
use figure::{Axis, Style};
use halfspace::{Kernel, Medium, Profile, Six};

/// What the pictures say.
const CAPTION: &str = "Fixed Talbot, which is the best of all after the last front, leaves the numbers before it \
    (errors up to 1e60, cut off at the top): the transform of a wave that is still to come grows as e^{-s t} on \
    its contour. The Fourier-series methods lose their digits at every front; the single integral knows where \
    the fronts are and does not notice them.";

/// One picture for the surface centre, one for the interior and one for the axis.
pub(crate) fn figures(effort: Effort, advance: &dyn Fn()) -> Result<Vec<Picture>, StudyError> {
    let medium = Medium::new(POISSON_RATIO)?;
    let count = effort.pick(40, 160);
    let mut figures = Vec::new();
    for (name, title, scene) in [
        (
            "inversions-surface",
            "Inversions over time: deflection of the surface's centre",
            KernelScene::surface(&medium, count, &[])?,
        ),
        (
            "inversions-interior",
            "Inversions over time: six fields at (0.55, 0.65) r0",
            KernelScene::interior(&medium, count, &[])?,
        ),
        (
            "inversions-axis",
            "Inversions over time: w on the axis at a depth of 0.65 r0",
            KernelScene::axis(&medium, count, &[])?,
        ),
    ] {
        figures.push(over_scene(&medium, &scene, (name, title), effort, advance)?);
    }
    Ok(figures)
}

/// Every inversion at one place.
fn over_scene(
    medium: &Medium,
    scene: &KernelScene,
    (name, title): (&'static str, &str),
    effort: Effort,
    advance: &dyn Fn(),
) -> Result<Picture, StudyError> {
    let last = scene.times.last().copied().unwrap_or(1.0);
    let mut figure = Picture::new(
        name,
        title,
        Axis::logarithmic("time")
            .unit("r0/c1")
            .range(scene.times[0], last),
        Axis::logarithmic("largest error over the largest value").range(1e-16, 10.0),
    );
    for method in Inversion::pictured(effort) {
        let (values, _) = method.run(medium, scene.place, &scene.times);
        figure.curve(
            &format!("{}, {}", method.name, method.setting),
            Style::Plain,
            over_time(scene, &values),
        );
        advance();
    }
    if name == "inversions-axis" {
        // every third time: double-double arithmetic is slow
        let mut few = scene.clone();
        few.thin(3);
        let weights = ExtendedWeights::new(26);
        let (values, _) = few.extended(medium, &weights);
        figure.curve(
            "Gaver-Stehfest, 31 digits, 26 terms",
            Style::Marked,
            over_time(&few, &values),
        );
    }
    let kernel = Kernel::new(medium, Profile::Hertz, 1e-10)?;
    figure.curve(
        "single integral, 1e-10",
        Style::Heavy,
        over_time(scene, &scene.by_kernel(&kernel)?),
    );
    for (arrival, label) in [
        (scene.arrivals.first(), "first front"),
        (scene.arrivals.last(), "last front"),
    ] {
        if let Some(&t) = arrival {
            figure.mark(t, label);
        }
    }
    CAPTION.clone_into(&mut figure.caption);
    Ok(figure)
}

fn over_time(scene: &KernelScene, values: &[Six]) -> Vec<(f64, f64)> {
    let errors = scene.errors_over_time(values);
    let clamp = |e: f64| e.clamp(1e-16, 10.0);
    scene
        .times
        .iter()
        .copied()
        .zip(errors.into_iter().map(clamp))
        .collect()
}
