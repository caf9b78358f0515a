//! Which model a scene needs: the plane of the two dimensionless groups.
//!
//! Static deflection over indentation is the half-space's part phi of the contact's compliance for a contact
//! that follows the load, and the coupling of a fixed disc, the paper's, whose whole deflection is added to Hertz's
//! indentation; memory is the time that the waves need across the contact, over Hertz's contact time.

use super::Map;
use super::marches::bisected;
use crate::measure::Effort;
use crate::picture::Picture;
use crate::question::marching::{Results, errors, results};
use crate::record::sizes;
use crate::scenes::{ROD_RADIUS_M, TABLE_1_PA, ball, collision, paper};
use contact::law::area_dashpot::{AreaDashpot, left_out};
use contact::law::hertz::CONTACT_TIME;
use contact::law::quasi_static::{quasi_static, quasi_static_radiation};
use contact::law::radiation::{LARGEST_LAG, LOSS, radiation};
use contact::{Accuracy, FixedDisc, GrowingContact, Library, MarchError, PunchWaves};
use contact::{Family, Groups, Rung};
use contact::{StaticShare, Summary, march_growing, march_implicit, refine};
use fault::AnyError;
use figure::{Interval, Layer, Style};
use halfspace::{Deflection, Medium, SurfaceResponse};

/// Tolerances of the three pictures.
pub const TOLERANCES: [f64; 3] = [1e-2, 1e-3, 1e-4];

/// Speeds of the built-in materials' points in m/s.
pub const SPEEDS_M_S: [f64; 3] = [1.0, 10.0, 100.0];

/// The plane of contacts that follow the load, at one Poisson ratio.
#[derive(Debug)]
pub struct Plane {
    centre: SurfaceResponse,
    waves: PunchWaves,
}

/// Errors of the cheaper models at one place of a plane, largest over peak force, contact time, restitution
/// and peak displacement; infinite where the program refuses the model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModelErrors {
    /// No waves: Hertz, or two springs.
    pub quasi_static: f64,
    /// First-order radiated loss.
    pub radiation: f64,
    /// Dashpot on the area of a contact that follows the load.
    pub dashpot: f64,
    /// Change of the march that they are compared with over the last halving of its step.
    pub march: f64,
}

impl ModelErrors {
    /// The cheapest model that meets a tolerance: 3 is the march, 4 the march where it has not converged.
    fn cheapest(&self, tolerance: f64) -> usize {
        let cheaper = [self.quasi_static, self.radiation, self.dashpot];
        let found = cheaper.into_iter().position(|error| error <= tolerance);
        found.unwrap_or(if self.march <= UNSETTLED { 3 } else { 4 })
    }
}

/// The largest error of a model's results, or infinite where it is beyond its bounds.
fn error(is_allowed: bool, found: &Summary, exact: &Results) -> f64 {
    if is_allowed {
        sizes(&errors(&results(found), exact))[0]
    } else {
        f64::INFINITY
    }
}

/// A march that changes by more when its step is halved is said not to have converged.
const UNSETTLED: f64 = 1e-2;

/// How often a step that is too long is halved.
const MOST_HALVINGS: usize = 5;

fn summary(growing: &GrowingContact<'_>, step: f64) -> Result<Summary, MarchError> {
    Summary::new(&march_growing(growing, step)?)
}

impl Plane {
    /// The contact at a place of the plane.
    #[must_use]
    pub fn contact(&self, share: f64, memory: f64) -> GrowingContact<'_> {
        GrowingContact {
            waves: &self.waves,
            target_share: share,
            wave_time: self.wave_time(memory),
        }
    }

    /// The plane at a Poisson ratio.
    ///
    /// # Errors
    /// When the ratio is outside (-1, 0.5).
    pub fn new(poisson_ratio: f64) -> Result<Self, AnyError> {
        let medium = Medium::new(poisson_ratio)?;
        Ok(Self {
            waves: PunchWaves::new(&medium),
            centre: SurfaceResponse::new(&medium, Deflection::Centre),
        })
    }

    /// a/c1 in collision times for a memory over contact time.
    fn wave_time(&self, memory: f64) -> f64 {
        memory * CONTACT_TIME / (2.0 * self.centre.memory())
    }

    /// The lag of the radiation model and the memory in collision times, as `auto` forms them.
    fn groups(&self, share: f64, memory: f64) -> Groups {
        Groups {
            family: Family::Growing,
            coupling: 0.0,
            lag: share * self.wave_time(memory) * self.centre.relaxation_time(),
            memory: memory * CONTACT_TIME,
        }
    }

    /// What `auto` chooses there.
    #[must_use]
    pub fn chosen(&self, share: f64, memory: f64, tolerance: f64) -> Rung {
        let asked = Accuracy::of_contact(tolerance, None);
        self.groups(share, memory).choose(&asked).0
    }

    /// Errors of the cheaper models against the growing contact with `steps` steps over Hertz's contact time.
    ///
    /// Where that is too coarse to hold the start of a very fast contact the step is halved, as step control does.
    ///
    /// # Errors
    /// Those of the march.
    pub fn errors(&self, share: f64, memory: f64, steps: usize) -> Result<ModelErrors, MarchError> {
        let growing = self.contact(share, memory);
        let mut step = CONTACT_TIME / steps as f64;
        let mut found = summary(&growing, step);
        for _ in 0..MOST_HALVINGS {
            if matches!(found, Err(MarchError::StepTooLong { .. })) {
                step *= 0.5;
                found = summary(&growing, step);
            }
        }
        let exact = results(&found?);
        let march = match summary(&growing, 2.0 * step) {
            Ok(coarse) => error(true, &coarse, &exact),
            Err(_) => f64::INFINITY,
        };
        let Groups {
            lag,
            memory: length,
            ..
        } = self.groups(share, memory);
        let dashpot = AreaDashpot::new(share, self.wave_time(memory), &self.waves);
        let is_allowed = left_out(dashpot.lag, length).contact() < 1.0;
        Ok(ModelErrors {
            quasi_static: error(true, &radiation(0.0), &exact),
            radiation: error(lag <= LARGEST_LAG, &radiation(lag), &exact),
            dashpot: error(is_allowed, &dashpot.summary(), &exact),
            march,
        })
    }

    /// Memory at which `auto` leaves a rung for the next, at a share.
    #[must_use]
    pub fn boundary(&self, share: f64, tolerance: f64, leaves: Rung) -> f64 {
        memory_of_change(1e-9, leaves, |memory| self.chosen(share, memory, tolerance))
    }
}

/// Accuracy of the march that models of a fixed disc are compared with.
const ACCURACY: f64 = 1e-5;

/// Errors of the cheaper models of a fixed disc against the implicit march.
///
/// # Errors
/// Those of the march.
pub fn disc_errors(disc: &FixedDisc<'_>) -> Result<ModelErrors, MarchError> {
    let (springs, loss_per_lag) = quasi_static(disc.coupling);
    let accuracy = Accuracy::of_contact(ACCURACY, None);
    let march = |step| march_implicit(disc, step);
    let first = springs.contact_time / accuracy.first_steps();
    let exact = results(&refine(march, first, accuracy)?.summary);
    let with_loss = |lag: f64| quasi_static_radiation(disc.coupling, lag);
    let lag = disc_groups(disc).lag;
    let is_allowed = loss_per_lag * lag <= LOSS * LARGEST_LAG;
    Ok(ModelErrors {
        quasi_static: error(true, &with_loss(0.0), &exact),
        radiation: error(is_allowed, &with_loss(lag), &exact),
        dashpot: f64::INFINITY,
        march: ACCURACY,
    })
}

/// What `auto` chooses for a disc at a tolerance.
#[must_use]
pub fn disc_chosen(disc: &FixedDisc<'_>, tolerance: f64) -> Rung {
    let asked = Accuracy::of_contact(tolerance, None);
    disc_groups(disc).choose(&asked).0
}

fn disc_groups(disc: &FixedDisc<'_>) -> Groups {
    Groups {
        family: Family::Full,
        coupling: disc.coupling,
        lag: disc.coupling * disc.wave_time * disc.response.relaxation_time(),
        memory: disc.memory(),
    }
}

/// The paper's disc with other groups.
#[must_use]
pub fn disc_at<'a>(like: &FixedDisc<'a>, coupling: f64, memory: f64) -> FixedDisc<'a> {
    FixedDisc {
        coupling,
        wave_time: memory * CONTACT_TIME / like.response.memory(),
        share: StaticShare::Full,
        ..*like
    }
}

/// Largest memory, from `low` to 1e3, at which `auto` has not yet left a rung for the next.
fn memory_of_change(low: f64, leaves: Rung, chosen: impl Fn(f64) -> Rung) -> f64 {
    let stays = |memory: f64| match chosen(memory.exp()) {
        Rung::QuasiStatic => true,
        Rung::Radiation | Rung::AreaDashpot => leaves != Rung::QuasiStatic,
        Rung::FullMemory => false,
    };
    bisected(low.ln(), 1e3_f64.ln(), stays).exp()
}

/// Where a steel ball on a material of the library lies in the plane.
///
/// # Errors
/// When the library's material makes no scene.
pub fn place_of(target: &str, velocity_m_s: f64) -> Result<(f64, f64), AnyError> {
    let collision = collision(&ball(target, velocity_m_s)?);
    let centre = SurfaceResponse::new(
        &Medium::new(collision.target_poisson_ratio)?,
        Deflection::Centre,
    );
    let memory = 2.0 * centre.memory() * collision.contact_wave_time();
    Ok((collision.target_share(), memory / CONTACT_TIME))
}

/// Names of the built-in materials that can be a target: those with a density.
#[must_use]
pub fn targets() -> Vec<String> {
    Library::built_in()
        .iter()
        .filter(|material| material.density_kg_m3.is_some())
        .map(|material| material.name.clone())
        .collect()
}

fn shape(effort: Effort) -> [usize; 2] {
    effort.pick([12, 14], [32, 40])
}

/// Rows of the plane, for the progress bar.
pub(crate) fn rows(effort: Effort) -> u64 {
    shape(effort)[1] as u64
}

/// The ordinate of both planes.
const MEMORY: &str = "memory over contact time";

/// The errors of the models in each cell of a map.
fn computed(
    map: &Map<'_>,
    at: impl Fn(f64, f64) -> Result<ModelErrors, MarchError>,
    advance: &dyn Fn(),
) -> Result<Vec<ModelErrors>, AnyError> {
    let (columns, mut errors) = (map.columns(), Vec::new());
    for memory in map.plane[1].cells(map.shape[1]) {
        for &deflection in &columns {
            errors.push(at(deflection, memory)?);
        }
        advance();
    }
    Ok(errors)
}

/// The cheapest model that meets a tolerance in each cell, and the memory at which `auto` leaves some.
fn picture(
    map: &Map<'_>,
    [name, what]: [&'static str; 2],
    tolerance: f64,
    errors: &[ModelErrors],
    leaves: [(&str, Rung); 2],
    points: usize,
    memory: impl Fn(f64, Rung) -> f64,
) -> Picture {
    let title = format!("{what} that meets {tolerance:.0e}");
    let last = map.classes.len() - 1;
    let class = |cell: usize, _| errors[cell].cheapest(tolerance).min(last);
    let mut figure = map.picture(name, &title, class);
    let styles = [Style::Heavy, Style::HeavyDashed];
    for ((label, rung), style) in leaves.into_iter().zip(styles) {
        let line = map.line(points, |x| memory(x, rung));
        figure.add(Layer::line(label, style, line));
    }
    figure
}

/// A picture a tolerance for contacts that follow the load, then for the paper's disc.
pub(crate) fn figures(effort: Effort, advance: &dyn Fn()) -> Result<Vec<Picture>, AnyError> {
    let mut figures = growing_figures(effort, advance)?;
    figures.extend(disc_figures(effort)?);
    advance();
    Ok(figures)
}

fn growing_figures(effort: Effort, advance: &dyn Fn()) -> Result<Vec<Picture>, AnyError> {
    let plane = Plane::new(0.3)?;
    let x = Interval::logarithmic(0.01, 1.15);
    let y = Interval::logarithmic(1e-4, 3.0);
    let shape = shape(effort);
    let map = Map {
        plane: [x, y],
        quantities: [
            "static deflection of the half-space over indentation",
            MEMORY,
        ],
        shape,
        classes: &[
            "hertz",
            "radiation",
            "area dashpot",
            "growing",
            "growing, not yet converged to 1e-2",
        ],
    };
    let steps = effort.pick(128, 192);
    // the half-space has all of the compliance at most
    let at = |share: f64, memory| plane.errors(share.min(1.0), memory, steps);
    let errors = computed(&map, at, advance)?;
    // `auto`'s estimate of what hertz leaves out over the error found, in the middle of the plane
    let (i, k) = (shape[0] / 2, shape[1] / 2);
    let groups = plane.groups(x.cells(shape[0])[i], y.cells(shape[1])[k]);
    let (_, estimate) = groups.choose(&Accuracy::of_contact(f64::INFINITY, None));
    let ratio = estimate / errors[k * shape[0] + i].quasi_static;
    let mut figures = Vec::new();
    let names = ["models-1e-2", "models-1e-3", "models-1e-4"];
    for (name, tolerance) in names.into_iter().zip(TOLERANCES) {
        let leaves = [
            ("auto leaves hertz", Rung::QuasiStatic),
            ("auto leaves the area dashpot", Rung::AreaDashpot),
        ];
        let names = [name, "Cheapest model"];
        let memory = |x, rung| plane.boundary(x, tolerance, rung);
        let mut figure = picture(&map, names, tolerance, &errors, leaves, 40, memory);
        for speed in SPEEDS_M_S {
            let targets = targets();
            let places = targets.iter().map(|target| place_of(target, speed));
            let places = places.collect::<Result<_, _>>()?;
            let label = format!("steel ball on each material, {speed} m/s");
            figure.add(Layer::line(&label, Style::Points, places));
        }
        figure.caption = format!(
            "Regions are computed: each model against the converged growing contact, largest error of peak force, \
             contact time, restitution and peak displacement. The lines are where `auto` changes model at a tolerance \
             of {tolerance:.0e}. In the darkest region the contact at first grows faster than the waves: the force of \
             `growing` starts with a spike there that does not stand still when {steps} steps are made twice as long, \
             and step control refuses it. `auto` never takes a model that misses, and its estimate for hertz is {ratio:.1} times the error \
             found in the middle of the plane."
        );
        figures.push(figure);
    }
    Ok(figures)
}

fn disc_figures(effort: Effort) -> Result<Vec<Picture>, AnyError> {
    let response = SurfaceResponse::new(&Medium::new(0.3)?, Deflection::Centre);
    let paper = paper(TABLE_1_PA)?.fixed_disc(&response, ROD_RADIUS_M, StaticShare::Full);
    let map = Map {
        plane: [
            Interval::logarithmic(1e-3, 10.0),
            Interval::logarithmic(1e-4, 1.0),
        ],
        quantities: ["static deflection over indentation (coupling)", MEMORY],
        shape: effort.pick([14, 12], [40, 40]),
        classes: &["two springs", "two springs and first-order loss", "wave"],
    };
    let at = |coupling, memory| disc_errors(&disc_at(&paper, coupling, memory));
    let errors = computed(&map, at, &|| ())?;
    let what = "Cheapest model of the paper's fixed disc";
    let names = ["models-disc-1e-2", "models-disc-1e-3", "models-disc-1e-4"];
    let figures = names.into_iter().zip(TOLERANCES).map(|(name, tolerance)| {
        let leaves = [
            ("auto leaves two springs", Rung::QuasiStatic),
            ("auto leaves the first-order loss", Rung::Radiation),
        ];
        let memory = |coupling, rung| {
            let chosen = |memory| disc_chosen(&disc_at(&paper, coupling, memory), tolerance);
            memory_of_change(1e-12, rung, chosen)
        };
        let mut figure = picture(&map, [name, what], tolerance, &errors, leaves, 60, memory);
        // half of the first-order loss is the error of the restitution of two springs
        let loss = 2.0 * tolerance;
        let theory = map.line(60, |coupling| {
            let lag = loss / quasi_static(coupling).1;
            let wave_time = lag / (coupling * response.relaxation_time());
            wave_time * response.memory() / CONTACT_TIME
        });
        let label = format!("theory: first-order loss of {loss:.0e}");
        figure.add(Layer::line(&label, Style::Dotted, theory));
        let place = (paper.coupling, paper.memory() / CONTACT_TIME);
        figure.add(Layer::star(place, "paper's case"));
        figure.caption = format!(
            "With the full share the half-space is a second spring; the waves are seen by their radiated loss, first \
             order in the memory, and then by their shape. Regions are computed against the implicit march; the lines \
             are where `auto` changes model at a tolerance of {tolerance:.0e}."
        );
        figure
    });
    Ok(figures.collect())
}
