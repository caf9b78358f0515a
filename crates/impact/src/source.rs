//! Source of the kernels of the fields: computed or looked up.

use crate::convolution::fronts::Fronts;
use crate::convolution::plan::Sets;
use crate::cost::{busy, computed_s};
use crate::error::ImpactError;
use crate::excitation::Excitation;
use crate::face::{stand_in_radii, stands_in};
use crate::grid::{Grid, Wanted};
use crate::kernels::{KernelSource, table_error};
use crate::quantity::Derivative;
use crate::scene::Scene;
use fault::AnyError;
use halfspace::{Profile, Six};
use lookup::{LookupError, Table};
use std::collections::hash_map::{Entry, HashMap};
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

/// Source of kernel tables: a table in memory, or a file from which the required part is loaded.
pub trait Tables: fmt::Debug + Send + Sync {
    /// A table for a Poisson's ratio that covers places (r, z) in disc radii from the first to the last of `span`.
    ///
    /// # Errors
    /// The reason why it cannot be loaded.
    fn part(&self, poisson_ratio: f64, span: [[f64; 2]; 2]) -> Result<Arc<Table>, AnyError>;

    /// Largest r and z in disc radii.
    fn reach(&self) -> [f64; 2];

    /// The reason why there is no such table, as far as it is known without loading one.
    ///
    /// # Errors
    /// The reason why that is unknown.
    fn refusal(&self, _ratio: f64, _farthest: [f64; 2]) -> Result<Option<LookupError>, AnyError> {
        Ok(None)
    }
}

impl Tables for Arc<Table> {
    fn reach(&self) -> [f64; 2] {
        Table::reach(self)
    }

    fn part(&self, _: f64, _: [[f64; 2]; 2]) -> Result<Arc<Table>, AnyError> {
        Ok(Self::clone(self))
    }
}

#[cfg(feature = "hdf5")]
impl Tables for lookup::TableFile {
    fn reach(&self) -> [f64; 2] {
        Self::reach(self)
    }

    fn part(&self, poisson_ratio: f64, span: [[f64; 2]; 2]) -> Result<Arc<Table>, AnyError> {
        Ok(Arc::new(Self::part(self, poisson_ratio, span)?))
    }

    fn refusal(&self, ratio: f64, farthest: [f64; 2]) -> Result<Option<LookupError>, AnyError> {
        Ok(self.serves(ratio, farthest)?.err())
    }
}

/// Tables of which a part is loaded for each Poisson's ratio, and a larger part when a place lies outside.
///
/// The results do not depend on earlier calls: a part returns the same numbers as the whole table. Each ratio may need
/// the memory of a slice, so use it for few ratios; [`Arc<Table>`] serves any number.
#[derive(Debug)]
pub struct Shared {
    tables: Arc<dyn Tables>,
    /// Known facts about each ratio, and the reason why a part could not be read.
    seen: Mutex<(HashMap<u64, Known>, Option<String>)>,
}

/// Known facts about a ratio: the reason why there is no table, and the loaded part with its places.
type Known = (Option<LookupError>, Option<([[f64; 2]; 2], Arc<Table>)>);

/// Ratio of the places of a loaded part to the requested ones, outwards and inwards: the places of a sweep vary.
const FARTHER: f64 = 1.5;

impl Shared {
    /// A source that has loaded nothing yet.
    pub fn new(tables: Arc<dyn Tables>) -> Self {
        let seen = Mutex::default();
        Self { tables, seen }
    }

    /// The reason why a part could not be read, if that has happened; results computed since then may lack the table.
    pub fn fault(&self) -> Option<String> {
        let seen = self.seen.lock().unwrap_or_else(PoisonError::into_inner);
        seen.1.clone()
    }

    /// The result of `read` with the known facts about a ratio; if it fails, the reason is kept.
    fn with<T>(
        &self,
        poisson_ratio: f64,
        read: impl FnOnce(&mut Known) -> Result<T, AnyError>,
    ) -> Result<T, AnyError> {
        let mut seen = self.seen.lock().unwrap_or_else(PoisonError::into_inner);
        let (all, fault) = &mut *seen;
        let found = || {
            let known = match all.entry(poisson_ratio.to_bits()) {
                Entry::Occupied(known) => known.into_mut(),
                Entry::Vacant(none) => {
                    let refusal = self.tables.refusal(poisson_ratio, [0.0; 2])?;
                    none.insert((refusal, None))
                }
            };
            read(known)
        };
        found().inspect_err(|error| {
            fault.get_or_insert(error.to_string());
        })
    }
}

impl Tables for Shared {
    fn reach(&self) -> [f64; 2] {
        self.tables.reach()
    }

    fn part(&self, poisson_ratio: f64, span: [[f64; 2]; 2]) -> Result<Arc<Table>, AnyError> {
        self.with(poisson_ratio, |(_, part)| {
            let mut wanted = [span[0].map(|x| x / FARTHER), span[1].map(|x| x * FARTHER)];
            if let Some((held, table)) = part {
                let mut axes = 0..2;
                if axes.all(|i| held[0][i] <= span[0][i] && span[1][i] <= held[1][i]) {
                    return Ok(Arc::clone(table));
                }
                for axis in 0..2 {
                    wanted[0][axis] = wanted[0][axis].min(held[0][axis]);
                    wanted[1][axis] = wanted[1][axis].max(held[1][axis]);
                }
            }
            let table = self.tables.part(poisson_ratio, wanted)?;
            *part = Some((wanted, Arc::clone(&table)));
            Ok(table)
        })
    }

    fn refusal(&self, poisson_ratio: f64, _: [f64; 2]) -> Result<Option<LookupError>, AnyError> {
        self.with(poisson_ratio, |(refusal, _)| Ok(refusal.clone()))
    }
}

/// Choice of the kernels for the fields.
#[derive(Debug, Clone)]
pub enum KernelChoice {
    /// Kernels computed for each probe.
    Direct,
    /// Kernels from a table.
    Table(Arc<dyn Tables>),
    /// Kernels from a table or computed, by the estimated cost and error of both.
    Auto(Arc<dyn Tables>),
    /// Kernels from a table if its estimated error is within the tolerance, computed otherwise. The choice for a row of
    /// a sweep depends on the row only, not on the threads that share the work.
    Within(Arc<dyn Tables>),
}

/// Below this cost, fields are computed rather than looked up, which avoids the table's error.
const CHEAP_S: f64 = 0.2;

/// Above this cost, fields are looked up whatever the table's error.
const DEAR_S: f64 = 10.0;

/// The source of the fields of a scene and the reason for it; none for a scene without fields.
///
/// [`looked_up_error`] decides, before the lookup, whether a table is accurate enough.
pub(crate) fn choose_source(
    scene: &Scene,
    kernels: &KernelChoice,
    excitation: &Excitation,
) -> Result<Option<(KernelSource, String)>, ImpactError> {
    if scene.points() == 0 {
        return Ok(None);
    }
    let points = places(scene, excitation.units().disc_radius_m);
    let (medium, tolerance) = (excitation.medium(), scene.settings.tolerance);
    let direct = |reason: String| -> Result<_, ImpactError> {
        let kernel = KernelSource::for_fields(medium, tolerance)?;
        Ok(Some((KernelSource::Direct(kernel), reason)))
    };
    if is_damped(excitation, kernels)? {
        return direct("tables are of elastic blocks: computed".to_owned());
    }
    let radius_m = excitation.units().disc_radius_m;
    let faces = faces(scene, radius_m);
    let of_points = points.iter().map(|place_m| place_m.map(|x| x / radius_m));
    let [widest, narrowest] = [1, 0].map(|end| {
        let over = |(place_m, radii_m): &Face| place_m.map(|x| x / radii_m[end]);
        faces.iter().map(over).collect::<Vec<[f64; 2]>>()
    });
    let [nearest, _] = span(of_points.clone().chain(widest));
    let [_, farthest] = span(of_points.chain(narrowest.iter().copied()));
    let load = |tables: &Arc<dyn Tables>| {
        // in radii of the smallest disc
        let sets = Sets::new(excitation, tolerance, Some(tables.reach()), (1, false));
        let seen = points.iter().map(|place_m| {
            let place = place_m.map(|x| x / radius_m);
            let smallest = sets.get(sets.choose(place)).smallest();
            place.map(|x| x / smallest)
        });
        let [_, far] = span(seen.chain(narrowest.iter().copied()));
        let table = tables.part(medium.poisson_ratio(), [nearest, far]);
        table.map(KernelSource::Table).map_err(ImpactError::Table)
    };
    let (tables, cost_s, before) = match kernels {
        KernelChoice::Direct => return direct("requested, or no table given".to_owned()),
        KernelChoice::Table(tables) => return Ok(Some((load(tables)?, "requested".to_owned()))),
        KernelChoice::Within(tables) => (tables, 0.0, Default::default()),
        KernelChoice::Auto(tables) => {
            let grid = Grid::new(&Wanted::of(scene), excitation, None)?;
            let (cells, count) = (grid.count(), scene.points());
            let cost_s = computed_s(scene, &grid) / busy(count);
            let cost =
                format!("computing {count} points of {cells} cells takes about {cost_s:.1e} s");
            if cost_s <= CHEAP_S {
                return direct(format!("{cost}: computed"));
            }
            let before = [", and ", "; "].map(|by| format!("{cost}{by}"));
            (tables, cost_s, before)
        }
    };
    let refusal = tables.refusal(medium.poisson_ratio(), farthest);
    if let Some(outside) = refusal.map_err(ImpactError::Table)? {
        return direct(format!("{outside}: computed"));
    }
    let table = load(tables)?;
    let KernelSource::Table(own) = &table else {
        return Ok(Some((table, "requested".to_owned())));
    };
    let largest = largest_error(own, excitation, scene, (&points, &faces));
    let error = match largest {
        Err(outside @ LookupError::Outside { .. }) => {
            return direct(format!("{outside}: computed"));
        }
        found => found.map_err(|source| ImpactError::Table(source.into()))?,
    };
    let [and, then]: [String; 2] = before;
    if error > tolerance && cost_s <= DEAR_S {
        return direct(format!(
            "{and}the table's error {error:.1e} is above the tolerance {tolerance:.1e}: computed"
        ));
    }
    let reason = format!("{then}the table's error is {error:.1e}: looked up");
    Ok(Some((table, reason)))
}

/// Whether the block has attenuation, which no table has.
fn is_damped(excitation: &Excitation, kernels: &KernelChoice) -> Result<bool, ImpactError> {
    let Some(law) = &excitation.attenuation else {
        return Ok(false);
    };
    match kernels {
        KernelChoice::Table(_) => Err(ImpactError::DampedTable {
            quality_factor: law.quality_factor(),
        }),
        KernelChoice::Direct | KernelChoice::Auto(_) | KernelChoice::Within(_) => Ok(true),
    }
}

/// The place of a sensor in m and the radii in m of the smallest and the largest disc that stands for its face.
type Face = ([f64; 2], [f64; 2]);

/// The sensors for whose faces discs stand.
fn faces(scene: &Scene, radius_m: f64) -> Vec<Face> {
    let faces = scene
        .sensors
        .iter()
        .filter(|own| stands_in(radius_m, own.face_radius_m));
    faces
        .map(|own| {
            (
                [own.r_m, own.z_m],
                stand_in_radii(own.face_radius_m, radius_m),
            )
        })
        .collect()
}

/// All probes, the corners and edges of the section, and the sensors for whose faces no discs stand: [r, z] in m.
fn places(scene: &Scene, radius_m: f64) -> Vec<[f64; 2]> {
    let probes = scene.probes.iter().map(|probe| [probe.r_m, probe.z_m]);
    let section = scene.section.iter().flat_map(|section| {
        let part = |most_m: f64, i: u32| most_m * f64::from(i) / 4.0;
        (0..25).map(move |i| [part(section.r_max_m, i / 5), part(section.z_max_m, i % 5)])
    });
    let others = scene
        .sensors
        .iter()
        .filter(|own| !stands_in(radius_m, own.face_radius_m));
    let sensors = others.flat_map(|sensor| {
        [
            sensor.nearest_m(),
            [sensor.r_m, sensor.z_m],
            sensor.farthest_m(),
        ]
    });
    probes.chain(section).chain(sensors).collect()
}

/// The smallest and the largest r and z of some places.
fn span(places: impl Iterator<Item = [f64; 2]>) -> [[f64; 2]; 2] {
    places.fold(
        [[f64::INFINITY; 2], [0.0; 2]],
        |[nearest, farthest], place| {
            let pick = |own: [f64; 2], of: fn(f64, f64) -> f64| {
                [0, 1].map(|axis| of(own[axis], place[axis]))
            };
            [pick(nearest, f64::min), pick(farthest, f64::max)]
        },
    )
}

/// The largest relative error of looked-up fields at some places and of means over some faces.
fn largest_error(
    table: &Table,
    excitation: &Excitation,
    scene: &Scene,
    (points, faces): (&[[f64; 2]], &[Face]),
) -> Result<f64, LookupError> {
    let of_points = points
        .iter()
        .map(|place_m| looked_up_error(table, excitation, scene, *place_m));
    let of_faces = faces
        .iter()
        .map(|(place_m, radii_m)| mean_error(table, excitation, *place_m, radii_m[1]));
    let mut all = of_points.chain(of_faces);
    all.try_fold(0.0_f64, |most, one| one.map(|error| most.max(error)))
}

/// Relative error of looked-up fields at a point, known before they are: that of the table for the force on each disc, and of the
/// short waves of the first and last instants, which no table has.
///
/// It is over the largest static field of a kind, displacements and stresses; samples right at a front can have more.
fn looked_up_error(
    table: &Table,
    excitation: &Excitation,
    scene: &Scene,
    place_m: [f64; 2],
) -> Result<f64, LookupError> {
    let (units, medium) = (excitation.units(), excitation.medium());
    let reach = table.reach();
    let tolerance = scene.settings.tolerance;
    let sets = Sets::new(excitation, tolerance, Some(reach), (1, scene.rates() > 0));
    let place = place_m.map(|x| x / units.disc_radius_m);
    let discs = sets.get(sets.choose(place));
    let still = |over: f64| -> Result<Six, LookupError> {
        let fixed = medium.static_field(Profile::Hertz, place[0] / over, place[1] / over)?;
        Ok(fixed)
    };
    let largest = still(1.0)?;
    let mut errors = Six::default();
    for (k, &over) in discs.radii.iter().enumerate() {
        let at = place.map(|x| x / over);
        let own = table_error(table, medium.poisson_ratio(), at, excitation.pulse(over))?;
        let unit = [1.0 / over, 1.0 / (over * over)].map(|unit| unit * discs.variation(k));
        for (f, error) in errors.iter_mut().enumerate() {
            *error = error.hypot(unit[usize::from(f >= 2)] * own[f]);
        }
    }
    let kinds =
        [&largest[..2], &largest[2..]].map(|own| own.iter().fold(0.0_f64, |a, b| a.max(b.abs())));
    let of_table = (0..6)
        .map(|f| errors[f] / kinds[usize::from(f >= 2)])
        .fold(0.0, f64::max);
    let (_, step_s) = Wanted::of(scene).duration_and_step_s(excitation);
    let fronts = Fronts::new(excitation, place_m);
    let [mostly, _] = fronts.looked_up_errors(discs.smallest(), step_s, Derivative::Field.power());
    Ok(of_table + mostly)
}

/// Relative error of a looked-up mean over a face, by the table's error on a disc as large.
fn mean_error(
    table: &Table,
    excitation: &Excitation,
    place_m: [f64; 2],
    disc_m: f64,
) -> Result<f64, LookupError> {
    let (place, medium) = (place_m.map(|x| x / disc_m), excitation.medium());
    let over = disc_m / excitation.units().disc_radius_m;
    let errors = table_error(table, medium.poisson_ratio(), place, excitation.pulse(over))?;
    let still = medium.static_field(Profile::Hertz, place[0], place[1])?;
    let largest = |own: &[f64]| own.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    Ok(largest(&errors[..2]) / largest(&still[..2]))
}
