"""Published closed forms, written down from their papers."""

from __future__ import annotations

import numpy as np


def pekeris(tau: np.ndarray) -> np.ndarray:
    """Vertical displacement of the surface under a point force applied suddenly at nu = 1/4, in P/(pi mu r).

    tau = c2 t/r; C. L. Pekeris, The seismic surface pulse, 1955.
    """
    root = 3**0.5
    tau = np.asarray(tau, dtype=float)
    with np.errstate(invalid="ignore", divide="ignore"):
        slow = (3 * root + 5) ** 0.5 / np.sqrt(0.75 + root / 4 - tau**2)
        first = 6 - root / np.sqrt(tau**2 - 0.25) - slow + (3 * root - 5) ** 0.5 / np.sqrt(tau**2 + root / 4 - 0.75)
        parts = [np.zeros_like(tau), first / 32, (6 - slow) / 16, np.full_like(tau, 6 / 16)]
    return np.choose(np.searchsorted([1 / root, 1, (3 + root) ** 0.5 / 2], tau, side="right"), parts)


def kausel(nu: float, tau: np.ndarray) -> np.ndarray:
    """The same at any Poisson's ratio over its static value (1 - nu)/(2 pi), in P/(mu r).

    E. Kausel, Lamb's problem at its simplest, 2012, in slownesses over 1/c2 squared.
    """
    k2 = (1 - 2 * nu) / (2 - 2 * nu)
    roots = np.roots([16 * (1 - k2), -8 * (3 - 2 * k2), 8, -1]).astype(complex)
    rayleigh = int(np.argmax(roots.real))
    tau = np.asarray(tau, dtype=float)

    def term(i: int, front: np.ndarray) -> np.ndarray:
        """One root's part, over the root of its distance from the front."""
        x = roots[i]
        apart = np.prod([x - y for y in np.delete(roots, i)])
        size = (x - 0.5) ** 2 * np.sqrt(x - k2 if i == rayleigh else k2 - x) / apart
        return np.real(size / np.sqrt(front + 0j))

    with np.errstate(invalid="ignore", divide="ignore"):
        late = 1 - term(rayleigh, roots[rayleigh] - tau**2)
        early = 0.5 * (late - sum(term(i, tau**2 - roots[i]) for i in range(3) if i != rayleigh))
    bounds = [k2**0.5, 1, roots[rayleigh].real ** 0.5]
    return np.choose(np.searchsorted(bounds, tau, side="right"), [0 * tau, early, late, 0 * tau + 1])


def huber(nu: float, r: np.ndarray, z: np.ndarray) -> dict[str, np.ndarray]:
    """Stresses under Hertz's pressure of unit peak on the unit disc, r > 0, z > 0, tension positive.

    M. T. Huber, 1904; u is the positive root of r^2/(1 + u) + z^2/u = 1.
    """
    b = r * r + z * z - 1
    both = np.sqrt(b * b + 4 * z * z)
    u = np.where(b > 0, 0.5 * (b + both), 2 * z * z / (both - b))
    root = np.sqrt(u)
    m, n = z / root, u / (u * u + z * z)
    angle = root * np.arctan(1 / root)
    ring = (1 - 2 * nu) / 3 / (r * r) * (1 - m**3)
    return {
        "stress_zz": -(m**3) * n,
        "stress_rz": -r * z * z / (u * u + z * z) * root / (1 + u),
        "stress_rr": ring + m**3 * n + m * (u * (1 - nu) / (1 + u) + (1 + nu) * angle - 2),
        "stress_tt": -ring - m * (2 * nu + u * (1 - nu) / (1 + u) - (1 + nu) * angle),
    }
