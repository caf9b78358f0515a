//! Breaks a text into lines of a given width.

use super::rich::Rich;

/// Lines no wider than `width` pixels at a size, broken between words; a word that is too wide alone is broken
/// between letters, unless parts of it are raised or lowered.
pub(crate) fn wrap(text: &str, size: f64, width: f64) -> Vec<String> {
    let fits = |line: &str| Rich::new(line).width(size) <= width;
    let mut lines = Vec::new();
    let mut line = String::new();
    for word in text.split_whitespace() {
        let longer = if line.is_empty() {
            word.to_owned()
        } else {
            format!("{line} {word}")
        };
        if fits(&longer) {
            line = longer;
            continue;
        }
        if !line.is_empty() {
            lines.push(std::mem::take(&mut line));
        }
        if fits(word) || word.contains('{') {
            word.clone_into(&mut line);
            continue;
        }
        for letter in word.chars() {
            line.push(letter);
            if !fits(&line) && line.chars().count() > 1 {
                line.pop();
                lines.push(std::mem::replace(&mut line, letter.to_string()));
            }
        }
    }
    if !line.is_empty() {
        lines.push(line);
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_names_are_broken_between_words() {
        let name = "wave implicit, step halved to tolerance, and then some more";
        let lines = wrap(name, 12.0, 150.0);
        assert!(lines.len() > 2);
        assert!(lines.iter().all(|l| Rich::new(l).width(12.0) <= 150.0));
        assert_eq!(lines.join(" "), name);
        assert!(wrap("  ", 12.0, 50.0).is_empty());
    }

    #[test]
    fn a_word_that_is_too_long_is_broken_too() {
        let lines = wrap("incompressibility of it", 12.0, 40.0);
        assert!(lines.iter().all(|l| Rich::new(l).width(12.0) <= 40.0));
        assert!(lines.len() >= 3);
        assert_eq!(lines.concat().replace(' ', ""), "incompressibilityofit");
        assert_eq!(wrap("x^{22}", 12.0, 1.0), ["x^{22}"]);
    }
}
