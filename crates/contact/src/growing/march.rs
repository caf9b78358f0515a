//! Pieces after pieces from the touch until the contact has mostly opened, then in the radius until it is zero.

use crate::error::MarchError;
use crate::growing::arrivals::{ContactPiece, State};
use crate::growing::equations::{Equations, Errors, Independent, March, Solution};
use crate::growing::nodes::{Polynomial, RadauNodes, SIZE};
use crate::law::branch::{Branch, Law};
use crate::law::hertz::CONTACT_TIME;
use crate::numeric::quadrature::rising_root;
use crate::units::INVERSE_MASS;
use crate::waves::punch::{GrowingContact, LEVELS, PunchWaves};
use std::sync::LazyLock;

/// Largest error after a change by the finer rule over the waves, over that change.
const LEFT_BY_FINER_RULE: f64 = 0.3;

/// Error at the end of a smooth piece over that inside.
const ERROR_OF_SMOOTH_END: f64 = 0.1;

/// Pieces of a load at most, tried ones included.
const MOST_PIECES: usize = 1500;

/// Radius over the largest from which on the radius is the variable.
const SWITCH_TO_RADIUS: f64 = 0.75;

/// Slope of the indentation below which the time to the expected end is the variable.
const LATE_SLOPE: f64 = 0.5;

/// Largest part of the root of the time left that a piece takes.
const LONGEST_PIECE: f64 = 0.45;

/// Change by the finer rule, over the error of a piece, below which the next piece takes a coarser rule.
const COARSER_RULE: f64 = 1e-2;

/// Pieces in the radius at most, tried ones included.
const MOST_PIECES_IN_RADIUS: usize = 200;

/// Error of the time left when it is taken from the power law of the last piece.
const POWER_LAW: f64 = 0.2;

/// Time left, over the accuracy, that is not resolved.
const NEGLIGIBLE: f64 = 2.0;

/// The same where no shorter piece is found either.
const LOST: f64 = 30.0;

impl<'a> March<'a> {
    pub(crate) fn new(contact: GrowingContact<'a>, accuracy: f64) -> Self {
        let degree = (1.0 - accuracy.log10()).round().clamp(5.0, 12.0);
        Self {
            contact,
            accuracy,
            nodes: RadauNodes::of(degree as usize, false),
            pieces: Vec::with_capacity(32),
            state: State::TOUCH,
            law: Law::HERTZ,
            surface: None,
            level: 2,
            widest: 0.0,
            dissipated: 0.0,
            errors: Errors::default(),
        }
    }

    /// On a half-space that answers at once, with a lag.
    pub(crate) fn damped(lag: f64, accuracy: f64) -> Self {
        static NONE: LazyLock<PunchWaves> = LazyLock::new(PunchWaves::default);
        let contact = GrowingContact {
            waves: &NONE,
            target_share: 0.0,
            wave_time: 1.0,
        };
        let mut march = Self::new(contact, accuracy);
        march.law.lag = Some(lag);
        march
    }

    /// Tries a piece, with a rule over the waves that is fine enough: its solution and the estimated error
    /// over the allowed one.
    pub(crate) fn attempt(
        &mut self,
        known: Independent,
        given: Polynomial,
        mut guess: [f64; SIZE],
    ) -> Option<(Solution, f64)> {
        // where what is known has no slope and the indentation has one, nothing in the piece has
        let flat = given.jet(0.0)[1] == 0.0 && self.state.slope < 0.0;
        self.nodes = RadauNodes::of(self.nodes.degree, flat);
        loop {
            let equations = Equations {
                march: self,
                known,
                given,
            };
            let solution = equations.solve(guess)?;
            // of the force where the radius is sought
            let weight = match known {
                Independent::Time => 3.0 * solution.widest * solution.widest,
                Independent::Radius => 1.0,
            };
            // what is left of the change by the finer rule is smaller
            let [error, miss] =
                [solution.truncated, solution.waves].map(|size| size * weight / self.accuracy);
            if error > 1.0 || miss <= 1.0 || self.level + 2 >= LEVELS {
                let coarser = error <= 1.0 && miss < COARSER_RULE && known == Independent::Time;
                self.level -= usize::from(coarser && self.level > 0);
                return Some((solution, error));
            }
            self.level += 1;
            guess = solution.sought;
        }
    }

    /// The error of a march that cannot go on.
    pub(crate) fn lost(&self) -> MarchError {
        MarchError::NotFollowed {
            time: self.state.time,
            tolerance: self.accuracy,
            target_share: self.contact.target_share,
            wave_time: self.contact.wave_time,
        }
    }

    /// Appends a piece.
    pub(crate) fn accept(&mut self, known: Independent, solution: &Solution) {
        let end = solution.piece.end;
        let duration = end.time - self.state.time;
        let error = solution.truncated + LEFT_BY_FINER_RULE * solution.waves;
        let force = 3.0 * solution.widest * solution.widest;
        match known {
            Independent::Time => {
                self.errors.force = self.errors.force.max(force * error);
                self.errors.momentum += force * error * duration;
            }
            Independent::Radius => {
                let steepest = force * (self.state.radius - end.radius) / duration;
                self.errors.force = self.errors.force.max(steepest * error);
                self.errors.momentum += solution.widest.powi(3) * error;
                // the end of a piece converges at twice the order, but in the layer of the last instants
                let layer = end.radius < 3.0 * self.contact.wave_time;
                self.errors.end += if layer {
                    error
                } else {
                    ERROR_OF_SMOOTH_END * error
                };
            }
        }
        // the rate of the lag is a difference of slopes
        let slopes = (self.nodes.degree * self.nodes.degree) as f64;
        self.errors.work +=
            solution.dissipated.abs() * error * slopes / solution.widest.max(duration);
        self.pieces.push(solution.piece);
        self.state = end;
        self.dissipated += solution.dissipated;
        self.widest = self.widest.max(solution.widest);
    }

    /// Change of length that an error over the allowed one asks for.
    pub(crate) fn factor(&self, error: f64) -> f64 {
        let power = 1.0 / self.nodes.degree as f64;
        (0.5 / error.max(1e-12)).powf(power).clamp(0.2, 3.0)
    }

    /// Pieces in time until the radius reaches a limit, or has fallen below most of its largest.
    ///
    /// They are polynomials of the root of the time since the touch, later of the root of the time to the
    /// expected end: Hertz's contact is analytic in these over most of its duration.
    ///
    /// # Errors
    /// [`MarchError::NotFollowed`].
    pub(crate) fn load(&mut self, limit: f64) -> Result<(), MarchError> {
        let mut late = false;
        let piece = |march: &Self, length: &mut f64| {
            let State { time, slope, .. } = march.state;
            if slope < 0.0 && march.state.radius < SWITCH_TO_RADIUS * march.widest {
                return None;
            }
            let expected = march.expected_end();
            if late != (slope < LATE_SLOPE) {
                late = !late;
                *length = 1.0;
            }
            let given = if late {
                *length = length.min(LONGEST_PIECE);
                let left = (expected - time).sqrt();
                Polynomial::power(left, -*length * left, 2).below(expected)
            } else {
                let since = time.sqrt();
                *length = length.min(LONGEST_PIECE * (expected.sqrt() - since));
                Polynomial::power(since, *length, 2)
            };
            let guess = if march.pieces.is_empty() {
                march.first_guess(*length)
            } else {
                march.guess(&given)
            };
            Some((given, guess, false))
        };
        let reached = |march: &Self, solution: &Solution, _| {
            let rising = |s| {
                let [radius, slope, _] = solution.piece.radius.jet(s);
                [radius - limit, slope]
            };
            let over = |s: &f64| rising(*s)[0] > 0.0;
            let above = march.nodes.places.iter().copied().find(over);
            let place = |above| rising_root(rising, [0.0, above], 0.5 * above, 1e-16)[1];
            (solution.widest > limit).then(|| place(above.unwrap_or(1.0)))
        };
        if self.until(
            MOST_PIECES,
            Independent::Time,
            self.first_length(),
            piece,
            reached,
        )? {
            self.state.radius = limit;
        }
        Ok(())
    }

    /// At most `most` pieces, tried ones included, from a first `length`, until there is none or an event in one: whether
    /// it has.
    ///
    /// `piece` returns the known variable over a length, a guess of the unknown, and whether it is the last; `event` the place in a
    /// solution, with its error over the allowed one, where the piece is to end when it is tried once more.
    ///
    /// # Errors
    /// [`MarchError::NotFollowed`].
    pub(crate) fn until(
        &mut self,
        most: usize,
        known: Independent,
        mut length: f64,
        mut piece: impl FnMut(&Self, &mut f64) -> Option<(Polynomial, [f64; SIZE], bool)>,
        event: impl Fn(&Self, &Solution, f64) -> Option<f64>,
    ) -> Result<bool, MarchError> {
        let mut ends = false;
        for _ in 0..most {
            let Some((given, guess, last)) = piece(self, &mut length) else {
                return Ok(false);
            };
            let tried = self.attempt(known, given, guess);
            let stop = tried.as_ref().filter(|_| !ends);
            if let Some(part) = stop.and_then(|(solution, error)| event(self, solution, *error)) {
                (length, ends) = (part * length, true);
                continue;
            }
            match tried {
                Some((solution, error)) if error <= 1.0 => {
                    self.accept(known, &solution);
                    if last || ends {
                        return Ok(ends);
                    }
                    length *= self.factor(error);
                }
                Some((_, error)) if known == Independent::Time && self.pieces.is_empty() => {
                    length *= self.factor(error).powi(2);
                }
                failed => {
                    length *= failed.map_or(0.3, |(_, error)| self.factor(error).min(0.7));
                    if length < 1e-9 {
                        return Err(self.lost());
                    }
                }
            }
            ends = false;
        }
        Err(self.lost())
    }

    /// Root of the duration of the first piece.
    ///
    /// Where the layer of the waves, phi tau in the radius, is not resolved its error of the force is
    /// phi tau s^2; a tenth of the layer is.
    fn first_length(&self) -> f64 {
        let layer = self.contact.target_share * self.contact.wave_time;
        let unresolved = (self.accuracy / (1.2 * layer)).sqrt();
        unresolved.max(0.1 * self.contact.wave_time).min(0.3)
    }

    /// Time at which Hertz's contact would end from here, to a hundredth.
    fn expected_end(&self) -> f64 {
        let (u, rate) = (self.state.radius.powi(2), self.state.slope);
        let energy = rate * rate + u.powf(2.5);
        let top = energy.powf(0.4);
        let half = 0.5 * CONTACT_TIME * top / energy.sqrt();
        let x = (1.0 - u / top).max(0.0);
        let away = half * x.sqrt() * (1.0 - 0.25 * x * (1.0 - x));
        self.state.time + half + if rate > 0.0 { away } else { -away }
    }

    /// A first guess of the radius over the first piece: the law with a relaxation that decays exponentially.
    fn first_guess(&self, length: f64) -> [f64; SIZE] {
        let mut guess = [0.0; SIZE];
        let relaxation = self.contact.waves.relaxation_time() * self.contact.wave_time;
        for (a, s) in guess.iter_mut().zip(&self.nodes.places).skip(1) {
            let t = (length * s).powi(2);
            let mut u = t;
            for _ in 0..4 {
                let rest = (-t / (relaxation * u.sqrt())).exp();
                u = t / (1.0 - self.contact.target_share * rest).max(1e-12);
            }
            *a = u.sqrt();
        }
        guess
    }

    /// The law without waves from the state on, as a guess.
    pub(crate) fn guess(&self, time: &Polynomial) -> [f64; SIZE] {
        let mut guess = [0.0; SIZE];
        guess[0] = self.state.radius;
        let (mut u, mut rate) = (self.state.radius.powi(2), self.state.slope);
        let least = 0.01 * self.widest * self.widest;
        let mut before = self.state.time;
        for (a, &s) in guess.iter_mut().zip(&self.nodes.places).skip(1) {
            let now = time.value(s);
            let step = now - before;
            before = now;
            let middle = u + 0.5 * step * rate;
            let depth = middle.max(0.0);
            let force = match self.law.branch {
                Branch::Hertzian { .. } => depth.powf(1.5),
                Branch::Line { .. }
                | Branch::Fit(_)
                | Branch::Truncated { .. }
                | Branch::OnSpring { .. } => self.law.branch.at(depth.sqrt()).force,
            };
            rate -= step * INVERSE_MASS * force;
            u = (middle + 0.5 * step * rate).max(least);
            *a = u.sqrt();
        }
        guess
    }

    /// Pieces in the radius until it is zero: the end of contact is then the time at a known place.
    ///
    /// In the last instants the contact is so small that its waves cross it in no time: the time left goes
    /// from a^2 over the velocity to a smaller multiple of it, for a stiff striker to nearly a power one of a.
    ///
    /// # Errors
    /// [`MarchError::NotFollowed`].
    pub(crate) fn close(&mut self) -> Result<(), MarchError> {
        if self.law.lag.is_some() {
            return Ok(());
        }
        let mut ratio = 0.3;
        // dt/da ~ a^(power - 1)
        let mut power = 2.0_f64;
        let mut again = 0;
        let (phi, wave_time) = (self.contact.target_share, self.contact.wave_time);
        let bare = (self.accuracy / (0.01 * phi * wave_time)).max(0.3 * wave_time);
        for _ in 0..MOST_PIECES_IN_RADIUS {
            let from = self.state.radius;
            let rate = self.law.branch.at(from).depth_slope / -self.state.slope;
            let left = rate * from / power;
            if left < NEGLIGIBLE * self.accuracy || again > 5 && left < LOST * self.accuracy {
                self.end_by_power_law(left, power);
                return Ok(());
            }
            if from < 3.0 * wave_time {
                self.level = self.level.max(self.least_level());
            }
            let last = from < bare && again == 0;
            let to = if last { 0.0 } else { ratio * from };
            let given = Polynomial::power(from.sqrt(), to.sqrt() - from.sqrt(), 2);
            let guess = self.power_law(&given, left, power);
            match self.attempt(Independent::Radius, given, guess) {
                Some((solution, error)) if error <= 1.0 => {
                    self.accept(Independent::Radius, &solution);
                    if last {
                        return Ok(());
                    }
                    again = 0;
                    let rise = self.law.branch.at(to).depth_slope / -self.state.slope / rate;
                    power = (1.0 + rise.ln() / (to / from).ln()).clamp(0.7, 2.0);
                    ratio = (1.0 - (1.0 - ratio) * self.factor(error)).clamp(0.1, 0.8);
                }
                Some(_) | None => {
                    if !last {
                        ratio = 1.0 - 0.6 * (1.0 - ratio);
                    }
                    again += 1;
                    if again > 1 && self.level < 7 {
                        self.level += 1;
                    }
                    if ratio > 0.999 {
                        break;
                    }
                }
            }
        }
        Err(self.lost())
    }

    /// Level of the rule over the waves below which the last instants have no solution: with few waves the
    /// stiff striker's contact does not open steadily.
    fn least_level(&self) -> usize {
        let phi = self.contact.target_share;
        let stiff = [phi > 0.5, phi > 0.9, self.accuracy < 1e-6];
        1 + stiff.map(usize::from).iter().sum::<usize>()
    }

    /// Times at the nodes by t = t_0 + left (1 - (a/a_0)^power).
    fn power_law(&self, radius: &Polynomial, left: f64, power: f64) -> [f64; SIZE] {
        let mut times = [0.0; SIZE];
        for (time, &s) in times.iter_mut().zip(&self.nodes.places) {
            let a = radius.value(s).max(0.0) / self.state.radius;
            *time = self.state.time + left * (1.0 - a.powf(power));
        }
        times
    }

    /// The last piece by the power law: shorter than the error.
    fn end_by_power_law(&mut self, left: f64, power: f64) {
        let start = self.state;
        let radius = Polynomial::power(start.radius.sqrt(), -start.radius.sqrt(), 2);
        let times = self.power_law(&radius, left, power);
        let places = times.map(|time| start.displacement + start.velocity * (time - start.time));
        self.errors.end += POWER_LAW * left;
        self.state = State {
            time: start.time + left,
            radius: 0.0,
            displacement: start.displacement + start.velocity * left,
            ..start
        };
        self.pieces.push(ContactPiece {
            law: self.law,
            time: self.nodes.polynomial(&times),
            radius,
            velocity: Polynomial::constant(start.velocity),
            displacement: self.nodes.polynomial(&places),
            force: None,
            start,
            end: self.state,
        });
    }
}
