"""Lamb's harmonic half-space: integrals over slowness on the real axis, or above it.

Slownesses are in 1/c2; the time factor is e^{i omega t}, so that waves travel outwards on the path above the poles.
Nothing here comes from docs/theory.md; the program works in the time domain.
"""

from __future__ import annotations

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq


def ratio(nu: float) -> float:
    """c2/c1."""
    return ((1 - 2 * nu) / (2 - 2 * nu)) ** 0.5


def rayleigh_slowness(nu: float) -> float:
    """c2/c_R, the root of Rayleigh's function above one."""
    k = ratio(nu)
    return brentq(
        lambda p: (2 * p * p - 1) ** 2 - 4 * p * p * ((p * p - k * k) * (p * p - 1)) ** 0.5, 1 + 1e-9, 2, xtol=1e-15
    )


def radiation_parts(nu: float) -> tuple[float, float, float]:
    """The imaginary part of the compliance under a slow force, over omega/(mu c2).

    From slownesses below 1/c1, between 1/c1 and 1/c2, and from the pole of the Rayleigh wave; their sum is J.
    """
    k = ratio(nu)

    def both(angle: float) -> float:  # p = k sin(angle): both waves leave
        p = k * np.sin(angle)
        a, b = k * np.cos(angle), (1 - p * p) ** 0.5
        return a * p / ((2 * p * p - 1) ** 2 + 4 * p * p * a * b) * k * np.cos(angle)

    def shear(angle: float) -> float:  # from k to 1, longitudinal waves bound to the surface
        p2 = k * k + (1 - k * k) * np.sin(angle) ** 2
        slope = (1 - k * k) * np.sin(angle) * np.cos(angle)  # p dp
        a2, b2 = p2 - k * k, 1 - p2
        return 4 * p2 * a2 * b2**0.5 / ((2 * p2 - 1) ** 4 + 16 * p2 * p2 * a2 * b2) * slope

    p = rayleigh_slowness(nu)
    a, b, g = (p * p - k * k) ** 0.5, (p * p - 1) ** 0.5, 2 * p * p - 1
    slope = 8 * p * g - 8 * p * a * b - 4 * p**3 * (b / a + a / b)
    exact = {"epsabs": 1e-14, "epsrel": 1e-13, "limit": 400}
    return (
        quad(both, 0, np.pi / 2, **exact)[0] / (2 * np.pi),
        quad(shear, 0, np.pi / 2, **exact)[0] / (2 * np.pi),
        0.5 * p * a / abs(slope),
    )


def disc_compliance(nu: float, a0: float) -> complex:
    """Deflection of the centre of a Hertz disc under e^{i omega t}, over its static value; a0 = omega r0/c2.

    The real axis is left between zero and 1.6 times the Rayleigh slowness, upward.
    """
    k, top = ratio(nu), 1.6 * rayleigh_slowness(nu)
    x, w = np.polynomial.legendre.leggauss(24)

    def integrand(p: np.ndarray) -> np.ndarray:
        a, b = np.sqrt(p * p - k * k + 0j), np.sqrt(p * p - 1 + 0j)
        y = a0 * p
        load = 1.5 / np.pi * (np.sin(y) - y * np.cos(y)) / y**3
        # less its limit at large p, whose integral is the static deflection
        return load * (a * p / ((2 * p * p - 1) ** 2 - 4 * p * p * a * b) + 1 - nu)

    def panels(ends: np.ndarray, path, slope) -> complex:
        half, middle = 0.5 * np.diff(ends), 0.5 * (ends[1:] + ends[:-1])
        s = middle[:, None] + half[:, None] * x
        return complex(np.sum(half[:, None] * w * integrand(path(s)) * slope(s)))

    lift = 0.3
    above = panels(
        np.linspace(0, 1, 41),
        lambda s: top * s + 1j * lift * np.sin(np.pi * s),
        lambda s: top + 1j * lift * np.pi * np.cos(np.pi * s),
    )
    count = int(600 * max(a0, 1))
    tail = panels(top * np.exp(np.linspace(0, np.log(400), count)), lambda s: s + 0j, lambda s: 1)
    return 1 - a0 * (above + tail) / (0.375 * (1 - nu))
