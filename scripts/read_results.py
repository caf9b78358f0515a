#!/usr/bin/env python3
"""Prints what a results file of `hertzlamb impact` holds.

.venv/bin/python scripts/read_results.py impact.h5
"""

import sys

import h5py
import numpy as np


def text(value):
    """An attribute as one line: HDF5 strings arrive as bytes or str, scalars as numpy numbers."""
    if isinstance(value, bytes):
        value = value.decode()
    lines = str(value).strip().splitlines()
    return lines[0] + (f" ... ({len(lines)} lines)" if len(lines) > 1 else "") if lines else ""


def print_attributes(file):
    for name, value in file.attrs.items():
        print(f"  {name} = {text(value)}")


def print_datasets(file):
    def visit(name, item):
        if isinstance(item, h5py.Dataset):
            unit = text(item.attrs.get("units", ""))
            line = f"  /{name:<32} {str(item.shape):<14} {unit:<5}"
            if item.size and np.issubdtype(item.dtype, np.floating):
                line += f" {np.nanmin(item[()]):12.5g} .. {np.nanmax(item[()]):.5g}"
            print(line.rstrip())

    file.visititems(visit)


def main(path):
    with h5py.File(path, "r") as file:
        print(path)
        print_attributes(file)
        print("datasets: shape, unit, smallest .. largest")
        print_datasets(file)
        time, force = file["time"][()], file["force"][()]
        peak = force.argmax()
        print(f"peak force {force[peak]:.6g} N at {time[peak] * 1e6:.4g} us")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: read_results.py RESULTS.h5")
    main(sys.argv[1])
