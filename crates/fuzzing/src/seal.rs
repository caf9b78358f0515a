//! The seal of a kernel table made right again, so that damage behind it is reached.

use sha2::{Digest, Sha256};

/// Bytes of the seal's last part, and of its digest.
const FOOTER: usize = 56;
const SUM: usize = 32;

/// Puts the digest that the bytes have into a seal, where there is one whose runs can be read.
pub(crate) fn renew(bytes: &mut [u8]) -> Option<()> {
    let footer = bytes.len().checked_sub(FOOTER)?;
    let word = |bytes: &[u8], at: usize| {
        let eight: [u8; 8] = bytes.get(at..at + 8)?.try_into().ok()?;
        usize::try_from(u64::from_le_bytes(eight)).ok()
    };
    let (end, count) = (word(bytes, footer + 8)?, word(bytes, footer + 16)?);
    let runs = footer.checked_sub(count.checked_mul(16)?)?;
    if end > runs {
        return None;
    }
    let (mut sum, mut place) = (Sha256::new(), 0_usize);
    for run in 0..count {
        let (start, length) = (
            word(bytes, runs + 16 * run)?,
            word(bytes, runs + 16 * run + 8)?,
        );
        sum.update(bytes.get(place..start)?);
        place = start.checked_add(length).filter(|&next| next <= end)?;
    }
    sum.update(&bytes[place..end]);
    sum.update(&bytes[runs..bytes.len() - SUM]);
    let digest = sum.finalize();
    let at = bytes.len() - SUM;
    bytes[at..].copy_from_slice(&digest);
    Some(())
}
