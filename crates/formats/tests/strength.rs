//! What bodies bear, in sweeps and in the warnings of single impacts.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use contact::Library;
use formats::sweep::{Block, Spec, compute_rows};
use formats::{QUANTITIES, parse_scene};
use impact::{KernelChoice, simulate};
use std::path::Path;

fn warnings(target: &str, striker: &str) -> String {
    let text = format!("[target]\nmaterial = \"{target}\"\n[striker]\nshape = \"ball\"\n{striker}");
    let scene = parse_scene(&text, Path::new(".")).unwrap();
    simulate(&scene, &KernelChoice::Direct)
        .unwrap()
        .warnings
        .join("\n")
}

#[test]
fn a_sweep_says_which_rows_yield_and_crack() {
    let text = "\
[scene.striker]
shape = \"ball\"
material = \"steel\"
diameter_m = 2e-3
[product.striker]
velocity_m_s = [0.1, 50.0]
[product.target]
material = [\"steel\", \"soda-lime-glass\", \"soil-soft\"]
";
    let spec = Spec::from_toml(text, Path::new(".")).unwrap();
    let done = compute_rows(&spec, 0, 1, spec.rows(), |_, _| true);
    let blocks: Vec<Block> = vec![done.unwrap().unwrap()];
    let rows: Vec<&[f64]> = blocks.iter().flat_map(Block::rows).collect();
    let value = |row: usize, name: &str| {
        let place = QUANTITIES.iter().position(|q| q.name == name).unwrap();
        rows[row][place]
    };
    // the mean pressure that Hertz's law gives goes as the velocity to 2/5
    let growth = value(3, "mean_pressure_pa") / value(0, "mean_pressure_pa");
    assert!((growth / 500_f64.powf(0.4) - 1.0).abs() < 0.02, "{growth}");
    assert!(value(0, "yield_onset") < 1.0 && value(3, "yield_onset") > 5.0);
    assert!(value(0, "cone_crack_onset").is_nan() && value(1, "cone_crack_onset") < 1.0);
    assert!(value(4, "cone_crack_onset") > 1.0);
    for row in [0, 1, 3, 4] {
        let (yields, over) = (value(row, "yield_onset"), value(row, "pressure_over_yield"));
        // both are of the striker, the only one with a yield strength or the same as the target
        assert!((over / yields - 2.0 / 3.0 / contact::largest_mises(0.3)).abs() < 1e-12);
        let tensile =
            value(row, "pressure_over_tensile") * if row % 3 == 0 { 1200e6 } else { 45e6 };
        assert!((tensile / value(row, "mean_pressure_pa") - 1.0).abs() < 1e-12);
    }
}

#[test]
fn balls_are_warned_about_when_something_gives_way_and_not_before() {
    let ball = "material = \"bearing-steel\"\ndiameter_m = 3e-3\n";
    // a fall of 2 mm on glass, of 0.2 m on granite: people do that with sensors all day
    assert_eq!(
        warnings("soda-lime-glass", &format!("{ball}drop_height_m = 2e-3\n")),
        ""
    );
    assert_eq!(
        warnings("granite", &format!("{ball}velocity_m_s = 0.5\n")),
        ""
    );
    let crack = warnings("soda-lime-glass", &format!("{ball}velocity_m_s = 5.0\n"));
    assert!(
        crack.contains("cone crack in the target") && !crack.contains("strength of the target"),
        "{crack}"
    );
    let dent = warnings("copper", &format!("{ball}velocity_m_s = 1.0\n"));
    assert!(
        dent.contains("yield strength of the target, 5.7000e7 Pa"),
        "{dent}"
    );
}

/// Everything but soils has a strength, with a source that speaks of it.
#[test]
fn built_in_materials_have_strengths() {
    for material in Library::built_in().iter() {
        let strengths = [
            material.yield_strength_pa,
            material.tensile_strength_pa,
            material.fracture_toughness_pa_sqrt_m,
        ];
        let known = strengths.iter().any(Option::is_some);
        assert_eq!(known, material.group != "soil", "{}", material.name);
        let brittle = ["glass", "rock", "ceramic"].contains(&material.group.as_str());
        assert_eq!(strengths[2].is_some(), brittle, "{}", material.name);
        if let (Some(first), Some(last)) = (strengths[0], strengths[1]) {
            assert!(first <= 1.5 * last, "{}", material.name);
        }
    }
}
