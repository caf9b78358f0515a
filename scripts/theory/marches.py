"""Simple marches of the impact equation in collision units, written from docs/theory.md, section 4."""

import numpy as np

from . import halfspace as hs
from .surface import measure, step


def root(a, b):
    """y >= 0 of a y^3 + y^2 = b."""
    if b <= 0:
        return 0.0
    y = min(b**0.5, 1e9)
    for _ in range(60):
        change = ((a * y + 1) * y * y - b) / ((3 * a * y + 2) * y)
        y -= change
        if abs(change) < 1e-15 * y:
            break
    return y


class Memory:
    """V = 1 - W of a chord function and its integral, in r0/c1."""

    def __init__(self, medium, chord):
        self.medium, self.chord = medium, chord
        self.length = chord[1] / medium.c
        eta, weight = hs.on_panels([0, chord[1]])
        x, mass = measure(medium)
        # int s^n V ds
        self.moments = [np.sum(weight * chord[0](eta) * eta**n) * np.sum(mass * x ** (n + 1)) for n in range(4)]
        grid = np.linspace(0, 1, 1201) ** 2 * self.length
        node, rule = np.polynomial.legendre.leggauss(6)
        half = 0.5 * np.diff(grid)
        t = 0.5 * (grid[1:] + grid[:-1])[:, None] + half[:, None] * node
        values = np.array([1 - step(medium, chord, v) for v in t.ravel()]).reshape(t.shape)
        self.grid = grid
        self.area = np.concatenate([[0], np.cumsum((values * rule * half[:, None]).sum(axis=1))])
        self.value = np.array([1 - step(medium, chord, v) if v else 1.0 for v in grid])

    def left(self, t):
        """V at any t >= 0."""
        return 1 - step(self.medium, self.chord, t) if 0 < t < self.length else float(t == 0)

    def integral(self, t):
        """int_0^t V, t >= 0, cubic between the nodes."""
        t = np.minimum(t, self.length)
        i = np.clip(np.searchsorted(self.grid, t, side="right") - 1, 0, len(self.grid) - 2)
        width = self.grid[i + 1] - self.grid[i]
        x = (t - self.grid[i]) / width
        rise = self.area[i + 1] - self.area[i]
        a, b = self.value[i] * width - rise, self.value[i + 1] * width - rise
        return self.area[i] + x * (rise + (1 - x) * ((1 - x) * a - x * b))


def start_constants(h, sigma, samples=4):
    """E_0 and E_1 of (T40) for a force that starts as (T44)."""
    y = np.array([root(sigma, j * h) for j in range(1, samples + 1)])
    t, p = h * np.arange(1, samples + 1), y**3
    weight = np.ones(samples)
    weight[-1] = 0.5
    y, end = y[-1], t[-1]
    u = 2 + 3 * sigma * y
    d1, d2, d3 = 3 * y / u, 6 / (y * u**3), -6 * (u + 9 * sigma * y) / (y**3 * u**5)
    tail = lambda first, third: h * h / 12 * (first - h * h / 60 * third)
    force = y**5 * (0.4 + 0.5 * sigma * y) - h * np.sum(weight * p) + tail(d1, d3)
    moment = y**7 * (2 / 7 + sigma * y * (5 / 8 + sigma * y / 3)) - h * np.sum(weight * t * p)
    return force, moment + tail(p[-1] + end * d1, 3 * d2 + end * d3)


def fixed_disc(memory, sigma, wave_time, h, full=True):
    """(T36) by (T40) to (T42); returns time, p, d, w, contact time and e."""
    cells = int(np.ceil(memory.length * wave_time / h)) + 1
    area = memory.integral(h * np.arange(cells + 1) / wave_time) * wave_time
    g = np.diff(area) / h
    share = 1.0 if full else 0.0
    elastic = sigma * (share - g[0])
    first, second = start_constants(h, max(elastic, 0))
    p, d, w = [0.0], [0.0], [0.0]
    total = double = 0.0
    while True:
        n = len(p)
        free = n * h - 1.25 * (h * h * double + first * n * h - second)
        steps = np.diff(p)[::-1][: cells - 1]
        past = np.sum(g[1 : 1 + len(steps)] * steps)
        known = sigma * (g[0] * p[-1] - past)
        inertia = 1.25 * h * h / 12
        y = (
            root(inertia + elastic, free - known)
            if elastic + inertia >= 0
            else lower_root(inertia + elastic, free - known)
        )
        force = y**3
        p.append(force)
        d.append(free - inertia * force)
        w.append(known + elastic * force)
        total += force
        double += total
        if force == 0 and n > 3:
            break
    p, d, w = np.array(p), np.array(d), np.array(w)
    b = d - w + (inertia + elastic) * p
    n = len(p) - 1
    place = (n - 1) + b[n - 1] / (b[n - 1] - b[n])
    e = 1.25 * (h * np.sum(p) + first) - 1
    return h * np.arange(len(p)), p, d, w, place * h, e


def lower_root(a, b):
    """The smaller root for a < 0."""
    if b <= 0:
        return 0.0
    y = b**0.5
    for _ in range(80):
        y -= ((a * y + 1) * y * y - b) / ((3 * a * y + 2) * y)
    return y


def explicit(memory, slope, sigma, wave_time, h):
    """(40) to (44) of the paper; returns the restitution and the largest force."""
    count = int(memory.length * wave_time / h) + 2
    kernel = np.array([sigma * slope(i * h / wave_time) * h / wave_time for i in range(count)])
    p, d, v, last = [0.0], 0.0, 1.0, 0.0
    while True:
        n = len(p)
        a = -1.25 * p[-1]
        d += h * (v + 0.5 * h * a)
        before, v = v, v + h * a
        m = np.arange(max(1, n - count), n - 1)
        w = 0.5 * kernel[0] * p[-1] + np.sum(kernel[n - 1 - m] * np.array(p)[m])
        if d - w <= 0:
            share = last / (last - (d - w))
            return -(before + share * (v - before)), max(p)
        last = d - w
        p.append(last**1.5)


def growing(memory, phi, tau, h):
    """(T47), the increments linear in u over a cell with the radius of its middle; returns e."""
    u, total, double = [0.0], 0.0, 0.0
    first, second = start_constants(h, 0.0)
    inertia = 1.25 * h * h / 12
    while True:
        n = len(u)
        free = n * h - 1.25 * (h * h * double + first * n * h - second)
        value = max(2 * u[-1] - u[-2], 0) if n > 1 else h
        widest = max(max(u), value) ** 0.5
        back = min(n, int(memory.length * tau * widest / h) + 2)
        old = np.array(u[n - back :])
        for _ in range(60):
            samples = np.append(old, value)
            mid = 0.5 * (samples[1:] + samples[:-1])
            unit = tau * np.sqrt(np.maximum(mid, 1e-300))
            age = h * np.arange(len(mid), -1, -1.0)
            area = unit * (memory.integral(age[:-1] / unit) - memory.integral(age[1:] / unit))
            delayed = phi * np.sum(area * np.diff(samples)) / h
            nxt = root(inertia, free + delayed) ** 2
            if abs(nxt - value) < 1e-14 or nxt == value == 0:
                break
            value = nxt
        u.append(nxt)
        force = nxt**1.5
        total += force
        double += total
        if nxt == 0 and n > 3:
            return 1.25 * (h * total + first) - 1
