//! Parallel compression of chunks; the HDF5 library itself compresses them one after the other, under its lock.
//!
//! The filters are those of the dataset, in its order: shuffle, Deflate, Fletcher's checksum.

use hdf5::Dataset;
use hdf5_sys::h5d::H5Dwrite_chunk;
use hdf5_sys::h5p::H5P_DEFAULT;
use miniz_oxide::deflate::compress_to_vec_zlib;
use ndarray::{Array4, ArrayView4, s};
use rayon::prelude::*;
use std::ops::Range;

/// Largest number of chunks in memory at a time.
const CHUNKS_AT_A_TIME: usize = 64;

/// Writes all values of a dataset whose chunks contain whole patches of rows and columns.
///
/// # Errors
/// The error of the HDF5 library.
pub(super) fn write_chunks(
    dataset: &Dataset,
    values: &ArrayView4<'_, f32>,
    [high, wide]: [usize; 2],
    level: u8,
) -> Result<(), hdf5::Error> {
    let (rows, columns, third, fourth) = values.dim();
    let pack = |[across, down]: &[Range<usize>; 2]| {
        let mut numbers = Array4::zeros((high, wide, third, fourth));
        numbers
            .slice_mut(s![..across.len(), ..down.len(), .., ..])
            .assign(&values.slice(s![across.clone(), down.clone(), .., ..]));
        packed(&numbers, level)
    };
    for some in patches([rows, columns], [high, wide]).chunks(CHUNKS_AT_A_TIME) {
        let packed = some.par_iter().map(pack).collect::<Vec<_>>();
        for ([across, down], bytes) in some.iter().zip(packed) {
            let offset = [across.start as u64, down.start as u64, 0, 0];
            // SAFETY: the dataset is open and has four dimensions, the bytes outlive the call, the lock is held.
            #[allow(unsafe_code)]
            hdf5::sync::sync(|| {
                let (bytes, length, place) = (bytes.as_ptr(), bytes.len(), offset.as_ptr());
                hdf5::h5check(unsafe {
                    H5Dwrite_chunk(dataset.id(), H5P_DEFAULT, 0, place, length, bytes.cast())
                })
            })?;
        }
    }
    Ok(())
}

/// Row and column ranges of all chunks of a size; the last chunks of a row or column may be smaller.
pub(super) fn patches(
    [rows, columns]: [usize; 2],
    [high, wide]: [usize; 2],
) -> Vec<[Range<usize>; 2]> {
    let along = |count: usize, size: usize| {
        let starts = (0..count).step_by(size);
        starts.map(move |start| start..count.min(start + size))
    };
    let across = along(rows, high);
    let down = |across: Range<usize>| along(columns, wide).map(move |down| [across.clone(), down]);
    across.flat_map(down).collect()
}

fn packed(numbers: &Array4<f32>, level: u8) -> Vec<u8> {
    let mut shuffled = Vec::with_capacity(size_of::<f32>() * numbers.len());
    for k in 0..size_of::<f32>() {
        shuffled.extend(numbers.iter().map(|x| x.to_le_bytes()[k]));
    }
    let mut packed = compress_to_vec_zlib(&shuffled, level);
    packed.extend(fletcher32(&packed).to_le_bytes());
    packed
}

/// Fletcher's checksum as in HDF5: over words of two bytes, the first byte the higher; multiples of 65,535 become
/// 65,535.
fn fletcher32(bytes: &[u8]) -> u32 {
    let reduced = |x: u64| if x == 0 { 0 } else { (x - 1) % 65_535 + 1 };
    let (mut sum, mut of_sums) = (0, 0);
    for some in bytes.chunks(1 << 12) {
        for word in some.chunks(2) {
            sum += u64::from(u16::from_be_bytes([word[0], *word.get(1).unwrap_or(&0)]));
            of_sums += sum;
        }
        (sum, of_sums) = (reduced(sum), reduced(of_sums));
    }
    (of_sums << 16 | sum) as u32
}
