//! PDF: one page, shapes as shapes and text as text in an embedded font.

mod font;
mod paint;

use crate::colour::WHITE;
use crate::error::RenderError;
use crate::scene::{Item, Picture, Scene};
use font::Subset;
use miniz_oxide::deflate::compress_to_vec_zlib;
use paint::paint;
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref};

/// Points over pixels: 96 pixels and 72 points are an inch.
const POINT: f32 = 0.75;

/// Compression of streams, of 10.
const LEVEL: u8 = 6;

/// Writes a scene.
pub(crate) fn pdf(scene: &Scene) -> Result<Vec<u8>, RenderError> {
    let mut next = 0;
    let mut new = || {
        next += 1;
        Ref::new(next)
    };
    let (catalog, tree, page, content) = (new(), new(), new(), new());
    let subset = Subset::of(scene)?;
    let font = new();
    let font_parts = [new(), new(), new(), new()];
    let pictures: Vec<(Ref, &Picture)> = scene
        .items
        .iter()
        .filter_map(|item| match item {
            Item::Picture(picture) => Some(picture),
            Item::Shape(_) | Item::Text(_) => None,
        })
        .map(|picture| (new(), picture))
        .collect();
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(tree);
    pdf.pages(tree).kids([page]).count(1);
    let (width, height) = (scene.width as f32, scene.height as f32);
    let mut sheet = pdf.page(page);
    sheet.media_box(Rect::new(0.0, 0.0, POINT * width, POINT * height));
    sheet.parent(tree);
    sheet.contents(content);
    let mut resources = sheet.resources();
    resources.fonts().pair(Name(paint::FONT), font);
    let mut objects = resources.x_objects();
    for (i, (id, _)) in pictures.iter().enumerate() {
        objects.pair(Name(paint::picture_name(i).as_bytes()), *id);
    }
    objects.finish();
    let mut states = resources.ext_g_states();
    for opacity in paint::opacities(scene) {
        let name = paint::state_name(opacity);
        let mut state = states.insert(Name(name.as_bytes())).dict();
        state.pair(Name(b"ca"), opacity as f32);
        state.finish();
    }
    states.finish();
    resources.finish();
    sheet.finish();

    let mut page_content = Content::new();
    // pixels from the upper left corner
    page_content.transform([POINT, 0.0, 0.0, -POINT, 0.0, POINT * height]);
    paint(&mut page_content, scene, &subset);
    let stream = compress_to_vec_zlib(&page_content.finish(), LEVEL);
    pdf.stream(content, &stream).filter(Filter::FlateDecode);
    subset.write(&mut pdf, font, font_parts);
    for (id, picture) in pictures {
        write_picture(&mut pdf, id, picture);
    }
    Ok(pdf.finish())
}

/// The pixels of a picture; white where there is nothing.
fn write_picture(pdf: &mut Pdf, id: Ref, picture: &Picture) {
    let bytes: Vec<u8> = picture
        .pixels
        .iter()
        .map(|pixel| pixel.unwrap_or(WHITE))
        .flat_map(|colour| [colour.red, colour.green, colour.blue])
        .collect();
    let stream = compress_to_vec_zlib(&bytes, LEVEL);
    let mut image = pdf.image_xobject(id, &stream);
    image.filter(Filter::FlateDecode);
    image.width(picture.columns.cast_signed());
    image.height(picture.rows.cast_signed());
    image.color_space().device_rgb();
    image.bits_per_component(8);
    image.finish();
}
