"""Inputs of the wrong kind: pipes, devices, folders, terabytes of zeros, other formats.

Each is passed as scene, sweep, grid, materials file, force record, kernel table, shard and result; each must be rejected at once.
"""

import os
import struct
import zlib

from common import GRID, SCENE, Tally, finish, fresh, last_line, rng, run, tries, well, write

SWEEP = """scene = "SCENE"
[product.striker]
velocity_m_s = [1.0, 2.0]
"""
FORCE = """[target]
material = "steel"
[force]
file = "FILE"
[contact]
disc_radius_m = 0.004
"""
OWN = """[materials]
file = "FILE"
"""
MOST_S = 3.0
MOST_MB = 500


def strange(folder):
    """Files that nobody should give, by name."""
    at = lambda name: os.path.join(folder, name)
    os.mkfifo(at("pipe"))
    os.mkdir(at("folder"))
    os.symlink(at("nowhere"), at("dangling"))
    with open(at("sparse"), "wb") as file:
        file.truncate(1 << 40)
    with open(at("sparse.h5"), "wb") as file:
        file.write(b"\x89HDF\r\n\x1a\n")
        file.truncate(1 << 40)
    write(at("empty"), b"")
    write(at("zeros"), bytes(100_000))
    write(at("latin"), "[target]\nmaterial = \"\u00e9\"\n".encode("latin-1"))
    write(at("deep.toml"), "a = " + "[" * 100_000)
    write(at("long.toml"), "a" * 17_000_000 + " = 1\n")
    write(at("many.csv"), "time_s,force_n\n" + "0,0\n" * 100_000)
    write(at("hdf5"), b"\x89HDF\r\n\x1a\n" + bytes(range(256)) * 40)
    names = "pipe folder dangling sparse sparse.h5 empty zeros latin deep.toml long.toml many.csv hdf5".split()
    return [at(name) for name in names] + ["/dev/zero", "/dev/full", "/dev/null", "/proc/self/mem"]


def uses(folder, path):
    """Commands that read a file, by the kind of file that they expect."""
    at = lambda name: os.path.join(folder, name)
    scene, out = write(at("scene.toml"), SCENE), at("out.h5")
    named = {
        "sweep's scene": SWEEP.replace("SCENE", path),
        "force record": FORCE.replace("FILE", path),
        "materials": OWN.replace("FILE", path) + SCENE,
    }
    written = {what: write(at(f"{index}.toml"), text) for index, (what, text) in enumerate(named.items())}
    grid = path if path.endswith(".toml") else None
    commands = {
        "scene": ["impact", path],
        "sweep": ["sweep", path, "-o", out],
        "sweep's scene": ["sweep", written["sweep's scene"], "-o", out],
        "force record": ["impact", written["force record"]],
        "materials": ["impact", written["materials"]],
        "materials listed": ["materials", "--file", path],
        "table": ["impact", scene, "--table", path, "--kernel", "table"],
        "table info": ["table", "info", path],
        "table verify": ["table", "verify", path],
        "shard": ["table", "merge", path, "-o", out],
        "results": ["plot", path, "-o", at("out.svg")],
    }
    if grid:
        commands["grid"] = ["tabulate", "--grid", grid, "-o", out]
    return commands


def records(folder):
    """Force records in HDF5 that a program of ours wrote, then damaged: an answer or a sentence."""
    tally, choice = Tally("force records in HDF5 damaged"), rng("records")
    at = lambda name: os.path.join(folder, name)
    scene = write(at("s.toml"), SCENE)
    well(["impact", scene, "-o", at("good.h5")])
    given = write(at("f.toml"), FORCE.replace("FILE", at("bad.h5")))
    with open(at("good.h5"), "rb") as file:
        good = file.read()
    for _ in range(tries(300)):
        bad = bytearray(good)
        for _ in range(choice.choice([1, 1, 2, 4])):
            place = choice.randrange(min(len(bad), choice.choice([200, 4000, len(bad)])))
            size = min(choice.choice([1, 1, 4, 8, 64]), len(bad) - place)
            bad[place : place + size] = choice.choice([bytes(size), b"\xff" * size, choice.randbytes(size)])
        write(at("bad.h5"), bytes(bad))
        ended = run(["impact", given, "--json"], limit=20)
        if ended.rss_mb > MOST_MB:
            tally.fail("exploding", f"{ended.rss_mb:.0f} MB")
        elif ended.code == 0 and any(word in ended.out for word in ("NaN", "inf,", "Infinity")):
            tally.fail("not finite")
        else:
            tally.ended(ended, {0, 1, 2})
    tally.show()
    return tally


if __name__ == "__main__":
    folder = fresh("strangers")
    tally = Tally("strange files")
    for path in strange(folder):
        for what, arguments in uses(folder, path).items():
            ended = run(arguments, limit=20)
            note = f"{os.path.basename(path)} as {what}"
            if ended.rss_mb > MOST_MB or ended.busy_s > MOST_S:
                tally.fail("exploding", f"{note}: {ended.rss_mb:.0f} MB, {ended.busy_s:.1f} s")
            elif ended.code == 0 and not (what.startswith("materials") and os.path.getsize(path) == 0):
                tally.fail("taken", note)
            else:
                tally.ended(ended, {0, 1, 2}, note)
    tally.show()
    finish([tally, records(fresh("records"))])
