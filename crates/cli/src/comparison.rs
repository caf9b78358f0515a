//! The paper's numbers beside those of this program.

use crate::failure::Failure;
use contact::law::hertz;
use contact::validity::super_seismic;
use contact::{Collision, Model, Results, Scheme};
use halfspace::{Arrivals, Medium, Profile};
use impact::KernelChoice;
use impact::{Load, Outcome, Scene, Strike, simulate};
use std::f64::consts::PI;

/// The runs that the table of numbers needs.
#[derive(Debug)]
pub(crate) struct Comparison {
    /// The scene with Table 1.
    pub(crate) table_1: Scene,
    /// Model wave with copper at 123 GPa (Table 1), with its fields.
    pub(crate) coupled: Outcome,
    numbers: Numbers,
}

/// Results of the variants, without fields.
#[derive(Debug)]
struct Numbers {
    /// Model wave with copper at 123 GPa (Table 1).
    coupled: Results,
    /// The same at 129 GPa.
    coupled_129: Results,
    /// The paper's scheme at 129 GPa with a step of 0.135 us.
    explicit: Results,
    /// The same with a step of 0.5 us.
    explicit_coarse: Results,
    /// Hertz at 123 GPa.
    hertz: Results,
    /// Hertz at 129 GPa.
    hertz_129: Results,
    /// Area of the rod in m^2.
    area_m2: f64,
    /// Load in N that the tensile strength of 227 MPa carries on that area.
    strength_n: f64,
}

/// Young's modulus of copper in Pa with which the paper's own numbers agree.
const STIFFER_PA: f64 = 129e9;

struct Row {
    what: &'static str,
    unit: &'static str,
    paper: f64,
    found: f64,
    digits: usize,
}

impl Row {
    fn text(&self) -> String {
        let digits = self.digits;
        let difference = 100.0 * (self.found / self.paper - 1.0);
        format!(
            "{:<58} {:>12.digits$} {:>12.digits$} {:>+9.2} %  {}",
            self.what, self.paper, self.found, difference, self.unit
        )
    }
}

fn heading() -> String {
    format!(
        "{:<58} {:>12} {:>12} {:>11}",
        "", "paper", "this program", "difference"
    )
}

fn row(what: &'static str, unit: &'static str, paper: f64, found: f64, digits: usize) -> Row {
    Row {
        what,
        unit,
        paper,
        found,
        digits,
    }
}

fn strike(scene: &Scene) -> Result<&Strike, Failure> {
    match &scene.load {
        Load::Strike(strike) => Ok(strike),
        Load::Record(_) => Err(Failure::work("the paper's scene has no striker")),
    }
}

/// The results of a variant of a scene, without fields.
fn variant(scene: &Scene, change: impl FnOnce(&mut Scene)) -> Result<Results, Failure> {
    let mut scene = scene.clone();
    scene.probes.clear();
    change(&mut scene);
    let outcome = simulate(&scene, &KernelChoice::Direct)?;
    outcome
        .results()
        .copied()
        .ok_or_else(|| Failure::work("the paper's scene has no striker"))
}

fn stiffen(scene: &mut Scene) {
    if let Load::Strike(strike) = &mut scene.load {
        strike.striker.material.youngs_modulus_pa = STIFFER_PA;
    }
}

impl Comparison {
    /// Runs the variants of the paper's scene, whose own outcome is given.
    pub(crate) fn new(table_1: Scene, coupled: Outcome) -> Result<Self, Failure> {
        let radius = strike(&table_1)?.striker.tip_radius_m;
        let area_m2 = PI * radius * radius;
        let explicit = |step_s: f64| {
            variant(&table_1, |scene| {
                stiffen(scene);
                scene.settings.scheme = Scheme::Explicit;
                scene.settings.step_s = Some(step_s);
            })
        };
        let hertz = |scene: &mut Scene| scene.settings.model = Model::Hertz;
        let numbers = Numbers {
            coupled: variant(&table_1, |_| ())?,
            coupled_129: variant(&table_1, stiffen)?,
            explicit: explicit(1.35e-7)?,
            explicit_coarse: explicit(5e-7)?,
            hertz: variant(&table_1, hertz)?,
            hertz_129: variant(&table_1, |scene| {
                stiffen(scene);
                hertz(scene);
            })?,
            area_m2,
            strength_n: 227e6 * area_m2,
        };
        Ok(Self {
            table_1,
            coupled,
            numbers,
        })
    }

    /// The whole table as text.
    /// The numbers that matter most, few enough for a screen.
    pub(crate) fn short(&self) -> String {
        let mut lines = vec![heading()];
        let sections = [
            ("Hertz", self.numbers.hertz_rows()),
            ("Coupled with the half-space", self.numbers.coupled_rows()),
        ];
        for (title, rows) in sections {
            lines.push(title.to_owned());
            lines.extend(rows.iter().map(|row| format!("  {}", row.text())));
        }
        lines.join("\n")
    }

    /// All numbers, with remarks.
    pub(crate) fn text(&self) -> Result<String, Failure> {
        let medium =
            Medium::new(self.table_1.target.material().poisson_ratio).map_err(Failure::work)?;
        let numbers = &self.numbers;
        let sections: [(&str, Vec<Row>); 5] = [
            ("Hertz, (45)-(47)", numbers.hertz_rows()),
            (
                "Coupled with the half-space, converged",
                numbers.coupled_rows(),
            ),
            (
                "The paper's explicit scheme (40)-(44), step 0.135 us, 129 GPa: its time-step error",
                numbers.explicit_rows(),
            ),
            (
                "Dynamic strength ratios of the conclusions, from the converged force at 123 GPa",
                numbers.strength_rows(),
            ),
            ("Other numbers", self.other_rows(&medium)?),
        ];
        let mut lines = vec![heading()];
        for (title, rows) in sections {
            lines.push(String::new());
            lines.push(title.to_owned());
            lines.extend(rows.iter().map(|row| format!("  {}", row.text())));
        }
        lines.push(String::new());
        lines.extend(remarks(&medium, numbers));
        Ok(lines.join("\n"))
    }

    fn other_rows(&self, medium: &Medium) -> Result<Vec<Row>, Failure> {
        let Strike {
            striker,
            velocity_m_s,
        } = strike(&self.table_1)?;
        let target = &self.table_1.target;
        let (radius, collision) = (
            striker.tip_radius_m,
            Collision::new(target, striker, *velocity_m_s),
        );
        let arrival = Arrivals::new(medium, Profile::Hertz, 0.0, 3.0).map_err(Failure::work)?;
        Ok(vec![
            row(
                "alpha_A of its own formula",
                "1e-3",
                0.785,
                1e3 * super_seismic(target, &collision, radius),
                3,
            ),
            row(
                "first wave at (0, 3 r0); printed as \"r0/c1\", it is 3 r0/c1",
                "us",
                2.0,
                US * arrival.first() * radius / target.longitudinal_speed_m_s(),
                3,
            ),
        ])
    }
}

/// Microseconds in a second.
const US: f64 = 1e6;

impl Numbers {
    fn hertz_rows(&self) -> Vec<Row> {
        vec![
            row(
                "peak force, copper at 123 GPa (Table 1)",
                "N",
                182_191.0,
                self.hertz.peak_force_n,
                0,
            ),
            row(
                "peak force, copper at 129 GPa",
                "N",
                182_191.0,
                self.hertz_129.peak_force_n,
                0,
            ),
            row(
                "contact time (47) with its 2.94, 123 GPa",
                "us",
                24.6,
                US * rounded(&self.hertz),
                2,
            ),
            row(
                "contact time (47) with its 2.94, 129 GPa",
                "us",
                24.6,
                US * rounded(&self.hertz_129),
                2,
            ),
            row(
                "Kmax = Pmax/S/Rm with Rm = 227 MPa, 129 GPa",
                "",
                15.97,
                self.hertz_129.peak_force_n / self.strength_n,
                2,
            ),
            row(
                "Kmax with the 57 MPa that the paper names, 129 GPa",
                "",
                15.97,
                self.hertz_129.peak_force_n / (57e6 * self.area_m2),
                2,
            ),
        ]
    }

    fn coupled_rows(&self) -> Vec<Row> {
        vec![
            row(
                "peak force, 123 GPa",
                "N",
                160_000.0,
                self.coupled.peak_force_n,
                0,
            ),
            row(
                "peak force, 129 GPa",
                "N",
                160_000.0,
                self.coupled_129.peak_force_n,
                0,
            ),
            row(
                "contact time, 123 GPa",
                "us",
                27.0,
                US * self.coupled.contact_time_s,
                3,
            ),
            row(
                "contact time, 129 GPa",
                "us",
                27.0,
                US * self.coupled_129.contact_time_s,
                3,
            ),
            row(
                "restitution, 123 GPa",
                "",
                0.991,
                self.coupled.restitution,
                5,
            ),
            row(
                "restitution, 129 GPa",
                "",
                0.991,
                self.coupled_129.restitution,
                5,
            ),
            row(
                "Kmax with 227 MPa, 129 GPa",
                "",
                14.11,
                self.coupled_129.peak_force_n / self.strength_n,
                2,
            ),
            row(
                "drop of the peak force against Hertz, 129 GPa",
                "%",
                11.6,
                100.0 * (1.0 - self.coupled_129.peak_force_n / self.hertz_129.peak_force_n),
                2,
            ),
        ]
    }

    fn explicit_rows(&self) -> Vec<Row> {
        vec![
            row("peak force", "N", 160_000.0, self.explicit.peak_force_n, 0),
            row(
                "contact time",
                "us",
                27.0,
                US * self.explicit.contact_time_s,
                3,
            ),
            row("restitution", "", 0.991, self.explicit.restitution, 5),
            row(
                "velocity of departure",
                "m/s",
                99.1,
                self.explicit.rebound_velocity_m_s,
                2,
            ),
        ]
    }

    fn strength_rows(&self) -> Vec<Row> {
        vec![
            row(
                "steel, over the yield point 1000 MPa",
                "",
                3.18,
                self.coupled.peak_force_n / self.area_m2 / 1e9,
                2,
            ),
            row(
                "steel, over the tensile strength 1200 MPa",
                "",
                2.65,
                self.coupled.peak_force_n / self.area_m2 / 1.2e9,
                2,
            ),
            row(
                "copper, over the tensile strength 227 MPa",
                "",
                14.0,
                self.coupled.peak_force_n / self.strength_n,
                2,
            ),
            row(
                "copper, on the mushroom of 6 mm",
                "",
                6.2,
                self.coupled.peak_force_n / (PI * 0.006 * 0.006 * 227e6),
                2,
            ),
        ]
    }
}

/// What the table does not show.
fn remarks(medium: &Medium, numbers: &Numbers) -> Vec<String> {
    let mut lines = vec![
        "Coefficient of the second term of (24), which must leave szz(z = 0) = -p:".to_owned(),
    ];
    for (slowness, printed, right) in [0.5, 1.0, 2.0].map(|s| surface_stress(medium, s)) {
        lines.push(format!(
            "  s r0/(c1 k r0) = {slowness:<4}  szz/p = {printed:+.6} with the printed 2, {right:+.6} with 4"
        ));
    }
    lines.push(format!(
        "The paper's 0.991 is the time-step error of its scheme, which loses less than the waves take away: its restitution is {:.4} with a step of ts/200, {:.3} with ts/54, and {:.4} converged.",
        numbers.explicit.restitution,
        numbers.explicit_coarse.restitution,
        numbers.coupled_129.restitution
    ));
    lines
}

/// (47) with the factor 2.94 of the paper; exactly it is 2.9433.
fn rounded(hertz: &Results) -> f64 {
    hertz.contact_time_s * 2.94 / hertz::CONTACT_TIME
}

/// szz over -(load) at z = 0 from (24) with coefficient 2 and with 4, at q = s/(k c1).
fn surface_stress(medium: &Medium, q: f64) -> (f64, f64, f64) {
    let k = medium.kappa();
    let a = (1.0 + q * q).sqrt();
    let b = (1.0 + (q / k).powi(2)).sqrt();
    let g = 2.0 + (q / k).powi(2);
    let d = g * g - 4.0 * a * b;
    let stress = |coefficient: f64| -(g * g - coefficient * a * b) / d;
    (q, stress(2.0), stress(4.0))
}
