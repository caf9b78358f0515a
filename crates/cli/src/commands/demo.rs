//! `hertzlamb demo`: the paper's case from kernels to picture, and the waves under a ball.

use crate::arguments::open_table;
use crate::failure::{Failure, line, print, say};
use crate::progress::Bar;
use clap::Args;
use figure::to_svg;
use formats::{Existing, OutputError, parse_scene, write_results, write_whole};
use impact::{Allowance, KernelChoice, Outcome, Scene, simulate, simulate_within};
use paper::Numbers;
use plot::{Request, compose};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;
use tabulator::{Grid, Progress, build};

/// The paper's scene, identical to the file in scenes/.
const SCENE: &str = include_str!("../copper-on-steel.toml");

/// A ball on glass, with well separated waves.
const WAVES: &str = include_str!("../waves.toml");

#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  hertzlamb demo -o demo-out\n\nBuilds the kernel table unless it exists in the folder, and replaces results and pictures of an earlier demo."
)]
pub(crate) struct Arguments {
    /// Folder for the table, results and pictures.
    #[arg(short, long, value_name = "DIR", default_value = "demo-out")]
    output: PathBuf,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let folder = &arguments.output;
    let shown = folder.display();
    std::fs::create_dir_all(folder)
        .map_err(|error| Failure::input(format!("cannot create the folder {shown}: {error}")))?;
    let table = folder.join("kernels.h5");
    if !table.exists() {
        let shown = table.display();
        say(format!(
            "building the demo kernel table {shown} (only the first time)"
        ));
        let summary = build(&Grid::demo(), &table, &Bar::new())?;
        let (points, took_s, bytes) = (summary.points, summary.wall_s, summary.bytes);
        say(format!("{points} points in {took_s:.1} s, {bytes} bytes"));
    }
    let table = open_table(&table)?;
    let table_1 = parse_scene(SCENE, Path::new(".")).map_err(Failure::work)?;
    let start = Instant::now();
    let coupled = simulate(&table_1, &KernelChoice::Table(Arc::new(table)))?;
    let wall_s = start.elapsed().as_secs_f64();
    let found = Numbers::compute().map_err(Failure::in_part)?;
    let numbers = folder.join("numbers.txt");
    replace(&numbers, &found.text())?;
    print(found.short())?;

    let results = folder.join("copper-on-steel.h5");
    let [results, picture] = kept(&table_1, &coupled, results)?;
    let probes = coupled.probes.as_ref();
    say(format!(
        "the coupled impact with its {} probes took {:.1} ms",
        probes.map_or(0, |fields| fields.r_m.len()),
        1e3 * wall_s
    ));
    let [waves, drawn] = waves(folder)?;
    let files = [&numbers, &results, &picture, &waves, &drawn];
    let [numbers, results, picture, waves, drawn] = files.map(|path| line(path.display()));
    print(format!(
        "\nall numbers, explained     {numbers}\nthe paper's impact         {results}, {picture}\nwaves under a ball         {waves}, {drawn}"
    ))
}

/// The waves that a ball sends into glass: results and picture.
fn waves(folder: &Path) -> Result<[PathBuf; 2], Failure> {
    let scene = parse_scene(WAVES, Path::new(".")).map_err(Failure::work)?;
    say(format!(
        "computing the waves under a 2 mm steel ball that falls 20 cm onto glass, at {} points",
        scene.points()
    ));
    let bar = Bar::new();
    bar.total("fields", scene.points() as u64);
    let allowance = Allowance {
        watch: &|| bar.advance(1),
        ..Allowance::default()
    };
    let outcome = simulate_within(&scene, &KernelChoice::Direct, &allowance)?;
    drop(bar);
    kept(&scene, &outcome, folder.join("waves.vtkhdf"))
}

/// Writes a results file and its picture as drawn by `hertzlamb plot`; returns both paths.
fn kept(scene: &Scene, outcome: &Outcome, results: PathBuf) -> Result<[PathBuf; 2], Failure> {
    write_results(&results, scene, outcome, Existing::Replace)?;
    let (figure, _) = compose(std::slice::from_ref(&results), &Request::default())?;
    let picture = results.with_extension("svg");
    replace(&picture, &to_svg(&figure).map_err(Failure::work)?)?;
    Ok([results, picture])
}

fn replace(path: &Path, text: &str) -> Result<(), OutputError> {
    write_whole(path, Existing::Replace, |mut file| {
        file.write_all(text.as_bytes())
    })
}
