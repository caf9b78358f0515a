//! The solver against `scipy.optimize.nnls`, whose solutions are in tests/golden/nnls.csv.

use inverse::{Symmetric, nnls};

struct Case {
    rows: Vec<Vec<f64>>,
    right: Vec<f64>,
    solution: Vec<f64>,
}

fn cases() -> Vec<Case> {
    let text = include_str!("../../../tests/golden/nnls.csv");
    let mut cases: Vec<Case> = Vec::new();
    for line in text.lines().skip(1) {
        let mut parts = line.split(',');
        let [problem, kind, values] = [(); 3].map(|()| parts.next().expect("three columns"));
        let values: Vec<f64> = values
            .split(' ')
            .map(|x| x.parse().expect("a number"))
            .collect();
        if problem.parse() == Ok(cases.len()) {
            cases.push(Case {
                rows: vec![],
                right: vec![],
                solution: vec![],
            });
        }
        let case = cases.last_mut().expect("a case");
        match kind {
            "row" => case.rows.push(values),
            "right" => case.right = values,
            _ => case.solution = values,
        }
    }
    cases
}

#[test]
fn solutions_are_those_of_scipy() {
    let cases = cases();
    assert_eq!(cases.len(), 5);
    for (k, case) in cases.iter().enumerate() {
        let size = case.solution.len();
        let product = |i: usize, j: usize| case.rows.iter().map(|row| row[i] * row[j]).sum();
        let matrix = Symmetric::from_fn(size, product);
        let column = |j: usize| {
            case.rows
                .iter()
                .zip(&case.right)
                .map(|(row, b)| row[j] * b)
                .sum()
        };
        let right: Vec<f64> = (0..size).map(column).collect();
        let largest = case.solution.iter().fold(0.0, |a: f64, b| a.max(*b));
        // from nothing, from everything, and from the unknowns that are zero in the end
        let wrong = case.solution.iter().map(|x| f64::from(u8::from(*x == 0.0)));
        for start in [vec![], vec![1.0; size], wrong.collect()] {
            let found = nnls(&matrix, &right, &start).expect("a solution");
            let worst = found
                .x
                .iter()
                .zip(&case.solution)
                .map(|(a, b)| (a - b).abs())
                .fold(0.0, f64::max);
            println!("problem {k}: {worst:.1e} of {largest:.2}");
            assert!(
                worst < 1e-9 * largest,
                "problem {k}: {:?} instead of {:?}",
                found.x,
                case.solution
            );
            for (x, g) in found.x.iter().zip(&found.gradient) {
                assert!(*x >= 0.0 && (*x > 0.0 || *g <= 1e-9), "{x} {g}");
            }
        }
    }
}

#[test]
fn equal_columns_and_nothing_to_explain() {
    let equal = Symmetric::from_fn(3, |_, _| 1.0);
    let found = nnls(&equal, &[2.0; 3], &[1.0; 3]).expect("a solution");
    assert!(
        (found.x.iter().sum::<f64>() - 2.0).abs() < 1e-12,
        "{:?}",
        found.x
    );
    let found = nnls(&equal, &[-1.0; 3], &[1.0, 2.0, 3.0]).expect("a solution");
    assert_eq!(found.x, [0.0; 3]);
    assert!(nnls(&Symmetric::from_fn(0, |_, _| 0.0), &[], &[]).is_some());
}
