"""Scenes, sweeps and tables that are too large for any machine: each must be rejected at once, with a message that has a number."""

import os

from common import GRID, SCENE, Tally, finish, fresh, last_line, run, write

MAP = "[map]\nr_max_m = 0.02\nz_max_m = 0.02\npoints = [{0}, {1}]\nframes = {2}\n"
SWEEP = """[scene.striker]
tip_radius_m = 0.005
material = "steel"
mass_kg = 0.01
[scene.target]
material = "steel"
[product.striker]
velocity_m_s = { from = 0.1, to = 10.0, count = COUNT }
"""
MOST_S = 3.0
MOST_MB = 500
FULL = 75


if __name__ == "__main__":
    folder = fresh("sizes")
    at = lambda name: os.path.join(folder, name)
    bare = SCENE.split("[[probe]]")[0]
    probes = "".join(f"[[probe]]\nr_m = 1e-3\nz_m = {1e-9 * i:.9f}\n" for i in range(100_000))
    scenes = {
        "a map of 2001 x 2001 x 100000": bare + MAP.format(2001, 2001, 100_000),
        "a map of 2001 x 2001 x 1000": bare + MAP.format(2001, 2001, 1000),
        "100,000 probes over 1 s": bare + "[contact]\nstep_s = 1e-6\n[output]\nduration_s = 1.0\n" + probes,
        "an output of 1e300 s": bare + "[output]\nduration_s = 1e300\n",
        "an output of 1e9 s": bare + "[output]\nduration_s = 1e9\n",
        "steps of 1e-300 s": bare + "[contact]\nstep_s = 1e-300\n",
        "steps of 1e-15 s": bare + "[contact]\nstep_s = 1e-15\n",
        "steps of 1e-13 s, growing": bare + '[contact]\nmodel = "growing"\nstep_s = 1e-13\n',
        "steps of 1e-13 s, explicit": bare + '[contact]\nmodel = "wave"\nscheme = "explicit"\nstep_s = 1e-13\n',
        "a disc of 1e9 m": bare + '[contact]\nmodel = "wave"\ndisc_radius_m = 1e9\n',
    }
    sweeps = {f"a sweep of {count} rows": SWEEP.replace("COUNT", count) for count in ("1e12", "1000000000000", "10000001")}
    sweeps["a sweep of 1e10 rows in two keys"] = (
        SWEEP.replace("COUNT", "100000") + "mass_kg = { from = 0.1, to = 10.0, count = 100000 }\n"
    )
    grids = {
        "a table of 2000 x 2000 nodes": GRID.replace("spacing = 0.25", "spacing = 0.005").replace("max = 2.0", "max = 9.9"),
        "a table with spacing 1e-9": GRID.replace("spacing = 0.25", "spacing = 1e-9"),
        "a table to 1e300 r0": GRID.replace("max = 2.0", "max = 1e300"),
    }
    commands = {name: ["impact", write(at(f"s{i}.toml"), text), "--json"] for i, (name, text) in enumerate(scenes.items())}
    for i, (name, text) in enumerate(sweeps.items()):
        commands[name] = ["sweep", write(at(f"w{i}.toml"), text), "-o", at("w.h5")]
    for i, (name, text) in enumerate(grids.items()):
        commands[name] = ["tabulate", "--grid", write(at(f"g{i}.toml"), text), "-o", at("g.h5")]
    small = write(at("small.toml"), SCENE)
    commands["a scene above the limit given"] = ["impact", small, "--max-memory", "1e-6"]
    tally = Tally("sizes")
    for name, arguments in commands.items():
        ended = run(arguments, limit=30)
        if ended.rss_mb > MOST_MB or ended.busy_s > MOST_S:
            tally.fail("exploding", f"{name}: {ended.rss_mb:.0f} MB, {ended.busy_s:.1f} s, {last_line(ended)[:120]}")
        elif ended.code in (1, 2, FULL if "no space left" in ended.err else 2) and len(ended.err.splitlines()) == 1:
            tally.good("refused at once")
        else:
            tally.fail("not refused", f"{name}: {ended.code} {last_line(ended)[:150]}")
    tally.show()
    finish([tally])
