//! Writing scenes.

use crate::body::to_table;
use crate::scene::striker::Form;
use contact::{Choice, Settings, Shape, Striker};
use impact::{Load, Scene};
use toml::{Table, Value};

/// The scene with every default and material spelled out, as TOML.
#[must_use]
pub fn resolved(scene: &Scene) -> String {
    let mut root = Table::new();
    let mut target = to_table(scene.target.material());
    put(&mut target, "thickness_m", scene.target.thickness_m);
    put(&mut target, "radius_m", scene.target.radius_m);
    root.insert("target".into(), Value::Table(target));
    match &scene.load {
        Load::Strike(strike) => {
            let striker = &strike.striker;
            let mut table = to_table(&striker.material);
            put_striker(&mut table, striker);
            put(&mut table, "velocity_m_s", Some(strike.velocity_m_s));
            root.insert("striker".into(), Value::Table(table));
        }
        Load::Record(record) => {
            let mut table = Table::new();
            let file = record.file.as_ref().map(|path| path.display().to_string());
            table.insert("file".into(), file.unwrap_or_default().into());
            if let Some(treated) = &record.treated {
                put(&mut table, "baseline_s", treated.baseline_s);
                put(&mut table, "low_pass_hz", treated.low_pass_hz);
            }
            root.insert("force".into(), Value::Table(table));
        }
    }
    root.insert("contact".into(), Value::Table(settings(&scene.settings)));
    let probes = scene.probes.iter().map(|probe| {
        let mut table = Table::new();
        put(&mut table, "r_m", Some(probe.r_m));
        put(&mut table, "z_m", Some(probe.z_m));
        Value::Table(table)
    });
    if !scene.probes.is_empty() {
        root.insert("probe".into(), Value::Array(probes.collect()));
    }
    if let Some(section) = scene.section {
        let mut table = Table::new();
        put(&mut table, "r_max_m", Some(section.r_max_m));
        put(&mut table, "z_max_m", Some(section.z_max_m));
        let points = section.points.map(|n| Value::Integer(n as i64));
        table.insert("points".into(), Value::Array(points.to_vec()));
        table.insert("frames".into(), Value::Integer(section.frames as i64));
        root.insert("map".into(), Value::Table(table));
    }
    let output = output(scene);
    if !output.is_empty() {
        root.insert("output".into(), Value::Table(output));
    }
    root.to_string()
}

fn output(scene: &Scene) -> Table {
    let mut table = Table::new();
    put(&mut table, "duration_s", scene.duration_s);
    if !scene.quantities.is_empty() {
        let names = scene.quantities.iter().map(|q| Value::from(q.name()));
        table.insert("quantities".into(), Value::Array(names.collect()));
    }
    if scene.peaks {
        table.insert("peaks".into(), Value::Boolean(true));
    }
    table
}

/// What mass and tip follow from, or themselves.
fn put_striker(table: &mut Table, striker: &Striker) {
    match striker.shape {
        None => {
            put(table, "mass_kg", Some(striker.mass_kg));
            put(table, "tip_radius_m", Some(striker.tip_radius_m));
            put(table, "length_m", striker.length_m);
        }
        Some(Shape::Ball { diameter_m }) => {
            table.insert("shape".into(), Form::Ball.name().into());
            put(table, "diameter_m", Some(diameter_m));
        }
        Some(Shape::Rod {
            length_m,
            diameter_m,
            tip_radius_m,
        }) => {
            table.insert("shape".into(), Form::Rod.name().into());
            put(table, "length_m", Some(length_m));
            put(table, "diameter_m", Some(diameter_m));
            put(table, "tip_radius_m", tip_radius_m);
        }
    }
}

fn settings(settings: &Settings) -> Table {
    let mut table = Table::new();
    let mut word = |key: &str, value: &str| {
        table.insert(key.to_owned(), value.into());
    };
    word("model", settings.model.name());
    word("scheme", settings.scheme.name());
    word("static_share", settings.static_share.name());
    word("deflection", settings.deflection.name());
    put(&mut table, "disc_radius_m", settings.disc_radius_m);
    put(&mut table, "tolerance", Some(settings.tolerance));
    put(&mut table, "loss_tolerance", settings.loss_tolerance);
    put(&mut table, "step_s", settings.step_s);
    table
}

fn put(table: &mut Table, key: &str, value: Option<f64>) {
    if let Some(value) = value {
        table.insert(key.to_owned(), value.into());
    }
}
