"""Commands that write files, small enough to be run hundreds of times."""

import collections
import os

from common import GRID, SCENE, fresh, well, write

Writing = collections.namedtuple("Writing", "arguments outputs setup")
"""A command, the files that it writes, and the initial content of its folder."""

SWEEP = """[scene.striker]
tip_radius_m = 0.005
material = "mine"
mass_kg = 0.01
[scene.target]
material = "steel"
[scene.contact]
model = "hertz"
[scene.materials]
file = "mine.toml"
[product.striker]
velocity_m_s = { from = 0.1, to = 10.0, count = 70000, spacing = "log" }
"""
SECTION = "[map]\nr_max_m = 0.01\nz_max_m = 0.01\npoints = [9, 7]\nframes = 3\n"
MATERIALS = '[mine]\nyoungs_modulus_pa = 70e9\npoisson_ratio = 0.22\ndensity_kg_m3 = 2500\nsource = "x"\n'


def commands(name):
    """The folder and the commands in it by name."""
    folder = fresh(name)
    at = lambda file: os.path.join(folder, file)
    table, grid = at("t.h5"), at("g.toml")

    def empty():
        fresh(name)
        write(grid, GRID)
        write(at("s.toml"), SWEEP)
        write(at("mine.toml"), MATERIALS)
        write(at("i.toml"), SCENE)
        write(at("map.toml"), SCENE + SECTION)
        os.mkdir(at("parts"))

    def with_table(ratio=None):
        def setup():
            empty()
            well(["tabulate", "--grid", grid, *(["--nu", ratio] if ratio else []), "-o", table])

        return setup

    def with_shards():
        empty()
        for part in (1, 2):
            well(["tabulate", "--grid", grid, "--shard", f"{part}/2", "-o", at(f"{part}.shard")])

    def with_results():
        empty()
        well(["impact", at("i.toml"), "-o", at("i.h5")])

    def with_parts():
        empty()
        for part in (1, 2):
            well([*sweep[:2], "--shard", f"{part}/2", "-o", at(f"parts/{part}.h5")])

    def with_old(*files):
        def setup():
            empty()
            for file in files:
                write(at(file), "old")

        return setup

    sweep = ["sweep", at("s.toml"), "-o", at("s.h5"), "--csv", at("s.csv")]
    both = [at("s.h5"), at("s.csv")]
    impact = ["impact", at("i.toml"), "-o", at("i.h5")]
    return folder, {
        "tabulate": Writing(["tabulate", "--grid", grid, "-o", table], [table], empty),
        "tabulate --force": Writing(["tabulate", "--grid", grid, "-o", table, "--force"], [table], with_table("0.2")),
        "extend": Writing(["tabulate", "--nu", "0.25", "-o", table], [table], with_table()),
        "shard": Writing(["tabulate", "--grid", grid, "--shard", "1/1", "-o", at("1.shard")], [at("1.shard")], empty),
        "merge": Writing(["table", "merge", at("1.shard"), at("2.shard"), "-o", table], [table], with_shards),
        "section": Writing(["impact", at("map.toml"), "-o", at("m.h5")], [at("m.h5")], empty),
        "part": Writing([*sweep[:2], "--shard", "1/2", "-o", at("1.h5")], [at("1.h5")], empty),
        "join": Writing(["sweep", "merge", at("parts"), "-o", at("s.h5")], [at("s.h5")], with_parts),
        "sweep": Writing(sweep, both, empty),
        "sweep --force": Writing([*sweep, "--force"], both, with_old("s.h5", "s.csv")),
        "impact": Writing(impact, [at("i.h5")], empty),
        "plot": Writing(["plot", at("i.h5"), "-o", at("i.svg")], [at("i.svg")], with_results),
        "impact --force": Writing([*impact, "--force"], [at("i.h5")], with_old("i.h5")),
    }
