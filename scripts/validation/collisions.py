"""Hertz's impact, its first-order radiated loss, and the area dashpot, computed without the program."""

from __future__ import annotations

from dataclasses import dataclass
from math import gamma, pi

import numpy as np
from scipy.integrate import solve_ivp

from .lamb import radiation_parts


@dataclass
class Solid:
    """Young's modulus in Pa, Poisson's ratio, density in kg/m^3."""

    e: float
    nu: float
    rho: float

    @property
    def compliance(self) -> float:
        return (1 - self.nu**2) / self.e

    @property
    def shear(self) -> float:
        return self.e / (2 + 2 * self.nu)

    def scene(self) -> dict[str, float]:
        return {"youngs_modulus_pa": self.e, "poisson_ratio": self.nu, "density_kg_m3": self.rho}


@dataclass
class Drop:
    """A ball of a radius in m at a velocity in m/s on a half-space."""

    ball: Solid
    block: Solid
    radius: float
    velocity: float

    @property
    def mass(self) -> float:
        return 4 / 3 * pi * self.radius**3 * self.ball.rho

    @property
    def modulus(self) -> float:
        return 1 / (self.ball.compliance + self.block.compliance)

    @property
    def stiffness(self) -> float:
        return 4 / 3 * self.modulus * self.radius**0.5

    @property
    def depth(self) -> float:
        """Hertz's largest approach, m."""
        return (1.25 * self.mass * self.velocity**2 / self.stiffness) ** 0.4

    @property
    def force(self) -> float:
        """Hertz's largest force, N."""
        return self.stiffness * self.depth**1.5

    @property
    def time(self) -> float:
        """Hertz's contact time, s."""
        return 0.8 * pi**0.5 * gamma(0.4) / gamma(0.9) * self.depth / self.velocity

    @property
    def lag(self) -> float:
        """J/(mu c2) in m s/N: delayed deflection of the block per rate of the force."""
        shear = self.block.shear
        return sum(radiation_parts(self.block.nu)) / (shear * (shear / self.block.rho) ** 0.5)

    @property
    def loss(self) -> float:
        """1 - e^2 to first order: the lag times the integral of the squared rate of Hertz's force."""
        rate = 4.5 * gamma(0.8) * gamma(1.5) / gamma(2.3)  # (5/2) int p'^2 dt
        return rate * self.lag * self.stiffness * self.velocity / self.depth**0.5

    def dashpot(self) -> tuple[float, float, float]:
        """Loss, largest force and contact time with a dashpot 4 (J/(mu c2)) E*^2 R d parallel to Hertz's spring."""
        damping = 4 * self.lag * self.modulus**2 * self.radius
        force = lambda d, v: max(self.stiffness * max(d, 0) ** 1.5 + damping * max(d, 0) * v, 0)
        # in units of Hertz's approach and of the velocity
        unit = self.depth / self.velocity
        rate = lambda t, y: [
            y[1],
            -force(y[0] * self.depth, y[1] * self.velocity) * self.depth / (self.mass * self.velocity**2),
        ]
        # the force over the depth, which crosses zero where the contact ends
        root = lambda d: np.sign(d) * abs(d) ** 0.5
        end = lambda t, y: self.stiffness * root(y[0] * self.depth) + damping * y[1] * self.velocity + (t < 0.5) * 1e30
        end.terminal, end.direction = True, -1
        run = solve_ivp(rate, (0, 9), [0.0, 1.0], method="DOP853", events=end, rtol=1e-12, atol=1e-14, max_step=0.01)
        peak = max(force(d * self.depth, v * self.velocity) for d, v in run.y.T)
        return 1 - run.y[1, -1] ** 2, peak, run.t[-1] * unit

    def scene(self, **contact: object) -> dict[str, object]:
        """The same impact as a scene of the program."""
        striker = {**self.ball.scene(), "shape": "ball", "diameter_m": 2 * self.radius, "velocity_m_s": self.velocity}
        return {"target": self.block.scene(), "striker": striker, "contact": contact}


def mclaskey(drop: Drop) -> tuple[float, float]:
    """Largest force and contact time as ball drops are given: McLaskey and Glaser 2012, equation 7."""
    delta = (drop.ball.compliance + drop.block.compliance) / pi
    force = 1.917 * drop.ball.rho**0.6 * delta**-0.4 * drop.radius**2 * drop.velocity**1.2
    time = 4.53 * (4 * drop.ball.rho * pi * delta / 3) ** 0.4 * drop.radius * drop.velocity**-0.2
    return force, time


def fall(height: float) -> float:
    """Velocity after a fall from rest, m/s."""
    return (2 * 9.80665 * height) ** 0.5


STEEL = Solid(208.197e9, 0.286, 7758.8)


def samples(count: int, low: float, high: float, seed: int) -> np.ndarray:
    """The same random numbers in every run."""
    return np.random.default_rng(seed).uniform(low, high, count)
