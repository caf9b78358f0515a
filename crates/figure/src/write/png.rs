//! PNG, from SVG, with the library's own font.

use crate::error::RenderError;
use crate::text;
use resvg::{tiny_skia, usvg};
use std::sync::{Arc, OnceLock};

fn fonts() -> Arc<usvg::fontdb::Database> {
    static FONTS: OnceLock<Arc<usvg::fontdb::Database>> = OnceLock::new();
    let load = || {
        let mut fonts = usvg::fontdb::Database::new();
        fonts.load_font_data(text::data().to_vec());
        let family = fonts
            .faces()
            .find_map(|face| Some(face.families.first()?.0.clone()));
        if let Some(family) = family {
            fonts.set_sans_serif_family(family);
        }
        Arc::new(fonts)
    };
    Arc::clone(FONTS.get_or_init(load))
}

/// Renders an SVG at so many pixels for each of its own.
pub(crate) fn png(svg: &str, scale: f32) -> Result<Vec<u8>, RenderError> {
    rendered(svg, scale)?
        .encode_png()
        .map_err(|error| RenderError::Png(error.to_string()))
}

/// The pixels of an SVG.
pub(super) fn rendered(svg: &str, scale: f32) -> Result<tiny_skia::Pixmap, RenderError> {
    let options = usvg::Options {
        fontdb: fonts(),
        ..usvg::Options::default()
    };
    let tree = usvg::Tree::from_str(svg, &options)?;
    let size = tree.size();
    let [width, height] = [size.width(), size.height()].map(|side| (scale * side).ceil() as u32);
    let mut pixels =
        tiny_skia::Pixmap::new(width, height).ok_or(RenderError::Pixels { width, height })?;
    let transform = tiny_skia::Transform::from_scale(scale, scale);
    resvg::render(&tree, transform, &mut pixels.as_mut());
    Ok(pixels)
}
