//! report.md: numbers, figures and what is said of them.

use crate::figures::Redrawn;
use crate::numbers::{Numbers, Section};
use std::fmt::Write;

/// The report as Markdown.
pub(crate) fn markdown(numbers: &Numbers, figures: &[Redrawn]) -> String {
    let mut out = String::new();
    // a String takes all that is written to it
    let _ = write_report(&mut out, numbers, figures);
    out
}

fn write_report(out: &mut String, numbers: &Numbers, figures: &[Redrawn]) -> std::fmt::Result {
    writeln!(out, "# The paper, redone\n")?;
    writeln!(
        out,
        "A copper rod of 12.2 g with a hemispherical end of 4 mm strikes a steel anvil at 100 m/s: every number that the source paper prints and its Figures 4 to 11, beside those of this program."
    )?;
    writeln!(
        out,
        "Written by `hertzlamb paper`, version {}; equations, figures and tables have the paper's numbers.\n",
        env!("CARGO_PKG_VERSION")
    )?;
    writeln!(
        out,
        "- \"Converged\" is the paper's model (a disc of radius r0 under Hertz's pressure, its whole deflection added to Hertz's indentation), solved to 1e-6."
    )?;
    writeln!(
        out,
        "- \"The paper's scheme\" is (40)-(44) with a step of 0.164 us, a 150th of (47), and copper of 129 GPa: with these every number that the paper prints of it comes out to its last digit."
    )?;
    writeln!(
        out,
        "- Fields are exact for the force that they belong to; z points into the block, and compression is negative.\n"
    )?;
    writeln!(out, "## Numbers\n")?;
    for section in &numbers.sections {
        table(out, section)?;
    }
    writeln!(out, "### What no row can hold\n")?;
    for remark in &numbers.remarks {
        writeln!(out, "- {remark}")?;
    }
    writeln!(out, "\n## Figures\n")?;
    for redrawn in figures {
        show(out, redrawn)?;
    }
    Ok(())
}

fn table(out: &mut String, section: &Section) -> std::fmt::Result {
    writeln!(out, "### {}\n", section.title)?;
    writeln!(
        out,
        "| where | what | paper | this program | difference | why |"
    )?;
    writeln!(out, "|---|---|---|---|---|---|")?;
    for row in &section.rows {
        let [paper, here, difference] = row.told();
        let unit = if row.unit.is_empty() { "" } else { " " };
        writeln!(
            out,
            "| {} | {} | {paper}{unit}{} | {here}{unit}{} | {difference} | {} |",
            row.place, row.what, row.unit, row.unit, row.why
        )?;
    }
    writeln!(out)
}

fn show(out: &mut String, redrawn: &Redrawn) -> std::fmt::Result {
    writeln!(out, "### {}\n", redrawn.title)?;
    writeln!(out, "![{}]({}.svg)\n", redrawn.title, redrawn.name)?;
    if !redrawn.caption.is_empty() {
        writeln!(out, "{}\n", redrawn.caption)?;
    }
    writeln!(out, "| the paper says | holds | found here |")?;
    writeln!(out, "|---|---|---|")?;
    for claim in &redrawn.claims {
        let holds = if claim.holds { "yes" } else { "no" };
        writeln!(out, "| {} | {holds} | {} |", claim.says, claim.found)?;
    }
    writeln!(out)
}
