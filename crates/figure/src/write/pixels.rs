//! The pixels of a picture.

use crate::error::RenderError;
use crate::scene::Picture;
use tiny_skia::{ColorU8, Pixmap};

/// A picture's pixels, transparent where nothing is to be seen.
pub(super) fn pixels(picture: &Picture) -> Result<Pixmap, RenderError> {
    let (width, height) = (picture.columns, picture.rows);
    let mut map = Pixmap::new(width, height).ok_or(RenderError::Pixels { width, height })?;
    for (to, from) in map.pixels_mut().iter_mut().zip(&picture.pixels) {
        let colour = match from {
            Some(c) => ColorU8::from_rgba(c.red, c.green, c.blue, 255),
            None => ColorU8::from_rgba(0, 0, 0, 0),
        };
        *to = colour.premultiply();
    }
    Ok(map)
}

/// Pixels as PNG.
pub(super) fn encode(map: &Pixmap) -> Result<Vec<u8>, RenderError> {
    map.encode_png()
        .map_err(|error| RenderError::Png(error.to_string()))
}
