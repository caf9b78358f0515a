use super::{
    DeHoog, ExtendedWeights, Framework, Window, cme, crump, durbin, euler, stehfest,
    stehfest_extended, talbot,
};
use num_complex::Complex64;

/// 1 - e^{-t} cos 2t.
fn smooth(s: Complex64) -> Complex64 {
    s.inv() - (s + 1.0) / ((s + 1.0) * (s + 1.0) + 4.0)
}

fn smooth_at(t: f64) -> f64 {
    1.0 - (-t).exp() * (2.0 * t).cos()
}

const TIMES: [f64; 5] = [0.3, 0.9, 1.7, 3.1, 4.9];

fn worst(rule: &Framework) -> f64 {
    TIMES.iter().fold(0.0, |most: f64, &t| {
        most.max((rule.invert(t, |s| [smooth(s)])[0] - smooth_at(t)).abs())
    })
}

#[test]
fn a_smooth_function_is_inverted_to_the_accuracy_of_each_method() {
    for (name, rule, expected) in [
        ("talbot", talbot(24), 1e-9),
        ("euler", euler(16), 1e-8),
        ("stehfest", stehfest(14), 2e-2),
        ("cme", cme(50), 1e-3),
    ] {
        let error = worst(&rule);
        assert!(error < expected, "{name}: {error:e}");
    }
}

#[test]
fn more_terms_are_better() {
    for (name, coarse, fine) in [
        ("talbot", talbot(8), talbot(20)),
        ("euler", euler(6), euler(12)),
        ("stehfest", stehfest(6), stehfest(14)),
        ("cme", cme(10), cme(40)),
    ] {
        assert!(worst(&fine) < 0.3 * worst(&coarse), "{name}");
    }
}

#[test]
fn series_share_their_samples() {
    let window = Window::new(5.0, 1e-10, 81);
    let samples: Vec<Complex64> = (0..window.samples)
        .map(|k| smooth(window.node(k)))
        .collect();
    let long = Window::new(5.0, 1e-6, 4001);
    let many: Vec<Complex64> = (0..long.samples).map(|k| smooth(long.node(k))).collect();
    let fraction = DeHoog::new(&window, &samples);
    for t in TIMES {
        let exact = smooth_at(t);
        assert!((fraction.at(t) - exact).abs() < 1e-8, "{t}");
        assert!((crump(&window, &samples, t) - exact).abs() < 1e-6, "{t}");
        assert!((durbin(&long, &many, t) - exact).abs() < 2e-2, "{t}");
    }
}

#[test]
fn the_cme_kernel_has_unit_mass_and_mean_and_never_overshoots() {
    for order in [5, 20, 50] {
        let rule = cme(order);
        // the step function and the ramp are the moments of the kernel
        let step = rule.invert(1.0, |s| [s.inv()])[0];
        let ramp = rule.invert(1.0, |s| [(s * s).inv()])[0];
        assert!((step - 1.0).abs() < 1e-9 && (ramp - 1.0).abs() < 1e-9);
        for i in 1..60 {
            let t = 0.05 * f64::from(i);
            let late = rule.invert(t, |s| [(-s).exp() / s])[0];
            assert!((-1e-9..=1.0 + 1e-9).contains(&late), "{order} {t} {late}");
        }
    }
}

#[test]
fn doubles_end_at_eighteen_terms_and_double_doubles_do_not() {
    use twofloat::TwoFloat;
    let transform =
        |s: TwoFloat| crate::extended::divide(TwoFloat::from(1.0), (s + 1.0) * (s + 1.0));
    let f = |t: f64| t * (-t).exp();
    let error = |terms: usize| {
        let weights = ExtendedWeights::new(terms);
        TIMES.iter().fold(0.0_f64, |most, &t| {
            most.max((stehfest_extended(&weights, t, transform) - f(t)).abs())
        })
    };
    let double = |terms: usize| {
        let rule = stehfest(terms);
        TIMES.iter().fold(0.0_f64, |most, &t| {
            let value = rule.invert(t, |s| [((s + 1.0) * (s + 1.0)).inv()])[0];
            most.max((value - f(t)).abs())
        })
    };
    assert!(double(26) > 1e-3, "{:e}", double(26));
    assert!(error(26) < 1e-6, "{:e}", error(26));
    assert!(error(26) < 1e-2 * error(14));
}
