//! Writing scenes.

use super::body::{Form, put, to_table};
use contact::{Choice, Plasticity, Settings, Shape, Striker};
use impact::{Load, Reading, Scene, Section};
use toml::{Table, Value};

/// The scene with every default and material spelled out, as TOML.
#[must_use]
pub fn resolved(scene: &Scene) -> String {
    let mut root = Table::new();
    let mut section = |name: &str, table: Table| root.insert(name.to_owned(), table.into());
    let mut target = to_table(scene.target.material());
    let block = &scene.target;
    put(
        &mut target,
        [
            ("thickness_m", block.thickness_m),
            ("radius_m", block.radius_m),
        ],
    );
    section("target", target);
    match &scene.load {
        Load::Strike(strike) => {
            let mut table = of_striker(&strike.striker);
            put(&mut table, [("velocity_m_s", Some(strike.velocity_m_s))]);
            section("striker", table);
        }
        Load::Record(record) => {
            let mut table = Table::new();
            let file = record.file.as_ref().map(|path| path.display().to_string());
            table.insert("file".into(), file.unwrap_or_default().into());
            let Reading {
                columns,
                units,
                start_s,
                end_s,
                sign,
            } = &*record.reading;
            for (key, words) in [("columns", columns), ("units", units)] {
                if let Some(words) = words {
                    table.insert(key.into(), words.to_vec().into());
                }
            }
            put(
                &mut table,
                [("start_s", *start_s), ("end_s", *end_s), ("sign", *sign)],
            );
            if let Some(treated) = &record.treated {
                let (baseline_s, low_pass_hz) = (treated.baseline_s, treated.low_pass_hz);
                put(
                    &mut table,
                    [("baseline_s", baseline_s), ("low_pass_hz", low_pass_hz)],
                );
            }
            section("force", table);
        }
    }
    section("contact", settings(&scene.settings));
    if let Some(map) = &scene.section {
        section("map", of_map(map));
    }
    let output = output(scene);
    if !output.is_empty() {
        section("output", output);
    }
    let probes = scene.probes.iter().map(|probe| {
        let mut table = Table::new();
        put(
            &mut table,
            [("r_m", Some(probe.r_m)), ("z_m", Some(probe.z_m))],
        );
        Value::Table(table)
    });
    if !scene.probes.is_empty() {
        root.insert("probe".into(), Value::Array(probes.collect()));
    }
    root.to_string()
}

fn of_map(map: &Section) -> Table {
    let mut table = Table::new();
    put(
        &mut table,
        [
            ("r_max_m", Some(map.r_max_m)),
            ("z_max_m", Some(map.z_max_m)),
        ],
    );
    let points = map.points.map(|n| Value::Integer(n as i64));
    table.insert("points".into(), Value::Array(points.to_vec()));
    table.insert("frames".into(), Value::Integer(map.frames as i64));
    table
}

fn output(scene: &Scene) -> Table {
    let mut table = Table::new();
    put(&mut table, [("duration_s", scene.duration_s)]);
    if !scene.quantities.is_empty() {
        let names = scene.quantities.iter().map(|q| Value::from(q.name()));
        table.insert("quantities".into(), Value::Array(names.collect()));
    }
    if scene.peaks {
        table.insert("peaks".into(), Value::Boolean(true));
    }
    table
}

/// Its material, and mass and tip or what they follow from.
fn of_striker(striker: &Striker) -> Table {
    let mut table = to_table(&striker.material);
    let (form, lengths) = match striker.shape {
        None => {
            put(&mut table, [("mass_kg", Some(striker.mass_kg))]);
            (None, [None, striker.length_m, Some(striker.tip_radius_m)])
        }
        Some(Shape::Ball { diameter_m }) => (Some(Form::Ball), [Some(diameter_m), None, None]),
        Some(Shape::Rod {
            length_m,
            diameter_m,
            tip_radius_m,
        }) => (
            Some(Form::Rod),
            [Some(diameter_m), Some(length_m), tip_radius_m],
        ),
    };
    if let Some(form) = form {
        table.insert("shape".into(), form.name().into());
    }
    let [diameter_m, length_m, tip_radius_m] = lengths;
    put(
        &mut table,
        [
            ("diameter_m", diameter_m),
            ("length_m", length_m),
            ("tip_radius_m", tip_radius_m),
        ],
    );
    table
}

fn settings(settings: &Settings) -> Table {
    let mut table = Table::new();
    let words = [
        ("model", settings.model.name()),
        ("scheme", settings.scheme.name()),
        ("static_share", settings.static_share.name()),
        ("deflection", settings.deflection.name()),
    ];
    if settings.plasticity != Plasticity::None {
        table.insert("plasticity".into(), settings.plasticity.name().into());
    }
    table.extend(words.map(|(key, word)| (key.to_owned(), word.into())));
    let numbers = [
        ("disc_radius_m", settings.disc_radius_m),
        ("tolerance", Some(settings.tolerance)),
        ("loss_tolerance", settings.loss_tolerance),
        ("step_s", settings.step_s),
        ("yield_pressure_pa", settings.yield_pressure_pa),
    ];
    put(&mut table, numbers);
    table
}
