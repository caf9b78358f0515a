//! Question 1: how to compute a kernel.
//!
//! One value is the fields at one point and time after a unit step of force; the reference is the single
//! integral at a tolerance of 1e-14, or the closed form of Kausel (2012) at the centre of the surface.

use crate::inversion::Inversion;
use crate::measure::{Effort, MeasuredScene, Rows, at};
use crate::method::ComparedMethod;
use crate::record::{Question, off, peaks, sizes};
use crate::scenes::Density;
use fault::AnyError;
use halfspace::{Arrivals, Deflection, Kernel, Medium, Profile, Six, SurfaceResponse, kausel};
use lookup::Smoothness;
use tabulator::Progress;

/// A point, its times and the exact step responses there.
pub(crate) struct KernelScene {
    pub(crate) name: &'static str,
    pub(crate) place: [f64; 2],
    pub(crate) times: Vec<f64>,
    /// Arrivals of the waves.
    pub(crate) arrivals: Vec<f64>,
    exact: Vec<Six>,
    /// Indices of the compared fields.
    fields: &'static [usize],
    /// Largest values.
    scale: Six,
    static_part: Six,
    /// Reciprocal of the unit of the fields.
    per_unit: f64,
}

/// Poisson's ratio of the chart.
pub(crate) const POISSON_RATIO: f64 = 0.3;

/// Point between the nodes of every table, and below the disc, so that all fronts pass it.
const INTERIOR: [f64; 2] = [0.55, 0.65];

/// Distances in time from the fronts, after and before them, relative to their times.
const NEAR_FRONTS: [f64; 2] = [0.01, -0.01];

/// All six fields.
pub(crate) const ALL_FIELDS: [usize; 6] = [0, 1, 2, 3, 4, 5];

impl KernelScene {
    /// Six fields at a point inside, from before the first arrival to long after the last.
    ///
    /// `near` are additional times: distances from every arrival, relative to its time.
    pub(crate) fn interior(medium: &Medium, count: usize, near: &[f64]) -> Result<Self, AnyError> {
        let name = "interior point, across the fronts";
        Self::new(name, medium, INTERIOR, count, &ALL_FIELDS, near)
    }

    /// The same point at late times, where all fields are smooth and inversions work best.
    fn late(medium: &Medium, count: usize) -> Result<Self, AnyError> {
        let name = "interior point, after the last front";
        let mut scene = Self::new(name, medium, INTERIOR, 3 * count, &ALL_FIELDS, &[])?;
        let last = scene.arrivals[scene.arrivals.len() - 1];
        let first = scene.times.partition_point(|&t| t < 1.05 * last);
        scene.times.drain(..first);
        scene.exact.drain(..first);
        Ok(scene)
    }

    /// w on the axis.
    pub(crate) fn axis(medium: &Medium, count: usize, near: &[f64]) -> Result<Self, AnyError> {
        Self::new("axis, w", medium, [0.0, 0.65], count, &[1], near)
    }

    /// w at the centre of the surface over its static value: the kernel of the impact equation.
    pub(crate) fn surface(medium: &Medium, count: usize, near: &[f64]) -> Result<Self, AnyError> {
        let name = "surface centre, w";
        let mut scene = Self::new(name, medium, [0.0, 0.0], count, &[1], near)?;
        for (exact, t) in scene.exact.iter_mut().zip(&scene.times) {
            exact[1] = kausel::centre_step(medium, medium.kappa() * t);
        }
        scene.scale[1] = 1.0;
        scene.per_unit = 1.0 / (0.375 * (1.0 - medium.poisson_ratio()));
        Ok(scene)
    }

    fn new(
        name: &'static str,
        medium: &Medium,
        [r, z]: [f64; 2],
        count: usize,
        fields: &'static [usize],
        near: &[f64],
    ) -> Result<Self, AnyError> {
        let kernel = Kernel::new(medium, Profile::Hertz, 1e-14)?;
        let arrivals = Arrivals::new(medium, Profile::Hertz, r, z)?;
        // from before the first arrival to long after the last, evenly spaced in the logarithm
        let (first, last) = (0.8 * arrivals.first().max(0.1), 8.0 * arrivals.last());
        let time = |i| first * (last / first).powf(i as f64 / (count - 1) as f64);
        let mut times: Vec<f64> = (0..count).map(time).collect();
        for arrival in arrivals.sorted() {
            let both = |d: &f64| [arrival * (1.0 - d), arrival * (1.0 + d)];
            times.extend(near.iter().flat_map(both));
        }
        times.retain(|t| *t > 0.0);
        times.sort_by(f64::total_cmp);
        let mut scene = Self {
            name,
            place: [r, z],
            times,
            arrivals: arrivals.sorted(),
            exact: Vec::new(),
            fields,
            scale: [0.0; 6],
            static_part: kernel.static_field(r, z)?,
            per_unit: 1.0,
        };
        scene.exact = scene.by_kernel(&kernel)?;
        scene.scale = peaks(&scene.exact);
        Ok(scene)
    }

    /// The values by the program's kernel.
    pub(crate) fn by_kernel(&self, kernel: &Kernel) -> Result<Vec<Six>, AnyError> {
        let [r, z] = self.place;
        let whole = |&t: &f64| {
            let remainder = kernel.remainder(r, z, t)?.value;
            let whole = |f: usize| (remainder[f] + self.static_part[f]) * self.per_unit;
            Ok(std::array::from_fn(whole))
        };
        self.times.iter().map(whole).collect()
    }

    /// The values of w alone.
    fn at_centre(&self, mut w: impl FnMut(f64) -> f64) -> Vec<Six> {
        let value = |&t: &f64| [0.0, w(t), 0.0, 0.0, 0.0, 0.0];
        self.times.iter().map(value).collect()
    }

    /// The relative errors at all times.
    fn errors(&self, values: &[Six]) -> Vec<f64> {
        off(values, &self.exact, &self.scale, self.fields)
    }

    /// The largest relative error at each time.
    pub(crate) fn errors_over_time(&self, values: &[Six]) -> Vec<f64> {
        let errors = self.errors(values);
        let largest = |errors: &[f64]| sizes(errors)[0];
        errors.chunks(self.fields.len()).map(largest).collect()
    }
}

/// Measures every method in every scene.
pub(crate) fn measure(effort: Effort, densities: &[Density], progress: &dyn Progress) -> Rows {
    let medium = Medium::new(POISSON_RATIO)?;
    let count = effort.pick(8, 40);
    let near = effort.pick(&NEAR_FRONTS[..1], &NEAR_FRONTS[..]);
    let mut records = Vec::new();
    let scenes = [
        KernelScene::interior(&medium, count, near)?,
        KernelScene::late(&medium, count)?,
        KernelScene::axis(&medium, count, near)?,
        KernelScene::surface(&medium, count, near)?,
    ];
    let inversions = Inversion::all(effort);
    progress.total("kernels", (scenes.len() * (inversions.len() + 1)) as u64);
    for scene in &scenes {
        let mut rows = MeasuredScene {
            effort,
            question: Question::Kernels,
            name: scene.name,
            values: scene.times.len() as f64,
            errors: &|values: &Vec<Six>| Ok(scene.errors(values)),
            records: &mut records,
        };
        for digits in (1..=13).step_by(effort.pick(2, 1)) {
            let tolerance = 10.0_f64.powi(-digits);
            let kernel = Kernel::new(&medium, Profile::Hertz, tolerance)?;
            let run = || Ok((scene.by_kernel(&kernel)?, None));
            let row = rows.add(ComparedMethod::SingleIntegral, at(tolerance), run)?;
            row.default_path = scene.place[1] > 0.0;
        }
        progress.advance(1);
        for inversion in &inversions {
            let run = || inversion.run(&medium, scene.place, &scene.times);
            rows.add(inversion.method, &inversion.setting, run)?;
            progress.advance(1);
        }
        if scene.place == [0.0, 0.0] {
            // the response that the impact equation uses, and its reference
            let response = SurfaceResponse::new(&medium, Deflection::Centre);
            let fitted = || Ok((scene.at_centre(|t| response.step(t)), None));
            let row = rows.add(ComparedMethod::SurfaceResponse, "fitted once", fitted)?;
            row.default_path = true;
            let kausel = |t: f64| kausel::centre_step(&medium, medium.kappa() * t);
            let closed = || Ok((scene.at_centre(kausel), None));
            let reference = ComparedMethod::Kausel;
            rows.add(reference, "no settings", closed)?;
        }
    }
    records.extend(tables(&scenes[0], densities, effort)?);
    Ok(records)
}

/// Averages over time cells, looked up in tables of several densities with stencils of several orders.
fn tables(scene: &KernelScene, densities: &[Density], effort: Effort) -> Rows {
    let mut records = Vec::new();
    let [r, z] = scene.place;
    let last = scene.times[scene.times.len() - 1];
    let (nu, linear) = (POISSON_RATIO, Smoothness::Linear);
    let exact_kernel = Kernel::new(&Medium::new(nu)?, Profile::Hertz, 1e-12)?;
    for density in densities {
        for points in effort.pick(vec![4, Density::points()], vec![2, 4, 6, 8]) {
            let table = density.with_stencil(points)?;
            let width = table.cell_width(nu)?;
            let count = (last / width) as usize;
            let mut exact = vec![[0.0; 6]; count];
            exact_kernel
                .trace(r, z, count as f64 * width)?
                .for_each_cell(width, count, |j, [average, ..]| exact[j] = average)?;
            let run = || {
                let mut cells = vec![[0.0; 6]; count];
                table.trace(linear, nu, r, z, 0, &mut cells)?;
                Ok((cells, Some(0)))
            };
            let mut rows = MeasuredScene {
                effort,
                question: Question::Kernels,
                name: scene.name,
                values: count as f64,
                errors: &|cells: &Vec<Six>| Ok(off(cells, &exact, &scene.scale, &ALL_FIELDS)),
                records: &mut records,
            };
            let setting = format!("{}, {points} points", density.label());
            rows.add(ComparedMethod::TableOfKernels, setting, run)?
                .default_path = density.is_default(points);
        }
    }
    Ok(records)
}
