//! The static field under a unit force, in closed form.
//!
//! ```text
//! w = (1 - nu) A3 + z A2/2         u = [-(1 - 2 nu) B3 + z B2]/2      szz = -(A2 + z A1)     srz = -z B1
//! srr = -A2 + z A1 - 2 u/r         stt = -2 nu A2 + 2 u/r             potentials at xi = z
//! ```
//!
//! For the Hertz profile this is Huber's solution (1904), which has a form of its own.
//!
//! Theory: `docs/theory.md` (T15).

use crate::domain::check_place_under;
use crate::error::DomainError;
use crate::field::Six;
use crate::huber;
use crate::medium::Medium;
use crate::potentials::closed_form::of_one;
use crate::potentials::order::{IMPULSE, STEP};
use crate::profile::Profile;
use num_complex::Complex64;

impl Medium {
    /// The static fields under a unit force: those of [`Kernel::static_field`](crate::Kernel::static_field).
    ///
    /// # Errors
    /// As there.
    pub fn static_field(&self, profile: Profile, r: f64, z: f64) -> Result<Six, DomainError> {
        check_place_under(profile, r, z)?;
        Ok(match profile {
            Profile::Hertz => huber::static_field(self.poisson_ratio(), r, z),
            Profile::Punch | Profile::Point => by_potentials(self, profile, r, z),
        })
    }
}

fn by_potentials(medium: &Medium, profile: Profile, r: f64, z: f64) -> Six {
    let nu = medium.poisson_ratio();
    let xi = Complex64::new(z, 0.0);
    let here = of_one::<STEP>(profile, xi, r);
    let (a3, a2, g3) = (here.a_upper.re, here.a_lower.re, here.g_upper.re);
    // z times the lower orders vanishes on the surface, though they are singular at the edge there
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
