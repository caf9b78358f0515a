//! An impact as text: one table of everything over time.

use super::schema;
use impact::{Outcome, Scene};
use output::{Output, OutputError, Staged};
use std::io::{BufWriter, Write};

/// Writes the time series and the traces of the probes, one line a sample, into an output that was claimed.
///
/// Lines that begin with `#` say where the probes are. The first line after them names the columns with their units,
/// such as `time_s`, `force_n` and `probe1_stress_zz_pa`.
pub fn stage_results_csv<'a>(
    output: &'a Output,
    scene: &Scene,
    outcome: &Outcome,
) -> Result<Staged<'a>, OutputError> {
    output.stage(|part| {
        let mut file = BufWriter::new(std::fs::File::create(part)?);
        for (i, probe) in (1..).zip(&scene.probes) {
            let (r_m, z_m) = (probe.r_m, probe.z_m);
            writeln!(file, "# probe{i}: r = {r_m} m, z = {z_m} m")?;
        }
        let columns = columns(outcome);
        let names: Vec<&str> = columns.iter().map(|(name, _)| name.as_str()).collect();
        writeln!(file, "{}", names.join(","))?;
        for i in 0..outcome.series.time_s.len() {
            for (k, (_, samples)) in columns.iter().enumerate() {
                let comma = if k == 0 { "" } else { "," };
                write!(file, "{comma}{:?}", samples[i])?;
            }
            writeln!(file)?;
        }
        file.flush()
    })
}

/// Names, which end with the unit, and samples.
fn columns(outcome: &Outcome) -> Vec<(String, &[f64])> {
    let series = schema::samples(&outcome.series);
    let mut found: Vec<_> = series
        .map(|((name, unit, _), samples)| (format!("{name}{}", ending(unit)), samples))
        .collect();
    for ((name, unit, _), values, _) in outcome.probes.iter().flat_map(schema::histories) {
        found.extend((1..).zip(values).map(|(probe, samples)| {
            let name = format!("probe{probe}_{name}{}", ending(unit));
            (name, samples.as_slice())
        }));
    }
    found
}

/// A unit as names carry it: `m/s` is `_m_s`.
fn ending(unit: &str) -> String {
    if unit == "1" {
        return String::new();
    }
    format!(
        "_{}",
        unit.to_lowercase().replace('/', "_").replace('^', "")
    )
}
