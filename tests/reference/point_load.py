#!/usr/bin/env python3
"""Write point_load.csv: the step response of a half-space to a point force, by the package pygrt-kit.

    python point_load.py            print the rows
    python point_load.py --write    write the file

Needs what scripts/requirements/point-load.txt lists.
The package evaluates the generalised closed form of Zhang and Feng; lamb1 has source and receiver on the surface,
lamb2 has the receiver below it.
Units and signs are those of point_load.md.
"""

import argparse
import math
from pathlib import Path

import numpy as np
from pygrt.utils import lamb1, lamb2

CSV = Path(__file__).with_name("point_load.csv")
HEADER = "nu,r,z,t,u,w,srr,stt,szz,srz,function"
RATIOS = [0.05, 0.15, 0.2, 0.25, 0.3, 1 / 3, 0.4, 0.45]
STEP = 1e-3  # of c2 t/distance: the package takes its slopes by differences in time, of second order
AWAY = 0.02  # relative distance from every front: the fields are singular at some of them


def kappa(nu):
    """c2/c1."""
    return math.sqrt((1 - 2 * nu) / (2 - 2 * nu))


def rayleigh_speed(nu):
    """c_R/c1, by bisection of the Rayleigh function."""
    k = kappa(nu)
    low, high = 0.4 * k, k * (1 - 1e-9)
    for _ in range(200):
        c = 0.5 * (low + high)
        v = (c / k) ** 2
        if (2 - v) ** 2 - 4 * math.sqrt((1 - c * c) * (1 - v)) < 0:
            low = c
        else:
            high = c
    return low


def fronts(nu, r, z):
    """Arrival times from the point force, in units of length over c1."""
    k = kappa(nu)
    slope = math.sqrt(1 / k**2 - 1)
    distance = math.hypot(r, z)
    times = [distance, distance / k, r / rayleigh_speed(nu)]
    if r * slope > z:
        times.append(r + z * slope)
    return times


def fields(nu, r, z, t):
    """u, w and, below the surface, the four stresses, for unit force, shear modulus one and speed c1 one."""
    distance = math.hypot(r, z)
    reduced = np.array([kappa(nu) * t / distance])  # c2 t/distance
    if z == 0:
        green = lamb1(nu=nu, tbar=reduced, azimuth=0.0)[0] / (math.pi**2 * distance)
        return [green[0, 2], green[2, 2], *[None] * 4]
    slopes = []
    for step in (STEP, STEP / 2):
        green, _, slope, _ = lamb2(nu=nu, tbar=reduced + step * np.arange(-1, 2), R=r, deprcv=z, azimuth=0.0)
        slopes.append(slope[1][:, :, 2])
    u = green[1] / (math.pi**2 * distance)
    # d[i, j]: derivative of component j of a vertical force's displacement along coordinate i of the receiver
    d = (4 * slopes[1] - slopes[0]) / 3 / (math.pi**2 * distance**2)
    lame = 2 * nu / (1 - 2 * nu)
    spread = lame * (d[0, 0] + d[1, 1] + d[2, 2])
    return [u[0, 2], u[2, 2], spread + 2 * d[0, 0], spread + 2 * d[1, 1], spread + 2 * d[2, 2], d[0, 2] + d[2, 0]]


def points():
    """Random places and times, from the first arrival to some time after the last, clear of the fronts."""
    rng = np.random.default_rng(20240301)
    count = 0
    while count < 96:
        nu = RATIOS[count % len(RATIOS)]
        r = round(float(rng.uniform(0.1, 6)), 4)
        z = 0.0 if count % 3 == 0 else round(float(rng.uniform(0.1, 6)), 4)
        times = fronts(nu, r, z)
        t = round(float(rng.uniform(min(times), 1.4 * max(times))), 4)
        if all(abs(t - front) > AWAY * front for front in times):
            count += 1
            yield nu, r, z, t


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", action="store_true", help="write the file instead of printing the rows")
    args = parser.parse_args()
    lines = [HEADER]
    for nu, r, z, t in points():
        values = ["" if v is None else repr(float(v)) for v in fields(nu, r, z, t)]
        lines.append(",".join([*map(repr, (nu, r, z, t)), *values, "lamb2" if z else "lamb1"]))
    if args.write:
        CSV.write_text("\n".join(lines) + "\n")
    else:
        print("\n".join(lines))


if __name__ == "__main__":
    main()
