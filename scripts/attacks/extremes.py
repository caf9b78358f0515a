"""Numbers at the limits of a scene and of a float: expected are finite results with an error below one half, or a message."""

import json
import math
import os
import re

from common import SCENES, Tally, finish, fresh, last_line, rng, run, tries, write

NUMBERS = """5e-324 1e-310 2.3e-308 1e-300 1e-160 1e-100 1e-30 1e-15 1e-9 1e-3 0.4999999999999999 0.5 1 1e3 1e6 1e9 1e15
1e30 1e100 1e155 1e160 1e200 1e300 1.7e308 0 -1 nan inf -inf""".split()
NUMBER = re.compile(r"(?<![\w.\"-])-?\d[\d_]*(?:\.\d+)?(?:[eE][-+]?\d+)?(?![\w\"])")
MODELS = ("hertz", "radiation", "quasi_static", "quasi_static_radiation", "area_dashpot", "wave", "growing", "auto")
MOST_S = 20.0
MOST_MB = 2000


def read(name):
    """A scene without its comments."""
    with open(os.path.join(SCENES, name)) as file:
        return "\n".join(line.split("#")[0].rstrip() for line in file) + "\n"


def starts():
    rod = read("copper-on-steel.toml").split("[[probe]]")[0]
    probe = "[[probe]]\nr_m = 0.004\nz_m = 0.001\n"
    found = [read("ball-drop.toml"), rod + probe, read("prescribed-force.toml")]
    for model in MODELS:
        text = rod.replace('model = "wave"', f'model = "{model}"')
        if model in ("growing", "area_dashpot"):
            text = "\n".join(line for line in text.splitlines() if "disc_radius_m" not in line) + "\n"
        found.append(text + probe)
    found.append(rod.replace('"implicit"', '"explicit"').replace("tolerance = 1e-4", "step_s = 1.35e-7"))
    return found


def changed(text, choice):
    """One or two numbers replaced."""
    for _ in range(choice.choice([1, 1, 2])):
        hits = list(NUMBER.finditer(text))
        hit = choice.choice(hits)
        number = choice.choice(NUMBERS) if choice.random() < 0.6 else f"{10 ** choice.uniform(-30, 30):.3g}"
        text = text[: hit.start()] + number + text[hit.end() :]
    return text


def wrong(text):
    """What cannot be right in a report, or nothing."""
    try:
        report = json.loads(text, parse_constant=lambda word: math.nan)
    except ValueError:
        return "no JSON"
    numbers = {k: v for k, v in report.items() if isinstance(v, float)}
    if any(not math.isfinite(v) for v in numbers.values()):
        return "not finite"
    struck = report["model"] != "prescribed"
    for key in ("peak_force_n", "contact_time_s", "peak_displacement_m", "restitution", "initial_energy_j"):
        if struck and report.get(key) is None:
            return f"{key} is null"
    if struck and not 0 <= report["restitution"] <= 1.001:
        return f"restitution {report['restitution']}"
    if struck and not 0 <= report["relative_error_estimate"] <= 0.5:
        return f"error {report['relative_error_estimate']}"
    return ""


if __name__ == "__main__":
    folder, choice = fresh("extremes"), rng("extremes")
    with open(os.path.join(SCENES, "pulse.csv"), "rb") as file:
        write(os.path.join(folder, "pulse.csv"), file.read())
    tally, texts = Tally("extremes"), starts()
    for index in range(tries(600)):
        path = write(os.path.join(folder, "s.toml"), changed(texts[index % len(texts)], choice))
        ended = run(["impact", path, "--json"], limit=60)
        with open(path) as file:
            note = " ".join(file.read().split())[-200:]
        fault = wrong(ended.out) if ended.code == 0 else ""
        if fault:
            tally.fail("absurd", f"{fault}: {note}")
        elif ended.rss_mb > MOST_MB or ended.busy_s > MOST_S:
            tally.fail("exploding", f"{ended.rss_mb:.0f} MB, {ended.busy_s:.1f} s: {last_line(ended)[:100]} {note}")
        else:
            tally.ended(ended, {0, 1, 2}, note)
    tally.show()
    finish([tally])
