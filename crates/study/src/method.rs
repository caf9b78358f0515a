//! The one table of methods that are compared: their names, and why the program does not take those that are ahead of its own
//! somewhere.

macro_rules! methods {
    ($($method:ident $name:literal $(not taken: $why:literal)?;)*) => {
        contact::choice! {
            /// A method that a chart compares, by its name in files and pictures.
            #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
            pub enum ComparedMethod { $(#[doc = $name] $method = $name,)* }
        }

        impl ComparedMethod {
            /// Why the program does not take a method that is cheaper than its own somewhere, in one clause, for methods
            /// that have been looked at; none for others.
            pub(crate) fn why_not(self) -> Option<&'static str> {
                match self { $(Self::$method => methods!(@why $($why)?)),* }
            }
        }
    };
    (@why) => { None };
    (@why $why:literal) => { Some($why) };
}

// kernels, force, fields, impacts
methods! {
    SingleIntegral "single integral";
    FixedTalbot "fixed Talbot";
    GaverStehfest "Gaver-Stehfest";
    Euler "Euler";
    Durbin "Durbin";
    DeHoog "de Hoog";
    SurfaceResponse "surface response";
    Kausel "closed form (Kausel): the reference";
    TableOfKernels "table";

    WaveImplicit "wave implicit" not taken: "its number of steps is known beforehand; the program does not know how many a tolerance needs, halves the step until the results stand still, and pays for the coarser marches as well";
    ImplicitFirst "implicit of order 1";
    ImplicitSecond "implicit of order 2" not taken: "it knows the loss 1 - e^2 from the momentum alone, to the digits of the restitution and not to its own; what the program's march takes longer at 1e-3 goes into the loss and the instant of separation";
    WaveExplicit "wave explicit (the paper's)";
    Hertz "hertz";
    TwoSprings "two springs, no waves";
    TwoSpringsWithLoss "two springs, first-order loss";
    WaveHalved "wave implicit, step halved to tolerance";
    WaveInSweeps "wave implicit, as in sweeps";
    Series "series, as in large sweeps";
    Radiation "radiation";
    AreaDashpot "area dashpot";
    GrowingPieces "growing, polynomial pieces";

    Direct "direct";
    DirectLinear "direct, linear cells";
    TableDirectSums "table, direct sums";
    TableTransform "table, FFT";
    TableLinear "table, linear cells" not taken: "it reads a third of the numbers and needs a step many times finer as soon as more is asked; the program takes it for forces with corners";
    TableOfPulse "table, sums for this pulse only" not taken: "its sums know that this pulse is two exponentials, which no computed force is";
    TableOther "table, other nodes or points" not taken: "fewer nodes are enough at this place and not at the worst places of a table, for which its nodes are chosen";
    WholeResponse "interpolated whole response";
    RemainderAlone "interpolated remainder";

    Computed "computed";
    CellsAlone "cells alone" not taken: "its step is known beforehand, many times finer than that of the output; the program does not know how fine is enough, and integrates the ends of the contact instead";
    LookedUp "looked up";
}
