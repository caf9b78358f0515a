#!/usr/bin/env python3
"""Draws a results file of `hertzlamb impact`: the impact above, the probes' displacements and stresses below.

.venv/bin/python scripts/plot_results.py impact.h5 impact.png
"""

import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

DISPLACEMENTS = {"displacement_z": "$w$, µm", "displacement_r": "$u$, µm"}
STRESSES = {"stress_zz": r"$\sigma_{zz}$, MPa", "stress_rr": r"$\sigma_{rr}$, MPa"}


def draw_impact(axes, file):
    time_us = file["time"][()] * 1e6
    axes[0].plot(time_us, file["force"][()] / 1e3, color="black")
    axes[0].set_ylabel("contact force, kN")
    for name, label in {"displacement": "striker", "deflection": "block"}.items():
        if name in file:
            axes[1].plot(time_us, file[name][()] * 1e6, label=label)
    axes[1].set_ylabel("displacement, µm")
    if axes[1].lines:
        axes[1].legend()


def draw_probes(axis, file, name, label, scale):
    probes = file["probes"]
    time_us = file["time"][()] * 1e6
    for r, z, history in zip(probes["r"], probes["z"], probes[name]):
        axis.plot(time_us, history * scale, label=f"r = {r * 1e3:g} mm, z = {z * 1e3:g} mm")
    axis.set_ylabel(label)


def main(results, picture):
    with h5py.File(results, "r") as file:
        has_probes = "probes" in file and len(file["probes/r"]) > 0
        rows = 3 if has_probes else 1
        figure, axes = plt.subplots(rows, 2, figsize=(11, 3.2 * rows), sharex=True, squeeze=False, layout="constrained")
        draw_impact(axes[0], file)
        if has_probes:
            for axis, (name, label) in zip(axes[1], DISPLACEMENTS.items()):
                draw_probes(axis, file, name, label, 1e6)
            for axis, (name, label) in zip(axes[2], STRESSES.items()):
                draw_probes(axis, file, name, label, 1e-6)
            axes[1, 0].legend(fontsize="x-small")
    for axis in axes[-1]:
        axis.set_xlabel("time, µs")
    figure.savefig(picture, dpi=150)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: plot_results.py RESULTS.h5 PICTURE.png (or .svg, .pdf)")
    main(*sys.argv[1:])
