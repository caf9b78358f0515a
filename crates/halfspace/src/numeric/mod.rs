//! Numbers and rules of quadrature: sums in twice the precision (`double`), Gauss-Legendre rules (`gauss`), polynomials
//! (`polynomial`), random numbers that follow from a seed (`random`), and numbers side by side (`lanes`), for which and for one number formulas are written once, with complex
//! roots and logarithms without cancellation (`scalar`).

pub(crate) mod double;
pub mod gauss;
pub(crate) mod lanes;
pub(crate) mod polynomial;
pub mod random;
pub(crate) mod scalar;

/// The last place on the way from one to another that a condition allows, which it does before and not after: by 60 halvings.
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
