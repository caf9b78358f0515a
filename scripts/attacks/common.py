"""Common parts of the attacks: runs the program within limits, and counts the outcomes.

Uses Python's standard library only. All random choices follow from ATTACK_SEED; ATTACK_SHARE multiplies the number of trials.
"""

import collections
import hashlib
import os
import random
import resource
import shutil
import signal
import subprocess
import sys

ROOT = os.environ.get("ATTACK_ROOT", os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
PROGRAM = os.environ.get("HERTZLAMB", os.path.join(ROOT, "target/debug/hertzlamb"))
WORK = os.environ.get("ATTACK_WORK", f"/tmp/hertzlamb-attack.{os.getpid()}")
SCENES = os.path.join(ROOT, "scenes")
SEED = int(os.environ.get("ATTACK_SEED", "1"))
SHARE = float(os.environ.get("ATTACK_SHARE", "1"))

MOST_MEMORY_KB = 6_000_000
"""Address space of the program."""
CODES = {0, 1, 2, 75}
"""Exit codes that are documented."""

os.environ["SOURCE_DATE_EPOCH"] = "1"  # the same bytes every time
os.environ["RUST_BACKTRACE"] = "0"
os.environ.setdefault("RAYON_NUM_THREADS", "2")
resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY_KB * 1024,) * 2)
resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

GRID = """poisson_ratios = [0.3]
cell_width = 0.8
pulse_lengths = [20.0, 40.0]
stencil_points = 2
[r]
max = 2.0
spacing = 0.25
[z]
max = 2.0
spacing = 0.25
"""
"""A grid whose table takes a fraction of a second."""

SCENE = """[target]
material = "steel"
[striker]
material = "steel"
mass_kg = 4e-3
tip_radius_m = 5e-3
velocity_m_s = 1.0
[[probe]]
r_m = 1e-3
z_m = 1e-3
"""
"""A scene that takes a few milliseconds."""

SWEEP = """[scene.striker]
tip_radius_m = 0.005
material = "steel"
[scene.target]
material = "steel"
[scene.contact]
model = "hertz"
[random]
samples = 2000
seed = 5
[random.striker]
mass_kg = { distribution = "normal", mean = 4e-3, deviation = 2e-3 }
velocity_m_s = { distribution = "log_uniform", low = 0.1, high = 10.0 }
"""
"""A sweep of draws without waves."""

Ended = collections.namedtuple("Ended", "code signal hung busy_s rss_mb out err")
"""How a run ended: `code` is None where a signal ended it."""


def tries(count):
    """A number of tries, multiplied by ATTACK_SHARE."""
    return max(1, round(count * SHARE))


def rng(name):
    """Random choices of one part, the same for the same seed."""
    return random.Random(f"{SEED} {name}")


def fresh(name):
    """An empty folder."""
    folder = os.path.join(WORK, name)
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    return folder


def write(path, text):
    """Writes text or bytes into a file and gives its path."""
    with open(path, "wb") as file:
        file.write(text if isinstance(text, bytes) else text.encode())
    return path


def for_all():
    """Puts the program where every user may run it, and opens the folder of the attacks to them."""
    global PROGRAM
    os.makedirs(WORK, exist_ok=True)
    os.chmod(WORK, 0o755)
    PROGRAM = shutil.copy(PROGRAM, os.path.join(WORK, "hertzlamb"))


def digest(path):
    """SHA-256 of a file, None where there is none."""
    try:
        with open(path, "rb") as file:
            return hashlib.sha256(file.read()).hexdigest()
    except OSError:
        return None


def run(arguments, limit=60.0, cwd=None, env=None, stdin=subprocess.DEVNULL, limits=None):
    """Runs the program to its end, `limit` seconds at most; `limits` is called in the child before it starts."""
    os.makedirs(WORK, exist_ok=True)
    tag = os.path.join(WORK, f".run.{os.getpid()}")
    with open(tag + ".out", "w+b") as out, open(tag + ".err", "w+b") as err:
        child = subprocess.Popen(
            [PROGRAM, *map(str, arguments)], stdin=stdin, stdout=out, stderr=err, cwd=cwd, env=env, preexec_fn=limits
        )
        hung = []

        def kill(*_):
            hung.append(True)
            os.kill(child.pid, signal.SIGKILL)

        signal.signal(signal.SIGALRM, kill)
        signal.setitimer(signal.ITIMER_REAL, limit)
        _, status, usage = os.wait4(child.pid, 0)
        signal.setitimer(signal.ITIMER_REAL, 0)
        child.returncode = 0
        # a busy machine takes longer, not more of the processor
        busy_s = usage.ru_utime + usage.ru_stime
        out.seek(0), err.seek(0)
        texts = [file.read(400_000).decode("utf-8", "replace") for file in (out, err)]
    code = os.waitstatus_to_exitcode(status)
    ended = -code if code < 0 else None
    return Ended(None if ended else code, ended, bool(hung), busy_s, usage.ru_maxrss / 1024, *texts)


def well(arguments, **how):
    """Runs the program for the set-up of an attack; it must succeed."""
    ended = run(arguments, **how)
    if ended.code != 0:
        sys.exit(f"attack: {' '.join(map(str, arguments))} ended with {ended.code}: {ended.err.strip()[-300:]}")
    return ended


def last_line(ended):
    """What the program said last on standard error."""
    lines = ended.err.strip().splitlines()
    return lines[-1] if lines else ""


def kind(ended, most_mb=2000):
    """How a run ended in one word: hung, crashed, memory, unclear (a failure without a sentence) or exit N."""
    if ended.hung:
        return "hung"
    if ended.signal or "panicked" in ended.err or ended.code not in CODES:
        return "crashed"
    if ended.rss_mb > most_mb:
        return "memory"
    if ended.code and not any(head in ended.err for head in ("error: ", '{"error":')):
        return "unclear"
    return f"exit {ended.code}"


class Tally:
    """Counts by class; classes named bad fail the part."""

    def __init__(self, name):
        self.name, self.counts, self.bad = name, collections.Counter(), collections.Counter()
        self.notes = collections.Counter()

    def good(self, what, count=1):
        self.counts[what] += count

    def fail(self, what, note=""):
        """Counts an outcome that must not occur, with a note."""
        self.counts[what] += 1
        self.bad[what] += 1
        if note:
            self.notes[f"{what}: {note}"] += 1

    def ended(self, ended, allowed=CODES, note=""):
        """Counts how a run ended; anything but the exit codes allowed fails."""
        word = kind(ended)
        if word.startswith("exit") and ended.code in allowed:
            self.good(word)
        else:
            self.fail(word, f"{note} {last_line(ended)[-200:]}".strip())
        return word

    def show(self):
        """Prints the counts."""
        words = ", ".join(f"{count} {what}" for what, count in self.counts.items())
        print(f"{self.name}: {words or 'nothing tried'}", flush=True)
        for note, count in self.notes.most_common(8):
            print(f"    {count} x {note.replace(WORK, '')}", flush=True)
        return not self.bad


def finish(tallies):
    """Ends a part: with 1 where a tally has a class that must not occur."""
    bad = sum(sum(tally.bad.values()) for tally in tallies)
    total = collections.Counter()
    for tally in tallies:
        total.update(tally.bad)
    if bad:
        print("FAILED: " + ", ".join(f"{count} {what}" for what, count in total.items()), flush=True)
    shutil.rmtree(WORK, ignore_errors=True)
    sys.exit(1 if bad else 0)
