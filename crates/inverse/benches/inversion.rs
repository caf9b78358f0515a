//! Time of an inversion: traces of a thousand samples, contacts of 25 to 200 samples.

use criterion::{Criterion, criterion_group, criterion_main};
use inverse::{Gain, Noise, Problem, Pulse, Trace, infer};
use std::hint::black_box;

fn inversions(criterion: &mut Criterion) {
    let pulse = Pulse::hertz();
    for (duration, oversampling) in [(25.0, 4), (100.0, 1), (200.0, 1)] {
        // an oscillation that decays, fifty samples after the force
        let scale = oversampling as f64;
        let response: Vec<f64> = (0..1000 * oversampling)
            .map(|k| k as f64 / scale - 50.0)
            .map(|t| {
                if t < 0.0 {
                    0.0
                } else {
                    (-t / 60.0).exp() * (t / 15.0).sin() / scale
                }
            })
            .collect();
        let start = 200.0;
        let force: Vec<f64> = (0..1000 * oversampling)
            .map(|j| pulse.at((j as f64 / scale - start) / duration)[0])
            .collect();
        let clean = (0..1000).map(|i| {
            (0..=i * oversampling)
                .map(|j| force[j] * response[i * oversampling - j])
                .sum::<f64>()
        });
        let clean: Vec<f64> = clean.collect();
        let sigma = clean.iter().fold(0.0, |a: f64, b| a.max(b.abs())) / 100.0;
        let mut stream = halfspace::random::Stream::new(1);
        let samples = clean
            .iter()
            .map(|x| x + sigma * stream.within(-3.0_f64.sqrt(), 3.0_f64.sqrt()))
            .collect();
        let trace = Trace {
            samples,
            response,
            noise: Noise::Quiet(0..200),
            gain: Gain::Known(1.0),
            valid_until_s: None,
        };
        let problem = Problem {
            oversampling,
            ..Problem::new(1.0, vec![trace], &pulse)
        };
        let found = infer(&problem).expect("a force");
        println!(
            "{} force samples, peak {:.3}, fit {:.3}, chi-squared {:.2}",
            found.history.force_n.len(),
            found.history.peak_n.value,
            found.fit.peak_n.value,
            found.history.chi_squared / found.history.degrees_of_freedom
        );
        criterion.bench_function(&format!("1000 samples, {duration} in a contact"), |b| {
            b.iter(|| infer(black_box(&problem)));
        });
    }
}

criterion_group! {
    name = inversion;
    config = Criterion::default().sample_size(10).measurement_time(std::time::Duration::from_secs(2));
    targets = inversions
}
criterion_main!(inversion);
