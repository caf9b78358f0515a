//! Contacts that yield: loading until the indentation turns, unloading as a sphere on a dent.
//!
//! The laws are branches of a growing contact (`branch`); [`Yielding`] says which follows which.
//! `march` follows them by the pieces of a contact that does not yield, with the memory of the half-space or with a dashpot
//! on the contact's area; `quick` has the results of the dashpot without a march.
//!
//! ```text
//! v' = -(5/4) p
//! dashpot   p = F(u) + c F'(u)^2 u',   u = d                                        c = J/(mu c2)
//! memory    d' = u' - phi s' + phi int (g(t) - g(t_X))/X dmu,  g = int ds/a,  t_X + X a(t_X) = t
//! ```
//!
//! c = 0 is the contact without waves.
//! Below the yield velocity nothing here is used: the contact is elastic.
//!
//! Theory: `docs/theory.md` (T62 to T67).

pub(crate) mod branch;
pub(crate) mod infer;
pub(crate) mod march;
pub(crate) mod quick;

use crate::model::Plasticity;
use crate::numeric::quadrature::in_panels;
use crate::plastic::branch::{Branch, FITTED, Fit, spread};

/// What a contact that may yield is, in collision units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Yielding {
    pub(crate) law: Plasticity,
    /// Mean pressure that is not exceeded, or at which the fit's contact yields, in Pa.
    pub yield_pressure_pa: f64,
    /// Indentation at the yield velocity.
    pub(crate) depth: f64,
    /// Jackson and Green's numbers, where they are the law.
    pub(crate) fit: Option<Fit>,
}

impl Yielding {
    /// s: velocity of approach over that at which yield begins.
    pub fn velocity_ratio(&self) -> f64 {
        self.depth.powf(-1.25)
    }

    /// Whether an elastic contact would yield.
    pub(crate) fn begins(&self) -> bool {
        self.edge() < 1.0
    }

    /// Radius of contact where the loading leaves Hertz's law.
    pub(crate) fn edge(&self) -> f64 {
        let depth = self.fit.map_or(self.depth, |fit| FITTED * fit.critical);
        depth.sqrt()
    }

    /// Loading beyond that radius.
    pub(crate) fn loading(&self) -> Branch {
        self.fit
            .map_or(Branch::Line { edge: self.edge() }, Branch::Fit)
    }

    /// Work of the loading up to a radius of contact, int p du.
    pub(crate) fn work(&self, radius: f64) -> f64 {
        let edge = self.edge().min(radius);
        let flow = match self.loading() {
            Branch::Line { edge: y } => {
                let [square, low] = [radius * radius, edge * edge];
                y * (0.75 * (square + low) - 0.5 * y * y) * (square - low)
            }
            loading => in_panels(edge, radius, |a| {
                let here = loading.at(a);
                here.force * here.depth_slope
            }),
        };
        0.4 * edge.powi(5) + flow
    }

    /// Unloading from a radius of contact, and the radius with which it begins: the fit's is another one.
    pub(crate) fn unloading(&self, top: f64) -> (Branch, f64) {
        let (edge, depth) = (self.edge(), top * top);
        if top <= edge {
            return (Branch::HERTZ, top);
        }
        let force = self.loading().at(top).force;
        match (self.fit, self.law) {
            (Some(fit), _) => {
                let left = fit.left(depth);
                let flatter = force * force / (depth - left).powi(3);
                (Branch::Hertzian { left, flatter }, (flatter * force).cbrt())
            }
            (None, Plasticity::Recovery) => (Branch::Truncated { edge, top }, top),
            (None, Plasticity::None | Plasticity::Thornton | Plasticity::JacksonGreen) => {
                let (left, flatter) = (depth - force / top, depth * top / force);
                (Branch::Hertzian { left, flatter }, top)
            }
        }
    }
}

/// What has flowed, in collision units; works over the kinetic energy before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flow {
    /// Work of the plastic flow.
    pub plastic_work: f64,
    /// Work on the half-space's waves.
    pub radiated: f64,
    pub(crate) yielding: Yielding,
    /// Largest radius of contact.
    pub contact_radius: f64,
    /// Radius of Hertz's pressure of the same second moment at the turning point.
    pub disc_radius: f64,
    /// Largest indentation.
    pub peak_indentation: f64,
    /// Indentation that stays.
    pub residual_indentation: f64,
    /// R_p/R: what contact's relative curvature has become.
    pub flatter: f64,
}

impl Flow {
    /// Of a law that unloads from a radius, with the works of flow and waves.
    pub(crate) fn new(
        yielding: &Yielding,
        radius: f64,
        [plastic_work, radiated]: [f64; 2],
    ) -> Self {
        let end = yielding.unloading(radius).0.at(0.0);
        let (edge, fit) = (yielding.edge(), yielding.fit);
        // the root of the indentation is less than the radius of the fit's contact
        let wider = |fit: Fit| (radius / edge).max(1.0).powf(fit.spread);
        let contact_radius = radius * fit.map_or(1.0, wider);
        Self {
            plastic_work,
            radiated,
            yielding: *yielding,
            disc_radius: match fit {
                // of a flat pressure
                Some(_) => contact_radius * 1.25_f64.sqrt(),
                None => spread(edge, radius),
            },
            contact_radius,
            peak_indentation: radius * radius,
            residual_indentation: end.depth,
            flatter: 2.0 / end.bends[0],
        }
    }
}
