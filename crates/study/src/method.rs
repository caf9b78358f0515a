//! Table of the compared methods: their names, and the reasons why the program does not use those that are ahead of its
//! own methods somewhere.

macro_rules! methods {
    ($($method:ident $name:literal $(not taken: $why:literal)?;)*) => {
        contact::choice! {
            /// A compared method, with its name in files and pictures.
            #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
            pub enum ComparedMethod { $(#[doc = $name] $method = $name,)* }
        }

        impl ComparedMethod {
            /// Reason why the program does not use this method although it is cheaper somewhere; none if no reason is
            /// recorded.
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

    WaveImplicit "wave implicit" not taken: "its number of steps is given in advance; the program does not know how many steps a tolerance needs, halves the step until the results no longer change, and computes the coarser marches as well";
    ImplicitFirst "implicit of order 1";
    ImplicitSecond "implicit of order 2" not taken: "it computes the loss 1 - e^2 from the momentum, so that the loss has only the absolute accuracy of the restitution; the additional time of the program's march at 1e-3 is spent on the loss and the time of separation";
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
    TableLinear "table, linear cells" not taken: "it reads a third of the numbers, but needs a much finer step for higher accuracy; the program uses it for forces with corners";
    TableOfPulse "table, sums for this pulse only" not taken: "its sums exploit that this pulse consists of two exponentials, and no computed force does";
    TableOther "table, other nodes or points" not taken: "fewer nodes are enough at this place, but the nodes of a table are chosen for its worst places";
    WholeResponse "interpolated whole response";
    RemainderAlone "interpolated remainder";

    Computed "computed";
    CellsAlone "cells alone" not taken: "its step is given in advance and much finer than that of the output; the program does not know the step needed, and integrates the ends of the contact instead";
    LookedUp "looked up";
}
