//! The dynamic compliance of a disc's deflection, C(i w) over its static value, where it is real.
//!
//! Theory: `docs/theory.md` (T57).

/// -C where it is real, at most, for any Poisson's ratio.
pub(crate) const LARGEST_NEGATIVE: f64 = 0.3;

/// Cells of the memory, frequencies, and the highest in radians over the memory.
const CELLS_OF_SPECTRUM: usize = 256;
const FREQUENCIES: usize = 240;
const HIGHEST_FREQUENCY: f64 = 60.0;

/// The largest -C(i w) at frequencies at which the compliance C is real, zero where it is nowhere negative; to 1e-3.
///
/// ```text
/// C(i w) = 1 - i w int_0^M V e^(-i w t) dt,     V = 1 - W, by its means over cells
/// ```
///
/// `cell` gives int W and its first moment over adjoining cells in ascending order, as `DiscResponse::cells`.
pub(crate) fn negative_compliance(
    memory: f64,
    mut cell: impl FnMut(f64, f64) -> (f64, f64),
) -> f64 {
    let width = memory / CELLS_OF_SPECTRUM as f64;
    let left: Vec<f64> = (0..CELLS_OF_SPECTRUM)
        .map(|j| 1.0 - cell(j as f64 * width, (j + 1) as f64 * width).0 / width)
        .collect();
    let compliance = |angle: f64| {
        // of a cell: w int e^(-i w t) dt = 2 sin(angle/2) e^(-i w middle)
        let (mut real, mut imaginary) = (0.0, 0.0);
        let (mut sine, mut cosine) = (0.5 * angle).sin_cos();
        let (turn_sine, turn_cosine) = angle.sin_cos();
        for v in &left {
            real += v * cosine;
            imaginary -= v * sine;
            (sine, cosine) = (
                sine * turn_cosine + cosine * turn_sine,
                cosine * turn_cosine - sine * turn_sine,
            );
        }
        let size = 2.0 * (0.5 * angle).sin();
        [1.0 + size * imaginary, -size * real]
    };
    let step = HIGHEST_FREQUENCY / (FREQUENCIES as f64 * CELLS_OF_SPECTRUM as f64);
    let mut before = compliance(step);
    let mut largest = 0.0_f64;
    for k in 2..=FREQUENCIES {
        let now = compliance(k as f64 * step);
        if before[1] * now[1] <= 0.0 && before[1] != now[1] {
            let part = before[1] / (before[1] - now[1]);
            largest = largest.max(-(before[0] + part * (now[0] - before[0])));
        }
        before = now;
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::waves::response::DiscResponse;
    use halfspace::{Deflection, Medium, SurfaceResponse};

    #[test]
    fn the_centre_is_soft_at_some_frequencies_and_the_mean_at_none() {
        let negative = |nu: f64, deflection| {
            SurfaceResponse::new(&Medium::new(nu).unwrap(), deflection).negative_compliance()
        };
        for i in -9..50 {
            let nu = f64::from(i) * 0.01 * if i < 0 { 10.0 } else { 1.0 };
            let [centre, mean] = [Deflection::Centre, Deflection::Mean].map(|of| negative(nu, of));
            println!("nu = {nu:.2}: {centre:.4} {mean:.4}");
            assert!(centre < LARGEST_NEGATIVE && mean < 1e-3);
        }
    }
}
