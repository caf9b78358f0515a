//! Inputs of LAMMPS and YADE: the numbers of a case and its laws, and scripts that use them.

use crate::commands::export::case::Case;
use crate::commands::export::law::{Laws, PairLaw};

/// Hertz's contact time over (m^2/(E*^2 R v))^(1/5).
const HERTZ_TIME: f64 = 2.868;

/// Time steps per shortest contact between balls of a file. More steps change the loss by a relative 1e-3 at most
/// (`scripts/check-exports`).
const LAMMPS_STEPS: f64 = 250.0;
const YADE_STEPS: f64 = 2500.0;

/// Steps per shortest contact below which a run stops. With this number the loss of the area dashpot is accurate to 2 %
/// (`scripts/check-exports`); with 1/10 to 1/5 of it a ball gains energy. YADE's damping lags by a step and needs more.
const LEAST_LAMMPS_STEPS: f64 = 25.0;
const LEAST_YADE_STEPS: f64 = 100.0;

/// An input of LAMMPS. Atoms of type 1 are of the striker's material, atoms of type 2 of the target's.
pub(super) fn lammps(case: &Case, laws: &Laws) -> String {
    let mut text = String::new();
    let mut variable = |name: &str, value: f64, what: &str| {
        text += &format!("variable {name:2} equal {value:<24?} # {what}\n");
    };
    let target = ["block", "second ball"][case.balls.len() - 1];
    let v = case.impact.velocity_m_s;
    variable("V", v, "velocity of approach, m/s");
    variable("T", laws.contact_time_s, "contact time at V, s");
    let both = &laws.both;
    variable(
        "ES",
        both.modulus_pa,
        &format!("E* of striker and {target}, Pa"),
    );
    variable("E0", both.restitution, "its restitution at V");
    if case.balls.len() == 1 && case.run.solved.flow.is_none() {
        variable("C", both.lag_m_s_n, "J/(mu c2) of the block, m s/N");
    }
    for (number, (law, [radius_m, mass_kg])) in (1..).zip(laws.like.iter().zip(&case.balls)) {
        let whose = ["striker", "second ball"][number - 1];
        variable(
            &format!("R{number}"),
            *radius_m,
            &format!("radius of the {whose}, m"),
        );
        variable(&format!("M{number}"), *mass_kg, "its mass, kg");
        variable(
            &format!("ES{number}"),
            law.modulus_pa,
            "E* of two such balls, Pa",
        );
        variable(
            &format!("E0{number}"),
            law.restitution,
            "their restitution at V",
        );
    }
    let stiffest = stiffest(laws);
    variable("EM", stiffest, "the largest E*, Pa");
    let parts: &[&str] = match (case.balls.len(), case.run.solved.flow) {
        (1, None) => &[BALL, PAIR, DASHPOT, BLOCK],
        (1, Some(_)) => &[BALL, PAIR, BLOCK],
        _ => &[BALL, PAIR, SECOND],
    };
    let types = case.balls.len().to_string();
    let size = ["8*v_R1", "4*(v_R1+v_R2)"][case.balls.len() - 1];
    let parts = parts
        .concat()
        .replace("TYPES", &types)
        .replace("SIZE", size);
    let run = RUN
        .replace("HERTZ_TIME", &HERTZ_TIME.to_string())
        .replace("LEAST", &LEAST_LAMMPS_STEPS.to_string())
        .replace("STEPS", &LAMMPS_STEPS.to_string());
    text + &parts + &run
}

fn stiffest(laws: &Laws) -> f64 {
    let like = laws.like.iter().map(|law| law.modulus_pa);
    like.fold(laws.both.modulus_pa, f64::max)
}

/// The parts of an input of LAMMPS.
const BALL: &str = "
units       si
atom_style  sphere
atom_modify map yes
boundary    f f f
comm_modify vel yes
variable    L equal SIZE
region      box block $(-v_L) ${L} $(-v_L) ${L} $(-v_L) ${L}
create_box  TYPES box
create_atoms 1 single 0 0 ${R1}
set         atom 1 diameter $(2*v_R1)
set         atom 1 mass ${M1}
velocity    all set 0 0 $(-v_V)
variable    e equal vz[1]/v_V
";

const PAIR: &str = "
# contacts between balls of the striker's material, of any radius: Hertz's law with a constant restitution, no friction
pair_style  granular
pair_coeff  1 1 hertz $(4/3*v_ES1) ${E01} tangential linear_nohistory 0 0 damping coeff_restitution
";

const SECOND: &str = "
# the second ball, at rest; its contacts with the striker, and contacts between balls of its material
create_atoms 2 single 0 0 $(-v_R2)
set         atom 2 diameter $(2*v_R2)
set         atom 2 mass ${M2}
variable    e equal (vz[1]-vz[2])/v_V
pair_coeff  1 2 hertz $(4/3*v_ES) ${E0} tangential linear_nohistory 0 0 damping coeff_restitution
pair_coeff  2 2 hertz $(4/3*v_ES2) ${E02} tangential linear_nohistory 0 0 damping coeff_restitution
";

/// The area dashpot needs no memory: it is a force on each ball above the plane z = 0. It precedes the stock block,
/// which its last line turns into a comment.
const DASHPOT: &str = "
# the block below z = 0, for balls of any radius at any velocity below yield; d is the depth, fz the force, cut at zero
variable    d  atom \"(z<radius)*(radius-z)\"
variable    f  atom \"4/3*v_ES*sqrt(radius)*v_d*sqrt(v_d)-4*v_C*v_ES^2*radius*v_d*vz\"
variable    fz atom \"(v_f>0)*v_f\"
fix         block all addforce 0 0 v_fz
# a stock model with the same result, at velocity V only:
# ";

const BLOCK: &str = "fix block all wall/gran granular hertz $(4/3*v_ES) ${E0} tangential linear_nohistory 0 0 damping coeff_restitution zplane 0 NULL
";

/// The shortest contact has the lightest ball and the highest velocity. With m >= m1/2, R <= R1 and v <= V + 2 max v,
/// Hertz's contact time is a lower bound for all pairs of balls in the file.
const RUN: &str = "
# time step: a fraction of the shortest possible contact of the balls, which is proportional to the radius; the run stops
# if a smaller or faster ball that is added later has too few steps per contact
variable    light atom mass^2/radius
variable    speed atom sqrt(vx^2+vy^2+vz^2)
compute     light all reduce min v_light
compute     fast all reduce max v_speed
variable    short equal HERTZ_TIME*(c_light/(4*v_EM^2*(v_V+2*c_fast)))^0.2
variable    steps equal v_short/dt
thermo_style custom step c_light c_fast
fix         motion all nve/sphere
run         0
timestep    $(v_short/STEPS)
fix         steps_per_contact all halt 10 v_steps < LEAST error hard

variable    force equal sqrt(fx[1]^2+fy[1]^2+fz[1]^2)
variable    touch equal v_force>0
fix         force all vector 1 v_force v_touch
run         $(ceil(1.25*v_T/dt))
print       \"restitution $(v_e:%.10g)\"
print       \"peak force $(max(f_force[1]):%.10g) N, contact time $(dt*sum(f_force[2]):%.6g) s\"
";

/// A script for YADE.
pub(super) fn yade(case: &Case, laws: &Laws) -> String {
    let mut text = String::new();
    let numbers = [
        ("V", case.impact.velocity_m_s, "velocity of approach, m/s"),
        ("T", laws.contact_time_s, "contact time at V, s"),
        (
            "HERTZ",
            HERTZ_TIME,
            "Hertz's contact time over (m^2/(E*^2 R v))^(1/5)",
        ),
        ("STEPS", YADE_STEPS, "steps per shortest contact"),
        (
            "LEAST",
            LEAST_YADE_STEPS,
            "steps per contact below which the run stops",
        ),
    ];
    for (name, value, what) in numbers {
        text += &format!("{name} = {value:?}  # {what}\n");
    }
    text += &format!("BALLS = {:?}  # radius in m and mass in kg\n", case.balls);
    text += "# E* in Pa, lag J/(mu c2) in m s/N of the area dashpot, ratio of damping of one restitution\nLAWS = {\n";
    let mut law = |one: &str, two: &str, law: &PairLaw| {
        text += &format!(
            "    (\"{one}\", \"{two}\"): ({:?}, {:?}, {:?}),\n",
            law.modulus_pa, law.lag_m_s_n, law.ratio
        );
    };
    law("striker", "target", &laws.both);
    for (name, like) in ["striker", "target"].into_iter().zip(&laws.like) {
        law(name, name, like);
    }
    text + "}\n" + include_str!("yade.py")
}
