//! All that is asked for at a point: the six fields, and what follows from them or from rates of the force.

use crate::error::FieldsError;
use crate::excitation::Excitation;
use crate::grid::Grid;
use crate::kernels::KernelSource;
use crate::quantity::{Origin, Quantity};
use crate::rate_loads::Order;
use crate::rates::{Motion, Rates, Resolved};
use crate::sampled::{Point, Sampled};
use crate::scene::Scene;
use crate::watch::Watch;

/// The fields of a scene at any point.
pub(crate) struct Observer<'a> {
    pub(crate) sampled: Sampled<'a>,
    pub(crate) excitation: &'a Excitation,
    velocity: Option<Rates<'a>>,
    acceleration: Option<Rates<'a>>,
    quantities: &'a [Quantity],
    /// Young's modulus in Pa and Poisson's ratio.
    elastic: [f64; 2],
}

/// What was asked for at a point.
pub(crate) struct Observed {
    pub(crate) point: Point,
    /// Samples and estimated absolute error of each quantity of the scene.
    pub(crate) more: Vec<(Vec<f64>, f64)>,
}

/// What fields at points are made of.
#[derive(Clone, Copy)]
pub(crate) struct Asked<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) excitation: &'a Excitation,
    pub(crate) source: &'a KernelSource,
    pub(crate) grid: &'a Grid,
    /// The force in N at the samples of the grid.
    pub(crate) force_n: &'a [f64],
    /// Samples at which the fields are wanted, ascending.
    pub(crate) wanted: &'a [usize],
    /// What becomes of samples of rates that cells do not resolve.
    pub(crate) resolved: Resolved,
    /// Who is told of each point.
    pub(crate) watch: &'a dyn Watch,
}

impl<'a> Observer<'a> {
    /// Of all that is asked for.
    pub(crate) fn of(asked: Asked<'a>) -> Result<Self, FieldsError> {
        let Asked {
            scene,
            excitation,
            source,
            grid,
            force_n,
            wanted,
            resolved,
            watch,
        } = asked;
        let tolerance = scene.settings.tolerance;
        let sampled = Sampled::new(excitation, source, grid, force_n, wanted, tolerance)?;
        Self::new(scene, excitation, sampled.watched(watch), |order| {
            let of = (excitation, source, grid);
            Rates::new(of, wanted, (order, resolved), tolerance)
        })
    }

    /// Of a scene whose fields are sampled; `rates` makes the rates of an order at the same samples.
    fn new(
        scene: &'a Scene,
        excitation: &'a Excitation,
        sampled: Sampled<'a>,
        rates: impl Fn(Order) -> Result<Rates<'a>, FieldsError>,
    ) -> Result<Self, FieldsError> {
        let has = |origins: [Origin; 2]| {
            let mut all = scene.quantities.iter();
            all.any(|quantity| origins.contains(&quantity.origin()))
        };
        let of = |wanted: bool, order| wanted.then(|| rates(order)).transpose();
        let material = scene.target.material();
        Ok(Self {
            velocity: of(has([0, 1].map(Origin::Velocity)), Order::First)?,
            acceleration: of(has([0, 1].map(Origin::Acceleration)), Order::Second)?,
            quantities: &scene.quantities,
            elastic: [material.youngs_modulus_pa, material.poisson_ratio],
            sampled,
            excitation,
        })
    }

    /// All that is asked for at a point.
    pub(crate) fn at(&self, r_m: f64, z_m: f64) -> Result<Observed, FieldsError> {
        let point = self.sampled.point(r_m, z_m)?;
        let motion = |rates: &Option<Rates<'_>>| {
            let rates = rates.as_ref().map(|rates| rates.at([r_m, z_m]));
            rates.transpose()
        };
        let (velocity, acceleration) = (motion(&self.velocity)?, motion(&self.acceleration)?);
        let of = |motion: &Option<Motion>, c: usize| match motion {
            Some(motion) => (motion.values[c].clone(), motion.errors[c]),
            None => (Vec::new(), f64::NAN),
        };
        let more = self
            .quantities
            .iter()
            .map(|quantity| match quantity.origin() {
                Origin::Velocity(c) => of(&velocity, c),
                Origin::Acceleration(c) => of(&acceleration, c),
                Origin::Stress => self.of_stresses(*quantity, &point),
            });
        Ok(Observed {
            more: more.collect(),
            point,
        })
    }

    fn of_stresses(&self, quantity: Quantity, point: &Point) -> (Vec<f64>, f64) {
        let [_, _, rr, tt, zz, rz] = &point.values;
        let samples = (0..rr.len())
            .map(|i| quantity.of([rr[i], tt[i], zz[i], rz[i]], self.elastic))
            .collect();
        let [_, _, rr, tt, zz, rz] = point.errors;
        (samples, quantity.error([rr, tt, zz, rz], self.elastic))
    }
}
