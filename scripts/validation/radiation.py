"""Energy radiated by a slow force, and deflection of a disc under a harmonic force."""

from __future__ import annotations

import hertzlamb as hl
import numpy as np

from . import lamb
from .collisions import Drop, Solid
from .table import Curve, Row

RATIOS = {"0": 0.0, "1/4": 0.25, "0.29": 0.29, "0.3": 0.3, "1/3": 1 / 3}


def constant(nu: float) -> float:
    """J = S0 times the integral of 1 - W over c2 t/r0."""
    medium = hl.kernels.medium(nu)
    return medium.shear_speed * medium.centre_compliance * medium.centre_relaxation_time


def rayleigh_share(nu: float) -> float:
    """The Rayleigh wave's part of J: after the shear wave 1 - W is its mass times 1 - (c t)^2, and nothing else."""
    medium = hl.kernels.medium(nu)
    t = 0.5 * (1 / medium.shear_speed + medium.centre_memory)
    left = 1 - float(hl.kernels.surface_step(nu, t))
    mass = left / (1 - (t / medium.centre_memory) ** 2)
    return 2 / 3 * mass * medium.centre_memory / medium.centre_relaxation_time


def slow_factor(nu: float) -> float:
    """(1 - e^2)/(V0/c0)^(3/5) of a ball on a block of its own material, at 1e-7 of the wave speed."""
    solid = Solid(2e11, nu, 8000.0)
    ratio = 1e-7
    drop = Drop(solid, solid, 0.005, ratio * (solid.e / solid.rho) ** 0.5)
    run = hl.impact(drop.scene(model="growing", tolerance=1e-7))
    return run.loss / ratio**0.6


def radiation() -> list[Row | Curve]:
    """J, the share of the Rayleigh wave, and consequences of J at low speed."""
    rows: list[Row | Curve] = []
    for name, nu in RATIOS.items():
        parts = lamb.radiation_parts(nu)
        what = "J, the lag of a slow deflection in P'/(mu c2), nu = "
        rows.append(Row(what + name, sum(parts), "Lamb's harmonic integral", constant(nu), 1e-11, digits=8))
    for name, nu in RATIOS.items():
        parts = lamb.radiation_parts(nu)
        share = parts[2] / sum(parts)
        what = "share of the Rayleigh wave in the radiated energy, nu = "
        rows.append(Row(what + name, share, "Lamb's harmonic integral, its pole", rayleigh_share(nu), 1e-10))
    why = "two digits were printed"
    rows.append(Row("the same, nu = 1/4", 0.67, "Miller and Pursey 1955", rayleigh_share(0.25), 0.0075, why, digits=4))
    why = "a fit of Sung's, as quoted in textbooks of foundation vibration; the quotation was not checked"
    for name, nu, value in (("0", 0.0, 0.214470), ("1/4", 0.25, 0.148594)):
        what = f"imaginary part of a disc's compliance over c2/(omega r0), low frequency, nu = {name}"
        rows.append(Row(what, value, "Sung 1953", constant(nu), 4e-3, why))
    for name, nu, value in (("0", 0.0, 0.25), ("1/4", 0.25, 0.1875)):
        static = float(hl.kernels.static(nu, 0.0, 0.0, profile="punch").displacement_z)
        rows.append(
            Row(
                f"static deflection of a rigid punch in P/(mu r0), nu = {name}",
                value,
                "Sung 1953",
                static,
                1e-12,
                "quoted likewise",
            )
        )
    why = "unexplained: the exact first order is (4/5)^(1/5) 3.9795 of J and elastic constants, by two routes here"
    for name, nu in (("1/4", 0.25), ("0.3", 0.3)):
        found = slow_factor(nu)
        what = f"(1 - e^2)/(V0/c0)^(3/5) of equal materials at low speed, nu = {name}"
        rows.append(Row(what, 1.04, "after Hunter 1957", found, 0.09, why, digits=5))
        solid = Solid(2e11, nu, 8000.0)
        drop = Drop(solid, solid, 0.005, 1e-7 * (solid.e / solid.rho) ** 0.5)
        exact = drop.loss / 1e-7**0.6
        rows.append(
            Row("the same", exact, "Hertz's pulse and Lamb's integral", found, 1e-4, "second order in the loss")
        )
    return rows


def harmonic() -> list[Row | Curve]:
    """Compliance of the centre of a Hertz disc under a harmonic force: the transform of the step response."""
    rows: list[Row | Curve] = []
    x, w = np.polynomial.legendre.leggauss(40)
    for nu in (0.0, 0.25, 0.45):
        medium = hl.kernels.medium(nu)
        # the step response is smooth between the arrivals of the three waves from the edge
        ends = np.array([0, 1, 1 / medium.shear_speed, medium.centre_memory])
        # roots at the ends of the first two pieces: nodes crowd there
        for a0 in (0.3, 1.0, 3.0, 10.0):
            omega = a0 * medium.shear_speed
            total = 0j
            for low, high in zip(ends[:-1], ends[1:]):
                s = 0.5 * (1 + x)
                t = low + (high - low) * s * s * (3 - 2 * s)
                slope = (high - low) * 6 * s * (1 - s)
                left = hl.kernels.surface_step(nu, t) - 1
                total += np.sum(0.5 * w * slope * left * np.exp(-1j * omega * t))
            found = 1 + 1j * omega * total
            exact = lamb.disc_compliance(nu, a0)
            what = f"compliance of the centre of a Hertz disc over its static value, nu = {nu:g}, omega r0/c2 = {a0:g}"
            source = f"{exact.real:.6f}{exact.imag:+.6f}i (Lamb's harmonic integral)"
            rows.append(Curve(what, source, abs(found - exact) / abs(exact), 1e-9))
    return rows
