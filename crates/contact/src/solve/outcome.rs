//! Outcomes of contacts that are marched from series, where a sweep has rows enough to pay for them.
//!
//! These are contacts with the full memory of the half-space, and those on Jackson and Green's fit with a dashpot.
//!
//! An outcome depends on few numbers: that of a contact that follows the load, between given materials, on tau = a/c1 alone,
//! that on a fixed disc, for a given Poisson's ratio, on theta = r0/c1 and the coupling, and that on the fit, for a given
//! material, on the lag and on sqrt(s^2 - 1), s the velocity over that at which the fit leaves Hertz's law.
//! Over an octave of each it is nearly a polynomial of low degree in their logarithms, so the plane of these is cut into
//! cells of an octave, each with a Chebyshev [`PlaneSeries`] through marches at its nodes.
//! The power that a result has to first order is divided out.
//!
//! A series serves where its certificate meets the tolerance: three times the largest difference from marches between
//! the nodes, and the error of the marches.
//! Cells with a second contact or a refusal at one of their marches have none, nor have those in which the outcome is not
//! smooth, with a new largest peak or a memory as long as the contact: contacts there are marched.
//!
//! The cells that have a series are known before the first row, from a sample of all rows; their content depends on the
//! cell alone.
//! So the numbers of a row depend neither on the order of rows nor on shards, threads and interruptions.

use crate::accuracy::Accuracy;
use crate::collision::Collision;
use crate::disc::radiated::radiated;
use crate::disc::refine::solve_disc;
use crate::disc::{FixedDisc, stability};
use crate::growing::quick::quick;
use crate::growing::solve_growing;
use crate::history::History;
use crate::law::fit::{FITTED, Fit};
use crate::law::yielding::{FlowLaw, Yielding};
use crate::numeric::series::PlaneSeries;
use crate::settings::{Memory, Physics, Scheme, Settings, StaticShare};
use crate::solve::choose::{Chosen, disc_of};
use crate::summary::{Summary, relative};
use crate::waves::cache::Responses;
use crate::waves::punch::GrowingContact;
use crate::waves::response::DiscResponse;
use halfspace::Deflection;
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// A cell: an octave of each free group of contacts of one physics, at given others.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Cell {
    /// Logarithms to the base of two of the free groups, rounded down.
    octaves: [i32; 2],
    physics: Physics,
    /// That of a fixed disc.
    deflection: Deflection,
    /// Poisson's ratio and, of a contact that follows the load, phi; C and e_y of the fit; in bits.
    fixed: [u64; 2],
    /// Tolerance, and that of the loss or zero; in bits.
    tolerances: [u64; 2],
}

/// Where a contact lies: its cell, its free groups, and their place in it between -1 and 1.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CellPlace {
    cell: Cell,
    groups: [f64; 2],
    inside: [f64; 2],
}

/// The series that the contacts of a sweep share, each with its certificate, made at its first use.
#[derive(Debug, Default)]
pub struct Outcomes {
    cells: BTreeMap<Cell, OnceLock<Option<(PlaneSeries<8>, f64)>>>,
}

/// Rows in a cell over the marches of its series from which on it pays: a march at a node, to a tenth of the tolerance, takes as
/// long as two or three rows. `benches/impacts.rs` prints the time of rows with and without series.
const ROWS_PER_MARCH: f64 = 4.0;

/// Tolerance of the marches over that of the rows; `tests/outcome.rs` fails at 0.5.
const FINER_MARCHES: f64 = 0.1;

/// Tolerance from which on the lower degree serves, and the nodes along a group: of it, below, and of the fit.
const COARSE_TOLERANCE: f64 = 1e-5;
const NODES_OF_SERIES: [usize; 3] = [5, 7, 8];

/// Marches between the nodes, of one free group, of two and of the fit; they are equidistributed, with these steps.
const MARCHES_BETWEEN: [usize; 3] = [4, 8, 16];
const STEPS_OF_SEQUENCE: [f64; 2] = [0.754_877_666, 0.569_840_291];

/// Certificate over the largest difference from the marches between the nodes: there are few of them. `tests/outcome.rs`
/// fails at 1, for the series of the fit.
const CAUTION_OF_CERTIFICATE: f64 = 3.0;

/// Allowed error, over the tolerance, of the results without a tolerance: loss, deflection, radiated energy. A choice, not a
/// measurement: they are relative to small numbers.
const ALLOWED_UNASKED: f64 = 10.0;

/// Coefficients left out of a series, over the tolerance. The certificate contains their effect, so that this sets the cost
/// only.
const COEFFICIENTS_LEFT_OUT: f64 = 5e-2;

impl CellPlace {
    /// Of a contact that would be marched with full memory, and its disc's response.
    pub(crate) fn of(
        chosen: &Chosen,
        collision: &Collision,
        settings: &Settings,
        response: &impl DiscResponse,
    ) -> Option<Self> {
        let is_marched = match chosen.memory() {
            Memory::None | Memory::FirstOrder | Memory::Dashpot => false,
            Memory::Full => true,
        };
        let is_refined = settings.step_s.is_none() && settings.scheme == Scheme::Implicit;
        if !is_marched || !is_refined {
            return None;
        }
        let (nu, memory) = (collision.target_poisson_ratio, chosen.regime.memory);
        let physics = chosen.regime.physics;
        let (fixed, groups) = match physics {
            Physics::Disc(StaticShare::Full | StaticShare::Dynamic) => {
                let disc = disc_of(settings, collision, response);
                ([nu, 0.0], [memory / response.disc().memory, disc.coupling])
            }
            Physics::Growing | Physics::Yielding => {
                let fixed = [nu, collision.target_share()];
                (fixed, [memory / response.punch_memory(), 1.0])
            }
        };
        Some(Self::new(settings, physics, fixed, groups))
    }

    /// Of a contact on Jackson and Green's fit with a dashpot.
    pub(crate) fn of_fit(
        chosen: &Chosen,
        yielding: &Yielding,
        settings: &Settings,
    ) -> Option<Self> {
        let fit = match yielding.law {
            FlowLaw::Fit(fit) => fit,
            // in closed form
            FlowLaw::Thornton | FlowLaw::Recovery => return None,
        };
        match chosen.memory() {
            Memory::Dashpot => {}
            Memory::None | Memory::FirstOrder | Memory::Full => return None,
        }
        let groups = [(yielding.edge().powi(-5) - 1.0).sqrt(), chosen.regime.lag];
        let fixed = [fit.shape, fit.strain];
        Some(Self::new(settings, Physics::Yielding, fixed, groups))
    }

    fn new(settings: &Settings, physics: Physics, fixed: [f64; 2], groups: [f64; 2]) -> Self {
        let octaves = groups.map(octave);
        let tolerances = [settings.tolerance, settings.loss_tolerance.unwrap_or(0.0)];
        let cell = Cell {
            octaves: octaves.map(|(octave, _)| octave),
            physics,
            deflection: settings.deflection,
            fixed: fixed.map(f64::to_bits),
            tolerances: tolerances.map(f64::to_bits),
        };
        Self {
            cell,
            groups,
            inside: octaves.map(|(_, part)| 2.0 * part.log2() - 1.0),
        }
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
    pub(crate) fn of(rows: usize, sample: impl Iterator<Item = Option<CellPlace>>) -> Self {
        let (mut counts, mut sampled) = (BTreeMap::new(), 0.0);
        for place in sample {
            sampled += 1.0;
            if let Some(place) = place {
                *counts.entry(place.cell).or_insert(0.0) += 1.0;
            }
        }
        counts.retain(|cell: &Cell, count| {
            let ([across, along], probes) = cell.nodes();
            *count * rows as f64 / sampled >= ROWS_PER_MARCH * (across * along + probes) as f64
        });
        let paying = counts.into_keys();
        Self {
            cells: paying.map(|cell| (cell, OnceLock::new())).collect(),
        }
    }

    /// The outcome at a place, its radiated over its kinetic energy, and its error; none if it has to be marched.
    pub(crate) fn at(
        &self,
        place: &CellPlace,
        responses: &impl Responses,
    ) -> Option<(Summary, f64, f64)> {
        let series = self.cells.get(&place.cell)?;
        let made = || place.cell.contract(responses);
        let (series, error) = series.get_or_init(made).as_ref()?;
        let (summary, radiated) = outcome(&series.at(place.inside), place.groups);
        Some((summary, radiated, *error))
    }
}

impl Cell {
    /// Nodes along each group, and marches between them.
    fn nodes(&self) -> ([usize; 2], usize) {
        let fine = usize::from(f64::from_bits(self.tolerances[0]) < COARSE_TOLERANCE);
        match self.physics {
            Physics::Growing => ([NODES_OF_SERIES[fine], 1], MARCHES_BETWEEN[0]),
            Physics::Disc(_) => ([NODES_OF_SERIES[fine]; 2], MARCHES_BETWEEN[1]),
            Physics::Yielding => ([NODES_OF_SERIES[2]; 2], MARCHES_BETWEEN[2]),
        }
    }

    /// The groups at a place in it.
    fn groups(&self, inside: [f64; 2]) -> [f64; 2] {
        let group = |k: usize| (f64::from(self.octaves[k]) + 0.5 * (inside[k] + 1.0)).exp2();
        match self.physics {
            Physics::Growing => [group(0), 1.0],
            Physics::Disc(_) | Physics::Yielding => [group(0), group(1)],
        }
    }

    /// The series with its certificate, where that meets the tolerance.
    fn contract(&self, responses: &impl Responses) -> Option<(PlaneSeries<8>, f64)> {
        let [tolerance, of_loss] = self.tolerances.map(f64::from_bits);
        let of_loss = Some(of_loss).filter(|&asked| asked > 0.0);
        let asked = Accuracy::of_contact(
            FINER_MARCHES * tolerance,
            of_loss.map(|asked| FINER_MARCHES * asked),
        );
        let (mut history, mut left) = (History::default(), 0.0_f64);
        let mut march = |inside: [f64; 2]| {
            let groups = self.groups(inside);
            let (summary, radiated, error) = self.march(groups, asked, responses, &mut history)?;
            left = left.max(error);
            Some((summary, radiated, groups))
        };
        let values = |inside: [f64; 2]| {
            let (summary, radiated, groups) = march(inside)?;
            Some(lanes(&summary, radiated, groups))
        };
        let (nodes, probes) = self.nodes();
        let series = PlaneSeries::through(nodes, COEFFICIENTS_LEFT_OUT * tolerance, values)?;
        let mut missed = 0.0_f64;
        for k in 1..=probes {
            let inside = STEPS_OF_SEQUENCE.map(|step| 2.0 * (k as f64 * step).fract() - 1.0);
            let (exact, work, groups) = march(inside)?;
            let (found, radiated) = outcome(&series.at(inside), groups);
            let late = (found.peak_force_time - exact.peak_force_time).abs() / exact.contact_time;
            let beside = exact
                .loss_distance(&found)
                .max(relative(exact.peak_deflection, found.peak_deflection))
                .max(relative(work, radiated));
            let loss = of_loss.map_or(0.0, |asked| exact.loss_distance(&found) / asked * tolerance);
            let all = [exact.distance(&found), late, beside / ALLOWED_UNASKED, loss];
            missed = all.into_iter().fold(missed, f64::max);
        }
        let error = CAUTION_OF_CERTIFICATE * missed + left;
        (error <= tolerance).then_some((series, error))
    }

    /// The outcome at some groups by a march, as of [`Outcomes::at`]; nothing where the contact is refused or is not one.
    fn march<S: Responses>(
        &self,
        [first, second]: [f64; 2],
        asked: Accuracy,
        responses: &S,
        history: &mut History,
    ) -> Option<(Summary, f64, f64)> {
        let fixed = self.fixed.map(f64::from_bits);
        let share = match self.physics {
            Physics::Growing => {
                let waves = responses.waves(fixed[0]).ok()?;
                let contact = GrowingContact {
                    waves: &waves,
                    target_share: fixed[1],
                    wave_time: first,
                };
                let solved = solve_growing(&contact, &asked).ok()?;
                let summary = solved.summary;
                return Some((summary, summary.loss, solved.estimates.contact()));
            }
            Physics::Yielding => {
                let depth = (1.0 + first * first).powf(-0.4);
                let [shape, strain] = fixed;
                let yielding = Yielding {
                    law: FlowLaw::Fit(Fit::new(depth / FITTED, shape, strain)),
                    yield_pressure_pa: f64::NAN,
                    depth,
                };
                let (summary, flow) = quick(&yielding, second)?;
                return Some((summary, flow.radiated, 0.0));
            }
            Physics::Disc(share) => share,
        };
        let of_mean = responses.disc(fixed[0], Deflection::Mean).ok()?;
        let response = responses.disc(fixed[0], self.deflection).ok()?;
        let impact = FixedDisc {
            response: &*response,
            coupling: second,
            wave_time: first,
            share,
        };
        stability::check(&impact, history).ok()?;
        let found = solve_disc(history, &impact, None, asked).ok()?;
        let summary = found.summary;
        let radiated = || radiated(&impact, &*of_mean, history, summary.contact_time);
        (summary.contacts == 1).then(|| (summary, radiated(), found.error))
    }
}

/// Results of an outcome as a series holds them: without the power of the groups that they have to first order.
fn lanes(summary: &Summary, radiated: f64, [time, coupling]: [f64; 2]) -> [f64; 8] {
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
fn outcome(lanes: &[f64; 8], [time, coupling]: [f64; 2]) -> (Summary, f64) {
    let first = time * coupling;
    let restitution = 1.0 - first * lanes[3];
    let summary = Summary {
        peak_force: lanes[0],
        peak_force_time: lanes[1],
        contact_time: lanes[2],
        loss: first * lanes[3] * (1.0 + restitution),
        peak_displacement: lanes[4],
        peak_deflection: lanes[5],
        ..Summary::rebound(restitution)
    };
    (summary, first * lanes[6])
}
