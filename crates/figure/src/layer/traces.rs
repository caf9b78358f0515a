//! A seismogram section: histories, each at its own height.

/// One history at one place.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// Value of the y axis at which it is drawn, such as the distance from the axis.
    pub offset: f64,
    /// Its points: x and value.
    pub points: Vec<(f64, f64)>,
}

/// How long a value is on the axis of the offsets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Gain {
    /// One gain for all: amplitudes can be compared from trace to trace.
    Common,
    /// Each trace to its own largest value: shapes can be compared.
    Each,
}

/// Histories, each at its own height.
#[derive(Debug, Clone, PartialEq)]
pub struct Traces {
    /// Its name in the legend; empty for none.
    pub name: String,
    /// The histories.
    pub traces: Vec<Trace>,
    /// How long a value is.
    pub gain: Gain,
}

impl Traces {
    /// A section.
    #[must_use]
    pub fn new(name: &str, gain: Gain, traces: Vec<Trace>) -> Self {
        Self {
            name: name.to_owned(),
            traces,
            gain,
        }
    }

    /// The curves as they are drawn: the largest value reaches 0.9 of the way to the nearest other trace.
    pub(crate) fn curves(&self) -> Vec<Vec<(f64, f64)>> {
        let largest = |trace: &Trace| {
            let sizes = trace.points.iter().map(|p| p.1.abs());
            sizes.filter(|s| s.is_finite()).fold(0.0, f64::max)
        };
        let overall = self.traces.iter().map(largest).fold(0.0, f64::max);
        let length = 0.9 * self.spacing();
        self.traces
            .iter()
            .map(|trace| {
                let most = match self.gain {
                    Gain::Common => overall,
                    Gain::Each => largest(trace),
                };
                let gain = if most > 0.0 { length / most } else { 0.0 };
                let place = |&(x, value): &(f64, f64)| (x, trace.offset + gain * value);
                trace.points.iter().map(place).collect()
            })
            .collect()
    }

    /// Smallest distance between two traces; one for a single trace.
    fn spacing(&self) -> f64 {
        let mut offsets: Vec<f64> = self.traces.iter().map(|t| t.offset).collect();
        offsets.sort_by(f64::total_cmp);
        let least = offsets
            .windows(2)
            .map(|pair| pair[1] - pair[0])
            .filter(|&d| d > 0.0)
            .fold(f64::INFINITY, f64::min);
        if least.is_finite() { least } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn traces_keep_clear_of_their_neighbours() {
        let trace = |offset: f64, size: f64| Trace {
            offset,
            points: vec![(0.0, 0.0), (1.0, size), (2.0, f64::NAN)],
        };
        let traces = vec![trace(1.0, 8.0), trace(3.0, -4.0)];
        let common = Traces::new("", Gain::Common, traces.clone()).curves();
        assert_eq!((common[0][1].1, common[1][1].1), (2.8, 2.1));
        let each = Traces::new("", Gain::Each, traces).curves();
        assert_eq!((each[0][1].1, each[1][1].1), (2.8, 1.2));
        assert!(each[0][2].1.is_nan());
        let still = Traces::new("", Gain::Each, vec![trace(5.0, 0.0)]).curves();
        assert_eq!(still[0][1], (1.0, 5.0));
    }
}
