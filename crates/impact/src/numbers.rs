//! The revision of the numbers of fields: versions of the program with the same revision compute the same numbers.

/// Revision of the fields at points.
///
/// It is part of the identity of sweeps with probes, in addition to [`contact::NUMBERS_REVISION`]. It is
/// raised by hand with every change that alters a field by more than the rounding of double precision, in this crate, in
/// `lookup` or in `halfspace`; a test compares fields with those that were written down for it.
pub const FIELDS_REVISION: u32 = 22;

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
            sensors: Vec::new(),
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

    /// Revision 22: the error of a peak is that of its time.
    #[rustfmt::skip]
    const KNOWN: [[f64; 3]; 6] = [
        [8.236680464508691e-6, 1.1053801620331743e-5, 2.411879956618437e-10],
        [-1334976595.8538249, 1.09619950092592e-5, 44263.077730718374],
        [1.086791359525515, 4.189541595124503e-6, 0.0004829767427168008],
        [4.82477080318011e-6, 1.1098767134081302e-5, 1.3913297223293646e-10],
        [-170502703.4934577, 1.0962043455840378e-5, 6218.079714775085],
        [0.6400721525378034, 4.924344975791117e-6, 0.00031803615895109605],
    ];
}
