//! The revision of the numbers of fields: which versions of the program compute the same ones.

/// Revision of the fields at points.
///
/// Sweeps with probes carry it, beside [`contact::numbers::NUMBERS_REVISION`], in what makes two of them the same. It is
/// raised by hand with every change that alters a field by more than the rounding of double precision, in this crate, in
/// `lookup` or in `halfspace`; a test compares fields with those that were written down for it.
pub const FIELDS_REVISION: u32 = 1;

#[cfg(test)]
mod tests {
    use crate::sweep::observe;
    use crate::{KernelChoice, Load, Probe, Quantity, Scene, Strike};
    use contact::{HalfSpace, Material, Ratios, Settings, Solver, Striker, Tabulated};

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
        let responses = Tabulated::new(Ratios::Few);
        let mut solver = Solver::new(&responses);
        let observed = observe(&mut solver, &scene, &KernelChoice::Direct).unwrap();
        let peaks = observed.peaks.unwrap().peaks;
        let rows = [1, 4, 6, 8, 11, 13].map(|i| peaks[i]);
        rows.map(|p| [p.value, p.time_s, p.error]).to_vec()
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

    /// Revision 1.
    #[rustfmt::skip]
    const KNOWN: [[f64; 3]; 6] = [
        [8.236_619_355_645_9e-6, 1.103_152_945_390_66e-5, 1.579_653_001_106_6e-9],
        [-1.334_969_574_138_19e9, 1.094_110_708_133_36e-5, 1.223_741_406_559_85e6],
        [1.086_783_906_894_74, 4.204_640_324_644_73e-6, 2.114_908_231_345_80e-3],
        [4.824_730_731_748_04e-6, 1.107_674_064_019_31e-5, 7.594_762_233_427_8e-11],
        [-1.705_009_717_923_81e8, 1.094_110_708_133_36e-5, 8.819_525_872_738_37e3],
        [6.400_724_839_737_06e-1, 4.928_019_305_228_77e-6, 2.163_979_050_185_61e-3],
    ];
}
