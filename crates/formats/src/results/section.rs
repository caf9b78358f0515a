//! The section in a results file: `/VTKHDF` for ParaView and pyvista, `/map` for everything else.
//!
//! Both are the same data: the fields in `/map` are hard links to those in `/VTKHDF`.

use super::schema;
use crate::hdf::{attach_scale, describe, numbers, set_scale, text, vector};
use hdf5::types::FixedAscii;
use hdf5::{Dataset, File, Group};
use impact::SectionFields;

pub(super) fn write_section(file: &File, map: &SectionFields) -> Result<(), hdf5::Error> {
    let group = file.create_group(schema::MAP)?;
    let (nr, nz) = (map.r_m.len(), map.z_m.len());
    let scales = [&map.time_s, &map.z_m, &map.r_m];
    let [time, z, r] = &schema::MAP_SCALES;
    let mut made = Vec::new();
    for (described, samples) in [time, z, r].into_iter().zip(scales) {
        let scale = vector(&group, described, samples)?;
        set_scale(&scale, described.0)?;
        made.push(scale);
    }
    let arrivals: Vec<f64> = map.arrival_s.iter().flatten().copied().collect();
    let dataset = numbers(&group, &schema::ARRIVALS, &[3, nz, nr], &arrivals)?;
    attach_all(&dataset, &made[1..], 1)?;
    let points = vtk_image(file, map)?;
    for (i, described) in schema::FIELDS.iter().enumerate() {
        let (name, unit, meaning) = *described;
        let dataset = points
            .new_dataset::<f32>()
            .shape([map.time_s.len(), nz, nr])
            .chunk([1, nz, nr])
            .obj_track_times(false)
            .create(name)?;
        dataset.write_raw(&map.values[i])?;
        describe(&dataset, described)?;
        attach_scale(&dataset, &made[0], 0)?;
        attach_all(&dataset, &made[1..], 1)?;
        let path = format!("/{}/{}/{name}", schema::VTK, schema::VTK_POINTS);
        file.link_hard(&path, &format!("/{}/{name}", schema::MAP))?;
        let error = format!("{name}{}", schema::ERROR_SUFFIX);
        let meaning = format!("estimated absolute error: {meaning}");
        let described = (error.as_str(), unit, meaning.as_str());
        let errors = numbers(&group, &described, &[nz, nr], &map.errors[i])?;
        attach_all(&errors, &made[1..], 0)?;
    }
    Ok(())
}

/// Attaches scales to the dimensions from `first` on.
fn attach_all(data: &Dataset, scales: &[Dataset], first: usize) -> Result<(), hdf5::Error> {
    for (index, scale) in (first..).zip(scales) {
        attach_scale(data, scale, index)?;
    }
    Ok(())
}

/// The group that VTK reads, as temporal image data; returns the group of its point data.
///
/// x is the distance from the axis, y is minus the depth.
fn vtk_image(file: &File, map: &SectionFields) -> Result<Group, hdf5::Error> {
    let vtk = file.create_group(schema::VTK)?;
    let (nr, nz) = (map.r_m.len(), map.z_m.len());
    let spacing = |x: &[f64]| (x[x.len() - 1] - x[0]).abs() / (x.len() - 1) as f64;
    let integers = |name: &str, values: &[i64]| attribute(&vtk, name, values);
    integers("Version", &[2, 1])?;
    let kind = FixedAscii::<9>::from_ascii("ImageData")
        .map_err(|_| hdf5::Error::from("the type is not ASCII"))?;
    vtk.new_attr::<FixedAscii<9>>()
        .create("Type")?
        .write_scalar(&kind)?;
    integers("WholeExtent", &[0, nr as i64 - 1, 0, nz as i64 - 1, 0, 0])?;
    let reals = |name: &str, values: &[f64]| attribute(&vtk, name, values);
    let (dr, dz) = (spacing(&map.r_m), spacing(&map.z_m));
    reals("Origin", &[map.r_m[0], -map.z_m[0], 0.0])?;
    reals("Spacing", &[dr, dz, dr.max(dz)])?;
    reals("Direction", &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0])?;
    let steps = vtk.create_group("Steps")?;
    steps
        .new_attr::<i64>()
        .create("NSteps")?
        .write_scalar(&(map.time_s.len() as i64))?;
    let values = numbers(
        &steps,
        &("Values", "s", "time of each frame"),
        &[map.time_s.len()],
        &map.time_s,
    )?;
    text(&values, "axis", "time")?;
    vtk.create_group(schema::VTK_POINTS)
}

fn attribute<T: hdf5::H5Type>(group: &Group, name: &str, values: &[T]) -> Result<(), hdf5::Error> {
    let attribute = group.new_attr::<T>().shape([values.len()]).create(name)?;
    attribute.write_raw(values)
}
