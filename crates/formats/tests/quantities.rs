//! Quantities on demand: every one is written, described, has an error and a peak, and agrees with the fields.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use contact::Choice;
use formats::quantities::{FIELD_QUANTITIES, FIELDS};
use formats::{Existing, parse_scene, resolved, write_results};
use impact::{KernelChoice, Quantity, simulate};
use std::path::Path;

const DOCUMENT: &str = include_str!("../../../data-schema/results.md");

fn text() -> String {
    let names: Vec<String> = Quantity::ALL
        .iter()
        .map(|q| format!("\"{}\"", q.name()))
        .collect();
    format!(
        "[target]\nmaterial = \"granite\"\n[striker]\nshape = \"ball\"\nmaterial = \"steel\"\ndiameter_m = 2e-3\nvelocity_m_s = 1.0\n\
         [contact]\ntolerance = 1e-3\n[[probe]]\nr_m = 0.004\nz_m = 0.003\n[[probe]]\nr_m = 0.0\nz_m = 0.004\n\
         [map]\nr_max_m = 0.008\nz_max_m = 0.006\npoints = [3, 3]\nframes = 7\n\
         [output]\nduration_s = 1.2e-5\npeaks = true\nquantities = [{}]\n",
        names.join(", ")
    )
}

#[test]
fn the_table_has_every_quantity_and_the_document_every_row() {
    assert!(
        FIELD_QUANTITIES
            .iter()
            .map(|row| row.0)
            .eq(Quantity::ALL.iter().copied())
    );
    for (quantity, unit, meaning) in FIELD_QUANTITIES {
        let row = format!("| `{}` | {unit} | {meaning} |", quantity.name());
        assert!(DOCUMENT.contains(&row), "{row}");
        let scene = include_str!("../../../data-schema/scene.md");
        assert!(scene.contains(&format!("`{}`", quantity.name())));
    }
}

/// The peaks of a quantity are one map for all steps.
fn has_one_map_of_peaks(file: &hdf5::File, name: &str) {
    let read = |path: &str| file.dataset(&format!("{path}/{name}_peak")).unwrap();
    let peaks = read("VTKHDF/PointData");
    assert_eq!(peaks.shape(), [1, 3, 3]);
    let all = read("map").read_raw::<f64>().unwrap();
    let all: Vec<f32> = all.into_iter().map(|peak| peak as f32).collect();
    assert_eq!(peaks.read_raw::<f32>().unwrap(), all);
    let offsets = read("VTKHDF/Steps/PointDataOffsets");
    assert_eq!(offsets.read_raw::<i64>().unwrap(), [0; 7]);
}

#[test]
fn quantities_and_peaks_are_written_with_units_and_agree_with_the_fields() {
    let scene = parse_scene(&text(), Path::new(".")).unwrap();
    assert_eq!(
        parse_scene(&resolved(&scene), Path::new(".")).unwrap(),
        scene
    );
    let outcome = simulate(&scene, &KernelChoice::Direct).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.h5");
    write_results(&path, &scene, &outcome, Existing::Keep).unwrap();
    let file = hdf5::File::open(&path).unwrap();
    let read = |name: &str| file.dataset(name).unwrap().read_raw::<f64>().unwrap();
    let unit = |name: &str| -> String {
        let attribute = file.dataset(name).unwrap().attr("units").unwrap();
        attribute
            .read_scalar::<hdf5::types::VarLenUnicode>()
            .unwrap()
            .to_string()
    };
    let time_s = read("time");
    let steps = time_s.len();
    let rows = FIELD_QUANTITIES.iter().map(|row| (row.0.name(), row.1));
    let fields = FIELDS.iter().map(|row| (row.0, row.1));
    for (name, expected) in fields.chain(rows) {
        for group in ["probes", "map"] {
            assert_eq!(unit(&format!("{group}/{name}")), expected);
            assert_eq!(unit(&format!("{group}/{name}_error")), expected);
            assert_eq!(unit(&format!("{group}/{name}_peak")), expected);
            assert_eq!(unit(&format!("{group}/{name}_peak_time")), "s");
            assert_eq!(unit(&format!("{group}/{name}_peak_error")), expected);
        }
        let samples = read(&format!("probes/{name}"));
        let (peaks, instants) = (
            read(&format!("probes/{name}_peak")),
            read(&format!("probes/{name}_peak_time")),
        );
        for probe in 0..2 {
            let own = &samples[probe * steps..(probe + 1) * steps];
            let most = own.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            // between the samples; where a needle passes it may be far above them
            let error = read(&format!("probes/{name}_peak_error"))[probe];
            assert!(peaks[probe].abs() >= most && error >= 0.0, "{name}");
            let after = time_s.partition_point(|t| *t < instants[probe]);
            assert!((0.0..=time_s[steps - 1]).contains(&instants[probe]));
            if let Some(&at) = own.get(after).filter(|_| time_s[after] == instants[probe]) {
                assert_eq!(at, peaks[probe], "{name}");
            }
        }
        assert!(
            read(&format!("probes/{name}_error"))
                .iter()
                .all(|e| e.is_finite() && *e >= 0.0)
        );
        // the section's peaks are over all samples: its point (0.004, 0.003) is the first probe
        let middle = read(&format!("map/{name}_peak"))[4];
        let error =
            read(&format!("probes/{name}_error"))[0] + read(&format!("map/{name}_error"))[4];
        assert!(
            (middle - peaks[0]).abs() <= error,
            "{name} {middle} {} {error}",
            peaks[0]
        );
        let frames = file
            .dataset(&format!("map/{name}"))
            .unwrap()
            .read_raw::<f32>()
            .unwrap();
        let shown = (0..7)
            .map(|f| frames[9 * f + 4].abs())
            .fold(0.0_f32, f32::max);
        assert!(f64::from(shown) <= middle.abs() * (1.0 + 1e-6), "{name}");
        assert!(file.dataset(&format!("VTKHDF/PointData/{name}")).is_ok());
        has_one_map_of_peaks(&file, name);
        assert!(
            file.dataset(&format!("VTKHDF/Steps/PointDataOffsets/{name}"))
                .is_ok()
        );
    }
}

/// On the axis a principal stress is the axial one.
#[test]
fn principal_stresses_on_the_axis_are_those_along_it() {
    let text = text().replace("peaks = true\n", "").replace(
        "[map]\nr_max_m = 0.008\nz_max_m = 0.006\npoints = [3, 3]\nframes = 7\n",
        "",
    );
    let scene = parse_scene(&text, Path::new(".")).unwrap();
    let outcome = simulate(&scene, &KernelChoice::Direct).unwrap();
    let probes = outcome.probes.unwrap();
    let of = |quantity: Quantity| {
        let place = probes.quantities.iter().position(|q| *q == quantity);
        &probes.values[6 + place.unwrap()][1]
    };
    let axial = &probes.values[4][1];
    for (i, &axial) in axial.iter().enumerate() {
        let near = [Quantity::Principal1, Quantity::Principal3].map(|q| (of(q)[i] - axial).abs());
        let size = probes.errors[4][1] + probes.errors[5][1] + 1e-12;
        assert!(near[0].min(near[1]) <= size, "{i}");
    }
}

#[test]
fn quantities_that_do_not_exist_or_stand_twice_are_refused() {
    for (list, words) in [
        (
            "[\"speed\"]",
            ["output.quantities = \"speed\"", "von_mises"],
        ),
        ("[\"tresca\", \"tresca\"]", ["tresca", "may occur once"]),
        ("\"tresca\"", ["output.quantities", "a list of words"]),
        ("[1]", ["output.quantities", "a word"]),
    ] {
        let text = text().replace("peaks = true\nquantities = [", "x = [");
        let text = format!(
            "{}quantities = {list}\n",
            text.split("x = [").next().unwrap()
        );
        let error = parse_scene(&text, Path::new(".")).unwrap_err().to_string();
        assert!(words.iter().all(|word| error.contains(word)), "{error}");
    }
}
