//! Curves: histories, convergence, classes, histograms.

use crate::waves::{even, pulse};
use figure::{Axis, Classes, Figure, Interval, Layer, Legend, Line, Panel, Scale, Sharing, Style};

/// Panels over one time axis, with an error band and arrivals.
pub(crate) fn histories() -> Figure {
    let times = even(0.0, 32e-6, 400);
    let curve = |f: &dyn Fn(f64) -> f64| times.iter().map(|&t| (t, f(t))).collect::<Vec<_>>();
    let force = |t: f64| 159e3 * pulse(t, 27.2e-6);
    let striker = |t: f64| 1e-3 * (1.0 - ((t - 13.6e-6) / 15e-6).powi(2));
    let block = |t: f64| 0.14e-3 * pulse(t - 1e-6, 28e-6);
    let within = |t: f64| (t, [0.93 * force(t), force(t), 1.07 * force(t)]);
    let forces: Vec<_> = times.iter().map(|&t| within(t)).collect();
    let time = || Axis::linear("time").si("s").range(0.0, 32e-6);
    Figure::new("Copper rod on a steel block, 100 m/s")
        .subtitle("peak force 159 kN, contact 27.2 µs, restitution 0.981 (model wave, implicit)")
        .sharing(Sharing::X)
        .panel(
            Panel::new(time(), Axis::linear("force").si("N"))
                .height(190.0)
                .banded("contact force P", Style::Plain, &forces)
                .mark(2.0e-6, "P")
                .mark(3.7e-6, "S")
                .mark(4.0e-6, "R")
                .mark(27.2e-6, "end of contact")
                .mark(30.0e-6, "valid until here"),
        )
        .panel(
            Panel::new(time(), Axis::linear("displacement").si("m"))
                .height(190.0)
                .line("striker h", Style::Plain, curve(&striker))
                .line("half-space w", Style::Plain, curve(&block)),
        )
        .panel(
            Panel::new(time(), Axis::linear("velocity").si("m/s"))
                .height(190.0)
                .line("striker v", Style::Plain, curve(&|t| 100.0 - 7.4e6 * t)),
        )
}

/// Errors over steps on two logarithmic axes.
pub(crate) fn convergence() -> Figure {
    let steps: Vec<f64> = (0..12).map(|i| 0.2 * 0.5_f64.powi(i)).collect();
    let order = |name: &str, size: f64, power: i32| {
        let points = steps
            .iter()
            .map(|&h| (h, (size * h.powi(power)).max(3e-15)));
        Line::new(name, Style::Marked, points.collect())
    };
    let panel = Panel::new(
        Axis::logarithmic("step h").unit("t_{s}"),
        Axis::logarithmic("relative error of the peak force"),
    )
    .height(360.0)
    .layer(Layer::Line(order("explicit Euler", 0.7, 1)))
    .layer(Layer::Line(order("implicit, linear cells", 0.4, 2)))
    .layer(Layer::Line(order("implicit, curved cells", 0.3, 4)))
    .layer(Layer::Line(order("Gauss, 3 nodes a cell", 0.05, 6)))
    .line(
        "slope 2",
        Style::HeavyDashed,
        vec![(1e-4, 1.5e-9), (0.2, 6e-3)],
    );
    Figure::new("Order of convergence")
        .width(680.0)
        .panel(panel)
}

/// All styles, more curves than colours.
pub(crate) fn styles() -> Figure {
    let xs = even(0.0, 10.0, 25);
    let line = |i: usize| -> Vec<(f64, f64)> {
        let shift = 0.35 * i as f64;
        xs.iter().map(|&x| (x, (x - shift).sin() + shift)).collect()
    };
    let axes =
        || Panel::new(Axis::linear("x").unit("r_{0}"), Axis::linear("y")).legend(Legend::Outside);
    let mut plain = axes().title("lines").height(330.0);
    let mut marked = axes().title("markers").height(330.0);
    for i in 0..8 {
        let names = [
            "Talbot", "Euler", "CME", "Durbin", "Crump", "de Hoog", "Stehfest", "own",
        ];
        plain = plain.line(names[i], Style::Plain, line(i));
        marked = marked.line(names[i], Style::Points, line(i));
    }
    plain = plain
        .line("theory", Style::Heavy, line(9))
        .line("front", Style::HeavyDashed, line(10))
        .line("limit", Style::Dotted, line(11))
        .line("region", Style::Dots, line(12));
    Figure::new("Styles")
        .subtitle("curves of one name look the same in all panels")
        .columns(2)
        .width(960.0)
        .sharing(Sharing::Both)
        .panel(plain)
        .panel(marked)
}

/// A map of classes with boundaries from theory.
pub(crate) fn classes() -> Figure {
    let x = Interval::logarithmic(0.01, 1.0);
    let y = Interval::logarithmic(1e-4, 3.0);
    let names = ["hertz", "radiation", "growing", "not converged"];
    let class = |a: f64, b: f64| ((a * b).log10() + 5.0).clamp(0.0, 3.0) as usize;
    let (xs, ys) = (x.cells(60), y.cells(60));
    let row = |&b: &f64| xs.iter().map(move |&a| class(a, b));
    let map = Classes {
        shape: [60, 60],
        class: ys.iter().flat_map(row).collect(),
        names: names.map(str::to_owned).into(),
    };
    let line = |c: f64| {
        x.cells(50)
            .into_iter()
            .map(|a| (a, c / a))
            .collect::<Vec<_>>()
    };
    Figure::new("Cheapest model that meets 1e-3")
        .width(760.0)
        .panel(
            Panel::new(
                Axis::over(x, "static deflection of the half-space over indentation"),
                Axis::over(y, "memory over contact time"),
            )
            .height(400.0)
            .layer(Layer::Classes(map))
            .line("auto leaves hertz", Style::Heavy, line(1e-4))
            .line("auto leaves radiation", Style::HeavyDashed, line(1e-3))
            .layer(Layer::star((0.12, 0.08), "paper's case"))
            .layer(Layer::star((0.14, 0.09), "the same at 129 GPa"))
            .layer(Layer::star((0.98, 2.4), "corner")),
        )
}

/// Distributions, one of them over decades.
pub(crate) fn histograms() -> Figure {
    // a sum of uniform numbers from a fixed generator is nearly normal
    let mut state = 1_u64;
    let mut uniform = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut normal = || (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
    let first: Vec<f64> = (0..4000).map(|_| 0.72 + 0.03 * normal()).collect();
    let second: Vec<f64> = (0..3000).map(|_| 0.81 + 0.05 * normal()).collect();
    let errors: Vec<f64> = (0..5000)
        .map(|_| 10_f64.powf(-6.0 + 0.9 * normal()))
        .collect();
    Figure::new("Ten thousand impacts")
        .columns(2)
        .width(900.0)
        .panel(
            Panel::new(Axis::linear("restitution"), Axis::linear("impacts"))
                .layer(Layer::Line(Line::histogram(
                    "glass on steel",
                    &first,
                    40,
                    Scale::Linear,
                )))
                .layer(Layer::Line(Line::histogram(
                    "steel on steel",
                    &second,
                    40,
                    Scale::Linear,
                ))),
        )
        .panel(
            Panel::new(
                Axis::logarithmic("relative error"),
                Axis::logarithmic("impacts"),
            )
            .layer(Layer::Line(Line::histogram(
                "against the march",
                &errors,
                40,
                Scale::Logarithmic,
            ))),
        )
}

/// One column of a journal: 85 mm wide, small text.
pub(crate) fn column() -> Figure {
    let times = even(0.0, 60e-6, 200);
    let wave = |delay: f64| -> Vec<(f64, f64)> {
        let value =
            |t: f64| -2.1e8 * pulse(t - delay, 25e-6) + 4e7 * pulse(t - delay - 20e-6, 15e-6);
        times.iter().map(|&t| (t, value(t))).collect()
    };
    let mut figure = Figure::new("").width(321.0);
    figure.text = 9.5;
    figure.panel(
        Panel::new(
            Axis::linear("time").si("s"),
            Axis::linear("axial stress σ_{zz}").si("Pa"),
        )
        .height(170.0)
        .line("z = r_{0}", Style::Plain, wave(1e-6))
        .line("z = 2 r_{0}", Style::Plain, wave(4e-6))
        .line("z = 4 r_{0}", Style::Plain, wave(9e-6))
        .mark(4e-6, "P")
        .mark(7.4e-6, "S")
        .mark(8.0e-6, "R"),
    )
}
