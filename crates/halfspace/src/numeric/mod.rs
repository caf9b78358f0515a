//! Numerical tools: Bessel functions (`bessel`), arithmetic in twice the precision (`double`), Gauss-Legendre rules (`gauss`), polynomials
//! (`polynomial`), seeded random numbers (`random`), vector registers (`lanes`), and a common interface to numbers and
//! registers with complex roots and logarithms without cancellation (`scalar`).

pub(crate) mod bessel;
pub(crate) mod double;
pub mod gauss;
pub(crate) mod lanes;
pub(crate) mod polynomial;
pub mod random;
pub(crate) mod scalar;

/// The last place between `from` and `to` at which a condition holds, by 60 bisections; it holds before that place and
/// not after it.
pub fn bisected(mut from: f64, mut to: f64, allows: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (from + to);
        if allows(middle) {
            from = middle;
        } else {
            to = middle;
        }
    }
    from
}
