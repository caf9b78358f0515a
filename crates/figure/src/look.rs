//! Looks of curves and classes: colours, dashes and markers that differ in more than hue.

use crate::colour::{BLACK, WHITE};
use crate::drawing::{Drawing, DrawnPath, Stroke};
use crate::geometry::Point;

/// Style of a curve.
///
/// Colour, dash and marker follow from the order in which names first appear in the figure: curves with the same name
/// look the same in all panels, and curves with different names differ in more than colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Style {
    /// Line with markers, coloured.
    Marked,
    /// Line; colours and dashes alternate.
    Plain,
    /// Markers only.
    Points,
    /// Heavy black line: a theoretical boundary.
    Heavy,
    /// Heavy black dashed line.
    HeavyDashed,
    /// Black dotted line.
    Dotted,
    /// Small black dots: a theoretical region.
    Dots,
    /// Black dashed line with a white rim, readable over an image: a wave front.
    Rimmed,
    /// Line around a lightly filled area; colours and dashes alternate: the bars of a histogram.
    Bars,
}

impl Style {
    /// Whether the colour of a curve follows from its name.
    pub(crate) fn is_coloured(self) -> bool {
        matches!(self, Self::Marked | Self::Plain | Self::Points | Self::Bars)
    }
}

/// Colours of curves; neighbours differ in lightness as well as in hue.
const COLOURS: [u32; 10] = [
    0x0b_53_94, 0xc1_27_2d, 0xe6_9f_00, 0x1b_7f_5c, 0x7a_3b_9a, 0x56_b4_e9, 0xb5_89_6f, 0x7f_7f_7f,
    0xd5_5e_8e, 0x3b_3b_00,
];

const DASHES: [&[f64]; 5] = [
    &[],
    &[8.0, 3.0],
    &[2.0, 3.0],
    &[10.0, 3.0, 2.0, 3.0],
    &[5.0, 2.0],
];

/// Fills of classes, from light to dark, by their number.
const FILLS: [&[u32]; 5] = [
    &[0xff_ff_ff],
    &[0xf4_f6_f8, 0x82_99_ad],
    &[0xf7_f8_f9, 0xbc_ca_d6, 0x70_8a_a1],
    &[0xf7_f8_f9, 0xc9_d4_dd, 0x8e_a4_b7, 0x4c_63_77],
    &[0xf7_f8_f9, 0xd3_dc_e4, 0xa9_ba_c9, 0x70_89_a0, 0x3d_52_65],
];

/// Fills for `count` classes.
pub(crate) fn fills(classes: usize) -> &'static [u32] {
    FILLS[classes.clamp(1, FILLS.len()) - 1]
}

/// Colours, dash and marker of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Look {
    pub(crate) style: Style,
    pub(crate) stroke: Stroke,
    symbol: usize,
}

impl Look {
    /// The look of a name in a style, from its number in the figure and its number among the names that appear together
    /// with it.
    pub(crate) fn new([number, beside]: [usize; 2], style: Style) -> Self {
        let own = COLOURS[number % COLOURS.len()];
        let dashed = DASHES[beside % DASHES.len()];
        let (colour, width, dash): (u32, f64, &[f64]) = match style {
            Style::Marked | Style::Points => (own, 1.6, &[]),
            Style::Plain | Style::Bars => (own, 1.6, dashed),
            Style::Heavy => (BLACK, 2.6, &[]),
            Style::HeavyDashed => (BLACK, 2.2, &[9.0, 5.0]),
            Style::Dotted | Style::Dots => (BLACK, 2.2, &[2.0, 4.0]),
            Style::Rimmed => (BLACK, 1.4, &[6.0, 4.0]),
        };
        Self {
            style,
            stroke: Stroke::new(colour, width, dash),
            symbol: number,
        }
    }

    /// Whether its points are connected by a line.
    pub(crate) fn has_line(&self) -> bool {
        !matches!(self.style, Style::Points | Style::Dots)
    }

    /// Draws its marker at a point.
    pub(crate) fn mark(&self, drawing: &mut Drawing, at: Point) {
        let colour = self.stroke.colour;
        match self.style {
            Style::Dots => drawing.shape(DrawnPath::circle(at, 1.6).filled(colour, 1.0)),
            Style::Marked | Style::Points => {
                // every other round of symbols is filled
                let is_open = (self.symbol / SYMBOLS).is_multiple_of(2);
                let fill = if is_open { WHITE } else { colour };
                symbol(drawing, self.symbol % SYMBOLS, at, 4.2, [colour, fill]);
            }
            Style::Plain
            | Style::Heavy
            | Style::HeavyDashed
            | Style::Dotted
            | Style::Rimmed
            | Style::Bars => {}
        }
    }
}

/// Number of filled symbols before they repeat; the last is a star.
const SYMBOLS: usize = 7;

/// Draws a star of a given half width.
pub(crate) fn star(drawing: &mut Drawing, at: Point, size: f64) {
    symbol(drawing, SYMBOLS - 1, at, size, [BLACK, WHITE]);
}

/// Draws a symbol of a given half width, with the colours of its outline and of its inside.
fn symbol(drawing: &mut Drawing, index: usize, (x, y): Point, size: f64, [edge, fill]: [u32; 2]) {
    let at = |(dx, dy): Point| (x + dx * size, y + dy * size);
    let polygon = |corners: &[Point]| {
        let corners = corners.iter().copied().map(at);
        DrawnPath::polygon(&corners.collect::<Vec<_>>())
    };
    let shape = match index {
        0 => DrawnPath::circle((x, y), 0.95 * size),
        1 => polygon(&[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)]),
        2 => polygon(&[(0.0, -1.2), (1.1, 0.8), (-1.1, 0.8)]),
        3 => polygon(&[(0.0, -1.3), (1.0, 0.0), (0.0, 1.3), (-1.0, 0.0)]),
        4 => polygon(&[(0.0, 1.2), (1.1, -0.8), (-1.1, -0.8)]),
        5 => DrawnPath::lines(
            [[(-1.0, -1.0), (1.0, 1.0)], [(-1.0, 1.0), (1.0, -1.0)]].map(|ends| ends.map(at)),
        ),
        _ => {
            let corner = |i: usize| {
                let angle = std::f64::consts::PI * (i as f64 / 5.0 - 0.5);
                let radius = if i.is_multiple_of(2) { 1.3 } else { 0.55 };
                (radius * angle.cos(), radius * angle.sin())
            };
            polygon(&(0..10).map(corner).collect::<Vec<_>>())
        }
    };
    drawing.shape(shape.stroked(Stroke::solid(edge, 1.5)).filled(fill, 1.0));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::colour::ColourMap;

    #[test]
    fn curves_differ_in_grey() {
        let nth = |n: usize, style: Style| Look::new([n, n], style);
        for i in 0..COLOURS.len() {
            for k in 0..i {
                let (a, b) = (nth(i, Style::Plain).stroke, nth(k, Style::Plain).stroke);
                let apart = (ColourMap::luminance(a.colour) - ColourMap::luminance(b.colour)).abs();
                assert!(a.dash != b.dash || apart > 0.02, "{i} and {k}: {apart}");
                assert_ne!(nth(i, Style::Marked).symbol, nth(k, Style::Marked).symbol);
            }
        }
        // classes become darker
        for classes in 1..=FILLS.len() {
            let fills = fills(classes).iter().copied();
            let light: Vec<f64> = fills.map(ColourMap::luminance).collect();
            assert!(light.windows(2).all(|pair| pair[1] < 0.8 * pair[0]));
        }
    }
}
