//! The section of a results file.

use super::error::ReadError;
use super::open::{Stored, StoredQuantity};
use crate::results::schema::{MAP, MAP_SCALES, PEAK_SUFFIXES};

/// The section of a results file: its grid and times; frames are read when they are asked for.
///
/// A frame runs over depths, the deepest first, and within a depth over the distances from the axis.
#[derive(Debug, Clone)]
pub struct StoredSection {
    stored: Stored,
    /// Distances from the axis in m, ascending.
    pub r_m: Vec<f64>,
    /// Depths in m, descending.
    pub z_m: Vec<f64>,
    /// Times of the frames in s.
    pub time_s: Vec<f64>,
}

impl StoredSection {
    pub(super) fn new(stored: Stored) -> Result<Self, ReadError> {
        let scale = |i: usize| stored.vector(&format!("{MAP}/{}", MAP_SCALES[i].0));
        let (time_s, z_m, r_m) = (scale(0)?, scale(1)?, scale(2)?);
        let rising = |x: &[f64]| x.windows(2).all(|pair| pair[0] < pair[1]);
        let falling = z_m.windows(2).all(|pair| pair[0] > pair[1]);
        if !rising(&time_s) || !rising(&r_m) || !falling || r_m.len() < 2 || z_m.len() < 2 {
            return Err(stored.damaged("the axes of its section are not in order"));
        }
        Ok(Self {
            stored,
            r_m,
            z_m,
            time_s,
        })
    }

    /// What was stored in each frame.
    #[must_use]
    pub fn quantities(&self) -> Vec<StoredQuantity> {
        self.stored.quantities(MAP, &self.shape())
    }

    /// A quantity in a frame.
    ///
    /// # Errors
    /// [`ReadError`] for a quantity or a frame that is not there.
    pub fn frame(&self, quantity: &str, frame: usize) -> Result<Vec<f32>, ReadError> {
        if frame >= self.time_s.len() {
            let last = self.time_s.len() - 1;
            return Err(self
                .stored
                .damaged(format!("frame {frame} is outside [0, {last}]")));
        }
        self.stored
            .slab(&format!("{MAP}/{quantity}"), &self.shape(), frame)
    }

    /// The largest value of a quantity over all samples at each place, where the file has it.
    #[must_use]
    pub fn peak(&self, quantity: &str) -> Option<Vec<f64>> {
        let path = format!("{MAP}/{quantity}{}", PEAK_SUFFIXES[0]);
        let [_, z, r] = self.shape();
        self.stored.numbers(&path, &[z, r]).ok()
    }

    fn shape(&self) -> [usize; 3] {
        [self.time_s.len(), self.z_m.len(), self.r_m.len()]
    }
}
