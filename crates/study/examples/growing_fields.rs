//! Error of a disc that has the largest radius throughout, compared with the contact whose radius follows the load.
//!
//! `cargo run --release --package hertzlamb-study --example growing_fields -- PICTURE.svg`
//!
//! A steel ball of 10 mm strikes steel at 5 m/s. Both loads have the same force; the largest difference over time is
//! relative to the largest value of the field at the place.

use figure::{Axis, ColourMap, Figure, Image, Layer, Panel, Sharing, to_svg};
use impact::{Field, HalfSpace, Impact, Material, Striker};
use std::error::Error;
use std::time::{Duration, Instant};

const TOLERANCE: f64 = 1e-4;
const PLACES: usize = 13;

fn main() -> Result<(), Box<dyn Error>> {
    let steel = HalfSpace::new(Material::named("steel")?)?;
    let ball = Striker::ball(Material::named("steel")?, 0.005)?;
    let run = Impact::new(steel, ball, 5.0).solve()?;
    let following = run.excitation();
    let radius_m = following.radius().largest_m();
    let fixed = following.on_disc(radius_m);

    // from the contact to six radii, and just below the surface, where the stresses equal those of the load
    let r: Vec<f64> = (0..PLACES).map(|i| 0.5 * i as f64).collect();
    let z: Vec<f64> = (0..PLACES).map(|i| 0.05 + 0.495 * i as f64).collect();
    let fields = [Field::DisplacementZ, Field::StressZz];
    let mut values = [Vec::new(), Vec::new()];
    let (mut spent, mut samples) = (Vec::<Duration>::new(), 0);
    println!("r/a z/a  displacement_z stress_zz: largest difference over the peak");
    for &z in &z {
        for &r in &r {
            let start = Instant::now();
            let exact = following
                .fields(1e-8)?
                .to_tolerance(TOLERANCE)
                .at(r * radius_m, z * radius_m)?;
            spent.push(start.elapsed());
            samples = exact.time_s.len();
            let disc = fixed
                .fields(1e-8)?
                .to_tolerance(TOLERANCE)
                .at(r * radius_m, z * radius_m)?;
            let mut row = Vec::new();
            for (values, field) in values.iter_mut().zip(fields) {
                let (a, b) = (&exact[field], &disc[field]);
                let pairs = a.samples.iter().zip(&b.samples);
                let most = pairs.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
                let off = most / a.peak().abs();
                row.push(format!("{off:.1e}"));
                values.push(100.0 * off);
            }
            println!("{r:4.2} {z:4.2}  {}", row.join(" "));
        }
    }
    spent.sort();
    let contact = following.end_s() / following.units().time_s();
    println!(
        "the contact lasts {contact:.0} a/c1; {samples} samples of six fields at a point: median {:.0?}, largest {:.0?}",
        spent[spent.len() / 2],
        spent[spent.len() - 1]
    );

    let figure = picture(&r, &z, values);
    if let Some(path) = std::env::args().nth(1) {
        std::fs::write(path, to_svg(&figure)?)?;
    }
    Ok(())
}

/// Two maps over distance and depth.
fn picture(r: &[f64], z: &[f64], values: [Vec<f64>; 2]) -> Figure {
    let mut figure = Figure::new("Error of a load on a disc of the largest radius throughout")
        .subtitle("steel ball of 10 mm on steel at 5 m/s: largest difference over time, over the largest value there")
        .sharing(Sharing::Both);
    for (values, title) in values
        .into_iter()
        .zip(["vertical displacement", "vertical stress"])
    {
        let colours = Axis::logarithmic("difference").unit("%").range(0.02, 100.0);
        let image = Image {
            has_cells: true,
            ..Image::new(
                r.to_vec(),
                z.to_vec(),
                values,
                colours,
                ColourMap::Sequential,
            )
        };
        let mut panel = Panel::new(
            Axis::linear("distance from the axis").unit("a"),
            Axis::linear("depth").unit("a").reversed(),
        );
        panel.has_equal_lengths = true;
        figure = figure.panel(panel.title(title).layer(Layer::Image(image)));
    }
    figure.columns(2)
}
