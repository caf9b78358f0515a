//! Load on the half-space: a force history with the radius of its pressure and its error.
//!
//! A solved contact, a closed form and a record all become an [`Excitation`], from which fields, sections and energy
//! are computed in the same way.
//!
//! Theory: `docs/theory.md` (T55).

use crate::kernels::Pulse;
use crate::record::ForceRecord;
use crate::record::jump::Jump;
use crate::sampled::convolve::{Transform, rises};
use crate::sampled::projection::{CellNodes, Node};
use contact::{
    CollisionUnits, HalfSpace, History, KernelUnits, Resampler, SolvedContact, StaticShare,
    WaveSpeeds, Weights,
};
use halfspace::{
    Attenuation, Deflection, DomainError, Medium, Profile, Six, SurfaceResponse, gauss,
};

/// Consecutive samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Samples {
    /// Time of the first in s.
    pub start_s: f64,
    /// Force long before it in N.
    pub base_n: f64,
    /// Number of samples.
    pub count: usize,
}

/// A force on a disc of the surface.
#[derive(Debug, Clone)]
pub struct Excitation {
    medium: Medium,
    /// Young's modulus in Pa and Poisson's ratio.
    pub(crate) elastic: [f64; 2],
    units: KernelUnits,
    force: Force,
    radius: PressureRadius,
    /// Estimated relative error of the force.
    pub(crate) relative_error: f64,
    /// Attenuation of the waves, with its reference frequency in Hz.
    pub(crate) attenuation: Option<Attenuation>,
}

/// Radius of Hertz's pressure under a force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PressureRadius {
    /// Constant, in m: the paper's disc, a record's disc.
    Fixed(f64),
    /// Hertz's radius at each time, proportional to the cube root of the force.
    Following {
        /// Under the largest force, in m.
        largest_m: f64,
        /// The largest force in N.
        largest_n: f64,
    },
}

impl PressureRadius {
    /// The largest in m: the unit of length of the fields.
    pub fn largest_m(self) -> f64 {
        let (Self::Fixed(largest_m) | Self::Following { largest_m, .. }) = self;
        largest_m
    }
}

/// One of the Hertz pressures whose sum is the pressure at a time.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Pressed {
    /// The force in N and its rate in N/s.
    pub(crate) force_n: f64,
    pub(crate) rate: f64,
    /// Square of the radius relative to the largest, and its rate in 1/s.
    pub(crate) square: f64,
    pub(crate) square_rate: f64,
}

impl Pressed {
    /// The rate of a function, from its difference over a fraction of the force or of the squared radius.
    pub(crate) fn rate_of<const N: usize, E>(
        self,
        part: f64,
        of: impl Fn(Self) -> Result<[f64; N], E>,
    ) -> Result<[f64; N], E> {
        let lasts = [[self.force_n, self.rate], [self.square, self.square_rate]];
        let half_s = part
            * lasts
                .map(|[x, rate]| (x / rate).abs())
                .into_iter()
                .fold(f64::INFINITY, f64::min);
        if half_s == 0.0 || half_s.is_infinite() {
            return Ok([0.0; N]);
        }
        let [more, less] = [half_s, -half_s].map(|seconds| {
            of(Self {
                force_n: self.force_n + seconds * self.rate,
                square: self.square + seconds * self.square_rate,
                ..self
            })
        });
        let (more, less) = (more?, less?);
        Ok(std::array::from_fn(|i| {
            (more[i] - less[i]) / (2.0 * half_s)
        }))
    }
}

/// A force history, and the motion of its striker if there is one.
#[derive(Debug, Clone)]
enum Force {
    Contact(Box<Contact>),
    Record(ForceRecord),
}

/// The force history of a striker.
#[derive(Debug, Clone)]
pub(crate) struct Contact {
    pub(crate) samples: Resampler,
    pub(crate) units: CollisionUnits,
    /// Duration of the first contact in s.
    duration_s: f64,
    /// Begin and end of each contact, in s.
    contacts_s: Vec<[f64; 2]>,
    /// Times in s at which its rate jumps within a contact.
    kinks_s: Vec<f64>,
}

/// The striker at one instant, in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    /// Displacement in m.
    pub displacement_m: f64,
    /// Velocity in m/s.
    pub velocity_m_s: f64,
    /// Deflection of the half-space that enters the contact law in m.
    pub deflection_m: f64,
}

/// Force in N and its rate in N/s from those in collision units.
#[inline(always)]
fn in_si([force, rate, _]: [f64; 3], units: &CollisionUnits) -> [f64; 2] {
    [force * units.force_n, rate * units.force_n / units.time_s]
}

/// Quality factor from which a block is elastic: attenuation changes fields by its inverse times the wave lengths of the path, which
/// is below 1e-10 then (`without_attenuation_fields_are_elastic`).
const ELASTIC: f64 = 1e12;

impl Contact {
    /// Nodes of a cell that begins at a time and has a length in s, with forces at its ends: graded toward the begin or end of a
    /// contact, where the force has the power 3/2. The force is not read yet.
    fn nodes(&self, [from_s, step_s]: [f64; 2], ends_n: [f64; 2], nodes: &mut Vec<Node>) {
        /// A force that changes by more than this over a cell is near the end of a contact.
        const STEEP: f64 = 0.5;
        const PLAIN: usize = 4;
        const GRADED: usize = 12;
        let node = |(x, weight)| Node {
            x,
            weight,
            force: 0.0,
        };
        let [low, high] = [ends_n[0].min(ends_n[1]), ends_n[0].max(ends_n[1])];
        // one of which both ends are within the cell counts by its middle
        if high <= 0.0 && self.force_n(from_s + 0.5 * step_s) <= 0.0 {
            return;
        }
        if low > STEEP * high {
            nodes.extend(gauss::rule(PLAIN).on(-0.5, 0.5).map(node));
            return;
        }
        // from the begin or end of the contact, or from the lower end of the cell
        let rising = ends_n[0] < ends_n[1];
        let [mut zero, end] = if rising { [-0.5, 0.5] } else { [0.5, -0.5] };
        if low <= 0.0 {
            let mut ends_s = self.contacts_s.iter().flatten();
            let inside = |&&end_s: &&f64| from_s <= end_s && end_s <= from_s + step_s;
            zero = ends_s
                .find(inside)
                .map_or(zero, |end_s| (end_s - from_s) / step_s - 0.5);
        }
        let (length, first) = (end - zero, nodes.len());
        let graded = gauss::rule(GRADED).on(0.0, 1.0);
        let graded = graded.map(|(u, w)| (zero + length * u * u, 2.0 * u * w * length.abs()));
        nodes.extend(graded.map(node));
        if length < 0.0 {
            nodes[first..].reverse();
        }
    }

    /// The force at a time, in N.
    fn force_n(&self, time_s: f64) -> f64 {
        self.samples.force(time_s / self.units.time_s)[0] * self.units.force_n
    }
}

impl Excitation {
    /// The excitation of a contact: its history in collision units, and its duration in s; `radius` is that of the
    /// pressure.
    ///
    /// # Errors
    /// [`DomainError`] for an impossible Poisson's ratio.
    pub fn of_contact(
        half_space: &HalfSpace,
        radius: PressureRadius,
        history: History,
        units: CollisionUnits,
        duration_s: f64,
    ) -> Result<Self, DomainError> {
        let relative_error = history.error;
        let samples = Resampler::new(history);
        let span_s = |span: &[f64]| [0, 1].map(|i| span[i] * units.time_s);
        let kinks = (samples.history.pieces.iter()).flat_map(|solved| &solved.kinks);
        let contact = Contact {
            contacts_s: samples.breaks.chunks_exact(2).map(span_s).collect(),
            kinks_s: kinks.map(|t| t * units.time_s).collect(),
            samples,
            units,
            duration_s,
        };
        let force = Force::Contact(Box::new(contact));
        Self::new(half_space, radius, force, relative_error)
    }

    /// The excitation of a record on a disc of a radius in m.
    ///
    /// # Errors
    /// [`DomainError`] for an impossible Poisson's ratio.
    pub fn of_record(
        half_space: &HalfSpace,
        radius_m: f64,
        record: ForceRecord,
    ) -> Result<Self, DomainError> {
        let radius = PressureRadius::Fixed(radius_m);
        Self::new(half_space, radius, Force::Record(record), 0.0)
    }

    fn new(
        half_space: &HalfSpace,
        radius: PressureRadius,
        force: Force,
        relative_error: f64,
    ) -> Result<Self, DomainError> {
        let material = half_space.material();
        Ok(Self {
            medium: Medium::new(material.poisson_ratio)?,
            elastic: [material.youngs_modulus_pa, material.poisson_ratio],
            units: KernelUnits {
                disc_radius_m: radius.largest_m(),
                longitudinal_speed_m_s: half_space.longitudinal_speed_m_s(),
                shear_modulus_pa: material.shear_modulus_pa(),
            },
            force,
            radius,
            relative_error,
            attenuation: half_space
                .attenuation
                .filter(|law| law.quality_factor() < ELASTIC),
        })
    }

    /// The half-space's Poisson ratio and derived quantities.
    pub fn medium(&self) -> &Medium {
        &self.medium
    }

    /// The same force with a pressure of a fixed radius in m.
    #[must_use]
    pub fn on_disc(&self, radius_m: f64) -> Self {
        let mut fixed = self.clone();
        fixed.radius = PressureRadius::Fixed(radius_m);
        fixed.units.disc_radius_m = radius_m;
        fixed
    }

    /// Radius of the pressure.
    pub fn radius(&self) -> PressureRadius {
        self.radius
    }

    /// Units of the kernels: largest radius of the pressure, wave speed, shear modulus.
    pub fn units(&self) -> &KernelUnits {
        &self.units
    }

    /// Its contact; none for a record.
    pub(crate) fn contact(&self) -> Option<&Contact> {
        match &self.force {
            Force::Contact(contact) => Some(contact),
            Force::Record(_) => None,
        }
    }

    /// Its record, if it has one.
    pub fn record(&self) -> Option<&ForceRecord> {
        match &self.force {
            Force::Contact(_) => None,
            Force::Record(record) => Some(record),
        }
    }

    /// The contact in collision units if it has yielded.
    pub(crate) fn yielded(&self) -> Option<&SolvedContact> {
        let pieces = self.contact()?.samples.history.pieces.as_deref();
        pieces.filter(|one| one.flow.is_some())
    }

    /// The force at a time, in N; the later value at a jump.
    pub fn force_n(&self, time_s: f64) -> f64 {
        match &self.force {
            Force::Contact(_) => self.force_and_rate(time_s)[0],
            Force::Record(record) => record.at(time_s),
        }
    }

    /// Jumps of the force, which the sums over its continuous part do not include; none for a contact.
    pub(crate) fn jumps(&self) -> &[Jump] {
        self.record().map_or(&[], ForceRecord::jumps)
    }

    /// Sum of the jumps of the force in N until a time, including a jump at that time.
    pub(crate) fn jumped_n(&self, time_s: f64) -> f64 {
        self.record().map_or(0.0, |record| record.jumped_n(time_s))
    }

    /// Hertz pressures whose sum is the pressure at a time: two for a yielding contact with known pressure, one
    /// otherwise.
    pub(crate) fn pressures(&self, time_s: f64) -> [Pressed; 2] {
        self.pressures_of(time_s, self.force_and_rate(time_s))
    }

    /// The same at several times, fastest where they ascend.
    pub(crate) fn pressures_at(&self, times_s: &[f64]) -> Vec<[Pressed; 2]> {
        let all = times_s.iter().zip(self.forces_and_rates(times_s));
        all.map(|(&time_s, own)| self.pressures_of(time_s, own))
            .collect()
    }

    /// The same of the force in N at a time and its rate.
    fn pressures_of(&self, time_s: f64, [force_n, rate]: [f64; 2]) -> [Pressed; 2] {
        let one = |square: f64, square_rate: f64| Pressed {
            force_n,
            rate,
            square,
            square_rate,
        };
        let PressureRadius::Following { largest_n, .. } = self.radius else {
            return [one(1.0, 0.0), Pressed::default()];
        };
        if force_n <= 0.0 {
            return [Pressed::default(); 2];
        }
        if let (Some(yielded), Some(Contact { units, .. })) = (self.yielded(), self.contact())
            && let Some(found) = yielded.pressures(time_s / units.time_s)
        {
            return found.map(|[part, part_rate, square, square_rate]| Pressed {
                force_n: part * force_n,
                rate: part * rate + part_rate * force_n / units.time_s,
                square,
                square_rate: square_rate / units.time_s,
            });
        }
        let square = (force_n / largest_n).cbrt().powi(2);
        [
            one(square, square * rate / (1.5 * force_n)),
            Pressed::default(),
        ]
    }

    /// Static field in SI units under the pressures at a time.
    pub(crate) fn static_si(
        &self,
        [r_m, z_m]: [f64; 2],
        pressures: impl IntoIterator<Item = Pressed>,
    ) -> Result<Six, DomainError> {
        let mut sum = Six::default();
        for one in pressures {
            let over = one.square.sqrt();
            if over == 0.0 {
                continue;
            }
            let radius_m = over * self.units.disc_radius_m;
            let fixed = self
                .medium
                .static_field(Profile::Hertz, r_m / radius_m, z_m / radius_m)?;
            let unit = self.units_si(over);
            for (f, sum) in sum.iter_mut().enumerate() {
                *sum += one.force_n * unit[f] * fixed[f];
            }
        }
        Ok(sum)
    }

    /// Units of the fields by a force in N, under a disc of a radius `over` the largest.
    pub(crate) fn units_si(&self, over: f64) -> Six {
        let displacement = self.units.displacement_m_per_n() / over;
        let stress = self.units.stress_pa_per_n() / (over * over);
        [displacement, displacement, stress, stress, stress, stress]
    }

    /// Begin and end of each contact, in s; empty for a record.
    pub(crate) fn contacts_s(&self) -> &[[f64; 2]] {
        self.contact().map_or(&[], |contact| &contact.contacts_s)
    }

    /// Spans in s on which the force of contacts is smooth.
    pub(crate) fn smooth_s(&self) -> Vec<[f64; 2]> {
        let cut = |&[begin_s, end_s]: &[f64; 2]| {
            let inside = self.kinks_s().iter().copied();
            let inside = inside.filter(move |kink| begin_s < *kink && *kink < end_s);
            let ends: Vec<f64> = [begin_s].into_iter().chain(inside).chain([end_s]).collect();
            ends.windows(2)
                .map(|pair| [pair[0], pair[1]])
                .collect::<Vec<_>>()
        };
        self.contacts_s().iter().flat_map(cut).collect()
    }

    /// Times in s at which the rate of a contact's force jumps between its beginning and end.
    pub(crate) fn kinks_s(&self) -> &[f64] {
        self.contact().map_or(&[], |contact| &contact.kinks_s)
    }

    /// Fold of the fronts from the edge of a contact next to its begin or end: by how much in s they are ahead of that from the
    /// centre, at most.
    ///
    /// The edge is faster than a wave of this speed until then, and its fronts meet where it becomes slower.
    pub(crate) fn fold_s(&self, end_s: f64, speed_m_s: f64) -> f64 {
        /// Logarithms of parts of the contact among which it lies, and their step.
        const PARTS: i32 = 160;
        const RATIO: f64 = 0.87;
        let inside = if end_s > 0.5 * self.end_s() {
            -1.0
        } else {
            1.0
        };
        let crossing_s = self.units.disc_radius_m / speed_m_s;
        let ahead_s = |k: i32| {
            let since_s = self.end_s() * RATIO.powi(k);
            let [one, other] = self.pressures(end_s + inside * since_s);
            let square = one.square.max(other.square);
            // so close to the end that rounding leaves no force
            let is_lost = square == 0.0;
            let ahead_s = square.sqrt() * crossing_s - since_s;
            if is_lost { f64::NEG_INFINITY } else { ahead_s }
        };
        // the radius over time is concave: there is one largest part
        let [mut before, mut after] = [1, PARTS];
        while before < after {
            let middle = (before + after) / 2;
            match ahead_s(middle) < ahead_s(middle + 1) {
                true => before = middle + 1,
                false => after = middle,
            }
        }
        ahead_s(before).max(0.0)
    }

    /// The force without its jumps in N long before a run.
    pub(crate) fn continuous_base_n(&self, run: &Samples) -> f64 {
        let earlier = self
            .jumps()
            .iter()
            .take_while(|jump| jump.time_s < run.start_s);
        run.base_n - earlier.map(|jump| jump.rise_n).sum::<f64>()
    }

    /// The force in N without its jumps, and its rate in N/s at a time; NaN for the rate of a record, which changes
    /// abruptly at its rows.
    #[inline(always)]
    pub(crate) fn force_and_rate(&self, time_s: f64) -> [f64; 2] {
        match &self.force {
            Force::Contact(contact) => in_si(
                contact.samples.force(time_s / contact.units.time_s),
                &contact.units,
            ),
            Force::Record(record) => [record.continuous_n(time_s), f64::NAN],
        }
    }

    /// The same at several times.
    fn forces_and_rates(&self, times_s: &[f64]) -> Vec<[f64; 2]> {
        let Force::Contact(contact) = &self.force else {
            let all = times_s.iter();
            return all.map(|&time_s| self.force_and_rate(time_s)).collect();
        };
        let units = &contact.units;
        let times: Vec<f64> = times_s.iter().map(|t| t / units.time_s).collect();
        let all = contact.samples.forces(&times).into_iter();
        all.map(|force| in_si(force, units)).collect()
    }

    /// Nodes in the cells between the samples of a run in N at which the force is read, with weights that integrate it.
    pub(crate) fn cell_nodes(&self, run: &Samples, step_s: f64, force_n: &[f64]) -> CellNodes {
        let mut found = self.unread_nodes(run, step_s, force_n);
        if self.contact().is_some() {
            let forces = self.forces_and_rates(&found.times_s(run.start_s, step_s));
            found.read(|node| forces[node][0]);
        }
        found
    }

    /// The same without the forces of a contact.
    pub(crate) fn unread_nodes(&self, run: &Samples, step_s: f64, force_n: &[f64]) -> CellNodes {
        let start_s = |cell: usize| run.start_s + cell as f64 * step_s;
        CellNodes::new(run.count.saturating_sub(1), |cell, nodes| {
            match &self.force {
                Force::Contact(contact) => {
                    let ends_n = [force_n[cell], force_n[cell + 1]];
                    contact.nodes([start_s(cell), step_s], ends_n, nodes);
                }
                Force::Record(record) => record.nodes(start_s(cell), step_s, nodes),
            }
        })
    }

    /// The striker at a time; none for a record.
    pub fn motion(&self, time_s: f64) -> Option<Motion> {
        let Contact { samples, units, .. } = self.contact()?;
        let now = samples.at(time_s / units.time_s);
        Some(Motion {
            displacement_m: now.displacement * units.length_m,
            velocity_m_s: now.velocity * units.velocity_m_s(),
            deflection_m: now.deflection * units.length_m,
        })
    }

    /// Onset of the main pulse in s: zero for a contact.
    pub(crate) fn start_s(&self) -> f64 {
        self.record().map_or(0.0, ForceRecord::start_s)
    }

    /// Wave speeds of the half-space.
    pub fn speeds(&self) -> WaveSpeeds {
        WaveSpeeds::new(&self.medium, self.units.longitudinal_speed_m_s)
    }

    /// Deflection of the disc in m at a time in s after a jump of the force by 1 N, with a share of its static part.
    pub(crate) fn deflection_after_jump_m(
        &self,
        deflection: Deflection,
        share: StaticShare,
    ) -> impl Fn(f64) -> f64 {
        let response = SurfaceResponse::new(&self.medium, deflection);
        let static_m_per_n = response.disc.static_compliance * self.units.displacement_m_per_n();
        let (factor, unit_s) = (share.factor(), self.units.time_s());
        move |time_s| static_m_per_n * (factor - 1.0 + response.step(time_s / unit_s))
    }

    /// Begin of the force in s, however small.
    pub(crate) fn first_s(&self) -> f64 {
        self.record().map_or(0.0, ForceRecord::leaves_zero_s)
    }

    /// First arrivals in s of the P, S and Rayleigh wave at a point in m; infinite if there is no Rayleigh wave.
    pub fn arrivals_s(&self, [r_m, z_m]: [f64; 2]) -> [f64; 3] {
        let first = self.speeds().arrivals_s(r_m, z_m, self.units.disc_radius_m);
        first.map(|t| self.start_s() + t)
    }

    /// End of the force in s.
    pub fn end_s(&self) -> f64 {
        match &self.force {
            Force::Contact(contact) => contact.duration_s,
            Force::Record(record) => record.span_s()[1],
        }
    }

    /// Properties that determine a table's error, with times in r0/c1 of discs of a radius `over` the largest.
    pub(crate) fn pulse(&self, over: f64) -> Pulse {
        let unit_s = over * self.units.time_s();
        match &self.force {
            Force::Contact(contact) => Pulse::Contact(contact.duration_s / unit_s),
            Force::Record(record) => Pulse::Lines {
                length: record.pulse_s() / unit_s,
                jump: record.largest_jump_n() / record.largest_n().max(f64::MIN_POSITIVE),
            },
        }
    }

    /// Deflection of the disc in m under a continuous force at equidistant samples, with a share of its static part;
    /// `base_n` is the force long before.
    pub(crate) fn deflection_m(
        &self,
        deflection: Deflection,
        share: StaticShare,
        step_s: f64,
        base_n: f64,
        force_n: &[f64],
    ) -> Vec<f64> {
        let response = SurfaceResponse::new(&self.medium, deflection);
        let weights = Weights::of_samples(&response, step_s, self.units.time_s(), force_n.len());
        let static_m_per_n = response.disc.static_compliance * self.units.displacement_m_per_n();
        let factor = share.factor();
        let count = force_n.len();
        let delayed = if Transform::is_faster(count, weights.values.len(), count) {
            let transform = Transform::new(&rises(base_n, force_n));
            transform.convolve_one(weights.values.iter().copied().take(count))
        } else {
            let above_n: Vec<f64> = force_n.iter().map(|p| p - base_n).collect();
            let all = (0..count).map(|n| weights.delayed(&above_n[..=n]));
            all.collect()
        };
        let all = force_n.iter().zip(delayed);
        all.map(|(p, delayed)| static_m_per_n * (factor * p - delayed))
            .collect()
    }
}
