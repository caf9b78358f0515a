"""Impacts whose contact radius follows the load, by direct superposition of flat punches in time.

    d(t) = u(t) - phi int_0^t V_p((t - t')/(tau a(t'))) u'(t') dt',    a = sqrt(u),    d'' = -(5/4) u^(3/2)

in collision units (README).  u is a polynomial on each element of a mesh that shrinks geometrically toward
both ends of the contact; the integral is taken as it stands, element by element, split where a wave front
passes (P, S and Rayleigh waves across the punch) and toward t' = t; each element is solved by Newton's method.
V_p comes from Kausel's closed form (growing_kernel.py).  Every row is solved on two meshes; the finer one is
written, and the differences between the two beside it.

    python growing.py [rows of each kind]      writes growing.csv, rows that exist are kept
"""

import sys
from pathlib import Path

import numpy as np
from numba import njit

from growing_kernel import punch

DEGREE = 8
GAUSS = 10
FILE = Path(__file__).parent / "growing.csv"
RESULTS = (
    "peak_force,peak_force_time,contact_time,restitution,loss,peak_displacement,peak_deflection,impulse"
)
COLUMNS = "kind,nu,phi,tau," + RESULTS + "," + ",".join("d_" + name for name in RESULTS.split(","))


def lobatto(n):
    """Nodes of the Lobatto rule of degree n on [-1, 1]."""
    inner = np.polynomial.legendre.Legendre.basis(n).deriv().roots()
    return np.array([-1.0, *np.sort(inner.real), 1.0])


X = lobatto(DEGREE)
TO_POWERS = np.linalg.inv(np.polynomial.polynomial.polyvander(X, DEGREE))
G_X, G_W = np.polynomial.legendre.leggauss(GAUSS)


def integral_matrices():
    """First and second integrals from -1 to each node of the polynomial through the nodes."""
    first = np.zeros((DEGREE + 1, DEGREE + 1))
    second = np.zeros((DEGREE + 1, DEGREE + 1))
    val = np.polynomial.polynomial.polyval
    integ = np.polynomial.polynomial.polyint
    for j in range(DEGREE + 1):
        once = integ(TO_POWERS[:, j], lbnd=-1)
        twice = integ(once, lbnd=-1)
        first[:, j] = val(X, once)
        second[:, j] = val(X, twice)
    return first, second


FIRST, SECOND = integral_matrices()


@njit(cache=True)
def powers(c, x):
    """Value and slope of a polynomial in powers of x."""
    v, s = 0.0, 0.0
    for k in range(len(c) - 1, -1, -1):
        s = s * x + v
        v = v * x + c[k]
    return v, s


@njit(cache=True)
def relaxation(y, ends, tables):
    """V_p and its slope at y (time in a/c2)."""
    if y >= ends[-1]:
        return 0.0, 0.0
    low, high = 0, len(ends) - 1
    while high - low > 1:
        mid = (low + high) // 2
        if ends[mid] <= y:
            low = mid
        else:
            high = mid
    x = (2.0 * y - ends[low] - ends[low + 1]) / (ends[low + 1] - ends[low])
    b1, b2, s1, s2 = 0.0, 0.0, 0.0, 0.0
    row = tables[low]
    for k in range(len(row) - 1, 0, -1):
        s1, s2 = 2.0 * b1 + 2.0 * x * s1 - s2, s1
        b1, b2 = 2.0 * x * b1 - b2 + row[k], b1
    return x * b1 - b2 + row[0], (b1 + x * s1 - s2) * 2.0 / (ends[low + 1] - ends[low])


@njit(cache=True)
def lateness(x, t, start, half, c, tau):
    """y of an increment at place x of an element that is felt at t."""
    u, _ = powers(c, x)
    if u <= 0.0:
        return 1e300
    return (t - (start + half * (1.0 + x))) / (tau * np.sqrt(u))


@njit(cache=True)
def cuts(low, high, t, start, half, c, tau, fronts):
    """Places in (low, high) where a front passes, and where the split toward it goes; ascending with both ends."""
    found = [low, high]
    y_low = lateness(low, t, start, half, c, tau)
    y_high = lateness(high, t, start, half, c, tau)
    for front in fronts:
        if (y_low - front) * (y_high - front) >= 0.0:
            continue
        a, b = low, high
        sign = y_low > front
        for _ in range(100):
            mid = 0.5 * (a + b)
            if (lateness(mid, t, start, half, c, tau) > front) == sign:
                a = mid
            else:
                b = mid
            if b - a < 1e-15:
                break
        place = 0.5 * (a + b)
        found.append(place)
        for k in range(1, 4):
            found.append(place - (place - low) * 0.15**k)
            found.append(place + (high - place) * 0.15**k)
    found.sort()
    return found


@njit(cache=True)
def piece(low, high, t, start, half, c, tau, ends, tables, weights, g_x, g_w, to_powers):
    """int V_p u' dt over part of an element; to weights, if any, its derivatives by the values of u are added."""
    total = 0.0
    middle, radius = 0.5 * (low + high), 0.5 * (high - low)
    for q in range(len(g_x)):
        x = middle + radius * g_x[q]
        u, slope = powers(c, x)
        if u <= 0.0:
            continue
        y = (t - (start + half * (1.0 + x))) / (tau * np.sqrt(u))
        v, v_slope = relaxation(y, ends, tables)
        v *= radius * g_w[q]
        v_slope *= -0.5 * y / u * slope * radius * g_w[q]
        total += v * slope
        if len(weights) > 0:
            for j in range(len(weights)):
                value, s = powers(to_powers[:, j], x)
                weights[j] += v * s + v_slope * value
    return total


@njit(cache=True)
def march(phi, tau, ends, tables, kappa, grading, longest, nodes, to_powers, first, second, g_x, g_w):
    """Starts, half lengths, coefficients of u and the state at each element; returns their number too."""
    n = len(nodes) - 1
    most = 6000
    start = np.zeros(most)
    half = np.zeros(most)
    coef = np.zeros((most, n + 1))
    state = np.zeros((most + 1, 2))  # velocity, displacement at the start
    state[0, 0] = 1.0
    fronts = np.array([2.0 * kappa, 2.0, ends[-1]])
    none = np.zeros(0)
    h = 1e-10 * min(1.0, 1.0 - phi + 1e-9)
    t0 = 0.0
    u0 = 0.0
    rate = 1.0 / (1.0 - phi)
    top = 0.0
    count = 0
    for e in range(most):
        # the guess: u linear with the last slope
        u = np.empty(n + 1)
        for i in range(n + 1):
            u[i] = u0 + rate * 0.5 * h * (1.0 + nodes[i])
        start[e], half[e] = t0, 0.5 * h
        past = np.zeros(n + 1)
        for i in range(1, n + 1):
            t = t0 + 0.5 * h * (1.0 + nodes[i])
            dead = 0
            for k in range(e - 1, -1, -1):
                y_right = lateness(1.0, t, start[k], half[k], coef[k], tau)
                y_left = lateness(-1.0, t, start[k], half[k], coef[k], tau)
                if y_right >= ends[-1] and y_left >= ends[-1]:
                    dead += 1
                    if dead > 3:
                        break
                    continue
                places = cuts(-1.0, 1.0, t, start[k], half[k], coef[k], tau, fronts)
                for m in range(len(places) - 1):
                    past[i] += piece(
                        places[m], places[m + 1], t, start[k], half[k], coef[k], tau, ends, tables, none, g_x, g_w, to_powers
                    )
        done = False
        for it in range(60):
            c = to_powers @ u
            matrix = np.zeros((n, n))
            right = np.zeros(n)
            force = np.zeros(n + 1)
            for j in range(n + 1):
                force[j] = max(u[j], 0.0) ** 1.5
            for i in range(1, n + 1):
                t = t0 + 0.5 * h * (1.0 + nodes[i])
                weights = np.zeros(n + 1)
                own = 0.0
                last = -1.0
                for k in range(1, 9):
                    edge = nodes[i] - (nodes[i] + 1.0) * (0.2**k if k < 8 else 0.0)
                    places = cuts(last, edge, t, t0, 0.5 * h, c, tau, fronts)
                    for m in range(len(places) - 1):
                        own += piece(
                            places[m], places[m + 1], t, t0, 0.5 * h, c, tau, ends, tables, weights, g_x, g_w, to_powers
                        )
                    last = edge
                d = state[e, 1] + state[e, 0] * (t - t0)
                for j in range(n + 1):
                    d -= 1.25 * 0.25 * h * h * second[i, j] * force[j]
                right[i - 1] = u[i] - phi * (past[i] + own) - d
                for j in range(1, n + 1):
                    matrix[i - 1, j - 1] = (
                        -phi * weights[j] + 1.25 * 0.25 * h * h * second[i, j] * 1.5 * np.sqrt(max(u[j], 0.0))
                    )
                matrix[i - 1, i - 1] += 1.0
            change = np.linalg.solve(matrix, right)
            size = 0.0
            scale = 1.0
            for j in range(1, n + 1):
                if change[j - 1] > 0.9 * u[j]:
                    scale = min(scale, 0.9 * u[j] / change[j - 1])
            for j in range(1, n + 1):
                u[j] -= scale * change[j - 1]
                size = max(size, abs(change[j - 1]))
            if size < 1e-13 * max(abs(u[n]), abs(u0)) + 1e-17 and scale == 1.0:
                done = True
                break
        if not done and size > 1e-9 * max(abs(u[n]), abs(u0)) + 1e-14:
            return start, half, coef, state, -2 - e
        coef[e] = to_powers @ u
        v, d = state[e, 0], state[e, 1] + state[e, 0] * h
        for j in range(n + 1):
            p = max(u[j], 0.0) ** 1.5
            v -= 1.25 * 0.5 * h * first[n, j] * p
            d -= 1.25 * 0.25 * h * h * second[n, j] * p
        state[e + 1, 0], state[e + 1, 1] = v, d
        count = e + 1
        t0 += h
        value, slope = powers(coef[e], 1.0)
        u0, rate = u[n], slope / (0.5 * h)
        top = max(top, u0)
        if u0 < max(1e-11, 1e-13 / (1.0 - phi)) * top or (rate < 0.0 and -u0 / rate < 1e-12):
            return start, half, coef, state, count
        h = min(longest, grading * t0)
        if rate < 0.0:
            h = min(h, -grading * u0 / rate)
    return start, half, coef, state, -1


def solve(nu, phi, tau, kernel, grading, longest):
    """Results of an impact; tau = a/c1 in collision times."""
    ends, tables, kappa = kernel
    # the kernel's time is a/c2
    slow = tau / kappa
    start, half, coef, state, count = march(
        phi, slow, ends, tables, kappa, grading, longest, X, TO_POWERS, FIRST, SECOND, G_X, G_W
    )
    if count < 0:
        return None
    val, der = np.polynomial.polynomial.polyval, np.polynomial.polynomial.polyder

    def crossing(f, low, high):
        sign = f(low) > 0
        for _ in range(200):
            mid = 0.5 * (low + high)
            if (f(mid) > 0) == sign:
                low = mid
            else:
                high = mid
        return 0.5 * (low + high)

    # u ~ (time left)^q over the last two elements
    (u_before, r_before), (u, rate) = (
        (val(1.0, coef[e]), val(1.0, der(coef[e])) / half[e]) for e in (count - 2, count - 1)
    )
    inverse = 1 - np.log(rate / r_before) / np.log(u / u_before)
    e = count - 1
    contact = start[e] + 2 * half[e] + u / -rate / inverse
    velocity = state[count, 0]
    peak, peak_time, travel, deflection = 0.0, 0.0, 0.0, 0.0
    work = 0.0
    for e in range(count):
        nodes = start[e] + half[e] * (1 + X)
        u = val(X, coef[e])
        force = np.maximum(u, 0.0) ** 1.5
        v = state[e, 0] - 1.25 * half[e] * (FIRST @ force)
        d = state[e, 1] + state[e, 0] * (nodes - start[e]) - 1.25 * half[e] ** 2 * (SECOND @ force)
        lag = v - val(X, der(coef[e])) / half[e]
        work += half[e] * (FIRST[-1] @ (force * lag))
        d_of, v_of = TO_POWERS @ d, TO_POWERS @ v
        places = [-1.0, 1.0]
        dc = der(coef[e])
        if val(-1.0, dc) > 0 >= val(1.0, dc):
            x = crossing(lambda x: val(x, dc), -1.0, 1.0)
            value = val(x, coef[e]) ** 1.5
            if value > peak:
                peak, peak_time = value, start[e] + half[e] * (1 + x)
        if val(-1.0, v_of) > 0 >= val(1.0, v_of):
            travel = val(crossing(lambda x: val(x, v_of), -1.0, 1.0), d_of)
        w_of = d_of - coef[e]
        dw = der(w_of)
        grid = np.linspace(-1, 1, 33)
        k = int(np.argmax(val(grid, w_of)))
        place = grid[k]
        if 0 < k < 32 and val(grid[k - 1], dw) > 0 > val(grid[k + 1], dw):
            place = crossing(lambda x: val(x, dw), grid[k - 1], grid[k + 1])
        deflection = max(deflection, val(place, w_of))
    deflection = max(deflection, state[count, 1])
    loss = 2.5 * work
    assert abs(loss - (1 - velocity**2)) < 1e-7, (loss, 1 - velocity**2)
    return np.array(
        [peak, peak_time, contact, -velocity, loss, travel, deflection, (1 - velocity) / 1.25]
    )


def groups(draw):
    """nu, phi, tau of a random ball on a random half-space, V0/c2 from 1e-4 to 5e-2."""

    def log(low, high):
        return low * (high / low) ** draw.random()

    rho, rho_s = log(900.0, 1e4), log(900.0, 2e4)
    soft, stiff = log(1e6, 4e11), log(1e6, 4e11)
    nu_s, nu = 0.49 * draw.random(), 0.49 * draw.random()
    mass = 4.18879 * rho_s * log(0.3, 10.0)
    c2 = np.sqrt(stiff / (2 * (1 + nu)) / rho)
    c1 = c2 * np.sqrt((2 - 2 * nu) / (1 - 2 * nu))
    v = c2 * log(1e-4, 5e-2)
    modulus = 1 / ((1 - nu_s**2) / soft + (1 - nu**2) / stiff)
    alpha = (1.25 * mass * v * v / (4 / 3 * modulus)) ** 0.4
    return nu, modulus * (1 - nu**2) / stiff, np.sqrt(alpha) / c1 / (alpha / v)


def long_memory(draw):
    """The half-space remembers a tenth of the contact to all of it."""
    nu = 0.45 * draw.random()
    memory = 0.3 * 10.0 ** draw.random()
    kappa = np.sqrt((1 - 2 * nu) / (2 - 2 * nu))
    return nu, 0.02 + 0.93 * draw.random(), memory * kappa / 2.2


def steel_ball(velocity):
    """A steel ball of 5 mm radius (208 GPa, 0.29, 7800 kg/m3) on steel."""
    modulus, nu, rho, radius = 208e9, 0.29, 7800.0, 0.005
    c1 = np.sqrt(modulus * (1 - nu) / (rho * (1 + nu) * (1 - 2 * nu)))
    mass = 4 / 3 * np.pi * radius**3 * rho
    plane = modulus / (1 - nu * nu) / 2
    alpha = (1.25 * mass * velocity**2 / (4 / 3 * plane * np.sqrt(radius))) ** 0.4
    return nu, 0.5, np.sqrt(radius * alpha) / c1 / (alpha / velocity)


def main():
    rows = int(sys.argv[1]) if len(sys.argv) > 1 else 110
    known = FILE.read_text().splitlines()[1:] if FILE.exists() else []
    have = {",".join(line.split(",")[:4]) for line in known}
    if not FILE.exists():
        FILE.write_text(COLUMNS + "\n")
    balls = iter((1.0, 20.0, 100.0))
    kinds = (
        ("scene", groups, 1, rows),
        ("long", long_memory, 2, rows // 4),
        ("ball", lambda _: steel_ball(next(balls)), 3, 3),
    )
    for kind, make, seed, wanted in kinds:
        draw = np.random.default_rng(seed)
        for _ in range(wanted):
            nu, phi, tau = (float(f"{x:.12g}") for x in make(draw))
            if f"{kind},{nu!r},{phi!r},{tau!r}" in have:
                continue
            kernel = punch(nu)
            coarse = solve(nu, phi, tau, kernel, 0.25, 0.06)
            fine = solve(nu, phi, tau, kernel, 0.18, 0.045)
            if coarse is None or fine is None:
                print("not resolved:", kind, nu, phi, tau)
                continue
            line = ",".join(
                [kind, f"{nu!r},{phi!r},{tau!r}"]
                + [f"{x:.14g}" for x in fine]
                + [f"{x:.0e}" for x in np.abs(fine - coarse)]
            )
            print(line, flush=True)
            with FILE.open("a") as file:
                file.write(line + "\n")


if __name__ == "__main__":
    main()
