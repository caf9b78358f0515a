//! Panels over time: the contact, and the fields at the probes.

use crate::error::{PlotError, chosen};
use crate::request::Request;
use crate::series::{curve, end_s, waves_of};
use crate::words::{axis, component, of_quantity, with_unit};
use figure::{Axis, Layer, Legend, Panel, Scale, Style};
use formats::quantities::Described;
use formats::stored::{StoredImpact, StoredProbes, StoredSensor};
use impact::{Impact, Series};

/// Number of probes that are shown together with a contact.
pub(super) const FEW_PROBES: usize = 3;

/// A quantity of a contact over time: its name in a file, its name in a panel of its own, its unit and its samples.
type OfContact = (
    &'static str,
    &'static str,
    &'static str,
    fn(&StoredImpact) -> Option<&Vec<f64>>,
);

/// All quantities of a contact.
const CONTACT: [OfContact; 4] = [
    ("force", "force", "N", |impact| Some(&impact.series.force_n)),
    (
        "displacement",
        "displacement of the striker",
        "m",
        |impact| Some(&impact.series.striker.as_ref()?.displacement_m),
    ),
    (
        "deflection",
        "deflection of the half-space",
        "m",
        |impact| Some(&impact.series.deflection_m),
    ),
    ("velocity", "velocity of the striker", "m/s", |impact| {
        Some(&impact.series.striker.as_ref()?.velocity_m_s)
    }),
];

/// Names of the quantities in a file.
pub(super) fn contact_names() -> [&'static str; 4] {
    CONTACT.map(|row| row.0)
}

/// An empty panel over a range of times.
fn over_time(quantity: &str, unit: &str, [from_s, to_s]: [f64; 2], legend: Legend) -> Panel {
    let time = Axis::linear("time").si("s").range(from_s, to_s);
    let value = axis(quantity, unit, Scale::Linear);
    Panel::new(time, value).height(210.0).legend(legend)
}

/// The time range of a picture of contacts: the requested one, or else that of the contacts.
fn contact_span_s(impacts: &[StoredImpact], request: &Request) -> Result<[f64; 2], PlotError> {
    let last_s = |of: fn(&Series) -> f64| {
        let ends = impacts.iter().map(|impact| of(&impact.series));
        ends.fold(0.0, f64::max)
    };
    match request.span_s {
        Some(_) => {
            request.span_within([0.0, last_s(|series| series.time_s[series.time_s.len() - 1])])
        }
        None => Ok([0.0, 1.1 * last_s(end_s)]),
    }
}

/// Panels of the contacts, one curve per impact, for the requested or else all quantities. A single impact is compared
/// with Hertz's force.
pub(super) fn contact_panels(
    impacts: &[StoredImpact],
    labels: &[String],
    request: &Request,
    asked: &[&str],
) -> Result<Vec<Panel>, PlotError> {
    let span_s = contact_span_s(impacts, request)?;
    let (single, part) = match impacts {
        [only] => (Some(only), deflection_part(impacts)),
        _ => (None, deflection_part(impacts)),
    };
    let legend = single.map_or(Legend::Off, |_| Legend::Auto);
    let mut panels: Vec<Panel> = Vec::new();
    for (name, quantity, unit, samples) in CONTACT {
        if !asked.is_empty() && !asked.contains(&name) {
            continue;
        }
        // a single impact has both displacements in one panel; several share a legend and colours in all panels
        let (quantity, curve_name) = match (single, asked, name) {
            (Some(_), [], "displacement") => ("displacement".to_owned(), "striker".to_owned()),
            (Some(_), [], "deflection") => ("displacement".to_owned(), format!("half-space{part}")),
            (Some(_), _, "force") => (quantity.to_owned(), "contact force".to_owned()),
            (_, _, "deflection") => (format!("{quantity}{part}"), String::new()),
            _ => (quantity.to_owned(), String::new()),
        };
        let mut panel = panels
            .pop_if(|panel| panel.y.quantity == quantity)
            .unwrap_or_else(|| over_time(&quantity, unit, span_s, legend));
        for (impact, label) in impacts.iter().zip(labels) {
            if let Some(samples) = samples(impact) {
                let name = single.map_or(label, |_| &curve_name);
                let points = curve(&impact.series.time_s, samples, span_s);
                panel = panel.line(name, Style::Plain, points);
            }
        }
        if panel.layers.is_empty() && !asked.is_empty() {
            let hint = "a force record has no striker";
            return Err(PlotError::absent(impacts[0].path(), name, hint));
        }
        panels.push(panel);
    }
    panels.retain(|panel| !panel.layers.is_empty());
    if let Some(first) = panels.first_mut() {
        first.legend = Legend::Auto;
    }
    let force = panels.iter_mut().find(|panel| panel.y.quantity == "force");
    if let (Some(only), Some(force)) = (single, force) {
        let hertz = hertz(only, span_s);
        let hertz = hertz.map(|points| Layer::line("Hertz, without waves", Style::Plain, points));
        let (speeds, start_s) = waves_of(only)?;
        // only if the size of the block is given
        let echo_s = speeds.first_echo_s(&only.target, [0.0; 2], 0.0);
        let echo = echo_s.map(|echo_s| Layer::mark(start_s + echo_s, "first echo"));
        force.layers.extend(hertz.into_iter().chain(echo));
        if let [Layer::Line(alone)] = force.layers.as_mut_slice() {
            // the axis already names a single curve
            alone.name.clear();
        }
    }
    Ok(panels)
}

/// Force over displacement of the striker, one curve per impact.
pub(super) fn loop_panel(impacts: &[StoredImpact], labels: &[String]) -> Result<Panel, PlotError> {
    let approach = Axis::linear("approach").si("m");
    let mut panel = Panel::new(approach, Axis::linear("force").si("N")).height(380.0);
    for (impact, label) in impacts.iter().zip(labels) {
        let series = &impact.series;
        let Some(striker) = &series.striker else {
            let hint = "a force record has no striker";
            return Err(PlotError::absent(impact.path(), "approach", hint));
        };
        let pairs = striker.displacement_m.iter().zip(&series.force_n);
        let pressed = |pair: &(&f64, &f64)| *pair.1 > 0.0;
        let points = pairs.clone().take(1).chain(pairs.filter(pressed));
        let points = points.map(|(&d, &p)| (d, p)).collect();
        let name = if impacts.len() > 1 { label } else { "" };
        panel = panel.line(name, Style::Plain, points);
    }
    Ok(panel)
}

/// Words for the part of the deflection in the files: Hertz's law may include the static part.
fn deflection_part(impacts: &[StoredImpact]) -> &'static str {
    let is_dynamic =
        |impact: &StoredImpact| match (impact.model.as_str(), impact.static_share.as_str()) {
            ("prescribed", _) => false,
            ("hertz" | "radiation" | "area_dashpot" | "growing", _) | (_, "dynamic") => true,
            _ => false,
        };
    let dynamic = impacts.iter().filter(|impact| is_dynamic(impact)).count();
    match dynamic {
        0 => "",
        count if count == impacts.len() => ", dynamic part",
        _ => ", for some impacts its dynamic part",
    }
}

/// Hertz's force for the same bodies, without waves and disc. None if the file has the model hertz or no striker.
fn hertz(impact: &StoredImpact, [from_s, to_s]: [f64; 2]) -> Option<Vec<(f64, f64)>> {
    const HERTZ_POINTS: u32 = 400;
    let strike = impact.strike.as_ref()?;
    if impact.model == "hertz" {
        return None;
    }
    let target = impact.target.clone();
    let same = Impact::new(target, strike.striker.clone(), strike.velocity_m_s);
    let run = same.without_waves().solve().ok()?;
    let time = |i: u32| from_s + (to_s - from_s) * f64::from(i) / f64::from(HERTZ_POINTS);
    let points = (0..=HERTZ_POINTS).map(|i| (time(i), run.excitation().force_n(time(i))));
    Some(points.collect())
}

/// One panel per probe of the first file, at most `most`, and the number of omitted probes. Other files add their
/// traces at the same place.
///
/// By default a single file shows both displacements, and several files the axial one.
pub(super) fn probe_panels(
    impacts: &[StoredImpact],
    labels: &[String],
    (request, quantities): (&Request, &[String]),
    most: usize,
) -> Result<(Vec<Panel>, usize), PlotError> {
    let mut files = Vec::new();
    for (impact, label) in impacts.iter().zip(labels) {
        if let Some(probes) = impact.probes()? {
            files.push((impact, label, probes));
        }
    }
    let Some((first, _, probes)) = files.first() else {
        return Ok((Vec::new(), 0));
    };
    let known = probes.quantities();
    let usual: &[&str] = match files.len() {
        1 => &["displacement_z", "displacement_r"],
        _ => &["displacement_z"],
    };
    // each axis has one unit
    let mut by_unit: Vec<Vec<&Described>> = Vec::new();
    for number in chosen(first.path(), &known, quantities, usual)? {
        let quantity = &known[number];
        match by_unit.iter_mut().find(|of| of[0].unit == quantity.unit) {
            Some(of_unit) => of_unit.push(quantity),
            None => by_unit.push(vec![quantity]),
        }
    }
    let count = probes.r_m.len().min(most);
    let time_s = &first.series.time_s;
    let span_s = request.span_within([0.0, time_s[time_s.len() - 1]])?;
    let mut panels = Vec::new();
    for of_unit in &by_unit {
        for probe in 0..count {
            let place = [probes.r_m[probe], probes.z_m[probe]];
            // the axis names a single curve; together with a contact the contact's legend names the impacts
            let is_told = of_unit.len() == 1
                && (files.len() == 1 || most == FEW_PROBES || !panels.is_empty());
            let legend = if is_told { Legend::Off } else { Legend::Auto };
            let mut panel = probe_panel(first, place, (of_unit, span_s), legend)?;
            for (impact, label, other) in &files {
                let mut all = other.r_m.iter().zip(&other.z_m);
                if let Some(found) = all.position(|(r_m, z_m)| [*r_m, *z_m] == place) {
                    let label = (files.len() > 1).then_some(label.as_str());
                    panel = with_traces(panel, impact, other, found, of_unit, label)?;
                }
            }
            panels.push(panel);
        }
    }
    Ok((panels, probes.r_m.len() - count))
}

/// A panel of a place with arrival times.
fn probe_panel(
    impact: &StoredImpact,
    [r_m, z_m]: [f64; 2],
    (shown, span_s): (&[&Described], [f64; 2]),
    legend: Legend,
) -> Result<Panel, PlotError> {
    let quantity = match shown {
        [single] => of_quantity(&single.name),
        // "displacement" of `displacement_z`
        several => several[0].name.split('_').take(1).collect(),
    };
    let panel = over_time(&quantity, &shown[0].unit, span_s, legend).title(&place(r_m, z_m));
    with_arrivals(panel, impact, [r_m, z_m])
}

/// Adds the arrivals at a place to a panel.
fn with_arrivals(
    mut panel: Panel,
    impact: &StoredImpact,
    [r_m, z_m]: [f64; 2],
) -> Result<Panel, PlotError> {
    let (speeds, start_s) = waves_of(impact)?;
    let radius_m = impact.number("disc_radius_m").unwrap_or(0.0);
    let arrivals_s = speeds.arrivals_s(r_m, z_m, radius_m);
    for (name, arrival_s) in ["P", "S", "R"].into_iter().zip(arrivals_s) {
        if arrival_s > 0.0 && arrival_s.is_finite() {
            panel = panel.mark(start_s + arrival_s, name);
        }
    }
    let echoes = speeds.echoes_s(&impact.target, [r_m, z_m], radius_m);
    // those with the fewest legs: more would hide each other
    let fewest = echoes.iter().map(|(name, _)| name.len()).min();
    for (name, echo_s) in echoes.iter().filter(|(name, _)| Some(name.len()) == fewest) {
        panel = panel.mark(start_s + echo_s, name);
    }
    if let Some(echo_s) = speeds.first_echo_s(&impact.target, [r_m, z_m], radius_m) {
        panel = panel.mark(start_s + echo_s, "valid until the echo");
    }
    Ok(panel)
}

/// One panel per sensor with its output, its error and the arrivals at the centre of its face.
pub(super) fn sensor_panels(
    impact: &StoredImpact,
    request: &Request,
) -> Result<Vec<Panel>, PlotError> {
    let sensors = impact.sensors()?;
    if sensors.is_empty() {
        let hint = "add a [[sensor]] with r_m and z_m to the scene";
        return Err(PlotError::absent(impact.path(), "sensors", hint));
    }
    let time_s = &impact.series.time_s;
    let span_s = request.span_within([0.0, time_s[time_s.len() - 1]])?;
    let panel = |sensor: &StoredSensor| {
        let quantity = sensor_words(sensor);
        let panel = over_time(&quantity, &sensor.unit, span_s, Legend::Off);
        let place_m = [sensor.r_m, sensor.z_m];
        let panel = with_arrivals(panel.title(&place(sensor.r_m, sensor.z_m)), impact, place_m)?;
        let [low, high] = [-1.0, 1.0].map(|sign| {
            let ends = sensor.output.iter().zip(&sensor.output_error);
            let ends = ends.map(|(own, error)| own + sign * error);
            curve(time_s, &ends.collect::<Vec<f64>>(), span_s)
        });
        let middle = curve(time_s, &sensor.output, span_s);
        let within = middle.iter().zip(low).zip(high);
        let within = within.map(|((&(t, y), (_, low)), (_, high))| (t, [low, y, high]));
        Ok(panel.banded("", Style::Plain, &within.collect::<Vec<_>>()))
    };
    sensors.iter().map(panel).collect()
}

/// Words for the output of a sensor.
pub(super) fn sensor_words(sensor: &StoredSensor) -> String {
    match sensor.has_response {
        true => "output of the sensor".to_owned(),
        false => format!("mean {}", of_quantity(&sensor.quantity)),
    }
}

/// Words for the place of a probe.
pub(super) fn place(r_m: f64, z_m: f64) -> String {
    let (r, z) = (with_unit(r_m, "m"), with_unit(z_m, "m"));
    match (r_m > 0.0, z_m > 0.0) {
        (false, false) => "at the centre of the contact".to_owned(),
        (true, false) => format!("on the surface, r = {r}"),
        (false, true) => format!("on the axis, z = {z}"),
        (true, true) => format!("r = {r}, z = {z}"),
    }
}

/// Adds the traces of a file at a probe to a panel.
fn with_traces(
    mut panel: Panel,
    impact: &StoredImpact,
    probes: &StoredProbes,
    probe: usize,
    shown: &[&Described],
    label: Option<&str>,
) -> Result<Panel, PlotError> {
    for quantity in shown {
        let name = match (label, shown.len()) {
            (None, _) => component(&quantity.name),
            (Some(label), 1) => label.to_owned(),
            (Some(label), _) => format!("{}, {label}", component(&quantity.name)),
        };
        let samples = probes.trace(&quantity.name, probe)?;
        if shown.len() > 1 && samples.iter().all(|&x| x == 0.0) {
            // radial components vanish on the axis
            continue;
        }
        let (from_s, to_s) = panel.x.range.unwrap_or((0.0, f64::INFINITY));
        let points = curve(&impact.series.time_s, &samples, [from_s, to_s]);
        panel = match probes.error(&quantity.name, probe) {
            Some(error) => {
                let within = points.iter().map(|&(t, y)| (t, [y - error, y, y + error]));
                panel.banded(&name, Style::Plain, &within.collect::<Vec<_>>())
            }
            None => panel.line(&name, Style::Plain, points),
        };
    }
    Ok(panel)
}
