"""Section 4.6 of docs/theory.md: contacts that yield."""

import numpy as np
from scipy.integrate import quad, solve_ivp


def loading(u, y):
    return u**1.5 if u <= y * y else y**3 + 1.5 * y * (u - y * y)


def slope(u, y):
    return 1.5 * np.sqrt(max(u, 0)) if u <= y * y else 1.5 * y


def followed(s, c):
    """Turning point, restitution and work of the dashpot by Runge and Kutta, with the motion."""
    y = s**-0.4

    def rise(_, z):
        f = slope(z[0], y)
        return [z[1], -1.25 * (loading(max(z[0], 0), y) + c * f * f * z[1]), 2.5 * c * f * f * z[1] ** 2]

    def turn(_, z):
        return z[1]

    turn.terminal, turn.direction = True, -1
    up = solve_ivp(rise, (0, 20), [0, 1, 0], "DOP853", events=turn, rtol=1e-12, atol=1e-14)
    depth, force = up.y[0, -1], loading(up.y[0, -1], y)
    rho = depth**1.5 / force
    left = depth - depth / rho

    def fall(_, z):
        x = max(z[0] - left, 0)
        return [z[1], -1.25 * (np.sqrt(rho) * x**1.5 + 2.25 * c * rho * x * z[1]), 2.5 * c * 2.25 * rho * x * z[1] ** 2]

    def gone(_, z):
        x = max(z[0] - left, 1e-18)
        return np.sqrt(x) + 2.25 * c * np.sqrt(rho) * z[1] if c else z[0] - left

    gone.terminal, gone.direction = True, -1
    start = [depth, 0, up.y[2, -1]]
    down = solve_ivp(fall, (0, 40), start, "DOP853", events=gone, rtol=1e-12, atol=1e-14, first_step=1e-4)
    return depth, force, -down.y[1, -1], down.y[2, -1], rho, max(down.y[0, -1] - left, 0)


def at_rest(density, ends, r, z, nu):
    """Static displacements and stresses (times 4 pi G and 2 pi) under punches: point loads at complex depths z + it."""
    sum_of = 0
    for low, high in zip(ends[:-1], ends[1:], strict=True):
        angle, weight = np.polynomial.legendre.leggauss(40)
        angle, weight = np.pi / 2 * (angle + 1), np.pi / 2 * weight
        t = (low + high) / 2 - (high - low) / 2 * np.cos(angle)
        depth = z + 1j * t
        far = np.sqrt(r * r + depth * depth)
        v_z, v_zz, v_rz = -depth / far**3, 3 * depth**2 / far**5 - 1 / far**3, 3 * r * depth / far**5
        psi_r = r / (far * (far + depth))
        around = psi_r / r
        each = [
            (2 * nu - 1) * psi_r + z * r / far**3,
            2 * (1 - nu) / far - z * v_z,
            2 * nu * v_z - z * (3 * r * r / far**5 - 1 / far**3) + (1 - 2 * nu) * (v_z + around),
            2 * nu * v_z + z / far**3 - (1 - 2 * nu) * around,
            v_z - z * v_zz,
            -z * v_rz,
        ]
        sum_of = sum_of + np.real(each) @ (density(t) * weight * (high - low) / 2 * np.sin(angle)) * 2
    return sum_of


def beyond(y, top, a):
    """Largest error of the fields of two of Hertz's pressures for a cut one unloaded to a radius, two to ten radii away."""
    kink = np.sqrt(top**2 - y * y)

    def chord(x):
        root = np.sqrt(np.maximum(x, y * y))
        cut = 1.5 / np.pi * (root**2 * np.arcsin(y / root) + y * np.sqrt(root**2 - y * y))
        return np.where(x > y * y, cut, 0.75 * x)

    def own(t):
        return chord(top**2 - t * t) - chord(top**2 - a * a)

    def punches(b, power):
        return 6 / np.pi * b ** (2 + power) * np.arcsin(min(1, y / np.sqrt(max(top**2 - b * b, y * y))))

    moments = [(2 * k + 3) / 3 * quad(punches, 0, a, args=(2 * k,), points=[min(kink, a)])[0] for k in range(3)]
    force, second, fourth = moments[0], moments[1] / moments[0] / a**2 - 1, moments[2] / moments[0] / a**4 - 1
    inner = fourth / second - 1
    share = second / (inner - 1)
    worst = 0
    for distance in (2, 3, 5, 10):
        for angle in np.linspace(0.1, np.pi / 2, 8):
            place = distance * top * np.sin(angle), distance * top * np.cos(angle), 0.3
            two = 0
            for part, radius in ((1 - share, a), (share, a * np.sqrt(inner))):
                hertz = lambda t, p=part, b=radius: 0.75 * p * force / b**3 * (b * b - t * t)  # noqa: E731
                two = two + at_rest(hertz, [0, radius], *place)
            exact = at_rest(own, sorted({0, min(kink, a), a}), *place)
            for kind in (slice(0, 2), slice(2, 6)):
                worst = max(worst, np.abs(two - exact)[kind].max() / np.abs(exact)[kind].max())
    return worst


def check(report):
    """(T62) to (T67)."""
    worst = 0
    for s in (1.3, 4.0, 60.0):
        q = np.sqrt(1.2 * s * s - 0.2)
        depth, force, e, _, _, _ = followed(s, 0)
        expected = [s**-0.8 * (1 + 2 * q) / 3, q * s**-1.2, q / s * (3 / (1 + 2 * q)) ** 0.25]
        worst = max(worst, *(abs(a / b - 1) for a, b in zip((depth, force, e), expected, strict=True)))
    report.row("T62", "closed forms against Runge and Kutta, s = 1.3, 4, 60", worst, 1e-8)

    y, top = 0.4, 0.9
    # pressure of the punches over c_H: int g(b)/(2 pi b sqrt(b^2 - r^2)) db with g = 4 b^2 asin(..)
    worst = 0
    for r in (0.05, 0.5, 0.7, 0.8, 0.88):
        def punch(t, r=r):
            b = np.sqrt(r * r + t * t)
            return 2 / np.pi * np.arcsin(min(1, y / np.sqrt(max(top**2 - b * b, 1e-300))))

        end = np.sqrt(top**2 - r * r)
        kink = np.sqrt(max(top**2 - y * y - r * r, 0))
        found = quad(punch, 0, kink, limit=200, epsabs=1e-12)[0] + quad(punch, kink, end, limit=200)[0]
        worst = max(worst, abs(found - min(y, end)))
    report.row("T63", "the punches rebuild min(p_y, Hertz) at five radii", worst, 1e-9)
    whole = quad(lambda b: 6 / np.pi * b * b * np.arcsin(min(1, y / np.sqrt(top**2 - b * b))), 0, top, points=[np.sqrt(top**2 - y * y)])[0]
    report.row("T63", "their sum against the force of (T62)", abs(whole - loading(top**2, y)), 1e-9)
    uniform = 80 / (9 * np.pi**2)
    # a flat pressure: work given back int p du over (2/5) p^2/a, p = (2 p*/pi)(asin x - x sqrt(1 - x^2)), u = -k sqrt(1 - x^2)
    back = quad(lambda x: 2 / np.pi * (np.arcsin(x) - x * np.sqrt(1 - x * x)) * x / np.sqrt(1 - x * x), 0, 1)[0]
    # far beyond yield p* = (3/2) y a^2 and the stroke is (4/pi) y a
    ratio = back * 1.5 * y * (4 / np.pi) * y / (0.4 * (1.5 * y) ** 2)
    report.row("T63", "work that comes back over Thornton's, far beyond yield", abs(ratio - uniform), 1e-9)

    for part, bound in ((1.0, 1e-4), (0.5, 1e-6)):
        report.row("T63", f"fields beyond two radii at {part} of the largest: two pressures", beyond(0.4, 0.9, part * 0.9), bound)

    def green(w, shape, strain):
        spread = 0.14 * np.exp(23 * strain)
        radius = np.pi * shape * strain / 2 * np.sqrt(w * (w / 1.9) ** spread)
        hardness = 2.84 * (1 - np.exp(-0.82 * radius**-0.7))
        return np.exp(-(w ** (5 / 12)) / 4) * w**1.5 + 4 * hardness / shape * (1 - np.exp(-(w ** (5 / 9)) / 25)) * w

    shape = 1.295 * np.exp(0.736 * 0.3)
    jump = green(1.9, shape, 0.002) / 1.9**1.5 - 1
    report.row("T64", "jump of the fit at 1.9 against half a per cent", abs(jump - 0.0047), 5e-4)
    far = 1e4
    residual = 1.02 * far * (1 - ((far + 5.9) / 6.9) ** -0.54)
    report.row("T64", "residual over the indentation far beyond yield against 1", abs(residual / far - 1), 0.02)

    s, c = 22.8529285605, 0.00169645646037
    depth, force, e, work, rho, rest = followed(s, c)
    report.row("T65", "restitution with a lag, s = 22.85, against an independent program", abs(e - 0.5379047573), 2e-9)
    report.row("T65", "radiated part, the same", abs(work - 0.002081133209), 1e-8)
    # (T66): g' a = s' on each branch
    a, step = 0.7, 1e-6
    worst = 0
    for g, punches in (
        (lambda a: 2 * a, lambda a: a * a),
        (lambda a: 2 * y * (1 + np.log(a / y)), lambda a: 2 * y * a),
        (lambda a: 2 * a / rho, lambda a: a * a / rho),
    ):
        rate = [(f(a + step) - f(a - step)) / (2 * step) for f in (g, punches)]
        worst = max(worst, abs(rate[0] * a - rate[1]))
    report.row("T66", "g' a against s' on three branches", worst, 1e-9)
    stored = 0.4 * rest**2.5 * np.sqrt(rho)
    edge = s**-0.4
    loaded = quad(loading, 0, edge**2, args=(edge,))[0] + quad(loading, edge**2, depth, args=(edge,))[0]
    plastic = 2.5 * (loaded - 0.4 * force**2 / np.sqrt(depth))
    report.row("T67", "energy after an impact with a lag", abs(e * e + plastic + work + 2.5 * stored - 1), 1e-8)
