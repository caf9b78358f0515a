"""Damaged kernel tables, shards, journals, results, sweeps and their parts: expected is a rejection, or the same numbers.

A table is damaged anywhere, at its start (metadata, attributes), by exchanged pieces, or in its checksum trailer; then an impact
and `table info` read it. A shard and the journals of a build and of a sweep are damaged and resumed. Results and sweeps are
damaged, drawn, and passed to `--skip-complete`; a part is damaged, listed and merged.
"""

import os
import struct

from common import SCENE, SWEEP, Tally, digest, finish, fresh, last_line, rng, run, tries, well, write

# metadata of several slices with few numbers
GRID = """poisson_ratios = [0.25, 0.3]
exact_ratios = [0.27]
cell_width = 0.8
pulse_lengths = [20.0]
stencil_points = 2
[r]
max = 2.0
spacing = 0.25
[z]
max = 2.0
spacing = 0.25
"""
# probes that the small table reaches
NEAR = SCENE.replace("_m = 1e-3", "_m = 2e-4")
MOST_MB = 500
MOST_S = 10.0


def damaged(good, choice, places=None):
    """One change of some bytes; of `places` alone where they are given."""
    bad = bytearray(good)
    at = choice.choice(places) if places else choice.randrange(len(bad))
    size = choice.choice([1, 2, 8, 64, 512])
    what = choice.choice(["bit", "bit", "byte", "zeros", "ones", "noise", "swap", "cut", "longer"])
    if what == "bit":
        bad[at] ^= 1 << choice.randrange(8)
    elif what == "byte":
        bad[at] = choice.randrange(256)
    elif what in ("zeros", "ones", "noise"):
        size = min(size, len(bad) - at)
        bad[at : at + size] = {"zeros": bytes(size), "ones": b"\xff" * size}.get(what) or choice.randbytes(size)
    elif what == "swap":
        other = choice.choice(places) if places else choice.randrange(len(bad))
        size = min(size, len(bad) - max(at, other))
        bad[at : at + size], bad[other : other + size] = bad[other : other + size], bad[at : at + size]
    elif what == "cut" and not places:
        del bad[at:]
    else:
        bad += choice.randbytes(size)
    return bytes(bad), f"{what} of {size} at {at}"


def regions(sealed):
    """Places at the start of a sealed file, without the slack of zeros, and those of its seal."""
    (end,) = struct.unpack_from("<Q", sealed, len(sealed) - 40)
    assert sealed[-48:-40] == b"hlseal2\n"
    return [place for place in range(min(end, 40_000)) if sealed[place]], list(range(end, len(sealed)))


def exchanged(good, choice):
    """Two stretches of equal length in each other's place, as a disk may mix them up."""
    size = choice.choice([512, 4096, 65536])
    one, other = (choice.randrange(max(1, len(good) // size - 1)) * size for _ in range(2))
    bad = bytearray(good)
    bad[one : one + size], bad[other : other + size] = good[other : other + size], good[one : one + size]
    return bytes(bad), f"{size} at {one} and {other}"


def judged(tally, ended, right, note):
    """Counts a run on a damaged file: refused in a sentence, or right."""
    if ended.rss_mb > MOST_MB or ended.busy_s > MOST_S:
        tally.fail("exploding", f"{note}: {ended.rss_mb:.0f} MB, {ended.busy_s:.1f} s")
    elif ended.code == 0:
        tally.good("right") if right else tally.fail("silently wrong", note)
    elif ended.code in (1, 2):
        tally.good("refused") if "error: " in ended.err else tally.fail("unclear", note)
    else:
        tally.ended(ended, {1, 2}, note)


def tables(folder):
    table, bad, out = (os.path.join(folder, name) for name in ("t.h5", "bad.h5", "out.h5"))
    grid, scene = write(os.path.join(folder, "g.toml"), GRID), write(os.path.join(folder, "s.toml"), NEAR)
    well(["tabulate", "--grid", grid, "-o", table])
    with open(table, "rb") as file:
        good = file.read()
    metadata, seal = regions(good)
    between = write(os.path.join(folder, "b.toml"), NEAR.replace('material = "steel"', "poisson_ratio = 0.27\nmaterial = \"steel\"", 1))
    scenes = [scene, between]
    write(bad, good)
    impact = lambda path: ["impact", path, "--table", bad, "--kernel", "table", "-o", out, "--force"]
    truth = {}
    for path in scenes:
        well(impact(path))
        truth[path] = digest(out)
    tallies = []
    for name, places, count in (("anywhere", None, 300), ("metadata", metadata, 200), ("seal", seal, 50), ("exchanged", (), 100)):
        tally, choice = Tally(f"tables damaged, {name}"), rng(name)
        for index in range(tries(count)):
            content, note = exchanged(good, choice) if places == () else damaged(good, choice, places)
            write(bad, content)
            path = scenes[index % 2]
            ended = run(impact(path))
            judged(tally, ended, digest(out) == truth[path], note)
            ended = run(["table", "info", bad])
            judged(tally, ended, True, f"info, {note}")
        tally.show()
        tallies.append(tally)
    return tallies


def journals(folder):
    at = lambda name: os.path.join(folder, name)
    grid, sweep = write(at("g.toml"), GRID), write(at("s.toml"), SWEEP)
    table, rows = at("t.h5"), at("rows.h5")
    parts = []
    for index in (1, 2):
        parts.append(at(f"{index}.shard"))
        well(["tabulate", "--grid", grid, "--shard", f"{index}/2", "-o", parts[-1]])
    merge = ["table", "merge", at("bad.shard"), parts[1], "-o", table, "--force"]
    with open(parts[0], "rb") as file:
        shard = file.read()
    write(at("bad.shard"), shard)
    well(merge)
    truth = digest(table)
    # a shard has the form of a journal
    build = ["tabulate", "--grid", grid, "-o", table]
    resume = ["sweep", sweep, "-o", rows]
    well(resume)
    of_sweep = digest(rows)
    kept = journal_of_sweep(resume, rows)
    shards, builds, sweeps = Tally("shards damaged"), Tally("journals of builds damaged"), Tally("journals of sweeps damaged")
    choice = rng("journals")
    for _ in range(tries(100)):
        content, note = damaged(shard, choice)
        write(at("bad.shard"), content)
        judged(shards, run(merge), digest(table) == truth, note)
        gone(table)
        content, note = damaged(shard, choice)
        write(table + ".journal", content)
        judged(builds, run(build), digest(table) == truth, note)
        gone(table, table + ".journal")
        if kept:
            content, note = damaged(kept, choice)
            gone(rows)
            write(rows + ".part", content)
            judged(sweeps, run(resume), digest(rows) == of_sweep, note)
            gone(rows + ".part")
    for tally in (shards, builds, sweeps):
        tally.show()
    return [shards, builds, sweeps]


def parts(folder):
    at = lambda name: os.path.join(folder, name)
    sweep, merged = write(at("s.toml"), SWEEP), at("merged.h5")
    os.mkdir(at("parts"))
    tallies = []
    for ending in ("h5", "parquet"):
        part = os.path.join(at("parts"), f"1.{ending}")
        compute = ["sweep", sweep, "--shard", "1/1", "-o", part]
        if "built without" in run(compute).err:
            print("    the program was built without Parquet")
            continue
        merge = ["sweep", "merge", at("parts"), "-o", merged, "--force"]
        well(merge)
        truth = digest(merged)
        with open(part, "rb") as file:
            good = file.read()
        tally, choice = Tally(f"parts damaged, {ending}"), rng(f"parts {ending}")
        for _ in range(tries(200)):
            content, note = damaged(good, choice)
            write(part, content)
            listed = run(["sweep", "status", at("parts"), "--sweep", sweep, "--json"])
            judged(tally, listed, content == good or '"foreign":[]' not in listed.out, f"status, {note}")
            judged(tally, run(merge), digest(merged) == truth, note)
            gone(merged)
        gone(part)
        tally.show()
        tallies.append(tally)
    return tallies


def results(folder):
    """Damaged results and sweeps, passed to `--skip-complete` and drawn."""
    at = lambda name: os.path.join(folder, name)
    scene, sweep, picture = write(at("s.toml"), SCENE), write(at("w.toml"), SWEEP), at("p.svg")
    tallies = []
    for name, make in (("results", ["impact", scene]), ("sweeps", ["sweep", sweep])):
        path = at(f"{name}.h5")
        draw = ["plot", path, "-o", picture, "--force"]
        well([*make, "-o", path])
        well(draw)
        truth = digest(picture)
        with open(path, "rb") as file:
            good = file.read()
        tally, choice = Tally(f"{name} damaged"), rng(name)
        for index in range(tries(200)):
            content, note = exchanged(good, choice) if index % 4 == 0 else damaged(good, choice)
            write(path, content)
            judged(tally, run([*make, "-o", path, "--skip-complete"]), content == good, note)
            judged(tally, run(draw), digest(picture) == truth, f"plot, {note}")
        tally.show()
        tallies.append(tally)
    return tallies


def gone(*paths):
    for path in paths:
        if os.path.exists(path):
            os.unlink(path)


def journal_of_sweep(arguments, output):
    """What a sweep keeps until its results are written: it is taken while a folder is in the way of their name."""
    gone(output)
    import signal
    import subprocess
    import time

    from common import PROGRAM

    for wait in (0.002, 0.005, 0.01, 0.02, 0.05, 0.1):
        child = subprocess.Popen([PROGRAM, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        until = time.monotonic() + 5
        while time.monotonic() < until and child.poll() is None:
            try:
                with open(output + ".part", "rb") as file:
                    content = file.read()
            except OSError:
                content = b""
            if len(content) > 5000:
                child.send_signal(signal.SIGKILL)
                child.wait()
                gone(output, output + ".part")
                return content
            time.sleep(wait / 10)
        child.wait()
        gone(output, output + ".part")
    print("    no journal of a sweep could be caught")
    return b""


if __name__ == "__main__":
    finish(
        tables(fresh("corruption")) + journals(fresh("journals")) + results(fresh("results")) + parts(fresh("parts"))
    )
