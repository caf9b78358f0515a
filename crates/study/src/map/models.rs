//! Which model a scene needs: the plane of the two dimensionless groups.
//!
//! Static deflection over indentation is the half-space's part phi of the contact's compliance for a contact
//! that follows the load, and the coupling of a fixed disc; memory is the time that the waves need across the
//! contact, over Hertz's contact time.

use crate::StudyError;
use crate::effort::Effort;
use crate::marching::Results;
use crate::picture::Picture;
use crate::record::Error;
use crate::scenes::{ball, collision};
use contact::law::area_dashpot::AreaDashpot;
use contact::law::hertz::CONTACT_TIME;
use contact::law::radiation::{LARGEST_LAG, radiation};
use contact::{
    GrowingContact, Library, MarchError, PunchWaves, Rung, Summary, choose, march_growing,
};
use figure::{Axis, Interval, Style};
use halfspace::{Deflection, Medium, SurfaceResponse};
use impact::Impact;

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

/// Errors of the cheaper models at one place of the plane, largest over peak force, contact time, restitution
/// and peak displacement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModelErrors {
    /// No waves.
    pub hertz: f64,
    /// First-order radiated loss.
    pub radiation: f64,
    /// Dashpot on the contact's area.
    pub dashpot: f64,
    /// Change of the march that they are compared with over the last halving of its step.
    pub march: f64,
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
    pub fn new(poisson_ratio: f64) -> Result<Self, StudyError> {
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
    fn groups(&self, share: f64, memory: f64) -> (f64, f64) {
        let lag = share * self.wave_time(memory) * self.centre.relaxation_time();
        (lag, memory * CONTACT_TIME)
    }

    /// What `auto` chooses there.
    #[must_use]
    pub fn chosen(&self, share: f64, memory: f64, tolerance: f64) -> Rung {
        let (lag, memory) = self.groups(share, memory);
        choose(lag, memory, tolerance, None).rung
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
        let exact = Results::from(&found?);
        let march = match summary(&growing, 2.0 * step) {
            Ok(coarse) => Error::of(&Results::from(&coarse).errors(&exact)).max,
            Err(_) => f64::INFINITY,
        };
        let of = |lag: f64| Error::of(&Results::from(&radiation(lag)).errors(&exact)).max;
        let (lag, length) = self.groups(share, memory);
        let terms = AreaDashpot::new(share, self.wave_time(memory), &self.waves);
        let dashpot = Results::from(&terms.summary());
        Ok(ModelErrors {
            hertz: of(0.0),
            // beyond it the program refuses the first-order law
            radiation: if lag <= LARGEST_LAG {
                of(lag)
            } else {
                f64::INFINITY
            },
            // and the expansion beyond its own bounds
            dashpot: if terms.left_out(length).contact() < 1.0 {
                Error::of(&dashpot.errors(&exact)).max
            } else {
                f64::INFINITY
            },
            march,
        })
    }

    /// Memory at which `auto` leaves a rung for the next, at a share.
    #[must_use]
    pub fn boundary(&self, share: f64, tolerance: f64, leaves: Rung) -> f64 {
        memory_of_change(1e-9, leaves, |memory| self.chosen(share, memory, tolerance))
    }
}

/// Largest memory, from `low` to 1e3, at which `auto` has not yet left a rung for the next.
pub(super) fn memory_of_change(low: f64, leaves: Rung, chosen: impl Fn(f64) -> Rung) -> f64 {
    let (mut low, mut high) = (low, 1e3_f64);
    for _ in 0..60 {
        let middle = (low * high).sqrt();
        let cheap = match chosen(middle) {
            Rung::QuasiStatic => true,
            Rung::Radiation | Rung::AreaDashpot => leaves != Rung::QuasiStatic,
            Rung::FullMemory => false,
        };
        if cheap {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Where a steel ball on a material of the library lies in the plane.
///
/// # Errors
/// When the library's material makes no scene.
pub fn place_of(target: &str, velocity_m_s: f64) -> Result<(f64, f64), StudyError> {
    let collision = collision(&ball(target, velocity_m_s)?);
    let centre = SurfaceResponse::new(
        &Medium::new(collision.target_poisson_ratio)?,
        Deflection::Centre,
    );
    let memory = 2.0 * centre.memory() * collision.contact_wave_time();
    Ok((collision.target_share(), memory / CONTACT_TIME))
}

/// The impact of such a point with model `auto` at a tolerance.
///
/// # Errors
/// When the library's material makes no half-space.
pub fn ball_impact(target: &str, velocity_m_s: f64, tolerance: f64) -> Result<Impact, StudyError> {
    Ok(ball(target, velocity_m_s)?.to_tolerance(tolerance))
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

/// The lines at which `auto` leaves a rung.
const LEAVES: [(&str, Rung, Style); 2] = [
    ("auto leaves hertz", Rung::QuasiStatic, Style::Heavy),
    (
        "auto leaves the area dashpot",
        Rung::AreaDashpot,
        Style::HeavyDashed,
    ),
];

/// A picture a tolerance.
pub(crate) fn figures(effort: Effort, advance: &dyn Fn()) -> Result<Vec<Picture>, StudyError> {
    let plane = Plane::new(0.3)?;
    let x = Interval::logarithmic(0.01, 1.15);
    let y = Interval::logarithmic(1e-4, 3.0);
    let shape = shape(effort);
    let steps = effort.pick(128, 192);
    let mut errors = Vec::new();
    for &memory in &y.cells(shape[1]) {
        for &share in &x.cells(shape[0]) {
            // the half-space has all of the compliance at most
            errors.push(plane.errors(share.min(1.0), memory, steps)?);
        }
        advance();
    }
    let mut points = [Vec::new(), Vec::new(), Vec::new()];
    for target in targets() {
        for (list, speed) in points.iter_mut().zip(SPEEDS_M_S) {
            list.push(place_of(&target, speed)?);
        }
    }
    let mut figures = Vec::new();
    for (name, tolerance) in ["models-1e-2", "models-1e-3", "models-1e-4"]
        .into_iter()
        .zip(TOLERANCES)
    {
        let mut figure = Picture::new(
            name,
            &format!("Cheapest model that meets {tolerance:.0e}"),
            Axis::over(x, "static deflection of the half-space over indentation"),
            Axis::over(y, "memory over contact time"),
        );
        let mut cells = errors.iter();
        figure.map(
            [x, y],
            shape,
            &[
                "hertz",
                "radiation",
                "area dashpot",
                "growing",
                "growing, not yet converged to 1e-2",
            ],
            |_, _| match cells.next() {
                Some(e) if e.hertz <= tolerance => 0,
                Some(e) if e.radiation <= tolerance => 1,
                Some(e) if e.dashpot <= tolerance => 2,
                Some(e) if e.march <= UNSETTLED => 3,
                Some(_) | None => 4,
            },
        );
        for (label, rung, style) in LEAVES {
            let line = x
                .cells(40)
                .into_iter()
                .map(|share| (share, plane.boundary(share, tolerance, rung)));
            figure.curve(label, style, line.collect());
        }
        for (list, speed) in points.iter().zip(SPEEDS_M_S) {
            figure.curve(
                &format!("steel ball on each material, {speed} m/s"),
                Style::Points,
                list.clone(),
            );
        }
        figure.caption = format!(
            "Regions are computed: each model against the converged growing contact, largest error of peak force, \
             contact time, restitution and peak displacement. The lines are where `auto` changes model at a tolerance \
             of {tolerance:.0e}. In the darkest region the contact at first grows faster than the waves: the force of \
             `growing` starts with a spike there that does not stand still when {steps} steps are made twice as long, \
             and step control refuses it. `auto` never takes a model that misses, and its estimate for hertz is {} times the error \
             found in the middle of the plane.",
            ratio(&plane, &errors, shape, x, y)
        );
        figures.push(figure);
    }
    Ok(figures)
}

/// `auto`'s estimate of what hertz leaves out over the error found, in the middle of the plane.
fn ratio(
    plane: &Plane,
    errors: &[ModelErrors],
    shape: [usize; 2],
    x: Interval,
    y: Interval,
) -> String {
    let (i, k) = (shape[0] / 2, shape[1] / 2);
    let (lag, memory) = plane.groups(x.cells(shape[0])[i], y.cells(shape[1])[k]);
    let estimate = choose(lag, memory, f64::INFINITY, None).error;
    format!("{:.1}", estimate / errors[k * shape[0] + i].hertz)
}
