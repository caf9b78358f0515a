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

use crate::numeric::cubic::force_root;
use crate::numeric::quadrature::in_panels;
use crate::units::INVERSE_MASS;
use std::f64::consts::{FRAC_PI_2, PI};

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

    /// What the dashpot adds to the force over the velocity.
    pub(crate) fn damping(&self, here: &Local) -> f64 {
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
pub(crate) struct Local {
    /// Indentation.
    pub(crate) depth: f64,
    /// Its slope in the radius.
    pub(crate) depth_slope: f64,
    /// Slope in the radius of the indentation s of the punches.
    pub(crate) punch_slope: f64,
    /// Slopes of the two slopes; not of a truncated branch, where the radius is what is known.
    pub(crate) bends: [f64; 2],
    /// Force.
    pub(crate) force: f64,
    /// Slope of the force in the indentation.
    pub(crate) stiffness: f64,
    /// Slope in the radius of what slows the striker, (5/4) p.
    pub(crate) braking: f64,
}

impl Branch {
    /// Nothing has flowed.
    pub(crate) const HERTZ: Self = Self::Hertzian {
        left: 0.0,
        flatter: 1.0,
    };

    /// At a radius.
    pub(crate) fn at(&self, a: f64) -> Local {
        let of = |depth, depth_slope, bend, force| Local {
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
                Local {
                    punch_slope: 2.0 * edge,
                    bends: [2.0, 0.0],
                    stiffness: 1.5 * edge,
                    braking: INVERSE_MASS * 3.0 * edge * a,
                    ..of(a * a, 2.0 * a, 2.0, force)
                }
            }
            Self::Fit(fit) => {
                let [force, stiffness] = fit.force(a * a);
                Local {
                    stiffness,
                    braking: INVERSE_MASS * stiffness * 2.0 * a,
                    ..of(a * a, 2.0 * a, 2.0, force)
                }
            }
            Self::OnSpring { coupling } => {
                let y = force_root(coupling, a * a, a).unwrap_or(0.0);
                let stiffness = 3.0 * y / (2.0 + 3.0 * coupling * y);
                Local {
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

    /// R_p/R: what contact's relative curvature has become where an unloading branch ends.
    pub(crate) fn flatter(&self) -> f64 {
        2.0 / self.at(0.0).bends[0]
    }

    /// Work that an unloading branch gives back from a radius on, int p du.
    pub(crate) fn given_back(&self, a: f64) -> f64 {
        let Self::Truncated { edge, top } = *self else {
            return 0.4 * a.powi(5) / self.flatter().powi(2);
        };
        let kink = (top * top - edge * edge).max(0.0).sqrt();
        let part = |turn: f64| {
            // smooth in the turn: roots at the kink, and a steep place of the width of y beside it
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

/// Radius of Hertz's pressure with the second moment of a cut pressure of the radius `top`.
pub(crate) fn spread(edge: f64, top: f64) -> f64 {
    let [whole, second, _] = Cut::new(edge.min(top), top, top).moments();
    (second / whole).sqrt()
}

/// Part of the force and squared radius of two of Hertz's pressures that together have force, second and fourth moment of a
/// cut pressure from the radius `top` without the punches outside `a`, which is the radius of the first.
pub(crate) fn nested(edge: f64, top: f64, a: f64) -> [[f64; 2]; 2] {
    /// Part of the radius below which moments lose digits, and the rest of the inner one is a power.
    const SMALL: f64 = 0.1;
    let edge = edge.min(top);
    let from = a.max(SMALL * top);
    let [whole, second, fourth] = Cut::new(edge, top, from).moments();
    let square = from * from;
    let [more, most] = [second / square, fourth / (square * square)].map(|x| x / whole - 1.0);
    if more < 1e-9 {
        return [[1.0, a * a], [0.0; 2]];
    }
    let inner = (most / more - 1.0).max(0.0);
    let share = more / (inner - 1.0) * (a / from).powi(2);
    [[1.0 - share, a * a], [share, inner * a * a]]
}

/// The cut pressure from which the punches outside a radius are gone.
struct Cut {
    edge: f64,
    top: f64,
    a: f64,
    /// Radius inside which the pressure was cut.
    kink: f64,
    /// asin min(1, y/sqrt(L^2 - a^2))
    angle: f64,
    /// asin(a/kink) and atan(a y/(L sqrt(kink^2 - a^2))).
    turns: [f64; 2],
}

impl Cut {
    fn new(edge: f64, top: f64, a: f64) -> Self {
        let kink = (top * top - edge * edge).max(0.0).sqrt();
        let rest = ((kink - a) * (kink + a)).max(0.0).sqrt();
        let turns = if a < kink {
            [(a / kink).asin(), (a * edge).atan2(top * rest)]
        } else {
            [FRAC_PI_2; 2]
        };
        Self {
            edge,
            top,
            a,
            kink,
            angle: edge.atan2(rest),
            turns,
        }
    }

    /// Work of the loading less what is left; Thornton's u* at the top.
    fn depth(&self) -> f64 {
        let (y2, square) = (self.edge * self.edge, self.top * self.top);
        // stroke of a radius squared from full unloading
        let stroke = |u: f64| {
            if u <= y2 {
                return u;
            }
            2.0 / PI * (u * (self.edge / u.sqrt()).asin() + self.edge * (u - y2).sqrt())
        };
        square - stroke((square - self.a * self.a).max(0.0))
    }

    /// Moments of the pressure in r^0, r^2 and r^4, over those of Hertz's pressure of unit force and radius.
    fn moments(&self) -> [f64; 3] {
        let [turn, far] = self.turns;
        let rest = (self.kink * self.kink - self.a * self.a).max(0.0).sqrt();
        let (square, kink) = (self.top * self.top, self.kink * self.kink);
        let mut power = self.a;
        // int b^(2n)/sqrt(kink^2 - b^2) db, and that of y b^(2n)/((L^2 - b^2) sqrt(kink^2 - b^2))
        let (mut bare, mut over) = (turn, square * far / self.top - self.edge * turn);
        [1.0, 2.0, 3.0].map(|n| {
            bare = ((2.0 * n - 1.0) * kink * bare - power * rest) / (2.0 * n);
            over = square * over - self.edge * bare;
            power *= self.a * self.a;
            2.0 / PI * (power * self.angle - over)
        })
    }

    fn delayed(&self) -> f64 {
        let [turn, far] = self.turns;
        let inner = self.a.min(self.kink) * self.angle + self.edge * turn - self.top * far;
        4.0 / PI * inner + 2.0 * (self.a - self.kink).max(0.0)
    }
}

/// Jackson and Green's fit of finite elements (2005), with the residual depth of Jackson, Green and Marghitu (2010).
///
/// ```text
/// w = u/w_c,  p/p_c = exp(-w^(5/12)/4) w^1.5 + (4 H/C) (1 - exp(-w^(5/9)/25)) w      w > 1.9
/// H = 2.84 (1 - exp(-0.82 (a/R)^-0.7)),   a/R = (pi C e_y/2) sqrt(w (w/1.9)^B)
/// w_r = 1.02 w (1 - ((w + 5.9)/6.9)^-0.54)
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fit {
    /// w_c in collision units.
    pub(crate) critical: f64,
    /// C = 1.295 exp(0.736 nu).
    pub(crate) shape: f64,
    /// e_y = S_y/E*.
    pub(crate) strain: f64,
    /// B of the contact's area, R u (w/1.9)^B.
    pub(crate) spread: f64,
    /// ln(pi C e_y/2)
    edge: f64,
}

/// Indentation over the critical one from which the fit leaves Hertz's law.
pub(crate) const FITTED: f64 = 1.9;
const LOG_FITTED: f64 = 0.641_853_886_172_394_7;

impl Fit {
    pub(crate) fn new(critical: f64, shape: f64, strain: f64) -> Self {
        Self {
            critical,
            shape,
            strain,
            spread: 0.14 * (23.0 * strain).exp(),
            edge: (0.5 * PI * shape * strain).ln(),
        }
    }

    /// Force and its slope at an indentation beyond 1.9 w_c.
    pub(crate) fn force(&self, depth: f64) -> [f64; 2] {
        let w = depth / self.critical;
        let log = w.ln();
        let spread = self.spread;
        let area = (1.0 + spread) * log - spread * LOG_FITTED;
        let by_radius = (-0.7 * (self.edge + 0.5 * area)).exp();
        let soft = (-0.82 * by_radius).exp();
        let hardness = 2.84 * (1.0 - soft);
        let hardening = -2.84 * soft * 0.82 * 0.7 * by_radius * 0.5 * (1.0 + spread) / w;
        let [slow, fast] = [5.0 / 12.0, 5.0 / 9.0].map(|power: f64| (power * log).exp());
        let (elastic, flowing) = ((-0.25 * slow).exp(), (-0.04 * fast).exp());
        let hertz = w * w.sqrt();
        let per = 4.0 / self.shape;
        let force = elastic * hertz + per * hardness * (1.0 - flowing) * w;
        let slope = elastic * w.sqrt() * (1.5 - 5.0 / 48.0 * slow)
            + per * hardness * (1.0 - flowing + fast * flowing / 45.0)
            + per * hardening * (1.0 - flowing) * w;
        let unit = self.critical.sqrt();
        [force * unit * self.critical, slope * unit]
    }

    /// Indentation from which on nothing is given back: the depth that is left reaches it where 1.02 (1 - x^-0.54) is one.
    pub(crate) fn deepest(&self) -> f64 {
        self.critical * (6.9 * (1.0_f64 - 1.0 / 1.02).powf(-1.0 / 0.54) - 5.9)
    }

    /// Depth that is left after an indentation.
    pub(crate) fn left(&self, depth: f64) -> f64 {
        let w = depth / self.critical;
        let rest = 1.0 - ((w + 5.9) / 6.9).powf(-0.54);
        self.critical * (1.02 * w * rest).max(0.0)
    }
}
