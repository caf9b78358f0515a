//! The numerical methods that several parts share.
//!
//! `quadrature` has Gauss's rules on [0, 1] and polynomials through equidistant samples, `gauss` rules of any number of
//! nodes and of any measure, `series` Chebyshev's in two variables, `cubic` the balance of force and indentation at one
//! instant.

pub(crate) mod cubic;
pub(crate) mod gauss;
pub(crate) mod linear;
pub(crate) mod quadrature;
pub(crate) mod series;
pub(crate) mod work;
