//! Times of arrival, and the weight of the super-seismic stage.

use super::US;
use crate::case::{RADIUS_M, TABLE_1_PA, anvil, coupled};
use crate::error::PaperError;
use crate::row::Row;
use contact::Collision;
use contact::super_seismic;
use halfspace::{Arrivals, Medium, Profile};

pub(super) fn rows() -> Result<Vec<Row>, PaperError> {
    let impact = coupled(TABLE_1_PA, RADIUS_M)?;
    let block = anvil()?;
    let medium = Medium::new(block.material().poisson_ratio)?;
    let unit_us = US * RADIUS_M / block.longitudinal_speed_m_s();
    let first = |r: f64, z: f64| -> Result<f64, PaperError> {
        Ok(unit_us * Arrivals::new(&medium, Profile::Hertz, r, z)?.first())
    };
    let row = |place, what, printed, here| Row::new(place, what, [printed, here]).unit("us", 2);
    let collision = Collision::new(&block, &impact.striker, impact.velocity_m_s);
    let weight = 1e3 * super_seismic(&block, &collision, RADIUS_M);
    Ok(vec![
        row("Figs 8, 9", "P at (0, r0)", 0.67, first(0.0, 1.0)?),
        row("Figs 8, 9", "P at (0, 3 r0)", 2.0, first(0.0, 3.0)?)
            .why("the text has t = r0/c1; the number is that of 3 r0/c1"),
        row("Figs 8, 9", "P at (0, 5 r0)", 3.3, first(0.0, 5.0)?),
        row(
            "Fig. 11",
            "P at (5 r0, 0), from the edge of the disc",
            2.67,
            first(5.0, 0.0)?,
        ),
        row(
            "section 4",
            "alpha_A, the weight of the super-seismic stage",
            0.785,
            weight,
        )
        .unit("1e-3", 3)
        .why("its own formula with its own numbers gives 0.774"),
    ])
}
