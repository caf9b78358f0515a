//! The area between two curves.

/// The area between two curves over the same places: what a curve may be wrong by.
///
/// It takes the colour of the curve with the same name, and shares its line in the legend.
#[derive(Debug, Clone, PartialEq)]
pub struct Band {
    /// Its name in the legend; empty for none.
    pub name: String,
    /// Place, lower and upper value.
    pub points: Vec<(f64, f64, f64)>,
}

impl Band {
    /// A band.
    pub fn new(name: &str, points: Vec<(f64, f64, f64)>) -> Self {
        Self {
            name: name.to_owned(),
            points,
        }
    }
}
