#!/usr/bin/env python3
"""Steps through the section of a results file with pyvista, as ParaView does, and prints the range of each frame.

`hertzlamb plot waves.vtkhdf -o waves.svg` draws the section.
"""

import argparse
import sys

import h5py

try:
    import pyvista
except ImportError:
    pyvista = None


def times(path):
    """Times of the frames in s; exits with a message for another kind of file."""
    try:
        with h5py.File(path, "r") as file:
            kind = file.attrs.get("file_type", "a file of another program")
            if kind != "hertzlamb results" or "VTKHDF" not in file:
                sys.exit(f"{path} is {kind!r} without a section: give the scene a [map]")
            return file["map/time"][()]
    except OSError as error:
        sys.exit(f"{path} cannot be read as HDF5: {str(error).splitlines()[0]}")


def frames(path):
    """Yields (time in s, mesh) of every frame; x is the distance from the axis, y minus the depth."""
    if pyvista is None:
        sys.exit("pyvista is not installed: .venv/bin/python -m pip install -r scripts/requirements/pyvista.txt")
    if not path.endswith(".vtkhdf"):
        sys.exit(f"{path} does not end in .vtkhdf, by which pyvista and ParaView know the format")
    known = times(path)
    reader = pyvista.HDFReader(path).reader
    reader.UpdateInformation()
    for step, time_s in enumerate(known):
        reader.SetStep(step)
        reader.Update()
        yield time_s, pyvista.wrap(reader.GetOutputDataObject(0)).copy()


def main(path, field):
    for time_s, mesh in frames(path):
        if field not in mesh.point_data:
            sys.exit(f"{field} is not in {path}; it has {', '.join(mesh.point_data.keys())}")
        low, high = mesh.get_data_range(field)
        print(f"{time_s * 1e6:10.4f} us   {field} {low:12.5g} .. {high:.5g}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("path", metavar="RESULTS.vtkhdf")
    parser.add_argument("field", metavar="FIELD", nargs="?", default="stress_zz")
    arguments = parser.parse_args()
    main(arguments.path, arguments.field)
