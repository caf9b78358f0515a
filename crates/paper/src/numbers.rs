//! Every number that the paper prints, with our result.

use crate::case::{NAMED_STRENGTH_PA, RADIUS_M, Runs, STRENGTH_PA, TABLE_1_PA, VELOCITY_M_S};
use crate::case::{anvil, coupled, kmax, mean_pa};
use contact::law::hertz::CONTACT_TIME;
use contact::{HalfSpace, Material, super_seismic};
use fault::AnyError;
use halfspace::{Arrivals, Medium, Profile};
use impact::Run;

/// A number of the paper and our result.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Place in the paper: an equation, figure, table or section.
    pub place: &'static str,
    pub what: &'static str,
    /// Unit; empty for a dimensionless number.
    pub unit: &'static str,
    /// Printed value.
    pub paper: f64,
    /// Our value.
    pub here: f64,
    /// Number of digits after the decimal point to print.
    pub digits: usize,
    /// Reason for the difference; empty if the printed digits agree.
    pub why: &'static str,
}

impl Row {
    /// Relative difference of our value from the paper's.
    pub fn difference(&self) -> f64 {
        self.here / self.paper - 1.0
    }

    /// Columns of the row in numbers.csv.
    pub(crate) fn cells(&self, section: &str) -> [String; 8] {
        let [paper, here, difference] =
            [self.paper, self.here, self.difference()].map(|x| x.to_string());
        let [section, place, what, unit, why] =
            [section, self.place, self.what, self.unit, self.why].map(str::to_owned);
        [section, place, what, unit, paper, here, difference, why]
    }

    /// Text of the two values and of their difference, without unit.
    pub fn told(&self) -> [String; 3] {
        let digits = self.digits;
        [
            format!("{:.digits$}", self.paper),
            format!("{:.digits$}", self.here),
            format!("{:+.2} %", 100.0 * self.difference()),
        ]
    }
}

/// A section of rows.
#[derive(Debug, Clone, PartialEq)]
pub struct PrintedSection {
    /// Title.
    pub title: &'static str,
    /// Rows.
    pub rows: Vec<Row>,
}

/// Every number that the paper prints, with our result.
#[derive(Debug, Clone, PartialEq)]
pub struct Numbers {
    /// Sections, in the order of the paper.
    pub sections: Vec<PrintedSection>,
    /// Remarks on the paper that are not a comparison of numbers, one sentence each.
    pub remarks: Vec<String>,
}

/// Microseconds in a second.
const US: f64 = 1e6;

impl Numbers {
    /// Solves the contacts.
    ///
    /// # Errors
    /// [`AnyError`] if a contact or field of the paper's case cannot be computed.
    pub fn compute() -> Result<Self, AnyError> {
        Self::of(&Runs::solve()?)
    }

    pub(crate) fn of(runs: &Runs) -> Result<Self, AnyError> {
        Ok(Self {
            sections: sections(runs)?,
            remarks: remarks(runs)?,
        })
    }

    /// Text with the most important numbers, those of the contact, for one screen.
    pub fn short(&self) -> String {
        lines(&self.sections[1..3]).join("\n")
    }

    /// Text with all numbers and remarks.
    pub fn text(&self) -> String {
        let mut lines = lines(&self.sections);
        lines.push(String::new());
        lines.extend(self.remarks.iter().cloned());
        lines.join("\n")
    }
}

fn lines(sections: &[PrintedSection]) -> Vec<String> {
    let head = ["paper", "this program", "difference"];
    let mut lines = vec![line("", head.map(str::to_owned), "")];
    for PrintedSection { title, rows } in sections {
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

/// A number that the paper prints, with the function that computes ours.
struct Printed {
    place: &'static str,
    what: &'static str,
    unit: &'static str,
    digits: usize,
    paper: f64,
    why: &'static str,
    ours: fn(&Ours<'_>) -> Result<f64, AnyError>,
}

macro_rules! why_or_none {
    () => {
        ""
    };
    ($why:ident) => {
        $why
    };
}

macro_rules! printed {
    ($($title:literal { $($place:literal | $what:literal | $unit:literal | $digits:literal
        | $paper:literal $(($why:ident))? = |$o:ident| $ours:expr;)* })*) => {
        &[$(($title, &[$(Printed {
            place: $place,
            what: $what,
            unit: $unit,
            digits: $digits,
            paper: $paper,
            why: why_or_none!($($why)?),
            ours: |$o| Ok($ours),
        },)*]),)*]
    };
}

/// Sections with their rows: place in the paper, quantity, unit, digits after the decimal point, printed number, reason
/// for a difference in parentheses, and our number.
const PRINTED: &[(&str, &[Printed])] = printed! {
    "Table 1: quantities that follow from its moduli" {
        "Tab. 1" | "copper, longitudinal speed c1" | "m/s" | 0 | 4597.0 = |o| longitudinal_m_s(&o.copper);
        "Tab. 1" | "copper, shear speed c2"        | "m/s" | 0 | 2263.0 = |o| shear_m_s(&o.copper);
        "Tab. 1" | "copper, lambda"                | "GPa" | 2 | 97.53  = |o| lambda_gpa(&o.copper);
        "Tab. 1" | "copper, shear modulus mu"      | "GPa" | 1 | 45.9   = |o| o.copper.shear_modulus_pa() / 1e9;
        "Tab. 1" | "steel, longitudinal speed c1"  | "m/s" | 0 | 5994.0 = |o| longitudinal_m_s(&o.steel);
        "Tab. 1" | "steel, shear speed c2"         | "m/s" | 0 | 3204.0 = |o| shear_m_s(&o.steel);
        "Tab. 1" | "steel, lambda"                 | "GPa" | 2 | 120.6  = |o| lambda_gpa(&o.steel);
        "Tab. 1" | "steel, shear modulus mu"       | "GPa" | 1 | 80.4   = |o| o.steel.shear_modulus_pa() / 1e9;
    }
    "Hertz without the half-space's deflection, (45)-(47)" {
        "(46)" | "peak force, copper at 123 GPa (Table 1)"  | "N"  | 0 | 182191.0 (STIFFER) = |o| o.runs.hertz_table_1.peak_force_n;
        "(46)" | "peak force, copper at 129 GPa"            | "N"  | 0 | 182191.0 = |o| o.runs.hertz_printed.peak_force_n;
        "(47)" | "contact time with its 2.94, 123 GPa"      | "us" | 2 | 24.6 (STIFFER) = |o| hertz_time_us(&o.runs.hertz_table_1);
        "(47)" | "contact time with its 2.94, 129 GPa"      | "us" | 2 | 24.6 = |o| hertz_time_us(&o.runs.hertz_printed);
        "after (47)" | "Kmax = Pmax/S/Rm, Rm = 227 MPa, 129 GPa" | ""  | 2 | 15.97 = |o| kmax(o.runs.hertz_printed.peak_force_n, RADIUS_M);
        "after (47)" | "Kmax with the 57 MPa that the text names, 129 GPa" | "" | 2 | 15.97 (YIELD)
            = |o| mean_pa(o.runs.hertz_printed.peak_force_n, RADIUS_M) / NAMED_STRENGTH_PA;
    }
    "Coupled with the half-space, converged" {
        "Fig. 6" | "peak force, 123 GPa"           | "N"   | 0 | 160e3 (ROUNDED) = |o| o.runs.table_1.peak_force_n;
        "Fig. 6" | "peak force, 129 GPa"           | "N"   | 0 | 160e3 (ROUNDED) = |o| o.runs.printed.peak_force_n;
        "Fig. 4" | "contact time, 123 GPa"         | "us"  | 3 | 27.0  (STEP_ERROR) = |o| time_us(&o.runs.table_1);
        "Fig. 4" | "contact time, 129 GPa"         | "us"  | 3 | 27.0  (STEP_ERROR) = |o| time_us(&o.runs.printed);
        "Fig. 4" | "restitution, 123 GPa"          | ""    | 5 | 0.991 (STEP_ERROR) = |o| o.runs.table_1.restitution;
        "Fig. 4" | "restitution, 129 GPa"          | ""    | 5 | 0.991 (STEP_ERROR) = |o| o.runs.printed.restitution;
        "Fig. 4" | "velocity of departure, 129 GPa" | "m/s" | 2 | 99.1 (STEP_ERROR) = |o| o.runs.printed.rebound_velocity_m_s;
        "Fig. 6" | "Kmax with 227 MPa, 129 GPa"    | ""    | 2 | 14.11 (STEP_ERROR) = |o| kmax(o.runs.printed.peak_force_n, RADIUS_M);
        "Fig. 6" | "drop of the peak force against Hertz, 129 GPa" | "%" | 2 | 11.6 (STEP_ERROR) = |o| drop_percent(&o.runs.printed, o);
    }
    "The paper's scheme (40)-(44), step 0.164 us, copper of 129 GPa" {
        "Fig. 6" | "peak force"            | "N"   | 0 | 160e3 (ROUNDED) = |o| o.runs.scheme.peak_force_n;
        "Fig. 4" | "contact time"          | "us"  | 3 | 27.0  = |o| time_us(&o.runs.scheme);
        "Fig. 4" | "restitution"           | ""    | 5 | 0.991 = |o| o.runs.scheme.restitution;
        "Fig. 4" | "velocity of departure" | "m/s" | 2 | 99.1  = |o| o.runs.scheme.rebound_velocity_m_s;
        "Fig. 6" | "Kmax with 227 MPa"     | ""    | 2 | 14.11 = |o| kmax(o.runs.scheme.peak_force_n, RADIUS_M);
        "Fig. 6" | "drop of the peak force against Hertz" | "%" | 2 | 11.6 = |o| drop_percent(&o.runs.scheme, o);
    }
    "Strength under impact, from the converged force" {
        "section 5" | "steel, over the yield point of 1000 MPa"      | "" | 2 | 3.18 = |o| o.on_rod_pa() / 1e9;
        "section 5" | "steel, over the tensile strength of 1200 MPa" | "" | 2 | 2.65 = |o| o.on_rod_pa() / 1.2e9;
        "section 5" | "copper, over the tensile strength of 227 MPa" | "" | 2 | 14.0 = |o| o.on_rod_pa() / STRENGTH_PA;
        "section 5" | "copper, on the mushroom of 6 mm"              | "" | 2 | 6.2
            = |o| mean_pa(o.runs.table_1.peak_force_n, 0.006) / STRENGTH_PA;
    }
    "First arrivals" {
        "Figs 8, 9" | "P at (0, r0)"   | "us" | 2 | 0.67 = |o| o.first_us(0.0, 1.0)?;
        "Figs 8, 9" | "P at (0, 3 r0)" | "us" | 2 | 2.0 (THREE_RADII) = |o| o.first_us(0.0, 3.0)?;
        "Figs 8, 9" | "P at (0, 5 r0)" | "us" | 2 | 3.3 = |o| o.first_us(0.0, 5.0)?;
        "Fig. 11"   | "P at (5 r0, 0), from the edge of the disc" | "us" | 2 | 2.67 = |o| o.first_us(5.0, 0.0)?;
        "section 4" | "alpha_A, the weight of the super-seismic stage" | "1e-3" | 3 | 0.785 (FORMULA)
            = |o| 1e3 * super_seismic(&o.block, &coupled(TABLE_1_PA, RADIUS_M)?.collision(), RADIUS_M);
    }
};

// reasons for differences
const STIFFER: &str = "the printed value belongs to copper of 129 GPa, Table 1 has 123 GPa";
const YIELD: &str =
    "57 MPa is the yield point of Table 1; the value was divided by its tensile strength, 227 MPa";
const ROUNDED: &str = "160 kN is rounded: the printed Kmax of 14.11 is 161.0 kN";
const STEP_ERROR: &str = "time-step error of the explicit scheme, see its own rows below";
const THREE_RADII: &str = "the text has t = r0/c1; the number is that of 3 r0/c1";
const FORMULA: &str = "its own formula with its own numbers gives 0.774";

/// Bodies and solved contacts for our numbers.
struct Ours<'a> {
    runs: &'a Runs,
    copper: Material,
    steel: Material,
    block: HalfSpace,
}

impl Ours<'_> {
    /// Mean pressure in Pa of the largest force on the section of the rod.
    fn on_rod_pa(&self) -> f64 {
        mean_pa(self.runs.table_1.peak_force_n, RADIUS_M)
    }

    /// First arrival in us at a point (r, z) in r0.
    fn first_us(&self, r: f64, z: f64) -> Result<f64, AnyError> {
        let medium = Medium::new(self.block.material().poisson_ratio)?;
        let unit_us = US * RADIUS_M / self.block.longitudinal_speed_m_s();
        Ok(unit_us * Arrivals::new(&medium, Profile::Hertz, r, z)?.first())
    }
}

fn longitudinal_m_s(material: &Material) -> f64 {
    material.longitudinal_speed_m_s().unwrap_or(f64::NAN)
}

fn shear_m_s(material: &Material) -> f64 {
    material.shear_speed_m_s().unwrap_or(f64::NAN)
}

fn lambda_gpa(material: &Material) -> f64 {
    (material.longitudinal_modulus_pa() - 2.0 * material.shear_modulus_pa()) / 1e9
}

fn time_us(run: &Run) -> f64 {
    US * run.contact_time_s
}

/// Contact time in us by (47) with the paper's factor 2.94; the exact factor is 2.9433.
fn hertz_time_us(run: &Run) -> f64 {
    US * (run.contact_time_s * 2.94 / CONTACT_TIME)
}

/// Drop of the peak force in percent relative to Hertz's for copper of the same modulus.
fn drop_percent(run: &Run, ours: &Ours<'_>) -> f64 {
    100.0 * (1.0 - run.peak_force_n / ours.runs.hertz_printed.peak_force_n)
}

/// The printed numbers with ours.
fn sections(runs: &Runs) -> Result<Vec<PrintedSection>, AnyError> {
    let ours = Ours {
        runs,
        copper: Material::named("copper")?,
        steel: Material::named("steel")?,
        block: anvil()?,
    };
    let row = |printed: &Printed| {
        Ok(Row {
            place: printed.place,
            what: printed.what,
            unit: printed.unit,
            paper: printed.paper,
            here: (printed.ours)(&ours)?,
            digits: printed.digits,
            why: printed.why,
        })
    };
    let section = |(title, rows): &(&'static str, &[Printed])| {
        let rows = rows.iter().map(row).collect::<Result<_, AnyError>>()?;
        Ok(PrintedSection { title, rows })
    };
    PRINTED.iter().map(section).collect()
}

/// The remarks.
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
            "The paper's restitution of 0.991 is the time-step error of its scheme, which loses less energy than the waves carry away: {:.4} with a step of 0.164 us, {:.3} with 0.5 us (the striker leaves faster than it came), {:.4} converged.",
            runs.scheme.restitution, runs.coarse.restitution, runs.printed.restitution
        ),
        format!(
            "Hertz's K already includes the static deflection of the half-space, so that (8) counts it twice. A contact whose radius follows the load counts it once: it has a peak force of {:.0} N, lasts {:.2} us and leaves with {:.2} m/s.",
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
