"""One failing write, each in turn, for every command that writes files, as on a full disk or a network file system.

Expected: exit code 0 only with the bytes of an undisturbed run. Otherwise the command prints its message, leaves every output
unchanged and no other files, and succeeds when it is run again.
With ATTACK_SHARE of at least 2 the writes also fail with EIO.
"""

import os
import shutil

from _writing import commands
from common import SHARE, WORK, Tally, digest, finish, run
from kills import ALONE, calls_of, traced

CALLS = ("pwrite64", "write", "ftruncate", "fsync")
MOST = {"pwrite64": 200}
"""Writes of each kind that are failed, 40 of the others: of more every second, third ... one. The HDF5 library uses pwrite64."""


def attack(name, folder, writing, error):
    tally = Tally(f"{name} ({error})")
    writing.setup()
    counts = calls_of(writing.arguments)
    truth = [digest(path) for path in writing.outputs]
    writing.setup()
    old = [digest(path) for path in writing.outputs]
    start = os.path.join(WORK, "start")
    shutil.rmtree(start, ignore_errors=True)
    shutil.copytree(folder, start)
    before = set(os.listdir(folder))
    for call in CALLS:
        for n in range(1, counts[call] + 1, -(-counts[call] // MOST.get(call, 40)) or 1):
            shutil.rmtree(folder)
            shutil.copytree(start, folder)
            where = f"{call} {n} of {counts[call]}"
            injected = f"inject={call}:error={error}:when={n}"
            code = traced(writing.arguments, ["-e", f"trace={call}", "-e", injected], os.devnull)
            now = [digest(path) for path in writing.outputs]
            if code == 0:
                tally.good("done all the same") if now == truth else tally.fail("exit 0 with other bytes", where)
                continue
            if code in (1, 2, 75):
                tally.good("failed")
            else:
                tally.fail(f"exit {code}", where)
            if any(found not in (was, new) for found, was, new in zip(now, old, truth)):
                tally.fail("other bytes", where)
            if litter := [file for file in set(os.listdir(folder)) - before if file.startswith(".")]:
                tally.fail("litter", f"{where}: {litter}")
            again = run(writing.arguments, env=ALONE)
            if [digest(path) for path in writing.outputs] == truth and (again.code == 0 or again.code == 2 and now == truth):
                tally.good("finished by the same command")
            else:
                tally.fail("not finished by the same command", f"{where}: {again.code}")
    tally.show()
    return tally


if __name__ == "__main__":
    if shutil.which("strace") is None:
        finish([])
    folder, writings = commands("writes")
    errors = ["ENOSPC", "EIO"][: 2 if SHARE >= 2 else 1]
    # a shard is its own journal, whose records stay
    names = [name for name in writings if name != "shard"]
    tallies = [attack(name, folder, writings[name], error) for name in names for error in errors]
    print(f"writes that failed: {sum(tally.counts['failed'] for tally in tallies)}")
    finish(tallies)
