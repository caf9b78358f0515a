//! Free fall.

/// Standard gravity in m/s^2.
pub const GRAVITY_M_S2: f64 = 9.80665;

/// Velocity in m/s after a free fall from rest.
///
/// ```text
/// v = sqrt(2 g h),   g = 9.80665 m/s^2
/// ```
///
/// The drag of air is left out: with a drag coefficient of 0.5 it takes 0.1 % of the velocity of a steel ball of 3 mm after 0.1 m, and 1 % after 1 m.
///
/// ```
/// assert!((contact::fall_velocity_m_s(0.2) - 1.980571).abs() < 1e-6);
/// ```
#[must_use]
pub fn fall_velocity_m_s(height_m: f64) -> f64 {
    (2.0 * GRAVITY_M_S2 * height_m).sqrt()
}
