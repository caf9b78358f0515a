//! Contact model that a scene needs, in the plane of the two dimensionless numbers of the regime.
//!
//! Static deflection over indentation: for a contact whose radius follows the load, the half-space's part phi of the
//! compliance; for the paper's fixed disc, whose whole deflection is added to Hertz's indentation, the coupling.
//! Memory: the time that waves need to cross the contact, over Hertz's contact time.

use super::StabilityMap;
use crate::measure::Effort;
use crate::picture::Picture;
use crate::question::marching::errors;
use crate::record::sizes;
use crate::scenes::{ball, paper_disc};
use contact::law::area_dashpot::{AreaDashpot, left_out};
use contact::law::hertz::CONTACT_TIME;
use contact::law::quasi_static::{quasi_static, quasi_static_radiation};
use contact::law::radiation::{MOST_LOSS, radiation};
use contact::{Accuracy, FixedDisc, GrowingContact, Library, MarchError, Material, PunchWaves};
use contact::{Memory, Physics, Regime};
use contact::{StaticShare, Summary, march_implicit, refine, solve_growing};
use fault::AnyError;
use figure::{Interval, Layer, Style};
use halfspace::{Deflection, Medium, SurfaceResponse, bisected};
use paper::TABLE_1_PA;

/// Tolerances of the three pictures.
pub(super) const TOLERANCES: [f64; 3] = [1e-2, 1e-3, 1e-4];

/// Velocities in m/s for the points of the built-in materials.
pub(super) const SPEEDS_M_S: [f64; 3] = [1.0, 10.0, 100.0];

/// Accuracy of the reference, the contact with memory.
const ACCURACY: f64 = 1e-5;

/// Largest part of the compliance of a growing contact that comes from the half-space. For a rigid striker, 1, the
/// contact begins with a jump of its radius that no march can follow.
const MOST_SHARE: f64 = 0.9999;

/// Errors of the cheaper models at one place of a plane, the largest over peak force, contact time, restitution and
/// peak displacement; infinite if the program rejects the model.
#[derive(Debug)]
pub(super) struct ModelErrors {
    /// No waves: Hertz, or two springs.
    pub(super) quasi_static: f64,
    /// First-order radiated loss.
    pub(super) radiation: f64,
    /// Dashpot on the area of a contact that follows the load.
    pub(super) dashpot: f64,
    /// Estimated error of the reference, the contact with memory; infinite if the program rejects it.
    pub(super) memory: f64,
}

impl ModelErrors {
    /// Index of the cheapest model that meets a tolerance: 3 is the contact with memory, 4 means none.
    fn cheapest(&self, tolerance: f64) -> usize {
        let cheaper = [self.quasi_static, self.radiation, self.dashpot];
        let found = cheaper.into_iter().position(|error| error <= tolerance);
        found.unwrap_or(if self.memory.is_finite() { 3 } else { 4 })
    }
}

/// The largest error of the results of a model; infinite outside its bounds.
fn error(is_allowed: bool, found: &Summary, exact: &Summary) -> f64 {
    let error = sizes(&errors(found, exact))[0];
    if is_allowed { error } else { f64::INFINITY }
}

/// The plane of a physics at a Poisson ratio: contacts whose radius follows the load ([`Physics::Growing`]), or the
/// paper's disc with other dimensionless groups ([`Physics::Disc`] with the full share).
pub(super) struct Plane {
    physics: Physics,
    centre: SurfaceResponse,
    waves: PunchWaves,
}

impl Plane {
    pub(super) fn new(physics: Physics, poisson_ratio: f64) -> Result<Self, AnyError> {
        let medium = Medium::new(poisson_ratio)?;
        Ok(Self {
            physics,
            waves: PunchWaves::new(&medium),
            centre: SurfaceResponse::new(&medium, Deflection::Centre),
        })
    }

    /// A contact that follows the load.
    pub(super) fn growing(&self, share: f64, memory: f64) -> GrowingContact<'_> {
        GrowingContact {
            waves: &self.waves,
            target_share: share,
            wave_time: memory * CONTACT_TIME / (2.0 * self.centre.disc.memory),
        }
    }

    /// A disc.
    fn disc(&self, coupling: f64, memory: f64) -> FixedDisc<'_> {
        FixedDisc {
            response: &self.centre,
            coupling,
            wave_time: memory * CONTACT_TIME / self.centre.disc.memory,
            share: StaticShare::Full,
        }
    }

    /// The dimensionless numbers by which `auto` chooses.
    fn regime(&self, deflection: f64, memory: f64) -> Regime {
        let (wave_time, memory) = if self.physics == Physics::Disc(StaticShare::Full) {
            let disc = self.disc(deflection, memory);
            (disc.wave_time, disc.memory())
        } else {
            let wave_time = self.growing(deflection, memory).wave_time;
            (wave_time, memory * CONTACT_TIME)
        };
        Regime {
            physics: self.physics,
            coupling: deflection,
            lag: deflection * wave_time * self.centre.disc.relaxation_time,
            memory,
        }
    }

    /// The choice of `auto` at a place.
    pub(super) fn chosen(&self, deflection: f64, memory: f64, tolerance: f64) -> Memory {
        let asked = Accuracy::of_contact(tolerance, None);
        self.regime(deflection, memory).choose(&asked).0
    }

    /// Largest memory, up to 1e3, at which `auto` still uses a model rather than the next one.
    pub(super) fn boundary(&self, deflection: f64, tolerance: f64, leaves: Memory) -> f64 {
        let low: f64 = if self.physics == Physics::Disc(StaticShare::Full) {
            1e-12
        } else {
            1e-9
        };
        let stays = |memory: f64| match self.chosen(deflection, memory.exp(), tolerance) {
            Memory::None => true,
            Memory::FirstOrder | Memory::Dashpot => leaves != Memory::None,
            Memory::Full => false,
        };
        bisected(low.ln(), 1e3_f64.ln(), stays).exp()
    }

    /// Errors of the cheaper models, relative to the growing contact or to the implicit march of a disc.
    pub(super) fn errors(&self, deflection: f64, memory: f64) -> Result<ModelErrors, MarchError> {
        let is_disc = self.physics == Physics::Disc(StaticShare::Full);
        let deflection = deflection.min(if is_disc { f64::INFINITY } else { MOST_SHARE });
        let regime = self.regime(deflection, memory);
        let lag_is_allowed = regime.first_order_loss() <= MOST_LOSS;
        if is_disc {
            let disc = self.disc(deflection, memory);
            let accuracy = Accuracy::of_contact(ACCURACY, None);
            let first = quasi_static(deflection).0.contact_time / accuracy.first_steps();
            let exact = refine(|step| march_implicit(&disc, step), first, accuracy)?.summary;
            let with_loss = |lag| quasi_static_radiation(deflection, lag);
            return Ok(ModelErrors {
                quasi_static: error(true, &with_loss(0.0), &exact),
                radiation: error(lag_is_allowed, &with_loss(regime.lag), &exact),
                dashpot: f64::INFINITY,
                memory: ACCURACY,
            });
        }
        let growing = self.growing(deflection, memory);
        let solved = match solve_growing(&growing, &Accuracy::of_contact(ACCURACY, None)) {
            Ok(solved) => solved,
            Err(
                MarchError::Overtaken { .. }
                | MarchError::StrikesAgain { .. }
                | MarchError::NotFollowed { .. }
                | MarchError::NotReached { .. },
            ) => {
                return Ok(ModelErrors {
                    quasi_static: f64::INFINITY,
                    radiation: f64::INFINITY,
                    dashpot: f64::INFINITY,
                    memory: f64::INFINITY,
                });
            }
            Err(error) => return Err(error),
        };
        let exact = solved.summary;
        let dashpot = AreaDashpot::new(&growing);
        let is_allowed = left_out(dashpot.lag, regime.memory).contact() < 1.0;
        Ok(ModelErrors {
            quasi_static: error(true, &radiation(0.0), &exact),
            radiation: error(lag_is_allowed, &radiation(regime.lag), &exact),
            dashpot: error(is_allowed, &dashpot.summary(), &exact),
            memory: solved.estimates.contact(),
        })
    }

    /// A picture for each tolerance: the cheapest model that meets it in each cell, the memory at which `auto` changes
    /// the model, and additional layers.
    fn pictures(
        &self,
        map: &StabilityMap<'_>,
        names: [&'static str; 3],
        advance: &dyn Fn(),
        add: impl Fn(&mut Picture, f64) -> Result<(), AnyError>,
    ) -> Result<Vec<Picture>, AnyError> {
        let (what, points, leaves) = if self.physics == Physics::Disc(StaticShare::Full) {
            let loss = ("auto leaves the first-order loss", Memory::FirstOrder);
            let leaves = [("auto leaves two springs", Memory::None), loss];
            ("Cheapest model of the paper's fixed disc", 60, leaves)
        } else {
            let dashpot = ("auto leaves the area dashpot", Memory::Dashpot);
            let leaves = [("auto leaves hertz", Memory::None), dashpot];
            ("Cheapest model", 40, leaves)
        };
        let mut errors = Vec::new();
        for memory in map.plane[1].cells(map.shape[1]) {
            for deflection in map.columns() {
                errors.push(self.errors(deflection, memory)?);
            }
            advance();
        }
        let last = map.classes.len() - 1;
        let pictures = names.into_iter().zip(TOLERANCES).map(|(name, tolerance)| {
            let title = format!("{what} that meets {tolerance:.0e}");
            let class = |cell: usize, _| errors[cell].cheapest(tolerance).min(last);
            let mut figure = map.picture(name, &title, class);
            let styles = [Style::Heavy, Style::HeavyDashed];
            for ((label, left), style) in leaves.into_iter().zip(styles) {
                let memory = |x| self.boundary(x, tolerance, left);
                figure.line(label, style, map.line(points, memory));
            }
            add(&mut figure, tolerance)?;
            Ok(figure)
        });
        pictures.collect()
    }
}

/// Place in the plane of a steel ball on a built-in material.
pub(super) fn place_of(target: &str, velocity_m_s: f64) -> Result<(f64, f64), AnyError> {
    let collision = ball(target, velocity_m_s)?.collision();
    let medium = Medium::new(collision.target_poisson_ratio)?;
    let centre = SurfaceResponse::new(&medium, Deflection::Centre);
    let memory = 2.0 * centre.disc.memory * collision.contact_wave_time();
    Ok((collision.target_share(), memory / CONTACT_TIME))
}

/// Names of the built-in materials that can be a target: those with a density.
pub(super) fn targets() -> impl Iterator<Item = &'static str> {
    let dense = |material: &&Material| material.density_kg_m3.is_some();
    let known = Library::built_in().iter().filter(dense);
    known.map(|material| &*material.name)
}

/// The ordinate of both planes.
const MEMORY: &str = "memory over contact time";

/// Pictures for each tolerance, of contacts whose radius follows the load and then of the paper's disc.
pub(crate) fn figures(effort: Effort, advance: &dyn Fn()) -> Result<Vec<Picture>, AnyError> {
    let mut figures = growing_figures(effort, advance)?;
    figures.extend(disc_figures(effort)?);
    advance();
    Ok(figures)
}

fn growing_figures(effort: Effort, advance: &dyn Fn()) -> Result<Vec<Picture>, AnyError> {
    let plane = Plane::new(Physics::Growing, 0.3)?;
    let shape = effort.pick([12, 14], [32, 40]);
    let [x, y] = [(0.01, 1.15), (1e-4, 3.0)].map(|(low, high)| Interval::logarithmic(low, high));
    let share = "static deflection of the half-space over indentation";
    let refused = "no model";
    let map = StabilityMap {
        plane: [x, y],
        quantities: [share, MEMORY],
        shape,
        classes: &["hertz", "radiation", "area dashpot", "growing", refused],
    };
    // `auto`'s estimate of the error of hertz over the true error, in the middle of the plane
    let [i, k] = shape.map(|cells| cells / 2);
    let (share, memory) = (x.cells(shape[0])[i], y.cells(shape[1])[k]);
    let any = Accuracy::of_contact(f64::INFINITY, None);
    let (_, estimate) = plane.regime(share, memory).choose(&any);
    let ratio = estimate / plane.errors(share, memory)?.quasi_static;
    let names = ["models-1e-2", "models-1e-3", "models-1e-4"];
    plane.pictures(&map, names, advance, |figure, tolerance| {
        for speed in SPEEDS_M_S {
            let places = targets().map(|target| place_of(target, speed));
            let label = format!("steel ball on each material, {speed} m/s");
            figure.line(&label, Style::Points, places.collect::<Result<_, _>>()?);
        }
        figure.caption = format!(
            "Regions are computed: each model against the converged growing contact, largest error of peak force, \
             contact time, restitution and peak displacement. The lines are where `auto` changes model at a tolerance \
             of {tolerance:.0e}. In the darkest region `growing` is refused: waves overtake each other or the surface strikes \
             again, and no other model is good there. `auto` never takes a model that misses, and its estimate for hertz is {ratio:.1} times the error \
             found in the middle of the plane."
        );
        Ok(())
    })
}

fn disc_figures(effort: Effort) -> Result<Vec<Picture>, AnyError> {
    let plane = Plane::new(Physics::Disc(StaticShare::Full), 0.3)?;
    let response = &plane.centre;
    let paper = paper_disc(TABLE_1_PA, response)?;
    let map = StabilityMap {
        plane: [[1e-3, 10.0], [1e-4, 1.0]].map(|[low, high]| Interval::logarithmic(low, high)),
        quantities: ["static deflection over indentation (coupling)", MEMORY],
        shape: effort.pick([14, 12], [40, 40]),
        classes: &["two springs", "two springs and first-order loss", "wave"],
    };
    let names = ["models-disc-1e-2", "models-disc-1e-3", "models-disc-1e-4"];
    plane.pictures(&map, names, &|| (), |figure, tolerance| {
        // half of the first-order loss is the error of the restitution of two springs
        let loss = 2.0 * tolerance;
        let theory = map.line(60, |coupling| {
            let lag = loss / quasi_static(coupling).1;
            let wave_time = lag / (coupling * response.disc.relaxation_time);
            wave_time * response.disc.memory / CONTACT_TIME
        });
        let label = format!("theory: first-order loss of {loss:.0e}");
        figure.line(&label, Style::Dotted, theory);
        let place = (paper.coupling, paper.memory() / CONTACT_TIME);
        figure.add(Layer::star(place, "paper's case"));
        figure.caption = format!(
            "With the full share the half-space is a second spring; the waves are seen by their radiated loss, first \
             order in the memory, and then by their shape. Regions are computed against the implicit march; the lines \
             are where `auto` changes model at a tolerance of {tolerance:.0e}."
        );
        Ok(())
    })
}
