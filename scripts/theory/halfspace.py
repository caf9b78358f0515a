"""Formulas of docs/theory.md, sections 1 to 3, in the form of that document.

Reduced units: length r0, speed c1, time r0/c1, displacement P/(mu r0), stress P/r0^2.
"""

import numpy as np

FIELDS = ("u", "w", "srr", "stt", "szz", "srz")


class Medium:
    """(T1) and (T11)."""

    def __init__(self, nu):
        self.nu = nu
        self.K = (2 - 2 * nu) / (1 - 2 * nu)
        self.kappa = self.K**-0.5
        self.lame = 2 * nu / (1 - 2 * nu)
        a2 = 1 / self.K
        roots = np.roots([-16 * (1 - a2), 8 * (3 - 2 * a2), -8, 1])
        self.roots = sorted(roots, key=lambda x: (abs(x.imag) < 1e-9) * x.real)
        self.x3 = float(self.roots[-1].real)
        self.c = (a2 / self.x3) ** 0.5

    def rayleigh(self, w):
        """D(iw) for w <= kappa."""
        v = w * w * self.K
        return (2 - v) ** 2 - 4 * np.sqrt((1 - w * w) * (1 - v))

    def slope(self):
        """D'(c)."""
        c, K = self.c, self.K
        a, b = (1 - c * c) ** 0.5, (1 - c * c * K) ** 0.5
        return 4 * c * (b / a + K * a / b - K * (2 - c * c * K))


# ------------------------------------------------------------------ load profiles (T4)

PRESSURE = {
    "hertz": lambda r: 1.5 / np.pi * np.sqrt(1 - r * r),
    "punch": lambda r: 0.5 / np.pi / np.sqrt(1 - r * r),
}
HANKEL = {
    "hertz": lambda k: 1.5 / np.pi * (np.sin(k) - k * np.cos(k)) / k**3,
    "punch": lambda k: 0.5 / np.pi * np.sin(k) / k,
    "point": lambda k: 0.5 / np.pi + 0 * k,
}
CHORD = {
    "hertz": lambda s: 0.375 / np.pi * (1 - s * s),
    "punch": lambda s: 0.25 / np.pi + 0 * s,
}


# ------------------------------------------------------------------ potentials (T12) to (T14)


def end(zeta, r):
    """zeta, rho and L of (T13)."""
    rho = np.sqrt(zeta + 1j * r) * np.sqrt(zeta - 1j * r)
    return zeta, rho, np.log(zeta + rho)


def chain_e(n, zeta, r):
    """E_n of (T13)."""
    z, rho, log = end(zeta, r)
    return {
        -1: lambda: z / rho**3,
        0: lambda: 1 / rho,
        1: lambda: -log,
        2: lambda: z * log - rho,
        3: lambda: 0.75 * z * rho + (0.25 * r * r - 0.5 * z * z) * log,
    }[n]()


def chain_f(n, zeta, r):
    """F_n/r of (T13)."""
    z, rho, log = end(zeta, r)
    total = rho + z
    return {
        -1: lambda: 1 / rho**3,
        0: lambda: 1 / (rho * total),
        1: lambda: 1 / total,
        2: lambda: -0.5 * (z / total + log),
        3: lambda: 0.5 * ((rho * rho + rho * z + z * z) / (3 * total) + z * log - rho),
    }[n]()


def potential(chain, n, profile, xi, r):
    """A_n (chain_e) or B_n/r (chain_f) of (T14)."""
    half = lambda m: (chain(m, xi - 1j, r) - chain(m, xi + 1j, r)) / 2j
    if profile == "hertz":
        return 1.5 / np.pi * (half(n) - 0.5 * (chain(n - 1, xi - 1j, r) + chain(n - 1, xi + 1j, r)))
    if profile == "punch":
        return 0.5 / np.pi * half(n - 2)
    return 0.5 / np.pi * chain(n - 3, xi, r)


def potentials(profile, xi, r):
    """A3, A2, B3/r, B2/r."""
    return [potential(f, n, profile, xi, r) for f in (chain_e, chain_f) for n in (3, 2)]


# ------------------------------------------------------------------ amplitudes (T7) and fields


def amplitudes(medium, q2, a, b):
    """Numerators N of P and S for (w, u, szz, srz, srr, stt)."""
    g = 2 + q2 * medium.K
    lame = medium.lame * q2
    p = (a * g, g, -g * g, -2 * a * g, g * (2 - lame), -lame * g)
    s = (-2 * a, -2 * a * b, 4 * a * b, 2 * a * g, -4 * a * b, 0 * a)
    return p, s


def combine(n, psi, r):
    """The six fields of one wave, in the order of FIELDS."""
    w, u, zz, rz, rr, tt = n
    a3, a2, g3, g2 = psi
    return np.stack([u * g3 * r, w * a3, rr * a2 - 2 * u * g3, tt * a2 + 2 * u * g3, zz * a2, rz * g2 * r])


def rayleigh_denominator(medium, q2, a, b):
    """D of (T7)."""
    return (2 + q2 * medium.K) ** 2 - 4 * a * b


# ------------------------------------------------------------------ quadrature


def double_exponential(n=50, reach=3.4):
    """Nodes in (0, 1), their distances from 1, and weights of the tanh-sinh rule."""
    t = np.linspace(-reach, reach, 2 * n + 1)
    g = np.pi * np.sinh(t)
    near, far = 1 / (1 + np.exp(-g)), 1 / (1 + np.exp(g))
    return near, far, (t[1] - t[0]) * np.pi * np.cosh(t) * near * far


RULE = double_exponential()


def on_panels(breaks, rule=RULE):
    """Nodes and weights between neighbouring breaks."""
    near, far, weight = rule
    nodes, weights = [], []
    for low, high in zip(breaks, breaks[1:]):
        if high - low < 1e-13 * high:
            continue
        nodes.append(np.where(near < 0.5, low + (high - low) * near, high - (high - low) * far))
        weights.append((high - low) * weight)
    return np.concatenate(nodes), np.concatenate(weights)


def fronts(medium, r, z, t, radius):
    """Slownesses at which an edge is felt, (T18), by the quadratic for the half-angle."""
    found = []
    for slowness in (1.0, medium.K**0.5):
        for sense in (-1.0, 1.0):
            time = sense * t / slowness
            for e in {radius + r, abs(radius - r), -radius - r, -abs(radius - r)}:
                for u in np.roots([time - z, -2 * e, z + time]):
                    if abs(u.imag) < 1e-9 and u.real > 0:
                        found.append(slowness * 2 * u.real / (1 + u.real**2))
    return found


# ------------------------------------------------------------------ static field (T15) and remainder (T10), (T16)


def static(medium, profile, r, z):
    """(T15)."""
    nu = medium.nu
    a3, a2, g3, g2 = (v.real for v in potentials(profile, complex(z), r))
    a1, g1 = (potential(f, 1, profile, complex(z), r).real for f in (chain_e, chain_f))
    hoop = 0.5 * (z * g2 - (1 - 2 * nu) * g3)
    w = (1 - nu) * a3 + 0.5 * z * a2
    return np.array([hoop * r, w, -a2 + z * a1 - 2 * hoop, -2 * nu * a2 + 2 * hoop, -(a2 + z * a1), -z * g1 * r])


def remainder(medium, profile, r, z, t, split=1):
    """R of (T10), with x = 1/w of (T16), whole potentials above x = 1 and compact ones below."""
    radius = 0.0 if profile == "point" else 1.0
    c, K = medium.c, medium.K
    q2 = -c * c
    a, b = (1 - c * c) ** 0.5, (1 - c * c * K) ** 0.5
    total = np.zeros(6)
    for n, decay in zip(amplitudes(medium, q2, a, b), (a, b)):
        psi = potentials(profile, complex(decay * z, -c * t), r)
        total += 2 / (c * medium.slope()) * combine(n, psi, r).real
    breaks = sorted({0.0, 1.0, K**0.5, *(x for x in fronts(medium, r, z, t, radius) if 0 < x < K**0.5)})
    breaks = [low + (high - low) * i / split for low, high in zip(breaks, breaks[1:]) for i in range(split)] + [K**0.5]
    x, weight = on_panels(breaks)
    keep = x > 1e-12
    x, weight = x[keep], weight[keep]
    q2 = -1 / x**2 + 0j
    a = np.where(x < 1, 1j * np.sqrt(abs(1 / x**2 - 1)), np.sqrt(abs(1 - 1 / x**2)))
    b = 1j * np.sqrt(abs(K / x**2 - 1))
    d = rayleigh_denominator(medium, q2, a, b)
    # a node that rounds to a front, where rho is zero, lies outside the compact part and is set to zero
    with np.errstate(divide="ignore", invalid="ignore"):
        for n, decay, slowness in zip(amplitudes(medium, q2, a, b), (a, b), (1, K**0.5)):
            amplitude = [v / (1j * x * d) for v in n]
            # gamma^ = slowness - x^2/(slowness + gamma^) keeps the digits of z - t just after the plane front
            less = z * x / (slowness - 1j * x * decay)
            for sense in (-1, 1):
                xi = 1j * ((z * slowness + sense * t) / x - less)
                term = combine(amplitude, potentials(profile, xi, r), r).real
                term[:, (x < 1) & (abs(xi.imag) > radius + r)] = 0.0
                total += term @ weight / np.pi
    return total


def step(medium, profile, r, z, t):
    """Response to a force one from t = 0 on."""
    return static(medium, profile, r, z) + remainder(medium, profile, r, z, t)


def arrivals(medium, r, z, radius=1.0):
    """Times of all fronts at (r, z)."""
    span = (medium.K - 1) ** 0.5
    edges = (abs(r - radius), r + radius)
    times = [z, z / medium.kappa] if r < radius else []
    for e in edges:
        times += [np.hypot(e, z), np.hypot(e, z) / medium.kappa, e / medium.c]
        if e * span >= z:
            times.append(e + z * span)
    return sorted(times)
