//! A contact that has yielded: its results, and its history at any time.

use crate::growing::solved::place_of;
use crate::plastic::Yielding;
use crate::plastic::march::{March, Stretch};
use crate::plastic::problem::Waves;
use crate::summary::{EndOfContact, Instant, Summary};
use crate::units::INVERSE_MASS;

/// A contact that has yielded, in collision units.
#[derive(Debug, Clone)]
pub struct YieldedContact {
    stretches: Vec<Stretch>,
    /// When each piece ends.
    ends: Vec<f64>,
    /// Touch, onset of yield, turning point and end.
    pub(crate) breaks: [f64; 4],
    lag: Option<f64>,
    yielding: Yielding,
    summary: Summary,
    flow: Flow,
    error: f64,
}

/// What has flowed, in collision units; works over the kinetic energy before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flow {
    /// Work of the plastic flow.
    pub plastic_work: f64,
    /// Work on the half-space's waves.
    pub radiated: f64,
    /// Root of the largest indentation.
    pub(crate) radius: f64,
    /// Largest radius of contact.
    pub contact_radius: f64,
    /// Radius of Hertz's pressure of the same second moment at the turning point.
    pub disc_radius: f64,
    /// Largest indentation.
    pub peak_indentation: f64,
    /// Indentation that stays.
    pub residual_indentation: f64,
    /// R_p/R: what contact's relative curvature has become.
    pub flatter: f64,
}

impl Flow {
    /// Of a law that unloads from a radius.
    pub(crate) fn new(yielding: &Yielding, radius: f64, radiated: f64) -> Self {
        let (back, from) = yielding.unloading(radius);
        Self {
            plastic_work: 2.0 * INVERSE_MASS * (yielding.work(radius) - back.given_back(from)),
            radiated,
            radius,
            disc_radius: yielding.disc_radius(radius),
            contact_radius: yielding.true_radius(radius),
            peak_indentation: radius * radius,
            residual_indentation: back.left(),
            flatter: back.flatter(),
        }
    }
}

impl YieldedContact {
    /// Follows a contact with pieces that leave an error of `accuracy` each; the time where none is short enough.
    pub(crate) fn follow(yielding: Yielding, waves: Waves<'_>, accuracy: f64) -> Result<Self, f64> {
        let mut march = March::new(yielding, waves, accuracy);
        march.run()?;
        let state = march.course.state;
        let mut radiated = march.radiated;
        let lag = match waves {
            Waves::Dashpot(lag) => Some(lag),
            Waves::Memory(_) => None,
        };
        let mut flow = Flow::new(&yielding, march.top, 0.0);
        if let Some(last) = march.stretches.last() {
            // what a contact without force has not given back goes the way of the dashpot
            radiated += 2.0 * INVERSE_MASS * last.branch.given_back(state.radius);
        }
        flow.radiated = radiated;
        let (peak_force, peak_force_time) = largest(&march.stretches, |one| &one.force);
        let (peak_displacement, _) = largest(&march.stretches, |one| &one.piece.displacement);
        let mut found = Self {
            ends: march.stretches.iter().map(|one| one.piece.to.0).collect(),
            breaks: [0.0, march.breaks[0], march.breaks[1], state.time],
            stretches: march.stretches,
            lag,
            yielding,
            summary: Summary {
                peak_force,
                peak_force_time,
                contact_time: state.time,
                restitution: -state.velocity,
                loss: (1.0 - state.velocity) * (1.0 + state.velocity),
                peak_displacement,
                peak_deflection: 0.0,
                impulse: (1.0 - state.velocity) / INVERSE_MASS,
                contacts: 1,
                end: EndOfContact::Layer(0.0),
            },
            flow,
            error: march.error,
        };
        let samples = (0..=SAMPLES).map(|i| state.time * i as f64 / SAMPLES as f64);
        found.summary.peak_deflection = samples
            .map(|t| found.state(t).deflection)
            .fold(0.0, f64::max);
        Ok(found)
    }

    /// The results.
    #[must_use]
    pub fn summary(&self) -> &Summary {
        &self.summary
    }

    /// What has flowed.
    #[must_use]
    pub fn flow(&self) -> &Flow {
        &self.flow
    }

    /// Sum of the errors of the pieces.
    #[must_use]
    pub fn error(&self) -> f64 {
        self.error
    }

    fn place(&self, time: f64) -> Option<(&Stretch, f64)> {
        if !(time >= 0.0 && time < self.summary.contact_time) {
            return None;
        }
        let after = self.ends.partition_point(|&end| end < time);
        let one = self.stretches.get(after).or(self.stretches.last())?;
        Some((one, place_of(&one.piece, time)))
    }

    /// The state at any time from the touch on; the deflection is not followed after the contact.
    #[must_use]
    pub fn state(&self, time: f64) -> Instant {
        let Some((one, s)) = self.place(time) else {
            let velocity = -self.summary.restitution;
            let last = self.stretches.last();
            let left = last.map_or(0.0, |one| one.piece.displacement.value(1.0));
            return Instant {
                displacement: left + velocity * (time - self.summary.contact_time),
                velocity,
                ..Instant::default()
            };
        };
        let ([force, p1, p2], [_, t1, t2]) = (one.force.curve(s), one.piece.time.curve(s));
        let rate = if t1 > 0.0 { p1 / t1 } else { 0.0 };
        let second_rate = if t1 > 0.0 {
            (p2 - rate * t2) / (t1 * t1)
        } else {
            0.0
        };
        let velocity = one.piece.velocity.value(s);
        let displacement = one.piece.displacement.value(s);
        let here = one.branch.at(one.piece.radius.value(s).max(0.0));
        Instant {
            force: force.max(0.0),
            rate,
            second_rate,
            displacement,
            velocity,
            deflection: match self.lag {
                Some(lag) => -lag * here.stiffness * velocity,
                None => displacement - here.depth,
            },
        }
    }

    /// Touch, onset of yield, turning point and end of the contact.
    #[must_use]
    pub fn breaks(&self) -> [f64; 4] {
        self.breaks
    }

    /// Radius of contact at a time; zero outside the contact.
    #[must_use]
    pub fn radius(&self, time: f64) -> f64 {
        self.place(time)
            .map_or(0.0, |(one, s)| one.piece.radius.value(s).max(0.0))
    }

    /// Stored energy, plastic work and work on the waves until a time, over the kinetic energy before.
    #[must_use]
    pub fn energies(&self, time: f64) -> [f64; 3] {
        let Some((one, s)) = self.place(time) else {
            return [0.0, self.flow.plastic_work, self.flow.radiated];
        };
        let radius = one.piece.radius.value(s).max(0.0);
        let turned = time >= self.breaks[2];
        let (back, from) = if turned {
            (one.branch, radius)
        } else {
            self.yielding.unloading(radius)
        };
        let stored = 2.0 * INVERSE_MASS * back.given_back(from);
        let flowed = if turned {
            self.flow.plastic_work
        } else {
            2.0 * INVERSE_MASS * self.yielding.work(radius) - stored
        };
        [stored, flowed.max(0.0), one.radiated.value(s)]
    }
}

/// Samples among which the largest deflection is.
const SAMPLES: usize = 256;

/// Parts of a piece in which an extremum is looked for.
const PARTS: usize = 6;

/// The largest value of a polynomial of the pieces, and its time.
fn largest<'s>(
    stretches: &'s [Stretch],
    of: impl Fn(&'s Stretch) -> &'s crate::growing::polynomial::Polynomial,
) -> (f64, f64) {
    let mut best = (0.0, 0.0);
    for one in stretches {
        let polynomial = of(one);
        let mut candidate = |s: f64| {
            let value = polynomial.value(s);
            if value > best.0 {
                best = (value, one.piece.time.value(s));
            }
        };
        candidate(1.0);
        for part in 0..PARTS {
            let [mut low, mut high] = [part, part + 1].map(|i| i as f64 / PARTS as f64);
            if polynomial.jet(low).1 <= 0.0 || polynomial.jet(high).1 > 0.0 {
                continue;
            }
            for _ in 0..52 {
                let middle = 0.5 * (low + high);
                if polynomial.jet(middle).1 > 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            candidate(low);
        }
    }
    best
}
