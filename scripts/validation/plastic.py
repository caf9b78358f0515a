"""Contacts that yield, compared with independent programs: `tests/reference/plastic`."""

from __future__ import annotations

import csv
from collections import defaultdict
from math import exp, pi
from pathlib import Path

import hertzlamb as hl

from .lamb import radiation_parts
from .table import Curve, Row

FOLDER = Path(__file__).resolve().parents[2] / "tests" / "reference" / "plastic"
WAVES = {"none": ("hertz", 1e-8), "dashpot": ("area_dashpot", 1e-7), "memory": ("growing", 1e-6)}
TOLERANCE = 1e-7
NUMBERS = (
    "restitution",
    "contact_time_s",
    "peak_force_n",
    "largest_displacement_m",
    "residual_indentation_m",
    "largest_indentation_m",
)
SOURCE = "ordinary and delay equations, another program"


def read(name: str) -> list[dict[str, str]]:
    with open(FOLDER / name, encoding="utf-8") as file:
        return list(csv.DictReader(file))


def body(plane: float, nu: float, density: float) -> dict[str, float]:
    return {"youngs_modulus_pa": plane * (1 - nu * nu), "poisson_ratio": nu, "density_kg_m3": density}


def from_groups(row: dict[str, str]) -> dict[str, object]:
    """A scene with the groups of a row: E* from the yield velocity, the block's part of it, its wave speed."""
    text = ("case", "ball", "target", "waves", "unloading")
    x = {name: float(value) for name, value in row.items() if name not in text}
    radius, mass, pressure, velocity, nu = (
        x[name] for name in ("radius_m", "mass_kg", "p_y_pa", "velocity_m_s", "poisson")
    )
    shape = (8 * pi * radius**3 / (15 * mass)) ** 0.5
    modulus = pi / 2 * (shape * pressure**2.5 / x["yield_velocity_m_s"]) ** 0.5
    depth = (15 * mass * velocity**2 / (16 * modulus * radius**0.5)) ** 0.4
    speed = (radius / depth) ** 0.5 * velocity / x["tau"]
    plane = modulus / x["phi"]
    density = plane * (1 - nu) ** 2 / ((1 - 2 * nu) * speed**2)
    striker = {**body(1 / (1 / modulus - 1 / plane), 0.0, 1.0), "tip_radius_m": radius, "mass_kg": mass}
    contact = {"plasticity": row["unloading"], "yield_pressure_pa": pressure}
    return {"target": body(plane, nu, density), "striker": {**striker, "velocity_m_s": velocity}, "contact": contact}


def from_fit(row: dict[str, str]) -> tuple[dict[str, object], float, float]:
    """A scene of a row of Jackson and Green's fit, its critical indentation and velocity."""
    strain, nu, ratio, lag = (
        float(row[name]) for name in ("S_y_over_Estar", "poisson_yielding", "V_over_Vc", "lag_at_Vc")
    )
    modulus, radius, mass = 1e11, 0.01, 0.03
    depth = (pi * 1.295 * exp(0.736 * nu) * strain / 2) ** 2 * radius
    stiffness = 4 / 3 * modulus * radius**0.5
    critical = (0.8 * stiffness * depth**2.5 / mass) ** 0.5
    # the lag J/(mu c2) in units of the critical indentation, force and velocity
    shear = modulus * (1 - nu) / 2
    unit = sum(radiation_parts(nu)) * stiffness * critical / depth**0.5 / shear**1.5
    target = {**body(modulus, nu, ((lag or 1e-6) / unit) ** 2), "yield_strength_pa": strain * modulus}
    striker = {**body(1e30, 0.0, 1.0), "tip_radius_m": radius, "mass_kg": mass, "velocity_m_s": ratio * critical}
    return {"target": target, "striker": striker, "contact": {"plasticity": "jackson_green"}}, depth, critical


def plastic() -> list[Row | Curve]:
    """Largest difference over all impacts of a kind: of restitutions as they are, of depths over the largest indentation."""
    off: dict[tuple[str, str], list[float]] = defaultdict(list)
    for row in read("results.csv"):
        scene, kind = from_groups(row), (row["unloading"], row["waves"])
        scene["contact"] |= {"model": WAVES[row["waves"]][0], "tolerance": TOLERANCE}
        run = hl.impact(scene)
        x = {name: float(row[name]) for name in NUMBERS}
        off[kind] += [
            abs(run.restitution - x["restitution"]),
            abs(run.contact_time_s / x["contact_time_s"] - 1),
            abs(run.peak_force_n / x["peak_force_n"] - 1),
            abs(run.peak_displacement_m / x["largest_displacement_m"] - 1),
            abs(run.residual_indentation_m - x["residual_indentation_m"]) / x["largest_indentation_m"],
        ]
    what = "restitution, duration, force, displacement, residual depth"
    found: list[Row | Curve] = []
    for (law, waves), each in off.items():
        model, bound = WAVES[waves]
        count = len(each) // 5
        found.append(Curve(f"`{law}`, {model}: {what} of {count} impacts", SOURCE, max(each), bound))
    fit = []
    for row in read("jackson_green.csv"):
        scene, depth, critical = from_fit(row)
        model = "area_dashpot" if float(row["lag_at_Vc"]) > 0 else "hertz"
        scene["contact"] |= {"model": model, "tolerance": TOLERANCE}
        run = hl.impact(scene)
        fit += [
            abs(run.restitution - float(row["restitution"])),
            abs(run.contact_time_s * critical / depth / float(row["contact_time_Vc_over_wc"]) - 1),
            abs(run.peak_displacement_m / depth / float(row["w_max_over_wc"]) - 1),
        ]
    count = len(fit) // 3
    found.append(Curve(f"`jackson_green`: the same but force and depth, {count} impacts", SOURCE, max(fit), 1e-6))
    return found
