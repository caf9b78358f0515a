//! Rounding of a point's numbers to what a table holds.

use crate::point::PointKernels;
use halfspace::Six;

/// Rounds the numbers of a point to what a table holds.
pub(crate) fn round(point: &mut PointKernels) {
    for field in 0..6 {
        let quantum = quantum(&point.averages, field);
        for six in &mut point.averages {
            six[field] = (six[field] / quantum).round() * quantum;
        }
    }
    for values in [
        &mut point.averages,
        &mut point.moments,
        &mut point.curvatures,
        &mut point.tail,
    ] {
        for value in values.iter_mut().flatten() {
            *value = f64::from(*value as f32);
        }
    }
}

/// Step to which averages are stored: that of single precision at the largest of the field in time.
///
/// All averages share the absolute resolution of the largest and so compress better.
fn quantum(averages: &[Six], field: usize) -> f64 {
    /// Bits after the leading one.
    const BITS: i32 = 24;
    let most = averages
        .iter()
        .fold(0.0_f64, |most, six| most.max(six[field].abs()));
    most.max(f64::from(f32::MIN_POSITIVE)).log2().floor().exp2() * 0.5_f64.powi(BITS)
}
