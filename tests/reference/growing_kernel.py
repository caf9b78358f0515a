"""Relaxation of a flat punch on a half-space, from Kausel's closed form for the point load.

W(T), T = c2 t/r0, is the response of the centre of a Hertz-loaded disc to a step (Kausel 2012, superposed
over the disc), evaluated with 34 digits.  The mean deflection under a flat punch of radius r0 follows from it:

    V_p(t) = V(y)/2 + (y/2) int_y^inf V(x)/x^2 dx,     y = t/2,     V = 1 - W

Nothing here is shared with the program, which integrates over slowness.
"""

import mpmath as mp
import numpy as np

mp.mp.dps = 34

NODES = 18  # Chebyshev nodes of a panel
HALVINGS = 24  # panels shrink so often toward a wave front


class Centre:
    """W(T) of a Poisson's ratio."""

    def __init__(self, nu):
        nu = mp.mpf(nu)
        self.a2 = (1 - 2 * nu) / (2 - 2 * nu)
        self.kappa = mp.sqrt(self.a2)
        a2 = self.a2
        roots = mp.polyroots([-16 * (1 - a2), 8 * (3 - 2 * a2), -8, 1], maxsteps=200, extraprec=200)
        roots.sort(key=lambda x: mp.re(x) if abs(mp.im(x)) < mp.mpf(10) ** -25 else -1)
        self.x3 = mp.re(roots[2])
        self.pair = roots[:2]
        self.t_r = mp.sqrt(self.x3)
        half = mp.mpf(1) / 2
        x1, x2 = self.pair
        self.a3 = (self.x3 - half) ** 2 * mp.sqrt(self.x3 - a2) / ((self.x3 - x1) * (self.x3 - x2))
        self.a3 = mp.re(self.a3)
        self.weights = [
            (xj - half) ** 2 * mp.sqrt(a2 - xj) / ((xj - xk) * (xj - self.x3))
            for xj, xk in ((x1, x2), (x2, x1))
        ]

    def i0(self, x):
        return (x * mp.sqrt(1 - x * x) + mp.asin(x)) / 2

    def i3(self, x, t):
        q = mp.sqrt(max(self.x3 * x * x - t * t, mp.mpf(0)))
        p = mp.sqrt(1 - x * x)
        arc = mp.asin(min(q / mp.sqrt(self.x3 - t * t), mp.mpf(1)))
        return q * p / (2 * self.x3) + (self.x3 - t * t) / (2 * self.x3 ** mp.mpf(1.5)) * arc

    def ij(self, x, t, xj):
        q = mp.sqrt(mp.mpc(t * t - xj * x * x))
        p = mp.sqrt(1 - x * x)
        root = mp.sqrt(mp.mpc(xj))
        return -q * p / (2 * xj) + (t * t - xj) / (2 * root**3) * mp.log(root * p + q)

    def step(self, t):
        """W(T), T in r0/c2."""
        t = mp.mpf(t)
        if t <= 0:
            return mp.mpf(0)
        if t >= self.t_r:
            return mp.mpf(1)
        one = mp.mpf(1)
        x_r, x_s, x_p = min(one, t / self.t_r), min(one, t), min(one, t / self.kappa)
        whole = self.i0(x_r)

        def outer(x):
            return self.i0(x) - self.a3 * self.i3(x, t)

        whole += outer(x_s) - outer(x_r)
        if x_p > x_s:
            inner = lambda x: mp.re(sum(w * self.ij(x, t, xj) for w, xj in zip(self.weights, self.pair)))
            whole += (outer(x_p) - outer(x_s) - inner(x_p) + inner(x_s)) / 2
        return 4 / mp.pi * whole


def panels(fronts):
    """Ends of panels on [0, last front], halving toward zero and to both sides of the fronts."""
    ends = [0.0]
    for low, high in zip([0.0, *fronts], fronts):
        middle = 0.5 * (low + high)
        width = middle - low
        ends += [low + width * 0.5**k for k in range(HALVINGS, -1, -1)]
        ends += [high - width * 0.5**k for k in range(1, HALVINGS + 1)]
        ends.append(high)
    return np.array(sorted(set(ends)))


def punch(nu):
    """Panel ends (time in a/c2) and Chebyshev coefficients of V_p on each; zero beyond the last."""
    centre = Centre(nu)
    kappa, t_r = float(centre.kappa), float(centre.t_r)
    ends = panels([kappa, 1.0, t_r])  # of y, in r0/c2
    angle = (np.arange(NODES) + 0.5) * np.pi / NODES
    x = np.cos(angle)
    basis = np.polynomial.chebyshev.chebvander(x, NODES - 1)
    inverse = np.linalg.inv(basis)
    tables = []
    beyond = 0.0
    for low, high in list(zip(ends, ends[1:]))[::-1]:
        y = 0.5 * (low + high) + 0.5 * (high - low) * x
        relaxation = np.array([float(1 - centre.step(v)) for v in y])
        # int V/x^2 in s = 1/x would be singular at zero: subtract V = 1 there
        first = low == 0.0
        smooth = (relaxation - 1.0) / (y * y) if first else relaxation / (y * y)
        if first:
            # 1 - V is like y: its integral over y^2 is a logarithm, taken by Gauss in log y
            tail = []
            for v in y:
                g, w = np.polynomial.legendre.leggauss(40)
                u = np.log(v) + (np.log(high) - np.log(v)) * 0.5 * (g + 1)
                xs = np.exp(u)
                vs = np.array([float(1 - centre.step(k)) for k in xs])
                tail.append(np.sum(0.5 * w * (np.log(high) - np.log(v)) * vs / xs))
            integral = np.array(tail)
        else:
            c = inverse @ smooth
            anti = np.polynomial.chebyshev.chebint(c) * 0.5 * (high - low)
            total = np.polynomial.chebyshev.chebval(1.0, anti)
            integral = total - np.polynomial.chebyshev.chebval(x, anti)
        value = 0.5 * relaxation + 0.5 * y * (integral + beyond)
        tables.append(inverse @ value)
        if not first:
            beyond += total - np.polynomial.chebyshev.chebval(-1.0, anti)
    return 2.0 * ends, np.array(tables[::-1]), kappa


if __name__ == "__main__":
    # values of Kausel's closed form that are known from elsewhere
    for nu, known in [
        (0.25, [(0.1, 0.09795187690274), (0.5, 0.4829324247467), (1.0, 0.924305551263), (1.05, 0.9666997726221)]),
        (0.30, [(0.1, 0.0971890924979), (0.5, 0.4834211245802), (1.0, 0.9334967005035), (1.05, 0.9754028581314)]),
    ]:
        centre = Centre(nu)
        for t, value in known:
            assert abs(float(centre.step(t)) - value) < 2e-13, (nu, t)
    ends, tables, kappa = punch(0.3)
    cheb = np.polynomial.chebyshev.chebval
    gap = max(abs(cheb(1.0, a) - cheb(-1.0, b)) for a, b in zip(tables, tables[1:]))
    print("largest jump between panels", gap, "start", cheb(-1.0, tables[0]), "last coefficients", np.abs(tables[:, -1]).max())
    area = sum(0.5 * (hi - lo) * sum(2 * c[k] / (1 - k * k) for k in range(0, NODES, 2)) for lo, hi, c in zip(ends, ends[1:], tables))
    print("area in a/c2", repr(area))
