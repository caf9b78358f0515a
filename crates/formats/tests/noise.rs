//! Noise files: results that agree with their document, journals, and files that cannot be used.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use formats::noise::{NoiseSpec, stage_noise};
use formats::schema::noise as schema;
use formats::{Existing, Output};
use std::path::Path;

const BODIES: &str = "[target]\nmaterial = \"granite\"\n[striker]\nmaterial = \"granite\"\nshape = \"ball\"\ndiameter_m = 0.02\nvelocity_m_s = 1.0\n";
const RING: &str =
    "[area]\nshape = \"disc\"\nradius_m = 30.0\ninner_radius_m = 2.0\nrate_per_m2_s = 0.5\n";
const RECEIVER: &str = "[[receiver]]\nx_m = 0.0\ny_m = 1.0\n";
const OUTPUT: &str = "[output]\nfrequencies_hz = [10.0, 50.0]\n";
const TRACES: &str = "duration_s = 0.5\nstep_s = 1e-3\n";

fn spec(text: &str, folder: &Path) -> Result<NoiseSpec, String> {
    let table = formats::scene::parse_table(text).map_err(|error| error.to_string())?;
    NoiseSpec::from_table(&table, folder).map_err(|error| error.to_string())
}

#[test]
fn files_agree_with_their_document() {
    let document = include_str!("../../../data-schema/noise.md");
    let has = |name: &str| assert!(document.contains(&format!("`{name}`")), "{name}");
    schema::AREA
        .iter()
        .chain(&schema::RECEIVER)
        .chain(&schema::OUTPUT)
        .for_each(|key| has(key));
    schema::IMPACTS
        .iter()
        .chain(&schema::COLUMNS)
        .chain(&schema::NUMBERS)
        .for_each(|key| has(key));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.h5");
    let spec = spec(
        &[BODIES, RING, RECEIVER, OUTPUT, TRACES].concat(),
        folder.path(),
    )
    .unwrap();
    let results = spec.compute(None, |_, _, _| true).unwrap().unwrap();
    let output = Output::claim(&path, Existing::Keep).unwrap();
    stage_noise(&output, &spec, &results)
        .unwrap()
        .commit()
        .unwrap();
    let file = hdf5::File::open(&path).unwrap();
    let mut names: Vec<String> = file.member_names().unwrap();
    names.retain(|name| name != schema::TRACES);
    names.extend(
        file.group(schema::TRACES)
            .unwrap()
            .member_names()
            .unwrap()
            .iter()
            .map(|name| format!("traces/{name}")),
    );
    assert!(names.len() >= 20);
    names.iter().for_each(|name| has(&format!("/{name}")));
    for name in file.attr_names().unwrap() {
        has(&name);
    }
    let power = file
        .dataset("vertical_velocity")
        .unwrap()
        .read_raw::<f64>()
        .unwrap();
    assert!(power.iter().all(|x| *x > 0.0 && x.is_finite()));
}

/// A stopped run keeps its tiles, and the traces of the resumed one are the same.
#[test]
fn stopped_traces_are_resumed() {
    let folder = tempfile::tempdir().unwrap();
    let part = folder.path().join("out.h5.part");
    let long = TRACES.replace("0.5", "4.0");
    let spec = spec(
        &[BODIES, RING, RECEIVER, OUTPUT, &long].concat(),
        folder.path(),
    )
    .unwrap();
    let whole = spec.compute(None, |_, _, _| true).unwrap().unwrap();
    let stopped = spec.compute(Some((&part, false)), |stage, done, _| {
        stage != "traces" || done < 2
    });
    assert!(stopped.unwrap().is_none());
    assert!(part.metadata().unwrap().len() > 8 * 1000);
    let resumed = spec
        .compute(Some((&part, false)), |_, _, _| true)
        .unwrap()
        .unwrap();
    assert_eq!(whole.traces, resumed.traces);
}

/// Ten listed impacts have ten times the power of one at the same place.
#[test]
fn impacts_of_a_file_add_up() {
    let folder = tempfile::tempdir().unwrap();
    let power = |rows: &str| {
        std::fs::write(folder.path().join("impacts.csv"), rows).unwrap();
        let file = "[impacts]\nfile = \"impacts.csv\"\n";
        let spec = spec(
            &[BODIES, file, RECEIVER, OUTPUT, "duration_s = 2.0\n"].concat(),
            folder.path(),
        )?;
        let results = spec
            .compute(None, |_, _, _| true)
            .map_err(|error| error.to_string())?;
        Ok::<_, String>(
            results
                .unwrap()
                .spectra
                .power(0, noise::Motion::Vertical, 1),
        )
    };
    let header = "time_s,x_m,y_m,velocity_m_s\n";
    let one = power(&[header, "0.1,3.0,1.0,2.0\n"].concat()).unwrap();
    let ten = power(&[header, &"0.1,3.0,1.0,2.0\n".repeat(10)].concat()).unwrap();
    assert!(
        one.iter()
            .zip(&ten)
            .all(|(a, b)| (b / a - 10.0).abs() < 1e-9)
    );
    for (rows, words) in [
        ("time_s,x_m\n1,2\n", "there is no column y_m"),
        (
            "time_s,x_m,y_m,speed\n1,2,3,4\n",
            "line 1: unknown key speed",
        ),
        ("time_s,x_m,y_m,youngs\n1,2,3,4\n", "line 1"),
        ("time_s,x_m,y_m\n1,2\n", "line 2: there are 2 fields"),
        (
            "time_s,x_m,y_m\n1,two,3\n",
            "line 2: \"two\" is not a finite number",
        ),
        ("time_s,x_m,y_m\n", "no impacts"),
        ("", "empty"),
        (
            "time_s,x_m,y_m,velocity_m_s\n1,2,3,-1\n",
            "striker.velocity_m_s = -1",
        ),
        ("time_s,x_m,y_m\n1,0.0,1.0\n", "from the nearest impact"),
    ] {
        let error = power(rows).unwrap_err();
        assert!(error.contains(words), "{rows:?}: {error}");
    }
}

#[test]
fn what_cannot_be_used_is_rejected_by_name() {
    let good = [BODIES, RING, RECEIVER, OUTPUT].concat();
    for (from, to, words) in [
        (
            "[output]\n",
            "[output]\nfrequency = 1\n",
            "unknown key output.frequency",
        ),
        (
            "[10.0, 50.0]",
            "[10.0, 5.0]",
            "output.frequencies_hz = 5 is outside (10, inf)",
        ),
        ("[10.0, 50.0]", "[0.0, 5.0]", "output.frequencies_hz = 0"),
        ("[10.0, 50.0]", "[\"a\"]", "output.frequencies_hz"),
        (
            "[10.0, 50.0]",
            "[1.0]\nduration_s = 3.0",
            "output.step_s is missing",
        ),
        (
            "[10.0, 50.0]",
            "[1.0]\nstep_s = 3.0",
            "output.duration_s is missing",
        ),
        (RECEIVER, "", "the number of [[receiver]] = 0"),
        ("y_m = 1.0", "y_m = 1.0\nz_m = -1.0", "receiver[1].z_m = -1"),
        (
            "inner_radius_m = 2.0",
            "inner_radius_m = 30.0",
            "area.inner_radius_m = 30",
        ),
        (
            "radius_m = 30.0",
            "radius_m = 30.0\nlength_m = 2.0",
            "unknown key area.length_m",
        ),
        (
            "\"disc\"",
            "\"square\"",
            "area.shape = \"square\" is not one of disc, strip",
        ),
        (RING, "", "area is missing"),
        ("rate_per_m2_s = 0.5\n", "", "area.rate_per_m2_s is missing"),
        (
            "[area]",
            "[random]\ntarget.poisson_ratio = { distribution = \"uniform\", low = 0.1, high = 0.2 }\n[area]",
            "unknown key random.target",
        ),
        (
            "[area]",
            "[impacts]\nfile = \"none.csv\"\n[area]",
            "[area] cannot be combined with [impacts]",
        ),
        (
            "[target]\n",
            "[target]\nthickness_m = 1.0\nechoes = 2\n",
            "target.echoes cannot be combined with noise",
        ),
        ("[area]", "[map]\n[area]", "unknown key map"),
        ("diameter_m", "diameter", "unknown key striker.diameter"),
    ] {
        assert!(good.contains(from), "{from}");
        let text = good.replace(from, to);
        let spec = spec(&text, Path::new("."));
        let error = spec.and_then(|spec| {
            let found = spec.compute(None, |_, _, _| true);
            found.map_err(|error| error.to_string())
        });
        let error = error.unwrap_err();
        assert!(error.contains(words), "{to:?}: {error}");
    }
    let inside = good.replace("inner_radius_m = 2.0\n", "");
    let error = spec(&inside, Path::new("."))
        .unwrap()
        .compute(None, |_, _, _| true)
        .unwrap_err();
    assert!(error.to_string().contains("set nearest_m"), "{error}");
}
