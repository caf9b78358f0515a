//! The six fields of an axisymmetric half-space, their values, and evaluation points.

/// One displacement or stress component in cylindrical coordinates (r, theta, z), z into the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Field {
    /// u, radial displacement, in P/(mu r0), positive outward.
    DisplacementR,
    /// w, axial displacement, in P/(mu r0), positive into the body.
    DisplacementZ,
    /// sigma_rr in P/r0^2, tension positive.
    StressRr,
    /// sigma_theta-theta in P/r0^2, tension positive.
    StressTt,
    /// sigma_zz in P/r0^2, tension positive.
    StressZz,
    /// sigma_rz in P/r0^2.
    StressRz,
}

/// The fields in the order of every [`Six`].
pub const FIELDS: [Field; 6] = [
    Field::DisplacementR,
    Field::DisplacementZ,
    Field::StressRr,
    Field::StressTt,
    Field::StressZz,
    Field::StressRz,
];

impl Field {
    /// Index in a [`Six`].
    pub const fn index(self) -> usize {
        self as usize
    }

    /// Whether the field is odd in r (it vanishes on the axis); the others are even.
    pub const fn is_odd_in_r(self) -> bool {
        matches!(self, Self::DisplacementR | Self::StressRz)
    }
}

/// One number for each field, in the order of [`FIELDS`].
pub type Six = [f64; 6];

/// Values with an estimate of their own numerical error.
///
/// The estimate is the sum, over the panels of the quadrature, of the rounding error and of the truncation error of a
/// Gauss rule near the closest singularity, rho^(-2n) times a factor calibrated on random points. For the Hertz profile
/// at tolerances of 1e-4 to 1e-10 less than one error in a thousand exceeds it, and the median estimate is 110 to 190
/// times the error: `cargo test -p hertzlamb-halfspace --test estimate -- --nocapture` prints both.
/// Stresses under a punch or a point force are infinite at fronts; there the estimate includes the rounding of the
/// fronts, and its median is 400 to 350000 times the error by region.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Estimate {
    /// The values.
    pub value: Six,
    /// Likely bounds on the absolute error of each value.
    pub error: Six,
}

/// One evaluation point.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Point {
    pub(crate) r: f64,
    pub(crate) z: f64,
    pub(crate) t: f64,
}

/// Direction of travel of a wave past the observer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Sense {
    /// xi- = i (z gamma^ - t)/x: the wave that comes down from the load.
    Outgoing = -1,
    /// xi+ = i (z gamma^ + t)/x: its image in time, which makes the sum causal.
    Image = 1,
}

impl Sense {
    pub(crate) fn sign(self) -> f64 {
        f64::from(self as i8)
    }
}
