//! The revision of the numbers of fields: which versions of the program compute the same ones.

/// Revision of the fields at points.
///
/// Sweeps with probes carry it, beside [`contact::NUMBERS_REVISION`], in what makes two of them the same. It is
/// raised by hand with every change that alters a field by more than the rounding of double precision, in this crate, in
/// `lookup` or in `halfspace`; a test compares fields with those that were written down for it.
pub const FIELDS_REVISION: u32 = 17;

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

    /// Revision 17: fields of records that jump, estimates of looked-up fields, and fields close to a contact.
    #[rustfmt::skip]
    const KNOWN: [[f64; 3]; 6] = [
        [8.236_619_355_763_50e-6, 1.103_152_945_390_66e-5, 2.460_409_030_584_00e-9],
        [-1.334_969_585_446_52e9, 1.094_110_708_133_36e-5, 3.937_619_664_498_90e5],
        [1.086_762_519_094_97e0, 4.159_429_138_358_23e-6, 6.143_435_442_727_00e-4],
        [4.824_726_432_104_24e-6, 1.112_195_182_647_96e-5, 1.852_090_656_652_53e-9],
        [-1.705_010_172_813_56e8, 1.094_110_708_133_36e-5, 1.435_257_959_775_19e5],
        [6.400_384_367_285_57e-1, 4.882_808_118_942_27e-6, 3.504_065_986_588_52e-4],
    ];
}
