//! A scene: load, half-space, and requested output.

use crate::quantity::{Derivative, Quantity};
use crate::record::ForceRecord;
use contact::{Echoes, HalfSpace, Settings, Striker, WaveSpeeds};

/// Load on the half-space.
#[derive(Debug, Clone, PartialEq)]
pub enum Load {
    /// A striker with its velocity of approach.
    Strike(Strike),
    /// A force history on a disc.
    Record(ForceRecord),
}

/// A striker with its velocity of approach.
#[derive(Debug, Clone, PartialEq)]
pub struct Strike {
    /// The body.
    pub striker: Striker,
    /// Velocity of approach in m/s.
    pub velocity_m_s: f64,
}

/// A point of the half-space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Probe {
    /// Distance from the axis in m.
    pub r_m: f64,
    /// Depth in m.
    pub z_m: f64,
}

/// A meridional section.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// Largest distance from the axis in m.
    pub r_max_m: f64,
    /// Largest depth in m.
    pub z_max_m: f64,
    /// Number of points along r and z.
    pub points: [usize; 2],
    /// Largest number of frames in time.
    pub frames: usize,
    /// Their times in s, ascending and not negative; empty for uniform frames over the output.
    pub times_s: Vec<f64>,
}

/// A scene, validated.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The half-space.
    pub target: HalfSpace,
    /// Load.
    pub load: Load,
    /// Settings of the contact; a record loads their disc.
    pub settings: Settings,
    /// Points of the requested fields.
    pub probes: Vec<Probe>,
    /// Requested section of the fields.
    pub section: Option<Section>,
    /// Requested quantities in addition to the fields, at probes and on the section.
    pub quantities: Vec<Quantity>,
    /// Whether the largest values over time and their times are requested on the section.
    pub peaks: bool,
    /// Duration of the output in s, if the scene sets it.
    pub duration_s: Option<f64>,
    /// Cutoff in Hz of the low pass through which fields and quantities are seen, if the scene asks for one.
    pub low_pass_hz: Option<f64>,
}

impl Scene {
    /// The striker with its velocity; none for a force record.
    pub fn strike(&self) -> Option<&Strike> {
        match &self.load {
            Load::Strike(strike) => Some(strike),
            Load::Record(_) => None,
        }
    }

    /// The force record; none for a striker.
    pub fn record(&self) -> Option<&ForceRecord> {
        match &self.load {
            Load::Strike(_) => None,
            Load::Record(record) => Some(record),
        }
    }

    /// Distance in m from the centre of the load to the farthest requested point; zero without points.
    pub(crate) fn farthest_m(&self) -> f64 {
        let probes = self.probes.iter().map(|probe| probe.r_m.hypot(probe.z_m));
        let corner = self.section.iter().map(|s| s.r_max_m.hypot(s.z_max_m));
        probes.chain(corner).fold(0.0, f64::max)
    }

    /// When the echoes of a plate stop being exact at the nearest of the points, and when they cannot be computed any longer, in s
    /// after the load begins.
    pub(crate) fn plate_s(&self) -> Option<[f64; 2]> {
        let (plate, echoes) = (self.target.echoing()?, self.target.echoes?);
        let exact_s = match echoes {
            Echoes::Until(time_s) => time_s,
            Echoes::Legs(_) => {
                let mut block = self.target.clone();
                block.radius_m = None;
                let speeds = WaveSpeeds::of(&block).ok()?;
                let probes = self.probes.iter().map(|probe| probe.z_m);
                let section = self.section.iter().flat_map(|s| [0.0, s.z_max_m]);
                let of = |z_m: f64| speeds.first_echo_s(&block, [0.0, z_m], 0.0);
                probes.chain(section).filter_map(of).reduce(f64::min)?
            }
        };
        Some([exact_s.min(plate.latest_s), plate.latest_s])
    }

    /// A warning if requested points lie within a distance of the contact of a yielding block.
    pub(crate) fn beside(&self, near_m: f64) -> Option<String> {
        let near = |probe: &&Probe| probe.r_m.hypot(probe.z_m) < near_m;
        let probes = self.probes.iter().filter(near).count();
        let probes = (probes > 0).then(|| format!("{probes} of the probes"));
        let section = self
            .section
            .iter()
            .map(|_| "the middle of the section".to_owned());
        let found: Vec<String> = probes.into_iter().chain(section).collect();
        (!found.is_empty()).then(|| {
            format!(
                "within {near_m:.3e} m of the contact (two contact radii) the stresses ignore the yielding of the block: {}",
                found.join(" and ")
            )
        })
    }

    /// Number of requested rates of the displacement: velocity, acceleration.
    pub(crate) fn rates(&self) -> usize {
        let own = || self.quantities.iter().filter_map(|one| one.rate());
        let asked = |derivative: &Derivative| own().any(|(own, _)| own == *derivative);
        let rates = [Derivative::First, Derivative::Second];
        rates.iter().filter(|rate| asked(rate)).count()
    }

    /// Number of points with fields.
    pub fn points(&self) -> usize {
        let section = self
            .section
            .as_ref()
            .map_or(0, |s| s.points[0] * s.points[1]);
        self.probes.len() + section
    }
}
