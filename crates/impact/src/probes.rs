//! Fields at the probes of a scene and on its meridional section.

use crate::error::FieldsError;
use crate::excitation::Excitation;
use crate::sampled::{Point, Sampled};
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
}

impl ProbeFields {
    /// What the user should know of echoes in an output that ends at a time in s.
    pub(crate) fn echoes(&self, end_s: f64) -> Option<String> {
        let echoing = self.valid_until_s.iter().enumerate();
        let echoing: Vec<(usize, f64)> = echoing
            .map(|(i, &valid_s)| (i, valid_s))
            .filter(|(_, valid_s)| *valid_s < end_s)
            .collect();
        let first = echoing
            .iter()
            .copied()
            .reduce(|a, b| if b.1 < a.1 { b } else { a })?;
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
    sampled: &Sampled<'_>,
    excitation: &Excitation,
    block: &HalfSpace,
    probes: &[Probe],
) -> Result<ProbeFields, FieldsError> {
    let points: Vec<Point> = probes
        .par_iter()
        .map(|probe| sampled.point(probe.r_m, probe.z_m))
        .collect::<Result<_, _>>()?;
    let mut fields = ProbeFields {
        r_m: probes.iter().map(|p| p.r_m).collect(),
        z_m: probes.iter().map(|p| p.z_m).collect(),
        arrival_s: Vec::new(),
        valid_until_s: Vec::new(),
        values: Default::default(),
        errors: Default::default(),
    };
    let (speeds, radius_m) = (excitation.speeds(), excitation.units().disc_radius_m);
    for (point, probe) in points.into_iter().zip(probes) {
        let place_m = [probe.r_m, probe.z_m];
        fields.arrival_s.push(excitation.arrivals_s(place_m));
        let echo_s = speeds.first_echo_s(block, place_m, radius_m);
        let valid_s = echo_s.map_or(f64::INFINITY, |t| excitation.start_s() + t);
        fields.valid_until_s.push(valid_s);
        for (field, samples) in point.values.into_iter().enumerate() {
            fields.errors[field].push(point.errors[field]);
            fields.values[field].push(samples);
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

/// The fields on a section, at the samples that are wanted.
pub(crate) fn on_section(
    sampled: &Sampled<'_>,
    excitation: &Excitation,
    section: &Section,
) -> Result<SectionFields, FieldsError> {
    let time_s: Vec<f64> = sampled.times_s().collect();
    let even =
        |end: f64, count: usize| (0..count).map(move |i| end * i as f64 / (count as f64 - 1.0));
    let r_m: Vec<f64> = even(section.r_max_m, section.points[0]).collect();
    let mut z_m: Vec<f64> = even(section.z_max_m, section.points[1]).collect();
    z_m.reverse();
    let (radii, size) = (r_m.len(), r_m.len() * z_m.len());
    let frames = time_s.len();
    let mut fields = SectionFields {
        time_s,
        arrival_s: Default::default(),
        values: std::array::from_fn(|_| vec![0.0; frames * size]),
        errors: Default::default(),
        r_m,
        z_m,
    };
    for row in 0..fields.z_m.len() {
        let z_m = fields.z_m[row];
        let points: Vec<Point> = fields
            .r_m
            .par_iter()
            .map(|&r_m| sampled.point(r_m, z_m))
            .collect::<Result<_, _>>()?;
        for (column, point) in points.into_iter().enumerate() {
            let arrivals = excitation.arrivals_s([fields.r_m[column], z_m]);
            for (times, time) in fields.arrival_s.iter_mut().zip(arrivals) {
                times.push(time);
            }
            let place = row * radii + column;
            for (field, samples) in point.values.iter().enumerate() {
                fields.errors[field].push(point.errors[field]);
                for (frame, &value) in samples.iter().enumerate() {
                    fields.values[field][frame * size + place] = value as f32;
                }
            }
        }
    }
    Ok(fields)
}
