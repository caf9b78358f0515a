"""Facts of a release that stand in several files: versions, licences, and the licence texts of third-party work."""

import json
import re
import subprocess

import pytest
from conftest import ROOT

tomllib = pytest.importorskip("tomllib", reason="Python 3.11")

WORKSPACE = tomllib.loads((ROOT / "Cargo.toml").read_text())["workspace"]
PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
CITATION = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
THIRD_PARTY = (ROOT / "THIRD-PARTY.md").read_text(encoding="utf-8")


def metadata(*options):
    command = ["cargo", "metadata", "--format-version", "1", "--offline", "--locked", *options]
    return json.loads(subprocess.run(command, cwd=ROOT, capture_output=True, check=True).stdout)


def test_rust_version_is_one_number():
    least = WORKSPACE["package"]["rust-version"]
    number = tuple(map(int, least.split(".")))
    for package in metadata()["packages"]:
        needed = package["rust_version"]
        if package["source"] is None:
            assert needed == least, package["name"]
        elif needed:
            assert tuple(map(int, needed.split("."))) <= (*number, 0), f"{package['name']} needs Rust {needed}"
    for path in [*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md"), *ROOT.glob("crates/*/README.md"), *ROOT.glob(".github/**/*.yml")]:
        if path.name != "CHANGELOG.md":
            for named in re.findall(r"\bRust(?: toolchain)? (?:version )?(1\.\d+)", path.read_text(encoding="utf-8")):
                assert named == least, f"{path.relative_to(ROOT)} names Rust {named}"


def test_setup_rejects_an_older_rust(tmp_path):
    """The set-up compares the toolchain with the version in Cargo.toml, whatever that is."""
    major, minor = map(int, WORKSPACE["package"]["rust-version"].split("."))
    for have, accepted in ((f"{major}.{minor - 1}.0", False), (f"{major}.{minor}.0", True), (f"{major}.{minor + 11}.1-nightly", True)):
        for name in ("cargo", "rustc"):
            program = tmp_path / name
            program.write_text(f"#!/bin/sh\necho '{name} {have} (0 2026-01-01)'\n")
            program.chmod(0o755)
        script = f"PATH={tmp_path}:$PATH; . {ROOT}/scripts/setup; set_up_cargo"
        ended = subprocess.run(["bash", "-c", script], capture_output=True, text=True)
        assert (ended.returncode == 0) == accepted, ended.stderr
        assert accepted or f"{major}.{minor} or later is needed" in ended.stderr


def test_versions_and_licences_agree():
    package = WORKSPACE["package"]
    assert f"\nversion: {package['version']}\n" in CITATION
    assert all(f"  - {name}\n" in CITATION for name in package["license"].split(" OR "))
    assert PYPROJECT["license"] == package["license"]
    assert "version" in PYPROJECT["dynamic"]
    for name, dependency in WORKSPACE["dependencies"].items():
        if isinstance(dependency, dict) and "path" in dependency:
            assert dependency["version"] == package["version"], name


def test_every_licence_text_is_named_and_there():
    there = {path.name for path in (ROOT / "licences").glob("*.txt")}
    assert set(re.findall(r"\(licences/([^)]*)\)", THIRD_PARTY)) == there
    assert not set(PYPROJECT["license-files"]) - {"LICENSE-*", "THIRD-PARTY.md", "licences/*.txt"}


def test_licence_texts_are_those_of_the_crates_in_use():
    """Names and versions only: `scripts/licences --check` compares the texts."""
    command = ["cargo", "tree", "--offline", "--locked", "--workspace", "--edges", "normal", "--target", "all"]
    command += ["--features", "hertzlamb-cli/static,hertzlamb-cli/parquet", "--prefix", "none", "--format", "{p}"]
    lines = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.splitlines()
    used = {" v".join(line.split(" v")[:2]).split(" (")[0].replace(" v", " ") for line in lines if line and "(/" not in line}
    text = (ROOT / "licences" / "rust-crates.txt").read_text(encoding="utf-8")
    listed = set(re.findall(r"^  - (\S+ \S+)$", text, re.MULTILINE))
    assert used == listed, "run scripts/licences"
