//! Surface responses by Poisson's ratio: exact ones, and tabulated ones that all threads share.

use crate::waves::punch::PunchWaves;
use crate::waves::response::{DiscResponse, ResponseTable};
use halfspace::{Deflection, DomainError, Medium, SurfaceResponse};
use std::collections::HashMap;
use std::sync::{Arc, PoisonError, RwLock};

/// Where a solver has its responses from.
pub trait Responses {
    /// Response of a fixed disc.
    type Disc: DiscResponse;

    /// The response of a fixed disc.
    ///
    /// # Errors
    /// [`DomainError`] for a Poisson's ratio outside (-1, 0.5).
    fn disc(&self, ratio: f64, deflection: Deflection) -> Result<Arc<Self::Disc>, DomainError>;

    /// The waves under a flat punch.
    ///
    /// # Errors
    /// [`DomainError`] for a Poisson's ratio outside (-1, 0.5).
    fn waves(&self, ratio: f64) -> Result<Arc<PunchWaves>, DomainError>;
}

/// Exact responses, computed at each call, for single impacts.
#[derive(Debug, Clone, Copy, Default)]
pub struct Exact;

impl Responses for Exact {
    type Disc = SurfaceResponse;

    fn disc(&self, ratio: f64, deflection: Deflection) -> Result<Arc<Self::Disc>, DomainError> {
        Ok(Arc::new(SurfaceResponse::new(
            &Medium::new(ratio)?,
            deflection,
        )))
    }

    fn waves(&self, ratio: f64) -> Result<Arc<PunchWaves>, DomainError> {
        Ok(Arc::new(PunchWaves::new(&Medium::new(ratio)?)))
    }
}

/// Tabulated responses, computed once and shared by all threads, for sweeps.
///
/// By default each Poisson's ratio has its own.
#[derive(Debug, Default)]
pub struct Tabulated {
    lattice: bool,
    /// By the bits of Poisson's ratio; the tables of both deflections.
    tables: [RwLock<HashMap<u64, Arc<ResponseTable>>>; 2],
    waves: RwLock<HashMap<u64, Arc<PunchWaves>>>,
}

/// Steps of the lattice in sqrt(1/2 - nu), in which every response is smooth.
const LATTICE: f64 = 4096.0;

/// Lattice points next to nu = 1/2 that are not used: the memory grows like 1/sqrt(1/2 - nu) there.
const FIRST_OF_LATTICE: f64 = 512.0;

impl Tabulated {
    /// For any number of Poisson's ratios, as random draws have: responses of a lattice, linear between two of them.
    ///
    /// The lattice has steps of 1/4096 in sqrt(1/2 - nu). Values between its points have relative errors below 1e-6,
    /// and 1e-5 for punches in their first instants.
    pub fn on_lattice() -> Self {
        Self {
            lattice: true,
            ..Self::default()
        }
    }

    /// The lattice's Poisson's ratios on both sides and the place between them.
    fn neighbours(&self, ratio: f64) -> Option<(f64, f64, f64)> {
        let place = (0.5 - ratio).max(0.0).sqrt() * LATTICE;
        let below = place.floor();
        let at = |i: f64| 0.5 - (i / LATTICE).powi(2);
        let inside = below >= FIRST_OF_LATTICE && at(below + 1.0) > -1.0;
        (self.lattice && inside).then(|| (at(below), at(below + 1.0), place - below))
    }

    /// The response of a ratio: computed once for it, or interpolated between two ratios of the lattice.
    fn at<V>(
        &self,
        cache: &RwLock<HashMap<u64, Arc<V>>>,
        ratio: f64,
        make: impl Fn(&Medium) -> V,
        between: impl FnOnce(Arc<V>, Arc<V>, f64) -> V,
    ) -> Result<Arc<V>, DomainError> {
        let exact = |nu: f64| {
            let read = cache.read().unwrap_or_else(PoisonError::into_inner);
            if let Some(found) = read.get(&nu.to_bits()) {
                return Ok(Arc::clone(found));
            }
            drop(read);
            let made = Arc::new(make(&Medium::new(nu)?));
            let mut cache = cache.write().unwrap_or_else(PoisonError::into_inner);
            Ok(Arc::clone(cache.entry(nu.to_bits()).or_insert(made)))
        };
        let Some((near, far, fraction)) = self.neighbours(ratio) else {
            return exact(ratio);
        };
        Ok(Arc::new(between(exact(near)?, exact(far)?, fraction)))
    }
}

impl Responses for Tabulated {
    type Disc = ResponseTable;

    fn disc(&self, ratio: f64, deflection: Deflection) -> Result<Arc<ResponseTable>, DomainError> {
        let tables = &self.tables[deflection as usize];
        let table = |medium: &Medium| ResponseTable::new(&SurfaceResponse::new(medium, deflection));
        self.at(tables, ratio, table, |near, far, fraction| {
            ResponseTable::between(&near, &far, fraction)
        })
    }

    fn waves(&self, ratio: f64) -> Result<Arc<PunchWaves>, DomainError> {
        self.at(&self.waves, ratio, PunchWaves::new, PunchWaves::between)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_lattice_points_responses_are_good_to_1e_6() {
        let (few, many) = (Tabulated::default(), Tabulated::on_lattice());
        for nu in [-0.9, -0.4, 0.05, 0.263_082_06, 0.31, 0.47, 0.498] {
            for deflection in [Deflection::Centre, Deflection::Mean] {
                let exact = few.disc(nu, deflection).unwrap();
                let found = many.disc(nu, deflection).unwrap();
                let memory = exact.disc.memory;
                assert!((found.disc.memory / memory - 1.0).abs() < 1e-6, "nu = {nu}");
                assert!(
                    (found.disc.relaxation_time / exact.disc.relaxation_time - 1.0).abs() < 1e-6
                );
                for i in 1..400 {
                    let t = memory * f64::from(i) / 300.0;
                    let (a, b) = (exact.integrals(t), found.integrals(t));
                    let error = (a[0] - b[0]).abs() / memory;
                    assert!(error < 1e-6, "nu = {nu}, t = {t}: {error:e}");
                }
            }
            let (exact, found) = (few.waves(nu).unwrap(), many.waves(nu).unwrap());
            for i in 1..400 {
                let t = exact.memory * f64::from(i) / 300.0;
                let [a, b] = [&exact, &found].map(|waves| waves.relaxation(t)[1]);
                assert!((a / b - 1.0).abs() < 1e-5, "nu = {nu}, t = {t}");
            }
            for power in 1..=3 {
                let (a, b) = (exact.moment(power), found.moment(power));
                assert!((a / b - 1.0).abs() < 1e-6, "nu = {nu}: moment {power}");
            }
            for level in [0, 3, 6] {
                let (a, b) = (exact.rule(level), found.rule(level));
                for power in 0..8 {
                    let sum = |rule: &[(f64, f64)]| -> f64 {
                        let parts = rule.iter();
                        parts.map(|(x, rate)| rate * x * x.powi(power)).sum()
                    };
                    assert!(
                        (sum(a) / sum(b) - 1.0).abs() < 1e-6,
                        "nu = {nu}: {level}, {power}"
                    );
                }
            }
        }
    }
}
