//! The revision of the numbers of fields: versions of the program with the same revision compute the same numbers.

/// Revision of the fields at points.
///
/// It is part of the identity of sweeps with probes, in addition to [`contact::NUMBERS_REVISION`]. It is
/// raised by hand with every change that alters a field by more than the rounding of double precision, in this crate, in
/// `lookup` or in `halfspace`; a test compares fields with those that were written down for it.
pub const FIELDS_REVISION: u32 = 20;

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
            low_pass_hz: None,
        };
        let responses = Tabulated::default();
        let mut solver = Solver::new(&responses);
        let observed = observe(&mut solver, &scene, &KernelChoice::Direct).unwrap();
        let peaks = observed.peaks.unwrap().unwrap().peaks;
        let rows = [1, 4, 6, 8, 11, 13].map(|i| [peaks[i].value, peaks[i].time_s, peaks[i].error]);
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

    /// Revision 20: errors of the force count more.
    #[rustfmt::skip]
    const KNOWN: [[f64; 3]; 6] = [
        [8.236619684706197e-6, 1.1031529453906603e-5, 8.806262657850892e-10],
        [-1334969647.8198595, 1.09411070813336e-5, 151028.91369747132],
        [1.0867629874347102, 4.159429138358228e-6, 0.0006885651036312989],
        [4.824726644931014e-6, 1.1121951826479609e-5, 9.722572796582712e-10],
        [-170500987.23572704, 1.09411070813336e-5, 113099.29336463622],
        [0.6400378210121088, 4.8828081189422675e-6, 0.000364564806540981],
    ];
}
