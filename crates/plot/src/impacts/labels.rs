//! Labels of several impacts: the differences between their scenes.

use crate::words::{of_key, stem, with_unit};
use formats::stored::{StoredImpact, Value};
use std::collections::{BTreeMap, BTreeSet};

/// Largest number of keys in a label.
const MOST_LABEL_KEYS: usize = 3;

/// One label per impact.
pub(super) fn labels(impacts: &[StoredImpact]) -> Vec<String> {
    let keys = |impact: &StoredImpact| {
        let mut keys: BTreeMap<String, Value> = impact.keys().into_iter().collect();
        // the model in use instead of "auto"
        let model = Value::String(impact.model.clone());
        keys.insert("contact.model".to_owned(), model);
        keys
    };
    let scenes: Vec<BTreeMap<String, Value>> = impacts.iter().map(keys).collect();
    let stems = || impacts.iter().map(|impact| stem(impact.path())).collect();
    by_difference(&scenes).unwrap_or_else(stems)
}

/// Labels from the keys that differ; none if no key differs, too many differ, or two scenes get the same label.
fn by_difference(scenes: &[BTreeMap<String, Value>]) -> Option<Vec<String>> {
    let mut keys: BTreeSet<&String> = scenes.iter().flatten().map(|(key, _)| key).collect();
    keys.retain(|&key| {
        scenes
            .iter()
            .any(|scene| scene.get(key) != scenes[0].get(key))
    });
    let named = keys.iter().filter_map(|key| key.strip_suffix(".material"));
    let named: Vec<&str> = named.collect();
    keys.retain(|key| !named.iter().any(|section| is_of_material(key, section)));
    if keys.is_empty() || keys.len() > MOST_LABEL_KEYS {
        return None;
    }
    let label = |scene: &BTreeMap<String, Value>| {
        let parts = keys.iter().map(|&key| {
            let (name, unit) = of_key(key);
            match scene.get(key) {
                Some(Value::String(text)) if key == "target.material" => {
                    format!("on {text}")
                }
                Some(Value::String(text)) if key == "striker.material" => {
                    format!("{text} striker")
                }
                Some(Value::Float(x)) => format!("{name} {}", with_unit(*x, unit)),
                Some(Value::String(text)) => format!("{name} {}", text.replace('_', " ")),
                Some(_) | None => format!("no {name}"),
            }
        });
        parts.collect::<Vec<_>>().join(", ")
    };
    let labels: Vec<String> = scenes.iter().map(label).collect();
    let different: BTreeSet<&String> = labels.iter().collect();
    let is_told = different.len() == labels.len();
    is_told.then_some(labels)
}

/// Whether the name of a key shows that it is a number of the material of a section.
fn is_of_material(key: &str, section: &str) -> bool {
    const NUMBERS: [&str; 5] = ["modulus", "poisson", "density", "strength", "toughness"];
    let is_number = |key: &str| NUMBERS.iter().any(|number| key.contains(number));
    key.split_once('.')
        .is_some_and(|(of, key)| of == section && is_number(key))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(velocity: f64, model: &str) -> BTreeMap<String, Value> {
        BTreeMap::from([
            ("striker.mass_kg".into(), Value::Float(3.3e-5)),
            ("striker.velocity_m_s".into(), Value::Float(velocity)),
            ("contact.model".into(), Value::String(model.into())),
        ])
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
        // three scenes, two of them identical
        let same = [
            scene(1.0, "hertz"),
            scene(1.0, "hertz"),
            scene(2.0, "hertz"),
        ];
        assert_eq!(by_difference(&same), None);
        let of = |material: &str, modulus: f64| {
            let mut scene = scene(1.0, "hertz");
            let text = Value::String(material.into());
            scene.insert("target.material".into(), text);
            let modulus = Value::Float(modulus);
            scene.insert("target.youngs_modulus_pa".into(), modulus);
            scene
        };
        assert_eq!(
            by_difference(&[of("granite", 5.5e10), of("steel", 2.1e11)]),
            Some(vec!["on granite".into(), "on steel".into()])
        );
    }
}
