//! Writes histories as text or HDF5: `data-schema/lamb.md`.

use super::{LambCase, LambHistory};
use crate::hdf::{attach_scales, scalar, scale, stage, text, vector};
use crate::results::{ending, write_columns};
use crate::schema::lamb as schema;
use hdf5::File;
use output::{CSV, Output, OutputError, Staged};
use std::io::{BufWriter, Write};
use std::path::Path;

/// Writes histories into an output that was claimed before the work; committing it gives the file its name.
///
/// # Errors
/// [`OutputError`].
pub fn stage_lamb<'a>(
    output: &'a Output,
    path: &Path,
    case: &LambCase,
    found: &[LambHistory],
) -> Result<Staged<'a>, OutputError> {
    if CSV.is_of(path) {
        return output.stage(|file| {
            let mut file = BufWriter::new(file);
            for receiver in &case.receivers {
                let [r_m, z_m] = receiver.place_m;
                writeln!(file, "# {}: r = {r_m} m, z = {z_m} m", receiver.name)?;
            }
            writeln!(
                file,
                "# columns _error: estimated largest absolute error of the history"
            )?;
            let errors: Vec<Vec<f64>> = found
                .iter()
                .map(|own| vec![own.error; case.times_s.len()])
                .collect();
            let mut columns = vec![("time_s".to_owned(), case.times_s.as_slice())];
            for (own, errors) in found.iter().zip(&errors) {
                let name = format!(
                    "{}_{}{}",
                    case.receivers[own.receiver].name,
                    own.name,
                    ending(own.unit)
                );
                columns.extend([
                    (name.clone(), own.values.as_slice()),
                    (format!("{name}_error"), errors),
                ]);
            }
            write_columns(&mut file, &columns)?;
            file.flush()
        });
    }
    let kind = [schema::FILE_TYPE, schema::FORMAT_VERSION];
    stage(output, kind, |file| fill(file, case, found))
}

fn fill(file: &File, case: &LambCase, found: &[LambHistory]) -> Result<(), hdf5::Error> {
    text(file, schema::CASE, &case.text)?;
    let time = scale(file, &schema::TIME, &case.times_s)?;
    for (i, receiver) in case.receivers.iter().enumerate() {
        let group = file.create_group(&receiver.name)?;
        let [r_m, z_m] = receiver.place_m;
        let [x_m, y_m] = receiver.xy_m.map_or([None; 2], |xy| xy.map(Some));
        for (name, value) in [
            ("r_m", Some(r_m)),
            ("z_m", Some(z_m)),
            ("x_m", x_m),
            ("y_m", y_m),
        ] {
            value.map_or(Ok(()), |value| scalar(&group, name, value))?;
        }
        for own in found.iter().filter(|own| own.receiver == i) {
            let meaning = schema::HISTORIES
                .iter()
                .find(|row| row.0 == own.name)
                .map_or("", |row| row.1);
            let dataset = vector(&group, &(own.name, own.unit, meaning), &own.values)?;
            scalar(&dataset, schema::ERROR, own.error)?;
            attach_scales(&dataset, &[&time])?;
        }
    }
    Ok(())
}
