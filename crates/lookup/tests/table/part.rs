//! Parts of a table on disk answer as the whole does.

use crate::slices::sliced;
use crate::stand_in::CELLS;
use lookup::{Table, TableFile, write};

#[test]
fn a_part_of_a_file_gives_the_same_answers() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.h5");
    write(&path, &sliced()).unwrap();
    let whole = Table::open(&path).unwrap();
    let file = TableFile::open(&path).unwrap();
    let (r_max, z_max) = (whole.r_max(), whole.z_max());
    let nodes = |table: &Table| [table.content().r.len(), table.content().z.len()];
    for (nu, tabulated) in [
        (0.08, true),
        (0.21, true),
        (0.19, false),
        (0.01, false),
        (0.39, false),
    ] {
        for farthest in [
            [0.0, 0.0],
            [whole.content().r[1], z_max],
            [0.3 * r_max, 0.4 * z_max],
            [r_max, 0.1 * z_max],
            [r_max, z_max],
        ] {
            let part = file.part(nu, farthest).unwrap();
            assert_eq!(part.poisson_ratios(), [nu]);
            assert!(part.r_max() >= farthest[0] && part.z_max() >= farthest[1]);
            assert!(farthest[0] > 0.0 || nodes(&part)[0] < nodes(&whole)[0]);
            for x in [0.0, 0.31, 0.77, 1.0] {
                for y in [0.0, 0.12, 0.9, 1.0] {
                    let (r, z) = (x * farthest[0], y * farthest[1]);
                    let answer = |table: &Table| {
                        let mut cells = vec![[0.0; 6]; CELLS];
                        let info = table.trace(nu, r, z, 0, &mut cells).unwrap();
                        (cells, info, table.error(nu, r, z, 10.0).unwrap())
                    };
                    let (found, exact) = (answer(&part), answer(&whole));
                    if tabulated {
                        assert_eq!(found, exact, "{nu} {farthest:?}: {r} {z}");
                        continue;
                    }
                    for field in 0..6 {
                        let peak = exact.0.iter().fold(0.0, |a: f64, c| a.max(c[field].abs()));
                        for (a, b) in found.0.iter().zip(&exact.0) {
                            assert!((a[field] - b[field]).abs() <= 2e-7 * peak);
                        }
                        let ratio = found.2[field] / exact.2[field];
                        assert!((0.9999..2.0).contains(&ratio), "{nu} {r} {z}: {ratio}");
                    }
                }
            }
        }
    }
}

#[test]
fn a_part_of_what_is_not_served_has_the_ranges_of_the_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.h5");
    write(&path, &sliced()).unwrap();
    let whole = Table::open(&path).unwrap();
    let file = TableFile::open(&path).unwrap();
    let part = file.part(0.08, [whole.r_max() + 1e-9, 0.0]).unwrap();
    assert_eq!((part.r_max(), part.z_max()), (whole.r_max(), whole.z_max()));
    let part = file.part(0.45, [0.1, 0.1]).unwrap();
    assert_eq!(part.poisson_ratios(), whole.poisson_ratios());
}
