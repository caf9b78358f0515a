//! Fields at the probes and on a meridional section.

use super::ImpactError;
use super::grid::Grid;
use crate::convolve::{CellPlan, Convolver, KernelSource, Place};
use crate::scene::Scene;
use crate::units::KernelUnits;
use halfspace::{Arrivals, Medium, Profile};
use lookup::Smoothness;
use rayon::prelude::*;

/// Fields at the probes in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Fields {
    /// Distances from the axis in m.
    pub r_m: Vec<f64>,
    /// Depths in m.
    pub z_m: Vec<f64>,
    /// Times of the first P, S and Rayleigh arrival in s, one row a probe.
    pub arrival_s: Vec<[f64; 3]>,
    /// Samples of each field (order of [`halfspace::FIELDS`]), one row a probe.
    pub values: [Vec<Vec<f64>>; 6],
    /// Estimated error of each field, one value a probe.
    pub errors: [Vec<f64>; 6],
}

/// Fields on a meridional section in SI units.
///
/// Depth comes before radius, and the deepest row first, so that a picture has the surface on top.
#[derive(Debug, Clone, PartialEq)]
pub struct MapFields {
    /// Distances from the axis in m, ascending.
    pub r_m: Vec<f64>,
    /// Depths in m, descending.
    pub z_m: Vec<f64>,
    /// Times of the frames in s.
    pub time_s: Vec<f64>,
    /// Times of the first P, S and Rayleigh arrival in s at each point.
    pub arrival_s: [Vec<f64>; 3],
    /// Each field (order of [`halfspace::FIELDS`]): frames, depths, radii.
    pub values: [Vec<f32>; 6],
    /// Estimated error of each field at each point.
    pub errors: [Vec<f64>; 6],
}

/// A load on a half-space whose fields are asked for.
pub(super) struct Load<'a> {
    pub(super) source: &'a KernelSource,
    pub(super) units: &'a KernelUnits,
    pub(super) medium: &'a Medium,
    pub(super) grid: &'a Grid,
    pub(super) force_n: &'a [f64],
    /// Relative error of the force.
    pub(super) force_error: f64,
    /// How the force is taken between its samples, and the error of that in N.
    pub(super) between_samples: (Smoothness, f64),
}

/// What a scene asks for: probes, section, and how they were summed.
pub(super) type All = (Option<Fields>, Option<MapFields>, &'static str);

/// All fields that a scene asks for.
pub(super) fn all_fields(scene: &Scene, load: Option<&Load<'_>>) -> Result<All, ImpactError> {
    let Some(load) = load else {
        return Ok((None, None, ""));
    };
    let probes = if scene.probes.is_empty() {
        None
    } else {
        Some(load.probes(scene)?)
    };
    let (map, method) = match &scene.map {
        Some(map) => {
            let (section, method) = load.section(map)?;
            (Some(section), method)
        }
        None => (None, Convolver::new(load.force_n).method()),
    };
    Ok((probes, map, method))
}

/// The fields at one point.
struct Point {
    arrival_s: [f64; 3],
    values: [Vec<f64>; 6],
    errors: [f64; 6],
}

impl Load<'_> {
    /// At all samples of the probes.
    pub(super) fn probes(&self, scene: &Scene) -> Result<Fields, ImpactError> {
        let convolver = Convolver::new(self.force_n);
        let points: Vec<Point> = scene
            .probes
            .par_iter()
            .map(|probe| self.point(&convolver, probe.r_m, probe.z_m))
            .collect::<Result<_, _>>()?;
        let mut fields = Fields {
            r_m: scene.probes.iter().map(|p| p.r_m).collect(),
            z_m: scene.probes.iter().map(|p| p.z_m).collect(),
            arrival_s: Vec::new(),
            values: Default::default(),
            errors: Default::default(),
        };
        for point in points {
            fields.arrival_s.push(point.arrival_s);
            for (field, samples) in point.values.into_iter().enumerate() {
                fields.errors[field].push(point.errors[field]);
                fields.values[field].push(samples);
            }
        }
        Ok(fields)
    }

    /// On the section, at the samples nearest to its frames; and how the sum was done.
    pub(super) fn section(
        &self,
        map: &crate::scene::Map,
    ) -> Result<(MapFields, &'static str), ImpactError> {
        let last = self.force_n.len() - 1;
        let frame = |i: usize| {
            (i as f64 * last as f64 / (map.frames as f64 - 1.0).max(1.0)).round() as usize
        };
        let wanted: Vec<usize> = (0..map.frames).map(frame).collect();
        let time_s = wanted.iter().map(|&n| n as f64 * self.grid.step_s);
        let even =
            |end: f64, count: usize| (0..count).map(move |i| end * i as f64 / (count as f64 - 1.0));
        let r_m: Vec<f64> = even(map.r_max_m, map.points[0]).collect();
        let mut z_m: Vec<f64> = even(map.z_max_m, map.points[1]).collect();
        z_m.reverse();
        let mut section = MapFields {
            time_s: time_s.collect(),
            arrival_s: Default::default(),
            values: std::array::from_fn(|_| vec![0.0; map.frames * r_m.len() * z_m.len()]),
            errors: Default::default(),
            r_m,
            z_m,
        };
        let convolver = Convolver::at(self.force_n, wanted);
        let (radii, size) = (section.r_m.len(), section.r_m.len() * section.z_m.len());
        for (row, &z_m) in section.z_m.iter().enumerate() {
            let points: Vec<Point> = section
                .r_m
                .par_iter()
                .map(|&r_m| self.point(&convolver, r_m, z_m))
                .collect::<Result<_, _>>()?;
            for (column, point) in points.into_iter().enumerate() {
                for (times, time) in section.arrival_s.iter_mut().zip(point.arrival_s) {
                    times.push(time);
                }
                let place = row * radii + column;
                for (field, samples) in point.values.iter().enumerate() {
                    section.errors[field].push(point.errors[field]);
                    for (frame, &value) in samples.iter().enumerate() {
                        section.values[field][frame * size + place] = value as f32;
                    }
                }
            }
        }
        Ok((section, convolver.method()))
    }

    fn point(&self, convolver: &Convolver, r_m: f64, z_m: f64) -> Result<Point, ImpactError> {
        let (units, grid) = (self.units, self.grid);
        let radius = units.disc_radius_m;
        let place = Place {
            r: r_m / radius,
            z: z_m / radius,
            disc_radius_m: radius,
        };
        let (smoothness, sampling) = self.between_samples;
        let plan = CellPlan {
            step: grid.step_s / units.time_s(),
            coarsening: grid.coarsening,
            count: grid.count,
            smoothness,
            pulse_length: grid.pulse_s / units.time_s(),
        };
        let cells = self
            .source
            .cells(self.medium.poisson_ratio(), place, plan)?;
        let arrivals = Arrivals::new(self.medium, Profile::Hertz, place.r, place.z)?;
        let direct = arrivals.above.unwrap_or([arrivals.p[0], arrivals.s[0]]);
        let first = [direct[0], direct[1], arrivals.rayleigh[0]];
        let mut values = convolver.fields(&cells.static_part, &cells.averages);
        let variation = cells.variation();
        let peak = self.force_n.iter().fold(0.0_f64, |m, p| m.max(p.abs()));
        let mut errors = [0.0; 6];
        for (field, samples) in values.iter_mut().enumerate() {
            let unit = if field < 2 {
                units.displacement_m_per_n()
            } else {
                units.stress_pa_per_n()
            };
            let mut largest = 0.0_f64;
            for value in samples {
                *value *= unit;
                largest = largest.max(value.abs());
            }
            let kernel = cells.error[field] * peak + variation[field] * sampling;
            errors[field] = kernel * unit + self.force_error * largest;
        }
        Ok(Point {
            arrival_s: first.map(|t| t * units.time_s()),
            values,
            errors,
        })
    }
}
