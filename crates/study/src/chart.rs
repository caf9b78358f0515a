//! The chart: all measurements and pictures.

use crate::map;
use crate::measure::Effort;
use crate::picture::{Picture, diagrams};
use crate::question::{fields, force, impacts, kernels};
use crate::ranking::{Ranking, rankings};
use crate::record::Record;
use crate::scenes::Density;
use fault::AnyError;
use std::time::Instant;
use tabulator::Progress;

/// Content of a chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// Extent of the measurements.
    pub effort: Effort,
    /// Description of the machine, on which the times depend, in one line.
    pub machine: String,
    /// Measured rows.
    pub records: Vec<Record>,
    /// Work-precision diagrams.
    pub diagrams: Vec<Picture>,
    /// Stability maps and errors over time.
    pub maps: Vec<Picture>,
    /// Elapsed time in s.
    pub wall_s: f64,
}

impl Chart {
    /// Measures all methods and computes all maps.
    ///
    /// # Errors
    /// [`AnyError`] if a reference or one of the program's methods fails; failures of compared methods are results.
    pub fn run(effort: Effort, progress: &dyn Progress) -> Result<Self, AnyError> {
        let (started, machine) = (Instant::now(), machine());
        let uniform = [None, Some(0.25), Some(0.125), Some(0.0625)];
        let spacings = &uniform[..effort.pick(1, 4)];
        progress.total("tables", spacings.len() as u64);
        let mut densities = Vec::new();
        for &spacing in spacings {
            densities.push(Density::build(kernels::POISSON_RATIO, spacing)?);
            progress.advance(1);
        }
        let advance = || progress.advance(1);
        let mut records = kernels::measure(effort, &densities, progress)?;
        progress.total("force", 2);
        records.extend(force::measure(effort, &advance)?);
        progress.total("fields", effort.pick(3, 9));
        records.extend(fields::measure(effort, &densities, &advance)?);
        progress.total("impacts", 4);
        records.extend(impacts::measure(effort, &densities, &advance)?);
        progress.total("inversions", 15);
        let mut maps = map::inversions::figures(effort, &advance)?;
        progress.total("marches", 3);
        maps.extend(map::marches::figures(effort, &advance)?);
        progress.total("kernel maps", 1);
        maps.extend(map::kernels::figures(effort)?);
        advance();
        progress.total("models", effort.pick(15, 41));
        maps.extend(map::models::figures(effort, &advance)?);
        Ok(Self {
            effort,
            machine,
            diagrams: diagrams(&records),
            records,
            maps,
            wall_s: started.elapsed().as_secs_f64(),
        })
    }

    /// Descriptions of methods that are ahead of the default path at 1e-3 to 1e-8 without a stated reason; expected to
    /// be empty.
    pub fn unexplained(&self) -> Vec<String> {
        let rankings = rankings(&self.records);
        rankings.iter().filter_map(Ranking::unexplained).collect()
    }
}

/// Description of this machine: processor, threads, operating system, architecture, optimisation of the program, and
/// load.
fn machine() -> String {
    /// Number of busy threads above which times are unreliable.
    const BUSY: f64 = 0.5;
    let read = |path: &str| std::fs::read_to_string(path).unwrap_or_default();
    let text = read("/proc/cpuinfo");
    let mut lines = text.lines();
    let model = lines.find(|line| line.starts_with("model name"));
    let processor = model.and_then(|line| line.split(':').nth(1));
    let processor = processor.map_or("unknown processor", str::trim);
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let (system, architecture) = (std::env::consts::OS, std::env::consts::ARCH);
    let build = if cfg!(debug_assertions) {
        "debug"
    } else {
        "release"
    };
    let load = read("/proc/loadavg");
    let load = load.split(' ').next().and_then(|load| load.parse().ok());
    let busy = load
        .filter(|load: &f64| *load > BUSY)
        .map(|load| format!("; busy with {load} other threads before: the times may be too long"));
    let busy = busy.unwrap_or_default();
    format!("{processor}, {threads} threads, {system} {architecture}, {build} build{busy}")
}
