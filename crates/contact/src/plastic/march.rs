//! A contact that yields as pieces of polynomials, by collocation as for one that does not.
//!
//! Along a piece time T and radius a are functions of a place in [0, 1]; one of them is known.
//!
//! ```text
//! (v - phi S) T' = (u_a - phi s_a) a',    S = sum_k (m_k/X_k) (g - g_k);      with a dashpot v T' = u_a a'
//! v = v_0 - (5/4) int p T' ds
//! ```
//!
//! Pieces end at yield and at the turning point, where the branch changes.

use crate::growing::arrivals::Piece;
use crate::growing::equations::{Independent, State, Values};
use crate::growing::march::March as Elastic;
use crate::growing::nodes::{Factors, Nodes};
use crate::growing::polynomial::{LARGEST, Polynomial, dot};
use crate::growing::waves::GrowingContact;
use crate::model::Plasticity;
use crate::numeric::quadrature::rising_root;
use crate::plastic::Yielding;
use crate::plastic::branch::Branch;
use crate::plastic::problem::{Course, Motion, Problem, Waves};
use crate::units::INVERSE_MASS;

/// A piece with its force, and the branch that it follows.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stretch {
    pub(crate) piece: Piece,
    pub(crate) force: Polynomial,
    /// Work on the waves since the touch, over the kinetic energy.
    pub(crate) radiated: Polynomial,
    pub(crate) branch: Branch,
}

/// A contact on its way.
pub(crate) struct March<'a> {
    pub(crate) yielding: Yielding,
    pub(crate) accuracy: f64,
    pub(crate) course: Course<'a>,
    pub(crate) stretches: Vec<Stretch>,
    /// Work on the deflection, over the kinetic energy.
    pub(crate) radiated: f64,
    /// Sum of the pieces' errors.
    pub(crate) error: f64,
    /// The largest radius.
    pub(crate) top: f64,
    /// When yield begins and when the striker turns.
    pub(crate) breaks: [f64; 2],
}

/// Pieces at most, tried ones included.
const MOST: usize = 500;

/// Velocity, and with memory rate of the radius, too small for a piece.
const STILL: [f64; 2] = [1e-7, 1e-9];

/// Newton's iterations at most.
const ITERATIONS: usize = 12;

/// Step of the differences that stand for derivatives.
const DIFFERENCE: f64 = 1e-7;

/// Velocity over that of approach below which time is the variable until the striker turns.
const SLOW: f64 = 0.6;

/// Part of the root of a radius that a piece takes at most where waves are remembered.
const LONGEST: f64 = 0.5;

/// Time left over the accuracy that is not resolved; the same where no shorter piece is found.
const NEGLIGIBLE: f64 = 1.0;
const LOST: f64 = 30.0;

impl<'a> March<'a> {
    pub(crate) fn new(yielding: Yielding, waves: Waves<'a>, accuracy: f64) -> Self {
        let degree = (2.0 - accuracy.log10()).round().clamp(6.0, 13.0);
        Self {
            yielding,
            accuracy,
            course: Course {
                waves,
                level: (-3.0 - accuracy.log10()).round().clamp(1.0, 7.0) as usize,
                nodes: Nodes::of(degree as usize),
                past: Vec::with_capacity(32),
                laws: Vec::with_capacity(32),
                state: State::TOUCH,
                branch: Branch::Hertz,
                offset: 0.0,
            },
            stretches: Vec::with_capacity(32),
            radiated: 0.0,
            error: 0.0,
            top: 0.0,
            breaks: [0.0; 2],
        }
    }

    /// The whole contact.
    ///
    /// # Errors
    /// The time where no piece is short enough.
    pub(crate) fn run(&mut self) -> Result<(), f64> {
        if let Waves::Memory(contact) = self.course.waves {
            self.touch(contact)?;
        }
        self.load()?;
        self.breaks[1] = self.course.state.time;
        self.top = self.course.state.radius;
        let (branch, top) = self.yielding.unloading(self.top);
        self.enter(branch);
        self.course.state.radius = top;
        self.unload(top)
    }

    /// Velocity, duration and the largest product of radius and velocity of a contact that begins to open at radius one.
    pub(crate) fn from_rest(branch: Branch, waves: Waves<'a>) -> Option<[f64; 3]> {
        let never = Yielding {
            law: Plasticity::None,
            yield_pressure_pa: f64::INFINITY,
            depth: f64::INFINITY,
            fit: None,
        };
        let mut march = Self::new(never, waves, 1e-12);
        (
            march.course.branch,
            march.course.state.radius,
            march.course.state.velocity,
        ) = (branch, 1.0, 0.0);
        march.unload(1.0).ok()?;
        let pull = |one: &Stretch, s: f64| one.piece.radius.value(s) * -one.piece.velocity.value(s);
        let samples = march
            .stretches
            .iter()
            .flat_map(|one| (0..=64).map(move |i| pull(one, f64::from(i) / 64.0)));
        Some([
            -march.course.state.velocity,
            march.course.state.time,
            samples.fold(0.0, f64::max),
        ])
    }

    /// Another branch from here on, with a g that goes on.
    fn enter(&mut self, branch: Branch) {
        let radius = self.course.state.radius;
        self.course.offset += self.course.branch.delayed(radius) - branch.delayed(radius);
        self.course.branch = branch;
    }

    /// The elastic beginning of a contact with memory is that of one that does not yield.
    fn touch(&mut self, contact: GrowingContact<'a>) -> Result<(), f64> {
        let edge = self.yielding.edge();
        let mut elastic = Elastic::new(contact, self.accuracy);
        elastic.load()?;
        for piece in elastic.pieces {
            let yields = piece.to.1 >= edge;
            let to = if yields {
                reaching(&piece.radius, edge)
            } else {
                1.0
            };
            let motion = self.sampled(&piece, to);
            self.accept(&motion);
            if yields {
                self.course.state.radius = edge;
                return Ok(());
            }
        }
        Err(self.course.state.time)
    }

    /// Whether what is left until the turning point is too short for a piece; then it is passed.
    fn has_turned(&mut self) -> bool {
        let State {
            radius,
            velocity,
            slope,
            ..
        } = self.course.state;
        match self.course.waves {
            Waves::Memory(_) => slope < STILL[1],
            Waves::Dashpot(_) if velocity < STILL[0] => {
                self.course.state.time +=
                    velocity / (INVERSE_MASS * self.course.branch.at(radius).force);
                self.course.state.velocity = 0.0;
                true
            }
            Waves::Dashpot(_) => false,
        }
    }

    /// Until the striker turns.
    fn load(&mut self) -> Result<(), f64> {
        let edge = self.yielding.edge();
        let mut part = 1.0;
        for _ in 0..MOST {
            let State { time, radius, .. } = self.course.state;
            if self.has_turned() {
                return Ok(());
            }
            let elastic = self.course.branch == Branch::Hertz;
            if elastic && radius >= edge {
                self.breaks[0] = time;
                self.enter(self.yielding.loading());
                if matches!(self.course.waves, Waves::Memory(_)) {
                    // waves from before the yield arrive with another slope
                    part = 0.1;
                }
                continue;
            }
            let (known, given) = self.next_piece(part);
            let by_radius = known == Independent::Radius;
            let Some((motion, error)) = self.attempt(known, given, None) else {
                part *= 0.5;
                if part < 1e-8 {
                    break;
                }
                continue;
            };
            self.error += error;
            let whole = by_radius && part == 1.0;
            part = (1.6 * part).min(1.0);
            let last = self.course.nodes.degree;
            let mut to = 1.0;
            // the indentation turns; with memory the striker does so later
            let turns = match self.course.waves {
                Waves::Dashpot(_) => motion.velocity[last] <= 0.0,
                Waves::Memory(_) => !by_radius && motion.radius_slope[last] <= 0.0,
            };
            if turns {
                to = match self.course.waves {
                    Waves::Dashpot(_) => {
                        let slowing = self
                            .course
                            .nodes
                            .polynomial(&motion.velocity.map(|v| -v)[..=last]);
                        crossing(|s| slowing.jet(s))
                    }
                    Waves::Memory(_) => {
                        let radius = self.course.nodes.polynomial(&motion.radius[..=last]);
                        crossing(|s| {
                            let [_, slope, bend] = radius.curve(s);
                            (-slope, -bend)
                        })
                    }
                };
            }
            let mut yields = elastic && whole;
            if elastic && !by_radius && motion.radius[last] >= edge {
                let radius = self.course.nodes.polynomial(&motion.radius[..=last]);
                let place = reaching(&radius, edge);
                yields = place <= to;
                to = to.min(place);
            }
            let motion = self.cut(motion, to);
            self.accept(&motion);
            if yields {
                self.course.state.radius = edge;
            } else if turns {
                self.course.state.slope = 0.0;
                return Ok(());
            }
        }
        Err(self.course.state.time)
    }

    /// What the next piece of the loading is a function of.
    fn next_piece(&self, part: f64) -> (Independent, Polynomial) {
        let State {
            time,
            radius,
            velocity,
            ..
        } = self.course.state;
        if velocity > SLOW && part > 1e-3 {
            let elastic = self.course.branch == Branch::Hertz;
            let goal = if elastic {
                self.yielding.edge()
            } else {
                radius + 0.3
            };
            return (
                Independent::Radius,
                Polynomial::power(radius, part * (goal - radius), 1),
            );
        }
        let here = self.course.branch.at(radius);
        let push = here.force + self.course.lag() * here.stiffness.powi(2) * velocity;
        let length = (part * 1.2 * velocity / (INVERSE_MASS * push)).min(0.5);
        (Independent::Time, Polynomial::power(time, length, 1))
    }

    /// Until the force is gone, from the radius at which the striker turned.
    fn unload(&mut self, top: f64) -> Result<(), f64> {
        // where the pressure was cut the branch has a root
        let kink = match self.course.branch {
            Branch::Truncated { edge, top } => ((top - edge) * (top + edge)).max(0.0).sqrt(),
            Branch::Hertz | Branch::Line { .. } | Branch::Fit(_) | Branch::Hertzian { .. } => 0.0,
        };
        let mut part = 0.5_f64;
        // the time left goes with this power of the radius
        let mut power = 2.0;
        let mut failed = false;
        for _ in 0..MOST {
            let State { radius, slope, .. } = self.course.state;
            let (base, floor) = match radius > kink {
                true => (top, kink),
                false => (kink, 0.0),
            };
            let near = radius > 0.5 * base;
            let goal = floor.max(if near { 0.45 * base } else { 0.0 });
            // in the root of the distance to the base, later in that of the radius
            let map = |radius: f64| {
                if near {
                    (base - radius).max(0.0).sqrt()
                } else {
                    radius.sqrt()
                }
            };
            let (from, to) = (map(radius), map(goal));
            let left = radius / -slope / power;
            let (mut share, mut guess) = (part, None);
            if let (Waves::Memory(contact), false) = (self.course.waves, near) {
                let layer = contact.target_share * contact.wave_time;
                let bare = (self.accuracy / (0.01 * layer)).max(0.3 * contact.wave_time);
                share = if radius < bare && !failed {
                    1.0
                } else {
                    part.min(LONGEST)
                };
                guess = Some((left, power));
                if left < NEGLIGIBLE * self.accuracy || part < 0.02 && left < LOST * self.accuracy {
                    self.end_by_power_law(left, power);
                    return Ok(());
                }
            }
            let given = Polynomial::power(from, share * (to - from), 2);
            let given = if near { given.below(base) } else { given };
            let Some((motion, error)) = self.attempt(Independent::Radius, given, guess) else {
                if share < 1.0 || part == 1.0 {
                    part = 0.5 * share;
                }
                failed = true;
                if part < 1e-6 {
                    break;
                }
                continue;
            };
            self.error += error;
            part = (2.0 * share).min(1.0);
            failed = false;
            if let Some(place) = self.separation(&motion) {
                let motion = self.cut(motion, place);
                self.accept(&motion);
                return Ok(());
            }
            self.accept(&motion);
            if share == 1.0 {
                self.course.state.radius = goal;
                if goal == 0.0 {
                    return Ok(());
                }
            }
            if slope < 0.0 {
                let rise = slope / self.course.state.slope;
                power =
                    (1.0 + rise.ln() / (self.course.state.radius / radius).ln()).clamp(0.7, 2.0);
            }
        }
        Err(self.course.state.time)
    }

    /// Where the dashpot's force is gone in a piece of the unloading.
    fn separation(&self, motion: &Motion) -> Option<f64> {
        let n = self.course.nodes.degree;
        let (lag, branch) = (self.course.lag(), self.course.branch);
        // the force over the square of the radius, which vanishes too
        let pull = |a: f64, v: f64| -branch.at(a).force / (a * a) - 2.25 * lag * v;
        let after = (1..=n).find(|&i| {
            motion.radius[i] <= 0.0 || pull(motion.radius[i], motion.velocity[i]) >= 0.0
        })?;
        if lag == 0.0 {
            return None;
        }
        let radius = self.course.nodes.polynomial(&motion.radius[..=n]);
        let velocity = self.course.nodes.polynomial(&motion.velocity[..=n]);
        let (mut low, mut high) = (
            self.course.nodes.places[after - 1],
            self.course.nodes.places[after],
        );
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            let a = radius.value(middle);
            if a > 0.0 && pull(a, velocity.value(middle)) < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(low)
    }

    /// A piece that solves its equations to the accuracy, and its error.
    fn attempt(
        &self,
        known: Independent,
        given: Polynomial,
        law: Option<(f64, f64)>,
    ) -> Option<(Motion, f64)> {
        let n = self.course.nodes.degree;
        let problem = Problem {
            course: &self.course,
            known,
            given,
        };
        let mut sought = problem.guess(law);
        let mut matrix = Factors::room(n);
        let mut before = f64::INFINITY;
        let mut fresh = false;
        for _ in 0..ITERATIONS {
            let mut departures = Vec::new();
            let (_, residual) = problem.residual(&sought, &mut departures);
            if !fresh {
                for l in 1..=n {
                    // short of rounding; a memory's pieces may be shorter than that
                    let least = match self.course.waves {
                        Waves::Dashpot(_) => 0.01 * sought[l].abs(),
                        Waves::Memory(_) => 1e-9,
                    };
                    let by = DIFFERENCE * (sought[l] - sought[0]).abs().max(least);
                    let mut moved = sought;
                    moved[l] += by;
                    let mut departures = departures.clone();
                    let (_, other) = problem.residual(&moved, &mut departures);
                    for i in 0..n {
                        matrix.row(i)[l - 1] = (other[i] - residual[i]) / by;
                    }
                }
                if !matrix.eliminate() {
                    return None;
                }
            }
            let mut change = residual;
            matrix.solve(&mut change[..n]);
            let size = change[..n].iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            let scale = (sought[n] - sought[0]).abs();
            if !size.is_finite() || size > 10.0 * scale {
                return None;
            }
            for i in 1..=n {
                sought[i] -= change[i - 1];
            }
            if size <= 1e-2 * self.accuracy {
                let (motion, _) = problem.residual(&sought, &mut departures);
                let rises = motion.time[..=n].windows(2).all(|t| t[1] >= t[0]);
                let positive = motion.radius[1..n].iter().all(|&a| a > 0.0);
                let mut modes = [0.0; LARGEST + 1];
                self.course.nodes.modes(&sought, &mut modes);
                let [a, b, c] = [3, 2, 1].map(|back| modes[n + 1 - back].abs());
                let error = c.max(if b < a { b * b / a } else { b });
                return (rises && positive && error <= self.accuracy).then_some((motion, error));
            }
            fresh = size < 0.3 * before;
            before = size;
        }
        None
    }

    /// The first part of a piece.
    fn cut(&self, motion: Motion, to: f64) -> Motion {
        if to == 1.0 {
            return motion;
        }
        let n = self.course.nodes.degree;
        let part = |values: &Values| {
            let polynomial = self.course.nodes.polynomial(&values[..=n]);
            let (mut found, mut slopes) = ([0.0; LARGEST + 1], [0.0; LARGEST + 1]);
            for (i, place) in self.course.nodes.places.iter().enumerate() {
                (found[i], slopes[i]) = polynomial.jet(place * to);
                slopes[i] *= to;
            }
            (found, slopes)
        };
        let ((time, time_slope), (radius, radius_slope)) =
            (part(&motion.time), part(&motion.radius));
        Motion {
            time,
            radius,
            time_slope,
            radius_slope,
            velocity: part(&motion.velocity).0,
            force: part(&motion.force).0,
        }
    }

    /// The first part of an elastic piece at the nodes.
    fn sampled(&self, piece: &Piece, to: f64) -> Motion {
        let mut motion = Motion::default();
        for (i, &place) in self.course.nodes.places.iter().enumerate() {
            let s = place * to;
            (motion.time[i], motion.time_slope[i]) = piece.time.jet(s);
            (motion.radius[i], motion.radius_slope[i]) = piece.radius.jet(s);
            motion.time_slope[i] *= to;
            motion.radius_slope[i] *= to;
            motion.velocity[i] = piece.velocity.value(s);
            motion.force[i] = motion.radius[i].max(0.0).powi(3);
        }
        motion
    }

    fn accept(&mut self, motion: &Motion) {
        let n = self.course.nodes.degree;
        let (mut travel, mut losing) = ([0.0; LARGEST], [0.0; LARGEST]);
        for j in 1..=n {
            let here = self.course.branch.at(motion.radius[j].max(0.0));
            travel[j - 1] = motion.velocity[j] * motion.time_slope[j];
            // the work on what is more than the indentation, or of what is more than the law's force
            let lost = match self.course.waves {
                Waves::Dashpot(_) => (motion.force[j] - here.force) * travel[j - 1],
                Waves::Memory(_) => {
                    let indented = here.depth_slope * motion.radius_slope[j];
                    motion.force[j] * (travel[j - 1] - indented)
                }
            };
            losing[j - 1] = 2.0 * INVERSE_MASS * lost;
        }
        let mut radiated = [self.radiated; LARGEST + 1];
        let mut displacement = [self.course.state.displacement; LARGEST + 1];
        for i in 1..=n {
            displacement[i] += dot(self.course.nodes.integral_row(i), &travel[..n]);
            radiated[i] += dot(self.course.nodes.integral_row(i), &losing[..n]);
        }
        self.radiated = radiated[n];
        let polynomial = |values: &Values| self.course.nodes.polynomial(&values[..=n]);
        let piece = Piece {
            time: polynomial(&motion.time),
            radius: polynomial(&motion.radius),
            velocity: polynomial(&motion.velocity),
            displacement: polynomial(&displacement),
            from: (motion.time[0], motion.radius[0]),
            to: (motion.time[n], motion.radius[n]),
        };
        self.course.past.push(piece);
        self.course
            .laws
            .push((self.course.branch, self.course.offset));
        self.stretches.push(Stretch {
            piece,
            force: polynomial(&motion.force),
            radiated: polynomial(&radiated),
            branch: self.course.branch,
        });
        self.course.state = State {
            time: motion.time[n],
            radius: motion.radius[n],
            velocity: motion.velocity[n],
            displacement: displacement[n],
            slope: motion.radius_slope[n] / motion.time_slope[n],
        };
    }

    /// The last piece where the time left goes with a power of the radius: shorter than the error.
    fn end_by_power_law(&mut self, left: f64, power: f64) {
        let from = self.course.state;
        let root = from.radius.sqrt();
        let radius = Polynomial::power(root, -root, 2);
        let mut motion = Motion {
            velocity: [from.velocity; LARGEST + 1],
            ..Motion::default()
        };
        for (i, &place) in self.course.nodes.places.iter().enumerate() {
            (motion.radius[i], motion.radius_slope[i]) = radius.jet(place);
            let part = motion.radius[i].max(0.0) / from.radius;
            motion.time[i] = from.time + left * (1.0 - part.powf(power));
            motion.time_slope[i] = 2.0 * power * left * (1.0 - place).powf(2.0 * power - 1.0);
            motion.force[i] = self.course.branch.at(motion.radius[i].max(0.0)).force;
        }
        self.accept(&motion);
        self.error += 0.2 * left;
    }
}

/// Where a polynomial that rises through a value in (0, 1] does so.
fn reaching(polynomial: &Polynomial, value: f64) -> f64 {
    crossing(|s| {
        let (found, slope) = polynomial.jet(s);
        (found - value, slope)
    })
}

/// Where a value with its slope rises through zero in (0, 1].
fn crossing(value: impl Fn(f64) -> (f64, f64)) -> f64 {
    rising_root(value, [0.0, 1.0], 0.5, 1e-16)[1]
}
