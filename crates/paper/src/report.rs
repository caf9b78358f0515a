//! The report and its folder: report.md, numbers, claims, figures and their curves.

use crate::case::Runs;
use crate::figures::{self, Claim, Redrawn};
use crate::numbers::Numbers;
use fault::AnyError;
use figure::{Figure, FigureError, Layer, to_png, to_svg};
use output::Folder;

/// Scale of a PNG relative to its SVG.
const SCALE: f32 = 1.5;

/// Columns of numbers.csv.
const NUMBERS: &str = "section place what unit paper here relative_difference why";

/// The reproduced paper.
#[derive(Debug, Clone, PartialEq)]
pub struct Redone {
    /// Numbers.
    pub numbers: Numbers,
    /// Figures 4 to 11.
    pub figures: Vec<Redrawn>,
}

impl Redone {
    /// Solves the contacts and computes the fields.
    ///
    /// # Errors
    /// [`AnyError`] if a contact or field of the paper's case cannot be computed.
    pub fn compute() -> Result<Self, AnyError> {
        let runs = Runs::solve()?;
        Ok(Self {
            numbers: Numbers::of(&runs)?,
            figures: figures::all(&runs)?,
        })
    }

    /// Writes report.md, numbers.csv, claims.csv, and for each figure an SVG, a PNG and a CSV of its curves.
    ///
    /// # Errors
    /// The file or figure at fault, with the reason; no file has changed then.
    pub fn write(&self, folder: &Folder) -> Result<(), AnyError> {
        let sections = self.numbers.sections.iter();
        let rows = sections.flat_map(|s| s.rows.iter().map(|row| row.cells(s.title)));
        let claims = self.figures.iter().flat_map(|figure| {
            let cells = |c: &Claim| {
                [figure.name, c.says, &c.holds.to_string(), &c.found].map(str::to_owned)
            };
            figure.claims.iter().map(cells)
        });
        let mut files = vec![
            ("report.md".to_owned(), self.report().into_bytes()),
            csv_file("numbers.csv", NUMBERS, rows)?,
            csv_file("claims.csv", "figure says holds found", claims)?,
        ];
        for redrawn in &self.figures {
            let name = redrawn.name;
            let failed = |source| format!("{name} cannot be drawn: {source}");
            files.extend(drawn(name, &redrawn.figure).map_err(failed)?);
            let (csv, points) = (format!("{name}.csv"), points(&redrawn.figure));
            files.push(csv_file(&csv, "abscissa ordinate curve x y", points)?);
        }
        Ok(folder.write(files)?)
    }

    /// The report as Markdown, with links to the figures in the same folder.
    pub fn report(&self) -> String {
        let mut lines = vec![
            "# The paper, redone\n".to_owned(),
            "A copper rod of 12.2 g with a hemispherical end of 4 mm strikes a steel anvil at 100 m/s: every number that the source paper prints and its Figures 4 to 11, compared with the results of this program.".to_owned(),
            format!("Written by `hertzlamb paper`, version {}; equations, figures and tables have the paper's numbers.\n", env!("CARGO_PKG_VERSION")),
            "- \"Converged\" is the paper's model (a disc of radius r0 under Hertz's pressure, its whole deflection added to Hertz's indentation), solved to 1e-6.".to_owned(),
            "- \"The paper's scheme\" is (40)-(44) with a step of 0.164 us, a 150th of (47), and copper of 129 GPa: they reproduce every number that the paper prints for its scheme, to the last digit.".to_owned(),
            "- Fields are exact for the given force; z points into the block, and compression is negative.\n".to_owned(),
            "## Numbers\n".to_owned(),
        ];
        for section in &self.numbers.sections {
            let head = "| place | quantity | paper | this program | difference | reason |";
            lines.push(format!(
                "### {}\n\n{head}\n|---|---|---|---|---|---|",
                section.title
            ));
            lines.extend(section.rows.iter().map(|row| {
                let [paper, here, difference] = row.told();
                let unit = if row.unit.is_empty() { "" } else { " " }.to_owned() + row.unit;
                let (place, what, why) = (row.place, row.what, row.why);
                format!(
                    "| {place} | {what} | {paper}{unit} | {here}{unit} | {difference} | {why} |"
                )
            }));
            lines.push(String::new());
        }
        lines.push("### Remarks\n".to_owned());
        let remarks = self.numbers.remarks.iter();
        lines.extend(remarks.map(|remark| format!("- {remark}")));
        lines.push("\n## Figures\n".to_owned());
        for figure in &self.figures {
            let (name, title) = (figure.name, figure.title);
            lines.push(format!("### {title}\n\n![{title}]({name}.svg)\n"));
            if !figure.caption.is_empty() {
                lines.push(format!("{}\n", figure.caption));
            }
            lines.push("| the paper says | holds | found here |\n|---|---|---|".to_owned());
            lines.extend(figure.claims.iter().map(|Claim { says, found, holds }| {
                let holds = if *holds { "yes" } else { "no" };
                format!("| {says} | {holds} | {found} |")
            }));
            lines.push(String::new());
        }
        lines.join("\n") + "\n"
    }
}

/// A table as CSV.
///
/// # Errors
/// None if `columns` has `N` names.
pub fn csv_file<const N: usize>(
    name: &str,
    columns: &str,
    rows: impl IntoIterator<Item = [String; N]>,
) -> Result<(String, Vec<u8>), AnyError> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(columns.split(' '))?;
    for row in rows {
        writer.write_record(row)?;
    }
    let bytes = writer.into_inner();
    let bytes = bytes.map_err(csv::IntoInnerError::into_error)?;
    Ok((name.to_owned(), bytes))
}

/// A figure as SVG and as PNG.
///
/// # Errors
/// [`FigureError`] for a figure that cannot be drawn.
pub fn drawn(name: &str, figure: &Figure) -> Result<[(String, Vec<u8>); 2], FigureError> {
    let (svg, png) = (to_svg(figure)?, to_png(figure, SCALE)?);
    Ok([
        (format!("{name}.svg"), svg.into_bytes()),
        (format!("{name}.png"), png),
    ])
}

/// The points of the curves of a figure: times in s, lengths in m, forces in N, speeds in m/s.
fn points(figure: &Figure) -> Vec<[String; 5]> {
    let mut points = Vec::new();
    for panel in &figure.panels {
        for layer in &panel.layers {
            let (name, found) = match layer {
                Layer::Line(line) => (line.name.as_str(), line.points.clone()),
                Layer::Point { at, .. } => ("printed in the paper", vec![*at]),
                Layer::Classes(_) | Layer::Image(_) | Layer::Mark { .. } => continue,
            };
            let names = [&panel.x.quantity, &panel.y.quantity, name];
            let [abscissa, ordinate, name] = names.map(str::to_owned);
            points.extend(found.into_iter().map(|(x, y)| {
                let [x, y] = [x, y].map(|value| value.to_string());
                [abscissa.clone(), ordinate.clone(), name.clone(), x, y]
            }));
        }
    }
    points
}
