"""Runs the hertzlamb program; scripts/test names it in the environment variable HERTZLAMB."""

import json
import os
import subprocess
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("HERTZLAMB", str(ROOT / "target" / "debug" / "hertzlamb"))


def run(*arguments, cwd=None):
    """One call of the program: exit code, standard output and standard error."""
    return subprocess.run(
        [PROGRAM, *map(str, arguments)], cwd=cwd, capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=600
    )


def run_well(*arguments, cwd=None):
    """A call that has to succeed, and its JSON object."""
    done = run(*arguments, "--json", cwd=cwd)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@dataclass
class Impact:
    summary: dict
    path: Path


@pytest.fixture(scope="session")
def paper_scene():
    return ROOT / "scenes" / "copper-on-steel.toml"


@pytest.fixture(scope="session")
def table(tmp_path_factory):
    path = tmp_path_factory.mktemp("table") / "kernels.h5"
    done = run("tabulate", "--grid", "demo", "-o", path)
    assert done.returncode == 0, done.stderr
    return path


@pytest.fixture(scope="session")
def impact(tmp_path_factory, table, paper_scene):
    path = tmp_path_factory.mktemp("impact") / "impact.h5"
    return Impact(run_well("impact", paper_scene, "--kernel", "table", "--table", table, "-o", path), path)
