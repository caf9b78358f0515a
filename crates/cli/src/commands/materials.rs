//! `hertzlamb materials`: lists and searches the materials library.

use crate::failure::{Failure, line, print};
use clap::Args;
use contact::{Library, Material};
use formats::{material_report, read_materials};
use serde_json::Value;
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  hertzlamb materials\n  hertzlamb materials ceramic\n  hertzlamb materials --file mine.toml --json"
)]
pub(crate) struct Arguments {
    /// Part of a name, group or source.
    search: Option<String>,
    /// File with further materials (TOML, see data-schema/scene.md).
    #[arg(long, value_name = "FILE")]
    file: Option<PathBuf>,
    /// Print a JSON array instead of a table.
    #[arg(long)]
    json: bool,
}

/// Header over the columns of [`text`].
const HEAD: &str = "\
name                     group            E     nu    rho     c1     c2     Ry     Rm    KIc  source
                                        GPa         kg/m3    m/s    m/s    MPa    MPa  MPa√m";

fn text(m: &Material) -> String {
    let number = |value: Option<f64>, scale: f64, decimals: usize| {
        value.map_or_else(|| "-".to_owned(), |v| format!("{:.decimals$}", v / scale))
    };
    format!(
        "{:<24} {:<9} {:>8.3} {:>6.3} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6}  {}",
        m.name,
        m.group,
        m.youngs_modulus_pa / 1e9,
        m.poisson_ratio,
        number(m.density_kg_m3, 1.0, 0),
        number(m.longitudinal_speed_m_s(), 1.0, 0),
        number(m.shear_speed_m_s(), 1.0, 0),
        number(m.yield_strength_pa, 1e6, 0),
        number(m.tensile_strength_pa, 1e6, 0),
        number(m.fracture_toughness_pa_sqrt_m, 1e6, 2),
        m.source
    )
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut library = Library::built_in().clone();
    if let Some(path) = &arguments.file {
        library = library.extended(&read_materials(path)?);
    }
    let word = arguments.search.as_deref().unwrap_or("");
    let found: Vec<&Material> = library.search(word).collect();
    if found.is_empty() {
        return Err(Failure::input(format!(
            "no material matches \"{word}\"; `hertzlamb materials` lists all"
        )));
    }
    if arguments.json {
        let rows: Value = found.into_iter().map(material_report).collect();
        return print(format!("{rows:#}"));
    }
    print(HEAD)?;
    found.into_iter().try_for_each(|m| print(line(text(m))))
}
