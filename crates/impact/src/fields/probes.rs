//! Fields at the probes of a scene and on its meridional section, and their largest values over time.

use crate::convolution::{Convolution, Trace};
use crate::cost::Forecast;
use crate::error::{ImpactError, finite};
use crate::excitation::Excitation;
use crate::fields::peaks::{Peak, peaks};
use crate::grid::{Grid, Wanted};
use crate::kernels::KernelSource;
use crate::quantity::Quantity;
use crate::scene::{Probe, Scene, Section};
use crate::source::{KernelChoice, choose_source};
use contact::HalfSpace;
use rayon::prelude::*;
use std::ops::Range;

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
    /// When the waves of a plate arrive that have run between its faces, until the output ends.
    pub echoes: EchoArrivals,
    /// The requested quantities in addition to the fields.
    pub quantities: Vec<Quantity>,
    /// Samples of each field (order of [`halfspace::FIELDS`]) and then of each quantity, one row a probe.
    pub values: Vec<Vec<Vec<f64>>>,
    /// Estimated error of each, one value a probe.
    pub errors: Vec<Vec<f64>>,
    /// Largest values over continuous time of each, where the scene asks for them.
    pub peaks: Option<Vec<Peaks>>,
}

/// Arrivals of the waves of a plate that have run between its faces; none on a half-space.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct EchoArrivals {
    /// A P or an S for each leg of a wave, P first where the order does not matter, and for the last part of one that ends between
    /// the faces: "PPS".
    pub names: Vec<String>,
    /// The first arrival of each in s, one row a probe; infinite where it does not arrive.
    pub time_s: Vec<Vec<f64>>,
}

impl EchoArrivals {
    /// Of probes, each with names and times in s after the load begins, until an end.
    fn new(rows: &[Vec<(String, f64)>], [start_s, end_s]: [f64; 2]) -> Self {
        let within = |time_s: f64| start_s + time_s <= end_s;
        let mut all: Vec<&(String, f64)> = rows.iter().flatten().collect();
        all.sort_by(|one, other| one.1.total_cmp(&other.1));
        let mut names: Vec<String> = Vec::new();
        for (name, time_s) in all {
            if within(*time_s) && !names.contains(name) {
                names.push(name.clone());
            }
        }
        let of = |row: &Vec<(String, f64)>, name: &String| {
            let found = row
                .iter()
                .find(|(own, time_s)| own == name && within(*time_s));
            found.map_or(f64::INFINITY, |(_, time_s)| start_s + time_s)
        };
        let row = |row: &Vec<(String, f64)>| names.iter().map(|name| of(row, name)).collect();
        Self {
            time_s: rows.iter().map(row).collect(),
            names,
        }
    }
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
    /// The requested quantities in addition to the fields.
    pub quantities: Vec<Quantity>,
    /// Each field (order of [`halfspace::FIELDS`]) and then each quantity: frames, depths, radii.
    pub values: Vec<Vec<f32>>,
    /// Estimated error of each at each point.
    pub errors: Vec<Vec<f64>>,
    /// Largest values over continuous time of each, where the scene asks for them.
    pub peaks: Option<Vec<Peaks>>,
}

/// Where a history is largest in magnitude, between its samples too.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Peaks {
    /// The value there, with its sign, at each place.
    pub values: Vec<f64>,
    /// When, in s.
    pub time_s: Vec<f64>,
    /// Estimated absolute error of the value.
    pub errors: Vec<f64>,
}

impl Peaks {
    /// Adds the peak of the next place.
    fn push(&mut self, peak: Peak) {
        self.values.push(peak.value);
        self.time_s.push(peak.time_s);
        self.errors.push(peak.error);
    }
}

/// The outputs at a point with their peaks, if these are asked for.
fn with_peaks(
    convolution: &Convolution<'_>,
    place_m: [f64; 2],
    all_s: Option<&[f64]>,
) -> Result<(Vec<Trace>, Vec<Peak>), ImpactError> {
    let point = convolution.point(place_m)?;
    let traces = convolution.sampled(&point)?;
    let peaks = all_s.map(|all_s| peaks(convolution, &point, all_s, &traces));
    Ok((traces, peaks.transpose()?.unwrap_or_default()))
}

/// The fields at probes, at the samples that are wanted.
pub(crate) fn at_probes(
    convolution: &Convolution<'_>,
    block: &HalfSpace,
    (probes, asks_peaks): (&[Probe], bool),
) -> Result<ProbeFields, ImpactError> {
    let all_s = asks_peaks.then(|| convolution.times_s());
    let of = |probe: &Probe| with_peaks(convolution, [probe.r_m, probe.z_m], all_s.as_deref());
    let found: Vec<_> = probes.par_iter().map(of).collect::<Result<_, _>>()?;
    let quantities = convolution.quantities.to_vec();
    let count = 6 + quantities.len();
    let mut fields = ProbeFields {
        r_m: probes.iter().map(|p| p.r_m).collect(),
        z_m: probes.iter().map(|p| p.z_m).collect(),
        arrival_s: Vec::new(),
        valid_until_s: Vec::new(),
        echoes: EchoArrivals::default(),
        quantities,
        values: vec![Vec::new(); count],
        errors: vec![Vec::new(); count],
        peaks: asks_peaks.then(|| vec![Peaks::default(); count]),
    };
    let excitation = convolution.grid.excitation;
    let (speeds, radius_m) = (excitation.speeds(), excitation.units().disc_radius_m);
    for ((found, peaks), probe) in found.into_iter().zip(probes) {
        for (all, peak) in fields.peaks.iter_mut().flatten().zip(peaks) {
            all.push(peak);
        }
        let place_m = [probe.r_m, probe.z_m];
        fields.arrival_s.push(excitation.arrivals_s(place_m));
        let echo_s = speeds.first_echo_s(block, place_m, radius_m);
        let valid_s = echo_s.map_or(f64::INFINITY, |t| excitation.start_s() + t);
        fields.valid_until_s.push(valid_s);
        for (quantity, trace) in found.into_iter().enumerate() {
            fields.values[quantity].push(trace.samples);
            fields.errors[quantity].push(trace.error);
        }
    }
    let of = |probe: &Probe| speeds.echoes_s(block, [probe.r_m, probe.z_m], radius_m);
    let rows: Vec<_> = probes.iter().map(of).collect();
    let end_s = convolution.times_s().last().copied().unwrap_or(0.0);
    fields.echoes = EchoArrivals::new(&rows, [excitation.start_s(), end_s]);
    Ok(fields)
}

/// The samples nearest to the frames of a section, evenly over all or at its own times; one for times that have the same.
///
/// # Errors
/// [`ImpactError::LateFrame`] for a time after the last sample.
pub(crate) fn frames(section: &Section, time_s: &[f64]) -> Result<Vec<usize>, ImpactError> {
    let last = time_s.len().saturating_sub(1);
    if section.times_s.is_empty() {
        let gaps = (section.frames as f64 - 1.0).max(1.0);
        let frame = |i: usize| (i as f64 * last as f64 / gaps).round() as usize;
        return Ok((0..section.frames).map(frame).collect());
    }
    let frame = |&wanted_s: &f64| {
        let after = time_s.partition_point(|&t| t < wanted_s);
        let end_s = time_s.get(last).copied().unwrap_or(0.0);
        if after > last {
            return Err(ImpactError::LateFrame { wanted_s, end_s });
        }
        let before = after.saturating_sub(1);
        let is_before = wanted_s - time_s[before] < time_s[after] - wanted_s;
        Ok(if is_before { before } else { after })
    };
    let found: Result<Vec<usize>, _> = section.times_s.iter().map(frame).collect();
    let mut found = found?;
    found.dedup();
    Ok(found)
}

/// The fields on some rows of a section, counted from its deepest; `frames` are places among the samples that are wanted, all of
/// which count for `peaks`.
pub(crate) fn on_rows(
    convolution: &Convolution<'_>,
    (section, frames): (&Section, &[usize]),
    rows: Range<usize>,
    peaks: bool,
) -> Result<SectionFields, ImpactError> {
    let all_s = convolution.times_s();
    let quantities = convolution.quantities.to_vec();
    let even =
        |end: f64, count: usize| (0..count).map(move |i| end * i as f64 / (count as f64 - 1.0));
    let r_m: Vec<f64> = even(section.r_max_m, section.points[0]).collect();
    let mut z_m: Vec<f64> = even(section.z_max_m, section.points[1]).collect();
    z_m.reverse();
    z_m.truncate(rows.end);
    z_m.drain(..rows.start.min(z_m.len()));
    let (radii, size) = (r_m.len(), r_m.len() * z_m.len());
    let count = 6 + quantities.len();
    let mut fields = SectionFields {
        time_s: frames.iter().map(|&n| all_s[n]).collect(),
        arrival_s: Default::default(),
        quantities,
        values: vec![vec![0.0; frames.len() * size]; count],
        errors: vec![Vec::new(); count],
        peaks: peaks.then(|| vec![Peaks::default(); count]),
        r_m,
        z_m,
    };
    for row in 0..fields.z_m.len() {
        let z_m = fields.z_m[row];
        let of = |&r_m: &f64| with_peaks(convolution, [r_m, z_m], peaks.then_some(&all_s[..]));
        let found: Vec<_> = fields.r_m.par_iter().map(of).collect::<Result<_, _>>()?;
        for (column, (found, peaks)) in found.into_iter().enumerate() {
            for (all, peak) in fields.peaks.iter_mut().flatten().zip(peaks) {
                all.push(peak);
            }
            let place_m = [fields.r_m[column], z_m];
            let arrivals = convolution.grid.excitation.arrivals_s(place_m);
            for (times, time) in fields.arrival_s.iter_mut().zip(arrivals) {
                times.push(time);
            }
            let place = row * radii + column;
            for (quantity, Trace { samples, error, .. }) in found.into_iter().enumerate() {
                for (frame, &n) in frames.iter().enumerate() {
                    fields.values[quantity][frame * size + place] = samples[n] as f32;
                }
                fields.errors[quantity].push(error);
            }
        }
    }
    Ok(fields)
}

/// Fields at the probes of a scene, each by its peak.
#[derive(Debug, Clone, PartialEq)]
pub struct ProbePeaks {
    /// Whether the kernels were looked up rather than computed.
    pub looked_up: bool,
    /// Of each probe each of the six fields and then each quantity of the scene.
    pub peaks: Vec<Peak>,
}

/// Memory in bytes that the fields of one row may take.
const MOST_BYTES: f64 = 1e9;

/// The peaks of the fields of an excitation at the probes of a scene.
///
/// # Errors
/// [`ImpactError`].
pub(crate) fn peaks_at_probes(
    scene: &Scene,
    kernels: &KernelChoice,
    excitation: &Excitation,
) -> Result<ProbePeaks, ImpactError> {
    match choose_source(scene, kernels, excitation)? {
        None => Ok(ProbePeaks {
            looked_up: false,
            peaks: Vec::new(),
        }),
        Some((source, _)) => peaks_from(scene, &source, excitation),
    }
}

fn peaks_from(
    scene: &Scene,
    source: &KernelSource,
    excitation: &Excitation,
) -> Result<ProbePeaks, ImpactError> {
    let mut found = ProbePeaks {
        looked_up: matches!(source, KernelSource::Table(_)),
        peaks: Vec::new(),
    };
    let grid = Grid::new(&Wanted::of(scene), excitation, Some(source))?;
    // on its own thread: whether a row fails depends on the row alone
    Forecast::new(scene, &grid, Some(source), 1.0).check(scene, MOST_BYTES)?;
    let time_s: Vec<f64> = grid.times_s().collect();
    let wanted: Vec<usize> = (0..time_s.len()).collect();
    let asked = (&scene.quantities[..], Some(&scene.target));
    let convolution = Convolution::new(source, &grid, &wanted, asked, &|| {})?;
    for probe in &scene.probes {
        let (_, peaks) = with_peaks(&convolution, [probe.r_m, probe.z_m], Some(&time_s))?;
        found.peaks.extend(peaks);
    }
    let peaks = found.peaks.iter();
    let peaks = peaks.flat_map(|one| [one.value, one.time_s, one.error]);
    finite(|| "the peak of a field at a probe".to_owned(), peaks)?;
    Ok(found)
}
