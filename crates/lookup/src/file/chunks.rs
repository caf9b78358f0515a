//! Chunks packed side by side: the HDF5 library compresses one after the other, under its lock.
//!
//! The filters are those of the dataset, in its order: bytes shuffled, Deflate, Fletcher's checksum.

use hdf5::Dataset;
use hdf5_sys::h5d::H5Dwrite_chunk;
use hdf5_sys::h5p::H5P_DEFAULT;
use miniz_oxide::deflate::compress_to_vec_zlib;
use ndarray::{Array4, ArrayView4, s};
use rayon::prelude::*;

/// Chunks in memory at a time.
const TOGETHER: usize = 64;

/// Writes all values of a dataset whose chunks hold all of a patch of rows and columns.
///
/// # Errors
/// What the library says.
pub(super) fn write_chunks(
    dataset: &Dataset,
    values: &ArrayView4<'_, f32>,
    [high, wide]: [usize; 2],
    level: u8,
) -> Result<(), hdf5::Error> {
    let (rows, columns, third, fourth) = values.dim();
    let patch = |row: usize, column: usize| {
        let [last, right] = [rows.min(row + high), columns.min(column + wide)];
        let mut numbers = Array4::zeros((high, wide, third, fourth));
        numbers
            .slice_mut(s![..last - row, ..right - column, .., ..])
            .assign(&values.slice(s![row..last, column..right, .., ..]));
        packed(&numbers, level)
    };
    let across = (0..rows).step_by(high);
    let places: Vec<[usize; 2]> = across
        .flat_map(|row| (0..columns).step_by(wide).map(move |column| [row, column]))
        .collect();
    for places in places.chunks(TOGETHER) {
        let patches = places.par_iter().map(|&[row, column]| patch(row, column));
        for (place, bytes) in places.iter().zip(patches.collect::<Vec<_>>()) {
            let offset = [place[0] as u64, place[1] as u64, 0, 0];
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

fn packed(numbers: &Array4<f32>, level: u8) -> Vec<u8> {
    let mut shuffled = Vec::with_capacity(size_of::<f32>() * numbers.len());
    for k in 0..size_of::<f32>() {
        shuffled.extend(numbers.iter().map(|x| x.to_le_bytes()[k]));
    }
    let mut packed = compress_to_vec_zlib(&shuffled, level);
    packed.extend(fletcher32(&packed).to_le_bytes());
    packed
}

/// Fletcher's checksum as HDF5 has it: of words of two bytes, the first the higher; 65,535 stands for its multiples.
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
