"""Energy that a force on a disc radiates, from its spectrum and the mean compliance.

    E = (1/pi) int_0^inf |P'(w)|^2 (-Im C(w))/w dw,    in P^2/(mu r0), P the largest force

for the pulse sin^2(pi t/T) and for the step that rises as sin^2(pi t/(2 T)) and stays.

    python pulse_energy.py > pulse_energy.csv
"""

import numpy as np

from disc_kernel import GAUSS, Admittance

RATIOS = (0.0, 0.2, 0.3, 0.45)
LENGTHS = (1.0, 3.0, 10.0, 40.0)


def rate(kind, t, length):
    """P' over the largest P."""
    if kind == "pulse":
        return np.pi / length * np.sin(2 * np.pi * t / length)
    return 0.5 * np.pi / length * np.sin(np.pi * t / length)


def energy(admittance, kind, length):
    x, w = GAUSS
    cells = 60
    ends = length * np.linspace(0, 1, cells + 1)
    half = 0.5 * np.diff(ends)[:, None]
    t = (0.5 * (ends[1:] + ends[:-1])[:, None] + half * x).ravel()
    slope = (half * w).ravel() * rate(kind, t, length)
    panel = 2 * np.pi / length
    total = 0.0
    for k in range(200):
        omega = panel * (k + 0.5 + 0.5 * x)
        spectrum = np.abs(np.exp(-1j * np.outer(omega, t)) @ slope) ** 2
        part = 0.5 * panel * np.sum(w * spectrum * admittance(omega) / omega)
        total += part
        # the spectrum of the rate falls with the fourth power, the admittance is between w and 1/w
        if k > 20 and part * (k + 1) < 1e-9 * total:
            break
    return total / np.pi


if __name__ == "__main__":
    print("kind,nu,length,energy")
    for nu in RATIOS:
        admittance = Admittance(nu)
        for kind in ("pulse", "step"):
            for length in LENGTHS:
                print(f"{kind},{nu},{length},{energy(admittance, kind, length):.12g}")
