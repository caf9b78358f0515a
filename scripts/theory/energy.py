"""Section 5 of docs/theory.md: the growing contact as a sum of punches, and the energy balance."""

import numpy as np

from . import halfspace as hs
from . import marches
from .collision import PAPER, TIME, Collision
from .halfspace import Medium
from .report import relative
from .surface import CENTRE, MEAN, PUNCH, measure


def superposition(report):
    """(T48), (T54), (T55), (T60)."""
    error = 0
    for r in (0.0, 0.4, 0.9):
        # a = sqrt(r^2 + s^2): a da = s ds; P = a^3
        s, weight = hs.on_panels([0, (1 - r * r) ** 0.5])
        a = np.sqrt(r * r + s * s)
        found = np.sum(weight * s / a * 3 * a * a / (2 * np.pi * a * s))
        error = max(error, abs(found - hs.PRESSURE["hertz"](r)))
    report.row("T54", "Hertz's pressure as a sum of punches, r = 0, 0.4, 0.9", error, 1e-12)
    k, h = 1.7, 1e-4
    slope = ((1 + h) ** 3 * hs.HANKEL["hertz"](k * (1 + h)) - (1 - h) ** 3 * hs.HANKEL["hertz"](k * (1 - h))) / (2 * h)
    report.row(
        "T54",
        "d/da [a^3 Z_H(ka)] of Hertz against 3 a^2 Z_H(ka) of the punch",
        abs(slope - 3 * hs.HANKEL["punch"](k)),
        1e-7,
    )
    medium = Medium(0.3)
    a, weight = hs.on_panels([0, 1])
    r, z = 0.6, 0.5
    total = np.zeros(6)
    for radius, part in zip(a, weight):
        if radius < 1e-4:
            continue
        field = hs.static(medium, "punch", r / radius, z / radius)
        total += part * 3 * radius**2 * field / np.array([radius] * 2 + [radius**2] * 4)
    exact = hs.static(medium, "hertz", r, z)
    report.row(
        "T54",
        "Huber's field as a sum of punch fields of radii 0 to 1, six fields",
        np.max(abs(total - exact)) / np.max(abs(exact)),
        1e-8,
    )
    force = lambda t: np.sin(t) ** 3
    t, weight = hs.on_panels([0, np.pi / 2, np.pi])
    error = 0
    for s, k in ((0.4, 1.5), (1.0, 6.0)):
        radius, e = np.maximum(np.sin(t), 1e-12), np.exp(-s * t)
        punches = np.sum(weight * e * 3 * np.sin(t) ** 2 * np.cos(t) * hs.HANKEL["punch"](k * radius))
        z = np.where(k * radius < 1e-3, 0.5 / np.pi, hs.HANKEL["hertz"](np.maximum(k * radius, 1e-3)))
        hertz = s * np.sum(weight * e * force(t) * z)
        error = max(error, abs(punches - hertz))
    report.row(
        "T55", "load of a contact that grows and shrinks: punches against Hertz's pressure, transforms", error, 1e-7
    )
    worst = []
    for count, k in ((4, 4.0), (8, 8.0), (8, 12.0)):
        nodes = np.cos((2 * np.arange(count) + 1) * np.pi / (4 * count))
        a = np.linspace(0.01, 1, 200)
        found = np.zeros_like(a)
        for j, node in enumerate(nodes):
            others = np.delete(nodes, j)
            share = np.prod((a[:, None] ** 2 - others**2) / (node**2 - others**2), axis=1)
            found += share * hs.HANKEL["hertz"](k * node)
        worst.append(np.max(abs(found - hs.HANKEL["hertz"](k * a))))
    report.row("T60", "4 discs for all radii at k a = 4, over Z_H(0): off by", worst[0] * 2 * np.pi, 1e-3)
    report.row("T60", "8 discs at k a = 8", worst[1] * 2 * np.pi, 3e-6)
    report.row("T60", "8 discs at k a = 12", worst[2] * 2 * np.pi, 1e-3)
    rates(report, medium)
    memory = marches.Memory(medium, PUNCH)
    # y = t/(tau sqrt(v t)): d_end = phi v int V_p dt
    t, weight = hs.on_panels([0, 0.5, 2.0, memory.length**2])
    V = np.array([memory.left(v**0.5) for v in t])
    report.row(
        "T48", "int V_p(sqrt(x)) dx against 2 int t V_p dt", abs(np.sum(weight * V) / (2 * memory.moments[1]) - 1), 1e-6
    )


def rates(report, medium):
    """(T61)."""
    nodes = np.cos((2 * np.arange(5) + 1) * np.pi / 20)
    load = lambda t, share: np.sin(t) ** 3 * share(np.sin(t) ** 2)
    error = 0
    for j, node in enumerate(nodes):
        share = np.poly1d(np.poly(np.delete(nodes, j) ** 2))
        share /= share(node**2)
        for t in (0.3, 0.8, 1.4, 2.5):
            a2 = np.sin(t) ** 2
            found = (share(a2) + 2 / 3 * a2 * share.deriv()(a2)) * 3 * a2 * np.cos(t)
            exact = load(t + 1e-30j, share).imag / 1e-30
            error = max(error, abs(found - exact))
    report.row(
        "T61", "rate of P phi_j(a^2) at a^3 = P = sin^3 t against a derivative over an imaginary step", error, 1e-12
    )
    r, z, t, h = 0.5, 0.6, 2.6, 2e-3
    fronts = hs.arrivals(medium, r, z)
    static = hs.static(medium, "hertz", r, z)

    def fields(force, slope, t):
        """P f_static + int P' R of the displacements."""
        breaks = [0, *(t - front for front in reversed(fronts) if front < t), t]
        past, weight = hs.on_panels(breaks, hs.double_exponential(16, 2.8))
        rest = [hs.remainder(medium, "hertz", r, z, float(t - s)) if t - s > fronts[0] else -static for s in past]
        return (force(t) * static + (weight * slope(past)) @ np.array(rest))[:2]

    # P = t^3 - t^2/2 + t/5, whose rate begins with a jump
    cubic = np.poly1d([1, -0.5, 0.2, 0])
    rate = cubic.deriv()
    after, before = (fields(cubic, rate, t + x) for x in (h, -h))
    jump = rate(0) * hs.remainder(medium, "hertz", r, z, t)[:2]
    found = fields(rate, rate.deriv(), t) + jump
    report.row(
        "T61",
        "u, w: the rate of a cubic force convolved against a difference over 4e-3",
        relative(found, (after - before) / (2 * h)),
        1e-5,
    )


def energy(report):
    """(T56), (T57)."""
    hit = Collision(E1=123e9, **PAPER)
    mean, centre = (marches.Memory(hit.medium, chord) for chord in (MEAN, CENTRE))
    sigma = {name: chord[2] * 0.7 * hit.unit for name, chord in (("mean", MEAN), ("centre", CENTRE))}
    h = TIME / 2000

    def ledger(memory, name):
        t, p, d, w, _, e = marches.fixed_disc(memory, sigma[name], hit.wave_time, h)
        cells = int(np.ceil(mean.length * hit.wave_time / h)) + 1
        g = np.diff(mean.integral(h * np.arange(cells + 1) / hit.wave_time) * hit.wave_time) / h
        delayed = np.convolve(np.diff(p), g)[: len(p) - 1]
        moved = sigma["mean"] * (p - np.concatenate([[0], delayed]))
        radiated = 2.5 * np.sum(0.5 * (p[1:] + p[:-1]) * np.diff(moved))
        return e * e + radiated - 1, t, p, d, w

    residual, t, p, d, w = ledger(mean, "mean")
    report.row("T56", "mean deflection: rebound + radiated - 1, rebound from the momentum", abs(residual), 2e-5)
    i = int(0.37 * len(p))
    speed = (d[i + 1] - d[i - 1]) / (2 * h)
    work = np.sum(0.5 * (p[1 : i + 1] + p[:i]) * np.diff(w[: i + 1]))
    total = speed**2 + 2.5 * (0.4 * p[i] ** (5 / 3) + work)
    report.row(
        "T56",
        "the same in the middle of the contact: kinetic + Hertz's spring + work on the surface",
        abs(total - 1),
        2e-5,
    )
    residual = ledger(centre, "centre")[0]
    report.fails(
        "T56",
        f"centre deflection: its contact law does other work than the pressure, residual {residual:.1e}",
        abs(residual),
        1e-4,
    )
    least = {}
    omega = np.linspace(0.05, 12, 600)
    for name, chord in (("mean", MEAN), ("punch", PUNCH), ("centre", CENTRE)):
        eta, weight = hs.on_panels([0, chord[1] / 2, chord[1]])
        spectrum = np.cos(np.outer(np.linspace(0, 60, 12001), eta)) @ (weight * chord[0](eta))
        for nu in (0.0, 0.3, 0.45):
            x, mass = measure(Medium(nu))
            inside = [np.sum(mass * x * np.interp(o * x, np.linspace(0, 60, 12001), spectrum)) for o in omega]
            least[name] = min(least.get(name, 1.0), min(inside))
    report.row(
        "T57",
        "cosine transform of V of the means, nu = 0, 0.3, 0.45: how far below zero",
        max(0, -least["mean"], -least["punch"]),
        1e-9,
    )
    report.fails("T57", "the same of the centre: it is not passive", -least["centre"], 1e-3)


def check(report):
    """All of section 5."""
    superposition(report)
    energy(report)
