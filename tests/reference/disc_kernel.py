"""Relaxation of a disc on a half-space, from Kausel's closed form for the point load.

A point force deflects the surface at a distance R by (1 - nu)/(2 pi mu R) U(c2 t/R) (Kausel 2012).  Superposed over
the pressure Z(r) = 3/(2 pi) sqrt(1 - r^2) the deflection under a step is S0 W(t) with

    W(T) = int U(T/s) g(s) ds / int g(s) ds,     T = c2 t/r0

for the centre g(s) = sqrt(1 - s^2); for the mean weighted with the pressure g(s) = int Z(x) Z(x + s) d^2x, the
pressure's correlation with itself at the distance s, by quadrature over the lens of two discs.
S0 = (1 - nu) int g (with Z for the centre) is 3 (1 - nu)/8 and 3 (1 - nu)/10.

The energy that a force radiates follows from Im of the harmonic compliance: of the integral over wave numbers only
the running waves and the Rayleigh pole are left (`Admittance`).

Nothing here is shared with the program, which fits moments of a measure over slowness.
"""

import numpy as np

NODES = 18  # Chebyshev nodes of a panel
HALVINGS = 22  # panels shrink so often toward a wave front
GAUSS = np.polynomial.legendre.leggauss(20)


def graded(low, high, toward, halvings=18):
    """Nodes and weights of Gauss panels on [low, high] that halve toward its ends ("low", "high", "both")."""
    if high <= low:
        return np.empty(0), np.empty(0)
    width = high - low
    parts = [0.5**k for k in range(halvings, -1, -1)]
    if toward == "low":
        ends = [0.0, *parts]
    elif toward == "high":
        ends = [1.0 - x for x in [0.0, *parts]][::-1]
    else:
        ends = [0.0, *[0.5 * x for x in parts]]
        ends += [1.0 - x for x in ends[-2::-1]]
    ends = low + width * np.array(ends)
    x, w = GAUSS
    half = 0.5 * np.diff(ends)[:, None]
    return (0.5 * (ends[1:] + ends[:-1])[:, None] + half * x).ravel(), (half * w).ravel()


def correlation(s):
    """int Z(x) Z(x + s) d^2x for a distance s in (0, 2)."""
    # x = (xi + s/2, y); the disc that ends first bounds y = h sin(phi)
    xi, w_xi = graded(0.0, 1.0 - 0.5 * s, "both", 26)
    phi, w_phi = graded(0.0, 0.5 * np.pi, "high", 26)
    h2 = 1.0 - (xi + 0.5 * s) ** 2
    far = 2.0 * xi * s  # the other disc's h^2 less this one's
    c2 = np.cos(phi) ** 2
    inner = (np.sqrt(far[:, None] + h2[:, None] * c2) * c2) @ w_phi
    return (3 / (2 * np.pi)) ** 2 * 4.0 * np.sum(w_xi * h2 * inner)


class Correlation:
    """The same as Chebyshev panels over s: it has a logarithm at 0 and a half power at 2."""

    def __init__(self):
        ends = [0.0, *[0.5**k for k in range(14, -1, -1)]]
        ends += [2.0 - e for e in ends[-2::-1]]
        self.ends = np.array(ends)
        x = np.cos((np.arange(NODES) + 0.5) * np.pi / NODES)
        inverse = np.linalg.inv(np.polynomial.chebyshev.chebvander(x, NODES - 1))
        self.tables = []
        for low, high in zip(ends, ends[1:]):
            s = 0.5 * (low + high) + 0.5 * (high - low) * x
            self.tables.append(inverse @ np.array([correlation(v) for v in s]))
        self.tables = np.array(self.tables)

    def __call__(self, s):
        return panel_value(s, self.ends, self.tables)


def panel_value(t, ends, tables):
    """Value at t of Chebyshev series on panels."""
    t = np.asarray(t, dtype=float)
    k = np.clip(np.searchsorted(ends, t, side="right") - 1, 0, len(tables) - 1)
    x = (2.0 * t - ends[k] - ends[k + 1]) / (ends[k + 1] - ends[k])
    rows = tables[k]
    b1, b2 = np.zeros_like(t), np.zeros_like(t)
    for j in range(tables.shape[1] - 1, 0, -1):
        b1, b2 = 2.0 * x * b1 - b2 + rows[..., j], b1
    return x * b1 - b2 + rows[..., 0]


class PointLoad:
    """U(tau) of a Poisson's ratio, tau = c2 t/R."""

    def __init__(self, nu):
        self.a2 = a2 = (1 - 2 * nu) / (2 - 2 * nu)
        self.kappa = np.sqrt(a2)
        cubic = np.array([-16 * (1 - a2), 8 * (3 - 2 * a2), -8, 1])
        roots = np.roots(cubic).astype(complex)
        slope = np.polyder(cubic)
        for _ in range(3):
            roots = roots - np.polyval(cubic, roots) / np.polyval(slope, roots)
        roots = sorted(roots, key=lambda x: x.real if abs(x.imag) < 1e-9 else -1.0)
        self.x3 = roots[2].real
        self.pair = roots[:2]
        self.latest = np.sqrt(self.x3)
        x1, x2 = self.pair
        self.a3 = ((self.x3 - 0.5) ** 2 * np.sqrt(self.x3 - a2) / ((self.x3 - x1) * (self.x3 - x2))).real
        self.weights = [
            (xj - 0.5) ** 2 * np.sqrt(a2 - xj + 0j) / ((xj - xk) * (xj - self.x3)) for xj, xk in ((x1, x2), (x2, x1))
        ]

    def late(self, tau):
        """Between the shear and the Rayleigh wave, without its root: 1 - U = a3/sqrt(x3 - tau^2)."""
        return 1.0 - self.a3 / np.sqrt(self.x3 - tau * tau)

    def early(self, tau):
        """Between the longitudinal and the shear wave."""
        others = sum(a / np.sqrt(tau * tau - x + 0j) for a, x in zip(self.weights, self.pair)).real
        return 0.5 * (1.0 - self.a3 / np.sqrt(self.x3 - tau * tau) - others)


class Disc:
    """V = 1 - W of a disc as Chebyshev panels in time of r0/c2; zero beyond the last."""

    def __init__(self, nu, weight, support):
        self.load = PointLoad(nu)
        self.weight, self.support = weight, support
        # sqrt ends of the weight at the support are integrated as those of 1 - x^2
        self.total = self.moment(0.0, support)
        fronts = support * np.array([self.load.kappa, 1.0, self.load.latest])
        ends = [0.0]
        for low, high in zip([0.0, *fronts], fronts):
            middle, width = 0.5 * (low + high), 0.5 * (high - low)
            ends += [low + width * 0.5**k for k in range(HALVINGS, -1, -1)]
            ends += [high - width * 0.5**k for k in range(1, HALVINGS + 1)]
            ends.append(high)
        self.ends = np.array(sorted(set(ends)))
        self.fronts = fronts
        x = np.cos((np.arange(NODES) + 0.5) * np.pi / NODES)
        inverse = np.linalg.inv(np.polynomial.chebyshev.chebvander(x, NODES - 1))
        tables = []
        for low, high in zip(self.ends, self.ends[1:]):
            t = 0.5 * (low + high) + 0.5 * (high - low) * x
            tables.append(inverse @ np.array([1.0 - self.step(v) for v in t]))
        self.tables = np.array(tables)

    def moment(self, low, high):
        """int g over [low, high]."""
        s, w = graded(low, min(high, self.support), "both")
        return np.sum(w * self.weight(s)) if len(s) else 0.0

    def step(self, t):
        """W(T)."""
        load, top = self.load, self.support
        near, middle, far = (min(top, t / v) for v in (load.latest, 1.0, load.kappa))
        sum_ = self.moment(0.0, near)
        # from the Rayleigh to the shear wave: s = near + x^2 takes the root out
        if middle > near:
            x, w = graded(0.0, np.sqrt(middle - near), "both")
            s = near + x * x
            if near < top:
                # sqrt(x3 - (t/s)^2) = x sqrt(x3 (s + near))/s
                singular = load.a3 * s / np.sqrt(load.x3 * (s + near))
                sum_ += np.sum(w * 2 * self.weight(s) * (x - singular))
        if far > middle:
            s, w = graded(middle, far, "both")
            sum_ += np.sum(w * self.weight(s) * load.early(t / s))
        return sum_ / self.total

    def __call__(self, t):
        """V at times in r0/c2."""
        t = np.asarray(t, dtype=float)
        inside = t < self.ends[-1]
        return np.where(inside, panel_value(np.minimum(t, self.ends[-1]), self.ends, self.tables), 0.0)


CORRELATION = Correlation()


def disc(nu, deflection):
    """V of the centre or the mean."""
    if deflection == "centre":
        return Disc(nu, lambda s: np.sqrt(np.maximum((1 - s) * (1 + s), 0.0)), 1.0)
    return Disc(nu, CORRELATION, 2.0)


class Admittance:
    """-Im of the mean compliance at an angular frequency in c1/r0, in 1/(mu r0): positive."""

    def __init__(self, nu):
        self.k2 = k2 = (2 - 2 * nu) / (1 - 2 * nu)  # K
        root = np.sqrt(k2)
        fast, w_fast = graded(0.0, 1.0, "both", 22)
        slow, w_slow = graded(1.0, root, "both", 22)
        self.slowness = np.concatenate([fast, slow])
        self.parts = np.concatenate([w_fast * self.fast(fast), w_slow * self.slow(slow)])

        def rayleigh(p):
            return (2 * p * p - k2) ** 2 - 4 * p * p * np.sqrt(p * p - 1) * np.sqrt(p * p - k2)

        low, high = root, 10.0 * root
        for _ in range(200):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if rayleigh(middle) > 0 else (low, middle)
        p = self.pole = 0.5 * (low + high)
        a, b = np.sqrt(p * p - 1), np.sqrt(p * p - k2)
        slope = 8 * p * (2 * p * p - k2) - 8 * p * a * b - 4 * p**3 * (b / a + a / b)
        self.mass = np.pi * k2 * p * a / -slope

    def fast(self, p):
        """Density over slowness in (0, 1): P and S waves run."""
        root = np.sqrt((1 - p) * (1 + p))
        return self.k2 * p * root / ((2 * p * p - self.k2) ** 2 + 4 * p * p * root * np.sqrt(self.k2 - p * p))

    def slow(self, p):
        """The same in (1, sqrt(K)): only S waves run."""
        root = np.sqrt(self.k2)
        m2, y = (p - 1) * (p + 1), np.sqrt((root - p) * (root + p))
        return 4 * self.k2 * p**3 * m2 * y / ((2 * p * p - self.k2) ** 4 + 16 * p**4 * m2 * y * y)

    def coarse(self, n):
        """Slownesses and masses, the pole's too, with n nodes of Gauss in the angle of each interval."""
        x, w = np.polynomial.legendre.leggauss(n)
        angle, w = 0.25 * np.pi * (1 + x), 0.25 * np.pi * w
        fast = np.sin(angle)
        slow = np.sqrt(1 + (self.k2 - 1) * fast**2)
        parts = [w * np.cos(angle) * self.fast(fast), w * (self.k2 - 1) * fast * np.cos(angle) / slow * self.slow(slow)]
        return np.concatenate([fast, slow, [self.pole]]), np.concatenate([*parts, [self.mass]])

    def __call__(self, omega):
        sum_ = np.array([np.sum(self.parts * transform(w * self.slowness) ** 2) for w in omega])
        return 2 * np.pi * omega * (sum_ + self.mass * transform(omega * self.pole) ** 2)


def transform(k):
    """Z_H(k) = 3/(2 pi) (sin k - k cos k)/k^3."""
    k = np.asarray(k, dtype=float)
    small = k < 0.05
    safe = np.where(small, 1.0, k)
    far = 3 / (2 * np.pi) * (np.sin(safe) - safe * np.cos(safe)) / safe**3
    near = (1 - k * k / 10 + k**4 / 280 - k**6 / 15120) / (2 * np.pi)
    return np.where(small, near, far)


if __name__ == "__main__":
    from growing_kernel import Centre

    total = Disc(0.25, CORRELATION, 2.0).total
    print("static factor 4/5: int of the correlation over 3/10", total / 0.3 - 1, "C(0) over 9/(8 pi)", float(CORRELATION(1e-9)) * 8 * np.pi / 9 - 1)
    for nu in (0.0, 0.25, 0.3, 0.45):
        centre, exact = disc(nu, "centre"), Centre(nu)
        error = max(abs(float(1 - exact.step(t)) - float(centre(t))) for t in np.linspace(0.003, 1.15, 60))
        mean = disc(nu, "mean")
        h = 1e-4
        # S0 W' at zero is kappa^2 int Z^2 = kappa^2 9/(8 pi), T = kappa t c1/r0
        slope = (1 - float(mean(h))) / h * 0.3 * (1 - nu) * mean.load.kappa
        print("nu", nu, "centre against the closed form", error, "slope of the mean over kappa^2 9/(8 pi)", slope / (mean.load.kappa**2 * 9 / (8 * np.pi)) - 1)
        # int (1 - W) dt S0 is the same for any load, and -Im C/omega tends to it
        area = {}
        for kind, s0 in (("centre", 0.375), ("mean", 0.3)):
            d = disc(nu, kind)
            ends, tables = d.ends, d.tables
            parts = [0.5 * (b - a) * sum(2 * c[k] / (1 - k * k) for k in range(0, NODES, 2)) for a, b, c in zip(ends, ends[1:], tables)]
            area[kind] = s0 * (1 - nu) * sum(parts)
        slow = Admittance(nu)(np.array([1e-3]))[0] / 1e-3
        print("   J centre, mean, Im C: ", area["centre"], area["mean"] / area["centre"] - 1, slow * mean.load.kappa / area["centre"] - 1)
