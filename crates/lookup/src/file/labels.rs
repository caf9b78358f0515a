//! Attributes and dimension scales for every HDF5 file of the workspace.
//!
//! Dimension scales are the only part of the HDF5 interface that no Rust crate offers.

use hdf5::types::VarLenUnicode;
use hdf5::{Dataset, H5Type, Location};
use hdf5_sys::h5i::hid_t;
use std::borrow::Borrow;
use std::ffi::{CString, c_char, c_int, c_uint};

/// A text for an HDF5 file; a NUL, which HDF5 cannot store, becomes a blank.
///
/// # Errors
/// None that is known.
pub fn unicode(text: &str) -> Result<VarLenUnicode, hdf5::Error> {
    let text = text.replace('\0', " ").parse();
    text.map_err(|_| "a text contains a NUL".into())
}

/// Writes a text attribute of an object.
///
/// # Errors
/// The error of the HDF5 library.
pub fn text(place: &Location, name: &str, value: &str) -> Result<(), hdf5::Error> {
    let attribute = place.new_attr::<VarLenUnicode>().create(name)?;
    attribute.write_scalar(&unicode(value)?)
}

/// Writes an attribute with one value.
///
/// # Errors
/// The error of the HDF5 library.
pub fn scalar<T: H5Type + Copy>(place: &Location, name: &str, value: T) -> Result<(), hdf5::Error> {
    place.new_attr::<T>().create(name)?.write_scalar(&value)
}

/// Writes an attribute with an array of numbers.
///
/// # Errors
/// The error of the HDF5 library.
pub fn array<T: H5Type>(
    place: &Location,
    name: &str,
    shape: &[usize],
    values: &[T],
) -> Result<(), hdf5::Error> {
    let attribute = place.new_attr::<T>().shape(shape).create(name)?;
    attribute.write_raw(values)
}

/// Makes `scale` a dimension scale called `name`.
///
/// # Errors
/// The error of the HDF5 library, or a name that contains a NUL.
pub fn set_scale(scale: &Dataset, name: &str) -> Result<(), hdf5::Error> {
    let name =
        CString::new(name).map_err(|_| hdf5::Error::from("the name of a scale contains a NUL"))?;
    // SAFETY: both arguments outlive the call, the dataset is open, and the lock of the library is held.
    #[allow(unsafe_code)]
    hdf5::sync::sync(|| hdf5::h5check(unsafe { H5DSset_scale(scale.id(), name.as_ptr()) }))?;
    Ok(())
}

/// Attaches scales to the first dimensions of `data`, in their order.
///
/// # Errors
/// The error of the HDF5 library.
pub fn attach_scales(data: &Dataset, scales: &[impl Borrow<Dataset>]) -> Result<(), hdf5::Error> {
    for (index, scale) in (0..).zip(scales) {
        let scale = scale.borrow().id();
        // SAFETY: both datasets are open and the lock of the library is held.
        #[allow(unsafe_code)]
        hdf5::sync::sync(|| hdf5::h5check(unsafe { H5DSattach_scale(data.id(), scale, index) }))?;
    }
    Ok(())
}

// SAFETY: the signatures of hdf5_hl.h, version 1.8 and later.
#[allow(unsafe_code, non_snake_case)]
unsafe extern "C" {
    fn H5DSset_scale(dataset: hid_t, name: *const c_char) -> c_int;
    fn H5DSattach_scale(dataset: hid_t, scale: hid_t, index: c_uint) -> c_int;
}
