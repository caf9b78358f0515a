//! The paper's numbers beside those of this program.

use crate::failure::Failure;
use halfspace::{Arrivals, Medium, Profile};
use impact::scene::Load;
use impact::validity::super_seismic;
use impact::{Outcome, Results, Scene};
use std::f64::consts::PI;

/// The runs that the table of numbers needs.
#[derive(Debug)]
pub(crate) struct Comparison {
    /// The scene with Table 1.
    pub(crate) table_1: Scene,
    /// Model wave with copper at 123 GPa (Table 1).
    pub(crate) coupled: Outcome,
    /// The same at 129 GPa.
    pub(crate) coupled_129: Outcome,
    /// The paper's scheme at 129 GPa with a step of 0.135 us.
    pub(crate) explicit_129: Outcome,
    /// The same with a step of 0.5 us.
    pub(crate) explicit_coarse: Outcome,
    /// Hertz at 123 GPa.
    pub(crate) hertz: Outcome,
    /// Hertz at 129 GPa.
    pub(crate) hertz_129: Outcome,
}

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

fn row(what: &'static str, unit: &'static str, paper: f64, found: f64, digits: usize) -> Row {
    Row {
        what,
        unit,
        paper,
        found,
        digits,
    }
}

impl Comparison {
    /// The whole table as text.
    pub(crate) fn text(&self) -> Result<String, Failure> {
        let Load::Strike(striker) = &self.table_1.load else {
            return Err(Failure::work("the paper's scene has no striker"));
        };
        let radius = striker.tip_radius_m;
        let area = PI * radius * radius;
        let medium = Medium::new(self.table_1.target.poisson_ratio).map_err(Failure::work)?;
        let speed = self
            .table_1
            .target
            .longitudinal_speed_m_s()
            .unwrap_or(f64::NAN);
        let arrival = Arrivals::new(&medium, Profile::Hertz, 0.0, 3.0).map_err(Failure::work)?;
        let us = 1e6;
        let [hertz, hertz_129] = [&self.hertz, &self.hertz_129].map(|o| o.results);
        let [coupled, coupled_129, explicit] =
            [&self.coupled, &self.coupled_129, &self.explicit_129].map(|o| o.results);
        let strength = 227e6 * area;
        let sections: [(&str, Vec<Row>); 5] = [
            (
                "Hertz, (45)-(47)",
                vec![
                    row(
                        "peak force, copper at 123 GPa (Table 1)",
                        "N",
                        182_191.0,
                        hertz.peak_force_n,
                        0,
                    ),
                    row(
                        "peak force, copper at 129 GPa",
                        "N",
                        182_191.0,
                        hertz_129.peak_force_n,
                        0,
                    ),
                    row(
                        "contact time (47) with its 2.94, 123 GPa",
                        "us",
                        24.6,
                        us * rounded(&hertz),
                        2,
                    ),
                    row(
                        "contact time (47) with its 2.94, 129 GPa",
                        "us",
                        24.6,
                        us * rounded(&hertz_129),
                        2,
                    ),
                    row(
                        "Kmax = Pmax/S/Rm with Rm = 227 MPa, 129 GPa",
                        "",
                        15.97,
                        hertz_129.peak_force_n / strength,
                        2,
                    ),
                    row(
                        "Kmax with the 57 MPa that the paper names, 129 GPa",
                        "",
                        15.97,
                        hertz_129.peak_force_n / (57e6 * area),
                        2,
                    ),
                ],
            ),
            (
                "Coupled with the half-space, converged",
                vec![
                    row(
                        "peak force, 123 GPa",
                        "N",
                        160_000.0,
                        coupled.peak_force_n,
                        0,
                    ),
                    row(
                        "peak force, 129 GPa",
                        "N",
                        160_000.0,
                        coupled_129.peak_force_n,
                        0,
                    ),
                    row(
                        "contact time, 123 GPa",
                        "us",
                        27.0,
                        us * coupled.contact_time_s,
                        3,
                    ),
                    row(
                        "contact time, 129 GPa",
                        "us",
                        27.0,
                        us * coupled_129.contact_time_s,
                        3,
                    ),
                    row("restitution, 123 GPa", "", 0.991, coupled.restitution, 5),
                    row(
                        "restitution, 129 GPa",
                        "",
                        0.991,
                        coupled_129.restitution,
                        5,
                    ),
                    row(
                        "Kmax with 227 MPa, 129 GPa",
                        "",
                        14.11,
                        coupled_129.peak_force_n / strength,
                        2,
                    ),
                    row(
                        "drop of the peak force against Hertz, 129 GPa",
                        "%",
                        11.6,
                        100.0 * (1.0 - coupled_129.peak_force_n / hertz_129.peak_force_n),
                        2,
                    ),
                ],
            ),
            (
                "The paper's explicit scheme (40)-(44), step 0.135 us, 129 GPa: its time-step error",
                vec![
                    row("peak force", "N", 160_000.0, explicit.peak_force_n, 0),
                    row("contact time", "us", 27.0, us * explicit.contact_time_s, 3),
                    row("restitution", "", 0.991, explicit.restitution, 5),
                    row(
                        "velocity of departure",
                        "m/s",
                        99.1,
                        explicit.rebound_velocity_m_s,
                        2,
                    ),
                ],
            ),
            (
                "Dynamic strength ratios of the conclusions, from the converged force at 123 GPa",
                vec![
                    row(
                        "steel, over the yield point 1000 MPa",
                        "",
                        3.18,
                        coupled.peak_force_n / area / 1e9,
                        2,
                    ),
                    row(
                        "steel, over the tensile strength 1200 MPa",
                        "",
                        2.65,
                        coupled.peak_force_n / area / 1.2e9,
                        2,
                    ),
                    row(
                        "copper, over the tensile strength 227 MPa",
                        "",
                        14.0,
                        coupled.peak_force_n / strength,
                        2,
                    ),
                    row(
                        "copper, on the mushroom of 6 mm",
                        "",
                        6.2,
                        coupled.peak_force_n / (PI * 0.006 * 0.006 * 227e6),
                        2,
                    ),
                ],
            ),
            (
                "Other numbers",
                vec![
                    row(
                        "alpha_A of its own formula",
                        "1e-3",
                        0.785,
                        1e3 * super_seismic(&self.table_1, striker, radius),
                        3,
                    ),
                    row(
                        "first wave at (0, 3 r0); printed as \"r0/c1\", it is 3 r0/c1",
                        "us",
                        2.0,
                        us * arrival.first() * radius / speed,
                        3,
                    ),
                ],
            ),
        ];
        let mut lines = vec![format!(
            "{:<58} {:>12} {:>12} {:>11}",
            "", "paper", "this program", "difference"
        )];
        for (title, rows) in sections {
            lines.push(String::new());
            lines.push(title.to_owned());
            lines.extend(rows.iter().map(|row| format!("  {}", row.text())));
        }
        lines.push(String::new());
        lines.push(
            "Coefficient of the second term of (24), which must leave szz(z = 0) = -p:".to_owned(),
        );
        for (slowness, printed, right) in [0.5, 1.0, 2.0].map(|s| surface_stress(&medium, s)) {
            lines.push(format!(
                "  s r0/(c1 k r0) = {slowness:<4}  szz/p = {printed:+.6} with the printed 2, {right:+.6} with 4"
            ));
        }
        lines.push(format!(
            "The paper's 0.991 is the time-step error of its scheme, which loses less than the waves take away: its restitution is {:.4} with a step of ts/200, {:.3} with ts/54, and {:.4} converged.",
            explicit.restitution,
            self.explicit_coarse.results.restitution,
            coupled_129.restitution
        ));
        Ok(lines.join("\n"))
    }
}

/// (47) with the factor 2.94 of the paper; exactly it is 2.9433.
fn rounded(hertz: &Results) -> f64 {
    hertz.contact_time_s * 2.94 / impact::contact::hertz::CONTACT_TIME
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
