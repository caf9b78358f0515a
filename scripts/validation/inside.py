"""Inside the block: Huber's static field, and the first front of an impulse on the axis."""

from __future__ import annotations

import hertzlamb as hl
import numpy as np
from scipy.optimize import minimize_scalar

from . import closed_forms
from .table import Curve, Row

PEAK = 1.5 / np.pi  # Hertz's largest pressure in P/r0^2


def static() -> list[Row | Curve]:
    """Huber's stresses at 400 places, and the numbers that textbooks print."""
    rows: list[Row | Curve] = []
    random = np.random.default_rng(4)
    r, z = 10 ** random.uniform(-1.5, 1, 400), 10 ** random.uniform(-2, 1, 400)
    for nu in (0.0, 0.25, 0.3, 0.45):
        own = hl.kernels.static(nu, r, z)
        for name, exact in closed_forms.huber(nu, r, z).items():
            error = np.max(abs(own[name] / PEAK - exact)) / np.max(abs(exact))
            rows.append(Curve(f"static {name} at 400 places, to 10 radii, nu = {nu:g}", "Huber 1904", error, 1e-11))
    at = lambda r, z, name: float(hl.kernels.static(0.3, r, z)[name]) / PEAK
    shear = lambda z: -0.5 * abs(at(0.0, z, "stress_zz") - at(0.0, z, "stress_rr"))
    deepest = minimize_scalar(shear, (0.3, 0.48, 0.7), options={"xtol": 1e-10})
    two = "two digits are printed"
    rows += [
        Row(
            "largest shear stress on the axis over the largest pressure, nu = 0.3",
            0.31,
            "Johnson 1985, ch. 4",
            -deepest.fun,
            5e-3,
            two,
            digits=4,
        ),
        Row("its depth over the radius", 0.48, "Johnson 1985, ch. 4", deepest.x, 5e-3, two, digits=4),
        Row(
            "radial tension at the edge over the largest pressure, nu = 0.3",
            0.4 / 3,
            "(1 - 2 nu)/3, Huber",
            at(1.0, 0.0, "stress_rr"),
            1e-12,
        ),
        Row(
            "deflection of the edge over the centre's",
            0.5,
            "Hertz",
            at(1.0, 0.0, "displacement_z") / at(0.0, 0.0, "displacement_z"),
            1e-12,
        ),
    ]
    return rows


def fronts() -> list[Row | Curve]:
    """The plane wave at the first front on the axis: nothing has come from the edge, so it is that of a bar in uniaxial strain."""
    rows: list[Row | Curve] = []
    for nu in (0.1, 0.3, 0.45):
        kappa2 = (1 - 2 * nu) / (2 - 2 * nu)
        for z in (0.3, 1.0, 4.0):
            near = 1e-7
            step = hl.kernels.step(nu, 0.0, z, z + near, tolerance=1e-13)
            rate = float(step.displacement_z) / near
            what = f"rate of the displacement at the first front on the axis, nu = {nu:g}, depth {z:g} r0"
            why = "taken 1e-7 r0/c1 after the front"
            rows.append(Row(what, kappa2 * PEAK, "largest pressure over rho c1", rate, 1e-6, why))
            what = "its stress"
            stress = float(step.stress_zz)
            rows.append(
                Row(what, -PEAK, "the largest pressure", stress, 1e-6, "the load is curved: behind the front it falls")
            )
            rows.append(
                Row("the radial stress", -PEAK * nu / (1 - nu), "nu/(1 - nu) of it", float(step.stress_rr), 1e-6)
            )
    return rows
