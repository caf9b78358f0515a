//! Names in scenes and reports: those of the values of a choice, and the likely meaning of a misspelt one.

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

/// Other words for names, in small letters: symbols of the field, and names in other programs.
const SYNONYMS: [(&str, &str); 18] = [
    ("e", "youngs_modulus_pa"),
    ("young", "youngs_modulus_pa"),
    ("modulus", "youngs_modulus_pa"),
    ("nu", "poisson_ratio"),
    ("poisson", "poisson_ratio"),
    ("rho", "density_kg_m3"),
    ("v", "velocity_m_s"),
    ("v0", "velocity_m_s"),
    ("speed", "velocity_m_s"),
    ("height", "drop_height_m"),
    ("radius", "diameter_m"),
    ("radius_m", "diameter_m"),
    ("n", "count"),
    ("num", "count"),
    ("sphere", "ball"),
    ("cylinder", "rod"),
    ("gauss", "normal"),
    ("gaussian", "normal"),
];

/// The candidate that is meant by `word`: the one that it is another word for, that it is the end or the beginning of, as
/// `velocity` is of `striker.velocity_m_s`, or that differs least from it, if it differs little.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let letters = word.chars().count();
    if letters > MOST_LETTERS {
        return None;
    }
    let (word, all) = (
        word.to_lowercase(),
        candidates.into_iter().collect::<Vec<_>>(),
    );
    let own = |candidate: &&str| {
        candidate
            .rsplit('.')
            .next()
            .unwrap_or_default()
            .to_lowercase()
    };
    let synonym = SYNONYMS.iter().find(|(other, _)| *other == word);
    let meant = |candidate: &&&str| synonym.is_some_and(|(_, name)| own(candidate) == *name);
    let begins = |candidate: &&&str| match own(candidate).strip_prefix(&word) {
        Some(rest) => rest.is_empty() || rest.starts_with('_'),
        None => false,
    };
    let named = all.iter().find(meant).or_else(|| all.iter().find(begins));
    // of a short word more than half stays
    let allowed = (letters / 3).max(2).min(letters.saturating_sub(1));
    let distance = |candidate: &str| strsim::levenshtein(&word, &candidate.to_lowercase());
    let near = all.iter().map(|candidate| (distance(candidate), candidate));
    let near = near.filter(|&(distance, _)| distance <= allowed).min();
    let nearest = named.or(near.map(|(_, candidate)| candidate));
    nearest.map(|candidate| (*candidate).to_owned())
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
        let scene = [
            "density_kg_m3",
            "poisson_ratio",
            "youngs_modulus_pa",
            "diameter_m",
        ];
        for (word, meant) in [
            ("E", Some("youngs_modulus_pa")),
            ("nu", Some("poisson_ratio")),
            ("density", Some("density_kg_m3")),
            ("radius_m", Some("diameter_m")),
            ("di", None),
        ] {
            assert_eq!(nearest(word, scene).as_deref(), meant, "{word}");
        }
        let range = ["from", "to", "count", "spacing"];
        assert_eq!(nearest("n", range).as_deref(), Some("count"));
        assert_eq!(nearest("x", range), None);
        let varied = ["target.material", "striker.diameter_m"];
        let of = |word| nearest(word, varied);
        assert_eq!(of("diameter").as_deref(), Some("striker.diameter_m"));
        assert_eq!(of("diameter_m").as_deref(), Some("striker.diameter_m"));
        // three letters differ, a third of six are two
        assert_eq!(nearest("kitten", ["sitting"]), None);
        assert_eq!(nearest("kittens", ["sitting"]), None);
        assert_eq!(
            nearest("kittenish", ["sittingish"]).as_deref(),
            Some("sittingish")
        );
    }
}
