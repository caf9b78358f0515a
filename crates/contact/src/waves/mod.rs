//! How a loaded surface answers: the waves under a flat punch, the response of a disc, and caches of both.

pub(crate) mod cache;
pub(crate) mod compliance;
pub(crate) mod punch;
pub(crate) mod response;
