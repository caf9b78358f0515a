//! Strikers that are balls and rods, alone and in sweeps, and draws that hang together.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use formats::sweep::{Block, Spec, compute_rows};
use formats::{QUANTITIES, SceneError, parse_scene, resolved};
use impact::{Load, Scene, Strike};
use std::f64::consts::PI;
use std::path::Path;

fn scene(striker: &str) -> Result<Scene, String> {
    let text = format!("[target]\nmaterial = \"granite\"\n[striker]\n{striker}");
    parse_scene(&text, Path::new(".")).map_err(|error| error.to_string())
}

fn strike(striker: &str) -> Strike {
    match scene(striker).unwrap().load {
        Load::Strike(strike) => strike,
        Load::Record(_) => panic!("a striker was given"),
    }
}

fn refused(striker: &str, words: &[&str]) {
    let error = scene(striker).unwrap_err();
    for word in words {
        assert!(error.contains(word), "{error}");
    }
    assert_eq!(error.lines().count(), 1);
}

const BALL: &str = "shape = \"ball\"\nmaterial = \"bearing-steel\"\ndiameter_m = 3e-3\n";
const ROD: &str = "shape = \"rod\"\nmaterial = \"steel\"\nlength_m = 0.1\ndiameter_m = 0.01\n";

#[test]
fn mass_and_tip_follow_from_shape_and_density() {
    let ball = strike(&format!("{BALL}drop_height_m = 0.2\n"));
    let mass_kg = 7800.0 * 4.0 / 3.0 * PI * 1.5e-3_f64.powi(3);
    assert!((ball.striker.mass_kg / mass_kg - 1.0).abs() < 1e-14);
    assert_eq!(ball.striker.tip_radius_m, 1.5e-3);
    assert!((ball.velocity_m_s - (2.0 * 9.80665 * 0.2_f64).sqrt()).abs() < 1e-15);
    // a hemisphere of 5 mm on a cylinder of 95 mm
    let rod = strike(&format!("{ROD}velocity_m_s = 2.0\n")).striker;
    let volume = PI * 0.005_f64.powi(2) * 0.095 + 2.0 / 3.0 * PI * 0.005_f64.powi(3);
    assert!((rod.mass_kg / (7830.0 * volume) - 1.0).abs() < 1e-14);
    assert_eq!((rod.tip_radius_m, rod.length_m), (0.005, Some(0.1)));
    let round = strike(&format!("{ROD}tip_radius_m = 0.05\nvelocity_m_s = 2.0\n")).striker;
    assert!(round.mass_kg > rod.mass_kg && round.tip_radius_m == 0.05);
}

#[test]
fn a_resolved_scene_gives_the_same_scene() {
    for striker in [
        format!("{BALL}drop_height_m = 0.2\n"),
        format!("{ROD}tip_radius_m = 0.05\nvelocity_m_s = 2.0\n"),
        format!("{ROD}velocity_m_s = 2.0\nyield_strength_pa = 0\n"),
        "material = \"copper\"\nmass_kg = 1e-3\ntip_radius_m = 2e-3\nvelocity_m_s = 1.0\n".into(),
    ] {
        let first = scene(&striker).unwrap();
        let text = resolved(&first);
        let again = parse_scene(&text, Path::new(".")).unwrap();
        assert_eq!(first, again, "{text}");
    }
}

#[test]
fn what_follows_cannot_be_given_beside() {
    let fast = "velocity_m_s = 1.0\n";
    refused(
        &format!("{BALL}{fast}mass_kg = 1e-3\n"),
        &["striker.mass_kg", "shape = \"ball\"", "diameter_m"],
    );
    refused(
        &format!("{BALL}{fast}tip_radius_m = 1e-3\n"),
        &["striker.tip_radius_m", "shape = \"ball\""],
    );
    refused(
        &format!("{BALL}{fast}drop_height_m = 1.0\n"),
        &["striker.velocity_m_s", "striker.drop_height_m"],
    );
    refused(
        &format!("{ROD}{fast}tip_radius_m = 0.004\n"),
        &["striker.tip_radius_m = 0.004", "[diameter_m/2, inf)"],
    );
    let short = ROD.replace("length_m = 0.1", "length_m = 0.004");
    refused(
        &format!("{short}{fast}"),
        &["striker.length_m = 0.004", "cap"],
    );
    refused(
        &format!("{}{fast}", BALL.replace("\"ball\"", "\"cube\"")),
        &["striker.shape = \"cube\"", "ball, rod"],
    );
    refused(
        &format!("{}{fast}", BALL.replace("shape = \"ball\"\n", "")),
        &["striker.shape is missing", "diameter_m"],
    );
    // a mass that no number holds is told by what the scene has
    let sized = |body: &str, old: &str, new: &str| format!("{}{fast}", body.replace(old, new));
    refused(
        &sized(BALL, "diameter_m = 3e-3", "diameter_m = 1e-200"),
        &["striker.diameter_m = 1e-200", "[1e-30, 1e30] kg"],
    );
    refused(
        &sized(
            ROD,
            "length_m = 0.1\ndiameter_m = 0.01",
            "length_m = 1e307\ndiameter_m = 10.0",
        ),
        &["striker.length_m = 1e307", "[1e-30, 1e30] kg"],
    );
    refused(
        "shape = \"ball\"\nyoungs_modulus_pa = 2e11\npoisson_ratio = 0.3\ndiameter_m = 1e-3\nvelocity_m_s = 1.0\n",
        &["striker.density_kg_m3 is missing"],
    );
}

fn every_row(spec: &Spec) -> Result<Option<Block>, SceneError> {
    compute_rows(spec, 0, 1, spec.rows(), |_, _| true)
}

fn rows(axes: &str) -> (Spec, Vec<Block>) {
    let text = format!(
        "[scene.target]\nmaterial = \"granite\"\n[scene.contact]\nmodel = \"hertz\"\n[scene.striker]\n{BALL}drop_height_m = 0.2\n{axes}"
    );
    let spec = Spec::from_toml(&text, Path::new(".")).unwrap();
    let done = every_row(&spec);
    (spec, vec![done.unwrap().unwrap()])
}

fn column(blocks: &[Block], name: &str) -> Vec<f64> {
    let place = QUANTITIES.iter().position(|q| q.name == name).unwrap();
    let all = blocks.iter().flat_map(Block::rows);
    all.map(|numbers| numbers[place]).collect()
}

/// Hertz's contact time goes as (m^2/(R v))^(1/5): for balls of one density, as their diameter.
#[test]
fn a_random_diameter_takes_the_mass_along() {
    let (spec, blocks) = rows(
        "[random]\nsamples = 200\n[random.striker]\ndiameter_m = { distribution = \"uniform\", low = 2e-3, high = 4e-3 }\n",
    );
    let values = &spec.axes[0].columns[0].values;
    let diameters: Vec<f64> = (0..200).map(|i| values.number(i).unwrap()).collect();
    let times = column(&blocks, "contact_time_s");
    for (time, diameter) in times.iter().zip(&diameters) {
        let ratio = time / times[0] / (diameter / diameters[0]);
        assert!((ratio - 1.0).abs() < 1e-12, "{ratio}");
    }
}

#[test]
fn densities_heights_and_rods_vary() {
    let (_, blocks) =
        rows("[product.striker]\ndensity_kg_m3 = [1000.0, 2000.0]\ndrop_height_m = [0.1, 0.4]\n");
    let energy = column(&blocks, "initial_energy_j");
    for (row, wanted) in [1.0, 4.0, 2.0, 8.0].into_iter().enumerate() {
        assert!((energy[row] / energy[0] / wanted - 1.0).abs() < 1e-12);
    }
    // words and lengths together; a rod shorter than its cap is a row that fails
    let (_, blocks) = rows("[list.striker]\nshape = [\"rod\", \"rod\"]\nlength_m = [0.1, 1e-4]\n");
    let failures: Vec<&String> = blocks
        .iter()
        .flat_map(|b| &b.failures)
        .map(|f| &f.1)
        .collect();
    assert!(failures.len() == 1 && failures[0].contains("striker.length_m = 0.0001"));
}

#[test]
fn a_key_that_follows_does_not_vary() {
    let text = format!(
        "[scene.target]\nmaterial = \"granite\"\n[scene.striker]\n{BALL}velocity_m_s = 1.0\n[product.striker]\nmass_kg = [1.0, 2.0]\n"
    );
    let spec = Spec::from_toml(&text, Path::new(".")).unwrap();
    let done = every_row(&spec);
    let error = done.unwrap_err().to_string();
    assert!(
        error.contains("striker.mass_kg") && error.contains("shape"),
        "{error}"
    );
}

const CORRELATED: &str = "\
[random]
samples = 20000
[random.striker]
diameter_m = { distribution = \"normal\", mean = 3e-3, deviation = 1e-4 }
drop_height_m = { distribution = \"uniform\", low = 0.1, high = 0.3 }
[random.target]
youngs_modulus_pa = { distribution = \"log_normal\", median = 5e10, deviation = 0.1 }
";

/// Each key keeps its moments; the coefficient is that of values and logarithms, and sqrt(3/pi) of it between a normal and a uniform key.
#[test]
fn draws_hang_together_as_asked() {
    let text = format!(
        "[scene.target]\nmaterial = \"granite\"\n[scene.striker]\n{BALL}drop_height_m = 0.2\n{CORRELATED}\
         [[random.correlation]]\nkeys = [\"striker.diameter_m\", \"target.youngs_modulus_pa\"]\ncoefficient = 0.8\n\
         [[random.correlation]]\nkeys = [\"striker.drop_height_m\", \"striker.diameter_m\"]\ncoefficient = -0.5\n"
    );
    let spec = Spec::from_toml(&text, Path::new(".")).unwrap();
    let draws = |key: &str| -> Vec<f64> {
        let mut columns = spec.axes.iter().flat_map(|axis| &axis.columns);
        let values = &columns.find(|column| column.name() == key).unwrap().values;
        (0..values.count())
            .map(|i| values.number(i).unwrap())
            .collect()
    };
    let diameter = draws("striker.diameter_m");
    let height = draws("striker.drop_height_m");
    let modulus: Vec<f64> = draws("target.youngs_modulus_pa")
        .iter()
        .map(|e| e.ln())
        .collect();
    let moments = |x: &[f64]| {
        let n = x.len() as f64;
        let mean = x.iter().sum::<f64>() / n;
        let square = x.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / n;
        (mean, square.sqrt())
    };
    let correlation = |x: &[f64], y: &[f64]| {
        let ((mx, sx), (my, sy)) = (moments(x), moments(y));
        let products = x.iter().zip(y).map(|(a, b)| (a - mx) * (b - my));
        products.sum::<f64>() / (x.len() as f64 * sx * sy)
    };
    let (mean, deviation) = moments(&diameter);
    assert!((mean / 3e-3 - 1.0).abs() < 1e-3 && (deviation / 1e-4 - 1.0).abs() < 0.02);
    let (mean, deviation) = moments(&height);
    assert!(
        (mean / 0.2 - 1.0).abs() < 5e-3 && (deviation / (0.2 / 12_f64.sqrt()) - 1.0).abs() < 0.02
    );
    assert!((moments(&modulus).1 / 0.1 - 1.0).abs() < 0.02);
    // 20,000 draws: a standard deviation of 0.007 (1 - rho^2)
    assert!((correlation(&diameter, &modulus) - 0.8).abs() < 0.01);
    // between a normal and a uniform key: rho sqrt(3/pi)
    let wanted = -0.5 * (3.0 / PI).sqrt();
    assert!((correlation(&diameter, &height) - wanted).abs() < 0.02);
}

#[test]
fn what_is_no_correlation_is_refused() {
    let refused = |more: &str, words: &[&str]| {
        let text = format!("[scene.target]\nmaterial = \"granite\"\n{CORRELATED}{more}");
        let error = Spec::from_toml(&text, Path::new("."))
            .unwrap_err()
            .to_string();
        assert!(words.iter().all(|word| error.contains(word)), "{error}");
    };
    let pair = |a: &str, b: &str, c: f64| {
        format!("[[random.correlation]]\nkeys = [\"{a}\", \"{b}\"]\ncoefficient = {c:?}\n")
    };
    let (d, h, e) = (
        "striker.diameter_m",
        "striker.drop_height_m",
        "target.youngs_modulus_pa",
    );
    refused(&pair(d, h, 1.0), &["coefficient = 1", "(-1, 1)"]);
    refused(&pair(d, "striker.mass_kg", 0.5), &["striker.mass_kg", d]);
    refused(&pair(d, d, 0.5), &["two different keys"]);
    let all = pair(d, h, 0.9) + &pair(d, e, 0.9) + &pair(h, e, -0.9);
    refused(&all, &["not positive definite"]);
}
