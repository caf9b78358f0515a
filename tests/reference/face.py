"""Mean over the face of a sensor: face.csv, by the closed form of a point force on a half-space with Poisson's ratio 1/4.

A step of the force moves the surface vertically by Pekeris's formula (Proc. Natl Acad. Sci. 41, 469, 1955), whose waves arrive at
r/c1, r/c2 and r/c_R.  It is convolved with the rate of a pulse sin^1.5, between the instants at which a wave arrives, and then averaged
over the face, between the distances at which the waves of the first and last instants arrive.  Cosine substitutions take away the roots
at all ends.  Nothing here is shared with the program.

Units: r (distance of the centre of the face), c2, and the peak force over mu r.
"""

from pathlib import Path

import numpy as np

ROOT = np.sqrt(3.0)
RAYLEIGH = np.sqrt(3.0 + ROOT) / 2.0
ARRIVALS = [1.0 / ROOT, 1.0, RAYLEIGH]
NODES, WEIGHTS = np.polynomial.legendre.leggauss(64)
ANGLES = 0.5 * np.pi * (NODES + 1.0)


def between(start, end):
    """Nodes and weights from one end to the other."""
    nodes = 0.5 * (start + end) - 0.5 * (end - start) * np.cos(ANGLES)
    return nodes, 0.25 * np.pi * WEIGHTS * (end - start) * np.sin(ANGLES)


def pieces(ends, start, end):
    inside = sorted({start, end, *(x for x in ends if start < x < end)})
    return [pair for pair in zip(inside, inside[1:]) if pair[1] - pair[0] > 1e-14]


def step(t):
    """Displacement into the block at distance 1 after a unit step of the force, by arrays of times none of which is an arrival."""
    late = np.full_like(t, 6.0)
    before = t < RAYLEIGH
    late[before] -= np.sqrt(3 * ROOT + 5) / np.sqrt((RAYLEIGH - t[before]) * (RAYLEIGH + t[before]))
    early = t < 1.0
    late[early] += np.sqrt(3 * ROOT - 5) / np.sqrt(t[early] ** 2 + (ROOT - 3) / 4) - ROOT / np.sqrt(t[early] ** 2 - 0.25)
    late[early] *= 0.5
    return np.where(t > 1.0 / ROOT, late, 0.0) / (16 * np.pi)


def point(distance, time, length):
    """Response at a distance to a pulse of some length; both times over the distance here."""
    t, tc = time / distance, length / distance
    total = 0.0
    for start, end in pieces([t - a for a in ARRIVALS], 0.0, min(t, tc)):
        s, weight = between(start, end)
        angle = np.pi * s / tc
        rate = 1.5 * np.pi / tc * np.sqrt(np.sin(angle)) * np.cos(angle)
        with np.errstate(invalid="ignore"):
            total += np.sum(weight * rate * np.nan_to_num(step(t - s)))
    return total / distance


def mean(radius, time, length):
    """Mean over a face of this radius around a place at distance 1."""
    fronts = [(time - s) / a for s in (0.0, length) for a in ARRIVALS]
    total = 0.0
    for start, end in pieces(fronts, 1.0 - radius, 1.0 + radius):
        distance, weight = between(start, end)
        half = np.arccos(np.clip((distance**2 + 1.0 - radius**2) / (2.0 * distance), -1.0, 1.0))
        arcs = 2.0 * distance * half / (np.pi * radius**2)
        total += np.sum(weight * arcs * [point(x, time, length) for x in distance])
    return total


if __name__ == "__main__":
    rows = ["face_radius_over_r,pulse_c2_over_r,time_c2_over_r,mean_uz_mu_r_over_peak"]
    for radius, length in [(0.05, 0.3), (0.2, 0.3), (0.6, 0.25), (0.02, 1.0)]:
        first, last = (1.0 - radius) / ROOT, (1.0 + radius) * RAYLEIGH + length
        for time in np.linspace(first, last, 18)[1:]:
            rows.append(f"{radius},{length},{time:.12g},{mean(radius, time, length):.12g}")
    Path(__file__).parents[1].joinpath("golden", "face.csv").write_text("\n".join(rows) + "\n")
