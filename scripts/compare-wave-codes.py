"""Two codes compared with `hertzlamb lamb` by `hertzlamb compare`.

    scripts/compare-wave-codes PROGRAM

- scikit-fem: axisymmetric finite elements, the block of `docs/cases/wave-code.md` that is not run there, on two meshes.
- pygrt-kit: its functions lamb1 (surface) and lamb2 (below it), the closed form of the step response.

The exit code is 1 if one of them is outside its tolerance: 30 % on the coarse mesh, 2.5 % on the fine one, 1e-6 for the closed forms.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
CASE = ROOT / "scenes/lamb-point.toml"
CHAPTER = ROOT / "docs/cases/wave-code.md"


def elements(folder, size):
    """Runs the chapter's model with another size of its elements; writes fem.csv."""
    blocks = re.findall(r"^```python\n(# not run: .*?)^```$", CHAPTER.read_text(), re.MULTILINE | re.DOTALL)
    code, count = re.subn(r"^size, step = .*$", f"size, step = {size}, {size / 20e3}", blocks[0], flags=re.MULTILINE)
    assert count == 1
    (folder / "fem.py").write_text(code)
    subprocess.run([sys.executable, "fem.py"], cwd=folder, check=True)


def closed_forms(folder):
    """Writes steps.toml and steps.csv: a step of 1 N on rock with mu = 8 GPa."""
    from pygrt.utils import lamb1, lamb2

    nu, c2, mu = 0.25, 2000.0, 8e9
    time = np.arange(0, 0.6, 1e-3)
    columns, receivers = [("time_s", time)], ""
    for name, r, z in [("surface", 300.0, 0.0), ("slant", 200.0, 300.0), ("shallow", 300.0, 30.0)]:
        distance = np.hypot(r, z)
        tbar = c2 * time / distance
        green = lamb1(nu=nu, tbar=tbar, azimuth=0.0) if z == 0 else lamb2(nu=nu, tbar=tbar, R=r, deprcv=z, azimuth=0.0)[0]
        columns += [(f"{name}_{c}_m", green[:, i, 2] / (np.pi**2 * distance * mu)) for i, c in [(0, "ur"), (2, "uz")]]
        receivers += f'[[receiver]]\nname = "{name}"\nr_m = {r}\nz_m = {z}\n'
    target = "[target]\n" + CASE.read_text().split("[target]\n")[1].split("[source]")[0]
    source = '[source]\nprofile = "point"\ntime_function = "step"\n'
    (folder / "steps.toml").write_text(f"{target}{source}{receivers}[output]\nend_s = 0.5995\nstep_s = 1e-3\n")
    names = ",".join(name for name, _ in columns)
    np.savetxt(folder / "steps.csv", np.c_[*(values for _, values in columns)], delimiter=",", header=names, comments="")


def compared(program, folder, case, theirs, tolerance):
    """Exit code of the comparison; prints its table."""
    subprocess.run([program, "lamb", "-q", case, "-o", "exact.csv", "--force"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    return subprocess.run([program, "compare", "-q", theirs, "exact.csv", "--tolerance", tolerance], cwd=folder).returncode


def main():
    program, codes = str(Path(sys.argv[1]).resolve()), []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for size, tolerance in [(40.0, "0.3"), (20.0, "0.025")]:
            print(f"scikit-fem, elements of {size:g} m", flush=True)
            elements(folder, size)
            codes.append(compared(program, folder, CASE, "fem.csv", tolerance))
        print("pygrt-kit, lamb1 and lamb2", flush=True)
        closed_forms(folder)
        codes.append(compared(program, folder, "steps.toml", "steps.csv", "1e-6"))
    return int(any(codes))


if __name__ == "__main__":
    sys.exit(main())
