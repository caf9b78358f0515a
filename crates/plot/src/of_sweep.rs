//! Figures of a sweep: lines, heat maps, losses, histograms.

use crate::error::PlotError;
use crate::kind::Kind;
use crate::labels::{stem, words};
use crate::request::{Drawn, Request};
use crate::sweep_view::{Slice, View, quantiles};
use contact::nearest;
use figure::{
    Axis, ColourMap, ColourScale, Figure, Histogram, Image, Layer, Legend, Panel, Scale, Shading,
    Style, Unit,
};
use formats::stored::{StoredQuantity, StoredSweep};

/// Results that are shown when none is asked for.
const USUAL: [&str; 4] = [
    "peak_force_n",
    "contact_time_s",
    "loss",
    "peak_displacement_m",
];

/// Curves in a panel, at most.
const MOST_CURVES: usize = 10;

/// Histograms in a panel, at most.
const MOST_HISTOGRAMS: usize = 4;

/// Values along a second axis from which on it is a heat map.
const MANY: usize = 7;

/// Shares of draws below the band, at its middle and below its upper end.
const SHARES: [f64; 3] = [0.05, 0.5, 0.95];

/// The key on the x axis of a picture of losses.
const VELOCITY: &str = "striker.velocity_m_s";

/// The figure of a sweep.
pub(crate) fn of_sweep(sweep: &StoredSweep, request: &Request) -> Result<Drawn, PlotError> {
    let view = View::new(sweep, request)?;
    let along = view.along(request.along.as_deref())?;
    let suits = if along.is_none() && view.drawn.is_some() {
        Kind::Histogram
    } else {
        Kind::Sweep
    };
    let kind = request.kind.unwrap_or(suits);
    let asked: Vec<String> = match (request.quantities.as_slice(), kind) {
        ([], Kind::Loss) => vec!["loss".to_owned()],
        ([], _) => USUAL.map(str::to_owned).to_vec(),
        (given, _) => given.to_vec(),
    };
    let quantities = chosen(sweep, &asked)?;
    let mut panels = Vec::new();
    for (i, quantity) in quantities.iter().enumerate() {
        let values = sweep.values(&quantity.name)?;
        let mut panel = match kind {
            Kind::Histogram => histogram(&view, quantity, &values)?,
            Kind::Loss => loss(&view, quantity, &values)?,
            _ => {
                let along = along.ok_or_else(|| PlotError::Absent {
                    path: sweep.path().to_owned(),
                    what: "key of numbers that varies",
                    hint: "a sweep over words alone has no axis to draw along; sweep --csv writes its rows",
                })?;
                over_keys(&view, along, request, quantity, &values)?
            }
        };
        if i > 0 {
            // a name has one look in all panels
            panel.legend = Legend::Off;
        }
        panels.push(panel);
    }
    let columns = if panels.len() > 1 { 2 } else { 1 };
    let title = request
        .title
        .clone()
        .unwrap_or_else(|| format!("Sweep {}", stem(sweep.path())));
    let rows: usize = sweep.axes.iter().map(|axis| axis.len).product();
    let mut figure = Figure::new(&title)
        .subtitle(&subtitle(&view, kind, rows))
        .columns(columns)
        .width(if columns == 1 { 760.0 } else { 1040.0 });
    figure.panels = panels;
    Ok(Drawn {
        figure,
        notes: Vec::new(),
    })
}

/// How many scenes, and what bands are.
fn subtitle(view: &View<'_>, kind: Kind, rows: usize) -> String {
    let mut text = format!("{rows} scenes");
    if view.sweep.failed > 0 {
        text.push_str(&format!(", {} of them failed", view.sweep.failed));
    }
    if let Some(axis) = view.drawn
        && kind != Kind::Histogram
    {
        let draws = view.sweep.axes[axis].len;
        text.push_str(&format!(
            "; median of {draws} draws, and where 90 % of them lie"
        ));
    }
    text
}

fn chosen(sweep: &StoredSweep, names: &[String]) -> Result<Vec<StoredQuantity>, PlotError> {
    let known = sweep.quantities();
    let find = |name: &String| {
        known
            .iter()
            .find(|q| q.name == *name)
            .cloned()
            .ok_or_else(|| {
                let all = || known.iter().map(|quantity| quantity.name.as_str());
                PlotError::Quantity {
                    path: sweep.path().to_owned(),
                    quantity: name.clone(),
                    suggestion: nearest(name, all()),
                    allowed: all().collect::<Vec<_>>().join(", "),
                }
            })
    };
    names.iter().map(find).collect()
}

/// A result in words: `peak_force_n` is "peak force".
fn result_words(quantity: &StoredQuantity) -> String {
    if quantity.name == "loss" {
        return "energy lost, 1 \u{2212} e^{2}".to_owned();
    }
    let ending = format!("_{}", quantity.unit.to_lowercase().replace(['/', ' '], "_"));
    let name = quantity
        .name
        .strip_suffix(&ending)
        .unwrap_or(&quantity.name);
    name.replace('_', " ")
}

/// Whether numbers are shown better by their ratios: all positive, and over a decade and a half.
fn scale_of(values: &[f64]) -> Scale {
    let known = || values.iter().copied().filter(|v| v.is_finite());
    let (low, high) = (
        known().fold(f64::INFINITY, f64::min),
        known().fold(0.0, f64::max),
    );
    if low > 0.0 && high > 30.0 * low {
        Scale::Logarithmic
    } else {
        Scale::Linear
    }
}

fn axis(name: &str, unit: &str, scale: Scale) -> Axis {
    let axis = match scale {
        Scale::Linear => Axis::linear(name),
        Scale::Logarithmic => Axis::logarithmic(name),
    };
    match unit {
        "1" | "" => axis,
        "kg" => axis.si("g"),
        "kg/m^3" => axis.unit("kg/m^{3}"),
        unit => axis.si(unit),
    }
}

/// Values in the unit that an axis has: grams for kilograms, which have a prefix already.
fn shown(places: &[f64], unit: &str) -> Vec<f64> {
    let factor = if unit == "kg" { 1e3 } else { 1.0 };
    places.iter().map(|x| factor * x).collect()
}

/// Lines over a key, or a heat map where a second key has many values.
fn over_keys(
    view: &View<'_>,
    along: usize,
    request: &Request,
    quantity: &StoredQuantity,
    values: &[f64],
) -> Result<Panel, PlotError> {
    let others = view.free().into_iter().filter(|&i| i != along);
    let second = others
        .filter(|&i| view.sweep.axes[i].len >= MANY && view.numbers(i, None).is_some())
        .max_by_key(|&i| view.sweep.axes[i].len);
    if let Some(second) = second
        && let [slice] = view.slices(&[along, second]).as_slice()
    {
        return Ok(heat_map(view, [along, second], slice, quantity, values));
    }
    lines(
        view,
        along,
        request.along.as_deref(),
        quantity,
        values,
        scale_of(values),
    )
}

fn lines(
    view: &View<'_>,
    along: usize,
    asked: Option<&str>,
    quantity: &StoredQuantity,
    values: &[f64],
    scale: Scale,
) -> Result<Panel, PlotError> {
    let slices = few(view, view.slices(&[along]), MOST_CURVES)?;
    let Some((column, places)) = view.numbers(along, asked) else {
        return Err(PlotError::NoNumbers {
            key: view.sweep.axes[along].name.clone(),
        });
    };
    let (name, unit) = words(&column.name);
    let places = shown(places, unit);
    let mut panel = Panel::new(
        axis(&name, unit, scale_of(&places)),
        axis(&result_words(quantity), &quantity.unit, scale),
    )
    .height(260.0);
    // values of a list or of a product need not rise
    let mut order: Vec<usize> = (0..places.len()).collect();
    order.sort_by(|&a, &b| places[a].total_cmp(&places[b]));
    let style = if places.len() <= 12 {
        Style::Marked
    } else {
        Style::Plain
    };
    for slice in &slices {
        let at = |&i: &usize| {
            let rows = view.rows(slice, &[(along, i)]);
            quantiles(rows.into_iter().map(|row| values[row]), SHARES).map(|q| (places[i], q))
        };
        let found: Vec<(f64, [f64; 3])> = order.iter().filter_map(at).collect();
        if view.drawn.is_some() {
            let band = found.iter().map(|&(x, q)| (x, q[0], q[2])).collect();
            panel = panel.band(&slice.label, band);
        }
        let middle = found.iter().map(|&(x, q)| (x, q[1])).collect();
        panel = panel.line(&slice.label, style, middle);
    }
    Ok(panel)
}

fn heat_map(
    view: &View<'_>,
    [along, second]: [usize; 2],
    slice: &Slice,
    quantity: &StoredQuantity,
    values: &[f64],
) -> Panel {
    let nodes = |number: usize| {
        let (name, unit, places) = view.numbers(number, None).map_or(
            (String::new(), "1", Vec::new()),
            |(column, places)| {
                let (name, unit) = words(&column.name);
                (name, unit, shown(places, unit))
            },
        );
        let mut order: Vec<usize> = (0..places.len()).collect();
        order.sort_by(|&a, &b| places[a].total_cmp(&places[b]));
        order.dedup_by(|a, b| places[*a] == places[*b]);
        (axis(&name, unit, scale_of(&places)), places, order)
    };
    let ((x, x_places, x_order), (y, y_places, y_order)) = (nodes(along), nodes(second));
    let mut image = Vec::new();
    for &j in &y_order {
        for &i in &x_order {
            let rows = view.rows(slice, &[(along, i), (second, j)]);
            let found = quantiles(rows.into_iter().map(|row| values[row]), SHARES);
            image.push(found.map_or(f64::NAN, |q| q[1]));
        }
    }
    let unit = match quantity.unit.as_str() {
        "1" | "" => Unit::One,
        unit => Unit::Si(unit.to_owned()),
    };
    let mut colours = ColourScale::new(&result_words(quantity), unit, ColourMap::Sequential);
    if scale_of(&image) == Scale::Logarithmic {
        colours = colours.logarithmic();
    }
    Panel::new(x, y).height(280.0).layer(Layer::Image(Image {
        x: x_order.iter().map(|&i| x_places[i]).collect(),
        y: y_order.iter().map(|&j| y_places[j]).collect(),
        values: image,
        shading: Shading::Smooth,
        colours,
    }))
}

/// Losses over the velocity of approach on logarithmic axes, with the slope of Hunter's law beside them.
fn loss(view: &View<'_>, quantity: &StoredQuantity, values: &[f64]) -> Result<Panel, PlotError> {
    let along = view.along(Some(VELOCITY))?.unwrap_or(0);
    let mut panel = lines(
        view,
        along,
        Some(VELOCITY),
        quantity,
        values,
        Scale::Logarithmic,
    )?;
    let (name, unit) = words(VELOCITY);
    panel.x = axis(&format!("{name} of approach"), unit, Scale::Logarithmic);
    panel = panel.height(380.0);
    let curves = panel.layers.iter().filter_map(|layer| match layer {
        Layer::Line(line) => Some(&line.points),
        _ => None,
    });
    let points: Vec<(f64, f64)> = curves.flatten().copied().filter(|p| p.1 > 0.0).collect();
    let ends = points.iter().fold((f64::INFINITY, 0.0_f64), |ends, p| {
        (ends.0.min(p.0), ends.1.max(p.0))
    });
    // above all curves, so that it crosses none of them
    let highest = points
        .iter()
        .map(|p| p.1 / p.0.powf(0.6))
        .fold(0.0, f64::max);
    if highest > 0.0 {
        let on = |v: f64| (v, 1.3 * highest * v.powf(0.6));
        panel = panel.line(
            "slope 3/5",
            Style::HeavyDashed,
            vec![on(ends.0), on(ends.1)],
        );
    }
    Ok(panel)
}

/// How often values occur, with their quantiles.
fn histogram(
    view: &View<'_>,
    quantity: &StoredQuantity,
    values: &[f64],
) -> Result<Panel, PlotError> {
    let slices = if view.drawn.is_some() {
        few(view, view.slices(&[]), MOST_HISTOGRAMS)?
    } else {
        Vec::new()
    };
    let scale = scale_of(values);
    let mut panel = Panel::new(
        axis(&result_words(quantity), &quantity.unit, scale),
        Axis::linear("scenes"),
    )
    .height(240.0);
    let of = |slice: &Slice| -> Vec<f64> {
        view.rows(slice, &[])
            .into_iter()
            .map(|row| values[row])
            .collect()
    };
    let groups: Vec<(String, Vec<f64>)> = match slices.as_slice() {
        // without draws all scenes are counted
        [] => vec![(String::new(), values.to_vec())],
        slices => slices
            .iter()
            .map(|slice| (slice.label.clone(), of(slice)))
            .collect(),
    };
    for (label, found) in &groups {
        let bins = (2.0 * (found.len() as f64).cbrt()).ceil().clamp(5.0, 60.0) as usize;
        panel = panel.layer(Layer::Histogram(Histogram::of(label, found, bins, scale)));
    }
    if let [(_, found)] = groups.as_slice()
        && let Some(quantiles) = quantiles(found.iter().copied(), SHARES)
    {
        for (place, name) in quantiles.into_iter().zip(["5 %", "median", "95 %"]) {
            panel = panel.mark(place, name);
        }
    }
    Ok(panel.legend(Legend::Auto))
}

/// Slices if they are few enough for one panel.
fn few(view: &View<'_>, slices: Vec<Slice>, most: usize) -> Result<Vec<Slice>, PlotError> {
    if slices.len() <= most {
        return Ok(slices);
    }
    let key = view
        .free()
        .into_iter()
        .find_map(|i| view.sweep.axes[i].columns.first());
    Err(PlotError::TooMany {
        path: view.sweep.path().to_owned(),
        count: slices.len(),
        most,
        key: key.map_or_else(String::new, |column| column.name.clone()),
    })
}
