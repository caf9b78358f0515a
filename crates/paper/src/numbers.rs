//! Every number that the paper prints, with ours.

use crate::case::{NAMED_STRENGTH_PA, RADIUS_M, Runs, STRENGTH_PA, TABLE_1_PA, VELOCITY_M_S};
use crate::case::{anvil, coupled, kmax, mean_pa};
use contact::Material;
use contact::law::hertz::CONTACT_TIME;
use contact::super_seismic;
use fault::AnyError;
use halfspace::{Arrivals, Medium, Profile};
use impact::Run;

/// A number of the paper beside ours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Where the paper has it: an equation, a figure, a table, a page of text.
    pub place: &'static str,
    pub what: &'static str,
    /// Its unit; empty for a number without one.
    pub unit: &'static str,
    /// As printed.
    pub paper: f64,
    /// As computed here.
    pub here: f64,
    /// Digits after the point that are told.
    pub digits: usize,
    /// Why they differ; empty where they do not, beyond the printed digits.
    pub why: &'static str,
}

impl Row {
    /// Ours over the paper's, less one.
    pub fn difference(&self) -> f64 {
        self.here / self.paper - 1.0
    }

    /// Its columns in numbers.csv.
    pub(crate) fn cells(&self, section: &str) -> [String; 8] {
        let [paper, here, difference] =
            [self.paper, self.here, self.difference()].map(|x| x.to_string());
        let [section, place, what, unit, why] =
            [section, self.place, self.what, self.unit, self.why].map(str::to_owned);
        [section, place, what, unit, paper, here, difference, why]
    }

    /// The two numbers and their difference as text, without unit.
    pub fn told(&self) -> [String; 3] {
        let digits = self.digits;
        [
            format!("{:.digits$}", self.paper),
            format!("{:.digits$}", self.here),
            format!("{:+.2} %", 100.0 * self.difference()),
        ]
    }
}

/// Rows that belong together.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// What they are.
    pub title: &'static str,
    /// The rows.
    pub rows: Vec<Row>,
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
    /// [`AnyError`] where something that must work does not.
    pub fn compute() -> Result<Self, AnyError> {
        Self::of(&Runs::solve()?)
    }

    pub(crate) fn of(runs: &Runs) -> Result<Self, AnyError> {
        Ok(Self {
            sections: sections(here(runs)?),
            remarks: remarks(runs)?,
        })
    }

    /// The numbers that matter most, those of the contact, few enough for a screen.
    pub fn short(&self) -> String {
        lines(&self.sections[1..3]).join("\n")
    }

    /// All numbers, with remarks.
    pub fn text(&self) -> String {
        let mut lines = lines(&self.sections);
        lines.push(String::new());
        lines.extend(self.remarks.iter().cloned());
        lines.join("\n")
    }
}

fn lines(sections: &[Section]) -> Vec<String> {
    let head = ["paper", "this program", "difference"];
    let mut lines = vec![line("", head.map(str::to_owned), "")];
    for Section { title, rows } in sections {
        lines.push((*title).to_owned());
        let told = |row: &Row| line(row.what, row.told(), row.unit);
        lines.extend(rows.iter().map(told));
    }
    lines
}

fn line(what: &str, [paper, here, difference]: [String; 3], unit: &str) -> String {
    let text = format!("  {what:<58} {paper:>12} {here:>13} {difference:>10}  {unit}");
    text.trim_end().to_owned()
}

/// Sections with their rows: where the paper has a number, what it is, its unit, digits after the point that are told, the
/// printed number, and the name of the reason why ours differs.
const PRINTED: &str = "\
Table 1: what follows from its moduli
    Tab. 1 | copper, longitudinal speed c1 | m/s | 0 | 4597
    Tab. 1 | copper, shear speed c2        | m/s | 0 | 2263
    Tab. 1 | copper, lambda                | GPa | 2 | 97.53
    Tab. 1 | copper, shear modulus mu      | GPa | 1 | 45.9
    Tab. 1 | steel, longitudinal speed c1  | m/s | 0 | 5994
    Tab. 1 | steel, shear speed c2         | m/s | 0 | 3204
    Tab. 1 | steel, lambda                 | GPa | 2 | 120.6
    Tab. 1 | steel, shear modulus mu       | GPa | 1 | 80.4
Hertz without the half-space's deflection, (45)-(47)
    (46)       | peak force, copper at 123 GPa (Table 1)           | N  | 0 | 182191 | stiffer
    (46)       | peak force, copper at 129 GPa                     | N  | 0 | 182191
    (47)       | contact time with its 2.94, 123 GPa               | us | 2 | 24.6   | stiffer
    (47)       | contact time with its 2.94, 129 GPa               | us | 2 | 24.6
    after (47) | Kmax = Pmax/S/Rm, Rm = 227 MPa, 129 GPa           |    | 2 | 15.97
    after (47) | Kmax with the 57 MPa that the text names, 129 GPa |    | 2 | 15.97  | yield
Coupled with the half-space, converged
    Fig. 6 | peak force, 123 GPa                           | N   | 0 | 160e3 | rounded
    Fig. 6 | peak force, 129 GPa                           | N   | 0 | 160e3 | rounded
    Fig. 4 | contact time, 123 GPa                         | us  | 3 | 27.0  | step
    Fig. 4 | contact time, 129 GPa                         | us  | 3 | 27.0  | step
    Fig. 4 | restitution, 123 GPa                          |     | 5 | 0.991 | step
    Fig. 4 | restitution, 129 GPa                          |     | 5 | 0.991 | step
    Fig. 4 | velocity of departure, 129 GPa                | m/s | 2 | 99.1  | step
    Fig. 6 | Kmax with 227 MPa, 129 GPa                    |     | 2 | 14.11 | step
    Fig. 6 | drop of the peak force against Hertz, 129 GPa | %   | 2 | 11.6  | step
The paper's scheme (40)-(44), step 0.164 us, copper of 129 GPa
    Fig. 6 | peak force                           | N   | 0 | 160e3 | rounded
    Fig. 4 | contact time                         | us  | 3 | 27.0
    Fig. 4 | restitution                          |     | 5 | 0.991
    Fig. 4 | velocity of departure                | m/s | 2 | 99.1
    Fig. 6 | Kmax with 227 MPa                    |     | 2 | 14.11
    Fig. 6 | drop of the peak force against Hertz | %   | 2 | 11.6
Strength under impact, from the converged force
    section 5 | steel, over the yield point of 1000 MPa      | | 2 | 3.18
    section 5 | steel, over the tensile strength of 1200 MPa | | 2 | 2.65
    section 5 | copper, over the tensile strength of 227 MPa | | 2 | 14.0
    section 5 | copper, on the mushroom of 6 mm              | | 2 | 6.2
First arrivals
    Figs 8, 9 | P at (0, r0)                                  | us   | 2 | 0.67
    Figs 8, 9 | P at (0, 3 r0)                                | us   | 2 | 2.0   | 3 r0
    Figs 8, 9 | P at (0, 5 r0)                                | us   | 2 | 3.3
    Fig. 11   | P at (5 r0, 0), from the edge of the disc     | us   | 2 | 2.67
    section 4 | alpha_A, the weight of the super-seismic stage | 1e-3 | 3 | 0.785 | formula";

/// Why a number differs.
fn why(name: &str) -> &'static str {
    match name {
        "stiffer" => "the printed value belongs to copper of 129 GPa, Table 1 has 123 GPa",
        "yield" => {
            "57 MPa is the yield point of Table 1; the value was divided by its tensile strength, 227 MPa"
        }
        "rounded" => "160 kN is rounded: the printed Kmax of 14.11 is 161.0 kN",
        "step" => "time-step error of the explicit scheme, see its own rows below",
        "3 r0" => "the text has t = r0/c1; the number is that of 3 r0/c1",
        "formula" => "its own formula with its own numbers gives 0.774",
        _ => "",
    }
}

/// What is printed, with ours in the same order.
fn sections(here: Vec<f64>) -> Vec<Section> {
    let mut here = here.into_iter();
    let mut sections: Vec<Section> = Vec::new();
    for line in PRINTED.lines() {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        match (&cells[..], sections.last_mut()) {
            (&[place, what, unit, digits, paper, ref rest @ ..], Some(section)) => {
                section.rows.push(Row {
                    place,
                    what,
                    unit,
                    paper: paper.parse().unwrap_or(f64::NAN),
                    here: here.next().unwrap_or(f64::NAN),
                    digits: digits.parse().unwrap_or_default(),
                    why: rest.first().map_or("", |name| why(name)),
                });
            }
            (_, _) => sections.push(Section {
                title: line,
                rows: Vec::new(),
            }),
        }
    }
    sections
}

/// Our numbers, in the order of what is printed.
fn here(runs: &Runs) -> Result<Vec<f64>, AnyError> {
    let mut here = Vec::new();
    for name in ["copper", "steel"] {
        let material = Material::named(name)?;
        let mu = material.shear_modulus_pa();
        here.extend([
            material.longitudinal_speed_m_s().unwrap_or(f64::NAN),
            material.shear_speed_m_s().unwrap_or(f64::NAN),
            (material.longitudinal_modulus_pa() - 2.0 * mu) / 1e9,
            mu / 1e9,
        ]);
    }

    let alone = [&runs.hertz_table_1, &runs.hertz_printed];
    here.extend(alone.map(|run| run.peak_force_n));
    // (47) with the factor 2.94 of the paper; exactly it is 2.9433
    here.extend(alone.map(|run| US * (run.contact_time_s * 2.94 / CONTACT_TIME)));
    let hertz_n = runs.hertz_printed.peak_force_n;
    here.push(kmax(hertz_n, RADIUS_M));
    here.push(mean_pa(hertz_n, RADIUS_M) / NAMED_STRENGTH_PA);

    let table_1 = of_contact(&runs.table_1, &runs.hertz_table_1);
    let printed = of_contact(&runs.printed, &runs.hertz_printed);
    here.extend((0..3).flat_map(|i| [table_1[i], printed[i]]));
    here.extend(&printed[3..]);
    here.extend(of_contact(&runs.scheme, &runs.hertz_printed));

    // what the conclusions say about strength, on the rod and on its mushroom of 6 mm
    let peak_n = runs.table_1.peak_force_n;
    let rod_pa = mean_pa(peak_n, RADIUS_M);
    here.extend([1e9, 1.2e9, STRENGTH_PA].map(|strength_pa| rod_pa / strength_pa));
    here.push(mean_pa(peak_n, 0.006) / STRENGTH_PA);

    let impact = coupled(TABLE_1_PA, RADIUS_M)?;
    let block = anvil()?;
    let medium = Medium::new(block.material().poisson_ratio)?;
    let unit_us = US * RADIUS_M / block.longitudinal_speed_m_s();
    for (r, z) in [(0.0, 1.0), (0.0, 3.0), (0.0, 5.0), (5.0, 0.0)] {
        here.push(unit_us * Arrivals::new(&medium, Profile::Hertz, r, z)?.first());
    }
    here.push(1e3 * super_seismic(&block, &impact.collision(), RADIUS_M));
    Ok(here)
}

/// Peak force, contact time, restitution, velocity of departure, Kmax, and the drop of the force against Hertz's.
fn of_contact(run: &Run, hertz: &Run) -> [f64; 6] {
    [
        run.peak_force_n,
        US * run.contact_time_s,
        run.restitution,
        run.rebound_velocity_m_s,
        kmax(run.peak_force_n, RADIUS_M),
        100.0 * (1.0 - run.peak_force_n / hertz.peak_force_n),
    ]
}

/// What no row can hold, in sentences.
fn remarks(runs: &Runs) -> Result<Vec<String>, AnyError> {
    let medium = Medium::new(anvil()?.material().poisson_ratio)?;
    let at = |q: f64| {
        let [printed, right] = surface_stress(&medium, q);
        format!("{printed:+.4} with 2 and {right:+.4} with 4 at s r0/(c1 k r0) = {q}")
    };
    let growing = &runs.growing;
    Ok(vec![
        format!(
            "The second term of (24) has the coefficient 2; (2) asks for szz = -p at z = 0, which holds with 4: szz/p is {}, {}, {}.",
            at(0.5),
            at(1.0),
            at(2.0)
        ),
        "The paper gives no transform of the hoop stress; here it is theory.md (T6).".to_owned(),
        format!(
            "The paper's restitution of 0.991 is the time-step error of its scheme, which loses less than the waves take away: {:.4} with a step of 0.164 us, {:.3} with 0.5 us (the striker leaves faster than it came), {:.4} converged.",
            runs.scheme.restitution, runs.coarse.restitution, runs.printed.restitution
        ),
        format!(
            "Hertz's K holds the static deflection of the half-space already, so that (8) counts it twice: a contact whose radius follows the load, and which counts it once, has a peak force of {:.0} N, lasts {:.2} us and leaves with {:.2} m/s.",
            growing.peak_force_n,
            US * growing.contact_time_s,
            VELOCITY_M_S * growing.restitution
        ),
    ])
}

/// szz over p at z = 0 from (24) with the coefficients 2 and 4, at q = s/(k c1).
fn surface_stress(medium: &Medium, q: f64) -> [f64; 2] {
    let k = medium.kappa();
    let a = (1.0 + q * q).sqrt();
    let b = (1.0 + (q / k).powi(2)).sqrt();
    let g = 2.0 + (q / k).powi(2);
    let d = g * g - 4.0 * a * b;
    [2.0, 4.0].map(|coefficient| -(g * g - coefficient * a * b) / d)
}
