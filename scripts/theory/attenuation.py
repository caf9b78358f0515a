"""Section 2.11 of docs/theory.md: frequency responses, attenuation, and its weights over the logarithm of time."""

import numpy as np
from scipy.integrate import quad, quad_vec
from scipy.special import jv, j0, j1

LAME = 2 * 0.3 / (1 - 2 * 0.3)


def fields(k, z, omega, factor):
    """u, w, srr + 2 u/r, szz, srz over J of a unit force on a half-space with the moduli `factor` and `factor` LAME, density 1/(2 + LAME)."""
    p2, s2 = omega**2 / factor, omega**2 / factor * (2 + LAME)
    a, b = np.sqrt(k * k - p2 + 0j), np.sqrt(k * k - s2 + 0j)
    g = 2 * k * k - s2
    rayleigh = g * g - 4 * k * k * a * b
    long, shear = np.exp(-a * z), np.exp(-b * z)
    unit = k / (2 * np.pi * rayleigh)
    return np.array(
        [
            k * (g * long - 2 * a * b * shear) * unit / factor,
            a * (g * long - 2 * k * k * shear) * unit / factor,
            -(g * g * long - 4 * k * k * a * b * shear) * unit,
            -2 * a * k * g * (long - shear) * unit,
        ]
    )


def response(r, z, omega, factor):
    """The same integrated over real wave numbers: moduli with a loss have no pole there."""

    def integrand(k):
        u, w, zz, rz = fields(k, z, omega, factor)
        return np.array([u * j1(k * r), w * j0(k * r), zz * j0(k * r), rz * j1(k * r)])

    found, _ = quad_vec(integrand, 0, 40 / z, epsabs=1e-13, epsrel=1e-12, limit=4000)
    return found


def elastic(r, z, omega):
    """The elastic response at a complex frequency, on an arc above the singularities: (T79)."""
    end = 2.2 * abs(omega) * np.sqrt(2 + LAME)

    def integrand(s):
        k = 0.5 * end * (1 - np.cos(np.pi * s)) + 0.3j * np.sin(np.pi * s)
        slope = np.pi * (0.5 * end * np.sin(np.pi * s) + 0.3j * np.cos(np.pi * s))
        u, w, zz, rz = fields(k, z, omega, 1.0)
        return slope * np.array([u * jv(1, k * r), w * jv(0, k * r), zz * jv(0, k * r), rz * jv(1, k * r)])

    arc, _ = quad_vec(integrand, 0, 1, epsabs=1e-13, epsrel=1e-12, limit=4000)
    line, _ = quad_vec(
        lambda k: np.array([f * j for f, j in zip(fields(k, z, omega, 1.0), [j1(k * r), j0(k * r), j0(k * r), j1(k * r)])]),
        end,
        40 / z,
        epsabs=1e-13,
        epsrel=1e-12,
        limit=4000,
    )
    return arc + line


def stable(order, g, x):
    """The inverse transform of s^(-order g) e^(-s^(1 - g)), on a parabola through its saddle point, times (1 - g)."""
    vertex = max((x / (1 - g)) ** (-1 / g), 3 / x)
    step = 0.02 / max(1.0, np.sqrt(vertex))
    root = 1 + 1j * np.arange(0, 8, step)
    s = vertex * root**2
    terms = np.exp(s * x - s ** (1 - g)) * s ** (-order * g) * 2j * vertex * root
    return (1 - g) * step * (np.sum(terms) - 0.5 * terms[0]).imag / np.pi


def check(report):
    """(T78) to (T80)."""
    r, z, omega, quality = 1.3, 0.6, 2.1, 8.0
    g = np.arctan(1 / quality) / np.pi
    factor = (1j * omega / 0.7) ** (2 * g)
    damped = response(r, z, omega, factor)
    moved = elastic(r, z, omega / np.sqrt(factor)) * np.array([1 / factor, 1 / factor, 1, 1])
    report.row("T78", "moduli with a loss against the elastic response at a complex frequency", np.max(abs(moved / damped - 1)), 1e-9)
    report.row("T78", "phase of the moduli over atan(1/Q)", abs(np.angle(factor) / np.arctan(1 / quality) - 1), 1e-13)
    real = elastic(r, z, omega)
    slightly = response(r, z, omega, 1 + 1e-5j)
    report.row("T79", "path above the singularities against moduli with a small loss", np.max(abs(slightly / real - 1)), 1e-3)

    # a step of the elastic response at tau, by the density and by the sine transform of its frequency response
    g = np.arctan(1 / 5) / np.pi
    reference, tau = 0.4, 1.7
    for order, name in ((3, "displacement"), (1, "stress")):
        worst = 0
        for t in (1.7, 2.1, 3.0, 6.0):
            last = np.log(t / (tau * reference**g) ** (1 / (1 - g)))
            found = quad(lambda y: stable(order, g, np.exp(y)) * np.exp(-(order - 1) * g * y), -1.2, last, limit=400)[0]
            found *= (reference * t) ** ((order - 1) * g)

            def spectrum(omega):
                s = 1j * omega
                factor = (s / reference) ** (-2 * g) if order == 3 else 1.0
                return (factor * np.exp(-(s ** (1 - g)) * reference**g * tau)).real * np.sin(omega * t) / omega

            wanted = sum(quad(spectrum, a, b, limit=400)[0] for a, b in ((0, 1), (1, 10), (10, 60), (60, 400)))
            worst = max(worst, abs(found - 2 / np.pi * wanted))
        report.row("T80", f"damped step of a {name} by the density against its transform", worst, 1e-8)
