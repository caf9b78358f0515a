//! Every number that the paper prints, with ours.

mod arrivals;
mod coupled;
mod hertz;
mod scheme;
mod strengths;
mod table_1;

use crate::case::VELOCITY_M_S;
use crate::error::PaperError;
use crate::misprint;
use crate::row::Row;
use crate::runs::Runs;

/// Rows that belong together.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// What they are.
    pub title: &'static str,
    /// The rows.
    pub rows: Vec<Row>,
    /// Whether they are among the few that matter most.
    pub is_main: bool,
}

/// Every number that the paper prints, with ours.
#[derive(Debug, Clone, PartialEq)]
pub struct Numbers {
    /// The rows, in the order of the paper.
    pub sections: Vec<Section>,
    /// What no row can hold, a sentence each.
    pub remarks: Vec<String>,
}

/// Microseconds in a second.
const US: f64 = 1e6;

impl Numbers {
    /// Solves the contacts.
    ///
    /// # Errors
    /// [`PaperError`] where something that must work does not.
    pub fn compute() -> Result<Self, PaperError> {
        Self::of(&Runs::solve()?)
    }

    pub(crate) fn of(runs: &Runs) -> Result<Self, PaperError> {
        let section = |title, rows, is_main| Section {
            title,
            rows,
            is_main,
        };
        let sections = vec![
            section(
                "Table 1: what follows from its moduli",
                table_1::rows()?,
                false,
            ),
            section(
                "Hertz without the half-space's deflection, (45)-(47)",
                hertz::rows(runs),
                true,
            ),
            section(
                "Coupled with the half-space, converged",
                coupled::rows(runs),
                true,
            ),
            section(
                "The paper's scheme (40)-(44), step 0.164 us, copper of 129 GPa",
                scheme::rows(runs),
                false,
            ),
            section(
                "Strength under impact, from the converged force",
                strengths::rows(runs),
                false,
            ),
            section("First arrivals", arrivals::rows()?, false),
        ];
        let mut remarks = misprint::sentences()?;
        remarks.push(time_step(runs));
        remarks.push(once(runs));
        Ok(Self { sections, remarks })
    }

    /// The row of a name.
    #[must_use]
    pub fn find(&self, what: &str) -> Option<&Row> {
        let mut rows = self.sections.iter().flat_map(|section| &section.rows);
        rows.find(|row| row.what == what)
    }

    /// The numbers that matter most, few enough for a screen.
    #[must_use]
    pub fn short(&self) -> String {
        let main = self.sections.iter().filter(|section| section.is_main);
        lines(main).join("\n")
    }

    /// All numbers, with remarks.
    #[must_use]
    pub fn text(&self) -> String {
        let mut lines = lines(self.sections.iter());
        lines.push(String::new());
        lines.extend(self.remarks.iter().cloned());
        lines.join("\n")
    }
}

fn lines<'a>(sections: impl Iterator<Item = &'a Section>) -> Vec<String> {
    let mut lines = vec![line(
        "",
        ["paper", "this program", "difference"].map(str::to_owned),
        "",
    )];
    for section in sections {
        lines.push(section.title.to_owned());
        lines.extend(
            section
                .rows
                .iter()
                .map(|row| line(row.what, row.told(), row.unit)),
        );
    }
    lines
}

fn line(what: &str, [paper, here, difference]: [String; 3], unit: &str) -> String {
    let text = format!("  {what:<58} {paper:>12} {here:>13} {difference:>10}  {unit}");
    text.trim_end().to_owned()
}

/// Where the restitution of the paper comes from.
fn time_step(runs: &Runs) -> String {
    format!(
        "The paper's restitution of 0.991 is the time-step error of its scheme, which loses less than the waves take away: {:.4} with a step of 0.164 us, {:.3} with 0.5 us (the striker leaves faster than it came), {:.4} converged.",
        runs.scheme.restitution, runs.coarse.restitution, runs.printed.restitution
    )
}

/// What a contact gives that counts the static deflection once.
fn once(runs: &Runs) -> String {
    format!(
        "Hertz's K holds the static deflection of the half-space already, so that (8) counts it twice: a contact whose radius follows the load, and which counts it once, has a peak force of {:.0} N, lasts {:.2} us and leaves with {:.2} m/s.",
        runs.growing.peak_force_n,
        US * runs.growing.contact_time_s,
        VELOCITY_M_S * runs.growing.restitution
    )
}
