"""What a scene takes is what the program says before: processor time, which other work on the machine disturbs little."""

import importlib.machinery
import importlib.util
import json
import os
import subprocess

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
