"""The loaded surface and its neighbourhood: closed forms, and seismograms from other programs."""

from __future__ import annotations

import csv
from collections.abc import Callable
from pathlib import Path

import hertzlamb as hl
import numpy as np

from . import closed_forms
from .collisions import samples
from .lamb import rayleigh_slowness, ratio
from .table import Curve, Row

POINTS = Path(__file__).resolve().parents[2] / "tests" / "reference" / "point_load.csv"


def point(nu: float, r: float, t: np.ndarray, tolerance: float = 1e-13) -> np.ndarray:
    """Vertical displacement at the surface under a point force, by the program; time in units of length over c1."""
    return hl.kernels.step(nu, r, 0.0, t, profile="point", tolerance=tolerance).displacement_z


def clear(nu: float, tau: np.ndarray, away: float = 0.02) -> np.ndarray:
    """Times in r/c2 that are not at the Rayleigh wave, where the displacement is infinite."""
    return tau[abs(tau - rayleigh_slowness(nu)) > away]


def on_disc(nu: float, t: np.ndarray) -> np.ndarray:
    """Deflection of the centre of a Hertz disc by Kausel's point forces: (4/pi) int sqrt(1 - s^2) U(t/s) ds."""
    x, w = np.polynomial.legendre.leggauss(60)
    found = []
    for instant in t:
        # cut where a wave from a radius s arrives; the Rayleigh wave leaves a root in the denominator on one side
        cuts = [instant / front for front in (ratio(nu), 1.0, rayleigh_slowness(nu))]
        ends = np.unique(np.clip([0.0, *cuts, 1.0], 0, 1))
        total = 0.0
        for low, high in zip(ends[:-1], ends[1:]):
            s = 0.5 * (1 + x)
            r = low + (high - low) * s * s * (3 - 2 * s)
            weight = 0.5 * w * (high - low) * 6 * s * (1 - s)
            total += np.sum(weight * np.sqrt(1 - r * r) * closed_forms.kausel(nu, instant / r))
        found.append(4 / np.pi * total)
    return np.array(found)


def largest(found: np.ndarray, exact: np.ndarray) -> float:
    return float(np.max(abs(found - exact)) / np.max(abs(exact)))


def closed() -> list[Row | Curve]:
    """Pekeris, Kausel, and 96 places of pygrt-kit."""
    rows: list[Row | Curve] = []
    tau = clear(0.25, samples(400, 0.3, 1.6, 1))
    what = "surface under a point force, nu = 1/4, 400 times"
    for tolerance, bound, why in (
        (
            1e-13,
            5e-11,
            "the quadrature, asked for 1e-13; times nearer than 0.02 r/c2 to the Rayleigh wave are left out",
        ),
        (1e-10, 1e-7, "the quadrature at its default, 1e-10 of a peak that is infinite; its own estimate is 1e-5"),
    ):
        found = point(0.25, 1.0, tau / ratio(0.25), tolerance) * np.pi
        rows.append(Curve(what, "Pekeris 1955", largest(found, closed_forms.pekeris(tau)), bound, why))
    for nu in (0.0, 0.1, 0.2, 0.3, 0.4, 0.49):
        tau = clear(nu, samples(400, 0.1, 1.6, 2))
        found = point(nu, 1.0, tau / ratio(nu)) * 2 * np.pi / (1 - nu)
        what = f"the same, nu = {nu:g}"
        rows.append(Curve(what, "Kausel 2012", largest(found, closed_forms.kausel(nu, tau)), 5e-11, "as above, 1e-13"))
    for nu in (0.0, 0.25, 0.45):
        t = samples(60, 0.02, 1.0, 3) * rayleigh_slowness(nu)
        found = hl.kernels.surface_step(nu, t / ratio(nu))
        what = f"deflection of the centre of a Hertz disc, nu = {nu:g}, 60 times"
        source = "Kausel's point force, superposed by quadrature"
        rows.append(Curve(what, source, largest(found, on_disc(nu, t)), 1e-10))
    for function, fields, bound in (
        ("lamb1", ["u", "w"], 1e-8),
        ("lamb2", ["u", "w"], 2e-7),
        ("lamb2", ["srr", "stt", "szz", "srz"], 1e-5),
    ):
        error, count = stored(function, fields)
        what = (
            f"{'surface' if function == 'lamb1' else 'inside'} under a point force, {count} places: {', '.join(fields)}"
        )
        why = (
            "noise of the package: ours agree with the closed forms above"
            if function == "lamb1"
            else "its slopes are differences in time"
        )
        rows.append(Curve(what, f"pygrt-kit 0.18.0, `{function}` (tests/reference/point_load.csv)", error, bound, why))
    return rows


FIELD = {
    "u": "displacement_r",
    "w": "displacement_z",
    "srr": "stress_rr",
    "stt": "stress_tt",
    "szz": "stress_zz",
    "srz": "stress_rz",
}


def against(rows: list[dict[str, str]], fields: list[str]) -> float:
    """Largest difference over the largest of these fields in its row."""
    worst = 0.0
    for row in rows:
        nu, r, z, t = (float(row[name]) for name in ("nu", "r", "z", "t"))
        own = hl.kernels.step(nu, r, z, t, profile="point", tolerance=1e-12)
        theirs = np.array([float(row[name]) for name in fields])
        ours = np.array([float(own[FIELD[name]]) for name in fields])
        worst = max(worst, float(np.max(abs(theirs - ours)) / np.max(abs(ours), initial=1e-12)))
    return worst


def stored(function: str, fields: list[str]) -> tuple[float, int]:
    """The rows of tests/reference/point_load.csv."""
    with open(POINTS, newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["function"] == function]
    return against(rows, fields), len(rows)


def package() -> list[Row | Curve]:
    """pygrt-kit itself, at the places of point_load.csv."""
    import sys

    sys.path.insert(0, str(POINTS.parent))
    import point_load

    rows = []
    for nu, r, z, t in point_load.points():
        values = point_load.fields(nu, r, z, t)
        names = ["u", "w", "srr", "stt", "szz", "srz"]
        rows.append({"nu": nu, "r": r, "z": z, "t": t, **dict(zip(names, values))})
    above, below = [row for row in rows if row["z"] == 0], [row for row in rows if row["z"]]
    return [
        Curve("surface under a point force, 32 places: u, w", "pygrt-kit, `lamb1`", against(above, ["u", "w"]), 1e-8),
        Curve("inside, 64 places: u, w", "pygrt-kit, `lamb2`", against(below, ["u", "w"]), 2e-7),
        Curve("inside, 64 places: stresses", "pygrt-kit, `lamb2`", against(below, ["srr", "stt", "szz", "srz"]), 1e-5),
    ]


# ------------------------------------------------------------------ other programs


def bump(order: int) -> Callable[[np.ndarray], np.ndarray]:
    """SW4's C6SmoothBump, 51480 t^7 (1 - t)^7 on (0, 1), or a derivative of it."""
    t = np.polynomial.Polynomial([0, 1])
    shape = (51480 * t**7 * (1 - t) ** 7).deriv(order) if order else 51480 * t**7 * (1 - t) ** 7
    return lambda x: np.where((x > 0) & (x < 1), shape(x), 0.0)


def smooth_nodes(ends: np.ndarray, count: int = 48) -> tuple[np.ndarray, np.ndarray]:
    """Gauss nodes on pieces, crowded at their ends, so that roots in the denominator do no harm."""
    x, w = np.polynomial.legendre.leggauss(count)
    s = 0.5 * (1 + x)
    width = np.diff(ends)[:, None]
    nodes = ends[:-1, None] + width * s * s * (3 - 2 * s)
    return nodes.ravel(), (0.5 * w * width * 6 * s * (1 - s)).ravel()


def lamb_test(distance: float, times: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """SW4's Lamb test (c2 = mu = 1, nu = 1/4) at a distance: exact by Pekeris, and by integrals of the program's steps."""
    exact, ours = [], []
    fronts = distance * np.array([1 / 3**0.5, 1.0, rayleigh_slowness(0.25)])
    static = 0.75 / (2 * np.pi * distance)
    for t in times:
        # delays between the force and now, cut at the arrivals
        ends = np.unique(np.clip([max(t - 1, 0), *fronts, t], max(t - 1, 0), t))
        delay, weight = smooth_nodes(ends)
        rate, curve = bump(1)(t - delay), bump(2)(t - delay)
        exact.append(np.sum(weight * rate * closed_forms.pekeris(delay / distance)) / (np.pi * distance))
        # once integrated in time the point force's remainder is finite at the Rayleigh wave
        own = hl.kernels.step_integral(0.25, distance, 0.0, delay * 3**0.5, profile="point").displacement_z / 3**0.5
        ours.append(static * bump(0)(np.array(t)) + np.sum(weight * curve * own))
    return np.array(exact), np.array(ours)


def programs() -> list[Row | Curve]:
    """SW4's Lamb test and Herrmann's CPS."""
    rows: list[Row | Curve] = []
    for distance, table in ((1.0, "7.17e-2, 3.44e-2, 9.31e-3, 3.25e-3"), (10.0, "4.31e-1, 2.43e-1, 6.99e-2, 2.42e-2")):
        times = np.linspace(0.5, 1.1, 61) * distance + np.linspace(0, 1, 61)
        exact, ours = lamb_test(distance, times)
        what = f"SW4's Lamb test, {distance:g} shear wavelength{'s' if distance > 1 else ''} from the source, 61 times"
        source = "Pekeris convolved with the pulse"
        why = f"SW4's own errors with 3.0e7, 7.3e7, 2.4e8 and 5.8e8 grid points: {table} (its user's guide)"
        rows.append(Curve(what, source, largest(ours, exact), 1e-8, why))
    shear, c1, c2, force = 2980.0 * 3600.0**2, 6200.0, 3600.0, 1e10
    nu = 0.5 * ((c1 / c2) ** 2 - 2) / ((c1 / c2) ** 2 - 1)
    source = "CPS hspec96, kura-okubo/4mNonSelfSim_OpenSWPC 8c4395d, BF_R02_11ZVF.sac"
    static = 100 * force * (1 - nu) / (2 * np.pi * shear * 0.1)
    whys = {
        24: "its source and receiver are 1 mm below the surface and its samples 0.1 us apart; its drift is 0.5 cm by then",
        33: "the drift of its sum over time",
    }
    for instant, theirs in ((24, -2.09), (28, -9.68), (29, -23.51), (33, 31.50), (34, 31.21), (35, 31.07)):
        own = float(point(nu, 0.1, np.array(instant * 1e-6 * c1))) * force / shear * 100
        what = f"surface of rock 100 mm from a step of 1e10 N at {instant} us, cm along the force"
        why = whys.get(instant, "as above")
        rows.append(Row(what, theirs, source if instant == 24 else "as above", own, 0.025, why, scale=static, digits=4))
    return rows
