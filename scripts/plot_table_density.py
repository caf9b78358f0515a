"""Draws the error over table size and over lookup time, from the output of the example `density`.

    scripts/measure-table-density      makes the data and calls this script
    python scripts/plot_table_density.py density.csv density.png
"""

import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import LogLocator, NullFormatter, ScalarFormatter

COLOURS = {2.0: "C3", 4.0: "C1", 6.0: "C2", 8.0: "C0"}
TEXTS = ("axes", "storage")
LENGTH = 10.0


def read(path):
    with open(path, newline="") as file:
        return [
            {key: value if key in TEXTS else float(value) for key, value in row.items()} for row in csv.DictReader(file)
        ]


def chosen(rows, **wanted):
    picked = [row for row in rows if all(row[key] == value for key, value in wanted.items())]
    return sorted(picked, key=lambda row: row["megabytes"])


def curve(ax, rows, x, **style):
    ax.loglog([row[x] for row in rows], [row["p99"] for row in rows], marker="o", markersize=4, **style)


def stencils(ax, rows, x, names):
    for points, colour in COLOURS.items():
        for name, dash in names:
            picked = chosen(rows, axes=name, stencil_points=points, pulse_length=LENGTH)
            curve(ax, picked, x, label=f"{points:.0f} points, {name}", color=colour, linestyle=dash)


def main(source, picture):
    rows = read(source)
    figure, axes = plt.subplots(1, 3, figsize=(16, 6.2), layout="constrained")
    stencils(axes[0], rows, "megabytes", (("graded", "-"), ("uniform", "--")))
    axes[0].set(
        xlabel="size of one slice / MB",
        ylabel="error over the peak in time, 99 % quantile",
        title="Stencils and axes, pulses of 10 r0/c1",
    )
    stencils(axes[1], rows, "lookup_us", (("graded", "-"),))
    axes[1].set(
        xlabel="median lookup of 300 cells, 6 fields / microseconds",
        title="Time of a lookup, graded axes, pulses of 10 r0/c1",
    )
    for length, colour in ((3.0, "C4"), (10.0, "C0"), (40.0, "C5")):
        # Open squares under filled dots: equal errors stay visible.
        for storage, style in (
            ("f64", {"linestyle": ":", "marker": "s", "markersize": 7, "fillstyle": "none"}),
            ("f32", {"linestyle": "-", "marker": "o", "markersize": 4}),
        ):
            picked = chosen(rows, axes="graded sampled", storage=storage, pulse_length=length)
            xs, ys = [row["megabytes"] for row in picked], [row["p99"] for row in picked]
            axes[2].loglog(xs, ys, color=colour, label=f"{storage}, pulses of {length:.0f}", **style)
    axes[2].set(xlabel="size of one slice / MB", title="Storage, 8 points, graded axes, sampled places")
    for ax in axes:
        ax.grid(which="major", alpha=0.4)
        ax.grid(which="minor", alpha=0.12)
        ax.yaxis.set_major_locator(LogLocator(numticks=20))
        ax.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5), numticks=20))
        ax.xaxis.set_major_formatter(ScalarFormatter())
        ax.xaxis.set_minor_formatter(NullFormatter())
        # Below the plot: nothing is hidden.
        ax.legend(fontsize=9, loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=2, frameon=False)
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main(*sys.argv[1:3])
