//! Where an integral over the past is cut: at the instants whose fronts arrive at the sample, at those at which the contact's
//! edge passes over the point, and as often as the force and the tail of the waves need.
//!
//! Theory: `docs/theory.md` (T55).

use super::past::Past;

/// Kinds of fronts, and the edge of the contact; of both pressures that stand for its own.
const KINDS: usize = 11;
const FAMILIES: usize = 2 * KINDS;

impl Past<'_> {
    /// Instants of a span of the past between which the integrand is smooth, ascending.
    pub(super) fn cuts(
        &self,
        place_m: [f64; 2],
        time_s: f64,
        [from_s, until_s]: [f64; 2],
    ) -> Vec<f64> {
        /// Instants between which crossings are looked for, dense toward both ends.
        const TRIALS: usize = 40;
        let fronts_s = self.fronts_s(place_m, self.excitation.units().disc_radius_m);
        let last_s = fronts_s.into_iter().fold(0.0, f64::max);
        let families = KINDS * (1 + usize::from(self.excitation.yielded().is_some()));
        /// Parts of a contact at which it is cut, so that rules follow the rate of its force.
        const PARTS: [f64; 8] = [0.02, 0.1, 0.25, 0.4, 0.6, 0.75, 0.9, 0.98];
        let mut cuts = vec![from_s, until_s];
        let parts_s = PARTS.map(|part| part * self.excitation.end_s());
        let parts_s = parts_s.iter().chain(self.excitation.kinks_s());
        cuts.extend(parts_s.filter(|s| from_s < **s && **s < until_s));
        // within the passing of the waves, and before it
        let passing_s = (time_s - 1.01 * last_s).clamp(from_s, until_s);
        for [low, high] in [[from_s, passing_s], [passing_s, until_s]] {
            if low >= high {
                continue;
            }
            let graded = |i: usize| {
                let x = i as f64 / TRIALS as f64;
                let from_end = if 2 * i < TRIALS { x } else { 1.0 - x };
                let part = 8.0 * from_end.powi(4);
                low + (high - low) * if 2 * i < TRIALS { part } else { 1.0 - part }
            };
            let mut before = (low, self.ahead(place_m, time_s, low));
            for past_s in (1..=TRIALS).map(graded) {
                let after = (past_s, self.ahead(place_m, time_s, past_s));
                for family in 0..families {
                    let signs = [before.1[family], after.1[family]];
                    if (signs[0] < 0.0) != (signs[1] < 0.0) {
                        let span = [(before.0, signs[0]), (after.0, signs[1])];
                        cuts.push(self.crossing(place_m, time_s, span, family));
                    }
                }
                before = after;
            }
        }
        // the tail of the waves falls as a power of the time since the last front
        let mut since_s = last_s;
        while since_s > 0.0 && time_s - since_s > from_s {
            if time_s - since_s < until_s {
                cuts.push(time_s - since_s);
            }
            since_s *= 2.0;
        }
        cuts.sort_by(f64::total_cmp);
        let shortest = 1e-12 * until_s;
        cuts.dedup_by(|later, earlier| *later - *earlier < shortest);
        cuts
    }

    /// Times in s that each kind of front takes from a disc of a radius in m.
    pub(super) fn fronts_s(&self, [r_m, z_m]: [f64; 2], radius_m: f64) -> [f64; KINDS - 1] {
        let medium = self.excitation.medium();
        let kappa = medium.kappa();
        let span = (1.0 / (kappa * kappa) - 1.0).sqrt();
        let [near, far] = [(r_m - radius_m).abs(), r_m + radius_m];
        let (short, long) = (near.hypot(z_m), far.hypot(z_m));
        let slowest = medium.rayleigh_speed();
        // where there is no such front: at the time of another
        let head = |r: f64, body: f64| {
            if r * span > z_m {
                r + z_m * span
            } else {
                body / kappa
            }
        };
        let plane = if r_m > radius_m { short } else { z_m };
        let lengths = [
            short,
            long,
            short / kappa,
            long / kappa,
            near / slowest,
            far / slowest,
            head(near, short),
            head(far, long),
            plane,
            plane / kappa,
        ];
        lengths.map(|length| length / self.excitation.units().longitudinal_speed_m_s)
    }

    /// How far in s each kind of front from the contact of an instant has gone beyond the point, and the edge of the contact
    /// beyond it.
    fn ahead(&self, place_m: [f64; 2], time_s: f64, past_s: f64) -> [f64; FAMILIES] {
        let units = self.excitation.units();
        let radii_m = self.overs(past_s).map(|over| over * units.disc_radius_m);
        let fronts_s = radii_m.map(|radius_m| self.fronts_s(place_m, radius_m));
        let since_s = time_s - past_s;
        std::array::from_fn(|family| {
            let (which, kind) = (family / KINDS, family % KINDS);
            match fronts_s[which].get(kind) {
                Some(front_s) => since_s - front_s,
                None => (radii_m[which] - place_m[0]) / units.longitudinal_speed_m_s,
            }
        })
    }

    /// Where one of the distances of [`Self::ahead`] changes its sign, by false position (Illinois).
    fn crossing(
        &self,
        place_m: [f64; 2],
        time_s: f64,
        [(mut low, mut at_low), (mut high, mut at_high)]: [(f64, f64); 2],
        family: usize,
    ) -> f64 {
        const MOST: usize = 40;
        let enough = 1e-13 * high;
        for _ in 0..MOST {
            if high - low < enough || at_low == at_high {
                break;
            }
            let middle = low + (high - low) * at_low / (at_low - at_high);
            let value = self.ahead(place_m, time_s, middle)[family];
            if value == 0.0 {
                return middle;
            }
            if (value < 0.0) == (at_low < 0.0) {
                (low, at_low, at_high) = (middle, value, 0.5 * at_high);
            } else {
                (high, at_high, at_low) = (middle, value, 0.5 * at_low);
            }
        }
        if at_low.abs() < at_high.abs() {
            low
        } else {
            high
        }
    }
}
