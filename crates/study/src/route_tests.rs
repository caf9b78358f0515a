//! The paper's route against the single integral and the closed form: two ways to the same numbers.

use crate::hankel::Hankel;
use crate::inversion::{DeHoog, Window, euler, talbot};
use crate::single_integral::remainder;
use crate::surface::SurfaceTransform;
use halfspace::{Kernel, Medium, Profile, Six, kausel};
use num_complex::Complex64;

fn distance(a: &Six, b: &Six) -> f64 {
    a.iter()
        .zip(b)
        .fold(0.0, |most, (x, y)| most.max((x - y).abs()))
}

#[test]
fn the_surface_centre_by_inversion_is_the_closed_form() {
    let medium = Medium::new(0.3).unwrap();
    let transform = SurfaceTransform::new(&medium, 13.0);
    for (t, promised) in [
        (0.5, 1e-9),
        (1.0, 1e-4),
        (2.5, 5e-3),
        (4.0, 1e-4),
        (8.0, 1e-6),
    ] {
        let exact = kausel::centre_step(&medium, medium.kappa() * t);
        let euler = euler(16).invert(t, |s| [transform.step(s)])[0];
        assert!((euler - exact).abs() < promised, "t = {t}: {euler} {exact}");
    }
    for (t, promised) in [(2.5, 1e-7), (4.0, 1e-11), (8.0, 1e-11)] {
        let talbot = talbot(24).invert(t, |s| [transform.step(s)])[0];
        assert!((talbot - 1.0).abs() < promised, "t = {t}: {talbot}");
    }
}

#[test]
fn the_interior_by_inversion_is_the_single_integral() {
    let medium = Medium::new(0.3).unwrap();
    let (r, z) = (0.5, 0.6);
    let kernel = Kernel::new(&medium, Profile::Hertz, 1e-13).unwrap();
    let rest = kernel.static_field(r, z).unwrap();
    let hankel = Hankel::new(&medium, r, z, 13.0);
    let window = Window::new(20.0, 1e-11, 161);
    let nodes = hankel.nodes(window.damping, window.node(160).im);
    let samples: Vec<[Complex64; 6]> = (0..161)
        .map(|k| hankel.step(&nodes, window.node(k)))
        .collect();
    for (t, promised) in [(2.0, 3e-5), (5.0, 1e-11), (9.0, 1e-11), (16.0, 1e-11)] {
        let value = kernel.remainder(r, z, t).unwrap().value;
        let exact: Six = std::array::from_fn(|f| value[f] + rest[f]);
        let series: Six = std::array::from_fn(|f| {
            let column: Vec<Complex64> = samples.iter().map(|s| s[f]).collect();
            DeHoog::new(&window, &column).at(t)
        });
        assert!(distance(&series, &exact) < promised, "de Hoog at {t}");
        if t >= 5.0 {
            let continued = talbot(24).invert(t, |s| hankel.continued(s));
            assert!(distance(&continued, &exact) < promised, "Talbot at {t}");
        }
        let (fixed, nodes) = remainder(&medium, [r, z, t], 40);
        assert!(distance(&fixed, &value) < 1e-9, "fixed rule at {t}");
        assert!(nodes < 2500);
    }
}
