//! Ranges of the settings of a grid.

use crate::error::BuildError;
use crate::grid::{Axis, Grid};

/// Largest memory in bytes for the numbers of a table.
const MOST_TABLE_BYTES: f64 = 64e9;

/// Number of copies of the numbers in memory while a table is assembled.
const COPIES: f64 = 3.0;

impl Grid {
    /// Checks that every setting is in its range, and that the numbers of the table fit into 64 GB of memory.
    ///
    /// # Errors
    /// [`BuildError::Refused`], which names the first key outside its range.
    pub fn validate(&self) -> Result<(), BuildError> {
        within("cell_width", self.cell_width, [0.005, 1.0], "[0.005, 1]")?;
        within("time_factor", self.time_factor, [1.1, 10.0], "[1.1, 10]")?;
        within("tail_terms", self.tail_terms as f64, [2.0, 20.0], "[2, 20]")?;
        within("tolerance", self.tolerance, [1e-12, 1e-3], "[1e-12, 1e-3]")?;
        let points = self.stencil_points;
        let even = points.is_multiple_of(2) && (2..=8).contains(&points);
        setting("stencil_points", points as f64, even, "{2, 4, 6, 8}")?;
        let lengths = &self.pulse_lengths;
        let at_least_one = "a list of at least one";
        setting("pulse_lengths", f64::NAN, !lengths.is_empty(), at_least_one)?;
        ascending("pulse_lengths", lengths, [0.5, 1000.0], "[0.5, 1000]")?;
        let ratios = &self.poisson_ratios;
        setting("poisson_ratios", f64::NAN, !ratios.is_empty(), at_least_one)?;
        ascending("poisson_ratios", ratios, [-0.95, 0.495], "[-0.95, 0.495]")?;
        let exact = &self.exact_ratios;
        ascending("exact_ratios", exact, [-0.95, 0.495], "[-0.95, 0.495]")?;
        for &nu in exact {
            let new = !ratios.contains(&nu);
            setting(
                "exact_ratios",
                nu,
                new,
                "ratios that are not in poisson_ratios",
            )?;
        }
        axis("r", &self.r)?;
        axis("z", &self.z)?;
        let gigabytes = 1e-9 * self.bytes()?;
        let range = "64 GB";
        let fits = gigabytes <= 1e-9 * MOST_TABLE_BYTES;
        setting("size of the table in memory in GB", gigabytes, fits, range)
    }

    /// Approximate memory in bytes for building the table: its numbers as rows, as a table and as a file.
    ///
    /// # Errors
    /// As [`validate`](Self::validate).
    pub fn memory_bytes(&self) -> Result<f64, BuildError> {
        self.validate()?;
        Ok(COPIES * self.bytes()?)
    }

    /// Size in bytes of the numbers of the table in memory.
    pub(crate) fn bytes(&self) -> Result<f64, BuildError> {
        let nodes: usize = self.nodes().iter().map(Vec::len).product();
        let slices = self.poisson_ratios.len() + self.exact_ratios.len();
        let each = 3 * self.cells()? + self.tail_terms;
        Ok(nodes as f64 * slices as f64 * (6 * each * size_of::<f32>()) as f64)
    }
}

fn axis(name: &str, axis: &Axis) -> Result<(), BuildError> {
    let key = |key: &str| format!("{name}.{key}");
    within(&key("max"), axis.max, [0.25, 100.0], "[0.25, 100]")?;
    within(&key("spacing"), axis.spacing, [0.005, 1.0], "[0.005, 1]")?;
    for (last, value, limits, range) in [
        ("focus", axis.focus, [0.0, axis.max], "[0, max]"),
        (
            "focus_spacing",
            axis.focus_spacing,
            [0.001, axis.spacing],
            "[0.001, spacing]",
        ),
        ("growth", axis.growth, [0.01, 1.0], "[0.01, 1]"),
        (
            "extended_to",
            axis.extended_to,
            [axis.max, 100.0],
            "[max, 100]",
        ),
    ] {
        if let Some(value) = value {
            within(&key(last), value, limits, range)?;
        }
    }
    let count = axis.count();
    let good = (8.0..=2000.0).contains(&count);
    setting(
        &format!("{name}: number of nodes"),
        count,
        good,
        "[8, 2000]",
    )
}

/// Checks that values are in their range and ascend strictly.
fn ascending(
    key: &str,
    values: &[f64],
    limits: [f64; 2],
    range: &'static str,
) -> Result<(), BuildError> {
    for (i, &value) in values.iter().enumerate() {
        within(key, value, limits, range)?;
        let ascends = i == 0 || value > values[i - 1];
        setting(key, value, ascends, "strictly ascending values")?;
    }
    Ok(())
}

/// Checks that a value is in its range.
pub(crate) fn within(
    key: &str,
    value: f64,
    [low, high]: [f64; 2],
    range: &'static str,
) -> Result<(), BuildError> {
    setting(key, value, value >= low && value <= high, range)
}

fn setting(key: &str, value: f64, good: bool, range: &'static str) -> Result<(), BuildError> {
    if good {
        return Ok(());
    }
    let sentence = format!("grid: {key} = {value} is outside {range}");
    Err(BuildError::of_key(key, value, Some(range), sentence))
}
