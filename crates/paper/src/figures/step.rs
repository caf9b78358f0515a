//! The paper's scheme against its step.

use super::{Claim, Redrawn, WIDTH};
use crate::PaperError;
use crate::case::{PRINTED_PA, RADIUS_M, STEP_S, TABLE_1_PA, VELOCITY_M_S, explicit, kmax};
use contact::{Collision, Exact, Solver};
use figure::{Axis, Figure, Legend, Panel, Sharing, Style};
use rayon::prelude::*;
use std::ops::RangeInclusive;

/// Spacing of the steps in s; the one that gives the printed numbers is among them.
const SPACING_S: f64 = STEP_S / 41.0;

/// The steps, in their spacing.
const STEPS: RangeInclusive<u32> = 10..=125;

/// A step in s, and what the scheme gives with it: Kmax, contact time in s, restitution.
type Found = (f64, [f64; 3]);

/// The printed values, and half a unit of their last digit.
const PRINTED: [(f64, f64); 3] = [(14.11, 0.005), (27.0e-6, 0.05e-6), (0.991, 0.0005)];

fn curve(copper_pa: f64) -> Result<Vec<Found>, PaperError> {
    let steps: Vec<u32> = STEPS.collect();
    let found = steps.par_iter().map_init(
        || Solver::new(&Exact),
        |solver, &i| {
            let step_s = f64::from(i) * SPACING_S;
            let impact = explicit(copper_pa, step_s)?;
            let collision = Collision::new(&impact.half_space, &impact.striker, VELOCITY_M_S);
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

/// Whether a step gives all printed values to their digits.
fn gives_all((_, values): &&Found) -> bool {
    let mut pairs = values.iter().zip(PRINTED);
    pairs.all(|(value, (printed, half))| (value - printed).abs() <= half)
}

/// Kmax, contact time and restitution against the step.
pub(super) fn dependence() -> Result<Redrawn, PaperError> {
    let (table_1, printed) = (curve(TABLE_1_PA)?, curve(PRINTED_PA)?);
    let axes = [
        Axis::linear("K_{max}"),
        Axis::linear("contact time").si("s"),
        Axis::linear("restitution"),
    ];
    let ends = [*STEPS.start(), *STEPS.end()].map(|i| 1e6 * f64::from(i) * SPACING_S);
    let mut figure = Figure::new("The paper's scheme (40)-(44) against its step")
        .sharing(Sharing::X)
        .width(WIDTH);
    for (k, axis) in axes.into_iter().enumerate() {
        let step = Axis::linear("step").unit("µs").range(0.0, ends[1]);
        let mut panel = Panel::new(step, axis).height(210.0).legend(Legend::Outside);
        for (copper, found) in [("123", &table_1), ("129", &printed)] {
            let name = &format!("copper of {copper} GPa");
            let points = found
                .iter()
                .map(|(step_s, values)| (1e6 * step_s, values[k]));
            panel = panel.line(name, Style::Plain, points.collect());
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
        claims: claims(&table_1, &printed),
    })
}

fn claims(table_1: &[Found], printed: &[Found]) -> Vec<Claim> {
    let fitting = |found: &[Found]| -> Vec<String> {
        let steps = found.iter().filter(gives_all);
        steps
            .map(|(step_s, _)| format!("{:.3}", 1e6 * step_s))
            .collect()
    };
    let (of_table_1, of_printed) = (fitting(table_1), fitting(printed));
    let told = |steps: &[String]| match steps {
        [] => "no step".to_owned(),
        steps => format!("{} us", steps.join(", ")),
    };
    let ends =
        [printed.first(), printed.last()].map(|f| f.map_or(f64::NAN, |(_, values)| values[2]));
    vec![
        Claim::new(
            "Kmax = 14.11, ts = 27.0 us and Rf = 0.991 together",
            !of_printed.is_empty(),
            format!(
                "all three to their digits with {} and copper of 129 GPa, {} and 123 GPa, of {} steps each",
                told(&of_printed),
                told(&of_table_1),
                printed.len()
            ),
        ),
        Claim::new(
            "the restitution is 0.991",
            (ends[0] - 0.991).abs() < 5e-4 && (ends[1] - 0.991).abs() < 5e-4,
            format!(
                "{:.4} with the smallest step, {:.4} with the largest: it follows the step",
                ends[0], ends[1]
            ),
        ),
    ]
}
