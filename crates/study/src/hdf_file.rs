//! chart.h5: the rows of chart.csv and the numbers behind every picture. Described in data-schema/chart.md.

use crate::chart::Chart;
use crate::csv_file::COLUMNS;
use crate::measure::Effort;
use crate::picture::Picture;
use crate::record::Record;
use figure::{Axis, Scale};
use hdf5::types::VarLenUnicode;
use hdf5::{File, Group, Location};
use std::path::Path;

/// Value of the attribute `file_type`.
pub const FILE_TYPE: &str = "hertzlamb chart";

/// Value of the attribute `format_version`.
pub const FORMAT_VERSION: &str = "1.0";

/// Names of the root's attributes.
pub const ATTRIBUTES: [&str; 6] = [
    "file_type",
    "format_version",
    "software_version",
    "machine",
    "effort",
    "wall_s",
];

/// Group of the pictures.
pub const FIGURES: &str = "figures";

pub(crate) fn write(path: &Path, chart: &Chart) -> Result<(), String> {
    write_file(path, chart).map_err(|error| lookup::labels::reason(&error))
}

fn write_file(path: &Path, chart: &Chart) -> Result<(), hdf5::Error> {
    let file = lookup::labels::new_file().create(path)?;
    let effort = match chart.effort {
        Effort::Quick => "quick",
        Effort::Full => "full",
    };
    let texts = [
        FILE_TYPE,
        FORMAT_VERSION,
        env!("CARGO_PKG_VERSION"),
        &chart.machine.line(),
        effort,
    ];
    for (name, value) in ATTRIBUTES.into_iter().zip(texts) {
        text(&file, name, value)?;
    }
    number(&file, ATTRIBUTES[5], chart.wall_s)?;
    rows(&file, &chart.records)?;
    let group = file.create_group(FIGURES)?;
    for figure in chart.diagrams.iter().chain(&chart.maps) {
        picture(&group.create_group(figure.name)?, figure)?;
    }
    file.flush()?;
    file.close()
}

fn rows(file: &File, records: &[Record]) -> Result<(), hdf5::Error> {
    let strings = |f: &dyn Fn(&Record) -> String| records.iter().map(f).collect::<Vec<_>>();
    let numbers = |f: &dyn Fn(&Record) -> f64| records.iter().map(f).collect::<Vec<_>>();
    let flags =
        |f: &dyn Fn(&Record) -> bool| records.iter().map(|r| u8::from(f(r))).collect::<Vec<_>>();
    let [
        question,
        scene,
        method,
        setting,
        default_path,
        cost,
        spread,
        max,
        rms,
        work,
        failed,
        refusal,
    ] = COLUMNS;
    list(file, question, &strings(&|r| r.question.name().to_owned()))?;
    list(file, scene, &strings(&|r| r.scene.to_owned()))?;
    list(file, method, &strings(&|r| r.method.to_owned()))?;
    list(file, setting, &strings(&|r| r.setting.clone()))?;
    list(
        file,
        refusal,
        &strings(&|r| r.refusal.clone().unwrap_or_default()),
    )?;
    vector(file, cost, &numbers(&|r| r.cost.median_ns), "ns")?;
    vector(file, spread, &numbers(&|r| r.cost.spread_ns), "ns")?;
    vector(file, max, &numbers(&|r| r.error.max), "1")?;
    vector(file, rms, &numbers(&|r| r.error.rms), "1")?;
    vector(file, work, &numbers(&|r| r.work.unwrap_or(f64::NAN)), "1")?;
    for (name, values) in [
        (default_path, flags(&|r| r.default_path)),
        (failed, flags(&Record::failed)),
    ] {
        let data = file
            .new_dataset::<u8>()
            .shape([values.len()])
            .create(name)?;
        data.write_raw(&values)?;
    }
    Ok(())
}

fn picture(group: &Group, figure: &Picture) -> Result<(), hdf5::Error> {
    text(group, "title", &figure.title)?;
    text(group, "caption", &figure.caption)?;
    for (name, axis) in [("x", &figure.panel.x), ("y", &figure.panel.y)] {
        axis_attributes(group, name, axis)?;
    }
    if let Some(cells) = figure.classes() {
        let classes: Vec<u8> = cells.class.iter().map(|&c| c as u8).collect();
        let [columns, rows] = cells.shape;
        let data = group
            .new_dataset::<u8>()
            .shape([rows, columns])
            .create("class")?;
        data.write_raw(&classes)?;
        text(&data, "names", &cells.names.join("\n"))?;
    }
    for (i, curve) in figure.curves().enumerate() {
        let values: Vec<f64> = curve.points.iter().flat_map(|&(x, y)| [x, y]).collect();
        let data = group
            .new_dataset::<f64>()
            .shape([curve.points.len(), 2])
            .create(format!("curve_{i}").as_str())?;
        if !values.is_empty() {
            data.write_raw(&values)?;
        }
        text(&data, "name", &curve.name)?;
    }
    Ok(())
}

fn axis_attributes(group: &Group, name: &str, axis: &Axis) -> Result<(), hdf5::Error> {
    let (low, high) = axis.range.unwrap_or((f64::NAN, f64::NAN));
    text(group, &format!("{name}_label"), &axis.label())?;
    number(group, &format!("{name}_low"), low)?;
    number(group, &format!("{name}_high"), high)?;
    let scale = match axis.scale {
        Scale::Logarithmic => "logarithmic",
        Scale::Linear => "linear",
    };
    text(group, &format!("{name}_scale"), scale)
}

fn unicode(value: &str) -> Result<VarLenUnicode, hdf5::Error> {
    value
        .replace('\0', " ")
        .parse()
        .map_err(|_| hdf5::Error::from("a text holds a NUL"))
}

fn text(place: &Location, name: &str, value: &str) -> Result<(), hdf5::Error> {
    let value = unicode(value)?;
    place
        .new_attr::<VarLenUnicode>()
        .create(name)?
        .write_scalar(&value)
}

fn number(place: &Location, name: &str, value: f64) -> Result<(), hdf5::Error> {
    place.new_attr::<f64>().create(name)?.write_scalar(&value)
}

fn list(group: &Group, name: &str, values: &[String]) -> Result<(), hdf5::Error> {
    let values: Vec<VarLenUnicode> = values
        .iter()
        .map(|v| unicode(v))
        .collect::<Result<_, _>>()?;
    let data = group
        .new_dataset::<VarLenUnicode>()
        .shape([values.len()])
        .create(name)?;
    data.write_raw(&values)
}

fn vector(group: &Group, name: &str, values: &[f64], units: &str) -> Result<(), hdf5::Error> {
    let data = group
        .new_dataset::<f64>()
        .shape([values.len()])
        .create(name)?;
    data.write_raw(values)?;
    text(&data, "units", units)
}
