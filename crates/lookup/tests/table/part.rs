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
    let (r_max, z_max) = (whole.content().r_max, whole.content().z_max);
    let nodes = |table: &Table| [table.content().r.len(), table.content().z.len()];
    for (nu, tabulated) in [
        (0.08, true),
        (0.21, true),
        (0.19, false),
        (0.01, false),
        (0.39, false),
    ] {
        for [nearest, farthest] in [
            [[0.0; 2]; 2],
            [[0.0; 2], [whole.content().r[1], z_max]],
            [[0.0; 2], [0.3 * r_max, 0.4 * z_max]],
            [[0.0; 2], [r_max, 0.1 * z_max]],
            [[0.0; 2], [r_max, z_max]],
            [[0.7 * r_max, 0.6 * z_max]; 2],
            [[0.6 * r_max, 0.0], [0.7 * r_max, z_max]],
            [[r_max, z_max]; 2],
        ] {
            let part = file.part(nu, [nearest, farthest]).unwrap();
            assert_eq!(part.poisson_ratios(), [nu]);
            assert!(part.content().r_max >= farthest[0] && part.content().z_max >= farthest[1]);
            let smaller = farthest[0] == 0.0 || nearest[0] > 0.5 * r_max;
            assert!(!smaller || nodes(&part)[0] < nodes(&whole)[0]);
            for x in [0.0, 0.31, 0.77, 1.0] {
                for y in [0.0, 0.12, 0.9, 1.0] {
                    let between = |a: f64, b: f64, x: f64| (a + x * (b - a)).min(b);
                    let r = between(nearest[0], farthest[0], x);
                    let z = between(nearest[1], farthest[1], y);
                    let answer = |table: &Table| {
                        let mut cells = vec![[0.0; 6]; CELLS];
                        let info = table
                            .trace(lookup::Smoothness::Linear, nu, r, z, 0, &mut cells)
                            .unwrap();
                        (cells, info, table.error(nu, r, z, 10.0).unwrap())
                    };
                    let (found, exact) = (answer(&part), answer(&whole));
                    if tabulated {
                        assert_eq!(found, exact, "{nu} {nearest:?} {farthest:?}: {r} {z}");
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
    let beyond = [0.0, whole.content().z_max + 1e-9];
    let part = file.part(0.08, [beyond; 2]).unwrap();
    assert_eq!(part.content().z_max, whole.content().z_max);
    let part = file.part(0.45, [[0.1; 2]; 2]).unwrap();
    assert_eq!(part.poisson_ratios(), whole.poisson_ratios());
}

#[test]
fn a_part_refuses_what_it_was_not_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.h5");
    write(&path, &sliced()).unwrap();
    let (r, z) = (1.7, 0.1);
    let part = TableFile::open(&path)
        .unwrap()
        .part(0.08, [[r, z]; 2])
        .unwrap();
    assert!(part.error(0.08, r, z, 10.0).is_ok());
    for far in [0.0, 0.3, 1.0] {
        let error = part.error(0.08, far, z, 10.0).unwrap_err();
        assert!(error.to_string().starts_with("r/r0 = "), "{error}");
    }
}
