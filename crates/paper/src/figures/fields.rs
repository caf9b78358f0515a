//! Figures 7 to 11: the fields over time.

use super::{Claim, Redrawn, single};
use crate::case::{RADIUS_M, Runs, STRENGTH_PA};
use contact::WaveSpeeds;
use fault::AnyError;
use figure::{Axis, Figure, Legend, Panel, Style};
use impact::{Field, FieldHistory, Run};
use rayon::prelude::*;
use std::f64::consts::FRAC_1_SQRT_2;

/// Name of the curves under the paper's force.
const PAPER_FORCE: &str = "under the paper's force";

const ON_SURFACE: (&str, [f64; 2]) = ("r", [1.0, 0.0]);
const ON_AXIS: (&str, [f64; 2]) = ("z", [0.0, 1.0]);

/// A field over time: time in s and value.
type Curve = Vec<(f64, f64)>;

/// Specification of a figure.
struct FieldFigure {
    name: &'static str,
    title: &'static str,
    field: Field,
    /// Line of the points: name of their distance from the centre, and r and z over that distance.
    along: (&'static str, [f64; 2]),
    /// Distances of the points in r0.
    distances: &'static [f64],
    caption: &'static str,
    /// The paper's claims about the figure, judged by its curves.
    claims: fn(&[Curve], &WaveSpeeds) -> Vec<Claim>,
}

const SHOWN: [FieldFigure; 5] = [
    FieldFigure {
        name: "fig-07",
        title: "Fig. 7: deflection w(r, 0, t) of the surface",
        field: Field::DisplacementZ,
        along: ON_SURFACE,
        distances: &[0.1, 1.0, 3.0, 5.0],
        caption: "",
        claims: of_surface,
    },
    FieldFigure {
        name: "fig-08",
        title: "Fig. 8: displacement w(0, z, t) on the axis",
        field: Field::DisplacementZ,
        along: ON_AXIS,
        distances: &[0.0, 1.0, 3.0, 5.0],
        caption: "Caption and text of the paper's figure disagree: z = 0 in one, \"r = 0.1 r0\" in the other; here it is z = 0.",
        claims: of_depths,
    },
    FieldFigure {
        name: "fig-09",
        title: "Fig. 9: stress on the axis over the tensile strength of copper",
        field: Field::StressZz,
        along: ON_AXIS,
        distances: &[1.0, 3.0, 5.0],
        caption: "Compression is negative.",
        claims: |curves, _| vec![amplitude(curves, 1.0 / STRENGTH_PA, "")],
    },
    FieldFigure {
        name: "fig-10",
        title: "Fig. 10: stress at 45 degrees over the tensile strength of copper",
        field: Field::StressZz,
        along: ("√(r^{2} + z^{2})", [FRAC_1_SQRT_2; 2]),
        distances: &[2.0, 3.0, 5.0],
        caption: "Caption and text of the paper disagree on the first point, 2 r0/√2 from both axes; here it is that.",
        claims: of_reversal,
    },
    FieldFigure {
        name: "fig-11",
        title: "Fig. 11: radial stress on the surface over the tensile strength of copper",
        field: Field::StressRr,
        along: ON_SURFACE,
        distances: &[1.0, 3.0, 5.0],
        caption: "",
        claims: of_quiet,
    },
];

impl FieldFigure {
    /// Points of the figure, r and z in r0.
    fn places(&self) -> impl Iterator<Item = [f64; 2]> {
        let (_, direction) = self.along;
        let place = move |&d: &f64| direction.map(|part| d * part);
        self.distances.iter().map(place)
    }

    /// Curves of the figure, from the fields at all points.
    fn curves(&self, fields: &[([f64; 2], FieldHistory)]) -> Vec<Curve> {
        let curve = |place| {
            let (_, history) = fields.iter().find(|(other, _)| *other == place)?;
            let samples = history[self.field].samples.iter().copied();
            Some(history.time_s.iter().copied().zip(samples).collect())
        };
        self.places().filter_map(curve).collect()
    }

    fn draw(&self, ours: &[Curve], theirs: &[Curve], speeds: &WaveSpeeds) -> Figure {
        let (axis, scale) = match self.field {
            Field::DisplacementZ => (Axis::linear("axial displacement w").si("m"), 1.0),
            Field::DisplacementR => (Axis::linear("radial displacement u").si("m"), 1.0),
            Field::StressRr => (Axis::linear("σ_{rr}/R_{m}"), STRENGTH_PA),
            Field::StressTt => (Axis::linear("σ_{tt}/R_{m}"), STRENGTH_PA),
            Field::StressZz => (Axis::linear("σ_{zz}/R_{m}"), STRENGTH_PA),
            Field::StressRz => (Axis::linear("σ_{rz}/R_{m}"), STRENGTH_PA),
        };
        let scaled = |curve: &Curve| curve.iter().map(|&(t, x)| (t, x / scale)).collect();
        let mut panel = Panel::new(Axis::linear("time").si("s"), axis)
            .height(420.0)
            .legend(Legend::Outside);
        for curve in theirs {
            panel = panel.line(PAPER_FORCE, Style::Dotted, scaled(curve));
        }
        let (along, _) = self.along;
        for (curve, distance) in ours.iter().zip(self.distances) {
            let name = match distance {
                0.0 => format!("{along} = 0"),
                1.0 => format!("{along} = r_{{0}}"),
                _ => format!("{along} = {distance} r_{{0}}"),
            };
            panel.x.range = curve.last().map(|end| (0.0, end.0));
            panel = panel.line(&name, Style::Plain, scaled(curve));
        }
        for ([r, z], distance) in self.places().zip(self.distances) {
            let first_s = speeds.arrivals_s(r * RADIUS_M, z * RADIUS_M, RADIUS_M)[0];
            if first_s > 0.0 {
                panel = panel.mark(first_s, &format!("P, {distance}"));
            }
        }
        let subtitle = "copper of 123 GPa, converged; P: first wave at each distance in r_{0}";
        single(self.title, subtitle, panel)
    }
}

/// Figs 7 to 11.
pub(super) fn figures(runs: &Runs) -> Result<Vec<Redrawn>, AnyError> {
    let (ours, theirs) = (fields(&runs.table_1)?, fields(&runs.scheme)?);
    let speeds = runs.table_1.excitation().speeds();
    let redrawn = |shown: &FieldFigure| {
        let curves = shown.curves(&ours);
        Redrawn {
            name: shown.name,
            title: shown.title,
            figure: shown.draw(&curves, &shown.curves(&theirs), &speeds),
            caption: shown.caption,
            claims: (shown.claims)(&curves, &speeds),
        }
    };
    Ok(SHOWN.iter().map(redrawn).collect())
}

/// The fields of a run at the points of all figures, each once.
fn fields(run: &Run) -> Result<Vec<([f64; 2], FieldHistory)>, AnyError> {
    let mut places: Vec<[f64; 2]> = SHOWN.iter().flat_map(FieldFigure::places).collect();
    places.sort_by_key(|place| place.map(f64::to_bits));
    places.dedup();
    let fields = run
        .excitation()
        .fields(1e-2 * FIELD_TOLERANCE)?
        .to_tolerance(FIELD_TOLERANCE);
    let fields = fields.until(UNTIL * run.contact_time_s);
    let at = places.into_par_iter().map(|[r, z]| {
        let history = fields.at(r * RADIUS_M, z * RADIUS_M)?;
        Ok(([r, z], history))
    });
    at.collect()
}

/// Text with the values, from the nearest point to the farthest.
fn list(curves: &[Curve], of: impl Fn(&Curve) -> f64, digits: usize) -> String {
    let values = curves.iter().map(|c| format!("{:.digits$}", of(c)));
    values.collect::<Vec<_>>().join(", ")
}

/// Whether values fall from point to point.
fn falls(curves: &[Curve], of: impl Fn(&Curve) -> f64) -> bool {
    curves.windows(2).all(|pair| of(&pair[1]) < of(&pair[0]))
}

fn amplitude(curves: &[Curve], scale: f64, unit: &str) -> Claim {
    Claim {
        says: "away from the source the amplitude decreases",
        holds: falls(curves, |c| peak(c).abs()),
        found: list(curves, |c| scale * peak(c), 2) + unit,
    }
}

fn width(curves: &[Curve]) -> Claim {
    Claim {
        says: "away from the source the disturbance widens",
        holds: falls(curves, |c| -width_s(c)),
        found: format!(
            "time above half the peak {} us",
            list(curves, |c| 1e6 * width_s(c), 2)
        ),
    }
}

/// Claim: beyond the first points there is a deflection opposite to the main one and larger than a fraction of it.
fn negative(curves: &[Curve], fraction: f64, places: &str) -> Claim {
    Claim {
        says: "away from the source a slight negative deflection appears",
        holds: curves.iter().all(|c| other(c) < -fraction * peak(c)),
        found: format!("{} um at {places}", list(curves, |c| 1e6 * other(c), 2)),
    }
}

fn of_surface(curves: &[Curve], speeds: &WaveSpeeds) -> Vec<Claim> {
    let rayleigh_s = speeds.arrivals_s(5.0 * RADIUS_M, 0.0, RADIUS_M)[2];
    // relative to its peak
    let after = curves[3].iter().find(|(t, _)| *t >= rayleigh_s);
    let at_rayleigh = after.map_or(0.0, |(_, x)| x / peak(&curves[3]));
    vec![
        amplitude(curves, 1e6, " um"),
        width(curves),
        negative(&curves[2..], 0.0, "3 and 5 r0"),
        Claim {
            says: "the arrivals of S and R cannot be seen",
            holds: at_rayleigh.abs() < 0.1,
            found: format!(
                "at 5 r0 the Rayleigh wave of the disc's edge comes at {:.2} us, when the deflection has {at_rayleigh:+.3} of its peak: the force has just begun to rise, and with zero slope",
                1e6 * rayleigh_s
            ),
        },
    ]
}

fn of_depths(curves: &[Curve], _: &WaveSpeeds) -> Vec<Claim> {
    vec![
        amplitude(curves, 1e6, " um"),
        width(curves),
        negative(&curves[1..], 1e-3, "r0, 3 r0 and 5 r0"),
    ]
}

fn of_reversal(curves: &[Curve], _: &WaveSpeeds) -> Vec<Claim> {
    vec![
        amplitude(curves, 1.0 / STRENGTH_PA, ""),
        Claim {
            says: "at the end of the disturbance the stress changes its sign into tension",
            holds: curves.iter().all(|c| other(c) > 1e-3 * peak(c).abs()),
            found: format!(
                "largest tension {} Rm",
                list(curves, |c| other(c) / STRENGTH_PA, 3)
            ),
        },
    ]
}

fn of_quiet(curves: &[Curve], speeds: &WaveSpeeds) -> Vec<Claim> {
    let first_s = speeds.arrivals_s(5.0 * RADIUS_M, 0.0, RADIUS_M)[0];
    let found_s = curves.last().map_or(f64::NAN, |curve| {
        let most = 1e-9 * peak(curve).abs();
        let first = curve.iter().find(|(_, x)| x.abs() > most);
        first.map_or(f64::INFINITY, |(t, _)| *t)
    });
    vec![
        amplitude(curves, 1.0 / STRENGTH_PA, ""),
        Claim {
            says: "at 5 r0 there is no disturbance before 4 r0/c1",
            holds: found_s >= first_s,
            found: format!(
                "the first sample above 1e-9 of the peak is at {:.2} us, 4 r0/c1 is {:.2} us",
                1e6 * found_s,
                1e6 * first_s
            ),
        },
    ]
}

/// End of the time axis of fields, in contact times.
const UNTIL: f64 = 1.6;

/// Relative tolerance of the fields.
const FIELD_TOLERANCE: f64 = 1e-4;

/// The value of a curve that is farthest from zero.
fn peak(curve: &Curve) -> f64 {
    let larger = |most: f64, &(_, x): &(f64, f64)| if x.abs() > most.abs() { x } else { most };
    curve.iter().fold(0.0, larger)
}

/// The value of largest magnitude whose sign is opposite to that of the peak.
fn other(curve: &Curve) -> f64 {
    let sign = peak(curve).signum();
    let farther = |most: f64, &(_, x): &(f64, f64)| if x * sign < most * sign { x } else { most };
    curve.iter().fold(0.0, farther)
}

/// The duration in s for which a curve is above half its peak.
fn width_s(curve: &Curve) -> f64 {
    let peak = peak(curve);
    let widths = curve.windows(2).map(|pair| {
        let [(from_s, a), (to_s, b)] = [pair[0], pair[1]].map(|(t, x)| (t, x / peak - 0.5));
        let part = (a.max(0.0) + b.max(0.0)) / (a.abs() + b.abs()).max(f64::MIN_POSITIVE);
        (to_s - from_s) * part
    });
    widths.sum()
}
