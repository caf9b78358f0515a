#!/usr/bin/env python3
"""Draws frames of the section in a results file of `hertzlamb impact`, read with pyvista as ParaView reads it.

Needs pyvista: .venv/bin/python -m pip install -r scripts/requirements/pyvista.txt
.venv/bin/python scripts/plot_section.py section.vtkhdf section.png [FIELD]
"""

import sys

import h5py
import numpy as np
import pyvista

FIELDS = ("displacement_r", "displacement_z", "stress_rr", "stress_tt", "stress_zz", "stress_rz")


def frames(path):
    """Yields (time in s, mesh) of every frame."""
    reader = pyvista.HDFReader(path).reader
    reader.UpdateInformation()
    with h5py.File(path, "r") as file:
        times = file["map/time"][()]
    for step, time in enumerate(times):
        reader.SetStep(step)
        reader.Update()
        mesh = pyvista.wrap(reader.GetOutputDataObject(0)).copy()
        missing = [name for name in FIELDS if name not in mesh.point_data]
        if missing:
            sys.exit(f"{path}: frame {step} has no {', '.join(missing)}")
        yield time, mesh


def front(path, time):
    """The P, S and Rayleigh fronts at a time as contours of the arrival times."""
    with h5py.File(path, "r") as file:
        arrival, r, z = (file[f"map/{name}"][()] for name in ("arrival", "r", "z"))
    grid = pyvista.ImageData(
        dimensions=(len(r), len(z), 1), origin=(r[0], -z[0], 1e-6), spacing=(r[1] - r[0], z[0] - z[1], 1.0)
    )
    lines = []
    for which, name in enumerate("PSR"):
        if name == "R":
            continue
        grid.point_data[name] = arrival[which].ravel()
        line = grid.contour([time], scalars=name)
        if line.n_points:
            lines.append(line)
    return lines


def main(path, picture, field="stress_zz"):
    if field not in FIELDS:
        sys.exit(f"{field} is not one of {', '.join(FIELDS)}")
    meshes = list(frames(path))
    shown = np.linspace(len(meshes) // 8, len(meshes) - 1, 4).astype(int)
    largest = max(np.abs(mesh[field]).max() for _, mesh in meshes)
    plotter = pyvista.Plotter(shape=(2, 2), off_screen=True, window_size=(1200, 1100))
    for place, index in enumerate(shown):
        time, mesh = meshes[index]
        plotter.subplot(place // 2, place % 2)
        scale = 0.25 * largest
        plotter.add_mesh(mesh, scalars=field, cmap="RdBu_r", clim=(-scale, scale), copy_mesh=True)
        for line in front(path, time):
            plotter.add_mesh(line, color="black", line_width=1)
        plotter.add_text(f"{time * 1e6:.2f} us", font_size=12)
        plotter.view_xy()
        plotter.camera.tight(padding=0.05)
    plotter.screenshot(picture)
    print(f"{len(meshes)} frames, {field} up to {largest:.4g}; {picture}")


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit("usage: plot_section.py RESULTS PICTURE.png [FIELD]")
    main(*sys.argv[1:])
