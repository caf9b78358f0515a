//! Names in scenes and reports: those of the values of a choice, and what a misspelt one most likely means.

/// A choice with a fixed list of values, each with the name that it has in files and reports.
pub trait Choice: Copy + PartialEq + 'static {
    /// All values, in the order in which documents list them.
    const ALL: &'static [Self];

    /// The name of this value.
    fn name(self) -> &'static str;

    /// The value of a name.
    fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|value| value.name() == name)
    }
}

/// Makes an enum, or one that there is, a [`Choice`] from one list of all its values with their names, in the order of
/// documents.
#[macro_export]
macro_rules! choice {
    ($(#[$of:meta])* $reach:vis enum $choice:ident { $($(#[$each:meta])* $value:ident = $name:literal,)+ }) => {
        $(#[$of])*
        $reach enum $choice {
            $($(#[$each])* $value,)+
        }
        $crate::choice!($choice: $($value = $name),+);
    };
    ($choice:ty: $($value:ident = $name:literal),+) => {
        impl $crate::Choice for $choice {
            const ALL: &'static [Self] = &[$(Self::$value),+];

            fn name(self) -> &'static str {
                match self {
                    $(Self::$value => $name),+
                }
            }
        }
    };
}
pub(crate) use choice;

/// Letters of a word that may be a misspelt name, at most.
const MOST_LETTERS: usize = 64;

/// The candidate that differs least from `word`, if it differs little.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<String> {
    if word.chars().nth(MOST_LETTERS).is_some() {
        return None;
    }
    let (word, allowed) = (word.to_lowercase(), (word.chars().count() / 3).max(2));
    let distance = |candidate: &str| strsim::levenshtein(&word, &candidate.to_lowercase());
    let all = candidates.into_iter();
    let near = all.map(|candidate| (distance(candidate), candidate));
    let nearest = near.filter(|&(distance, _)| distance <= allowed).min();
    nearest.map(|(_, candidate)| candidate.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_words_are_suggested() {
        let keys = ["mass_kg", "tip_radius_m", "velocity_m_s"];
        assert_eq!(nearest("mas_kg", keys).as_deref(), Some("mass_kg"));
        assert_eq!(
            nearest("velocity_ms", keys).as_deref(),
            Some("velocity_m_s")
        );
        assert_eq!(nearest("colour", keys), None);
        // three letters differ, a third of six are two
        assert_eq!(nearest("kitten", ["sitting"]), None);
        assert_eq!(nearest("kittens", ["sitting"]), None);
        assert_eq!(
            nearest("kittenish", ["sittingish"]).as_deref(),
            Some("sittingish")
        );
    }
}
