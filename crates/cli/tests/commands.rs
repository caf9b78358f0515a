//! The program from outside: exit codes, one sentence a refusal, nothing written over.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use std::path::Path;
use std::process::{Command, Output, Stdio};

const SCENE: &str = "\
[target]
material = \"steel\"
[striker]
material = \"copper\"
mass_kg = 0.0122
tip_radius_m = 0.004
velocity_m_s = 100.0
[contact]
disc_radius_m = 0.004
model = \"wave\"
";

fn hertzlamb(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_hertzlamb"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .unwrap()
}

fn folder_with(scene: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("scene.toml"), scene).unwrap();
    folder
}

fn refused(folder: &Path, arguments: &[&str], code: i32, parts: &[&str]) {
    let done = hertzlamb(folder, arguments);
    let message = String::from_utf8(done.stderr).unwrap();
    assert_eq!(done.status.code(), Some(code), "{arguments:?}: {message}");
    assert!(done.stdout.is_empty(), "{arguments:?}");
    assert_eq!(message.trim().lines().count(), 1, "{message}");
    for part in parts {
        assert!(message.contains(part), "{arguments:?}: {message}");
    }
}

#[test]
fn an_impact_prints_one_json_object() {
    let folder = folder_with(SCENE);
    let done = hertzlamb(
        folder.path(),
        &["impact", "scene.toml", "--json", "-o", "out.h5"],
    );
    assert_eq!(done.status.code(), Some(0));
    let text = String::from_utf8(done.stdout).unwrap();
    assert_eq!(text.trim().lines().count(), 1);
    let object: serde_json::Value = serde_json::from_str(&text).unwrap();
    for key in "model scheme static_share deflection kernel steps step_s peak_force_n peak_force_time_s contact_time_s \
        rebound_velocity_m_s restitution peak_displacement_m peak_deflection_m impulse_n_s radiated_energy_j \
        energy_residual relative_error_estimate wall_s warnings"
        .split_whitespace()
    {
        assert!(!object[key].is_null(), "{key}");
    }
    // golden/impacts.csv, copper rod on steel, table values, full
    let peak = object["peak_force_n"].as_f64().unwrap();
    assert!((peak / 159_053.22 - 1.0).abs() < 1e-4, "{peak}");
    assert!(folder.path().join("out.h5").exists());
}

#[test]
fn refusals_have_exit_code_2() {
    let folder = folder_with(SCENE);
    let here = folder.path();
    let write = |name: &str, text: &str| std::fs::write(here.join(name), text).unwrap();
    write("mass.toml", &SCENE.replace("0.0122", "-1"));
    write(
        "step.toml",
        &SCENE.replace("model = \"wave\"", "model = \"wave\"\nstep_s = 1.0"),
    );
    write("broken.toml", "[target");
    write("broken.h5", "not a table");
    write("precious.h5", "precious");
    let cases: [(&[&str], &[&str]); 9] = [
        (&["impact", "none.toml"], &["none.toml"]),
        (&["impact", "broken.toml"], &["broken.toml", "line 1"]),
        (
            &["impact", "mass.toml", "-o", "out.h5"],
            &["striker.mass_kg = -1", "(0, inf)"],
        ),
        (&["impact", "step.toml", "-o", "out.h5"], &["step_s"]),
        (&["impact", "scene.toml", "--kernel", "table"], &["--table"]),
        (
            &["impact", "scene.toml", "--table", "none.h5"],
            &["none.h5"],
        ),
        (
            &["impact", "scene.toml", "--table", "broken.h5"],
            &["broken.h5"],
        ),
        (
            &["impact", "scene.toml", "-o", "precious.h5"],
            &["precious.h5", "--force"],
        ),
        (&["impact", "scene.toml", "-o", "none/out.h5"], &["none"]),
    ];
    for (arguments, parts) in cases {
        refused(here, arguments, 2, parts);
    }
    assert_eq!(
        std::fs::read(here.join("precious.h5")).unwrap(),
        b"precious"
    );
    assert!(!here.join("out.h5").exists());
    refused(here, &["materials", "unobtainium"], 2, &["unobtainium"]);
    let usage = hertzlamb(here, &["impact", "scene.toml", "--nosuch"]);
    assert_eq!(usage.status.code(), Some(2));
}

#[test]
fn force_replaces_an_existing_file() {
    let folder = folder_with(SCENE);
    let out = folder.path().join("out.h5");
    std::fs::write(&out, "precious").unwrap();
    let done = hertzlamb(
        folder.path(),
        &["impact", "scene.toml", "-o", "out.h5", "--force"],
    );
    assert_eq!(done.status.code(), Some(0));
    assert_eq!(&std::fs::read(&out).unwrap()[..4], b"\x89HDF");
}

#[test]
fn work_that_fails_has_exit_code_1() {
    // a soft target under the dynamic share: no solution exists
    let soft = SCENE
        .replace(
            "material = \"steel\"",
            "youngs_modulus_pa = 1e6\npoisson_ratio = 0.45\ndensity_kg_m3 = 1500",
        )
        .replace(
            "model = \"wave\"",
            "model = \"wave\"\nstatic_share = \"dynamic\"",
        )
        .replace("velocity_m_s = 100", "velocity_m_s = 1");
    let folder = folder_with(&soft);
    refused(
        folder.path(),
        &["impact", "scene.toml", "-o", "out.h5"],
        1,
        &["dynamic static share"],
    );
    assert!(!folder.path().join("out.h5").exists());
}

#[test]
fn every_command_has_help_with_an_example() {
    let folder = folder_with(SCENE);
    for command in [
        "impact",
        "sweep",
        "plot",
        "demo",
        "materials",
        "completions",
    ] {
        let done = hertzlamb(folder.path(), &[command, "--help"]);
        let text = String::from_utf8(done.stdout).unwrap();
        assert_eq!(done.status.code(), Some(0), "{command}");
        assert!(
            text.contains("Example") && text.contains(&format!("hertzlamb {command}")),
            "{text}"
        );
    }
}

#[test]
fn the_library_is_listed_and_searched() {
    let folder = folder_with(SCENE);
    let done = hertzlamb(folder.path(), &["materials", "--json"]);
    let rows: serde_json::Value = serde_json::from_slice(&done.stdout).unwrap();
    assert!(rows.as_array().unwrap().len() >= 40);
    let done = hertzlamb(folder.path(), &["materials", "granite"]);
    assert!(String::from_utf8(done.stdout).unwrap().contains("2650"));
    let done = hertzlamb(folder.path(), &["completions", "bash"]);
    assert!(
        String::from_utf8(done.stdout)
            .unwrap()
            .contains("hertzlamb")
    );
}

#[test]
fn the_scenes_of_the_project_run() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    for name in ["copper-on-steel", "ball-drop", "prescribed-force"] {
        let done = hertzlamb(&root, &["impact", &format!("{name}.toml"), "--json"]);
        assert_eq!(
            done.status.code(),
            Some(0),
            "{name}: {}",
            String::from_utf8_lossy(&done.stderr)
        );
    }
}

#[test]
fn a_sweep_writes_its_rows_and_refuses_what_is_wrong() {
    let folder = folder_with(&SCENE.replace("model = \"wave\"", "model = \"auto\""));
    let here = folder.path();
    let write = |name: &str, text: &str| std::fs::write(here.join(name), text).unwrap();
    write(
        "sweep.toml",
        "scene = \"scene.toml\"\n[product.striker]\nmass_kg = [0.01, 0.02]\n[list.striker]\nvelocity_m_s = [1.0, 10.0, 1e6]\n",
    );
    let done = hertzlamb(
        here,
        &[
            "sweep",
            "sweep.toml",
            "-o",
            "out.h5",
            "--csv",
            "out.csv",
            "--json",
        ],
    );
    let said = String::from_utf8(done.stderr).unwrap();
    assert_eq!(done.status.code(), Some(0), "{said}");
    assert!(
        said.contains("2 of 6 scenes failed") && said.contains("Rayleigh"),
        "{said}"
    );
    let object: serde_json::Value = serde_json::from_slice(&done.stdout).unwrap();
    assert_eq!(
        (object["rows"].as_u64(), object["failed"].as_u64()),
        (Some(6), Some(2))
    );
    let lines = std::fs::read_to_string(here.join("out.csv")).unwrap();
    assert_eq!(lines.lines().count(), 7);
    assert!(!here.join("out.h5.part").exists());
    write(
        "negative.toml",
        "scene = \"scene.toml\"\n[list.striker]\nvelocity_m_s = [1.0, -2.0]\n",
    );
    refused(
        here,
        &["sweep", "negative.toml", "-o", "new.h5"],
        2,
        &["striker.velocity_m_s = -2", "(0, inf)"],
    );
    write(
        "typo.toml",
        "scene = \"scene.toml\"\n[product.striker]\nvelocity = [1.0]\n",
    );
    refused(
        here,
        &["sweep", "typo.toml", "-o", "new.h5"],
        2,
        &["typo.toml", "striker.velocity"],
    );
    refused(
        here,
        &["sweep", "sweep.toml", "-o", "out.h5"],
        2,
        &["out.h5", "--force"],
    );
    refused(
        here,
        &["sweep", "none.toml", "-o", "new.h5"],
        2,
        &["none.toml"],
    );
    assert!(!here.join("new.h5").exists());
}

#[test]
fn a_scene_comes_from_standard_input_and_is_said_back() {
    use std::io::Write;
    let mut child = Command::new(env!("CARGO_BIN_EXE_hertzlamb"))
        .args(["impact", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let scene = "[target]\nmaterial = \"granite\"\n[striker]\nshape = \"ball\"\nmaterial = \"steel\"\n\
        diameter_m = 0.003\ndrop_height_m = 0.2\n";
    child
        .stdin
        .take()
        .unwrap()
        .write_all(scene.as_bytes())
        .unwrap();
    let done = child.wait_with_output().unwrap();
    let text = String::from_utf8(done.stdout).unwrap();
    let first = text.lines().next().unwrap();
    assert!(
        done.status.success()
            && first.starts_with(
                "impact         steel ball of 3 mm, 110.7 mg, at 1.981 m/s, on granite: E "
            ),
        "{first}"
    );
}

#[test]
fn errors_are_json_where_results_would_be() {
    let folder = tempfile::tempdir().unwrap();
    let error = |line: &[&str], code: i32| -> serde_json::Value {
        let done = hertzlamb(folder.path(), line);
        assert_eq!(done.status.code(), Some(code));
        assert!(done.stdout.is_empty());
        let object: serde_json::Value = serde_json::from_slice(&done.stderr).unwrap();
        object["error"].clone()
    };
    let wrong = SCENE.replacen("mass_kg = ", "mass_kg = -", 1);
    std::fs::write(folder.path().join("wrong.toml"), wrong).unwrap();
    let found = error(&["impact", "wrong.toml", "--json"], 2);
    assert_eq!(found["class"], "scene");
    assert_eq!(found["key"], "striker.mass_kg");
    assert_eq!(found["range"], "(0, inf)");
    assert_eq!(found["file"], "wrong.toml");
    assert!(found["value"].as_f64().unwrap() < 0.0, "{found}");
    assert!(
        found["message"]
            .as_str()
            .unwrap()
            .starts_with("wrong.toml: striker.mass_kg = -"),
        "{found}"
    );
    let found = error(&["impact", "none.toml", "--jsn", "--json"], 2);
    assert!(
        found["message"].as_str().unwrap().contains("--jsn"),
        "{found}"
    );
}
