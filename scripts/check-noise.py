"""Long checks of `hertzlamb noise`: see scripts/check-noise.

Usage: check-noise.py COMMAND [campbell|million|same]...
"""

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import h5py
import numpy as np

BODIES = """
[target]
material = "granite"
quality_factor = 20.0
reference_frequency_hz = 100.0
[striker]
material = "granite"
shape = "ball"
velocity_m_s = 1.0
"""


def run(command, folder, text, name="out", threads=None, kill_after=None):
    """The results of a noise file, and the time of the command in s."""
    noise, out = folder / f"{name}.toml", folder / f"{name}.h5"
    noise.write_text(text)
    environment = dict(os.environ) if threads is None else dict(os.environ, RAYON_NUM_THREADS=str(threads))
    start = time.time()
    process = subprocess.Popen([command, "noise", noise, "-o", out, "--quiet"], env=environment, stdout=subprocess.DEVNULL)
    if kill_after:
        time.sleep(kill_after)
        process.kill()
        process.wait()
        return None
    if process.wait():
        raise SystemExit(f"the command failed on {noise}")
    return out, time.time() - start


def campbell(command, folder):
    """Mean periodograms of 200 records of a second against the spectrum."""
    worst = 0.0
    step, samples, records = 5e-4, 2048, 200
    text = BODIES + f"""
diameter_m = 0.02
[area]
shape = "disc"
radius_m = 60.0
inner_radius_m = 3.0
rate_per_m2_s = 1.0
[[receiver]]
x_m = 0.0
y_m = 0.0
[[receiver]]
x_m = 80.0
y_m = 0.0
[output]
frequencies_hz = {{ from = {1 / (samples * step)}, to = {0.5 / step}, count = {samples // 2} }}
"""
    with h5py.File(run(command, folder, text)[0]) as file:
        frequency, expected = file["frequency"][()], file["vertical_velocity"][()]
    window = np.sin(np.pi * (np.arange(samples) + 0.5) / samples) ** 2
    powers = []
    # each record has a seed of its own
    for seed in range(records):
        recording = f"duration_s = {samples * step}\nstep_s = {step}\nseed = {seed}\n"
        few = text.replace(f"count = {samples // 2}", "count = 2")
        with h5py.File(run(command, folder, few + recording, f"record{seed}")[0]) as file:
            spectrum = np.fft.rfft(window * file["traces/velocity"][()])[:, 1:]
        powers.append(2 * step * np.abs(spectrum) ** 2 / np.sum(window**2))
        (folder / f"record{seed}.h5").unlink()
    powers = np.array(powers)
    for receiver, name in enumerate(["3 m inside", "20 m outside"]):
        for low, high in [(10, 50), (50, 150), (150, 400), (400, 950)]:
            band = (frequency >= low) & (frequency < high)
            own = powers[:, receiver, band].mean(axis=1) / expected[receiver, band].mean()
            off = 10 * np.log10(own.mean())
            error = 10 / np.log(10) * own.std() / np.sqrt(records)
            worst = max(worst, abs(off) - 3 * error)
            print(f"campbell, receiver {name}, {low} to {high} Hz: {off:+.3f} dB +- {error:.3f}")
    return worst < 0.1


def million(command, folder):
    """A million listed impacts at ten receivers on one thread."""
    random = np.random.default_rng(1)
    count, receivers = 1_000_000, 10
    columns = [random.uniform(0, 10, count), random.uniform(-100, 100, count), random.uniform(5, 35, count)]
    columns += [0.02 * np.exp(0.4 * random.normal(size=count)), np.exp(0.3 * random.normal(size=count))]
    header = "time_s,x_m,y_m,diameter_m,velocity_m_s"
    np.savetxt(folder / "impacts.csv", np.c_[tuple(columns)], delimiter=",", header=header, comments="", fmt="%.7g")
    places = "".join(f"[[receiver]]\nx_m = {10 * i}\ny_m = 0.0\n" for i in range(receivers))
    text = BODIES.replace("velocity_m_s = 1.0\n", "") + f"""
[impacts]
file = "impacts.csv"
{places}
[output]
frequencies_hz = {{ from = 1.0, to = 100.0, count = 100, spacing = "log" }}
duration_s = 10.0
"""
    spectra_s = run(command, folder, text, threads=1)[1]
    print(f"million impacts, ten receivers, 100 frequencies, one thread: {spectra_s:.1f} s")
    traces_s = run(command, folder, text + "step_s = 0.005\n", "traces", threads=1)[1]
    print(f"the same with traces of 2,000 samples: {traces_s:.1f} s")
    return spectra_s < 60 and traces_s - spectra_s < 300


def same(command, folder):
    """The same bytes on any number of threads, and after a kill."""
    text = BODIES + """
diameter_m = 0.02
[area]
shape = "strip"
length_m = 200.0
width_m = 10.0
y_m = 20.0
rate_per_m2_s = 2.0
[[receiver]]
x_m = 0.0
y_m = 0.0
[[receiver]]
x_m = 5.0
y_m = 20.0
z_m = 0.3
[output]
frequencies_hz = [10.0, 50.0, 100.0]
duration_s = 40.0
step_s = 0.002
seed = 4
"""
    files = {}
    for threads in (1, 2, 5):
        files[threads], took = run(command, folder, text, f"threads{threads}", threads)
    part, out = folder / "killed.h5.part", folder / "killed.h5"
    run(command, folder, text, "killed", kill_after=0.6 * took)
    kept = part.stat().st_size if part.exists() else 0
    run(command, folder, text, "killed")
    contents = {path.read_bytes() for path in [*files.values(), out]}
    print(f"same: {len(contents)} different file of 4; {kept} bytes of tiles were kept by the killed run")
    return len(contents) == 1 and kept > 1000 and not part.exists()


def main(command, wanted):
    checks = {"campbell": campbell, "million": million, "same": same}
    good = True
    for name in wanted or checks:
        with tempfile.TemporaryDirectory() as folder:
            good &= checks[name](command, Path(folder))
    print("passed" if good else "FAILED")
    return not good


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
