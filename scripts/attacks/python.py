"""Hostile arguments to the Python package: expected is a value or an exception, never the end of the interpreter.

Each case runs in a separate interpreter with 3 GB of address space. If the package cannot be imported, the part reports this and
passes. ATTACK_PYTHON is the path of the interpreter; default: that of .venv.
"""

import os
import resource
import subprocess
import textwrap
import time

from common import ROOT, WORK, Tally, finish, fresh

PYTHON = os.environ.get("ATTACK_PYTHON", os.path.join(ROOT, ".venv/bin/python"))
MOST_S = 60.0
HEAD = """
import os, sys, warnings
warnings.simplefilter("ignore")
import numpy as np
import hertzlamb as hl
nan, inf = float("nan"), float("inf")
S = {"target": {"material": "granite"}, "striker": {"material": "steel", "shape": "ball", "diameter_m": 3e-3, "drop_height_m": 0.2}}
V = {"target": {"material": "granite"}, "striker": {"material": "steel", "shape": "ball", "diameter_m": 3e-3}}
P = {**S, "probe": [{"r_m": 5e-3, "z_m": 5e-3}]}
W = {"scene": V, "product": {"striker": {"velocity_m_s": [1.0, 2.0, 3.0]}}}
k, a = hl.kernels, np.linspace(0.1, 2.0, 6)
"""
ODD = ("nan", "inf", "-1.0", "1e300", "'x'", "None", "1j", "[[]]", "np.zeros(0)", "object()", "10**400", "True", "b'x'", "{}")
CASES = {
    "numbers": [f"{call.format(odd)}" for odd in ODD for call in ("k.step(0.3, 0.5, 0.6, {})", "k.step({}, 0.5, 0.6, 1.0)", "hl.collide(V, velocity_m_s={})", "hl.impact({{**S, 'contact': {{'tolerance': {}}}}})")],
    "containers": [
        "d = {}; d['target'] = d; hl.impact(d)",
        "d = {}; d['target'] = d; hl.resolve(d)",
        "d = {}; d['target'] = d; hl.collide(d, velocity_m_s=1.0)",
        "d = {}; d['scene'] = d; hl.sweep(d)",
        "d = {}; d['r'] = d; hl.tabulate('t.h5', d)",
        "d = []; d.append(d); hl.impact({'probe': d})",
        "d = x = {}\nfor _ in range(100000): x['a'] = {}; x = x['a']\nhl.impact(d)",
        "class D:\n    def tolist(self): return self\nhl.impact({'target': D()})",
        "class D(dict):\n    def items(self): raise RuntimeError('mine')\nhl.impact(D(S))",
        "hl.impact({**S, '\\ud800': {}})",
        "hl.impact({**S, 'x' * 10**7: {}})",
        "hl.impact('x' * 10**7)",
    ],
    "memory": [
        "hl.impact({**S, 'map': {'r_max_m': 0.01, 'z_max_m': 0.01, 'points': [2001, 2001], 'frames': 100000}})",
        "k.static(0.3, np.broadcast_to(0.5, 30_000_000), 0.5)",
        "k.surface_step(0.3, np.broadcast_to(0.5, 150_000_000))",
        "k.step(0.3, np.broadcast_to(0.5, 20_000_000), 0.5, 1.0)",
        "hl.collide(V, velocity_m_s=np.broadcast_to(1.0, 9_000_000))",
        # each row fails
        "hl.collide({**V, 'contact': {'plasticity': 'jackson_green', 'yield_pressure_pa': 2e9}}, velocity_m_s=np.linspace(0.1, 1.0, 4_000_000))",
        "hl.impact(P, max_memory_gb=1e-9)",
    ],
    "threads": [f"{call}, threads={count})" for count in ("0", "-1", "10**30", "100000", "1.5", "'2'") for call in ("k.step(0.3, a, a, a", "hl.collide(V, velocity_m_s=a", "hl.impact(P")]
    + ["os.environ['RAYON_NUM_THREADS'] = '999999'; hl.collide(V, velocity_m_s=a)"],
    "private": [
        "hl._core.kernel('step', 0.3, a, a[:2], a, 'hertz', 1e-8)",
        "hl._core.plan_of_columns(V, [])",
        "hl._core.plan_of_columns(V, [('striker', 'velocity_m_s', [])])",
        "hl._core.plan(W).compute(0, 1, 10**18)",
        "hl._core.plan(W).compute(10**18, 1, 5)",
    ],
    "files": [
        "hl.impact('/dev/zero')",
        "hl.impact(S).save('/proc/x.h5')",
        "hl.Table.open('/dev/zero')",
        "hl.sweep(W).save('/dev/null', overwrite=True)",
        "hl.materials(file='/dev/zero')",
    ],
}


def within_limits():
    resource.setrlimit(resource.RLIMIT_AS, (3 << 30, 3 << 30))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def judged(tally, code, folder):
    tried = "try:\n" + textwrap.indent(code, "    ") + "\n    print('value')\nexcept Exception: print('exception')\n"
    started = time.monotonic()
    try:
        done = subprocess.run(
            [PYTHON, "-c", HEAD + tried], cwd=folder, capture_output=True, timeout=MOST_S, preexec_fn=within_limits
        )
    except subprocess.TimeoutExpired:
        return tally.fail("hung", code)
    said = done.stdout.decode().strip()
    if done.returncode < 0:
        tally.fail(f"signal {-done.returncode}", code)
    elif done.returncode or said not in ("value", "exception"):
        tally.fail("panic", f"{code}: {done.stderr.decode('utf-8', 'replace')[-200:]}")
    else:
        tally.good(said)
    return time.monotonic() - started


def attacked(folder):
    there = os.path.exists(PYTHON) and subprocess.run([PYTHON, "-c", HEAD], cwd=folder, capture_output=True).returncode == 0
    if not there:
        print(f"    {PYTHON} has no package hertzlamb: scripts/python builds it", flush=True)
        return []
    tallies = []
    for name, codes in CASES.items():
        tally = Tally(f"Python, {name}")
        for code in codes:
            judged(tally, code, folder)
        tally.show()
        tallies.append(tally)
    return tallies


if __name__ == "__main__":
    os.makedirs(WORK, exist_ok=True)
    finish(attacked(fresh("python")))
