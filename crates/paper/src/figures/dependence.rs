//! Figure 5, the contact stress against the radius; and the paper's scheme against its step.

use super::{Claim, HERTZ_CURVE, Redrawn, WIDTH, single};
use crate::case::{PRINTED_PA, RADIUS_M, STEP_S, TABLE_1_PA};
use crate::case::{coupled, explicit, hertz, kmax};
use contact::{Exact, Solver};
use fault::AnyError;
use figure::{Axis, Figure, Layer, Legend, Panel, Sharing, Style};
use impact::Impact;
use rayon::prelude::*;
use std::ops::RangeInclusive;

/// Radii in m.
const RADII_M: [f64; 2] = [2e-3, 12e-3];

/// Number of points of a curve.
const DEPENDENCE_POINTS: u32 = 24;

/// Kmax over the radius in mm.
fn over_radius(
    impact: impl Fn(f64) -> Result<Impact, AnyError> + Sync,
) -> Result<Vec<(f64, f64)>, AnyError> {
    let [low, high] = RADII_M;
    let points = (0..=DEPENDENCE_POINTS).into_par_iter().map(|i| {
        let radius_m = low * (high / low).powf(f64::from(i) / f64::from(DEPENDENCE_POINTS));
        let run = impact(radius_m)?.solve()?;
        Ok((1e3 * radius_m, kmax(run.peak_force_n, radius_m)))
    });
    points.collect()
}

/// Slope between the ends, on logarithmic axes.
fn slope(points: &[(f64, f64)]) -> f64 {
    let [a, b] = [points[0], points[points.len() - 1]];
    (b.1 / a.1).ln() / (b.0 / a.0).ln()
}

/// Fig. 5.
pub(super) fn on_radius() -> Result<Redrawn, AnyError> {
    let alone = over_radius(|radius_m| hertz(PRINTED_PA, radius_m))?;
    let on_block = over_radius(|radius_m| coupled(PRINTED_PA, radius_m))?;
    let (of_hertz, of_block) = (slope(&alone), slope(&on_block));
    let radius = Axis::logarithmic("radius r_{0}")
        .unit("mm")
        .range(1e3 * RADII_M[0], 1e3 * RADII_M[1]);
    let panel = Panel::new(radius, Axis::logarithmic("K_{max}"))
        .height(420.0)
        .line(HERTZ_CURVE, Style::Plain, alone)
        .line(
            "coupled with the half-space, 129 GPa",
            Style::Plain,
            on_block,
        )
        .layer(Layer::star((1e3 * RADIUS_M, 15.97), "15.97"))
        .layer(Layer::star((1e3 * RADIUS_M, 14.11), "14.11"));
    Ok(Redrawn {
        name: "fig-05",
        title: "Fig. 5: K_max against the radius r0",
        figure: single(
            "Fig. 5: K_{max} = P_{max}/S/R_{m} against the radius",
            "mass and velocity as in the paper; stars: values printed in the paper",
            panel,
        ),
        caption: "The radius is that of the rod, its tip and the disc; the mass stays.",
        claims: vec![Claim {
            says: "Kmax goes as r0 to the power -9/5",
            holds: (of_hertz + 1.8).abs() < 1e-6,
            found: format!(
                "{of_hertz:.4} for Hertz; coupled with the half-space {of_block:.3} between 2 and 12 mm, because the disc's static deflection stiffens with its radius"
            ),
        }],
    })
}

/// Spacing of the steps in s, chosen so that the step that reproduces the printed numbers is among them.
const SPACING_S: f64 = STEP_S / 41.0;

/// The steps, in units of their spacing.
const TRIED_STEPS: RangeInclusive<u32> = 10..=125;

/// A step in s, and the results of the scheme with it: Kmax, contact time in s, restitution.
type Found = (f64, [f64; 3]);

/// The printed values, and half a unit of their last digit.
const PRINTED: [(f64, f64); 3] = [(14.11, 0.005), (27.0e-6, 0.05e-6), (0.991, 0.0005)];

fn over_step(copper_pa: f64) -> Result<Vec<Found>, AnyError> {
    let steps: Vec<u32> = TRIED_STEPS.collect();
    let found = steps.par_iter().map_init(
        || Solver::new(&Exact),
        |solver, &i| {
            let step_s = f64::from(i) * SPACING_S;
            let impact = explicit(copper_pa, step_s)?;
            let collision = impact.collision();
            let summary = solver.solve(&collision, &impact.settings)?.summary;
            let units = collision.units();
            let values = [
                kmax(summary.peak_force * units.force_n, RADIUS_M),
                summary.contact_time * units.time_s,
                summary.restitution,
            ];
            Ok((step_s, values))
        },
    );
    found.collect()
}

/// Whether a step reproduces all printed values to their digits.
fn gives_all((_, values): &&Found) -> bool {
    let mut pairs = values.iter().zip(PRINTED);
    pairs.all(|(value, (printed, half))| (value - printed).abs() <= half)
}

/// Kmax, contact time and restitution as functions of the step.
pub(super) fn on_step() -> Result<Redrawn, AnyError> {
    let (table_1, printed) = (over_step(TABLE_1_PA)?, over_step(PRINTED_PA)?);
    let axes = [
        Axis::linear("K_{max}"),
        Axis::linear("contact time").si("s"),
        Axis::linear("restitution"),
    ];
    let ends = [*TRIED_STEPS.start(), *TRIED_STEPS.end()].map(|i| 1e6 * f64::from(i) * SPACING_S);
    let mut figure = Figure::new("The paper's scheme (40)-(44) against its step")
        .sharing(Sharing::X)
        .width(WIDTH);
    for (k, axis) in axes.into_iter().enumerate() {
        let step = Axis::linear("step").unit("µs").range(0.0, ends[1]);
        let mut panel = Panel::new(step, axis).height(210.0).legend(Legend::Outside);
        for (copper, found) in [("123", &table_1), ("129", &printed)] {
            let name = &format!("copper of {copper} GPa");
            let point = |(step_s, values): &Found| (1e6 * step_s, values[k]);
            panel = panel.line(name, Style::Plain, found.iter().map(point).collect());
        }
        let level = ends.map(|step_us| (step_us, PRINTED[k].0));
        panel = panel.line("printed", Style::HeavyDashed, level.to_vec());
        if k == 0 {
            panel = panel.mark(1e6 * STEP_S, "0.164 µs");
        }
        figure = figure.panel(panel);
    }
    Ok(Redrawn {
        name: "time-step",
        title: "The paper's scheme against its step",
        figure,
        caption: "The scheme is of first order, and its error jumps where a sample of the steep kernel falls on the other side of a front.",
        claims: of_steps(&table_1, &printed),
    })
}

fn of_steps(table_1: &[Found], printed: &[Found]) -> Vec<Claim> {
    let fitting = |found: &[Found]| {
        let steps = found.iter().filter(gives_all);
        let steps: Vec<_> = steps.map(|(s, _)| format!("{:.3}", 1e6 * s)).collect();
        if steps.is_empty() {
            "no step".to_owned()
        } else {
            format!("{} us", steps.join(", "))
        }
    };
    let [first, last] = [0, printed.len() - 1].map(|i| printed[i].1[2]);
    vec![
        Claim {
            says: "Kmax = 14.11, ts = 27.0 us and Rf = 0.991 together",
            holds: printed.iter().any(|found| gives_all(&found)),
            found: format!(
                "all three to their digits with {} and copper of 129 GPa, {} and 123 GPa, of {} steps each",
                fitting(printed),
                fitting(table_1),
                printed.len()
            ),
        },
        Claim {
            says: "the restitution is 0.991",
            holds: [first, last].iter().all(|e| (e - 0.991).abs() < 5e-4),
            found: format!(
                "{first:.4} with the smallest step, {last:.4} with the largest: it follows the step"
            ),
        },
    ]
}
