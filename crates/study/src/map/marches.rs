//! Marching schemes: the step, and the stiffness of the contact over the impedance of the half-space.
//!
//! At its peak the contact is a spring k = (3/2) p^(1/3); at first the half-space is a dashpot of impedance
//! Z = 1/G(0), G the impulse response. Both in collision units.
//!
//! ```text
//! explicit, oscillates      z^2 - z + (lambda/2)(z + 1) = 0 has complex roots:       lambda = h k/Z > 6 - 4 sqrt 2
//! explicit, blown up        z^2 - z + (lambda/2)(z + 1) = 0 has a root beyond 1:  lambda = h k/Z > 2
//! explicit, gains energy    1 - e^2 = loss - h C,   C = (25/16) int p^2 dt - (5/2) int p' w' dt
//! implicit, oscillates      the recurrence of the weights with the spring k has a root beyond 1
//! dynamic share             a y^3 + y^2 = b has no root:  (coupling g_0 - (5/48) h^2) p^(1/3) > 2/3
//! ```
//!
//! The first is the stability of the newest samples, the second first-order perturbation: v lags the force
//! by half a step, which feeds h (25/16) int p^2 into the striker, and w by a step, which takes
//! h (5/2) int p' w' out again.

use super::StabilityMap;
use crate::measure::Effort;
use crate::picture::Picture;
use crate::scenes::{paper_disc, paper_response};
use contact::law::hertz::CONTACT_TIME;
use contact::{
    Choice, FixedDisc, History, MarchError, StaticShare, Summary, Weights, march_explicit,
    march_implicit,
};
use fault::AnyError;
use figure::{Interval, Layer, Style};
use halfspace::bisected;
use paper::PRINTED_PA;

contact::choice! {
    /// Outcome of a march.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub(super) enum MarchOutcome {
        /// Restitution within 1e-3 of the converged one.
        Accurate = "restitution within 1e-3",
        /// It loses energy, though not the right amount.
        Lossy = "loses energy, off by more",
        /// The striker leaves faster than it came.
        GainsEnergy = "gains energy: restitution above 1",
        /// The force has maxima that the converged one does not have.
        Oscillates = "the force oscillates",
        /// The contact breaks off early, the force grows without bound, or the march refuses.
        BlownUp = "breaks off, blows up or refuses",
    }
}

/// A disc with its converged impact and the integrals for first-order theory.
pub(super) struct Converged<'a> {
    disc: FixedDisc<'a>,
    /// Its results.
    pub(super) summary: Summary,
    /// Maxima of its force.
    maxima: usize,
    /// C of the energy that the explicit scheme feeds in: 1 - e^2 = loss - h C.
    pub(super) gain: f64,
}

impl<'a> Converged<'a> {
    /// Marches implicitly with at least 800 steps and computes the integrals of the energy balance.
    pub(super) fn new(disc: FixedDisc<'a>) -> Result<Self, MarchError> {
        let history = march_implicit(&disc, CONTACT_TIME / 800.0)?;
        let summary = Summary::new(&history)?;
        let steps = (summary.contact_time / history.step).ceil() as usize;
        let (p, w) = (&history.force, &history.deflection);
        let mut gain = 0.0;
        for i in 1..steps.min(p.len() - 1) {
            let slope = |samples: &[f64]| (samples[i + 1] - samples[i - 1]) / (2.0 * history.step);
            gain += history.step * (1.5625 * p[i] * p[i] - 2.5 * slope(p) * slope(w));
        }
        Ok(Self {
            disc,
            summary,
            maxima: maxima(p),
            gain,
        })
    }

    /// Restitution of the explicit scheme at a step in collision units, to first order.
    pub(super) fn explicit_restitution(&self, step: f64) -> f64 {
        (1.0 - self.summary.loss + step * self.gain).max(0.0).sqrt()
    }

    /// Step beyond which the explicit scheme blows up: h k/Z = 2.
    pub(super) fn stable_step(&self) -> f64 {
        2.0 / (self.stiffness() * admittance(&self.disc))
    }

    /// Step beyond which the newest samples of the explicit scheme oscillate: h k/Z = 6 - 4 sqrt 2.
    pub(super) fn smooth_step(&self) -> f64 {
        (3.0 - 2.0 * std::f64::consts::SQRT_2) * self.stable_step()
    }

    /// k of the contact at its peak.
    fn stiffness(&self) -> f64 {
        1.5 * self.summary.peak_force.cbrt()
    }

    /// Outcome of the explicit scheme at a step.
    pub(super) fn explicit(&self, step: f64) -> MarchOutcome {
        let march = march_explicit(&self.disc, step);
        self.outcome(march.map(|(history, summary)| (summary, history)))
    }

    /// Outcome of the implicit scheme at a step.
    pub(super) fn implicit(&self, step: f64) -> MarchOutcome {
        let march = march_implicit(&self.disc, step);
        self.outcome(march.and_then(|march| Ok((Summary::new(&march)?, march))))
    }

    fn outcome(&self, march: Result<(Summary, History), MarchError>) -> MarchOutcome {
        let Ok((summary, history)) = march else {
            return MarchOutcome::BlownUp;
        };
        let early = summary.contact_time < 0.8 * self.summary.contact_time;
        if early || !summary.restitution.is_finite() {
            MarchOutcome::BlownUp
        } else if maxima(&history.force) > self.maxima {
            MarchOutcome::Oscillates
        } else if (summary.restitution - self.summary.restitution).abs() <= 1e-3 {
            MarchOutcome::Accurate
        } else if summary.restitution > 1.0 {
            MarchOutcome::GainsEnergy
        } else {
            MarchOutcome::Lossy
        }
    }
}

/// 1/Z = G(0) in collision units.
pub(super) fn admittance(disc: &FixedDisc<'_>) -> f64 {
    disc.coupling * disc.response.impulse(0.0) / disc.wave_time
}

/// Number of maxima of a force that exceed both sides by 1e-4 of its largest value.
fn maxima(force: &[f64]) -> usize {
    let least = 1e-4 * force.iter().fold(0.0_f64, |a, &p| a.max(p));
    // the sign tells whether the force has risen or fallen since the last extremum
    let (mut count, mut sign, mut turn) = (0, 1.0_f64, 0.0_f64);
    for &p in force {
        turn = sign * (sign * turn).max(sign * p);
        if sign * p < sign * turn - least {
            count += usize::from(sign > 0.0);
            (sign, turn) = (-sign, p);
        }
    }
    count
}

/// The paper's case at two steps, the second of which reproduces its restitution: label, place on the map, step.
fn paper_steps(paper: &Converged<'_>) -> [(String, (f64, f64), f64); 2] {
    [54, 200].map(|n| {
        let step = paper.summary.contact_time / f64::from(n);
        let place = (1.5 * admittance(&paper.disc), step / CONTACT_TIME);
        (format!("paper's case, ts/{n}"), place, step)
    })
}

/// A map of discs and of the step over Hertz's contact time.
fn map<'a>(
    x: [f64; 2],
    quantity: &'a str,
    classes: &'a [&'a str],
    effort: Effort,
) -> StabilityMap<'a> {
    StabilityMap {
        plane: [x, [1e-3, 0.2]].map(|[low, high]| Interval::logarithmic(low, high)),
        quantities: [quantity, "step over Hertz's contact time"],
        shape: effort.pick([16, 14], [48, 40]),
        classes,
    }
}

/// A step of each column as a curve.
fn line<'a>(
    columns: &[(f64, Converged<'a>)],
    step: impl Fn(&Converged<'a>) -> f64,
) -> Vec<(f64, f64)> {
    let point = |(x, exact): &(f64, Converged<'a>)| (*x, step(exact) / CONTACT_TIME);
    columns.iter().map(point).collect()
}

/// Draws the three maps.
pub(crate) fn figures(effort: Effort, advance: &dyn Fn()) -> Result<Vec<Picture>, AnyError> {
    let response = paper_response()?;
    let disc = paper_disc(PRINTED_PA, &response)?;
    let stiffness = "contact stiffness over impedance, k/Z, per collision time";
    let outcomes: Vec<_> = MarchOutcome::ALL
        .iter()
        .map(|outcome| outcome.name())
        .collect();
    let map = map([0.1, 100.0], stiffness, &outcomes, effort);
    let mut columns = Vec::new();
    for stiffness in map.columns() {
        // a different stiffness over impedance with the same wave time
        let scale = stiffness / (1.5 * admittance(&disc));
        let coupling = disc.coupling * scale;
        columns.push((stiffness, Converged::new(FixedDisc { coupling, ..disc })?));
    }
    let paper = Converged::new(disc)?;
    let explicit = explicit(&map, &columns, &paper)?;
    advance();
    let implicit = implicit(&map, &columns, &paper);
    advance();
    let dynamic = dynamic_share(&paper.disc, effort);
    advance();
    Ok(vec![explicit, implicit, dynamic])
}

fn explicit(
    map: &StabilityMap<'_>,
    columns: &[(f64, Converged<'_>)],
    paper: &Converged<'_>,
) -> Result<Picture, AnyError> {
    let title = "Explicit march (the paper's scheme)";
    let mut figure = map.picture("march-explicit", title, |cell, y| {
        columns[cell % columns.len()].1.explicit(y * CONTACT_TIME) as usize
    });
    let stable = line(columns, Converged::stable_step);
    figure.line("theory: h k/Z = 2", Style::Heavy, stable);
    let complex = "theory: roots turn complex, h k/Z = 0.34";
    let smooth = line(columns, Converged::smooth_step);
    figure.line(complex, Style::Dotted, smooth);
    let gain = line(columns, |exact| exact.summary.loss / exact.gain);
    figure.line("theory: gain = radiated loss", Style::HeavyDashed, gain);
    let mut told = Vec::new();
    for (label, place, step) in paper_steps(paper) {
        let (_, found) = march_explicit(&paper.disc, step)?;
        let [found, theory] = [found.restitution, paper.explicit_restitution(step)];
        figure.add(Layer::star(place, &format!("{label}: e = {found:.4}")));
        told.push([found, theory].map(|e| format!("{e:.4}")));
    }
    figure.caption = format!(
        "The paper's case (E = 129 GPa) has a restitution of {:.5} when it is converged. \
         Its explicit scheme gives {} at a step of ts/200 and {} at ts/54; first-order theory gives {} and {}. \
         The published 0.991 is the energy that the scheme feeds in at about ts/200, not a property of the impact.",
        paper.summary.restitution, told[1][0], told[0][0], told[1][1], told[0][1],
    );
    Ok(figure)
}

fn implicit(
    map: &StabilityMap<'_>,
    columns: &[(f64, Converged<'_>)],
    paper: &Converged<'_>,
) -> Picture {
    let title = "Implicit march (the default)";
    let mut figure = map.picture("march-implicit", title, |cell, y| {
        columns[cell % columns.len()].1.implicit(y * CONTACT_TIME) as usize
    });
    let steps = map.plane[1].cells(4 * map.shape[1]);
    let mut growing = Vec::new();
    for (x, exact) in columns {
        let growth = |y: f64| linear_growth(&exact.disc, exact.stiffness(), y * CONTACT_TIME);
        let grows = steps.iter().filter(|y| growth(**y) > 1.0);
        growing.extend(grows.map(|&y| (*x, y)));
    }
    let root = "theory: a root of the weights beyond 1";
    figure.line(root, Style::Dots, growing);
    let fewest = "eight samples in contact, the fewest that are interpolated";
    let step = line(columns, |exact| exact.summary.contact_time / 8.0);
    figure.line(fewest, Style::Dotted, step);
    let cells = figure.points().into_iter();
    let gaining = cells.filter(|(class, ..)| *class == MarchOutcome::GainsEnergy.name());
    let gains = gaining.count();
    for (label, place, _) in paper_steps(paper) {
        figure.add(Layer::star(place, &label));
    }
    figure.caption = format!(
        "The implicit march gains energy in {gains} cells of this plane, and with fewer than eight samples in \
        contact it refuses with a sentence that asks for a smaller step. The curvature of the newest cell, an \
        extrapolation, is limited so that a force which alternates from sample to sample meets no negative compliance. \
        Where dots are left the deflection of the centre feeds energy back, on half-spaces much softer than the contact: \
        at some frequencies its compliance is real and negative, at any step. The mean deflection does not."
    );
    figure
}

/// Growth per step of the implicit scheme's newest samples at a frozen contact stiffness k.
///
/// The largest root, in modulus, of p_n/k + coupling [p_n - sum_j g_j (p_{n-j} - p_{n-j-1})] = 0, without the first p_n
/// in brackets for the dynamic share, from a long run of the recurrence. The samples settle if it is below one.
pub(super) fn linear_growth(disc: &FixedDisc<'_>, stiffness: f64, step: f64) -> f64 {
    const RECURRENCE_STEPS: usize = 400;
    let lag = Weights::of(disc, disc.response, step).values;
    let own = 1.0 / stiffness + disc.coupling * (disc.share.factor() - lag[0]);
    let mut p = vec![0.0; lag.len() + 1];
    p.push(1.0);
    // rescaled to avoid overflow; the logarithm of the scale is summed
    let mut growth = 0.0;
    for n in 0..RECURRENCE_STEPS {
        let m = p.len();
        let terms = lag[1..].iter().enumerate();
        let past = terms.map(|(j, g)| g * (p[m - 1 - j] - p[m - 2 - j]));
        let past: f64 = past.sum();
        p.push(disc.coupling * (past - lag[0] * p[m - 1]) / own);
        p.remove(0);
        let size = p.iter().fold(0.0_f64, |a, v| a.max(v.abs()));
        if size == 0.0 {
            return 0.0;
        }
        for v in &mut p {
            *v /= size;
        }
        if n >= RECURRENCE_STEPS / 2 {
            growth += size.ln();
        }
    }
    (growth / (RECURRENCE_STEPS / 2) as f64).exp()
}

/// A disc of another coupling under the `dynamic` share.
fn dynamic<'a>(disc: &FixedDisc<'a>, coupling: f64) -> FixedDisc<'a> {
    FixedDisc {
        coupling,
        share: StaticShare::Dynamic,
        ..*disc
    }
}

/// Whether the `dynamic` share has a solution at a step.
pub(super) fn dynamic_is_solved(disc: &FixedDisc<'_>, step: f64) -> bool {
    let march = march_implicit(&dynamic(disc, disc.coupling), step);
    !matches!(march, Err(MarchError::NoSolution { .. }))
}

/// Largest coupling for which the `dynamic` share has a solution at a step, up to a force of Hertz's peak.
pub(super) fn dynamic_limit(disc: &FixedDisc<'_>, step: f64) -> f64 {
    // Numerov's weight of the newest force
    let allowed = 2.0 / 3.0 + 1.25 * step * step / 12.0;
    bisected(0.0, 1e6, |coupling| {
        let weights = Weights::of(&dynamic(disc, coupling), disc.response, step);
        coupling * weights.values[0] < allowed
    })
}

/// Largest coupling for which the newest samples of the `dynamic` share settle, up to a force of Hertz's peak.
pub(super) fn dynamic_growth_limit(disc: &FixedDisc<'_>, step: f64) -> f64 {
    let grows = |coupling: f64| linear_growth(&dynamic(disc, coupling), 1.5, step) > 1.0;
    bisected(0.0, dynamic_limit(disc, step), |coupling| !grows(coupling))
}

const DYNAMIC: [&str; 4] = [
    "restitution within 1e-3",
    "solved, off by more",
    "solved only because the step is coarse",
    "refused: no solution",
];

/// The `dynamic` share in the plane of coupling and step: regions without a solution, and regions where a coarse step
/// hides that.
fn dynamic_share(paper: &FixedDisc<'_>, effort: Effort) -> Picture {
    let coupling = "static deflection over indentation (coupling)";
    let map = map([0.05, 5.0], coupling, &DYNAMIC, effort);
    let column = |coupling| {
        let disc = dynamic(paper, coupling);
        (disc.clone(), Converged::new(disc).ok())
    };
    let columns: Vec<_> = map.columns().into_iter().map(column).collect();
    let title = "Dynamic share (static part of the deflection taken out)";
    let mut figure = map.picture("march-dynamic", title, |cell, y| {
        let ((disc, exact), step) = (&columns[cell % columns.len()], y * CONTACT_TIME);
        match (exact, dynamic_is_solved(disc, step)) {
            (_, false) => 3,
            (None, true) => 2,
            (Some(exact), true) => usize::from(exact.implicit(step) != MarchOutcome::Accurate),
        }
    });
    let [x, y] = map.plane;
    let line = |limit: fn(&FixedDisc<'_>, f64) -> f64| {
        let steps = y.cells(effort.pick(30, 80)).into_iter();
        let points = steps.map(|y| (limit(paper, y * CONTACT_TIME), y));
        // the part of the curve in the plane
        points.filter(|point| point.0 < x.high).collect()
    };
    let folds = "theory: newest weight times coupling = 2/3, the law folds back";
    figure.line(folds, Style::Heavy, line(dynamic_limit));
    let grows = "theory: a root of the weights beyond 1, the samples grow";
    figure.line(grows, Style::HeavyDashed, line(dynamic_growth_limit));
    let place = (paper.coupling, 1.0 / 137.0);
    figure.add(Layer::star(place, "paper's case, 137 steps"));
    figure.caption = "Without its static part the newest weight of the deflection is negative: the contact law \
        folds back, and beyond a coupling of 2/3 it has no solution. At steps near the memory and beyond \
        the samples alternate and grow from the dashed line on, until they reach the fold. \
        A coarse step can hide that there is no solution; the march refuses with a sentence as soon as the step is \
        halved, which step control does."
        .to_owned();
    figure
}
