//! Power spectra at receivers by Campbell's theorem.
//!
//! ```text
//! S(f) = 2 n E|F(f)|^2 int |G(r, z, f)|^2 dA          impacts at random
//! S(f) = 2/T sum |F_i(f)|^2 |G(r_i, z, f)|^2          listed impacts
//! ```
//!
//! One-sided: the integral of S over positive frequencies is the variance.

use crate::area::Area;
use crate::error::NoiseError;
use crate::ground::{AtFrequency, Sheet};
use crate::source::{Bins, Noise, Receiver, Source, distance_m};
use crate::spacing::cubic;
use halfspace::gauss::rule;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// Direction of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Motion {
    /// Both horizontal components together.
    Horizontal,
    /// Down.
    Vertical,
}

/// Relative errors of the power at a receiver and a frequency.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Errors {
    /// Standard deviation for the number of impacts of which E|F|^2 is the mean; 0 for listed impacts.
    pub sampling: f64,
    /// Pulses between those that are solved.
    pub pulses: f64,
    /// Size of the contacts against the wavelength.
    pub contact_size: f64,
    /// Response of the half-space.
    pub response: f64,
    /// Integral over the distance.
    pub quadrature: f64,
}

impl Errors {
    /// Their sum.
    pub fn total(&self) -> f64 {
        self.sampling + self.pulses + self.contact_size + self.response + self.quadrature
    }
}

/// Spectra at all receivers.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectra {
    /// Frequencies in Hz.
    pub frequency_hz: Vec<f64>,
    /// E|F|^2 in N^2 s^2 at each.
    pub force_n2_s2: Vec<f64>,
    /// Distances in m at which the share of nearer impacts is stated, for each receiver.
    pub distance_m: Vec<Vec<f64>>,
    /// By receiver and frequency.
    rows: Vec<Vec<Row>>,
}

/// A receiver at a frequency.
#[derive(Debug, Clone, PartialEq, Default)]
struct Row {
    /// Horizontal and vertical displacement in m^2/Hz.
    power: [f64; 2],
    /// Part of the vertical power from within each distance.
    share: Vec<f64>,
    errors: Errors,
}

impl Row {
    /// Empty, with room for shares.
    fn new(shares: usize) -> Self {
        let share = vec![0.0; shares];
        Self {
            share,
            ..Self::default()
        }
    }

    /// Divides sums by the vertical power.
    fn over_power(&mut self) {
        let all = self.power[1].max(f64::MIN_POSITIVE);
        self.share.iter_mut().for_each(|share| *share /= all);
        self.errors.response /= all;
        self.errors.quadrature /= all;
    }
}

impl Spectra {
    /// Power in m^2/Hz of a displacement, in (m/s)^2/Hz after one derivative, in (m/s^2)^2/Hz after two; one-sided.
    pub fn power(&self, receiver: usize, motion: Motion, derivatives: i32) -> Vec<f64> {
        let factor = |f: &f64| (TAU * f).powi(2 * derivatives);
        let rows = self.rows[receiver].iter().zip(&self.frequency_hz);
        rows.map(|(row, f)| row.power[motion as usize] * factor(f))
            .collect()
    }

    /// Errors of a receiver.
    pub fn errors(&self, receiver: usize) -> impl Iterator<Item = &Errors> {
        self.rows[receiver].iter().map(|row| &row.errors)
    }

    /// Part of the vertical power from within each distance, at each frequency of a receiver.
    pub fn share(&self, receiver: usize) -> impl Iterator<Item = &[f64]> {
        self.rows[receiver].iter().map(|row| &row.share[..])
    }
}

/// Number of distances at which a share is stated.
const SHARES: usize = 25;

/// Nodes of the rule between two cuts, and of that whose difference is the error.
const NODES: [usize; 2] = [12, 8];

/// Largest ratio of the distances of two cuts, and largest x between them: |H|^2 has beats of half a wave number
/// (`integrals_are_within_their_errors`).
const RATIO: f64 = 2.0;
const BEAT: f64 = 6.0;

/// Frequencies that are summed together.
const CHUNK: usize = 32;

/// Loss of power by the size of a contact over (k a)^2, Rayleigh's k: from the transform 1 - (k a)^2/10 of Hertz's pressure.
const CONTACT_SIZE: f64 = 0.2;

/// Distances and responses around the receivers.
struct Around {
    bins: Vec<Bins>,
    sheets: Vec<Sheet>,
    ends_m: Vec<[f64; 2]>,
    edges_m: Vec<Vec<f64>>,
}

/// Sums over all impacts at a frequency: |F|^2, |F|^4, |F|^2 a^2.
type Forces = [f64; 3];

impl Noise {
    /// The spectra at frequencies in Hz, ascending.
    ///
    /// # Errors
    /// [`NoiseError`] for an impact too close to a receiver, and for frequencies or an area too large for a table.
    pub fn spectra(&self, frequency_hz: &[f64]) -> Result<Spectra, NoiseError> {
        let ends = [frequency_hz[0], frequency_hz[frequency_hz.len() - 1]];
        let sheets = self.sheets(ends)?;
        let ends_m = self.receivers.iter().map(|one| self.distances_m(one));
        let ends_m: Vec<[f64; 2]> = ends_m.collect::<Result<_, _>>()?;
        let edges_m: Vec<Vec<f64>> = (self.receivers.iter().zip(&ends_m))
            .map(|(receiver, ends_m)| edges(receiver.depth_m, *ends_m))
            .collect();
        let bins = match &self.source {
            Source::Poisson { .. } => Vec::new(),
            Source::Listed { .. } => self.bins(ends[1], CHUNK)?,
        };
        let around = Around {
            bins,
            sheets,
            ends_m,
            edges_m,
        };
        let chunks = frequency_hz.par_chunks(CHUNK);
        let chunks = chunks.map(|chunk| self.chunk(chunk, &around));
        let chunks: Vec<Vec<(f64, Vec<Row>)>> = chunks.collect::<Result<_, _>>()?;
        let mut found = Spectra {
            frequency_hz: frequency_hz.to_vec(),
            force_n2_s2: Vec::new(),
            distance_m: around.edges_m,
            rows: vec![Vec::new(); self.receivers.len()],
        };
        for (force, rows) in chunks.into_iter().flatten() {
            found.force_n2_s2.push(force);
            let all = found.rows.iter_mut().zip(rows);
            all.for_each(|(all, row)| all.push(row));
        }
        Ok(found)
    }

    /// E|F|^2 and the rows of all receivers at some frequencies.
    fn chunk(&self, chunk: &[f64], around: &Around) -> Result<Vec<(f64, Vec<Row>)>, NoiseError> {
        let (forces, listed) = self.forces(chunk, &around.bins);
        let row = |i: usize, j: usize| {
            let (receiver, f) = (&self.receivers[i], chunk[j]);
            let (ends_m, edges_m) = (around.ends_m[i], &around.edges_m[i]);
            let at = self.at(&around.sheets, i, f);
            let mut row = match &self.source {
                Source::Poisson {
                    area,
                    rate_per_m2_s,
                } => {
                    let mean = forces[j][0] / self.blows.len() as f64;
                    let cuts = Cuts {
                        area,
                        receiver,
                        ends_m,
                        edges_m,
                    };
                    cuts.row(&at, 2.0 * rate_per_m2_s * mean)
                }
                Source::Listed { duration_s, .. } => {
                    let powers = listed[i].iter().skip(j).step_by(chunk.len());
                    let powers = powers
                        .map(|power| 2.0 / duration_s * power)
                        .collect::<Vec<f64>>();
                    summed(&at, &around.bins[i], &powers, edges_m)
                }
            };
            self.add_errors(&mut row.errors, f, &forces[j]);
            Ok(row)
        };
        let all = (0..chunk.len()).map(|j| {
            let rows = (0..self.receivers.len()).map(|i| row(i, j));
            let rows: Vec<Row> = rows.collect::<Result<_, NoiseError>>()?;
            Ok((forces[j][0] / self.blows.len() as f64, rows))
        });
        all.collect()
    }

    /// Sums over the impacts at some frequencies; of listed ones also the power |F|^2 near each node of each receiver.
    fn forces(&self, chunk: &[f64], bins: &[Bins]) -> (Vec<Forces>, Vec<Vec<f64>>) {
        let mut sums = vec![Forces::default(); chunk.len()];
        let places_m = match &self.source {
            Source::Poisson { .. } => None,
            Source::Listed { places_m, .. } => Some(places_m),
        };
        let sizes = bins.iter().map(|bins| bins.spacing.count * chunk.len());
        let mut listed: Vec<Vec<f64>> = sizes.map(|size| vec![0.0; size]).collect();
        let mut powers = vec![0.0; chunk.len()];
        for (i, blow) in self.blows.iter().enumerate() {
            for ((sum, power), &f) in sums.iter_mut().zip(&mut powers).zip(chunk) {
                *power = self.pulses.force(i, blow, f).norm_sqr();
                sum[0] += *power;
                sum[1] += *power * *power;
                sum[2] += *power * blow.contact_radius_m.powi(2);
            }
            let Some(places_m) = places_m else { continue };
            for ((receiver, bins), sums) in self.receivers.iter().zip(bins).zip(&mut listed) {
                let distance_m = distance_m(places_m[i], receiver.place_m);
                if distance_m >= self.nearest_m {
                    bins.add(sums, distance_m, &powers);
                }
            }
        }
        (sums, listed)
    }

    /// Adds the errors of the forces.
    fn add_errors(&self, errors: &mut Errors, frequency_hz: f64, forces: &Forces) {
        let [power, square, sized] = *forces;
        let count = self.blows.len() as f64;
        let spread = (count * square / (power * power) - 1.0).max(0.0);
        errors.sampling = match &self.source {
            Source::Poisson { .. } if power > 0.0 => (spread / count).sqrt(),
            Source::Poisson { .. } | Source::Listed { .. } => 0.0,
        };
        errors.pulses = self.pulses.error(&self.blows, frequency_hz);
        let k = TAU * frequency_hz / self.ground.rayleigh_speed_m_s(frequency_hz);
        errors.contact_size = CONTACT_SIZE * k * k * sized / power.max(f64::MIN_POSITIVE);
    }
}

/// Distances in m at which the share of nearer impacts is stated.
fn edges(depth_m: f64, [low, high]: [f64; 2]) -> Vec<f64> {
    /// The first edge of a receiver in or below the impacts, over its depth or the size of the area.
    const CLOSE: [f64; 2] = [0.1, 1e-3];
    let from = low
        .max((CLOSE[0] * depth_m).min(0.5 * high))
        .max(CLOSE[1] * high);
    let part = |i: usize| i as f64 / (SHARES - 1) as f64;
    (0..SHARES)
        .map(|i| from * (high / from).powf(part(i)))
        .collect()
}

/// The row of impacts whose power |F|^2 is that at nodes in distance.
fn summed(at: &AtFrequency<'_>, bins: &Bins, powers: &[f64], edges_m: &[f64]) -> Row {
    let mut row = Row::new(edges_m.len());
    let responses = (0..powers.len()).map(|i| at.power(bins.node_m(i as f64)));
    let responses: Vec<[f64; 2]> = responses.collect();
    for (i, (power, response)) in powers.iter().zip(&responses).enumerate() {
        let (distance_m, own) = (
            bins.node_m(i as f64),
            response.map(|response| power * response),
        );
        row.power = [0, 1].map(|c| row.power[c] + own[c]);
        row.errors.response += own[1] * at.error(distance_m);
        for (share, edge) in row.share.iter_mut().zip(edges_m) {
            *share += if distance_m <= *edge { own[1] } else { 0.0 };
        }
    }
    // the interpolation in the middle between nodes is as wrong as anywhere
    for (i, around) in responses.windows(4).enumerate() {
        let terms = cubic(0.5).into_iter().zip(around);
        let between: f64 = terms.map(|(weight, node)| weight * node[1]).sum();
        let exact = at.power(bins.node_m(i as f64 + 1.5))[1];
        row.errors.quadrature += powers[i + 1].abs() * (between - exact).abs();
    }
    row.over_power();
    row
}

/// The integral over an area around a receiver.
struct Cuts<'a> {
    area: &'a Area,
    receiver: &'a Receiver,
    ends_m: [f64; 2],
    edges_m: &'a [f64],
}

impl Cuts<'_> {
    /// The row, with `factor` in front of the integral.
    fn row(&self, at: &AtFrequency<'_>, factor: f64) -> Row {
        let [low, high] = self.ends_m;
        let breaks = self.area.breaks(self.receiver.place_m);
        let mut cuts: Vec<f64> = breaks
            .into_iter()
            .chain(self.edges_m.iter().copied())
            .collect();
        cuts.extend(self.ends_m);
        cuts.retain(|cut| (low..=high).contains(cut));
        cuts.sort_by(f64::total_cmp);
        let mut row = Row::new(self.edges_m.len());
        let mut coarse = 0.0;
        for ends in cuts.windows(2).filter(|ends| ends[1] > ends[0]) {
            let [own, other] = self.between([ends[0], ends[1]], at);
            row.power = [0, 1].map(|c| row.power[c] + factor * own[c]);
            row.errors.response += factor * own[2];
            coarse += factor * other[1];
            for (share, edge) in row.share.iter_mut().zip(self.edges_m) {
                *share += if ends[1] <= *edge {
                    factor * own[1]
                } else {
                    0.0
                };
            }
        }
        row.errors.quadrature = (coarse - row.power[1]).abs();
        row.over_power();
        row
    }

    /// The integrals of |G|^2, and of its error downwards, between two distances by both rules.
    fn between(&self, [from, to]: [f64; 2], at: &AtFrequency<'_>) -> [[f64; 3]; 2] {
        let above = |r: f64| r.max(self.receiver.depth_m * 0.5).max(f64::MIN_POSITIVE);
        let octaves = (above(to) / above(from)).log(RATIO);
        let beats = at.wave_number * (to - from) / BEAT;
        let count = octaves.max(beats).ceil().max(1.0) as usize;
        NODES.map(|nodes| {
            let mut sum = [0.0; 3];
            for i in 0..count {
                let end = |i: usize| from + (to - from) * i as f64 / count as f64;
                let [middle, half] = [0.5 * (end(i) + end(i + 1)), 0.5 * (end(i + 1) - end(i))];
                // arcs begin and end like square roots, which steps of a cosine make smooth
                for (angle, weight) in rule(nodes).on(0.0, PI) {
                    let r = middle - half * angle.cos();
                    let width =
                        weight * half * angle.sin() * r * self.area.arc(self.receiver.place_m, r);
                    let [across, down] = at.power(r);
                    let terms = [across, down, down * at.error(r)];
                    sum = [0, 1, 2].map(|c| sum[c] + width * terms[c]);
                }
            }
            sum
        })
    }
}
