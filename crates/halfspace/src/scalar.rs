//! Real or complex numbers: the closed forms of the potentials hold for both.

use num_complex::Complex64;
use std::ops::{Add, Mul, Sub};

/// A real or complex number.
pub(crate) trait Scalar:
    Copy
    + From<f64>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
{
}

impl Scalar for f64 {}
impl Scalar for Complex64 {}
