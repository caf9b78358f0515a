//! The field at one instant as an integral over the force's past, without cells and without discs that stand for others.
//!
//! Hertz's pressure of radius a grows by the pressure of a flat punch of that radius: with the radius of the instant t'
//!
//! ```text
//! u(t) = P(t) static(a(t)) + int P'(t') R_punch(t - t'; a(t')) dt'
//! ```
//!
//! On a fixed disc R is that of Hertz's pressure.
//!
//! The integrand is smooth but where a front from the punch of an instant t' arrives at t, and where the contact's edge
//! passes over a point of the surface. Between these instants, and toward them with the square of the variable, Gauss
//! rules are exact to the accuracy of the punch's kernel.
//!
//! Theory: `docs/theory.md` (T55).

use crate::at_rest::static_si;
use crate::error::FieldsError;
use crate::excitation::{Excitation, PressureRadius};
use halfspace::{Arrivals, FIELDS, Kernel, Profile, Six, gauss};

/// Kernels for one excitation, a contact.
pub(crate) struct Superposition<'a> {
    excitation: &'a Excitation,
    /// Of the pressure by which the load grows.
    growth: Kernel,
    hertz: Kernel,
    /// Nodes of a rule.
    nodes: usize,
    end_s: f64,
}

/// An instant of the past: the radius of the contact over the largest, and the rate of the force in N/s.
struct Past {
    over: f64,
    rate: f64,
}

impl<'a> Superposition<'a> {
    /// To about `tolerance` of the peaks of the fields.
    pub(crate) fn new(excitation: &'a Excitation, tolerance: f64) -> Result<Self, FieldsError> {
        let medium = excitation.medium();
        let growth = match excitation.radius() {
            PressureRadius::Fixed(_) => Profile::Hertz,
            PressureRadius::Following { .. } => Profile::Punch,
        };
        let kernel = (1e-6 * tolerance).clamp(1e-12, 1e-10);
        Ok(Self {
            excitation,
            growth: Kernel::new(medium, growth, kernel)?,
            hertz: Kernel::new(medium, Profile::Hertz, 1e-6)?,
            nodes: (-4.0 * tolerance.log10()).clamp(16.0, 24.0) as usize,
            end_s: excitation.end_s(),
        })
    }

    /// The six fields in SI units at a point in m, at a time in s when the force is `force_n`.
    ///
    /// Near the axis, where fronts from opposite edges meet and the punch has no kernel of its own, fields are r to their
    /// parity times a function of r^2, which their values at a few larger radii continue.
    pub(crate) fn at(&self, [r_m, z_m]: [f64; 2], instant: [f64; 2]) -> Result<Six, FieldsError> {
        /// Radii below this fraction of the distance from the largest edge are continued.
        const NEAR: f64 = 0.031;
        const RADII: usize = 4;
        let step_m = NEAR * z_m.hypot(self.excitation.units().disc_radius_m);
        if r_m >= step_m {
            return self.off_axis([r_m, z_m], instant);
        }
        let radii: [f64; RADII] = std::array::from_fn(|i| step_m * (i + 1) as f64);
        let mut sum = Six::default();
        for (i, &radius) in radii.iter().enumerate() {
            let others = radii.iter().enumerate().filter(|&(j, _)| j != i);
            let weight: f64 = others
                .map(|(_, x)| (r_m * r_m - x * x) / (radius * radius - x * x))
                .product();
            let found = self.off_axis([radius, z_m], instant)?;
            for (f, field) in FIELDS.into_iter().enumerate() {
                let parity = if field.is_odd_in_r() {
                    r_m / radius
                } else {
                    1.0
                };
                sum[f] += weight * parity * found[f];
            }
        }
        Ok(sum)
    }

    fn off_axis(&self, place_m: [f64; 2], [time_s, force_n]: [f64; 2]) -> Result<Six, FieldsError> {
        let mut sum = static_si(self.excitation, &self.hertz, place_m, force_n)?;
        let until_s = time_s.min(self.end_s);
        if until_s <= 0.0 {
            return Ok(sum);
        }
        let cuts = self.cuts(place_m, time_s, until_s)?;
        for pair in cuts.windows(2) {
            let middle = 0.5 * (pair[0] + pair[1]);
            for (cut, to) in [(pair[0], middle), (pair[1], middle)] {
                for (u, weight) in gauss::rule(self.nodes).on(0.0, 1.0) {
                    let past_s = cut + (to - cut) * u * u;
                    let weight = 2.0 * u * weight * (to - cut).abs();
                    self.add(place_m, time_s, past_s, weight, &mut sum)?;
                }
            }
        }
        Ok(sum)
    }

    fn past(&self, past_s: f64) -> Option<Past> {
        let [force_n, rate] = self.excitation.force_and_rate(past_s)?;
        let over = self.excitation.radius().square(force_n).sqrt();
        (over > 0.0).then_some(Past { over, rate })
    }

    fn add(
        &self,
        [r_m, z_m]: [f64; 2],
        time_s: f64,
        past_s: f64,
        weight: f64,
        sum: &mut Six,
    ) -> Result<(), FieldsError> {
        let Some(Past { over, rate }) = self.past(past_s) else {
            return Ok(());
        };
        let units = self.excitation.units();
        let radius_m = over * units.disc_radius_m;
        let since = (time_s - past_s) / (over * units.time_s());
        let found = self
            .growth
            .remainder(r_m / radius_m, z_m / radius_m, since)?;
        for (f, value) in found.value.into_iter().enumerate() {
            let unit = if f < 2 {
                units.displacement_m_per_n() / over
            } else {
                units.stress_pa_per_n() / (over * over)
            };
            sum[f] += weight * rate * unit * value;
        }
        Ok(())
    }

    /// Instants of the past between which the integrand is smooth, ascending, from 0 to `until_s`.
    fn cuts(&self, place_m: [f64; 2], time_s: f64, until_s: f64) -> Result<Vec<f64>, FieldsError> {
        let mut cuts = vec![0.0, until_s];
        let mut before: Option<(f64, Vec<f64>)> = None;
        let last_s = self.last_s(place_m);
        for past_s in self.trials(time_s, until_s, last_s) {
            let signs = self.ahead(place_m, time_s, past_s)?;
            if let Some((from_s, earlier)) = &before
                && earlier.len() == signs.len()
            {
                for family in 0..signs.len() {
                    if (earlier[family] < 0.0) != (signs[family] < 0.0) {
                        cuts.push(self.crossing(place_m, time_s, [*from_s, past_s], family)?);
                    }
                }
            }
            before = Some((past_s, signs));
        }
        // the tail of the waves falls as a power of the time since the last front
        let mut since_s = last_s;
        while since_s > 0.0 && time_s - since_s > 0.0 {
            if time_s - since_s < until_s {
                cuts.push(time_s - since_s);
            }
            since_s *= 2.0;
        }
        cuts.sort_by(f64::total_cmp);
        let shortest = 1e-12 * until_s;
        cuts.dedup_by(|later, earlier| *later - *earlier < shortest);
        Ok(cuts)
    }

    /// Time in s after which the last front from the largest contact has passed.
    fn last_s(&self, [r_m, z_m]: [f64; 2]) -> f64 {
        let units = self.excitation.units();
        let radius_m = units.disc_radius_m;
        Arrivals::new(
            self.excitation.medium(),
            Profile::Punch,
            r_m / radius_m,
            z_m / radius_m,
        )
        .map_or(0.0, |arrivals| arrivals.last() * units.time_s())
    }

    /// Instants between which crossings are looked for: dense toward both ends of the contact and within the passing.
    fn trials(&self, time_s: f64, until_s: f64, last_s: f64) -> Vec<f64> {
        const TRIALS: usize = 64;
        let graded = |x: f64| x * x * (3.0 - 2.0 * x);
        let even = (0..=TRIALS).map(|i| i as f64 / TRIALS as f64);
        let from_s = (time_s - 1.01 * last_s).clamp(0.0, until_s);
        let mut trials: Vec<f64> = even
            .flat_map(|x| {
                [
                    until_s * graded(x),
                    until_s * x.powi(4),
                    until_s * (1.0 - x.powi(4)),
                    from_s + (until_s - from_s) * x,
                ]
            })
            .collect();
        trials.sort_by(f64::total_cmp);
        trials.dedup();
        trials
    }

    /// How far in s each kind of front from the contact of an instant has gone beyond the point, and the edge of the contact
    /// beyond it; nothing without a contact.
    fn ahead(
        &self,
        [r_m, z_m]: [f64; 2],
        time_s: f64,
        past_s: f64,
    ) -> Result<Vec<f64>, FieldsError> {
        let Some(Past { over, .. }) = self.past(past_s) else {
            return Ok(Vec::new());
        };
        let units = self.excitation.units();
        let radius_m = over * units.disc_radius_m;
        let unit_s = over * units.time_s();
        let (r, z) = (r_m / radius_m, z_m / radius_m);
        let arrivals = Arrivals::new(self.excitation.medium(), Profile::Punch, r, z)?;
        let since_s = time_s - past_s;

        let kappa = self.excitation.medium().kappa();
        let span = (1.0 / (kappa * kappa) - 1.0).sqrt();
        // the plane fronts do not depend on the radius; head waves are followed where there are none, too
        let [near, far] = [(r - 1.0).abs(), r + 1.0];
        let times = [
            arrivals.p[0],
            arrivals.p[1],
            arrivals.s[0],
            arrivals.s[1],
            arrivals.rayleigh[0],
            arrivals.rayleigh[1],
            near + z * span,
            far + z * span,
            z,
            z / kappa,
        ];
        let mut ahead: Vec<f64> = times.iter().map(|t| since_s - t * unit_s).collect();
        ahead.push((1.0 - r) * unit_s);
        Ok(ahead)
    }

    /// Where one of the distances of [`Self::ahead`] changes its sign.
    fn crossing(
        &self,
        place_m: [f64; 2],
        time_s: f64,
        [mut from_s, mut to_s]: [f64; 2],
        family: usize,
    ) -> Result<f64, FieldsError> {
        let value = |at_s: f64| -> Result<f64, FieldsError> {
            Ok(self
                .ahead(place_m, time_s, at_s)?
                .get(family)
                .copied()
                .unwrap_or(0.0))
        };
        let negative = value(from_s)? < 0.0;
        for _ in 0..60 {
            let middle = 0.5 * (from_s + to_s);
            if (value(middle)? < 0.0) == negative {
                from_s = middle;
            } else {
                to_s = middle;
            }
        }
        Ok(0.5 * (from_s + to_s))
    }
}
