"""Times calls of the Python package and of the library: called by scripts/time-python."""

import statistics
import subprocess
import sys
import tempfile
import time
import warnings
from pathlib import Path

import numpy as np

import hertzlamb as hl

ROUNDS = 7
SCENE = {
    "target": {"material": "granite"},
    "striker": {"material": "bearing-steel", "mass_kg": 1.105e-4, "tip_radius_m": 1.5e-3, "velocity_m_s": 0.2},
}


def median(count, call):
    """Seconds of a call: the median of so many after a first one."""
    call()
    times = []
    for _ in range(count):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def main(calls, program):
    warnings.simplefilter("ignore")
    table = hl.Table.demo()
    share = np.arange(10_000) / 10_000
    velocity = np.linspace(0.1, 10.0, 200_000)
    works = {
        "impact": (100, 1.5, lambda: hl.impact(SCENE).peak_force_n),
        "trace": (5, 1.1, lambda: table.trace(0.3, 6.0 * share, 6.0 * (1.0 - share)).stress_zz),
        "sweep": (3, 1.1, lambda: hl.collide(SCENE, velocity_m_s=velocity).restitution),
    }
    late = False
    for name, (count, limit, call) in works.items():
        here, there = [], []
        for _ in range(ROUNDS):
            done = subprocess.run([calls, table.path, name], capture_output=True, text=True, check=True)
            there.append(float(done.stdout))
            here.append(median(count, call))
        ratios = [a / b for a, b in zip(here, there)]
        ratio = statistics.median(ratios)
        late |= ratio > limit
        print(
            f"{name:8} library {1e3 * statistics.median(there):9.3f} ms, Python {1e3 * statistics.median(here):9.3f} ms, "
            f"ratio {ratio:.3f} ({min(ratios):.3f} to {max(ratios):.3f}), promised {limit}"
        )
    with tempfile.TemporaryDirectory() as folder:
        scene = Path(folder, "scene.toml")
        for section, keys in SCENE.items():
            lines = [f"{key} = {value!r}".replace("'", '"') for key, value in keys.items()]
            with scene.open("a") as file:
                print(f"[{section}]", *lines, sep="\n", file=file)
        command = [program, "impact", scene, "--json"]
        process = median(21, lambda: subprocess.run(command, check=True, capture_output=True))
        print(f"{'command':8} one process of the same impact {1e3 * process:9.3f} ms")
    million = np.linspace(0.1, 10.0, 1_000_000)
    for plasticity in ["none", "thornton"]:
        scene = SCENE | {"contact": {"model": "area_dashpot", "plasticity": plasticity, "yield_pressure_pa": 2e9}}
        seconds = median(1, lambda scene=scene: hl.collide(scene, velocity_m_s=million))
        print(f"{'collide':8} a million impacts from numpy, plasticity {plasticity}: {seconds:9.3f} s")
    return 1 if late else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
