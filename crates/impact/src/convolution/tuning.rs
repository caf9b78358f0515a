//! The numbers of the fields that were chosen: each with its meaning, the range in which it serves, and what was measured
//! outside it. Where no test is named, none fails: the number moves time, or the width of an estimate, and only
//! `numbers::tests` sees it.
//!
//! Lengths are over the largest radius of contact, times over the time a/c_R that a Rayleigh wave takes over it. chi is a/c_R
//! over the duration of the contact: 1/1000 for steel balls that roll, 1/200 for most impacts, 1/20 for rubber.

/// Discs for each digit of the tolerance away from the contact and inside it, of the kernels that are computed: 3 and 6 at
/// 1e-4. More lose digits to kernels of small discs, fewer leave smooth waves (`scripts/check-close`).
pub(crate) const DISCS_A_DIGIT: [f64; 2] = [0.75, 1.5];

/// Two discs serve between fronts where chi^2 over the distance is below this fraction of the tolerance: their error is about
/// ten times chi^2 over the distance (`scripts/check-close`).
pub(crate) const TWO_SERVE: f64 = 0.03;

/// One disc alone, of the radius [`SMALLEST_FAR`], serves outside the contact where chi^2 is below this fraction of the
/// tolerance; for rates ten times chi^2. At 0.03 errors of 1 in 100 fields are 3 times the tolerance
/// (`scripts/check-close 20 1e-3`); with the largest radius those at fronts near the surface are 4 times a tolerance of 1e-2.
pub(crate) const ONE_SERVES: f64 = 0.01;

/// Discs more for rates of the fields, which have shorter waves; `rates_of_growing_contacts_are_within_their_estimates` fails
/// at 0.
pub(crate) const MORE_FOR_RATES: usize = 2;

/// Distance up to which a point has the discs of the inside: beyond it the contact's edge does not pass. At 0.3 errors are the
/// same at 1e-4 and estimates a twentieth narrower.
pub(crate) const INSIDE: f64 = 1.2;

/// Radius of the smallest disc, from 0.02 to 0.1: it stands for the first and last instants.
/// `velocities_are_within_their_estimates_of_a_finer_output` fails at 0.4.
pub(crate) const SMALLEST: f64 = 0.04;

/// Error of looked-up fields by the waves of the first and last instants that are shorter than the discs, over the largest of
/// their kind and the fraction of the largest force that a contact reaches while a Rayleigh wave crosses the radius: of nine
/// fields in ten, by which a table is chosen; at most, over the squared radius of the smallest disc; and at most at shallow
/// points, where few samples right at a front have it. `scripts/measure-lookups` counts errors above their estimates: none of 3,251
/// fields and velocities (`--scenes 210 --seed 42`).
pub(crate) const LOOKED_UP_MOSTLY: f64 = 0.3;
pub(crate) const LOOKED_UP_DEEP: f64 = 2.0;
pub(crate) const LOOKED_UP_SHALLOW: f64 = 12.0;

/// The same of waves that are shorter than a cell, over the fraction of the force that is reached within it.
pub(crate) const LOOKED_UP_CELLS: f64 = 0.05;

/// Distance from which on the waves of a contact nearly cancel: kernels of small discs lose digits, so that the smallest has
/// this radius, and kernels of several discs have this tolerance over that of the fields (`far_away_few_discs_are_enough`).
pub(crate) const FAR: f64 = 30.0;
pub(crate) const SMALLEST_FAR: f64 = 0.25;
pub(crate) const KERNELS_FAR: f64 = 0.03;

/// Discs for each digit of the tolerance where kernels are looked up, and smallest radii of which the first is taken that the
/// table has at the point (`scripts/measure-lookups`).
pub(crate) const LOOKED_UP_A_DIGIT: f64 = 0.75;
pub(crate) const COVERED: [f64; 4] = [0.2, 0.4, 0.6, 0.8];

/// Error of a disc alone that stands for a growing contact, over the field, times the squared distance.
pub(crate) const ONE_DISC: f64 = 2.0;

/// Tolerance of the kernels over that of the fields, at most 3e-3 of the peak: a coarser series says little of its error.
/// From 0.1 to 0.5 the errors of the fields are the same, at 4 twice as large in the median (`scripts/check-close`); below 0.5
/// estimates of other parts dominate.
pub(crate) const KERNELS: f64 = 0.5;
pub(crate) const COARSEST: f64 = 3e-3;

/// Tolerance of the weights of attenuation over that of the fields: a tenth of that of the kernels, since nodes are cheap
/// (`damped_fields_are_those_of_spectra`).
pub(crate) const DAMPED: f64 = 0.05;

/// Error of few discs between fronts, over chi^(3/2) times the peak of a field, and of rates over chi^(1/2): where it is
/// above the tolerance, samples near fronts of the first and last instants are integrated.
/// `rates_of_growing_contacts_are_within_their_estimates` fails at 1e-6.
pub(crate) const BETWEEN_FRONTS: f64 = 0.15;

/// Error at a distance x from a front, times x, over chi^(3/2): of fronts deep below the surface, and of those of shear and
/// Rayleigh's waves in depths below so many distances from the axis. `far_away_few_discs_are_enough` fails at 0.
pub(crate) const AT_FRONT: [f64; 2] = [0.02, 0.3];
pub(crate) const SHALLOW: f64 = 0.3;

/// The most by which a front of a small contact is followed.
pub(crate) const WIDEST_FRONT: f64 = 0.5;

/// Distance up to which a point is close, and chi over the distance, at a tolerance of 1e-3, above which no discs serve there
/// and all of the past is integrated; it falls as this power of the tolerance.
/// `discs_agree_with_frequency_and_wavenumber_integrals` fails with a distance of 1 and with a chi of 0.4.
pub(crate) const CLOSE: f64 = 4.0;
pub(crate) const FAST: f64 = 0.04;
pub(crate) const FAST_POWER: f64 = 0.3;

/// Fraction of the tolerance below which the error of a cell's parabola is accepted; a tenth of it for each difference.
pub(crate) const ACCEPTED: f64 = 0.5;

/// Fields smaller than this fraction of the largest of their kind are not resolved on their own: tractions vanish at the
/// surface.
pub(crate) const SMALL_FIELD: f64 = 1e-4;

/// Residual of a cell from which on it is part of a zone, over the tolerance of the steepest rise, and parts of a zone.
pub(crate) const UNRESOLVED: f64 = 0.02;
pub(crate) const MOST_PARTS: usize = 16;

/// Residual of a cell of a zone below which it is left out of the bound on what cells leave, over the tolerance of the load: a
/// zone has up to a hundred cells, whose residuals fall quickly. It saves time.
pub(crate) const SHARP: f64 = 3e-5;

/// Parts of a cell of a zone in which its residual is summed over the cells of a table, at most.
pub(crate) const PARTS: usize = 16;

/// Error of a residual summed over parts of a cell, over its rises in them times the changes of the kernel to both sides
/// (`scripts/measure-lookups`).
pub(crate) const WITHIN_PARTS: f64 = 0.5;

/// Rise of the force that the integrals over a zone may lose, over its largest over a cell.
/// `velocities_are_within_their_estimates_where_a_cut_pressure_opens` fails at 3e3.
pub(crate) const LOST: f64 = 3e-3;

/// Error of an integral over a zone, and of the sum of the last terms of an integral over the past, in tolerances.
/// `velocities_are_within_their_estimates_where_a_cut_pressure_opens` fails at 0.5.
pub(crate) const QUADRATURE: f64 = 0.7;
pub(crate) const LAST_TERMS: f64 = 3.0;

/// Ratio of the error of a kernel at an instant to its estimate, which is for convolutions; 3.2 was seen.
pub(crate) const AT_INSTANTS: f64 = 4.0;

/// Slopes and bends of a force that are left to the differences of its samples: fraction of the largest sample, and of the
/// error of the force.
pub(crate) const NEGLIGIBLE_SLOPE: f64 = 1e-9;
pub(crate) const NEGLIGIBLE_OF_ERROR: f64 = 1e-3;

/// Fraction of the force over which a static field is differenced; it is a smooth function of the force.
pub(crate) const STATIC_DIFFERENCE: f64 = 1e-4;

/// Largest error of a force over its peak, over that of the results of its contact; 1.2 was seen (`scripts/measure-lookups --scenes 210 --seed 42`).
pub(crate) const FORCE_OVER_RESULTS: f64 = 1.3;

/// Sensitivity of a rate to the tolerance of the history. Three of `tests/rates.rs` fail at 0.
pub(crate) const RATE_OF_TOLERANCE: f64 = 4.0;

/// Samples of loads on discs that are held at most.
pub(crate) const MOST_HELD: usize = 1 << 24;
