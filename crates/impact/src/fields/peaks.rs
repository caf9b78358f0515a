//! Largest values of the outputs over continuous time, found between their samples.
//!
//! Away from wave fronts a sampled output is smooth, and the polynomial through the samples next to its crest has the peak. Where a
//! front of the first or last instants of a contact passes, an output may have a needle far narrower than a step. The times of these
//! fronts are known beforehand. There, and wherever polynomials through the samples differ, the outputs are computed at further
//! instants, until they agree.
//!
//! Under a contact whose radius follows the load, velocities and stresses of a surface point have no finite peak: the edge of the
//! contact is faster than waves in its first and last instants, and where it becomes slower its fronts meet in a fold, toward which
//! the velocity grows as the logarithm of the time. It is shown at a fixed part of the time by which the fold is ahead of the front
//! from the centre: the same for any step, with an error that covers its fall over a sixtieth of a step.
//!
//! The error of a peak is that of the samples next to it, or by how much another sample or a front may be higher. A table does not
//! resolve narrow fronts: there no further instants are computed, and the error covers what the output may reach.
//!
//! Theory: `docs/theory.md` (T60, T75).

use crate::convolution::{Convolution, Point, Trace};
use crate::error::ImpactError;
use crate::excitation::{Excitation, PressureRadius};
use crate::sampled::projection::largest;

/// The largest value of an output over continuous time.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Peak {
    /// With its sign.
    pub value: f64,
    /// When it is reached, in s.
    pub time_s: f64,
    /// Estimated absolute error.
    pub error: f64,
}

/// Rounds of further instants, and instants, at most: the surroundings of a crest are halved in each. Fewer leave larger errors, more
/// take time at points where an output has many crests. No test fails.
const MOST_ROUNDS: usize = 24;
const MOST_INSTANTS: usize = 48;

/// Part of the error of an output up to which its crest may be uncertain without further instants: smaller takes time, larger widens
/// the estimate, which includes the uncertainty. No test fails.
const ENOUGH: f64 = 0.25;

/// Part of the largest sample below which a difference is rounding.
const ROUNDING: f64 = 1e-10;

/// Uncertainty of a crest over the difference of neighbouring parabolas within a gap: a corner between samples is not seen by
/// polynomials through them. `peaks_of_records_are_those_of_a_finer_output` fails at 0.
const ROUGH: f64 = 0.2;

/// How much an uncertain crest may be larger than it seems, in its uncertainty: it is looked at if it may be the highest. No test
/// fails.
const MAY_RISE: f64 = 2.0;

/// Instants around a fold, in times of it. The velocity of the surface grows there as a logarithm, so that the inner ones are a
/// convention: at 0.04 a velocity is a fifth larger.
const BESIDE_FOLD: [f64; 4] = [-0.64, -0.16, 0.16, 0.64];

/// The same of the front from an edge.
const AT_EDGE: [f64; 4] = [0.0; 4];

/// Time in which the front of a small contact passes, over that in which it crosses the depth of a point; shear waves beyond the
/// critical angle are sharp at any depth. At 0 peaks on the axis take ten times as long (`hertzlamb sweep scenes/sweep-probes.toml`).
const IN_DEPTH: f64 = 0.3;

/// Instants at fronts, at most, of those that may be highest: a record with many jumps has hundreds.
const MOST_AT_FRONTS: usize = 24;

/// Part of a step from a crest over which an output may fall: that much the error of a peak includes. Samples of an output thirty
/// times finer are not farther from it. `peaks_of_growing_contacts_are_those_of_a_finer_output` fails at 0.
const SEEN: f64 = 1.0 / 60.0;

/// The time that the fronts from the edges of a fixed disc take to pass, over that which a Rayleigh wave takes over its radius, and
/// that of a kink of a growing contact: a front narrower than a step is looked at. No test fails.
const WIDTH_OF_EDGE: f64 = 0.1;
const WIDTH_OF_KINK: f64 = 0.01;

/// The peaks of outputs that were sampled at these times, at a point.
pub(crate) fn peaks(
    convolution: &Convolution<'_>,
    point: &Point<'_>,
    time_s: &[f64],
    traces: &[Trace],
) -> Result<Vec<Peak>, ImpactError> {
    let mut history = History {
        step_s: convolution.grid.step_s,
        time_s: time_s.to_vec(),
        values: traces.iter().map(|trace| trace.samples.clone()).collect(),
        errors: traces.iter().map(|trace| trace.error).collect(),
        own_errors: traces.iter().map(widened).collect(),
        hidden: vec![0.0; traces.len()],
        folds: Vec::new(),
    };
    let mut left = MOST_INSTANTS;
    let fronts = fronts(convolution.grid.excitation, point.place_m());
    let mut wanted_s = match point.shortest_s() {
        None => history.at_fronts(&fronts),
        Some(shortest_s) => {
            history.hide(&fronts, shortest_s);
            Vec::new()
        }
    };
    let is_narrow = |front: &Front| front.is_fold && front.width_s < history.step_s;
    history.folds = fronts.into_iter().filter(is_narrow).collect();
    // through a low pass the samples show all there is
    let rounds = match convolution.grid.low_pass_hz {
        Some(_) => 0,
        None => MOST_ROUNDS,
    };
    for _ in 0..rounds {
        for j in 0..traces.len() {
            history.ask(j, &mut wanted_s);
        }
        wanted_s.sort_by(f64::total_cmp);
        wanted_s.dedup_by(|later, earlier| *later - *earlier < 1e-6 * history.step_s);
        wanted_s.retain(|&at_s| history.is_new(at_s));
        wanted_s.truncate(left);
        if wanted_s.is_empty() {
            break;
        }
        left -= wanted_s.len();
        for at_s in wanted_s.drain(..) {
            history.insert(at_s, &convolution.at_instant(point, at_s)?);
        }
    }
    Ok((0..traces.len()).map(|j| history.peak(j)).collect())
}

/// A front that may be narrower than a step.
struct Front {
    /// When it passes, in s.
    at_s: f64,
    /// In how many s.
    width_s: f64,
    /// Whether it is a fold, where an output may grow without limit.
    is_fold: bool,
    /// Instants in s that show it.
    instants_s: [f64; 4],
}

/// The fronts that pass a point in m.
fn fronts(excitation: &Excitation, [r_m, z_m]: [f64; 2]) -> Vec<Front> {
    let (units, speeds) = (excitation.units(), excitation.speeds());
    let crossing_s = units.disc_radius_m / speeds.rayleigh;
    let kappa = speeds.s / speeds.p;
    let critical = kappa / (1.0 - kappa * kappa).sqrt();
    let around = |at_s: f64, width_s: f64, parts: [f64; 4]| Front {
        at_s,
        width_s,
        is_fold: parts == BESIDE_FOLD,
        instants_s: parts.map(|part| at_s + part * width_s),
    };
    let of_edges = |event_s: f64, radius_m: f64, width_s: f64| {
        let distances_m = [(r_m - radius_m).abs(), r_m, r_m + radius_m];
        let arrivals = distances_m.map(|distance_m| speeds.arrivals_s(distance_m, z_m, 0.0));
        let arrivals = arrivals.into_iter().flatten();
        arrivals.map(move |t| around(event_s + t, width_s, AT_EDGE))
    };
    let ends_s = excitation.contacts_s().iter().flatten().copied();
    let kinks_s = excitation.kinks_s().iter().copied();
    let mut found: Vec<Front> = match excitation.radius() {
        PressureRadius::Fixed(radius_m) => {
            let jumps_s = excitation.jumps().iter().map(|jump| jump.time_s);
            let events_s = ends_s.chain(kinks_s).chain(jumps_s);
            let width_s = WIDTH_OF_EDGE * crossing_s;
            let of = |event_s| of_edges(event_s, radius_m, width_s);
            events_s.flat_map(of).collect()
        }
        PressureRadius::Following { largest_m, .. } => {
            let of_ends = ends_s.flat_map(|end_s| {
                let arrivals = speeds.arrivals_s(r_m, z_m, 0.0);
                let waves = [speeds.p, speeds.s, speeds.rayleigh];
                let of = move |(wave, (t, speed)): (usize, (f64, f64))| {
                    let fold_s = excitation.fold_s(end_s, speed);
                    let sign = if end_s > 0.5 * excitation.end_s() {
                        1.0
                    } else {
                        -1.0
                    };
                    let front = around(end_s + t + sign * fold_s, fold_s, BESIDE_FOLD);
                    // shear waves beyond the critical angle are sharp at any depth
                    let is_sharp = wave == 1 && r_m > critical * z_m;
                    let depth_m = if is_sharp { 0.0 } else { z_m };
                    let width_s = fold_s.max(IN_DEPTH * depth_m / speed);
                    Front { width_s, ..front }
                };
                arrivals.into_iter().zip(waves).enumerate().map(of)
            });
            let of_kinks = kinks_s.flat_map(|kink_s| {
                let [pressed, _] = excitation.pressures(kink_s);
                let radius_m = pressed.square.sqrt() * largest_m;
                of_edges(kink_s, radius_m, WIDTH_OF_KINK * crossing_s)
            });
            of_ends.chain(of_kinks).collect()
        }
    };
    found.retain(|front| front.at_s.is_finite() && front.width_s > 0.0);
    found
}

/// Outputs at samples and at further instants, ascending in time.
struct History {
    step_s: f64,
    time_s: Vec<f64>,
    /// Of each output, with the error of all values and that of each.
    values: Vec<Vec<f64>>,
    errors: Vec<f64>,
    own_errors: Vec<Vec<f64>>,
    /// The largest magnitude that each may have at fronts which its kernels do not resolve.
    hidden: Vec<f64>,
    /// Those narrower than a step, which are not followed further than by their instants.
    folds: Vec<Front>,
}

/// The error of each sample: the largest of those next to it, since the bounds on some errors change their sign.
fn widened(trace: &Trace) -> Vec<f64> {
    /// Samples to both sides, in powers of two.
    const BESIDE: [usize; 3] = [1, 2, 4];
    let count = trace.samples.len();
    let mut found: Vec<f64> = (0..count).map(|i| trace.error_of(i)).collect();
    for shift in BESIDE {
        let of = |i: usize| {
            let sides = [i.checked_sub(shift), Some(i + shift)]
                .into_iter()
                .flatten();
            let sides = sides.filter_map(|k| found.get(k));
            sides.fold(found[i], |most, own| most.max(*own))
        };
        found = (0..count).map(of).collect();
    }
    found
}

/// A local crest of an output.
#[derive(Clone, Copy, Default)]
struct Crest {
    /// Its error is the uncertainty of the place of the crest alone.
    peak: Peak,
    /// Error of the values next to it.
    of_values: f64,
    /// Where the output should be known next, in s.
    next_s: f64,
}

impl History {
    /// The instants at fronts where an output may have a needle above its largest sample.
    fn at_fronts(&self, fronts: &[Front]) -> Vec<f64> {
        let largest: Vec<f64> = self.values.iter().map(|own| largest(own)).collect();
        let mut found: Vec<(f64, [f64; 4])> = Vec::new();
        for front in fronts {
            let most = |j: usize| self.most_at(j, front, 0.0).unwrap_or(0.0);
            let over = |j: usize| most(j) / largest[j].max(f64::MIN_POSITIVE);
            let highest = (0..self.values.len()).map(over).fold(0.0, f64::max);
            if highest > 1.0 {
                let mut instants_s = front.instants_s;
                if front.is_fold {
                    let seen_s = SEEN * self.step_s;
                    instants_s[0] = instants_s[0].min(front.at_s - seen_s);
                    instants_s[3] = instants_s[3].max(front.at_s + seen_s);
                }
                found.push((highest, instants_s));
            }
        }
        // those that may be highest first
        found.sort_by(|one, other| other.0.total_cmp(&one.0));
        let mut wanted_s = Vec::new();
        for (_, instants_s) in found {
            let before = wanted_s.len();
            wanted_s.extend(instants_s);
            wanted_s[before..].sort_by(f64::total_cmp);
            wanted_s.dedup();
            if wanted_s.len() >= MOST_AT_FRONTS {
                break;
            }
        }
        wanted_s
    }

    /// Notes how large the outputs may be at fronts that looked-up kernels do not resolve. The shortest waves of their discs take a
    /// time in s to pass, which may be longer than a fold.
    fn hide(&mut self, fronts: &[Front], shortest_s: f64) {
        for j in 0..self.values.len() {
            let most = fronts.iter().filter_map(|front| {
                let shortest_s = if front.is_fold { shortest_s } else { 0.0 };
                self.most_at(j, front, shortest_s)
            });
            self.hidden[j] = most.fold(0.0, f64::max);
        }
    }

    /// The largest magnitude that an output may have at a front, if this is narrower than the samples around it, and than a time in
    /// s: it grows toward the front no faster than as the root of the time to it, and already shows in the bends of the samples.
    fn most_at(&self, j: usize, front: &Front, shortest_s: f64) -> Option<f64> {
        let after = self.time_s.partition_point(|&t| t <= front.at_s);
        let before = after.checked_sub(1).filter(|i| self.joins(*i))?;
        let gap_s = (self.time_s[after] - self.time_s[before]).max(shortest_s);
        if front.width_s >= gap_s {
            return None;
        }
        let own = &self.values[j];
        let bends = (before.saturating_sub(1)..=after + 1).filter_map(|i| self.bend(j, i));
        let most = own[before].abs().max(own[after].abs());
        Some(most + (gap_s / front.width_s).sqrt() * bends.fold(0.0, f64::max))
    }

    /// Whether a place and the next one are in one run of samples.
    fn joins(&self, i: usize) -> bool {
        let next = self.time_s.get(i + 1);
        next.is_some_and(|next| next - self.time_s[i] < 1.01 * self.step_s)
    }

    /// The second difference of an output around a place.
    fn bend(&self, j: usize, i: usize) -> Option<f64> {
        let (before, own) = (i.checked_sub(1)?, &self.values[j]);
        let inside = self.joins(before) && self.joins(i);
        inside.then(|| (own[i + 1] - 2.0 * own[i] + own[before]).abs())
    }

    fn is_new(&self, at_s: f64) -> bool {
        let after = self.time_s.partition_point(|&t| t < at_s);
        let near = |i: usize| {
            let known_s = self.time_s.get(i);
            known_s.is_some_and(|t| (t - at_s).abs() < 1e-6 * self.step_s)
        };
        let inside = after.checked_sub(1).is_some_and(|i| self.joins(i));
        inside && !near(after) && !near(after - 1)
    }

    fn insert(&mut self, at_s: f64, found: &[[f64; 2]]) {
        /// Ratio of an error to that of the samples above which a value says nothing.
        const USELESS: f64 = 10.0;
        let place = self.time_s.partition_point(|&t| t < at_s);
        for (j, [value, error]) in found.iter().enumerate() {
            let is_useless = *error > USELESS * self.errors[j] && *error > 0.1 * value.abs();
            let value = if is_useless { self.at(j, at_s) } else { *value };
            self.values[j].insert(place, value);
            let beside = [place.saturating_sub(1), place].map(|i| self.own_errors[j].get(i));
            let beside = beside
                .into_iter()
                .flatten()
                .fold(0.0_f64, |most, own| most.max(*own));
            self.own_errors[j].insert(place, beside);
            if !is_useless {
                self.errors[j] = self.errors[j].max(*error);
                self.own_errors[j][place] = *error;
            }
        }
        self.time_s.insert(place, at_s);
    }

    /// An output between known instants, by a straight line.
    fn at(&self, j: usize, at_s: f64) -> f64 {
        let (own, last) = (&self.values[j], self.time_s.len() - 1);
        let after = self
            .time_s
            .partition_point(|&t| t < at_s)
            .clamp(1, last.max(1));
        let before = after - 1;
        if last == 0 {
            return own[0];
        }
        let length_s = self.time_s[after] - self.time_s[before];
        let x = ((at_s - self.time_s[before]) / length_s).clamp(0.0, 1.0);
        own[before] + x * (own[after] - own[before])
    }

    /// Adds the instants at which an output should be known better.
    fn ask(&self, j: usize, wanted_s: &mut Vec<f64>) {
        let crests = self.crests(j);
        let highest = crests
            .iter()
            .map(|crest| crest.peak.value.abs())
            .fold(0.0, f64::max);
        let enough = self.enough(j, highest);
        for crest in crests {
            let may_be = crest.peak.value.abs() + MAY_RISE * crest.peak.error;
            if crest.peak.error > enough && may_be > highest {
                wanted_s.push(crest.next_s);
            }
        }
    }

    /// Uncertainty of a crest that is accepted.
    fn enough(&self, j: usize, highest: f64) -> f64 {
        (ENOUGH * self.errors[j]).max(ROUNDING * highest)
    }

    fn peak(&self, j: usize) -> Peak {
        // a straight line between samples has no crest
        let falls = |peak: &Peak| {
            let sides = [-SEEN, SEEN].map(|part| {
                let at_s = peak.time_s + part * self.step_s;
                let place = self.time_s.partition_point(|&t| t < at_s).max(1) - 1;
                let next = self.time_s.get(place + 1);
                let gap_s = next.map_or(f64::INFINITY, |next| next - self.time_s[place]);
                match gap_s < 0.5 * self.step_s {
                    true => peak.value.abs() - self.at(j, at_s).abs(),
                    false => 0.0,
                }
            });
            sides[0].max(sides[1]).max(0.0)
        };
        let higher = |most: Crest, crest: &Crest| {
            let is_higher = crest.peak.value.abs() > most.peak.value.abs();
            if is_higher { *crest } else { most }
        };
        let crests = self.crests(j);
        let highest = crests.iter().fold(Crest::default(), higher);
        let others = crests
            .iter()
            .map(|one| one.peak.value.abs() + one.peak.error + one.of_values);
        let values = self.values[j].iter().zip(&self.own_errors[j]);
        let may_be = others.chain(values.map(|(value, error)| value.abs() + error));
        let may_be = may_be.fold(self.hidden[j], f64::max);
        let mut found = highest.peak;
        let uncertain = found.error.max(falls(&found)) + highest.of_values;
        found.error = uncertain.max(may_be - found.value.abs());
        if found.value == 0.0 {
            found.time_s = self.time_s.first().copied().unwrap_or_default();
        }
        found
    }

    /// By how much the parabolas through three values differ within the gaps next to a place, from those next to it.
    fn roughness(&self, j: usize, i: usize) -> f64 {
        let (own, t) = (&self.values[j], &self.time_s);
        let bend = |k: usize| {
            let slope = |k: usize| (own[k + 1] - own[k]) / (t[k + 1] - t[k]);
            let inside = k > 0 && self.joins(k - 1) && self.joins(k);
            inside.then(|| (slope(k) - slope(k - 1)) / (t[k + 1] - t[k - 1]))
        };
        let Some(here) = bend(i) else {
            return 0.0;
        };
        let sides = [i.checked_sub(1).and_then(bend), bend(i + 1)];
        let gap_s = (t[i] - t[i - 1]).max(t[i + 1] - t[i]);
        let differences = sides.into_iter().flatten().map(|side| (side - here).abs());
        gap_s * gap_s * differences.fold(0.0, f64::max)
    }

    /// The local crests of an output that may be its highest.
    fn crests(&self, j: usize) -> Vec<Crest> {
        let own = &self.values[j];
        let most = largest(own);
        let is_crest = |i: &usize| {
            let i = *i;
            let lower = |other: Option<&f64>| other.is_none_or(|v| v.abs() <= own[i].abs());
            let before = i.checked_sub(1).and_then(|i| own.get(i));
            own[i] != 0.0 && lower(before) && lower(own.get(i + 1))
        };
        let reaches = |i: &usize| {
            let bend = self.bend(j, *i).unwrap_or(0.0);
            own[*i].abs() + MAY_RISE * bend >= most
        };
        let places = (0..own.len()).filter(is_crest).filter(reaches);
        places.map(|i| self.crest(j, i)).collect()
    }

    /// The crest around a place: by polynomials through three and five values; their difference is its uncertainty.
    fn crest(&self, j: usize, i: usize) -> Crest {
        let own = &self.values[j];
        let known = Peak {
            value: own[i],
            time_s: self.time_s[i],
            error: 0.0,
        };
        let has_both = i > 0 && self.joins(i - 1) && self.joins(i);
        let errors = &self.own_errors[j];
        if !has_both {
            return Crest {
                peak: known,
                of_values: errors[i],
                next_s: known.time_s,
            };
        }
        let of_values = errors[i - 1].max(errors[i]).max(errors[i + 1]);
        let mut span = [i - 1, i + 1];
        if span[0] > 0 && self.joins(span[0] - 1) {
            span[0] -= 1;
        }
        if self.joins(span[1]) {
            span[1] += 1;
        }
        let of = |from: usize, to: usize| {
            top(
                &self.time_s[from..=to],
                &own[from..=to],
                [self.time_s[i - 1], self.time_s[i + 1]],
            )
        };
        let (low, high) = (of(i - 1, i + 1), of(span[0], span[1]));
        let spread = (high[1] - low[1]).abs().max(ROUGH * self.roughness(j, i));
        let [before_s, after_s] = [1, 0].map(|k| self.time_s[i + 1 - k] - self.time_s[i - k]);
        let is_finest = self.folds.iter().any(|fold| {
            let off_s = (self.time_s[i] - fold.at_s).abs();
            off_s < 1.01 * BESIDE_FOLD[2] * fold.width_s
        });
        // the crest of the better polynomial, unless it is as good as known: then the middle of the longer side
        let nearest = (high[0] - self.time_s[i])
            .abs()
            .min((high[0] - self.time_s[i - 1]).abs());
        let nearest = nearest.min((high[0] - self.time_s[i + 1]).abs());
        let next_s = match nearest > 0.1 * before_s.min(after_s) {
            true => high[0],
            false if before_s > after_s => self.time_s[i] - 0.5 * before_s,
            false => self.time_s[i] + 0.5 * after_s,
        };
        if is_finest || spread > 0.5 * own[i].abs() {
            // no polynomial: the known value, and its rise above those around it
            let error = (own[i].abs() - own[i - 1].abs().min(own[i + 1].abs())).max(0.0);
            return Crest {
                peak: Peak { error, ..known },
                of_values,
                next_s: if is_finest { known.time_s } else { next_s },
            };
        }
        let value = own[i].signum() * high[1];
        Crest {
            peak: Peak {
                value,
                time_s: high[0],
                error: spread,
            },
            of_values,
            next_s,
        }
    }
}

/// The largest magnitude within a span, and when, of the polynomial through some values, whose middle one is largest.
fn top(time_s: &[f64], values: &[f64], [from_s, to_s]: [f64; 2]) -> [f64; 2] {
    /// Places at which a polynomial is read before a parabola through three of them.
    const TRIALS: usize = 32;
    let middle = (0..values.len()).fold(0, |most, i| match values[i].abs() > values[most].abs() {
        true => i,
        false => most,
    });
    let (sign, unit_s) = (values[middle].signum(), to_s - from_s);
    let x = |t: f64| (t - from_s) / unit_s;
    let at: Vec<f64> = time_s.iter().map(|&t| x(t)).collect();
    let mut differences: Vec<f64> = values.iter().map(|value| sign * value).collect();
    for order in 1..at.len() {
        for k in (order..at.len()).rev() {
            differences[k] = (differences[k] - differences[k - 1]) / (at[k] - at[k - order]);
        }
    }
    let read = |x: f64| {
        let pairs = differences.iter().zip(&at).rev();
        pairs.fold(0.0, |sum, (own, at)| own + (x - at) * sum)
    };
    let read_at = |k: usize| read(k as f64 / TRIALS as f64);
    let best = (1..TRIALS).fold(
        1,
        |most, k| if read_at(k) > read_at(most) { k } else { most },
    );
    let [a, b, c] = [best - 1, best, best + 1].map(read_at);
    let bend = a - 2.0 * b + c;
    let shift = match bend < 0.0 {
        true => (0.5 * (a - c) / bend).clamp(-1.0, 1.0),
        false => 0.0,
    };
    let crest = (best as f64 + shift) / TRIALS as f64;
    // never below what is known
    let (known, found) = (sign * values[middle], read(crest));
    match found >= known {
        true => [from_s + crest * unit_s, found],
        false => [time_s[middle], known],
    }
}
