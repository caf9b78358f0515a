//! A curve.

/// How a curve is drawn.
///
/// Colour, dash and marker follow from the order in which names first appear in the figure: curves of the same
/// name look the same in all panels, and curves of different names differ in more than colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Style {
    /// Line with markers, coloured.
    Marked,
    /// Line, coloured and dashed by turns.
    Plain,
    /// Markers alone.
    Points,
    /// Heavy black line: a boundary given by theory.
    Heavy,
    /// Heavy black dashed line.
    HeavyDashed,
    /// Black dotted line.
    Dotted,
    /// Small black dots: a region given by theory.
    Dots,
    /// Black line with a white rim, readable over an image: a wave front.
    Rimmed,
    /// The same, dashed.
    RimmedDashed,
}

/// One curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// Its name in the legend; empty for none.
    pub name: String,
    /// Its points; the line breaks at those that the axes cannot show, such as NaN.
    pub points: Vec<(f64, f64)>,
    /// How it is drawn.
    pub style: Style,
}

impl Line {
    /// A curve.
    pub fn new(name: &str, style: Style, points: Vec<(f64, f64)>) -> Self {
        Self {
            name: name.to_owned(),
            points,
            style,
        }
    }
}
