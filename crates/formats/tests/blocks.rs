//! Blocks with faces: what lies outside is refused, and results say until when they are those of a half-space.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use formats::parse_scene;
use impact::{KernelChoice, Outcome, simulate};
use std::path::Path;

const STRIKER: &str = "\
[striker]
shape = \"ball\"
material = \"bearing-steel\"
diameter_m = 3e-3
velocity_m_s = 0.2
[contact]
tolerance = 1e-3
";

fn run(block: &str, rest: &str) -> Result<Outcome, String> {
    let text = format!("[target]\nmaterial = \"granite\"\n{block}\n{STRIKER}{rest}");
    let scene = parse_scene(&text, Path::new(".")).map_err(|error| error.to_string())?;
    simulate(&scene, &KernelChoice::Direct).map_err(|error| error.to_string())
}

const PROBES: &str = "[[probe]]\nr_m = 0.0\nz_m = 0.02\n[[probe]]\nr_m = 0.03\nz_m = 0.0\n";

#[test]
fn probes_and_sections_outside_the_block_are_refused() {
    for (block, rest, words) in [
        (
            "thickness_m = 0.019",
            PROBES,
            [
                "probe[1].z_m = 0.02 is outside [0, 0.019]",
                "target.thickness_m",
            ],
        ),
        (
            "radius_m = 0.02",
            PROBES,
            [
                "probe[2].r_m = 0.03 is outside [0, 0.02]",
                "target.radius_m",
            ],
        ),
        (
            "radius_m = 0.02",
            "[map]\nr_max_m = 0.03\nz_max_m = 0.01\npoints = [3, 3]\nframes = 2\n",
            ["map.r_max_m = 0.03 is outside [0, 0.02]", "target.radius_m"],
        ),
        (
            "thickness_m = -1.0",
            "",
            ["target.thickness_m = -1", "(0, inf)"],
        ),
    ] {
        let error = run(block, rest).unwrap_err();
        assert!(words.iter().all(|word| error.contains(word)), "{error}");
    }
    assert!(run("thickness_m = 0.02\nradius_m = 0.03", PROBES).is_ok());
}

#[test]
fn results_say_until_when_they_hold() {
    let half_space = run("", PROBES).unwrap();
    assert_eq!(half_space.probes.unwrap().valid_until_s, [f64::INFINITY; 2]);
    let block = run("thickness_m = 0.05", PROBES).unwrap();
    let (fields, disc_m) = (block.probes.unwrap(), 1e-4);
    // granite: E = 55 GPa, nu = 0.25, 2650 kg/m3
    let c1 = (55e9_f64 * 0.75 / (1.25 * 0.5) / 2650.0).sqrt();
    assert!((fields.valid_until_s[0] / (0.08 / c1) - 1.0).abs() < 1e-12);
    let beside = 0.1_f64.hypot(0.03 - disc_m) / c1;
    assert!((fields.valid_until_s[1] / beside - 1.0).abs() < 1e-3);
    // the ball rests for 19 us; the output goes on until the Rayleigh wave has passed
    let warnings = block.warnings.join("\n");
    assert!(
        warnings.contains("reach") && warnings.contains("of 2 probes"),
        "{warnings}"
    );
    let thick = run("thickness_m = 1.0\nradius_m = 1.0", PROBES).unwrap();
    assert!(!thick.warnings.join("\n").contains("echo"));
    // the nearest face is the side
    let contact = run("thickness_m = 1.0\nradius_m = 0.031", PROBES).unwrap();
    let sooner = contact.probes.unwrap().valid_until_s[1];
    assert!(sooner < 0.033 / c1 && sooner > 0.031 / c1);
    assert!(
        contact.warnings.join("\n").contains("radius_m = 3.100e-2"),
        "{:?}",
        contact.warnings
    );
}

/// On a face the echo is the first arrival: the motion of a half-space is none of the block's there.
#[test]
fn places_on_a_face_are_told() {
    let of = |block: &str, rest: &str| {
        let warnings = run(block, rest).unwrap().warnings;
        let told = warnings.into_iter().filter(|w| w.contains("free face"));
        told.collect::<Vec<_>>()
    };
    let below = of("thickness_m = 0.02", PROBES);
    assert!(
        below.len() == 1 && below[0].starts_with("probe 1 is on a free face"),
        "{below:?}"
    );
    let beside = of("thickness_m = 0.03\nradius_m = 0.03", PROBES);
    assert!(
        beside.len() == 1 && beside[0].contains("r_m = radius_m = 0.03 m"),
        "{beside:?}"
    );
    assert!(of("thickness_m = 0.0201\nradius_m = 0.0301", PROBES).is_empty());
    let section = "[map]\nr_max_m = 0.004\nz_max_m = 0.007\npoints = [2, 2]\nframes = 2\n";
    let section = |thickness: &str| of(thickness, section);
    assert_eq!(section("thickness_m = 0.007").len(), 1);
    assert!(section("thickness_m = 0.0071").is_empty());
}

/// A delayed pulse arrives later, and there is no Rayleigh wave below the contact.
#[test]
fn arrivals_count_from_the_force_and_rayleigh_waves_run_along_the_surface() {
    let folder = tempfile::tempdir().unwrap();
    let mut text = "time_s,force_n\n0,0\n1e-4,0\n".to_owned();
    for i in 1..=20 {
        let t = 1e-4 + 1e-6 * f64::from(i);
        let force = (std::f64::consts::PI * f64::from(i) / 20.0).sin().powi(2);
        text += &format!("{t},{}\n", if i == 20 { 0.0 } else { force });
    }
    std::fs::write(folder.path().join("pulse.csv"), text).unwrap();
    let scene = "[target]\nmaterial = \"granite\"\n[force]\nfile = \"pulse.csv\"\n[contact]\ndisc_radius_m = 1e-3\n\
                 [[probe]]\nr_m = 0.0\nz_m = 0.05\n[[probe]]\nr_m = 0.05\nz_m = 0.0\n";
    let scene = parse_scene(scene, folder.path()).unwrap();
    let fields = simulate(&scene, &KernelChoice::Direct).unwrap();
    let time_s = fields.series.time_s;
    let probes = fields.probes.unwrap();
    let c1 = (55e9_f64 * 0.75 / (1.25 * 0.5) / 2650.0).sqrt();
    assert!((probes.arrival_s[0][0] / (1e-4 + 0.05 / c1) - 1.0).abs() < 1e-12);
    assert!(probes.arrival_s[0][2].is_infinite());
    // c_R = 0.9194 c_S at nu = 1/4
    let rayleigh = 1e-4 + 0.049 / (0.919_402 * c1 / 3_f64.sqrt());
    assert!((probes.arrival_s[1][2] / rayleigh - 1.0).abs() < 1e-6);
    for probe in 0..2 {
        let still = time_s.iter().zip(&probes.values[1][probe]);
        let before = still.filter(|(t, _)| **t < probes.arrival_s[probe][0]);
        let most = probes.values[1][probe]
            .iter()
            .fold(0.0_f64, |m, v| m.max(v.abs()));
        assert!(before.fold(0.0_f64, |m, (_, v)| m.max(v.abs())) < 1e-6 * most);
    }
}
