//! Figures 7 to 11: the fields over time.

use super::{Claim, Redrawn, single};
use crate::case::{RADIUS_M, Runs, STRENGTH_PA};
use contact::WaveSpeeds;
use fault::AnyError;
use figure::{Axis, Figure, Legend, Panel, Style};
use impact::{Field, FieldHistory, Run};
use rayon::prelude::*;
use std::f64::consts::FRAC_1_SQRT_2;

/// Distances of the surface's and the axis' curves of displacement, in r0.
const SURFACE: [f64; 4] = [0.1, 1.0, 3.0, 5.0];
const DEPTHS: [f64; 4] = [0.0, 1.0, 3.0, 5.0];

/// Distances of the curves at 45 degrees, in r0.
const OBLIQUE: [f64; 3] = [2.0, 3.0, 5.0];

/// Name of the curves under the paper's force.
const PAPER_FORCE: &str = "under the paper's force";

/// Where the points of a figure lie.
#[derive(Debug, Clone, Copy)]
enum Along {
    Surface,
    Axis,
    /// At 45 degrees.
    Oblique,
}

impl Along {
    /// Points at distances in r0.
    fn places(self, distances: &[f64]) -> Vec<[f64; 2]> {
        let place = |&d: &f64| match self {
            Self::Surface => [d, 0.0],
            Self::Axis => [0.0, d],
            Self::Oblique => [d * FRAC_1_SQRT_2, d * FRAC_1_SQRT_2],
        };
        distances.iter().map(place).collect()
    }

    /// How the distance is called.
    fn name(self) -> &'static str {
        match self {
            Self::Surface => "r",
            Self::Axis => "z",
            Self::Oblique => "√(r^{2} + z^{2})",
        }
    }
}

/// What a figure shows.
struct Shown {
    name: &'static str,
    title: &'static str,
    field: Field,
    along: Along,
    /// Distances of the points in r0.
    distances: &'static [f64],
    caption: &'static str,
    /// What is said of it, from its curves.
    claims: fn(&[History<'_>], &Histories) -> Vec<Claim>,
}

const SHOWN: [Shown; 5] = [
    Shown {
        name: "fig-07",
        title: "Fig. 7: deflection w(r, 0, t) of the surface",
        field: Field::DisplacementZ,
        along: Along::Surface,
        distances: &SURFACE,
        caption: "",
        claims: of_surface,
    },
    Shown {
        name: "fig-08",
        title: "Fig. 8: displacement w(0, z, t) on the axis",
        field: Field::DisplacementZ,
        along: Along::Axis,
        distances: &DEPTHS,
        caption: "Caption and text of the paper's figure disagree: z = 0 in one, \"r = 0.1 r0\" in the other; here it is z = 0.",
        claims: of_depths,
    },
    Shown {
        name: "fig-09",
        title: "Fig. 9: stress on the axis over the tensile strength of copper",
        field: Field::StressZz,
        along: Along::Axis,
        distances: &[1.0, 3.0, 5.0],
        caption: "Compression is negative.",
        claims: |curves, _| vec![amplitude(curves, 1.0 / STRENGTH_PA, "")],
    },
    Shown {
        name: "fig-10",
        title: "Fig. 10: stress at 45 degrees over the tensile strength of copper",
        field: Field::StressZz,
        along: Along::Oblique,
        distances: &OBLIQUE,
        caption: "Caption and text of the paper disagree on the first point, 2 r0/√2 from both axes; here it is that.",
        claims: of_reversal,
    },
    Shown {
        name: "fig-11",
        title: "Fig. 11: radial stress on the surface over the tensile strength of copper",
        field: Field::StressRr,
        along: Along::Surface,
        distances: &[1.0, 3.0, 5.0],
        caption: "",
        claims: of_quiet,
    },
];

impl Shown {
    /// The ordinate, and what the field is divided by.
    fn ordinate(&self) -> (Axis, f64) {
        if self.field == Field::DisplacementZ {
            return (Axis::linear("axial displacement w").si("m"), 1.0);
        }
        let component = if self.field == Field::StressRr {
            "rr"
        } else {
            "zz"
        };
        let axis = Axis::linear(&format!("σ_{{{component}}}/R_{{m}}"));
        (axis, STRENGTH_PA)
    }
}

/// Figs 7 to 11.
pub(super) fn figures(runs: &Runs) -> Result<Vec<Redrawn>, AnyError> {
    let mut places = Along::Surface.places(&SURFACE);
    places.extend(Along::Axis.places(&DEPTHS));
    places.extend(Along::Oblique.places(&OBLIQUE));
    let ours = Histories::new(&runs.table_1, &places)?;
    let theirs = Histories::new(&runs.scheme, &places)?;
    let redrawn = |shown: &Shown| {
        let places = shown.along.places(shown.distances);
        let curves: Vec<History<'_>> = ours.of(shown.field, &places).collect();
        Redrawn {
            name: shown.name,
            title: shown.title,
            figure: draw(shown, &ours, &theirs),
            caption: shown.caption,
            claims: (shown.claims)(&curves, &ours),
        }
    };
    Ok(SHOWN.iter().map(redrawn).collect())
}

fn draw(shown: &Shown, ours: &Histories, theirs: &Histories) -> Figure {
    let mut end_s = 0.0_f64;
    let places = shown.along.places(shown.distances);
    let (axis, scale) = shown.ordinate();
    let mut panel = Panel::new(Axis::linear("time").si("s"), axis)
        .height(420.0)
        .legend(Legend::Outside);
    for history in theirs.of(shown.field, &places) {
        panel = panel.line(PAPER_FORCE, Style::Dotted, history.curve(scale));
    }
    let along = shown.along.name();
    for (history, distance) in ours.of(shown.field, &places).zip(shown.distances) {
        let name = match distance {
            0.0 => format!("{along} = 0"),
            1.0 => format!("{along} = r_{{0}}"),
            _ => format!("{along} = {distance} r_{{0}}"),
        };
        end_s = history.time_s.last().copied().unwrap_or(0.0);
        panel = panel.line(&name, Style::Plain, history.curve(scale));
    }
    for ([r, z], distance) in places.iter().zip(shown.distances) {
        let first_s = ours.speeds.arrivals_s(r * RADIUS_M, z * RADIUS_M, RADIUS_M)[0];
        if first_s > 0.0 {
            panel = panel.mark(first_s, &format!("P, {distance}"));
        }
    }
    panel.x = panel.x.range(0.0, end_s);
    let subtitle = "copper of 123 GPa, converged; P: first wave at each distance in r_{0}";
    single(shown.title, subtitle, panel)
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

/// A deflection against the main one, beyond a fraction of it, at the points after the first ones.
fn negative(curves: &[History<'_>], fraction: f64, places: &str) -> Claim {
    Claim::new(
        "away from the source a slight negative deflection appears",
        curves.iter().all(|c| c.other() < -fraction * c.peak()),
        format!("{} um at {places}", list(curves, |c| 1e6 * c.other(), 2)),
    )
}

fn of_surface(curves: &[History<'_>], ours: &Histories) -> Vec<Claim> {
    let rayleigh_s = ours.speeds.arrivals_s(5.0 * RADIUS_M, 0.0, RADIUS_M)[2];
    let at_rayleigh = curves[3].share_at(rayleigh_s);
    vec![
        amplitude(curves, 1e6, "um"),
        width(curves),
        negative(&curves[2..], 0.0, "3 and 5 r0"),
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
    vec![
        amplitude(curves, 1e6, "um"),
        width(curves),
        negative(&curves[1..], 1e-3, "r0, 3 r0 and 5 r0"),
    ]
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

/// Until when fields are drawn, in contact times.
const UNTIL: f64 = 1.6;

/// Relative tolerance of the fields.
const TOLERANCE: f64 = 1e-4;

/// The fields of a run at points, r and z in r0.
#[derive(Debug, Clone)]
struct Histories {
    /// Wave speeds of the anvil.
    speeds: WaveSpeeds,
    at: Vec<([f64; 2], FieldHistory)>,
}

/// A field at a point.
#[derive(Debug, Clone, Copy)]
struct History<'a> {
    time_s: &'a [f64],
    samples: &'a [f64],
}

impl Histories {
    /// Computes them.
    fn new(run: &Run, places: &[[f64; 2]]) -> Result<Self, AnyError> {
        let excitation = run.excitation();
        let fields = excitation
            .fields(1e-2 * TOLERANCE)?
            .until(UNTIL * run.contact_time_s)
            .to_tolerance(TOLERANCE);
        let at = places.par_iter().map(|&[r, z]| {
            let history = fields.at(r * RADIUS_M, z * RADIUS_M)?;
            Ok::<_, AnyError>(([r, z], history))
        });
        Ok(Self {
            speeds: excitation.speeds(),
            at: at.collect::<Result<_, _>>()?,
        })
    }

    /// A field at each of some points, which are among those computed.
    fn of<'a>(&'a self, field: Field, places: &'a [[f64; 2]]) -> impl Iterator<Item = History<'a>> {
        let of_place = move |place: &[f64; 2]| self.at.iter().find(|(other, _)| other == place);
        places
            .iter()
            .filter_map(of_place)
            .map(move |(_, history)| History {
                time_s: &history.time_s,
                samples: &history[field].samples,
            })
    }
}

impl History<'_> {
    /// The points of a curve, over `scale`.
    fn curve(&self, scale: f64) -> Vec<(f64, f64)> {
        let points = self.time_s.iter().zip(self.samples);
        points.map(|(&t, &x)| (t, x / scale)).collect()
    }

    /// The value that is farthest from zero.
    fn peak(&self) -> f64 {
        let larger = |most: f64, &x: &f64| if x.abs() > most.abs() { x } else { most };
        self.samples.iter().fold(0.0, larger)
    }

    /// The value farthest on the other side of zero than the peak, with its sign.
    fn other(&self) -> f64 {
        let sign = self.peak().signum();
        let farther = |most: f64, &x: &f64| if x * sign < most * sign { x } else { most };
        self.samples.iter().fold(0.0, farther)
    }

    /// The time in s for which it is above half its peak.
    fn width_s(&self) -> f64 {
        let (peak, mut width) = (self.peak(), 0.0);
        for (times, values) in self.time_s.windows(2).zip(self.samples.windows(2)) {
            let above = |x: f64| (x / peak).max(0.5) - 0.5 > 0.0;
            width += match (above(values[0]), above(values[1])) {
                (true, true) => times[1] - times[0],
                (false, false) => 0.0,
                (left, _) => {
                    let share = (0.5 * peak - values[0]) / (values[1] - values[0]);
                    (times[1] - times[0]) * if left { share } else { 1.0 - share }
                }
            };
        }
        width
    }

    /// Its value at a time, in its peak.
    fn share_at(&self, time_s: f64) -> f64 {
        let after = self.time_s.partition_point(|&t| t < time_s);
        self.samples.get(after).map_or(0.0, |x| x / self.peak())
    }

    /// When it first exceeds a share of its peak, in s.
    fn first_s(&self, share: f64) -> f64 {
        let most = share * self.peak().abs();
        let first = self.samples.iter().position(|x| x.abs() > most);
        first.map_or(f64::INFINITY, |i| self.time_s[i])
    }
}
