//! The contact whose radius follows the load, to any accuracy.
//!
//! In Hertz's contact an increment of load is carried by a flat punch of the radius at that moment, and deflects both bodies
//! by du; the half-space gives its part phi of each increment not at once but as the punch's waves allow:
//!
//! ```text
//! d(t) = u(t) - phi int_0^t V_p((t - t') c1/a(t')) du(t'),     phi = E* (1 - nu^2)/E,     u = a^2
//! ```
//!
//! No radius is free, and no static part is counted twice.
//! Because du carries phi <= 1 of itself at most, the equation is well posed for every pair of materials; with increments
//! shaped like Hertz's pressure it would not be for phi > 2/3.
//!
//! It is turned into another one, whose terms are all smooth: the relaxation of a flat punch is a superposition of triangles over the slowness of its waves
//! ([`PunchWaves`](crate::PunchWaves)), V_p(t) = int (1 - t/X)_+ dmu, so that with du = 2 a da the memory integral can be done:
//!
//! ```text
//! d' = 2 (1 - phi) a a' + 2 phi int (a(t) - a(t_X))/X dmu,     t_X + X a(t_X) = t,     d'' = -(5/4) a^3
//! ```
//!
//! a the radius, X = 2 x tau the time in which a wave of slowness x crosses the unit contact.
//! t_X is when the wave left that has just crossed: a delay equation whose delays follow the solution.
//! For small X the bracket is a a' - X(..): a short memory is no special case, and nothing is summed over a past.
//! For phi = 1 the equation is algebraic in a, not ill-posed.
//!
//! a is analytic in time inside the contact, so it is a few polynomials (`equations`) of the root of the
//! time since the touch, then of the root of the time to the expected end; in the last part the time
//! is a polynomial of the root of the radius, which makes the end of contact a place that is known.
//! Both ends are layers that scale with themselves (a ~ phi tau); pieces get shorter toward them.
//! The integral over the waves is Gauss's rule of their measure, of 3 to 220 nodes as each piece needs.
//!
//! In reading order: `waves`, `equations` of a piece, solved at the `nodes` of its polynomials, and the `arrivals` of its
//! waves, `march` from piece to piece, on a `surface` that moves where echoes return, `checks` of the assumptions, `solved`, `work`; `dashpot` for the models in
//! closed form.
//! A contact that the surface strikes again, or whose waves overtake each other, is refused.
//! Measured against superposition in time of punches by another kernel formula (`tests/reference/growing.csv`).

pub(crate) mod arrivals;
pub(crate) mod checks;
pub(crate) mod dashpot;
pub(crate) mod equations;
pub(crate) mod march;
pub(crate) mod nodes;
pub(crate) mod quick;
pub(crate) mod solved;
pub(crate) mod surface;
pub(crate) mod work;
pub(crate) mod yielding;

use crate::accuracy::Accuracy;
use crate::error::MarchError;
use crate::growing::equations::March;
use crate::growing::solved::SolvedContact;
use crate::growing::surface::SurfaceMotion;
use crate::waves::punch::GrowingContact;
use halfspace::check;

/// Least and largest tolerance.
const TOLERANCES: [f64; 2] = [1e-11, 1e-2];

/// Error of a piece over the tolerance on the results, from a tolerance of 1e-5 on and below.
///
/// Where pieces are few a second attempt costs more than smaller errors.
const ERROR_OF_PIECE: [f64; 2] = [0.1, 0.3];
const COARSE_TOLERANCE: f64 = 1e-5;

/// Times that error where the first attempt has no end.
const COARSER_PIECES: f64 = 3.0;

/// Least error of a piece.
const FINEST_PIECE: f64 = 1e-11;

/// Attempts with finer pieces while the estimate exceeds the tolerance.
const ATTEMPTS: usize = 4;

/// Fraction of the estimate before above which a further attempt is not worth while.
const STUCK: f64 = 0.5;

/// Estimate over the tolerance up to which a result is returned where nothing finer is found.
///
/// The estimates are several times the errors, hundreds of times where phi is within 1e-4 of one; the result carries
/// them.
const LENIENT: f64 = 100.0;

/// Solves the impact of a striker on a contact whose radius follows the load.
///
/// Force, contact time, restitution and displacement meet `accuracy.tolerance` by their estimates; so do loss
/// and deflection, if they have a tolerance.
/// Near the limits of double precision (phi within 1e-3 of one and tolerances of 1e-8 and below) the estimates
/// may be up to a hundred times the tolerance.
/// Valid for target shares in (0, 1] and wave times up to a few collision times; all scenes of
/// `tests/growing.rs` are solved at 1e-4 to 1e-10.
///
/// ```
/// use contact::{Accuracy, GrowingContact, PunchWaves, solve_growing};
/// let waves = PunchWaves::new(&halfspace::Medium::new(0.3)?);
/// let contact = GrowingContact { waves: &waves, target_share: 0.5, wave_time: 0.03 };
/// let solved = solve_growing(&contact, &Accuracy::of_contact(1e-8, Some(1e-6)))?;
/// // by superposition in time (tests/reference/growing.py)
/// assert!((solved.summary.loss - 0.0562357185).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`MarchError`].
pub fn solve_growing(
    contact: &GrowingContact<'_>,
    accuracy: &Accuracy,
) -> Result<SolvedContact, MarchError> {
    solve_growing_on(contact, None, accuracy)
}

/// The same on a surface that moves of itself.
pub(crate) fn solve_growing_on(
    contact: &GrowingContact<'_>,
    surface: Option<&SurfaceMotion>,
    accuracy: &Accuracy,
) -> Result<SolvedContact, MarchError> {
    let (phi, tau) = (contact.target_share, contact.wave_time);
    check(phi > 0.0 && phi <= 1.0, "target_share", phi, "(0, 1]")?;
    check(tau > 0.0 && tau < 1e3, "wave_time", tau, "(0, 1000)")?;
    let [least, largest] = TOLERANCES;
    let parts = [Some(accuracy.tolerance), accuracy.loss, accuracy.deflection];
    let asked = parts.into_iter().flatten().fold(largest, f64::min);
    let mut piece = (ERROR_OF_PIECE[usize::from(asked < COARSE_TOLERANCE)] * asked.max(least))
        .max(FINEST_PIECE);
    let (mut best, mut before) = (None, f64::INFINITY);
    for attempt in 0..ATTEMPTS {
        let mut march = March::new(*contact, piece);
        march.surface = surface;
        let followed = march.load(f64::INFINITY).and_then(|()| march.close());
        let tried = followed.and_then(|()| checks::passed(SolvedContact::new(march), contact));
        match (tried, &best) {
            (Ok(solved), _) => {
                let (errors, of_contact) = (&solved.estimates, accuracy.tolerance.max(least));
                let contact = errors.contact() / of_contact;
                let excess = accuracy.excess(contact, errors.loss, errors.peak_deflection);
                if excess <= 1.0 {
                    return Ok(solved);
                }
                // finer pieces that hardly help cost seconds
                let stuck = piece <= FINEST_PIECE || excess > STUCK * before;
                if excess < before {
                    (best, before) = (Some(solved), excess);
                }
                if stuck {
                    break;
                }
                piece = (piece * (0.3 / excess).max(0.1)).max(FINEST_PIECE);
            }
            // pieces that are finer than the last instants allow
            (Err(MarchError::NotFollowed { .. }), None) if attempt == 0 => piece *= COARSER_PIECES,
            (Err(error), None) => return Err(error),
            // finer pieces than the last instants of a stiff striker allow
            (Err(_), Some(_)) => break,
        }
    }
    best.filter(|_| before <= LENIENT)
        .ok_or(MarchError::NotReached {
            tolerance: accuracy.tolerance,
            estimate: before * accuracy.tolerance,
        })
}
