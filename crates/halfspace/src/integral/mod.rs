//! The single integral over slowness, assembled from its parts.
//!
//! ```text
//! R = 2/(c D'(c)) Re sum_{P,S} N Psi(gamma z - i c t)
//!     + (1/pi) Re int_0^{1/kappa} dx sum_{P,S} amplitude(x) [ Psi(xi-) + Psi(xi+) ],   xi-+ = i (z gamma^ -+ t)/x
//! ```
//!
//! with gamma^ = sqrt(1 - x^2) for P and sqrt(1/kappa^2 - x^2) for S. Below x = 1 only the compact parts of the
//! potentials enter, so each wave and each direction of travel has its own interval; above x = 1 the whole potentials
//! enter.
//!
//! In reading order: the integrand (`spectrum`, `setting`), its two parts below and above slowness 1/c1 (`fast`, `slow`) and
//! the Rayleigh wave (`rayleigh_pole`, `rayleigh_front`); where it is singular (`fronts`, `branch_points`), and
//! the intervals with their Gauss rules that follow (`singularities`, `panels`, `sum`); and the axis (`axis`).

pub(crate) mod axis;
pub(crate) mod branch_points;
pub(crate) mod fast;
pub(crate) mod fronts;
pub(crate) mod panels;
pub(crate) mod rayleigh_front;
pub(crate) mod rayleigh_pole;
pub(crate) mod setting;
pub(crate) mod singularities;
pub(crate) mod slow;
pub(crate) mod spectrum;
pub(crate) mod sum;

use crate::domain::NEAREST;
use crate::field::{Estimate, Field, Point, Sense, Six};
use crate::numeric::lanes::dispatch;
use crate::potentials::closed_form::SMALL_RADIUS;
use crate::potentials::far_front::{FAR_RADIUS, ROUNDING_DIGITS};
use crate::potentials::{STEP, STEP_INTEGRAL, shallow};
use crate::profile::Profile;
use num_complex::Complex64;
use panels::PanelNodes;
use setting::Setting;
use singularities::Singularities;
use spectrum::Wave;
use std::f64::consts::PI;
use sum::{QuadraturePanel, Sum};

impl Setting {
    /// The remainder or one of its time integrals; extrapolated to the axis where the fronts of a point force or a
    /// punch meet.
    pub(crate) fn evaluate<const N: i32>(&self, at: Point) -> Estimate {
        let t = at.t.max(NEAREST);
        let at = Point { t, ..at };
        let mut estimate = if axis::is_near::<N>(self.profile, at) {
            axis::continued(&self.medium, self.profile, at, |at| self.integrate::<N>(at))
        } else {
            self.integrate::<N>(at)
        };
        // on the surface sigma_zz equals the load and sigma_rz is zero at all times: both remainders vanish
        if at.z == 0.0 {
            for field in [Field::StressZz, Field::StressRz] {
                estimate.value[field.index()] = 0.0;
                estimate.error[field.index()] = 0.0;
            }
        }
        estimate
    }

    fn integrate<const N: i32>(&self, at: Point) -> Estimate {
        /// Radius from which the pressure and its rounding errors are zero.
        const CLEAR_OF_EDGE: f64 = 1.01;
        let mut sum = Sum::default();
        self.rayleigh_wave::<N>(at, &mut sum);
        let mut singularities = Singularities::new([], Complex64::ZERO, &[]);
        for wave in [Wave::P, Wave::S] {
            for sense in [Sense::Outgoing, Sense::Image] {
                self.fast::<N>(at, wave, sense, &mut singularities, &mut sum);
            }
            self.slow::<N>(at, wave, &mut singularities, &mut sum);
        }
        let mut floor = rounding_floor::<N>(self.profile, at.r);
        if at.r > CLEAR_OF_EDGE && shallow::applies::<N>(self.profile, at) {
            for field in [Field::StressZz, Field::StressRz] {
                floor[field.index()] *= 8.0 * at.z.sqrt();
            }
        }
        let error = sum.error();
        Estimate {
            value: sum.value().map(|v| v / PI),
            error: std::array::from_fn(|f| error[f] / PI + floor[f]),
        }
    }

    /// Adds the nodes of one panel; a wave below slowness one has one sense, above it both.
    pub(crate) fn add_nodes<const N: i32>(
        &self,
        at: Point,
        wave: Wave,
        sense: Option<Sense>,
        nodes: &PanelNodes,
        shallow: bool,
        sum: &mut Sum,
    ) {
        // step responses and velocities are frequent; time integrals do not justify the additional code
        if N != STEP_INTEGRAL && !shallow {
            dispatch(QuadraturePanel::<N> {
                setting: self,
                at,
                wave,
                sense,
                nodes,
                sum,
            });
            return;
        }
        for (place, weight, error) in nodes.iter() {
            let (jacobian, mut term) = match sense {
                Some(sense) => {
                    self.fast_term::<N, f64>((at, ROUNDING_DIGITS), (wave, sense), place)
                }
                None => self.slow_term::<N, f64>((at, ROUNDING_DIGITS), wave, place),
            };
            match sense {
                _ if !shallow => {}
                Some(sense) => self.set_fast_traction(at, (wave, sense), place, &mut term),
                None => self.set_slow_traction(at, wave, place, &mut term),
            }
            sum.add(weight * jacobian, error, term);
        }
    }
}

/// Rounding errors of terms that cancel within the potentials.
///
/// The terms of the closed forms grow with the radius; those of the step response at a distant front decrease as its
/// inverse root.
fn rounding_floor<const N: i32>(profile: Profile, r: f64) -> Six {
    const UNIT: f64 = 2.0 * f64::EPSILON;
    let [displacement, stress] = if N == STEP && profile == Profile::Hertz && r > FAR_RADIUS {
        [UNIT / r.sqrt(); 2]
    } else {
        // the primitives are divided by r^2
        let near = if r > SMALL_RADIUS { 8.0 / (r * r) } else { 0.0 };
        [UNIT * (64.0 + r * r), UNIT * (64.0 + r + near)]
    };
    [displacement, displacement, stress, stress, stress, stress]
}
