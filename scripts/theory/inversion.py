"""Forces from traces: the fit of a pulse, the force history, the ball, and the noise of a sensor."""

import numpy as np
from scipy.integrate import quad, solve_ivp
from scipy.stats import multivariate_normal, norm

SAMPLES = 25
FINER = 8
START = 0.313
HERTZ = 2.943275184324705


def pekeris(t):
    """Integral over time of w at the surface under a step, nu = 1/4, mu r = 1, t in r/c2 (Pekeris 1955)."""
    root = np.sqrt(3)
    a, b, c, d = 3 * root + 5, (3 + root) / 4, 3 * root - 5, (3 - root) / 4
    onset, last = 1 / root, np.sqrt(3 + root) / 2

    def ray(x):
        return np.sqrt(a) * np.arcsin(np.minimum(x / np.sqrt(b), 1))

    def first(x):
        logs = np.sqrt(c) * np.log(x + np.sqrt(x * x - d)) - root * np.log(x + np.sqrt(x * x - 0.25))
        return (6 * x - ray(x) + logs) / (32 * np.pi)

    def second(x):
        return (6 * x - ray(x)) / (16 * np.pi)

    early = first(np.clip(t, onset, 1)) - first(onset) + second(np.clip(t, 1, last)) - second(1)
    return early + 3 / (8 * np.pi) * np.maximum(t - last, 0)


def response(velocity, distance, width, count):
    """To a hat of force of this half width, every width; the velocity is a mean over a sampling interval."""
    t = np.arange(count) * width

    def displacement(t):
        return sum(weight * pekeris((t + shift) / distance) for shift, weight in ((width, 1), (0, -2), (-width, 1))) / width

    half = 0.5 / SAMPLES
    return (displacement(t + half) - displacement(t - half)) * SAMPLES if velocity else displacement(t)


def hertz():
    """Hertz's pulse over a duration of one, with the largest force one."""
    motion = solve_ivp(lambda _, z: [z[1], -1.25 * max(z[0], 0) ** 1.5], (0, HERTZ / 2), [0, 1], "DOP853", rtol=1e-12, atol=1e-14, dense_output=True)

    def pulse(x):
        x = np.asarray(x, dtype=float)
        half = np.where(x < 0.5, x, 1 - x)
        return np.where(half > 0, np.maximum(motion.sol(np.clip(half, 0, 0.5) * HERTZ)[0], 0) ** 1.5, 0)

    return pulse


def trace(pulse, velocity, distance, parameters):
    """Samples of the trace of a pulse of this peak, duration and start."""
    peak, duration, start = parameters
    count = int((1.0877 * distance + 1.7 + START) * SAMPLES) * FINER
    width = 1 / (SAMPLES * FINER)
    force = peak * pulse((np.arange(count) * width - start) / duration)
    return np.convolve(response(velocity, distance, width, count), force)[:count:FINER]


def bounds(pulse, velocity, distance):
    """Standard deviations of peak, duration and start by the bound of Cramer and Rao for a noise of 1 % of the peak."""
    exact, step = np.array([1, 1, START]), 1e-3
    columns = [trace(pulse, velocity, distance, exact + step * e) - trace(pulse, velocity, distance, exact - step * e) for e in np.eye(3)]
    jacobian = np.array(columns).T / (2 * step)
    noise = 0.01 * np.abs(trace(pulse, velocity, distance, exact)).max()
    return np.sqrt(np.diag(np.linalg.inv(jacobian.T @ jacobian / noise**2)))


def check_fit(report, pulse):
    """The table of (T73)."""
    table = {
        (False, 0.5): (0.34, 0.30, 0.18),
        (False, 2): (0.33, 0.22, 0.13),
        (False, 10): (0.31, 0.22, 0.13),
        (True, 0.5): (0.27, 0.06, 0.03),
        (True, 2): (0.29, 0.07, 0.05),
        (True, 10): (0.29, 0.07, 0.05),
    }
    worst = max(np.abs(100 * bounds(pulse, *place) - row).max() for place, row in table.items())
    report.row("T73", "bounds of peak, duration and start in per cent against the table", worst, 0.006)
    draws, exact = np.random.default_rng(73), np.array([1, 1, START])
    clean = trace(pulse, False, 2, exact)
    columns = [trace(pulse, False, 2, exact + 1e-3 * e) - trace(pulse, False, 2, exact - 1e-3 * e) for e in np.eye(3)]
    jacobian = np.array(columns).T / 2e-3
    found = []
    for _ in range(400):
        data, here = clean + 0.01 * np.abs(clean).max() * draws.normal(size=len(clean)), exact.copy()
        for _ in range(3):
            here = here + np.linalg.lstsq(jacobian, data - trace(pulse, False, 2, here), rcond=None)[0]
        found.append(here)
    ratio = np.std(found, axis=0) / bounds(pulse, False, 2)
    report.row("T73", "scatter of 400 fits over the bounds", np.abs(ratio - 1).max(), 0.12)


def check_history(report, pulse):
    """Likelihood, band of a pinned sample."""
    width, count = 1 / SAMPLES, 60
    kernel = response(False, 0.5, width, count)
    rows = np.array([[kernel[i - j] if i >= j else 0 for j in range(8, 36)] for i in range(count)])
    clean = rows @ pulse((np.arange(8, 36) * width - START) / 1)
    noise = 0.05 * np.abs(clean).max()
    a, d = rows / noise, clean / noise + np.random.default_rng(1).normal(size=count)
    size = a.shape[1]
    second = np.array([[{0: 1, 1: -2, 2: 1}.get(i - j, 0) for j in range(size)] for i in range(size + 2)])
    penalty = second.T @ second

    def likelihood(weight):
        matrix = a.T @ a + weight * penalty
        right = a.T @ d
        return 0.5 * (right @ np.linalg.solve(matrix, right) - np.linalg.slogdet(matrix)[1] + size * np.log(weight))

    def direct(weight):
        covariance = np.eye(count) + a @ np.linalg.solve(weight * penalty, a.T)
        return multivariate_normal(np.zeros(count), covariance).logpdf(d)

    weights = [1.0, 30.0, 1e3]
    differences = [[f(w) - f(weights[0]) for w in weights] for f in (likelihood, direct)]
    report.row("T73", "likelihoods of three weights against the density of the traces", np.abs(np.subtract(*differences)).max(), 1e-6)

    sampling = np.linalg.inv(a.T @ a + 30 * penalty)
    linear = sampling @ a.T @ a @ sampling
    by_penalty = sampling - 30 * sampling @ penalty @ sampling
    report.row("T73", "covariance of the noise from that of the posterior", np.abs(linear - by_penalty).max() / np.abs(linear).max(), 1e-9)

    mean, deviation = -0.7, 0.4
    end = mean + deviation * norm.isf(0.05 * norm.sf(-mean / deviation))
    density = norm(mean, deviation).pdf
    report.row("T73", "a pinned sample is below its upper end with 95 %", abs(quad(density, 0, end)[0] / quad(density, 0, 9)[0] - 0.95), 1e-9)


def check_ball(report):
    """A ball on Hertz's spring, followed by Runge and Kutta, from its peak and duration."""
    mass, radius, velocity, modulus = 2.6e-4, 0.002, 0.5, 1.1e11
    k = 4 / 3 * modulus * np.sqrt(radius)
    scale = (1.25 * mass * velocity**2 / k) ** 0.4

    def turned(_, z):
        return z[1]

    turned.terminal, turned.direction = True, -1
    motion = solve_ivp(lambda _, z: [z[1], -k * max(z[0], 0) ** 1.5 / mass], (0, 5 * scale / velocity), [0, velocity], "DOP853", events=turned, rtol=1e-12, atol=1e-18)
    peak, duration = k * motion.y[0, -1] ** 1.5, 2 * motion.t[-1]
    alpha = (peak / k) ** (2 / 3)
    found = HERTZ * alpha / duration
    report.row("T73", "velocity of a ball from peak and duration", abs(found / velocity - 1), 1e-8)
    heavy = 4 * k * alpha**2.5 / (5 * found**2)
    report.row("T73", "mass of a ball from peak and duration", abs(heavy / mass - 1), 1e-8)
    density = mass / (4 / 3 * np.pi * radius**3)
    over = 0.8 * (4 / 3 * modulus) ** (2 / 3) * peak ** (1 / 3) * (duration / HERTZ) ** 2
    report.row("T73", "radius of a ball of known density", abs((3 * over / (4 * np.pi * density)) ** 0.375 / radius - 1), 1e-8)


def burg(x, order):
    """Autoregressive coefficients and power of the residual."""
    forward, backward, a, power = x.copy(), x.copy(), np.array([1.0]), np.mean(x * x)
    for _ in range(order):
        f, b = forward[1:], backward[:-1]
        k = -2 * (f @ b) / (f @ f + b @ b)
        forward, backward = f + k * b, b + k * f
        a = np.append(a, 0) + k * np.append(a, 0)[::-1]
        power *= 1 - k * k
    return a, power


def check_noise(report):
    """(T74): a resonance is an autoregressive process of the second order."""
    radius, angle = 0.98, 0.4
    exact = np.array([1, -2 * radius * np.cos(angle), radius**2])
    draws = np.random.default_rng(74).normal(size=40_500)
    x = np.zeros(len(draws))
    for i in range(2, len(x)):
        x[i] = draws[i] - exact[1] * x[i - 1] - exact[2] * x[i - 2]
    a, power = burg(x[500:], 2)
    report.row("T74", "Burg's coefficients of a resonance of 40,000 samples", np.abs(a - exact).max(), 0.01)
    report.row("T74", "power of its residual", abs(power - 1), 0.02)
    white = np.convolve(x[500:], a)[2:40_000] / np.sqrt(power)
    lags = [np.mean(white[lag:] * white[: len(white) - lag]) for lag in range(1, 30)]
    report.row("T74", "correlation of the whitened noise at 29 lags", np.abs(lags).max(), 0.02)
    raw = x[500:] / x[500:].std()
    report.fails("T74", "the same of the noise itself", abs(np.mean(raw[1:] * raw[:-1])), 0.5)


def check(report):
    """(T73) and (T74)."""
    pulse = hertz()
    check_fit(report, pulse)
    check_history(report, pulse)
    check_ball(report)
    check_noise(report)
