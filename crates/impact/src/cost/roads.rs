//! The road of each point of a scene, as its plan has it, and the time that it takes.
//!
//! Constants are seconds of one thread, measured with the jobs of `scripts/time-impacts`.

use crate::convolution::echoes::image_m;
use crate::convolution::plan::{PointPlan, Sets};
use crate::excitation::PressureRadius;
use crate::face::{MeanPlan, plans};
use crate::grid::Grid;
use crate::quantity::Derivative;
use crate::sampled::convolve::{direct_ns, transform_ns};
use crate::scene::{Scene, Section};

/// A kernel, and kernels of a trace whatever its tolerance, and for each digit; for fields with rates so many times more.
const KERNEL_S: f64 = 4e-6;
const KERNELS: f64 = 16.0;
const KERNELS_A_DIGIT: f64 = 16.0;
const WITH_RATES: f64 = 1.5;

/// A trace with attenuation over one without.
const DAMPED: f64 = 2.5;

/// Moments of a cell, and the lookup of a cell.
const CELL_S: f64 = 4e-7;
const LOOKED_UP_S: f64 = 1.5e-7;

/// A static field, and a step response at an instant for each jump of a record.
const STATIC_S: f64 = 3e-7;
const STEP_S: f64 = 6e-8;

/// Kernels of a sample that is integrated over all of the past, and over parts of it, over the square of the digits; on the
/// axis so many times more: for fields the three of a difference at two radii, for rates one at two.
const KERNELS_OF_WHOLE: f64 = 12.0;
const KERNELS_OF_PARTS: f64 = 6.0;
const AXIS: f64 = 0.03;
const ON_AXIS: f64 = 6.0;
const RATES_ON_AXIS: f64 = 2.0;

/// Power of the longitudinal over the shear speed, over that of a ratio of 1/4: a block that is nearly incompressible has as many
/// more fronts between which its waves are integrated.
const OF_SPEEDS: f64 = 0.25;

/// Echoes of a plate on a disc, over the squared number of groups of waves that are summed: the fronts of each are integrated, at
/// instants whose number grows with that of the fronts.
const ECHOES_S: f64 = 8e-5;

/// Kernels of the mean over a face over those of a point: so many circles between fronts, on more segments.
const KERNELS_OF_MEAN: f64 = 100.0;

/// Points of a section whose plans are made for a forecast, at most.
const MOST_PLANS: usize = 4096;

/// What a road belongs to; probes and sensors are numbered from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// A probe.
    Probe(usize),
    /// A sensor, whose face is a point or a sum over circles.
    Sensor(usize),
    /// A sensor with the mean of the kernels themselves.
    MeanOfKernels(usize),
    /// All points of the section.
    Section,
}

/// How the fields of a probe, of a sensor or of the points of the section are computed: known before any kernel is.
#[derive(Debug, Clone, PartialEq)]
pub struct Road {
    /// The point of it.
    pub place: Place,
    /// How many points there are, as circles of a sensor's face.
    pub points: usize,
    /// Discs of fixed radii that stand for the load, at most.
    pub discs: usize,
    /// Whether their kernels are looked up rather than computed.
    pub looked_up: bool,
    /// Samples in time of each point: those of the fields, and of each rate that is asked for.
    pub samples: usize,
    /// Samples of all points at which the past of the force is integrated, which discs do not serve.
    pub integrated: f64,
    /// Seconds of one thread.
    pub seconds: f64,
}

/// A place of a scene.
struct Planned {
    place_m: [f64; 2],
    place: Place,
    /// How many points it stands for.
    points: f64,
    /// Discs that stand for a face, if they do.
    stand_ins: Option<usize>,
}

impl Planned {
    fn of(place_m: [f64; 2], place: Place, points: f64) -> Self {
        Self {
            place_m,
            place,
            points,
            stand_ins: None,
        }
    }
}

/// Places of a scene.
fn planned(scene: &Scene, faces: &[MeanPlan]) -> Vec<Planned> {
    let probes = scene.probes.iter().enumerate();
    let probes = probes.map(|(i, probe)| Planned::of([probe.r_m, probe.z_m], Place::Probe(i), 1.0));
    let sensors = scene.sensors.iter().zip(faces).enumerate();
    let sensors = sensors.map(|(i, (sensor, plan))| {
        let place_m = [sensor.r_m, sensor.z_m];
        match plan {
            MeanPlan::Point => Planned::of(place_m, Place::Sensor(i), 1.0),
            MeanPlan::Discs(discs) => Planned {
                stand_ins: Some(discs.shares.len()),
                ..Planned::of(place_m, Place::Sensor(i), 1.0)
            },
            MeanPlan::Circles(count, _) => Planned::of(place_m, Place::Sensor(i), *count as f64),
            MeanPlan::Exact => Planned::of(place_m, Place::MeanOfKernels(i), 1.0),
        }
    });
    let section = scene.section.iter().flat_map(|section| {
        let Section {
            r_max_m,
            z_max_m,
            points,
            ..
        } = section;
        let all = points[0] * points[1];
        let stride = (all as f64 / MOST_PLANS as f64).sqrt().ceil().max(1.0) as usize;
        let axis = move |most_m: f64, count: usize| {
            let place_m = move |i: usize| most_m * i as f64 / (count as f64 - 1.0).max(1.0);
            (0..count)
                .step_by(stride)
                .map(place_m)
                .collect::<Vec<f64>>()
        };
        let (r_m, z_m) = (axis(*r_max_m, points[0]), axis(*z_max_m, points[1]));
        let each = all as f64 / (r_m.len() * z_m.len()) as f64;
        let places = r_m
            .into_iter()
            .flat_map(move |r| z_m.clone().into_iter().map(move |z| [r, z]));
        places.map(move |place_m| Planned::of(place_m, Place::Section, each))
    });
    probes.chain(sensors).chain(section).collect()
}

/// Samples of the output, at probes and on the section.
struct Asked {
    /// How many in all, and how many frames.
    counts: [f64; 2],
    /// Times in s at which short waves may pass; empty where nothing is integrated.
    times_s: [Vec<f64>; 2],
}

impl Asked {
    fn of(scene: &Scene, grid: &Grid<'_>, may_integrate: bool) -> Self {
        let all_s: Vec<f64> = match may_integrate {
            true => grid.times_s().collect(),
            false => Vec::new(),
        };
        let samples = grid.count() as f64;
        let frames = match &scene.section {
            Some(Section { frames, .. }) if !scene.peaks => (*frames as f64).min(samples),
            Some(_) | None => samples,
        };
        let every = (samples / frames).max(1.0);
        let frame = |i: usize| all_s.get((i as f64 * every) as usize).copied();
        let frames_s = (0..frames as usize).filter_map(frame).collect();
        Self {
            counts: [samples, frames],
            times_s: [all_s, frames_s],
        }
    }
}

/// A plate whose echoes are summed until the output ends.
struct EchoCost {
    thickness_m: f64,
    legs: f64,
}

impl EchoCost {
    fn of(scene: &Scene, grid: &Grid<'_>) -> Option<Self> {
        let plate = scene.target.echoing()?;
        let speed = scene.target.longitudinal_speed_m_s();
        let last_s = grid.times_s().last().unwrap_or(0.0) - grid.excitation.start_s();
        let transits = (last_s * speed / plate.thickness_m).max(0.0);
        Some(Self {
            thickness_m: plate.thickness_m,
            legs: transits.min(plate.legs as f64),
        })
    }

    /// Seconds of a point.
    fn seconds(&self, place_m: [f64; 2], radius_m: f64, (sets, samples): (&Sets, f64)) -> f64 {
        let image = image_m(place_m, self.thickness_m).map(|x| x / radius_m);
        let discs = sets.get(sets.choose_for_echoes(image)).count() as f64;
        discs * (ECHOES_S * self.groups(place_m[1]).powi(2) + samples * CELL_S)
    }

    /// Groups of waves: half of them arrive at each face, and inside they pass once in each direction, with two last parts.
    fn groups(&self, z_m: f64) -> f64 {
        let all = 0.5 * (self.legs + 1.0) * (self.legs + 2.0);
        let is_inside = z_m > 0.0 && z_m < self.thickness_m;
        if is_inside { 2.0 * all } else { 0.5 * all }
    }
}

/// What the cost of all points of a scene depends on.
struct Prices<'a> {
    scene: &'a Scene,
    grid: &'a Grid<'a>,
    sets: Sets,
    asked: Asked,
    plate: Option<EchoCost>,
    looked_up: bool,
    /// Seconds for the kernels of a disc.
    kernels_s: f64,
    /// Kernels of the past over those of a ratio of 1/4.
    harder: f64,
}

impl<'a> Prices<'a> {
    fn of(scene: &'a Scene, grid: &'a Grid<'a>, reach: Option<[f64; 2]>) -> Self {
        let (excitation, tolerance) = (grid.excitation, grid.tolerance);
        let follows = matches!(excitation.radius(), PressureRadius::Following { .. });
        let asked = Asked::of(scene, grid, follows && reach.is_none());
        let samples = asked.counts[0];
        let of_sets = (samples as usize, scene.rates() > 0);
        let more = if scene.rates() > 0 { WITH_RATES } else { 1.0 };
        let digits = -tolerance.log10();
        let speeds = excitation.speeds();
        Self {
            sets: Sets::new(excitation, tolerance, reach, of_sets),
            plate: EchoCost::of(scene, grid),
            looked_up: reach.is_some(),
            kernels_s: match reach {
                None => {
                    let kernels_s = more * (KERNELS + KERNELS_A_DIGIT * digits) * KERNEL_S;
                    kernels_s
                        * match excitation.attenuation {
                            Some(_) => DAMPED,
                            None => 1.0,
                        }
                        + samples * CELL_S
                }
                Some(_) => samples * LOOKED_UP_S,
            },
            harder: (speeds.p / speeds.s / 3.0_f64.sqrt())
                .max(1.0)
                .powf(OF_SPEEDS),
            scene,
            grid,
            asked,
        }
    }

    /// The road of a place.
    fn road(&self, planned: &Planned) -> Road {
        let (excitation, tolerance) = (self.grid.excitation, self.grid.tolerance);
        let Planned {
            place_m,
            place,
            points,
            stand_ins,
        } = *planned;
        let kind = usize::from(place == Place::Section);
        let (times_s, count) = (&self.asked.times_s[kind][..], self.asked.counts[kind]);
        let samples = self.asked.counts[0];
        let forcings: Vec<_> = derivatives(self.scene).map(|one| (one, times_s)).collect();
        let plan = PointPlan::new(&self.sets, (excitation, tolerance), &forcings, place_m);
        let discs = stand_ins.unwrap_or_else(|| self.sets.get(plan.set).count());
        let follows = matches!(excitation.radius(), PressureRadius::Following { .. });
        let still_s = if follows { count * STATIC_S } else { 0.0 };
        let sums_s = (discs as f64 + 1.0) * convolved_s(self.scene, samples, count) + still_s;
        let radius_m = excitation.units().disc_radius_m;
        let is_on_axis = place_m[0] < AXIS * place_m[1].hypot(radius_m);
        let axis = |derivative| match (is_on_axis, derivative) {
            (false, _) => 1.0,
            (true, Derivative::Field) => ON_AXIS,
            (true, Derivative::First | Derivative::Second) => RATES_ON_AXIS,
        };
        let each = |whole| {
            if whole {
                KERNELS_OF_WHOLE
            } else {
                KERNELS_OF_PARTS
            }
        };
        let integrated: Vec<(Derivative, bool)> = forcings
            .iter()
            .zip(&plan.integrated)
            .flat_map(|((derivative, _), own)| own.iter().map(|one| (*derivative, one.whole)))
            // discs that stand for a face serve all samples
            .filter(|_| stand_ins.is_none())
            .collect();
        let kernels = |&(derivative, whole): &_| axis(derivative) * each(whole);
        let past: f64 = integrated.iter().map(kernels).sum();
        let digits = -tolerance.log10();
        let past_s = self.harder * past * digits.powi(2) * KERNEL_S;
        let of_echoes = |plate: &EchoCost| plate.seconds(place_m, radius_m, (&self.sets, samples));
        let echoes_s = self.plate.as_ref().map_or(0.0, of_echoes);
        let fields_s = discs as f64 * self.kernels_s + forcings.len() as f64 * sums_s + past_s;
        let of_mean = match place {
            Place::MeanOfKernels(_) => KERNELS_OF_MEAN,
            Place::Probe(_) | Place::Sensor(_) | Place::Section => 1.0,
        };
        Road {
            place,
            points: points as usize,
            discs,
            looked_up: self.looked_up,
            samples: forcings.len() * count as usize,
            integrated: points * integrated.len() as f64,
            seconds: points * (of_mean * fields_s + echoes_s),
        }
    }
}

/// The roads of the points of a scene at the times of a grid, with kernels of a table that reaches to `reach` or, without it,
/// computed ones.
pub(crate) fn roads(scene: &Scene, grid: &Grid<'_>, reach: Option<[f64; 2]>) -> Vec<Road> {
    let prices = Prices::of(scene, grid, reach);
    let mut roads: Vec<Road> = Vec::new();
    for planned in planned(scene, &plans(scene, grid, reach.is_none())) {
        let road = prices.road(&planned);
        let is_next = |last: &&mut Road| last.place == Place::Section && road.place == last.place;
        match roads.last_mut().filter(is_next) {
            Some(last) => {
                last.discs = last.discs.max(road.discs);
                last.integrated += road.integrated;
                last.seconds += road.seconds;
            }
            None => roads.push(road),
        }
    }
    if let (Some(last), Some(section)) = (roads.last_mut(), &scene.section) {
        // the section comes last
        last.points = section.points[0] * section.points[1];
    }
    roads
}

/// The fields, and the rates of them that a scene asks for.
fn derivatives(scene: &Scene) -> impl Iterator<Item = Derivative> {
    let rates = [Derivative::First, Derivative::Second];
    let mut own: Vec<Derivative> = vec![Derivative::Field];
    let measured = scene.measured_rates();
    let asked = scene.quantities.iter().chain(&measured);
    let asked = asked.filter_map(|one| one.rate());
    let asked: Vec<Derivative> = asked.map(|(derivative, _)| derivative).collect();
    own.extend(rates.into_iter().filter(|rate| asked.contains(rate)));
    own.into_iter()
}

/// Seconds of the convolutions of a point of which some samples are wanted. Slopes and bends of a record are summed wherever
/// lines meet, or transformed as its rises are.
fn convolved_s(scene: &Scene, samples: f64, wanted: f64) -> f64 {
    let (corners, jumps) = scene.record().map_or((0.0, 0.0), |record| {
        let rows = (record.time_s().len() as f64).min(samples);
        (rows, record.jumps().len() as f64)
    });
    let transform_ns = transform_ns(2.0 * samples);
    let rises_ns = direct_ns(wanted, samples).min(transform_ns);
    let bends_ns = direct_ns(wanted, 2.0 * corners).min(2.0 * transform_ns);
    1e-9 * (rises_ns + bends_ns) + jumps * wanted * STEP_S
}
