"""Wavelets of a point force on a half-space, by the closed forms of the step response: lamb.csv.

    surface  Pekeris, Proc. Natl Acad. Sci. 41, 469 (1955), nu = 1/4: uz and ur
    axis     Cagniard's substitution, which is algebraic below the force, any nu: uz and szz

Each is convolved with the derivatives of a Ricker or a Gaussian wavelet by Gauss's rule with cosine substitutions between the arrivals;
the stress, a distribution, as its time integral with the second derivative.  Nothing here is shared with the program.

Units: the distance R, c1, mu and the force; z down, u outward, tension positive.
"""

from pathlib import Path

import numpy as np

ROOT = np.sqrt(3.0)
RAYLEIGH = np.sqrt(3.0 + ROOT) / 2.0
NODES, WEIGHTS = np.polynomial.legendre.leggauss(60)
ANGLES = 0.5 * np.pi * (NODES + 1.0)
CIRCLE = np.sin((np.arange(4000) + 0.5) * np.pi / 8000) ** 2


def vertical(tau):
    """uz on the surface, tau = c2 t/r."""
    square = tau * tau
    with np.errstate(invalid="ignore"):
        rayleigh = np.sqrt(3 * ROOT + 5) / np.sqrt(0.75 + 0.25 * ROOT - square)
        bound = np.sqrt(3 * ROOT - 5) / np.sqrt(square + 0.25 * ROOT - 0.75)
        early = (6 - ROOT / np.sqrt(square - 0.25) - rayleigh + bound) / (32 * np.pi)
        late = np.where(tau < RAYLEIGH, (6 - rayleigh) / (16 * np.pi), 3 / (8 * np.pi))
    return np.where(3 * square < 1, 0.0, np.where(tau < 1, early, late))


def radial(tau):
    """ur on the surface."""
    k2 = 0.5 * (3 * tau * tau - 1)
    early = tau < 1
    with np.errstate(invalid="ignore", divide="ignore"):
        modulus, factor = np.where(early, k2, 1 / k2), np.where(early, k2, 1.0)
        scale = np.where(early, 1.0, 1 / np.sqrt(k2))

        def third(n):
            under = 1 - modulus[:, None] * CIRCLE
            return np.mean(0.5 * np.pi / ((1 + n * factor[:, None] * CIRCLE) * np.sqrt(under)), axis=1)

        total = 6 * third(0) - 18 * third(8) + (6 - 4 * ROOT) * third(20 - 12 * ROOT) + (6 + 4 * ROOT) * third(20 + 12 * ROOT)
        body = -np.sqrt(6) * tau * scale / (32 * np.pi**2) * total
        behind = tau * tau - 0.25 * (3 + ROOT)
        pole = np.where(behind > 0, tau / (8 * np.pi * np.sqrt(np.abs(behind))), 0.0)
    return np.where(k2 <= 0, 0.0, body - pole)


def below(nu):
    """uz, and the time integral of szz, at depth 1 below the force."""
    k = (2 - 2 * nu) / (1 - 2 * nu)

    def rayleigh(p2, a, b):
        return (2 * p2 + k) ** 2 - 4 * p2 * a * b

    def both(t):
        t = t.astype(complex)
        p, s = t * t - 1, t * t - k
        g, of_p, of_s = 2 * p + k, rayleigh(p, t, np.sqrt(p + k)), rayleigh(s, np.sqrt(s + 1), t)
        after = t.real > np.sqrt(k)
        w = t * t * g / of_p - np.where(after, 2 * s * np.sqrt(s + 1) * t / of_s, 0)
        stress = t * g * g / of_p - np.where(after, 4 * t * s * np.sqrt(s + 1) * t / of_s, 0)
        here = t.real > 1
        return np.where(here, w.real, 0) / (2 * np.pi), -np.where(here, stress.real, 0) / (2 * np.pi)

    return both, np.sqrt(k)


def wavelet(name, f, t):
    """First and second derivative."""
    x = np.pi * f * t
    e = np.exp(-x * x)
    if name == "ricker":
        return np.pi * f * (4 * x**3 - 6 * x) * e, (np.pi * f) ** 2 * (-6 + 24 * x**2 - 8 * x**4) * e
    return -2 * np.pi * f * x * e, (np.pi * f) ** 2 * (4 * x**2 - 2) * e


def convolved(response, fronts, name, f, delay, time, order):
    end = time - delay + 8 / (np.pi * f)
    ends = sorted({x for x in fronts if x < end} | {end})
    total = 0.0
    for start, stop in zip(ends, ends[1:]):
        if stop - start < 1e-12:
            continue
        for i in range(parts := int(np.ceil((stop - start) * f * 4))):
            # the substitution spans the whole interval, so that its parts share it
            angles = np.pi * (i + ANGLES / np.pi) / parts
            lag = 0.5 * (start + stop) - 0.5 * (stop - start) * np.cos(angles)
            weight = 0.5 * (stop - start) * np.sin(angles) * WEIGHTS * 0.5 * np.pi / parts
            total += np.sum(weight * response(lag) * wavelet(name, f, time - delay - lag)[order - 1])
    return total


def rows():
    kappa = 1 / ROOT
    surface = [1.0, ROOT, RAYLEIGH * ROOT]
    for name, f in [("ricker", 0.3), ("ricker", 2.0), ("gaussian", 1.0), ("ricker", 12.0)]:
        delay = 1.5 / f
        around = np.array([-0.4, 0.0, 0.3, 0.7]) / f + delay
        for time in sorted(x + y for x in surface for y in around):
            for quantity, response, order in [("uz", vertical, 1), ("vz", vertical, 2), ("ur", radial, 1)]:
                value = convolved(lambda lag: response(lag * kappa), surface, name, f, delay, time, order)
                yield 0.25, 1.0, 0.0, name, f, time, quantity, value
        for nu in (0.1, 0.3333):
            both, s = below(nu)
            for time in sorted(x + y for x in (1.0, s) for y in around):
                for i, (quantity, order) in enumerate([("uz", 1), ("szz", 2)]):
                    value = convolved(lambda lag: both(lag)[i], [1.0, s], name, f, delay, time, order)
                    yield nu, 0.0, 1.0, name, f, time, quantity, value


if __name__ == "__main__":
    lines = ["nu,r,z,wavelet,frequency,time,quantity,value"]
    lines += [",".join(x if isinstance(x, str) else f"{x:.14g}" for x in row) for row in rows()]
    Path(__file__).parents[1].joinpath("golden", "lamb.csv").write_text("\n".join(lines) + "\n")
