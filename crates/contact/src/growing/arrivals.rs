//! A contact as pieces of polynomials, and where the waves that arrive at one of them left: by Newton's method, several
//! at a time.

use crate::growing::nodes::Polynomial;
use crate::law::branch::Law;
use crate::numeric::quadrature::{CLOSE, rising_root};

/// Time, contact radius, velocity and displacement of the striker over a stretch of the contact, and the law that it follows.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContactPiece {
    pub(crate) law: Law,
    pub(crate) time: Polynomial,
    pub(crate) radius: Polynomial,
    pub(crate) velocity: Polynomial,
    pub(crate) displacement: Polynomial,
    /// Force where it is not the cube of the radius.
    pub(crate) force: Option<Polynomial>,
    pub(crate) start: State,
    pub(crate) end: State,
}

/// State of the striker and the contact where a piece starts or ends.
#[derive(Debug, Clone, Copy)]
pub(crate) struct State {
    pub(crate) time: f64,
    pub(crate) radius: f64,
    pub(crate) velocity: f64,
    pub(crate) displacement: f64,
    /// Slope of the indentation a^2.
    pub(crate) slope: f64,
}

impl State {
    /// When the striker touches.
    pub(crate) const TOUCH: Self = Self {
        time: 0.0,
        radius: 0.0,
        velocity: 1.0,
        displacement: 0.0,
        slope: 1.0,
    };
}

impl ContactPiece {
    /// Force and its first two slopes in the place.
    pub(crate) fn force(&self, place: f64) -> [f64; 3] {
        self.forces(&[place]).map(|[one]| one)
    }

    /// The same at several places together.
    #[inline]
    pub(crate) fn forces<const N: usize>(&self, places: &[f64; N]) -> [[f64; N]; 3] {
        if let Some(force) = &self.force {
            return force.jets(places);
        }
        let [mut radius, mut slope, mut bend] = self.radius.jets(places);
        for l in 0..N {
            let [a, a1, a2] = [radius[l], slope[l], bend[l]];
            let square = 3.0 * a * a;
            radius[l] = a.powi(3);
            slope[l] = square * a1;
            bend[l] = 6.0 * a * a1 * a1 + square * a2;
        }
        [radius, slope, bend]
    }

    /// Power that leaves the law, per place: (p v T' - F u_a a').
    pub(crate) fn losing(&self, place: f64) -> f64 {
        let [radius, radius_slope, _] = self.radius.jet(place);
        let here = self.law.branch.at(radius.max(0.0));
        let travel = self.velocity.value(place) * self.time.jet(place)[1];
        self.force(place)[0] * travel - here.force * here.depth_slope * radius_slope
    }
}

/// The departures of waves of some delays that arrive at a place and a time of a piece after all others, in ascending
/// order: later and later back in time.
///
/// `own` has the time and the radius of that piece, which starts at `start`; `found` holds departures of a nearby
/// contact as first guesses, or of no piece at all.
pub(crate) fn departures(
    pieces: &[ContactPiece],
    own: [&Polynomial; 2],
    start: &State,
    [place, arrival]: [f64; 2],
    delays: &[f64],
    found: &mut [Departure],
) {
    let mut index = pieces.len();
    let mut k = 0;
    while k < delays.len() {
        let arrives = |index: usize, delay: f64| {
            let start = pieces.get(index).map_or(start, |piece| &piece.start);
            start.time + delay * start.radius
        };
        // the piece of the first of those that are left, and those that it holds too
        while index > 0 && arrives(index, delays[k]) > arrival {
            index -= 1;
        }
        let next = delays[k..].iter().take(LANES);
        let held = next
            .take_while(|&&delay| index == 0 || arrives(index, delay) <= arrival)
            .count()
            // an arrival that is not a number is held by no piece
            .max(1);
        let ([time, radius], latest) = match pieces.get(index) {
            Some(piece) => ([&piece.time, &piece.radius], 1.0),
            None => (own, place),
        };
        let roots = Roots {
            time,
            radius,
            arrival,
            latest,
        };
        let (delays, found) = (&delays[k..k + held], &mut found[k..k + held]);
        roots.find(delays, index, found);
        k += held;
    }
}

/// Where the wave of delay X that arrives now left: T + X a(T) = t.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Departure {
    /// Index of the piece; none of a wave that is yet to be found.
    pub(crate) piece: Option<usize>,
    /// Place in it.
    pub(crate) place: f64,
    pub(crate) radius: f64,
    /// Slopes of time and radius with respect to the place.
    pub(crate) time_slope: f64,
    pub(crate) radius_slope: f64,
}

/// Roots and places that are sought together.
pub(crate) const LANES: usize = 4;

/// Roots of T + X a - t in a piece.
struct Roots<'a> {
    time: &'a Polynomial,
    radius: &'a Polynomial,
    /// t
    arrival: f64,
    /// Largest place of a root.
    latest: f64,
}

/// Newton's steps for all roots together; those that need more are found one by one.
const TOGETHER: usize = 4;

impl Roots<'_> {
    /// The roots for up to `LANES` delays; `found` holds first guesses where they are of the piece `index`.
    fn find(&self, delays: &[f64], index: usize, found: &mut [Departure]) {
        let lanes = std::array::from_fn(|l| *delays.get(l).unwrap_or(&delays[0]));
        let mut places = if found.iter().all(|one| one.piece == Some(index)) {
            std::array::from_fn(|l| found.get(l).map_or(0.5 * self.latest, |one| one.place))
        } else {
            self.guess(&lanes)
        };
        let [mut steps, mut time_slopes, mut radii, mut radius_slopes] = [[0.0; LANES]; 4];
        for _ in 0..TOGETHER {
            let times;
            [times, time_slopes, _] = self.time.jets(&places);
            [radii, radius_slopes, _] = self.radius.jets(&places);
            let mut largest = 0.0_f64;
            for l in 0..LANES {
                let miss = times[l] + lanes[l] * radii[l] - self.arrival;
                steps[l] = -miss / (time_slopes[l] + lanes[l] * radius_slopes[l]);
                places[l] = (places[l] + steps[l]).clamp(0.0, self.latest);
                largest = largest.max(steps[l].abs());
            }
            if largest < CLOSE {
                break;
            }
        }
        for (l, one) in found.iter_mut().enumerate() {
            // the next step would be below the last digit; the larger root at the very end is not meant
            let rises = time_slopes[l] + lanes[l] * radius_slopes[l] > 0.0;
            let inside = places[l] > 0.0 && places[l] < self.latest;
            *one = if steps[l].abs() < CLOSE && rises && inside {
                Departure {
                    piece: Some(index),
                    place: places[l],
                    radius: radii[l] + radius_slopes[l] * steps[l],
                    time_slope: time_slopes[l],
                    radius_slope: radius_slopes[l],
                }
            } else {
                self.bracketed(lanes[l], index)
            };
        }
    }

    /// Secants over the piece.
    fn guess(&self, delays: &[f64; LANES]) -> [f64; LANES] {
        let (t0, a0) = (self.time.value(0.0), self.radius.value(0.0));
        let [t1, ts, _] = self.time.jet(self.latest);
        let [a1, a_s, _] = self.radius.jet(self.latest);
        delays.map(|delay| {
            // the tangent at the end where it falls into the piece, else the secant
            let miss = t1 + delay * a1 - self.arrival;
            let tangent = self.latest - miss / (ts + delay * a_s);
            let low = self.arrival - t0 - delay * a0;
            let secant = self.latest * low / (low + miss);
            let near = tangent > 0.3 * self.latest && tangent < self.latest;
            let first = if near { tangent } else { secant };
            let inside = first > 0.0 && first < self.latest;
            if inside { first } else { 0.5 * self.latest }
        })
    }

    /// Newton's iterations inside a bracket; the earliest root in (0, latest).
    fn bracketed(&self, delay: f64, index: usize) -> Departure {
        let late = |place: f64| {
            let [time, time_slope, _] = self.time.jet(place);
            let [radius, radius_slope, _] = self.radius.jet(place);
            let miss = time + delay * radius - self.arrival;
            [miss, time_slope + delay * radius_slope]
        };
        let [before, place] = rising_root(late, [0.0, self.latest], 0.5 * self.latest, 5e-16);
        let [radius, radius_slope, _] = self.radius.jet(before);
        Departure {
            piece: Some(index),
            place,
            radius: radius + radius_slope * (place - before),
            time_slope: self.time.jet(before)[1],
            radius_slope,
        }
    }
}
