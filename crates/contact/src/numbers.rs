//! The revision of the numbers: versions of the program with the same revision compute the same numbers.

/// Revision of the results of contacts.
///
/// It is part of the identity of a sweep, so that parts of two revisions are never merged and a finished
/// output of another one is never taken for this one's. It is raised by hand with every change that alters a result by
/// more than the rounding of double precision, in this crate or in `halfspace`; a test compares results of every model
/// with those that were written down for it.
pub const NUMBERS_REVISION: u32 = 9;

#[cfg(test)]
mod tests {
    use crate::bodies::material::Material;
    use crate::bodies::{HalfSpace, Striker};
    use crate::collision::Collision;
    use crate::settings::{Model, Settings, StaticShare};
    use crate::solve::Solver;
    use crate::waves::cache::Exact;

    /// Peak force, contact time and loss of every model, in collision units.
    fn found() -> Vec<[f64; 3]> {
        let block = HalfSpace::new(Material::named("soda-lime-glass").unwrap()).unwrap();
        let ball = Striker::ball(Material::named("bearing-steel").unwrap(), 0.003).unwrap();
        let of = |model, disc_radius_m, static_share, tolerance| {
            let settings = Settings {
                model,
                disc_radius_m,
                static_share,
                tolerance,
                ..Settings::default()
            };
            let collision = Collision::new(&block, &ball, 3.0);
            let solved = Solver::new(&Exact).solve(&collision, &settings).unwrap();
            let summary = solved.summary;
            [summary.peak_force, summary.contact_time, summary.loss]
        };
        let (full, dynamic) = (StaticShare::Full, StaticShare::Dynamic);
        vec![
            of(Model::Hertz, None, full, 1e-4),
            of(Model::Radiation, None, full, 1e-4),
            of(Model::AreaDashpot, None, full, 1e-4),
            of(Model::Growing, None, full, 1e-4),
            of(Model::Growing, None, full, 1e-8),
            of(Model::Wave, Some(1e-3), full, 1e-4),
            of(Model::Wave, Some(1e-3), dynamic, 1e-4),
            of(Model::Auto, None, full, 1e-6),
        ]
    }

    /// If this fails, numbers have changed: raise [`super::NUMBERS_REVISION`] and write down the new ones, which the
    /// failure prints.
    #[test]
    fn numbers_are_those_of_the_revision() {
        let found = found();
        for (row, (found_row, known)) in found.iter().zip(KNOWN).enumerate() {
            for (a, b) in found_row.iter().zip(known) {
                assert!(
                    (a - b).abs() < 1e-11,
                    "row {row}: {a} against {b}: {found:.13?}"
                );
            }
        }
    }

    /// Revision 9: those of a contact that follows the load do not depend on `step_s`; the others are revision 8's.
    #[rustfmt::skip]
    const KNOWN: [[f64; 3]; 8] = [
        [1.000_000_000_000_0, 2.943_275_184_324_7, 0.000_000_000_000_0],
        [0.995_210_045_239_2, 2.945_624_878_559_4, 0.015_966_515_869_5],
        [0.995_269_229_917_1, 2.945_591_991_904_2, 0.015_802_410_641_6],
        [0.995_269_277_934_5, 2.945_580_496_380_2, 0.015_802_430_110_0],
        [0.995_269_231_434_8, 2.945_591_980_599_2, 0.015_802_426_907_9],
        [0.878_917_389_971_0, 3.245_947_520_551_1, 0.011_176_600_436_8],
        [0.995_343_444_605_2, 2.944_906_453_031_1, 0.015_804_088_865_8],
        [0.995_269_229_917_1, 2.945_591_991_904_2, 0.015_802_410_641_6],
    ];
}
