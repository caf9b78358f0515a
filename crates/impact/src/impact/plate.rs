//! The contact on a plate whose echo returns before it ends.
//!
//! The upper face moves under the contact by the echoes of its own earlier force. As this motion comes late, and is a small part of
//! the indentation, it follows from the force of the solution before: solved again on the moving surface until nothing changes.
//!
//! Theory: `docs/theory.md` (T70).

use crate::convolution::{Convolution, Trace};
use crate::error::ImpactError;
use crate::excitation::Excitation;
use crate::grid::{Grid, Wanted};
use crate::impact::run::Run;
use crate::kernels::KernelSource;
use crate::quantity::Quantity;
use contact::{
    Choice, Collision, ContactError, Echoes, Echoing, HalfSpace, Memory, Model, Results, Settings,
    SurfaceMotion,
};

/// Solutions at most; each is exact for one echo more.
const MOST_SOLUTIONS: usize = 12;

/// Change of the results over the tolerance below which a solution is the last.
const LAST_CHANGE: f64 = 0.1;

/// Relative change of the force over that of the indentation: Hertz's power.
const OF_INDENTATION: f64 = 1.5;

/// Distance from the axis, over the radius, at which the motion stands for its mean under Hertz's pressure: exact for one that is
/// a square of the distance.
const MEAN: f64 = 0.632_455_532_033_675_9;

/// A contact on a plate, given its solution on the half-space and how it is solved on a moving surface.
pub(crate) fn with_echo(
    (half_space, collision, settings): (&HalfSpace, &Collision, &Settings),
    mut run: Run,
    mut solve: impl FnMut(SurfaceMotion) -> Result<Run, ContactError>,
) -> Result<Run, ContactError> {
    let Some(plate) = half_space.echoing() else {
        return Ok(run);
    };
    let contact_s = run.results.contact_time_s;
    let echo_s = 2.0 * plate.thickness_m / half_space.longitudinal_speed_m_s();
    if contact_s <= echo_s {
        return Ok(run);
    }
    let fails = |reason: String| ContactError::EchoReturns {
        echo_s,
        contact_s,
        reason,
    };
    if let Some(reason) = unknown(&run, settings, &plate) {
        return Err(fails(reason));
    }
    for _ in 0..MOST_SOLUTIONS {
        let contact_s = run.results.contact_time_s;
        let mut block = half_space.clone();
        block.echoes = Some(Echoes::Until(contact_s));
        let motion = motion(&block, run.excitation(), (collision, settings.tolerance));
        let (motion, error_m_s) = motion.map_err(|error| fails(error.to_string()))?;
        let next = solve(motion)?;
        let change = largest_change(&run.results, &next.results);
        run = next;
        if change < LAST_CHANGE * settings.tolerance {
            // as if the surface were off in one direction during all of the contact
            let off = error_m_s * contact_s / run.results.peak_displacement_m;
            run.add_error(change + OF_INDENTATION * off);
            return Ok(run);
        }
    }
    Err(fails("its effect on the force does not settle".to_owned()))
}

/// The largest relative change of peak force, contact time and restitution.
fn largest_change(one: &Results, other: &Results) -> f64 {
    let of = |own: &Results| [own.peak_force_n, own.contact_time_s, own.restitution];
    let pairs = of(one).into_iter().zip(of(other));
    let changes = pairs.map(|(before, now)| (now / before - 1.0).abs());
    changes.fold(0.0, f64::max)
}

/// Why the echo of a contact is not known.
fn unknown(run: &Run, settings: &Settings, plate: &Echoing) -> Option<String> {
    let model = run.solved.chosen.model;
    if run.results.contact_time_s > plate.latest_s {
        return Some(format!(
            "lasts longer than the echoes can be computed, {:.3e} s: such a plate answers with its bending, not with waves that run across it",
            plate.latest_s
        ));
    }
    if run.solved.flow.is_some() {
        return Some(
            "yields, for which the effect of the echo is not known: set plasticity = \"none\""
                .to_owned(),
        );
    }
    let follows = !model.on_disc() && settings.disc_radius_m.is_none();
    let knows = match settings.model {
        Model::Auto => follows,
        named => follows && named.memory() == Memory::Full,
    };
    (!knows).then(|| {
        format!(
            "model \"{}\"{} does not know the echo: use model = \"growing\" without disc_radius_m",
            model.name(),
            if follows {
                ""
            } else {
                " on a disc of fixed radius"
            },
        )
    })
}

/// Motion of the upper face of a plate under a contact, by its echoes, and the error of its velocity in m/s.
fn motion(
    block: &HalfSpace,
    excitation: &Excitation,
    (collision, tolerance): (&Collision, f64),
) -> Result<(SurfaceMotion, f64), ImpactError> {
    let wanted = Wanted {
        tolerance,
        step_s: None,
        duration_s: Some(excitation.end_s()),
        frames: None,
        farthest_m: None,
        plate_s: None,
        low_pass_hz: None,
    };
    let source = KernelSource::direct(excitation.medium(), tolerance)?;
    let grid = Grid::new(&wanted, excitation, Some(&source))?;
    let all: Vec<usize> = (0..grid.count()).collect();
    let asked = (&[Quantity::VelocityZ][..], Some(block));
    let convolution = Convolution::new(&source, &grid, &all, asked, &|| {})?;
    let place_m = [MEAN * excitation.units().disc_radius_m, 0.0];
    let units = collision.units();
    let unit_m_s = units.length_m / units.time_s;
    let (samples, error_m_s) = match convolution.echo_velocity(place_m)? {
        Some(Trace { samples, error, .. }) => (samples, error),
        None => (Vec::new(), 0.0),
    };
    let motion = SurfaceMotion {
        step: grid.step_s / units.time_s,
        velocity: samples.iter().map(|v| v / unit_m_s).collect(),
    };
    Ok((motion, error_m_s))
}
