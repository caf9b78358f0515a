"""Folders of parts with errors: missing rows, duplicate rows, parts of another sweep, or other files.

Each folder is listed, listed with `--missing` and merged. Expected: the command ends in time, with a message, and never with rows
other than those of one run.
"""

import os
import shutil

from common import GRID, SWEEP, Tally, digest, finish, fresh, kind, last_line, run, well, write

ROWS = SWEEP.replace("samples = 2000", "samples = 300")
MOST_S = 10.0


def cases(other, table, whole):
    """What is done to a folder, by name."""
    into = lambda source, name: lambda folder: shutil.copy(source, os.path.join(folder, name))
    made = lambda name, content: lambda folder: write(os.path.join(folder, name), content)
    linked = lambda target, name: lambda folder: os.symlink(target, os.path.join(folder, name))
    overlapping = lambda name, rows: lambda folder: well(
        ["sweep", os.path.join(folder, "..", "s.toml"), "--rows", rows, "-o", os.path.join(folder, name)]
    )
    return {
        "untouched": lambda folder: None,
        "a part missing": lambda folder: os.unlink(os.path.join(folder, "2.h5")),
        "a part twice": lambda folder: shutil.copy(os.path.join(folder, "2.h5"), os.path.join(folder, "2b.h5")),
        "a part linked twice": linked("2.h5", "2b.h5"),
        "one row twice": overlapping("4.h5", "99:100"),
        "one row twice, at the start of a part": overlapping("4.h5", "200:201"),
        "all rows once more": overlapping("4.h5", "0:300"),
        "no rows": overlapping("4.h5", "7:7"),
        "another sweep's part beside": into(other, "4.h5"),
        "another sweep's part instead": into(other, "2.h5"),
        "the whole beside": into(whole, "all.h5"),
        "a table beside": into(table, "4.h5"),
        "an empty file": made("4.h5", ""),
        "a text": made("4.h5", "row,restitution\n"),
        "what begins as Parquet": made("4.parquet", b"PAR1" + bytes(range(256)) * 20 + b"PAR1"),
        "a folder": lambda folder: os.mkdir(os.path.join(folder, "4.h5")),
        "a pipe": lambda folder: os.mkfifo(os.path.join(folder, "4.h5")),
        "a link to /dev/zero": linked("/dev/zero", "4.h5"),
        "a link to nothing": linked("/nowhere", "4.h5"),
        "a journal of nothing": made("4.h5.part", "x"),
        "a forged journal": made("4.h5.part", f"hertzlamb journal 1 of a sweep: {'0' * 64} 4\nabcd"),
        "a name that obeys": lambda folder: os.rename(
            os.path.join(folder, "2.h5"), os.path.join(folder, "2\x1b[31m.h5")
        ),
        "a sparse terabyte": lambda folder: os.truncate(write(os.path.join(folder, "4.h5"), b"\x89HDF\r\n\x1a\n"), 2**40),
    }


RIGHT = {"untouched", "no rows", "the whole beside", "a journal of nothing", "a forged journal", "a name that obeys"}
"""What is merged to the bytes of one run."""


def listing(tally, ended, note):
    """Counts a run that lists a folder."""
    if ended.busy_s > MOST_S:
        tally.fail("slow", f"{note}: {ended.busy_s:.1f} s")
    elif "\x1b" in ended.out + ended.err:
        tally.fail("control characters", note)
    else:
        tally.ended(ended, {0, 2}, note)


def folders(work):
    at = lambda name: os.path.join(work, name)
    sweep, other = write(at("s.toml"), ROWS), write(at("o.toml"), ROWS.replace("seed = 5", "seed = 6"))
    os.mkdir(at("good"))
    for index, rows in enumerate(("0:100", "100:200", "200:300"), 1):
        well(["sweep", sweep, "--rows", rows, "-o", at(f"good/{index}.h5")])
    well(["sweep", other, "--rows", "100:200", "-o", at("other.h5")])
    well(["sweep", sweep, "-o", at("whole.h5")])
    well(["tabulate", "--grid", write(at("g.toml"), GRID), "-o", at("table.h5")])
    truth, tally = digest(at("whole.h5")), Tally("folders of parts")
    for name, change in cases(at("other.h5"), at("table.h5"), at("whole.h5")).items():
        shutil.rmtree(at("out"), ignore_errors=True)
        shutil.copytree(at("good"), at("out"))
        change(at("out"))
        listing(tally, run(["sweep", "status", at("out")]), name)
        listing(tally, run(["sweep", "status", at("out"), "--shards", "1000000", "--missing"]), name)
        merged = at("merged.h5")
        ended = run(["sweep", "merge", at("out"), "-o", merged, "--force"])
        if ended.code == 0 and digest(merged) != truth:
            tally.fail("other rows", name)
        elif (ended.code == 0) != (name in RIGHT):
            tally.fail("merged" if ended.code == 0 else "refused", f"{name}: {last_line(ended)}")
        else:
            tally.ended(ended, {0, 2}, name)
        if os.path.exists(merged):
            os.unlink(merged)
    tally.show()
    return [tally]


def shards(work):
    """Shards of odd numbers."""
    sweep, tally = write(os.path.join(work, "s.toml"), ROWS), Tally("shards of odd numbers")
    for text in ("0/4", "5/4", "1/0", "1/18446744073709551615", "1/1000001", "-1/2", "a/b", "1", "1/2/3", ""):
        ended = run(["sweep", sweep, "--shard", text, "-o", os.path.join(work, "x.h5")])
        tally.ended(ended, {2}, text) if kind(ended) == "exit 2" else tally.fail("taken", text)
    tally.show()
    return [tally]


if __name__ == "__main__":
    work = fresh("parts")
    finish(folders(work) + shards(work))
