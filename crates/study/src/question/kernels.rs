//! Question 1: how to compute a kernel.
//!
//! One value is the fields at one point and time after a unit step of force; the reference is the single
//! integral at a tolerance of 1e-14, or the closed form of Kausel (2012) at the centre of the surface.

use super::inversions::Inversion;
use crate::StudyError;
use crate::axis_extended::AxisTransform;
use crate::effort::Effort;
use crate::inversion::{ExtendedWeights, stehfest_extended};
use crate::record::{Error, Question, Record};
use crate::single_integral::remainder;
use crate::tables::Density;
use halfspace::{Arrivals, Deflection, Kernel, Medium, Profile, Six, SurfaceResponse, kausel};
use std::hint::black_box;
use tabulator::Progress;

/// A point, its times and the exact step responses there.
#[derive(Debug, Clone)]
pub(crate) struct KernelScene {
    pub(crate) name: &'static str,
    pub(crate) place: [f64; 2],
    pub(crate) times: Vec<f64>,
    /// Arrivals of the waves.
    pub(crate) arrivals: Vec<f64>,
    exact: Vec<Six>,
    scale: Six,
}

/// Poisson's ratio of the chart.
pub(crate) const POISSON_RATIO: f64 = 0.3;

/// Off the nodes of every table; inside the disc, so that all fronts pass.
const INTERIOR: [f64; 2] = [0.55, 0.65];

/// On the axis, where Gaver-Stehfest is run in extended precision.
const AXIS: [f64; 2] = [0.0, 0.65];

/// How near the fronts are looked at, after and before them: over their times.
const NEAR: [f64; 2] = [0.01, -0.01];

/// All six fields.
const ALL: [usize; 6] = [0, 1, 2, 3, 4, 5];

impl KernelScene {
    /// Six fields at a point inside, from before the first arrival to long after the last.
    ///
    /// `near` are distances from every arrival, over its time, that are looked at too.
    pub(crate) fn interior(
        medium: &Medium,
        count: usize,
        near: &[f64],
    ) -> Result<Self, StudyError> {
        Self::new(
            "interior point, across the fronts",
            medium,
            INTERIOR,
            count,
            &ALL,
            near,
        )
    }

    /// The same point where all fields are smooth: inversions at their best.
    fn late(medium: &Medium, count: usize) -> Result<Self, StudyError> {
        let mut scene = Self::new(
            "interior point, after the last front",
            medium,
            INTERIOR,
            3 * count,
            &ALL,
            &[],
        )?;
        let last = scene.arrivals.last().copied().unwrap_or(0.0);
        let first = scene.times.partition_point(|&t| t < 1.05 * last);
        scene.times.drain(..first);
        scene.exact.drain(..first);
        Ok(scene)
    }

    /// w on the axis.
    pub(crate) fn axis(medium: &Medium, count: usize, near: &[f64]) -> Result<Self, StudyError> {
        Self::new("axis, w", medium, AXIS, count, &[1], near)
    }

    /// w at the centre of the surface over its static value: the kernel of the impact equation.
    pub(crate) fn surface(medium: &Medium, count: usize, near: &[f64]) -> Result<Self, StudyError> {
        let name = "surface centre, w";
        let mut scene = Self::new(name, medium, [0.0, 0.0], count, &[1], near)?;
        for (exact, t) in scene.exact.iter_mut().zip(&scene.times) {
            exact[1] = kausel::centre_step(medium, medium.kappa() * t);
        }
        scene.scale[1] = 1.0;
        Ok(scene)
    }

    fn new(
        name: &'static str,
        medium: &Medium,
        place: [f64; 2],
        count: usize,
        fields: &[usize],
        near: &[f64],
    ) -> Result<Self, StudyError> {
        let kernel = Kernel::new(medium, Profile::Hertz, 1e-14)?;
        let [r, z] = place;
        let arrivals = Arrivals::new(medium, Profile::Hertz, r, z)?;
        // from before the first arrival to long after the last, even in the logarithm
        let (first, last) = (0.8 * arrivals.first().max(0.1), 8.0 * arrivals.last());
        let mut times: Vec<f64> = (0..count)
            .map(|i| first * (last / first).powf(i as f64 / (count - 1) as f64))
            .collect();
        for arrival in arrivals.sorted() {
            times.extend(
                near.iter()
                    .flat_map(|d| [arrival * (1.0 - d), arrival * (1.0 + d)]),
            );
        }
        times.retain(|t| *t > 0.0);
        times.sort_by(f64::total_cmp);
        let rest = kernel.static_field(r, z)?;
        let mut scale = [f64::INFINITY; 6];
        for &f in fields {
            scale[f] = 0.0;
        }
        let mut exact = Vec::with_capacity(count);
        for &t in &times {
            let value = kernel.remainder(r, z, t)?.value;
            let whole: Six = std::array::from_fn(|f| value[f] + rest[f]);
            for f in 0..6 {
                scale[f] = scale[f].max(whole[f].abs());
            }
            exact.push(whole);
        }
        Ok(Self {
            name,
            place,
            times,
            arrivals: arrivals.sorted(),
            exact,
            scale,
        })
    }

    /// Keeps every n-th time.
    pub(crate) fn thin(&mut self, n: usize) {
        self.times = self.times.iter().step_by(n).copied().collect();
        self.exact = self.exact.iter().step_by(n).copied().collect();
    }

    /// w on the axis by Gaver-Stehfest in double-double arithmetic, and the integrand evaluations.
    pub(crate) fn extended(&self, medium: &Medium, weights: &ExtendedWeights) -> (Vec<Six>, u64) {
        let mut work = 0;
        let value = |&t: &f64| {
            let least = std::f64::consts::LN_2 / t;
            let transform = AxisTransform::new(medium, self.place[1], least);
            work += (weights.terms() * transform.nodes()) as u64;
            let w = stehfest_extended(weights, t, |s| transform.step(s));
            [0.0, w, 0.0, 0.0, 0.0, 0.0]
        };
        (self.times.iter().map(value).collect(), work)
    }

    /// Largest relative error over the fields at each time.
    pub(crate) fn errors_over_time(&self, values: &[Six]) -> Vec<f64> {
        self.relative(values)
            .chunks(6)
            .map(|chunk| Error::of(chunk).max)
            .collect()
    }

    fn relative(&self, values: &[Six]) -> Vec<f64> {
        let pairs = values.iter().zip(&self.exact);
        pairs
            .flat_map(|(v, e)| (0..6).map(|f| (v[f] - e[f]) / self.scale[f]))
            .collect()
    }

    /// The error over the fields of the scene.
    fn error(&self, values: &[Six]) -> Error {
        let live: Vec<bool> = self.scale.iter().map(|s| s.is_finite()).collect();
        let kept: Vec<f64> = self
            .relative(values)
            .into_iter()
            .enumerate()
            .filter(|(i, _)| live[i % 6])
            .map(|(_, e)| e)
            .collect();
        Error::of(&kept)
    }
}

/// One method at one setting: a closure that makes the values and counts its work.
struct Candidate<'a> {
    method: &'static str,
    setting: String,
    default_path: bool,
    run: Box<dyn Fn() -> (Vec<Six>, Option<u64>) + 'a>,
}

/// Measures every method in every scene.
pub(crate) fn measure(
    effort: Effort,
    densities: &[Density],
    progress: &dyn Progress,
) -> Result<Vec<Record>, StudyError> {
    let medium = Medium::new(POISSON_RATIO)?;
    let count = effort.pick(8, 40);
    let near = effort.pick(&NEAR[..1], &NEAR[..]);
    let mut records = Vec::new();
    let scenes = [
        KernelScene::interior(&medium, count, near)?,
        KernelScene::late(&medium, count)?,
        KernelScene::axis(&medium, count, near)?,
        KernelScene::surface(&medium, count, near)?,
    ];
    let mut work = Vec::new();
    for scene in &scenes {
        let mut candidates = single_integrals(&medium, scene, effort)?;
        candidates.extend(inversions(&medium, scene, effort));
        if scene.place == [0.0, 0.0] {
            candidates.extend(closed_forms(&medium, scene));
        }
        if scene.place == AXIS {
            candidates.extend(extended(&medium, scene, effort));
        }
        work.extend(candidates.into_iter().map(|candidate| (scene, candidate)));
    }
    progress.total("kernels", work.len() as u64 + 1);
    for (scene, candidate) in &work {
        records.push(take(effort, scene, candidate));
        progress.advance(1);
    }
    records.extend(tables(&medium, &scenes[0], densities, effort)?);
    progress.advance(1);
    Ok(records)
}

fn take(effort: Effort, scene: &KernelScene, candidate: &Candidate<'_>) -> Record {
    let (mut values, mut work) = (Vec::new(), None);
    let cost = effort.clock().time(scene.times.len() as f64, || {
        (values, work) = black_box((candidate.run)());
    });
    Record {
        question: Question::Kernels,
        scene: scene.name,
        method: candidate.method,
        setting: candidate.setting.clone(),
        default_path: candidate.default_path,
        cost,
        error: scene.error(&values),
        work: work.map(|work| work as f64 / scene.times.len() as f64),
        refusal: None,
    }
}

/// The program's kernel at several tolerances and the fixed rule at several node counts.
fn single_integrals<'a>(
    medium: &'a Medium,
    scene: &'a KernelScene,
    effort: Effort,
) -> Result<Vec<Candidate<'a>>, StudyError> {
    let [r, z] = scene.place;
    let mut candidates = Vec::new();
    let unit = if z > 0.0 {
        1.0
    } else {
        1.0 / (0.375 * (1.0 - medium.poisson_ratio()))
    };
    let rest = Kernel::new(medium, Profile::Hertz, 1e-6)?.static_field(r, z)?;
    let whole = move |value: Six| -> Six { std::array::from_fn(|f| (value[f] + rest[f]) * unit) };
    for digits in (1..=13).step_by(effort.pick(2, 1)) {
        let tolerance = 10.0_f64.powi(-digits);
        let kernel = Kernel::new(medium, Profile::Hertz, tolerance)?;
        candidates.push(Candidate {
            method: "single integral",
            setting: format!("tolerance {tolerance:.0e}"),
            default_path: z > 0.0,
            run: Box::new(move || {
                let value = |&t: &f64| match kernel.remainder(r, z, t) {
                    Ok(estimate) => whole(estimate.value),
                    Err(_) => [f64::NAN; 6],
                };
                (scene.times.iter().map(value).collect(), None)
            }),
        });
    }
    for points in effort.pick(vec![6, 12, 24], vec![4, 6, 8, 12, 16, 24, 32, 48]) {
        candidates.push(Candidate {
            method: "single integral, fixed rule",
            setting: format!("{points} nodes a panel"),
            default_path: false,
            run: Box::new(move || {
                let mut work = 0;
                let values = scene
                    .times
                    .iter()
                    .map(|&t| {
                        // the closed forms do not know causality
                        let (value, count) = remainder(medium, [r, z, t], points);
                        work += count;
                        whole(value)
                    })
                    .collect();
                (values, Some(work))
            }),
        });
    }
    Ok(candidates)
}

fn inversions<'a>(
    medium: &'a Medium,
    scene: &'a KernelScene,
    effort: Effort,
) -> Vec<Candidate<'a>> {
    Inversion::all(effort)
        .into_iter()
        .map(|method| {
            let prepared = method.prepare();
            Candidate {
                method: method.name(),
                setting: method.setting(),
                default_path: false,
                run: Box::new(move || {
                    let (values, work) =
                        prepared.run(medium, scene.place, method.digits(), &scene.times);
                    (values, Some(work))
                }),
            }
        })
        .collect()
}

/// What the impact equation uses, and what it is compared with.
fn closed_forms<'a>(medium: &'a Medium, scene: &'a KernelScene) -> Vec<Candidate<'a>> {
    let at_centre = |w: f64| [0.0, w, 0.0, 0.0, 0.0, 0.0];
    let response = SurfaceResponse::new(medium, Deflection::Centre);
    vec![
        Candidate {
            method: "surface response",
            setting: "fitted once".to_owned(),
            default_path: true,
            run: Box::new(move || {
                let value = |&t: &f64| at_centre(response.step(t));
                (scene.times.iter().map(value).collect(), None)
            }),
        },
        Candidate {
            method: "closed form (Kausel): the reference",
            setting: "no settings".to_owned(),
            default_path: false,
            run: Box::new(move || {
                let value = |&t: &f64| at_centre(kausel::centre_step(medium, medium.kappa() * t));
                (scene.times.iter().map(value).collect(), None)
            }),
        },
    ]
}

fn extended<'a>(medium: &'a Medium, scene: &'a KernelScene, effort: Effort) -> Vec<Candidate<'a>> {
    effort
        .pick(vec![26], vec![18, 22, 26, 30])
        .into_iter()
        .map(|terms| {
            let weights = ExtendedWeights::new(terms);
            Candidate {
                method: "Gaver-Stehfest, 31 digits",
                setting: format!("{terms} terms"),
                default_path: false,
                run: Box::new(move || {
                    let (values, work) = scene.extended(medium, &weights);
                    (values, Some(work))
                }),
            }
        })
        .collect()
}

/// Averages over time cells, looked up in tables of several densities with stencils of several orders.
fn tables(
    medium: &Medium,
    scene: &KernelScene,
    densities: &[Density],
    effort: Effort,
) -> Result<Vec<Record>, StudyError> {
    let [r, z] = scene.place;
    let last = scene.times.last().copied().unwrap_or(1.0);
    let exact_kernel = Kernel::new(medium, Profile::Hertz, 1e-12)?;
    let mut records = Vec::new();
    for density in densities {
        for points in effort.pick(vec![4, Density::points()], vec![2, 4, 6, 8]) {
            let table = density.with_stencil(points)?;
            let width = table.cell_width(medium.poisson_ratio())?;
            let count = (last / width) as usize;
            let mut exact = vec![[0.0; 6]; count];
            exact_kernel
                .trace(r, z, count as f64 * width)?
                .for_each_cell(width, count, |j, [average, ..]| exact[j] = average)?;
            let mut cells = vec![[0.0; 6]; count];
            table.trace(medium.poisson_ratio(), r, z, 0, &mut cells)?;
            let mut errors = Vec::new();
            for (a, b) in cells.iter().zip(&exact) {
                errors.extend((0..6).map(|f| (a[f] - b[f]) / scene.scale[f]));
            }
            let cost = effort.clock().time(count as f64, || {
                let _ = black_box(table.trace(medium.poisson_ratio(), r, z, 0, &mut cells));
            });
            records.push(Record {
                question: Question::Kernels,
                scene: scene.name,
                method: "table",
                setting: format!("{}, {points} points", density.spacing.label()),
                default_path: density.is_default(points),
                cost,
                error: Error::of(&errors),
                work: Some(0.0),
                refusal: None,
            });
        }
    }
    Ok(records)
}
