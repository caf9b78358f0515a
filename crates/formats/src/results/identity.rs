//! What makes the results of two scenes the same, and whether a results file is the whole result of a scene.

use crate::error::SceneError;
use crate::scene::resolved;
use crate::schema::results as schema;
use crate::stored::StoredImpact;
use contact::NUMBERS_REVISION;
use impact::numbers::FIELDS_REVISION;
use impact::{Load, Scene};
use ledger::Identity;
use std::path::Path;

/// Identity of the resolved scene with the samples of its force record, of the program's version, of the
/// revisions of its numbers and of the format.
pub fn scene_sha256(scene: &Scene) -> String {
    // wherever its record lies
    let mut placeless = scene.clone();
    let mut samples = Vec::new();
    if let Load::Record(record) = &mut placeless.load {
        record.file = None;
        let numbers = record.time_s().iter().chain(record.force_n());
        samples.extend(numbers.flat_map(|number| number.to_le_bytes()));
    }
    Identity::default()
        .with("software", env!("CARGO_PKG_VERSION"))
        .with("numbers", format!("{NUMBERS_REVISION} {FIELDS_REVISION}"))
        .with("format", schema::FORMAT_VERSION)
        .with("scene", resolved(&placeless))
        .with("record", samples)
        .hex()
}

/// Why the file at `path` is not the whole result of a scene, whose fields may have computed kernels where `direct` says
/// so, and those of the table with an id where there is one.
///
/// # Errors
/// One sentence.
pub fn check_results(
    path: &Path,
    scene: &Scene,
    direct: bool,
    id: Option<&str>,
) -> Result<(), String> {
    let told = |error: SceneError| error.to_string();
    let found = StoredImpact::open(path).map_err(told)?;
    // files of versions before 1.7 do not say which scene they are of
    if found.stored.text(schema::SCENE_SHA256) != Ok(scene_sha256(scene)) {
        return Err(format!(
            "{} is of another scene, or of this one before its files or the program changed",
            path.display()
        ));
    }
    let text = |name| found.stored.text(name).map_err(told);
    let (kernel, table) = (text("kernel")?, text("table_id")?);
    let same = match kernel.as_str() {
        // no fields, no kernels
        "none" => true,
        "direct" => direct,
        "table" => id == Some(&table),
        _ => false,
    };
    if same {
        return Ok(());
    }
    let of_table = if table.is_empty() {
        String::new()
    } else {
        format!(" of the table {table}")
    };
    Err(format!(
        "{} has fields with other kernels than are asked for: {kernel}{of_table}",
        path.display()
    ))
}
