//! The scene that a file was made from.

use crate::scene::bodies_of;
use crate::section::parse;
use contact::HalfSpace;
use impact::Strike;
use toml::{Table, Value};

/// The resolved scene of a results file.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredScene {
    /// The half-space.
    pub target: HalfSpace,
    /// The striker; none where the force was given.
    pub strike: Option<Strike>,
    table: Table,
}

impl StoredScene {
    /// From the text in a file.
    pub(super) fn new(text: &str) -> Result<Self, String> {
        let table = parse(text).map_err(|error| error.to_string())?;
        let (target, strike) = bodies_of(&table).map_err(|error| error.to_string())?;
        Ok(Self {
            target,
            strike,
            table,
        })
    }

    /// Every key with a value, such as `striker.velocity_m_s` and `2.5`, in alphabetical order.
    ///
    /// Lists are left out: the probes, the points of a section.
    #[must_use]
    pub fn keys(&self) -> Vec<(String, StoredValue)> {
        let mut found = Vec::new();
        for (section, value) in &self.table {
            let Value::Table(keys) = value else {
                continue;
            };
            for (key, value) in keys {
                let value = match value {
                    Value::Float(x) => StoredValue::Number(*x),
                    Value::Integer(i) => StoredValue::Number(*i as f64),
                    Value::String(text) => StoredValue::Text(text.clone()),
                    Value::Boolean(_) | Value::Datetime(_) | Value::Array(_) | Value::Table(_) => {
                        continue;
                    }
                };
                found.push((format!("{section}.{key}"), value));
            }
        }
        found
    }
}

/// The value of a key of a scene.
#[derive(Debug, Clone, PartialEq)]
pub enum StoredValue {
    /// A number in the unit of its key.
    Number(f64),
    /// A word.
    Text(String),
}
