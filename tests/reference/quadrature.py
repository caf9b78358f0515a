"""Numbers without error and tanh-sinh quadrature in ball arithmetic, shared by the two methods."""

import math
from functools import lru_cache

from flint import acb, arb, ctx

ctx.prec = 160  # bits
FIELDS = ("u", "w", "srr", "stt", "szz", "srz")
I = acb(0, 1)
PI = arb.pi()


def exact(x):
    """A float as a number without error."""
    n, d = float(x).as_integer_ratio()
    return arb(n) / arb(d)


def mid(z):
    return acb(z.real.mid(), z.imag.mid())


def tanh_sinh(h, odd_only=False, cut=70.0):
    """Rule on (0,1): rows (x, 1-x, weight), both distances to full relative accuracy."""
    rows, n = [], 0
    while True:
        if not (odd_only and n % 2 == 0):
            g = PI * (h * n).sinh()
            far, near = 1 / (1 + (-g).exp()), 1 / (1 + g.exp())
            wt = h * PI * (h * n).cosh() * far * near
            if float(wt) < math.exp(-cut):
                return rows
            rows.append((far.mid(), near.mid(), wt.mid()))
            if n:
                rows.append((near.mid(), far.mid(), wt.mid()))
        n += 1


@lru_cache(None)
def level_rule(level):
    """New nodes when the step of the outer rule goes to 2^-(level+3)."""
    return tanh_sinh(arb(1) / 2 ** (level + 3), odd_only=level > 0)


def integrate(f, tol, x0=0.0, x1=1.0, depth=0):
    """Integral of the vector f(x, 1-x) over (x0, x1) inside (0,1), by tanh-sinh with step halving, then splitting."""
    e0, e1 = exact(x0), exact(x1)
    length = e1 - e0
    left, right = x0 == 0.0, x1 == 1.0

    def point(x, y):
        px = length * x if left else e0 + length * x
        py = length * y if right else (1 - e1) + length * y
        return f(px, py)

    total = None
    old = None
    for level in range(5):
        acc = None
        for x, y, wt in level_rule(level):
            v = [p * wt for p in point(x, y)]
            acc = v if acc is None else [p + q for p, q in zip(acc, v)]
        total = acc if total is None else [p / 2 + q for p, q in zip(total, acc)]
        total = [mid(p) for p in total]
        if old is not None:
            diff = max(abs(complex(p - q)) for p, q in zip(total, old)) * float(length)
            if diff < tol:
                return [p * length for p in total]
            if level >= 2 and diff > 1e-6 and depth < 12:
                break
        old = total
    if depth >= 12:
        raise ArithmeticError(f"no convergence, difference {diff}")
    m = (x0 + x1) / 2
    return [p + q for p, q in zip(integrate(f, tol, x0, m, depth + 1), integrate(f, tol, m, x1, depth + 1))]
