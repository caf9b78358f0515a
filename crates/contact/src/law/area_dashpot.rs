//! Radiation as a dashpot that grows with the contact's area, to the second order in the memory.
//!
//! For a memory that is short compared with the contact, the equation of the growing contact
//! ([`solve_growing`](crate::growing::solve_growing)) is, by Lagrange's inversion of its delays,
//!
//! ```text
//! d = p^(2/3) - c p' + b (p^(4/3))'' - (e/60) (p^(5/3))''' + ..
//! c = phi tau M_1/3,   b = phi tau^2 M_2/12,   e = phi tau^3 M_3,   M_n = int X^n dmu
//! ```
//!
//! and, solved for the force to the second order, an ordinary differential equation without memory
//!
//! ```text
//! d'' = -(5/4) p,   p = d^(3/2) + (9/4) c d d' + (135/32) c^2 sqrt(d) (d'^2 - d^(5/2))
//!                       - 3 b sqrt(d) (d'^2 - (5/4) d^(5/2))
//! ```
//!
//! Its first two terms are Hertz's spring and a dashpot on the contact's area; the last two conserve energy.
//! Its results are analytic in c and nearly linear in b: they are Chebyshev series of c
//! (`tests/reference/area_dashpot.py`), with two parts that no such equation has:
//! the third order, fitted but for its e, which takes phi M_3 tau^3/24 int p'' (p^(5/3))'' dt from the loss; and the contact ends while the
//! striker is still pressed in by 4 b f(phi) v^2, since the last instants are shorter than any memory.

use crate::summary::{Estimates, SMALL_LOSS, Summary};
use crate::waves::punch::GrowingContact;
use halfspace::chebyshev;

/// The terms of the expansion in the memory, in collision units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AreaDashpot {
    /// c: the lag w = -c p' of the first order.
    pub lag: f64,
    /// b: the inertia of the second order.
    pub inertia: f64,
    /// e: the third order.
    pub third: f64,
    /// phi: the half-space's part of the contact's compliance.
    pub target_share: f64,
}

/// Largest lag of the tables.
pub const LARGEST_LAG: f64 = 0.2;

/// Truncation error of the expansion, for a lag c and the punch's memory T, 2 tau/c_R at the largest approach, both in collision times: bounds that 99.5 of 100
/// random scenes keep (`tests/growing.rs`).
///
/// ```text
/// force 0.14 c T^2.5,  its time 0.035 c T^2.5,  contact time 0.09 c T^2,  restitution 0.01 c T^2,
/// displacement 0.018 c T^2,  loss 0.0052 T^2,  force at any time 0.11 c T^2 and 0.7 c T^3
/// ```
///
/// One beyond [`LARGEST_LAG`] and [`LARGEST_MEMORY`].
pub fn left_out(lag: f64, memory: f64) -> Estimates {
    let (c, t) = (lag, memory);
    let square = c * t * t;
    let steeper = square * t.sqrt();
    let inside = c <= LARGEST_LAG && t <= LARGEST_MEMORY;
    let bound = |error: f64| if inside { error } else { 1.0 };
    Estimates {
        peak_force: bound(0.14 * steeper + FLOOR),
        peak_force_time: bound(0.035 * steeper + FLOOR),
        contact_time: bound(0.09 * square + FLOOR),
        restitution: bound(0.01 * square + FLOOR),
        loss: bound(0.0052 * t * t + LOSS_FLOOR),
        peak_displacement: bound(0.018 * square + FLOOR),
        peak_deflection: f64::INFINITY,
        force: bound(square * (0.7 * t).min(0.11) + 10.0 * FLOOR),
    }
}

/// Memory over the contact, in collision times, up to which the bounds were measured.
pub const LARGEST_MEMORY: f64 = 0.5;

/// Errors of the references, relative.
const FLOOR: f64 = 1e-8;
const LOSS_FLOOR: f64 = 2e-7;

impl AreaDashpot {
    /// The terms of a contact.
    pub fn new(contact: &GrowingContact<'_>) -> Self {
        let (waves, phi, tau) = (contact.waves, contact.target_share, contact.wave_time);
        Self {
            lag: phi * tau * waves.moment(1) / 3.0,
            inertia: phi * tau.powi(2) * waves.moment(2) / 12.0,
            third: phi * tau.powi(3) * waves.moment(3),
            target_share: phi,
        }
    }

    /// Contact force at a displacement and a velocity, to the third order; none in tension.
    pub fn force(&self, displacement: f64, velocity: f64) -> f64 {
        self.law(displacement, velocity).max(0.0)
    }

    fn law(&self, displacement: f64, velocity: f64) -> f64 {
        let d = displacement.max(0.0);
        self.second_order(d, velocity) + self.third_order(d, velocity)
    }

    fn second_order(&self, d: f64, v: f64) -> f64 {
        let (root, square) = (d.sqrt(), v * v);
        let elastic = d * d * root;
        let inner =
            d + 2.25 * self.lag * root * v + 4.218_75 * self.lag * self.lag * (square - elastic)
                - 3.0 * self.inertia * (square - 1.25 * elastic);
        root * inner
    }

    /// The third order, smoothed where the contact is shorter than its memory.
    fn third_order(&self, d: f64, v: f64) -> f64 {
        let (c, b, e) = (self.lag, self.inertia, self.third);
        let by_speed = c * (5.484_375 * c * c - 7.875 * b) + 0.046_875 * e;
        let by_depth = c * (47.460_937_5 * c * c - 73.125 * b) + 0.468_75 * e;
        let rise = d / (d + 4.0 * b).max(f64::MIN_POSITIVE);
        v * rise * (by_speed * v * v - by_depth * d * d * d.sqrt())
    }

    /// Displacement of the striker at the end of contact.
    fn depth(&self, velocity: f64) -> f64 {
        let (c, b, phi) = (self.lag, self.inertia, self.target_share);
        // M_1^2/M_2
        let shape = 0.75 * c * c / (phi * b).max(f64::MIN_POSITIVE);
        4.0 * b * velocity * velocity * depth_factor(phi, shape.clamp(0.8, 1.0))
    }

    /// Results, for a lag in [0, [`LARGEST_LAG`]].
    pub fn summary(&self) -> Summary {
        let (c, b) = (self.lag.min(LARGEST_LAG), self.inertia);
        let x = 2.0 * c / LARGEST_LAG - 1.0;
        let result = |k: usize| chebyshev(&AT_ZERO[k], x) + b * chebyshev(&BY_B[k], x);
        let third =
            |[by_c, by_b, by_e]: [f64; 3]| c * (by_c * c * c + by_b * b) + by_e * self.third;
        let loss = c * result(5) + third(LOSS);
        let velocity = result(3) - 0.5 * third(LOSS) / result(3);
        let restitution = if loss < SMALL_LOSS {
            (1.0 - loss).sqrt()
        } else {
            velocity
        };
        Summary {
            peak_force: result(0) + third(PEAK_FORCE),
            peak_force_time: result(1) + third(PEAK_FORCE_TIME),
            contact_time: result(2) - self.depth(velocity) / velocity,
            loss,
            peak_displacement: result(4) + third(PEAK_DISPLACEMENT),
            peak_deflection: c * chebyshev(&AT_ZERO[6], x) + b * chebyshev(&BY_B[6], x),
            ..Summary::rebound(restitution)
        }
    }
}

/// f: depth of the striker at the end of contact over 4 b v^2, the value of an undisturbed end.
///
/// In these instants everything scales with itself, so that f depends on phi and the shape of the
/// relaxation only, here M_1^2/M_2; fitted to solutions with Poisson's ratios of -0.4 to 0.4995 within 1e-3.
fn depth_factor(target_share: f64, shape: f64) -> f64 {
    let away = shape - 0.837_131;
    let fall = 0.7502 + 0.97 * away;
    let rest = 0.028 + 2.2 * away * away;
    1.0 - fall * target_share + rest * target_share.powi(8)
}

/// Terms of c^3, c b and e that the results have beyond the equation, fitted to [`solve_growing`](crate::growing::solve_growing).
///
/// The part of e in the loss is -(1/24) int p'' (p^(5/3))'' dt of Hertz's pulse.
const PEAK_FORCE: [f64; 3] = [6.57, -10.70, 0.072_7];
const PEAK_FORCE_TIME: [f64; 3] = [39.84, -61.32, 0.393];
const LOSS: [f64; 3] = [-22.74, 36.90, -0.252_130_892_297_553];
const PEAK_DISPLACEMENT: [f64; 3] = [4.582, -7.425, 0.049_95];

/// At b = 0, in 2 c/`LARGEST_LAG` - 1; the last two over c.
#[rustfmt::skip]
const AT_ZERO: [[f64; 13]; 7] = [
    // PEAK_FORCE
    [8.75879629027282e-01, -1.22658928123732e-01, 3.41688992860976e-03, 2.0332415693612e-03, 6.50478826572325e-05, -1.38920306856685e-05, -2.09767037069366e-06, -9.72864544906943e-07, -6.1137845478669e-09, 2.23689265261423e-08, 8.78364697968581e-09, 8.19770721438168e-10, -1.67036360272782e-10],
    // PEAK_FORCE_TIME
    [1.25712131000816e+00, -2.22993276830809e-01, -1.19030341405954e-02, -2.97390764574326e-03, 5.57018608504703e-04, 1.29939506165808e-04, 2.38194975797848e-05, -2.57046366932956e-06, -1.67484219566154e-06, -3.50178813570409e-07, 4.12685172268367e-09, 2.23809258443655e-08, 6.44159205873246e-09],
    // END
    [3.04977425969208e+00, 1.22396522609338e-01, 1.59953316249843e-02, 1.98043240201478e-04, 9.78023337456793e-05, -1.55630791165105e-06, 7.58338910206406e-07, -3.39760041502102e-08, 7.26222713545334e-09, -5.45338640181883e-10, 8.39965697430236e-11, -7.87619097991166e-12, 1.02624434932027e-12],
    // VELOCITY
    [8.36987239802995e-01, -1.52625887745762e-01, 9.53451230836966e-03, -7.84431180090366e-04, 6.15145264324063e-05, -5.74631813275964e-06, 5.96061113060974e-07, -6.42480471008682e-08, 6.96596938879973e-09, -7.50835827417653e-10, 8.20398670703793e-11, -9.07669922488411e-12, 9.66968750154136e-13],
    // PEAK_DISPLACEMENT
    [9.2502672251701e-01, -7.34391358032888e-02, 1.55138553609853e-03, 2.82002780403387e-05, 8.60979133171743e-06, -2.06672025127294e-06, 2.55426959089094e-07, -2.23122079621537e-08, 1.94402075840778e-09, -1.99322154417439e-10, 2.42659577719739e-11, -2.90952729748025e-12, 3.28739428544057e-13],
    // LOSS
    [3.21972391963197e+00, -6.84262507973486e-01, 6.81688206519532e-02, -6.63866624347356e-03, 6.64014852372249e-04, -7.00531825166416e-05, 7.66471792248357e-06, -8.53812916844731e-07, 9.56396674590921e-08, -1.07672504173575e-08, 1.22094862403176e-09, -1.39456584823294e-10, 1.56418846213069e-11],
    // DEFLECTION
    [8.21383841181795e-01, -1.29663422717176e-01, 3.23232604656043e-02, -3.47982199627808e-03, -5.01756582673742e-05, 4.27307449859226e-05, 5.33426017737148e-06, -2.18272947077358e-06, -1.03797867405343e-07, 9.84572076571069e-08, 2.34385794692098e-09, -5.5304467090766e-09, 1.84303754604808e-10],
];

/// Their derivatives by b; that of the last as it stands.
#[rustfmt::skip]
const BY_B: [[f64; 7]; 7] = [
    // PEAK_FORCE
    [3.128676432e+00, -1.140645257e+00, -5.019945202e-02, -3.857447505e-04, -3.873787289e-05, 8.2121736e-04, 1.130713054e-04],
    // PEAK_FORCE_TIME
    [6.180497765e-01, 1.983457633e+00, -2.151774087e-02, -3.605069124e-02, -2.695758533e-02, -2.553781563e-03, 6.482770965e-04],
    // END
    [-2.753288713e+00, -7.671817378e-02, -7.145926126e-02, 1.099205587e-03, -8.233896739e-04, 3.654902359e-05, -1.031077791e-05],
    // VELOCITY
    [8.626851194e-02, 7.435822955e-02, -9.659777273e-03, 1.909017682e-03, -2.938743954e-04, 4.142997211e-05, -5.403671433e-06],
    // PEAK_DISPLACEMENT
    [2.666655463e-01, -5.477017076e-02, -7.031617604e-03, 1.678081097e-03, -2.062831682e-04, 1.767415462e-05, -1.792037899e-06],
    // LOSS
    [-1.732739104e+00, 8.061046293e-01, -1.537229294e-01, 2.588702817e-02, -3.920878448e-03, 5.533140896e-04, -7.461241159e-05],
    // DEFLECTION
    [-1.049909717e-01, -7.497803531e-01, 8.676940674e-02, 1.459421168e-02, -3.488687001e-03, -6.278459224e-04, 2.095127483e-04],
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::radiation::radiation;
    use crate::law::reference::Course;
    use crate::waves::punch::PunchWaves;
    use halfspace::Medium;

    #[test]
    fn its_first_order_is_the_radiation_law() {
        let terms = AreaDashpot {
            lag: 1e-5,
            inertia: 1.2e-10 * 0.75,
            third: 0.0,
            target_share: 1.0,
        };
        let (found, law) = (terms.summary(), radiation(1e-5));
        assert!(
            (found.peak_force - law.peak_force).abs() < 1e-9,
            "{found:?} {law:?}"
        );
        assert!((found.peak_force_time - law.peak_force_time).abs() < 3e-9);
        assert!((found.contact_time - law.contact_time).abs() < 1e-9);
        assert!(
            (found.loss / law.loss - 1.0).abs() < 3e-5,
            "{} {}",
            found.loss,
            law.loss
        );
        assert!((found.peak_displacement - law.peak_displacement).abs() < 1e-9);
        assert!((found.peak_deflection / law.peak_deflection - 1.0).abs() < 1e-4);
    }

    #[test]
    fn the_tables_are_those_of_the_equation() {
        for (lag, inertia) in [(0.003, 0.0), (0.05, 0.0), (0.12, 1e-3), (0.19, 0.0)] {
            let terms = AreaDashpot {
                lag,
                inertia,
                third: 0.0,
                target_share: 1.0,
            };
            let found = terms.summary();
            // without the third order, which is no part of the equation
            let third = |[c, b, _]: [f64; 3]| lag * (c * lag * lag + b * inertia);
            let force = |d, v| terms.second_order(d, v);
            let course = Course::new(&force, 5e-3);
            let square = 30.0 * inertia * inertia;
            let peak = found.peak_force - third(PEAK_FORCE) - course.peak_force;
            assert!(peak.abs() < 1e-6 + square, "{peak:e}");
            let time = found.peak_force_time - third(PEAK_FORCE_TIME);
            assert!((time - course.peak_force_time).abs() < 1e-5 + square);
            let travel = found.peak_displacement - third(PEAK_DISPLACEMENT);
            assert!((travel - course.peak_displacement).abs() < 1e-6 + square);
            let loss = found.loss - third(LOSS);
            assert!(
                (1.0 - course.velocity.powi(2) - loss).abs() < 2e-5 + square,
                "{lag}"
            );
        }
    }

    #[test]
    fn the_third_order_of_the_results_is_that_of_the_equation() {
        // fitted results and the derived equation differ by the fourth order only
        let waves = PunchWaves::new(&Medium::new(0.3).unwrap());
        for phi in [0.1, 0.5, 0.9] {
            for tau in [0.1, 0.05, 0.02, 0.01] {
                let terms = AreaDashpot::new(&GrowingContact {
                    waves: &waves,
                    target_share: phi,
                    wave_time: tau,
                });
                let found = terms.summary();
                let force = |d, v| terms.law(d, v);
                let course = Course::new(&force, 2e-3);
                let loss = 1.0 - course.velocity.powi(2);
                let allowed = 0.03 * phi * (tau * waves.memory).powi(4) + 1e-7;
                for (found, exact) in [
                    (found.peak_force, course.peak_force),
                    (found.peak_displacement, course.peak_displacement),
                    (found.loss, loss),
                ] {
                    let error = (found - exact).abs() / allowed;
                    assert!(error < 1.0, "{phi} {tau}: {error}");
                }
            }
        }
    }
}
