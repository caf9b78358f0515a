//! Relative errors measured between the nodes of the grid, by field, on slices and between them.

use crate::content::{Content, FIELDS, Verification};
use halfspace::Field;

/// Quantiles over places of the relative error: the largest error in time over the largest exact response in time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantiles {
    /// Median.
    pub p50: f64,
    /// 99 % quantile.
    pub p99: f64,
    /// Largest.
    pub max: f64,
}

/// Relative errors for one length of the pulse, each in the order of [`halfspace::FIELDS`].
#[derive(Debug, Clone, PartialEq)]
pub struct Accuracy {
    /// Length of the pulse in r0/c1.
    pub pulse_length: f64,
    /// Errors at the centres of all meshes of all slices.
    pub on_slices: [Quantiles; 6],
    /// Errors midway between neighbouring slices; none for a table without such probes.
    pub between_slices: Option<[Quantiles; 6]>,
}

impl Content {
    /// Measured errors, for each of [`Self::pulse_lengths`]; places where a field is always zero are skipped.
    ///
    /// The content must be one that [`crate::Table::new`] accepts.
    pub fn accuracy(&self) -> Vec<Accuracy> {
        let slices: Vec<&Verification> = self.slices.iter().map(|s| &s.verification).collect();
        let between: Vec<&Verification> = self.between.iter().map(|b| &b.verification).collect();
        let of = |measured: &[&Verification], pulse: usize| -> [Quantiles; 6] {
            std::array::from_fn(|field| {
                let every = FIELDS * self.pulse_lengths.len();
                quantiles(measured, pulse * FIELDS + field, every)
            })
        };
        let lengths = self.pulse_lengths.iter().enumerate();
        lengths
            .map(|(pulse, &pulse_length)| Accuracy {
                pulse_length,
                on_slices: of(&slices, pulse),
                between_slices: (!between.is_empty()).then(|| of(&between, pulse)),
            })
            .collect()
    }
}

/// The value nearest to the `fraction` quantile of ascending values; zero for an empty list.
///
/// ```
/// assert_eq!(lookup::quantile(&[1.0, 2.0, 3.0, 10.0, 20.0], 0.5), 3.0);
/// ```
pub fn quantile(ascending: &[f64], fraction: f64) -> f64 {
    let last = ascending.len().saturating_sub(1) as f64;
    let index = (fraction * last).round() as usize;
    ascending.get(index).copied().unwrap_or(0.0)
}

/// Quantiles over the entries `first`, `first + every`, ... of all verifications.
fn quantiles(measured: &[&Verification], first: usize, every: usize) -> Quantiles {
    let mut errors: Vec<f64> = measured
        .iter()
        .flat_map(|probes| {
            let pairs = probes.error.iter().zip(&probes.direct);
            pairs.skip(first).step_by(every)
        })
        .filter(|&(_, &peak)| peak != 0.0)
        .map(|(&error, &peak)| f64::from(error) / f64::from(peak).abs())
        .collect();
    errors.sort_by(f64::total_cmp);
    Quantiles {
        p50: quantile(&errors, 0.5),
        p99: quantile(&errors, 0.99),
        max: quantile(&errors, 1.0),
    }
}

/// The field with the largest 99 % quantile, and its errors.
pub fn worst(errors: &[Quantiles; 6]) -> (Field, Quantiles) {
    let fields = halfspace::FIELDS.into_iter().zip(*errors);
    fields
        .max_by(|a, b| a.1.p99.total_cmp(&b.1.p99))
        .unwrap_or((halfspace::FIELDS[0], errors[0]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_field_has_its_own_quantiles_and_small_peaks_count() {
        // Three places, two pulses, six fields: the error of field 4 under pulse 1 is large where its peak is small.
        let places = 3;
        let mut probes = Verification {
            direct: vec![1.0; places * 2 * FIELDS],
            looked_up: vec![1.0; places * 2 * FIELDS],
            error: vec![1e-6; places * 2 * FIELDS],
        };
        let entry = (2 * 2 + 1) * FIELDS + 4;
        (probes.direct[entry], probes.error[entry]) = (-1e-5, 1e-6);
        let all = [&probes];
        let of = |pulse: usize, field: usize| quantiles(&all, pulse * FIELDS + field, 2 * FIELDS);
        assert!((of(1, 4).max - 0.1).abs() < 1e-6);
        assert!((of(1, 4).p50 - 1e-6).abs() < 1e-12);
        assert!((of(0, 4).max - 1e-6).abs() < 1e-12);
        let errors = std::array::from_fn(|field| of(1, field));
        assert_eq!(worst(&errors).0, halfspace::FIELDS[4]);
    }
}
