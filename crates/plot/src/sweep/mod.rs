//! Figures of a sweep: lines, heat maps, losses, histograms; `view` selects the data.

mod view;

use crate::error::{Drawn, PlotError, chosen};
use crate::request::{PictureKind, Request};
use crate::words::{axis, of_key, stem};
use contact::fall_velocity_m_s;
use figure::{Axis, ColourMap, Figure, Image, Layer, Legend, Line, Panel, Scale, Style};
use formats::quantities::Described;
use formats::stored::StoredSweep;
use std::path::Path;
use view::{SweepSlice, View, quantiles};

/// Results that are shown by default.
const USUAL: [&str; 4] = [
    "peak_force_n",
    "contact_time_s",
    "loss",
    "peak_displacement_m",
];

/// Largest number of curves in a panel.
const MOST_CURVES: usize = 10;

/// Largest number of histograms in a panel.
const MOST_HISTOGRAMS: usize = 4;

/// Largest number of draws that are shown as points; more are shown in bins.
const MOST_POINTS: usize = 400;

/// Number of bins of draws.
const BINS: usize = 20;

/// Number of values of a second axis from which a heat map is drawn.
const MANY: usize = 7;

/// The key on the x axis of losses and restitution: a velocity, or the height that determines it.
const VELOCITY: &str = "striker.velocity_m_s";
const DROP_HEIGHT: &str = "striker.drop_height_m";

/// Result that is above 1 if a body yields.
const YIELD_ONSET: &str = "yield_onset";

/// Result by which the velocity is divided in pictures of restitution, if a sweep has it.
const AT_YIELD: &str = "yield_velocity_m_s";

/// A result of all rows of a sweep, with its axis.
struct SweptQuantity<'a> {
    view: &'a View<'a>,
    axis: Axis,
    values: Vec<f64>,
}

impl SweptQuantity<'_> {
    /// Quantiles over the draws of a slice at a place along the shown axes; without draws those of a single value.
    fn quantiles(&self, slice: &SweepSlice, at: &[(usize, usize)]) -> Option<[f64; 3]> {
        let rows = self.view.rows(slice, at).into_iter();
        quantiles(rows.map(|row| self.values[row]))
    }
}

/// Pictures of a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum SweepPicture {
    OverKeys,
    Loss,
    Restitution,
    Histogram,
}

impl SweepPicture {
    /// The picture of a kind; kinds for other files do not reach this function.
    fn of(kind: PictureKind) -> Self {
        match kind {
            PictureKind::Loss => Self::Loss,
            PictureKind::Restitution => Self::Restitution,
            PictureKind::Histogram => Self::Histogram,
            PictureKind::Sweep
            | PictureKind::Impact
            | PictureKind::Loop
            | PictureKind::Probes
            | PictureKind::Sensors
            | PictureKind::Spectrum
            | PictureKind::Waves
            | PictureKind::Peak
            | PictureKind::Surface
            | PictureKind::Depth
            | PictureKind::Axis
            | PictureKind::Errors => Self::OverKeys,
        }
    }
}

/// The figure of a sweep, with notes for the user.
pub(crate) fn of_sweep(path: &Path, request: &Request) -> Drawn<Figure> {
    let sweep = &StoredSweep::open(path)?;
    let view = View::new(sweep, request)?;
    let along = view.along(request.along.as_deref())?;
    let suits = match (along, view.drawn) {
        (None, Some(_)) => PictureKind::Histogram,
        (Some(_), _) | (None, None) => PictureKind::Sweep,
    };
    let picture = SweepPicture::of(request.kind_or(suits)?);
    let (along, usual): (_, &[&str]) = match picture {
        // if only draws vary, over the first of their keys
        SweepPicture::OverKeys => (along.or(view.drawn), &USUAL),
        SweepPicture::Loss => (along, &["loss"]),
        SweepPicture::Restitution => (along, &["restitution"]),
        SweepPicture::Histogram => (along, &USUAL),
    };
    let known = sweep.quantities();
    let rows = view.shown();
    let mut panels = Vec::new();
    for number in chosen(path, &known, &request.quantities, usual)? {
        let quantity = &known[number];
        let values = sweep.values(&quantity.name)?;
        let shown: Vec<f64> = rows.iter().map(|&row| values[row]).collect();
        let usual = scale_of(&shown);
        let scale = request.scale.unwrap_or(usual);
        let axis = axis(&result_words(quantity), &quantity.unit, scale);
        let view = &view;
        let shown = SweptQuantity { view, axis, values };
        let mut panel = match picture {
            SweepPicture::Histogram => histogram(&shown)?,
            SweepPicture::Loss => loss(&shown)?,
            SweepPicture::Restitution => restitution(&shown)?,
            SweepPicture::OverKeys => {
                let along = along.ok_or_else(|| PlotError::NoAxis(path.to_owned()))?;
                over_keys(&shown, along, request)?
            }
        };
        if !panels.is_empty() {
            // each name looks the same in all panels
            panel.legend = Legend::Off;
        }
        panels.push(panel);
    }
    let subtitle = subtitle(&view, (picture, along), &rows)?;
    let columns = if panels.len() == 1 { 1 } else { 2 };
    let title = title(path, sweep);
    let figure = request.figure(&title, &subtitle, columns);
    Ok((figure.panels(panels), Vec::new()))
}

/// The name of a sweep and the keys that vary.
fn title(path: &Path, sweep: &StoredSweep) -> String {
    /// Largest number of keys in a title.
    const MOST_TITLE_KEYS: usize = 4;
    let columns = sweep.axes.iter().flat_map(|axis| &axis.columns);
    let keys: Vec<String> = columns.map(|column| of_key(&column.name()).0).collect();
    let more = if keys.len() > MOST_TITLE_KEYS {
        ", ..."
    } else {
        ""
    };
    let named = keys[..keys.len().min(MOST_TITLE_KEYS)].join(", ");
    format!("Sweep {} over {named}{more}", stem(path))
}

/// Number of scenes, of failures and of yielding contacts, and meaning of the bands.
fn subtitle(
    view: &View<'_>,
    (picture, along): (SweepPicture, Option<usize>),
    shown: &[usize],
) -> Result<String, PlotError> {
    let rows: usize = view.sweep.axes.iter().map(|axis| axis.len).product();
    let count = shown.len();
    let mut text = match count == rows {
        true => format!("{rows} scenes"),
        false => format!("{count} of {rows} scenes"),
    };
    if view.sweep.failed > 0 {
        let of = if count == rows { "of them" } else { "of all" };
        text.push_str(&format!(", {} {of} failed", view.sweep.failed));
    }
    let mut known = view.sweep.quantities().into_iter();
    if known.any(|quantity| quantity.name == YIELD_ONSET) {
        let onset = view.sweep.values(YIELD_ONSET)?;
        let yielding = shown.iter().filter(|&&row| onset[row] > 1.0).count();
        if yielding > 0 {
            text.push_str(&format!(", {yielding} of {count} yield"));
        }
    }
    if let Some(held) = view.held() {
        text.push_str(&format!(", held: {held}"));
    }
    if let Some(axis) = view.drawn
        && picture != SweepPicture::Histogram
    {
        let draws = view.sweep.axes[axis].len;
        text.push_str(&match along == Some(axis) {
            false => format!("; median and 90 % band of {draws} draws"),
            true if draws <= MOST_POINTS => format!("; {draws} draws"),
            true => format!("; {draws} draws in {BINS} bins: median and 90 % band"),
        });
    }
    Ok(text)
}

/// A result in words: `peak_force_n` is "peak force".
fn result_words(quantity: &Described) -> String {
    if quantity.name == "loss" {
        return "energy lost, 1 \u{2212} e^{2}".to_owned();
    }
    let ending = format!("_{}", quantity.unit.to_lowercase().replace(['/', ' '], "_"));
    let name = quantity.name.as_str();
    name.strip_suffix(&ending).unwrap_or(name).replace('_', " ")
}

/// A logarithmic scale for positive values over more than a decade and a half, linear otherwise.
fn scale_of(values: &[f64]) -> Scale {
    let known = || values.iter().copied().filter(|v| v.is_finite());
    let low = known().fold(f64::INFINITY, f64::min);
    match low > 0.0 && known().fold(0.0, f64::max) > 30.0 * low {
        true => Scale::Logarithmic,
        false => Scale::Linear,
    }
}

/// The numbers of the requested key along an axis of a sweep, and their axis in a picture, which is linear on request.
fn nodes(
    view: &View<'_>,
    number: usize,
    (asked, scale): (Option<&str>, Option<Scale>),
) -> Result<(Axis, Vec<f64>), PlotError> {
    let Some((column, values)) = view.numbers(number, asked) else {
        return Err(PlotError::no_numbers(&view.sweep.axes[number].name));
    };
    let (name, unit) = of_key(&column.name());
    // grams instead of kilograms, which have a prefix already
    let factor = if unit == "kg" { 1e3 } else { 1.0 };
    let nodes: Vec<f64> = values.iter().map(|x| factor * x).collect();
    let linear = scale.filter(|scale| *scale == Scale::Linear);
    let scale = linear.unwrap_or_else(|| scale_of(&nodes));
    Ok((axis(&name, unit, scale), nodes))
}

/// Nodes with their indices, ascending: the values of a list or of a product may have any order.
fn rising(nodes: &[f64]) -> Vec<(usize, f64)> {
    let mut rising: Vec<(usize, f64)> = nodes.iter().copied().enumerate().collect();
    rising.sort_by(|a, b| a.1.total_cmp(&b.1));
    rising
}

/// Lines over a key, or a heat map if a second key has many values.
fn over_keys(
    shown: &SweptQuantity<'_>,
    along: usize,
    request: &Request,
) -> Result<Panel, PlotError> {
    let view = shown.view;
    let others = view.free().into_iter().filter(|&i| i != along);
    let second = others
        .filter(|&i| view.sweep.axes[i].len >= MANY && view.numbers(i, None).is_some())
        .max_by_key(|&i| view.sweep.axes[i].len);
    if let Some(second) = second
        && let [slice] = view.slices(&[along, second]).as_slice()
    {
        return heat_map(shown, [along, second], slice, request.scale);
    }
    lines(shown, along, (request.along.as_deref(), request.scale))
}

fn lines(
    shown: &SweptQuantity<'_>,
    along: usize,
    asked: (Option<&str>, Option<Scale>),
) -> Result<Panel, PlotError> {
    let view = shown.view;
    let slices = few(view, &[along], MOST_CURVES)?;
    let (axis, nodes) = nodes(view, along, asked)?;
    let mut panel = Panel::new(axis, shown.axis.clone());
    let style = match nodes.len() {
        ..=12 => Style::Marked,
        _ => Style::Plain,
    };
    if view.drawn == Some(along) {
        for slice in &slices {
            panel = over_draws(panel, shown, slice, &nodes);
        }
        return Ok(panel);
    }
    for slice in &slices {
        let at = |(i, x)| Some((x, shown.quantiles(slice, &[(along, i)])?));
        let found: Vec<(f64, [f64; 3])> = rising(&nodes).into_iter().filter_map(at).collect();
        panel = match view.drawn {
            Some(_) => panel.banded(&slice.label, style, &found),
            None => {
                let middle = found.iter().map(|&(x, q)| (x, q[1])).collect();
                panel.line(&slice.label, style, middle)
            }
        };
    }
    Ok(panel)
}

/// Draws over one of their keys: points, or for many draws the median and 90 % band in bins of equal counts.
fn over_draws(panel: Panel, shown: &SweptQuantity<'_>, slice: &SweepSlice, nodes: &[f64]) -> Panel {
    let rows = shown.view.rows(slice, &[]);
    let pairs = nodes
        .iter()
        .zip(rows)
        .map(|(x, row)| (*x, shown.values[row]));
    let mut pairs: Vec<(f64, f64)> = pairs.filter(|pair| pair.1.is_finite()).collect();
    if pairs.len() <= MOST_POINTS {
        return panel.line(&slice.label, Style::Points, pairs);
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let of = |bin: &[(f64, f64)]| {
        let [_, x, _] = quantiles(bin.iter().map(|pair| pair.0))?;
        Some((x, quantiles(bin.iter().map(|pair| pair.1))?))
    };
    let bins = pairs.chunks(pairs.len().div_ceil(BINS)).filter_map(of);
    panel.banded(&slice.label, Style::Marked, &bins.collect::<Vec<_>>())
}

fn heat_map(
    shown: &SweptQuantity<'_>,
    axes: [usize; 2],
    slice: &SweepSlice,
    scale: Option<Scale>,
) -> Result<Panel, PlotError> {
    let [along, second] = axes;
    let nodes = |axis| nodes(shown.view, axis, (None, scale));
    let ((mut x_axis, x), (y_axis, y)) = (nodes(along)?, nodes(second)?);
    let [x, y] = [x, y].map(|nodes| {
        let mut distinct = rising(&nodes);
        distinct.dedup_by(|a, b| a.1 == b.1);
        distinct
    });
    let mut values = Vec::new();
    for &(j, _) in &y {
        for &(i, _) in &x {
            let found = shown.quantiles(slice, &[(along, i), (second, j)]);
            values.push(found.map_or(f64::NAN, |q| q[1]));
        }
    }
    let mut colours = shown.axis.clone();
    colours.scale = scale.unwrap_or_else(|| scale_of(&values));
    let [columns, rows] =
        [x, y].map(|nodes| nodes.into_iter().map(|node| node.1).collect::<Vec<_>>());
    // few values are not interpolated: each has its own column, and the axis has room below the first
    let has_cells = columns.len() < MANY;
    if has_cells {
        x_axis.scale = Scale::Linear;
    }
    let image = Image {
        has_cells,
        ..Image::new(columns, rows, values, colours, ColourMap::Sequential)
    };
    let panel = Panel::new(x_axis, y_axis).height(280.0);
    Ok(panel.layer(Layer::Image(image)))
}

/// Results over the velocity of approach, on logarithmic axes.
fn over_velocity(shown: &SweptQuantity<'_>) -> Result<Panel, PlotError> {
    let axes = &shown.view.sweep.axes;
    let mut columns = axes.iter().flat_map(|axis| &axis.columns);
    let is_height = columns.any(|column| column.name() == DROP_HEIGHT);
    let key = if is_height { DROP_HEIGHT } else { VELOCITY };
    let along = shown.view.along(Some(key))?.unwrap_or(0);
    let mut panel = lines(shown, along, (Some(key), None))?;
    if is_height {
        for point in points_of(&mut panel) {
            point.0 = fall_velocity_m_s(point.0);
        }
        for layer in &mut panel.layers {
            if let Layer::Line(line) = layer {
                let band = line.band.iter_mut().flatten();
                band.for_each(|point| point.0 = fall_velocity_m_s(point.0));
            }
        }
    }
    panel.y.scale = Scale::Logarithmic;
    panel.x = axis("velocity of approach", "m/s", Scale::Logarithmic);
    Ok(panel.height(380.0))
}

/// The points of the curves of a panel.
fn points_of(panel: &mut Panel) -> impl Iterator<Item = &mut (f64, f64)> {
    let curves = panel.layers.iter_mut().filter_map(|layer| match layer {
        Layer::Line(line) => Some(&mut line.points),
        Layer::Image(_) | Layer::Classes(_) | Layer::Mark { .. } | Layer::Point { .. } => None,
    });
    curves.flatten()
}

/// Losses over the velocity of approach, with the slope of Hunter's law.
fn loss(shown: &SweptQuantity<'_>) -> Result<Panel, PlotError> {
    let mut panel = over_velocity(shown)?;
    let (mut first, mut last) = (f64::INFINITY, 0.0_f64);
    let (mut lowest, mut highest) = (f64::INFINITY, 0.0_f64);
    for &mut (x, y) in points_of(&mut panel).filter(|p| p.1 > 0.0) {
        (first, last) = (first.min(x), last.max(x));
        let factor = y / x.powf(0.6);
        (lowest, highest) = (lowest.min(factor / 1.3), highest.max(1.3 * factor));
    }
    if highest > 0.0 {
        // above all curves, or below them if it would exceed the possible losses, so that it crosses none
        let leaves = highest * last.powf(0.6) > 1.0;
        let factor = if leaves { lowest } else { highest };
        let on = |v: f64| (v, factor * v.powf(0.6));
        panel = panel.line("slope 3/5", Style::HeavyDashed, vec![on(first), on(last)]);
    }
    Ok(panel)
}

/// Restitution over the velocity of approach; with a plasticity law, relative to the velocity at the onset of yield of
/// the first row, with Johnson's slope.
fn restitution(shown: &SweptQuantity<'_>) -> Result<Panel, PlotError> {
    let mut panel = over_velocity(shown)?;
    let sweep = shown.view.sweep;
    let mut known = sweep.quantities().into_iter();
    let is_told = known.any(|quantity| quantity.name == AT_YIELD);
    let at_yield = is_told.then(|| sweep.values(AT_YIELD)).transpose()?;
    let Some(yields) = at_yield.into_iter().flatten().find(|v| v.is_finite()) else {
        return Ok(panel);
    };
    let name = "velocity of approach over velocity at yield";
    panel.x = axis(name, "1", Scale::Logarithmic);
    let mut last = (0.0, f64::INFINITY);
    for point in points_of(&mut panel) {
        point.0 /= yields;
        if point.0 > last.0 || point.0 == last.0 && point.1 < last.1 {
            last = *point;
        }
    }
    // below all curves
    let on = |x: f64| (x, 0.9 * last.1 * (x / last.0).powf(-0.25));
    let ends = vec![on(0.03 * last.0), on(last.0)];
    Ok(panel.line("slope -1/4", Style::HeavyDashed, ends))
}

/// Histograms, with quantiles if the values are random draws; quantiles of a designed sweep have no meaning.
fn histogram(shown: &SweptQuantity<'_>) -> Result<Panel, PlotError> {
    let view = shown.view;
    let scale = shown.axis.scale;
    let mut panel = Panel::new(shown.axis.clone(), Axis::linear("scenes")).height(240.0);
    let values = |rows: Vec<usize>| rows.into_iter().map(|row| shown.values[row]).collect();
    let groups: Vec<(String, Vec<f64>)> = match view.drawn {
        Some(_) => {
            let slices = few(view, &[], MOST_HISTOGRAMS)?.into_iter();
            let of = |slice: SweepSlice| {
                let found = values(view.rows(&slice, &[]));
                (slice.label, found)
            };
            slices.map(of).collect()
        }
        None => vec![(String::new(), values(view.shown()))],
    };
    for (label, found) in &groups {
        let bins = (2.0 * (found.len() as f64).cbrt()).ceil().clamp(5.0, 60.0) as usize;
        panel = panel.layer(Layer::Line(Line::histogram(label, found, bins, scale)));
    }
    if let [(_, found)] = groups.as_slice()
        && view.drawn.is_some()
        && let Some(quantiles) = quantiles(found.iter().copied())
    {
        for (place, name) in quantiles.into_iter().zip(["5 %", "median", "95 %"]) {
            panel = panel.mark(place, name);
        }
    }
    Ok(panel)
}

/// The slices along the axes that are not shown, if one panel has room for them.
fn few(view: &View<'_>, shown: &[usize], most: usize) -> Result<Vec<SweepSlice>, PlotError> {
    let slices = view.slices(shown);
    if slices.len() <= most {
        return Ok(slices);
    }
    Err(PlotError::TooManyCurves {
        file: view.sweep.path().to_owned(),
        curves: slices.len(),
        most,
        example: view.example(shown),
    })
}
