"""What documents say of scripts: that these are there, take those options, and build what exists."""

import importlib.machinery
import importlib.util
import json
import re
import subprocess
import sys

import pytest
from conftest import ROOT

DOCUMENTS = [path for folder in (".", "docs", "docs/cases", "data-schema", "scenes", "tests/reference") for path in (ROOT / folder).glob("*.md")]
DOCUMENTS = [path for path in DOCUMENTS + list(ROOT.glob("crates/*/README.md")) if path.name != "CHANGELOG.md"]
TEXTS = {path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8") for path in DOCUMENTS}
SCRIPTS = sorted(path for path in (ROOT / "scripts").iterdir() if path.is_file())
SOURCES = {path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8") for path in SCRIPTS}
TOLD = re.compile(r"scripts/([a-z_-]+(?:\.py)?)((?: +(?:--?[a-z][a-z-]*|[A-Z0-9.]+))*)")


def options(name):
    """What documents give a script."""
    found = set()
    for text in TEXTS.values():
        for script, words in TOLD.findall(text):
            if script == name:
                found |= {word for word in words.split() if word.startswith("--")}
    return found


def test_scripts_that_are_named_are_there():
    for name, text in {**TEXTS, **SOURCES}.items():
        for script, _ in TOLD.findall(text):
            assert (ROOT / "scripts" / script).exists(), f"{name} names scripts/{script}"


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda path: path.name)
def test_a_script_says_what_it_takes(script):
    text = SOURCES[f"scripts/{script.name}"]
    for packages in re.findall(r"install_wheels ([a-z-]+)", text):
        assert (ROOT / "scripts" / "requirements" / f"{packages}.txt").exists(), packages
    if not text.startswith("#!"):
        compile(text, script.name, "exec")
        return
    command = [sys.executable if "python3" in text.splitlines()[0] else "bash", script]
    help = subprocess.run([*command, "--help"], capture_output=True, text=True, timeout=60)
    assert help.returncode == 0 and len(help.stdout) > 60, help.stderr
    assert options(script.name) <= set(re.findall(r"--[a-z-]+", help.stdout + text)), script.name
    if command[0] == "bash":
        subprocess.run(["bash", "-n", script], check=True)


def test_targets_of_cargo_exist():
    metadata = subprocess.run(
        ["cargo", "metadata", "--format-version", "1", "--no-deps", "--offline"], cwd=ROOT, capture_output=True, check=True
    )
    packages = {
        package["name"]: {(kind, target["name"]) for target in package["targets"] for kind in target["kind"]}
        for package in json.loads(metadata.stdout)["packages"]
    }
    everywhere = set().union(*packages.values())
    for name, text in {**TEXTS, **SOURCES}.items():
        for line in text.replace("\\\n", " ").splitlines():
            for package in re.findall(r"(?:--package|-p) (hertzlamb[a-z-]*)", line):
                assert package in packages, f"{name}: {package}"
            for kind, target in re.findall(r"--(example|bench|test) ([a-z_]+)", line):
                assert (kind, target) in everywhere, f"{name}: {kind} {target}"
            for target in re.findall(r"release/examples/([a-z_]+)", line):
                assert ("example", target) in everywhere, f"{name}: {target}"


def test_mutations_are_of_the_source_as_it_is():
    loader = importlib.machinery.SourceFileLoader("check_mutations", str(ROOT / "scripts" / "check-mutations"))
    script = importlib.util.module_from_spec(importlib.util.spec_from_loader("check_mutations", loader))
    loader.exec_module(script)
    for crate, _, _, file, sound, _ in script.MUTATIONS:
        assert (ROOT / "crates" / crate / file).read_text(encoding="utf-8").count(sound) == 1, f"{crate} {file}: {sound}"
