//! The section in a results file: `/VTKHDF` for ParaView and pyvista, `/map` for everything else.
//!
//! Both contain the same data: the fields in `/map` are hard links to those in `/VTKHDF`.

use crate::hdf::{
    array, attach_scales, describe, numbers, scalar, scale, set_scale, text, texts, vector,
};
use crate::quantities::{Described, Labels, labels_of};
use crate::schema::results as schema;
use hdf5::types::FixedAscii;
use hdf5::{Dataset, File, Group};
use impact::{Peaks, SectionFields};

/// Suffix of the names of largest values.
const PEAK: &str = schema::PEAK_SUFFIXES[0];

pub(super) fn write_section(file: &File, map: &SectionFields) -> Result<(), hdf5::Error> {
    let group = file.create_group(schema::MAP)?;
    let shape = [map.time_s.len(), map.z_m.len(), map.r_m.len()];
    let [_, nz, nr] = shape;
    let [time, z, r] = &schema::MAP_SCALES;
    let time = scale(&group, time, &map.time_s)?;
    let (z, r) = (scale(&group, z, &map.z_m)?, scale(&group, r, &map.r_m)?);
    let wave = waves(&group)?;
    let arrivals: Vec<f64> = map.arrival_s.iter().flatten().copied().collect();
    let dataset = numbers(&group, &schema::ARRIVALS, &[3, nz, nr], &arrivals)?;
    attach_scales(&dataset, &[&wave, &z, &r])?;
    let (points, offsets) = vtk_image(file, map)?;
    let whole = match &map.peaks {
        Some(_) => Some(scale(&file.group(schema::VTK)?, &schema::WHOLE, &[0_i64])?),
        None => None,
    };
    // netCDF looks for the scales of a dataset in its group and in the parent groups
    for (name, ..) in schema::MAP_SCALES {
        link(file, &[schema::MAP, name], &[schema::VTK, name])?;
    }
    let found = map.values.iter().zip(&map.errors);
    for (i, (row, (values, errors))) in labels_of(&map.quantities).zip(found).enumerate() {
        let dataset = points
            .new_dataset::<f32>()
            .shape(shape)
            .chunk([1, nz, nr])
            .obj_track_times(false)
            .create(row.0)?;
        dataset.write_raw(values)?;
        describe(&dataset, &row)?;
        attach_scales(&dataset, &[&time, &z, &r])?;
        let path = [schema::VTK, schema::VTK_POINTS, row.0];
        link(file, &path, &[schema::MAP, row.0])?;
        let peaks = map.peaks.as_ref().map(|peaks| &peaks[i]);
        for (row, found) in beside(row, errors, peaks) {
            let dataset = numbers(&group, &row.labels(), &[nz, nr], found)?;
            attach_scales(&dataset, &[&z, &r])?;
            if let Some(whole) = whole.as_ref().filter(|_| row.name.ends_with(PEAK)) {
                // all steps refer to the first and only value
                let single: Vec<f32> = found.iter().map(|&value| value as f32).collect();
                let dataset = numbers(&points, &row.labels(), &[1, nz, nr], &single)?;
                attach_scales(&dataset, &[whole, &z, &r])?;
                vector(&offsets, &row.labels(), &vec![0_i64; map.time_s.len()])?;
            }
        }
    }
    Ok(())
}

/// Datasets of a quantity with one number per place: the estimate of its error and, if recorded, its largest value over
/// time, the time of it, and the error of it.
pub fn beside<'v>(
    row: Labels<'_>,
    errors: &'v [f64],
    peaks: Option<&'v Peaks>,
) -> Vec<(Described, &'v [f64])> {
    let peaks = peaks.map(|peaks| [&peaks.values, &peaks.time_s, &peaks.errors]);
    let columns = [errors].into_iter();
    let columns = columns.chain(peaks.into_iter().flatten().map(Vec::as_slice));
    let described = schema::beside(row.0, row, "").into_iter();
    described.zip(columns).collect()
}

/// The scale of arrivals.
pub(super) fn waves(group: &Group) -> Result<Dataset, hdf5::Error> {
    let names = schema::WAVES.map(str::to_owned);
    let dataset = texts(group, &schema::WAVE, &names)?;
    set_scale(&dataset, schema::WAVE.0)?;
    Ok(dataset)
}

/// Adds a second name for a dataset.
fn link(file: &File, from: &[&str], to: &[&str]) -> Result<(), hdf5::Error> {
    let path = |parts: &[&str]| format!("/{}", parts.join("/"));
    file.link_hard(&path(from), &path(to))
}

/// Creates the group that VTK reads, as temporal image data; returns the groups of its point data and of the offsets of
/// its steps.
///
/// x is the distance from the axis, y is minus the depth.
fn vtk_image(file: &File, map: &SectionFields) -> Result<(Group, Group), hdf5::Error> {
    let vtk = file.create_group(schema::VTK)?;
    let (nr, nz) = (map.r_m.len(), map.z_m.len());
    let spacing = |x: &[f64]| (x[x.len() - 1] - x[0]).abs() / (x.len() - 1) as f64;
    array(&vtk, "Version", &[2], &[2, 1])?;
    let kind = FixedAscii::<9>::from_ascii("ImageData")
        .map_err(|_| hdf5::Error::from("the type of the VTK group is not ASCII"))?;
    scalar(&vtk, "Type", kind)?;
    let extent = [0, nr as i64 - 1, 0, nz as i64 - 1, 0, 0];
    array(&vtk, "WholeExtent", &[6], &extent)?;
    let reals = |name: &str, values: &[f64]| array(&vtk, name, &[values.len()], values);
    let (dr, dz) = (spacing(&map.r_m), spacing(&map.z_m));
    reals("Origin", &[map.r_m[0], -map.z_m[0], 0.0])?;
    reals("Spacing", &[dr, dz, dr.max(dz)])?;
    reals("Direction", &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0])?;
    let steps = vtk.create_group("Steps")?;
    scalar(&steps, "NSteps", map.time_s.len() as i64)?;
    let described = ("Values", "s", "time of each frame");
    let values = vector(&steps, &described, &map.time_s)?;
    text(&values, "axis", "time")?;
    // a step of a field begins at the end of the previous step; some readers need 64-bit offsets
    let offsets = steps.create_group(schema::VTK_OFFSETS)?;
    let numbered: Vec<i64> = (0..map.time_s.len() as i64).collect();
    for (name, _, meaning) in labels_of(&map.quantities) {
        vector(&offsets, &(name, "1", meaning), &numbered)?;
    }
    Ok((vtk.create_group(schema::VTK_POINTS)?, offsets))
}
