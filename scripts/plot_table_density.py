"""Draws error against table size and against lookup time from the output of the example `density`.

    cargo run --release -p hertzlamb-tabulator --example density > density.csv
    python scripts/plot_table_density.py density.csv density.png
"""

import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def read(path):
    with open(path, newline="") as file:
        return [
            {key: value if key in ("axes", "storage") else float(value) for key, value in row.items()}
            for row in csv.DictReader(file)
        ]


def curve(ax, rows, x, label, **style):
    rows = sorted(rows, key=lambda row: row["megabytes"])
    ax.loglog([row[x] for row in rows], [row["p99"] for row in rows], label=label, **style)


def main(source, picture):
    rows = read(source)
    figure, axes = plt.subplots(1, 3, figsize=(15, 4.8), layout="constrained")
    colours = {2.0: "C3", 4.0: "C1", 6.0: "C2", 8.0: "C0"}
    for points, colour in colours.items():
        for name, dash in (("graded", "-"), ("uniform", "--")):
            chosen = [
                row
                for row in rows
                if row["axes"] == name and row["stencil_points"] == points and row["pulse_length"] == 10
            ]
            label = f"{points:.0f} points, {name}"
            curve(axes[0], chosen, "megabytes", label, color=colour, linestyle=dash, marker="o", markersize=4)
            if name == "graded":
                curve(axes[1], chosen, "lookup_us", label, color=colour, linestyle=dash, marker="o", markersize=4)
    for length, colour in ((3.0, "C4"), (10.0, "C0"), (40.0, "C5")):
        for storage, dash in (("f32", "-"), ("f64", ":")):
            chosen = [
                row
                for row in rows
                if row["axes"] == "graded sampled" and row["storage"] == storage and row["pulse_length"] == length
            ]
            label = f"{storage}, pulses of {length:.0f}"
            curve(axes[2], chosen, "megabytes", label, color=colour, linestyle=dash, marker="o", markersize=4)
    axes[0].set(xlabel="size of one slice / MB", ylabel="p99 of error over peak", title="pulses of 10 r0/c1: stencils and axes")
    axes[1].set(xlabel="lookup of 300 cells, 6 fields / microseconds", title="pulses of 10 r0/c1: time, graded axes")
    axes[2].set(xlabel="size of one slice / MB", title="8 points, graded: storage and pulses")
    for ax in axes:
        ax.grid(which="both", alpha=0.25)
        ax.legend(fontsize=7)
    figure.savefig(picture, dpi=130)


if __name__ == "__main__":
    main(*sys.argv[1:3])
