"""Energy that the pressure of a growing contact radiates, from its spectrum, beside the loss of the contact law.

The pressure is Hertz's on the radius a(t) of the instant, P(t) Z_H(k a(t)) over the wave number, so that with the
force of growing.py

    E = 2 int_0^inf w^2 int f(x) |F(w x, w)|^2 dx dw,    F(k, w) = int P(t) Z_H(k a(t)) exp(-i w t) dt

f the running waves and the Rayleigh pole over slowness (`disc_kernel.Admittance`).  The contact law weighs each
increment of the load with the pressure of its own punch; what the two differ by is what it leaves out.

    python growing_energy.py     prints rows of growing.csv with both
"""

import numpy as np

from disc_kernel import Admittance, transform
from growing import DEGREE, FILE, FIRST, G_W, G_X, SECOND, TO_POWERS, X, march
from growing_kernel import punch

GAUSS = np.polynomial.legendre.leggauss(8)


def history(nu, phi, tau):
    """Times in a/c1, weights and radii of a contact."""
    ends, tables, kappa = punch(nu)
    start, half, coef, _, count = march(
        phi, tau / kappa, ends, tables, kappa, 0.25, 0.045, X, TO_POWERS, FIRST, SECOND, G_X, G_W
    )
    assert count > 0
    x, w = GAUSS
    powers = np.polynomial.polynomial.polyvander(x, DEGREE)
    u = coef[:count] @ powers.T
    t = start[:count, None] + half[:count, None] * (1 + x)
    return t.ravel() / tau, (half[:count, None] * w).ravel() / tau, np.sqrt(np.maximum(u, 0)).ravel()


def energy(nu, phi, tau):
    t, weights, a = history(nu, phi, tau)
    part = weights * a**3
    keep = part > 1e-10 * part.max()
    t, part, a = t[keep], part[keep], a[keep]
    admittance = Admittance(nu)
    slowness, mass = admittance.coarse(32)
    duration = t[-1]
    panel = 2 * np.pi / duration
    x, w = GAUSS
    total = 0.0
    for k in range(60):
        for omega, weight in zip(panel * (k + 0.5 + 0.5 * x), 0.5 * panel * w):
            wave = np.exp(-1j * omega * t) * part
            spectrum = np.abs(transform(np.outer(omega * slowness, a)) @ wave) ** 2
            total += weight * omega**2 * np.sum(mass * spectrum)
    # force times length over mu a0 in units of the kinetic energy
    return 2 * total * 2.5 * 8 * phi / (3 * (1 - nu))


def main():
    rows = [line.split(",") for line in FILE.read_text().splitlines()[1:]]
    chosen = [r for r in rows if r[0] == "ball"] + [r for r in rows if r[0] == "scene"][:2]
    for row in chosen:
        nu, phi, tau, loss = (float(row[i]) for i in (1, 2, 3, 8))
        found = energy(nu, phi, tau)
        print(f"{row[0]} nu {nu:.3f} phi {phi:.4f} tau {tau:.5f}: loss {loss:.6e}, pressure {found:.6e}, {found / loss - 1:+.1e}", flush=True)


if __name__ == "__main__":
    main()
