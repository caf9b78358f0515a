//! Unloading of a pressure that was cut at that of yield: the punches are gone from outside in.
//!
//! Theory: `docs/theory.md` (T63).

use std::f64::consts::{FRAC_PI_2, PI};

/// Radius of Hertz's pressure with the second moment of a cut pressure of the radius `top`.
pub(crate) fn spread(edge: f64, top: f64) -> f64 {
    let [whole, second, _] = Cut::new(edge.min(top), top, top).moments();
    (second / whole).sqrt()
}

/// Part of the force and squared radius of two of Hertz's pressures that together have force, second and fourth moment of a
/// cut pressure from the radius `top` without the punches outside `a`, which is the radius of the first.
pub(crate) fn nested(edge: f64, top: f64, a: f64) -> [[f64; 2]; 2] {
    /// Part of the radius below which moments lose digits, and the rest of the inner one is a power.
    const SMALL_RADIUS: f64 = 0.1;
    let edge = edge.min(top);
    let from = a.max(SMALL_RADIUS * top);
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
pub(crate) struct Cut {
    edge: f64,
    top: f64,
    a: f64,
    /// Radius inside which the pressure was cut.
    pub(crate) kink: f64,
    /// asin min(1, y/sqrt(L^2 - a^2))
    pub(crate) angle: f64,
    /// asin(a/kink) and atan(a y/(L sqrt(kink^2 - a^2))).
    turns: [f64; 2],
}

impl Cut {
    pub(crate) fn new(edge: f64, top: f64, a: f64) -> Self {
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

    /// Indentation of the loading less the stroke of the rest; Thornton's u* at the top.
    pub(crate) fn depth(&self) -> f64 {
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
    pub(crate) fn moments(&self) -> [f64; 3] {
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

    pub(crate) fn delayed(&self) -> f64 {
        let [turn, far] = self.turns;
        let inner = self.a.min(self.kink) * self.angle + self.edge * turn - self.top * far;
        4.0 / PI * inner + 2.0 * (self.a - self.kink).max(0.0)
    }
}
