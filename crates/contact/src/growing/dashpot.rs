//! Elastic contacts on a half-space that answers at once: the history of the models in closed form.
//!
//! ```text
//! d'' = -(5/4) p,     p = F(d) + c F'(d)^2 d'
//! ```
//!
//! with F of Hertz's spring in series with a linear one and c of the radiated loss, zero where the model has none.
//! The closed forms are the first order of this law in c; their error estimate covers the difference.

use crate::error::MarchError;
use crate::growing::equations::March;
use crate::growing::solved::SolvedContact;
use crate::law::branch::Branch;

/// Error of a piece: below that of any model in closed form.
const ACCURACY: f64 = 1e-8;

/// Longest piece in the root of the time, and of the distance from the largest radius, in collision units: at
/// [`ACCURACY`] longer ones are tried in vain. `benches/histories.rs` measures the time: 35 to 45 us, and 60 us without.
const LONGEST_PIECE: f64 = 0.35;

/// Solves the contact of Hertz's spring in series with a linear one of compliance `coupling`, with a lag.
///
/// # Errors
/// [`MarchError::NotFollowed`].
pub(crate) fn solve_springs(coupling: f64, lag: f64) -> Result<SolvedContact, MarchError> {
    let mut march = March::damped(lag, ACCURACY);
    march.law.branch = Branch::OnSpring { coupling };
    march.flow(LONGEST_PIECE)?;
    let top = march.state.radius;
    march.open(top, 0.0, LONGEST_PIECE)?;
    Ok(SolvedContact::with_dashpot(march))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::quasi_static::{quasi_static, quasi_static_radiation};
    use crate::law::radiation::radiation;
    use crate::law::reference::Course;
    use crate::numeric::cubic::force_root;
    use crate::summary::Summary;

    /// The force of the springs with a lag, at a displacement and a velocity.
    fn damped(coupling: f64, lag: f64) -> impl Fn(f64, f64) -> f64 {
        move |d, v| {
            let y = force_root(coupling, d, d.max(0.0).sqrt()).unwrap();
            let stiffness = 3.0 * y / (2.0 + 3.0 * coupling * y);
            y * y * y + lag * stiffness * stiffness * v
        }
    }

    fn check(solved: &SolvedContact, force: impl Fn(f64, f64) -> f64) {
        let course = Course::new(&force, 1e-3);
        let found = &solved.summary;
        for (name, found, exact) in [
            ("force", found.peak_force, course.peak_force),
            ("its time", found.peak_force_time, course.peak_force_time),
            (
                "displacement",
                found.peak_displacement,
                course.peak_displacement,
            ),
            ("end", found.contact_time, course.contact_time),
            ("velocity", -found.restitution, course.velocity),
        ] {
            assert!(
                (found - exact).abs() < 3e-6 * exact.abs(),
                "{name}: {found} {exact}"
            );
        }
        for (i, exact) in course.force.iter().enumerate().skip(1) {
            let time = i as f64 * course.step;
            let [pressed, ..] = solved.force(time);
            assert!((pressed - exact).abs() < 3e-7, "{time}: {pressed} {exact}");
            let now = solved.state(time);
            let law = force(now.displacement, now.velocity);
            assert!((pressed - law).abs() < 3e-7, "{time}: {pressed} {law}");
        }
    }

    #[test]
    fn pieces_are_those_of_the_force_law_by_runge_and_kutta() {
        for lag in [0.0, 1e-4, 3e-3, 0.03, 0.12] {
            for coupling in [0.0, 0.1, 1.0, 30.0] {
                check(
                    &solve_springs(coupling, lag).unwrap(),
                    damped(coupling, lag),
                );
            }
        }
    }

    #[test]
    fn without_a_lag_it_is_the_closed_form() {
        for coupling in [0.0, 0.1, 1.0, 30.0] {
            let (found, exact) = (
                solve_springs(coupling, 0.0).unwrap(),
                quasi_static(coupling).0,
            );
            assert!(found.summary.distance(&exact) < 1e-7, "{found:?} {exact:?}");
            let time = found.summary.peak_force_time - exact.peak_force_time;
            assert!(time.abs() < 1e-6, "{time:e}");
        }
    }

    #[test]
    fn the_first_order_of_the_closed_forms_is_that_of_the_law() {
        let near = |found: &Summary, law: &Summary, lag: f64| {
            let square = 7.0 * lag * lag;
            assert!((found.peak_force - law.peak_force).abs() < square);
            assert!((found.peak_force_time - law.peak_force_time).abs() < square);
            assert!((found.restitution - law.restitution).abs() < square);
        };
        for lag in [1e-3, 3e-3] {
            near(
                &solve_springs(0.0, lag).unwrap().summary,
                &radiation(lag),
                lag,
            );
            for coupling in [0.1, 1.0, 4.0] {
                let found = solve_springs(coupling, lag).unwrap();
                near(&found.summary, &quasi_static_radiation(coupling, lag), lag);
            }
        }
    }
}
