"""Displacements of a plate beside those of PyGRT, which integrates over wave number and frequency.

    scripts/compare-pygrt PROGRAM

A plate of 200 m, 4000 m/s, Poisson's ratio 0.25, is struck on its upper face by a force sin^4(pi t/T). PyGRT has the impulse
response of a point force in a plate with two free faces, the program a disc of a five-thousandth of the thickness.
Prints for each receiver and component the largest difference over the peak within 8 transits, and the program's own estimate.
The exit code is 1 if a difference is above 1e-4.
"""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np
from pygrt.cli import find_grt
from scipy.interpolate import CubicSpline

SPEED, DENSITY, THICKNESS, PEAK = 4000.0, 2400.0, 200.0, 1e6
SHEAR = SPEED / 3**0.5
TRANSIT, TRANSITS, LIMIT = THICKNESS / SPEED, 8, 1e-4
PULSES = (0.6, 1.5)
RECEIVERS = [(0.5, 0.0), (1.5, 0.0), (3.0, 0.0), (0.7, 0.5), (0.0, 1.0), (0.5, 1.0), (1.5, 1.0)]

# its frequencies end at 1/(2 STEP): with a step of 1/32 of a transit differences are 6e-5
STEP, SAMPLES, UP = TRANSIT / 48, 144 * TRANSITS, 6
# waves of later windows are damped by exp(-pi ZETA); the default of 0.8 leaves 8 %, and a plate never comes to rest
ZETA = 4.5
# 2 pi/(dk H): its sum over k leaves out -dk^2/12 times the plate under a uniform pressure, so that two of them are extrapolated
RINGS = 300.0


def pulse(time, length):
    inside = (time >= 0) & (time <= length)
    return np.where(inside, PEAK * np.sin(np.pi * time / length) ** 4, 0.0)


def read_sac(path):
    raw = Path(path).read_bytes()
    count = int(np.frombuffer(raw[280:440], "<i4")[9])
    return np.frombuffer(raw[632 : 632 + 4 * count], "<f4").astype(float)


def impulse_responses(folder, depth, distances, rings):
    """Of PyGRT at a depth over H: w down and u outward in m per N s, damped by exp(-wi t), by distance over H."""
    km = [x / 1e3 for x in (THICKNESS, SPEED, SHEAR, DENSITY)]
    # the last row ends the plate, whose lower face is free by -BfF
    (folder / "plate").write_text(" ".join(map(repr, km)) + "\n0 4 2 2.4\n")
    places = ",".join(f"{r * km[0]:.9g}" for r in distances)
    command = [find_grt(), "greenfn", "-Mplate", f"-D0/{depth * km[0]:.9g}", f"-R{places}", "-Ores", "-BfF", "-Gv", "-P1", "-s"]
    command += [f"-N{SAMPLES}/{STEP!r}+w{ZETA!r}+n{UP}+a+f", f"-L{rings / max(distances)!r}", "-K+k6+f+s2"]
    if depth == 0:
        command.append("-Cp")
    shutil.rmtree(folder / "res", ignore_errors=True)
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(command)}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    found = {}
    for place in filter(Path.is_dir, (folder / "res").iterdir()):
        far = float(place.name.split("_")[-1])
        up, out = (read_sac(place / f"VF{component}.sac") for component in "ZR")
        # 1e-15 cm/dyne, and its vertical is up
        found[min(distances, key=lambda r: abs(r * km[0] - far))] = 1e-12 * np.array([-up, out])
    return found


def of_pygrt(folder):
    """Impulse responses by receiver, extrapolated from two steps of wave number."""
    found = {}
    for depth in sorted({z for _, z in RECEIVERS}):
        distances = sorted({r for r, z in RECEIVERS if z == depth})
        fine, coarse = (impulse_responses(folder, depth, distances, rings) for rings in (RINGS, RINGS / 2))
        found.update({(r, depth): (4 * fine[r] - coarse[r]) / 3 for r in distances})
    return found


def under_pulse(samples, length):
    """Times and response; convolved before the damping is undone, so that what wraps round in time stays small."""
    step, damping = STEP / UP, ZETA * np.pi / (SAMPLES * STEP)
    count = samples.shape[1]
    time = np.arange(count) * step
    force = pulse(time, length) * np.exp(-damping * time)
    response = np.fft.irfft(np.fft.rfft(samples) * np.fft.rfft(force), count) * step
    return time, response * np.exp(damping * time)


def of_program(program, folder, length):
    """Times, and displacements and their estimated errors by component and receiver."""
    time, end = np.linspace(0, length, 4001), TRANSITS * TRANSIT
    np.savetxt(folder / "force.csv", np.c_[time, pulse(time, length)], delimiter=",", header="time_s,force_n", comments="")
    (folder / "scene.toml").write_text(
        f"[target]\nlongitudinal_speed_m_s = {SPEED}\nshear_speed_m_s = {SHEAR}\ndensity_kg_m3 = {DENSITY}\n"
        f"thickness_m = {THICKNESS}\nuntil_s = {end}\n[force]\nfile = 'force.csv'\n"
        f"[contact]\ndisc_radius_m = {THICKNESS / 5000}\ntolerance = 1e-5\n[output]\nduration_s = {end}\n"
        + "".join(f"[[probe]]\nr_m = {r * THICKNESS}\nz_m = {z * THICKNESS}\n" for r, z in RECEIVERS)
    )
    subprocess.run([program, "impact", "-q", "scene.toml", "-o", "out.h5", "--force"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    with h5py.File(folder / "out.h5") as file:
        probes = file["probes"]
        values, errors = (np.stack([probes[f"displacement_{c}{s}"][()] for c in "zr"]) for s in ("", "_error"))
        return probes["time"][()], values, errors


def main():
    program, above = str(Path(sys.argv[1]).resolve()), 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        theirs = of_pygrt(folder)
        print("pulse c1/H   r/H   z/H   displacement   difference   estimate   at t c1/H")
        for part in PULSES:
            time, values, errors = of_program(program, folder, part * TRANSIT)
            for i, receiver in enumerate(RECEIVERS):
                their_time, response = under_pulse(theirs[receiver], part * TRANSIT)
                inside = their_time <= time[-1]
                for c, component in enumerate("zr"):
                    if component == "r" and receiver[0] == 0:
                        continue
                    own = CubicSpline(time, values[c, i])(their_time[inside])
                    off, peak = np.abs(own - response[c, inside]), np.abs(response[c, inside]).max()
                    above += off.max() > LIMIT * peak
                    at = their_time[inside][off.argmax()] / TRANSIT
                    r, z = receiver
                    print(f"{part:10} {r:5} {z:5}   {component:12} {off.max() / peak:12.1e} {errors[c, i] / peak:10.1e} {at:11.2f}")
    return int(above > 0)


if __name__ == "__main__":
    sys.exit(main())
