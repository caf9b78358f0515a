"""kill -9 at the n-th system call of every kind that uses files, then the same command again.

Expected: after the kill each output is the old file, the new file or absent, never incomplete. The same command then writes the
bytes of an undisturbed run and leaves no other files.
"""

import os
import shutil
import subprocess

from _writing import commands
from common import WORK, Tally, digest, finish, last_line, rng, run, tries

CALLS = ("openat", "write", "pwrite64", "ftruncate", "fsync", "fdatasync", "fchmod", "flock", "rename", "unlink", "close")
ALONE = dict(os.environ, RAYON_NUM_THREADS="1")  # the same calls in the same order every time


def traced(arguments, options, log):
    command = ["strace", "-f", "-q", "-o", log, *options, os.environ["HERTZLAMB"], *arguments]
    quiet = subprocess.DEVNULL
    return subprocess.run(command, stdin=quiet, stdout=quiet, stderr=quiet, env=ALONE, check=False).returncode


def calls_of(arguments):
    """How often a command makes each call."""
    log = os.path.join(WORK, "calls")
    traced(arguments, ["-e", f"trace={','.join(CALLS)}"], log)
    counts = dict.fromkeys(CALLS, 0)
    with open(log, errors="replace") as lines:
        for line in lines:
            call = line.split(None, 1)[1].split("(")[0]
            if call in counts:
                counts[call] += 1
    return counts


def moments(counts, most, choice):
    """Which calls are killed: of each kind the first, the last three, and others by chance."""
    certain, others = [], []
    for call, count in counts.items():
        ends = {1, count, count - 1, count - 2}
        certain += [(call, n) for n in sorted(ends) if 1 <= n <= count]
        others += [(call, n) for n in range(2, count - 2)]
    choice.shuffle(others)
    return (certain + others)[:most] if most > len(certain) else choice.sample(certain, most)


def attack(name, folder, writing, most):
    tally = Tally(name)
    writing.setup()
    counts = calls_of(writing.arguments)
    truth = [digest(path) for path in writing.outputs]
    writing.setup()
    old = [digest(path) for path in writing.outputs]
    start = os.path.join(WORK, "start")
    shutil.rmtree(start, ignore_errors=True)
    shutil.copytree(folder, start)
    before = set(os.listdir(folder))
    for call, n in moments(counts, most, rng(name)):
        shutil.rmtree(folder)
        shutil.copytree(start, folder)
        traced(writing.arguments, ["-e", f"trace={call}", "-e", f"inject={call}:signal=KILL:when={n}"], os.devnull)
        tally.good("kills")
        now = [digest(path) for path in writing.outputs]
        if name != "shard" and any(found not in (was, new) for found, was, new in zip(now, old, truth)):
            tally.fail("half-written", f"{call} {n}")
        again = run(writing.arguments, env=ALONE)
        done = [digest(path) for path in writing.outputs] == truth
        if done and (again.code == 0 or again.code == 2 and now == truth):
            tally.good("finished by the same command")
        else:
            tally.fail("not finished by the same command", f"{call} {n}: {again.code} {last_line(again)[-150:]}")
        left = set(os.listdir(folder)) - before - {os.path.basename(path) for path in writing.outputs}
        if left:
            tally.fail("litter", f"{call} {n}: {' '.join(sorted(left))}")
    tally.show()
    return tally


if __name__ == "__main__":
    if shutil.which("strace") is None:
        finish([])
    folder, writings = commands("kills")
    each = tries(12)
    tallies = [attack(name, folder, writing, each) for name, writing in writings.items()]
    print(f"kills in all: {sum(tally.counts['kills'] for tally in tallies)}")
    finish(tallies)
