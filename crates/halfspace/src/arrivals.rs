//! Arrival times of the wave fronts from the loaded disc.
//!
//! Theory: `docs/theory.md` (T18, T28).

use crate::domain::{DomainError, check_place};
use crate::medium::Medium;
use crate::profile::Profile;

/// Arrival times at one point in r0/c1, of waves from directly above and from the nearest and farthest edge of the
/// disc.
///
/// Between fronts every field is a smooth function of time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arrivals {
    /// Plane longitudinal and plane shear front from the disc; only for points below the disc.
    pub above: Option<[f64; 2]>,
    /// Longitudinal wave from the nearest and the farthest edge.
    pub p: [f64; 2],
    /// Shear wave from the nearest and the farthest edge.
    pub s: [f64; 2],
    /// Head wave, longitudinal along the surface and shear into the depth; only beyond the critical angle.
    pub head: [Option<f64>; 2],
    /// Rayleigh wave along the surface; below the surface its smooth peak passes at about this time.
    pub rayleigh: [f64; 2],
}

impl Arrivals {
    /// Arrivals at (r, z) from a disc of the profile's radius.
    ///
    /// ```
    /// use halfspace::{Arrivals, Medium, Profile};
    /// let steel = Medium::new(0.3)?;
    /// // the paper, section 4: the longitudinal wave reaches (0, 3 r0) at 3 r0/c1
    /// assert_eq!(Arrivals::new(&steel, Profile::Hertz, 0.0, 3.0)?.first(), 3.0);
    /// # Ok::<(), halfspace::DomainError>(())
    /// ```
    ///
    /// # Errors
    /// [`DomainError`] for r or z outside [0, 1e20].
    pub fn new(medium: &Medium, profile: Profile, r: f64, z: f64) -> Result<Self, DomainError> {
        check_place(r, z)?;
        let radius = profile.radius();
        let edges = [(r - radius).abs(), r + radius];
        let span = (medium.shear_slowness_squared() - 1.0).sqrt();
        Ok(Self {
            above: (r < radius).then_some([z, z / medium.kappa()]),
            p: edges.map(|e| e.hypot(z)),
            s: edges.map(|e| e.hypot(z) / medium.kappa()),
            head: edges.map(|e| (e * span >= z).then_some(e + z * span)),
            rayleigh: edges.map(|e| e / medium.rayleigh_speed()),
        })
    }

    /// The first arrival: the distance to the nearest point of the disc.
    pub fn first(&self) -> f64 {
        self.above.map_or(self.p[0], |above| above[0])
    }

    /// The last arrival; after it every field is a smooth function of 1/t.
    pub fn last(&self) -> f64 {
        let head = self.head[1].unwrap_or(0.0);
        self.s[1].max(self.rayleigh[1]).max(head)
    }

    /// All arrivals in ascending order.
    pub fn sorted(&self) -> Vec<f64> {
        let heads = self.head.into_iter().flatten();
        let above = self.above.into_iter().flatten();
        let waves = [self.p, self.s, self.rayleigh].into_iter().flatten();
        let mut times: Vec<f64> = waves.chain(heads).chain(above).collect();
        times.sort_by(f64::total_cmp);
        times
    }
}
