//! Error of every inversion over time, from before the first arrival to long after the last.

use crate::inversion::Inversion;
use crate::measure::Effort;
use crate::picture::Picture;
use crate::question::kernels::{KernelScene, POISSON_RATIO};
use contact::Choice;
use fault::AnyError;
use figure::{Axis, Layer, Style};
use halfspace::{Kernel, Medium, Profile, Six};

/// Caption of the pictures.
const CAPTION: &str = "Fixed Talbot, which is the best of all after the last front, leaves the numbers before it \
    (errors up to 1e60, cut off at the top): the transform of a wave that is still to come grows as e^{-s t} on \
    its contour. The Fourier-series methods lose their digits at every front; the single integral knows where \
    the fronts are and does not notice them.";

/// One picture for the surface centre, one for the interior and one for the axis.
pub(crate) fn figures(effort: Effort, advance: &dyn Fn()) -> Result<Vec<Picture>, AnyError> {
    let medium = Medium::new(POISSON_RATIO)?;
    let kernel = Kernel::new(&medium, Profile::Hertz, 1e-10)?;
    let count = effort.pick(40, 160);
    let surface = KernelScene::surface(&medium, count, &[])?;
    let interior = KernelScene::interior(&medium, count, &[])?;
    let axis = KernelScene::axis(&medium, count, &[])?;
    let centre = "deflection of the surface's centre";
    let inside = "six fields at (0.55, 0.65) r0";
    let depth = "w on the axis at a depth of 0.65 r0";
    let mut figures = Vec::new();
    for (name, what, scene) in [
        ("inversions-surface", centre, surface),
        ("inversions-interior", inside, interior),
        ("inversions-axis", depth, axis),
    ] {
        let (first, last) = (scene.times[0], scene.times[scene.times.len() - 1]);
        let mut figure = Picture::new(
            name,
            &format!("Inversions over time: {what}"),
            Axis::logarithmic("time").unit("r0/c1").range(first, last),
            Axis::logarithmic("largest error over the largest value").range(1e-16, 10.0),
        );
        for method in Inversion::pictured(effort) {
            let (values, _) = method.run(&medium, scene.place, &scene.times)?;
            let label = format!("{}, {}", method.method.name(), method.setting);
            figure.line(&label, Style::Plain, over_time(&scene, &values));
            advance();
        }
        let own = over_time(&scene, &scene.by_kernel(&kernel)?);
        figure.line("single integral, 1e-10", Style::Heavy, own);
        let last = scene.arrivals.len() - 1;
        for (arrival, label) in [(0, "first front"), (last, "last front")] {
            figure.add(Layer::mark(scene.arrivals[arrival], label));
        }
        CAPTION.clone_into(&mut figure.caption);
        figures.push(figure);
    }
    Ok(figures)
}

fn over_time(scene: &KernelScene, values: &[Six]) -> Vec<(f64, f64)> {
    let errors = scene.errors_over_time(values).into_iter();
    let clamped = errors.map(|error| error.clamp(1e-16, 10.0));
    scene.times.iter().copied().zip(clamped).collect()
}
