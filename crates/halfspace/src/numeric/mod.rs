//! Numbers and rules of quadrature: complex roots and logarithms without cancellation (`complex`), sums in twice the
//! precision (`double`), Gauss-Legendre rules (`gauss`), polynomials (`polynomial`), and four numbers side by side
//! (`lanes`), for which and for one number formulas are written once (`scalar`).

pub(crate) mod complex;
pub(crate) mod double;
pub mod gauss;
pub(crate) mod lanes;
pub(crate) mod polynomial;
pub(crate) mod scalar;
