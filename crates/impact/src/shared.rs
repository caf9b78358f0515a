//! Tables for many excitations: each part is loaded once, and shared by all threads.

use crate::kernels::source::{TableFault, Tables};
use lookup::{LookupError, Table};
use std::collections::HashMap;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

/// Tables a part of which is loaded once for each Poisson's ratio, as far as it reaches.
///
/// What it gives does not depend on who asked before.
/// A ratio takes the memory of a slice, so that it is for a few of them; [`Arc<Table>`] serves any number.
#[derive(Debug)]
pub struct Shared {
    tables: Arc<dyn Tables>,
    parts: Mutex<HashMap<u64, Part>>,
    fault: Mutex<Option<String>>,
}

/// What is known of a ratio.
type Part = Result<Arc<Table>, LookupError>;

/// A table that was there before and cannot be read any more.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Lost(String);

impl fmt::Display for Lost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Lost {}

impl Shared {
    /// Of some tables; nothing is loaded yet.
    #[must_use]
    pub fn new(tables: Arc<dyn Tables>) -> Self {
        Self {
            tables,
            parts: Mutex::default(),
            fault: Mutex::default(),
        }
    }

    /// Why a part could not be read, where that has happened: what was computed since may lack it.
    #[must_use]
    pub fn fault(&self) -> Option<String> {
        let fault = self.fault.lock().unwrap_or_else(PoisonError::into_inner);
        fault.clone()
    }

    fn known(&self, poisson_ratio: f64) -> Result<Part, TableFault> {
        let mut parts = self.parts.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(part) = parts.get(&poisson_ratio.to_bits()) {
            return Ok(part.clone());
        }
        let found = self.load(poisson_ratio).map_err(|error| {
            let mut fault = self.fault.lock().unwrap_or_else(PoisonError::into_inner);
            fault.get_or_insert(error.to_string());
            Lost(error.to_string())
        })?;
        parts.insert(poisson_ratio.to_bits(), found.clone());
        Ok(found)
    }

    fn load(&self, poisson_ratio: f64) -> Result<Part, TableFault> {
        if let Some(outside) = self.tables.refusal(poisson_ratio, [0.0; 2])? {
            return Ok(Err(outside));
        }
        let part = self.tables.part(poisson_ratio, [f64::INFINITY; 2])?;
        Ok(Ok(part))
    }
}

impl Tables for Shared {
    fn part(&self, poisson_ratio: f64, _: [f64; 2]) -> Result<Arc<Table>, TableFault> {
        Ok(self.known(poisson_ratio)??)
    }

    fn refusal(&self, poisson_ratio: f64, _: [f64; 2]) -> Result<Option<LookupError>, TableFault> {
        Ok(self.known(poisson_ratio)?.err())
    }
}
