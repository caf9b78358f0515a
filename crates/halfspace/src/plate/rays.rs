//! The waves between the faces of a plate: how far they run, and when they arrive.

use crate::numeric::bisected;
use num_complex::Complex64;

/// A plate as its waves see it; lengths in any unit, times in that unit over c1.
///
/// ```
/// use halfspace::Rays;
/// // Poisson's ratio 1/4; 100 mm, up to two legs
/// let plate = Rays { thickness: 0.1, legs: 2, shear: 3.0 };
/// let echoes = plate.arrivals(0.0, 0.0);
/// let names: Vec<String> = echoes.iter().map(|echo| echo.name()).collect();
/// assert_eq!(names, ["PP", "PS", "SS"]);
/// assert!((echoes[0].time - 0.2).abs() < 1e-15);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rays {
    /// Thickness.
    pub thickness: f64,
    /// Most legs of a wave between the faces.
    pub legs: usize,
    /// Squared slowness of shear waves over that of longitudinal ones.
    pub shear: f64,
}

/// Where a point stands: on a face, or inside, where waves of both directions pass separately.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Place {
    /// Under the load.
    Upper,
    /// Opposite.
    Lower,
    /// Between them.
    Inside,
}

/// Waves that are longitudinal over some legs between the faces and shear over the others, in any order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Echo {
    /// Legs as a longitudinal wave, then as a shear wave.
    pub legs: [usize; 2],
    /// Whether the last part, from a face to a point between them, is longitudinal; none on the faces.
    pub last_is_p: Option<bool>,
    /// When the first of them arrives.
    pub time: f64,
}

impl Echo {
    /// Their name: a P or an S for each leg, and for the last part: "PPS".
    pub fn name(&self) -> String {
        let [p, s] = self.legs;
        let last = match self.last_is_p {
            None => "",
            Some(true) => "P",
            Some(false) => "S",
        };
        format!("{}{}{last}", "P".repeat(p), "S".repeat(s))
    }
}

impl Rays {
    /// All waves at a depth z, at a distance r along the plate from where they begin, in the order of their arrival; on the lower
    /// face without those of one leg, which are the waves of a half-space.
    pub fn arrivals(&self, r: f64, z: f64) -> Vec<Echo> {
        let place = self.place(z);
        let mut found = vec![];
        for (m, n, wave) in self.groups(z) {
            if place == Place::Lower && m == 1 {
                continue;
            }
            found.push(Echo {
                legs: [n, m - n],
                last_is_p: (place == Place::Inside).then_some(wave == 0),
                time: arrival(r, self.distances(m, n, z, wave), self.shear),
            });
        }
        found.sort_by(|one, other| one.time.total_cmp(&other.time));
        found
    }

    /// The groups of waves at a depth: their legs, how many of them are P, and the wave of the last part.
    pub(crate) fn groups(&self, z: f64) -> impl Iterator<Item = (usize, usize, usize)> {
        let lasts = match self.place(z) {
            Place::Inside => 2,
            Place::Upper | Place::Lower => 1,
        };
        let counted = (1..=self.legs).filter(move |m| self.counts(*m, z));
        let each = move |m, n| (0..lasts).map(move |wave| (m, n, wave));
        counted.flat_map(move |m| (0..=m).flat_map(move |n| each(m, n)))
    }

    /// Where a depth is.
    pub(crate) fn place(&self, z: f64) -> Place {
        match z {
            0.0 => Place::Upper,
            _ if z == self.thickness => Place::Lower,
            _ => Place::Inside,
        }
    }

    /// Vertical distance that waves of m legs run from the face that they left last to a depth; zero on the faces, where they
    /// are counted as they arrive.
    fn last_part(&self, m: usize, z: f64) -> f64 {
        match self.place(z) {
            Place::Inside if m.is_multiple_of(2) => z,
            Place::Inside => self.thickness - z,
            Place::Upper | Place::Lower => 0.0,
        }
    }

    /// Vertical distance that waves of m legs run to a depth.
    pub(crate) fn distance(&self, m: usize, z: f64) -> f64 {
        m as f64 * self.thickness + self.last_part(m, z)
    }

    /// Vertical distances as P and as S to a depth, of waves of m legs, n of them as P, whose last part is P (0) or S (1).
    pub(crate) fn distances(&self, m: usize, n: usize, z: f64, wave: usize) -> [f64; 2] {
        let mut distances = [n, m - n].map(|legs| legs as f64 * self.thickness);
        distances[wave] += self.last_part(m, z);
        distances
    }

    /// Whether waves of m legs are counted at a place: those that arrive at a face.
    pub(crate) fn counts(&self, m: usize, z: f64) -> bool {
        match self.place(z) {
            Place::Upper => m.is_multiple_of(2),
            Place::Lower => !m.is_multiple_of(2),
            Place::Inside => true,
        }
    }
}

/// When waves arrive that cover a distance `e` along a plate, and vertical distances as P and as S; `shear` is
/// the squared slowness of shear waves.
///
/// The slowness along the plate is the one of the latest of all plane waves (Fermat).
pub(crate) fn arrival(e: f64, [as_p, as_s]: [f64; 2], shear: f64) -> f64 {
    if as_p == 0.0 {
        return shear.sqrt() * e.hypot(as_s);
    }
    // by the tangent of the angle of P, with which the distance covered grows: its slowness, and the cosines of P and S
    let slownesses = |tangent: f64| {
        let p = (1.0 + tangent * tangent).sqrt().recip();
        let x = tangent * p;
        [x, p, (shear - x * x).sqrt()]
    };
    let falls_short = |tangent: f64| {
        let [x, _, s] = slownesses(tangent);
        as_p * tangent + as_s * x / s < e
    };
    let [x, p, s] = slownesses(bisected(0.0, e / as_p, falls_short));
    e * x + as_p * p + as_s * s
}

/// When the head wave arrives, longitudinal along a face and shear across; none nearer than it exists.
pub(crate) fn head(e: f64, as_s: f64, shear: f64) -> Option<f64> {
    let span = (shear - 1.0).sqrt();
    (e * span >= as_s).then_some(e + as_s * span)
}

/// Where the front of waves that have arrived stands among complex slownesses i/q, right of the imaginary axis:
///
/// ```text
/// A sqrt(1 + q^2) + B sqrt(1 + k q^2) - q t = -i e
/// ```
///
/// By Newton's method, from the place in a medium with the mean slowness.
pub(crate) fn passed(e: f64, [as_p, as_s]: [f64; 2], t: f64, shear: f64) -> Option<Complex64> {
    let distance = as_p + as_s;
    let slowness = (as_p + as_s * shear.sqrt()) / distance;
    let path = t / slowness;
    let late = (path * path - distance * distance).max(f64::MIN_POSITIVE);
    let root = (late - e * e).max(1e-6 * late).sqrt() * distance;
    let mut q = Complex64::new(root, e * path) / (late * slowness);
    for _ in 0..30 {
        let [p, s] = [1.0, shear].map(|k| (1.0 + k * q * q).sqrt());
        let value = as_p * p + as_s * s - q * t + Complex64::new(0.0, e);
        let slope = q * (as_p / p + as_s * shear / s) - t;
        let step = value / slope;
        q -= step;
        if step.norm() < 1e-9 * q.norm() {
            return (q.re > 0.0).then_some(q);
        }
    }
    None
}
