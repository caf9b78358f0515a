//! The static field under a unit force, in closed form.
//!
//! ```text
//! w = (1 - nu) A3 + z A2/2         u = [-(1 - 2 nu) B3 + z B2]/2      szz = -(A2 + z A1)     srz = -z B1
//! srr = -A2 + z A1 - 2 u/r         stt = -2 nu A2 + 2 u/r             potentials at xi = z
//! ```
//!
//! For the Hertz profile this is Huber's solution (1904), which is evaluated in a separate form.
//!
//! Theory: `docs/theory.md` (T15).

use crate::domain::{DomainError, check_place_under};
use crate::field::Six;
use crate::medium::Medium;
use crate::potentials::closed_form::of_one;
use crate::potentials::{IMPULSE, STEP};
use crate::profile::Profile;
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, PI};

impl Medium {
    /// The static fields under a unit force: those of [`Kernel::static_field`](crate::Kernel::static_field).
    ///
    /// # Errors
    /// As there.
    pub fn static_field(&self, profile: Profile, r: f64, z: f64) -> Result<Six, DomainError> {
        check_place_under(profile, r, z)?;
        Ok(match profile {
            Profile::Hertz => huber(self.poisson_ratio(), r, z),
            Profile::Punch | Profile::Point => by_potentials(self, profile, r, z),
        })
    }
}

fn by_potentials(medium: &Medium, profile: Profile, r: f64, z: f64) -> Six {
    let nu = medium.poisson_ratio();
    let xi = Complex64::new(z, 0.0);
    let here = of_one::<STEP>(profile, xi, r);
    let (a3, a2, g3) = (here.a_upper.re, here.a_lower.re, here.g_upper.re);
    // z times the lower orders vanishes on the surface, although they are singular at the edge
    let (z_a1, z_g2, z_g1) = if z > 0.0 {
        let below = of_one::<IMPULSE>(profile, xi, r);
        (
            z * below.a_lower.re,
            z * here.g_lower.re,
            z * below.g_lower.re,
        )
    } else {
        (0.0, 0.0, 0.0)
    };
    let u_over_r = 0.5 * (z_g2 - (1.0 - 2.0 * nu) * g3);
    let szz = if z > 0.0 {
        -(a2 + z_a1)
    } else {
        -profile.pressure(r)
    };
    [
        u_over_r * r,
        (1.0 - nu) * a3 + 0.5 * z * a2,
        -a2 + z_a1 - 2.0 * u_over_r,
        -2.0 * nu * a2 + 2.0 * u_over_r,
        szz,
        -z_g1 * r,
    ]
}

/// The static field under a Hertz load: Huber's solution (1904) in a form without cancellation.
///
/// Oblate spheroidal coordinates turn the potentials of the load into elementary functions of two numbers, c and s,
///
/// ```text
/// r^2/(1 + s^2) + z^2/s^2 = 1        c = z/s = sqrt(1 - r^2/(1 + s^2))        T = 1 - s atan(1/s)
/// ```
///
/// s = 0 on the disc and c = 0 on the surface outside it. With p0 = 3/(2 pi), the pressure at the centre,
///
/// ```text
/// w    = (1 - nu) A3 + z A2/2         A2 = p0 c T        A3 = p0/4 [2 atan(1/s) - r^2 V - 2 z c T]
/// u    = p0 r/2 [c (1 - nu) (1/(1 + s^2) - T) - ring]    V  = atan(1/s) - s/(1 + s^2)
/// srr  = p0 [ring + core - c ((1 - nu)/(1 + s^2) + (1 + nu) T)]
/// stt  = p0 [c ((1 - nu)/(1 + s^2) - (1 + nu) T) - ring]
/// szz  = -p0 core                     core = c^3/(s^2 + c^2)
/// srz  = -p0 r s c^2/((s^2 + c^2) (1 + s^2))
/// ring = (1 - 2 nu)/3 (1 - c^3)/r^2 = (1 - 2 nu)/3 (1 + c + c^2)/((1 + s^2) (1 + c))
/// ```
///
/// The stresses are those of Johnson, Contact Mechanics (1985), section 3.4, with u = s^2.
///
/// The error is 2e-15, relative to the largest field of the same unit.
fn huber(nu: f64, r: f64, z: f64) -> Six {
    const P0: f64 = 1.5 / PI;
    let [c, s] = spheroidal(r, z);
    let inverse = 1.0 / (1.0 + s * s);
    let deficit = arc_deficit(s);
    let ring = (1.0 - 2.0 * nu) / 3.0 * (1.0 + c + c * c) / (1.0 + c) * inverse;
    let (sum, core) = if z > 0.0 {
        let sum = s * s + c * c;
        (sum, c * c * c / sum)
    } else {
        // the pressure, to the last bit
        (1.0, ((1.0 - r) * (1.0 + r)).max(0.0).sqrt())
    };
    let curvature = second_arc(s, deficit);
    let a3 = 0.25 * (2.0 * arc(s) - r * r * curvature - 2.0 * z * c * deficit);
    [
        0.5 * P0 * r * (c * (1.0 - nu) * (inverse - deficit) - ring),
        P0 * ((1.0 - nu) * a3 + 0.5 * z * c * deficit),
        P0 * (ring + core - c * ((1.0 - nu) * inverse + (1.0 + nu) * deficit)),
        P0 * (c * ((1.0 - nu) * inverse - (1.0 + nu) * deficit) - ring),
        -P0 * core,
        -P0 * r * s * c * c / sum * inverse,
    ]
}

/// The two spheroidal coordinates c and s, computed without cancellation.
fn spheroidal(r: f64, z: f64) -> [f64; 2] {
    let d = (r - 1.0) * (r + 1.0) + z * z;
    let root = d.hypot(2.0 * z);
    if d > 0.0 {
        let s = (0.5 * (root + d)).sqrt();
        [z / s, s]
    } else {
        let c = (0.5 * (root - d)).sqrt();
        let s = if z > 0.0 { z / c } else { 0.0 };
        [c, s]
    }
}

/// atan(1/s) for s >= 0.
fn arc(s: f64) -> f64 {
    if s > 1.0 {
        (1.0 / s).atan()
    } else {
        FRAC_PI_2 - s.atan()
    }
}

/// Value of s from which differences of arcs are computed from their series in 1/s.
const FAR_ARCS: f64 = 2.0;

/// T = 1 - s atan(1/s), which falls as 1/(3 s^2).
fn arc_deficit(s: f64) -> f64 {
    if s < FAR_ARCS {
        return 1.0 - s * arc(s);
    }
    // x^2/3 - x^4/5 + ... from its small end, x = 1/s
    const ARC_TERMS: i32 = 27;
    let square = 1.0 / (s * s);
    let terms = (1..=ARC_TERMS).rev();
    square * terms.fold(0.0, |sum, n| 1.0 / f64::from(2 * n + 1) - square * sum)
}

/// V = atan(1/s) - s/(1 + s^2), which falls as 2/(3 s^3).
fn second_arc(s: f64, deficit: f64) -> f64 {
    let inverse = 1.0 / (1.0 + s * s);
    if s < FAR_ARCS {
        arc(s) - s * inverse
    } else {
        (inverse - deficit) / s
    }
}
