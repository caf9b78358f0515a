"""Sections 4.4 and 4.5 of docs/theory.md: first-order radiation and the area dashpot, compared with the full memory."""

import mpmath as mp
import numpy as np
from scipy.integrate import solve_ivp

from . import halfspace as hs
from . import marches
from .collision import LOSS, TIME, Collision
from .surface import PUNCH


def dashpot(c):
    """The area dashpot (T51) in collision units: e, contact time, peaks and their times, by DOP853."""
    force = lambda d, v: max(d, 0) ** 1.5 + 2.25 * c * max(d, 0) * v
    # p over the root of d, which crosses zero where the contact ends
    end = lambda t, y: y[0] + 2.25 * c * max(y[0], 0) ** 0.5 * y[1] + (t < 0.5)
    end.terminal, end.direction = True, -1
    run = solve_ivp(
        lambda t, y: [y[1], -1.25 * force(*y)],
        (0, 8),
        [0.0, 1.0],
        method="DOP853",
        events=end,
        rtol=1e-13,
        atol=1e-15,
        dense_output=True,
        max_step=0.02,
    )
    t = np.linspace(0.6 * TIME / 2, 1.4 * TIME / 2, 4001)
    d, v = run.sol(t)
    p = d**1.5 + 2.25 * c * d * v
    i = int(np.argmax(p))
    fit = np.polyfit(t[i - 60 : i + 61] - t[i], p[i - 60 : i + 61], 4)
    best = min(np.roots(np.polyder(fit)), key=abs).real
    return {
        "e": -run.y[1, -1],
        "time": run.t[-1],
        "peak": np.polyval(fit, best),
        "peak_time": t[i] + best,
        "depth": np.max(d),
    }


def check(report):
    """(T47), (T49) to (T53), (T58)."""
    x, weight = hs.on_panels([0, 1])
    d = 1 - x**2
    # int p'^2 dt = 2 int (9/4) d v dd
    integral = 2 * np.sum(weight * 2 * x * 2.25 * d * np.sqrt(1 - d**2.5))
    report.row("T49", "(5/2) int p'^2 dt of Hertz's pulse against (9/2) B(4/5, 3/2)", abs(2.5 * integral - LOSS), 1e-12)
    report.row(
        "T49",
        "the same against the code's 3.979536609, and (4/5)^(1/5) of it against 3.80583978",
        max(abs(LOSS - 3.979536609), abs(LOSS * 0.8**0.2 - 3.80583978)),
        6e-9,
    )
    for nu, factor in ((0.25, 1.1115), (0.3, 1.1318)):
        ball = Collision(0.01, 4 / 3 * np.pi * 7800 * 0.005**3, 0.005, 2e11, nu, 2e11, nu, 7800)
        loss = LOSS * ball.reduced_lag() / (0.01 / (2e11 / 7800) ** 0.5) ** 0.6
        report.row("T49", f"equal materials: 1 - e^2 = {loss:.5f} (V0/c0)^(3/5) at nu = {nu}", abs(loss - factor), 1e-4)
    still, lags = dashpot(0.0), (1e-4, 2e-4)
    runs = [dashpot(c) for c in lags]
    rate = lambda f: 2 * (f(runs[0]) - f(still)) / lags[0] - (f(runs[1]) - f(still)) / lags[1]
    for name, key, exact in (
        ("peak force -(3/10) l", "peak", -0.3 * LOSS),
        ("largest approach -(1/5) l", "depth", -0.2 * LOSS),
        ("contact time +(1/20) l T_H", "time", 0.05 * LOSS * TIME),
        ("time of the peak -2.08713 c", "peak_time", -2.08713),
    ):
        report.row(
            "T50",
            f"first-order change of the {name}, against the damped ODE",
            abs(rate(lambda r: r[key]) - exact),
            2e-5,
        )
    report.row("T50", "contact time: 0.05 l T_H/c against the code's 0.58565", abs(0.05 * LOSS * TIME - 0.58565), 1e-5)
    steepest = 1.5 * ((2 / 7) ** 0.4 * 5 / 7) ** 0.5
    fine = np.linspace(0.5, 0.7, 20001)
    samples = np.max(1.5 * np.sqrt(fine * (1 - fine**2.5)))
    report.row(
        "T50", f"largest slope of Hertz's pulse, {steepest:.6f}, against samples of it", abs(steepest - samples), 1e-8
    )
    second = []
    for c in (0.002, 0.004):
        loss = 1 - dashpot(c)["e"] ** 2
        second.append((LOSS * c - loss) / (LOSS * c) ** 2)
    report.row(
        "T53",
        "second order of the loss of the damped ODE, l - (13/20) l^2",
        abs(2 * second[0] - second[1] - 0.65),
        2e-3,
    )
    m, c, k = 1.0, 1e-2, 3.0
    roots = np.roots([-m * c, m / k, 0, 1])
    grows = max(roots, key=lambda v: v.real)
    report.row("T52", "displacement form: growing root against 1/(c k)", abs(grows.real * c * k - 1), 1e-2)
    decay = min(roots, key=lambda v: v.real)
    report.row(
        "T52",
        "and its oscillating roots against the damping c k^2/(2 m)",
        abs(decay.real / (-c * k * k / (2 * m)) - 1),
        1e-2,
    )
    next_term(report)
    third_order(report)
    balls(report)


def next_term(report):
    """(T53): P = K (d + c P')^(3/2) for a given d(t), expanded in c."""
    mp.mp.dps = 40
    d, K = (lambda t: 1 + mp.sin(t) / 3), mp.mpf(2)
    slopes = [mp.diff(d, 0, n) for n in range(3)]
    errors = []
    for c in (mp.mpf("1e-3"), mp.mpf("5e-4")):
        p = lambda t: K * d(t) ** 1.5
        for _ in range(3):
            taylor = mp.taylor(p, 0, 8)
            p = lambda t, s=taylor[::-1]: (
                K * (d(t) + c * mp.polyval([n * v for n, v in zip(range(8, 0, -1), s)], t)) ** 1.5
            )
        x, v, a = slopes
        found = (
            K * x**1.5
            + mp.mpf(9) / 4 * c * K**2 * x * v
            + mp.mpf(27) / 32 * c**2 * K**3 * mp.sqrt(x) * (5 * v * v + 4 * x * a)
        )
        errors.append(abs(found - p(mp.mpf(0))))
    mp.mp.dps = 15
    report.row(
        "T53",
        "expansion of P = K (d + c P')^(3/2) to second order: order of the rest against 3",
        abs(mp.log(errors[0] / errors[1], 2) - 3),
        0.02,
    )


def third_order(report):
    """(T59): the force law against the expansion in the memory that it solves, along its own motion."""
    mp.mp.dps = 50
    q = lambda a, b: mp.mpf(a) / b

    def law(c, b, e):
        return lambda d, v: (
            d ** q(3, 2)
            + q(9, 4) * c * d * v
            + (q(135, 32) * c**2 - 3 * b) * mp.sqrt(d) * v**2
            - (q(135, 32) * c**2 - q(15, 4) * b) * d**3
            + (q(351, 64) * c**3 - q(63, 8) * b * c + q(3, 64) * e) * v**3
            - (q(6075, 128) * c**3 - q(585, 8) * b * c + q(15, 32) * e) * d ** q(5, 2) * v
        )

    def rest(size):
        c, b, e = size, q(7, 10) * size**2, q(13, 10) * size**3
        force = law(c, b, e)
        motion = mp.odefun(lambda t, y: [y[1], -q(5, 4) * force(*y)], 0, [q(6, 10), q(7, 10)])
        pressed = lambda t: force(*motion(t))
        # slopes at a time inside, by differences of many digits
        at = q(1, 5)
        slope = lambda power, n: mp.diff(lambda t: pressed(t) ** power, at, n, h=mp.mpf("1e-8"))
        value = pressed(at) ** q(2, 3) - c * slope(1, 1) + b * slope(q(4, 3), 2) - e / 60 * slope(q(5, 3), 3)
        return abs(motion(at)[0] - value)

    order = mp.log(rest(mp.mpf("2e-3")) / rest(mp.mpf("1e-3")), 2)
    mp.mp.dps = 15
    report.row("T59", "force law without memory: order of what it leaves of the expansion, against 4", abs(order - 4), 0.02)
    x, weight = hs.on_panels([0, 1])
    d = 1 - x**2
    v2 = -np.expm1(2.5 * np.log1p(-(x**2)))
    time = weight * 2 * x / np.sqrt(v2)
    found = 2.5 * 2 * np.sum(time * (3 / 64 * v2**2 - 15 / 32 * d**2.5 * v2))
    # both second derivatives by the root of d, which the first has below and the second above
    curved, stored = 0.75 * v2 - 1.875 * d**2.5, 3.75 * v2 - 3.125 * d**2.5
    exact = -2 * np.sum(time * curved * stored) / 24
    report.row("T59", "work of its third order against -(1/24) int p'' (p^(5/3))'' dt of Hertz's pulse", abs(found - exact), 1e-6)
    report.row("T59", "the same against the code's -0.252130892", abs(found + 0.252130892), 1e-8)


def balls(report):
    """(T47), (T51): a steel ball on steel, radius 5 mm."""
    memory, errors = None, []
    for speed, quoted in ((1.0, 0.006643), (20.0, 0.039227)):
        hit = Collision(speed, 4 / 3 * np.pi * 7800 * 0.005**3, 0.005, 208e9, 0.29, 208e9, 0.29, 7800)
        memory = memory or marches.Memory(hit.medium, PUNCH)
        c = hit.reduced_lag()
        report.row(
            "T47",
            "lag of the growing contact (2/3) phi tau (3/2) int V_centre against J/(mu c2)",
            abs(hit.phi * hit.tau * 2 / 3 * memory.moments[0] / c - 1),
            1e-9,
        )
        loss = 1 - dashpot(c)["e"] ** 2
        report.row(
            "T51",
            f"ball at {speed:.0f} m/s, damped ODE, 1 - e^2 = {loss:.6f} against {quoted} (particle code)",
            abs(loss / quoted - 1),
            3e-4,
        )
        e = [marches.growing(memory, hit.phi, hit.tau, TIME / n) for n in (800, 1600)]
        full = 1 - (2 * e[1] - e[0]) ** 2
        errors.append(abs(full / loss - 1))
        first, length = LOSS * c, memory.length * hit.tau
        allowed = 0.4 * first**2 + 0.3 * first * length + 0.06 * first * length**0.5
        report.row(
            "T58",
            "restitution: what the first order leaves out over its estimate",
            abs((1 - full) ** 0.5 - (1 - first) ** 0.5) / allowed,
            1,
        )
        report.row("T58", "loss: the same", abs(full / first - 1) / (0.75 * first + 0.25 * length**2), 1)
        report.row(
            "T47, T51", f"the same with full memory, 1 - e^2 = {full:.6f}, against the damped ODE", errors[-1], 3e-3
        )
