//! Which model the paper's family needs: a fixed disc whose whole deflection is added to Hertz's indentation.

use super::models::{TOLERANCES, memory_of_change};
use crate::StudyError;
use crate::effort::Effort;
use crate::marching::Results;
use crate::picture::Picture;
use crate::record::Error;
use crate::scenes::{ROD_RADIUS_M, TABLE_1_PA, paper};
use contact::law::hertz::CONTACT_TIME;
use contact::law::quasi_static::{quasi_static, quasi_static_radiation};
use contact::law::radiation::{LARGEST_LAG, LOSS};
use contact::{Accuracy, ExactDisc, MarchError, StaticShare, march_implicit, refine};
use contact::{Family, Groups, Rung};
use figure::{Axis, Interval, Style};
use halfspace::{Deflection, Medium, SurfaceResponse};

/// Accuracy of the march that they are compared with.
const ACCURACY: f64 = 1e-5;

/// Errors of the models without memory, largest over peak force, contact time, restitution and peak
/// displacement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiscErrors {
    /// Two springs in series.
    pub springs: f64,
    /// Two springs with the first-order radiated loss.
    pub radiation: f64,
}

/// Errors against the implicit march.
///
/// # Errors
/// Those of the march.
pub fn disc_errors(disc: &ExactDisc<'_>) -> Result<DiscErrors, MarchError> {
    let springs = quasi_static(disc.coupling);
    let accuracy = Accuracy::of_contact(ACCURACY, None);
    let march = |step| march_implicit(disc, step);
    let found = refine(
        march,
        springs.contact_time / accuracy.first_steps(),
        accuracy,
    )?;
    let exact = Results::from(&found.summary);
    let of = |lag: f64| {
        let found = Results::from(&quasi_static_radiation(disc.coupling, lag));
        Error::of(&found.errors(&exact)).max
    };
    let lag = groups(disc).lag;
    Ok(DiscErrors {
        springs: of(0.0),
        // beyond it the program refuses the first-order law
        radiation: if springs.loss_per_lag * lag <= LOSS * LARGEST_LAG {
            of(lag)
        } else {
            f64::INFINITY
        },
    })
}

/// What `auto` chooses for a disc at a tolerance.
#[must_use]
pub fn disc_chosen(disc: &ExactDisc<'_>, tolerance: f64) -> Rung {
    groups(disc)
        .choose(&Accuracy::of_contact(tolerance, None))
        .rung
}

fn groups(disc: &ExactDisc<'_>) -> Groups {
    Groups {
        family: Family::Full,
        coupling: disc.coupling,
        lag: disc.coupling * disc.wave_time * disc.response.relaxation_time(),
        memory: disc.memory(),
    }
}

/// The paper's disc with other groups.
#[must_use]
pub fn disc_at<'a>(like: &ExactDisc<'a>, coupling: f64, memory: f64) -> ExactDisc<'a> {
    ExactDisc {
        coupling,
        wave_time: memory * CONTACT_TIME / like.response.memory(),
        share: StaticShare::Full,
        ..*like
    }
}

/// A picture a tolerance.
pub(crate) fn figures(effort: Effort) -> Result<Vec<Picture>, StudyError> {
    let response = SurfaceResponse::new(&Medium::new(0.3)?, Deflection::Centre);
    let paper = paper(TABLE_1_PA)?.fixed_disc(&response, ROD_RADIUS_M, StaticShare::Full);
    let x = Interval::logarithmic(1e-3, 10.0);
    let y = Interval::logarithmic(1e-4, 1.0);
    let shape = effort.pick([14, 12], [40, 40]);
    let mut errors = Vec::new();
    for &memory in &y.cells(shape[1]) {
        for &coupling in &x.cells(shape[0]) {
            errors.push(disc_errors(&disc_at(&paper, coupling, memory))?);
        }
    }
    let boundary = |coupling: f64, tolerance: f64, leaves: Rung| {
        memory_of_change(1e-12, leaves, |memory| {
            disc_chosen(&disc_at(&paper, coupling, memory), tolerance)
        })
    };
    let mut figures = Vec::new();
    for (name, tolerance) in ["models-disc-1e-2", "models-disc-1e-3", "models-disc-1e-4"]
        .into_iter()
        .zip(TOLERANCES)
    {
        let mut figure = Picture::new(
            name,
            &format!("Cheapest model of the paper's fixed disc that meets {tolerance:.0e}"),
            Axis::over(x, "static deflection over indentation (coupling)"),
            Axis::over(y, "memory over contact time"),
        );
        let mut cells = errors.iter();
        let classes = ["two springs", "two springs and first-order loss", "wave"];
        figure.map([x, y], shape, &classes, |_, _| match cells.next() {
            Some(e) if e.springs <= tolerance => 0,
            Some(e) if e.radiation <= tolerance => 1,
            Some(_) | None => 2,
        });
        for (label, rung, style) in [
            ("auto leaves two springs", Rung::QuasiStatic, Style::Heavy),
            (
                "auto leaves the first-order loss",
                Rung::Radiation,
                Style::HeavyDashed,
            ),
        ] {
            let line = x
                .cells(60)
                .into_iter()
                .map(|coupling| (coupling, boundary(coupling, tolerance, rung)));
            figure.curve(label, style, line.collect());
        }
        // half of the first-order loss is the error of the restitution of two springs
        let theory = x.cells(60).into_iter().map(|coupling| {
            let lag = 2.0 * tolerance / quasi_static(coupling).loss_per_lag;
            let wave_time = lag / (coupling * response.relaxation_time());
            (coupling, wave_time * response.memory() / CONTACT_TIME)
        });
        figure.curve(
            &format!("theory: first-order loss of {:.0e}", 2.0 * tolerance),
            Style::Dotted,
            theory.collect(),
        );
        let place = (paper.coupling, paper.memory() / CONTACT_TIME);
        figure.point(place, "paper's case");
        figure.caption = format!(
            "With the full share the half-space is a second spring; the waves are seen by their radiated loss, first \
             order in the memory, and then by their shape. Regions are computed against the implicit march; the lines \
             are where `auto` changes model at a tolerance of {tolerance:.0e}."
        );
        figures.push(figure);
    }
    Ok(figures)
}
