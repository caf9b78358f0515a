//! Folder of a chart: rows, pictures, and report.md with an answer to each question, generated from the rows.

use crate::chart::Chart;
use crate::measure::Effort;
use crate::picture::Picture;
use crate::ranking::{Ranking, rankings};
use crate::record::{Question, Record, distinct};
use contact::Choice;
use fault::AnyError;
use output::Folder;
use paper::{csv_file, drawn};

/// Columns of pictures.csv.
pub const PICTURE_COLUMNS: &str = "picture name x y";

impl Chart {
    /// Writes chart.csv, pictures.csv, report.md and the pictures into a folder.
    ///
    /// # Errors
    /// The file or picture at fault, with the reason; no file has changed then.
    pub fn write(&self, folder: &Folder) -> Result<(), AnyError> {
        let rows = self.records.iter().map(Record::row);
        let mut files = vec![csv_file("chart.csv", Record::COLUMNS, rows)?];
        let mut points = Vec::new();
        for picture in self.diagrams.iter().chain(&self.maps) {
            let name = picture.name;
            points.extend(picture.points().into_iter().map(|(curve, x, y)| {
                let [x, y] = [x, y].map(|value| value.to_string());
                [name.to_owned(), curve.to_owned(), x, y]
            }));
            let failed = |source| format!("the picture {name} cannot be drawn: {source}");
            files.extend(drawn(name, &picture.figure).map_err(failed)?);
        }
        files.push(csv_file("pictures.csv", PICTURE_COLUMNS, points)?);
        files.push(("report.md".to_owned(), markdown(self).into_bytes()));
        Ok(folder.write(files)?)
    }
}

/// The report as Markdown.
fn markdown(chart: &Chart) -> String {
    let command = match chart.effort {
        Effort::Quick => "hertzlamb chart --quick",
        Effort::Full => "hertzlamb chart",
    };
    let mut lines = vec![
        "# Speed against accuracy, and where methods fail\n".to_owned(),
        format!("Made by `{command}`, version {}.", env!("CARGO_PKG_VERSION")),
        format!("Machine: {}.", chart.machine),
        format!("Time taken: {:.0} s.", chart.wall_s),
        "Costs are nanoseconds per value on one core, the median of repeated runs; `chart.csv` has their spread, the work counts and the errors of every row.".to_owned(),
        "Costs exclude the set-up (weights, nodes, a table, the spectrum of the force) and include everything that a new point, time or impact needs.".to_owned(),
        "In the diagrams `[default]` marks the methods that the program uses by default, and `(fails)` the methods whose largest error is above 0.1 at every setting; points above the frame are not drawn.\n".to_owned(),
    ];
    let all = rankings(&chart.records);
    for &question in Question::ALL {
        let (name, [_, title, _]) = (question.name(), question.words());
        lines.push(format!("## {title}\n"));
        let mine: Vec<&Ranking<'_>> = all.iter().filter(|s| s.question == question).collect();
        lines.extend(answer(chart, question, &mine));
        lines.extend(not_taken(&mine));
        for picture in chart.diagrams.iter().filter(|f| f.name.starts_with(name)) {
            lines.push(shown(picture));
            if !picture.caption.is_empty() {
                lines.push(format!("{}\n", picture.caption));
            }
        }
        lines.extend(table(&mine));
    }
    lines.push("## Where methods fail\n".to_owned());
    for picture in &chart.maps {
        lines.push(format!("### {}\n", picture.figure.title));
        let sentences = picture.caption.split(". ");
        lines.extend(sentences.map(|sentence| format!("{}.", sentence.trim_end_matches('.'))));
        lines.push(format!("\n{}", shown(picture)));
    }
    lines.extend(failures(&chart.records));
    lines.join("\n") + "\n"
}

fn shown(picture: &Picture) -> String {
    format!("![{}]({}.png)\n", picture.figure.title, picture.name)
}

/// Methods that are ahead somewhere, with the reason why the program does not use them.
fn not_taken(rankings: &[&Ranking<'_>]) -> Vec<String> {
    let ahead = rankings.iter().flat_map(|s| &s.ahead);
    let methods = distinct(ahead.map(|record| record.method));
    let mut lines = Vec::new();
    if !methods.is_empty() {
        lines.push("Methods that are ahead of the default path somewhere, and the reasons why the program does not use them:\n".to_owned());
        lines.extend(methods.into_iter().map(|method| {
            let unknown = "no reason is recorded: it should be adopted";
            let why = method.why_not().unwrap_or(unknown);
            format!("- {}: {why}.", method.name())
        }));
        lines.push(String::new());
    }
    lines
}

/// Three sentences: the cheapest methods, the rank of the default path, and the failures.
fn answer(chart: &Chart, question: Question, rankings: &[&Ranking<'_>]) -> [String; 4] {
    let cheapest = |level: f64| {
        let at = rankings.iter().filter(|s| s.level == level);
        let best = at.filter_map(|s| {
            let (method, cost) = (s.best?.method.name(), time(s.best?.cost_ns));
            Some(format!("{method} ({cost}) in \"{}\"", s.scene))
        });
        match best.collect::<Vec<_>>() {
            list if list.is_empty() => "nothing".to_owned(),
            list => list.join(", "),
        }
    };
    let (coarse, fine) = (cheapest(1e-3), cheapest(1e-6));
    let first = format!("The cheapest for an error of 1e-3 is {coarse}; for 1e-6 it is {fine}.");
    let of = rankings.iter().filter(|s| s.best.is_some()).count();
    let off: Vec<String> = rankings.iter().filter_map(|s| s.first_ahead()).collect();
    let second = if off.is_empty() {
        format!(
            "The default path is on the front by time at all {of} accuracies from 1e-3 to 1e-8 that any method reaches."
        )
    } else {
        format!(
            "The default path is on the front by time at {} of {of} accuracies from 1e-3 to 1e-8 that any method reaches, and not at {}.",
            of - off.len(),
            off.join(", ")
        )
    };
    let rows = chart.records.iter().filter(|r| r.question == question);
    let failed = distinct(rows.filter(|r| r.failed()).map(|r| r.method.name()));
    let third = if failed.is_empty() {
        "No method failed in any scene.".to_owned()
    } else {
        format!(
            "These methods have errors above 0.1, or no result, at some setting or in some scene: {}.",
            failed.join(", ")
        )
    };
    [first, second, third, String::new()]
}

fn table(rankings: &[&Ranking<'_>]) -> Vec<String> {
    let head = "| scene | error | cheapest of all | cost | default path | cost |";
    let mut lines = vec![format!("{head}\n|---|---|---|---|---|---|")];
    let cell = |found: Option<&Record>| match found {
        Some(r) => format!("{}, {} | {}", r.method.name(), r.setting, time(r.cost_ns)),
        None => "not reached | ".to_owned(),
    };
    lines.extend(rankings.iter().map(|s| {
        let (best, own) = (cell(s.best), cell(s.own));
        format!("| {} | {:.0e} | {best} | {own} |", s.scene, s.level)
    }));
    lines.push(String::new());
    lines
}

/// Methods that failed, with their largest errors.
fn failures(records: &[Record]) -> Vec<String> {
    let head = "| question | scene | method | setting | largest error | says |";
    let head = format!("## Failures in the rows\n\n{head}\n|---|---|---|---|---|---|");
    let mut lines = vec![head];
    lines.extend(records.iter().filter(|r| r.failed()).map(|r| {
        let (question, says) = (r.question.name(), r.refusal.as_deref().unwrap_or(""));
        let (scene, method, setting, error) = (r.scene, r.method.name(), &r.setting, r.error_max);
        format!("| {question} | {scene} | {method} | {setting} | {error:.1e} | {says} |")
    }));
    lines
}

/// Text of a time in a suitable unit.
fn time(ns: f64) -> String {
    match ns {
        x if x < 1e3 => format!("{x:.0} ns"),
        x if x < 1e6 => format!("{:.1} us", x / 1e3),
        x if x < 1e9 => format!("{:.1} ms", x / 1e6),
        x => format!("{:.1} s", x / 1e9),
    }
}
