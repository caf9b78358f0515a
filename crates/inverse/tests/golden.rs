//! Six noisy traces of an independent program (`tests/golden/inverse_trace.csv`) at a signal-to-noise ratio of 100.

use halfspace::{Field, Kernel, Medium, Profile};
use inverse::{Gain, Inferred, Noise, Problem, Pulse, Trace, infer};

/// Force samples before the first sample.
const LEAD: usize = 4;

/// Response of a surface point at distance 1 to a hat; time in 1/c2, displacement in P/mu, nu = 1/4.
fn response(velocity: bool, step: f64, count: usize) -> Vec<f64> {
    let medium = Medium::new(0.25).expect("a Poisson ratio");
    let kernel = Kernel::new(&medium, Profile::Point, 1e-10).expect("a tolerance");
    let w = Field::DisplacementZ.index();
    let rest = kernel.static_field(1.0, 0.0).expect("a place")[w];
    let faster = 3.0_f64.sqrt();
    let base = kernel.step_integral(1.0, 0.0, 0.0).expect("a time").value[w];
    let integral = |t: f64| {
        let t = t.max(0.0) * faster;
        (rest * t + kernel.step_integral(1.0, 0.0, t).expect("a time").value[w] - base) / faster
    };
    let rise = |t: f64| {
        let t = t.max(0.0) * faster;
        rest + kernel.remainder(1.0, 0.0, t).expect("a time").value[w]
    };
    let bend = |f: &dyn Fn(f64) -> f64, t: f64| (f(t + step) - 2.0 * f(t) + f(t - step)) / step;
    let at = |t: f64| {
        if velocity {
            bend(&rise, t)
        } else {
            bend(&integral, t)
        }
    };
    (0..count).map(|k| at(k as f64 * step)).collect()
}

/// Step, largest true force and trace of a case.
fn read(case: &str) -> (f64, f64, Trace) {
    let text = include_str!("../../../tests/golden/inverse_trace.csv");
    let lines = text.lines().filter(|line| line.starts_with(case));
    let numbers = |line: &str| {
        line.split(',')
            .skip(1)
            .map(|x| x.parse().expect("a number"))
            .collect()
    };
    let rows: Vec<Vec<f64>> = lines.map(numbers).collect();
    let largest = |column: usize| {
        rows.iter()
            .fold(0.0, |a: f64, row| a.max(row[column].abs()))
    };
    let trace = Trace {
        samples: rows.iter().map(|row| row[2]).collect(),
        response: response(case.starts_with('v'), rows[0][0], rows.len() + LEAD),
        noise: Noise::White(largest(2) / 100.0),
        gain: Gain::Known(1.0),
        valid_until_s: None,
    };
    (rows[0][0], largest(1), trace)
}

/// The L-curve in its order, and a residual of the size of the noise.
fn check_consistency(case: &str, trace: &Trace, found: &Inferred) {
    let history = &found.history;
    assert!(history.l_curve.len() > 10, "{case}");
    for pair in history.l_curve.windows(2) {
        // more weight: a smoother force with a larger residual
        assert!(
            pair[0].lambda < pair[1].lambda && pair[0].residual < pair[1].residual * (1.0 + 1e-9)
        );
        assert!(
            pair[0].roughness > pair[1].roughness * (1.0 - 1e-9),
            "{case}: {pair:?}"
        );
    }
    let left = trace
        .samples
        .iter()
        .zip(&found.predicted[0])
        .map(|(d, p)| (d - p).powi(2));
    let rms = (left.sum::<f64>() / trace.samples.len() as f64).sqrt() / found.noise[0].sigma;
    assert!((0.7..1.3).contains(&rms), "{case}: {rms}");
    assert!(
        history.variance_reduction > 0.98,
        "{case}: {}",
        history.variance_reduction
    );
}

#[test]
fn forces_of_independent_traces() {
    let sine = |i: i32| (std::f64::consts::PI * f64::from(i) / 400.0).sin();
    let samples: Vec<f64> = (0..=400).map(|i| sine(i).powf(1.5)).collect();
    let pulse = Pulse::sampled(&samples).expect("a pulse");
    for case in ["u2.0", "u0.5", "u0.1", "v2.0", "v0.5", "v0.1"] {
        let (step, exact, trace) = read(case);
        let problem = Problem {
            lead: LEAD,
            ..Problem::new(step, vec![trace], &pulse)
        };
        let found = infer(&problem).expect("a force");
        check_consistency(case, &problem.traces[0], &found);
        let (fit, history) = (&found.fit, &found.history);
        let duration = 25.0 * step;
        println!(
            "{case}: peak {:.4} of {exact:.4}, fit {:.4} {:.4} tc, start {:.4} tc, chi-squared {:.2}",
            history.peak_n.value,
            fit.peak_n.value,
            fit.duration_s.value / duration,
            (fit.start_s.value + step) / duration,
            fit.chi_squared / fit.degrees_of_freedom as f64,
        );
        assert!(
            (history.peak_n.value / exact - 1.0).abs() < 0.02,
            "{case}: {:?}",
            history.peak_n
        );
        assert!(
            (fit.peak_n.value - 1.0).abs() < 0.02,
            "{case}: {:?}",
            fit.peak_n
        );
        assert!(
            (fit.duration_s.value / duration - 1.0).abs() < 0.02,
            "{case}: {:?}",
            fit.duration_s
        );
        assert!(
            (fit.start_s.value + step).abs() < 0.02 * duration,
            "{case}: {:?}",
            fit.start_s
        );
        assert!(
            (0.5..1.5).contains(&(fit.chi_squared / fit.degrees_of_freedom as f64)),
            "{case}"
        );
    }
}
