//! What a scene will take, before it is computed: time, memory, disk.

use crate::cost::Cost;
use crate::excitation::Excitation;
use crate::grid::Grid;
use crate::kernels::KernelSource;
use crate::scene::{Probe, Scene, Section};
use crate::watch::{Unwatched, Watch};
use halfspace::{Deflection, SurfaceResponse};
use thiserror::Error;

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

/// Why a scene is not begun.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum TooMuch {
    /// It needs more memory than there is.
    #[error(transparent)]
    Memory(#[from] TooMuchMemory),
    /// The deflection of its disc needs more products than can be waited for.
    #[error(
        "the deflection of the disc is a sum of {products:.1e} products, more than {limit:.0e}: its memory spans {cells:.2e} of the output's {samples:.2e} samples; ask for a larger step_s, a smaller duration_s or a smaller disc_radius_m"
    )]
    Work {
        /// Products needed.
        products: f64,
        /// Products allowed.
        limit: f64,
        /// Samples of the disc's memory.
        cells: f64,
        /// Samples of the output.
        samples: f64,
    },
    /// Whoever asked for the scene has seen the forecast and does not want it.
    #[error("the scene was given up before it was begun: it takes about {seconds:.1e} s")]
    GivenUp {
        /// Time in s.
        seconds: f64,
    },
}

/// What a scene may take.
pub struct Allowance<'a> {
    /// Memory in bytes.
    pub memory_bytes: f64,
    /// Told the forecast once the force is known; whether to go on.
    pub go_on: &'a dyn Fn(&Forecast) -> bool,
    /// Told how far the fields are.
    pub watch: &'a dyn Watch,
}

impl Default for Allowance<'_> {
    /// Whatever it takes.
    fn default() -> Self {
        Self {
            memory_bytes: f64::INFINITY,
            go_on: &|_| true,
            watch: &Unwatched,
        }
    }
}

/// A scene that needs more memory than there is.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error(
    "the scene needs about {needed_gb:.3} GB of memory, more than the {limit_gb:.3} GB allowed ({points} points, {samples:.3e} samples, {frames} frames): ask for {change}"
)]
pub struct TooMuchMemory {
    /// Needed in GB.
    pub needed_gb: f64,
    /// Allowed in GB.
    pub limit_gb: f64,
    /// Points at which fields are asked for.
    pub points: usize,
    /// Samples of the output in time.
    pub samples: f64,
    /// Frames of the section.
    pub frames: usize,
    /// What to change.
    pub change: &'static str,
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

/// Bytes of a point of a section at one frame: six fields in single precision.
const FRAME_POINT: f64 = 4.0 * 6.0;

/// Bytes of a point of a section whatever the frames: arrivals and errors.
const POINT: f64 = 8.0 * 9.0;

/// Products of the sum for the deflection of the disc at most, and seconds that one takes.
const MOST_PRODUCTS: f64 = 1e11;
const PRODUCT_S: f64 = 1e-9;

impl Forecast {
    /// The least that a scene takes, before its force is known.
    #[must_use]
    pub fn least(scene: &Scene) -> Self {
        Self::of(scene, FEWEST, rayon::current_num_threads())
    }

    /// Of a scene whose force and times are known, among so many threads.
    ///
    /// # Errors
    /// [`TooMuch::Work`].
    pub(crate) fn new(
        scene: &Scene,
        excitation: &Excitation,
        grid: &Grid,
        source: Option<&KernelSource>,
        threads: usize,
    ) -> Result<Self, TooMuch> {
        let samples = grid.count() as f64;
        let response = SurfaceResponse::new(excitation.medium(), Deflection::Centre);
        let cells = response.memory() * excitation.units().time_s() / grid.step_s;
        let products = samples * cells.min(samples);
        if products > MOST_PRODUCTS {
            return Err(TooMuch::Work {
                products,
                limit: MOST_PRODUCTS,
                cells,
                samples,
            });
        }
        let cost = Cost::new(scene, excitation, samples);
        let fields_s = match source {
            None => 0.0,
            Some(KernelSource::Direct(_)) => cost.computed_s(),
            Some(KernelSource::Table(_)) => cost.looked_up_s(),
        };
        Ok(Self {
            seconds: fields_s / threads as f64 + products * PRODUCT_S,
            ..Self::of(scene, samples, threads)
        })
    }

    fn of(scene: &Scene, samples: f64, threads: usize) -> Self {
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
        let cells = if scene.points() > 0 {
            threads as f64 * CELL
        } else {
            0.0
        };
        Self {
            points: scene.points(),
            samples,
            seconds: 0.0,
            memory_bytes: samples * (SAMPLE + cells) + probes + section,
            disk_bytes: 8.0 * samples * (10.0 + (6.0 + more) * scene.probes.len() as f64) + kept,
        }
    }

    /// Compares it with the memory that there is.
    ///
    /// # Errors
    /// [`TooMuchMemory`] with what to change.
    pub fn check(&self, scene: &Scene, memory_bytes: f64) -> Result<(), TooMuchMemory> {
        if self.memory_bytes <= memory_bytes {
            return Ok(());
        }
        let of_probes = scene.probes.len() * size_of::<Probe>() > 0
            && scene.probes.len() as f64 * self.samples * PROBE_SAMPLE > 0.5 * self.memory_bytes;
        let change = if of_probes {
            "fewer probes, a larger step_s or a smaller duration_s"
        } else if scene.section.is_some() {
            "fewer points or frames of the map"
        } else {
            "a larger step_s or a smaller duration_s"
        };
        Err(TooMuchMemory {
            needed_gb: 1e-9 * self.memory_bytes,
            limit_gb: 1e-9 * memory_bytes,
            points: self.points,
            samples: self.samples,
            frames: scene.section.map_or(0, |section| section.frames),
            change,
        })
    }
}
