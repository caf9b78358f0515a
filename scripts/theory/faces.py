"""Sections 2.7 and 5.4 of docs/theory.md: means over faces, and peaks between samples."""

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.special import j0, jv, spherical_jn

NODES, WEIGHTS = np.polynomial.legendre.leggauss(200)


def arc(r, centre, radius):
    """Half of the angle of the arc of a circle around the axis that lies on a face."""
    cosine = (r * r + centre * centre - radius * radius) / (2 * r * centre)
    return np.arccos(np.clip(cosine, -1, 1))


def mean(k, centre, radius):
    """Mean of J_0(k r) over a face by its arcs, and of J_1(k r) cos(angle)."""
    angle = 0.5 * np.pi * (NODES + 1)
    r = centre - radius * np.cos(angle)
    weight = 0.5 * np.pi * WEIGHTS * radius * np.sin(angle) * 2 * r / (np.pi * radius**2)
    half = arc(r, centre, radius)
    return np.sum(weight * half * j0(k * r)), np.sum(weight * np.sin(half) * jv(1, k * r))


def check(report):
    """(T71) and (T75)."""
    worst = 0.0
    for k, centre, radius in [(1.0, 3.0, 1.0), (4.0, 2.0, 1.5), (7.0, 5.0, 0.8), (0.3, 10.0, 4.0)]:
        face = 2 * jv(1, k * radius) / (k * radius)
        even, odd = mean(k, centre, radius)
        worst = max(worst, abs(even - face * j0(k * centre)), abs(odd - face * jv(1, k * centre)))
    report.row("T71", "means of J_0 and of J_1 cos over a face by arcs against 2 J_1(kb)/(kb) of the centre", worst, 1e-10)
    worst = 0.0
    for count, x in [(4, 1.0), (6, 2.0), (8, 3.0), (12, 6.0)]:
        angle = np.pi * np.arange(1, count + 1) / (count + 1)
        rule = 2 / (count + 1) * np.sum(np.sin(angle) ** 2 * np.cos(x * np.cos(angle)))
        bound = (x / 2) ** (2 * count) / np.prod(np.arange(1.0, 2 * count + 1))
        worst = max(worst, abs(rule - 2 * jv(1, x) / x) / bound)
    report.row("T71", "error of the rule for plane waves over (x/2)^(2n)/(2n)!", worst, 1.0)
    x = np.linspace(1e-3, 150, 40000)
    weight = 1 / (1 + x * x)
    for load, bound in [(0.0, 2e-5), (0.3, 5e-5)]:
        radii = [0.45, 0.7, 0.9 + 0.1 * load, 1.0 + 0.25 * load, 1.013 + 0.8 * load]
        disc = lambda y: np.where(y > 1e-3, 3 * spherical_jn(1, y) / np.maximum(y, 1e-3), 1.0)
        columns = np.array([disc(b * x) for b in radii]).T
        wanted = 2 * jv(1, x) / x * disc(load * x)
        whole = 1e4 * np.sqrt(np.sum(weight**2))
        rows = np.vstack([columns * weight[:, None], whole * np.ones((1, 5))])
        shares = np.linalg.lstsq(rows, np.append(wanted * weight, whole), rcond=None)[0]
        left = np.sqrt(np.sum(((columns @ shares - wanted) * weight) ** 2) / np.sum(weight**2))
        report.row("T71", f"five discs for a face and a load of {load} of its radius, rms over waves 1/(1 + x^2)", left, bound)
    # a(s) = sqrt(s): the slowest front
    for speed in (0.5, 2.0):
        found = minimize_scalar(lambda s: s - np.sqrt(s) / speed, bounds=(1e-9, 4 / speed**2), method="bounded", options={"xatol": 1e-12})
        report.row("T75", "first of the edge's fronts where a' = c_R, for a = sqrt(s)", abs(found.x * (2 * speed) ** 2 - 1), 1e-4)
