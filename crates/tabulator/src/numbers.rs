//! Revision of the numbers; versions of the program with the same revision compute the same numbers.

/// Revision of the numbers that [`PointPlan`](crate::PointPlan) computes.
///
/// Tables, journals and shards contain it; an extended table has the revision of its older part. It is raised by hand
/// with every change, in this crate or in `halfspace`, that alters a number by more than the rounding of double
/// precision. `numbers_are_those_of_the_revision` compares numbers of each kind with recorded ones.
pub const NUMBERS_REVISION: u64 = 7;

#[cfg(test)]
mod tests {
    use crate::point::PointPlan;
    use halfspace::Six;

    /// Sums over the lists of a point and over the six fields, each with its own weight.
    fn sum(list: &[Six]) -> f64 {
        let weights = (1..).map(|i| (0.37 * f64::from(i)).sin());
        let numbers = list.iter().flatten();
        numbers.zip(weights).map(|(x, w)| w * x).sum()
    }

    /// If this fails, numbers have changed: raise [`super::NUMBERS_REVISION`] and record the new sums, which the
    /// failure prints.
    #[test]
    fn numbers_are_those_of_the_revision() {
        let mut found = Vec::new();
        for nu in [0.0, 0.3, 0.45] {
            let plan = PointPlan::new(nu, 1e-8, 0.125, 60, 12).unwrap();
            // on the axis, near the surface, near the edge of the disc, far away
            for (r, z) in [(0.0, 0.7), (0.4, 0.02), (1.05, 0.1), (2.5, 1.5)] {
                let point = plan.compute(r, z).unwrap();
                found.extend(point.each_ref().map(|list| sum(list)));
            }
        }
        assert_eq!(found.len(), SUMS.len(), "{found:?}");
        for (i, (a, b)) in found.iter().zip(SUMS).enumerate() {
            // moments are rounded to steps of about 1e-5 of the field, and another sine function may change the step
            let allowed = if matches!(i % 4, 1 | 2) { 2e-5 } else { 1e-10 };
            assert!(
                (a - b).abs() < allowed,
                "sum {i}: {a} against {b}: {found:?}"
            );
        }
    }

    /// Averages, moments, curvatures and tails at each ratio and place, since revision 7.
    #[rustfmt::skip]
    const SUMS: [f64; 48] = [
        -8.638997650183e-02, -1.396103125316e-02, -1.176896081666e-03, -6.642383674809e-03,
        1.015491684908e-01, -2.521699632857e-02, 7.148375200933e-03, -6.985578808823e-03,
        1.876886477051e-02, -3.792052657307e-04, -2.318031141983e-04, -7.502343527597e-03,
        -1.785054544884e-02, -5.535338795246e-04, 2.996025027408e-05, -8.089670119189e-03,
        -1.553663401612e-01, -8.641845001740e-04, -2.235717885850e-04, -8.580645216097e-03,
        1.804942466163e-01, -5.205458953404e-02, 1.176526834935e-02, -9.474322097631e-03,
        7.779657547390e-02, 8.970122038373e-04, -6.358208913299e-04, -9.910423611589e-03,
        -1.544051717552e-02, -1.007882018937e-03, 6.130637336495e-05, -7.694929620995e-03,
        -2.280410215303e-01, 1.301881555299e-02, 4.958289114534e-04, -2.073583106764e-02,
        1.267427710644e-01, -7.374793308115e-02, 1.657233288765e-02, -2.467386797411e-02,
        1.050989861079e-01, 4.216801474020e-03, -6.359008171988e-04, -2.732020199238e-02,
        1.090672028571e-02, -2.095437166075e-03, 6.800321229931e-05, -1.552015982721e-02,
    ];
}
