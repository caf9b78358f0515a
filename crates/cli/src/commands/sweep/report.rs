//! What a sweep has done, for people and as JSON.

use formats::QUANTITIES;
use formats::sweep::{Block, Blocks, Spec};
use output::Fault;
use serde::Serialize;
use std::path::Path;

/// The JSON object of `sweep --json`.
#[derive(Debug, Serialize)]
pub(crate) struct Report<'a> {
    pub(crate) output: &'a Path,
    pub(crate) csv: Option<&'a Path>,
    pub(crate) shape: Vec<usize>,
    pub(crate) rows: usize,
    /// Of a part.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) first_row: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) shard: Option<String>,
    pub(crate) sweep_rows: usize,
    pub(crate) sweep_sha256: String,
    pub(crate) resumed: usize,
    pub(crate) failed: usize,
    /// Scenes in which a body yields, and in which one is expected to crack.
    pub(crate) yielding: usize,
    pub(crate) cracking: usize,
    /// Rows whose fields were looked up, of a sweep with probes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) looked_up: Option<usize>,
    pub(crate) wall_s: f64,
    pub(crate) computing_s: f64,
}

/// What is counted over all rows.
#[derive(Debug, Default)]
pub(crate) struct Tally {
    pub(crate) rows: usize,
    pub(crate) failed: usize,
    pub(crate) first: Option<(usize, String)>,
    pub(crate) yielding: usize,
    pub(crate) cracking: usize,
    /// Rows whose fields were looked up, of a sweep with probes.
    pub(crate) looked_up: Option<usize>,
}

impl Tally {
    pub(crate) fn of(spec: &Spec, rows: &impl Blocks) -> Result<Self, Fault> {
        let mut tally = Self {
            looked_up: spec.has_probes().then_some(0),
            ..Self::default()
        };
        rows.each(&mut |block| {
            tally.rows += block.numbers.len();
            tally.failed += block.failures.len();
            tally.first = tally
                .first
                .take()
                .or_else(|| block.failures.first().cloned());
            tally.yielding += beyond(block, "yield_onset");
            tally.cracking += beyond(block, "cone_crack_onset");
            if let Some(count) = &mut tally.looked_up {
                *count += block.looked_up();
            }
            Ok(())
        })?;
        Ok(tally)
    }
}

/// Scenes in which a ratio to what the bodies bear is above 1.
fn beyond(block: &Block, name: &str) -> usize {
    let place = QUANTITIES.iter().position(|quantity| quantity.name == name);
    place.map_or(0, |k| {
        block
            .numbers
            .iter()
            .filter(|numbers| numbers[k] > 1.0)
            .count()
    })
}

impl Report<'_> {
    pub(crate) fn text(&self, spec: &Spec) -> String {
        let axes: Vec<String> = spec
            .axes
            .iter()
            .map(|axis| format!("{} ({})", axis.name, axis.len))
            .collect();
        let beyond = match (self.yielding, self.cracking) {
            (0, 0) => String::new(),
            (yielding, cracking) => format!(
                "\nnot elastic    {yielding} yield (yield_onset above 1), {cracking} may crack (cone_crack_onset above 1)"
            ),
        };
        let fields = self.looked_up.map_or_else(String::new, |count| {
            format!(
                "\nfields         {count} of {} scenes looked up, the others computed",
                self.rows
            )
        });
        let part = self.first_row.map_or_else(String::new, |first| {
            let shard = self
                .shard
                .as_ref()
                .map_or_else(String::new, |s| format!("shard {s}: "));
            format!(
                "\npart           {shard}rows {first}:{} of {}",
                first + self.rows,
                self.sweep_rows
            )
        });
        format!(
            "axes           {}{part}\nscenes         {}, {} failed, {} resumed{beyond}{fields}\ntime           {:.2} s, {:.2} s of it computing\nwritten        {}",
            axes.join(" x "),
            self.rows,
            self.failed,
            self.resumed,
            self.wall_s,
            self.computing_s,
            self.output.display()
        )
    }
}
