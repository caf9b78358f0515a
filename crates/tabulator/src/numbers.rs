//! The revision of the numbers: which versions of the program compute the same ones.

/// Revision of the numbers that [`PointPlan`](crate::PointPlan) computes.
///
/// Journals and shards carry it, so that blocks of two revisions never make one table. It is raised by hand with
/// every change that alters a number of a point by more than the rounding of double precision, in this crate or in
/// `halfspace`; a test compares numbers of each kind with those that were written down for it.
pub const NUMBERS_REVISION: u32 = 1;

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

    /// If this fails, numbers have changed: raise [`super::NUMBERS_REVISION`] and write down the new sums, which the
    /// failure prints.
    #[test]
    fn numbers_are_those_of_the_revision() {
        let mut found = Vec::new();
        for nu in [0.0, 0.3, 0.45] {
            let plan = PointPlan::new(nu, 1e-8, 0.125, 60, 12).unwrap();
            // On the axis, near the surface, beside the disc's edge, far away.
            for (r, z) in [(0.0, 0.7), (0.4, 0.02), (1.05, 0.1), (2.5, 1.5)] {
                let point = plan.compute(r, z).unwrap();
                let lists = [
                    &point.averages,
                    &point.moments,
                    &point.curvatures,
                    &point.tail,
                ];
                found.extend(lists.map(|list| sum(list)));
            }
        }
        assert_eq!(found.len(), SUMS.len(), "{found:?}");
        for (i, (a, b)) in found.iter().zip(SUMS).enumerate() {
            // The moments are rounded to steps of about 1e-5 of the field, which another library of sines may cross.
            let allowed = if matches!(i % 4, 1 | 2) { 2e-5 } else { 1e-10 };
            assert!(
                (a - b).abs() < allowed,
                "sum {i}: {a} against {b}: {found:?}"
            );
        }
    }

    /// Averages, moments, curvatures and tails at each ratio and place, revision 1.
    #[rustfmt::skip]
    const SUMS: [f64; 48] = [
        -8.638997589917e-02, -1.396428352648e-02, -1.165173944547e-03, -6.642383674929e-03,
        1.015491676302e-01, -2.521602853037e-02, 7.208545150848e-03, -6.985578808103e-03,
        1.876886531755e-02, -3.795523936025e-04, -2.256091968011e-04, -7.502343528209e-03,
        -1.785054462408e-02, -5.533262971382e-04, 3.216385780802e-05, -8.089670116072e-03,
        -1.553663270549e-01, -8.626712384776e-04, -1.818364935496e-04, -8.580645216174e-03,
        1.804942474653e-01, -5.205775638233e-02, 1.174114977675e-02, -9.474322097136e-03,
        7.779657693221e-02, 8.954159226992e-04, -6.639706232253e-04, -9.910423611800e-03,
        -1.544051755209e-02, -1.007980315070e-03, 6.757576179988e-05, -7.694929516835e-03,
        -2.280410138045e-01, 1.301672718937e-02, 5.534011928125e-04, -2.073583106762e-02,
        1.267427602265e-01, -7.374549748035e-02, 1.655580360927e-02, -2.467386797215e-02,
        1.050988158321e-01, 4.215479476421e-03, -6.375783257985e-04, -2.732023602083e-02,
        1.182828213971e-02, -1.634539023960e-03, 2.273541390216e-04, -1.622214270828e-02,
    ];
}
