//! The echoes of a plate against what must hold for any plate, and against an inversion of the whole plate.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use halfspace::{FIELDS, Field, Kernel, Medium, Plate, Profile, Rays, gauss};

const W: usize = Field::DisplacementZ.index();

fn plate(poisson_ratio: f64, thickness: f64) -> (Kernel, Plate) {
    let medium = Medium::new(poisson_ratio).unwrap();
    let kernel = Kernel::new(&medium, Profile::Hertz, 1e-8).unwrap();
    let plate = Plate::new(&kernel, thickness).unwrap();
    (kernel, plate)
}

/// The step response of a field at a point of a plate.
fn step((kernel, plate): &(Kernel, Plate), field: usize, [r, z]: [f64; 2], t: f64) -> f64 {
    let alone =
        kernel.static_field(r, z).unwrap()[field] + kernel.remainder(r, z, t).unwrap().value[field];
    alone + plate.echoes(r, z, t).unwrap().value[field]
}

/// w under a force sin^4(pi t/T), Laplace-Hankel inversion of the whole plate with a 4 by 4 system for each wave number:
/// Poisson's ratio, H, r, on which face, T, t, and w in P/(mu r0).
const WHOLE: [(f64, f64, f64, bool, f64, f64, f64); 12] = [
    (0.25, 4.0, 0.0, true, 8.0, 9.0, 7.5026346e-02),
    (0.25, 4.0, 0.0, true, 8.0, 13.5, 1.1181633e-02),
    (0.25, 4.0, 0.0, true, 8.0, 20.0, 4.2377676e-02),
    (0.25, 4.0, 0.0, true, 8.0, 26.0, 3.8618539e-02),
    (0.25, 4.0, 3.0, false, 8.0, 9.0, 2.5892777e-02),
    (0.25, 4.0, 3.0, false, 8.0, 13.5, 2.4629052e-02),
    (0.25, 4.0, 3.0, false, 8.0, 20.0, 2.5902630e-02),
    (0.25, 4.0, 3.0, false, 8.0, 26.0, 2.6210270e-02),
    (0.3, 3.0, 2.0, true, 6.0, 9.0, 4.2161703e-02),
    (0.3, 3.0, 2.0, true, 6.0, 13.5, 3.3482046e-02),
    (0.3, 3.0, 2.0, true, 6.0, 20.0, 3.7995610e-02),
    (0.3, 3.0, 2.0, true, 6.0, 26.0, 3.9403683e-02),
];

#[test]
fn echoes_agree_with_an_inversion_of_the_whole_plate() {
    let rule = gauss::rule(20);
    for (poisson_ratio, thickness, r, is_lower, duration, t, whole) in WHOLE {
        let both = plate(poisson_ratio, thickness);
        let place = [r, if is_lower { thickness } else { 0.0 }];
        let rate = |s: f64| {
            let x = std::f64::consts::PI * s / duration;
            4.0 * x.sin().powi(3) * x.cos() * std::f64::consts::PI / duration
        };
        // panels so short that fronts within them matter little
        let parts = 60;
        let width = duration.min(t) / f64::from(parts);
        let part = |i: i32| {
            let from = width * f64::from(i);
            let terms = rule.on(from, from + width);
            terms
                .map(|(s, weight)| weight * rate(s) * step(&both, W, place, t - s))
                .sum::<f64>()
        };
        let found: f64 = (0..parts).map(part).sum();
        // fronts are sharp on the axis, and the inversion interpolates them
        let within = if r == 0.0 { 2e-4 } else { 2e-5 };
        assert!(
            (found - whole).abs() < within * 0.08,
            "{t}: {found} against {whole}"
        );
    }
}

/// The sum over all ways of the waves vanishes before the first of them.
#[test]
fn nothing_comes_before_its_time() {
    let (_, plate) = plate(0.3, 3.0);
    for [r, z] in [[0.0, 0.0], [2.0, 3.0], [5.0, 1.2]] {
        // the first echo: two legs to the upper face, one to the lower, back from the lower inside
        let way = if z == 0.0 { 6.0 } else { 3.0 + (3.0 - z) };
        let first = f64::max(r - 1.0, 0.0).hypot(way);
        let early = plate.echoes(r, z, 0.999_999 * first).unwrap();
        assert_eq!(early.value, [0.0; 6]);
        // continuous displacements: nothing of a group is there at once
        let late = plate.echoes(r, z, 1.000_01 * first).unwrap();
        assert!(late.value[W].abs() < 1e-4, "{late:?}");
    }
}

/// Later groups begin with nothing as well: displacements are continuous through the arrival of each number of legs.
#[test]
fn displacements_are_continuous_through_arrivals() {
    let (_, plate) = plate(0.25, 2.0);
    for legs in 2..=8 {
        let z = if legs % 2 == 0 { 0.0 } else { 2.0 };
        let arrival = 1_f64.hypot(2.0 * f64::from(legs));
        let [before, after] = [-1e-6, 1e-6].map(|d| plate.echoes(2.0, z, arrival + d).unwrap());
        for f in 0..2 {
            assert!(
                (before.value[f] - after.value[f]).abs() < 1e-5,
                "{legs} {f}"
            );
        }
    }
}

/// Both faces are free: no traction on the upper beside the load, none on the lower.
#[test]
fn faces_are_free() {
    let (kernel, plate) = plate(0.2, 1.5);
    for t in [2.0, 4.7, 9.3, 15.0] {
        for field in [Field::StressZz, Field::StressRz] {
            let total = step(
                &(kernel.clone(), plate.clone()),
                field.index(),
                [0.7, 1.5],
                t,
            );
            assert!(total.abs() < 1e-7, "{field:?} at {t}: {total}");
            assert_eq!(plate.echoes(0.7, 0.0, t).unwrap().value[field.index()], 0.0);
        }
    }
}

/// Opposite the load a free face doubles the motion of the first P wave.
#[test]
fn the_lower_face_doubles_the_first_motion() {
    let (kernel, plate) = plate(0.3, 20.0);
    let t = 20.000_1_f64;
    let rest = kernel.static_field(0.0, 20.0).unwrap()[W];
    let alone = rest + kernel.remainder(0.0, 20.0, t).unwrap().value[W];
    let echo = plate.echoes(0.0, 20.0, t).unwrap().value[W];
    assert!((echo / alone - 1.0).abs() < 1e-3, "{echo} {alone}");
}

/// A point just below a face has the fields of the face, whose sum is taken in another way.
#[test]
fn points_inside_tend_to_the_faces() {
    let both = plate(0.3, 2.0);
    for (face, inside) in [(0.0, 1e-7), (2.0, 2.0 - 1e-7)] {
        for t in [5.3, 8.9, 14.2] {
            for field in FIELDS {
                let [a, b] = [face, inside].map(|z| step(&both, field.index(), [1.7, z], t));
                assert!((a - b).abs() < 1e-5, "{field:?} at {face}, {t}: {a} {b}");
            }
        }
    }
}

#[test]
fn what_a_plate_cannot_do_is_rejected() {
    let (kernel, plate) = plate(0.3, 2.0);
    for (found, words) in [
        (plate.echoes(0.0, 2.1, 1.0), "z"),
        (plate.echoes(0.0, 1.0, 32.5), "16 transits"),
        (plate.echoes(-1.0, 1.0, 2.0), "r"),
    ] {
        assert!(found.unwrap_err().to_string().contains(words));
    }
    assert!(Plate::new(&kernel, 0.0).is_err());
    let point = Kernel::new(kernel.medium(), Profile::Point, 1e-6).unwrap();
    assert!(Plate::new(&point, 1.0).is_err());
}

/// A trace has the echoes at any time, with all fronts of twelve transits.
#[test]
fn a_trace_follows_the_echoes() {
    for (thickness, r, depth) in [(4.0, 0.0, 1.0), (4.0, 3.0, 0.0), (20.0, 15.0, 0.3)] {
        let medium = Medium::new(0.25).unwrap();
        let kernel = Kernel::new(&medium, Profile::Hertz, 1e-5).unwrap();
        let plate = Plate::new(&kernel, thickness).unwrap();
        let (z, end) = (depth * thickness, 12.0 * thickness);
        let rise = |length: f64| [(length / thickness).min(1.0); 6];
        let trace = plate.trace_under(r, z, end, ([1e-4; 6], &rise)).unwrap();
        let size = 1.0 + thickness;
        for i in 0..100 {
            let t = end * (f64::from(i) + 0.5) / 100.0;
            let (found, exact) = (trace.at(t), plate.echoes(r, z, t).unwrap().value);
            for f in 0..6 {
                let unit = if f < 2 { size } else { size * size };
                let off = (found[f] - exact[f]).abs() * unit;
                assert!(off < 1e-3, "{:?} at {t}: {off:.1e}", FIELDS[f]);
            }
        }
    }
}

/// Waves by name: straight paths of one kind, a mixed one by its Snell ray, the head wave beyond its angle.
#[test]
fn echoes_arrive_by_name() {
    let plate = Rays {
        thickness: 2.0,
        legs: 4,
        shear: 3.0,
    };
    let of = |r: f64, z: f64, name: &str| {
        let all = plate.arrivals(r, z);
        let found = all.iter().find(|echo| echo.name() == name);
        found.unwrap_or_else(|| panic!("no {name} in {all:?}")).time
    };
    let slow = 3_f64.sqrt();
    assert!((of(0.0, 0.0, "PP") - 4.0).abs() < 1e-12);
    assert!((of(3.0, 0.0, "PP") - 5.0).abs() < 1e-12);
    assert!((of(3.0, 0.0, "SSSS") - slow * 3_f64.hypot(8.0)).abs() < 1e-12);
    assert!((of(0.0, 0.0, "PS") - 2.0 * (1.0 + slow)).abs() < 1e-12);
    // down as S, up as P, at half of the depth
    assert!((of(0.0, 1.0, "SP") - (2.0 * slow + 1.0)).abs() < 1e-12);
    // between those of one kind, and earlier than the path by the middle of the lower face
    let mixed = of(3.0, 0.0, "PS");
    let by_middle = 1.5_f64.hypot(2.0) * (1.0 + slow);
    assert!(of(3.0, 0.0, "PP") < mixed && mixed < by_middle);
    assert!(
        plate
            .arrivals(3.0, 2.0)
            .iter()
            .all(|echo| echo.legs != [1, 0])
    );
}

/// Reciprocity of the faces: the mean over one disc of the motion under another is that over the other under the one, whichever
/// face has the load. Lengths are in radii of the loaded disc, so that the plate has another thickness in the second.
#[test]
fn faces_are_reciprocal() {
    let rule = gauss::rule(24);
    // mean of w under Hertz's pressure on a disc of a radius, in P/(mu r0), opposite a disc of radius 1
    let mean = |thickness: f64, radius: f64, t: f64| {
        let both = plate(0.27, thickness);
        // r^2 = R^2 (1 - c^2), p r dr ~ c^2 dc
        let terms = rule.on(0.0, 1.0).map(|(c, weight)| {
            let r = radius * (1.0 - c * c).sqrt();
            3.0 * weight * c * c * step(&both, W, [r, thickness], t)
        });
        terms.sum::<f64>()
    };
    for t in [6.0, 11.3, 17.9] {
        let [one, other] = [mean(4.0, 1.6, t), mean(4.0 / 1.6, 1.0 / 1.6, t / 1.6) / 1.6];
        assert!((one - other).abs() < 1e-5, "{t}: {one} {other}");
    }
}
