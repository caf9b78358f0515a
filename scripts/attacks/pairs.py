"""Two simultaneous runs with the same output, one of them sometimes killed; then the same command again.

Expected: a run succeeds, or ends with 75 (another run is writing the file) or 2 (the file exists). The bytes are those of one of
the two runs. Afterwards the same command succeeds and leaves no other files.
"""

import os
import subprocess
import time

from _writing import SWEEP, commands
from common import PROGRAM, WORK, Tally, digest, finish, last_line, rng, run, tries, write

AT_ONCE = ("tabulate", "tabulate --force", "extend", "shard", "merge", "sweep", "sweep --force", "impact", "impact --force")


def truth_of(writing, arguments):
    writing.setup()
    run(arguments)
    return [content(path) for path in writing.outputs]


def content(path):
    """Digest of a file; of a shard, whose blocks lie in the order in which they were finished, that of its table."""
    if not path.endswith(".shard") or not os.path.exists(path):
        return digest(path)
    table = os.path.join(WORK, "merged.h5")
    done = run(["table", "merge", path, "-o", table, "--force"]).code == 0
    return digest(table) if done else "unfinished"


def attack(name, folder, writing, rounds, other=None):
    """`other` is a command for the same outputs that wants something else in them."""
    tally, choice = Tally(name if other is None else f"{name}, another one"), rng(f"pairs {name} {other}")
    both = [writing.arguments, other or writing.arguments]
    truths = [truth_of(writing, arguments) for arguments in both]
    writing.setup()
    before = set(os.listdir(folder)) | {os.path.basename(path) for path in writing.outputs}
    for _ in range(rounds):
        writing.setup()
        old = [content(path) for path in writing.outputs]
        runs = []
        for arguments in both:
            quiet = subprocess.DEVNULL
            runs.append(subprocess.Popen([PROGRAM, *arguments], stdin=quiet, stdout=quiet, stderr=subprocess.PIPE))
            time.sleep(choice.choice([0, 0, choice.uniform(0, 0.02), choice.uniform(0, 0.5)]))
        victim = choice.choice([None, None, *runs])
        if victim:
            time.sleep(choice.uniform(0, 0.4))
            victim.kill()
        for child in runs:
            said = child.communicate()[1].decode("utf-8", "replace").strip()
            if child.returncode in (0, 2, 75) or child is victim:
                tally.good(f"exit {child.returncode}" if child.returncode >= 0 else "killed")
            else:
                tally.fail(f"exit {child.returncode}", said[-150:])
        now = [content(path) for path in writing.outputs]
        allowed = [*truths, old]
        if name != "shard" and any(found not in [some[i] for some in allowed] for i, found in enumerate(now)):
            tally.fail("bytes of neither")
        if now == old and old not in truths and any(child.returncode == 0 for child in runs):
            tally.fail("exit 0 and nothing there")
        again = run(writing.arguments)
        now = [content(path) for path in writing.outputs]
        if again.code == 0 and now in truths or again.code == 2 and now in truths:
            tally.good("right afterwards")
        elif again.code == 2 and "another sweep" in again.err:
            tally.good("told of the other one")
            again = run([*writing.arguments, "--force"])
            if again.code != 0:
                tally.fail("dead end", last_line(again))
        else:
            tally.fail("not right afterwards", f"{again.code} {last_line(again)[-150:]}")
        left = set(os.listdir(folder)) - before
        if left:
            tally.fail("litter", " ".join(sorted(left)))
    tally.show()
    return tally


if __name__ == "__main__":
    folder, writings = commands("pairs")
    rounds = tries(10)
    tallies = [attack(name, folder, writings[name], rounds) for name in AT_ONCE]
    sweep = writings["sweep"]

    def with_another():
        sweep.setup()
        write(os.path.join(folder, "s2.toml"), SWEEP.replace("10.0", "20.0"))

    another = [os.path.join(folder, "s2.toml") if part.endswith("s.toml") else part for part in sweep.arguments]
    tallies.append(attack("sweep", folder, sweep._replace(setup=with_another), rounds, another))
    print(f"pairs in all: {rounds * len(tallies)}")
    finish(tallies)
