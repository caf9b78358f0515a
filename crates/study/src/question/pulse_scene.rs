//! The scenes of question 3: a pulse at a point, and how a method is measured there.

use crate::StudyError;
use crate::effort::Effort;
use crate::pulse_reference::PulseReference;
use crate::record::{Error, Question, Record};
use halfspace::{Medium, Six};
use std::hint::black_box;

/// A pulse at a point.
pub(super) struct Scene {
    pub(super) name: &'static str,
    /// Its name where two ways to interpolate are compared.
    pub(super) interpolation: &'static str,
    pub(super) reference: PulseReference,
}

/// Every method is sampled at multiples of this.
pub(super) const EVERY: f64 = 1.6;

/// The scenes of the question.
pub(super) fn scenes(medium: &Medium, effort: Effort) -> Result<Vec<Scene>, StudyError> {
    let count = effort.pick(8, 16);
    let scene = |name, interpolation, place, length| -> Result<Scene, StudyError> {
        let reference = PulseReference::new(medium, place, length, EVERY, count)?;
        Ok(Scene {
            name,
            interpolation,
            reference,
        })
    };
    let mut scenes = vec![scene(
        "under the disc, pulse of 10 r0/c1",
        "whole response against remainder, pulse of 10 r0/c1",
        [0.55, 0.65],
        10.0,
    )?];
    if effort == Effort::Full {
        scenes.push(scene(
            "under the disc, pulse of 40 r0/c1",
            "whole response against remainder, pulse of 40 r0/c1",
            [0.55, 0.65],
            40.0,
        )?);
        scenes.push(scene(
            "near the edge, pulse of 40 r0/c1",
            "whole response against remainder, near the edge",
            [1.03, 0.45],
            40.0,
        )?);
    }
    Ok(scenes)
}

/// What a record is called.
pub(super) struct Label {
    pub(super) scene: &'static str,
    pub(super) method: &'static str,
    pub(super) setting: String,
    pub(super) default_path: bool,
}

/// Adds the record of a method whose samples are `width` apart.
pub(super) fn add(
    records: &mut Vec<Record>,
    effort: Effort,
    reference: &PulseReference,
    label: Label,
    width: f64,
    run: &mut dyn FnMut() -> Vec<Six>,
) {
    let samples = run();
    let Some(errors) = reference.errors(&samples, width) else {
        return;
    };
    let time = reference.times.last().copied().unwrap_or(1.0);
    let cost = effort.clock().time(time, || {
        black_box(run());
    });
    records.push(Record {
        question: Question::Fields,
        scene: label.scene,
        method: label.method,
        setting: label.setting,
        default_path: label.default_path,
        cost,
        error: Error::of(&errors),
        work: Some(samples.len() as f64 / time),
        refusal: None,
    });
}

/// Samples needed at a width.
pub(super) fn sample_count(reference: &PulseReference, width: f64) -> usize {
    let end = reference.times.last().copied().unwrap_or(0.0);
    (end / width).round() as usize + 1
}
