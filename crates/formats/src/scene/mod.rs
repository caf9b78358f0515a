//! Scene files: what hits what, and what is asked, in TOML and SI units, as `data-schema/scene.md` writes it down.
//!
//! `keys` lists what a scene can have and spells one out, `section` reads typed values, `read` makes a scene of them with
//! `body`; `record` is the file beside it.

pub(crate) mod body;
pub(crate) mod keys;
mod read;
mod record;
pub(crate) mod section;

pub use body::{parse_materials, read_materials};
pub(crate) use keys::Form;
pub use keys::{resolved, resolved_table, sections_of};
pub(crate) use read::{bodies_of, scene_with};
pub use read::{parse_scene, read_scene, read_with_inputs, scene_of};
pub use record::read_record;
pub use section::{MOST_OF_TOML, parse as parse_table, parse_text, read_text};
