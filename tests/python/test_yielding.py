"""Contacts that yield, seen from outside: warnings, counts and ends of the laws of flow, and rebounds that are inferred."""

import csv
import io
import subprocess
import time

import pytest

from conftest import PROGRAM, run, run_well

SCENE = """
[target]
material = "{target}"
[striker]
material = "bearing-steel"
shape = "ball"
diameter_m = {diameter}
velocity_m_s = {velocity}
{striker}
[contact]
plasticity = "{law}"
{contact}
"""


def scene(tmp_path, law, velocity, target="copper", diameter=0.003, striker="", contact="", name="scene.toml"):
    path = tmp_path / name
    path.write_text(SCENE.format(**locals()))
    return path


def test_jackson_green_far_beyond_its_range_is_warned_of(tmp_path):
    slow = run_well("impact", scene(tmp_path, "jackson_green", 0.5))
    trusted = 0.5 / slow["velocity_over_trusted"]
    below, above = (run("impact", scene(tmp_path, "jackson_green", part * trusted)) for part in (0.98, 1.02))
    assert "is valid" not in below.stderr
    assert 'plasticity = "jackson_green" is valid' in above.stderr and "velocity_m_s" in above.stderr
    assert run_well("impact", scene(tmp_path, "thornton", 1.02 * trusted)).get("velocity_over_trusted") is None


def sweep(tmp_path, key, values, law, velocity=1.0):
    base = scene(tmp_path, law, velocity).read_text()
    for section in ("target", "striker", "contact"):
        base = base.replace(f"[{section}]", f"[scene.{section}]")
    section, name = key.split(".")
    path = tmp_path / "sweep.toml"
    path.write_text(f"{base}\n[product.{section}]\n{name} = {values}\n")
    return path


def test_a_sweep_counts_the_rows_beyond_the_range(tmp_path):
    slow = run_well("impact", scene(tmp_path, "jackson_green", 0.5))
    velocities = [part * 0.5 / slow["velocity_over_trusted"] for part in (0.1, 0.5, 0.9, 1.1, 3.0, 8.0)]
    path = sweep(tmp_path, "striker.velocity_m_s", velocities, "jackson_green")
    done = run_well("sweep", path, "-o", tmp_path / "a.h5", "--csv", tmp_path / "a.csv")
    rows = list(csv.DictReader(io.StringIO((tmp_path / "a.csv").read_text())))
    over = [float(row["velocity_over_trusted"]) for row in rows]
    assert done["untrusted"] == sum(x > 1 for x in over) == 3
    # counted whatever is written
    only = run_well("sweep", path, "-o", tmp_path / "b.h5", "--columns", "restitution")
    assert only["untrusted"] == done["untrusted"]
    text = run("sweep", path, "-o", tmp_path / "c.h5").stdout
    assert f"{done['untrusted']} are too fast for" in text and "velocity_over_trusted above 1" in text


@pytest.mark.parametrize("strength", ["3e5", "2e3", "1e-12", "1e-200"])
def test_a_weak_body_ends_in_time_with_a_sentence(tmp_path, strength):
    path = sweep(tmp_path, "target.yield_strength_pa", f"[1e8, {strength}]", "jackson_green")
    start = time.monotonic()
    done = subprocess.run(
        [PROGRAM, "sweep", path, "-o", tmp_path / "weak.h5"], capture_output=True, text=True, timeout=60
    )
    assert "1 of 2 scenes failed" in done.stderr, done.stderr
    assert '"thornton"' in done.stderr or "check their units" in done.stderr
    weak = scene(tmp_path, "jackson_green", 1.0).read_text()
    weak = weak.replace("[striker]", f"yield_strength_pa = {strength}\n[striker]")
    (tmp_path / "weak.toml").write_text(weak)
    one = subprocess.run([PROGRAM, "impact", tmp_path / "weak.toml"], capture_output=True, text=True, timeout=60)
    assert one.returncode == 2 or one.returncode == 1, one.stdout
    assert one.stderr.splitlines()[-1].split(": ", 1)[1][:40] in done.stderr
    assert time.monotonic() - start < 60


def test_the_stated_onset_is_where_the_restitution_changes(tmp_path):
    onset = run_well("impact", scene(tmp_path, "jackson_green", 1.0, contact='model = "hertz"'))["yield_velocity_m_s"]
    for part, elastic in [(0.99, True), (1.1, False)]:
        found = run_well("impact", scene(tmp_path, "jackson_green", part * onset, contact='model = "hertz"'))
        assert (found["restitution"] == 1) == elastic, found["restitution"]
        assert (found["plastic_work_j"] == 0) == elastic


def test_an_elastic_rebound_has_no_upper_pressure(tmp_path):
    stiff = scene(tmp_path, "recovery", 0.04, "titanium", contact="yield_pressure_pa = 6e9")
    measured = run_well("impact", stiff)
    assert measured["velocity_over_yield"] < 1
    for name, key in [("restitution", "--restitution"), ("contact_time_s", "--contact-time"), ("peak_force_n", "--peak-force")]:
        found = run_well("infer", stiff, key, measured[name])
        assert found["elastic"] and found["high"] is None and found["low"] < 6e9, (name, found)
    told = run("infer", stiff, "--restitution", measured["restitution"]).stdout
    assert "no upper bound" in told and "elastic" in told and "MPa" in told


def test_what_is_told_of_a_measure_is_short_and_has_a_way_out(tmp_path):
    drop = scene(tmp_path, "thornton", 1.0)
    tiny = run("infer", drop, "--restitution", "3e-310")
    assert tiny.returncode == 2 and len(tiny.stderr) < 300 and "3e-310" in tiny.stderr
    slow = run("infer", drop, "--bounces", "412,230")
    assert slow.returncode == 2 and "0.412,0.23" in slow.stderr and "(0, 10] s" in slow.stderr


def test_plasticity_none_is_told_only_where_it_changes_the_rebound(tmp_path):
    """The velocity at which the restitution of both begins to differ is above the onset of yield."""
    told = []
    for velocity in [0.02, 0.05, 0.1, 1.0]:
        elastic = scene(tmp_path, "none", velocity)
        warned = [line for line in run("impact", elastic).stderr.splitlines() if "ignores" in line]
        pair = [run_well("impact", scene(tmp_path, law, velocity))["restitution"] for law in ("none", "thornton")]
        assert bool(warned) == (abs(pair[0] - pair[1]) > 1e-3), (velocity, pair, warned)
        told += warned
    assert told


def test_a_step_too_fine_for_the_output_is_refused_before_the_contact(tmp_path):
    path = tmp_path / "far.toml"
    text = scene(tmp_path, "none", 1.0, "steel", contact='model = "growing"\nstep_s = 3e-10').read_text()
    path.write_text(text + "\n[[probe]]\nr_m = 9.0\nz_m = 0.0\n")
    start = time.monotonic()
    done = run("impact", path)
    assert done.returncode == 2 and "larger step_s" in done.stderr, done.stderr
    assert time.monotonic() - start < 10


def test_the_head_of_an_export_says_how_far_the_law_is_trusted(tmp_path):
    slow = run_well("impact", scene(tmp_path, "jackson_green", 0.5))
    trusted = 0.5 / slow["velocity_over_trusted"]
    table = tmp_path / "table.csv"
    assert run("export", "table", scene(tmp_path, "jackson_green", 1.3 * trusted), "-o", table).returncode == 0
    head = table.read_text()
    assert "valid up to" in head and "is valid: restitution" in head
