//! Nodes of one axis, uniform or graded toward a place where the fields vary strongly.

use serde::{Deserialize, Serialize};

/// An axis from 0 to `max` whose spacing grows linearly with the distance from `focus`.
///
/// ```text
/// spacing(x) = min(spacing, focus_spacing + growth |x - focus|)
/// ```
///
/// Without `focus_spacing` the axis is uniform. All lengths are in r0.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Axis {
    /// Last node.
    pub max: f64,
    /// Largest spacing.
    pub spacing: f64,
    /// Place with the smallest spacing.
    pub focus: Option<f64>,
    /// Spacing at the focus.
    pub focus_spacing: Option<f64>,
    /// Growth of the spacing with distance from the focus.
    pub growth: Option<f64>,
    /// End of the equal steps of the last spacing that follow `max`.
    pub extended_to: Option<f64>,
}

impl Axis {
    /// A uniform axis.
    pub fn uniform(max: f64, spacing: f64) -> Self {
        Self {
            max,
            spacing,
            ..Self::default()
        }
    }

    /// An axis graded toward `focus`.
    pub fn graded(max: f64, spacing: f64, focus: f64, focus_spacing: f64, growth: f64) -> Self {
        Self {
            focus: Some(focus),
            focus_spacing: Some(focus_spacing),
            growth: Some(growth),
            ..Self::uniform(max, spacing)
        }
    }

    /// The nodes ascending from 0 to `max`, including the focus, rounded to multiples of 2^-16, and then the extension.
    pub fn nodes(&self) -> Vec<f64> {
        self.padded(0)
    }

    /// The nodes up to `max`.
    fn inner(&self) -> Vec<f64> {
        let focus = self.focus.unwrap_or(0.0).clamp(0.0, self.max);
        let mut nodes = Vec::new();
        if focus > 0.0 {
            let inner = self.one_side(focus);
            nodes.extend(inner[1..].iter().rev().map(|distance| focus - distance));
        }
        let outer = self.one_side(self.max - focus);
        nodes.extend(outer.iter().map(|distance| focus + distance));
        for node in &mut nodes {
            *node = (*node * 65536.0).round() / 65536.0;
        }
        if let Some(last) = nodes.last_mut() {
            *last = self.max;
        }
        nodes
    }

    /// Number of steps beyond `max`, an integer.
    fn extension(&self, step: f64) -> f64 {
        let steps = (self.extended_to.unwrap_or(0.0) - self.max) / step;
        (steps - 1e-9).ceil().max(0.0)
    }

    /// Number of nodes, without computing those beyond `max`; infinite if neighbours coincide.
    ///
    /// `max` and the spacings must be positive.
    pub(crate) fn count(&self) -> f64 {
        let nodes = self.inner();
        if nodes.windows(2).all(|pair| pair[0] < pair[1]) {
            nodes.len() as f64 + self.extension(last_step(&nodes))
        } else {
            f64::INFINITY
        }
    }

    /// [`Self::nodes`] and `count` more nodes at the last spacing.
    pub fn padded(&self, count: usize) -> Vec<f64> {
        let mut nodes = self.inner();
        let step = last_step(&nodes);
        let beyond = self.extension(step) as usize + count;
        nodes.extend((1..=beyond).map(|i| self.max + step * i as f64));
        nodes
    }

    /// Last place that can be looked up.
    pub fn end(&self) -> f64 {
        self.nodes().last().copied().unwrap_or(self.max)
    }

    /// Distances from 0 to `length` from the focus, equally spaced in int dx/spacing(x).
    fn one_side(&self, length: f64) -> Vec<f64> {
        let steps = self.measure(length);
        let count = (steps - 1e-9).ceil().max(1.0);
        (0..=count as usize)
            .map(|i| self.distance(steps * i as f64 / count).min(length))
            .collect()
    }

    /// Number of steps from the focus to a distance.
    fn measure(&self, distance: f64) -> f64 {
        match self.grading() {
            Some((start, growth, knee)) => {
                let graded = distance.min(knee);
                (growth * graded / start).ln_1p() / growth + (distance - graded) / self.spacing
            }
            None => distance / self.spacing,
        }
    }

    /// Inverse of [`Self::measure`].
    fn distance(&self, steps: f64) -> f64 {
        match self.grading() {
            Some((start, growth, knee)) => {
                let graded = (growth * knee / start).ln_1p() / growth;
                if steps <= graded {
                    start * (growth * steps).exp_m1() / growth
                } else {
                    knee + (steps - graded) * self.spacing
                }
            }
            None => steps * self.spacing,
        }
    }

    /// Spacing at the focus, growth, and the distance at which the largest spacing is reached.
    fn grading(&self) -> Option<(f64, f64, f64)> {
        let start = self.focus_spacing?;
        let growth = self.growth.filter(|growth| *growth > 0.0)?;
        (start < self.spacing).then(|| (start, growth, (self.spacing - start) / growth))
    }
}

/// The step before the last node.
fn last_step(nodes: &[f64]) -> f64 {
    nodes[nodes.len() - 1] - nodes[nodes.len() - 2]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_uniform_axis_has_its_spacing() {
        let nodes = Axis::uniform(6.0, 0.125).nodes();
        assert_eq!(nodes.len(), 49);
        assert!(
            nodes
                .iter()
                .enumerate()
                .all(|(i, &x)| x == 0.125 * i as f64)
        );
    }

    #[test]
    fn nodes_are_counted_without_making_them() {
        let mut axis = Axis::graded(6.0, 0.125, 1.0, 0.02, 0.2);
        axis.extended_to = Some(7.3);
        assert_eq!(axis.count(), axis.nodes().len() as f64);
        // a focus that rounds to the end, with a last step of zero
        axis.focus = Some(6.0 - 1e-9);
        assert_eq!(axis.count(), f64::INFINITY);
    }

    #[test]
    fn a_graded_axis_ascends_and_keeps_its_ends_and_focus() {
        let axis = Axis::graded(6.0, 0.125, 1.0, 0.02, 0.2);
        let nodes = axis.nodes();
        assert_eq!((nodes[0], nodes[nodes.len() - 1]), (0.0, 6.0));
        assert!(nodes.contains(&1.0));
        for pair in nodes.windows(2) {
            let (step, middle) = (pair[1] - pair[0], 0.5 * (pair[0] + pair[1]));
            let asked = (0.02 + 0.2 * (middle - 1.0_f64).abs()).min(0.125);
            assert!(
                step > 0.5 * asked && step < 1.1 * asked,
                "{middle}: {step} against {asked}"
            );
        }
    }
}
