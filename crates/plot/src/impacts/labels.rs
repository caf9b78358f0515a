//! What several impacts are called: by what differs between their scenes.

use crate::words::{of_key, stem, with_unit};
use formats::stored::{StoredImpact, StoredValue};

/// Most keys that a label names.
const MOST_KEYS: usize = 3;

/// One label an impact.
pub(super) fn labels(impacts: &[StoredImpact]) -> Vec<String> {
    let scenes: Vec<Vec<(String, StoredValue)>> = impacts
        .iter()
        .map(|impact| {
            let mut keys = impact.scene.keys();
            // what was computed, rather than "auto"
            keys.retain(|(key, _)| key != "contact.model");
            let model = StoredValue::Text(impact.model.clone());
            keys.push(("contact.model".to_owned(), model));
            keys
        })
        .collect();
    let stems: Vec<String> = impacts.iter().map(|impact| stem(impact.path())).collect();
    by_difference(&scenes).unwrap_or(stems)
}

/// Labels from the keys that differ; none where there are none, too many, or two scenes get the same.
fn by_difference(scenes: &[Vec<(String, StoredValue)>]) -> Option<Vec<String>> {
    let value = |scene: &[(String, StoredValue)], key: &str| {
        let found = scene.iter().find(|(known, _)| known == key);
        found.map(|(_, value)| value.clone())
    };
    let mut keys: Vec<&String> = scenes.iter().flatten().map(|(key, _)| key).collect();
    keys.sort();
    keys.dedup();
    keys.retain(|key| {
        let first = value(&scenes[0], key);
        scenes.iter().any(|scene| value(scene, key) != first)
    });
    let named: Vec<String> = (keys.iter().filter_map(|key| key.strip_suffix(".material")))
        .map(str::to_owned)
        .collect();
    keys.retain(|key| !named.iter().any(|section| is_of_material(key, section)));
    if keys.is_empty() || keys.len() > MOST_KEYS {
        return None;
    }
    let label = |scene: &Vec<(String, StoredValue)>| {
        let parts = keys.iter().map(|key| {
            let (name, unit) = of_key(key);
            match value(scene, key) {
                Some(StoredValue::Text(text)) if key.as_str() == "target.material" => {
                    format!("on {text}")
                }
                Some(StoredValue::Text(text)) if key.as_str() == "striker.material" => {
                    format!("{text} striker")
                }
                Some(StoredValue::Number(x)) => format!("{name} {}", with_unit(x, unit)),
                Some(StoredValue::Text(text)) => format!("{name} {}", text.replace('_', " ")),
                None => format!("no {name}"),
            }
        });
        parts.collect::<Vec<_>>().join(", ")
    };
    let labels: Vec<String> = scenes.iter().map(label).collect();
    let mut different = labels.clone();
    different.sort();
    different.dedup();
    (different.len() == labels.len()).then_some(labels)
}

/// Whether a key is a number of the material of a section, which its name says.
fn is_of_material(key: &str, section: &str) -> bool {
    const NUMBERS: [&str; 5] = ["modulus", "poisson", "density", "strength", "toughness"];
    let key = key
        .strip_prefix(section)
        .and_then(|key| key.strip_prefix('.'));
    key.is_some_and(|key| NUMBERS.iter().any(|number| key.contains(number)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(velocity: f64, model: &str) -> Vec<(String, StoredValue)> {
        vec![
            ("striker.mass_kg".into(), StoredValue::Number(3.3e-5)),
            ("striker.velocity_m_s".into(), StoredValue::Number(velocity)),
            ("contact.model".into(), StoredValue::Text(model.into())),
        ]
    }

    #[test]
    fn labels_say_what_differs() {
        let found = by_difference(&[scene(1.0, "hertz"), scene(2.5, "hertz")]);
        assert_eq!(
            found,
            Some(vec!["velocity 1 m/s".into(), "velocity 2.5 m/s".into()])
        );
        let found = by_difference(&[scene(1.0, "hertz"), scene(1.0, "quasi_static")]);
        assert_eq!(
            found,
            Some(vec!["model hertz".into(), "model quasi static".into()])
        );
        assert_eq!(
            by_difference(&[scene(1.0, "hertz"), scene(1.0, "hertz")]),
            None
        );
        // three scenes of which two are the same
        let same = [
            scene(1.0, "hertz"),
            scene(1.0, "hertz"),
            scene(2.0, "hertz"),
        ];
        assert_eq!(by_difference(&same), None);
        let of = |material: &str, modulus: f64| {
            let mut scene = scene(1.0, "hertz");
            let text = StoredValue::Text(material.into());
            scene.push(("target.material".into(), text));
            let modulus = StoredValue::Number(modulus);
            scene.push(("target.youngs_modulus_pa".into(), modulus));
            scene
        };
        assert_eq!(
            by_difference(&[of("granite", 5.5e10), of("steel", 2.1e11)]),
            Some(vec!["on granite".into(), "on steel".into()])
        );
    }
}
