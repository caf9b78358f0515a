"""Kernels of the half-space side by side: called by scripts/compare-kernels with the path of the example `evaluate`.

    lamb1, lamb2   pygrt-kit: point force, receiver on the surface and below it, displacements and their slopes; C code
    inversion      Hankel quadrature and numerical Laplace inversion in NumPy, the route of the paper: Hertz disc,
                   six fields of the response to a sin^4 pulse
    ours           the same with this crate at tolerance 1e-10

Times are of one core: user time of the other programs, the least of several runs of ours.
A difference is relative to the largest value of the same field in its trace; the slopes of the package, the time
cells of our pulse and the cut of its spectrum are what it shows, not the kernels.
"""

import math
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
from scipy.special import j0, j1

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests" / "reference"))
from pygrt.utils import lamb1, lamb2  # noqa: E402

import point_load  # noqa: E402

EVALUATE = sys.argv[1]
TOLERANCE = "1e-10"
RATIO = 0.25
AWAY = 0.02  # relative distance from the fronts of a point force, where its fields are infinite


def ours(mode, profile, lines, *more):
    """Seconds for a line, and the rows."""
    command = [EVALUATE, mode, profile, TOLERANCE, *map(str, more)]
    text = "".join(" ".join(map(repr, line)) + "\n" for line in lines)
    output = subprocess.run(command, input=text, capture_output=True, text=True, check=True).stdout.splitlines()
    return float(output[0]), np.array([[float(v) for v in row.split()] for row in output[1:]])


def least_time(call, runs=3):
    """Least processor time of several runs, and the result."""
    best = math.inf
    for _ in range(runs):
        start = time.process_time()
        result = call()
        best = min(best, time.process_time() - start)
    return best, result


# ------------------------------------------------------------------ point force


def point_force(depth, count=2000, r=1.0):
    """Seconds a sample of the package and of ours, and the differences of u and w."""
    k, distance = point_load.kappa(RATIO), math.hypot(r, depth)
    fronts = point_load.fronts(RATIO, r, depth)
    times = np.linspace(min(fronts), 1.5 * max(fronts), count)
    reduced = k * times / distance
    if depth == 0:
        seconds, green = least_time(lambda: lamb1(nu=RATIO, tbar=reduced, azimuth=0.0))
    else:
        seconds, green = least_time(lambda: lamb2(nu=RATIO, tbar=reduced, R=r, deprcv=depth, azimuth=0.0)[0])
    theirs = np.stack([green[:, 0, 2], green[:, 2, 2]], axis=1) / (math.pi**2 * distance)
    own_seconds, own = ours("steps", "point", [(RATIO, r, depth, float(t)) for t in times])
    clear = np.all([np.abs(times - front) > AWAY * front for front in fronts], axis=0)
    difference = np.abs(theirs - own[:, :2])[clear] / np.max(np.abs(own[clear, :2]), axis=0)
    return seconds / count, own_seconds, difference


# ------------------------------------------------------------------ numerical inversion


class Inversion:
    """Durbin's Laplace inversion over a Gauss-Legendre Hankel quadrature; reduced units r0 = c1 = mu = 1."""

    PULSE = 4.0
    END = 16.0
    DAMPING = math.log(1e7) / (2 * END)
    HIGHEST = 60.0  # frequency: the spectrum of the pulse falls as its fifth power
    PANELS, NODES = 120, 16

    def __init__(self, r, z):
        self.r, self.z = r, z

    def run(self, times):
        """Fields u, w, srr, stt, szz, srz at the times."""
        omega = np.arange(0, self.HIGHEST, math.pi / self.END)
        s = self.DAMPING + 1j * omega
        rate = np.pi / self.PULSE
        force = 0
        # sin^4 = 3/8 - cos(2.)/2 + cos(4.)/8, on [0, PULSE]
        for weight, frequency in ((3 / 8, 0), (-1 / 4, 2), (-1 / 4, -2), (1 / 16, 4), (1 / 16, -4)):
            shift = s - 1j * frequency * rate
            force = force + weight * (1 - np.exp(-shift * self.PULSE)) / shift
        spectrum = np.array([self.fields(value) for value in s]) * force[:, None]
        spectrum[0] *= 0.5
        phase = np.exp(1j * np.outer(times, omega))
        return (np.exp(self.DAMPING * times)[:, None] / self.END) * (phase @ spectrum).real

    def fields(self, s):
        """Laplace transforms of the impulse responses: (22) to (29) of the paper by quadrature over k."""
        highest = 40 / self.z + 2 * abs(s.imag)
        x, w = np.polynomial.legendre.leggauss(self.NODES)
        ends = np.linspace(0, highest, self.PANELS + 1)
        half = 0.5 * np.diff(ends)
        k = (0.5 * (ends[1:] + ends[:-1])[:, None] + half[:, None] * x).ravel()
        weight = (half[:, None] * w).ravel()
        q2 = (s / k) ** 2
        kappa2 = (1 - 2 * RATIO) / (2 - 2 * RATIO)
        lame = 2 * RATIO / (1 - 2 * RATIO)
        a, b, g = np.sqrt(1 + q2), np.sqrt(1 + q2 / kappa2), 2 + q2 / kappa2
        scale = weight * 3 / (2 * np.pi) * (np.sin(k) - k * np.cos(k)) / k**3 / (g * g - 4 * a * b)
        p, v = scale * np.exp(-k * a * self.z), scale * np.exp(-k * b * self.z)
        zero, one = j0(k * self.r), j1(k * self.r)
        radial = g * p - 2 * a * b * v
        ring = 2 * np.sum(radial * one) / self.r
        return [
            np.sum(radial * one),
            np.sum((a * g * p - 2 * a * v) * zero),
            np.sum((g * (2 - lame * q2) * p - 4 * a * b * v) * k * zero) - ring,
            np.sum(-lame * q2 * g * p * k * zero) + ring,
            np.sum((-g * g * p + 4 * a * b * v) * k * zero),
            np.sum((-2 * a * g * p + 2 * a * g * v) * k * one),
        ]


def pulse(r, z, width=0.025):
    """Seconds a sample of the inversion and of ours, and the differences of the six fields."""
    count = round(Inversion.END / width / 2)
    times = width * np.arange(1, count + 1)
    seconds, theirs = least_time(lambda: Inversion(r, z).run(times), runs=1)
    total, traces = 0.0, []
    for refined in (1, 2):  # a force linear over each cell errs as the width squared, once extrapolated as its cube
        n, step = refined * count, width / refined
        one, rows = ours("cells", "hertz", [(RATIO, r, z)], step, n)
        time_of = step * np.arange(n + 1)
        force = np.where(time_of < Inversion.PULSE, np.sin(np.pi * time_of / Inversion.PULSE) ** 4, 0.0)
        start = time.process_time()
        trace = np.array([np.convolve(np.diff(force), rows[1:, f])[:n] for f in range(6)]).T
        total += one + time.process_time() - start
        traces.append((trace + np.outer(force[1:], rows[0]))[refined - 1 :: refined])
    own = (4 * traces[1] - traces[0]) / 3
    return seconds / count, total / count, np.abs(own - theirs) / np.max(np.abs(own), axis=0)


def main():
    rows = [
        ("lamb1, on the surface", *point_force(0.0)),
        ("lamb2, at half its distance", *point_force(0.5)),
        ("inversion, (r, z) = (0.5, 0.6)", *pulse(0.5, 0.6)),
        ("inversion, (r, z) = (2, 1)", *pulse(2.0, 1.0)),
    ]
    print(f"{'':32}{'us a sample':>12}{'ours':>8}{'ratio':>9}    {'difference: p50':>16}{'p99':>9}{'max':>9}")
    for name, theirs, own, difference in rows:
        p50, p99, largest = np.quantile(difference, [0.5, 0.99, 1.0])
        print(f"{name:32}{1e6 * theirs:12.1f}{1e6 * own:8.1f}{theirs / own:9.1f}    {p50:16.1e}{p99:9.1e}{largest:9.1e}")


if __name__ == "__main__":
    main()
