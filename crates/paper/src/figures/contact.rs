//! Figures 4 and 6: the contact over time.

use super::{CONVERGED, Claim, GROWING, HERTZ_CURVE, Redrawn, SCHEME, WIDTH, single};
use crate::case::{RADIUS_M, Runs, VELOCITY_M_S, kmax};
use figure::{Axis, Figure, Layer, Legend, Panel, Sharing, Style};
use impact::{Motion, Run};

/// End of the time axis in s; the printed contact time is 27 us.
const UNTIL_S: f64 = 31e-6;

/// Explanation of the points.
const STARS: &str = "stars: values printed in the paper";

/// Number of points of a curve.
const CURVE_POINTS: u32 = 620;

fn over_time(of: impl Fn(f64) -> Option<f64>) -> Vec<(f64, f64)> {
    let times = (0..=CURVE_POINTS).map(|i| UNTIL_S * f64::from(i) / f64::from(CURVE_POINTS));
    times.filter_map(|t| Some((t, of(t)?))).collect()
}

fn motion(run: &Run, of: impl Fn(Motion) -> f64) -> Vec<(f64, f64)> {
    over_time(|t| run.excitation().motion(t).map(&of))
}

fn force(run: &Run, scale: f64) -> Vec<(f64, f64)> {
    over_time(|t| Some(run.excitation().force_n(t) / scale))
}

/// Fig. 4.
pub(super) fn history(runs: &Runs) -> Redrawn {
    let pairs = [(CONVERGED, &runs.table_1), (SCHEME, &runs.scheme)];
    let panel = |quantity: &str, unit: &str| {
        let time = Axis::linear("time").si("s").range(0.0, UNTIL_S);
        Panel::new(time, Axis::linear(quantity).si(unit)).height(230.0)
    };
    let mut forces = panel("force P", "N").legend(Legend::Outside);
    let mut lengths = panel("displacement", "m").legend(Legend::Outside);
    let mut speeds = panel("velocity of the rod v", "m/s").legend(Legend::Outside);
    for (name, run) in pairs {
        forces = forces.line(name, Style::Plain, force(run, 1.0));
        speeds = speeds.line(name, Style::Plain, motion(run, |m| m.velocity_m_s));
    }
    forces = forces
        .line(HERTZ_CURVE, Style::Plain, force(&runs.hertz_printed, 1.0))
        .line(GROWING, Style::Plain, force(&runs.growing, 1.0))
        .layer(Layer::star((13.5e-6, 160e3), "160 kN"))
        .layer(Layer::star((27.0e-6, 0.0), "27.0 µs"));
    for (name, what) in [("h", 0), ("w", 1)] {
        for (whose, run) in pairs {
            let of = |m: Motion| [m.displacement_m, m.deflection_m][what];
            let name = format!("{name}: {whose}");
            lengths = lengths.line(&name, Style::Plain, motion(run, of));
        }
    }
    speeds = speeds.layer(Layer::star((27.0e-6, -99.1), "-99.1 m/s"));
    Redrawn {
        name: "fig-04",
        title: "Fig. 4: force P, displacement h, deflection w and speed v",
        figure: Figure::new("Fig. 4: force, displacements and velocity")
            .subtitle(STARS)
            .sharing(Sharing::X)
            .width(WIDTH)
            .panel(forces)
            .panel(lengths)
            .panel(speeds),
        caption: "h is the rod's displacement, w the half-space's; the velocity is positive into the block, so that the printed 99.1 m/s of departure are negative. A contact whose radius follows the load counts the static deflection of the block once, the paper's model twice: hence its smaller force and longer contact.",
        claims: symmetry(runs),
    }
}

fn symmetry(runs: &Runs) -> Vec<Claim> {
    let share = |run: &Run| run.peak_force_time_s / run.contact_time_s;
    let table_1 = &runs.table_1;
    let (hertz, coupled) = (share(&runs.hertz_printed), share(table_1));
    let mut speeds = motion(table_1, |m| m.velocity_m_s).into_iter();
    let turn_s = speeds.find(|(_, v)| *v <= 0.0).map_or(f64::NAN, |(t, _)| t);
    // h - w at the end of contact over the largest h
    let end = table_1.excitation().motion(table_1.contact_time_s);
    let open_m = end.map_or(f64::NAN, |m| (m.displacement_m - m.deflection_m).abs());
    let closes = open_m / table_1.peak_displacement_m;
    vec![
        Claim {
            says: "P(t) is symmetrical about t's, with ts = 2 t's",
            holds: (coupled - 0.5).abs() < 0.01,
            found: format!(
                "the peak comes at {coupled:.4} of the contact time, Hertz's at {hertz:.4}: the energy lost to waves makes the rise a little shorter than the fall"
            ),
        },
        Claim {
            says: "the speed drops to zero at t's",
            holds: (turn_s / table_1.peak_force_time_s - 1.0).abs() < 0.02,
            found: format!(
                "the rod turns at {:.2} us, the force peaks at {:.2} us",
                1e6 * turn_s,
                1e6 * table_1.peak_force_time_s
            ),
        },
        Claim {
            says: "h - w = 0 when the force has fallen to zero",
            holds: closes < 1e-3,
            found: format!("{closes:.0e} of the largest h"),
        },
        Claim {
            says: "the restitution hardly depends on speed and size",
            holds: false,
            found: format!(
                "the loss 1 - e^2 of {:.4} grows with the speed to the power 3/5 for a contact that follows the load; 0.991 is a time-step error",
                table_1.loss
            ),
        },
    ]
}

/// Fig. 6.
pub(super) fn stress(runs: &Runs) -> Redrawn {
    let time = Axis::linear("time").si("s").range(0.0, UNTIL_S);
    let one_n = 1.0 / kmax(1.0, RADIUS_M);
    let mut panel = Panel::new(time, Axis::linear("P/(π r_{0}^{2})/R_{m}")).height(420.0);
    for (name, run) in [
        (CONVERGED, &runs.table_1),
        (SCHEME, &runs.scheme),
        (HERTZ_CURVE, &runs.hertz_printed),
    ] {
        panel = panel.line(name, Style::Plain, force(run, one_n));
    }
    panel = panel
        .layer(Layer::star((13.5e-6, 14.11), "14.11"))
        .layer(Layer::star((12.3e-6, 15.97), "15.97"));
    let mean_ry = runs.table_1.peak_force_n * kmax(1.0, RADIUS_M) * 227.0 / 57.0;
    Redrawn {
        name: "fig-06",
        title: "Fig. 6: contact stress over the tensile strength of copper",
        figure: single(
            "Fig. 6: P/S over the tensile strength of copper, 227 MPa",
            STARS,
            panel,
        ),
        caption: "S is the area of the rod, not of the contact.",
        claims: vec![Claim {
            says: "the stress is significantly higher than the tensile strength",
            holds: mean_ry > 1.0,
            found: format!(
                "14 times the tensile strength and {mean_ry:.0} times the yield point of Table 1 on average over the rod's section: at {VELOCITY_M_S:.0} m/s the linear elastic model is used far outside its range, as the paper says itself"
            ),
        }],
    }
}
