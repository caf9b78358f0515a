"""Section 2.6 of docs/theory.md: a plate with two free faces."""

import numpy as np


def roots(nu, q):
    k = (2 - 2 * nu) / (1 - 2 * nu)
    a, b, g = np.sqrt(1 + q * q), np.sqrt(1 + k * q * q), 2 + k * q * q
    return k, a, b, g


def whole(nu, q, h):
    """Potentials of a plate at k = 1 from its four conditions: down-going ones at the upper, up-going ones at the lower face."""
    _, a, b, g = roots(nu, q)
    p, s = np.exp(-a * h), np.exp(-b * h)
    rows = [
        # traction of the upper face is the load, J0 and J1 parts
        [g, -2 * b, g * p, -2 * b * s],
        [2 * a, -g, -2 * a * p, g * s],
        [g * p, -2 * b * s, g, -2 * b],
        [2 * a * p, -g * s, -2 * a, g],
    ]
    return np.linalg.solve(np.array(rows), np.array([-1, 0, 0, 0], complex))


def legs(nu, q, h, most):
    """The same as a sum over legs."""
    _, a, b, g = roots(nu, q)
    d = g * g - 4 * a * b
    turn = -np.array([[g * g + 4 * a * b, -4 * b * g], [4 * a * g, -(g * g + 4 * a * b)]]) / d
    leg = np.diag([np.exp(-a * h), np.exp(-b * h)])
    wave = np.array([-g, -2 * a]) / d
    down, up = np.zeros(2, complex), np.zeros(2, complex)
    for m in range(most):
        if m % 2 == 0:
            down += wave
        else:
            up += wave
        wave = turn @ leg @ wave
    return np.concatenate([down, up])


def front(way, time, e, speed=1.0):
    late = time**2 - way**2
    return speed * (way * np.sqrt(late - e * e + 0j) + 1j * e * time) / late


CHORD = np.polynomial.legendre.leggauss(400)


def a3(xi, r):
    """A_3 of a Hertz disc as an integral over its chord, with the roots that belong to Re xi > 0."""
    s, w = CHORD
    zeta = xi - 1j * s
    return 3 / (8 * np.pi) * np.sum(w * (1 - s * s) / np.sqrt(zeta * zeta + r * r))


def check(report):
    """(T68) to (T70)."""
    rng = np.random.default_rng(5)
    worst, worst_turn = 0.0, 0.0
    for _ in range(50):
        nu, h = rng.uniform(0, 0.45), rng.uniform(2.0, 5.0)
        q = complex(rng.uniform(1.0, 3.0), rng.uniform(-2.0, 2.0))
        one, other = whole(nu, q, h), legs(nu, q, h, 60)
        worst = max(worst, np.abs(one - other).max() / np.abs(one).max())
    report.row("T68", "sum over 60 legs against the plate's four conditions, 50 complex q", worst, 1e-10)
    for _ in range(50):
        way, e = rng.uniform(1, 9), rng.uniform(0, 4)
        time = np.hypot(way, e) * rng.uniform(1.05, 3.0)
        q = front(way, time, e)
        worst_turn = max(worst_turn, abs(way * np.sqrt(1 + q * q) - q * time + 1j * e))
    report.row("T69", "fronts of P against their equation, 50 ways and times", worst_turn, 1e-11)
    # beside the disc, along a circle that crosses the axis between the fronts
    worst = 0.0
    for r in (1.8, 4.0):
        gap = abs(r - 1)
        centre, reach = 0.2j * gap, 0.4 * gap
        mean, points = 0.0, 64
        for angle in 2 * np.pi * (np.arange(points) + 0.5) / points:
            xi = centre + reach * np.exp(1j * angle)
            mean += a3(xi if xi.real > 0 else -xi, r) / points
        worst = max(worst, abs(mean - a3(centre + 1e-9, r)))
    report.row("T69", "A_3 continued by A_3(-xi) beside the disc: mean over circles across the axis against its centre", worst, 1e-8)
    s, w = np.polynomial.legendre.leggauss(40)
    square = 0.5 * (1 + s)
    pressure = 0.5 * w * np.sqrt(1 - square)
    mean = np.sum(pressure * (1 + square)) / np.sum(pressure)
    report.row("T70", "mean of 1 + r^2 under Hertz's pressure against its value at r^2 = 2/5", abs(mean / 1.4 - 1), 1e-4)
