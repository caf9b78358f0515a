#!/usr/bin/env python3
"""Write step_response.csv: reference values of the half-space step response under a Hertz disc.

    python generate.py               compute the missing rows (each is written as soon as it is finished)
    python generate.py --check N     recompute N rows, drawn with a fixed seed, by the second method and print the differences
    python generate.py --check 0     the same for all rows
    python generate.py --sanity      boundary condition, static limit, causality and path independence

Problem: half-space z >= 0 at rest, surface pressure Z(r) H(t), Z = 3/(2 pi) sqrt(1-r^2) on the disc r < 1.
Units: r0 = c1 = mu = 1 and unit force, so displacement is in P/(mu r0), stress in P/r0^2, time in r0/c1.

Method (contours.py): the Laplace-Hankel solution is written with the slowness q = s/k.
For P and S apart, the Bromwich line is bent into a path of steepest descent through the saddle point and the branch points,
on which the k-integral converges.
The k-integral is the potential of the disc, taken by quadrature over the chord of the disc (a point source at complex depth).
The poles at zero and at the Rayleigh slowness give the static field and the Rayleigh wave.
Both quadratures are tanh-sinh or Gauss rules in 160-bit arithmetic.

Second method (cagniard.py): explicit Cagniard-de Hoop response to a line load, continued to complex offset, integrated over
the chord of the disc and averaged over the horizontal direction.
The two share nothing but the quadrature rule.

Sources:
    A. T. de Hoop, Appl. Sci. Res. B 8 (1960) 349: the slowness path.
    L. R. Johnson, Geophys. J. R. astr. Soc. 37 (1974) 99: Green's function of the half-space in that form.
    V. I. Smirnov and S. L. Sobolev, Trudy Seismol. Inst. 20 (1932): superposition of plane problems.
    G. A. Deschamps, Electron. Lett. 7 (1971) 684: point source at a complex position.
    M. T. Huber, Ann. Phys. 319 (1904) 153: static field.
    H. Takahasi and M. Mori, Publ. RIMS 9 (1974) 721: tanh-sinh quadrature.

Needs python-flint (0.9 was used).
"""

import argparse
import csv
import math
import random
import time
from pathlib import Path

from flint import arb

import cagniard
import contours
from quadrature import FIELDS, PI, exact

CSV = Path(__file__).with_name("step_response.csv")
HEADER = ["nu", "r", "z", "t", *FIELDS, "kind"]
NUS = [-0.5, -0.2, 0.0, 0.1, 0.2, 0.25, 0.26308206, 0.26308206 - 1e-12, 0.26308206 + 1e-12, 0.3, 1 / 3, 0.4, 0.45, 0.49, 0.499, 0.4999]
COMMON = [0.0, 0.2, 0.25, 0.3, 1 / 3, 0.4, 0.45]
ZERO_BELOW = 1e-22


# ------------------------------------------------------------------ points


def speeds(nu):
    """kappa = c2/c1 and c_R/c1."""
    k2 = (1 - 2 * nu) / (2 - 2 * nu)
    return math.sqrt(k2), float(cagniard.rayleigh_speed((1 - 2 * exact(nu)) / (2 - 2 * exact(nu))))


def arrivals(nu, r, z):
    """(label, time) of the fronts at a point: P, S, head and (at the surface) Rayleigh, near and far edge, and the plane fronts."""
    kappa, c = speeds(nu)
    slope = math.sqrt(1 / kappa**2 - 1)
    out = []
    for side, x in (("near", abs(r - 1)), ("far", r + 1)):
        d = math.hypot(z, x)
        out += [(f"P {side}", d), (f"S {side}", d / kappa)]
        if x * slope > z:
            out.append((f"head {side}", z * slope + x))
        if z < 1e-2:
            out.append((f"Rayleigh {side}", x / c))
    if r < 1 and z > 0:
        out += [("P plane", z), ("S plane", z / kappa)]
    return [(n, t) for n, t in out if t > 0]


def keep_off(nu, r, z, t, gap=0.9e-6):
    """True if t stays away from every front."""
    return all(abs(t - a) > gap * a for _, a in arrivals(nu, r, z))


def points():
    rng = random.Random(20240229)
    rnd = lambda lo, hi: round(rng.uniform(lo, hi), 6)
    groups = {}

    def add(kind, nu, r, z, t):
        if t > 0 and keep_off(nu, r, z, t):
            groups.setdefault(kind, []).append((float(nu), float(r), float(z), float(t), kind))

    # about half of all: anywhere, with half of the times between the first and a little after the last arrival
    for i in range(190):
        nu, r, z = NUS[i % len(NUS)], rnd(0, 6), rnd(0, 6)
        first = z if r < 1 else math.hypot(z, r - 1)
        last = math.hypot(z, r + 1) / speeds(nu)[0]
        t = rnd(0.05, 20) if i % 2 else round(min(rng.uniform(0.97 * first, 1.15 * last), 20), 6)
        add("random", nu, r, z, t)
    for i, z in enumerate([1e-3, 0.05, 0.3, 0.6, 1.0, 1.7, 3.0, 4.5, 6.0, 10.0]):
        nu = COMMON[i % len(COMMON)]
        last = math.hypot(z, 1) / speeds(nu)[0]
        add("axis", nu, 0, z, rnd(z, last))
        add("axis", nu, 0, z, rnd(0.9 * last, 1.5 * last + 1))
    for t in (0.1, 0.7, 1.3, 1.9, 2.6):
        add("axis", 0.3, 0, 0, t)
    for i, r in enumerate([0.1, 0.3, 0.5, 0.8, 0.97, 1.04, 1.3, 2.0, 3.5, 6.0, 12.0, 20.0]):
        nu = NUS[(3 * i + 2) % 13]
        c = speeds(nu)[1]
        add("surface", nu, r, 0, rnd(max(r - 1, 0.02), (r + 1) / c))
        add("surface", nu, r, 0, rnd((r - 0.9) / c if r > 1 else 0.4, 1.1 * (r + 1) / c))
        add("surface", 0.3, r, 0, rnd(0.05, 1.2 * (r + 1) / c))
    for i, (r, z) in enumerate([(1, 0), (1, 0), (1, 0), (1, 0.01), (1, 0.1), (1, 0.1), (1, 0.5), (1 - 1e-6, 0), (1 + 1e-6, 0),
                                (1 - 1e-9, 1e-3), (1 + 1e-9, 1e-3), (1 - 1e-3, 1e-4), (1 + 1e-3, 1e-4), (1, 1e-6), (1, 1e-9)]):
        nu = COMMON[i % len(COMMON)]
        add("edge", nu, r, z, rnd(0.1, 2.2 / speeds(nu)[1]))
    for i in range(28):
        nu = NUS[(5 * i) % len(NUS)]
        z = 10.0 ** (-9 + i % 7)
        r = [0.0, 0.4, 0.9, 1.1, 2.0, 3.7, 5.5][(i // 2) % 7] + 0.0137 * (i % 3)
        c = speeds(nu)[1]
        lo, hi = max(r - 1, 0.05), min(1.15 * (r + 1) / c, 60)
        add("shallow", nu, r, z, rnd(lo, hi))
    spots = [(0.3, 0.5, 0.8), (0.25, 2.5, 0.9), (0.2, 0.0, 0.7), (0.4, 4.0, 0.4), (1 / 3, 1.6, 0.0), (0.3, 0.4, 0.0), (0.45, 1.0, 0.5), (0.0, 3.0, 2.0), (0.3, 3.0, 1e-5)]
    n = 0
    for nu, r, z in spots:
        for _, a in arrivals(nu, r, z):
            for j in range(2):  # each front from both sides, the distance alternates
                eps = (1e-3, 1e-6)[n // 2 % 2]
                add("arrival", nu, r, z, a * (1 + (-eps, eps)[j]))
                n += 1
            n += rng.randrange(2) * 2
    for j, (r, z, t) in enumerate([(0.6, 0.4, 1.1), (0.3, 0.0, 0.9), (2.2, 1.3, 4.4)]):
        for nu in NUS if j == 0 else NUS[5:10]:
            add("nu_special", nu, r, z, t)
    for i, (r, z, t) in enumerate([(20, 20, 200), (20, 0, 200), (0, 20, 200), (20, 20, 40), (20, 20, 28.5), (20, 0.5, 21), (20, 5, 38),
                                   (20, 1e-3, 35), (0, 20, 35.5), (3, 20, 21), (15, 18, 44), (18, 2, 33.2), (0.5, 0.5, 200), (0.5, 0, 150),
                                   (1, 1, 100), (20, 20, 120), (19.5, 10, 75), (0.7, 19, 60), (12, 0, 22.5), (12, 7, 30)]):
        add("far", [0.3, 0.25, 0.2, 0.4, 0.0][i % 5] if i % 7 else 0.3, r, z, t)
    # interleave, so that a partial file already holds every kind
    order = []
    for kind, rows in groups.items():
        order += [((i + 0.5) / len(rows), p) for i, p in enumerate(rows)]
    seen, out = set(), []
    for _, p in sorted(order, key=lambda e: e[0]):
        if p[:4] not in seen:
            seen.add(p[:4])
            out.append(p)
    return out


# ------------------------------------------------------------------ file


def number(x):
    """20 significant digits; magnitudes that only rounding leaves are written as 0."""
    if abs(float(x)) < ZERO_BELOW:
        return "0"
    text = x.mid().str(20, radius=False)
    return text.strip("[]")


def read_rows():
    if not CSV.exists():
        return []
    with CSV.open(newline="") as f:
        return [row for row in csv.DictReader(f) if row["kind"]]


def generate():
    done = {tuple(row[k] for k in HEADER[:4]) for row in read_rows()}
    todo = [p for p in points() if tuple(map(repr, p[:4])) not in done]
    if not CSV.exists():
        CSV.write_text(",".join(HEADER) + "\n")
    start = time.time()
    with CSV.open("a") as out:
        for i, p in enumerate(todo):
            t0 = time.time()
            values = contours.step_response(*p[:4])
            out.write(",".join([*map(repr, p[:4]), *map(number, values), p[4]]) + "\n")
            out.flush()
            print(f"{i + 1}/{len(todo)} {p} {time.time() - t0:.1f} s, total {time.time() - start:.0f} s", flush=True)


# ------------------------------------------------------------------ checks


def check(n):
    """Differences to the second method, absolute and relative to the largest of the fields of the same unit in the row."""
    rows = read_rows()
    if n:
        rows = random.Random(n).sample(rows, min(n, len(rows)))
    worst = 0.0
    for row in rows:
        t0 = time.time()
        p = [float(row[k]) for k in HEADER[:4]]
        near_edge = abs(p[1] - 1) < 1e-2 and p[2] < 1e-2
        try:
            other = cagniard.step_response(*p, tol=1e-15 if near_edge else 1e-11)
        except ArithmeticError as e:
            print(f"{row['kind']:10} {p} second method failed: {e}", flush=True)
            continue
        diff = [abs(float(arb(row[k]) - v)) for k, v in zip(FIELDS, other)]
        size = {k: abs(float(row[k])) for k in FIELDS}
        disp = max(size["u"], size["w"])
        stress = max(size[k] for k in FIELDS[2:])
        rel = max(max(diff[:2]) / max(disp, 1e-6), max(diff[2:]) / max(stress, 1e-6))
        worst = max(worst, rel)
        print(f"{row['kind']:10} {p} abs {max(diff):.1e} rel {rel:.1e} {time.time() - t0:.1f} s", flush=True)
    print(f"{len(rows)} rows, worst relative difference {worst:.1e}")


def sanity():
    """Facts that need no second method; prints the largest deviation of each."""
    zdisc = lambda r: 3 / (2 * PI) * (1 - exact(r) ** 2).sqrt()
    dev = 0.0
    for nu, r, t in [(0.3, 0.25, 0.4), (0.2, 0.75, 1.5), (0.45, 0.5, 2.0)]:
        f = contours.step_response(nu, r, 0.0, t)
        dev = max(dev, abs(float(f[4] + zdisc(r))), abs(float(f[5])))
    print(f"surface: szz + Z and srz        {dev:.1e}")
    f = contours.step_response(0.3, 0.0, 0.0, 2.5)
    print(f"w(0,0) - 3(1-nu)/8              {abs(float(f[1] - 3 * (1 - exact(0.3)) / 8)):.1e}")
    dev = 0.0
    for nu, r in [(0.25, 0.5), (0.3, 1.7), (0.4, 4.0)]:
        t = 1.01 * (r + 1) / speeds(nu)[1]
        s = contours.Solid(nu)
        dev = max(dev, abs(float(contours.step_response(nu, r, 0.0, t)[1] - contours.static_field(s, exact(r), exact(0.0))[1])))
    print(f"surface: w static after Rayleigh {dev:.1e}")
    dev = 0.0
    for nu, r, z, t in [(0.3, 4.0, 0.6, 2.0), (0.1, 4.0, 1.0, 2.5), (0.4999, 1.5, 0.001, 0.45), (0.25, 3.0, 0.0, 1.9)]:
        dev = max([dev] + [abs(float(v)) for v in contours.step_response(nu, r, z, t)])
    print(f"before the first arrival        {dev:.1e}")
    dev = 0.0
    for p in [(0.3, 0.5, 0.6, 3.0), (0.2, 2.0, 1.0, 3.1), (0.45, 0.0, 0.8, 4.0), (-0.2, 1.3, 2.0, 3.0)]:
        a, b = contours.step_response(*p), contours.step_response(*p, poles=False)
        dev = max([dev] + [abs(float(x - y)) for x, y in zip(a, b)])
    print(f"path left or right of the poles {dev:.1e}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", type=int, metavar="N")
    parser.add_argument("--sanity", action="store_true")
    args = parser.parse_args()
    if args.check is not None:
        check(args.check)
    elif args.sanity:
        sanity()
    else:
        generate()


if __name__ == "__main__":
    main()
