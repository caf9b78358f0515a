//! Sweeps: every row a scene, resumed, reproducible, failures with their reason.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use contact::{Choice, Model};
use formats::schema::sweep as schema;
use formats::sweep::{
    BLOCK, Block, Blocks, Kept, Spec, compute_rows, is_computed, run_rows, stage_csv, stage_rows,
};
use formats::{Existing, Output, QUANTITIES, parse_scene};
use impact::{KernelChoice, simulate};
use std::collections::BTreeSet;
use std::path::Path;

const SCENE: &str = "\
[scene.target]
material = \"steel\"
[scene.striker]
material = \"copper\"
mass_kg = 0.0122
tip_radius_m = 0.004
velocity_m_s = 1.0
";

fn place_of(name: &str) -> usize {
    QUANTITIES.iter().position(|q| q.name == name).unwrap()
}

fn spec(axes: &str) -> Spec {
    Spec::from_toml(&format!("{SCENE}{axes}"), Path::new(".")).unwrap()
}

fn all(spec: &Spec) -> Vec<Block> {
    let folder = tempfile::tempdir().unwrap();
    let part = folder.path().join("part");
    let done = run_rows(spec, &part, Existing::Keep, |_| true);
    blocks(&done.unwrap().unwrap())
}

fn blocks(kept: &Kept) -> Vec<Block> {
    let mut blocks = Vec::new();
    let copied = kept.each(&mut |block| {
        blocks.push(block.clone());
        Ok(())
    });
    copied.unwrap();
    blocks
}

#[test]
fn each_row_is_what_its_scene_gives_alone() {
    let spec = spec(
        "[scene.contact]\ntolerance = 1e-4\n[product.striker]\nvelocity_m_s = [0.3, 30.0]\n\
         [product.target]\nmaterial = [\"granite\", \"pmma\"]\n\
         [product.contact]\nmodel = [\"hertz\", \"radiation\", \"wave\", \"growing\"]\n",
    );
    let blocks = all(&spec);
    let rows: Vec<&[f64]> = blocks.iter().flat_map(Block::rows).collect();
    assert_eq!(rows.len(), 16);
    let mut row = 0;
    // alphabetical: contact.model, striker.velocity_m_s, target.material
    for model in ["hertz", "radiation", "wave", "growing"] {
        for velocity in [0.3, 30.0] {
            for target in ["granite", "pmma"] {
                let text = SCENE
                    .replace("scene.", "")
                    .replace("\"steel\"", &format!("\"{target}\""))
                    .replace("velocity_m_s = 1.0", &format!("velocity_m_s = {velocity}"));
                let text = format!("{text}[contact]\ntolerance = 1e-4\nmodel = \"{model}\"\n");
                let scene = parse_scene(&text, Path::new(".")).unwrap();
                let alone = simulate(&scene, &KernelChoice::Direct).unwrap();
                let alone = *alone.results().unwrap();
                let close = |name: &str, value: f64| {
                    let k = place_of(name);
                    let found = rows[row][k];
                    // both are within the tolerance
                    assert!(
                        (found / value - 1.0).abs() < 2e-4,
                        "{model} {velocity} {target}, {}: {found} {value}",
                        QUANTITIES[k].name
                    );
                };
                close("peak_force_n", alone.peak_force_n);
                close("contact_time_s", alone.contact_time_s);
                close("restitution", alone.restitution);
                close("peak_displacement_m", alone.peak_displacement_m);
                close("impulse_n_s", alone.impulse_n_s);
                row += 1;
            }
        }
    }
}

#[test]
fn a_failed_scene_is_a_row_with_a_reason() {
    let spec = spec(
        "[scene.contact]\ndisc_radius_m = 0.004\nmodel = \"wave\"\n\
         [list.striker]\nmass_kg = [0.01, 0.02, 0.01]\nvelocity_m_s = [1.0, 1e6, 2e6]\n",
    );
    let blocks = all(&spec);
    let block = &blocks[0];
    let (first, failed) = block.numbers.split_at(block.width);
    assert!(first[0] > 0.0 && failed.len() == 2 * block.width);
    assert!(failed.iter().all(|x| x.is_nan()));
    let reasons: Vec<&str> = block.failures.iter().map(|(_, r)| r.as_str()).collect();
    for (reason, velocity) in reasons.into_iter().zip(["1000000", "2000000"]) {
        let parts = [velocity, "Rayleigh"];
        assert!(parts.iter().all(|part| reason.contains(part)), "{reason}");
    }
    let folder = tempfile::tempdir().unwrap();
    let (h5, csv) = (folder.path().join("s.h5"), folder.path().join("s.csv"));
    let output = |path| Output::claim(path, Existing::Keep).unwrap();
    let (rows, text) = (output(&h5), output(&csv));
    let staged = stage_rows(&rows, &spec, &blocks).unwrap();
    staged.commit().unwrap();
    let staged = stage_csv(&text, &spec, &blocks).unwrap();
    staged.commit().unwrap();
    let text = std::fs::read_to_string(csv).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 4);
    assert!(lines[0].starts_with("striker.mass_kg,striker.velocity_m_s,peak_force_n,"));
    assert!(lines[2].contains("Rayleigh"));
    let columns = lines[0].split(',').count();
    assert_eq!(lines[1].split(',').count(), columns);
    let file = hdf5::File::open(&h5).unwrap();
    let failure: Vec<i32> = file.dataset("results/failure").unwrap().read_raw().unwrap();
    assert_eq!(failure, [-1, 0, 1]);
    assert_eq!(file.dataset("failures").unwrap().size(), 2);
}

const DRAWS: &str = "[scene.contact]\nmodel = \"wave\"\ndisc_radius_m = 0.002\n\
    [product.striker]\nvelocity_m_s = { from = 1.0, to = 100.0, count = 10, spacing = \"log\" }\n\
    [random]\nsamples = 10000\nseed = 7\n[random.target]\n\
    poisson_ratio = { distribution = \"normal\", mean = 0.3, deviation = 0.01 }\n[random.striker]\n\
    mass_kg = { distribution = \"log_normal\", median = 0.0122, deviation = 0.05 }\n";

fn bits(blocks: &[Block]) -> Vec<u64> {
    let numbers = blocks.iter().flat_map(|b| &b.numbers);
    numbers.map(|x| x.to_bits()).collect()
}

#[test]
fn an_interrupted_sweep_goes_on_and_gives_the_same() {
    let spec = spec(DRAWS);
    assert!(spec.rows() > 2 * BLOCK);
    let folder = tempfile::tempdir().unwrap();
    let part = folder.path().join("part");
    // stops after the first block
    let stopped = run_rows(&spec, &part, Existing::Keep, |done| done == 0).unwrap();
    assert!(stopped.is_none());
    assert!(!is_computed(&spec, &part));
    // a record that is cut short is computed anew, in blocks that begin and end elsewhere
    let length = std::fs::metadata(&part).unwrap().len();
    let mut counts = Vec::new();
    let stopped = run_rows(&spec, &part, Existing::Keep, |done| {
        counts.push(done);
        done < 2 * BLOCK
    });
    assert!(stopped.unwrap().is_none());
    let file = std::fs::OpenOptions::new().write(true).open(&part).unwrap();
    let both = file.metadata().unwrap().len();
    assert!(both > length);
    file.set_len(both - 100).unwrap();
    let kept = counts[counts.len() - 2];
    let mut first = None;
    let done = run_rows(&spec, &part, Existing::Keep, |rows| {
        first.get_or_insert(rows);
        true
    });
    let done = done.unwrap().unwrap();
    assert_eq!((first, done.resumed), (Some(kept), kept));
    assert!(is_computed(&spec, &part));
    let whole = all(&spec);
    assert!(bits(&blocks(&done)) == bits(&whole), "resumed rows differ");
    let k = place_of("restitution");
    let numbers = whole.iter().flat_map(Block::rows);
    let restitutions: BTreeSet<u64> = numbers.map(|n| n[k].to_bits()).collect();
    assert!(
        restitutions.len() > spec.rows() / 2,
        "draws differ from row to row"
    );
    // another sweep does not go on with this one's rows, and drops them only when it is told to
    let other = self::spec(&DRAWS.replace("seed = 7", "seed = 8"));
    let before = std::fs::read(&part).unwrap();
    let refused = run_rows(&other, &part, Existing::Keep, |_| true).unwrap_err();
    assert!(refused.to_string().contains("another sweep"), "{refused}");
    assert!(std::fs::read(&part).unwrap() == before);
    run_rows(&other, &part, Existing::Replace, |_| false).unwrap();
    assert!(std::fs::metadata(&part).unwrap().len() < 300);
}

#[test]
fn a_sweep_goes_on_only_with_the_materials_that_it_began_with() {
    let folder = tempfile::tempdir().unwrap();
    let (materials, part) = (folder.path().join("m.toml"), folder.path().join("part"));
    let mine = "[mine]\nyoungs_modulus_pa = 70e9\npoisson_ratio = 0.22\nsource = \"x\"\n";
    std::fs::write(&materials, mine).unwrap();
    let text = "[scene.materials]\nfile = \"m.toml\"\n[scene.target]\nmaterial = \"steel\"\n\
        [scene.striker]\nmaterial = \"mine\"\nmass_kg = 0.01\ntip_radius_m = 0.005\n\
        [product.striker]\nvelocity_m_s = { from = 1.0, to = 2.0, count = 1000 }\n";
    let read = || Spec::from_toml(text, folder.path()).unwrap();
    let spec = read();
    assert_eq!(spec.inputs[0].1, materials);
    run_rows(&spec, &part, Existing::Keep, |done| done == 0).unwrap();
    // what was read once is not read again
    std::fs::write(&materials, mine.replace("70e9", "7e9")).unwrap();
    let done = run_rows(&spec, &part, Existing::Keep, |_| true);
    let done = done.unwrap().unwrap();
    let alone = folder.path().join("alone");
    std::fs::write(&materials, mine).unwrap();
    let whole = run_rows(&read(), &alone, Existing::Keep, |_| true);
    assert!(bits(&blocks(&done)) == bits(&blocks(&whole.unwrap().unwrap())));
    // and a later run with the edited file is another sweep
    std::fs::write(&materials, mine.replace("70e9", "7e9")).unwrap();
    let refused = run_rows(&read(), &part, Existing::Keep, |_| true).unwrap_err();
    assert!(refused.to_string().contains("its files"), "{refused}");
}

#[test]
fn a_damaged_journal_takes_no_memory_and_a_strange_one_stays() {
    let spec = spec("[product.striker]\nvelocity_m_s = { from = 1.0, to = 2.0, count = 100 }\n");
    let folder = tempfile::tempdir().unwrap();
    let part = folder.path().join("part");
    let whole = run_rows(&spec, &part, Existing::Keep, |_| true);
    let whole = bits(&blocks(&whole.unwrap().unwrap()));
    let good = std::fs::read(&part).unwrap();
    // the length of the first record, behind the title, and what it says of itself
    let line = good.iter().position(|&byte| byte == b'\n').unwrap();
    let title = String::from_utf8_lossy(&good[..line]);
    let about: usize = title.rsplit(' ').next().unwrap().parse().unwrap();
    let begin = line + 1 + about;
    for (place, number) in [
        (0, u64::MAX),
        (0, 1 << 40),
        (8, 7),
        (16, 36_000_000),
        (32, 0),
    ] {
        let (mut bad, place) = (good.clone(), begin + place);
        bad[place..place + 8].copy_from_slice(&number.to_le_bytes());
        std::fs::write(&part, &bad).unwrap();
        let done = run_rows(&spec, &part, Existing::Keep, |_| true);
        assert!(bits(&blocks(&done.unwrap().unwrap())) == whole);
    }
    for strange in ["precious", "hertz", "hertzlamb journal 1 of a sweep: 12"] {
        std::fs::write(&part, strange).unwrap();
        let done = run_rows(&spec, &part, Existing::Replace, |_| true);
        assert_eq!(done.is_ok(), strange.starts_with("hertz"), "{strange}");
    }
    std::fs::write(&part, "precious").unwrap();
    run_rows(&spec, &part, Existing::Keep, |_| true).unwrap_err();
    assert_eq!(std::fs::read(&part).unwrap(), b"precious");
}

#[test]
fn the_model_of_a_row_is_an_index_into_the_names() {
    let spec = spec("[product.contact]\nmodel = [\"growing\", \"hertz\"]\n");
    let blocks = all(&spec);
    let names: Vec<&str> = blocks[0]
        .models
        .iter()
        .map(|&m| Model::ALL[usize::from(m)].name())
        .collect();
    assert_eq!(names, ["growing", "hertz"]);
}

#[test]
fn bad_sweeps_are_refused_with_key_and_value() {
    let cases = [
        ("", "product"),
        (
            "[product.striker]\nvelocity_ms = [1.0]\n",
            "striker.velocity_ms",
        ),
        ("[product.striker]\nmass_kg = []\n", "mass_kg = []"),
        (
            "[product.striker]\nmass_kg = [1.0, \"a\"]\n",
            "list of numbers",
        ),
        (
            "[product.striker]\nmass_kg = { from = 1.0, to = 2.0, count = 1 }\n",
            "mass_kg.count = 1 is outside [2",
        ),
        (
            "[product.striker]\nmass_kg = { from = 0.0, to = 2.0, count = 3, spacing = \"log\" }\n",
            "mass_kg.from = 0 is outside (0, inf)",
        ),
        (
            "[list.striker]\nmass_kg = [1.0, 2.0]\nvelocity_m_s = [1.0]\n",
            "of 2 values cannot be combined",
        ),
        (
            "[random]\nsamples = 3\n[random.striker]\nmass_kg = { distribution = \"gauss\", mean = 1.0 }\n",
            "uniform, log_uniform, normal, log_normal",
        ),
        (
            "[random]\nsamples = 3\n[random.striker]\nmass_kg = { distribution = \"uniform\", low = 2.0, high = 1.0 }\n",
            "high must be above low",
        ),
        (
            "[product.striker]\nmass_kg = [1.0]\n[list.striker]\nmass_kg = [1.0]\n",
            "along one axis only",
        ),
        (
            "[product.striker]\nmass_kg = { from = 1.0, to = 2.0, count = 10000000 }\nvelocity_m_s = { from = 1.0, to = 2.0, count = 1000000 }\n",
            "10000000000000 is outside [1, 1e12]",
        ),
        (
            "[product.target]\nmaterial = [\"steel\", \"granite\", \"steal\"]\n",
            "target.material = \"steal\" is not in the materials library; did you mean steel?",
        ),
        (
            "[product.contact]\nmodel = [\"hertz\", \"wave\", \"hertzz\"]\n",
            "contact.model = \"hertzz\" is not one of",
        ),
        (
            "[list.striker]\nmass_kg = [0.01, 0.02]\nmaterial = [\"steel\", \"steal\"]\n",
            "striker.material = \"steal\"",
        ),
        (
            "[product.materials]\nfile = [\"nowhere.toml\"]\n",
            "cannot read ./nowhere.toml",
        ),
        (
            "[[scene.probe]]\nr_m = 0.0\nz_m = 0.0\n[product.striker]\nmass_kg = [1.0]\n",
            "[[probe]]",
        ),
    ];
    let folder = tempfile::tempdir().unwrap();
    for (axes, expected) in cases {
        let text = format!("{SCENE}{axes}");
        let message = match Spec::from_toml(&text, Path::new(".")) {
            Err(error) => error.to_string(),
            Ok(spec) => {
                let part = folder.path().join("part");
                match run_rows(&spec, &part, Existing::Keep, |_| true) {
                    Err(error) => error.to_string(),
                    Ok(_) => "no error".to_owned(),
                }
            }
        };
        assert!(message.contains(expected), "{axes}\n{message}");
        assert_eq!(message.lines().count(), 1, "{message}");
    }
}

#[test]
fn a_scene_and_numbers_out_of_range_are_refused_at_once() {
    let scene = SCENE.replace("[scene.", "[");
    let outside = format!(
        "{SCENE}[product.striker]\nvelocity_m_s = {{ from = -1.0, to = 2.0, count = 3 }}\n"
    );
    for (text, expected) in [
        (scene, "this is a scene; a sweep contains"),
        (outside, "striker.velocity_m_s = -1 is outside (0, inf)"),
    ] {
        let error = Spec::from_toml(&text, Path::new(".")).unwrap_err();
        assert!(error.to_string().contains(expected), "{error}");
    }
}

#[test]
fn draws_take_no_memory_and_are_those_of_a_shorter_sweep() {
    let text = |samples: usize| {
        format!(
            "[random]\nsamples = {samples}\nseed = 5\n[random.striker]\nvelocity_m_s = {{ distribution = \"normal\", mean = 2.0, deviation = 0.7 }}\nmass_kg = {{ distribution = \"log_uniform\", low = 1e-3, high = 1.0 }}\n"
        )
    };
    let (many, few) = (spec(&text(1_000_000_000_000)), spec(&text(1000)));
    assert!(many.memory_bytes() < 2e8);
    assert_eq!(many.memory_bytes(), few.memory_bytes());
    let rows = |spec: &Spec, start| {
        let block = compute_rows(spec, start, 7, 100, |_, _| true);
        block.unwrap().unwrap()
    };
    assert_eq!(bits(&[rows(&many, 30)]), bits(&[rows(&few, 30)]));
    let last = rows(&many, 1_000_000_000_000 - 694);
    assert!(last.failures.len() < 20 && bits(&[last]) != bits(&[rows(&few, 30)]));
    // numbers of sweeps that were computed before draws were made one by one
    let number = |key: usize, index| few.axes[0].columns[key].values.number(index);
    let known = [
        (0, 0, 0.058_510_761_477_406_78),
        (0, 999, 0.008_977_711_685_233_05),
        (1, 0, 2.537_885_776_361_141_8),
        (1, 999, 1.688_494_095_772_436_6),
    ];
    for (key, index, value) in known {
        assert_eq!(number(key, index), Some(value));
    }
    assert_eq!(number(0, 1000), None);
}

#[test]
fn the_format_is_written_down() {
    let document = include_str!("../../../data-schema/sweep.md");
    let numbers = QUANTITIES.iter().map(|q| q.name);
    let names = numbers
        .chain(schema::TEXTS)
        .chain([schema::ROWS, schema::FAILED])
        .chain([schema::MODEL.0, schema::FAILURE.0, schema::FAILURES.0])
        .chain([
            schema::AXES,
            schema::RESULTS,
            schema::FILE_TYPE,
            schema::FORMAT_VERSION,
            schema::part::FILE_TYPE,
            schema::part::FORMAT_VERSION,
            schema::part::SHARD,
            schema::part::SWEEP_ROWS,
            schema::part::FIRST_ROW,
            schema::part::ROW.0,
            schema::part::WORDS,
        ]);
    for name in names {
        assert!(
            document.contains(name),
            "{name} is not in data-schema/sweep.md"
        );
    }
    for quantity in &QUANTITIES {
        let (name, unit) = (quantity.name, quantity.unit);
        let row = document
            .lines()
            .find(|line| line.contains(&format!("/{name}`")));
        assert!(
            row.is_some_and(|row| row.contains(&format!("| {unit} |"))),
            "{name}: {unit}"
        );
    }
}
