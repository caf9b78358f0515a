//! Histories at a place after a force on the surface of a half-space.
//!
//! ```text
//! smooth force     u(t) = int P'(t - s) H(s) ds                      v(t) = int P''(t - s) H(s) ds
//! steps and lines  u(t) = sum of rises times H(t - t_i) + sum of changes of slope times int_0^(t - t_j) H ds
//! ```
//!
//! H is the step response. Stresses under a point force or at the edge of a punch are not functions, so that a smooth force uses
//! int H ds with P''. A uniform pressure is a sum of punches,
//!
//! ```text
//! 1/(pi r0^2) = 4/pi int_0^(pi/2) sin^2(x) p_punch(r; r0 sin x) dx
//! ```
//!
//! whose integrand is even and periodic, so that the trapezoidal rule converges like a power of its number of punches.
//!
//! Theory: `docs/theory.md` (T76, T77).

use crate::error::OracleError;
use crate::panels::Panels;
use crate::place::Place;
use crate::source::{Lines, Load, TimeFunction, Wavelet};
use contact::{HalfSpace, choice};
use halfspace::Profile;
use std::f64::consts::{FRAC_PI_2, PI};

/// Quantities that can be requested.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Displacement.
    Displacement,
    /// Velocity.
    Velocity,
    /// Stresses.
    Stress,
}

choice!(Quantity: Displacement = "displacement", Velocity = "velocity", Stress = "stress");

/// Components in the order of [`History::values`].
pub const COMPONENTS: [(Quantity, &str, &str); 8] = [
    (Quantity::Displacement, "ur", "m"),
    (Quantity::Displacement, "uz", "m"),
    (Quantity::Stress, "srr", "Pa"),
    (Quantity::Stress, "stt", "Pa"),
    (Quantity::Stress, "szz", "Pa"),
    (Quantity::Stress, "srz", "Pa"),
    (Quantity::Velocity, "vr", "m/s"),
    (Quantity::Velocity, "vz", "m/s"),
];

/// All components in SI units.
type Eight = [f64; 8];

/// Components over time; those that were not requested are zero.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    /// Values at each time, in the order of [`COMPONENTS`].
    pub values: Vec<Eight>,
    /// Estimated largest error of each component over time.
    pub errors: Eight,
}

/// Tolerances of the kernels and lengths of panels in units of 1/(pi f), of the results and of a second computation: their difference
/// estimates the error.
///
/// 16 nodes on two units integrate a wavelet to rounding (`a_point_force_is_that_of_pekeris`).
const COMPUTATIONS: [(f64, f64); 2] = [(1e-12, 2.0), (1e-11, 1.5)];

/// Least error relative to the peak of a component, and that next to the axis below a point force, where the kernels have an error that
/// both computations share; that of r over z.
///
/// `a_point_force_is_that_of_pekeris` finds errors of 8e-10 and 6e-8 (stresses).
const LEAST_ERROR: [f64; 2] = [1e-9, 1e-7];
const NEAR_AXIS: f64 = 0.1;

/// Punches that stand for a uniform pressure at first, and at most.
///
/// `a_uniform_pressure_is_a_sum_of_hertz_pressures` fails with at most 8.
const PUNCHES: [usize; 2] = [4, 64];

/// Difference between two numbers of punches that ends their doubling, relative to the peak of a component. Doubling squares the
/// relative error, so that the error that is left is 1e-12.
const PUNCH_TOLERANCE: f64 = 1e-6;

/// The histories at r_m, z_m (depth) at ascending times, with all components of the quantities in `asked`.
///
/// Accuracy: 1e-9 of the peak of each component for a smooth force; for steps 1e-10 of the kernels' peaks.
///
/// ```
/// use contact::{HalfSpace, Material};
/// use oracle::{Lines, Load, Quantity, TimeFunction, histories};
///
/// let block = HalfSpace::new(Material::elastic(2.5e9, 0.25, 1000.0)?)?;
/// let force = TimeFunction::Lines(Lines::step(0.0, 1.0));
/// let found = histories(&block, Load::Point, &force, [1.0, 0.0], &[1.0], &[Quantity::Displacement])?;
/// // long after the waves: Boussinesq's (1 - nu)/(2 pi mu r), mu = 1e9 Pa
/// assert!((found.values[0][1] - 0.75 / (2.0 * std::f64::consts::PI * 1e9)).abs() < 1e-22);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`OracleError`] for quantities that are no functions of time under this force, and at the force itself.
pub fn histories(
    block: &HalfSpace,
    load: Load,
    force: &TimeFunction,
    place: [f64; 2],
    times_s: &[f64],
    asked: &[Quantity],
) -> Result<History, OracleError> {
    check(load, force, place, asked)?;
    let [mut found, other] =
        COMPUTATIONS.map(|how| once(block, load, force, place, (times_s, asked), how));
    let found = found.as_mut().map_err(|error| error.clone())?;
    let other = other?;
    let off = largest_difference(&found.values, &other.values);
    let peaks = largest_difference(&found.values, &vec![Eight::default(); times_s.len()]);
    let floor = LEAST_ERROR[usize::from(load == Load::Point && place[0] < NEAR_AXIS * place[1])];
    found.errors = std::array::from_fn(|c| found.errors[c].max(off[c]).max(floor * peaks[c]));
    for (t, values) in times_s.iter().zip(&found.values) {
        if let Some(c) = values.iter().position(|x| !x.is_finite()) {
            let sentence = format!(
                "{} is infinite at t = {t} s, where a wave front arrives: change output.step_s or source.delay_s",
                COMPONENTS[c].1
            );
            return Err(OracleError::new("output.step_s", sentence));
        }
    }
    Ok(found.clone())
}

/// The histories by one computation; the error is that of the number of punches.
fn once(
    block: &HalfSpace,
    load: Load,
    force: &TimeFunction,
    place: [f64; 2],
    (times_s, asked): (&[f64], &[Quantity]),
    (tolerance, longest): (f64, f64),
) -> Result<History, OracleError> {
    let under = |profile, radius_m| {
        let integrated = profile != Profile::Hertz && asked.contains(&Quantity::Stress);
        // the force of lines is in N, that of a smooth function 1
        let force_n = match force {
            TimeFunction::Smooth { force_n, .. } => *force_n,
            TimeFunction::Lines(_) => 1.0,
        };
        let place = Place::new(
            block,
            (profile, radius_m, force_n),
            place,
            integrated,
            tolerance,
        )?;
        let mut values = vec![Eight::default(); times_s.len()];
        match force {
            TimeFunction::Smooth {
                wavelet,
                frequency_hz,
                delay_s,
                ..
            } => {
                let rate = PI * frequency_hz;
                add_smooth(
                    &mut values,
                    &place,
                    (*wavelet, rate, *delay_s),
                    times_s,
                    (integrated, longest / rate),
                )?;
            }
            TimeFunction::Lines(lines) => add_lines(&mut values, &place, lines, times_s, asked)?,
        }
        let other = (0..8).filter(|&c| !asked.contains(&COMPONENTS[c].0));
        other.for_each(|c| values.iter_mut().for_each(|values| values[c] = 0.0));
        Ok(values)
    };
    let exact = |values| History {
        values,
        errors: Eight::default(),
    };
    match load {
        Load::Point => under(Profile::Point, 0.0).map(exact),
        Load::Hertz { radius_m } => under(Profile::Hertz, radius_m).map(exact),
        Load::Uniform { radius_m } => {
            uniform(times_s.len(), |part| under(Profile::Punch, part * radius_m))
        }
    }
}

/// Rejects places and quantities without values.
fn check(
    load: Load,
    force: &TimeFunction,
    [r_m, z_m]: [f64; 2],
    asked: &[Quantity],
) -> Result<(), OracleError> {
    let wrong = |key: &str, sentence: &str| Err(OracleError::new(key, sentence));
    let has = |quantity| asked.contains(&quantity);
    match (load, force) {
        (Load::Point, _) if r_m == 0.0 && z_m == 0.0 => {
            return wrong(
                "receiver",
                "a receiver at a point force has an infinite displacement: move it, or use source.profile = \"hertz\"",
            );
        }
        (Load::Uniform { radius_m }, _) if z_m == 0.0 && r_m <= radius_m => {
            return wrong(
                "receiver",
                "a receiver on the surface under a uniform pressure is not available: move it below the surface or out of the disc, or use source.profile = \"hertz\"",
            );
        }
        (Load::Uniform { .. }, TimeFunction::Lines(_)) => {
            return wrong(
                "source.time_function",
                "source.profile = \"uniform\" needs a smooth source.time_function: use \"ricker\" or \"gaussian\"",
            );
        }
        _ => {}
    }
    match force {
        TimeFunction::Lines(_)
            if load == Load::Point && (has(Quantity::Stress) || has(Quantity::Velocity)) =>
        {
            wrong(
                "output.quantities",
                "velocities and stresses under a point force that has steps or kinks are distributions: use source.time_function = \"ricker\" or \"gaussian\", or source.profile = \"hertz\"",
            )
        }
        TimeFunction::Lines(lines) if !lines.kinks.is_empty() && has(Quantity::Velocity) => wrong(
            "output.quantities",
            "velocities after a force record are not available here: use `hertzlamb impact` with [force]",
        ),
        _ => Ok(()),
    }
}

/// A uniform pressure as a sum over punches; `under` has the values under a punch whose radius is a part of the disc's.
fn uniform(
    count: usize,
    under: impl Fn(f64) -> Result<Vec<Eight>, OracleError>,
) -> Result<History, OracleError> {
    let [mut punches, most] = PUNCHES;
    let zero = vec![Eight::default(); count];
    let add = |sum: &mut [Eight], punches: usize, every: usize| {
        for j in (1..=punches).step_by(every) {
            let x = FRAC_PI_2 * j as f64 / punches as f64;
            let end = if j == punches { 0.5 } else { 1.0 };
            let weight = 2.0 / punches as f64 * end * x.sin().powi(2);
            let found = under(x.sin())?;
            (sum.iter_mut().flatten().zip(found.iter().flatten()))
                .for_each(|(sum, own)| *sum += weight * own);
        }
        Ok::<(), OracleError>(())
    };
    let mut found = zero.clone();
    add(&mut found, punches, 1)?;
    loop {
        // those in between
        punches *= 2;
        let mut finer: Vec<Eight> = found.iter().map(|values| values.map(|x| 0.5 * x)).collect();
        add(&mut finer, punches, 2)?;
        let [peaks, off] = [&zero, &found].map(|other| largest_difference(&finer, other));
        let is_done = (0..8).all(|c| off[c] <= PUNCH_TOLERANCE * peaks[c]);
        found = finer;
        if is_done || punches >= most {
            let errors =
                std::array::from_fn(|c| off[c] * if is_done { PUNCH_TOLERANCE } else { 1.0 });
            return Ok(History {
                values: found,
                errors,
            });
        }
    }
}

/// Largest difference of each component over time.
fn largest_difference(a: &[Eight], b: &[Eight]) -> Eight {
    let off = |c: usize| a.iter().zip(b).map(move |(a, b)| (a[c] - b[c]).abs());
    std::array::from_fn(|c| off(c).fold(0.0, f64::max))
}

fn add_smooth(
    values: &mut [Eight],
    place: &Place,
    (wavelet, rate, delay_s): (Wavelet, f64, f64),
    times_s: &[f64],
    (integrated, longest_s): (bool, f64),
) -> Result<(), OracleError> {
    let reach_s = Wavelet::REACH / rate;
    let end_s = times_s.last().copied().unwrap_or(0.0) - delay_s + reach_s;
    if end_s <= place.first_s() {
        return Ok(());
    }
    let nodes = Panels::of(place, end_s, rate, longest_s)?.nodes;
    for (values, t) in values.iter_mut().zip(times_s) {
        let [from_s, to_s] = [-reach_s, reach_s].map(|reach_s| t - delay_s + reach_s);
        let from = nodes.partition_point(|node| node.time_s < from_s);
        for node in nodes[from..].iter().take_while(|node| node.time_s <= to_s) {
            let [_, first, second] = wavelet.at(rate * (t - delay_s - node.time_s));
            let factors = [first * rate, second * rate * rate].map(|x| x * node.weight_s);
            for (c, value) in values.iter_mut().enumerate() {
                *value += match c {
                    0 | 1 => factors[0] * node.value[c],
                    2..6 => factors[usize::from(integrated)] * node.value[c],
                    _ => factors[1] * node.value[c - 6],
                };
            }
        }
    }
    Ok(())
}

fn add_lines(
    values: &mut [Eight],
    place: &Place,
    lines: &Lines,
    times_s: &[f64],
    asked: &[Quantity],
) -> Result<(), OracleError> {
    let first_s = place.first_s();
    for (values, t) in values.iter_mut().zip(times_s) {
        for [since_s, rise_n] in lines.steps.iter().take_while(|step| t - step[0] > first_s) {
            let found = place.step(t - since_s)?;
            (0..6).for_each(|c| values[c] += rise_n * found[c]);
            if asked.contains(&Quantity::Velocity) {
                let found = place.step_velocity(t - since_s)?;
                (0..2).for_each(|c| values[6 + c] += rise_n * found[c]);
            }
        }
    }
    let span_s = lines.kinks.first().zip(times_s.last());
    let Some(end_s) = span_s
        .map(|(first, end_s)| end_s - first[0])
        .filter(|&end_s| end_s > first_s)
    else {
        return Ok(());
    };
    let pairs = lines.kinks.windows(2).map(|pair| pair[1][0] - pair[0][0]);
    let panels = Panels::of(place, end_s, 1.0 / pairs.fold(end_s, f64::min), end_s)?;
    for (values, t) in values.iter_mut().zip(times_s) {
        for [since_s, change] in lines.kinks.iter().take_while(|kink| t - kink[0] > first_s) {
            let found = panels.integral(t - since_s);
            (0..6).for_each(|c| values[c] += change * found[c]);
        }
    }
    Ok(())
}
