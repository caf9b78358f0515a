//! A sensor with a face, and a point in a block with attenuation, against a point at the same place, whole scenes:
//! `cargo bench --package hertzlamb-impact --bench sensors`.

#![allow(missing_docs, reason = "criterion's macros make undocumented items")]
#![allow(clippy::unwrap_used, reason = "a bench may panic")]

use contact::{HalfSpace, Material, Settings, Striker};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use halfspace::Attenuation;
use impact::{
    ForceRecord, KernelChoice, Load, Measured, Probe, Quantity, Scene, Sensor, Strike, simulate,
};
use std::f64::consts::PI;
use std::hint::black_box;

/// A ball of 5 mm on aluminium at 1 m/s, and a record of 200 rows over 10 us.
fn loads() -> [(&'static str, Load); 2] {
    let steel = Material::elastic(209e9, 0.3, 7800.0).unwrap();
    let striker = Striker::ball(steel, 2.5e-3).unwrap();
    let time_s: Vec<f64> = (0..=200).map(|i| 5e-8 * f64::from(i)).collect();
    let force = time_s
        .iter()
        .map(|t| (PI * t / 1e-5).sin().max(0.0).powf(1.5));
    let record = ForceRecord::new(time_s.clone(), force.collect()).unwrap();
    let velocity_m_s = 1.0;
    [
        (
            "ball",
            Load::Strike(Strike {
                striker,
                velocity_m_s,
            }),
        ),
        ("record", Load::Record(record)),
    ]
}

fn scene(load: &Load, tolerance: f64) -> Scene {
    let disc_radius_m = matches!(load, Load::Record(_)).then_some(1e-4);
    Scene {
        target: HalfSpace::new(Material::elastic(70e9, 0.33, 2700.0).unwrap()).unwrap(),
        load: load.clone(),
        settings: Settings {
            tolerance,
            disc_radius_m,
            ..Settings::default()
        },
        quantities: vec![],
        peaks: false,
        low_pass_hz: None,
        duration_s: None,
        probes: vec![],
        sensors: vec![],
        section: None,
    }
}

fn faces(c: &mut Criterion) {
    let mut group = c.benchmark_group("a sensor and its point");
    group.sample_size(10);
    let (r_m, z_m) = (0.02, 0.0);
    for (name, load) in loads() {
        for (measured, quantity) in [
            (Measured::DisplacementZ, None),
            (Measured::VelocityZ, Some(Quantity::VelocityZ)),
        ] {
            for tolerance in [1e-3, 1e-4] {
                let mut point = scene(&load, tolerance);
                point.probes = vec![Probe { r_m, z_m }];
                point.quantities = quantity.into_iter().collect();
                let mut damped = point.clone();
                damped.target.attenuation = Some(Attenuation::new(50.0, 1e6).unwrap());
                let mut sensor = scene(&load, tolerance);
                sensor.sensors = vec![Sensor {
                    r_m,
                    z_m,
                    face_radius_m: 3e-3,
                    measured,
                    response: None,
                }];
                let what = format!("{name} {measured:?} {tolerance:e}");
                for (kind, scene) in [("point", point), ("damped", damped), ("sensor", sensor)] {
                    group.bench_function(BenchmarkId::new(kind, &what), |b| {
                        b.iter(|| black_box(simulate(&scene, &KernelChoice::Direct).unwrap()));
                    });
                }
            }
        }
    }
    group.finish();
}

criterion_group!(benches, faces);
criterion_main!(benches);
