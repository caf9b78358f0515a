//! Identity of the results of a scene, and the check that a results file is complete.

use crate::error::SceneError;
use crate::scene::resolved;
use crate::schema::results as schema;
use crate::stored::StoredImpact;
use contact::NUMBERS_REVISION;
use impact::numbers::FIELDS_REVISION;
use impact::{Load, Scene};
use ledger::Identity;
use std::path::Path;

/// SHA-256 over the resolved scene with the samples of its force record, the program's version, the revisions of its
/// numbers and the file format.
pub fn scene_sha256(scene: &Scene) -> String {
    // the path of its record does not matter
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

/// Checks that the file at `path` is the complete result of a scene. Its fields may have computed kernels if `direct`,
/// and kernels of the table `id` if there is one.
///
/// # Errors
/// One sentence with the reason.
pub fn check_results(
    path: &Path,
    scene: &Scene,
    direct: bool,
    id: Option<&str>,
) -> Result<(), String> {
    let told = |error: SceneError| error.to_string();
    let found = StoredImpact::open(path).map_err(told)?;
    // files of versions before 1.7 do not store the hash of their scene
    if found.stored.text(schema::SCENE_SHA256) != Ok(scene_sha256(scene)) {
        return Err(format!(
            "{} is the result of another scene, or of this scene before its files or the program changed",
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
        "{} has fields with other kernels than requested: {kernel}{of_table}",
        path.display()
    ))
}
