//! Scenes that are refused: the message names key, value and what is allowed, in one line.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use contact::Library;
use formats::parse_scene;
use std::path::Path;

const GOOD: &str = "\
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
[[probe]]
r_m = 0.001
z_m = 0.002
";

/// What is replaced in the good scene, by what, and what the message must hold.
const BAD: [(&str, &str, &[&str]); 34] = [
    (
        "mass_kg = 0.0122",
        "mass_kg = -1.0",
        &["striker.mass_kg = -1", "(0, inf)"],
    ),
    (
        "mass_kg = 0.0122",
        "mass_kg = 0",
        &["striker.mass_kg = 0", "(0, inf)"],
    ),
    (
        "mass_kg = 0.0122",
        "mass_kg = nan",
        &["striker.mass_kg = NaN", "(0, inf)"],
    ),
    (
        "mass_kg = 0.0122",
        "mass_kg = inf",
        &["striker.mass_kg = inf", "(0, inf)"],
    ),
    (
        "mass_kg = 0.0122",
        "mass_kg = \"heavy\"",
        &["striker.mass_kg", "\"heavy\"", "a number"],
    ),
    (
        "mass_kg = 0.0122",
        "mass_kg = [1]",
        &["striker.mass_kg", "a number"],
    ),
    ("mass_kg = 0.0122\n", "", &["striker.mass_kg is missing"]),
    (
        "mass_kg = 0.0122",
        "mas_kg = 0.0122",
        &["striker.mas_kg", "did you mean mass_kg?"],
    ),
    (
        "mass_kg = 0.0122",
        "colour = 3",
        &["striker.colour", "known keys: "],
    ),
    (
        "tip_radius_m = 0.004",
        "tip_radius_m = -0.004",
        &["striker.tip_radius_m = -0.004"],
    ),
    (
        "velocity_m_s = 100.0",
        "velocity_m_s = 0.0",
        &["striker.velocity_m_s = 0"],
    ),
    (
        "disc_radius_m = 0.004",
        "disc_radius_m = 0.0",
        &["contact.disc_radius_m = 0"],
    ),
    (
        "model = \"wave\"",
        "model = \"waves\"",
        &[
            "contact.model = \"waves\"",
            "hertz, radiation, quasi_static, quasi_static_radiation, wave, growing, area_dashpot, auto",
        ],
    ),
    (
        "model = \"wave\"",
        "model = \"growing\"",
        &["growing", "disc_radius_m"],
    ),
    (
        "model = \"wave\"",
        "tolerance = 1e-12",
        &["contact.tolerance = 1e-12", "[1e-9, 0.1]"],
    ),
    (
        "model = \"wave\"",
        "step_s = -1e-9",
        &["contact.step_s", "(0, inf)"],
    ),
    (
        "model = \"wave\"",
        "scheme = \"explicit\"\nstatic_share = \"dynamic\"",
        &["explicit", "dynamic"],
    ),
    (
        "model = \"wave\"",
        "scheme = \"explicit\"\nmodel = \"hertz\"",
        &["explicit", "hertz"],
    ),
    (
        "r_m = 0.001",
        "r_m = -0.001",
        &["probe[1].r_m = -0.001", "[0, inf)"],
    ),
    (
        "z_m = 0.002",
        "z_m = inf",
        &["probe[1].z_m = inf", "[0, inf)"],
    ),
    ("z_m = 0.002\n", "", &["probe[1].z_m is missing"]),
    (
        "[[probe]]",
        "[probe]",
        &["probe", "write [[probe]] for [probe]"],
    ),
    ("[target]", "[traget]", &["traget", "did you mean target?"]),
    (
        "material = \"steel\"",
        "material = \"steal\"",
        &["target.material = \"steal\"", "did you mean steel?"],
    ),
    (
        "material = \"steel\"",
        "youngs_modulus_pa = 1e9\ndensity_kg_m3 = 1",
        &["target.poisson_ratio is missing"],
    ),
    (
        "material = \"steel\"",
        "youngs_modulus_pa = 1e9\npoisson_ratio = 0.3",
        &["target.density_kg_m3 is missing"],
    ),
    (
        "material = \"steel\"",
        "material = \"steel\"\npoisson_ratio = 0.5",
        &["target.poisson_ratio = 0.5", "(-1, 0.5)"],
    ),
    (
        "material = \"steel\"",
        "material = \"steel\"\npoisson_ratio = -1.5",
        &["target.poisson_ratio = -1.5"],
    ),
    (
        "material = \"steel\"",
        "material = \"steel\"\nshear_speed_m_s = 3000",
        &["target.longitudinal_speed_m_s is missing"],
    ),
    (
        "material = \"steel\"",
        "material = \"steel\"\nlongitudinal_speed_m_s = 3000\nshear_speed_m_s = 3000",
        &["target.shear_speed_m_s = 3000"],
    ),
    (
        "material = \"steel\"",
        "youngs_modulus_pa = 209e9\npoisson_ratio = 0.3\ndensity_kg_m3 = 7830\nlongitudinal_speed_m_s = 5000\nshear_speed_m_s = 3204",
        &[
            "[target]",
            "209000000000",
            "longitudinal_speed_m_s and shear_speed_m_s",
        ],
    ),
    (
        "[striker]",
        "[force]\nfile = \"none.csv\"\n[striker]",
        &["[striker]", "[force]"],
    ),
    ("[target]", "[target", &["line 1"]),
    (
        "z_m = 0.002",
        "z_m = 0.002\n[output]\nduration_s = 0",
        &["output.duration_s = 0"],
    ),
];

fn refused(text: &str, directory: &Path) -> String {
    let message = parse_scene(text, directory).expect_err(text).to_string();
    assert!(!message.contains('\n'), "{message}");
    message
}

#[test]
fn the_good_scene_is_good() {
    let scene = parse_scene(GOOD, Path::new(".")).unwrap();
    assert_eq!(scene.probes.len(), 1);
}

#[test]
fn every_fault_is_named() {
    for (good, bad, parts) in BAD {
        assert!(GOOD.contains(good), "{good}");
        let message = refused(&GOOD.replacen(good, bad, 1), Path::new("."));
        for part in parts {
            assert!(message.contains(part), "{bad}: {message}");
        }
    }
}

#[test]
fn force_files_are_checked_line_by_line() {
    let folder = tempfile::tempdir().unwrap();
    let scene = "[target]\nmaterial = \"steel\"\n[contact]\ndisc_radius_m = 0.004\n[force]\nfile = \"f.csv\"\n";
    let cases: [(&str, &[&str]); 11] = [
        ("", &["line 1", "empty"]),
        ("time,force\n0,1\n", &["line 1", "time_s,force_n"]),
        ("time_s,force_n\n", &["0 rows"]),
        ("time_s,force_n\n0,1\n", &["1 rows"]),
        (
            "time_s,force_n\n0,1\n0,2\n",
            &["all samples have the time 0 s"],
        ),
        (
            "time_s,force_n\n0,1\n1,2\n1,3\n1,4\n",
            &["line 5", "must ascend", "at most two rows"],
        ),
        ("time_s,force_n\n1,1\n0.5,2\n", &["line 3", "0.5"]),
        ("time_s,force_n\n-1,1\n0.5,2\n", &["line 2", "[0, inf)"]),
        (
            "time_s,force_n\n0,1\n1,nan\n",
            &["line 3", "force_n", "nan"],
        ),
        ("time_s,force_n\n0,1\n1\n", &["line 3", "force_n"]),
        ("time_s,force_n\n0,1\n1,2,3\n", &["line 3", "third field"]),
    ];
    for (text, parts) in cases {
        std::fs::write(folder.path().join("f.csv"), text).unwrap();
        let message = refused(scene, folder.path());
        for part in parts.iter().chain(&["f.csv"]) {
            assert!(message.contains(part), "{text:?}: {message}");
        }
    }
    std::fs::remove_file(folder.path().join("f.csv")).unwrap();
    assert!(refused(scene, folder.path()).contains("f.csv"));
    // what says that it is empty is not waited for
    let of_the_system = scene.replace("f.csv", "/proc/self/status");
    let message = refused(&of_the_system, folder.path());
    assert!(!message.contains("Name:"), "{message}");
    std::fs::write(
        folder.path().join("f.csv"),
        "# why not\ntime_s,force_n\n0,0\n1e-6,5\n",
    )
    .unwrap();
    assert!(parse_scene(scene, folder.path()).is_ok());
    let without = scene.replace("disc_radius_m = 0.004\n", "");
    assert!(refused(&without, folder.path()).contains("contact.disc_radius_m is missing"));
}

/// Times and forces of a record, or why there is none; its scene spelled out is the same.
fn record(text: &str, keys: &str) -> Result<(Vec<f64>, Vec<f64>), String> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("f.csv"), text).unwrap();
    let scene = format!(
        "[target]\nmaterial = \"steel\"\n[contact]\ndisc_radius_m = 0.004\n[force]\nfile = \"f.csv\"\n{keys}"
    );
    let scene = parse_scene(&scene, folder.path()).map_err(|error| error.to_string())?;
    let again = parse_scene(&formats::resolved(&scene), Path::new("."));
    assert_eq!(again.unwrap().load, scene.load);
    match scene.load {
        impact::Load::Record(record) => Ok((record.time_s().to_vec(), record.force_n().to_vec())),
        impact::Load::Strike(_) => Err("a striker".to_owned()),
    }
}

const OSCILLOSCOPE: &str =
    "Model;X\n\"F [kN]\";Time [us];T\n0;-1,0;9\n-1,5;0,5;9\n0,5;2;9\n0;3;9\n";
const NAMED: &str = "columns = [\"Time [us]\", \"F [kN]\"]\n";
const BARE: &str = "0\t0\n1\t5\n2\t0\n";

#[test]
fn records_of_instruments_are_read_by_column_unit_sign_and_instant() {
    let near = |found: (Vec<f64>, Vec<f64>), time_s: &[f64], force_n: &[f64]| {
        for (found, wanted) in [(found.0, time_s), (found.1, force_n)] {
            assert_eq!(found.len(), wanted.len(), "{found:?}");
            for (x, y) in found.iter().zip(wanted) {
                assert!((x - y).abs() <= 1e-12 * y.abs().max(1e-6), "{found:?}");
            }
        }
    };
    let cut = format!("{NAMED}start_s = -0.25e-6\nend_s = 2.5e-6\nsign = -1\n");
    near(
        record(OSCILLOSCOPE, &cut).unwrap(),
        &[0.0, 0.75e-6, 2.25e-6, 2.75e-6],
        &[750.0, 1500.0, -500.0, -250.0],
    );
    let placed = "columns = [1, 2]\nunits = [\"us\", \"lbf\"]\n";
    near(
        record(BARE, placed).unwrap(),
        &[0.0, 1e-6, 2e-6],
        &[0.0, 22.241_108_076_302_5, 0.0],
    );
    let below = "time,force\n(ms),(N)\n\n0,0\n1,5\n2,0\n";
    let units = "columns = [\"time\", \"force\"]\nunits = [\"ms\", \"N\"]\n";
    near(
        record(below, units).unwrap(),
        &[0.0, 1e-3, 2e-3],
        &[0.0, 5.0, 0.0],
    );
    near(
        record("time_s force_n\n0 0\n1 5\n", "").unwrap(),
        &[0.0, 1.0],
        &[0.0, 5.0],
    );
}

#[test]
fn each_refusal_of_a_record_says_the_way_out() {
    let cases = [
        (OSCILLOSCOPE, "", "line 2: the header is"),
        (
            OSCILLOSCOPE,
            "",
            "such as force.columns = [\"F [kN]\", \"Time [us]\"]",
        ),
        (OSCILLOSCOPE, NAMED, "set force.start_s"),
        (BARE, "", "force.columns = [1, 2] with force.units"),
        (BARE, "columns = [1, 2]\n", "has no unit"),
        (
            BARE,
            "columns = [1, 2]\nunits = [\"us\", \"V\"]\n",
            "has the unit \"V\"",
        ),
        (
            BARE,
            "columns = [1, 3]\n",
            "force.columns has 3, but the rows have 2 columns",
        ),
        (
            BARE,
            "columns = [1, 2]\nunits = [\"s\", \"mV\"]\n",
            "set force.sensitivity_v_per_n",
        ),
        (
            "time_s,force_n\n0,1\n1,2\n",
            "sensitivity_v_per_n = 0.1\n",
            "has the unit \"N\", but force.sensitivity_v_per_n applies to a signal",
        ),
        (
            "time_s,force_n\n0,1\n1,2\n",
            "sensitivity_v_per_n = 0.0\n",
            "force.sensitivity_v_per_n = 0 is outside (0, inf)",
        ),
        (
            "time_s,force_n\n0,1\n1,2\n",
            "start_s = -1.0\nonset_s = 1.0\n",
            "force.onset_s = 1 is outside [0, 1), the times of the record",
        ),
        (
            "time_s,force_n\n0,1\n1,2\n3,0\n",
            "onset_s = 0.5\nbaseline_s = 0.75\n",
            "force.baseline_s = 0.75 is outside (0, 0.5], the part of the record before onset_s",
        ),
        (BARE, "columns = [1]\n", "not a pair of words"),
        (
            "time_s,force_n\n0,1\n1,2\n",
            "start_s = 3.0\n",
            "force.start_s = 3 is outside",
        ),
        (
            "time_s,force_n\n0,1\n1,2\n",
            "end_s = -3.0\n",
            "force.end_s = -3 is outside",
        ),
        (
            "time_s,force_n\n0,1\n1,2\n",
            "sign = 2\n",
            "force.sign = 2 is outside {-1, 1}",
        ),
    ];
    for (text, keys, part) in cases {
        let message = record(text, keys).unwrap_err();
        assert!(message.contains(part), "{keys}: {message}");
    }
}

/// A signal in volts, a header below other lines, and two bytes a letter, as instruments and spreadsheets write them.
#[test]
fn signals_and_texts_of_two_bytes_are_read() {
    let signal = "CH1\nTime [ms];U [mV]\n0;0\n1;9\n2;0\n";
    let keys = "columns = [\"Time [ms]\", \"U [mV]\"]\nsensitivity_v_per_n = 0.00225\n";
    let (time_s, force_n) = record(signal, keys).unwrap();
    assert_eq!((time_s[1], force_n[0]), (1e-3, 0.0));
    assert!((force_n[1] - 4.0).abs() < 1e-12, "{force_n:?}");
    let below = record("of the hammer\n\ntime_s,force_n\n0,0\n1,5\n", "").unwrap();
    assert_eq!(below.1, [0.0, 5.0]);
    let folder = tempfile::tempdir().unwrap();
    let scene = "[target]\nmaterial = \"steel\"\n[contact]\ndisc_radius_m = 0.004\n[force]\nfile = \"f.csv\"\n";
    let text = "time_s,force_n\n0,0\n1,5\n";
    for order in [u16::to_le_bytes, u16::to_be_bytes] {
        let units = "\u{feff}".encode_utf16().chain(text.encode_utf16());
        let mut bytes: Vec<u8> = units.flat_map(order).collect();
        std::fs::write(folder.path().join("f.csv"), &bytes).unwrap();
        let found = parse_scene(scene, folder.path()).unwrap();
        assert_eq!(found.record().unwrap().force_n(), [0.0, 5.0]);
        bytes.pop();
        std::fs::write(folder.path().join("f.csv"), &bytes).unwrap();
        assert!(refused(scene, folder.path()).contains("UTF-16"));
    }
}

/// A force record may name any file of whoever runs the program: one that is no table of numbers is not shown.
#[test]
fn no_line_of_a_file_without_numbers_is_shown() {
    for secret in [
        "root:$6$salt$hash:19000:0:99999:7:::\n",
        "key = abc\nsecret, secret\n",
    ] {
        let message = record(secret, "").unwrap_err();
        assert!(message.contains("no row with two numbers"), "{message}");
        let shown = ["root", "hash", "abc", "secret"]
            .iter()
            .any(|part| message.contains(part));
        assert!(!shown, "{message}");
    }
}

#[test]
fn words_say_what_was_meant() {
    let cases = [
        (
            "tip_radius_m = 0.004",
            "tip_radius_mm = 4.0",
            "did you mean tip_radius_m, in m?",
        ),
        (
            "velocity_m_s = 100.0",
            "velocity_m_s = 0,5",
            "numbers need a decimal point, not a comma",
        ),
        (
            "[striker]",
            "[striker]\ntolerance = 1e-4",
            "did you mean contact.tolerance?",
        ),
    ];
    for (good, bad, part) in cases {
        assert!(GOOD.contains(good), "{good}");
        let message = refused(&GOOD.replacen(good, bad, 1), Path::new("."));
        assert!(message.contains(part), "{bad}: {message}");
    }
    let asked = format!("{GOOD}\n[output]\nquantities = [\"vonmises\"]\n");
    let message = refused(&asked, Path::new("."));
    assert!(message.ends_with("did you mean von_mises?"), "{message}");
}

#[test]
fn the_library_is_readable_and_physical() {
    let library = Library::built_in();
    assert!(library.iter().count() >= 40);
    for material in library.iter() {
        assert!(
            !material.source.is_empty() && material.density_kg_m3.is_some(),
            "{}",
            material.name
        );
        assert!(
            (-0.5..0.4999).contains(&material.poisson_ratio),
            "{}",
            material.name
        );
    }
    for group in [
        "metal", "ceramic", "glass", "polymer", "rock", "concrete", "soil",
    ] {
        assert!(library.iter().any(|m| m.group == group), "{group}");
    }
    assert!(library.search("CRC").count() > 5);
    // Table 1 of the paper: c1 = 5994 m/s and c2 = 3204 m/s of steel
    let steel = library.get("steel").unwrap();
    assert!((steel.longitudinal_speed_m_s().unwrap() - 5994.0).abs() < 2.0);
    assert!((steel.shear_speed_m_s().unwrap() - 3204.0).abs() < 2.0);
}

#[test]
fn a_users_library_extends_the_built_in_one() {
    let folder = tempfile::tempdir().unwrap();
    let own = "[mine]\nyoungs_modulus_pa = 1e9\npoisson_ratio = 0.2\ndensity_kg_m3 = 1000\nsource = \"measured\"\n";
    std::fs::write(folder.path().join("own.toml"), own).unwrap();
    let text = GOOD.replace("\"steel\"", "\"mine\"") + "[materials]\nfile = \"own.toml\"\n";
    let scene = parse_scene(&text, folder.path()).unwrap();
    assert_eq!(scene.target.material().youngs_modulus_pa, 1e9);
    std::fs::write(
        folder.path().join("own.toml"),
        own.replace("source = \"measured\"\n", ""),
    )
    .unwrap();
    assert!(refused(&text, folder.path()).contains("mine.source is missing"));
    for name in ["\"\"", "\"a\\u001b[31m\""] {
        std::fs::write(folder.path().join("own.toml"), own.replace("mine", name)).unwrap();
        assert!(refused(&text, folder.path()).contains("the name of a material"));
    }
}
