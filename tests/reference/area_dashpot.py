"""Chebyshev coefficients of the results of the area dashpot, for crates/impact/src/contact/area_dashpot.rs.

    d'' = -(5/4) p,   p = d^(3/2) + (9/4) c d d' + (135/32) c^2 sqrt(d) (d'^2 - d^(5/2)) - 3 b sqrt(d) (d'^2 - (5/4) d^(5/2))

from d = 0, d' = 1 until d = 0 again; results at b = 0 and their derivatives by b there, for c in [0, 0.2].
Runge and Kutta of order 8 (DOP853) with a relative tolerance of 1e-13, in the root of time at the touch and in the
root of d at the end, where the solution is analytic in these.

    python area_dashpot.py            prints the tables
"""

import numpy as np
from scipy.integrate import quad, solve_ivp

LARGEST = 0.2
DEGREE = 12
B = 1e-4
NAMES = ["PEAK_FORCE", "PEAK_FORCE_TIME", "END", "VELOCITY", "PEAK_DISPLACEMENT", "LOSS", "DEFLECTION"]


def force(c, b, d, v):
    r = np.sqrt(np.maximum(d, 0.0))
    return (
        d * r + 2.25 * c * d * v + 135 / 32 * c * c * r * (v * v - d**2.5) - 3 * b * r * (v * v - 1.25 * d**2.5)
    )


def results(c, b):
    """Peak force, its time, end, -velocity, peak displacement, loss/c, largest deflection/c (0 for c = 0)."""
    tight = dict(method="DOP853", rtol=1e-13, atol=1e-16, dense_output=True)

    # s = sqrt(t); third: the work of all but Hertz's force
    def odd(d, v):
        return (force(c, b, d, v) - np.maximum(d, 0.0) ** 1.5) * v

    def start(s, y):
        p = force(c, b, y[0], y[1])
        return [2 * s * y[1], -1.25 * 2 * s * p, 2 * s * odd(y[0], y[1])]

    one = solve_ivp(start, [0, 1], [0.0, 1.0, 0.0], **tight)

    def middle(t, y):
        return [y[1], -1.25 * force(c, b, y[0], y[1]), odd(y[0], y[1])]

    low = lambda t, y: y[0] - 0.3 if y[1] < 0 else 1.0
    low.terminal, low.direction = True, -1
    top = lambda t, y: y[1]
    two = solve_ivp(middle, [1, 5], one.y[:, -1], events=[low, top], **tight)
    t1, (d1, v1, w1) = two.t_events[0][0], two.y_events[0][0]
    displacement = two.y_events[1][0][0]

    def closing(r, y):  # r = sqrt(d) from its start down to 0: place x = start - r
        root = r0 - r
        p = force(c, b, root * root, y[0])
        rate = 2 * root / -y[0]
        return [-1.25 * p * rate, rate, rate * odd(root * root, y[0])]

    r0 = np.sqrt(d1)
    three = solve_ivp(closing, [0, r0], [v1, t1, w1], **tight)
    velocity, end, work = three.y[:, -1]

    def newton(f, low, high):
        for _ in range(200):
            mid = 0.5 * (low + high)
            if f(mid) > 0:
                low = mid
            else:
                high = mid
        return 0.5 * (low + high)

    def slope(t):
        d, v = two.sol(t)[:2] if t > 1 else one.sol(np.sqrt(t))[:2]
        h = 1e-30
        p = force(c, b, d, v)
        # dp/dt by the chain rule, complex steps
        z = np.sqrt(d + 1j * h * v)
        dc, vc = d + 1j * h * v, v - 1j * h * 1.25 * p
        pc = dc * z + 2.25 * c * dc * vc + 135 / 32 * c * c * z * (vc**2 - dc**2.5) - 3 * b * z * (vc**2 - 1.25 * dc**2.5)
        return pc.imag / h

    peak_time = newton(slope, 0.7, 2.2)
    peak = force(c, b, *(two.sol(peak_time)[:2] if peak_time > 1 else one.sol(np.sqrt(peak_time))[:2]))
    deflection = 0.0
    if c > 0:

        def lag(x):
            root = r0 - x
            return root * root - abs(force(c, b, root * root, three.sol(x)[0])) ** (2 / 3)

        def lag_middle(t):
            d, v = two.sol(t)[:2]
            return d - abs(force(c, b, d, v)) ** (2 / 3)

        best = 0.0
        for f, a, z in ((lag_middle, peak_time + 1e-3, t1), (lag, 0.0, r0 * 0.98)):
            grid = np.linspace(a, z, 400)
            values = [f(g) for g in grid]
            i = int(np.argmax(values))
            lo, hi = grid[max(i - 1, 0)], grid[min(i + 1, 399)]
            for _ in range(200):
                x, y = lo + (hi - lo) * 0.381966, lo + (hi - lo) * 0.618034
                if f(x) < f(y):
                    lo = x
                else:
                    hi = y
            best = max(best, f(0.5 * (lo + hi)))
        deflection = best / c
    return np.array([peak, peak_time, end, -velocity, displacement, 2.5 * work / c, deflection])


def number(value, digits):
    """Without zeros at the end of the mantissa."""
    mantissa, exponent = f"{value:.{digits}e}".split("e")
    return mantissa.rstrip("0") + "e" + exponent


def main():
    angles = (np.arange(DEGREE + 1) + 0.5) * np.pi / (DEGREE + 1)
    x = np.cos(angles)
    places = 0.5 * LARGEST * (1 + x)
    inverse = np.linalg.inv(np.polynomial.chebyshev.chebvander(x, DEGREE))
    zero = np.array([results(c, 0.0) for c in places])
    plus = np.array([results(c, B) for c in places])
    minus = np.array([results(c, -B) for c in places])
    by_b = (plus - minus) / (2 * B)
    # the deflection is c times its column, and nearly as small as b's part of it
    small = 1e-6
    by_b[:, -1] = [(results(c, small)[-1] - results(c, -small)[-1]) * c / (2 * small) for c in places]
    for title, table, keep in (("AT_ZERO", zero, DEGREE + 1), ("BY_B", by_b, 7)):
        print(f"const {title}: [[f64; {keep}]; {len(NAMES)}] = [")
        for k, name in enumerate(NAMES):
            row = inverse @ table[:, k]
            print(f"    // {name}; next {abs(row[min(keep, DEGREE)]):.0e}")
            digits = 14 if title == "AT_ZERO" else 9
            print("    [" + ", ".join(number(v, digits) for v in row[:keep]) + "],")
        print("];")
    # third order of the loss: -(phi M_3/24) int p'' (p^(5/3))'' dt over Hertz's pulse, in x = d, both halves
    def integrand(y):  # d = 1 - y^2, dt = dd/v
        d = 1 - y * y
        v2 = 1 - d**2.5
        if v2 <= 0 or d <= 0:
            return 0.0
        p2 = 0.75 * v2 / np.sqrt(d) - 1.875 * d**2
        e2 = 3.75 * np.sqrt(d) * v2 - 3.125 * d**3
        return 2 * y * p2 * e2 / np.sqrt(v2)

    print("const THIRD: f64 =", 2 * quad(integrand, 0, 1, epsabs=1e-13, epsrel=1e-13, limit=400)[0] / 24, ";")


if __name__ == "__main__":
    main()
