"""Step response of the elastic half-space under a Hertz disc, by steepest-descent slowness contours.

Placeholder docstring.
"""
import math

from flint import acb, arb, ctx, fmpq

ctx.prec = 160
FIELDS = ("u", "w", "srr", "stt", "szz", "srz")
I = acb(0, 1)
PI = arb.pi()
HALF_PI = PI / 2
C0 = 3 / (8 * PI)


def exact(x):
    """The value of a float as an exact ball."""
    n, d = float(x).as_integer_ratio()
    return arb(n) / arb(d)


# ---------------------------------------------------------------- quadrature rules
def tanh_sinh(h, cut=64):
    """Nodes of (0,1) as (x, 1-x, weight) with both distances to full relative accuracy; weights > e^-cut."""
    out = []
    n = 0
    while True:
        rows = []
        for sign in (1, -1) if n else (1,):
            t = arb(n) * h * sign
            g = PI * t.sinh()
            e = g.exp()
            x, y = e / (1 + e), 1 / (1 + e)
            rows.append((x, y, h * PI * t.cosh() * x * y))
        out += rows
        if float(rows[0][2]) < math.exp(-cut):
            return out
        n += 1


LEVEL0 = arb(1) / 8
MAX_LEVEL = 4
_levels = {}


def level_nodes(level):
    """New nodes of the tanh-sinh rule at this level (odd multiples of the step, all for level 0)."""
    if level not in _levels:
        h = LEVEL0 / 2**level
        nodes = tanh_sinh(h)
        if level:
            nodes = [p for i, p in enumerate(nodes) if i and ((i + 1) // 2) % 2 == 1]
        _levels[level] = [(x.mid(), y.mid(), w.mid()) for x, y, w in nodes]
    return _levels[level]


class ChordRule:
    """Fixed nodes of the source chord s in [-1,1]: tau = 1-s, 1+s, and the two weight columns."""

    def __init__(self, rows):
        self.minus = [1j_mul(r[0]) for r in rows]  # i (1-s)
        self.plus = [1j_mul(r[1]) for r in rows]  # i (1+s)
        from flint import acb_mat
        n = len(rows)
        self.n = n
        self.w = acb_mat(n, 2, [v for r in rows for v in (r[2] * r[0] * r[1], r[2] * (1 - r[0]))])
        self.w3 = acb_mat(n, 1, [r[2] for r in rows])


def mid(z):
    return acb(z.real.mid(), z.imag.mid())


def 1j_mul(z):
    return z
