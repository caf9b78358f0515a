//! The waves of a contact whose radius follows the load, as an integral over a part of the force's past.
//!
//! Hertz's pressure of radius a grows by the pressure of a flat punch of that radius: with the radius of the instant t'
//!
//! ```text
//! u(t) = P(t) static(a(t)) + int P'(t') R_punch(t - t'; a(t')) dt'
//! ```
//!
//! On a fixed disc R is that of Hertz's pressure.
//!
//! The integrand is smooth but where a front from the punch of an instant t' arrives at t, and where the contact's edge
//! passes over a point of the surface. Between these instants it is a series in an angle, which turns roots at both ends into
//! smooth functions, with as many terms as the tolerance needs.
//!
//! Theory: `docs/theory.md` (T55).

use super::loads::Reading;
use super::tuning;
use crate::error::ImpactError;
use crate::excitation::Excitation;
use crate::sampled::projection::largest;
use halfspace::{Estimate, Kernel, Profile, Six, gauss, leja_nodes, leja_series, weights_off_axis};
use std::f64::consts::PI;
use std::ops::Range;
use std::sync::LazyLock;

/// Terms of a series at least and at most, and how often an interval is halved then; more often in the first instants, this part
/// of a contact, since the force of a fast one rises within 1e-4 of its duration
/// (`the_first_instants_of_a_fast_contact_are_resolved` fails at 5).
const LEAST_TERMS: usize = 5;
const MOST_TERMS: usize = 21;
const HALVINGS: usize = 5;
const FIRST_INSTANTS: f64 = 0.02;
const HALVINGS_OF_FIRST: usize = 12;

/// Radius over the distance from the largest edge below which kernels of a punch lose digits.
const NEAR_AXIS: f64 = 0.031;

/// Part of the square of a radius over which kernels near the axis are differenced, and their tolerance over that of the fields: at
/// most 1e-7 of them is lost in rounding, and beside fronts the square of this part over the distance to them
/// (`scripts/check-close`, regions `axis` and `centre`).
const DIFFERENCE: f64 = 1e-5;
const OF_DIFFERENCES: f64 = 1e-7;

/// Integrals of the terms of a series. The argument x stands for an angle (1 + x) pi/2, and each term is the integral
/// of a function times 1 - x^2, since stresses of a punch grow as 1/angle toward a front.
static INTEGRALS: LazyLock<[f64; MOST_TERMS]> = LazyLock::new(|| {
    let rule = gauss::rule(gauss::MAX_NODES);
    std::array::from_fn(|k| {
        let terms = rule.on(-1.0, 1.0).map(|(x, weight)| {
            let sine = (0.5 * PI * (1.0 + x)).sin();
            weight * (k as f64 * x.acos()).cos() * 0.5 * PI * sine / (1.0 - x * x)
        });
        terms.sum()
    })
});

/// Places of the Rayleigh waves from the nearest and the farthest edge among the kinds of fronts.
const RAYLEIGH: [usize; 2] = [4, 5];

/// Kinds of fronts, and the edge of the contact; of both pressures that stand for its own.
const KINDS: usize = 11;
const FAMILIES: usize = 2 * KINDS;

/// Kernels for one excitation, a contact.
pub(crate) struct Past<'a> {
    excitation: &'a Excitation,
    /// Of a punch and of Hertz's pressure, for points that are far, and to fewer digits for others.
    punch: [Kernel; 2],
    hertz: [Kernel; 2],
    /// Of the fields, over their peaks.
    tolerance: f64,
    /// Of Hertz's pressure, to all digits, for differences near the axis.
    axial: Kernel,
}

impl<'a> Past<'a> {
    /// To about `tolerance` of the peaks of the fields.
    pub(crate) fn new(excitation: &'a Excitation, tolerance: f64) -> Result<Self, ImpactError> {
        let least = [
            (1e-6 * tolerance).clamp(1e-12, 1e-10),
            (1e-3 * tolerance).clamp(1e-12, 1e-6),
        ];
        let kernels = |profile| -> Result<[Kernel; 2], ImpactError> {
            let [far, near] = least.map(|least| Kernel::new(excitation.medium(), profile, least));
            Ok([far?, near?])
        };
        Ok(Self {
            excitation,
            punch: kernels(Profile::Punch)?,
            hertz: kernels(Profile::Hertz)?,
            tolerance,
            axial: Kernel::new(
                excitation.medium(),
                Profile::Hertz,
                (OF_DIFFERENCES * tolerance).clamp(1e-12, 1e-8),
            )?,
        })
    }

    /// The six fields in SI units at a point in m, at a time in s.
    pub(crate) fn at(&self, place_m: [f64; 2], time_s: f64) -> Result<Six, ImpactError> {
        /// Instants, as parts of the contact, near one of which the force is large, and tolerances of a last term.
        const PARTS_OF_PEAK: [f64; 4] = [0.2, 0.4, 0.6, 0.8];
        const ALLOWED: f64 = 0.2;
        let still = |time_s: f64| {
            let pressures = self.excitation.pressures(time_s);
            self.excitation.static_si(place_m, pressures)
        };
        // of the largest static field of a kind
        let mut kinds = [0.0_f64; 2];
        for part in PARTS_OF_PEAK {
            let fields = still(part * self.excitation.end_s())?;
            let largest = [&fields[..2], &fields[2..]].map(largest);
            kinds = [0, 1].map(|kind| largest[kind].max(kinds[kind]));
        }
        let allowed =
            std::array::from_fn(|f| ALLOWED * self.tolerance * kinds[usize::from(f >= 2)]);
        let mut sum = still(time_s)?;
        // rates that are not smooth inside a contact, as under a disc whose memory has ended, need short spans
        const PARTS: usize = 16;
        let graded = |i: usize| {
            let x = i as f64 / PARTS as f64;
            x * x * (3.0 - 2.0 * x) * self.excitation.end_s()
        };
        for i in 0..PARTS {
            let span_s = [graded(i), graded(i + 1)];
            let waves = self.between(&allowed, place_m, time_s, span_s, Reading::Force)?;
            for (sum, waves) in sum.iter_mut().zip(waves.value) {
                *sum += waves;
            }
        }
        Ok(sum)
    }

    /// Times of travel in s between which a wave from the nearest or farthest edge of any contact up to the largest passes.
    fn windows(&self, [r_m, z_m]: [f64; 2]) -> [[f64; 2]; 4] {
        let units = self.excitation.units();
        let farthest_s = self.fronts_s([r_m, z_m], units.disc_radius_m);
        let nearest_s = self.fronts_s([(r_m - units.disc_radius_m).max(0.0), z_m], 0.0);
        let margin_s = units.time_s() / self.excitation.medium().rayleigh_speed();
        std::array::from_fn(|wave| {
            [
                nearest_s[2 * wave] - margin_s,
                farthest_s[2 * wave + 1] + margin_s,
            ]
        })
    }

    /// The cells of a contact whose waves reach a point at a time from near its beginning, its kinks and its end, where a
    /// sum over discs does not serve, as far as any front is among them; none where all of the contact is near.
    ///
    /// They are cut where no front passes: there the discs and the integral agree instant by instant.
    pub(crate) fn parts(
        &self,
        place_m: [f64; 2],
        time_s: f64,
        cells: &Range<usize>,
        span_s: impl Fn(&Range<usize>) -> [f64; 2],
    ) -> Option<Vec<Range<usize>>> {
        /// Discs do not serve for this many times that a Rayleigh wave takes over the radius, and for as many cells.
        const SPREAD: f64 = 2.0;
        const NEAR: f64 = 2.0;
        const FEWEST: usize = 2;
        let units = self.excitation.units();
        let margin_s = units.time_s() / self.excitation.medium().rayleigh_speed();
        let windows = self.windows(place_m);
        // how far a time of travel is from all fronts, negative where one passes
        let clear = |s: f64| {
            let distances = windows.iter().map(|[from, to]| (from - s).max(s - to));
            distances.fold(f64::INFINITY, f64::min)
        };
        let [begin_s, end_s] = span_s(cells);
        let cell_s = (end_s - begin_s) / cells.len() as f64;
        let least = ((SPREAD * margin_s / cell_s).ceil() as usize).max(FEWEST);
        // where the contact's edge passes over the point, fields are not smooth in its radius
        let near = place_m.iter().all(|x| *x < NEAR * units.disc_radius_m);
        if near || 2 * least >= cells.len() {
            return None;
        }
        // the first clear cut, or the one that is clearest
        let cut_s = |cut: usize| span_s(&(cells.start..cut))[1];
        let best = |cuts: &mut dyn Iterator<Item = usize>| {
            let mut best = (None, f64::NEG_INFINITY);
            for cut in cuts {
                let own = clear(time_s - cut_s(cut));
                if own > best.1 {
                    best = (Some(cut), own);
                }
                if own >= 0.0 {
                    break;
                }
            }
            best.0
        };
        // an output may end before the contact does
        let contacts = self.excitation.contacts_s();
        let ends = contacts.iter().any(|span| span[1] <= end_s);
        let inside = |at_s: &&f64| begin_s < **at_s && **at_s < end_s;
        let kinks = self.excitation.kinks_s().iter().filter(inside);
        let kinks = kinks.map(|at_s| cells.start + ((at_s - begin_s) / cell_s) as usize);
        let marks: Vec<usize> = [cells.start]
            .into_iter()
            .chain(kinks)
            .chain(ends.then_some(cells.end))
            .collect();
        // halfway to the next mark
        let next = |i: usize| marks.get(i + 1).copied();
        let limit = |i: usize| next(i).map_or(cells.end, |next| marks[i].midpoint(next));
        let around = |(i, &mark): (usize, &usize)| {
            let from = match i {
                0 => mark,
                _ => {
                    let mut cuts = (limit(i - 1)..=mark.saturating_sub(least)).rev();
                    best(&mut cuts).unwrap_or(limit(i - 1))
                }
            };
            let to = if mark == cells.end {
                mark
            } else {
                best(&mut (mark + least..=limit(i))).unwrap_or(limit(i))
            };
            from..to
        };
        let passed = |part: &Range<usize>| {
            let [from_s, to_s] = span_s(part).map(|t| time_s - t);
            let inside = |[near, far]: &[f64; 2]| *near < from_s && *far > to_s;
            windows.iter().any(inside)
        };
        let parts = marks.iter().enumerate().map(around);
        Some(parts.filter(passed).collect())
    }

    /// The waves from a part of the past at a time, or as much of their rate as comes of the rate of the force there.
    ///
    /// That of the instants' waves is an integral as they are, and what leaves the part at its ends is not lost:
    ///
    /// ```text
    /// int_a^b P''(t') R(t - t') dt' = [P' R]_a^b + int_a^b P'(t') dR/dt(t - t') dt'
    /// ```
    pub(crate) fn between(
        &self,
        allowed: &Six,
        place_m: [f64; 2],
        time_s: f64,
        [from_s, to_s]: [f64; 2],
        reading: Reading,
    ) -> Result<Estimate, ImpactError> {
        let last_s = time_s.min(self.excitation.end_s());
        let from_s = from_s.clamp(0.0, last_s);
        let span_s = [from_s, to_s.clamp(from_s, last_s)];
        let mut sum = self.integral(allowed, place_m, time_s, span_s, reading)?;
        if reading == Reading::Rate {
            for (past_s, sign) in span_s.into_iter().zip([-1.0, 1.0]) {
                self.add(
                    place_m,
                    [time_s, past_s],
                    sign,
                    (Reading::Force, false),
                    &mut sum.value,
                )?;
            }
        }
        Ok(sum)
    }

    /// The integral over some of the past by series whose last terms are within what is allowed, and what these may leave.
    ///
    /// At the axis, where fronts from opposite edges meet, fields are r to their parity times a function of r^2, which their
    /// values at two larger radii continue; their error is taken from the difference to the nearer one alone.
    fn integral(
        &self,
        allowed: &Six,
        [r_m, z_m]: [f64; 2],
        time_s: f64,
        span_s: [f64; 2],
        reading: Reading,
    ) -> Result<Estimate, ImpactError> {
        /// Radius over the distance from the largest edge from which the axis is continued, the part of the difference of two
        /// continuations that is their error, and the part of the allowed error that each may have: at 1 errors are twice as
        /// large and a twentieth of the time is saved (`scripts/check-close`, regions `axis` and `centre`).
        const AXIS: f64 = 0.008;
        const CONTINUED: f64 = 0.3;
        const OF_EACH: f64 = 0.3;
        // rates are those of a punch, which are not differenced
        let part = match reading {
            Reading::Force => AXIS,
            Reading::Rate => NEAR_AXIS,
        };
        let step_m = part * z_m.hypot(self.excitation.units().disc_radius_m);
        if r_m >= step_m {
            return self.off_axis(allowed, [r_m, z_m], time_s, span_s, reading);
        }
        let radii = [step_m, 2.0 * step_m];
        let mut sum = Estimate::default();
        let mut nearer = Six::default();
        for (i, &radius) in radii.iter().enumerate() {
            let weights = weights_off_axis(r_m, &radii, i);
            // what vanishes on the axis needs no digits beside it
            let weight = |f: usize| weights[f].abs().max(f64::MIN_POSITIVE);
            let allowed = std::array::from_fn(|f| OF_EACH * allowed[f] / weight(f));
            let found = self.off_axis(&allowed, [radius, z_m], time_s, span_s, reading)?;
            for (f, weight) in weights.into_iter().enumerate() {
                sum.value[f] += weight * found.value[f];
                sum.error[f] += (weight * found.error[f]).abs();
            }
            if i == 0 {
                let weights = weights_off_axis(r_m, &radii[..1], 0);
                nearer = std::array::from_fn(|f| weights[f] * found.value[f]);
            }
        }
        for (f, nearer) in nearer.into_iter().enumerate() {
            sum.error[f] += CONTINUED * (sum.value[f] - nearer).abs();
        }
        Ok(sum)
    }

    fn off_axis(
        &self,
        allowed: &Six,
        place_m: [f64; 2],
        time_s: f64,
        span_s: [f64; 2],
        reading: Reading,
    ) -> Result<Estimate, ImpactError> {
        let cuts = self.cuts(place_m, time_s, span_s);
        let differenced = reading == Reading::Force && self.is_near_axis(place_m);
        // between two cuts, and how often they may be halved
        let first_s = FIRST_INSTANTS * self.excitation.end_s();
        let halvings = |to_s: f64| match to_s <= first_s {
            true => HALVINGS_OF_FIRST,
            false => HALVINGS,
        };
        let pairs = cuts
            .windows(2)
            .map(|pair| ([pair[0], pair[1]], halvings(pair[1])));
        let mut panels: Vec<_> = pairs.rev().collect();
        let mut sum = Estimate::default();
        'panels: while let Some((pair, halvings)) = panels.pop() {
            let [from_s, to_s] = pair;
            let (mut values, mut series) = (Vec::new(), Vec::new());
            for terms in (LEAST_TERMS..=MOST_TERMS).step_by(2) {
                for &node in &leja_nodes()[values.len()..terms] {
                    let weight = 0.5 * (to_s - from_s) * (1.0 - node * node);
                    let mut value = Six::default();
                    if weight > 0.0 {
                        let times_s = [time_s, at_node(pair, node)];
                        self.add(place_m, times_s, weight, (reading, differenced), &mut value)?;
                    }
                    values.push(value);
                }
                series = leja_series(&values);
                // terms that fall as a power are many
                let many = terms as f64 / LEAST_TERMS as f64;
                let last = |f: usize| series[terms - 1][f].abs() + series[terms - 2][f].abs();
                if (0..6).all(|f| many * last(f) <= allowed[f]) {
                    break;
                }
                // such as of logarithms at the ends
                if terms == MOST_TERMS && halvings > 0 {
                    let middle_s = 0.5 * (from_s + to_s);
                    let halves = [[middle_s, to_s], [from_s, middle_s]];
                    panels.extend(halves.map(|half| (half, halvings - 1)));
                    continue 'panels;
                }
            }
            let last = &series[series.len() - 2..];
            for f in 0..6 {
                let terms = series.iter().zip(&*INTEGRALS);
                sum.value[f] += terms
                    .map(|(term, integral)| integral * term[f])
                    .sum::<f64>();
                sum.error[f] += last.iter().map(|term| term[f].abs()).sum::<f64>();
            }
        }
        Ok(sum)
    }

    /// Whether fields nearly cancel over a contact.
    pub(crate) fn is_far(&self, [r_m, z_m]: [f64; 2]) -> bool {
        r_m.max(z_m) > tuning::FAR * self.excitation.units().disc_radius_m
    }

    /// Radii of the pressures of an instant over the largest; twice that of a single one.
    fn overs(&self, past_s: f64) -> [f64; 2] {
        let [one, other] = self
            .excitation
            .pressures(past_s)
            .map(|one| one.square.sqrt());
        [one, if other > 0.0 { other } else { one }]
    }

    /// Adds the waves of what an instant changes, or their rate: a pressure grows by that of a punch of its radius, and scales
    /// as it is. Near the axis the kernels of a punch lose digits, because its fronts from opposite edges meet there; there the
    /// kernels of Hertz's pressure are `differenced` over the square of their radius.
    fn add(
        &self,
        place_m: [f64; 2],
        times_s: [f64; 2],
        weight: f64,
        (reading, differenced): (Reading, bool),
        sum: &mut Six,
    ) -> Result<(), ImpactError> {
        /// Part of the rate that is not told from rounding.
        const NOTHING: f64 = 1e-12;
        let level = usize::from(!self.is_far(place_m));
        for one in self.excitation.pressures(times_s[1]) {
            if one.square == 0.0 {
                continue;
            }
            let grown = 1.5 * one.force_n * one.square_rate / one.square;
            let of = |kernel: &Kernel, square: f64| {
                self.waves(kernel, place_m, times_s, square, reading)
            };
            let mut add = |rate: f64, waves: Six| {
                for (sum, waves) in sum.iter_mut().zip(waves) {
                    *sum += weight * rate * waves;
                }
            };
            if differenced {
                let [above, below] =
                    [1.0 + DIFFERENCE, 1.0 - DIFFERENCE].map(|part| part * one.square);
                let slope = one.force_n * one.square_rate / (2.0 * DIFFERENCE * one.square);
                add(one.rate, of(&self.axial, one.square)?);
                add(slope, of(&self.axial, above)?);
                add(-slope, of(&self.axial, below)?);
                continue;
            }
            for (rate, kernel) in [
                (grown, &self.punch[level]),
                (one.rate - grown, &self.hertz[level]),
            ] {
                if rate.abs() > NOTHING * one.rate.abs() {
                    add(rate, of(kernel, one.square)?);
                }
            }
        }
        Ok(())
    }

    /// The waves of a unit force with a kernel's pressure, or their rate in SI units, since an instant; of a radius with this
    /// square, over that of the largest.
    fn waves(
        &self,
        kernel: &Kernel,
        place_m: [f64; 2],
        [time_s, past_s]: [f64; 2],
        square: f64,
        reading: Reading,
    ) -> Result<Six, ImpactError> {
        let (units, over) = (self.excitation.units(), square.sqrt());
        let [r, z] = place_m.map(|x| x / (over * units.disc_radius_m));
        let unit_s = over * units.time_s();
        let since = (time_s - past_s) / unit_s;
        let value = match reading {
            Reading::Force => kernel.remainder(r, z, since)?.value,
            Reading::Rate => {
                let [u, w] = kernel.displacement_impulse(r, z, since)?;
                [u / unit_s, w / unit_s, 0.0, 0.0, 0.0, 0.0]
            }
        };
        let unit = self.excitation.units_si(over);
        Ok(std::array::from_fn(|f| unit[f] * value[f]))
    }

    /// Whether fronts from opposite edges of the contact nearly meet at a point.
    fn is_near_axis(&self, [r_m, z_m]: [f64; 2]) -> bool {
        r_m < NEAR_AXIS * z_m.hypot(self.excitation.units().disc_radius_m)
    }

    /// Instants of a span of the past between which the integrand is smooth, ascending.
    fn cuts(&self, place_m: [f64; 2], time_s: f64, [from_s, until_s]: [f64; 2]) -> Vec<f64> {
        /// Instants between which crossings are looked for, dense toward both ends.
        const TRIALS: usize = 40;
        let fronts_s = self.fronts_s(place_m, self.excitation.units().disc_radius_m);
        let last_s = fronts_s.into_iter().fold(0.0, f64::max);
        let families = KINDS * (1 + usize::from(self.excitation.yielded().is_some()));
        /// Parts of a contact at which it is cut, so that rules follow the rate of its force.
        const PARTS: [f64; 8] = [FIRST_INSTANTS, 0.1, 0.25, 0.4, 0.6, 0.75, 0.9, 0.98];
        let mut cuts = vec![from_s, until_s];
        let parts_s = PARTS.map(|part| part * self.excitation.end_s());
        let parts_s = parts_s.iter().chain(self.excitation.kinks_s());
        cuts.extend(parts_s.filter(|s| from_s < **s && **s < until_s));
        // within the passing of the waves; before it the contact's edge alone may pass
        let passing_s = (time_s - 1.01 * last_s).clamp(from_s, until_s);
        let is_under = place_m[0] < self.excitation.units().disc_radius_m;
        for [low, high] in [[from_s, passing_s], [passing_s, until_s]] {
            if low >= high || high == passing_s && !is_under {
                continue;
            }
            let graded = |i: usize| {
                let x = i as f64 / TRIALS as f64;
                let from_end = if 2 * i < TRIALS { x } else { 1.0 - x };
                let part = 8.0 * from_end.powi(4);
                low + (high - low) * if 2 * i < TRIALS { part } else { 1.0 - part }
            };
            let at = |s: f64| (s, self.ahead(place_m, time_s, s));
            let trials: Vec<_> = (0..=TRIALS).map(graded).map(at).collect();
            for family in 0..families {
                let own = trials.iter().map(|(s, ahead)| (*s, ahead[family]));
                let mut tried: Vec<_> = own.collect();
                let turn = |three: &[_]| self.turn(place_m, time_s, three, family);
                let turns: Vec<_> = tried.windows(3).filter_map(turn).collect();
                tried.extend(turns);
                tried.sort_by(|a, b| a.0.total_cmp(&b.0));
                for pair in tried.windows(2) {
                    if (pair[0].1 < 0.0) != (pair[1].1 < 0.0) {
                        let at_s = self.crossing(place_m, time_s, [pair[0], pair[1]], family);
                        cuts.push(at_s);
                        if RAYLEIGH.contains(&(family % KINDS)) {
                            let beside = self.beside_rayleigh(place_m, time_s);
                            let both = beside.iter().flat_map(|s| [at_s - s, at_s + s]);
                            cuts.extend(both.filter(|s| from_s < *s && *s < until_s));
                        }
                    }
                }
            }
        }
        // the tail of the waves falls as a power of the time since the last front
        let mut since_s = last_s;
        while since_s > 0.0 && time_s - since_s > from_s {
            if time_s - since_s < until_s {
                cuts.push(time_s - since_s);
            }
            since_s *= 2.0;
        }
        cuts.sort_by(f64::total_cmp);
        let shortest = 1e-12 * until_s;
        cuts.dedup_by(|later, earlier| *later - *earlier < shortest);
        cuts
    }

    /// Distances in s from a Rayleigh wave at which a span is cut just below the surface: there it passes in a time of the order
    /// of the depth, which nodes that are as far apart as the other fronts do not see.
    fn beside_rayleigh(&self, [r_m, z_m]: [f64; 2], time_s: f64) -> Vec<f64> {
        /// Depth over the distance from the farthest edge below which that is so, and the factor between two cuts.
        const SHALLOW: f64 = 0.05;
        const APART: f64 = 8.0;
        let (units, medium) = (self.excitation.units(), self.excitation.medium());
        if z_m == 0.0 || z_m > SHALLOW * (r_m + units.disc_radius_m) {
            return Vec::new();
        }
        let slowness = [medium.rayleigh_speed(), medium.kappa()].map(|c| 1.0 / (c * c));
        let passing = z_m * (slowness[0] - slowness[1]).sqrt() / units.longitudinal_speed_m_s;
        let grow = |s: &f64| Some(APART * s);
        std::iter::successors(Some(passing), grow)
            .take_while(|s| APART * s < time_s)
            .collect()
    }

    /// Times in s that each kind of front takes from a disc of a radius in m.
    fn fronts_s(&self, [r_m, z_m]: [f64; 2], radius_m: f64) -> [f64; KINDS - 1] {
        let medium = self.excitation.medium();
        let kappa = medium.kappa();
        let span = (1.0 / (kappa * kappa) - 1.0).sqrt();
        let [near, far] = [(r_m - radius_m).abs(), r_m + radius_m];
        let (short, long) = (near.hypot(z_m), far.hypot(z_m));
        let slowest = medium.rayleigh_speed();
        // where there is no such front: at the time of another
        let head = |r: f64, body: f64| {
            if r * span > z_m {
                r + z_m * span
            } else {
                body / kappa
            }
        };
        let plane = if r_m > radius_m { short } else { z_m };
        let lengths = [
            short,
            long,
            short / kappa,
            long / kappa,
            near / slowest,
            far / slowest,
            head(near, short),
            head(far, long),
            plane,
            plane / kappa,
        ];
        lengths.map(|length| length / self.excitation.units().longitudinal_speed_m_s)
    }

    /// How far in s each kind of front from the contact of an instant has gone beyond the point, and the edge of the contact
    /// beyond it.
    fn ahead(&self, place_m: [f64; 2], time_s: f64, past_s: f64) -> [f64; FAMILIES] {
        let units = self.excitation.units();
        let radii_m = self.overs(past_s).map(|over| over * units.disc_radius_m);
        let first_s = self.fronts_s(place_m, radii_m[0]);
        let other_s = match radii_m[0] == radii_m[1] {
            true => first_s,
            false => self.fronts_s(place_m, radii_m[1]),
        };
        let fronts_s = [first_s, other_s];
        let since_s = time_s - past_s;
        std::array::from_fn(|family| {
            let (which, kind) = (family / KINDS, family % KINDS);
            match fronts_s[which].get(kind) {
                Some(front_s) => since_s - front_s,
                None => (radii_m[which] - place_m[0]) / units.longitudinal_speed_m_s,
            }
        })
    }

    /// Where one of the distances of [`Self::ahead`] that does not change its sign between three instants does so all the
    /// same: the edge of a contact begins and ends faster than any wave, whose front passes a point and turns. By golden
    /// sections.
    fn turn(
        &self,
        place_m: [f64; 2],
        time_s: f64,
        tried: &[(f64, f64)],
        family: usize,
    ) -> Option<(f64, f64)> {
        const STEPS: usize = 12;
        const SECTION: f64 = 0.382;
        let &[low, middle, high] = tried else {
            return None;
        };
        let is_past = |at: f64| (at < 0.0) != (middle.1 < 0.0);
        let nears = middle.1.abs() < low.1.abs().min(high.1.abs());
        if !nears || is_past(low.1) || is_past(high.1) {
            return None;
        }
        let (mut nearest, mut span) = (middle, [low.0, high.0]);
        for _ in 0..STEPS {
            let sides = span.map(|end| end - nearest.0);
            let later = usize::from(sides[1] > -sides[0]);
            let next = nearest.0 + SECTION * sides[later];
            let at = self.ahead(place_m, time_s, next)[family];
            if is_past(at) {
                return Some((next, at));
            }
            if at.abs() < nearest.1.abs() {
                span[1 - later] = nearest.0;
                nearest = (next, at);
            } else {
                span[later] = next;
            }
        }
        None
    }

    /// Where one of the distances of [`Self::ahead`] changes its sign, by false position (Illinois).
    fn crossing(
        &self,
        place_m: [f64; 2],
        time_s: f64,
        [(mut low, mut at_low), (mut high, mut at_high)]: [(f64, f64); 2],
        family: usize,
    ) -> f64 {
        const MOST_SECANTS: usize = 40;
        let enough = 1e-13 * high;
        for _ in 0..MOST_SECANTS {
            if high - low < enough || at_low == at_high {
                break;
            }
            let middle = low + (high - low) * at_low / (at_low - at_high);
            let value = self.ahead(place_m, time_s, middle)[family];
            if value == 0.0 {
                return middle;
            }
            if (value < 0.0) == (at_low < 0.0) {
                (low, at_low, at_high) = (middle, value, 0.5 * at_high);
            } else {
                (high, at_high, at_low) = (middle, value, 0.5 * at_low);
            }
        }
        if at_low.abs() < at_high.abs() {
            low
        } else {
            high
        }
    }
}

/// The instant between two that a node stands for.
fn at_node([from, to]: [f64; 2], node: f64) -> f64 {
    0.5 * (from + to) - 0.5 * (to - from) * (0.5 * PI * (1.0 + node)).cos()
}
