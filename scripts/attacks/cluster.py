"""A node of a cluster: a mask of processors, a home folder that is empty, read-only or missing, no locks for h5py.

Right is: as many threads as the mask has processors, nothing written outside the folder of the outputs, and files that
h5py opens on a file system without locks once HDF5_USE_FILE_LOCKING is FALSE (docs/cluster.md).
Masks need Linux, a home that is read-only for us a user other than root, h5py the project's .venv, and locks strace.
"""

import json
import os
import shutil
import subprocess
import time

import common
from _writing import commands
from common import ROOT, SCENE, SWEEP, WORK, Tally, digest, finish, for_all, kind, last_line, run, well, write

NOBODY = 54323
H5PY = os.path.join(ROOT, ".venv/bin/python")
ALONE = {name: value for name, value in os.environ.items() if name != "RAYON_NUM_THREADS"}
"""The environment without the number of threads that the attacks set."""


def tasks(arguments, mask):
    """The most threads of a run under a mask, which is ended after a second of work."""
    child = subprocess.Popen(
        [common.PROGRAM, *arguments],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        env=ALONE,
        preexec_fn=lambda: os.sched_setaffinity(0, mask),
    )
    most, end = 0, time.monotonic() + 1.0
    while time.monotonic() < end and child.poll() is None:
        try:
            most = max(most, len(os.listdir(f"/proc/{child.pid}/task")))
        except OSError:
            break
        time.sleep(0.01)
    child.kill()
    child.wait()
    return most


def masks(folder):
    """As many threads of work as processors in the mask: `taskset -c 0` gives one."""
    tally = Tally("masks of processors")
    processors = sorted(os.sched_getaffinity(0))
    scene = write(os.path.join(folder, "masked.toml"), SCENE)
    long = write(os.path.join(folder, "masked-sweep.toml"), SWEEP.replace("samples = 2000", "samples = 9000000"))
    # at least 2 processors: one more in the mask is one more thread
    counts = [n for n in (1, 2, 4) if n <= len(processors)]
    seen = {}
    for count in counts:
        mask = set(processors[:count])
        ended = run(["impact", scene, "--dry-run", "--json"], env=ALONE, limits=lambda mask=mask: os.sched_setaffinity(0, mask))
        planned = json.loads(ended.out)["threads"] if ended.code == 0 else None
        if planned == count:
            tally.good("planned as the mask")
        else:
            tally.fail("planned otherwise", f"{planned} threads for {count} processors")
        seen[count] = tasks(["sweep", long, "--force", "-o", os.path.join(folder, "masked.h5")], mask)
        if seen[count] - seen[1] == count - 1 and seen[count] > count:
            tally.good("worked as the mask")
        else:
            tally.fail("worked otherwise", f"{seen[count]} threads in all for {count} processors, {seen[1]} for one")
    if len(processors) == 1:
        print("    not tried: more than one processor")
    tally.show()
    return tally


def homes(folder, writings):
    """Outputs are the same with any home folder, and an empty one stays empty."""
    tally = Tally("home folders")
    home = os.path.join(WORK, "home")
    shutil.rmtree(home, ignore_errors=True)
    os.mkdir(home)
    variables = ("HOME", "XDG_CACHE_HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME")
    # with one thread the blocks of a shard are in one order
    bare = {name: value for name, value in os.environ.items() if name not in variables} | {"RAYON_NUM_THREADS": "1"}

    def as_nobody():
        os.setgid(NOBODY)
        os.setuid(NOBODY)

    for name, writing in writings.items():
        writing.setup()
        if run(writing.arguments, env=bare).code != 0:
            tally.fail("does not run at all", name)
            continue
        truth = [digest(path) for path in writing.outputs]
        for what, value, mode, limits in (
            ("empty", home, 0o755, None),
            ("read-only", home, 0o555, as_nobody if os.geteuid() == 0 else None),
            ("missing", os.path.join(WORK, "nowhere"), 0o755, None),
            ("unset", None, 0o755, None),
        ):
            writing.setup()
            os.chmod(home, mode)
            if limits:
                for place, _, files in os.walk(folder):
                    for path in (place, *(os.path.join(place, file) for file in files)):
                        os.chmod(path, 0o777)
                        os.chown(path, NOBODY, NOBODY)
            ended = run(writing.arguments, env={**bare, "HOME": value} if value else bare, limits=limits)
            if ended.code == 0 and [digest(path) for path in writing.outputs] == truth:
                tally.good(what)
            else:
                tally.fail(f"{what}: {kind(ended)}", f"{name}: {last_line(ended)[-150:]}")
            if found := os.listdir(home):
                tally.fail("written into the home folder", f"{name}: {' '.join(found)}")
    tally.show()
    return tally


def locks(folder):
    """h5py on a file system without locks: it opens files with HDF5_USE_FILE_LOCKING=FALSE only."""
    tally = Tally("h5py without locks")
    has_h5py = os.path.exists(H5PY) and subprocess.run([H5PY, "-c", "import h5py"], capture_output=True).returncode == 0
    if not has_h5py or not shutil.which("strace"):
        print("    not tried: this needs strace and h5py in .venv")
        return tally
    scene, out = write(os.path.join(folder, "locks.toml"), SCENE), os.path.join(folder, "locks.h5")
    well(["impact", scene, "-o", out])
    program = f"import h5py; h5py.File({out!r})['force'][()]"
    for error in ("ENOLCK", "EOPNOTSUPP"):
        for value, expected in ((None, False), ("BEST_EFFORT", False), ("FALSE", True)):
            env = {**os.environ, **({"HDF5_USE_FILE_LOCKING": value} if value else {})}
            command = ["strace", "-f", "-q", "-o", os.devnull, "-e", "trace=flock", "-e", f"inject=flock:error={error}"]
            ended = subprocess.run([*command, H5PY, "-c", program], env=env, capture_output=True, text=True)
            if (ended.returncode == 0) == expected and (expected or "unable to lock file" in ended.stderr):
                tally.good("opened with FALSE" if expected else "not opened otherwise, as documented")
            else:
                tally.fail(f"exit {ended.returncode}", f"{error} {value}: {ended.stderr.strip()[-150:]}")
    tally.show()
    return tally


if __name__ == "__main__":
    folder, writings = commands("cluster")
    for_all()
    tallies = [homes(folder, writings), locks(folder)]
    if hasattr(os, "sched_setaffinity"):
        tallies.append(masks(folder))
    finish(tallies)
