//! One file per subcommand: its arguments, the call of the library, and its printed report.

pub(crate) mod chart;
pub(crate) mod compare;
pub(crate) mod demo;
pub(crate) mod export;
pub(crate) mod impact;
pub(crate) mod infer;
pub(crate) mod lamb;
pub(crate) mod materials;
pub(crate) mod noise;
pub(crate) mod paper;
pub(crate) mod plot;
pub(crate) mod sweep;
pub(crate) mod table;
pub(crate) mod tabulate;
