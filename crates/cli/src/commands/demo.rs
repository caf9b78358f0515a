//! `hertzlamb demo`: the paper's case from kernels to picture, and the waves under a ball.

use crate::arguments::open_table;
use crate::failure::{Failure, print, say};
use crate::progress::Bar;
use clap::Args;
use figure::to_svg;
use formats::{Existing, parse_scene, write_results, write_whole};
use impact::{Allowance, KernelChoice, simulate, simulate_within};
use paper::Numbers;
use plot::{Request, compose};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;
use tabulator::{Grid, Progress, build};

/// The paper's scene, the same file as in scenes/.
const SCENE: &str = include_str!("../copper-on-steel.toml");

/// A ball on glass, whose waves are seen apart.
const WAVES: &str = include_str!("../waves.toml");

#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  hertzlamb demo -o demo-out\n\nThe kernel table is made when it is missing; results and pictures of an earlier demo are replaced."
)]
pub(crate) struct Arguments {
    /// Folder for the table, results and pictures.
    #[arg(short, long, value_name = "DIR", default_value = "demo-out")]
    output: PathBuf,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let folder = &arguments.output;
    std::fs::create_dir_all(folder).map_err(|error| {
        Failure::input(format!(
            "cannot make the folder {}: {error}",
            folder.display()
        ))
    })?;
    let table_path = folder.join("kernels.h5");
    make_table(&table_path)?;
    let table = open_table(&table_path)?;
    let table_1 = parse_scene(SCENE, Path::new(".")).map_err(Failure::work)?;
    let start = Instant::now();
    let coupled = simulate(&table_1, &KernelChoice::Table(Arc::new(table)))?;
    let wall_s = start.elapsed().as_secs_f64();
    let found = Numbers::compute().map_err(Failure::in_part)?;
    let numbers = folder.join("numbers.txt");
    write_whole(&numbers, Existing::Replace, |part| {
        std::fs::write(part, found.text())
    })?;
    print(found.short())?;

    let results = folder.join("copper-on-steel.h5");
    write_results(&results, &table_1, &coupled, Existing::Replace)?;
    let picture = drawn(&results, folder.join("copper-on-steel.svg"))?;
    let probes = coupled.probes.as_ref();
    say(format!(
        "the coupled impact with its {} probes took {:.1} ms",
        probes.map_or(0, |fields| fields.r_m.len()),
        1e3 * wall_s
    ));
    let waves = waves(folder)?;
    print(format!(
        "\nall numbers, with reasons  {}\nthe paper's impact         {}, {}\nwaves under a ball         {}, {}",
        numbers.display(),
        results.display(),
        picture.display(),
        waves[0].display(),
        waves[1].display()
    ))
}

/// The waves that a ball sends into glass: results and picture.
fn waves(folder: &Path) -> Result<[PathBuf; 2], Failure> {
    let scene = parse_scene(WAVES, Path::new(".")).map_err(Failure::work)?;
    say(format!(
        "waves under a 2 mm steel ball that falls 20 cm on glass, at {} points",
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
    let results = folder.join("waves.vtkhdf");
    write_results(&results, &scene, &outcome, Existing::Replace)?;
    let picture = drawn(&results, folder.join("waves.svg"))?;
    Ok([results, picture])
}

/// Draws a results file as `hertzlamb plot` does.
fn drawn(results: &PathBuf, picture: PathBuf) -> Result<PathBuf, Failure> {
    let (figure, _) = compose(std::slice::from_ref(results), &Request::default())?;
    let svg = to_svg(&figure).map_err(Failure::work)?;
    write_whole(&picture, Existing::Replace, |part| {
        std::fs::write(part, svg)
    })?;
    Ok(picture)
}

fn make_table(path: &Path) -> Result<(), Failure> {
    if path.exists() {
        return Ok(());
    }
    say(format!(
        "making the demo kernel table {} (once)",
        path.display()
    ));
    let summary = build(&Grid::demo(), path, &Bar::new())?;
    say(format!(
        "{} points in {:.1} s, {} bytes",
        summary.points, summary.wall_s, summary.bytes
    ));
    Ok(())
}
