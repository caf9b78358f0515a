"""What a sweep refuses, keeps and says: numbers out of range, failed rows, other columns, standard input and output."""

import os
import signal
import subprocess
import time

import h5py
import numpy as np
import pytest
from conftest import PROGRAM, run, run_well

SCENE = """
[scene.target]
material = "granite"
[scene.striker]
shape = "ball"
material = "alumina-99.5"
diameter_m = 0.006
velocity_m_s = 0.7
[scene.contact]
{contact}
"""
WAVE = 'model = "wave"\nstatic_share = "dynamic"'


def write(folder, axes, contact=""):
    (folder / "s.toml").write_text(SCENE.format(contact=contact) + axes)


@pytest.mark.parametrize("section", ["product", "list"])
@pytest.mark.parametrize(("key", "values", "wrong"), [("diameter_m", "[2e-3, -3e-3]", "-0.003"), ("density_kg_m3", "[0.0, 8e3]", "0")])
def test_a_number_out_of_range_is_refused_before_the_first_row(tmp_path, section, key, values, wrong):
    write(tmp_path, f"[{section}.striker]\n{key} = {values}\n")
    done = run("sweep", "s.toml", "-o", "s.h5", cwd=tmp_path)
    assert done.returncode == 2
    assert f"striker.{key} = {wrong} is outside (0, inf)" in done.stderr
    assert os.listdir(tmp_path) == ["s.toml"]


def test_a_draw_out_of_range_stays_a_failed_row(tmp_path):
    draw = '[random]\nsamples = 40\n[random.striker]\nvelocity_m_s = { distribution = "normal", mean = 0.1, deviation = 0.2 }\n'
    write(tmp_path, draw)
    done = run_well("sweep", "s.toml", "-o", "s.h5", cwd=tmp_path)
    assert 0 < done["failed"] < 40


def test_failed_rows_and_the_exit_code(tmp_path):
    # on a disc so small the coupling has no solution
    write(tmp_path, "[list.contact]\ndisc_radius_m = [3e-8, 3e-3, 5e-8]\n", WAVE)
    some = run("sweep", "s.toml", "-o", "some.h5", cwd=tmp_path)
    assert some.returncode == 0 and "warning: 2 of 3 scenes failed, the first in row 0" in some.stderr
    asked = run("sweep", "s.toml", "-o", "asked.h5", "--fail-if-failed", cwd=tmp_path)
    assert asked.returncode == 1 and "error: 2 of 3 scenes failed" in asked.stderr
    assert (tmp_path / "some.h5").read_bytes() == (tmp_path / "asked.h5").read_bytes()
    write(tmp_path, "[list.contact]\ndisc_radius_m = [3e-8, 5e-8]\n", WAVE)
    for asked in (["-o", "all.h5"], ["--csv", "-"]):
        every = run("-q", "sweep", "s.toml", *asked, cwd=tmp_path)
        assert every.returncode == 1 and "error: all 2 scenes failed, the first in row 0" in every.stderr
    with h5py.File(tmp_path / "all.h5") as file:
        assert list(file["results/failure"]) == [0, 1]


def test_rows_with_other_columns_are_kept_until_they_may_go(tmp_path):
    write(tmp_path, "[product.striker]\nvelocity_m_s = { from = 0.1, to = 9.0, count = 700000 }\n", 'model = "growing"')
    columns = lambda names: [PROGRAM, "sweep", "s.toml", "-o", "s.h5", "--columns", names]
    part = tmp_path / "s.h5.part"
    running = subprocess.Popen(columns("loss"), cwd=tmp_path, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while running.poll() is None and not (part.exists() and part.stat().st_size > 2000):
        time.sleep(0.01)
    running.send_signal(signal.SIGTERM)
    assert running.wait() in (143, -signal.SIGTERM)
    before = part.read_bytes()
    other = subprocess.run(columns("loss,impulse_n_s"), cwd=tmp_path, capture_output=True, text=True)
    assert other.returncode == 2 and "pass --force to drop it" in other.stderr
    assert part.read_bytes() == before
    # fewer results than are kept, or the same: it goes on
    done = run_well("sweep", "s.toml", "-o", "s.h5", "--columns", "loss", cwd=tmp_path)
    assert done["resumed"] > 0 and not part.exists()


def test_standard_input_and_output(tmp_path):
    axes = '[product.target]\nmaterial = ["granite", "pmma"]\n[product.striker]\nvelocity_m_s = [0.3, 0.6, 1.2]\n'
    write(tmp_path, axes)
    run_well("sweep", "s.toml", "-o", "s.h5", "--csv", "s.csv", cwd=tmp_path)
    text = (tmp_path / "s.toml").read_text()
    streamed = subprocess.run([PROGRAM, "sweep", "-", "--csv", "-"], input=text, cwd=tmp_path, capture_output=True, text=True)
    assert streamed.returncode == 0
    assert streamed.stdout == (tmp_path / "s.csv").read_text()
    some = run("sweep", "s.toml", "--csv", "-", "--rows", "2:5", cwd=tmp_path)
    assert some.stdout.splitlines()[1:] == streamed.stdout.splitlines()[3:6]
    into = subprocess.run([PROGRAM, "sweep", "-", "-o", "i.h5"], input=text, cwd=tmp_path, capture_output=True, text=True)
    assert into.returncode == 0 and (tmp_path / "i.h5").read_bytes() == (tmp_path / "s.h5").read_bytes()
    broken = subprocess.run([PROGRAM, "sweep", "-", "--csv", "-"], input=text + "[lists]\n", cwd=tmp_path, capture_output=True, text=True)
    assert broken.returncode == 2 and "standard input: unknown key lists; did you mean list?" in broken.stderr
    assert run("sweep", "s.toml", "--csv", "x.csv", cwd=tmp_path).returncode == 2


def test_a_short_sweep_writes_no_lines_of_progress(tmp_path):
    write(tmp_path, "[product.striker]\nvelocity_m_s = { from = 0.1, to = 9.0, count = 30000 }\n")
    done = run("sweep", "s.toml", "-o", "s.h5", cwd=tmp_path)
    assert done.returncode == 0 and done.stderr == ""


def test_logarithmic_ranges_hit_their_decades(tmp_path):
    write(tmp_path, '[product.striker]\nvelocity_m_s = { from = 0.007, to = 7, count = 31, spacing = "log" }\n')
    run_well("sweep", "s.toml", "-o", "s.h5", cwd=tmp_path)
    with h5py.File(tmp_path / "s.h5") as file:
        found = file["axes/striker.velocity_m_s"][()]
    assert list(found[::10]) == [0.007, 0.07, 0.7, 7.0]
    np.testing.assert_allclose(found, np.geomspace(0.007, 7, 31), rtol=1e-14)


def test_the_plan_of_a_table(tmp_path):
    grid = "poisson_ratios = [0.2, 0.4]\ncell_width = 0.25\ntolerance = 1e-6\npulse_lengths = [10.0]\n"
    grid += "[r]\nmax = 2.0\nspacing = 0.25\n[z]\nmax = 2.0\nspacing = 0.25\n"
    (tmp_path / "g.toml").write_text(grid)
    plan = run_well("tabulate", "--grid", "g.toml", "--plan", cwd=tmp_path)
    assert os.listdir(tmp_path) == ["g.toml"]
    built = run_well("tabulate", "--grid", "g.toml", "-o", "t.h5", cwd=tmp_path)
    assert 0.2 * plan["most_bytes"] < built["bytes"] < plan["most_bytes"] < plan["memory_bytes"]
    # the places at which errors are measured come to the nodes
    assert 1.5 * built["points"] < plan["points"] < 3 * built["points"]
    outside = run("tabulate", "--nu", "0.6", "--plan", cwd=tmp_path)
    assert outside.returncode == 2 and "'0.6' for '--nu" in outside.stderr and "[-0.95, 0.495]" in outside.stderr


SUGGESTED = [
    ('material = "granite"', "E = 5e10", "unknown key target.E; did you mean youngs_modulus_pa?"),
    ('material = "granite"', "poisson = 0.2", "unknown key target.poisson; did you mean poisson_ratio?"),
    ("velocity_m_s = 0.7", "velocity = 0.7", "unknown key striker.velocity; did you mean velocity_m_s?"),
    ("diameter_m = 0.006", "radius_m = 0.003", "unknown key striker.radius_m; did you mean diameter_m?"),
    ('shape = "ball"', 'shape = "sphere"', "did you mean ball?"),
    ('shape = "ball"', 'shape = "cylinder"', "did you mean rod?"),
    ('"alumina-99.5"', '"ruby"', "`hertzlamb materials` lists the names"),
    ("velocity_m_s = 0.7", "velocity_m_s = [0.7, 0.8]", "in [product] of a sweep file"),
    ("[contact]", "[probe]\nr_m = 0\nz_m = 1e-3\n[contact]", "write [[probe]] for [probe]"),
    ("[contact]", '[output]\nquantities = ["stress_rz"]\n[contact]', "always written: remove it"),
]


@pytest.mark.parametrize(("old", "new", "said"), SUGGESTED)
def test_what_is_meant_is_suggested(tmp_path, old, new, said):
    text = SCENE.format(contact="").replace("[scene.", "[")
    assert text.count(old) == 1
    (tmp_path / "s.toml").write_text(text.replace(old, new))
    done = run("impact", "s.toml", cwd=tmp_path)
    assert done.returncode == 2 and said in done.stderr, done.stderr


def test_an_output_of_text_is_another_option(tmp_path):
    write(tmp_path, "[product.striker]\nvelocity_m_s = [1.0]\n")
    for command in ("sweep", "impact"):
        done = run(command, "s.toml", "-o", "s.csv", cwd=tmp_path)
        assert done.returncode == 2
    assert "--csv OUT.csv writes text" in run("sweep", "s.toml", "-o", "s.csv", cwd=tmp_path).stderr
