//! What a scene takes before it is computed: time, memory, disk. By this one model kernels are chosen, and work is
//! announced and refused.
//!
//! Its constants are seconds of one thread, measured with the jobs of `scripts/time-impacts`.

use crate::error::ImpactError;
use crate::evaluator::convolve::{direct_ns, transform_ns};
use crate::evaluator::discs::Discs;
use crate::evaluator::sum::most_whole;
use crate::evaluator::{APART, MOST_HELD};
use crate::excitation::{Excitation, PressureRadius};
use crate::grid::{Grid, Wanted};
use crate::kernels::KernelSource;
use crate::scene::{Probe, Scene, Section};

/// What any output takes, the opening of a table, and a byte of what is decoded of it.
const OUTPUT_S: f64 = 1.4e-2;
const TABLE_S: f64 = 1e-2;
const DECODED_S: f64 = 2.7e-9;

/// A kernel beside a disc, and one of the smaller discs of a contact that follows its load, which are farther.
const KERNEL_S: f64 = 7e-6;
const SMALL_DISC: f64 = 1.1;

/// Kernels of a trace whatever its tolerance, and for each digit; for fields with rates so many times more.
const KERNELS: f64 = 16.0;
const KERNELS_A_DIGIT: f64 = 16.0;
const WITH_RATES: f64 = 1.5;

/// Moments of a cell, and what it takes to look it up.
const CELL_S: f64 = 4e-7;
const LOOKED_UP_S: f64 = 4.5e-7;

/// A step response at an instant, for each jump of a record.
const STEP_S: f64 = 6e-8;

/// Part of a point's samples that are integrated over the radii, and kernels of each over the square of the digits.
const OPEN: f64 = 0.01;
const KERNELS_OF_OPEN: f64 = 2.6;

/// Radii from the axis and below the surface within which whole contacts are integrated, and kernels of each over the square
/// of the digits.
const BESIDE: [f64; 2] = [3.0, 1.4];
const KERNELS_OF_WHOLE: f64 = 6.0;

/// Seconds of a rate of a point inside the contact at four digits, and how many times as many for each digit more. On the axis,
/// up to some radii from it, all parts of the contact are as far, and it takes more.
const RATE_INSIDE_S: f64 = 0.15;
const RATE_A_DIGIT: f64 = 4.0;
const INSIDE: [f64; 2] = [1.2, 0.5];
const ON_AXIS: f64 = 8.0;
const AXIS: f64 = 0.05;

/// Times that a longitudinal wave takes over the radius: shorter contacts have short waves, and all choices of discs are tried.
const SHORT: f64 = 20.0;

/// A force with a kink, such as that of a contact that yields, has more parts to be integrated over.
const WITH_KINKS: f64 = 3.0;

/// Power of the longitudinal over the shear speed, over that of a ratio of 1/4: the fields beside a contact on a block that is
/// nearly incompressible have as many more scales.
const OF_SPEEDS: f64 = 0.5;

/// What the rates of a contact that follows its load take beside its fields.
const FOLLOWING_RATES: f64 = 2.0;

/// Seconds of one thread that the fields of a scene take whose output has so many samples: with kernels that are computed,
/// and with those of a table that is in memory.
pub(crate) fn fields_s(scene: &Scene, excitation: &Excitation, samples: f64) -> [f64; 2] {
    let (radius, tolerance) = (excitation.radius(), scene.settings.tolerance);
    let (rates, digits) = (scene.rates() as f64, -tolerance.log10());
    let frames = match &scene.section {
        Some(Section { frames, .. }) if !scene.peaks => (*frames as f64).min(samples),
        Some(_) | None => samples,
    };
    // of so many samples at a probe and at a point of the section
    let sum = |of_point: &dyn Fn(f64) -> f64| {
        let probes = scene.probes.len();
        let section = scene.points() - probes;
        probes as f64 * of_point(samples) + section as f64 * of_point(frames)
    };
    // slopes and bends of a record are summed wherever lines meet, or transformed as its rises are
    let (corners, jumps) = scene.record().map_or((0.0, 0.0), |record| {
        let rows = (record.time_s().len() as f64).min(samples);
        (rows, record.jumps().len() as f64)
    });
    let convolved_s = |wanted: f64| {
        let transform_ns = transform_ns(2.0 * samples);
        let rises_ns = direct_ns(wanted, samples).min(transform_ns);
        let bends_ns = direct_ns(wanted, 2.0 * corners).min(2.0 * transform_ns);
        1e-9 * (rises_ns + bends_ns) + jumps * wanted * STEP_S
    };
    let discs = Discs::looked_up(radius)[0].radii.len() as f64;
    let looked_up_s =
        sum(&|wanted| discs * (samples * LOOKED_UP_S + (1.0 + rates) * convolved_s(wanted)));
    // those beside the load seldom leave little at the first choice
    let choices = Discs::computed(radius, tolerance);
    let beside = !choices[0].is_apart();
    let counts = |choices: &[Discs]| choices.iter().map(|discs| discs.radii.len()).sum::<usize>();
    let is_short = excitation.end_s() < SHORT * excitation.units().time_s();
    let discs = match (radius, is_short) {
        (PressureRadius::Following { .. }, true) => counts(&choices),
        _ => choices[usize::from(beside).min(choices.len() - 1)]
            .radii
            .len(),
    } as f64;
    let kernels = KERNELS + KERNELS_A_DIGIT * digits;
    let more = if rates > 0.0 { WITH_RATES } else { 1.0 };
    let [small, of_rates, open, beside] = match radius {
        PressureRadius::Following { largest_m, .. } => {
            let beside = points_beside(scene, largest_m);
            [SMALL_DISC, FOLLOWING_RATES, OPEN, beside]
        }
        PressureRadius::Fixed(_) => [1.0, 1.0, 0.0, 0.0],
    };
    let trace_s = kernels * more * small * KERNEL_S + samples * CELL_S;
    let points_s = sum(&|wanted| {
        let past_s = open * wanted * KERNELS_OF_OPEN * digits.powi(2) * SMALL_DISC * KERNEL_S;
        let each = discs * convolved_s(wanted) + past_s;
        discs * trace_s + each * (1.0 + of_rates * rates)
    });
    let step_s = Wanted::of(scene).duration_and_step_s(excitation).1;
    let whole = most_whole(excitation, step_s, tolerance) as f64;
    let kinks = match excitation.kinks_s().is_empty() {
        true => 1.0,
        false => WITH_KINKS,
    };
    let speeds = excitation.speeds();
    let scales = (speeds.p / speeds.s / 3.0_f64.sqrt()).max(1.0);
    let harder = kinks * scales.powf(OF_SPEEDS);
    let whole_s = whole * KERNELS_OF_WHOLE * digits.powi(2) * SMALL_DISC * KERNEL_S;
    let rate_s = rates * RATE_INSIDE_S * RATE_A_DIGIT.powf(digits - 4.0);
    let inside_s = match radius {
        PressureRadius::Following { largest_m, .. } => points_inside(scene, largest_m) * rate_s,
        PressureRadius::Fixed(_) => 0.0,
    };
    let more_s = harder * (beside * whole_s + inside_s);
    [OUTPUT_S + points_s + more_s, looked_up_s]
}

/// Points of a scene that are inside a contact of a radius; those on the axis count for more.
fn points_inside(scene: &Scene, radius_m: f64) -> f64 {
    let [far_m, deep_m] = INSIDE.map(|radii| radii * radius_m);
    let of = |r_m: f64| if r_m < AXIS * radius_m { ON_AXIS } else { 1.0 };
    let probes = scene.probes.iter();
    let inside = probes.filter(|probe| probe.r_m < far_m && probe.z_m < deep_m);
    let section = scene.section.as_ref().map_or(0.0, |s| {
        let [columns, rows] = s.points.map(|n| n as f64);
        let columns = ON_AXIS + (columns - 1.0) * (far_m / s.r_max_m).min(1.0);
        columns * (1.0 + (rows - 1.0) * (deep_m / s.z_max_m).min(1.0))
    });
    inside.map(|probe| of(probe.r_m)).sum::<f64>() + section
}

/// Discs that stand for the load at some point of a scene, at most.
fn most_discs(
    scene: &Scene,
    excitation: &Excitation,
    source: Option<&KernelSource>,
    samples: f64,
) -> f64 {
    let radius = excitation.radius();
    let choices = match source {
        None => return 0.0,
        Some(KernelSource::Table(_)) => Discs::looked_up(radius),
        Some(KernelSource::Direct(_)) => Discs::computed(radius, scene.settings.tolerance),
    };
    let near_m = APART * radius.largest_m();
    let probes = scene.probes.iter();
    let near = scene.section.is_some()
        || probes
            .map(|probe| probe.r_m.hypot(probe.z_m))
            .any(|far_m| far_m < near_m);
    let counts = choices.iter().map(|discs| discs.radii.len());
    let apart = choices.iter().filter(|discs| discs.is_apart());
    let held = counts.filter(|&count| count as f64 * samples <= MOST_HELD as f64);
    let few = apart.map(|discs| discs.radii.len()).max().unwrap_or(0);
    let first = choices.iter().find(|discs| !discs.is_apart());
    let few = few.max(first.map_or(1, |discs| discs.radii.len()));
    if near {
        held.max().unwrap_or(few) as f64
    } else {
        few as f64
    }
}

/// Points of a scene that are beside a contact of a radius.
fn points_beside(scene: &Scene, radius_m: f64) -> f64 {
    let [far_m, deep_m] = BESIDE.map(|radii| radii * radius_m);
    let beside = |probe: &&Probe| probe.r_m < far_m && probe.z_m < deep_m;
    let probes = scene.probes.iter().filter(beside).count();
    let section = scene.section.as_ref().map_or(0.0, |s| {
        let part = (far_m / s.r_max_m).min(1.0) * (deep_m / s.z_max_m).min(1.0);
        (s.points[0] * s.points[1]) as f64 * part
    });
    probes as f64 + section
}

/// Threads that have something to do among points; one point does not start the others.
pub(crate) fn busy(points: usize) -> f64 {
    match points {
        0 | 1 => 1.0,
        several => several.min(rayon::current_num_threads()) as f64,
    }
}

/// What computing and keeping a scene takes, about.
#[derive(Debug, Clone, Copy, PartialEq)]
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
        let [computed_s, looked_up_s] = fields_s(scene, excitation, samples);
        let (loaded_s, fields_s) = match source {
            None => (0.0, 0.0),
            Some(KernelSource::Direct(_)) => (0.0, computed_s),
            Some(KernelSource::Table(table)) => {
                let decoded = table.decoded_bytes() as f64;
                (TABLE_S + DECODED_S * decoded, looked_up_s)
            }
        };
        let deflection_s = (products * PRODUCT_S).min(1e-9 * transform_ns(2.0 * samples));
        let forcings = 1.0 + scene.rates() as f64;
        let discs = most_discs(scene, excitation, source, samples);
        let of_discs = threads * CELL * (discs - 1.0).max(0.0) + forcings * FORCE_SAMPLE * discs;
        let mut forecast = Self::of(scene, samples, threads);
        forecast.seconds = loaded_s + fields_s / threads + deflection_s;
        forecast.memory_bytes += samples * of_discs;
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
