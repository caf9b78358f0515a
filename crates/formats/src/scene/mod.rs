//! Scene files in TOML and SI units: bodies, contact settings and requested output; `data-schema/scene.md` describes
//! them.
//!
//! `keys` lists all keys of a scene and writes resolved scenes, `section` reads typed values, `read` and `body` build a
//! scene, `record` reads force records, and `response` responses of sensors.

pub(crate) mod body;
pub(crate) mod keys;
mod read;
pub(crate) mod record;
mod response;
pub(crate) mod section;

pub use body::{parse_materials, read_materials};
pub(crate) use keys::Form;
pub use keys::{resolved, resolved_table, sections_of};
pub(crate) use read::{bodies_of, read_library, read_target, scene_with};
pub use read::{parse_scene, read_scene, read_with_inputs, scene_of};
pub use record::read_record;
pub use response::read_response;
pub use section::{MOST_OF_TOML, parse as parse_table, parse_text, read_text};
