//! Fields at the probes of a scene and on its meridional section.

use crate::error::FieldsError;
use crate::evaluator::{AtPoint, Evaluator};
use crate::fields::quantity::Quantity;
use crate::scene::{Probe, Section};
use contact::HalfSpace;
use rayon::prelude::*;

/// Fields at the probes in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct ProbeFields {
    /// Distances from the axis in m.
    pub r_m: Vec<f64>,
    /// Depths in m.
    pub z_m: Vec<f64>,
    /// Times of the first P, S and Rayleigh arrival in s, one row a probe; infinite for a Rayleigh wave where there is
    /// none.
    pub arrival_s: Vec<[f64; 3]>,
    /// When the first echo from the faces of the block arrives, in s, one a probe; infinite where no face is known.
    pub valid_until_s: Vec<f64>,
    /// Samples of each field (order of [`halfspace::FIELDS`]), one row a probe.
    pub values: [Vec<Vec<f64>>; 6],
    /// Estimated error of each field, one value a probe.
    pub errors: [Vec<f64>; 6],
    /// The quantities that the scene asks for beside the fields.
    pub more: Vec<ProbeQuantity>,
}

/// A quantity at the probes, in its SI unit.
#[derive(Debug, Clone, PartialEq)]
pub struct ProbeQuantity {
    /// Which.
    pub quantity: Quantity,
    /// Samples, one row a probe.
    pub values: Vec<Vec<f64>>,
    /// Estimated error, one value a probe.
    pub errors: Vec<f64>,
}

/// Fields on a meridional section in SI units.
///
/// Depth comes before radius, and the deepest row first, so that a picture has the surface on top.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionFields {
    /// Distances from the axis in m, ascending.
    pub r_m: Vec<f64>,
    /// Depths in m, descending.
    pub z_m: Vec<f64>,
    /// Times of the frames in s.
    pub time_s: Vec<f64>,
    /// Times of the first P, S and Rayleigh arrival in s at each point; infinite for a Rayleigh wave where there is
    /// none.
    pub arrival_s: [Vec<f64>; 3],
    /// Each field (order of [`halfspace::FIELDS`]): frames, depths, radii.
    pub values: [Vec<f32>; 6],
    /// Estimated error of each field at each point.
    pub errors: [Vec<f64>; 6],
    /// The quantities that the scene asks for beside the fields.
    pub more: Vec<SectionQuantity>,
    /// Largest values over all samples in time, of each field and then of each quantity, where the scene asks for them.
    pub peaks: Option<Vec<Peaks>>,
}

/// A quantity on the section, in its SI unit.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionQuantity {
    /// Which.
    pub quantity: Quantity,
    /// Frames, depths, radii.
    pub values: Vec<f32>,
    /// Estimated error at each point.
    pub errors: Vec<f64>,
}

/// Where a history is largest in magnitude.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Peaks {
    /// The value there, with its sign, at each place.
    pub values: Vec<f64>,
    /// When, in s.
    pub time_s: Vec<f64>,
}

impl Peaks {
    /// Adds the peak of the next place.
    pub fn push(&mut self, time_s: &[f64], samples: &[f64]) {
        let larger = |most: usize, i: usize| {
            if samples[i].abs() > samples[most].abs() {
                i
            } else {
                most
            }
        };
        let most = (0..samples.len()).fold(0, larger);
        self.values.push(samples.get(most).copied().unwrap_or(0.0));
        self.time_s.push(time_s.get(most).copied().unwrap_or(0.0));
    }
}

impl ProbeFields {
    /// What the user should know of echoes in an output that ends at a time in s.
    pub(crate) fn echoes(&self, end_s: f64) -> Option<String> {
        let echoing = self.valid_until_s.iter().enumerate();
        let echoing: Vec<(usize, f64)> = echoing
            .map(|(i, &valid_s)| (i, valid_s))
            .filter(|(_, valid_s)| *valid_s < end_s)
            .collect();
        let sooner = |a: (usize, f64), b: (usize, f64)| if b.1 < a.1 { b } else { a };
        let first = echoing.iter().copied().reduce(sooner)?;
        Some(format!(
            "echoes from the faces of the block reach {} of {} probes before the output ends at {end_s:.4e} s, probe {} first, at {:.4e} s: what follows there is that of a half-space, not of the block",
            echoing.len(),
            self.r_m.len(),
            first.0 + 1,
            first.1
        ))
    }
}

/// The fields at probes, at the samples that are wanted.
pub(crate) fn at_probes(
    evaluator: &Evaluator<'_>,
    block: &HalfSpace,
    probes: &[Probe],
) -> Result<ProbeFields, FieldsError> {
    let found: Vec<AtPoint> = probes
        .par_iter()
        .map(|probe| evaluator.at(probe.r_m, probe.z_m))
        .collect::<Result<_, _>>()?;
    let blank = |&quantity: &Quantity| ProbeQuantity {
        quantity,
        values: Vec::new(),
        errors: Vec::new(),
    };
    let mut fields = ProbeFields {
        r_m: probes.iter().map(|p| p.r_m).collect(),
        z_m: probes.iter().map(|p| p.z_m).collect(),
        arrival_s: Vec::new(),
        valid_until_s: Vec::new(),
        values: Default::default(),
        errors: Default::default(),
        more: evaluator.asked.quantities.iter().map(blank).collect(),
    };
    let excitation = evaluator.asked.excitation;
    let (speeds, radius_m) = (excitation.speeds(), excitation.units().disc_radius_m);
    for (AtPoint { values, errors }, probe) in found.into_iter().zip(probes) {
        let place_m = [probe.r_m, probe.z_m];
        fields.arrival_s.push(excitation.arrivals_s(place_m));
        let echo_s = speeds.first_echo_s(block, place_m, radius_m);
        let valid_s = echo_s.map_or(f64::INFINITY, |t| excitation.start_s() + t);
        fields.valid_until_s.push(valid_s);
        for (i, (samples, error)) in values.into_iter().zip(errors).enumerate() {
            let (own, own_errors) = match i.checked_sub(6) {
                None => (&mut fields.values[i], &mut fields.errors[i]),
                Some(i) => {
                    let more = &mut fields.more[i];
                    (&mut more.values, &mut more.errors)
                }
            };
            own.push(samples);
            own_errors.push(error);
        }
    }
    Ok(fields)
}

/// The samples of a force nearest to the frames of a section.
pub(crate) fn frames(section: &Section, samples: usize) -> Vec<usize> {
    let last = samples.saturating_sub(1) as f64;
    let gaps = (section.frames as f64 - 1.0).max(1.0);
    let frame = |i: usize| (i as f64 * last / gaps).round() as usize;
    (0..section.frames).map(frame).collect()
}

/// The fields on a section; `frames` are places among the samples that are wanted, all of which count for `peaks`.
pub(crate) fn on_section(
    evaluator: &Evaluator<'_>,
    (section, frames): (&Section, &[usize]),
    peaks: bool,
) -> Result<SectionFields, FieldsError> {
    let all_s = evaluator.times_s();
    let quantities = evaluator.asked.quantities;
    let even =
        |end: f64, count: usize| (0..count).map(move |i| end * i as f64 / (count as f64 - 1.0));
    let r_m: Vec<f64> = even(section.r_max_m, section.points[0]).collect();
    let mut z_m: Vec<f64> = even(section.z_max_m, section.points[1]).collect();
    z_m.reverse();
    let (radii, size) = (r_m.len(), r_m.len() * z_m.len());
    let blank = |&quantity: &Quantity| SectionQuantity {
        quantity,
        values: vec![0.0; frames.len() * size],
        errors: Vec::new(),
    };
    let mut fields = SectionFields {
        time_s: frames.iter().map(|&n| all_s[n]).collect(),
        arrival_s: Default::default(),
        values: std::array::from_fn(|_| vec![0.0; frames.len() * size]),
        errors: Default::default(),
        more: quantities.iter().map(blank).collect(),
        peaks: peaks.then(|| vec![Peaks::default(); 6 + quantities.len()]),
        r_m,
        z_m,
    };
    for row in 0..fields.z_m.len() {
        let z_m = fields.z_m[row];
        let found: Vec<AtPoint> = fields
            .r_m
            .par_iter()
            .map(|&r_m| evaluator.at(r_m, z_m))
            .collect::<Result<_, _>>()?;
        for (column, at_point) in found.into_iter().enumerate() {
            let place_m = [fields.r_m[column], z_m];
            let arrivals = evaluator.asked.excitation.arrivals_s(place_m);
            for (times, time) in fields.arrival_s.iter_mut().zip(arrivals) {
                times.push(time);
            }
            let place = row * radii + column;
            fields.add((&all_s, frames), (place, size), &at_point);
        }
    }
    Ok(fields)
}

impl SectionFields {
    /// Adds what was found at a place of `size` places.
    fn add(
        &mut self,
        (all_s, frames): (&[f64], &[usize]),
        (place, size): (usize, usize),
        AtPoint { values, errors }: &AtPoint,
    ) {
        let put = |values: &mut [f32], samples: &[f64]| {
            for (frame, &n) in frames.iter().enumerate() {
                values[frame * size + place] = samples[n] as f32;
            }
        };
        for (i, (samples, &error)) in values.iter().zip(errors).enumerate() {
            let (own, own_errors) = match i.checked_sub(6) {
                None => (&mut self.values[i], &mut self.errors[i]),
                Some(i) => {
                    let more = &mut self.more[i];
                    (&mut more.values, &mut more.errors)
                }
            };
            put(own, samples);
            own_errors.push(error);
        }
        for (peaks, samples) in self.peaks.iter_mut().flatten().zip(values) {
            peaks.push(all_s, samples);
        }
    }
}
