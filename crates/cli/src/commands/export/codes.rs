//! Inputs of LAMMPS and YADE: the numbers of a case, and scripts that take them.

use crate::commands::export::case::Case;
use std::f64::consts::PI;

/// Steps over the contact: more change the loss by less than 1e-3 of itself (`scripts/check-exports`).
const LAMMPS_STEPS: f64 = 400.0;
const YADE_STEPS: f64 = 4000.0;

impl Case {
    /// Its notes as comments, which all three formats have in the same way.
    pub(super) fn header(&self) -> String {
        let version = env!("CARGO_PKG_VERSION");
        let mut text = format!("# hertzlamb {version}: SI units\n");
        let warnings = self.run.warnings.iter();
        let warnings = warnings.map(|warning| format!("warning: {warning}"));
        for note in self.notes.iter().cloned().chain(warnings) {
            text += &format!("# {note}\n");
        }
        text
    }
}

/// An input of LAMMPS.
pub(super) fn lammps(case: &Case) -> String {
    let mut text = case.header();
    let mut variable = |name: &str, value: f64, what: &str| {
        text += &format!("variable {name:2} equal {value:<24?} # {what}\n");
    };
    variable("V", case.impact.velocity_m_s, "velocity of approach, m/s");
    let modulus_pa = case.impact.collision().effective_modulus_pa;
    variable("ES", modulus_pa, "E*, Pa");
    variable("E0", case.run.restitution, "restitution at V");
    if let Some(lag) = case.lag_m_s_n() {
        variable("C", lag, "J/(mu c2) of the block, m s/N");
    }
    for (number, [radius_m, mass_kg]) in (1..).zip(&case.balls) {
        variable(&format!("R{number}"), *radius_m, "radius of a ball, m");
        variable(&format!("M{number}"), *mass_kg, "its mass, kg");
    }
    variable("dt", case.run.contact_time_s / LAMMPS_STEPS, "time step, s");
    let parts: &[&str] = match (case.balls.len(), case.lag_m_s_n()) {
        (1, Some(_)) => &[BALL, PAIR, DASHPOT, BLOCK, RUN],
        (1, None) => &[BALL, PAIR, BLOCK, RUN],
        _ => &[BALL, SECOND, PAIR, RUN],
    };
    text + &parts.concat()
}

/// The parts of an input of LAMMPS.
const BALL: &str = "
units       si
atom_style  sphere
atom_modify map yes
boundary    f f f
comm_modify vel yes
variable    L equal 8*v_R1
region      box block $(-v_L) ${L} $(-v_L) ${L} $(-v_L) ${L}
create_box  1 box
create_atoms 1 single 0 0 ${R1}
set         atom 1 diameter $(2*v_R1)
set         atom 1 mass ${M1}
velocity    all set 0 0 $(-v_V)
variable    e equal vz[1]/v_V
";

const SECOND: &str = "
create_atoms 1 single 0 0 $(-v_R2)
set         atom 2 diameter $(2*v_R2)
set         atom 2 mass ${M2}
variable    e equal (vz[1]-vz[2])/v_V
";

const PAIR: &str = "
# balls on each other: Hertz's law with one restitution, without friction
pair_style  granular
pair_coeff  * * hertz $(4/3*v_ES) ${E0} tangential linear_nohistory 0 0 damping coeff_restitution
";

/// The dashpot on the contact's area needs no memory: it is a force on each ball above the plane z = 0. It stands before
/// the stock block, which it makes a comment.
const DASHPOT: &str = "
# the block below z = 0, for balls of any radius at any velocity; d is the depth, fz not below zero
variable    d  atom \"(z<radius)*(radius-z)\"
variable    f  atom \"4/3*v_ES*sqrt(radius)*v_d*sqrt(v_d)-4*v_C*v_ES^2*radius*v_d*vz\"
variable    fz atom \"(v_f>0)*v_f\"
fix         block all addforce 0 0 v_fz
# at V alone, the same by a stock model:
# ";

const BLOCK: &str = "fix block all wall/gran granular hertz $(4/3*v_ES) ${E0} tangential linear_nohistory 0 0 damping coeff_restitution zplane 0 NULL
";

const RUN: &str = "
fix         motion all nve/sphere
timestep    ${dt}
run         500
print       \"restitution $(v_e:%.10g)\"
";

/// A script for YADE.
pub(super) fn yade(case: &Case) -> String {
    let restitution = case.run.restitution;
    let (lag, beta) = match case.lag_m_s_n() {
        Some(lag) => (lag, 0.0),
        None => (0.0, damping(restitution)),
    };
    let body = case.impact.collision();
    let modulus_pa = body.effective_modulus_pa;
    let numbers = [
        ("V", case.impact.velocity_m_s, "velocity of approach, m/s"),
        ("E_STAR", modulus_pa, "1/E* = sum of (1 - nu^2)/E, Pa"),
        ("R", body.tip_radius_m, "radius of Hertz's law, m"),
        ("M", body.mass_kg, "mass of the motion, kg"),
        ("LAG", lag, "J/(mu c2) of the block, m s/N"),
        (
            "BETA",
            beta,
            "damping ratio of one restitution, 0 with the lag",
        ),
        ("STEP", case.run.contact_time_s / YADE_STEPS, "time step, s"),
    ];
    let mut text = case.header();
    for (name, value, what) in numbers {
        text += &format!("{name} = {value:?}  # {what}\n");
    }
    text += &format!("BALLS = {:?}  # radius in m and mass in kg\n", case.balls);
    text + include_str!("yade.py")
}

/// YADE's `betan` for a restitution e, whose force is not negative.
///
/// Without that cut the ratio is exact for Hertz's law, `sqrt(5/6) |ln e|/sqrt(pi^2 + ln^2 e)`, and with it the ball
/// leaves with e + 0.203 (1 - e)^2: within 1e-3 of it for e from 0.3 to 1.
fn damping(restitution: f64) -> f64 {
    let asked = 1.0 - (1.0 - (1.0 - 0.812 * (1.0 - restitution)).max(0.0).sqrt()) / 0.406;
    let decay = -asked.clamp(1e-3, 1.0).ln();
    (5.0_f64 / 6.0).sqrt() * decay / decay.hypot(PI)
}
