#!/usr/bin/env python3
"""Reads a results file of `hertzlamb impact` and prints its contents, its largest force and its probes."""

import argparse
import sys

import h5py
import numpy as np


def open_results(path):
    """Opens the file; exits with a message for another kind of file."""
    try:
        file = h5py.File(path, "r")
    except OSError as error:
        sys.exit(f"{path} cannot be read as HDF5: {str(error).splitlines()[0]}")
    kind = file.attrs.get("file_type", "a file of another program")
    if kind != "hertzlamb results":
        sys.exit(f"{path} is {kind!r}, not the results of an impact")
    if file.attrs["format_version"].split(".")[0] != "1":
        sys.exit(f"{path} has the format version {file.attrs['format_version']}; this script reads 1.x")
    return file


def print_attributes(file):
    for name, value in file.attrs.items():
        lines = str(value).strip().splitlines() or [""]
        print(f"  {name} = {lines[0]}" + (f" ... ({len(lines)} lines)" if len(lines) > 1 else ""))


def print_datasets(file):
    def visit(name, item):
        if isinstance(item, h5py.Dataset):
            line = f"  /{name:<42} {str(item.shape):<16} {item.attrs.get('units', ''):<5}"
            if item.size and np.issubdtype(item.dtype, np.floating):
                line += f" {np.nanmin(item[()]):12.5g} .. {np.nanmax(item[()]):.5g}"
            print(line.rstrip())

    file.visititems(visit)


def main(path):
    with open_results(path) as file:
        print_attributes(file)
        print("datasets: shape, unit, smallest .. largest")
        print_datasets(file)
        time_s, force_n = file["time"][()], file["force"][()]
        peak = force_n.argmax()
        print(f"peak force {force_n[peak]:.6g} N at {time_s[peak] * 1e6:.4g} us")
        for number, (r_m, z_m) in enumerate(zip(file.get("probes/r", ()), file.get("probes/z", ())), 1):
            displacement_m = file["probes/displacement_z"][number - 1]
            print(f"probe {number} at r = {r_m:g} m, z = {z_m:g} m moves {np.abs(displacement_m).max():.4g} m down or up")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("path", metavar="RESULTS.h5")
    main(parser.parse_args().path)
