//! The laws of a contact that yields, as branches: force, indentation and slope over the radius of contact.
//!
//! Collision units: length alpha, radius sqrt(R alpha), force K alpha^1.5.
//! On any branch the load is carried by punches, dp = (3/2) a ds: s is the indentation where nothing flows.
//!
//! ```text
//! line          u = a^2                                p = y^3 + (3/2) y (a^2 - y^2)     (3/2) y
//! fit           u = a^2                                p of Jackson and Green
//! Hertzian      u = u_p + a^2/rho                      p = a^3/rho                 (3/2) a
//! on a spring   u = a^2                                p = y^3,  y^2 + sigma y^3 = a^2
//! truncated     du = (4/pi) asin min(1, y/sqrt(L^2 - a^2)) a da,  dp = (3/2) a du  (3/2) a
//! ```
//!
//! y is the radius at yield, L the largest, rho = R_p/R of Thornton (1997).
//! The truncated branch takes the punches of the pressure min(p_y, Hertz) away from outside in, so that nothing presses
//! after the separation.
//!
//! Theory: `docs/theory.md` (T62 to T65).

use crate::law::cut::Cut;
use crate::law::fit::Fit;
use crate::numeric::cubic::force_root;
use crate::numeric::quadrature::in_panels;
use crate::units::INVERSE_MASS;
use std::f64::consts::PI;

/// A law on one side of the turning point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Branch {
    /// The pressure is cut at that of yield; `edge` the radius at yield.
    Line { edge: f64 },
    /// Jackson and Green's fit.
    Fit(Fit),
    /// Hertz's law of a sphere `flatter` times as flat on a dent of depth `left`: unloading, and [`Branch::HERTZ`].
    Hertzian { left: f64, flatter: f64 },
    /// Unloading of a cut pressure from the radius `top`.
    Truncated { edge: f64, top: f64 },
    /// Hertz's spring in series with a linear one of compliance `coupling`; the radius stands for the root of the
    /// indentation of both.
    OnSpring { coupling: f64 },
}

/// A branch with the constant of its int ds/a, which goes on where branches meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Law {
    pub(crate) branch: Branch,
    offset: f64,
    /// c of a half-space that answers at once; none of one with a memory.
    pub(crate) lag: Option<f64>,
}

impl Law {
    /// A contact that has not yielded.
    pub(crate) const HERTZ: Self = Self {
        branch: Branch::HERTZ,
        offset: 0.0,
        lag: None,
    };

    /// Another branch from a radius on.
    pub(crate) fn followed_by(&self, branch: Branch, radius: f64) -> Self {
        Self {
            branch,
            offset: self.delayed(radius) - branch.delayed(radius),
            ..*self
        }
    }

    /// Force of the dashpot over the velocity.
    pub(crate) fn damping(&self, here: &AtRadius) -> f64 {
        self.lag.unwrap_or(0.0) * here.stiffness * here.stiffness
    }

    /// g = int ds/a from the touch.
    pub(crate) fn delayed(&self, radius: f64) -> f64 {
        self.branch.delayed(radius) + self.offset
    }

    /// Its slope in the radius.
    pub(crate) fn slope(&self, radius: f64) -> f64 {
        match self.branch {
            Branch::Fit(_) | Branch::OnSpring { .. } => 2.0,
            Branch::Line { edge } => 2.0 * edge / radius,
            Branch::Hertzian { flatter, .. } => 2.0 / flatter,
            Branch::Truncated { edge, top } => 4.0 / PI * Cut::new(edge, top, radius).angle,
        }
    }
}

/// A branch at a radius of contact.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct AtRadius {
    /// Indentation.
    pub(crate) depth: f64,
    /// Its slope in the radius.
    pub(crate) depth_slope: f64,
    /// Slope in the radius of the indentation s of the punches.
    pub(crate) punch_slope: f64,
    /// Slopes of the two slopes; not of a truncated branch, where the radius is the known variable.
    pub(crate) bends: [f64; 2],
    /// Force.
    pub(crate) force: f64,
    /// Slope of the force in the indentation.
    pub(crate) stiffness: f64,
    /// Slope in the radius of the deceleration of the striker, (5/4) p.
    pub(crate) braking: f64,
}

impl Branch {
    /// Nothing has flowed.
    pub(crate) const HERTZ: Self = Self::Hertzian {
        left: 0.0,
        flatter: 1.0,
    };

    /// At a radius.
    pub(crate) fn at(&self, a: f64) -> AtRadius {
        let of = |depth, depth_slope, bend, force| AtRadius {
            depth,
            depth_slope,
            punch_slope: depth_slope,
            bends: [bend; 2],
            force,
            stiffness: 1.5 * a,
            braking: INVERSE_MASS * 1.5 * a * depth_slope,
        };
        match *self {
            Self::Line { edge } => {
                let force = edge * (1.5 * a * a - 0.5 * edge * edge);
                AtRadius {
                    punch_slope: 2.0 * edge,
                    bends: [2.0, 0.0],
                    stiffness: 1.5 * edge,
                    braking: INVERSE_MASS * 3.0 * edge * a,
                    ..of(a * a, 2.0 * a, 2.0, force)
                }
            }
            Self::Fit(fit) => {
                let [force, stiffness] = fit.force(a * a);
                AtRadius {
                    stiffness,
                    braking: INVERSE_MASS * stiffness * 2.0 * a,
                    ..of(a * a, 2.0 * a, 2.0, force)
                }
            }
            Self::OnSpring { coupling } => {
                let y = force_root(coupling, a * a, a).unwrap_or(0.0);
                let stiffness = 3.0 * y / (2.0 + 3.0 * coupling * y);
                AtRadius {
                    stiffness,
                    braking: INVERSE_MASS * stiffness * 2.0 * a,
                    ..of(a * a, 2.0 * a, 2.0, y * y * y)
                }
            }
            Self::Hertzian { left, flatter } => {
                let (depth, force) = (left + a * a / flatter, a * a * a / flatter);
                of(depth, 2.0 * a / flatter, 2.0 / flatter, force)
            }
            Self::Truncated { edge, top } => {
                let cut = Cut::new(edge, top, a);
                let slope = 4.0 / PI * cut.angle;
                let force = if a < LITTLE * cut.kink {
                    0.5 * slope * a * a * a
                } else {
                    cut.moments()[0]
                };
                of(cut.depth(), a * slope, slope, force)
            }
        }
    }

    /// int ds/a, but for a constant.
    pub(crate) fn delayed(&self, a: f64) -> f64 {
        match *self {
            Self::Fit(_) | Self::OnSpring { .. } => 2.0 * a,
            Self::Line { edge } => 2.0 * edge * (1.0 + (a / edge).ln()),
            Self::Hertzian { flatter, .. } => 2.0 * a / flatter,
            Self::Truncated { edge, top } => Cut::new(edge, top, a).delayed(),
        }
    }

    /// Work along a branch from a radius of zero, int p du: that of unloading is given back.
    pub(crate) fn work(&self, a: f64) -> f64 {
        match *self {
            Self::Hertzian { flatter, .. } => 0.4 * a.powi(5) / flatter.powi(2),
            Self::Truncated { edge, top } => self.work_of_cut(edge, top, a),
            Self::Line { .. } | Self::Fit(_) | Self::OnSpring { .. } => self.work_between(0.0, a),
        }
    }

    /// Work along a smooth branch between two radii.
    pub(crate) fn work_between(&self, from: f64, to: f64) -> f64 {
        in_panels(from, to, |a| {
            let here = self.at(a);
            here.force * here.depth_slope
        })
    }

    fn work_of_cut(&self, edge: f64, top: f64, a: f64) -> f64 {
        let kink = (top * top - edge * edge).max(0.0).sqrt();
        let part = |turn: f64| {
            // smooth in the turn: roots at the kink, and a steep place of the width of y next to it
            let q = edge / kink * turn.sinh();
            let here = self.at(kink * (1.0 - q * q));
            2.0 * edge * q * turn.cosh() * here.force * here.depth_slope
        };
        let place = |b: f64| ((1.0 - b / kink).max(0.0).sqrt() * kink / edge).asinh();
        let curved = if kink > 0.0 {
            in_panels(place(a.min(kink)), place(0.0), part)
        } else {
            0.0
        };
        if a <= kink {
            return curved;
        }
        let shift = self.at(kink).force - kink.powi(3);
        curved + shift * (a * a - kink * kink) + 0.4 * (a.powi(5) - kink.powi(5))
    }
}

/// Radius over that inside which the pressure was cut below which the force of a truncated branch goes with its cube.
const LITTLE: f64 = 1e-3;
