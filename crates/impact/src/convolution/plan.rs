//! How the fields of a point are computed: decided from geometry, excitation and tolerance, before any kernel is.

use super::discs::Discs;
use super::fronts::Fronts;
use super::tuning;
use crate::excitation::{Excitation, PressureRadius};
use crate::quantity::Derivative;

/// Sets of discs from which points choose.
pub(crate) struct Sets {
    all: Vec<Discs>,
    /// Number of the first of those for kernels that are computed.
    computed: usize,
    /// Largest r and z in radii of a disc at which a table has kernels; none where they are computed.
    reach: Option<[f64; 2]>,
    follows: bool,
    /// Whether waves are damped, whose past is not integrated.
    damped: bool,
    /// Inverse distance up to which two discs serve between fronts, of fields and of what is asked for.
    two_serve: [f64; 2],
    /// Whether one does outside the contact, and for echoes.
    one_serves: [bool; 2],
}

/// The road of one point.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PointPlan {
    /// Number of the set of discs.
    pub(crate) set: usize,
    /// Of each forcing, the samples at which the past is integrated, ascending, among those needed.
    pub(crate) integrated: Vec<Vec<Integrated>>,
}

/// A sample at which the past of the force is integrated over the radii of the contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Integrated {
    /// Number among the samples needed.
    pub(crate) sample: usize,
    /// All of the contact, rather than the parts of the past whose fronts pass.
    pub(crate) whole: bool,
}

impl Sets {
    /// For kernels that are computed, or that a table has up to a reach in r and z; `samples` limits the discs that are held, and
    /// `rates` of the fields have shorter waves than these. Damped waves are summed over discs alone.
    pub(crate) fn new(
        excitation: &Excitation,
        tolerance: f64,
        reach: Option<[f64; 2]>,
        (samples, rates): (usize, bool),
    ) -> Self {
        let follows = matches!(excitation.radius(), PressureRadius::Following { .. });
        let digits = -tolerance.log10();
        let most = (tuning::MOST_HELD / samples.max(1)).max(1);
        let more = if rates { tuning::MORE_FOR_RATES } else { 0 };
        let count = |a_digit: f64| ((a_digit * digits).round().max(2.0) as usize + more).min(most);
        let chi = Fronts::new(excitation, [0.0; 2]).chi;
        let of_fields = tuning::TWO_SERVE * tolerance / (chi * chi);
        let two_serve = [of_fields, if rates { 0.0 } else { of_fields }];
        // rates have shorter waves, those that come by echoes fewer of them
        let shorter = if rates { [10.0, 3.0] } else { [1.0; 2] };
        let one_serves = shorter.map(|own| own * chi * chi < tuning::ONE_SERVES * tolerance);
        let mut all = match (follows, reach) {
            (false, _) => vec![Discs::one(1.0)],
            (true, Some(_)) => {
                let count = count(tuning::LOOKED_UP_A_DIGIT);
                let some = tuning::COVERED.map(|smallest| Discs::between(smallest, count));
                some.into_iter().chain([Discs::one(1.0)]).collect()
            }
            (true, None) => Vec::new(),
        };
        let computed = if follows { all.len() } else { 0 };
        if follows {
            let [outside, inside] = tuning::DISCS_A_DIGIT.map(count);
            all.extend([
                Discs::between(tuning::SMALLEST, outside),
                Discs::between(tuning::SMALLEST, 2),
                Discs::between(tuning::SMALLEST, inside),
                Discs::between(tuning::SMALLEST_FAR, outside),
                Discs::one(tuning::SMALLEST_FAR),
            ]);
        }
        Self {
            all,
            computed,
            reach,
            follows,
            damped: excitation.attenuation.is_some(),
            two_serve,
            one_serves,
        }
    }

    /// With other discs for all kernels that are computed.
    #[cfg(test)]
    pub(crate) fn replace(&mut self, discs: &Discs) {
        self.all[self.computed..].fill(discs.clone());
    }

    /// Whether there are windows of time in which the past is integrated.
    pub(crate) fn has_windows(&self) -> bool {
        self.follows && self.reach.is_none() && !self.damped
    }

    /// The discs of a set.
    pub(crate) fn get(&self, set: usize) -> &Discs {
        &self.all[set]
    }

    /// How many sets there are.
    pub(crate) fn count(&self) -> usize {
        self.all.len()
    }

    /// The set for a point at a place in largest radii; where a table has none, the disc alone, whose error names the place.
    pub(crate) fn choose(&self, [r, z]: [f64; 2]) -> usize {
        let Some(reach) = self.reach.filter(|_| self.follows) else {
            return self.choose_computed([r, z]);
        };
        let has =
            |discs: &Discs| r <= discs.smallest() * reach[0] && z <= discs.smallest() * reach[1];
        let looked_up = &self.all[..self.computed];
        let found = looked_up.iter().position(has);
        found.unwrap_or(looked_up.len() - 1)
    }

    /// The same for a place in m.
    pub(crate) fn choose_for(&self, excitation: &Excitation, place_m: [f64; 2]) -> usize {
        let radius_m = excitation.units().disc_radius_m;
        self.choose(place_m.map(|x| x / radius_m))
    }

    /// The set for a point whose kernels are computed.
    pub(crate) fn choose_computed(&self, [r, z]: [f64; 2]) -> usize {
        let distance = r.hypot(z);
        let chosen = match () {
            () if !self.follows => 0,
            () if distance < tuning::INSIDE => 2,
            () if self.one_serves[0] => 4,
            () if distance > tuning::FAR => 3,
            () if self.two_serve[1] > distance.recip() && !self.damped => 1,
            () => 0,
        };
        self.computed + chosen
    }

    /// The set for the echoes of a plate, whose waves have come from a place: without windows discs are needed that are nearly
    /// points, but few of them, also for rates.
    pub(crate) fn choose_for_echoes(&self, [r, z]: [f64; 2]) -> usize {
        let chosen = match () {
            () if !self.follows => 0,
            () if self.one_serves[1] => 4,
            () if self.two_serve[0] > r.hypot(z).recip() => 1,
            () => 0,
        };
        self.computed + chosen
    }
}

impl PointPlan {
    /// For a point in m; asked for are the fields or their rates at some times in s.
    pub(crate) fn new(
        sets: &Sets,
        (excitation, tolerance): (&Excitation, f64),
        asked: &[(Derivative, &[f64])],
        place_m: [f64; 2],
    ) -> Self {
        let set = sets.choose_for(excitation, place_m);
        if !sets.has_windows() {
            return Self {
                set,
                integrated: vec![Vec::new(); asked.len()],
            };
        }
        let fronts = Fronts::new(excitation, place_m);
        let count = sets.get(set).count();
        let of = |one: &(Derivative, &[f64])| windows(&fronts, *one, tolerance, count);
        Self {
            set,
            integrated: asked.iter().map(of).collect(),
        }
    }
}

/// The samples that so many discs do not serve.
fn windows(
    fronts: &Fronts<'_>,
    (derivative, times_s): (Derivative, &[f64]),
    tolerance: f64,
    discs: usize,
) -> Vec<Integrated> {
    let is_fast = fronts.is_fast(tolerance);
    let widths = fronts.widths(discs, tolerance, derivative.power());
    let of = |(sample, &time_s): (usize, &f64)| {
        let whole = is_fast || fronts.are_of_small_contact(time_s, tolerance);
        let passes = || fronts.pass(time_s, widths);
        (time_s > fronts.first_s && (whole || passes())).then_some(Integrated { sample, whole })
    };
    times_s.iter().enumerate().filter_map(of).collect()
}
