//! Forecast of the cost of a scene: time, memory, disk space. The same model chooses the kernels and announces or
//! rejects work.
//!
//! Its constants are seconds on one thread, measured with the jobs of `scripts/time-impacts`.

mod roads;

pub use roads::{Place, Road};

use crate::error::ImpactError;
use crate::grid::Grid;
use crate::kernels::KernelSource;
use crate::sampled::convolve::transform_ns;
use crate::scene::{Scene, Section};
use roads::roads;

/// Time for any output, for opening a table, and for decoding a byte of it.
const OUTPUT_S: f64 = 1.4e-2;
const TABLE_S: f64 = 1e-2;
const DECODED_S: f64 = 2.7e-9;

/// Seconds on one thread for the fields of a scene at the times of a grid with computed kernels.
pub(crate) fn computed_s(scene: &Scene, grid: &Grid<'_>) -> f64 {
    let roads = roads(scene, grid, None);
    OUTPUT_S + roads.iter().map(|road| road.seconds).sum::<f64>()
}

/// Threads with work for some number of points; a single point uses one thread.
pub(crate) fn busy(points: usize) -> f64 {
    match points {
        0 | 1 => 1.0,
        several => several.min(rayon::current_num_threads()) as f64,
    }
}

/// Approximate cost of computing and storing a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Forecast {
    /// Points with fields.
    pub points: usize,
    /// Samples of the output in time.
    pub samples: f64,
    /// Time in s.
    pub seconds: f64,
    /// Memory in bytes at its largest.
    pub memory_bytes: f64,
    /// Size of a results file in bytes.
    pub disk_bytes: f64,
    /// Method of computing the fields, for each probe and then for the section.
    pub roads: Vec<Road>,
}

/// Limits of the cost of a scene.
pub struct Allowance<'a> {
    /// Memory in bytes.
    pub memory_bytes: f64,
    /// Called with the forecast once the force is known; returns whether to continue.
    pub go_on: &'a dyn Fn(&Forecast) -> bool,
    /// Called after the fields at each point, from several threads.
    pub watch: &'a (dyn Fn() + Sync),
}

impl Default for Allowance<'_> {
    /// Without limits.
    fn default() -> Self {
        Self {
            memory_bytes: f64::INFINITY,
            go_on: &|_| true,
            watch: &|| {},
        }
    }
}

/// Smallest number of samples of a contact, before it is known.
const FEWEST: f64 = 100.0;

/// Bytes per sample in any case: time, force, deflection, striker, energy, and buffers.
const SAMPLE: f64 = 8.0 * 24.0;

/// Bytes per sample of the six fields at a probe: stored, and once more while a field is written.
const PROBE_SAMPLE: f64 = 8.0 * (6.0 + 1.0);

/// Bytes per sample of a further quantity, at a probe and at a frame of a section's point.
const QUANTITY_SAMPLE: f64 = 8.0;
const QUANTITY_FRAME: f64 = 4.0;

/// Bytes per sample in each thread: averages and moments of the kernels, buffers of the convolution.
const CELL: f64 = 8.0 * 6.0 * 6.0;

/// Bytes per sample of the force on a disc, and of its residual.
const FORCE_SAMPLE: f64 = 200.0;
/// Bytes per row of a record, and per cell between rows or samples, in which the force is read at nodes.
///
/// Measured: 614 MB with 3.84 million rows. `test_a_record_takes_what_was_forecast` fails without them.
const ROW: f64 = 8.0 * 4.0;
const NODES: f64 = 8.0 * 16.0;

/// Bytes of the transforms of a record per point of a transform: those of its rises, slopes and bends, and the buffers
/// of each thread.
const TRANSFORMS: [f64; 2] = [8.0 * 3.0, 8.0 * 4.0];

/// Bytes per point of a section and frame: six fields in single precision.
const FRAME_POINT: f64 = 4.0 * 6.0;

/// Bytes per point of a section for all frames: arrivals and errors.
const POINT: f64 = 8.0 * 9.0;

/// Seconds per product in the sum for the deflection of the disc.
const PRODUCT_S: f64 = 1e-9;

impl Forecast {
    /// Lower bound of the cost of a scene, before its force is known.
    pub fn least(scene: &Scene) -> Self {
        Self::of(scene, FEWEST, busy(scene.points()))
    }

    /// Forecast for a scene whose force and times are known, on a number of threads.
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
        let roads = source.map_or_else(Vec::new, |_| roads(scene, grid, reach));
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
        // a sensor's mean and output are stored, its fields only while they are averaged
        let probes = (scene.probes.len() + scene.sensors.len()) as f64 * of_probe;
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
            disk_bytes: 8.0
                * samples
                * (10.0
                    + (6.0 + more) * scene.probes.len() as f64
                    + 3.0 * scene.sensors.len() as f64)
                + kept,
        }
    }

    /// Compares the forecast with a memory limit.
    ///
    /// # Errors
    /// [`ImpactError::TooMuchMemory`] with advice.
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
