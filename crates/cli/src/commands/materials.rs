//! `hertzlamb materials`: lists and searches the library.

use crate::failure::{Failure, print};
use clap::Args;
use contact::{Library, Material};
use formats::read_materials;
use serde::Serialize;
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  hertzlamb materials\n  hertzlamb materials ceramic\n  hertzlamb materials --file mine.toml --json"
)]
pub(crate) struct Arguments {
    /// Part of a name, group or source.
    search: Option<String>,
    /// A file of further materials (TOML, see data-schema/scene.md).
    #[arg(long, value_name = "FILE")]
    file: Option<PathBuf>,
    /// Print a JSON array instead of a table.
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Serialize)]
struct Row<'a> {
    name: &'a str,
    group: &'a str,
    youngs_modulus_pa: f64,
    poisson_ratio: f64,
    density_kg_m3: Option<f64>,
    longitudinal_speed_m_s: Option<f64>,
    shear_speed_m_s: Option<f64>,
    yield_strength_pa: Option<f64>,
    tensile_strength_pa: Option<f64>,
    fracture_toughness_pa_sqrt_m: Option<f64>,
    source: &'a str,
}

impl<'a> Row<'a> {
    fn new(m: &'a Material) -> Self {
        Self {
            name: &m.name,
            group: &m.group,
            youngs_modulus_pa: m.youngs_modulus_pa,
            poisson_ratio: m.poisson_ratio,
            density_kg_m3: m.density_kg_m3,
            longitudinal_speed_m_s: m.longitudinal_speed_m_s(),
            shear_speed_m_s: m.shear_speed_m_s(),
            yield_strength_pa: m.yield_strength_pa,
            tensile_strength_pa: m.tensile_strength_pa,
            fracture_toughness_pa_sqrt_m: m.fracture_toughness_pa_sqrt_m,
            source: &m.source,
        }
    }

    fn text(&self) -> String {
        let number = |value: Option<f64>, scale: f64| {
            value.map_or_else(|| "-".to_owned(), |v| format!("{:.0}", v / scale))
        };
        format!(
            "{:<24} {:<9} {:>8.3} {:>6.3} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6}  {}",
            self.name,
            self.group,
            self.youngs_modulus_pa / 1e9,
            self.poisson_ratio,
            number(self.density_kg_m3, 1.0),
            number(self.longitudinal_speed_m_s, 1.0),
            number(self.shear_speed_m_s, 1.0),
            number(self.yield_strength_pa, 1e6),
            number(self.tensile_strength_pa, 1e6),
            self.fracture_toughness_pa_sqrt_m
                .map_or_else(|| "-".to_owned(), |k| format!("{:.2}", k / 1e6)),
            self.source
        )
    }
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut library = Library::built_in().clone();
    if let Some(path) = &arguments.file {
        let own = read_materials(path).map_err(Failure::input)?;
        library = library.extended(&own);
    }
    let word = arguments.search.as_deref().unwrap_or("");
    let rows: Vec<Row<'_>> = library.search(word).map(Row::new).collect();
    if rows.is_empty() {
        return Err(Failure::input(format!(
            "no material matches \"{word}\"; hertzlamb materials lists them all"
        )));
    }
    if arguments.json {
        return print(serde_json::to_string_pretty(&rows).map_err(Failure::work)?);
    }
    print(format!(
        "{:<24} {:<9} {:>8} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6}  source",
        "name", "group", "E [GPa]", "nu", "kg/m3", "c1", "c2", "Ry", "Rm", "KIc"
    ))?;
    rows.iter().try_for_each(|row| print(row.text()))
}
