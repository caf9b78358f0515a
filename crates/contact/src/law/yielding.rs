//! Contacts that yield: loading until the indentation turns, unloading as a sphere on a dent.
//!
//! The laws are branches of a growing contact; [`Yielding`] says which follows which.
//! `growing/yielding` follows them by the pieces of a contact that does not yield, with the memory of the half-space or with
//! a dashpot on the contact's area; `growing/quick` has the results of the dashpot without a march.
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

use crate::law::branch::Branch;
use crate::law::cut::spread;
use crate::law::fit::Fit;
use crate::units::INVERSE_MASS;

/// The law of flow with its numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum FlowLaw {
    /// The pressure is cut; unloading as Hertz's law of a flatter sphere.
    Thornton,
    /// The same loading, and the unloading that leaves no traction.
    Recovery,
    /// Jackson and Green's fit.
    Fit(Fit),
}

/// Velocity of approach over the one at which Jackson and Green's material yields under the surface, up to which their law
/// is trusted.
///
/// Up to here the restitution by the energy of the law is within 2.5 % of the formula that its authors fitted to their
/// finite elements, for yield strengths up to 0.01 of the effective modulus; at 2000 it is 10 to 50 % off, and the formula
/// ends at 1000. `tests/beyond.rs` (`the_fit_is_warned_of_where_it_leaves_its_authors_restitution`) fails otherwise.
const TRUSTED: f64 = 500.0;

/// A contact that may yield, in collision units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Yielding {
    pub(crate) law: FlowLaw,
    /// Mean pressure that is not exceeded, or at which the fit's material yields under the surface, in Pa.
    pub yield_pressure_pa: f64,
    /// Indentation where the loading leaves Hertz's law.
    pub(crate) depth: f64,
}

impl Yielding {
    /// s: velocity of approach over that from which the law differs from elasticity.
    pub fn velocity_ratio(&self) -> f64 {
        self.depth.powf(-1.25)
    }

    /// Velocity of approach over the largest one for which the law is trusted; none of a law without such a limit.
    pub fn trusted_ratio(&self) -> Option<f64> {
        match self.law {
            FlowLaw::Thornton | FlowLaw::Recovery => None,
            FlowLaw::Fit(fit) => Some(fit.critical.powf(-1.25) / TRUSTED),
        }
    }

    /// Whether anything is given back of the deepest indentation, without waves: the fit's dent grows faster than the
    /// indentation.
    pub(crate) fn rebounds(&self) -> bool {
        match self.law {
            FlowLaw::Thornton | FlowLaw::Recovery => true,
            FlowLaw::Fit(fit) => {
                let is_trusted = self.trusted_ratio().is_none_or(|ratio| ratio <= 1.0);
                is_trusted || 2.0 * INVERSE_MASS * self.work(fit.deepest().sqrt()) > 1.0
            }
        }
    }

    /// Whether an elastic contact would yield.
    pub(crate) fn begins(&self) -> bool {
        self.edge() < 1.0
    }

    /// Radius of contact where the loading leaves Hertz's law.
    pub(crate) fn edge(&self) -> f64 {
        self.depth.sqrt()
    }

    /// Loading beyond that radius.
    pub(crate) fn loading(&self) -> Branch {
        match self.law {
            FlowLaw::Thornton | FlowLaw::Recovery => Branch::Line { edge: self.edge() },
            FlowLaw::Fit(fit) => Branch::Fit(fit),
        }
    }

    /// Work of the loading up to a radius of contact, int p du.
    pub(crate) fn work(&self, radius: f64) -> f64 {
        let edge = self.edge().min(radius);
        let flow = match self.law {
            FlowLaw::Thornton | FlowLaw::Recovery => {
                let (y, [square, low]) = (self.edge(), [radius * radius, edge * edge]);
                y * (0.75 * (square + low) - 0.5 * y * y) * (square - low)
            }
            FlowLaw::Fit(_) => self.loading().work_between(edge, radius),
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
        match self.law {
            FlowLaw::Thornton => {
                let (left, flatter) = (depth - force / top, depth * top / force);
                (Branch::Hertzian { left, flatter }, top)
            }
            FlowLaw::Recovery => (Branch::Truncated { edge, top }, top),
            FlowLaw::Fit(fit) => {
                let left = fit.left(depth);
                let flatter = force * force / (depth - left).powi(3);
                (Branch::Hertzian { left, flatter }, (flatter * force).cbrt())
            }
        }
    }
}

/// Plastic flow of a contact in collision units; works over the kinetic energy before.
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
    /// R_p/R: radius of relative curvature after the contact over that before.
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
        let edge = yielding.edge();
        let (contact_radius, disc_radius) = match yielding.law {
            FlowLaw::Thornton | FlowLaw::Recovery => (radius, spread(edge, radius)),
            FlowLaw::Fit(fit) => {
                // the root of the indentation is less than the radius of the fit's contact, whose pressure is flat
                let wider = radius * (radius / edge).max(1.0).powf(fit.spread);
                (wider, wider * 1.25_f64.sqrt())
            }
        };
        Self {
            plastic_work,
            radiated,
            yielding: *yielding,
            disc_radius,
            contact_radius,
            peak_indentation: radius * radius,
            residual_indentation: end.depth,
            flatter: 2.0 / end.bends[0],
        }
    }
}
