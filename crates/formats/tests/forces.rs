//! Prescribed forces: jumps, HDF5 files, and files that cannot be used.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use formats::{Existing, parse_scene, write_results};
use impact::{Cause, KernelChoice, Outcome, simulate};
use std::path::Path;

const SCENE: &str = "[target]\nmaterial = \"steel\"\n[contact]\ndisc_radius_m = 0.004\n[force]\nfile = \"FILE\"\n\
    [[probe]]\nr_m = 0.0\nz_m = 0.0\n";

fn with_file(folder: &Path, name: &str) -> Result<Outcome, String> {
    let text = SCENE.replace("FILE", name);
    let scene = parse_scene(&text, folder).map_err(|error| error.to_string())?;
    simulate(&scene, &KernelChoice::Direct).map_err(|error| error.to_string())
}

#[test]
fn a_force_that_jumps_loads_the_surface_with_its_pressure_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let jump = "time_s,force_n\n0,0\n1e-9,1000\n4e-6,1000\n4.001e-6,0\n1e-5,0\n";
    std::fs::write(folder.path().join("jump.csv"), jump).unwrap();
    let found = with_file(folder.path(), "jump.csv").unwrap();
    let fields = found.probes.unwrap();
    assert!(
        fields
            .values
            .iter()
            .flatten()
            .flatten()
            .all(|x| x.is_finite())
    );
    // szz at the surface is minus the pressure, 3/(2 pi) P/r0^2 in the centre
    let pressure = 1.5 / std::f64::consts::PI * 1000.0 / 0.004_f64.powi(2);
    let middle = found.series.time_s.iter().position(|&t| t > 2e-6).unwrap();
    assert!((fields.values[4][0][middle] / -pressure - 1.0).abs() < 1e-3);
    assert!(
        found
            .warnings
            .iter()
            .any(|w| w.contains("the force is approximated to")),
        "{:?}",
        found.warnings
    );
}

#[test]
fn the_results_of_an_impact_drive_another() {
    let folder = tempfile::tempdir().unwrap();
    let strike = "[target]\nmaterial = \"steel\"\n[striker]\nmaterial = \"copper\"\nmass_kg = 0.0122\n\
        tip_radius_m = 0.004\nvelocity_m_s = 100.0\n[contact]\nmodel = \"wave\"\ndisc_radius_m = 0.004\n\
        [[probe]]\nr_m = 0.0\nz_m = 0.0\n";
    let scene = parse_scene(strike, Path::new(".")).unwrap();
    let first = simulate(&scene, &KernelChoice::Direct).unwrap();
    write_results(
        &folder.path().join("first.h5"),
        &scene,
        &first,
        Existing::Keep,
    )
    .unwrap();
    let second = with_file(folder.path(), "first.h5").unwrap();
    let peak = |outcome: &Outcome| {
        let w = &outcome.probes.as_ref().unwrap().values[1][0];
        w.iter().fold(0.0_f64, |most, x| most.max(*x))
    };
    let impulse = |outcome: &Outcome| match &outcome.cause {
        Cause::Contact { results, .. } => results.impulse_n_s,
        Cause::Record(results) => results.impulse_n_s,
    };
    assert!((peak(&second) / peak(&first) - 1.0).abs() < 1e-3);
    assert!((impulse(&second) / impulse(&first) - 1.0).abs() < 1e-3);
}

#[test]
fn unusable_files_are_refused_with_their_name() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::write(here.join("text.h5"), "not HDF5").unwrap();
    std::fs::write(here.join("empty.csv"), "").unwrap();
    std::fs::write(
        here.join("unordered.csv"),
        "time_s,force_n\n0,0\n2e-6,1\n1e-6,2\n",
    )
    .unwrap();
    let file = hdf5::File::create(here.join("short.h5")).unwrap();
    for (name, samples) in [("time", &[0.0, 1.0][..]), ("force", &[1.0][..])] {
        let dataset = file
            .new_dataset::<f64>()
            .shape([samples.len()])
            .create(name)
            .unwrap();
        dataset.write_raw(samples).unwrap();
    }
    file.close().unwrap();
    for (name, part) in [
        ("none.h5", "does not exist"),
        ("text.h5", "not an HDF5 file"),
        ("short.h5", "2 samples"),
        ("empty.csv", "empty"),
        ("unordered.csv", "line 4"),
    ] {
        let message = with_file(here, name).unwrap_err();
        assert!(
            message.contains(name) && message.contains(part),
            "{message}"
        );
    }
}
