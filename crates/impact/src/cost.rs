//! What a scene takes before it is computed: time, memory, disk. By this one model kernels are chosen, and work is
//! announced and refused.
//!
//! Its constants are seconds of one thread, measured with the jobs of `scripts/time-impacts`.

use crate::convolution::plan::{PointPlan, Sets};
use crate::error::ImpactError;
use crate::excitation::{Excitation, PressureRadius};
use crate::fields::quantity::Derivative;
use crate::grid::{Grid, Wanted};
use crate::kernels::KernelSource;
use crate::sampled::convolve::{direct_ns, transform_ns};
use crate::scene::{Scene, Section};

/// What any output takes, the opening of a table, and a byte of what is decoded of it.
const OUTPUT_S: f64 = 1.4e-2;
const TABLE_S: f64 = 1e-2;
const DECODED_S: f64 = 2.7e-9;

/// A kernel, and kernels of a trace whatever its tolerance, and for each digit; for fields with rates so many times more.
const KERNEL_S: f64 = 7e-6;
const KERNELS: f64 = 16.0;
const KERNELS_A_DIGIT: f64 = 16.0;
const WITH_RATES: f64 = 1.5;

/// Moments of a cell, and the lookup of a cell.
const CELL_S: f64 = 4e-7;
const LOOKED_UP_S: f64 = 1.5e-7;

/// A static field, and a step response at an instant for each jump of a record.
const STATIC_S: f64 = 3e-7;
const STEP_S: f64 = 6e-8;

/// Kernels of a sample that is integrated over all of the past, and over parts of it, over the square of the digits; on the
/// axis they are continued from so many radii.
const KERNELS_OF_WHOLE: f64 = 12.0;
const KERNELS_OF_PARTS: f64 = 6.0;
const AXIS: f64 = 0.03;
const RADII_ON_AXIS: f64 = 2.0;

/// Points of a section whose plans are made for a forecast, at most.
const MOST_PLANS: usize = 4096;

/// How the fields of a probe, or of the points of the section, are computed: known before any kernel is.
#[derive(Debug, Clone, PartialEq)]
pub struct Road {
    /// Number of the probe from 0; none for the section.
    pub probe: Option<usize>,
    /// How many points there are.
    pub points: usize,
    /// Discs of fixed radii that stand for the load, at most.
    pub discs: usize,
    /// Whether their kernels are looked up rather than computed.
    pub looked_up: bool,
    /// Samples in time of each point.
    pub samples: usize,
    /// Samples of all points at which the past of the force is integrated, which discs do not serve.
    pub integrated: f64,
    /// Seconds of one thread.
    pub seconds: f64,
}

/// Places of a scene, each with the number of its probe or none in the section, and how many points it stands for.
fn planned(scene: &Scene) -> Vec<([f64; 2], Option<usize>, f64)> {
    let probes = scene.probes.iter().enumerate();
    let probes = probes.map(|(i, probe)| ([probe.r_m, probe.z_m], Some(i), 1.0));
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
        places.map(move |place_m| (place_m, None, each))
    });
    probes.chain(section).collect()
}

/// The roads of the points of a scene whose excitation is known, with kernels of a table that reaches to `reach` or, without it,
/// computed ones.
pub(crate) fn roads(scene: &Scene, excitation: &Excitation, reach: Option<[f64; 2]>) -> Vec<Road> {
    let (wanted, tolerance) = (Wanted::of(scene), scene.settings.tolerance);
    let samples = wanted.cells(excitation);
    let (duration_s, step_s) = wanted.duration_and_step_s(excitation);
    let follows = matches!(excitation.radius(), PressureRadius::Following { .. });
    // windows are looked for among them
    let times_s = |count: f64| -> Vec<f64> {
        let gaps = (count - 1.0).max(1.0);
        let count = if follows && reach.is_none() {
            count as usize
        } else {
            0
        };
        (0..count).map(|n| duration_s * n as f64 / gaps).collect()
    };
    let frames = match &scene.section {
        Some(Section { frames, .. }) if !scene.peaks => (*frames as f64).min(samples),
        Some(_) | None => samples,
    };
    let all_s = times_s(duration_s / step_s + 1.0);
    let frames_s = if scene.section.is_some() {
        times_s(frames)
    } else {
        Vec::new()
    };
    let asked = (samples as usize, scene.rates() > 0);
    let sets = Sets::new(excitation, tolerance, reach, asked);
    let digits = -tolerance.log10();
    let more = if scene.rates() > 0 { WITH_RATES } else { 1.0 };
    let kernel_s = match reach {
        None => more * (KERNELS + KERNELS_A_DIGIT * digits) * KERNEL_S + samples * CELL_S,
        Some(_) => samples * LOOKED_UP_S,
    };
    let mut roads: Vec<Road> = Vec::new();
    for (place_m, probe, points) in planned(scene) {
        let (times_s, count) = match probe {
            None => (&frames_s, frames),
            Some(_) => (&all_s, samples),
        };
        let asked: Vec<_> = derivatives(scene).map(|one| (one, &times_s[..])).collect();
        let plan = PointPlan::new(&sets, (excitation, tolerance), &asked, place_m);
        let discs = sets.get(plan.set).count();
        let still_s = if follows { count * STATIC_S } else { 0.0 };
        let sum_s = convolved_s(scene, samples, count);
        let is_on_axis = place_m[0] < AXIS * place_m[1].hypot(excitation.units().disc_radius_m);
        let axis = if is_on_axis { RADII_ON_AXIS } else { 1.0 };
        let kernels = |whole: bool| {
            if whole {
                KERNELS_OF_WHOLE
            } else {
                KERNELS_OF_PARTS
            }
        };
        let integrated = plan.integrated.iter().flatten();
        let past: f64 = integrated.map(|one| kernels(one.whole)).sum();
        let seconds = discs as f64 * kernel_s
            + asked.len() as f64 * ((discs as f64 + 1.0) * sum_s + still_s)
            + axis * past * digits.powi(2) * KERNEL_S;
        let integrated: usize = plan.integrated.iter().map(Vec::len).sum();
        let road = Road {
            probe,
            points: 1,
            discs,
            looked_up: reach.is_some(),
            samples: count as usize,
            integrated: points * integrated as f64,
            seconds: points * seconds,
        };
        match roads
            .last_mut()
            .filter(|last| last.probe.is_none() && probe.is_none())
        {
            Some(last) => {
                last.discs = last.discs.max(discs);
                last.integrated += road.integrated;
                last.seconds += road.seconds;
            }
            None => roads.push(road),
        }
    }
    if let (Some(last), Some(section)) = (roads.last_mut(), &scene.section) {
        last.points = section.points[0] * section.points[1];
    }
    roads
}

/// Seconds of one thread that the fields of a scene take with kernels that are computed.
pub(crate) fn computed_s(scene: &Scene, excitation: &Excitation) -> f64 {
    let roads = roads(scene, excitation, None);
    OUTPUT_S + roads.iter().map(|road| road.seconds).sum::<f64>()
}

/// The fields, and the rates of them that a scene asks for.
fn derivatives(scene: &Scene) -> impl Iterator<Item = Derivative> {
    let rates = [Derivative::First, Derivative::Second];
    let mut own: Vec<Derivative> = vec![Derivative::Field];
    let asked = scene.quantities.iter().filter_map(|one| one.rate());
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

/// Threads that have something to do among points; one point does not start the others.
pub(crate) fn busy(points: usize) -> f64 {
    match points {
        0 | 1 => 1.0,
        several => several.min(rayon::current_num_threads()) as f64,
    }
}

/// What computing and keeping a scene takes, about.
#[derive(Debug, Clone, PartialEq)]
pub struct Forecast {
    /// Points at which fields are asked for.
    pub points: usize,
    /// Samples of the output in time.
    pub samples: f64,
    /// Time in s.
    pub seconds: f64,
    /// Memory in bytes at its largest.
    pub memory_bytes: f64,
    /// A results file in bytes.
    pub disk_bytes: f64,
    /// How the fields are computed, probe by probe, then on the section.
    pub roads: Vec<Road>,
}

/// What a scene may take.
pub struct Allowance<'a> {
    /// Memory in bytes.
    pub memory_bytes: f64,
    /// Told the forecast once the force is known; whether to go on.
    pub go_on: &'a dyn Fn(&Forecast) -> bool,
    /// Called when the fields at one more point are computed, from several threads.
    pub watch: &'a (dyn Fn() + Sync),
}

impl Default for Allowance<'_> {
    /// Whatever it takes.
    fn default() -> Self {
        Self {
            memory_bytes: f64::INFINITY,
            go_on: &|_| true,
            watch: &|| {},
        }
    }
}

/// Samples of a contact at least, before it is known.
const FEWEST: f64 = 100.0;

/// Bytes that a sample takes whatever is asked: time, force, deflection, striker, energy, and room to compute them.
const SAMPLE: f64 = 8.0 * 24.0;

/// Bytes that a sample of the six fields at a probe takes: kept, and once more while a field is written.
const PROBE_SAMPLE: f64 = 8.0 * (6.0 + 1.0);

/// Bytes that a sample of a quantity beside them takes, at a probe and at a frame of a section's point.
const QUANTITY_SAMPLE: f64 = 8.0;
const QUANTITY_FRAME: f64 = 4.0;

/// Bytes that a sample takes in each thread: averages and moments of the kernels, the convolution's room.
const CELL: f64 = 8.0 * 6.0 * 6.0;

/// Bytes that a sample takes of the force on a disc, and of what of it is left.
const FORCE_SAMPLE: f64 = 200.0;
/// Bytes of a row of a record, and of a cell between rows or samples, in which the force is read at nodes.
///
/// Measured: 614 MB with 3.84 million rows. `test_a_record_takes_what_was_forecast` fails without them.
const ROW: f64 = 8.0 * 4.0;
const NODES: f64 = 8.0 * 16.0;

/// Bytes of the transforms of a record over the points of a transform: those of its rises, slopes and bends, and the room of
/// each thread.
const TRANSFORMS: [f64; 2] = [8.0 * 3.0, 8.0 * 4.0];

/// Bytes of a point of a section at one frame: six fields in single precision.
const FRAME_POINT: f64 = 4.0 * 6.0;

/// Bytes of a point of a section whatever the frames: arrivals and errors.
const POINT: f64 = 8.0 * 9.0;

/// Seconds that a product of the sum for the deflection of the disc takes.
const PRODUCT_S: f64 = 1e-9;

impl Forecast {
    /// The least that a scene takes, before its force is known.
    pub fn least(scene: &Scene) -> Self {
        Self::of(scene, FEWEST, busy(scene.points()))
    }

    /// Of a scene whose force and times are known, among so many threads.
    pub(crate) fn new(
        scene: &Scene,
        grid: &Grid<'_>,
        source: Option<&KernelSource>,
        threads: f64,
    ) -> Self {
        let (excitation, samples) = (grid.excitation, grid.count() as f64);
        // as long as a Rayleigh wave takes from the edge to the centre
        let memory_s = excitation.units().time_s() / excitation.medium().rayleigh_speed();
        let cells = memory_s / grid.step_s;
        let products = samples * cells.min(samples);
        let reach = source.and_then(KernelSource::table_reach);
        let roads = source.map_or_else(Vec::new, |_| roads(scene, excitation, reach));
        let loaded_s = match source {
            None => 0.0,
            Some(KernelSource::Direct(_)) => OUTPUT_S,
            Some(KernelSource::Table(table)) => TABLE_S + DECODED_S * table.decoded_bytes() as f64,
        };
        let fields_s: f64 = roads.iter().map(|road| road.seconds).sum();
        let deflection_s = (products * PRODUCT_S).min(1e-9 * transform_ns(2.0 * samples));
        let forcings = 1.0 + scene.rates() as f64;
        let discs = roads.iter().map(|road| road.discs).max().unwrap_or(0) as f64;
        let of_discs = threads * CELL * (discs - 1.0).max(0.0) + forcings * FORCE_SAMPLE * discs;
        let mut forecast = Self::of(scene, samples, threads);
        forecast.seconds = loaded_s + fields_s / threads + deflection_s;
        forecast.memory_bytes += samples * of_discs;
        forecast.roads = roads;
        forecast
    }

    fn of(scene: &Scene, samples: f64, threads: f64) -> Self {
        let more = scene.quantities.len() as f64;
        let of_probe = samples * (PROBE_SAMPLE + more * QUANTITY_SAMPLE) + POINT;
        let probes = scene.probes.len() as f64 * of_probe;
        let (mut section, mut kept) = (0.0, 0.0);
        if let Some(Section { points, frames, .. }) = &scene.section {
            let [r, z] = points.map(|n| n as f64);
            let at_frame = FRAME_POINT + more * QUANTITY_FRAME;
            let peaks = if scene.peaks { 2.0 * (6.0 + more) } else { 0.0 };
            kept = r * z * (*frames as f64 * at_frame + POINT + 8.0 * (more + peaks));
            // a row is computed at once, in double precision
            let wanted = if scene.peaks { samples } else { *frames as f64 };
            section = kept + r * wanted * 2.0 * at_frame;
        }
        let cells = match scene.points() {
            0 => 0.0,
            _ => threads * CELL,
        };
        let record = scene.record().map_or(0.0, |record| {
            let rows = record.time_s().len() as f64;
            let transformed = match scene.points() {
                0 => 0.0,
                _ => (2.0 * samples).log2().ceil().exp2(),
            };
            rows * (ROW + NODES)
                + samples * NODES
                + transformed * (TRANSFORMS[0] + threads * TRANSFORMS[1])
        });
        Self {
            points: scene.points(),
            samples,
            seconds: 0.0,
            memory_bytes: samples * (SAMPLE + cells) + probes + section + record,
            roads: Vec::new(),
            disk_bytes: 8.0 * samples * (10.0 + (6.0 + more) * scene.probes.len() as f64) + kept,
        }
    }

    /// Compares it with the memory that there is.
    ///
    /// # Errors
    /// [`ImpactError::TooMuchMemory`] with what to change.
    pub fn check(&self, scene: &Scene, memory_bytes: f64) -> Result<(), ImpactError> {
        if self.memory_bytes <= memory_bytes {
            return Ok(());
        }
        let of_probes =
            scene.probes.len() as f64 * self.samples * PROBE_SAMPLE > 0.5 * self.memory_bytes;
        let rows = scene.record().map_or(0, |record| record.time_s().len());
        let change = if rows as f64 * (ROW + NODES) > 0.5 * self.memory_bytes {
            "a shorter record, fewer rows or a lower low_pass_hz"
        } else if of_probes {
            "fewer probes, a larger step_s or a smaller duration_s"
        } else if scene.section.is_some() {
            "fewer points or frames of the map"
        } else {
            "a larger step_s or a smaller duration_s"
        };
        Err(ImpactError::TooMuchMemory {
            needed_gb: 1e-9 * self.memory_bytes,
            limit_gb: 1e-9 * memory_bytes,
            points: self.points,
            samples: self.samples,
            frames: scene.section.as_ref().map_or(0, |section| section.frames),
            change,
        })
    }
}
