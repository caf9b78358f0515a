//! Gauss-Legendre rules on [0, 1] and local polynomials on equidistant nodes.

/// Node and weight pairs of the 4-point rule on [0, 1]; exact to degree 7.
///
/// Constants, not `halfspace::gauss`, whose rules are made at run time: sums over them are inlined.
pub(crate) const GAUSS_4: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// Node and weight pairs of the 8-point rule on [0, 1]; exact to degree 15.
pub(crate) const GAUSS_8: [(f64, f64); 8] = [
    (0.019_855_071_751_231_884, 0.050_614_268_145_188_13),
    (0.101_666_761_293_186_63, 0.111_190_517_226_687_24),
    (0.237_233_795_041_835_5, 0.156_853_322_938_943_64),
    (0.408_282_678_752_175_1, 0.181_341_891_689_181),
    (0.591_717_321_247_825, 0.181_341_891_689_181),
    (0.762_766_204_958_164_5, 0.156_853_322_938_943_64),
    (0.898_333_238_706_813_4, 0.111_190_517_226_687_24),
    (0.980_144_928_248_768_1, 0.050_614_268_145_188_13),
];

/// The cubic on [0, 1] with these values and slopes at its ends, at x.
#[inline]
pub(crate) fn hermite([v0, s0]: [f64; 2], [v1, s1]: [f64; 2], x: f64) -> f64 {
    let rise = v1 - v0;
    let cubic = s0 + s1 - 2.0 * rise;
    v0 + x * (s0 + x * (rise - s0 - cubic + x * cubic))
}

/// The quintic on [0, 1] with these values, slopes and curvatures at its ends: its own at x.
#[inline]
pub(crate) fn quintic([v0, a, bend0]: [f64; 3], [v1, s1, bend1]: [f64; 3], x: f64) -> [f64; 3] {
    let b = 0.5 * bend0;
    let (rise, tilt, turn) = (v1 - v0 - a - b, s1 - a - bend0, 0.5 * (bend1 - bend0));
    let c = 10.0 * rise - 4.0 * tilt + turn;
    let d = -15.0 * rise + 7.0 * tilt - 2.0 * turn;
    let e = 6.0 * rise - 3.0 * tilt + turn;
    [
        v0 + x * (a + x * (b + x * (c + x * (d + x * e)))),
        a + x * (2.0 * b + x * (3.0 * c + x * (4.0 * d + x * 5.0 * e))),
        2.0 * b + x * (6.0 * c + x * (12.0 * d + x * 20.0 * e)),
    ]
}

/// The integral of f by one of these rules.
pub(crate) fn gauss(rule: &[(f64, f64)], from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
    let width = to - from;
    width
        * rule
            .iter()
            .map(|&(x, weight)| weight * f(from + x * width))
            .sum::<f64>()
}

/// Panels of [`in_panels`].
const PANELS: u8 = 4;

/// The integral of f by the 8-point rule in four panels.
pub(crate) fn in_panels(from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
    let width = (to - from) / f64::from(PANELS);
    let starts = (0..PANELS).map(|i| from + f64::from(i) * width);
    starts
        .map(|start| gauss(&GAUSS_8, start, start + width, &f))
        .sum()
}

/// A polynomial through N values at x = 0, 1, .., N - 1 in Newton's form.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LocalPolynomial<const N: usize> {
    /// Forward differences over k!.
    differences: [f64; N],
}

impl<const N: usize> LocalPolynomial<N> {
    pub(crate) fn new(values: [f64; N]) -> Self {
        let mut differences = values;
        for k in 1..N {
            for i in (k..N).rev() {
                differences[i] = (differences[i] - differences[i - 1]) / k as f64;
            }
        }
        Self { differences }
    }

    /// Through `N` samples of `samples` that start at `from`.
    pub(crate) fn at(samples: &[f64], from: usize) -> Self {
        Self::new(std::array::from_fn(|i| samples[from + i]))
    }

    pub(crate) fn value(&self, x: f64) -> f64 {
        self.jet(x)[0]
    }

    /// Value, slope and half the curvature.
    pub(crate) fn jet(&self, x: f64) -> [f64; 3] {
        let mut jet = [self.differences[N - 1], 0.0, 0.0];
        for k in (0..N - 1).rev() {
            let factor = x - k as f64;
            jet[2] = jet[2] * factor + jet[1];
            jet[1] = jet[1] * factor + jet[0];
            jet[0] = jet[0] * factor + self.differences[k];
        }
        jet
    }

    /// The zero of the polynomial in [from, to], by bisection-guarded Newton; the ends must differ in sign.
    pub(crate) fn root(&self, from: f64, to: f64) -> f64 {
        find_root(|x| self.jet(x), from, to)
    }
}

/// A zero of f (value, slope and whatever follows) between two places of different sign.
pub(crate) fn find_root<const N: usize>(f: impl Fn(f64) -> [f64; N], from: f64, to: f64) -> f64 {
    let sign = if f(from)[0] < 0.0 { 1.0 } else { -1.0 };
    let rising = |x: f64| f(x).map(|part| sign * part);
    rising_root(rising, [from, to], 0.5 * (from + to), 1e-15)[1]
}

/// A zero of a rising function (value, slope and whatever follows) in [low, high] by Newton's method from `start`, with bisection where
/// that leaves the bracket: the place before the last step, and the one after it.
///
/// It ends with a step below [`CLOSE`], or with a bisection below `least`.
pub(crate) fn rising_root<const N: usize>(
    f: impl Fn(f64) -> [f64; N],
    [mut low, mut high]: [f64; 2],
    start: f64,
    least: f64,
) -> [f64; 2] {
    let mut places = [start; 2];
    for _ in 0..60 {
        let place = places[1];
        let now = f(place);
        if now[0] < 0.0 {
            low = place;
        } else {
            high = place;
        }
        let newton = place - now[0] / now[1];
        let inside = newton >= low && newton <= high;
        let next = if inside { newton } else { 0.5 * (low + high) };
        places = [place, next];
        if (next - place).abs() < if inside { CLOSE } else { least } {
            break;
        }
    }
    places
}

/// Newton's step after which the next is below the last digit of a number of about one.
pub(crate) const CLOSE: f64 = 3e-8;

/// The first of the largest samples, and it; four lanes at a time.
fn largest(samples: &[f64]) -> (usize, f64) {
    let mut lanes = [f64::NEG_INFINITY; 4];
    let (fours, rest) = samples.as_chunks::<4>();
    for four in fours {
        for (lane, &value) in lanes.iter_mut().zip(four) {
            *lane = if value > *lane { value } else { *lane };
        }
    }
    let largest = lanes
        .iter()
        .chain(rest)
        .fold(f64::NEG_INFINITY, |a, &b| a.max(b));
    match samples.iter().position(|&value| value == largest) {
        Some(place) => (place, largest),
        None => (0, samples.first().copied().unwrap_or(0.0)),
    }
}

/// Place (in steps) and value of the largest of equidistant samples, interpolated through five of them.
pub(crate) fn peak(samples: &[f64]) -> (f64, f64) {
    let (best, largest) = largest(samples);
    if samples.len() < 5 {
        return (best as f64, largest);
    }
    let from = best.saturating_sub(2).min(samples.len() - 5);
    let (local, centre) = (
        LocalPolynomial::<5>::at(samples, from),
        (best - from) as f64,
    );
    let [low, high] = [(centre - 1.0).max(0.0), (centre + 1.0).min(4.0)];
    let slope = |x: f64| {
        let [_, slope, half_curvature] = local.jet(x);
        [slope, 2.0 * half_curvature]
    };
    // where the slope changes sign, else the larger end
    let place = if slope(low)[0] > 0.0 && slope(high)[0] < 0.0 {
        find_root(slope, low, high)
    } else if local.value(low) > local.value(high) {
        low
    } else {
        high
    };
    (from as f64 + place, local.value(place))
}

#[cfg(test)]
mod tests {
    use super::*;
    use halfspace::gauss::rule;

    #[test]
    fn the_constants_are_the_rules_of_gauss_and_legendre() {
        for constants in [&GAUSS_4[..], &GAUSS_8[..]] {
            let exact = rule(constants.len()).on(0.0, 1.0);
            for (&(x, weight), (node, of_node)) in constants.iter().zip(exact) {
                assert!((x - node).abs() < 1e-15 && (weight - of_node).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn rules_integrate_their_degree() {
        for (degree, rule) in [(7, &GAUSS_4[..]), (15, &GAUSS_8[..])] {
            for k in 0..=degree {
                let sum: f64 = rule.iter().map(|&(x, w)| w * x.powi(k)).sum();
                assert!((sum * f64::from(k + 1) - 1.0).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn a_cubic_is_met_by_its_ends() {
        let f = |x: f64| 0.3 - x + 2.0 * x * x - 1.5 * x * x * x;
        let slope = |x: f64| -1.0 + 4.0 * x - 4.5 * x * x;
        for x in [0.0, 0.3, 1.0] {
            let found = hermite([f(0.0), slope(0.0)], [f(1.0), slope(1.0)], x);
            assert!((found - f(x)).abs() < 1e-14);
        }
    }

    #[test]
    fn a_local_polynomial_is_exact() {
        let f = |x: f64| 1.0 - 2.0 * x + 0.5 * x * x - 0.25 * x.powi(3) + 0.125 * x.powi(4);
        let local = LocalPolynomial::<5>::new(std::array::from_fn(|i| f(i as f64)));
        let [value, slope, _] = local.jet(1.7);
        assert!((value - f(1.7)).abs() < 1e-13);
        let expected = -2.0 + 1.7 - 0.75 * 1.7 * 1.7 + 0.5 * 1.7_f64.powi(3);
        assert!((slope - expected).abs() < 1e-12);
        assert!(f(local.root(0.0, 1.0)).abs() < 1e-14);
    }

    #[test]
    fn the_peak_lies_between_samples() {
        let samples: Vec<f64> = (0..40).map(|i| (0.1 * f64::from(i)).sin()).collect();
        let (place, value) = peak(&samples);
        assert!((0.1 * place - std::f64::consts::FRAC_PI_2).abs() < 1e-5);
        assert!((value - 1.0).abs() < 1e-8);
    }
}
