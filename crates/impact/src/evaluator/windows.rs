//! Windows of time in which waves of the first and last instants of a contact pass a point, known before anything is summed.
//!
//! Theory: `docs/theory.md` (T60).

use crate::excitation::Excitation;
use std::f64::consts::PI;

/// The windows of one point.
pub(crate) struct Windows<'a> {
    pub(crate) excitation: &'a Excitation,
    pub(crate) place_m: [f64; 2],
    pub(crate) tolerance: f64,
    /// Of fields, not of their rates.
    pub(crate) of_fields: bool,
}

impl Windows<'_> {
    /// Whether a front from the beginning or the end of a contact passes at a time: a contact that is smaller than the smallest
    /// disc has a sharper one, of which the terms that are left out do not tell.
    pub(crate) fn front_passes(&self, time_s: f64) -> bool {
        /// Times that a longitudinal wave takes over the largest radius, of fields and of rates, and how many kinds of fronts:
        /// Rayleigh's is sharp in rates alone. `fronts_that_are_sharper_than_any_disc_are_seen` fails without them.
        const OF_FIELDS: (f64, usize) = (0.025, 2);
        const OF_RATES: (f64, usize) = (0.16, 3);
        let (blur, kinds) = if self.of_fields { OF_FIELDS } else { OF_RATES };
        self.passes(time_s, kinds, [blur, blur], [1.0; 3])
    }

    /// Whether a front of the first kinds from the centre of a contact that begins or ends passes a time: from so much before it
    /// to so much after it, in radii over a speed of each kind, itself over that of longitudinal waves.
    fn passes(
        &self,
        time_s: f64,
        kinds: usize,
        [before, after]: [f64; 2],
        speeds: [f64; 3],
    ) -> bool {
        let (excitation, [r_m, z_m]) = (self.excitation, self.place_m);
        let unit_s = excitation.units().time_s();
        let fronts_s = excitation.speeds().arrivals_s(r_m, z_m, 0.0);
        let mut ends_s = excitation.contacts_s().iter().flatten();
        ends_s.any(|end_s| {
            let mut fronts = fronts_s.iter().zip(speeds).take(kinds);
            fronts.any(|(front_s, speed)| {
                let since = (time_s - end_s - front_s) * speed / unit_s;
                -before < since && since < after
            })
        })
    }

    /// Whether waves of a time come from the first or last instants of a contact, seen from close to it: the discs do not have
    /// them, nor tell, and the whole contact is integrated.
    ///
    /// Their fronts are as sharp as the contact is small, and what follows them, too. Near the centre, before they have passed,
    /// the static field of a contact hardly larger than the distance from its centre, with which its waves begin, is no
    /// polynomial in the square of its radius.
    pub(crate) fn is_of_small_contact(&self, time_s: f64) -> bool {
        // all of these: `scripts/check-close` counts the fields above their estimates
        /// Distance in largest radii up to which a point is close, and times over the radius before and after a front.
        const CLOSE: f64 = 4.0;
        const PASSING: [f64; 2] = [0.05, 0.8];
        /// Part of the tolerance that the force has reached when a wave has crossed a radius, below which nothing shows.
        const SHOWS: f64 = 0.3;
        /// Distance near the centre in largest radii, radius of the contact over that distance and over the largest, and times
        /// that Rayleigh's wave takes over the distance.
        const CENTRAL: f64 = 0.15;
        const SMALL: f64 = 8.0;
        const LARGEST: f64 = 0.25;
        const CROSSINGS: f64 = 30.0;
        let (excitation, medium) = (self.excitation, self.excitation.medium());
        let units = excitation.units();
        let over = self.place_m[0].hypot(self.place_m[1]) / units.disc_radius_m;
        let crossing = PI * units.time_s() / (medium.rayleigh_speed() * excitation.end_s());
        let shows = crossing.powf(1.5) > SHOWS * self.tolerance;
        if over > CLOSE || !shows || !self.of_fields {
            return false;
        }
        let speeds = [1.0, medium.kappa(), medium.rayleigh_speed()];
        if self.passes(time_s, 3, PASSING, speeds) {
            return true;
        }
        let passing_s = CROSSINGS * over * units.time_s() / medium.rayleigh_speed();
        let most = (SMALL * over).min(LARGEST);
        let is_small = |s: f64| excitation.pressures(s)[0].square < most * most;
        let is_at_end = |&[begin_s, end_s]: &[f64; 2]| {
            let middle_s = 0.5 * (begin_s + end_s);
            let begins = time_s < middle_s && is_small((time_s - passing_s).max(begin_s));
            let ends =
                time_s > middle_s && time_s < end_s + passing_s && is_small(time_s.min(end_s));
            begins || ends
        };
        over < CENTRAL && excitation.contacts_s().iter().any(is_at_end)
    }
}
