//! How each curve looks: colour, dash and marker by its name.

use crate::colour::{BLACK, Colour, WHITE};
use crate::figure::Figure;
use crate::layer::{Layer, Style};
use crate::panel::Panel;

/// Colours of curves; neighbours differ in lightness as well as in hue.
const COLOURS: [Colour; 10] = [
    Colour::new(0x0b_53_94),
    Colour::new(0xc1_27_2d),
    Colour::new(0xe6_9f_00),
    Colour::new(0x1b_7f_5c),
    Colour::new(0x7a_3b_9a),
    Colour::new(0x56_b4_e9),
    Colour::new(0xb5_89_6f),
    Colour::new(0x7f_7f_7f),
    Colour::new(0xd5_5e_8e),
    Colour::new(0x3b_3b_00),
];

const DASHES: [&[f64]; 5] = [
    &[],
    &[8.0, 3.0],
    &[2.0, 3.0],
    &[10.0, 3.0, 2.0, 3.0],
    &[5.0, 2.0],
];

/// Fills of classes, from light to dark, by their number.
const FILLS: [&[Colour]; 5] = [
    &[WHITE],
    &[Colour::new(0xf4_f6_f8), Colour::new(0x82_99_ad)],
    &[
        Colour::new(0xf7_f8_f9),
        Colour::new(0xbc_ca_d6),
        Colour::new(0x70_8a_a1),
    ],
    &[
        Colour::new(0xf7_f8_f9),
        Colour::new(0xc9_d4_dd),
        Colour::new(0x8e_a4_b7),
        Colour::new(0x4c_63_77),
    ],
    &[
        Colour::new(0xf7_f8_f9),
        Colour::new(0xd3_dc_e4),
        Colour::new(0xa9_ba_c9),
        Colour::new(0x70_89_a0),
        Colour::new(0x3d_52_65),
    ],
];

/// Fills of so many classes.
pub(crate) fn fills(classes: usize) -> &'static [Colour] {
    FILLS[classes.clamp(1, FILLS.len()) - 1]
}

/// What a curve is drawn with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Look {
    pub(crate) colour: Colour,
    pub(crate) dash: &'static [f64],
    pub(crate) width: f64,
    pub(crate) line: bool,
    pub(crate) marker: Marker,
    /// Whether it has a white rim.
    pub(crate) rim: bool,
}

/// What is drawn at the points of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Marker {
    None,
    /// A small dot.
    Dot,
    /// The n-th shape.
    Shape(usize),
}

/// The look of a name in a style.
pub(crate) fn look(slot: Slot, style: Style) -> Look {
    let coloured = Look {
        colour: COLOURS[slot.figure % COLOURS.len()],
        dash: &[],
        width: 1.6,
        line: true,
        marker: Marker::Shape(slot.figure),
        rim: false,
    };
    let black = Look {
        colour: BLACK,
        width: 2.2,
        marker: Marker::None,
        ..coloured
    };
    match style {
        Style::Marked => coloured,
        Style::Plain => Look {
            dash: DASHES[slot.panel % DASHES.len()],
            marker: Marker::None,
            ..coloured
        },
        Style::Points => Look {
            line: false,
            ..coloured
        },
        Style::Heavy => Look {
            width: 2.6,
            ..black
        },
        Style::HeavyDashed => Look {
            dash: &[9.0, 5.0],
            ..black
        },
        Style::Dotted => Look {
            dash: &[2.0, 4.0],
            ..black
        },
        Style::Dots => Look {
            line: false,
            marker: Marker::Dot,
            ..black
        },
        Style::Rimmed => Look {
            width: 1.4,
            rim: true,
            ..black
        },
        Style::RimmedDashed => Look {
            width: 1.4,
            dash: &[6.0, 4.0],
            rim: true,
            ..black
        },
    }
}

/// Numbers of a name that has a colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Slot {
    /// In the figure, by order of first appearance: colour and marker.
    figure: usize,
    /// The least number that no other name has in any panel where it appears: its dash, so that the first curve
    /// of a panel is a whole line.
    panel: usize,
}

/// The numbers of all names of a figure.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Looks(Vec<(String, Slot)>);

impl Looks {
    pub(crate) fn of(figure: &Figure) -> Self {
        let of_panel = |panel: &Panel| coloured(&panel.layers).map(|(_, name)| name).collect();
        let panels: Vec<Vec<String>> = figure.panels.iter().map(of_panel).collect();
        let mut found: Vec<(String, Slot)> = Vec::new();
        for name in panels.iter().flatten() {
            if found.iter().any(|(known, _)| known == name) {
                continue;
            }
            let beside =
                |other: &String| panels.iter().any(|p| p.contains(name) && p.contains(other));
            let taken: Vec<usize> = found
                .iter()
                .filter(|(other, _)| beside(other))
                .map(|(_, slot)| slot.panel)
                .collect();
            let slot = Slot {
                figure: found.len(),
                panel: (0..).find(|n| !taken.contains(n)).unwrap_or(0),
            };
            found.push((name.clone(), slot));
        }
        Self(found)
    }

    /// The numbers of each layer of a panel; the first for those without a colour of their own.
    pub(crate) fn slots(&self, layers: &[Layer]) -> Vec<Slot> {
        let mut found = vec![Slot::default(); layers.len()];
        for (i, name) in coloured(layers) {
            let known = self.0.iter().find(|(n, _)| *n == name);
            found[i] = known.map_or(Slot::default(), |(_, slot)| *slot);
        }
        found
    }
}

/// Layers that have a colour of their own, each with its name; one without a name is named by its number in the panel.
fn coloured(layers: &[Layer]) -> impl Iterator<Item = (usize, String)> + '_ {
    let own = |layer: &Layer| match layer {
        Layer::Line(line) => matches!(line.style, Style::Marked | Style::Plain | Style::Points),
        Layer::Band(_) | Layer::Histogram(_) => true,
        Layer::Image(_) | Layer::Classes(_) | Layer::Mark(_) | Layer::Point(_) => false,
    };
    let layers = layers.iter().enumerate().filter(move |(_, l)| own(l));
    layers
        .enumerate()
        .map(|(n, (i, layer))| match layer.name() {
            "" => (i, format!("\0{n}")),
            name => (i, name.to_owned()),
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axis::Axis;

    #[test]
    fn a_name_looks_the_same_in_every_panel() {
        let panel = || Panel::new(Axis::linear("x"), Axis::linear("y"));
        let figure = Figure::new("")
            .panel(
                panel()
                    .line("a", Style::Plain, vec![])
                    .line("theory", Style::Heavy, vec![])
                    .line("b", Style::Marked, vec![]),
            )
            .panel(
                panel()
                    .band("b", vec![])
                    .line("b", Style::Plain, vec![])
                    .line("c", Style::Plain, vec![]),
            );
        let looks = Looks::of(&figure);
        let numbers = |panel: usize| -> Vec<[usize; 2]> {
            let slots = looks.slots(&figure.panels[panel].layers);
            slots.iter().map(|s| [s.figure, s.panel]).collect()
        };
        assert_eq!(numbers(0), [[0, 0], [0, 0], [1, 1]]);
        // a name keeps its numbers, and no dash comes twice in a panel
        assert_eq!(numbers(1), [[1, 1], [1, 1], [2, 0]]);
    }

    #[test]
    fn curves_differ_in_grey() {
        let nth = |n: usize, style: Style| {
            let slot = Slot {
                figure: n,
                panel: n,
            };
            look(slot, style)
        };
        for i in 0..COLOURS.len() {
            for k in 0..i {
                let (a, b) = (nth(i, Style::Plain), nth(k, Style::Plain));
                let apart = (a.colour.luminance() - b.colour.luminance()).abs();
                assert!(a.dash != b.dash || apart > 0.02, "{i} and {k}: {apart}");
                assert_ne!(nth(i, Style::Marked).marker, nth(k, Style::Marked).marker);
            }
        }
        // classes grow darker
        for fills in FILLS {
            let light: Vec<f64> = fills.iter().map(|c| c.luminance()).collect();
            assert!(light.windows(2).all(|pair| pair[1] < 0.8 * pair[0]));
        }
    }
}
