//! A place and a time, and the directions in which waves pass it.

/// One evaluation point.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Point {
    pub(crate) r: f64,
    pub(crate) z: f64,
    pub(crate) t: f64,
}

/// Direction of travel of a wave past the observer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Sense {
    /// xi- = i (z gamma^ - t)/x: the wave that comes down from the load.
    Outgoing = -1,
    /// xi+ = i (z gamma^ + t)/x: its image in time, which makes the sum causal.
    Image = 1,
}

impl Sense {
    pub(crate) fn sign(self) -> f64 {
        f64::from(self as i8)
    }
}
