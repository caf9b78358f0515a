//! Outcomes of contacts with the full memory of the half-space from series, where a sweep has rows enough to pay for them.
//!
//! An outcome depends on few numbers: that of a contact that follows the load, between given materials, on tau = a/c1 alone,
//! that on a fixed disc, for a given Poisson's ratio, on theta = r0/c1 and the coupling.
//! Over an octave of each it is nearly a polynomial of low degree in their logarithms, so the plane of these is cut into
//! cells of an octave, each with a Chebyshev [`Series`] through marches at its nodes.
//! The power that a result has to first order is divided out.
//!
//! A series serves where its certificate meets the tolerance: three times the largest difference from marches between
//! the nodes, and the error of the marches.
//! Cells with a second contact or a refusal at one of their marches have none, nor have those in which the outcome is not
//! smooth, with a new largest peak or a memory as long as the contact: contacts there are marched.
//!
//! Which cells have a series is known before the first row, from a sample of all rows; what they hold depends on the cell
//! alone.
//! So the numbers of a row depend neither on the order of rows nor on shards, threads and interruptions.

pub(crate) mod series;

use crate::collision::Collision;
use crate::disc::refine::{Accuracy, Workspace, solve_disc};
use crate::disc::response::DiscResponse;
use crate::disc::{FixedDisc, stability};
use crate::energy;
use crate::growing::solve_growing;
use crate::growing::waves::GrowingContact;
use crate::model::choose::{Plan, disc_radius_m};
use crate::model::{Rung, Scheme, Settings, StaticShare};
use crate::outcome::series::{LANES, Series};
use crate::responses::Responses;
use crate::summary::{EndOfContact, Summary, relative};
use crate::units::INVERSE_MASS;
use halfspace::Deflection;
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// A cell: an octave of each free group of a family of contacts, at given others.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Cell {
    /// Logarithms to the base of two of tau or theta, and of the coupling, rounded down.
    octaves: [i32; 2],
    /// Poisson's ratio and, of a contact that follows the load, phi; in bits.
    fixed: [u64; 2],
    /// Of a fixed disc: whether its share is the dynamic one, and whether its deflection is the mean.
    disc: Option<[bool; 2]>,
    /// Tolerance, and that of the loss or zero; in bits.
    tolerances: [u64; 2],
}

/// Where a contact lies: its cell, its free groups, and their place in it between -1 and 1.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place {
    cell: Cell,
    groups: [f64; 2],
    inside: [f64; 2],
}

/// The series that the contacts of a sweep share, each with its certificate, made when it is first asked for.
#[derive(Debug, Default)]
pub struct Outcomes {
    cells: BTreeMap<Cell, OnceLock<Option<(Series, f64)>>>,
}

/// Summary of a contact, its radiated over its kinetic energy, and the error of the summary.
pub(crate) type Outcome = (Summary, f64, f64);

/// Rows in a cell over the marches of its series from which on it pays: one at a node takes as long as two or three rows.
const PAYS: f64 = 4.0;

/// Tolerance of the marches over that of the rows.
const FINER: f64 = 0.1;

/// Tolerance from which on the lower degree serves, and the nodes along a group: of it, and below.
const COARSE: f64 = 1e-5;
const NODES: [usize; 2] = [5, 7];

/// Marches between the nodes, of one free group and of two; they are equidistributed, with these steps.
const PROBES: [usize; 2] = [4, 8];
const STEPS: [f64; 2] = [0.754_877_666, 0.569_840_291];

/// Times their largest difference that the certificate has.
const CAUTION: f64 = 3.0;

/// Times the tolerance by which results may differ on which none is asked: loss, deflection, radiated energy.
const BESIDE: f64 = 10.0;

/// Part of the tolerance below which a coefficient is left out.
const LEFT_OUT: f64 = 1e-3;

impl Place {
    /// Of a contact that would be marched with full memory, and its disc's response.
    pub(crate) fn of(
        plan: &Plan,
        collision: &Collision,
        settings: &Settings,
        response: &impl DiscResponse,
    ) -> Option<Self> {
        let (rung, on_disc) = plan.model.row();
        let is_refined = settings.step_s.is_none() && settings.scheme == Scheme::Implicit;
        if rung != Rung::FullMemory || !is_refined {
            return None;
        }
        let nu = collision.target_poisson_ratio.to_bits();
        let memory = plan.groups.memory;
        let (groups, fixed, disc) = if on_disc {
            let dynamic = settings.static_share == StaticShare::Dynamic;
            let mean = settings.deflection == Deflection::Mean;
            let coupling = if dynamic {
                let radius_m = disc_radius_m(settings, collision);
                let compliance = response.static_compliance();
                collision.disc_groups(compliance, radius_m).0
            } else {
                plan.groups.coupling
            };
            let groups = [memory / response.memory(), coupling];
            (groups, [nu, 0], Some([dynamic, mean]))
        } else {
            let phi = collision.target_share().to_bits();
            ([memory / response.punch_memory(), 1.0], [nu, phi], None)
        };
        let tolerances = [settings.tolerance, settings.loss_tolerance.unwrap_or(0.0)];
        let octaves = groups.map(octave);
        let cell = Cell {
            octaves: octaves.map(|(octave, _)| octave),
            fixed,
            disc,
            tolerances: tolerances.map(f64::to_bits),
        };
        Some(Self {
            cell,
            groups,
            inside: octaves.map(|(_, part)| 2.0 * part.log2() - 1.0),
        })
    }
}

/// The octave of a positive number, and the number over its beginning: exponent and significand.
fn octave(number: f64) -> (i32, f64) {
    const BITS: u32 = f64::MANTISSA_DIGITS - 1;
    const ONE: u64 = 1.0_f64.to_bits();
    let bits = number.to_bits();
    let significand = bits & ((1 << BITS) - 1) | ONE;
    let octave = (bits >> BITS) as i32 - (ONE >> BITS) as i32;
    (octave, f64::from_bits(significand))
}

impl Outcomes {
    /// Those that pay for so many rows, of which these are a sample; rows that are not marched with full memory have no
    /// place.
    pub(crate) fn of(rows: usize, sample: impl Iterator<Item = Option<Place>>) -> Self {
        let mut counts = BTreeMap::new();
        let mut sampled = 0.0;
        for place in sample {
            sampled += 1.0;
            if let Some(place) = place {
                *counts.entry(place.cell).or_insert(0.0) += 1.0;
            }
        }
        let pays =
            |cell: &Cell, count: f64| count * rows as f64 / sampled >= PAYS * cell.marches() as f64;
        let paying = counts
            .into_iter()
            .filter(|(cell, count)| pays(cell, *count));
        Self {
            cells: paying.map(|(cell, _)| (cell, OnceLock::new())).collect(),
        }
    }

    /// The outcome at a place; nothing where it has to be marched.
    pub(crate) fn at(&self, place: &Place, responses: &impl Responses) -> Option<Outcome> {
        let series = self.cells.get(&place.cell)?;
        let made = || place.cell.contract(responses);
        let (series, error) = series.get_or_init(made).as_ref()?;
        let (summary, radiated) = outcome(&series.at(place.inside), place.groups);
        Some((summary, radiated, *error))
    }
}

impl Cell {
    /// Nodes along each group.
    fn nodes(&self) -> [usize; 2] {
        let nodes = NODES[usize::from(f64::from_bits(self.tolerances[0]) < COARSE)];
        [nodes, if self.disc.is_some() { nodes } else { 1 }]
    }

    fn probes(&self) -> usize {
        PROBES[usize::from(self.disc.is_some())]
    }

    /// Marches of a contraction.
    fn marches(&self) -> usize {
        self.nodes().iter().product::<usize>() + self.probes()
    }

    /// The groups at a place in it.
    fn groups(&self, inside: [f64; 2]) -> [f64; 2] {
        let group = |k: usize| (f64::from(self.octaves[k]) + 0.5 * (inside[k] + 1.0)).exp2();
        [group(0), self.disc.map_or(1.0, |_| group(1))]
    }

    /// The series with its certificate, where that meets the tolerance.
    fn contract(&self, responses: &impl Responses) -> Option<(Series, f64)> {
        let [tolerance, of_loss] = self.tolerances.map(f64::from_bits);
        let of_loss = Some(of_loss).filter(|&asked| asked > 0.0);
        let asked = Accuracy::of_contact(FINER * tolerance, of_loss.map(|asked| FINER * asked));
        let (mut workspace, mut left) = (Workspace::default(), 0.0_f64);
        let mut march = |inside: [f64; 2]| {
            let groups = self.groups(inside);
            let (summary, radiated, error) =
                self.march(groups, asked, responses, &mut workspace)?;
            left = left.max(error);
            Some((summary, radiated, groups))
        };
        let values = |inside: [f64; 2]| {
            let (summary, radiated, groups) = march(inside)?;
            Some(lanes(&summary, radiated, groups))
        };
        let series = Series::through(self.nodes(), LEFT_OUT * tolerance, values)?;
        let mut missed = 0.0_f64;
        for k in 1..=self.probes() {
            let inside = STEPS.map(|step| 2.0 * (k as f64 * step).fract() - 1.0);
            let (exact, work, groups) = march(inside)?;
            let (found, radiated) = outcome(&series.at(inside), groups);
            let late = (found.peak_force_time - exact.peak_force_time).abs() / exact.contact_time;
            let beside = exact
                .loss_distance(&found)
                .max(relative(exact.peak_deflection, found.peak_deflection))
                .max(relative(work, radiated));
            let loss = of_loss.map_or(0.0, |asked| exact.loss_distance(&found) / asked * tolerance);
            missed = [exact.distance(&found), late, beside / BESIDE, loss]
                .into_iter()
                .fold(missed, f64::max);
        }
        let error = CAUTION * missed + left;
        (error <= tolerance).then_some((series, error))
    }

    /// The outcome at some groups by a march; nothing where the contact is refused or is not one.
    fn march<S: Responses>(
        &self,
        [time, coupling]: [f64; 2],
        asked: Accuracy,
        responses: &S,
        workspace: &mut Workspace,
    ) -> Option<Outcome> {
        let [nu, target_share] = self.fixed.map(f64::from_bits);
        let Some([dynamic, mean]) = self.disc else {
            let waves = responses.waves(nu).ok()?;
            let contact = GrowingContact {
                waves: &waves,
                target_share,
                wave_time: time,
            };
            let solved = solve_growing(&contact, &asked).ok()?;
            let summary = *solved.summary();
            return Some((summary, summary.loss, solved.estimates().contact()));
        };
        let of_mean = responses.disc(nu, Deflection::Mean).ok()?;
        let response = if mean {
            of_mean.clone()
        } else {
            responses.disc(nu, Deflection::Centre).ok()?
        };
        let impact = FixedDisc {
            response: &*response,
            coupling,
            wave_time: time,
            share: if dynamic {
                StaticShare::Dynamic
            } else {
                StaticShare::Full
            },
        };
        stability::check(&impact, workspace).ok()?;
        let found = solve_disc(workspace, &impact, None, asked).ok()?;
        let summary = found.summary;
        let radiated =
            || energy::radiated(&impact, &*of_mean, &workspace.history, summary.contact_time);
        (summary.contacts == 1).then(|| (summary, radiated(), found.error))
    }
}

/// What a series has of an outcome: without the power of the groups that it has to first order.
fn lanes(summary: &Summary, radiated: f64, [time, coupling]: [f64; 2]) -> [f64; LANES] {
    let first = time * coupling;
    [
        summary.peak_force,
        summary.peak_force_time,
        summary.contact_time,
        summary.loss / (1.0 + summary.restitution) / first,
        summary.peak_displacement,
        summary.peak_deflection,
        radiated / first,
        0.0,
    ]
}

/// The way back; all other results follow from these.
fn outcome(lanes: &[f64; LANES], [time, coupling]: [f64; 2]) -> (Summary, f64) {
    let &[
        peak_force,
        peak_force_time,
        contact_time,
        slower,
        peak_displacement,
        ..,
    ] = lanes;
    let first = time * coupling;
    let restitution = 1.0 - first * slower;
    let summary = Summary {
        peak_force,
        peak_force_time,
        contact_time,
        restitution,
        loss: first * slower * (1.0 + restitution),
        peak_displacement,
        peak_deflection: lanes[5],
        impulse: (1.0 + restitution) / INVERSE_MASS,
        contacts: 1,
        end: EndOfContact::Smooth,
    };
    (summary, first * lanes[6])
}
