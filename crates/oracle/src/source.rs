//! The load: its distribution over the surface, and its function of time.

use contact::choice;
use std::f64::consts::PI;

/// Distribution of the force over the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Load {
    /// A point force.
    Point,
    /// Hertz's pressure on a disc, proportional to sqrt(1 - r^2/radius^2).
    Hertz {
        /// Radius of the disc in m.
        radius_m: f64,
    },
    /// Uniform pressure on a disc.
    Uniform {
        /// Radius of the disc in m.
        radius_m: f64,
    },
}

/// A smooth function of time with peak 1, defined at all times.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wavelet {
    /// (1 - 2 a) exp(-a), a = (pi f (t - t0))^2; f is the peak frequency of its spectrum.
    Ricker,
    /// exp(-a), a = (pi f (t - t0))^2.
    Gaussian,
}

choice!(Wavelet: Ricker = "ricker", Gaussian = "gaussian");

/// A force over time.
#[derive(Debug, Clone, PartialEq)]
pub enum TimeFunction {
    /// A smooth one, times an amplitude in N.
    Smooth {
        /// Its shape.
        wavelet: Wavelet,
        /// f in Hz.
        frequency_hz: f64,
        /// t0 in s.
        delay_s: f64,
        /// Force at t0 in N.
        force_n: f64,
    },
    /// Steps and lines.
    Lines(Lines),
}

/// A force that is a sum of steps and of a continuous force, linear between its kinks.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Lines {
    /// Time in s and rise in N of each step, ascending in time.
    pub(crate) steps: Vec<[f64; 2]>,
    /// Time in s and change of slope in N/s of each kink, ascending in time.
    pub(crate) kinks: Vec<[f64; 2]>,
}

impl Lines {
    /// A step of `force_n` at `delay_s`.
    pub fn step(delay_s: f64, force_n: f64) -> Self {
        Self {
            steps: vec![[delay_s, force_n]],
            kinks: Vec::new(),
        }
    }

    /// Lines between samples at ascending times in s, forces in N, with the steps of it: at a first and a last sample that is not
    /// zero, and at two samples of one time.
    pub fn of_samples(time_s: &[f64], force_n: &[f64], steps: Vec<[f64; 2]>) -> Self {
        let (mut kinks, mut slope) = (Vec::new(), 0.0);
        for (t, p) in time_s.windows(2).zip(force_n.windows(2)) {
            if t[1] > t[0] {
                let after = (p[1] - p[0]) / (t[1] - t[0]);
                kinks.push([t[0], after - slope]);
                slope = after;
            }
        }
        kinks.extend(time_s.last().map(|&end_s| [end_s, -slope]));
        Self { steps, kinks }
    }
}

impl Wavelet {
    /// Distance from t0 in units of 1/(pi f) beyond which the function and its first two derivatives are below 1e-18 of their
    /// peaks.
    pub(crate) const REACH: f64 = 7.2;

    /// The value, and the first and second derivative with respect to x = pi f (t - t0).
    ///
    /// ```
    /// use oracle::Wavelet;
    /// assert_eq!(Wavelet::Ricker.at(0.0), [1.0, 0.0, -6.0]);
    /// assert_eq!(Wavelet::Gaussian.at(0.0), [1.0, 0.0, -2.0]);
    /// ```
    pub fn at(self, x: f64) -> [f64; 3] {
        let a = x * x;
        let factors = match self {
            Self::Ricker => [
                1.0 - 2.0 * a,
                x * (4.0 * a - 6.0),
                a * (24.0 - 8.0 * a) - 6.0,
            ],
            Self::Gaussian => [1.0, -2.0 * x, 4.0 * a - 2.0],
        };
        factors.map(|factor| factor * (-a).exp())
    }
}

impl TimeFunction {
    /// The force in N at a time of a smooth function; 0 otherwise.
    pub fn smooth_n(&self, time_s: f64) -> f64 {
        match self {
            Self::Smooth {
                wavelet,
                frequency_hz,
                delay_s,
                force_n,
            } => force_n * wavelet.at(PI * frequency_hz * (time_s - delay_s))[0],
            Self::Lines(_) => 0.0,
        }
    }
}
