#![allow(clippy::all, clippy::pedantic, clippy::unwrap_used, missing_docs)]
use crate::evaluator::tests::contact;
use crate::evaluator::Past;
#[test]
fn rate() {
    let e = contact(0.29, 300.0);
    for tol in [1e-8, 1e-2] {
        let past = Past::new(&e, tol).unwrap();
        for b in [12.0, 14.0, 16.0, 20.0] {
            for h in [0.001, 0.01, 0.1] {
                let v: Vec<f64> = [12.0 - h, 12.0, 12.0 + h].iter().map(|&t| past.between([8.0, 0.0], t, [0.0, b]).unwrap()[0]).collect();
                println!("tol {tol:.0e} b {b} h {h}: value {:.10e} rate {:.6e}  left {:.6e} right {:.6e}", v[1], (v[2] - v[0]) / (2.0 * h), (v[1]-v[0])/h, (v[2]-v[1])/h);
            }
            let r = past.rate_between([8.0, 0.0], 12.0, [0.0, b], 2.0).unwrap();
            println!("  rate_between {:.6e}", r[0]);
        }
    }
}
