//! Settings of a contact: model, scheme, disc, tolerances.

use crate::names::choice;
use halfspace::Deflection;

choice! {
    /// Contact model.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum Model {
        /// Closed form, no waves.
        Hertz = "hertz",
        /// First-order radiated loss.
        Radiation = "radiation",
        /// Hertz's spring in series with the disc's static one, no waves.
        QuasiStatic = "quasi_static",
        /// The same with the first-order radiated loss.
        QuasiStaticRadiation = "quasi_static_radiation",
        /// Full retarded deflection of a disc of fixed radius: the paper.
        Wave = "wave",
        /// Contact radius that follows the load.
        Growing = "growing",
        /// Radiation to the second order in the memory, with its third: a dashpot on the contact's area.
        AreaDashpot = "area_dashpot",
        /// The cheapest of these that meets the tolerance.
        Auto = "auto",
    }
}

/// Physics of a contact, as its scene states it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Physics {
    /// The contact radius follows the load.
    Growing,
    /// The half-space is loaded on a disc of fixed radius, whose deflection is added to Hertz's indentation.
    Disc(StaticShare),
    /// The contact radius follows the load, and the softer body flows.
    Yielding,
}

/// Memory of the half-space in a model; each is the limit of the next for a short memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Memory {
    /// None: no waves at all.
    None,
    /// First-order radiated loss.
    FirstOrder,
    /// Dashpot on the contact's area.
    Dashpot,
    /// All of it.
    Full,
}

impl Physics {
    /// The table of models: physics x memory. Without the full memory a disc that adds no static deflection is no disc, and
    /// no disc has a dashpot on its area.
    pub fn model(self, memory: Memory) -> Model {
        use StaticShare::{Dynamic, Full};
        match (self, memory) {
            (Self::Growing | Self::Yielding | Self::Disc(Dynamic), Memory::None) => Model::Hertz,
            (Self::Disc(Full), Memory::None) => Model::QuasiStatic,
            (Self::Growing | Self::Yielding | Self::Disc(Dynamic), Memory::FirstOrder) => {
                Model::Radiation
            }
            (Self::Disc(Full), Memory::FirstOrder) => Model::QuasiStaticRadiation,
            (Self::Growing | Self::Yielding | Self::Disc(Full | Dynamic), Memory::Dashpot) => {
                Model::AreaDashpot
            }
            (Self::Growing | Self::Yielding, Memory::Full) => Model::Growing,
            (Self::Disc(Full | Dynamic), Memory::Full) => Model::Wave,
        }
    }
}

impl Model {
    /// Memory of the half-space; `auto` has all of it until it has chosen.
    pub fn memory(self) -> Memory {
        match self {
            Self::Hertz | Self::QuasiStatic => Memory::None,
            Self::Radiation | Self::QuasiStaticRadiation => Memory::FirstOrder,
            Self::AreaDashpot => Memory::Dashpot,
            Self::Growing | Self::Wave | Self::Auto => Memory::Full,
        }
    }

    /// Whether the half-space is loaded on a disc of fixed radius; `auto` is the paper's disc until it has chosen.
    pub fn on_disc(self) -> bool {
        match self {
            Self::QuasiStatic | Self::QuasiStaticRadiation | Self::Wave | Self::Auto => true,
            Self::Hertz | Self::Radiation | Self::AreaDashpot | Self::Growing => false,
        }
    }

    /// Whether it may be a march on a fixed disc, for which there are two schemes.
    pub(crate) fn has_schemes(self) -> bool {
        match self {
            Self::Wave | Self::Auto => true,
            Self::Hertz
            | Self::Radiation
            | Self::QuasiStatic
            | Self::QuasiStaticRadiation
            | Self::Growing
            | Self::AreaDashpot => false,
        }
    }

    /// Whether `disc_radius_m` may be given: as the disc of the contact, or as that of its fields.
    fn allows_disc(self) -> bool {
        match self {
            Self::Growing => false,
            Self::Hertz
            | Self::Radiation
            | Self::QuasiStatic
            | Self::QuasiStaticRadiation
            | Self::Wave
            | Self::AreaDashpot
            | Self::Auto => true,
        }
    }

    /// Whether a body may flow by a law in it.
    fn allows(self, law: Plasticity) -> bool {
        match self {
            Self::Hertz | Self::AreaDashpot | Self::Auto => true,
            Self::Growing => law.has_memory(),
            Self::Radiation | Self::QuasiStatic | Self::QuasiStaticRadiation | Self::Wave => false,
        }
    }
}

choice! {
    /// The marching scheme.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum Scheme {
        /// Product integration, any step.
        Implicit = "implicit",
        /// The paper's (40)-(44).
        Explicit = "explicit",
    }
}

choice! {
    /// How the softer body flows.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum Plasticity {
        /// It does not, however high the pressure.
        None = "none",
        /// The pressure is cut at that of yield; unloading as Hertz's law of a flatter sphere.
        Thornton = "thornton",
        /// The same loading, and the unloading that leaves no traction.
        Recovery = "recovery",
        /// The fit of finite elements of Jackson and Green.
        JacksonGreen = "jackson_green",
    }
}

impl Plasticity {
    /// Whether a body flows at all.
    pub fn yields(self) -> bool {
        match self {
            Self::None => false,
            Self::Thornton | Self::Recovery | Self::JacksonGreen => true,
        }
    }

    /// Whether the pressure of the flow can be given; otherwise it follows from the yield strength.
    pub fn has_pressure(self) -> bool {
        match self {
            Self::Thornton | Self::Recovery => true,
            Self::None | Self::JacksonGreen => false,
        }
    }

    /// Whether the law can be followed with the memory of the half-space: a law that jumps cannot.
    pub fn has_memory(self) -> bool {
        match self {
            Self::None | Self::Thornton | Self::Recovery => true,
            Self::JacksonGreen => false,
        }
    }
}

choice! {
    /// Part of the half-space's deflection that is added to Hertz's indentation.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub enum StaticShare {
        /// All of it: the paper, whose K already holds the static compliance of the half-space.
        Full = "full",
        /// Only the difference from the static deflection: nothing is counted twice.
        Dynamic = "dynamic",
    }
}

choice!(Deflection: Centre = "centre", Mean = "mean");

impl StaticShare {
    /// Part of the static deflection that enters.
    pub fn factor(self) -> f64 {
        match self {
            Self::Full => 1.0,
            Self::Dynamic => 0.0,
        }
    }
}

/// How a contact is computed.
///
/// Fields may be added: name those that you set and end with `..Settings::default()`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Radius of the loaded disc in m, if it is fixed.
    pub disc_radius_m: Option<f64>,
    /// Model.
    pub model: Model,
    /// Marching scheme.
    pub scheme: Scheme,
    /// Static share.
    pub static_share: StaticShare,
    /// Deflection.
    pub deflection: Deflection,
    /// Relative tolerance on the results.
    pub tolerance: f64,
    /// Relative tolerance on the loss 1 - e^2, if there is one.
    pub loss_tolerance: Option<f64>,
    /// Fixed step in s.
    pub step_s: Option<f64>,
    /// How the softer body flows.
    pub plasticity: Plasticity,
    /// Mean pressure in Pa that is not exceeded; 2.8 times the yield strength where none is given.
    pub yield_pressure_pa: Option<f64>,
}

impl Default for Settings {
    /// Model `auto` at a tolerance of 1e-4.
    fn default() -> Self {
        Self {
            disc_radius_m: None,
            model: Model::Auto,
            scheme: Scheme::Implicit,
            static_share: StaticShare::Full,
            deflection: Deflection::Centre,
            tolerance: 1e-4,
            loss_tolerance: None,
            step_s: None,
            plasticity: Plasticity::None,
            yield_pressure_pa: None,
        }
    }
}

/// Two settings that exclude each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Conflict {
    /// The explicit scheme with the dynamic share.
    ExplicitDynamic,
    /// The explicit scheme with a model that it does not march.
    ExplicitModel(Model),
    /// A contact that follows the load with a fixed disc.
    GrowingDisc,
    /// A contact that yields with a fixed disc.
    PlasticDisc,
    /// A law of flow with a model that it does not have.
    PlasticModel(Plasticity, Model),
    /// A yield pressure that its law does not take.
    PlasticPressure(Plasticity),
}

impl Settings {
    /// The first two settings that exclude each other, if there are any.
    pub fn conflict(&self) -> Option<Conflict> {
        let (law, model, disc) = (self.plasticity, self.model, self.disc_radius_m.is_some());
        let explicit = match self.scheme {
            Scheme::Implicit => false,
            Scheme::Explicit => true,
        };
        let dynamic = match self.static_share {
            StaticShare::Full => false,
            StaticShare::Dynamic => true,
        };
        let pressure = self.yield_pressure_pa.is_some();
        let yields = law.yields();
        let without = yields && (explicit || !model.allows(law));
        let conflicts = [
            (explicit && dynamic, Conflict::ExplicitDynamic),
            (
                explicit && !model.has_schemes(),
                Conflict::ExplicitModel(model),
            ),
            (disc && !model.allows_disc(), Conflict::GrowingDisc),
            (
                pressure && !law.has_pressure(),
                Conflict::PlasticPressure(law),
            ),
            (yields && disc, Conflict::PlasticDisc),
            (without, Conflict::PlasticModel(law, model)),
        ];
        let found = conflicts.into_iter().find(|(holds, _)| *holds);
        found.map(|(_, conflict)| conflict)
    }
}
