//! Input that does not determine a force is rejected with a reason.

mod common;

use common::{Place, Quantity, noisy, normal, problem};
use fault::Fault;
use inverse::{Gain, Noise, Problem, Pulse, Trace, infer};

const PLACE: Place = Place {
    quantity: Quantity::Displacement,
    distance: 2.0,
    start: 2.1,
};

fn good(pulse: &Pulse) -> Problem<'_> {
    let clean = PLACE.clean(&|t| pulse.at(t - PLACE.start)[0]);
    problem(
        pulse,
        PLACE,
        vec![noisy(&clean, &PLACE.response(), 50.0, 1)],
    )
}

/// The sentence of the error after a change of a good problem, its key checked.
fn rejected(key: &str, change: impl FnOnce(&mut Problem)) -> String {
    let pulse = Pulse::hertz();
    let mut problem = good(&pulse);
    change(&mut problem);
    let error = infer(&problem).expect_err("an error");
    println!("{error}");
    assert_eq!(error.culprit().key.as_deref(), Some(key), "{error}");
    error.to_string()
}

#[test]
fn numbers_and_lengths() {
    assert!(infer(&good(&Pulse::hertz())).is_ok());
    for (key, change) in [
        ("step_s", (|p| p.step_s = 0.0) as fn(&mut Problem)),
        ("step_s", |p| p.step_s = f64::NAN),
        ("oversampling", |p| p.oversampling = 0),
        ("confidence", |p| p.confidence = 1.0),
        ("lambda", |p| p.lambda = Some(-1.0)),
        ("the number of traces", |p| p.traces.clear()),
        ("noise", |p| p.traces[0].noise = Noise::White(0.0)),
        ("gain", |p| p.traces[0].gain = Gain::Known(0.0)),
        ("valid_until_s", |p| p.traces[0].valid_until_s = Some(-1.0)),
        ("the end of window_s", |p| p.window_s = Some([3.0, 2.0])),
        ("the end of window_s", |p| p.window_s = Some([-9.0, -1.0])),
        ("valid_until_s", |p| {
            p.traces[0].valid_until_s = Some(f64::INFINITY);
        }),
        ("the largest value of response 1", |p| {
            p.traces[0].valid_until_s = Some(0.2);
        }),
        ("the number of valid samples of trace 1", |p| {
            p.traces[0].samples.resize(20_000, 0.0);
            p.traces[0].response.resize(80_001, 0.0);
        }),
        ("the number of samples of response 1", |p| {
            p.lead = usize::MAX;
        }),
        ("sample 77 of trace 1", |p| {
            p.traces[0].samples[77] = f64::INFINITY;
        }),
        ("sample 3 of response 1", |p| {
            p.traces[0].response[3] = f64::NAN;
        }),
        ("the number of samples of response 1", |p| {
            p.traces[0].response.truncate(100);
        }),
        ("the largest value of response 1", |p| {
            p.traces[0].response.fill(0.0);
        }),
        ("gain", |p| p.traces[0].gain = Gain::Unknown),
    ] {
        rejected(key, change);
    }
}

#[test]
fn noise_that_cannot_be_found() {
    let said = rejected("the number of quiet samples of trace 1", |p| {
        p.traces[0].noise = Noise::Quiet(0..9);
    });
    assert!(
        said.contains("= 9 is outside [16, 149]") && said.contains("pass the standard deviation"),
        "{said}"
    );
    rejected("the number of quiet samples of trace 1", |p| {
        p.traces[0].noise = Noise::Quiet(0..9999);
    });
    rejected("the noise of the quiet part of trace 1", |p| {
        p.traces[0].samples[..30].fill(0.0);
        p.traces[0].noise = Noise::Quiet(0..30);
    });
    // the wave arrives at sample 80
    let said = rejected("noise", |p| p.traces[0].noise = Noise::Quiet(0..95));
    assert!(said.contains("first wave of the blow arrives"), "{said}");
}

#[test]
fn beginnings_under_load() {
    let offset = |p: &mut Problem| p.traces[0].samples.iter_mut().for_each(|x| *x += 0.02);
    for noise in [None, Some(Noise::Quiet(0..60))] {
        let said = rejected("trace", |p| {
            offset(p);
            p.traces[0].noise = noise.clone().unwrap_or_else(|| p.traces[0].noise.clone());
        });
        assert!(said.contains("begins under load"), "{said}");
    }
    // the first waves of the blow are before the first sample, where the trace happens to be small
    let said = rejected("trace", |p| {
        let Trace { samples, .. } = &mut p.traces[0];
        samples.drain(..90);
        samples[0] = 0.0;
    });
    assert!(said.contains("do not show the start"), "{said}");
}

#[test]
fn forces_that_are_not_in_the_traces() {
    let said = rejected("window_s", |p| p.window_s = Some([2.0, 4.9]));
    assert!(said.contains("valid until"), "{said}");
    // the pulse itself ends after the echo
    let pulse = Pulse::hertz();
    let place = Place {
        distance: 0.5,
        ..PLACE
    };
    let clean = place.clean(&|t| pulse.at(t - place.start)[0]);
    let mut trace = noisy(&clean, &place.response(), 50.0, 1);
    trace.valid_until_s = Some(3.2);
    let error = infer(&problem(&pulse, place, vec![trace])).expect_err("an error");
    assert!(error.to_string().contains("shows forces until"), "{error}");
}

#[test]
fn noise_alone_and_pulses_in_it() {
    let pulse = Pulse::hertz();
    let clean = PLACE.clean(&|t| pulse.at(t - PLACE.start)[0]);
    let count = |snr: f64| {
        let found = (0..50).map(|seed| {
            let mut trace = noisy(&clean, &PLACE.response(), snr.max(1.0), seed);
            if snr == 0.0 {
                trace.samples = normal(seed, clean.len());
                trace.noise = Noise::White(1.0);
            }
            match infer(&problem(&pulse, PLACE, vec![trace])) {
                Err(error) => {
                    let said = error.to_string();
                    let expected = ["begins under load", "the peak of the best pulse"];
                    assert!(expected.iter().any(|part| said.contains(part)), "{said}");
                    0
                }
                Ok(_) => 1,
            }
        });
        found.sum::<usize>()
    };
    let found = [0.0, 1.0, 2.0, 3.0, 5.0].map(count);
    println!("found of 50 at signal-to-noise 0, 1, 2, 3, 5: {found:?}");
    assert!(
        found[0] == 0 && found[1] == 0 && found[3] > 25 && found[4] == 50,
        "{found:?}"
    );
}

/// What is allowed, however strange, gives numbers.
#[test]
fn strange_input_gives_numbers() {
    let pulse = Pulse::hertz();
    for change in [
        (|p| p.window_s = Some([0.1, 0.9])) as fn(&mut Problem),
        |p| p.window_s = Some([2.3, 2.31]),
        |p| p.window_s = Some([-5.0, 4.7]),
        |p| p.lambda = Some(1e-300),
        |p| p.lambda = Some(1e200),
        |p| p.traces[0].valid_until_s = Some(1e300),
        |p| p.traces[0].noise = Noise::White(1e-9),
        |p| p.traces[0].gain = Gain::Known(1e-12),
        |p| p.traces[0].samples[100] = 1e6,
        |p| {
            let more = p.traces[0].clone();
            p.traces.push(Trace {
                gain: Gain::Unknown,
                ..more
            });
            p.traces[1].samples.fill(0.0);
        },
    ] {
        let mut problem = good(&pulse);
        change(&mut problem);
        match infer(&problem) {
            Err(error) => println!("{error}"),
            Ok(found) => {
                let history = &found.history;
                println!(
                    "{:?} {:?} {:.1e}",
                    found.fit.peak_n, history.peak_n, history.lambda
                );
                let values = history
                    .force_n
                    .iter()
                    .chain(&history.low_n)
                    .chain(&history.high_n);
                let all = values.chain([
                    &history.peak_n.sd,
                    &history.impulse_n_s.sd,
                    &history.chi_squared,
                ]);
                assert!(all.into_iter().all(|x| x.is_finite()));
            }
        }
    }
}
