//! The paper's Fig. 4: force, displacement, deflection and velocity against time.

use figure::{Axis, Figure, Panel, RenderError, Sharing, Style, to_svg};
use formats::choices;
use impact::{Outcome, Scene};
use std::path::Path;

/// Draws the picture as SVG.
pub(crate) fn draw(path: &Path, scene: &Scene, outcome: &Outcome) -> Result<(), String> {
    let picture = svg(scene, outcome).map_err(|error| error.to_string())?;
    std::fs::write(path, picture).map_err(|error| error.to_string())
}

fn svg(scene: &Scene, outcome: &Outcome) -> Result<String, RenderError> {
    let (series, choices) = (&outcome.series, choices(scene, outcome));
    let Some((results, striker)) = outcome.results().zip(series.striker.as_ref()) else {
        return to_svg(&Figure::new("A force without a striker"));
    };
    // the contact and a little after it
    let end_s = 1.12 * results.contact_time_s;
    let curve = |samples: &[f64]| -> Vec<(f64, f64)> {
        let points = series.time_s.iter().copied().zip(samples.iter().copied());
        points.take_while(|(t, _)| *t <= end_s).collect()
    };
    let panel = |quantity: &str, unit: &str| {
        let time = Axis::linear("time").si("s").range(0.0, end_s);
        Panel::new(time, Axis::linear(quantity).si(unit)).height(230.0)
    };
    let figure = Figure::new("Copper rod on a steel block, 100 m/s")
        .subtitle(&format!(
            "peak force {:.1} kN, contact {:.2} \u{b5}s, restitution {:.4} (model {}, {})",
            results.peak_force_n / 1e3,
            1e6 * results.contact_time_s,
            results.restitution,
            choices.model,
            choices.scheme
        ))
        .sharing(Sharing::X)
        .panel(panel("force", "N").line("contact force P", Style::Plain, curve(&series.force_n)))
        .panel(
            panel("displacement", "m")
                .line("striker h", Style::Plain, curve(&striker.displacement_m))
                .line("half-space w", Style::Plain, curve(&series.deflection_m)),
        )
        .panel(panel("velocity", "m/s").line(
            "striker v",
            Style::Plain,
            curve(&striker.velocity_m_s),
        ));
    to_svg(&figure)
}
