//! Energy over time.
//!
//! ```text
//! kinetic   m v^2/2, v by the momentum of the force
//! stored    (2/5) P^(5/3)/K^(2/3) in Hertz's spring, and S P^2/2 in the static field where a disc holds one of its own
//! radiated  int P dw_d, w_d the part of the deflection that lags behind the force
//! ```
//!
//! They are computed by different methods, so that their sum, the initial energy, is a real check.
//! w_d is the contact's own. On a disc with memory, S and w_d belong to the pressure-weighted mean of the disc's
//! deflection, which does the work of the pressure, whichever deflection is in the contact law.
//! Until the end of a contact the last term includes energy of the near field that returns.
//!
//! Theory: `docs/theory.md` (T56).

use crate::excitation::{Excitation, Samples};
use crate::grid::Grid;
use crate::record::jump::Jump;
use contact::{Chosen, Memory, Physics, StaticShare, work_until_j};
use halfspace::{Deflection, SurfaceResponse, lagrange};

/// Energies in J at the times of the output.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct EnergySeries {
    /// Kinetic energy of the striker; none for a record.
    pub kinetic_j: Option<Vec<f64>>,
    /// Work of a record on the half-space since its first sample; none for a striker, which shares the spring.
    pub work_j: Option<Vec<f64>>,
    /// Recoverable elastic energy: of Hertz's spring and of the disc's static field.
    pub stored_j: Vec<f64>,
    /// Work on the deflection that lags behind the force; after the contact, the radiated energy.
    pub radiated_j: Vec<f64>,
    /// Work of plastic flow, for a yielding contact.
    pub plastic_j: Option<Vec<f64>>,
}

/// Number of samples over the contacts for the work.
const SAMPLES: f64 = 1024.0;

impl EnergySeries {
    /// Energies of a striker whose contact has this model, at times in s; none for a record.
    ///
    /// The relative error of the work is 1e-4 in addition to the error of the force.
    pub(crate) fn of_striker(
        excitation: &Excitation,
        chosen: &Chosen,
        time_s: &[f64],
    ) -> Option<Self> {
        let contact = excitation.contact()?;
        let (end_s, units) = (contact.samples.end() * contact.units.time_s, &contact.units);
        let initial_j = 0.4 * units.force_n * units.length_m;
        let kinetic = |&t: &f64| {
            let v = excitation.motion(t).map_or(0.0, |m| m.velocity_m_s);
            initial_j * (v / units.velocity_m_s()).powi(2)
        };
        let kinetic_j = Some(time_s.iter().map(kinetic).collect());
        if let Some(yielded) = excitation.yielded() {
            let energies = |t: &f64| yielded.energies(t / units.time_s);
            let energies = time_s.iter().filter_map(energies);
            let energies: Vec<[f64; 3]> = energies.map(|e| e.map(|e| initial_j * e)).collect();
            let [stored_j, plastic_j, radiated_j] =
                [0, 1, 2].map(|i| energies.iter().map(|e| e[i]).collect());
            return Some(Self {
                kinetic_j,
                stored_j,
                radiated_j,
                plastic_j: Some(plastic_j),
                ..Self::default()
            });
        }
        let step_s = end_s / SAMPLES;
        let times = (0..=SAMPLES as usize + 1).map(|i| i as f64 * step_s);
        let force_n: Vec<f64> = times.clone().map(|t| excitation.force_n(t)).collect();
        let physics = chosen.regime.physics;
        let on_disc = match (physics, chosen.memory()) {
            (Physics::Disc(_), Memory::Full) => true,
            (Physics::Disc(_), Memory::None | Memory::FirstOrder | Memory::Dashpot)
            | (Physics::Growing | Physics::Yielding, _) => false,
        };
        let lag_m: Vec<f64> = if on_disc {
            let share = StaticShare::Dynamic;
            excitation.deflection_m(Deflection::Mean, share, step_s, 0.0, &force_n)
        } else {
            // the deflection in the contact law without its static part
            let static_m_per_n = chosen.coupling() * units.length_m / units.force_n;
            let law_m = |t| excitation.motion(t).map_or(0.0, |m| m.deflection_m);
            let samples = times.zip(&force_n);
            let lag_m = samples.map(|(t, p)| law_m(t) - static_m_per_n * p);
            lag_m.collect()
        };
        let work_j = work_until_j(&force_n, &lag_m);
        let static_m_per_n = match physics {
            Physics::Disc(StaticShare::Full) => static_mean_m_per_n(excitation),
            // Hertz's law includes all of it
            Physics::Growing | Physics::Disc(StaticShare::Dynamic) | Physics::Yielding => 0.0,
        };
        let stored = |&t: &f64| {
            let p = excitation.force_n(t);
            initial_j * (p / units.force_n).powf(5.0 / 3.0) + 0.5 * static_m_per_n * p * p
        };
        let radiated = |&t: &f64| between(&work_j, t / step_s);
        Some(Self {
            kinetic_j,
            stored_j: time_s.iter().map(stored).collect(),
            radiated_j: time_s.iter().map(radiated).collect(),
            ..Self::default()
        })
    }

    /// Energies of a record whose force is sampled at the output's times.
    pub(crate) fn of_record(grid: &Grid<'_>, force_n: &[f64]) -> Self {
        let excitation = grid.excitation;
        let static_m_per_n = static_mean_m_per_n(excitation);
        let (mut stored_j, mut radiated_j) = (Vec::new(), Vec::new());
        let (disc, share) = (Deflection::Mean, StaticShare::Dynamic);
        let lag_m = grid.deflection_m(disc, share, force_n);
        let runs = grid.split(force_n).into_iter().zip(grid.split(&lag_m));
        for ((run, force_n), (_, lag_m)) in runs {
            let mut lag = Lag {
                excitation,
                static_m_per_n,
                // no work is done between the rest before the run and the run before
                work_j: radiated_j.last().copied().unwrap_or(0.0),
                last: [run.base_n, 0.0],
                slope_m: 0.0,
            };
            lag.add_run(&run, grid.step_s, [force_n, lag_m], &mut radiated_j);
            let stored = |p: &f64| 0.5 * static_m_per_n * p * p;
            stored_j.extend(force_n.iter().map(stored));
        }
        let parts = stored_j.iter().zip(&radiated_j);
        let work_j = parts.map(|(stored, radiated)| stored + radiated).collect();
        Self {
            work_j: Some(work_j),
            stored_j,
            radiated_j,
            ..Self::default()
        }
    }

    /// The energy radiated at the last time, in J.
    pub fn radiated_at_last_j(&self) -> f64 {
        self.radiated_j.last().copied().unwrap_or(0.0)
    }
}

/// The work of a record on the lagging deflection, along a run.
struct Lag<'a> {
    excitation: &'a Excitation,
    static_m_per_n: f64,
    /// The work so far.
    work_j: f64,
    /// Force in N and deflection in m so far.
    last: [f64; 2],
    /// Rise of the deflection over the last whole step.
    slope_m: f64,
}

impl Lag<'_> {
    /// Adds the work until each sample of a run; between jumps of the force the samples are smooth.
    fn add_run(
        &mut self,
        run: &Samples,
        step_s: f64,
        [force_n, lag_m]: [&[f64]; 2],
        work_j: &mut Vec<f64>,
    ) {
        let time_s = |i: usize| run.start_s + i as f64 * step_s;
        let jumps = self.excitation.jumps().iter();
        let mut jumps = jumps.filter(|jump| jump.time_s >= run.start_s).peekable();
        let mut from = 0;
        while from < force_n.len() {
            let next = jumps.peek().map_or(force_n.len(), |jump| {
                let samples = from..force_n.len();
                samples
                    .into_iter()
                    .find(|&i| jump.is_past(time_s(i)))
                    .unwrap_or(force_n.len())
            });
            self.add_smooth([&force_n[from..next], &lag_m[from..next]], work_j);
            from = next;
            while let Some(jump) =
                jumps.next_if(|jump| from < force_n.len() && jump.is_past(time_s(from)))
            {
                let part = 1.0 - (time_s(from) - jump.time_s) / step_s;
                self.jump(jump, part.clamp(0.0, 1.0));
            }
        }
    }

    fn go_to(&mut self, next: [f64; 2]) {
        let [[force_n, lag_m], [last_n, last_m]] = [next, self.last];
        self.work_j += 0.5 * (force_n + last_n) * (lag_m - last_m);
        self.last = next;
    }

    /// Adds samples a step apart, after the last place.
    fn add_smooth(&mut self, [force_n, lag_m]: [&[f64]; 2], work_j: &mut Vec<f64>) {
        let (force_n, lag_m) = (
            [&self.last[..1], force_n].concat(),
            [&self.last[1..], lag_m].concat(),
        );
        let until_j = work_until_j(&force_n, &lag_m);
        work_j.extend(until_j.iter().skip(1).map(|work| self.work_j + work));
        self.work_j += until_j.last().copied().unwrap_or(0.0);
        if let ([.., force_n], [.., before_m, after_m]) = (&force_n[..], &lag_m[..]) {
            self.last = [*force_n, *after_m];
            self.slope_m = after_m - before_m;
        }
    }

    /// Passes a jump at a fraction of a step after the last sample: the lag jumps with the force, like the static
    /// deflection, and no work is done.
    fn jump(&mut self, jump: &Jump, part: f64) {
        let after_n = self.excitation.force_n(jump.time_s);
        let before_m = self.last[1] + part * self.slope_m;
        self.go_to([after_n - jump.rise_n, before_m]);
        let fallen_m = self.static_m_per_n * jump.rise_n;
        self.go_to([after_n, before_m - fallen_m]);
        self.slope_m = 0.0;
    }
}

/// Static mean deflection of the disc in m/N.
fn static_mean_m_per_n(excitation: &Excitation) -> f64 {
    let response = SurfaceResponse::new(excitation.medium(), Deflection::Mean);
    response.disc.static_compliance * excitation.units().displacement_m_per_n()
}

/// Cubic through the four samples around a place; the last one after them.
fn between(samples: &[f64], place: f64) -> f64 {
    let count = samples.len();
    if count < 4 || place >= (count - 1) as f64 {
        return samples.last().copied().unwrap_or(0.0);
    }
    let from = (place.max(0.0) as usize).saturating_sub(1).min(count - 4);
    let x = place - from as f64;
    let part = |i: usize| samples[from + i] * lagrange(|j| j as f64, 4, i, x);
    (0..4).map(part).sum()
}
