#!/usr/bin/env python3
"""Draw new points over the whole domain, where kernels are likely to fail, and print their reference values as rows.

    python attack.py SEED SECONDS > new.csv             rows in the form of step_response.csv
    python attack.py SEED SECONDS shallow > new.csv     only points 1e-9 to 1e-3 below the surface
    REFERENCE_ROWS=$PWD/new.csv cargo test -p hertzlamb-halfspace --test reference -- --nocapture

Poisson's ratio from the special ones or anywhere in [-0.5, 0.499], r and z to 20, t to 200: on the axis, on the surface,
at and around the edge, 1e-9 to 1e-3 below the surface, at an arrival to the last bit or 1e-12, 1e-9, 1e-7 beside it, and
where a front comes at the slowness of the Rayleigh wave or at a branch point.
The shallow points crowd where a front passes in a time of the order of the depth, outside, inside and at the edge of the disc.
A point that takes longer than half a minute is left out and named on the standard error.
"""

import math
import random
import signal
import sys
import time

import contours
from generate import FIELDS, HEADER, NUS, arrivals, number, speeds

LIMIT = 25  # seconds for a point


class Slow(Exception):
    """A point takes too long."""


def give_up(*_):
    raise Slow


def draw(rng, i):
    """One point and its kind."""
    nu = rng.choice(NUS) if rng.random() < 0.6 else rng.uniform(-0.5, 0.499)
    kappa, c = speeds(nu)
    reach = rng.choice([4, 20])
    r, z, kind = rng.uniform(0, reach), rng.uniform(0, reach), "random"
    case = i % 10
    if case == 1:
        r, kind = 0.0, "axis"
    elif case == 2:
        z, kind = 0.0, "surface"
    elif case == 3:
        r, kind = 1.0, "edge"
    elif case in (4, 5):
        r, z, kind = rng.uniform(0, 5), 10 ** rng.uniform(-9, -3), "shallow"
    elif case == 6:
        r, z, kind = 1 + rng.choice([-1, 1]) * 10 ** rng.uniform(-9, -1), 10 ** rng.uniform(-9, -1), "edge"
    elif case in (7, 8) and rng.random() < 0.3:
        z = 10 ** rng.uniform(-9, -3)
    fronts = [a for _, a in arrivals(nu, r, z)]
    t = rng.uniform(min(fronts), 1.15 * max(fronts)) if rng.random() < 0.7 else rng.uniform(0, 200)
    if case in (7, 8):
        kind, a = "arrival", rng.choice(fronts)
        beside = a * (1 + rng.choice([-1, 1]) * rng.choice([1e-12, 1e-9, 1e-7]))
        t = rng.choice([a, math.nextafter(a, 0), math.nextafter(a, math.inf), beside])
    elif case == 9:
        kind, edge, x = "meets", rng.choice([r + 1, abs(r - 1)]), rng.choice([1 / c, 1.0, 1 / kappa])
        vertical = rng.choice([0.0, math.sqrt(max(1 / kappa**2 - x * x, 0)), math.sqrt(max(1 - x * x, 0))])
        t = edge * x + rng.choice([-1, 1]) * z * vertical
    return nu, r, z, t, kind


def draw_shallow(rng, i):
    """One point just below the surface and its kind."""
    nu = rng.choice(NUS) if rng.random() < 0.6 else rng.uniform(-0.5, 0.499)
    c = speeds(nu)[1]
    z = 10 ** rng.uniform(-9, -3)
    place = i % 5
    r = rng.uniform(1, 6)
    if place == 1:
        r = rng.uniform(0, 1)
    elif place == 2:
        r = 1 + rng.choice([-1, 1]) * 10 ** rng.uniform(-9, -1)
    elif place == 3:
        r = rng.uniform(1, 20)
    front = rng.choice([a for _, a in arrivals(nu, r, z)])
    rayleigh = rng.choice([abs(r - 1), r + 1]) / c
    times = [
        rng.uniform(max(r - 1, 0.01), 1.15 * (r + 1) / c),
        rayleigh + z * rng.uniform(-10, 10),
        rayleigh * (1 + rng.choice([-1, 1]) * 10 ** rng.uniform(-9, -1)),
        front + z * rng.uniform(-10, 10),
        front * (1 + rng.choice([-1, 1]) * 10 ** rng.uniform(-9, -1)),
        rng.choice([front, math.nextafter(front, 0), math.nextafter(front, math.inf)]),
    ]
    return nu, r, z, times[i % len(times)], "shallow"


def main():
    rng, seconds = random.Random(int(sys.argv[1])), float(sys.argv[2])
    chosen = draw_shallow if sys.argv[3:] == ["shallow"] else draw
    signal.signal(signal.SIGALRM, give_up)
    assert HEADER[4:10] == list(FIELDS)
    print(",".join(HEADER))
    start, i = time.time(), 0
    while time.time() - start < seconds:
        *point, kind = chosen(rng, i)
        i += 1
        if not 0 < point[3] <= 200:
            continue
        signal.alarm(LIMIT)
        try:
            values = contours.step_response(*point)
            signal.alarm(0)
            print(",".join([*map(repr, point), *map(number, values), kind]), flush=True)
        except Slow:
            print(f"left out: {point} {kind}", file=sys.stderr)


if __name__ == "__main__":
    main()
