//! Results are numbers: none that is not finite leaves the crate.

use crate::fields::probes::{ProbeFields, SectionFields};
use crate::outcome::{Cause, Outcome, RecordResults, Series};
use contact::Choice;
use lookup::schema::FIELD_NAMES;
use thiserror::Error;

/// A result that is no number.
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "{quantity} comes out as {value}: the numbers of the scene are beyond what floating-point arithmetic holds; check their units"
)]
pub struct NotFinite {
    /// Which result.
    pub quantity: String,
    /// What it is.
    pub value: f64,
}

/// Passes on an outcome all numbers of which are finite; those of a contact are checked where it is solved.
pub(crate) fn checked(outcome: Outcome) -> Result<Outcome, NotFinite> {
    match &outcome.cause {
        Cause::Contact { .. } => {}
        Cause::Record(results) => of_record(results)?,
    }
    series(&outcome.series)?;
    if let Some(fields) = &outcome.probes {
        probes(fields)?;
    }
    if let Some(fields) = &outcome.section {
        section(fields)?;
    }
    Ok(outcome)
}

fn finite(
    quantity: impl Fn() -> String,
    numbers: impl IntoIterator<Item = f64>,
) -> Result<(), NotFinite> {
    match numbers.into_iter().find(|x| !x.is_finite()) {
        None => Ok(()),
        Some(value) => Err(NotFinite {
            quantity: quantity(),
            value,
        }),
    }
}

fn of_record(results: &RecordResults) -> Result<(), NotFinite> {
    let RecordResults {
        peak_force_n,
        peak_force_time_s,
        duration_s,
        impulse_n_s,
        peak_deflection_m,
        disc_radius_m,
        relative_error_estimate,
        radiated_energy_j,
    } = *results;
    for (name, value) in [
        ("the peak force", peak_force_n),
        ("the time of the peak force", peak_force_time_s),
        ("the duration", duration_s),
        ("the impulse", impulse_n_s),
        ("the largest deflection", peak_deflection_m),
        ("the disc's radius", disc_radius_m),
        ("the error estimate", relative_error_estimate),
        ("the radiated energy", radiated_energy_j),
    ] {
        finite(|| name.to_owned(), [value])?;
    }
    Ok(())
}

fn series(series: &Series) -> Result<(), NotFinite> {
    let (striker, energy) = (series.striker.as_ref(), series.energy.as_ref());
    for (name, samples) in [
        ("the time", Some(&series.time_s)),
        ("the force", Some(&series.force_n)),
        ("the deflection", Some(&series.deflection_m)),
        ("the displacement", striker.map(|s| &s.displacement_m)),
        ("the velocity", striker.map(|s| &s.velocity_m_s)),
        (
            "the kinetic energy",
            energy.and_then(|e| e.kinetic_j.as_ref()),
        ),
        ("the work", energy.and_then(|e| e.work_j.as_ref())),
        ("the stored energy", energy.map(|e| &e.stored_j)),
        ("the radiated energy", energy.map(|e| &e.radiated_j)),
        (
            "the plastic work",
            energy.and_then(|e| e.plastic_j.as_ref()),
        ),
    ] {
        let samples = samples.into_iter().flatten().copied();
        finite(|| format!("{name} of a sample"), samples)?;
    }
    Ok(())
}

fn probes(fields: &ProbeFields) -> Result<(), NotFinite> {
    let arrivals = fields.arrival_s.iter().flat_map(|[p, s, _]| [*p, *s]);
    finite(|| "an arrival at a probe".to_owned(), arrivals)?;
    let own = FIELD_NAMES
        .iter()
        .zip(fields.values.iter().zip(&fields.errors));
    let own = own.map(|(name, (values, errors))| (*name, values, errors));
    let more = fields.more.iter();
    let more = more.map(|own| (own.quantity.name(), &own.values, &own.errors));
    for (name, values, errors) in own.chain(more) {
        let values = values.iter().flatten().copied();
        finite(|| format!("{name} at a probe"), values)?;
        finite(
            || format!("the error of {name} at a probe"),
            errors.iter().copied(),
        )?;
    }
    Ok(())
}

fn section(fields: &SectionFields) -> Result<(), NotFinite> {
    let arrivals = fields.arrival_s[..2].iter().flatten().copied();
    finite(|| "an arrival in the section".to_owned(), arrivals)?;
    let own = FIELD_NAMES
        .iter()
        .zip(fields.values.iter().zip(&fields.errors));
    let own = own.map(|(name, (values, errors))| (*name, values, errors));
    let more = fields.more.iter();
    let more = more.map(|own| (own.quantity.name(), &own.values, &own.errors));
    for (name, values, errors) in own.chain(more) {
        let values = values.iter().copied().map(f64::from);
        finite(|| format!("{name} in the section"), values)?;
        finite(
            || format!("the error of {name} in the section"),
            errors.iter().copied(),
        )?;
    }
    Ok(())
}
