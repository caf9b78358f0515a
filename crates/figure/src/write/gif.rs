//! An animated GIF.

use super::png::rendered;
use crate::error::RenderError;
use crate::scene::Scene;
use gif::{Encoder, Frame, Repeat};

/// How long it takes to find the colours of a frame: 1 is the best, 30 the fastest.
const SPEED: i32 = 10;

/// The frames as a GIF that repeats, each `frame_s` long, to the hundredth.
pub(crate) fn gif(scenes: &[Scene], scale: f32, frame_s: f64) -> Result<Vec<u8>, RenderError> {
    let fault = |error: gif::EncodingError| RenderError::Gif(error.to_string());
    let mut encoder: Option<Encoder<Vec<u8>>> = None;
    let mut first = None;
    for scene in scenes {
        let pixels = rendered(scene, scale)?;
        let side = |pixels: u32| {
            u16::try_from(pixels)
                .map_err(|_| RenderError::Gif(format!("{pixels} pixels is more than 65535")))
        };
        let (width, height) = (side(pixels.width())?, side(pixels.height())?);
        if *first.get_or_insert((width, height)) != (width, height) {
            return Err(RenderError::Gif(
                "its frames are not of one size".to_owned(),
            ));
        }
        let encoder = match &mut encoder {
            Some(known) => known,
            none => {
                let mut made = Encoder::new(Vec::new(), width, height, &[]).map_err(fault)?;
                made.set_repeat(Repeat::Infinite).map_err(fault)?;
                none.insert(made)
            }
        };
        // the page is white throughout: no pixel is transparent
        let mut rgba = pixels.take();
        let mut frame = Frame::from_rgba_speed(width, height, &mut rgba, SPEED);
        frame.delay = (100.0 * frame_s).round().clamp(2.0, 6000.0) as u16;
        encoder.write_frame(&frame).map_err(fault)?;
    }
    encoder
        .ok_or(RenderError::Figure(crate::error::FigureError::NoPanels))?
        .into_inner()
        .map_err(|error| RenderError::Gif(error.to_string()))
}
