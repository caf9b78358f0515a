"""Static field of the Hertz load, 25 digits, for static_field.csv.

    w = (1 - nu) A3 + z A2/2,   A3 = int h(s)/rho ds,   A2 = int h(s) zeta/rho^3 ds,   zeta = z - i s, rho^2 = zeta^2 + r^2

by quadrature over the chord, h = 3/(8 pi) (1 - s^2).
Stresses from Huber's closed form (1904) as printed by Johnson, Contact Mechanics (1985), section 3.4, and by Fischer-Cripps,
Introduction to Contact Mechanics (2007), (5.4.2); the radial displacement from these by Hooke's law.

    python static_field.py > static_field.csv
"""

import random

from mpmath import atan, mp, mpc, mpf, pi, quad, sqrt

mp.dps = 60

RATIOS = ["-0.5", "0", "0.25", "0.3", "0.4999"]


def stresses(nu, r, z):
    """srr, stt, szz, srz at r > 0, z > 0."""
    p0 = 3 / (2 * pi)
    d = r * r + z * z - 1
    u = (d + sqrt(d * d + 4 * z * z)) / 2
    root = sqrt(u)
    c = z / root
    ring = (1 - 2 * nu) / (3 * r * r) * (1 - c**3)
    angle = root * atan(1 / root)
    core = c**3 * u / (u * u + z * z)
    srr = ring + core + c * ((1 - nu) * u / (1 + u) + (1 + nu) * angle - 2)
    stt = -(ring + c * (2 * nu + (1 - nu) * u / (1 + u) - (1 + nu) * angle))
    srz = -r * z * z / (u * u + z * z) * root / (1 + u)
    return [p0 * s for s in (srr, stt, -core, srz)]


def vertical(nu, r, z):
    """w by quadrature over the chord; the integrand is sharpest where the chord passes the point."""
    def terms(s):
        zeta = mpc(z, -s)
        rho = sqrt(mpc(z, r - s)) * sqrt(mpc(z, -r - s))
        value = (1 - nu) / rho + z * zeta / (2 * rho**3)
        return (1 - s * s) * value.real
    breaks = sorted({mpf(-1), mpf(1), *(mpf(x) for x in (-r, r) if abs(x) < 1)})
    pieces = [breaks[0]]
    for a, b in zip(breaks, breaks[1:]):
        # halves toward both ends, down to the distance of the singularity
        n = int(max(4, 4 - mp.log(z, 2)))
        grid = [a + (b - a) / 2 ** (n - i) for i in range(n)]
        grid += [b - (b - a) / 2 ** (i + 2) for i in range(n - 1)] + [b]
        pieces += grid
    return 3 / (8 * pi) * quad(terms, pieces)


def field(nu, r, z):
    srr, stt, szz, srz = stresses(nu, r, z)
    # mu = 1, E = 2 (1 + nu)
    u = r * (stt - nu * (srr + szz)) / (2 * (1 + nu))
    return [u, vertical(nu, r, z), srr, stt, szz, srz]


def places(count):
    draw = random.Random(2026)
    for i in range(count):
        power = lambda a, b: 10 ** draw.uniform(a, b)
        yield [
            lambda: (draw.uniform(0, 6), draw.uniform(0, 6)),
            lambda: (power(-8, 0), draw.uniform(0, 6)),
            lambda: (draw.uniform(0, 6), power(-8, 0)),
            lambda: (1 + draw.choice([-1, 1]) * power(-8, -1), power(-8, 0)),
            lambda: (power(0, 4), power(-3, 4)),
            lambda: (draw.uniform(3, 14), draw.uniform(0, 14)),
        ][i % 6]()


def main():
    print("nu,r,z,u,w,srr,stt,szz,srz")
    for i, (r, z) in enumerate(places(300)):
        nu = RATIOS[(i // 6) % len(RATIOS)]
        values = field(mpf(float(nu)), mpf(r), mpf(z))
        print(nu, repr(r), repr(z), *(mp.nstr(v, 25) for v in values), sep=",")


if __name__ == "__main__":
    main()
