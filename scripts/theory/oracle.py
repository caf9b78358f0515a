"""Section 2.10 of docs/theory.md: a uniform pressure as a sum of punches, and forces on a response that is a distribution."""

import numpy as np
from scipy.integrate import quad
from scipy.special import jv


def check(report):
    """(T76) and (T77)."""
    worst = 0.0
    for r in (0.0, 0.3, 0.8, 0.99):
        # a^2 = r^2 + (1 - r^2) s^2 takes away both roots
        found = quad(lambda s: 4 / np.pi / (2 * np.pi) * np.sqrt((1 - r * r) / (1 - (r * r + (1 - r * r) * s * s))), 0, 1, limit=200)[0]
        worst = max(worst, abs(found * np.pi - 1))
    report.row("T76", "sum of the pressures of punches over the uniform one", worst, 1e-7)
    errors = []
    for count in (4, 8, 16):
        x = 0.5 * np.pi * np.arange(1, count + 1) / count
        weight = np.where(np.arange(1, count + 1) == count, 1.0, 2.0) / count * np.sin(x) ** 2
        k = 9.0
        errors.append(abs(np.sum(weight * np.sin(k * np.sin(x)) / (2 * np.pi * k * np.sin(x))) * np.pi * k / jv(1, k) - 1))
    report.row("T76", "its transform by the trapezoidal rule of 16 punches, k = 9", errors[2], 1e-12)
    report.fails("T76", "digits of 8 punches over those of 4", np.log(errors[1]) / np.log(errors[0]), 2.0)

    # a delta at 1 and a root after it: G has a step
    def response(t):
        return np.where(t > 1, 2 * np.sqrt(np.maximum(t - 1, 0)), 0.0)

    def integral(t):
        return np.where(t > 1, 0.7 + 4 / 3 * np.maximum(t - 1, 0) ** 1.5, 0.0)

    t = 2.3
    rate, second = (lambda s: -2 * (s - 0.8) * np.exp(-((s - 0.8) ** 2))), (lambda s: (4 * (s - 0.8) ** 2 - 2) * np.exp(-((s - 0.8) ** 2)))
    direct = 0.7 * rate(t - 1) + quad(lambda s: rate(t - s) * response(s), 1, 9)[0]
    report.row("T77", "a wavelet on a delta and a root against the time integral", abs(quad(lambda s: second(t - s) * integral(s), 1, 9)[0] / direct - 1), 1e-9)
    kinks, slopes = [0.0, 0.4, 1.0], [1.0, -3.0, 2.0]
    lines = sum(m * integral(np.array(t - s)) for s, m in zip(kinks, slopes))
    slope = lambda s: sum(m for k, m in zip(kinks, slopes) if k <= s)
    direct = 0.7 * slope(t - 1) + quad(lambda s: slope(t - s) * response(np.array(s)), 1, t, points=[t - k for k in kinks], limit=200)[0]
    report.row("T77", "lines on the same against the sum over kinks", abs(lines / direct - 1), 1e-8)
