"""What a scene takes is what the program says before: processor time, which other work on the machine disturbs little."""

import contextlib
import importlib.machinery
import importlib.util
import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from conftest import PROGRAM, ROOT, run

loader = importlib.machinery.SourceFileLoader("time_impacts", str(ROOT / "scripts" / "time-impacts"))
times = importlib.util.module_from_spec(importlib.util.spec_from_loader("time_impacts", loader))
loader.exec_module(times)

JOBS = [job for job in times.jobs(None, False) if job[2] and job[2][0] != "sweep"]
PROCESS_S = 0.05
"""What a process takes beside its fields, at most."""


def test_what_is_forecast_is_described():
    assert len(JOBS) >= 10
    document = (ROOT / "data-schema" / "results.md").read_text()
    for key in json.loads(run("impact", ROOT / "scenes" / "sensor.toml", "--dry-run", "--json").stdout):
        assert f"`{key}`" in document, key


@pytest.mark.parametrize(("name", "scene", "arguments", "most"), JOBS, ids=lambda value: value if isinstance(value, str) and "\n" not in value else "")
def test_a_forecast_is_within_a_factor_of_three(name, scene, arguments, most, tmp_path):
    command = times.command(PROGRAM, tmp_path, scene, arguments)
    told = times.forecast(PROGRAM, tmp_path, arguments)
    took, why = min(times.processor_time(command) for _ in range(min(most, 3)))
    assert not why, why
    assert told / 3 - PROCESS_S < took < 3 * told + PROCESS_S, name


@pytest.mark.parametrize(
    ("rows", "keys", "probes"),
    [(30_000, "", 1), (60_000, "", 3), (10_000, "low_pass_hz = 1e7", 0)],
    ids=["a probe", "three probes", "rows of a low pass"],
)
def test_a_record_takes_what_was_forecast(rows, keys, probes, tmp_path):
    """Noise throughout has a slope and a bend in every cell; a low pass far above the rows adds rows."""
    rng = np.random.default_rng(7)
    time = np.arange(rows) * (2e-3 / rows)
    force = 500 * np.exp(-(((time - 1e-3) / 1e-4) ** 2)) + rng.normal(0, 1, rows)
    np.savetxt(tmp_path / "f.csv", np.c_[time, force], delimiter=",", header="time_s,force_n", comments="")
    places = "".join(f"[[probe]]\nr_m = {0.02 * (i + 1)}\nz_m = 0\n" for i in range(probes))
    scene = tmp_path / "s.toml"
    scene.write_text(f'[target]\nmaterial = "steel"\n[force]\nfile = "f.csv"\n{keys}\n[contact]\ndisc_radius_m = 0.005\n{places}')
    told = json.loads(run("impact", scene, "--dry-run", "--json").stdout)
    command = [PROGRAM, "impact", scene, "-o", tmp_path / "o.h5", "-q"]
    with subprocess.Popen(command, env={**os.environ, "RAYON_NUM_THREADS": "1"}, stderr=subprocess.DEVNULL) as process:
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0
    # beside the program itself
    assert 1024 * used.ru_maxrss < 1.5 * told["memory_bytes"] + 3e7
    if probes:
        threads = min(probes, os.cpu_count())
        assert used.ru_utime < 3 * told["seconds"] * threads + 2 * PROCESS_S


def test_the_plan_of_a_sweep_is_within_a_factor_of_three(tmp_path):
    """Draws of Poisson's ratio begin with a lattice that is made once, not once a row."""
    text = (ROOT / "scenes" / "uncertain.toml").read_text()
    sweep = tmp_path / "sweep.toml"
    sweep.write_text(text.replace("samples = 20000", "samples = 400000"))
    plan = json.loads(run("sweep", sweep, "--plan", "--json").stdout)
    assert plan["rows"] == 400_000
    told = plan["seconds"] * plan["threads"]
    took, why = times.processor_time([PROGRAM, "sweep", sweep, "-o", tmp_path / "out.h5"])
    assert not why, why
    assert told / 3 < took < 3 * told


BALL = """
[target]
{target}
[striker]
shape = "ball"
material = "steel"
diameter_m = 0.005
velocity_m_s = 0.6
[contact]
tolerance = {tolerance}
{contact}
[output]
quantities = {quantities}
"""
RATES = '["velocity_z", "acceleration_z"]'
YIELDS = 'plasticity = "recovery"\nyield_pressure_pa = 6e8'
NEARLY_INCOMPRESSIBLE = "youngs_modulus_pa = 2e7\npoisson_ratio = 0.4995\ndensity_kg_m3 = 1100"
SOME = [
    ('material = "soda-lime-glass"', "", "1e-4", RATES, 0.0, 2e-5),
    ('material = "soda-lime-glass"', "", "1e-4", RATES, 3e-5, 0.0),
    ('material = "soda-lime-glass"', "", "1e-5", '["velocity_z"]', 3e-5, 0.0),
    ('material = "soda-lime-glass"', YIELDS, "1e-4", RATES, 2e-5, 0.0),
    (NEARLY_INCOMPRESSIBLE, "", "1e-4", "[]", 0.0, 0.0),
    (NEARLY_INCOMPRESSIBLE, "", "1e-4", '["velocity_z"]', 0.0, 1e-4),
]


def dry_run(path):
    done = run("impact", path, "--dry-run", "--json")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.parametrize("case", range(len(SOME)))
def test_a_point_inside_a_contact_takes_at_most_three_times_its_forecast(case, tmp_path):
    target, contact, tolerance, quantities, r_m, z_m = SOME[case]
    path = tmp_path / "scene.toml"
    scene = BALL.format(target=target, contact=contact, tolerance=tolerance, quantities=quantities)
    path.write_text(f"{scene}[[probe]]\nr_m = {r_m}\nz_m = {z_m}\n")
    took, why = times.processor_time([PROGRAM, "impact", path, "-o", tmp_path / "out.h5"])
    assert not why, why
    told = dry_run(path)["seconds"]
    assert told / 12 - PROCESS_S < took < 3 * told + PROCESS_S


def peak_bytes(*arguments):
    """Largest memory of a run that succeeds, from the kernel's high-water mark: that of wait4 counts this process, too."""
    process = subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    largest = 0
    while process.poll() is None:
        with contextlib.suppress(OSError):
            status = Path(f"/proc/{process.pid}/status").read_text()
            largest = max([largest, *(1024 * int(kb) for kb in re.findall(r"^VmHWM:\s+(\d+) kB", status, re.MULTILINE))])
        time.sleep(0.002)
    assert process.returncode == 0
    return largest


ROD = """
[{0}target]
material = "copper"
[{0}striker]
shape = "rod"
material = "steel"
diameter_m = 0.012
length_m = 0.04
tip_radius_m = 4000
velocity_m_s = 1.1
[{0}contact]
tolerance = 1e-4
[{0}output]
duration_s = 1.5e-4
[[{0}probe]]
r_m = 0.0
z_m = 0.003
[[{0}probe]]
r_m = 0.005
z_m = 0.0
"""


@pytest.mark.skipif(sys.platform != "linux", reason="/proc has the largest memory of a process")
def test_memory_under_a_wide_contact_is_forecast_and_bounded(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(ROD.format(""))
    told = dry_run(path)["memory_bytes"]
    found = peak_bytes("impact", path, "-o", tmp_path / "out.h5")
    assert found < 1.3 * told + 3e7 and told < 4 * found
    refused = run("impact", path, "--max-memory", 0.8e-9 * told)
    assert refused.returncode == 2 and "--max-memory" in refused.stderr
    sweep = tmp_path / "sweep.toml"
    sweep.write_text(ROD.format("scene.") + "[product.striker]\nvelocity_m_s = [0.9, 1.0, 1.1]\n")
    refused = run("sweep", sweep, "-o", tmp_path / "s.h5", "--max-memory", 1e-9 * (1.3e8 + told / 2))
    assert refused.returncode == 2 and "the sweep with its fields needs" in refused.stderr
