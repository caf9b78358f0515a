//! Inputs of particle codes: their numbers are those of the bodies, computed here from the scene alone.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use serde_json::Value;
use std::f64::consts::PI;
use std::path::Path;
use std::process::{Command, Output};

/// A ball of 10 mm on the half-space for which Miller and Pursey's J is known to eight digits.
const SCENE: &str = "\
[target]
youngs_modulus_pa = 7e10
poisson_ratio = 0.25
density_kg_m3 = 2500
yield_strength_pa = 2e8
[striker]
shape = \"ball\"
youngs_modulus_pa = 2.1e11
poisson_ratio = 0.3
density_kg_m3 = 7800
diameter_m = 0.01
velocity_m_s = 1.0
[contact]
loss_tolerance = 1e-6
";
const J: f64 = 0.148_133_88;
const MODULUS: f64 = 1.0 / (0.9375 / 7e10 + 0.91 / 2.1e11);

fn export(scene: &str, arguments: &[&str]) -> (Output, String) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("scene.toml"), scene).unwrap();
    let done = Command::new(env!("CARGO_BIN_EXE_hertzlamb"))
        .current_dir(folder.path())
        .args(["export", arguments[0], "scene.toml", "-o", "out.csv"])
        .args(&arguments[1..])
        .output()
        .unwrap();
    let text = std::fs::read_to_string(folder.path().join("out.csv"));
    (done, text.unwrap_or_default())
}

fn written(scene: &str, arguments: &[&str]) -> String {
    let (done, text) = export(scene, arguments);
    assert!(done.status.success(), "{done:?}");
    text
}

/// The number behind a name, in the form of LAMMPS or of Python.
fn number(text: &str, name: &str) -> f64 {
    let found = text.lines().find_map(|line| {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words.as_slice() {
            ["variable", word, "equal", value, ..] if *word == name => value.parse().ok(),
            [word, "=", value, ..] if *word == name => value.parse().ok(),
            _ => None,
        }
    });
    found.unwrap_or_else(|| panic!("{name} in {text}"))
}

/// E*, lag and ratio of damping of two materials in a script for YADE.
fn law(text: &str, one: &str, two: &str) -> [f64; 3] {
    let begin = format!("(\"{one}\", \"{two}\"): (");
    let (_, rest) = text.split_once(&begin).unwrap();
    let (numbers, _) = rest.split_once(')').unwrap();
    let numbers: Vec<f64> = numbers
        .split(", ")
        .map(|number| number.parse().unwrap())
        .collect();
    numbers.try_into().unwrap()
}

/// What a command prints of a scene as JSON.
fn told(scene: &str, arguments: &[&str]) -> Value {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("scene.toml"), scene).unwrap();
    let done = Command::new(env!("CARGO_BIN_EXE_hertzlamb"))
        .current_dir(folder.path())
        .args(arguments)
        .args(["scene.toml", "--json"])
        .output()
        .unwrap();
    assert!(done.status.success(), "{done:?}");
    serde_json::from_slice(&done.stdout).unwrap()
}

/// A column of a table.
fn column(text: &str, name: &str) -> Vec<f64> {
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let mut names = lines.next().unwrap().split(',');
    let place = names.position(|found| found == name).unwrap();
    let value = |line: &str| line.split(',').nth(place).unwrap().parse().unwrap();
    lines.map(value).collect()
}

fn close(found: f64, wanted: f64, error: f64) {
    assert!((found / wanted - 1.0).abs() < error, "{found} {wanted}");
}

fn mass(radius: f64, density: f64) -> f64 {
    4.0 / 3.0 * PI * radius.powi(3) * density
}

/// Loss of a ball on Hertz's spring with the dashpot 4 C E*^2 R d, followed here.
fn loss_of(modulus: f64, lag: f64, velocity: f64) -> f64 {
    let (radius, mass) = (0.005_f64, mass(0.005, 7800.0));
    let force = |d: f64, v: f64| {
        let d = d.max(0.0);
        let hertz = 4.0 / 3.0 * modulus * radius.sqrt() * d.powf(1.5);
        (hertz + 4.0 * lag * modulus * modulus * radius * d * v).max(0.0)
    };
    let (mut d, mut v, step) = (0.0, velocity, 1e-8);
    while d >= 0.0 {
        // velocity Verlet with the middle of the step
        let half = v - 0.5 * step * force(d, v) / mass;
        d += step * half;
        v = half - 0.5 * step * force(d, half) / mass;
    }
    1.0 - (v / velocity).powi(2)
}

#[test]
fn lammps_and_yade_are_given_the_law_of_the_bodies() {
    let (lammps, yade) = (written(SCENE, &["lammps"]), written(SCENE, &["yade"]));
    let shear = 7e10 / 2.5;
    let lag = J / (shear * (shear / 2500.0_f64).sqrt());
    let [modulus, delay, beta] = law(&yade, "striker", "target");
    for (text, found) in [
        (&lammps, [number(&lammps, "ES"), number(&lammps, "C")]),
        (&yade, [modulus, delay]),
    ] {
        close(found[0], MODULUS, 1e-14);
        close(found[1], lag, 1e-7);
        assert!(text.contains("below 1e-3 at velocities under"), "{text}");
    }
    close(number(&lammps, "R1"), 0.005, 1e-15);
    close(number(&lammps, "M1"), mass(0.005, 7800.0), 1e-14);
    assert_eq!(beta, 0.0);
    let loss = loss_of(MODULUS, lag, 1.0);
    close(1.0 - number(&lammps, "E0").powi(2), loss, 1e-3);
    assert!(lammps.contains("fix         block all addforce 0 0 v_fz"));
    // no waves, no dashpot
    let hertz = format!("{SCENE}model = \"hertz\"\n");
    assert_eq!(number(&written(&hertz, &["lammps"]), "C"), 0.0);
    let yade = written(&hertz, &["yade"]);
    assert_eq!(law(&yade, "striker", "target")[1..], [0.0, 0.0]);
}

#[test]
fn a_ball_on_a_ball_is_the_reduced_contact_without_waves() {
    let text = written(SCENE, &["yade", "--target-diameter", "0.006"]);
    let (one, two) = (mass(0.005, 7800.0), mass(0.003, 2500.0));
    let elastic = told(
        SCENE,
        &["export", "yade", "-o", "o.py", "--target-diameter", "0.006"],
    );
    let (reduced, mass) = (0.005 * 0.003 / 0.008, one * two / (one + two));
    let stiffness = 4.0 / 3.0 * MODULUS * f64::sqrt(reduced);
    let peak = stiffness.powf(0.4) * (1.25 * mass).powf(0.6);
    close(elastic["peak_force_n"].as_f64().unwrap(), peak, 1e-9);
    close(elastic["law"]["peak_force_n"].as_f64().unwrap(), peak, 1e-6);
    assert!(text.contains("= 1.875 mm and m = "), "{text}");
    let balls = format!("BALLS = [[0.005, {one:?}], [0.003, ");
    assert!(text.contains(&balls[..30]), "{text}");
    assert_eq!(law(&text, "striker", "target")[1..], [0.0, 0.0]);
    assert!(text.contains("# waves: echoes cross the target"), "{text}");
    let text = written(SCENE, &["lammps", "--target-diameter", "0.006"]);
    assert_eq!(number(&text, "E0"), 1.0);
    close(number(&text, "M2"), two, 1e-14);
    assert!(!text.contains("fix         block"));
    // one that is large enough is a half-space while the contact lasts
    let text = written(SCENE, &["yade", "--target-diameter", "10"]);
    assert!(text.contains("radiates like a half-space"), "{text}");
    assert!(law(&text, "striker", "target")[1] > 0.0);
    // which LAMMPS has at one velocity alone
    let text = written(SCENE, &["lammps", "--target-diameter", "10"]);
    assert!(number(&text, "E0") < 0.999, "{text}");
    assert!(text.contains("with the restitution of the contact with waves"));
}

#[test]
fn a_contact_that_flows_has_the_restitution_of_its_velocity() {
    let plastic = format!("{SCENE}plasticity = \"thornton\"\nmodel = \"hertz\"\n");
    // Thornton's restitution in closed form, without waves
    let pressure: f64 = 2.8 * 2e8;
    let onset = 1.56 * (pressure.powi(5) / (MODULUS.powi(4) * 7800.0)).sqrt();
    let s = 1.0 / onset;
    let q = (1.2 * s * s - 0.2).sqrt();
    let e = (q / s) * (3.0 / (1.0 + 2.0 * q)).powf(0.25);
    let text = written(&plastic, &["lammps"]);
    // 1.56 has three digits
    close(number(&text, "E0"), e, 1e-3);
    assert!(text.contains("\nfix block all wall/gran granular hertz"));
    assert!(text.contains("its loss is accurate to 10 % from"));
    let [_, _, beta] = law(&written(&plastic, &["yade"]), "striker", "target");
    // what Hertz's spring with 2 beta sqrt(m k) makes of it, cut at zero
    let (d_v, found) = (
        |d: f64, v: f64| d.powf(1.5) + 2.0 * beta * (1.5 * d.sqrt()).sqrt() * v,
        0.0,
    );
    let (mut d, mut v, step) = (0.0_f64, 1.0_f64, 1e-5);
    loop {
        let half = v - 0.5 * step * d_v(d, v).max(0.0);
        d += step * half;
        if d <= found {
            break;
        }
        v = half - 0.5 * step * d_v(d, half).max(0.0);
    }
    close(-v, e, 1e-3);
}

#[test]
fn a_table_has_both_laws_at_every_velocity() {
    let plastic = format!("{SCENE}plasticity = \"thornton\"\n");
    let text = written(
        &plastic,
        &["table", "--velocities", "0.001,10", "--rows", "5"],
    );
    let lines: Vec<&str> = text.lines().filter(|line| !line.starts_with('#')).collect();
    let names: Vec<&str> = lines[0].split(',').collect();
    assert_eq!((lines.len(), names.len()), (6, 11));
    let column = |name: &str| column(&text, name);
    let velocities = column("velocity_m_s");
    assert_eq!([velocities[0], velocities[4]], [0.001, 10.0]);
    let (elastic, plastic) = (column("elastic_loss"), column("plastic_loss"));
    // below yield to the last bit
    assert_eq!(elastic[0], plastic[0]);
    assert!(plastic[4] > 10.0 * elastic[4]);
    let shear = 7e10 / 2.5;
    let lag = J / (shear * (shear / 2500.0_f64).sqrt());
    for (v, loss) in velocities.iter().zip(&elastic) {
        close(*loss, loss_of(MODULUS, lag, *v), 2e-3);
    }
    // the power law of the header is the first order, T49
    let law = text
        .lines()
        .find(|line| line.starts_with("# elastic loss"))
        .unwrap();
    let factor: f64 = law.split_whitespace().nth(7).unwrap().parse().unwrap();
    let stiffness: f64 = 4.0 / 3.0 * MODULUS * 0.005_f64.sqrt();
    let wanted = 3.805_839_78 * lag * stiffness.powf(1.2) * mass(0.005, 7800.0).powf(-0.2);
    close(factor, wanted, 1e-6);
    for (name, of) in [
        ("elastic_restitution", &elastic),
        ("plastic_restitution", &plastic),
    ] {
        for (e, loss) in column(name).iter().zip(of) {
            close(e * e, 1.0 - loss, 1e-7);
        }
    }
    let alone = written(SCENE, &["table", "--rows", "2"]);
    assert!(
        !alone.contains("plastic_loss") && alone.contains("\n0.01,"),
        "{alone}"
    );
}

/// Two balls of the striker's material of half the radius and mass, without waves.
fn alike(plasticity: &str, striker: &str) -> f64 {
    let (radius, mass) = (0.0025, 0.5 * mass(0.005, 7800.0));
    let body = format!("youngs_modulus_pa = 2.1e11\npoisson_ratio = 0.3\n{striker}");
    let scene = format!(
        "[target]\n{body}density_kg_m3 = 7800\n[striker]\n{body}mass_kg = {mass:?}\ntip_radius_m = {radius:?}\nvelocity_m_s = 1.0\n[contact]\nmodel = \"hertz\"\n{plasticity}"
    );
    told(&scene, &["impact"])["restitution"].as_f64().unwrap()
}

#[test]
fn two_balls_of_one_material_have_its_own_law() {
    let (one, two) = (0.5 * 2.1e11 / 0.91, 0.5 * 7e10 / 0.9375);
    let text = written(SCENE, &["lammps"]);
    close(number(&text, "ES1"), one, 1e-14);
    assert_eq!(number(&text, "E01"), 1.0);
    assert!(text.contains("pair_coeff  1 1 hertz $(4/3*v_ES1) ${E01} "));
    let text = written(SCENE, &["lammps", "--target-diameter", "0.25"]);
    close(number(&text, "ES2"), two, 1e-14);
    for line in [
        "1 2 hertz $(4/3*v_ES) ${E0} ",
        "2 2 hertz $(4/3*v_ES2) ${E02} ",
    ] {
        assert!(text.contains(line), "{text}");
    }
    // both balls are in the box
    assert!(text.contains("variable    L equal 4*(v_R1+v_R2)"), "{text}");
    let text = written(SCENE, &["yade", "--target-diameter", "0.25"]);
    close(law(&text, "striker", "striker")[0], one, 1e-14);
    close(law(&text, "target", "target")[0], two, 1e-14);
    assert_eq!(law(&text, "striker", "striker")[1..], [0.0, 0.0]);
}

#[test]
fn two_balls_that_yield_have_the_strength_of_their_material() {
    let strong = SCENE.replace("[contact]", "yield_strength_pa = 3e8\n[contact]");
    let law = "plasticity = \"thornton\"\n";
    let text = written(&format!("{strong}{law}"), &["lammps"]);
    let restitution = alike(law, "yield_strength_pa = 3e8\n");
    assert!(restitution < 0.9, "{restitution}");
    close(number(&text, "E01"), restitution, 1e-9);
    // a pressure that is given is that of the softer body
    let given = format!("{law}yield_pressure_pa = 4e8\n");
    let text = written(&format!("{strong}{given}"), &["lammps"]);
    close(number(&text, "E01"), restitution, 1e-9);
    let softer = strong.replace("3e8", "1e8");
    let text = written(&format!("{softer}{given}"), &["lammps"]);
    let restitution = alike(&given, "yield_strength_pa = 1e8\n");
    close(number(&text, "E01"), restitution, 1e-9);
    // without a strength
    let text = written(&format!("{SCENE}{law}"), &["lammps"]);
    assert_eq!(number(&text, "E01"), 1.0);
    assert!(
        text.contains("elastic, because their plasticity is unknown"),
        "{text}"
    );
}

#[test]
fn the_head_has_the_results_of_the_law_and_of_the_model() {
    let plastic =
        format!("{SCENE}plasticity = \"recovery\"\n").replace("loss_tolerance = 1e-6\n", "");
    let (model, found) = (
        told(&plastic, &["impact"]),
        told(&plastic, &["export", "lammps", "-o", "in.x"]),
    );
    for name in [
        "restitution",
        "contact_time_s",
        "peak_force_n",
        "relative_error_estimate",
    ] {
        assert_eq!(model[name], found[name], "{name}");
    }
    // Hertz's spring with LAMMPS's dashpot of one restitution, over the length sqrt(R) and the mass of the ball
    let e: f64 = found["restitution"].as_f64().unwrap();
    let (mass, stiffness) = (mass(0.005, 7800.0), 4.0 / 3.0 * MODULUS * 0.005_f64.sqrt());
    let eta = -(5.0_f64.sqrt()) * e.ln() / PI.hypot(e.ln());
    let force = |d: f64, v: f64| {
        let root = d.max(0.0).sqrt();
        // LAMMPS: eta sqrt(m k) v with the stiffness k = K sqrt(d)
        stiffness * d.max(0.0) * root + eta * (mass * stiffness * root).sqrt() * v
    };
    let (mut d, mut v, mut time, mut peak, step) = (0.0, 1.0, 0.0, 0.0_f64, 1e-9);
    while d >= 0.0 {
        let half = v - 0.5 * step * force(d, v) / mass;
        d += step * half;
        v = half - 0.5 * step * force(d, half) / mass;
        time += step;
        peak = peak.max(force(d, v));
    }
    close(-v, e, 1e-3);
    let law = &found["law"];
    close(law["contact_time_s"].as_f64().unwrap(), time, 1e-3);
    close(law["peak_force_n"].as_f64().unwrap(), peak, 1e-3);
    assert!(peak > 1.1 * found["peak_force_n"].as_f64().unwrap());
    let notes = found["notes"].to_string();
    for part in [
        "this file at 1 m/s: restitution",
        "with recovery at 1 m/s: restitution",
    ] {
        assert!(notes.contains(part), "{notes}");
    }
}

#[test]
fn one_restitution_serves_up_to_both_ends() {
    for (plasticity, velocity) in [("thornton", 0.3), ("recovery", 2.5), ("jackson_green", 0.7)] {
        let scene = format!("{SCENE}plasticity = \"{plasticity}\"\n")
            .replace("velocity_m_s = 1.0", &format!("velocity_m_s = {velocity}"));
        let found = told(&scene, &["export", "yade", "-o", "o.py"]);
        let loss = found["loss"].as_f64().unwrap();
        let [from, to] = ["from_m_s", "to_m_s"].map(|end| found["law"][end].as_f64().unwrap());
        assert!(from < velocity && to > velocity);
        let off = |from: f64, to: f64| {
            let velocities = format!("{from:?},{to:?}");
            let text = written(
                &scene,
                &["table", "--velocities", &velocities, "--rows", "2"],
            );
            let own = column(&text, "plastic_loss");
            own.iter()
                .map(|own| (loss / own - 1.0).abs())
                .collect::<Vec<f64>>()
        };
        let (ends, beyond) = (off(from, to), off(0.9 * from, 1.1 * to));
        assert!(ends.iter().all(|off| *off <= 0.1), "{plasticity}: {ends:?}");
        assert!(
            beyond.iter().all(|off| *off > 0.1),
            "{plasticity}: {beyond:?}"
        );
    }
}

#[test]
fn echoes_decide_at_each_velocity_whether_a_ball_radiates() {
    // wave speed of the target
    let echo = 2.0 * 0.16 / (7e10 * 0.75 / (1.25 * 0.5 * 2500.0_f64)).sqrt();
    let arguments = [
        "table",
        "--target-diameter",
        "0.16",
        "--velocities",
        "0.01,10",
        "--rows",
        "9",
    ];
    let text = written(SCENE, &arguments);
    let (times, losses) = (
        column(&text, "elastic_contact_time_s"),
        column(&text, "elastic_loss"),
    );
    let outlast = times.iter().filter(|time| **time > echo).count();
    assert!((2..8).contains(&outlast), "{times:?}");
    for (time, loss) in times.iter().zip(&losses) {
        assert_eq!(*time > echo, *loss < 1e-12, "{times:?} {losses:?}");
    }
}

#[test]
fn what_no_particle_code_has_is_refused() {
    let record = "[target]\nmaterial = \"steel\"\n[force]\nfile = \"f.csv\"\n[contact]\ndisc_radius_m = 0.001\n";
    let disc = format!("{SCENE}disc_radius_m = 0.002\n");
    let wave = format!("{SCENE}model = \"wave\"\n");
    let fast = SCENE.replace("velocity_m_s = 1.0", "velocity_m_s = 4000.0");
    // a ball of gum that is pressed in by more than its radius
    let soft = SCENE
        .replace("2.1e11", "1e6")
        .replace("density_kg_m3 = 7800", "density_kg_m3 = 1000")
        .replace("velocity_m_s = 1.0", "velocity_m_s = 90.0");
    let cases: [(&str, &[&str], &str); 11] = [
        (
            &soft,
            &["lammps"],
            "a particle code loses a contact deeper than 5 mm",
        ),
        (&soft, &["yade"], "use a lower striker.velocity_m_s"),
        (&disc, &["lammps"], "disc_radius_m"),
        (&wave, &["yade"], "fixed disc"),
        (&fast, &["table"], "velocity_m_s"),
        (record, &["lammps"], "f.csv"),
        (SCENE, &["lammps", "--rows", "5"], "--rows"),
        (SCENE, &["table", "--velocities", "1"], "FROM,TO"),
        (SCENE, &["table", "--velocities", "2,1"], "0 < FROM < TO"),
        (SCENE, &["table", "--velocities", "nan,1"], "0 < FROM < TO"),
        (SCENE, &["yade", "--target-diameter", "-1"], "(0, inf)"),
    ];
    for (scene, arguments, part) in cases {
        let (done, text) = export(scene, arguments);
        let message = String::from_utf8(done.stderr).unwrap();
        assert_eq!(done.status.code(), Some(2), "{arguments:?}: {message}");
        assert_eq!(message.trim().lines().count(), 1, "{message}");
        assert!(message.contains(part) && text.is_empty(), "{message}");
    }
    // an output is not written over, and is no input
    let folder = tempfile::tempdir().unwrap();
    let own = |name: &str| folder.path().join(name);
    std::fs::write(own("scene.toml"), SCENE).unwrap();
    let run = |to: &Path| {
        let program = env!("CARGO_BIN_EXE_hertzlamb");
        let scene = own("scene.toml");
        let done = Command::new(program)
            .args(["export", "yade"])
            .arg(scene)
            .arg("-o")
            .arg(to)
            .output();
        done.unwrap().status.code()
    };
    assert_eq!(
        [
            run(&own("a.py")),
            run(&own("a.py")),
            run(&own("scene.toml"))
        ],
        [Some(0), Some(2), Some(2)]
    );
}
