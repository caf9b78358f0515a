//! A picture as data: axes, layers, legend. Drawn by [`crate::draw`], and easily checked by a test.

/// One axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// What it shows, with its unit.
    pub label: String,
    /// Whether it is logarithmic.
    pub logarithmic: bool,
    /// Values outside are left out.
    pub range: (f64, f64),
}

impl Axis {
    /// A logarithmic axis.
    #[must_use]
    pub fn logarithmic(label: &str, low: f64, high: f64) -> Self {
        Self {
            label: label.to_owned(),
            logarithmic: true,
            range: (low, high),
        }
    }

    /// A linear axis.
    #[must_use]
    pub fn linear(label: &str, low: f64, high: f64) -> Self {
        Self {
            label: label.to_owned(),
            logarithmic: false,
            range: (low, high),
        }
    }

    /// Share of the axis at a value: 0 at its low end, 1 at its high one.
    #[must_use]
    pub fn share(&self, value: f64) -> f64 {
        let (low, high) = self.range;
        if self.logarithmic {
            (value / low).ln() / (high / low).ln()
        } else {
            (value - low) / (high - low)
        }
    }

    /// The value at a share.
    #[must_use]
    pub fn value(&self, share: f64) -> f64 {
        let (low, high) = self.range;
        if self.logarithmic {
            low * (high / low).powf(share)
        } else {
            low + share * (high - low)
        }
    }

    /// Centres of `count` equal cells.
    pub(crate) fn cells(&self, count: usize) -> Vec<f64> {
        (0..count)
            .map(|i| self.value((i as f64 + 0.5) / count as f64))
            .collect()
    }
}

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Style {
    /// Line with markers, coloured.
    Marked,
    /// Line, coloured and dashed by turns.
    Plain,
    /// Markers alone.
    Points,
    /// Heavy black line: a boundary given by theory, or a Pareto front.
    Heavy,
    /// Heavy black dashed line.
    HeavyDashed,
    /// Black dotted line.
    Dotted,
    /// Small black dots: a region given by theory.
    Dots,
}

/// One curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Its name in the legend.
    pub name: String,
    /// Its points.
    pub points: Vec<(f64, f64)>,
    /// How it is drawn.
    pub style: Style,
}

/// A map of classes on a regular grid of cells.
#[derive(Debug, Clone, PartialEq)]
pub struct Cells {
    /// Cells along x and y.
    pub shape: [usize; 2],
    /// Class of each cell, x runs fastest.
    pub class: Vec<usize>,
    /// Names of the classes, from light to dark.
    pub names: Vec<String>,
}

/// A picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Name of its files.
    pub name: &'static str,
    /// Title.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Map below the curves.
    pub cells: Option<Cells>,
    /// Curves.
    pub curves: Vec<Curve>,
    /// Vertical lines with their labels.
    pub marks: Vec<(f64, String)>,
    /// Single points with their labels.
    pub labelled: Vec<(f64, f64, String)>,
    /// Sentences for the report.
    pub caption: String,
}

impl Figure {
    /// An empty picture.
    pub(crate) fn new(name: &'static str, title: &str, x: Axis, y: Axis) -> Self {
        Self {
            name,
            title: title.to_owned(),
            x,
            y,
            cells: None,
            curves: Vec::new(),
            marks: Vec::new(),
            labelled: Vec::new(),
            caption: String::new(),
        }
    }

    /// Adds a curve.
    pub(crate) fn curve(&mut self, name: &str, style: Style, points: Vec<(f64, f64)>) {
        self.curves.push(Curve {
            name: name.to_owned(),
            points,
            style,
        });
    }

    /// Adds a map: the class of each cell from its centre.
    pub(crate) fn map(
        &mut self,
        shape: [usize; 2],
        names: &[&str],
        mut class: impl FnMut(f64, f64) -> usize,
    ) {
        let (xs, ys) = (self.x.cells(shape[0]), self.y.cells(shape[1]));
        let mut classes = Vec::with_capacity(shape[0] * shape[1]);
        for &y in &ys {
            for &x in &xs {
                classes.push(class(x, y));
            }
        }
        self.cells = Some(Cells {
            shape,
            class: classes,
            names: names.iter().map(|&n| n.to_owned()).collect(),
        });
    }
}
