//! A scene: load, half-space, and requested output.

use crate::quantity::{Derivative, Quantity};
use crate::record::ForceRecord;
use crate::response::Response;
use contact::{Echoes, HalfSpace, Settings, Striker, WaveSpeeds};
use halfspace::Field;
use std::path::PathBuf;

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

contact::choice! {
    /// A quantity that a sensor measures, at the centre of its face along or across the axis of the load.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum Measured {
        /// Axial displacement.
        #[default]
        DisplacementZ = "displacement_z",
        /// Radial displacement.
        DisplacementR = "displacement_r",
        /// Axial velocity.
        VelocityZ = "velocity_z",
        /// Radial velocity.
        VelocityR = "velocity_r",
        /// Axial acceleration, as a mean over one step of the output.
        AccelerationZ = "acceleration_z",
        /// Radial acceleration, as a mean over one step of the output.
        AccelerationR = "acceleration_r",
        /// Axial stress, on a face inside the block.
        StressZz = "stress_zz",
    }
}

impl Measured {
    /// The rate of the displacement that it is; none for a field.
    pub(crate) fn rate(self) -> Option<Quantity> {
        match self {
            Self::DisplacementZ | Self::DisplacementR | Self::StressZz => None,
            Self::VelocityZ => Some(Quantity::VelocityZ),
            Self::VelocityR => Some(Quantity::VelocityR),
            Self::AccelerationZ => Some(Quantity::AccelerationZ),
            Self::AccelerationR => Some(Quantity::AccelerationR),
        }
    }

    /// Its place among the six fields and then some quantities.
    pub(crate) fn index(self, quantities: &[Quantity]) -> usize {
        let field = match self {
            Self::DisplacementR => Field::DisplacementR,
            Self::StressZz => Field::StressZz,
            _ => Field::DisplacementZ,
        };
        let own = self
            .rate()
            .and_then(|rate| quantities.iter().position(|one| *one == rate));
        own.map_or(field.index(), |place| 6 + place)
    }

    /// Its derivative of the fields in time.
    pub(crate) fn derivative(self) -> Derivative {
        let rate = self.rate().and_then(Quantity::rate);
        rate.map_or(Derivative::Field, |(derivative, _)| derivative)
    }

    /// Its unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::DisplacementZ | Self::DisplacementR => "m",
            Self::VelocityZ | Self::VelocityR => "m/s",
            Self::AccelerationZ | Self::AccelerationR => "m/s^2",
            Self::StressZz => "Pa",
        }
    }
}

/// A sensor on or in the half-space, parallel to its surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensor {
    /// Distance of its centre from the axis in m.
    pub r_m: f64,
    /// Depth in m.
    pub z_m: f64,
    /// Radius of its face in m; 0 for a point.
    pub face_radius_m: f64,
    /// The quantity that its output follows.
    pub measured: Measured,
    /// Its response to the mean of that quantity over its face; without one the output is the mean.
    pub response: Option<SensorResponse>,
}

/// Response of a sensor.
#[derive(Debug, Clone, PartialEq)]
pub struct SensorResponse {
    /// From the measured quantity in SI units to the output.
    pub response: Response,
    /// Unit of the output.
    pub unit: String,
    /// File that it was read from.
    pub file: Option<PathBuf>,
}

impl Sensor {
    /// Unit of its output.
    pub fn output_unit(&self) -> &str {
        match &self.response {
            Some(own) => &own.unit,
            None => self.measured.unit(),
        }
    }

    /// The nearest place of its face to the load in m.
    pub(crate) fn nearest_m(&self) -> [f64; 2] {
        [(self.r_m - self.face_radius_m).max(0.0), self.z_m]
    }

    /// The farthest place of its face from the load in m.
    pub(crate) fn farthest_m(&self) -> [f64; 2] {
        [self.r_m + self.face_radius_m, self.z_m]
    }
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
    /// Sensors, in addition to the probes.
    pub sensors: Vec<Sensor>,
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
        let sensors = self.sensors.iter().map(|sensor| {
            let [r_m, z_m] = sensor.farthest_m();
            r_m.hypot(z_m)
        });
        probes.chain(corner).chain(sensors).fold(0.0, f64::max)
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
                let sensors = self.sensors.iter().map(|sensor| sensor.z_m);
                let of = |z_m: f64| speeds.first_echo_s(&block, [0.0, z_m], 0.0);
                probes
                    .chain(section)
                    .chain(sensors)
                    .filter_map(of)
                    .reduce(f64::min)?
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

    /// Rates of the displacement that sensors measure, each once.
    pub(crate) fn measured_rates(&self) -> Vec<Quantity> {
        let mut found = Vec::new();
        for rate in self
            .sensors
            .iter()
            .filter_map(|sensor| sensor.measured.rate())
        {
            if !found.contains(&rate) {
                found.push(rate);
            }
        }
        found
    }

    /// Number of requested rates of the displacement: velocity, acceleration.
    pub(crate) fn rates(&self) -> usize {
        let measured = self.measured_rates();
        let own = || {
            let all = self.quantities.iter().chain(&measured);
            all.filter_map(|one| one.rate())
        };
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
        self.probes.len() + self.sensors.len() + section
    }
}
