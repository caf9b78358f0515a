//! Pieces after pieces until the contact ends.

use super::nodes::{LARGEST, Nodes, Polynomial};
use super::piece::Piece;
use super::step::{Groups, Known, Solved, State, Step, Values};
use super::waves::{LEVELS, PunchWaves};
use crate::units::INVERSE_MASS;

/// How finely a contact is resolved.
#[derive(Debug, Clone, Copy)]
pub struct Resolution {
    /// Degree of the pieces.
    pub degree: usize,
    /// Error that a piece may leave.
    pub piece: f64,
    /// Error that the rule over the waves may leave.
    pub waves: f64,
}

/// Work done.
#[derive(Debug, Clone, Copy, Default)]
pub struct Work {
    pub pieces: usize,
    pub refused: usize,
    pub iterations: usize,
    pub delays: usize,
    pub finest: usize,
}

#[derive(Debug, Clone)]
pub struct Contact {
    pub(super) pieces: Vec<Piece>,
    pub work: Work,
    pub end: (f64, f64, f64),
    pub dissipated: f64,
}

struct March<'a> {
    waves: &'a PunchWaves,
    groups: Groups,
    resolution: Resolution,
    nodes: &'static Nodes,
    pieces: Vec<Piece>,
    state: State,
    level: usize,
    widest: f64,
    dissipated: f64,
    work: Work,
}

/// The force of the first contact.
pub fn contact(waves: &PunchWaves, target_share: f64, wave_time: f64, resolution: Resolution) -> Result<Contact, String> {
    let mut march = March {
        waves,
        groups: Groups { target_share, wave_time },
        resolution,
        nodes: Nodes::of(resolution.degree),
        pieces: Vec::with_capacity(32),
        state: State { time: 0.0, radius: 0.0, velocity: 1.0, displacement: 0.0, slope: 1.0 },
        level: 2,
        widest: 0.0,
        dissipated: 0.0,
        work: Work::default(),
    };
    march.load()?;
    march.close()?;
    Ok(Contact {
        end: (march.state.time, march.state.velocity, march.state.displacement),
        dissipated: 2.5 * march.dissipated,
        work: Work { pieces: march.pieces.len(), ..march.work },
        pieces: march.pieces,
    })
}

/// What came of a piece.
enum Tried {
    Done(Solved, f64),
    Refused,
}

impl March<'_> {
    fn attempt(&mut self, known: Known, given: Polynomial, guess: &Values) -> Tried {
        loop {
            let step = Step {
                groups: self.groups,
                nodes: self.nodes,
                rule: self.waves.rule(self.level),
                finer: self.waves.rule(self.level + 1),
                pieces: &self.pieces,
                start: self.state,
                known,
                given,
            };
            let Some(solved) = step.solve(guess, (1e-2 * self.resolution.piece).sqrt().min(1e-5), 0.3 * self.resolution.piece) else {
                self.work.refused += 1;
                return Tried::Refused;
            };
            self.work.iterations += solved.iterations;
            self.work.delays += solved.iterations * self.nodes.degree * step.rule.delays.len();
            let n = self.nodes.degree;
            let widest = solved.radius[..=n].iter().fold(0.0_f64, |m, &a| m.max(a));
            let error = match known {
                Known::Time => last_mode(&solved.modes, n) * 3.0 * widest * widest,
                Known::Radius => last_mode(&solved.modes, n),
            } / self.resolution.piece;
            if error > 1.0 {
                self.work.refused += 1;
                return Tried::Done(solved, error);
            }
            let waves = match known {
                Known::Time => solved.waves * 3.0 * widest * widest,
                Known::Radius => solved.waves,
            };
            let miss = waves / self.resolution.waves;
            if miss > 1.0 && self.level + 2 < LEVELS {
                self.level += 1;
                continue;
            }
            if miss < 1e-3 && self.level > 0 && known == Known::Time {
                self.level -= 1;
            }
            self.work.finest = self.work.finest.max(self.level);
            return Tried::Done(solved, error);
        }
    }

    fn accept(&mut self, solved: &Solved) {
        self.pieces.push(solved.piece);
        self.state = solved.end;
        self.dissipated += solved.dissipated;
        self.widest = solved.radius[..=self.nodes.degree].iter().fold(self.widest, |m, &a| m.max(a));
    }

    /// Change of length that an error asks for.
    fn factor(&self, error: f64) -> f64 {
        (0.5 / error.max(1e-12)).powf(1.0 / self.nodes.degree as f64).clamp(0.2, 3.0)
    }

    /// Time pieces until the radius has fallen below most of its largest.
    ///
    /// They are polynomials of the root of the time since the touch, later of the time to the expected end.
    fn load(&mut self) -> Result<(), String> {
        let mut length = self.first_length();
        let mut late = false;
        for _ in 0..400 {
            let first = self.pieces.is_empty();
            let expected = if first { HERTZ } else { self.expected_end() };
            let falling = self.state.slope < LATE;
            if falling != late {
                late = falling;
                length = 1.0;
            }
            if late {
                length = length.min(1.0 - SHORTEST);
            }
            let left = (expected - self.state.time).sqrt();
            let given = if late {
                let step = length * left;
                Polynomial::power(left, -step, 2).below(expected)
            } else {
                let from = self.state.time.sqrt();
                length = length.min(0.45 * (expected.sqrt() - from));
                Polynomial::power(from, length, 2)
            };
            let guess = if first { self.first_guess(length) } else { self.guess(&given) };
            let tried = self.attempt(Known::Time, given, &guess);
            if std::env::var("DBG").is_ok() { println!("   load {:.4e} + {length:.4e} late {late} a {:.5e} slope {:.3e} level {} {}", self.state.time, self.state.radius, self.state.slope, self.level, match &tried { Tried::Done(s, e) => format!("err {e:.2e} its {}", s.iterations), Tried::Refused => "refused".into() }); }
            match tried {
                Tried::Done(solved, error) if error <= 1.0 => {
                    self.accept(&solved);
                    length *= self.factor(error);
                    if self.state.slope < 0.0 && self.state.radius < SWITCH * self.widest {
                        return Ok(());
                    }
                }
                Tried::Done(_, error) => {
                    let factor = self.factor(error);
                    length *= if first { factor * factor } else { factor.min(0.7) };
                }
                Tried::Refused => length *= 0.3,
            }
            if length < 1e-14 {
                return Err(format!("length {length:e} at {}", self.state.time));
            }
        }
        Err("too many pieces".into())
    }

    /// Root of the duration of the first piece.
    ///
    /// Where the waves' layer, phi tau long in the radius, is not resolved its error of the force is
    /// phi tau s^2; a tenth of the layer is.
    fn first_length(&self) -> f64 {
        let Groups { target_share, wave_time } = self.groups;
        let layer = target_share * wave_time;
        (self.resolution.piece / (1.2 * layer)).sqrt().max(0.1 * wave_time).min(0.3)
    }

    /// Time at which Hertz's contact would end from here.
    fn expected_end(&self) -> f64 {
        let (u, rate) = (self.state.radius.powi(2), self.state.slope);
        let energy = rate * rate + u.powf(2.5);
        let top = energy.powf(0.4);
        let half = 0.5 * HERTZ * top / energy.sqrt();
        // time from the top: u/top = 1 - x^2 of the half, nearly
        let x = (1.0 - u / top).max(0.0);
        let away = half * x.sqrt() * (1.0 - 0.25 * x * (1.0 - x) - 0.0 * x);
        self.state.time + half + if rate > 0.0 { away } else { -away }
    }

    /// A first guess of the radius over the first piece: the law with a relaxation that decays exponentially.
    fn first_guess(&self, length: f64) -> Values {
        let mut guess = [0.0; LARGEST + 1];
        let Groups { target_share, wave_time } = self.groups;
        let relaxation = self.waves.relaxation_time() * wave_time;
        for (a, s) in guess.iter_mut().zip(&self.nodes.places).skip(1) {
            let t = (length * s).powi(2);
            let mut u = t;
            for _ in 0..4 {
                u = t / (1.0 - target_share * (-t / (relaxation * u.sqrt())).exp()).max(1e-12);
            }
            *a = u.sqrt();
        }
        guess
    }

    /// Hertz's contact from the state on, as a guess.
    fn guess(&self, time: &Polynomial) -> Values {
        let mut guess = [0.0; LARGEST + 1];
        guess[0] = self.state.radius;
        let (mut u, mut rate) = (self.state.radius.powi(2), self.state.slope);
        for i in 1..=self.nodes.degree {
            let step = time.value(self.nodes.places[i]) - time.value(self.nodes.places[i - 1]);
            let pull = |u: f64| -INVERSE_MASS * u.max(0.0).powf(1.5);
            let middle = u + 0.5 * step * rate;
            rate += step * pull(middle);
            u = (middle + 0.5 * step * rate).max(0.01 * self.widest * self.widest);
            guess[i] = u.sqrt();
        }
        guess
    }

    /// Pieces in the radius until it is zero.
    fn close(&mut self) -> Result<(), String> {
        let mut ratio = 0.3;
        let mut power = 2.0_f64;
        let mut again = 0;
        let phi = self.groups.target_share;
        let floor = if phi > 0.9 { 3 } else if phi > 0.5 { 2 } else { 1 } + usize::from(self.resolution.piece < 1e-6);
        let layer = self.groups.target_share * self.groups.wave_time;
        let bare = (self.resolution.piece / (0.01 * layer)).max(0.3 * self.groups.wave_time);
        for _ in 0..200 {
            let from = self.state.radius;
            // dt/da ~ a^(q - 1)
            let rate = 2.0 * from / -self.state.slope;
            let rest = rate * from / power;
            let tiny = rest < 2.0 * self.resolution.piece || again > 5 && rest < 30.0 * self.resolution.piece;
            if from < 3.0 * self.groups.wave_time {
                self.level = self.level.max(floor);
            }
            let last = from < bare && again == 0;
            let to = if last { 0.0 } else { ratio * from };
            let given = Polynomial::power(from.sqrt(), to.sqrt() - from.sqrt(), 2);
            let mut guess = [0.0; LARGEST + 1];
            for (t, s) in guess.iter_mut().zip(&self.nodes.places) {
                let a = (from.sqrt() + s * (to.sqrt() - from.sqrt())).powi(2);
                *t = self.state.time + rest * (1.0 - (a / from).powf(power));
            }
            if tiny {
                self.state.time += rest;
                return Ok(());
            }
            let tried = self.attempt(Known::Radius, given, &guess);
            if std::env::var("DBG").is_ok() { println!("   close {from:.4e} -> {to:.4e} t {:.8} slope {:.3e} level {} {}", self.state.time, self.state.slope, self.level, match &tried { Tried::Done(s, e) => format!("err {e:.2e} its {}", s.iterations), Tried::Refused => "refused".into() }); }
            match tried {
                Tried::Done(solved, error) if error <= 1.0 => {
                    self.accept(&solved);
                    again = 0;
                    let rise = (to / -self.state.slope) / (0.5 * rate);
                    power = (1.0 + rise.ln() / (to / from).ln()).clamp(0.7, 2.0);
                    if to == 0.0 {
                        return Ok(());
                    }
                    let width = (1.0 - ratio) * self.factor(error);
                    ratio = (1.0 - width).clamp(0.1, 0.8);
                }
                Tried::Done(_, _) | Tried::Refused => {
                    if !last {
                        ratio = 1.0 - 0.6 * (1.0 - ratio);
                    }
                    again += 1;
                    if again > 1 && self.level < 7 {
                        self.level += 1;
                    }
                    if ratio > 0.999 {
                        return Err(format!("ratio at {from}, t = {}", self.state.time));
                    }
                }
            }
        }
        Err("never closes".into())
    }
}

/// Radius over the largest from which on the radius is the variable.
const SWITCH: f64 = 0.75;

/// Slope of the indentation below which the time to the end is the variable.
const LATE: f64 = 0.5;

/// Root of the time left over that at the start of a piece, at least.
const SHORTEST: f64 = 0.55;

/// Hertz's contact time.
const HERTZ: f64 = 2.943_275_184_324_705;

fn last_mode(modes: &Values, n: usize) -> f64 {
    let [a, b, c] = [modes[n - 2], modes[n - 1], modes[n]].map(f64::abs);
    c.max(if b < a { b * b / a } else { b })
}
