//! The results file against its description in `data-schema/results.md`.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use formats::schema::results as schema;
use formats::stored::StoredImpact;
use formats::{Existing, OutputError, QUANTITIES, parse_scene, resolved, write_results};
use hdf5::types::VarLenUnicode;
use impact::{KernelChoice, Outcome, Scene, simulate};
use std::collections::BTreeSet;
use std::path::Path;

const DOCUMENT: &str = include_str!("../../../data-schema/results.md");

fn outcome() -> (Scene, Outcome) {
    // with a toughness, so that every result exists
    let text = include_str!("../../../scenes/copper-on-steel.toml").replace(
        "\n[striker]",
        "fracture_toughness_pa_sqrt_m = 5e7\n\n[striker]",
    );
    let section = "[map]\nr_max_m = 0.004\nz_max_m = 0.002\npoints = [4, 3]\nframes = 5\n";
    let scene = parse_scene(&format!("{text}\n{section}"), Path::new(".")).unwrap();
    let outcome = simulate(&scene, &KernelChoice::Direct).unwrap();
    (scene, outcome)
}

/// First cells of the tables of a part of the document, without their back quotes.
fn listed(from: &str, to: &str) -> BTreeSet<String> {
    let part = DOCUMENT.split(from).nth(1).unwrap();
    let part = if to.is_empty() {
        part
    } else {
        part.split(to).next().unwrap()
    };
    part.lines()
        .filter_map(|line| line.strip_prefix("| `"))
        .map(|line| line.split('`').next().unwrap().to_owned())
        .collect()
}

/// Paths of the datasets in a file, each of which is described with its unit.
fn described_datasets(file: &hdf5::File) -> BTreeSet<String> {
    let mut written = BTreeSet::new();
    let mut groups = vec![(String::new(), file.as_group().unwrap())];
    while let Some((name, group)) = groups.pop() {
        // by the names of the links: a dataset of the section has two
        for member in group.member_names().unwrap() {
            let Ok(dataset) = group.dataset(&member) else {
                continue;
            };
            let path = format!("{name}/{member}");
            for attribute in ["units", "long_name"] {
                assert!(dataset.attr(attribute).is_ok(), "{path} has no {attribute}");
            }
            let expected = DOCUMENT
                .lines()
                .find(|line| line.contains(&format!("| `{path}` |")));
            let unit: VarLenUnicode = dataset.attr("units").unwrap().read_scalar().unwrap();
            assert!(
                expected.is_some_and(|line| line.contains(&format!("| {unit} |"))),
                "{path}"
            );
            written.insert(path);
        }
        for inner in group.groups().unwrap() {
            groups.push((inner.name(), inner));
        }
    }
    written
}

/// What a striker has and a record has not, and the other way round.
const OF_A_STRIKER: [&str; 3] = ["/displacement", "/velocity", "/energy/kinetic"];
const OF_A_RECORD: [&str; 1] = ["/energy/work"];
/// What a striker has that makes the contact yield.
const OF_FLOW: &str = "/energy/plastic";

#[test]
fn every_dataset_is_described_and_every_description_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let (path, other) = (
        folder.path().join("out.h5"),
        folder.path().join("record.h5"),
    );
    let (scene, outcome) = outcome();
    write_results(&path, &scene, &outcome, Existing::Keep).unwrap();
    let text = include_str!("../../../scenes/prescribed-force.toml");
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let scene = parse_scene(text, &scenes).unwrap();
    let outcome = simulate(&scene, &KernelChoice::Direct).unwrap();
    write_results(&other, &scene, &outcome, Existing::Keep).unwrap();
    let file = hdf5::File::open(&path).unwrap();
    let striker = described_datasets(&file);
    let record = described_datasets(&hdf5::File::open(&other).unwrap());
    for (own, has, has_not) in [
        (&OF_A_STRIKER[..], &striker, &record),
        (&OF_A_RECORD[..], &record, &striker),
    ] {
        assert!(
            own.iter()
                .all(|&path| has.contains(path) && !has_not.contains(path))
        );
    }
    assert_eq!(StoredImpact::open(&other).unwrap().series, outcome.series);
    let plastic = include_str!("../../../scenes/plastic-drop.toml");
    let fitted = plastic.replace("\"thornton\"", "\"jackson_green\"");
    let own = |line: &&str| !line.starts_with("yield_pressure_pa");
    let fitted: String = fitted
        .lines()
        .filter(own)
        .flat_map(|line| [line, "\n"])
        .collect();
    assert!(fitted.contains("jackson_green"));
    let write = |text: &str, path: &Path| {
        let scene = parse_scene(text, &scenes).unwrap();
        let outcome = simulate(&scene, &KernelChoice::Direct).unwrap();
        write_results(path, &scene, &outcome, Existing::Replace).unwrap();
    };
    write(plastic, &other);
    let third = other.with_file_name("fitted.h5");
    write(&fitted, &third);
    let fitted = hdf5::File::open(&third).unwrap();
    let dented = hdf5::File::open(&other).unwrap();
    let yielding = described_datasets(&dented);
    assert!(yielding.contains(OF_FLOW) && !striker.contains(OF_FLOW));
    let mut written: BTreeSet<String> = striker.union(&record).cloned().collect();
    written.extend(yielding);
    let plate = text
        .replace("[force]", "thickness_m = 0.02\nechoes = 2\n[force]")
        .replace(
            "[output]",
            "[[probe]]\nr_m = 0.0\nz_m = 0.02\n[output]\nlow_pass_hz = 2e5",
        );
    let sensor =
        "[[sensor]]\nr_m = 0.01\nz_m = 0.0\nface_radius_m = 1e-3\n[output]\nlow_pass_hz = 2e5";
    let plate = plate.replace("[output]\nlow_pass_hz = 2e5", sensor);
    let of_plate = other.with_file_name("plate.h5");
    write(&plate, &of_plate);
    let of_plate = hdf5::File::open(&of_plate).unwrap();
    written.extend(described_datasets(&of_plate));
    assert_eq!(written, listed("## Datasets", "## Attributes"));
    let names = [&file, &dented, &fitted, &of_plate].map(|file| file.attr_names().unwrap());
    let attributes: BTreeSet<String> = names.into_iter().flatten().collect();
    assert_eq!(attributes, listed("## Attributes", ""));
    for quantity in &QUANTITIES {
        let row = format!("| `{}` |", quantity.name);
        let line = DOCUMENT.lines().find(|line| line.contains(&row));
        assert!(
            line.is_some_and(|line| line.contains(&format!("| {} |", quantity.unit))),
            "{row}"
        );
    }
    assert!(DOCUMENT.contains(&format!("Version {}.\n", schema::FORMAT_VERSION)));
}

#[test]
fn the_section_is_what_probes_at_its_points_see() {
    let text = include_str!("../../../scenes/copper-on-steel.toml");
    let start = text.find("[[probe]]").unwrap();
    let text = format!(
        "{}[[probe]]\nr_m = 0.004\nz_m = 0.001\n[map]\nr_max_m = 0.008\nz_max_m = 0.002\npoints = [3, 3]\nframes = 7\n",
        &text[..start]
    );
    let scene = parse_scene(&text, Path::new(".")).unwrap();
    let outcome = simulate(&scene, &KernelChoice::Direct).unwrap();
    let (map, probe) = (outcome.section.unwrap(), outcome.probes.unwrap());
    assert_eq!((map.r_m[1], map.z_m[1]), (0.004, 0.001));
    assert_eq!((map.z_m[0], map.z_m[2]), (0.002, 0.0));
    for (frame, time_s) in map.time_s.iter().enumerate() {
        let sample = outcome
            .series
            .time_s
            .iter()
            .position(|t| (t / time_s - 1.0).abs() < 1e-12 || t == time_s);
        let sample = sample.unwrap();
        for field in 0..6 {
            let (a, b) = (
                map.values[field][frame * 9 + 4],
                probe.values[field][0][sample],
            );
            let peak = probe.values[field][0]
                .iter()
                .fold(0.0_f64, |m, x| m.max(x.abs()));
            assert!(
                (f64::from(a) - b).abs() < 1e-6 * peak,
                "{field} {frame}: {a} {b}"
            );
        }
    }
    assert_eq!(
        [map.arrival_s[0][4], map.arrival_s[2][4]],
        [probe.arrival_s[0][0], probe.arrival_s[0][2]]
    );
}

#[test]
fn a_file_in_the_way_is_kept() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.h5");
    std::fs::write(&path, "precious").unwrap();
    let (scene, outcome) = outcome();
    let refused = write_results(&path, &scene, &outcome, Existing::Keep);
    assert!(matches!(refused, Err(OutputError::Exists { .. })));
    assert_eq!(std::fs::read(&path).unwrap(), b"precious");
    write_results(&path, &scene, &outcome, Existing::Replace).unwrap();
    assert!(hdf5::File::open(&path).is_ok());
    let nowhere = folder.path().join("none").join("out.h5");
    assert!(write_results(&nowhere, &scene, &outcome, Existing::Keep).is_err());
    // nothing but the one file is left
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn a_file_without_warnings_is_none_of_the_program() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.h5");
    let (scene, outcome) = outcome();
    write_results(&path, &scene, &outcome, Existing::Keep).unwrap();
    let change = |change: &dyn Fn(&hdf5::File)| {
        let file = hdf5::File::open_rw(&path).unwrap();
        change(&file);
        file.close().unwrap();
        StoredImpact::open(&path).map(drop)
    };
    // of a version before files had a seal
    let version: VarLenUnicode = "1.7".parse().unwrap();
    let older = |file: &hdf5::File| {
        let attribute = file.attr("format_version").unwrap();
        attribute.write_scalar(&version).unwrap();
    };
    change(&older).unwrap();
    let told = change(&|file| file.delete_attr(schema::WARNINGS).unwrap()).unwrap_err();
    let sentence = "the text attribute warnings is missing";
    assert_eq!(told.to_string(), format!("{}: {sentence}", path.display()));
}

#[test]
fn the_resolved_scene_gives_the_same_numbers() {
    let (scene, first) = outcome();
    let again = parse_scene(&resolved(&scene), Path::new(".")).unwrap();
    assert_eq!(simulate(&again, &KernelChoice::Direct).unwrap(), first);
}

/// The frames of a section at given times are the samples nearest to them.
#[test]
fn a_section_has_frames_at_the_times_that_are_given() {
    let scene = include_str!("../../../scenes/copper-on-steel.toml");
    let section = "[map]\nr_max_m = 0.006\nz_max_m = 0.003\npoints = [2, 2]\n";
    let folder = tempfile::tempdir().unwrap();
    let parsed = |times: &str| parse_scene(&format!("{scene}\n{section}{times}"), folder.path());
    let wanted_s = [0.0, 3.3e-7, 1.234e-6, 2.05e-6];
    let scene = parsed(&format!("times_s = {wanted_s:?}\n")).unwrap();
    let again = parse_scene(&resolved(&scene), folder.path()).unwrap();
    assert_eq!(again.section, scene.section);
    let outcome = simulate(&scene, &KernelChoice::Direct).unwrap();
    let (time_s, section) = (&outcome.series.time_s, outcome.section.unwrap());
    assert_eq!(section.time_s.len(), wanted_s.len());
    let half_s = 0.5 * (time_s[1] - time_s[0]);
    for (found, wanted) in section.time_s.iter().zip(wanted_s) {
        assert!((found - wanted).abs() <= 1.001 * half_s, "{found} {wanted}");
    }
    let late = parsed("times_s = [1e-6, 1.0]\n").unwrap();
    let said = simulate(&late, &KernelChoice::Direct)
        .unwrap_err()
        .to_string();
    assert!(
        said.starts_with("map.times_s = 1 is outside [0, "),
        "{said}"
    );
    for (times, part) in [
        ("times_s = [2e-6, 1e-6]\n", "numbers that rise"),
        ("times_s = [-1e-6, 1e-6]\n", "numbers that rise"),
        ("times_s = []\n", "numbers that rise"),
        (
            "times_s = [1e-6]\nframes = 3\n",
            "map.frames cannot be combined with map.times_s",
        ),
        ("", "map.frames is missing"),
    ] {
        let said = parsed(times).unwrap_err().to_string();
        assert!(said.contains(part), "{said}");
    }
}
