"""The recipes of docs/cluster.md as they stand there, with shards killed, run twice at once and out of space.

Slurm itself is not needed: its script runs with the variables that Slurm sets.
"""

import json
import os
import re
import subprocess
import sys

import h5py
import numpy as np
import pytest
from conftest import PROGRAM, ROOT

SWEEP = """
[scene.target]
material = "steel"
[scene.striker]
material = "steel"
mass_kg = 4e-3
tip_radius_m = 5e-3
[scene.contact]
model = "radiation"
[product.target]
material = ["granite", "steel"]
[random]
samples = 120000
seed = 5
[random.striker]
velocity_m_s = { distribution = "normal", mean = 2.0, deviation = 0.7 }
"""

# Stands in for the program: the first run of shard 3 is killed, that of 5 meets another run, that of 7 has no space.
FAULTS = """#!/bin/sh
case "$*" in
*"--shard 3/8"*) fault=kill part=out/3.h5.part ;;
*"--shard 5/8"*) fault=twice ;;
*"--shard 7/8"*) fault=full ;;
*) exec "$PROGRAM" "$@" ;;
esac
mkdir "fault-$fault" 2>/dev/null || exec "$PROGRAM" "$@"
case $fault in
kill)
    "$PROGRAM" "$@" &
    while [ ! -s "$part" ]; do :; done
    kill -9 $!
    wait $!
    ;;
twice)
    "$PROGRAM" "$@" &
    "$PROGRAM" "$@"
    status=$?
    wait $!
    other=$?
    echo "$status $other" >codes-twice
    exit $status
    ;;
full) (ulimit -f 2000 && exec "$PROGRAM" "$@") ;;
esac
status=$?
echo $status >codes-$fault
exit $status
"""


def recipe(heading, language):
    """The first block of code under a heading."""
    text = (ROOT / "docs/cluster.md").read_text()
    section = text.split(f"\n## {heading}\n")[1].split("\n## ")[0]
    return re.search(rf"```{language}\n(.*?)```", section, re.DOTALL)[1]


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    folder = tmp_path_factory.mktemp("whole")
    (folder / "s.toml").write_text(SWEEP)
    subprocess.run([PROGRAM, "-q", "sweep", "s.toml", "-o", "whole.h5"], cwd=folder, check=True, capture_output=True)
    return folder / "whole.h5"


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "s.toml").write_text(SWEEP)
    (tmp_path / "bin").mkdir()
    program = tmp_path / "bin/hertzlamb"
    program.write_text(FAULTS)
    program.chmod(0o755)
    return tmp_path


def run(folder, *command, check=True, **variables):
    path = f"{folder / 'bin'}{os.pathsep}{os.environ['PATH']}"
    environment = {**os.environ, "PATH": path, "PROGRAM": str(PROGRAM), "HOME": str(folder), **variables}
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=300)
    assert not check or done.returncode == 0, done.stdout + done.stderr
    return done


def check_faults(folder):
    """Every fault came, with the exit code that engines see."""
    assert (folder / "codes-kill").read_text() == "137\n"
    assert (folder / "codes-full").read_text() == "75\n"
    codes = (folder / "codes-twice").read_text().split()
    assert sorted(codes) in (["0", "75"], ["0", "0"]), codes
    left = [path.name for path in (folder / "out").iterdir() if not re.fullmatch(r"\d\.h5", path.name)]
    assert not left


def test_slurm(folder, whole):
    (folder / "job.sh").write_text(recipe("Slurm", "sh"))

    def missing():
        done = run(folder, "hertzlamb", "sweep", "status", "out", "--sweep", "s.toml", "--shards", "8", "--missing")
        return done.stdout.strip()

    slurm = {"SLURM_CPUS_PER_TASK": "1"}
    codes = [
        run(folder, "sh", "job.sh", check=False, SLURM_ARRAY_TASK_ID=str(task), **slurm).returncode
        for task in range(1, 9)
    ]
    assert (codes[2], codes[6]) == (137, 75)
    assert missing() == "3,7"
    for task in missing().split(","):
        run(folder, "sh", "job.sh", SLURM_ARRAY_TASK_ID=task, **slurm)
    assert missing() == ""
    # requeued: nothing is left to do; and an offset for arrays that are too long
    run(folder, "sh", "job.sh", SLURM_ARRAY_TASK_ID="2", **slurm)
    done = run(folder, "sh", "job.sh", SLURM_ARRAY_TASK_ID="2", OFFSET="3", **slurm)
    assert "out/5.h5, nothing to do" in done.stdout
    check_faults(folder)
    run(folder, "hertzlamb", "sweep", "merge", "out", "-o", "all.h5")
    assert (folder / "all.h5").read_bytes() == whole.read_bytes()


def test_snakemake(folder, whole):
    pytest.importorskip("snakemake")
    (folder / "Snakefile").write_text(recipe("Snakemake", "python"))
    run(folder, sys.executable, "-m", "snakemake", "--cores", "2")
    check_faults(folder)
    assert (folder / "all.h5").read_bytes() == whole.read_bytes()
    again = run(folder, sys.executable, "-m", "snakemake", "--cores", "2")
    assert "Nothing to be done" in again.stderr


def test_dask(folder, whole):
    pytest.importorskip("distributed")
    (folder / "quantiles.py").write_text(recipe("dask", "python"))
    done = run(folder, sys.executable, "quantiles.py", KEEP="1")
    check_faults(folder)
    run(folder, "hertzlamb", "sweep", "merge", "out", "-o", "all.h5")
    assert (folder / "all.h5").read_bytes() == whole.read_bytes()
    with h5py.File(whole) as file:
        restitution = file["results/restitution"][()]
    restitution = restitution[np.isfinite(restitution)]
    lines = [[float(word) for word in line.split()] for line in done.stdout.splitlines()]
    assert [quantile for quantile, _ in lines] == [0.05, 0.5, 0.95]
    for quantile, value in lines:
        # bins are 1e-5 wide and named by their upper ends
        assert -1e-9 <= value - np.quantile(restitution, quantile) <= 1.001e-5


def test_a_plan_is_json(folder):
    done = run(folder, "hertzlamb", "sweep", "s.toml", "--plan", "--shards", "8", "--json")
    plan = json.loads(done.stdout)
    assert (plan["rows"], plan["shards"]) == (240_000, 8)
    assert plan["seconds_per_shard"] > 0.0


GRID = """
poisson_ratios = [0.3]
cell_width = 0.25
[r]
max = 5.0
spacing = 0.25
[z]
max = 5.0
spacing = 0.25
"""


def test_kernel_tables(tmp_path):
    """Shards killed, run twice at once and out of space; the merged table is that of one uninterrupted build."""
    (tmp_path / "grid.toml").write_text(GRID)
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin/hertzlamb").symlink_to(PROGRAM)
    text = (ROOT / "docs/cluster.md").read_text().split("## Kernel tables")[1]
    shard, merge = re.findall(r"```sh\n(.*?)```", text, re.DOTALL)[:2]
    variables = {"GRID": "grid.toml", "SOURCE_DATE_EPOCH": "1000000000"}

    def task(number, before=""):
        return ["sh", "-c", f"{before}SLURM_ARRAY_TASK_ID={number}\n{shard}"]

    def codes(*commands):
        path = f"{tmp_path / 'bin'}{os.pathsep}{os.environ['PATH']}"
        environment = {**os.environ, **variables, "PATH": path}
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        running = [subprocess.Popen(c, cwd=tmp_path, env=environment, **quiet) for c in commands]
        return sorted(process.wait(timeout=300) for process in running)

    run(tmp_path, "hertzlamb", "tabulate", "--grid", "grid.toml", "-o", "whole.h5", **variables)
    assert codes(task(1)) == [0]
    # killed as soon as it has begun, then given again
    kill = "(while [ ! -s shards/2.shard ]; do :; done; pkill -9 -f 'shards/2[.]shard$') & "
    assert codes(task(2, kill)) == [137]
    assert codes(task(2)) == [0]
    assert codes(task(3), task(3)) in ([0, 0], [0, 75])
    assert codes(task(4, "ulimit -f 8\n")) == [75]
    assert run(tmp_path, "sh", "-c", merge, check=False, **variables).returncode == 2
    assert codes(task(4)) == [0]
    # given again where everything is there
    before = (tmp_path / "shards/1.shard").read_bytes()
    assert codes(task(1)) == [0]
    assert (tmp_path / "shards/1.shard").read_bytes() == before
    run(tmp_path, "sh", "-c", merge, **variables)
    assert (tmp_path / "kernels.h5").read_bytes() == (tmp_path / "whole.h5").read_bytes()
