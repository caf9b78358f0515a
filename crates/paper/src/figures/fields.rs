//! Figures 7 to 11: the fields over time.

use super::Redrawn;
use super::contact::WIDTH;
use crate::case::{RADIUS_M, STRENGTH_PA};
use crate::claim::Claim;
use crate::error::PaperError;
use crate::histories::{Histories, History};
use crate::runs::Runs;
use figure::{Axis, Figure, Legend, Panel, Style};
use impact::Field;
use std::f64::consts::FRAC_1_SQRT_2;

/// Distances of the surface's and the axis' curves of displacement, in r0.
const SURFACE: [f64; 4] = [0.1, 1.0, 3.0, 5.0];
const DEPTHS: [f64; 4] = [0.0, 1.0, 3.0, 5.0];

/// Distances of the curves at 45 degrees, in r0.
const OBLIQUE: [f64; 3] = [2.0, 3.0, 5.0];

/// Name of the curves under the paper's force.
const PAPER_FORCE: &str = "under the paper's force";

/// What a figure shows.
struct Shown<'a> {
    name: &'static str,
    title: &'static str,
    field: Field,
    axis: Axis,
    scale: f64,
    places: Vec<[f64; 2]>,
    /// Distance of each place in r0, and how it is called.
    distances: &'a [f64],
    along: &'static str,
    caption: &'static str,
}

fn on_surface(distances: &[f64]) -> Vec<[f64; 2]> {
    distances.iter().map(|&r| [r, 0.0]).collect()
}

fn on_axis(distances: &[f64]) -> Vec<[f64; 2]> {
    distances.iter().map(|&z| [0.0, z]).collect()
}

fn oblique(distances: &[f64]) -> Vec<[f64; 2]> {
    let at = |&d: &f64| [d * FRAC_1_SQRT_2, d * FRAC_1_SQRT_2];
    distances.iter().map(at).collect()
}

/// What is said of a figure, from its curves.
type Claims = fn(&[History<'_>], &Histories) -> Vec<Claim>;

/// Figs 7 to 11.
pub(super) fn figures(runs: &Runs) -> Result<Vec<Redrawn>, PaperError> {
    let mut places = on_surface(&SURFACE);
    places.extend(on_axis(&DEPTHS));
    places.extend(oblique(&OBLIQUE));
    let ours = Histories::new(&runs.table_1, &places)?;
    let theirs = Histories::new(&runs.scheme, &places)?;
    let all = lengths().into_iter().chain(stresses());
    let redrawn = all.map(|(shown, claims)| {
        let curves: Vec<History<'_>> = ours.of(shown.field, &shown.places).collect();
        Redrawn {
            name: shown.name,
            title: shown.title,
            figure: draw(&shown, &ours, &theirs),
            caption: shown.caption,
            claims: claims(&curves, &ours),
        }
    });
    Ok(redrawn.collect())
}

/// Figs 7 and 8.
fn lengths() -> [(Shown<'static>, Claims); 2] {
    let axis = || Axis::linear("axial displacement w").si("m");
    [
        (
            Shown {
                name: "fig-07",
                title: "Fig. 7: deflection w(r, 0, t) of the surface",
                field: Field::DisplacementZ,
                axis: axis(),
                scale: 1.0,
                places: on_surface(&SURFACE),
                distances: &SURFACE,
                along: "r",
                caption: "",
            },
            of_surface,
        ),
        (
            Shown {
                name: "fig-08",
                title: "Fig. 8: displacement w(0, z, t) on the axis",
                field: Field::DisplacementZ,
                axis: axis(),
                scale: 1.0,
                places: on_axis(&DEPTHS),
                distances: &DEPTHS,
                along: "z",
                caption: "Caption and text of the paper's figure disagree: z = 0 in one, \"r = 0.1 r0\" in the other; here it is z = 0.",
            },
            of_depths,
        ),
    ]
}

/// Figs 9 to 11.
fn stresses() -> [(Shown<'static>, Claims); 3] {
    let axis = |component: &str| Axis::linear(&format!("σ_{{{component}}}/R_{{m}}"));
    [
        (
            Shown {
                name: "fig-09",
                title: "Fig. 9: stress on the axis over the tensile strength of copper",
                field: Field::StressZz,
                axis: axis("zz"),
                scale: STRENGTH_PA,
                places: on_axis(&DEPTHS[1..]),
                distances: &DEPTHS[1..],
                along: "z",
                caption: "Compression is negative.",
            },
            of_axis_stress,
        ),
        (
            Shown {
                name: "fig-10",
                title: "Fig. 10: stress at 45 degrees over the tensile strength of copper",
                field: Field::StressZz,
                axis: axis("zz"),
                scale: STRENGTH_PA,
                places: oblique(&OBLIQUE),
                distances: &OBLIQUE,
                along: "√(r^{2} + z^{2})",
                caption: "Caption and text of the paper disagree on the first point, 2 r0/√2 from both axes; here it is that.",
            },
            of_reversal,
        ),
        (
            Shown {
                name: "fig-11",
                title: "Fig. 11: radial stress on the surface over the tensile strength of copper",
                field: Field::StressRr,
                axis: axis("rr"),
                scale: STRENGTH_PA,
                places: on_surface(&SURFACE[1..]),
                distances: &SURFACE[1..],
                along: "r",
                caption: "",
            },
            of_quiet,
        ),
    ]
}

fn draw(shown: &Shown<'_>, ours: &Histories, theirs: &Histories) -> Figure {
    let mut end_s = 0.0_f64;
    let time = Axis::linear("time").si("s");
    let mut panel = Panel::new(time, shown.axis.clone())
        .height(420.0)
        .legend(Legend::Outside);
    for history in theirs.of(shown.field, &shown.places) {
        panel = panel.line(PAPER_FORCE, Style::Dotted, history.curve(shown.scale));
    }
    for (history, distance) in ours.of(shown.field, &shown.places).zip(shown.distances) {
        let name = match distance {
            0.0 => format!("{} = 0", shown.along),
            1.0 => format!("{} = r_{{0}}", shown.along),
            _ => format!("{} = {distance} r_{{0}}", shown.along),
        };
        end_s = history.time_s.last().copied().unwrap_or(0.0);
        panel = panel.line(&name, Style::Plain, history.curve(shown.scale));
    }
    for ([r, z], distance) in shown.places.iter().zip(shown.distances) {
        let first_s = ours.speeds.arrivals_s(r * RADIUS_M, z * RADIUS_M, RADIUS_M)[0];
        if first_s > 0.0 {
            panel = panel.mark(first_s, &format!("P, {distance}"));
        }
    }
    panel.x = panel.x.range(0.0, end_s);
    Figure::new(shown.title)
        .subtitle("copper of 123 GPa, converged; P: first wave at each distance in r_{0}")
        .width(WIDTH)
        .panel(panel)
}

/// Values in words, from the nearest point to the farthest.
fn list(curves: &[History<'_>], of: impl Fn(&History<'_>) -> f64, digits: usize) -> String {
    let values: Vec<String> = curves
        .iter()
        .map(|c| format!("{:.digits$}", of(c)))
        .collect();
    values.join(", ")
}

/// Whether values fall or rise from point to point.
fn falls(curves: &[History<'_>], of: impl Fn(&History<'_>) -> f64) -> bool {
    curves.windows(2).all(|pair| of(&pair[1]) < of(&pair[0]))
}

fn amplitude(curves: &[History<'_>], scale: f64, unit: &str) -> Claim {
    Claim::new(
        "away from the source the amplitude decreases",
        falls(curves, |c| c.peak().abs()),
        format!("{} {unit}", list(curves, |c| scale * c.peak(), 2))
            .trim_end()
            .to_owned(),
    )
}

fn width(curves: &[History<'_>]) -> Claim {
    Claim::new(
        "away from the source the disturbance widens",
        falls(curves, |c| -c.width_s()),
        format!(
            "time above half the peak {} us",
            list(curves, |c| 1e6 * c.width_s(), 2)
        ),
    )
}

fn of_surface(curves: &[History<'_>], ours: &Histories) -> Vec<Claim> {
    let away = &curves[2..];
    let far_m = 5.0 * RADIUS_M;
    let rayleigh_s = ours.speeds.arrivals_s(far_m, 0.0, RADIUS_M)[2];
    let at_rayleigh = curves[3].share_at(rayleigh_s);
    vec![
        amplitude(curves, 1e6, "um"),
        width(curves),
        Claim::new(
            "away from the source a slight negative deflection appears",
            away.iter().all(|c| c.other() < 0.0),
            format!("{} um at 3 and 5 r0", list(away, |c| 1e6 * c.other(), 2)),
        ),
        Claim::new(
            "the arrivals of S and R cannot be seen",
            at_rayleigh.abs() < 0.1,
            format!(
                "at 5 r0 the Rayleigh wave of the disc's edge comes at {:.2} us, when the deflection has {at_rayleigh:+.3} of its peak: the force has just begun to rise, and with zero slope",
                1e6 * rayleigh_s
            ),
        ),
    ]
}

fn of_depths(curves: &[History<'_>], _: &Histories) -> Vec<Claim> {
    let away = &curves[1..];
    vec![
        amplitude(curves, 1e6, "um"),
        width(curves),
        Claim::new(
            "away from the source a slight negative deflection appears",
            away.iter().all(|c| c.other() < -1e-3 * c.peak()),
            format!(
                "{} um at r0, 3 r0 and 5 r0",
                list(away, |c| 1e6 * c.other(), 2)
            ),
        ),
    ]
}

fn of_axis_stress(curves: &[History<'_>], _: &Histories) -> Vec<Claim> {
    vec![amplitude(curves, 1.0 / STRENGTH_PA, "")]
}

fn of_reversal(curves: &[History<'_>], _: &Histories) -> Vec<Claim> {
    vec![
        amplitude(curves, 1.0 / STRENGTH_PA, ""),
        Claim::new(
            "at the end of the disturbance the stress changes its sign into tension",
            curves.iter().all(|c| c.other() > 1e-3 * c.peak().abs()),
            format!(
                "largest tension {} Rm",
                list(curves, |c| c.other() / STRENGTH_PA, 3)
            ),
        ),
    ]
}

fn of_quiet(curves: &[History<'_>], ours: &Histories) -> Vec<Claim> {
    let first_s = ours.speeds.arrivals_s(5.0 * RADIUS_M, 0.0, RADIUS_M)[0];
    let found_s = curves.last().map_or(f64::NAN, |c| c.first_s(1e-9));
    vec![
        amplitude(curves, 1.0 / STRENGTH_PA, ""),
        Claim::new(
            "at 5 r0 there is no disturbance before 4 r0/c1",
            found_s >= first_s,
            format!(
                "the first sample above 1e-9 of the peak is at {:.2} us, 4 r0/c1 is {:.2} us",
                1e6 * found_s,
                1e6 * first_s
            ),
        ),
    ]
}
