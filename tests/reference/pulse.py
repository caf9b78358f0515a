"""Responses to sin^4 pulses far from the load, for pulse_response.csv.

    u(t) = P(t) static + int P'(t - s) R(s) ds,     P(t) = sin^4(pi t/T) on [0, T],     R = step response - static

with step responses from steepest-descent contours (contours.py), which share nothing with the kernels of the workspace,
and Gauss-Legendre rules on pieces that are cut at every front and grow by factors of four away from it; next to a front
the variable is the square root of the distance.

    python pulse.py [part parts]     rows that are missing, each as soon as it is there; row i where i % parts == part
    python pulse.py --check          the first rows again with four more nodes on every piece
"""

import math
import os
import sys

from flint import arb

import contours
from contours import Solid, static_field, step_response
from quadrature import exact

# values of 1e-6 to 12 digits and more: two successive rules agree to this, and the finer is better by far
contours.TOL = 1e-14

NU = 0.3
FIELDS = "u,w,srr,stt,szz,srz"
NODES = 14


def fronts(solid, r, z):
    kappa, c = float(solid.kappa), float(solid.c)
    edges = [abs(r - 1), r + 1]
    span = math.sqrt(1 / kappa**2 - 1)
    times = [math.hypot(e, z) for e in edges] + [math.hypot(e, z) / kappa for e in edges]
    times += [e / c for e in edges] + [e + z * span for e in edges if e * span >= z]
    return sorted(times)


def gauss(n):
    rows = []
    for k in range(n):
        x, w = arb.legendre_p_root(n, k, weight=True)
        rows.append((float(x.mid()), float(w.mid())))
    return rows


def nodes(start, end, cuts, n):
    """Nodes (s, weight) on [start, end]."""
    rule = gauss(n)
    cuts = [c for c in cuts if start < c < end]
    ends = [start] + cuts + [end]
    for i, (a, b) in enumerate(zip(ends, ends[1:])):
        anchors = [x for x, is_front in ((a, i > 0), (b, i + 1 < len(ends) - 1)) if is_front]
        if not anchors:
            count = math.ceil((b - a) / 0.75)
            h = (b - a) / count
            for j in range(count):
                for x, w in rule:
                    yield a + h * (j + 0.5 + 0.5 * x), 0.5 * h * w
            continue
        for anchor in anchors:
            far = (a + b) / 2 if len(anchors) == 2 else (b if anchor == a else a)
            length, sign = abs(far - anchor), 1 if far > anchor else -1
            marks = [0.0]
            step = 0.3
            while step < 0.7 * length:
                marks.append(step)
                step *= 3
            marks.append(length)
            for d0, d1 in zip(marks, marks[1:]):
                s0, s1 = math.sqrt(d0), math.sqrt(d1)
                for x, w in rule:
                    s = 0.5 * (s0 + s1) + 0.5 * (s1 - s0) * x
                    yield anchor + sign * s * s, 0.5 * (s1 - s0) * w * 2 * s


def response(r, z, pulse, t, n=NODES, step=None):
    solid = Solid(NU)
    rest = static_field(solid, exact(r), exact(z))
    step = step or (lambda s: step_response(NU, r, z, s, solid=solid))
    force = lambda s: math.sin(math.pi * s / pulse) ** 4 if 0 < s < pulse else 0.0
    total = [v * force(t) for v in rest]
    first = math.hypot(max(r - 1, 0), z)
    for s, weight in nodes(t - pulse, t, fronts(solid, r, z), n):
        x = math.pi * (t - s) / pulse
        rate = 4 * math.pi / pulse * math.sin(x) ** 3 * math.cos(x)
        value = step(s) if s > first else [arb(0)] * 6
        total = [a + weight * rate * (v - b) for a, v, b in zip(total, value, rest)]
    return total


def places():
    """r, z, pulse length, time: the Rayleigh wave at z = 0 and 1, P and S at z = r, near the middle of the pulse."""
    solid = Solid(NU)
    c, kappa = float(solid.c), float(solid.kappa)
    pulses = [3.0, 10.0, 40.0]
    for i, r in enumerate([300.0, 1000.0, 10000.0, 100.0, 50.0]):
        for j, z in enumerate([0.0, 1.0, r]):
            pulse = pulses[(i + j) % 3]
            arrival = [r / c, r / c, math.hypot(r, z) / (1 if i % 2 else kappa)][j]
            yield r, z, pulse, round(arrival + [0.5, 0.37, 0.61][(i + 2 * j) % 3] * pulse, 3)


def main():
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "pulse_response.csv")
    if "--check" in sys.argv:
        for r, z, pulse, t in list(places())[:2]:
            for n in (NODES, NODES + 4):
                print(r, z, pulse, t, n, [str(v.mid().str(14, radius=False)) for v in response(r, z, pulse, t, n)])
        return
    part, parts = (int(v) for v in sys.argv[1:3]) if len(sys.argv) > 2 else (0, 1)
    if not os.path.exists(path):
        with open(path, "w") as file:
            file.write(f"nu,r,z,pulse,t,{FIELDS}\n")
    done = {tuple(line.split(",")[1:5]) for line in open(path)}
    for i, (r, z, pulse, t) in enumerate(places()):
        if i % parts != part or tuple(map(repr, (r, z, pulse, t))) in done:
            continue
        values = [v.mid().str(15, radius=False) for v in response(r, z, pulse, t)]
        with open(path, "a") as file:
            print(NU, r, z, pulse, t, *values, sep=",", file=file)


if __name__ == "__main__":
    main()
