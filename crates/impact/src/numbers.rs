//! The revision of the numbers of fields: versions of the program with the same revision compute the same numbers.

/// Revision of the fields at points.
///
/// It is part of the identity of sweeps with probes, in addition to [`contact::NUMBERS_REVISION`]. It is
/// raised by hand with every change that alters a field by more than the rounding of double precision, in this crate, in
/// `lookup` or in `halfspace`; a test compares fields with those that were written down for it.
pub const FIELDS_REVISION: u32 = 19;

#[cfg(test)]
mod tests {
    use crate::sweep::observe;
    use crate::{KernelChoice, Load, Probe, Quantity, Scene, Strike};
    use contact::{HalfSpace, Material, Settings, Solver, Striker, Tabulated};

    /// Peak, its time in s and error of two fields and a velocity, on and off the axis.
    fn found() -> Vec<[f64; 3]> {
        let block = HalfSpace::new(Material::named("soda-lime-glass").unwrap()).unwrap();
        let striker = Striker::ball(Material::named("bearing-steel").unwrap(), 0.003).unwrap();
        let [axis, off] = [[0.0, 3e-4], [4e-4, 2e-4]].map(|[r_m, z_m]| Probe { r_m, z_m });
        let scene = Scene {
            target: block,
            load: Load::Strike(Strike {
                striker,
                velocity_m_s: 3.0,
            }),
            settings: Settings::default(),
            probes: vec![axis, off],
            section: None,
            quantities: vec![Quantity::VelocityZ],
            peaks: false,
            duration_s: None,
        };
        let responses = Tabulated::default();
        let mut solver = Solver::new(&responses);
        let observed = observe(&mut solver, &scene, &KernelChoice::Direct).unwrap();
        let peaks = observed.peaks.unwrap().unwrap().peaks;
        let rows = [1, 4, 6, 8, 11, 13].map(|i| peaks[i]);
        rows.to_vec()
    }

    /// If this fails, numbers have changed: raise [`super::FIELDS_REVISION`] and write down the new ones, which the
    /// failure prints.
    #[test]
    fn fields_are_those_of_the_revision() {
        let found = found();
        for (row, (found_row, known)) in found.iter().zip(KNOWN).enumerate() {
            // an error estimate is of differences of rounded numbers
            for ((a, b), within) in found_row.iter().zip(known).zip([1e-9, 1e-9, 1e-4]) {
                assert!(
                    (a / b - 1.0).abs() < within,
                    "row {row}: {a} against {b}: {found:?}"
                );
            }
        }
    }

    /// Revision 18: histories without memory are marched by pieces, and fields are planned before they are computed.
    #[rustfmt::skip]
    const KNOWN: [[f64; 3]; 6] = [
        [8.236_619_684_706_20e-6, 1.103_152_945_390_66e-5, 8.391_374_647_420_93e-10],
        [-1.334_969_647_819_86e9, 1.094_110_708_133_36e-5, 1.443_045_179_821_18e5],
        [1.086_762_987_434_71e0, 4.159_429_138_358_23e-6, 6.830_920_025_370_60e-4],
        [4.824_726_644_931_01e-6, 1.112_195_182_647_96e-5, 9.479_545_764_231_00e-10],
        [-1.705_009_872_357_27e8, 1.094_110_708_133_36e-5, 1.122_404_602_743_83e5],
        [6.400_378_210_121_09e-1, 4.882_808_118_942_27e-6, 3.613_410_225_640_51e-4],
    ];
}
