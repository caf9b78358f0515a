"""Traces a second: lookup in Pyrocko's store, six components interpolated multilinearly, beside ours.

    scripts/compare-pyrocko

Both sides look up one trace of six components and 300 samples at random places of a grid of 72 by 72 nodes.
"""

import subprocess
import sys
import tempfile
import time

import numpy as np
from pyrocko import gf

NODES, SAMPLES, COMPONENTS, PROBES = 72, 300, 6, 2000
SPACING = 100.0


def make_store(folder):
    """A store with made-up traces: what is timed is the lookup."""
    last = SPACING * (NODES - 1)
    config = gf.ConfigTypeA(
        id="bench",
        component_scheme="elastic10",
        ncomponents=10,
        sample_rate=10.0,
        receiver_depth=0.0,
        source_depth_min=0.0,
        source_depth_max=last,
        source_depth_delta=SPACING,
        distance_min=0.0,
        distance_max=last,
        distance_delta=SPACING,
    )
    gf.Store.create(folder, config)
    store = gf.Store(folder, "w")
    generator = np.random.default_rng(1)
    for arguments in config.iter_nodes():
        data = generator.standard_normal(SAMPLES).astype(np.float32)
        store.put(arguments, gf.GFTrace(data, itmin=0, deltat=config.deltat))
    store.close()


def measure(folder):
    store = gf.Store(folder)
    store.open()
    generator = np.random.default_rng(2)
    places = generator.uniform(0.0, SPACING * (NODES - 1.001), (PROBES, 2))
    one = np.ones(1)
    times = []
    for depth, distance in places:
        start = time.perf_counter()
        for component in range(COMPONENTS):
            arguments = (np.array([depth]), np.array([distance]), np.array([component], dtype=np.uint64))
            store.sum(arguments, 0.0 * one, one, itmin=0, nsamples=SAMPLES, interpolation="multilinear")
        times.append(time.perf_counter() - start)
    return 1.0 / np.median(times)


def main(bench):
    with tempfile.TemporaryDirectory() as parent:
        folder = f"{parent}/store"
        make_store(folder)
        theirs = measure(folder)
    text = subprocess.run([bench, "--bench"], capture_output=True, text=True, check=True).stdout
    print(f"pyrocko, 6 components, {SAMPLES} samples, 4 nodes:  {theirs:8.0f} traces a second")
    for line in text.splitlines():
        words = line.split()
        if words[:2] == ["random", "averages"]:
            median = float(words[-2])
            # the first such line is that of plain averages
            print(f"hertzlamb, 6 fields, {SAMPLES} cells, 64 nodes:    {1e6 / median:8.0f} traces a second")
            print(f"ratio {1e6 / median / theirs:.0f}")
            break
    print(text)


if __name__ == "__main__":
    main(sys.argv[1])
