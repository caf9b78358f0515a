"""Outputs that are inputs, equal to each other, folders, pipes, devices or of another format, all with --force.

Expected: exit code 2 with a message, at once, and every file unchanged.
"""

import os
import shutil
import stat

from _writing import commands
from common import WORK, Tally, digest, finish, kind, last_line, run, write

FORCED = ("tabulate --force", "merge", "sweep --force", "impact --force", "plot")


def state(folder):
    """Everything in a folder: kinds, links, permissions, contents."""
    found = {}
    for entry in sorted(os.scandir(folder), key=lambda entry: entry.name):
        mode = entry.stat(follow_symlinks=False).st_mode
        inside = os.readlink(entry.path) if stat.S_ISLNK(mode) else digest(entry.path) if stat.S_ISREG(mode) else None
        found[entry.name] = (mode, inside)
    return found


def inputs_of(name, folder):
    """What a command reads."""
    names = {
        "tabulate --force": ["g.toml"],
        "merge": ["1.shard", "2.shard"],
        "sweep --force": ["s.toml", "mine.toml"],
        "impact --force": ["i.toml", "k.h5"],
        "plot": ["i.h5"],
    }
    return [os.path.join(folder, name) for name in names[name]]


def places(path, folder, ending):
    """A file under its own name and behind links of both kinds."""
    hard, soft, chain = (os.path.join(folder, f"{kind}{ending}") for kind in ("hard", "soft", "chain"))
    os.link(path, hard)
    os.symlink(os.path.basename(path), soft)
    os.symlink(os.path.basename(soft), chain)
    return [path, hard, soft, chain, os.path.join(folder, ".", os.path.basename(path)), f"{folder}/../{os.path.basename(folder)}/{os.path.basename(path)}"]


def attack(name, folder, writing, table):
    tally = Tally(name)

    def fresh():
        writing.setup()
        shutil.copy(table, os.path.join(folder, "k.h5"))

    def refused(arguments, what, codes=(2,)):
        before = state(folder)
        ended = run(arguments, limit=20)
        if kind(ended) in [f"exit {code}" for code in codes]:
            tally.good(f"{what} refused")
        else:
            tally.fail(f"{what} not refused", f"{kind(ended)} {last_line(ended)[-150:]}")
        if state(folder) != before:
            tally.fail(f"{what}: files changed", " ".join(name for name in before if before[name] != state(folder).get(name)))

    def to(output):
        arguments = [output if part == writing.outputs[0] else part for part in writing.arguments]
        if name == "impact --force":
            arguments += ["--table", os.path.join(folder, "k.h5")]
        return arguments if "--force" in arguments else [*arguments, "--force"]

    ending = os.path.splitext(writing.outputs[0])[1]
    fresh()
    for place in range(len(inputs_of(name, folder))):
        fresh()
        for output in places(inputs_of(name, folder)[place], folder, ending):
            refused(to(output), "an input")
    fresh()
    pipe, inside = os.path.join(folder, f"pipe{ending}"), os.path.join(folder, f"folder{ending}")
    os.mkfifo(pipe)
    os.mkdir(inside)
    os.symlink("pipe" + ending, os.path.join(folder, "topipe" + ending))
    os.symlink("loop" + ending, os.path.join(folder, "loop" + ending))
    strange = [pipe, inside, os.path.join(folder, "topipe" + ending), os.path.join(folder, "loop" + ending), "/dev/null", "/dev/full", "/dev/stdout", "-", "", "/", ".", ".."]
    strange += [os.path.join(folder, "nowhere/x" + ending), os.path.join(folder, "g.toml/x" + ending), os.path.join(folder, "n" * 300 + ending)]
    for output in strange:
        refused(to(output), "what is no file")
    if os.geteuid() == 0:
        device = os.path.join(folder, f"device{ending}")
        os.mknod(device, stat.S_IFCHR | 0o666, os.makedev(1, 3))
        refused(to(device), "what is no file")
    for other in (".toml", ".shard", ".csv", ".jpg"):
        refused(to(os.path.join(folder, "new" + other)), "the ending of another format")
    if name.startswith("sweep"):
        twice = os.path.join(folder, "twice")
        refused(["sweep", os.path.join(folder, "s.toml"), "-o", twice, "--csv", f"{folder}/./twice", "--force"], "the same output twice")
        journal = os.path.join(folder, "s.h5.part")
        for strange in (b"precious", b"x" * 20, b"hertzlamb journal 1 of a table: 0 3\nabc"):
            write(journal, strange)
            refused(writing.arguments, "a strange journal")
    if name.startswith("tabulate"):
        for strange in (b"precious", b"x" * 20, b"hertzlamb journal 1 of a sweep: 0 3\nabc"):
            write(os.path.join(folder, "t.h5.journal"), strange)
            refused(writing.arguments, "a strange journal")
    tally.show()
    return tally


if __name__ == "__main__":
    folder, writings = commands("outputs")
    writings["tabulate"].setup()
    assert run(writings["tabulate"].arguments).code == 0
    table = os.path.join(WORK, "k.h5")
    shutil.copy(writings["tabulate"].outputs[0], table)
    finish([attack(name, folder, writings[name], table) for name in FORCED])
