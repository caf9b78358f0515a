//! What is counted over the rows of a sweep.

use formats::QUANTITIES;
use formats::sweep::{Block, Blocks, Spec};
use output::Fault;

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
