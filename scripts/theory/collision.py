"""An impact in SI units and its dimensionless groups, (T36) to (T39) of docs/theory.md."""

import numpy as np
from scipy.special import beta, gamma

from .halfspace import Medium
from .surface import lag

LOSS = 4.5 * beta(0.8, 1.5)
TIME = 0.8 * np.pi**0.5 * gamma(0.4) / gamma(0.9)


class Collision:
    """SI numbers of an impact and its groups, (T36) to (T39)."""

    def __init__(self, V0, m, R, E1, nu1, E, nu, rho, disc=None):
        self.V0, self.m, self.R = V0, m, R
        self.medium = Medium(nu)
        self.mu = E / (2 + 2 * nu)
        self.c2 = (self.mu / rho) ** 0.5
        self.c1 = self.c2 / self.medium.kappa
        self.modulus = 1 / ((1 - nu1**2) / E1 + (1 - nu**2) / E)
        self.K = 4 / 3 * self.modulus * R**0.5
        self.length = (1.25 * m * V0**2 / self.K) ** 0.4
        self.time = self.length / V0
        self.force = self.K * self.length**1.5
        self.phi = self.modulus * (1 - nu**2) / E
        self.tau = (R * self.length) ** 0.5 / self.c1 / self.time
        self.lag = lag(self.medium) / (self.mu * self.c2)
        if disc:
            self.wave_time = disc / self.c1 / self.time
            self.unit = self.force / (self.mu * disc) / self.length

    def reduced_lag(self):
        return self.lag * self.force / (self.length * self.time)


PAPER = dict(V0=100.0, m=0.0122, R=0.004, nu1=0.34, E=209e9, nu=0.3, rho=7830.0, disc=0.004)
