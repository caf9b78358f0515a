"""What documents say of scripts: that these are there, take those options, and build what exists."""

import importlib.machinery
import importlib.util
import json
import re
import subprocess
import sys

import pytest
from conftest import ROOT

# scripts import each other
sys.path.insert(0, str(ROOT / "scripts"))

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


def loaded(name):
    """A script as a module."""
    loader = importlib.machinery.SourceFileLoader(name.replace("-", "_").removesuffix(".py"), str(ROOT / "scripts" / name))
    script = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(script)
    return script


def test_mutations_are_of_the_source_as_it_is():
    script = loaded("check-mutations")
    for crate, _, _, file, sound, _ in script.MUTATIONS:
        assert (ROOT / "crates" / crate / file).read_text(encoding="utf-8").count(sound) == 1, f"{crate} {file}: {sound}"


def crate(folder, **files):
    """A crate with these files in `src`; two underscores stand for a folder."""
    for name, text in files.items():
        path = folder / "crates" / "made" / "src" / (name.replace("__", "/") + ".rs")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return folder / "crates" / "made"


def test_modules_of_a_crate_are_in_layers(tmp_path):
    faults = loaded("check-structure.py").module_faults
    below = "pub struct Length;\n"
    above = "use crate::below::Length;\npub use crate::below::Length as Passed;\nfn of(_: Length) {}\n"
    made = crate(tmp_path, lib="mod below;\nmod above;\npub use above::Passed;\n", below=below, above=above)
    assert list(faults(made)) == []
    # comments, texts and tests are no uses
    innocent = '// crate::above::of\nconst A: &str = "crate::above::of";\n#[cfg(test)]\nmod tests {\n    use crate::above::of;\n}\n'
    crate(tmp_path, below=below + innocent)
    assert list(faults(made)) == []
    # a path inside an expression is one, from wherever it is seen
    for call in ("crate::above::of(Length)", "super::above::of(Length)", "use crate::{above::{of}}; of(Length)"):
        crate(tmp_path, below=below + f"fn knot() {{ {call} }}\n")
        found = list(faults(made))
        assert any("a circle of files" in fault for fault in found), call
        assert any("`below` uses above, which is not above it" in fault for fault in found), call
    # so is a name that the root passes on
    crate(tmp_path, above="pub struct Passed;\n", below="use crate::Passed;\n")
    assert [fault for fault in faults(made) if "`below` uses above" in fault]
    # without a knot the order of the list decides
    crate(tmp_path, lib="mod above;\nmod below;\n", below=below, above=above)
    assert [fault for fault in faults(made) if "`above` uses below" in fault]
    # files within a module make no circle either
    parts = {"above__mod": "mod one;\nmod two;\n", "above__one": "fn a() { super::two::b() }\n", "above__two": "use super::one::a;\n"}
    (made / "src" / "above.rs").unlink()
    crate(tmp_path, lib="mod below;\nmod above;\n", below=below, **parts)
    assert [fault for fault in faults(made) if "a circle of files" in fault and "one.rs" in fault]


def test_every_crate_is_checked_for_layers():
    assert set(loaded("check-structure.py").NOT_YET) <= {"contact", "impact"}
