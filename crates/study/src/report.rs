//! report.md: the pictures with an answer to each question, generated from the rows.

use crate::chart::Chart;
use crate::measure::Effort;
use crate::picture::Picture;
use crate::reasons::reason;
use crate::record::{Question, Record, distinct};
use crate::standing::{EQUAL, LEVELS, Measure, Standing, standings};
use std::fmt::Write;

/// The report as Markdown.
pub(crate) fn markdown(chart: &Chart) -> String {
    let mut out = String::new();
    // a String takes all that is written to it
    let _ = write_report(&mut out, chart);
    out
}

fn write_report(out: &mut String, chart: &Chart) -> std::fmt::Result {
    writeln!(out, "# Speed against accuracy, and where methods fail\n")?;
    let command = match chart.effort {
        Effort::Quick => "hertzlamb chart --quick",
        Effort::Full => "hertzlamb chart",
    };
    writeln!(
        out,
        "Made by `{command}`, version {}.",
        env!("CARGO_PKG_VERSION")
    )?;
    writeln!(out, "Machine: {}.", chart.machine.line())?;
    writeln!(out, "Time taken: {:.0} s.", chart.wall_s)?;
    writeln!(
        out,
        "Costs are nanoseconds per value on one core, the median of repeated runs; `chart.csv` has their spread, the work counts and the errors of every row."
    )?;
    writeln!(
        out,
        "Setting up (weights, nodes, a table, the force's spectrum) is not part of a cost; everything that a new point, time or impact needs is."
    )?;
    writeln!(
        out,
        "In the diagrams `[default]` marks the ways that the program itself takes, and `(fails)` those whose largest error is above a tenth at every setting; what is above the frame is not drawn.\n"
    )?;
    let all = standings(&chart.records, Measure::Time);
    for (question, title) in [
        (Question::Kernels, "How to compute a kernel"),
        (Question::Force, "How to compute an impact"),
        (Question::Fields, "How to compute fields"),
        (
            Question::Impacts,
            "How to compute the fields of a whole impact",
        ),
    ] {
        writeln!(out, "## {title}\n")?;
        let mine: Vec<&Standing<'_>> = all.iter().filter(|s| s.question == question).collect();
        for sentence in answer(chart, question, &mine) {
            writeln!(out, "{sentence}")?;
        }
        writeln!(out)?;
        let names = question.name();
        not_adopted(out, &mine)?;
        for picture in chart.diagrams.iter().filter(|f| f.name.starts_with(names)) {
            show(out, picture)?;
            if !picture.caption.is_empty() {
                writeln!(out, "{}\n", picture.caption)?;
            }
        }
        table(out, &mine)?;
    }
    writeln!(out, "## Where methods fail\n")?;
    for picture in &chart.maps {
        writeln!(out, "### {}\n", picture.title)?;
        for sentence in picture.caption.split(". ") {
            writeln!(out, "{}.", sentence.trim_end_matches('.'))?;
        }
        writeln!(out)?;
        show(out, picture)?;
    }
    failures(out, &chart.records)
}

fn show(out: &mut String, picture: &Picture) -> std::fmt::Result {
    writeln!(out, "![{}]({}.png)\n", picture.title, picture.name)
}

/// Methods that are ahead somewhere, with the reason why the program does not take them.
fn not_adopted(out: &mut String, standings: &[&Standing<'_>]) -> std::fmt::Result {
    let ahead = standings.iter().flat_map(|s| &s.ahead);
    let methods = distinct(ahead.map(|(record, _)| record.method));
    if methods.is_empty() {
        return Ok(());
    }
    writeln!(out, "Ahead of the default path somewhere, and not taken:\n")?;
    for method in methods {
        let why = reason(method).unwrap_or("no reason is written down: it should be adopted");
        writeln!(out, "- {method}: {why}.")?;
    }
    writeln!(out)
}

/// Three sentences: what is cheapest, where the default stands, what does not work.
fn answer(chart: &Chart, question: Question, standings: &[&Standing<'_>]) -> [String; 3] {
    let scenes = distinct(standings.iter().map(|s| s.scene));
    let at = |level: f64| -> Vec<String> {
        scenes
            .iter()
            .filter_map(|scene| {
                let found = standings
                    .iter()
                    .find(|s| s.scene == *scene && s.level == level)?;
                let (record, cost) = found.best?;
                Some(format!("{} ({}) in \"{scene}\"", record.method, time(cost)))
            })
            .collect()
    };
    let cheapest = |level: f64| match at(level) {
        list if list.is_empty() => "nothing".to_owned(),
        list => list.join(", "),
    };
    let first = format!(
        "The cheapest for an error of 1e-3 is {}; for 1e-6 it is {}.",
        cheapest(1e-3),
        cheapest(1e-6)
    );
    let reached: Vec<&&Standing<'_>> = standings.iter().filter(|s| s.best.is_some()).collect();
    let on = reached.iter().filter(|s| s.on_front(EQUAL)).count();
    let off: Vec<String> = reached.iter().filter_map(|s| s.first_ahead()).collect();
    let second = if off.is_empty() {
        format!(
            "The default path is on the front by time at all {on} accuracies from 1e-3 to 1e-8 that anything reaches."
        )
    } else {
        format!(
            "The default path is on the front by time at {on} of {} accuracies from 1e-3 to 1e-8 that anything reaches, and not at {}.",
            reached.len(),
            off.join(", ")
        )
    };
    let rows: Vec<&Record> = chart
        .records
        .iter()
        .filter(|r| r.question == question)
        .collect();
    let failed: Vec<&str> = distinct(rows.iter().filter(|r| r.failed()).map(|r| r.method));
    let third = if failed.is_empty() {
        "No method failed in any scene.".to_owned()
    } else {
        format!(
            "These methods give errors above a tenth, or nothing, at some setting or in some scene: {}.",
            failed.join(", ")
        )
    };
    [first, second, third]
}

fn table(out: &mut String, standings: &[&Standing<'_>]) -> std::fmt::Result {
    writeln!(
        out,
        "| scene | error | cheapest of all | cost | default path | cost |"
    )?;
    writeln!(out, "|---|---|---|---|---|---|")?;
    let cell = |found: Option<(&Record, f64)>| match found {
        Some((r, cost)) => format!("{}, {} | {}", r.method, r.setting, time(cost)),
        None => "not reached | ".to_owned(),
    };
    for s in standings {
        debug_assert!(LEVELS.contains(&s.level));
        writeln!(
            out,
            "| {} | {:.0e} | {} | {} |",
            s.scene,
            s.level,
            cell(s.best),
            cell(s.own)
        )?;
    }
    writeln!(out)
}

/// Methods that failed, with their largest errors.
fn failures(out: &mut String, records: &[Record]) -> std::fmt::Result {
    writeln!(out, "## Failures in the rows\n")?;
    writeln!(
        out,
        "| question | scene | method | setting | largest error | says |"
    )?;
    writeln!(out, "|---|---|---|---|---|---|")?;
    for r in records.iter().filter(|r| r.failed()) {
        writeln!(
            out,
            "| {} | {} | {} | {} | {:.1e} | {} |",
            r.question.name(),
            r.scene,
            r.method,
            r.setting,
            r.error.max,
            r.refusal.as_deref().unwrap_or("")
        )?;
    }
    Ok(())
}

/// A time in a unit that suits it.
fn time(ns: f64) -> String {
    match ns {
        x if x < 1e3 => format!("{x:.0} ns"),
        x if x < 1e6 => format!("{:.1} us", x / 1e3),
        x if x < 1e9 => format!("{:.1} ms", x / 1e6),
        x => format!("{:.1} s", x / 1e9),
    }
}
