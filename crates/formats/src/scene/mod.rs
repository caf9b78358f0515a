//! Scene files: what hits what, and what is asked, in TOML and SI units.
//!
//! The format is written down in `data-schema/scene.md`.

mod read;
mod striker;
mod write;

pub(crate) use read::bodies_of;
pub(crate) use read::scene_with;
pub use read::{parse_scene, read_scene, scene_of, sections_of};
pub(crate) use striker::Form;
pub use write::resolved;
