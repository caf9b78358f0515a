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


def check(report):
    """(T68) and (T69)."""
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
