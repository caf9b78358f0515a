//! The paper's Fig. 4: force, displacement, deflection and velocity against time.

use contact::{Choice, Results};
use impact::{Cause, Outcome};
use plotters::prelude::{
    BLACK, ChartBuilder, IntoDrawingArea, LineSeries, PathElement, RGBColor, SVGBackend,
    SeriesLabelPosition, WHITE,
};
use plotters::style::{Color, IntoFont, TextStyle};
use std::error::Error;
use std::path::Path;

const BLUE: RGBColor = RGBColor(0, 90, 160);
const RED: RGBColor = RGBColor(190, 60, 40);
const GREEN: RGBColor = RGBColor(30, 120, 70);

struct Curve<'a> {
    name: &'static str,
    samples: &'a [f64],
    scale: f64,
    colour: RGBColor,
}

struct Panel<'a> {
    label: &'static str,
    curves: Vec<Curve<'a>>,
}

/// The backend draws on whole units; finer ones than pixels keep the curves smooth.
const FINE: u32 = 5;

/// Size of the picture in pixels.
const SIZE: (u32, u32) = (860, 960);

/// Draws the picture as SVG.
pub(crate) fn draw(path: &Path, outcome: &Outcome) -> Result<(), String> {
    let mut picture = String::new();
    draw_panels(&mut picture, outcome).map_err(|error| error.to_string())?;
    let (width, height) = SIZE;
    let fine = format!("width=\"{}\" height=\"{}\"", width * FINE, height * FINE);
    let shown = format!("width=\"{width}\" height=\"{height}\"");
    std::fs::write(path, picture.replacen(&fine, &shown, 1)).map_err(|error| error.to_string())
}

/// A length in pixels.
fn px(pixels: u32) -> u32 {
    pixels * FINE
}

/// A text of a height in pixels.
fn font(pixels: u32) -> (&'static str, u32) {
    ("sans-serif", px(pixels))
}

/// A place in pixels.
fn at(x: u32, y: u32) -> (i32, i32) {
    (px(x).cast_signed(), px(y).cast_signed())
}

fn draw_panels(picture: &mut String, outcome: &Outcome) -> Result<(), Box<dyn Error>> {
    let series = &outcome.series;
    let (
        Cause::Contact {
            model,
            scheme,
            results,
            ..
        },
        Some(striker),
    ) = (&outcome.cause, &series.striker)
    else {
        return Err("a record has no striker".into());
    };
    let results: &Results = results;
    let end_us = 1.12e6 * results.contact_time_s;
    let panels = [
        Panel {
            label: "force [kN]",
            curves: vec![Curve {
                name: "contact force P",
                samples: &series.force_n,
                scale: 1e-3,
                colour: BLACK,
            }],
        },
        Panel {
            label: "displacement [\u{b5}m]",
            curves: vec![
                Curve {
                    name: "striker h",
                    samples: &striker.displacement_m,
                    scale: 1e6,
                    colour: BLUE,
                },
                Curve {
                    name: "half-space w",
                    samples: &series.deflection_m,
                    scale: 1e6,
                    colour: RED,
                },
            ],
        },
        Panel {
            label: "velocity [m/s]",
            curves: vec![Curve {
                name: "striker v",
                samples: &striker.velocity_m_s,
                scale: 1.0,
                colour: GREEN,
            }],
        },
    ];
    let root = SVGBackend::with_string(picture, (px(SIZE.0), px(SIZE.1))).into_drawing_area();
    root.fill(&WHITE)?;
    let (head, body) = root.split_vertically(px(58));
    let title = TextStyle::from(font(21).into_font());
    let small = TextStyle::from(font(14).into_font());
    head.draw_text("Copper rod on a steel block, 100 m/s", &title, at(24, 12))?;
    head.draw_text(
        &format!(
            "peak force {:.1} kN, contact {:.2} \u{b5}s, restitution {:.4} (model {}, {})",
            results.peak_force_n / 1e3,
            1e6 * results.contact_time_s,
            results.restitution,
            model.name(),
            scheme.map_or("closed form", Choice::name)
        ),
        &small,
        at(24, 38),
    )?;
    for (area, panel) in body.split_evenly((3, 1)).iter().zip(&panels) {
        let (low, high) = range(panel, &series.time_s, end_us);
        let mut chart = ChartBuilder::on(area)
            .margin_top(px(12))
            .margin_right(px(28))
            .margin_left(px(12))
            .x_label_area_size(px(46))
            .y_label_area_size(px(66))
            .build_cartesian_2d(0.0..end_us, low..high)?;
        chart
            .configure_mesh()
            .x_desc("time [\u{b5}s]")
            .y_desc(panel.label)
            .light_line_style(WHITE)
            .bold_line_style(BLACK.mix(0.12).stroke_width(FINE))
            .label_style(font(14))
            .axis_desc_style(font(15))
            .x_label_formatter(&|x| format!("{x:.0}"))
            .y_label_formatter(&|y| format!("{y:.0}"))
            .axis_style(BLACK.stroke_width(FINE))
            .set_all_tick_mark_size(px(4))
            .y_labels(6)
            .x_labels(8)
            .draw()?;
        for curve in &panel.curves {
            let points = series
                .time_s
                .iter()
                .zip(curve.samples)
                .map(|(t, y)| (1e6 * t, curve.scale * y))
                .take_while(|(t, _)| *t <= end_us);
            let colour = curve.colour;
            chart
                .draw_series(LineSeries::new(points, colour.stroke_width(px(2))))?
                .label(curve.name)
                .legend(move |(x, y)| {
                    PathElement::new(
                        vec![(x, y), (x + px(22).cast_signed(), y)],
                        colour.stroke_width(px(2)),
                    )
                });
        }
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::UpperRight)
            .margin(px(10))
            .legend_area_size(px(30))
            .label_font(font(14))
            .background_style(WHITE.mix(0.85))
            .border_style(BLACK.mix(0.15).stroke_width(FINE))
            .draw()?;
    }
    root.present()?;
    Ok(())
}

/// Range of a panel with a little air.
fn range(panel: &Panel<'_>, time_s: &[f64], end_us: f64) -> (f64, f64) {
    let (mut low, mut high) = (0.0_f64, 0.0_f64);
    for curve in &panel.curves {
        for (t, y) in time_s.iter().zip(curve.samples) {
            if 1e6 * t <= end_us {
                low = low.min(curve.scale * y);
                high = high.max(curve.scale * y);
            }
        }
    }
    let air = 0.06 * (high - low).max(f64::MIN_POSITIVE);
    (if low < 0.0 { low - air } else { 0.0 }, high + air)
}
