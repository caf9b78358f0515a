"""Failures of the system: threads, file locks, memory limits of a control group, and a standard error that nobody reads.

Expected: the program works with fewer threads if some do not start, and writes files on a file system without locks. It rejects
work that needs more memory than the group may use, with a message. A signal ends it at once, whoever reads its messages.
Control groups need root and their file system, version 1 or 2; locks need strace.
"""

import fcntl
import json
import os
import resource
import shutil
import signal
import subprocess
import time

from _writing import commands
from common import PROGRAM, SCENE, SWEEP, WORK, Tally, digest, finish, for_all, kind, last_line, run, tries, write
from kills import ALONE, traced

NOBODY = 54323
MOST_S = 5.0
"""Time in s within which a signal ends the program."""
RECORD = """[target]
material = "steel"
[contact]
disc_radius_m = 1e-3
[force]
file = "long.csv"
"""
"""A force whose samples take more than most of the limits of memory that are tried."""
SECTION = "[map]\nr_max_m = 0.02\nz_max_m = 0.02\npoints = [401, 401]\nframes = 40\n"


def threads(folder, writings):
    """Few processes allowed: fewer threads, the same bytes."""
    tally = Tally("threads that do not start")
    for name in ("sweep", "tabulate", "impact"):
        writing = writings[name]
        writing.setup()
        assert run(writing.arguments).code == 0
        truth = [digest(path) for path in writing.outputs]
        for most in (1, 2, 3, 5):
            writing.setup()
            os.chmod(folder, 0o777)

            def few(most=most):
                resource.setrlimit(resource.RLIMIT_NPROC, (most, most))
                if os.geteuid() == 0:
                    os.setgid(NOBODY)
                    os.setuid(NOBODY)

            ended = run(writing.arguments, limits=few, env=dict(os.environ, RAYON_NUM_THREADS="4"))
            if ended.code == 0 and [digest(path) for path in writing.outputs] == truth:
                tally.good("done with fewer")
            else:
                tally.fail(f"{kind(ended)} with {most} processes", f"{name}: {last_line(ended)[-150:]}")
    for count, code in (("1024", 0), ("1025", 2), ("5000", 2), ("1000000000", 2), ("0", 0), ("x", 0)):
        writings["impact"].setup()
        ended = run(writings["impact"].arguments, limit=30, env=dict(os.environ, RAYON_NUM_THREADS=count))
        tally.ended(ended, {code}, f"RAYON_NUM_THREADS={count}")
    tally.show()
    return tally


def locks(writings):
    """File systems without locks: ENOLCK (NFS without its service), ENOSYS, EOPNOTSUPP."""
    tally = Tally("no locks")
    for name in ("impact", "sweep", "tabulate", "plot"):
        writing = writings[name]
        writing.setup()
        assert run(writing.arguments).code == 0
        truth = [digest(path) for path in writing.outputs]
        for error in ("ENOLCK", "ENOSYS", "EOPNOTSUPP"):
            writing.setup()
            options = ["-e", "trace=flock", "-e", f"inject=flock:error={error}"]
            code = traced(writing.arguments, options, os.devnull)
            if code == 0 and [digest(path) for path in writing.outputs] == truth:
                tally.good("done without")
            else:
                tally.fail(f"exit {code}", f"{name} {error}")
    tally.show()
    return tally


def group():
    """A group of processes of this one's, for memory: its folder, and the names of its limit and its members."""
    with open("/proc/self/cgroup") as lines:
        listed = [line.strip().split(":", 2)[1:] for line in lines]
    for controllers, path in listed:
        if "memory" in controllers.split(","):
            return f"/sys/fs/cgroup/memory{path}/attack{os.getpid()}", "memory.limit_in_bytes"
    return f"/sys/fs/cgroup{dict(listed).get('', '/')}/attack{os.getpid()}", "memory.max"


def memory(folder):
    """More memory than the group may take is refused before any work."""
    tally = Tally("memory of a group")
    place, limit = group()
    try:
        os.mkdir(place)
        with open(os.path.join(place, limit), "w") as file:
            file.write("120000000")
    except OSError as error:
        print(f"    not tried: {error}")
        return tally
    try:
        scene = write(os.path.join(folder, "large.toml"), SCENE.split("[[probe]]")[0] + SECTION)

        def join():
            with open(os.path.join(place, "cgroup.procs"), "w") as file:
                file.write(str(os.getpid()))

        ended = run(["impact", scene, "-o", os.path.join(folder, "large.h5")], limits=join)
        if ended.code == 2 and "GB of memory" in ended.err:
            tally.good("refused with the number")
        else:
            tally.fail(kind(ended), f"signal {ended.signal}: {last_line(ended)[-150:]}")
    finally:
        for _ in range(50):
            try:
                os.rmdir(place)
                break
            except OSError:
                time.sleep(0.1)
    tally.show()
    return tally


def unread(folder, writings):
    """A pipe as standard error that is full, or as standard output: signals end the program."""
    tally = Tally("streams that nobody reads")
    long = write(os.path.join(folder, "long.toml"), SWEEP.replace("samples = 2000", "samples = 9000000"))
    for name, arguments in {
        "sweep": ["sweep", long, "-o", os.path.join(folder, "long.h5")],
        "tabulate": ["tabulate", "--grid", "demo", "-o", os.path.join(folder, "long-table.h5")],
    }.items():
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            for _ in range(tries(1)):
                read, full = os.pipe()
                flags = fcntl.fcntl(full, fcntl.F_GETFL)
                fcntl.fcntl(full, fcntl.F_SETFL, flags | os.O_NONBLOCK)
                try:
                    while True:
                        os.write(full, b"." * 512)
                except BlockingIOError:
                    fcntl.fcntl(full, fcntl.F_SETFL, flags)
                child = subprocess.Popen([PROGRAM, *arguments], stdin=subprocess.DEVNULL, stdout=full, stderr=full)
                os.close(full)
                time.sleep(2.0)
                child.send_signal(number)
                try:
                    code = child.wait(MOST_S)
                    tally.good("ended by the signal") if code == -number else tally.fail(f"exit {code}", name)
                except subprocess.TimeoutExpired:
                    tally.fail("not ended", f"{name} {number.name}")
                    child.kill()
                    child.wait()
                os.close(read)
                if hidden := [file for file in os.listdir(folder) if file.startswith(".")]:
                    tally.fail("litter", " ".join(hidden))
    tally.show()
    return tally


def late(folder, writings):
    """A signal while the outputs are finished: the exit code is that of the signal, never that of a failure caused by it."""
    tally = Tally("signals at the end")
    for name in ("impact", "sweep", "tabulate", "plot"):
        writing = writings[name]
        for number in (signal.SIGTERM, signal.SIGINT):
            for call in ("fsync", "rename", "pwrite64", "write"):
                for n in range(1, tries(4) + 1):
                    writing.setup()
                    injected = f"inject={call}:signal={number.name}:when={n}"
                    code = traced(writing.arguments, ["-e", f"trace={call}", "-e", injected], os.devnull)
                    if code in (0, -number, 128 + number):
                        tally.good("ended")
                    else:
                        tally.fail(f"exit {code}", f"{name} {number.name} at {call} {n}")
    tally.show()
    return tally


def objects(folder):
    """No memory left with --json: one JSON object, and no other files than the output."""
    tally = Tally("no memory, --json")
    write(os.path.join(folder, "long.csv"), "time_s,force_n\n" + "".join(f"{i}e-9,1\n" for i in range(1_500_000)))
    scene = write(os.path.join(folder, "long.toml"), RECORD)
    for megabytes in range(30, 250, max(2, 20 // tries(1))):

        def little(megabytes=megabytes):
            resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20,) * 2)

        arguments = ["impact", scene, "-o", os.path.join(folder, "large.h5"), "--json", "--max-memory", "50"]
        ended = run(arguments, limits=little, env=ALONE)
        word = tally.ended(ended, {0, 1, 2, 75}, f"{megabytes} MB")
        lines = ended.err.strip().splitlines()
        try:
            bad = ended.code and not all("error" in json.loads(text) for text in lines[-1:])
        except ValueError:
            bad = True
        if bad and word.startswith("exit"):
            tally.fail("no object", f"{megabytes} MB: {last_line(ended)[:150]}")
        if hidden := [file for file in os.listdir(folder) if file.startswith(".")]:
            tally.fail("litter", f"{megabytes} MB: {' '.join(hidden)}")
    tally.show()
    return tally


if __name__ == "__main__":
    folder, writings = commands("system")
    for_all()
    tallies = [threads(folder, writings)]
    if shutil.which("strace"):
        tallies += [locks(writings), late(folder, writings)]
    writings["impact"].setup()
    tallies += [memory(folder), unread(folder, writings)]
    writings["impact"].setup()
    finish([*tallies, objects(folder)])
