//! Double-double arithmetic, about 31 decimal digits: what `twofloat` rounds to a double is finished here.
//!
//! Its sums and products, and quotients by a double, are exact to 31 digits; its quotients of two
//! double-doubles and its elementary functions stop at 17 to 23 (version 0.8).

use twofloat::TwoFloat;

/// 2 pi.
const TURN: TwoFloat = twofloat::consts::TAU;

/// a/b.
pub(crate) fn divide(a: TwoFloat, b: TwoFloat) -> TwoFloat {
    let first = a.hi() / b.hi();
    let rest = a - b * first;
    let second = rest.hi() / b.hi();
    let third = (rest - b * second).hi() / b.hi();
    TwoFloat::new_add(first, second) + third
}

/// The square root of a > 0.
pub(crate) fn root(a: TwoFloat) -> TwoFloat {
    let x = TwoFloat::from(a.hi().sqrt());
    let x = x + (a - x * x) / (2.0 * x.hi());
    x + (a - x * x) / (2.0 * x.hi())
}

/// e^x for |x| < 700.
pub(crate) fn exponential(x: TwoFloat) -> TwoFloat {
    const HALVINGS: i32 = 9;
    let doublings = (x.hi() / std::f64::consts::LN_2).round();
    let reduced = (x - twofloat::consts::LN_2 * doublings) * 0.5_f64.powi(HALVINGS);
    // e^x - 1 by its series, then doubled: (1 + y)^2 - 1 = y (2 + y)
    let mut term = reduced;
    let mut sum = reduced;
    for n in 2..=12 {
        term = term * reduced / f64::from(n);
        sum += term;
    }
    for _ in 0..HALVINGS {
        sum = sum * (sum + 2.0);
    }
    (sum + 1.0) * doublings.exp2()
}

/// sin x and cos x.
pub(crate) fn sine_cosine(x: TwoFloat) -> (TwoFloat, TwoFloat) {
    const HALVINGS: i32 = 6;
    let turns = (x.hi() / TURN.hi()).round();
    let reduced = (x - TURN * turns) * 0.5_f64.powi(HALVINGS);
    let square = reduced * reduced;
    let (mut sine, mut versed) = (reduced, square * 0.5);
    let (mut odd, mut even) = (sine, versed);
    for n in 1..=9 {
        let m = f64::from(2 * n);
        odd = -odd * square / (m * (m + 1.0));
        even = -even * square / ((m + 1.0) * (m + 2.0));
        sine += odd;
        versed += even;
    }
    // 1 - cos 2x = 2 sin^2 x keeps its digits where cos is near one
    for _ in 0..HALVINGS {
        (sine, versed) = (sine * (1.0 - versed) * 2.0, sine * sine * 2.0);
    }
    (sine, 1.0 - versed)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn small(x: TwoFloat) -> f64 {
        f64::from(x).abs()
    }

    #[test]
    fn functions_keep_thirty_digits() {
        for i in 1..60 {
            let x = divide(TwoFloat::from(f64::from(i)), TwoFloat::from(7.0)) * 3.0;
            assert!(small(divide(x, x * 3.0) * 3.0 - 1.0) < 1e-30);
            assert!(small(divide(root(x) * root(x), x) - 1.0) < 1e-30);
            let (sine, cosine) = sine_cosine(x);
            let (twice, _) = sine_cosine(x * 2.0);
            assert!(small(sine * sine + cosine * cosine - 1.0) < 1e-29, "{i}");
            assert!(small(twice - sine * cosine * 2.0) < 3e-29, "{i}");
            let product = exponential(x) * exponential(-x * 2.0) * exponential(x);
            assert!(small(product - 1.0) < 3e-29, "{i}");
            assert!((f64::from(exponential(x)) / f64::from(x).exp() - 1.0).abs() < 1e-14);
            assert!((f64::from(sine) - f64::from(x).sin()).abs() < 1e-14);
        }
    }
}
