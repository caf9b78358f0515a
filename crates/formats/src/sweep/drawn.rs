//! Random draws of a key, each made when it is asked for: no memory holds them.

use super::correlation::Correlations;
use super::random::{Distribution, LARGEST_NORMAL, normal, stream};
use std::sync::Arc;

/// The draws of one key.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawn {
    draws: Arc<Draws>,
    key: usize,
}

/// The draws of all keys, which may hang together.
#[derive(Debug, PartialEq)]
struct Draws {
    samples: usize,
    keys: Vec<(u64, Distribution)>,
    correlations: Correlations,
}

impl Drawn {
    /// Those of all keys, by their names, in their order.
    pub(super) fn of(
        seed: u64,
        samples: usize,
        keys: &[(String, Distribution)],
        correlations: Correlations,
    ) -> Vec<Self> {
        let keys: Vec<_> = (keys.iter())
            .map(|(name, distribution)| (stream(seed, name), *distribution))
            .collect();
        let count = keys.len();
        let draws = Arc::new(Draws {
            samples,
            keys,
            correlations,
        });
        let of = |key| Self {
            draws: Arc::clone(&draws),
            key,
        };
        (0..count).map(of).collect()
    }

    /// How many.
    #[must_use]
    pub fn len(&self) -> usize {
        self.draws.samples
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Draw number `index`: a function of the seed, the keys and this number only.
    #[must_use]
    pub fn at(&self, index: usize) -> f64 {
        let Draws {
            keys, correlations, ..
        } = &*self.draws;
        let (stream, own) = keys[self.key];
        let index = index as u64;
        if correlations.binds(self.key) {
            own.at(correlations.mixed(self.key, |j| normal(keys[j].0, index)))
        } else {
            own.draw(stream, index)
        }
    }

    /// One that is not finite, where some of any number of draws may be so.
    pub(super) fn infinite(&self) -> Option<f64> {
        // those of correlated keys are sums of all with the squares of their weights adding up to one
        let most = LARGEST_NORMAL * (self.draws.keys.len() as f64).sqrt();
        let ends = self.draws.keys[self.key].1.ends(most);
        ends.into_iter().find(|end| !end.is_finite())
    }
}
