//! The balance of force and indentation at one instant: the cubic a y^3 + y^2 = b for y = p^(1/3).
//!
//! Hertz's indentation is y^2, a y^3 is what the newest force takes away at once: the striker's own retreat and the
//! elastic deflection of the half-space.
//!
//! Theory: `docs/theory.md` (T42).

/// The smallest y >= 0 of a y^3 + y^2 = b, relative error below 1e-12; zero where b <= 0, nothing where there is none.
pub(crate) fn force_root(a: f64, b: f64, guess: f64) -> Option<f64> {
    if b.is_nan() {
        return None;
    }
    if b <= 0.0 {
        return Some(0.0);
    }
    // For a >= 0 the left side and its derivatives rise, so that Halley's method finds its root from any y > 0.
    if a >= 0.0 && guess > 0.0 {
        let mut y = guess;
        for _ in 0..8 {
            let value = (a * y + 1.0) * y * y - b;
            let slope = (3.0 * a * y + 2.0) * y;
            let change = value * slope / (slope * slope - value * (3.0 * a * y + 1.0));
            y -= change;
            // the relative error is cubed each time, with a factor below 1/2
            if change.abs() <= 1e-4 * y {
                return Some(y);
            }
            if y <= 0.0 || y.is_nan() {
                break;
            }
        }
    }
    // The root lies below sqrt(b) for a > 0, and below the fold 2/(3 |a|) for a < 0.
    let (mut low, mut high) = if a >= 0.0 {
        (0.0, b.sqrt())
    } else {
        let fold = -2.0 / (3.0 * a);
        if fold * fold * (1.0 + a * fold) < b {
            return None;
        }
        (b.sqrt().min(fold), fold)
    };
    let inside = guess > low && guess < high;
    let mut y = if inside { guess } else { high };
    for _ in 0..100 {
        let value = (a * y + 1.0) * y * y - b;
        if value > 0.0 {
            high = y;
        } else {
            low = y;
        }
        let newton = y - value / ((3.0 * a * y + 2.0) * y);
        let inside = newton >= low && newton <= high;
        let next = if inside { newton } else { 0.5 * (low + high) };
        // Newton's error is squared each time: the next one would be below the last digit
        if (next - y).abs() <= 1e-8 * y {
            return Some(next);
        }
        y = next;
    }
    Some(y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cubic_is_solved_on_its_physical_branch() {
        for a in [-0.9, -0.3, 0.0, 1e-9, 0.1, 10.0, 1e9] {
            for y in [1e-12, 1e-3, 0.1, 0.7] {
                let b: f64 = (a * y + 1.0) * y * y;
                for guess in [0.0, y, 0.5, -1.0, f64::NAN] {
                    let found = force_root(a, b, guess).unwrap();
                    assert!((found / y - 1.0).abs() < 1e-12, "{a} {y} {found}");
                }
            }
        }
        assert_eq!(force_root(-0.9, 0.3, 0.5), None);
        assert_eq!(force_root(0.3, -1.0, 0.5), Some(0.0));
        assert_eq!(force_root(0.3, f64::NAN, 0.5), None);
    }
}
