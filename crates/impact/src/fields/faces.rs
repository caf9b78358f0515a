//! Sentences on the faces of a block: fields are those of a half-space, which has none but the loaded one.

use crate::convolution::Convolution;
use crate::fields::probes::ProbeFields;
use crate::fields::sensors::SensorHistory;
use crate::scene::{Probe, Scene, Section, Sensor};
use contact::HalfSpace;

/// The other face of the block that a place is on, by the keys that say so.
fn face(block: &HalfSpace, [r, z]: [(&str, f64); 2]) -> Option<Face> {
    let limits = [
        (z, "thickness_m", block.thickness_m),
        (r, "radius_m", block.radius_m),
    ];
    let is_plate = block.echoing().is_some();
    let on = limits.into_iter().find(|((_, place_m), key, limit)| {
        let counts = !(is_plate && *key == "thickness_m");
        counts && limit.is_some_and(|limit_m| *place_m >= limit_m)
    });
    on.map(|((key, place_m), limit, _)| Face {
        words: format!("{key} = {limit} = {place_m} m"),
        is_lower: limit == "thickness_m",
    })
}

/// A face of a block.
struct Face {
    words: String,
    is_lower: bool,
}

/// A warning that no field is valid on a face.
fn doubled(who: &str, face: &Face) -> String {
    let way_out = match face.is_lower {
        true => "; with echoes = 1 or more in [target] they are those of a plate",
        false => "",
    };
    format!(
        "{who} on a free face of the block ({}): the echo begins there with the first arrival, and a free face about doubles the motion (exactly doubles that of a P wave at normal incidence), so the fields of the half-space are not valid there at any time{way_out}",
        face.words
    )
}

/// What the fields after the last echo that they contain are of.
fn instead(block: &HalfSpace) -> String {
    match block.echoing() {
        None => "later fields there are those of a half-space, not of the block".to_owned(),
        Some(plate) => format!(
            "later fields there have the waves that run the thickness up to {} times, not those of the block",
            plate.legs
        ),
    }
}

/// Points of one kind that warnings are about.
struct Points {
    /// "probe" or "sensor".
    kind: &'static str,
    /// Their distances from the axis and depths in m, by the keys that set them.
    places: Vec<[(&'static str, f64); 2]>,
    arrival_s: Vec<[f64; 3]>,
    valid_until_s: Vec<f64>,
}

/// Of probes in an output that ends at a time in s.
pub(crate) fn of_probes(scene: &Scene, fields: &ProbeFields, end_s: f64) -> Vec<String> {
    let place = |probe: &Probe| [("r_m", probe.r_m), ("z_m", probe.z_m)];
    let points = Points {
        kind: "probe",
        places: scene.probes.iter().map(place).collect(),
        arrival_s: fields.arrival_s.clone(),
        valid_until_s: fields.valid_until_s.clone(),
    };
    points.warnings(scene, end_s)
}

/// Of sensors.
pub(crate) fn of_sensors(scene: &Scene, histories: &[SensorHistory], end_s: f64) -> Vec<String> {
    let place = |sensor: &Sensor| [("r_m", sensor.farthest_m()[0]), ("z_m", sensor.z_m)];
    let points = Points {
        kind: "sensor",
        places: scene.sensors.iter().map(place).collect(),
        arrival_s: histories.iter().map(|own| own.arrival_s).collect(),
        valid_until_s: histories.iter().map(|own| own.valid_until_s).collect(),
    };
    points.warnings(scene, end_s)
}

impl Points {
    fn warnings(&self, scene: &Scene, end_s: f64) -> Vec<String> {
        let (mut found, kind, count) = (Vec::new(), self.kind, self.places.len());
        let faces = self.places.iter().map(|place| face(&scene.target, *place));
        let faces: Vec<Option<Face>> = faces.collect();
        let on: Vec<(usize, &Face)> = (1..)
            .zip(&faces)
            .filter_map(|(i, face)| Some((i, face.as_ref()?)))
            .collect();
        if let Some((first, face)) = on.first() {
            let who = match on.len() {
                1 => format!("{kind} {first} is"),
                several => format!("{several} of {count} {kind}s, the first {kind} {first}, are"),
            };
            found.push(doubled(&who, face));
        }
        found.extend(self.unreached(scene, end_s));
        let inside = (1..).zip(self.valid_until_s.iter().zip(&faces));
        let inside = inside.filter(|(_, (valid_s, face))| face.is_none() && **valid_s < end_s);
        let echoing: Vec<(usize, f64)> = inside.map(|(i, (&valid_s, _))| (i, valid_s)).collect();
        if let Some((first, first_s)) = echoing.iter().min_by(|a, b| a.1.total_cmp(&b.1)) {
            found.push(format!(
                "echoes from the faces of the block reach {} of {count} {kind}s before the output ends at {end_s:.4e} s, first {kind} {first} at {first_s:.4e} s: {}",
                echoing.len(),
                instead(&scene.target),
            ));
        }
        found
    }

    /// A warning of places so far out on a plate that its echoes end before a wave arrives: elsewhere the output waits for it.
    fn unreached(&self, scene: &Scene, end_s: f64) -> Option<String> {
        scene.target.echoing()?;
        let arrivals = (1..).zip(&self.arrival_s);
        let late: Vec<usize> = arrivals
            .filter(|(_, [p_s, ..])| *p_s > end_s)
            .map(|(i, _)| i)
            .collect();
        let (kind, first) = (self.kind, late.first()?);
        Some(format!(
            "no wave reaches {} of {} {kind}s, first {kind} {first}, before the output ends at {end_s:.4e} s: set a longer output.duration_s, as far as the echoes of the plate can be computed",
            late.len(),
            self.places.len(),
        ))
    }
}

/// Of a section in an output that ends at a time in s.
pub(crate) fn of_section(
    convolution: &Convolution<'_>,
    block: &HalfSpace,
    section: &Section,
    end_s: f64,
) -> Vec<String> {
    let corner = [("r_max_m", section.r_max_m), ("z_max_m", section.z_max_m)];
    let on = face(block, corner).map(|face| doubled("the section ends", &face));
    let excitation = convolution.grid.excitation;
    let radius_m = excitation.units().disc_radius_m;
    // the nearest of its places to the lower face and to the side
    let nearest = [[0.0, section.z_max_m], [section.r_max_m, 0.0]];
    let echoes = nearest.map(|place| excitation.speeds().first_echo_s(block, place, radius_m));
    let first_s = echoes.into_iter().flatten().reduce(f64::min);
    let first_s = first_s.map(|first_s| excitation.start_s() + first_s);
    let echoing = first_s.filter(|&first_s| first_s < end_s).map(|first_s| {
        format!(
            "echoes from the faces of the block reach the section from {first_s:.4e} s on, before the output ends at {end_s:.4e} s: {}",
            instead(block)
        )
    });
    on.into_iter().chain(echoing).collect()
}
