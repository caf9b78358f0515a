"""Fields as a user gets them, against an independent inversion of the transforms (tests/golden/fields.csv)."""

import csv
import math

import h5py
import numpy as np
import pytest
from conftest import ROOT, run_well

MODULUS, DENSITY, RADIUS, PEAK = 2.09e11, 7830.0, 0.004, 1000.0
FIELDS = ["displacement_z", "displacement_r", "stress_zz", "stress_rz", "stress_rr", "stress_tt"]


def groups():
    """(nu, r, z, length of the pulse): rows of t and the six fields."""
    found = {}
    with open(ROOT / "tests" / "golden" / "fields.csv", newline="") as file:
        for row in list(csv.reader(file))[1:]:
            numbers = [float(x) for x in row]
            found.setdefault(tuple(numbers[:4]), []).append(numbers[4:11])
    return found


GROUPS = groups()


def interpolated(time, values, instant):
    """Lagrange's polynomial through eight samples."""
    start = int(np.clip(np.searchsorted(time, instant) - 4, 0, len(time) - 8))
    x, y = time[start : start + 8], values[start : start + 8]
    return sum(y[i] * np.prod([(instant - x[j]) / (x[i] - x[j]) for j in range(8) if j != i]) for i in range(8))


def errors(folder, group, *kernel, step=0.05):
    """Largest error over the rows of a group, one number a field, as a share of the field's peak in time."""
    nu, r, z, length = group
    shear = MODULUS / (2 * (1 + nu))
    unit_s = RADIUS / math.sqrt(MODULUS * (1 - nu) / ((1 + nu) * (1 - 2 * nu) * DENSITY))
    # lines between rows leave less than 1e-7 of a response
    instants = np.linspace(0, length, 8 * math.ceil(4000 * length / 8) + 1)
    pulse = PEAK * np.sin(np.pi * instants / length) ** 4
    lines = [f"{float(t * unit_s)!r},{max(float(p), 0.0)!r}" for t, p in zip(instants, pulse)]
    (folder / "pulse.csv").write_text("time_s,force_n\n" + "\n".join(lines) + "\n")
    (folder / "scene.toml").write_text(
        f"""
        [target]
        youngs_modulus_pa = {MODULUS}
        poisson_ratio = {nu}
        density_kg_m3 = {DENSITY}
        [force]
        file = "pulse.csv"
        [contact]
        disc_radius_m = {RADIUS}
        step_s = {step * unit_s}
        tolerance = 1e-6
        [output]
        duration_s = {(GROUPS[group][-1][0] + 1) * unit_s}
        [[probe]]
        r_m = {r * RADIUS}
        z_m = {z * RADIUS}
        """
    )
    out = folder / "out.h5"
    run_well("impact", folder / "scene.toml", *kernel, "-o", out, "--force")
    worst = []
    with h5py.File(out, "r") as file:
        time = file["time"][()] / unit_s
        for column, name in enumerate(FIELDS, start=1):
            unit = shear * RADIUS / PEAK if name.startswith("displacement") else RADIUS**2 / PEAK
            samples = unit * file["probes"][name][0]
            gaps = [abs(interpolated(time, samples, row[0]) - row[column]) for row in GROUPS[group]]
            # the reference is known to 1e-10, on the surface to 1e-7
            worst.append((max(gaps) - (2e-7 if z == 0 else 2e-10)) / max(np.abs(samples).max(), 1e-300))
    return np.array(worst)


@pytest.mark.parametrize("group", [g for g in GROUPS if g[0] == 0.3 and g[3] >= 10], ids=str)
def test_fields_from_the_table(tmp_path, table, group):
    assert np.all(errors(tmp_path, group, "--kernel", "table", "--table", table) < 1e-5)


@pytest.mark.parametrize("group", list(GROUPS), ids=str)
def test_fields_from_direct_kernels(tmp_path, group):
    # the pulse is smooth on a step of 1/800 of it: what is left is that of the kernels and of the reference
    step = min(0.05, group[3] / 800)
    assert np.all(errors(tmp_path, group, "--kernel", "direct", step=step) < 1e-7)
