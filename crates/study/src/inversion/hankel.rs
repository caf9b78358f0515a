//! The paper's transforms, and their Hankel quadrature: from (k, s) to step responses at (r, z) in the Laplace domain.
//!
//! Gauss-Legendre panels along the real k axis for Re s > 0.
//! The branch points and the Rayleigh pole lie at k = -i s times 1, 1/kappa and 1/c, below the path by Re s:
//! that distance and the oscillation of J(k r) Z_H(k) set the panels, and e^{-k z} sets the end.
//! For Re s <= 0, which only Talbot's contour needs, they have crossed the axis, and the path is raised above them.
//!
//! At z = 0 nothing decays along k. After the static deflection is subtracted, the load's e^{ik} and e^{-ik} are
//! separated beyond the singularities, and each is followed into the half-plane where it decays.
//!
//! The Laplace-Hankel transforms (22) to (29) of the paper, with the coefficient of (24) corrected to 4.
//!
//! ```text
//! alpha = sqrt(k^2 + s^2)   beta = sqrt(k^2 + s^2/kappa^2)   gamma = 2 k^2 + s^2/kappa^2   D = gamma^2 - 4 alpha beta k^2
//! w   = alpha (gamma e^{-alpha z} - 2 k^2 e^{-beta z})/D                                   times J0
//! u   = k (gamma e^{-alpha z} - 2 alpha beta e^{-beta z})/D                                times J1
//! szz = -(gamma^2 e^{-alpha z} - 4 alpha beta k^2 e^{-beta z})/D                           times J0
//! srz = 2 alpha gamma k (e^{-beta z} - e^{-alpha z})/D                                     times J1
//! srr = [gamma (2 k^2 - (lambda/mu) s^2) e^{-alpha z} - 4 alpha beta k^2 e^{-beta z}]/D    times J0,   - 2 u J1/(k r)
//! stt = -(lambda/mu) s^2 gamma e^{-alpha z}/D                                              times J0,   + 2 u J1/(k r)
//! ```
//!
//! Impulse responses under a unit force; a step response is one over s times them.
//! Units: mu = c1 = r0 = 1.

use halfspace::Medium;
use halfspace::gauss::Rule;
use num_complex::Complex64;
use std::cell::Cell;
use std::f64::consts::{LN_10, PI};

/// Step responses at one point as functions of the Laplace variable: the six fields inside, and only w over its static
/// value at the centre of the surface.
pub(crate) struct Hankel {
    medium: Medium,
    r: f64,
    z: f64,
    digits: f64,
    /// Slowness of the Rayleigh wave, the slowest.
    slowest: f64,
    /// 1/kappa^2.
    shear: f64,
    /// Gauss rule of a panel.
    rule: Rule,
    /// Number of integrand evaluations so far.
    pub(crate) evaluations: Cell<u64>,
}

/// A node on the real axis with the factors that do not depend on s: k, and the load's J0, J1, J1/(k r) times the
/// weight.
type Node = (f64, [f64; 3]);

impl Hankel {
    /// Accuracy in decimal digits.
    pub(crate) fn new(medium: &Medium, [r, z]: [f64; 2], digits: f64) -> Self {
        debug_assert!(z > 0.0 || r == 0.0, "on the surface only the centre");
        let [least, slope] = if z > 0.0 { [2.0, 1.2] } else { [3.0, 1.3] };
        Self {
            medium: medium.clone(),
            r,
            z,
            digits,
            slowest: 1.0 / medium.rayleigh_speed(),
            shear: 1.0 / (medium.kappa() * medium.kappa()),
            rule: Rule::new((least + slope * digits).ceil() as usize),
            evaluations: Cell::new(0),
        }
    }

    /// Step responses at many s with Im s >= 0, continued through the imaginary axis if one of them needs it.
    pub(crate) fn values(&self, s: &[Complex64]) -> Vec<[Complex64; 6]> {
        if self.z == 0.0 {
            let zero = Complex64::default();
            let fields = |&s| [zero, self.surface(s), zero, zero, zero, zero];
            return s.iter().map(fields).collect();
        }
        let least = s.iter().map(|s| s.re).fold(f64::INFINITY, f64::min);
        if least <= 0.0 {
            return s.iter().map(|&s| self.continued(s)).collect();
        }
        let widest = s.iter().map(|s| s.im.abs()).fold(0.0, f64::max);
        let nodes = self.nodes(least, widest);
        let at = |&s: &Complex64| {
            let end = s.im.abs() * self.slowest + self.reach() + 4.0 * s.re;
            let needed = nodes.iter().take_while(|(k, _)| *k <= end);
            let mut sum = [Complex64::default(); 6];
            for &(k, bessel) in needed {
                self.add(&mut sum, k.into(), s, bessel.map(Complex64::from));
            }
            sum.map(|v| v / s)
        };
        s.iter().map(at).collect()
    }

    /// k beyond which e^{-k z} has decayed.
    fn reach(&self) -> f64 {
        self.digits * LN_10 / self.z
    }

    /// Nodes for all s with Re s >= `least` and |Im s| <= `widest`.
    fn nodes(&self, least: f64, widest: f64) -> Vec<Node> {
        let last = widest * self.slowest;
        let end = last + self.reach() + 4.0 * least;
        let width = 3.5 / (1.0 + self.r);
        let mut nodes = Vec::new();
        let mut from = 0.0;
        while from < end {
            // the distance from the singularities grows beyond the last one
            let clear = least.hypot((from - last).max(0.0));
            let to = from + width.min(2.0 * clear);
            for (k, weight) in self.rule.on(from, to) {
                let scale = weight * load(k.into()).re;
                let x = k * self.r;
                let j1 = libm::j1(x);
                let ratio = if x < 1e-6 { 0.5 } else { j1 / x };
                nodes.push((k, [libm::j0(x), j1, ratio].map(|j| scale * j)));
            }
            from = to;
        }
        nodes
    }

    /// Step response at any s with Im s >= 0, continued through the imaginary axis.
    fn continued(&self, s: Complex64) -> [Complex64; 6] {
        let clearance = 1.0 / (1.0 + self.r);
        let end = s.im.abs() * self.slowest + self.reach();
        let (legs, widest) = path(s, self.slowest, clearance, end);
        let widths = [0.7 * s.norm(), widest.min(1.5 * clearance)];
        let mut sum = [Complex64::default(); 6];
        self.along(&legs, widths, |k, weight| {
            let scale = weight * load(k);
            let (x, is_small) = (k * self.r, k.norm() * self.r < 1e-6);
            let [j0, j1] = bessel(x);
            let ratio = if is_small { 0.5.into() } else { j1 / x };
            self.add(&mut sum, k, s, [j0, j1, ratio].map(|j| scale * j));
        });
        sum.map(|v| v / s)
    }

    /// Calls a function with every node k and its weight along straight parts of a path in the k plane, on panels of at
    /// most the width `widest`, and of at most `least` near the beginning of each part, where the singularities of k =
    /// 0 are as near as s.
    fn along(
        &self,
        legs: &[[Complex64; 2]],
        [least, widest]: [f64; 2],
        mut f: impl FnMut(Complex64, Complex64),
    ) {
        for [from, to] in legs {
            let length = (to - from).norm();
            let direction = (to - from) / length;
            let mut at = 0.0;
            while at < length * (1.0 - 1e-12) {
                let end = (at + least.max(0.5 * at).min(widest)).min(length);
                for (x, weight) in self.rule.on(at, end) {
                    f(from + direction * x, weight * direction);
                }
                at = end;
            }
        }
    }

    /// w at the centre of the surface over its static value, at any s with Im s >= 0, continued through the
    /// imaginary axis.
    pub(crate) fn surface(&self, s: Complex64) -> Complex64 {
        let rest = 1.0 - self.medium.poisson_ratio();
        let without_rest = |k: Complex64, [alpha, _, _, inverse]: Roots| {
            alpha * s * s * self.shear * inverse - rest / k
        };
        let (legs, widest) = path(s, self.slowest, 1.0, s.norm() * self.slowest + 4.0);
        let widths = [(0.7 * s.norm()).min(1.0), widest.min(2.0)];
        let mut sum = Complex64::default();
        self.along(&legs, widths, |k, weight| {
            sum += weight * (load(k) * without_rest(k, self.roots(k, s, above)));
        });
        // 3 (sin k - k cos k)/(2 pi k^2) = sum over both signs of e^{+-ik} (-+ i - k)/2 times 3/(2 pi k^2)
        let depth = self.digits * LN_10 + 2.0;
        let [_, [_, start]] = legs;
        for sign in [1.0, -1.0] {
            let i = Complex64::new(0.0, sign);
            self.along(&[[start, start + i * depth]], widths, |k, weight| {
                let half = 0.75 / PI * (i * k).exp() * (-i - k) / (k * k);
                sum += weight * (half * without_rest(k, self.roots(k, s, beyond)));
            });
        }
        (1.0 + sum / (0.375 * rest)) / s
    }

    /// The integrand at one (k, s), by a branch of the roots.
    fn roots(
        &self,
        k: Complex64,
        s: Complex64,
        root: impl Fn(Complex64, Complex64) -> Complex64,
    ) -> Roots {
        self.evaluations.update(|count| count + 1);
        let (alpha, beta) = (root(k, s), root(k, s * self.shear.sqrt()));
        let (k2, s2) = (k * k, s * s);
        let slow = s2 * self.shear;
        let gamma = 2.0 * k2 + slow;
        // gamma^2 - 4 k^4 and alpha beta - k^2 separately, without a difference of large numbers for k >> s
        let product = alpha * beta;
        let excess = (k2 * (s2 + slow) + s2 * slow) / (product + k2);
        let d = slow * (4.0 * k2 + slow) - 4.0 * k2 * excess;
        [alpha, beta, gamma, d.inv()]
    }

    /// Adds the fields of one k, in the order of [`halfspace::FIELDS`], from J0 and J1 times a weight, and J1/(k r) times
    /// it.
    fn add(
        &self,
        sum: &mut [Complex64; 6],
        k: Complex64,
        s: Complex64,
        [j0, j1, j1_over_kr]: [Complex64; 3],
    ) {
        let [alpha, beta, gamma, inverse] = self.roots(k, s, above);
        let k2 = k * k;
        let p = (-alpha * self.z).exp() * inverse;
        let q = (-beta * self.z).exp() * inverse;
        let cross = 4.0 * alpha * beta * k2 * q;
        let lame = self.medium.lambda_over_mu() * s * s;
        let u = k * (gamma * p - 2.0 * alpha * beta * q);
        let hoop = 2.0 * u * k * j1_over_kr;
        let terms = [
            u * j1,
            alpha * (gamma * p - 2.0 * k2 * q) * j0,
            (gamma * (2.0 * k2 - lame) * p - cross) * j0 - hoop,
            -lame * gamma * p * j0 + hoop,
            (cross - gamma * gamma * p) * j0,
            2.0 * alpha * gamma * k * (q - p) * j1,
        ];
        for (total, term) in sum.iter_mut().zip(terms) {
            *total += term;
        }
    }
}

/// alpha, beta, gamma and 1/D.
type Roots = [Complex64; 4];

/// sqrt(k^2 + s^2) on the correct branch for every k on a path that passes above the branch point -i s.
fn above(k: Complex64, s: Complex64) -> Complex64 {
    // by factors: the cut from -i s runs to the right below the path, the cut from i s to the left
    let i = Complex64::i();
    i * (-(k + i * s)).sqrt() * (k - i * s).sqrt()
}

/// sqrt(k^2 + s^2) for |k| beyond the last singularity, in any direction with Re k > 0.
fn beyond(k: Complex64, s: Complex64) -> Complex64 {
    k * (1.0 + (s / k) * (s / k)).sqrt()
}

/// J0 and J1 of a complex argument.
fn bessel(x: Complex64) -> [Complex64; 2] {
    if x.norm() < 1e-8 {
        return [1.0.into(), 0.5 * x];
    }
    [0.0, 1.0].map(|order| {
        complex_bessel::besselj(order, x).unwrap_or(Complex64::new(f64::INFINITY, 0.0))
    })
}

/// k Z_H(k) of Hertz's pressure, (30): 3 (sin k - k cos k)/(2 pi k^2).
fn load(k: Complex64) -> Complex64 {
    let scale = 1.5 / PI;
    if k.norm() < 0.1 {
        let k2 = k * k;
        return scale * k / 3.0 * (1.0 - k2 / 10.0 * (1.0 - k2 / 28.0 * (1.0 - k2 / 54.0)));
    }
    scale * (k.sin() - k * k.cos()) / (k * k)
}

/// A path in the k plane from 0 that passes above the singularities -i s x, x = 1 .. `slowest`, and to the
/// right of i s x, and leaves to the right as far as `end`: its two straight parts, the first along the imaginary axis,
/// and the widest panel that keeps away from the singularities.
fn path(s: Complex64, slowest: f64, clearance: f64, end: f64) -> ([[Complex64; 2]; 2], f64) {
    let (height, widest) = if s.im == 0.0 && s.re > 0.0 {
        (0.0, f64::INFINITY)
    } else if s.re > 0.25 * s.im {
        (0.0, 1.4 * s.re)
    } else {
        ((-s.re).max(0.0) * slowest + clearance, 1.5 * clearance)
    };
    let corner = Complex64::new(0.0, height);
    (
        [[Complex64::default(), corner], [corner, corner + end]],
        widest,
    )
}
