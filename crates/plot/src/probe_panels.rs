//! Histories at the probes, with arrivals, error bands and the end of validity.

use crate::error::PlotError;
use crate::history::curve;
use crate::number::with_unit;
use crate::quantity::words;
use crate::span::onset_s;
use contact::WaveSpeeds;
use contact::nearest;
use figure::{Axis, Legend, Panel, Style};
use formats::stored::{StoredImpact, StoredProbes, StoredQuantity};
use impact::FieldsError;

/// Probes that are shown beside a contact.
pub(crate) const FEW: usize = 3;

/// Height of a panel in pixels.
const HEIGHT: f64 = 210.0;

/// Panels of probes, and how many there is no panel of.
pub(crate) struct ProbePanels {
    pub(crate) panels: Vec<Panel>,
    pub(crate) left_out: usize,
}

/// One panel a probe of the first file, `most` at most; other files add their traces at the same place.
///
/// Without names of quantities both displacements of a single file are shown, and the axial one of several.
pub(crate) fn probe_panels(
    impacts: &[StoredImpact],
    labels: &[String],
    quantities: &[String],
    most: usize,
) -> Result<ProbePanels, PlotError> {
    let mut files = Vec::new();
    for (impact, label) in impacts.iter().zip(labels) {
        if let Some(probes) = impact.probes()? {
            files.push((impact, label, probes));
        }
    }
    let Some((first, _, probes)) = files.first() else {
        return Ok(ProbePanels {
            panels: Vec::new(),
            left_out: 0,
        });
    };
    let usual: &[&str] = match files.len() {
        1 => &["displacement_z", "displacement_r"],
        _ => &["displacement_z"],
    };
    let names: Vec<String> = match quantities {
        [] => usual.iter().map(|&name| name.to_owned()).collect(),
        given => given.to_vec(),
    };
    let shown = chosen(first, probes, &names)?;
    let count = probes.r_m.len().min(most);
    let mut panels = Vec::new();
    for unit in units(&shown) {
        let of_unit: Vec<&StoredQuantity> = shown.iter().filter(|q| q.unit == unit).collect();
        for probe in 0..count {
            let place = [probes.r_m[probe], probes.z_m[probe]];
            // beside a contact its legend says which impact is which
            let is_told =
                files.len() > 1 && of_unit.len() == 1 && (most == FEW || !panels.is_empty());
            let legend = if is_told { Legend::Off } else { Legend::Auto };
            let mut panel = empty(first, place, &of_unit, legend)?;
            for (impact, label, other) in &files {
                let at = |i: &usize| [other.r_m[*i], other.z_m[*i]] == place;
                if let Some(found) = (0..other.r_m.len()).find(at) {
                    let single = (files.len() > 1).then_some(label.as_str());
                    panel = with_traces(panel, impact, other, found, &of_unit, single)?;
                }
            }
            panels.push(panel);
        }
    }
    Ok(ProbePanels {
        panels,
        left_out: probes.r_m.len() - count,
    })
}

/// The quantities of some names.
fn chosen(
    impact: &StoredImpact,
    probes: &StoredProbes,
    names: &[String],
) -> Result<Vec<StoredQuantity>, PlotError> {
    let known = probes.quantities();
    let find = |name: &String| {
        let found = known.iter().find(|quantity| quantity.name == *name);
        found.cloned().ok_or_else(|| {
            let all = || known.iter().map(|quantity| quantity.name.as_str());
            PlotError::Quantity {
                path: impact.path().to_owned(),
                quantity: name.clone(),
                suggestion: nearest(name, all()),
                allowed: all().collect::<Vec<_>>().join(", "),
            }
        })
    };
    names.iter().map(find).collect()
}

/// Units in the order of their first appearance: one axis has one unit.
fn units(shown: &[StoredQuantity]) -> Vec<String> {
    let mut units: Vec<String> = Vec::new();
    for quantity in shown {
        if !units.contains(&quantity.unit) {
            units.push(quantity.unit.clone());
        }
    }
    units
}

/// A panel of a place with its arrivals.
fn empty(
    impact: &StoredImpact,
    [r_m, z_m]: [f64; 2],
    shown: &[&StoredQuantity],
    legend: Legend,
) -> Result<Panel, PlotError> {
    let quantity = match shown {
        [single] => words(&single.name),
        [first, ..] => kind(&first.name),
        [] => String::new(),
    };
    let unit = shown.first().map_or("", |q| q.unit.as_str());
    let series = &impact.series;
    let last_s = series.time_s[series.time_s.len() - 1];
    let time = Axis::linear("time").si("s").range(0.0, last_s);
    let mut panel = Panel::new(time, Axis::linear(&quantity).si(unit))
        .title(&place(r_m, z_m))
        .height(HEIGHT)
        .legend(legend);
    let target = &impact.scene.target;
    let speeds = WaveSpeeds::of(target).map_err(FieldsError::from)?;
    let start_s = onset_s(&series.time_s, &series.force_n);
    let radius_m = impact.number("disc_radius_m").unwrap_or(0.0);
    let arrivals_s = speeds.arrivals_s(r_m, z_m, radius_m);
    for (name, arrival_s) in ["P", "S", "R"].into_iter().zip(arrivals_s) {
        if arrival_s > 0.0 && arrival_s.is_finite() {
            panel = panel.mark(start_s + arrival_s, name);
        }
    }
    if let Some(echo_s) = speeds.first_echo_s(target, [r_m, z_m], radius_m) {
        panel = panel.mark(start_s + echo_s, "valid until the echo");
    }
    Ok(panel)
}

/// Where a probe is.
fn place(r_m: f64, z_m: f64) -> String {
    match (r_m > 0.0, z_m > 0.0) {
        (false, false) => "at the centre of the contact".to_owned(),
        (true, false) => format!("on the surface, r = {}", with_unit(r_m, "m")),
        (false, true) => format!("on the axis, z = {}", with_unit(z_m, "m")),
        (true, true) => format!("r = {}, z = {}", with_unit(r_m, "m"), with_unit(z_m, "m")),
    }
}

fn with_traces(
    mut panel: Panel,
    impact: &StoredImpact,
    probes: &StoredProbes,
    probe: usize,
    shown: &[&StoredQuantity],
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
            // on the axis, where nothing is radial
            continue;
        }
        let points = curve(&impact.series.time_s, &samples, f64::INFINITY);
        if let Some(error) = probes.error(&quantity.name, probe) {
            let band = points.iter().map(|&(t, y)| (t, y - error, y + error));
            panel = panel.band(&name, band.collect());
        }
        panel = panel.line(&name, Style::Plain, points);
    }
    Ok(panel)
}

/// What a quantity of several components is: "displacement" of `displacement_z`.
fn kind(name: &str) -> String {
    let kind = name.split('_').next().unwrap_or(name);
    kind.to_owned()
}

/// Name of a component for the legend: "axial u_{z}".
fn component(name: &str) -> String {
    let (kind, component) = name.rsplit_once('_').unwrap_or((name, ""));
    let symbol = match kind {
        "displacement" => "u",
        "velocity" => "v",
        "acceleration" => "a",
        "stress" => "σ",
        _ => return name.replace('_', " "),
    };
    let direction = match component {
        "r" | "rr" => "radial",
        "z" | "zz" => "axial",
        "tt" => "hoop",
        "rz" => "shear",
        _ => return name.replace('_', " "),
    };
    format!("{direction} {symbol}_{{{component}}}")
}
