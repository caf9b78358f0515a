//! The contacts that numbers and figures need, each solved once.

use crate::case::{COARSE_STEP_S, PRINTED_PA, RADIUS_M, STEP_S, TABLE_1_PA};
use crate::case::{coupled, explicit, growing, hertz};
use crate::error::PaperError;
use impact::Run;

/// The contacts.
#[derive(Debug, Clone)]
pub(crate) struct Runs {
    /// The paper's model, converged, with Table 1.
    pub(crate) table_1: Run,
    /// The same with copper of 129 GPa.
    pub(crate) printed: Run,
    /// The paper's scheme with 129 GPa and a step of 0.164 us.
    pub(crate) scheme: Run,
    /// The same with a step of 0.5 us.
    pub(crate) coarse: Run,
    /// Hertz with Table 1.
    pub(crate) hertz_table_1: Run,
    /// Hertz with 129 GPa.
    pub(crate) hertz_printed: Run,
    /// A contact that follows its load, with Table 1.
    pub(crate) growing: Run,
}

impl Runs {
    pub(crate) fn solve() -> Result<Self, PaperError> {
        Ok(Self {
            table_1: coupled(TABLE_1_PA, RADIUS_M)?.solve()?,
            printed: coupled(PRINTED_PA, RADIUS_M)?.solve()?,
            scheme: explicit(PRINTED_PA, STEP_S)?.solve()?,
            coarse: explicit(PRINTED_PA, COARSE_STEP_S)?.solve()?,
            hertz_table_1: hertz(TABLE_1_PA, RADIUS_M)?.solve()?,
            hertz_printed: hertz(PRINTED_PA, RADIUS_M)?.solve()?,
            growing: growing()?.solve()?,
        })
    }
}
