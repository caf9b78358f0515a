//! The legend, beside the plot.

use super::{AREA, DOT, Look, SIZE, marker, text};
use svg::node::element::{Group, Line, Rectangle};

/// One line of the legend.
pub(super) enum Entry {
    Fill(String, &'static str),
    Curve(String, Look),
}

const HEIGHT: f64 = 19.0;
const SWATCH: f64 = 34.0;

/// Characters that fit beside the plot.
const CHARACTERS: usize = 36;

pub(super) fn draw(entries: &[Entry]) -> Group {
    let left = AREA[2] + 18.0;
    debug_assert!(left + SWATCH < SIZE.0);
    let mut y = AREA[1] + 10.0;
    let mut group = Group::new();
    for entry in entries {
        let (name, lines) = match entry {
            Entry::Fill(name, fill) => {
                group = group.add(
                    Rectangle::new()
                        .set("x", left + 4.0)
                        .set("y", y - 9.0)
                        .set("width", SWATCH - 10.0)
                        .set("height", 13.0)
                        .set("fill", *fill)
                        .set("stroke", "#555555")
                        .set("stroke-width", 0.8),
                );
                (name, wrap(name))
            }
            Entry::Curve(name, look) => {
                let middle = y - 4.0;
                if look.line {
                    group = group.add(
                        Line::new()
                            .set("x1", left)
                            .set("x2", left + SWATCH - 4.0)
                            .set("y1", middle)
                            .set("y2", middle)
                            .set("stroke", look.colour)
                            .set("stroke-width", look.width)
                            .set("stroke-dasharray", look.dash),
                    );
                }
                if let Some(index) = look.marker {
                    let x = left + 0.5 * (SWATCH - 4.0);
                    let size = if index == DOT { 1.6 } else { 4.2 };
                    group =
                        marker::draw(group, index % DOT, x, middle, size, look.colour, "#ffffff");
                }
                (name, wrap(name))
            }
        };
        debug_assert!(!name.is_empty());
        for line in lines {
            group = group.add(text(&line, left + SWATCH + 2.0, y, 12.5, "start"));
            y += 0.84 * HEIGHT;
        }
        y += 0.3 * HEIGHT;
    }
    group
}

/// Breaks a name into lines that fit.
fn wrap(name: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in name.split(' ') {
        let last = lines.len() - 1;
        if !lines[last].is_empty() && lines[last].len() + word.len() >= CHARACTERS {
            lines.push(word.to_owned());
        } else {
            if !lines[last].is_empty() {
                lines[last].push(' ');
            }
            lines[last].push_str(word);
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_names_are_broken_between_words() {
        let name = "wave implicit, step halved to tolerance, and then some more";
        let lines = wrap(name);
        assert!(lines.len() == 2 && lines.iter().all(|l| l.len() <= CHARACTERS));
        assert_eq!(lines.join(" "), name);
    }
}
