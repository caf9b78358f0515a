"""Traces per second: lookups in Pyrocko's store, six components interpolated multilinearly, and in our table.

    scripts/compare-pyrocko

Both look up traces of six components and 300 samples at random places in a grid of 72 by 72 nodes.
"""

import re
import subprocess
import sys
import tempfile
import time

import numpy as np
from pyrocko import gf

NODES, SAMPLES, COMPONENTS, PROBES = 72, 300, 6, 2000
SPACING = 100.0


def make_store(folder):
    """A store with made-up traces, for the timing of lookups."""
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


def measure_engine(parent):
    """The same through Pyrocko's documented interface: one source, six targets."""
    engine = gf.LocalEngine(store_superdirs=[parent])
    generator = np.random.default_rng(3)
    orientations = [(0.0, 0.0), (90.0, 0.0), (0.0, 90.0), (45.0, 0.0), (45.0, 45.0), (90.0, 45.0)]
    times = []
    for depth, distance in generator.uniform(SPACING, SPACING * (NODES - 1.001), (PROBES // 4, 2)):
        source = gf.MTSource(depth=depth, mnn=1.0, mee=0.5, mdd=0.3, mne=0.1, mnd=0.2, med=0.1)
        targets = [
            gf.Target(
                quantity="displacement",
                store_id="bench",
                north_shift=distance,
                interpolation="multilinear",
                azimuth=azimuth,
                dip=dip,
                codes=("", "", "", str(index)),
            )
            for index, (azimuth, dip) in enumerate(orientations)
        ]
        start = time.perf_counter()
        engine.process(source, targets)
        times.append(time.perf_counter() - start)
    return 1.0 / np.median(times)


def main(bench):
    with tempfile.TemporaryDirectory() as parent:
        folder = f"{parent}/bench"
        make_store(folder)
        store, engine = measure(folder), measure_engine(parent)
    text = subprocess.run([bench, "--bench"], capture_output=True, text=True, check=True).stdout
    # the first line of random places is that of plain averages
    median = next(float(line.split()[-2]) for line in text.splitlines() if line.split()[:2] == ["random", "averages"])
    both = float(re.search(r"one thread, (\d+) on two", text)[1])
    print(f"pyrocko, 6 components, {SAMPLES} samples, 4 nodes, LocalEngine  {engine:8.0f} traces a second")
    print(f"pyrocko, the same, bare Store.sum                        {store:8.0f}")
    for name, ours in (("one core", 1e6 / median), ("two cores", both)):
        print(f"hertzlamb, 6 fields, {SAMPLES} cells, 64 nodes, {name:9}        {ours:8.0f}")
        print(f"    {ours / engine:.0f} times LocalEngine, {ours / store:.0f} times Store.sum")
    print(text)


if __name__ == "__main__":
    main(sys.argv[1])
