"""Force records that jump: seen from outside, against superposition, steeper rises, static limits and a table."""

import json

import h5py
import numpy as np
from conftest import run, run_well

SCENE = """
[target]
material = "{material}"
[force]
file = "f.csv"
{force}
[contact]
disc_radius_m = 0.002
{contact}
[output]
duration_s = 2.4e-5
{output}
[[probe]]
r_m = 0
z_m = 0
[[probe]]
r_m = 0.0013
z_m = 0.0021
[[probe]]
r_m = 0.009
z_m = 0.004
"""
FIELDS = ["displacement_r", "displacement_z", "stress_rr", "stress_tt", "stress_zz", "stress_rz"]


def fields(folder, rows, *arguments, force="", contact="step_s = 2e-8", output="", material="aluminium"):
    """Times, force, fields by name, their errors, and the report."""
    (folder / "f.csv").write_text("time_s,force_n\n" + "".join(f"{t!r},{p!r}\n" for t, p in rows))
    (folder / "s.toml").write_text(SCENE.format(force=force, contact=contact, output=output, material=material))
    report = run_well("impact", folder / "s.toml", "-o", folder / "s.h5", "--force", *arguments)
    with h5py.File(folder / "s.h5") as file:
        probes = file["probes"]
        names = [name for name in probes if f"{name}_error" in probes]
        return {
            "time": file["time"][:],
            "force": file["force"][:],
            "fields": {name: probes[name][:] for name in names},
            "errors": {name: probes[f"{name}_error"][:] for name in names},
            "arrival": probes["arrival"][:],
            "report": report,
        }


def off(a, b):
    """Largest differences over the sums of the estimates, of fields that are not zero."""
    worst = 0.0
    for name in FIELDS:
        for probe in range(3):
            x, y = a["fields"][name][probe], b["fields"][name][probe]
            if np.abs(x).max() > 0:
                errors = a["errors"][name][probe] + b["errors"][name][probe]
                worst = max(worst, np.abs(x - y).max() / errors)
    return worst


def test_a_rectangle_is_a_step_less_the_same_step_later(tmp_path):
    step = fields(tmp_path, [(0, 30.0), (5e-5, 30.0)])
    n = 321
    later = step["time"][n]
    rectangle = fields(tmp_path, [(0, 30.0), (float(later), 30.0)])
    assert np.array_equal(step["time"], rectangle["time"])
    for name in FIELDS:
        shifted = np.zeros_like(step["fields"][name])
        shifted[:, n:] = step["fields"][name][:, :-n]
        difference = step["fields"][name] - shifted - rectangle["fields"][name]
        for probe in range(3):
            size = np.abs(step["fields"][name][probe]).max()
            assert np.abs(difference[probe]).max() <= 1e-4 * size + 1e-30, (name, probe)
    # the force at the jump is that after it
    assert rectangle["force"][0] == 30 and rectangle["force"][n] == 0 and rectangle["force"][n - 1] == 30


def test_the_surface_has_the_pressure_of_the_load_at_once(tmp_path):
    found = fields(tmp_path, [(0, 0), (3.7e-6, 0.0), (3.7e-6, 45.0), (3e-5, 45.0)])
    stress = found["fields"]["stress_zz"][0]
    before = found["time"] < 3.7e-6
    assert not stress[before].any()
    assert np.allclose(stress[~before], -1.5 * 45 / (np.pi * 0.002**2), rtol=1e-3)


def test_two_rows_of_one_time_are_the_limit_of_a_rise(tmp_path):
    jump = fields(tmp_path, [(0, 12.0), (4e-6, 80.0), (4e-6, 20.0), (9e-6, 0.0)])
    before = np.inf
    for rise in (1e-7, 1e-8, 1e-9):
        rows = [(0, 0.0), (rise, 12.0), (4e-6, 80.0), (4e-6 + rise, 20.0), (9e-6, 0.0)]
        found = fields(tmp_path, rows)
        u, v = (x["fields"]["displacement_z"] for x in (jump, found))
        gap = (np.abs(u - v).max(axis=1) / np.abs(u).max(axis=1)).max()
        assert gap < 0.3 * before
        before = gap
    assert before < 2e-3


def test_looked_up_jumps_are_within_their_estimates(tmp_path, table):
    rows = [(0, 12.0), (4e-6, 80.0), (4e-6, 20.0), (9e-6, 5.0)]
    computed = fields(tmp_path, rows, "--kernel", "direct", material="steel")
    looked_up = fields(tmp_path, rows, "--kernel", "table", "--table", table, material="steel")
    assert looked_up["report"]["kernel"] == "table"
    # the table's cells are not the steps asked for: compared at equal times
    times, own = looked_up["time"], computed["time"]
    common = np.isin(np.round(times * 1e12), np.round(own * 1e12))
    assert common.sum() > 100
    places = np.searchsorted(own, times[common] - 1e-13)
    picked = {**computed, "fields": {name: computed["fields"][name][:, places] for name in FIELDS}}
    seen = {**looked_up, "fields": {name: looked_up["fields"][name][:, common] for name in FIELDS}}
    assert off(picked, seen) < 1


def test_velocities_under_a_jump_say_what_they_are(tmp_path):
    found = fields(tmp_path, [(0, 30.0), (5e-5, 30.0)], output='quantities = ["velocity_z"]')
    assert any("velocities and accelerations are means" in told for told in found["report"]["warnings"])
    # displacements half a step before and after
    finer = fields(tmp_path, [(0, 30.0), (5e-5, 30.0)], contact="step_s = 1e-8")
    step, v = found["time"][1], found["fields"]["velocity_z"]
    u = finer["fields"]["displacement_z"]
    assert np.isclose(finer["time"][2], step, rtol=1e-12)
    for probe in range(3):
        mean = (u[probe, 3::2] - u[probe, 1:-2:2])[: v.shape[1] - 1] / step
        assert np.abs(v[probe, 1 : mean.size + 1] - mean).max() <= found["errors"]["velocity_z"][probe]


def test_arrivals_and_duration_count_from_the_onset(tmp_path):
    rng = np.random.default_rng(5)
    time = np.arange(0, 2.4e-5, 4e-8)
    pulse = np.where((time > 8e-6) & (time < 1.4e-5), 90 * np.sin(np.pi * (time - 8e-6) / 6e-6) ** 2, 0)
    rows = list(zip(time.tolist(), (pulse + rng.normal(0, 0.2, time.size)).tolist()))
    without = fields(tmp_path, rows)
    told = [told for told in without["report"]["warnings"] if "force.onset_s = " in told]
    assert len(told) == 1
    proposed = float(told[0].split("force.onset_s = ")[1].split()[0])
    assert 7.5e-6 < proposed < 9.5e-6
    found = fields(tmp_path, rows, force="onset_s = 8e-6\nbaseline_s = 6e-6")
    assert not any("onset_s" in told for told in found["report"]["warnings"])
    arrives = np.isfinite(found["arrival"])
    assert np.allclose(found["arrival"][arrives] - without["arrival"][arrives], 8e-6)
    assert 5e-6 < found["report"]["contact_time_s"] < 6.3e-6 and without["report"]["contact_time_s"] > 2e-5


def test_a_record_that_counts_pressing_as_negative_is_told_of_the_sign(tmp_path):
    rows = [(0, 0.0), (4e-6, -80.0), (9e-6, 0.0)]
    assert any("force.sign = -1" in told for told in fields(tmp_path, rows)["report"]["warnings"])
    pressed = fields(tmp_path, rows, force="sign = -1")["report"]["warnings"]
    assert not any("sign" in told for told in pressed)


def test_a_results_file_without_its_checksums_is_no_record(tmp_path, impact):
    whole = impact.path.read_bytes()
    scene = '[target]\nmaterial = "steel"\n[contact]\ndisc_radius_m = 0.004\n[force]\nfile = "r.h5"\n'
    (tmp_path / "r.toml").write_text(scene)
    for kept, good in [(whole, True), (whole + b"x", False)]:
        (tmp_path / "r.h5").write_bytes(kept)
        done = run("impact", tmp_path / "r.toml", "-o", tmp_path / "o.h5", "--force")
        assert (done.returncode == 0) == good, done.stderr
    assert "checksum trailer" in done.stderr


def test_errors_of_record_keys_have_key_value_and_range(tmp_path):
    (tmp_path / "f.csv").write_text("time_s,force_n\n0,0\n1e-6,5\n3e-6,0\n")
    for key, value in [("baseline_s", 1.0), ("start_s", 1.0), ("end_s", -1.0), ("low_pass_hz", 1.0), ("onset_s", 9.0)]:
        (tmp_path / "s.toml").write_text(SCENE.format(force=f"{key} = {value}", contact="", output="", material="steel"))
        done = run("impact", tmp_path / "s.toml", "--json")
        error = json.loads(done.stdout or done.stderr)["error"]
        assert done.returncode == 2 and error["key"] == f"force.{key}" and error["value"] == value
        assert len(error["limits"]) == 2 and "is outside" in error["message"]
