//! Fields over time at the points of Figures 7 to 11.

use crate::PaperError;
use crate::case::RADIUS_M;
use contact::WaveSpeeds;
use impact::{Field, FieldHistory, Run};
use rayon::prelude::*;

/// Until when fields are drawn, in contact times.
const UNTIL: f64 = 1.6;

/// Relative tolerance of the fields.
const TOLERANCE: f64 = 1e-4;

/// The fields of a run at points, r and z in r0.
#[derive(Debug, Clone)]
pub(crate) struct Histories {
    /// Wave speeds of the anvil.
    pub(crate) speeds: WaveSpeeds,
    at: Vec<([f64; 2], FieldHistory)>,
}

/// A field at a point.
#[derive(Debug, Clone, Copy)]
pub(crate) struct History<'a> {
    pub(crate) time_s: &'a [f64],
    pub(crate) samples: &'a [f64],
}

impl Histories {
    /// Computes them.
    pub(crate) fn new(run: &Run, places: &[[f64; 2]]) -> Result<Self, PaperError> {
        let excitation = run.excitation();
        let fields = excitation
            .fields(1e-2 * TOLERANCE)?
            .until(UNTIL * run.contact_time_s)
            .to_tolerance(TOLERANCE);
        let at = places.par_iter().map(|&[r, z]| {
            let history = fields.at(r * RADIUS_M, z * RADIUS_M)?;
            Ok::<_, PaperError>(([r, z], history))
        });
        Ok(Self {
            speeds: excitation.speeds(),
            at: at.collect::<Result<_, _>>()?,
        })
    }

    /// A field at each of some points, which are among those computed.
    pub(crate) fn of<'a>(
        &'a self,
        field: Field,
        places: &'a [[f64; 2]],
    ) -> impl Iterator<Item = History<'a>> {
        let of_place = move |place: &[f64; 2]| self.at.iter().find(|(other, _)| other == place);
        places
            .iter()
            .filter_map(of_place)
            .map(move |(_, history)| History {
                time_s: &history.time_s,
                samples: &history[field].samples,
            })
    }
}

impl History<'_> {
    /// The points of a curve, over `scale`.
    pub(crate) fn curve(&self, scale: f64) -> Vec<(f64, f64)> {
        let points = self.time_s.iter().zip(self.samples);
        points.map(|(&t, &x)| (t, x / scale)).collect()
    }

    /// The value that is farthest from zero.
    pub(crate) fn peak(&self) -> f64 {
        let larger = |most: f64, &x: &f64| if x.abs() > most.abs() { x } else { most };
        self.samples.iter().fold(0.0, larger)
    }

    /// The value farthest on the other side of zero than the peak, with its sign.
    pub(crate) fn other(&self) -> f64 {
        let sign = self.peak().signum();
        let farther = |most: f64, &x: &f64| if x * sign < most * sign { x } else { most };
        self.samples.iter().fold(0.0, farther)
    }

    /// The time in s for which it is above half its peak.
    pub(crate) fn width_s(&self) -> f64 {
        let (peak, mut width) = (self.peak(), 0.0);
        for (times, values) in self.time_s.windows(2).zip(self.samples.windows(2)) {
            let above = |x: f64| (x / peak).max(0.5) - 0.5 > 0.0;
            width += match (above(values[0]), above(values[1])) {
                (true, true) => times[1] - times[0],
                (false, false) => 0.0,
                (left, _) => {
                    let share = (0.5 * peak - values[0]) / (values[1] - values[0]);
                    (times[1] - times[0]) * if left { share } else { 1.0 - share }
                }
            };
        }
        width
    }

    /// Its value at a time, in its peak.
    pub(crate) fn share_at(&self, time_s: f64) -> f64 {
        let after = self.time_s.partition_point(|&t| t < time_s);
        self.samples.get(after).map_or(0.0, |x| x / self.peak())
    }

    /// When it first exceeds a share of its peak, in s.
    pub(crate) fn first_s(&self, share: f64) -> f64 {
        let most = share * self.peak().abs();
        let first = self.samples.iter().position(|x| x.abs() > most);
        first.map_or(f64::INFINITY, |i| self.time_s[i])
    }
}
