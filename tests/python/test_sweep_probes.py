"""Sweeps with probes: rows beside `impact`, independence of threads, shards and interruptions, what makes two the same."""

import importlib.machinery
import importlib.util
import os
import signal
import subprocess
import time

import h5py
import numpy as np
import pytest
from conftest import PROGRAM, ROOT, run, run_well

FIELDS = ["displacement_r", "displacement_z", "stress_rr", "stress_tt", "stress_zz", "stress_rz", "von_mises"]
SCENE = """
[target]
youngs_modulus_pa = 2.09e11
poisson_ratio = 0.3
density_kg_m3 = 7830
[striker]
material = "steel"
shape = "ball"
diameter_m = 0.005
velocity_m_s = {velocity}
[contact]
tolerance = {tolerance}
{contact}
[[probe]]
r_m = 0.0
z_m = 4e-4
[[probe]]
r_m = 3e-4
z_m = 3e-4
[output]
quantities = ["von_mises"]
peaks = true
"""
VELOCITIES = [1.0, 4.0, 16.0]


def write(folder, axes, velocity=1.0, tolerance=1e-3, contact=""):
    (folder / "base.toml").write_text(SCENE.format(velocity=velocity, tolerance=tolerance, contact=contact))
    (folder / "s.toml").write_text('scene = "base.toml"\n' + axes)


def results(path):
    with h5py.File(path) as file:
        return {name: data[()] for name, data in file["results"].items()}


def described(path):
    with h5py.File(path) as file:
        return {name: (data.attrs["units"], data.attrs["long_name"]) for name, data in file["results"].items()}


@pytest.mark.parametrize("contact", ["", 'model = "wave"\ndisc_radius_m = 3e-4'])
@pytest.mark.parametrize("kernel", ["table", "direct"])
def test_rows_are_what_impact_gives(tmp_path, table, kernel, contact):
    write(tmp_path, f"[product.striker]\nvelocity_m_s = {VELOCITIES}\n", contact=contact)
    asked = ["--kernel", kernel] + (["--table", table] if kernel == "table" else [])
    run_well("sweep", "s.toml", *asked, "-o", "s.h5", cwd=tmp_path)
    rows = results(tmp_path / "s.h5")
    assert list(rows["failure"]) == [-1, -1, -1]
    assert list(rows["probe_table"]) == [float(kernel == "table")] * 3
    for i, velocity in enumerate(VELOCITIES):
        text = SCENE.format(velocity=velocity, tolerance=1e-3, contact=contact)
        (tmp_path / "one.toml").write_text(text)
        run_well("impact", "one.toml", *asked, "-o", "one.h5", "--force", cwd=tmp_path)
        with h5py.File(tmp_path / "one.h5") as one:
            # a contact on a disc takes tabulated responses in a sweep, off by 1e-6 at most
            same = 0.0 if not contact else 2e-6
            assert rows["peak_force_n"][i] == pytest.approx(one.attrs["peak_force_n"], rel=same, abs=0)
            for field in FIELDS:
                for suffix in ["_peak", "_peak_time", "_error"]:
                    for probe in (1, 2):
                        found = rows[f"probe_{probe}_{field}{suffix}"][i]
                        # the error of a row is that of its peak
                        of_peak = suffix.replace("_error", "_peak_error")
                        alone = one[f"probes/{field}{of_peak}"][probe - 1]
                        if same == 0.0:
                            assert found == alone, (velocity, probe, field, suffix, found, alone)
                        elif suffix == "_peak":
                            largest = max(abs(one[f"probes/{kind}_peak"][probe - 1]) for kind in FIELDS[2:])
                            scale = largest if field not in FIELDS[:2] else abs(one["probes/displacement_z_peak"][probe - 1])
                            assert abs(found - alone) < 1e-5 * scale, (velocity, probe, field, found, alone)


def test_columns_have_names_units_and_meanings(tmp_path):
    write(tmp_path, f"[product.striker]\nvelocity_m_s = {VELOCITIES}\n", tolerance=1e-2)
    run_well("sweep", "s.toml", "-o", "s.h5", "--csv", "s.csv", cwd=tmp_path)
    found = described(tmp_path / "s.h5")
    assert found["probe_1_stress_zz_peak"][0] == "Pa"
    assert found["probe_2_von_mises_peak_time"][0] == "s"
    assert found["probe_2_displacement_z_error"][0] == "m"
    assert "at probe 2" in found["probe_2_displacement_z_error"][1]
    assert len([name for name in found if name.startswith("probe_")]) == 1 + 2 * 7 * 3
    with h5py.File(tmp_path / "s.h5") as file:
        assert file.attrs["format_version"] == "1.7"
        assert 'kernel = "direct"' in file.attrs["sweep"]
    head, *lines = (tmp_path / "s.csv").read_text().splitlines()
    place = head.split(",").index("probe_1_stress_zz_peak")
    peaks = results(tmp_path / "s.h5")["probe_1_stress_zz_peak"]
    assert [float(line.split(",")[place]) for line in lines] == list(peaks)
    # what is chosen, rounded
    chosen = "probe_1_stress_zz_peak,restitution"
    run_well("sweep", "s.toml", "-o", "few.h5", "--columns", chosen, "--float32", cwd=tmp_path)
    few = results(tmp_path / "few.h5")
    assert set(few) == {"striker.velocity_m_s", "probe_1_stress_zz_peak", "restitution", "model", "failure"}
    assert list(few["probe_1_stress_zz_peak"]) == list(peaks.astype(np.float32))
    wrong = run("sweep", "s.toml", "-o", "x.h5", "--columns", "probe_3_stress_zz_peak", cwd=tmp_path)
    assert wrong.returncode == 2 and "probe_2_stress_zz_peak" in wrong.stderr
    plan = run_well("sweep", "s.toml", "--plan", cwd=tmp_path)
    assert "probe_2_von_mises_peak_time" in plan["columns"]
    run_well("sweep", "s.toml", "--rows", "0:3", "-o", "part.h5", cwd=tmp_path)
    assert set(plan["columns"]) == set(described(tmp_path / "part.h5"))
    columns = 3 * (8 + 8 + (23 + 43) * 8 + 1 + 4)
    assert plan["bytes_per_shard"] == columns + columns // 256  # and the seal


# 120 draws; some rows outside the table, some contacts that fail
DRAWS = """[random]
samples = 120
seed = 3
[random.striker]
velocity_m_s = { distribution = "normal", mean = 3.0, deviation = 2.0 }
diameter_m = { distribution = "log_normal", median = 0.004, deviation = 0.7 }
"""


def test_rows_depend_on_nothing_but_the_sweep(tmp_path, table):
    write(tmp_path, DRAWS)
    asked = ["--table", table, "--kernel", "table"]
    said = run_well("sweep", "s.toml", *asked, "-o", "whole.h5", "--csv", "whole.csv", cwd=tmp_path)
    rows = results(tmp_path / "whole.h5")
    contact = rows["model"] != 255
    outside = contact & (rows["failure"] >= 0)
    assert 0 < outside.sum() < 60 and (~contact).sum() > 0
    assert said["looked_up"] == (rows["failure"] == -1).sum()
    assert said["failed"] == (rows["failure"] >= 0).sum()
    # the contact stays where its fields alone have failed
    assert np.isfinite(rows["peak_force_n"][contact]).all()
    assert np.isnan(rows["probe_1_stress_zz_peak"][outside]).all()
    assert np.isfinite(rows["probe_1_stress_zz_peak"][contact & ~outside]).all()
    with h5py.File(tmp_path / "whole.h5") as file:
        reasons = file["failures"].asstr()[()]
    assert all("outside the table's range" in reasons[rows["failure"][i]] for i in np.flatnonzero(outside))
    whole = (tmp_path / "whole.h5").read_bytes()
    one = {**os.environ, "RAYON_NUM_THREADS": "1"}
    command = [PROGRAM, "-q", "sweep", "s.toml", *asked]
    subprocess.run([*command, "-o", "one.h5"], cwd=tmp_path, env=one, check=True, capture_output=True)
    assert (tmp_path / "one.h5").read_bytes() == whole
    # stopped in the middle, and taken up again
    part = tmp_path / "stopped.h5.part"
    stopped = subprocess.Popen([*command, "-o", "stopped.h5"], cwd=tmp_path, env=one, stderr=subprocess.DEVNULL)
    while stopped.poll() is None and (not part.exists() or part.stat().st_size < 1000):
        time.sleep(0.002)
    stopped.send_signal(signal.SIGKILL)
    stopped.wait()
    run_well("sweep", "s.toml", *asked, "-o", "stopped.h5", *(["--force"] if not part.exists() else []), cwd=tmp_path)
    assert (tmp_path / "stopped.h5").read_bytes() == whole
    # in parts
    (tmp_path / "out").mkdir()
    for i, bounds in enumerate(["0:7", "7:50", "50:120"]):
        run_well("sweep", "s.toml", *asked, "--rows", bounds, "-o", f"out/{i}.h5", cwd=tmp_path)
    status = run_well("sweep", "status", "out", "--sweep", "s.toml", *asked, cwd=tmp_path)
    assert status["complete"] and not status["foreign"]
    run_well("sweep", "merge", "out", "-o", "merged.h5", cwd=tmp_path)
    assert (tmp_path / "merged.h5").read_bytes() == whole
    again = run("sweep", "s.toml", *asked, "--rows", "0:7", "--skip-complete", "-o", "out/0.h5", cwd=tmp_path)
    assert again.returncode == 0, again.stderr


def test_kernels_are_part_of_what_makes_two_sweeps_the_same(tmp_path, table):
    write(tmp_path, f"[product.striker]\nvelocity_m_s = {VELOCITIES}\n", tolerance=1e-2)

    def sha256(*asked):
        return run_well("sweep", "s.toml", "--plan", *asked, cwd=tmp_path)["sweep_sha256"]

    found = {sha256(), sha256("--table", table), sha256("--table", table, "--kernel", "table")}
    assert len(found) == 3
    run_well("sweep", "s.toml", "--table", table, "-o", "s.h5", cwd=tmp_path)
    other = run("sweep", "s.toml", "-o", "s.h5", "--skip-complete", cwd=tmp_path)
    assert other.returncode == 1 and "another sweep" in other.stderr
    # a base scene without probes has no kernels
    base = (tmp_path / "base.toml").read_text().split("[[probe]]")[0]
    (tmp_path / "base.toml").write_text(base)
    refused = run("sweep", "s.toml", "--table", table, "-o", "t.h5", cwd=tmp_path)
    assert refused.returncode == 2 and "no [[probe]]" in refused.stderr


def test_auto_takes_the_table_where_the_stored_errors_are_within_the_tolerance(tmp_path, table):
    velocities = "[list.striker]\nvelocity_m_s = [1.0, 1.0, 1.0]\n"
    write(tmp_path, "[list.contact]\ntolerance = [4e-2, 2e-4, 1e-6]\n" + velocities)
    said = run_well("sweep", "s.toml", "--table", table, "-o", "s.h5", cwd=tmp_path)
    rows = results(tmp_path / "s.h5")
    assert list(rows["probe_table"]) == [1.0, 0.0, 0.0] and said["looked_up"] == 1
    # both are the same field within what they claim
    difference = abs(np.diff(rows["probe_1_stress_zz_peak"]))[1]
    assert difference < rows["probe_1_stress_zz_error"].sum() + 1e-2 * abs(rows["probe_1_stress_zz_peak"][0])
    # the row that is computed at 2e-4 is one whose stored errors would be above it
    run_well("sweep", "s.toml", "--table", table, "--kernel", "table", "-o", "t.h5", cwd=tmp_path)
    for row, tolerance in enumerate([4e-2, 2e-4, 1e-6]):
        found = results(tmp_path / "t.h5")
        worst = 0.0
        for kind in (FIELDS[:2], FIELDS[2:6]):
            of = lambda what: max(abs(found[f"probe_{k}_{f}_{what}"][row]) for k in (1, 2) for f in kind)
            worst = max(worst, of("error") / of("peak"))
        assert (worst <= tolerance) == bool(rows["probe_table"][row]), (tolerance, worst)


def test_estimates_of_looked_up_fields_are_those_of_their_errors(table):
    """Whole traces and peaks at random places beside computed ones: the median of estimate over error of traces, and none below."""
    loader = importlib.machinery.SourceFileLoader("measure_lookups", str(ROOT / "scripts" / "measure-lookups"))
    lookups = importlib.util.module_from_spec(importlib.util.spec_from_loader("measure_lookups", loader))
    loader.exec_module(lookups)
    found, refused = lookups.measure(PROGRAM, table, range(5), seed=7)
    rows = np.array(sum((own for (kind, _), own in found.items() if "peak" not in kind), []))
    assert not refused and len(rows) > 40
    # 70 over the sixteen impacts of seed 11, 61 of growing contacts and 78 of fixed discs
    assert np.median(rows[:, 1] / rows[:, 0]) < 100.0
    assert not any(map(lookups.is_below, sum(found.values(), [])))
