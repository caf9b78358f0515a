"""Section 2.7 of docs/theory.md: responses of sensors."""

import mpmath as mp
import numpy as np
from scipy.integrate import solve_ivp
from scipy.signal import lfilter

from .report import relative

NODES = np.arange(-2, 3)


def lagrange(nodes, i):
    """Coefficients of L_i, the highest power first."""
    poly = np.poly1d([1.0])
    for k, node in enumerate(nodes):
        if k != i:
            poly = poly * np.poly1d([1.0, -node]) / (nodes[i] - node)
    return poly


def weights(q, nodes=NODES):
    """w_i by Gauss's rule with many points."""
    t, w = np.polynomial.legendre.leggauss(60)
    t, w = 0.5 * (t - 1), 0.5 * w
    return np.array([np.sum(w * np.exp(-q * t) * lagrange(nodes, i)(t)) for i in range(len(nodes))])


def circle(taps, points=4000):
    """The sum sum_i w_i e^{i theta i} of taps around the middle, on the unit circle."""
    theta = 2 * np.pi * np.arange(points + 1) / points
    reach = len(taps) // 2
    return sum(tap * np.exp(1j * theta * (i - reach)) for i, tap in enumerate(taps))


def turns(values):
    return round(np.sum(np.angle(values[1:] / values[:-1])) / (2 * np.pi))


def factors(taps):
    """Past and future of a real sum from the roots of its polynomial; the future begins with one."""
    reach = len(taps) // 2
    # the highest power is the furthest future
    roots = np.roots(taps[::-1])
    inside, outside = roots[abs(roots) < 1], roots[abs(roots) > 1]
    if len(outside) != reach:
        return None
    past = np.poly(inside).real
    future = np.poly(1 / outside).real
    scale = taps.sum() / (past.sum() * future.sum())
    return scale * past, future


class Section:
    """A real root or a pair, as (T72) has them."""

    def __init__(self, root, step):
        qs = [root * step] if root.imag == 0 else [root * step, np.conj(root) * step]
        self.recursion, taps = np.ones(1), np.ones(1)
        for q in qs:
            self.recursion = np.convolve(self.recursion, [1, -np.exp(q)])
            taps = np.convolve(taps, step * weights(q))
        self.recursion = self.recursion.real
        self.taps = taps.real
        self.past, self.future = factors(self.taps)


def output(poles, zeros, samples, step):
    """The output where the samples end in zeros, so that nothing has to be continued."""
    found, sections = samples, []
    for root in zeros:
        section = Section(root, step)
        sections.append((section, False))
        found = lfilter(section.recursion, section.past, found)
    for root in poles:
        section = Section(root, step)
        sections.append((section, True))
        found = lfilter(section.past, section.recursion, found)
    for section, is_pole in sections:
        pair = ([1.0], section.future) if not is_pole else (section.future, [1.0])
        found = lfilter(*pair, found[::-1])[::-1]
    return found


def pulse(t):
    return np.where((t > 0) & (t < 1), np.sin(np.pi * t) ** 4, 0.0)


def exact(poly, zeros, times):
    """sum zeros_k s^k / poly(s) of the pulse by an ordinary differential equation."""
    b, c = poly[1], poly[2]

    def slope(t, y):
        return [y[1], pulse(t) - b * y[1] - c * y[0]]

    options = {"rtol": 1e-13, "atol": 1e-16, "method": "DOP853", "max_step": 0.02}
    found = solve_ivp(slope, (0, times[-1]), [0, 0], t_eval=times, **options)
    y = found.y
    second = pulse(times) - b * y[1] - c * y[0]
    return zeros[0] * y[0] + zeros[1] * y[1] + zeros[2] * second


def minimum_phase(f, a, at):
    """The phase of straight lines of ln a over f, by the integral of (T72)."""
    total = mp.mpf(0)
    for (f0, a0), (f1, a1) in zip(zip(f, a), zip(f[1:], a[1:])):
        slope = (mp.log(a1) - mp.log(a0)) / (f1 - f0)
        total += slope * mp.quad(lambda g: mp.log(abs((g + at) / (g - at))), [f0, f1])
    return total / mp.pi


def check(report):
    """(T72)."""
    rng = np.random.default_rng(72)
    worst = 0.0
    for q in (-1e-3, -0.4 + 2.0j, -12.0):
        for degree in range(5):
            value = mp.quad(lambda t: mp.exp(-mp.mpmathify(q) * t) * t**degree, [-1, -0.5, 0])
            worst = max(worst, abs(complex(value) - np.sum(weights(q) * NODES.astype(float) ** degree)) / abs(value))
    report.row("T72", "a step of one pole under polynomials to degree 4 against their integrals, 3 poles", worst, 1e-11)
    worst, least = 0, np.inf
    for _ in range(300):
        size, damping = 10 ** rng.uniform(-5, np.log10(3.1)), rng.uniform(0, 1) ** 3
        q = size * (-damping + 1j * np.sqrt(1 - damping**2))
        values = circle(weights(q))
        worst, least = max(worst, abs(turns(values))), min(least, abs(values).min() / abs(values).max())
    report.row("T72", "turns of the sum around zero on the unit circle, 300 poles below half the rate", worst, 0)
    report.fails("T72", "its smallest magnitude there over its largest: the inverse is bounded", least, 0.1)
    cubic = abs(np.sum(weights(0.0, np.arange(-2, 2)) * (-1.0) ** np.arange(4)))
    report.row("T72", "the sum of four samples at half the sampling rate, where it has a zero", cubic, 1e-14)
    pole = -0.3 + 9.0j
    poly = np.poly([pole, np.conj(pole)]).real
    errors = []
    for steps in (20, 40, 80):
        step = 1.0 / steps
        times = step * np.arange(-10, 6 * steps)
        late = times >= 0
        found = output([pole], [], pulse(times), step)[late]
        errors.append(relative(found[:-10], exact(poly, [1, 0, 0], times[late])[:-10]))
    report.row("T72", "sin^4 through a resonance against its differential equation, 80 steps", errors[2], 1e-6)
    report.fails("T72", "order of convergence from 20 to 80 steps", np.log2(errors[0] / errors[2]) / 2, 4.0)
    # long enough before and after, so that what looks ahead has decayed
    step = 1.0 / 80
    times = step * np.arange(-40, 480)
    late = times >= 0
    zeros = [0j, -2.0 + 0j]
    found = output([pole], zeros, pulse(times), step)
    error = relative(found[late][:-10], exact(poly, [0, 2, 1], times[late])[:-10])
    report.row("T72", "the same with zeros at 0 and -2", error, 1e-7)
    back = output(zeros, [pole], found, step)
    error = relative(back[:-40], pulse(times)[:-40])
    report.row("T72", "and back, with poles and zeros exchanged", error, 1e-10)
    f = np.concatenate([[0.0], np.geomspace(0.01, 1e5, 600)])
    for name, response in (
        ("a low pass", lambda x: 1 / (1 + 1j * x)),
        ("a resonance", lambda x: (1 + 0.3j * x) / (1 - x * x + 0.4j * x)),
    ):
        row = 180
        phase = float(minimum_phase(f, abs(response(f)), f[row]))
        error = abs(phase - np.angle(response(f[row])))
        report.row("T72", f"phase of {name} from its amplitudes, 600 rows to 1e5", error, 2e-3)
