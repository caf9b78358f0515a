"""Examples run and are typed: the notebooks, the README's program, the docstrings; stubs are those of the module."""

import doctest
import importlib
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import matplotlib
import pytest

import hertzlamb as hl
from conftest import ROOT

matplotlib.use("Agg")
NOTEBOOKS = sorted((ROOT / "docs" / "notebooks").glob("*.ipynb"))
README = ROOT / "crates" / "python" / "README.md"
FRONT = ROOT / "README.md"

pytestmark = pytest.mark.filterwarnings("ignore")


@pytest.fixture(autouse=True)
def demo_table(table, tmp_path_factory, monkeypatch):
    """The demo table of the session under the name that `Table.demo` looks for."""
    cache = tmp_path_factory.getbasetemp() / "cache"
    cache.mkdir(exist_ok=True)
    place = cache / f"demo-{hl.__version__}.h5"
    if not place.exists():
        os.link(table, place)
    monkeypatch.setenv("HERTZLAMB_CACHE", str(cache))


def cells(notebook):
    """The code of a notebook's cells."""
    return ["".join(cell["source"]) for cell in json.loads(notebook.read_text())["cells"] if cell["cell_type"] == "code"]


def programs(text):
    return re.findall(r"```python\n(.*?)```", text, re.S)


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(notebook, tmp_path, monkeypatch):
    import matplotlib.pyplot as plt

    monkeypatch.chdir(tmp_path)
    names = {}
    for number, cell in enumerate(cells(notebook)):
        exec(compile(cell, f"{notebook.name}, cell {number}", "exec"), names)
    pictures = [plt.figure(number) for number in plt.get_fignums()]
    folder = os.environ.get("HERTZLAMB_PICTURES")
    for number, picture in enumerate(pictures):
        assert any(axes.has_data() for axes in picture.axes)
        if folder:
            picture.savefig(Path(folder, f"{notebook.stem}-{number}.png"), dpi=70)
    plt.close("all")
    assert pictures, "a notebook without a picture"


def test_pictures_show_what_is_asked():
    scene = {
        "target": {"material": "steel"},
        "striker": {"material": "copper", "shape": "ball", "diameter_m": 2e-3, "velocity_m_s": 1.0},
        "probe": [{"r_m": 0.004, "z_m": 0.0}],
        "output": {"quantities": ["velocity_z", "von_mises"]},
        "map": {"r_max_m": 0.006, "z_max_m": 0.006, "points": [5, 5], "frames": 3},
    }
    run = hl.impact(scene)
    (line,) = run.plot().get_lines()
    assert line.get_xdata()[-1] <= 1.1e6 * run.contact_time_s and line.get_ydata().max() == run.force.max()
    for quantity in ("stress_rr", "velocity_z", "von_mises"):
        (panel,) = run.plot_probes(quantity).axes
        shown = panel.get_lines()[0].get_ydata()
        expected = getattr(run.probes, quantity)[0]
        assert abs(shown @ expected / ((shown @ shown) * (expected @ expected)) ** 0.5 - 1.0) < 1e-12
    axes = run.plot_section(2, "von_mises")
    assert "von Mises" in axes.get_title("left") and axes.get_ylim()[1] == 0.0
    with pytest.raises(KeyError, match="not one of displacement_r"):
        run.plot_probes("speed")
    spec = {"scene": {k: scene[k] for k in ("target", "striker")}, "product": {"striker": {"velocity_m_s": [0.5, 1.0, 2.0]}}}
    out = hl.sweep(spec)
    (line,) = out.plot("loss").get_lines()
    assert list(line.get_ydata()) == list(out.loss)


def test_the_program_of_the_readme_runs(capsys):
    (program,) = programs(README.read_text())
    exec(compile(program, "README.md", "exec"), {})
    assert capsys.readouterr().out


def test_the_program_of_the_front_page_prints_what_stands_there(capsys):
    program, printed = re.search(r"```python\n(.*?)```\n\n```text\n(.*?)```", FRONT.read_text(), re.S).groups()
    exec(compile(program, "README.md", "exec"), {})
    assert capsys.readouterr().out == printed


@pytest.mark.parametrize(
    "module", ["hertzlamb", "hertzlamb.kernels", "hertzlamb._impact", "hertzlamb._sweep", "hertzlamb._table", "hertzlamb._materials"]
)
def test_docstrings_say_what_happens(module):
    found = doctest.testmod(importlib.import_module(module))
    assert found.failed == 0 and found.attempted > 0


def mypy(*arguments, cwd):
    done = subprocess.run([sys.executable, "-m", *arguments], cwd=cwd, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_package_and_examples_are_typed(tmp_path):
    for notebook in NOTEBOOKS:
        (tmp_path / f"{notebook.stem.replace('-', '_')}.py").write_text("\n".join(cells(notebook)))
    (tmp_path / "readme.py").write_text("\n".join(programs(README.read_text())))
    examples = sorted(tmp_path.glob("*.py"))
    assert len(examples) == len(NOTEBOOKS) + 1 > 5
    mypy("mypy", "--strict", "--config-file", ROOT / "pyproject.toml", ROOT / "python" / "hertzlamb", cwd=tmp_path)
    mypy("mypy", "--strict", "--config-file", ROOT / "pyproject.toml", *examples, cwd=tmp_path)


MISSPELT = """
import hertzlamb as hl

run = hl.impact("scene.toml")
print(run.peak_forc_n)
print(run.probes.displacment_z)
print(run.probes.error.velocity_q)
print(run.section.von_mise_peak)
print(run.energy.kinetik)
out = hl.collide("scene.toml", velocity_m_s=[1.0])
print(out.restitutoin)
print(hl.sweep("sweep.toml").los)
"""
RIGHT = """
run.peak_force_n + run.contacts
run.probes.von_mises + run.probes.stress_zz_peak_time + run.probes.time + run.probes.error.max_shear
run.section.strain_rz_error + run.section.time + run.energy.plastic
out.restitution + hl.sweep("sweep.toml", columns=["loss"]).loss
"""


def test_misspelt_attributes_are_errors_of_type_checkers(tmp_path):
    (tmp_path / "misspelt.py").write_text(MISSPELT + RIGHT)
    command = [sys.executable, "-m", "mypy", "--strict", "--config-file", ROOT / "pyproject.toml", "misspelt.py"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    wrong = [n for n, line in enumerate(MISSPELT.splitlines(), 1) if line.startswith("print")]
    found = [int(number) for number in re.findall(r"^misspelt.py:(\d+): error: .*has no attribute", done.stdout, re.M)]
    assert found == wrong and done.stdout.count("error:") == len(wrong), done.stdout


def test_the_stubs_are_those_of_the_module(tmp_path):
    mypy("mypy.stubtest", "hertzlamb._core", "--mypy-config-file", ROOT / "pyproject.toml", cwd=tmp_path)


def test_everything_is_documented():
    for name in hl.__all__:
        thing = getattr(hl, name)
        if name == "__version__":
            continue
        assert thing.__doc__ and len(thing.__doc__) > 20, name
        members = vars(thing).items() if isinstance(thing, type) and thing.__module__.startswith("hertzlamb") else ()
        for member, value in members:
            if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                assert value.__doc__, f"{name}.{member}"
    assert set(dir(hl)) == set(hl.__all__)
