"""Sweeps in Parquet beside the same in HDF5: duckdb, polars, dask and pyarrow read a folder of parts as one table."""

import json
import os
import re
import subprocess
import sys

import h5py
import numpy as np
import pytest
from conftest import PROGRAM, ROOT, run, run_well

duckdb = pytest.importorskip("duckdb")
polars = pytest.importorskip("polars")
pq = pytest.importorskip("pyarrow.parquet")

SWEEP = """
[scene.target]
material = "steel"
[scene.striker]
material = "steel"
mass_kg = 4e-3
tip_radius_m = 5e-3
[scene.contact]
model = "radiation"
[product.target]
material = ["granite", "steel"]
[list.striker]
tip_radius_m = [1e-3, 5e-3]
mass_kg = [1e-3, 4e-3]
[random]
samples = 60000
seed = 5
[random.striker]
velocity_m_s = { distribution = "normal", mean = 2.0, deviation = 0.7 }
"""
ROWS = 240_000
KEYS = ["target.material", "striker.mass_kg", "striker.tip_radius_m", "striker.velocity_m_s"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with a sweep, its HDF5 file, its Parquet file and three parts."""
    folder = tmp_path_factory.mktemp("parquet")
    (folder / "s.toml").write_text(SWEEP)
    if "built without" in run("sweep", "s.toml", "-o", "whole.parquet", cwd=folder).stderr:
        pytest.skip("the program was built without Parquet")
    run_well("sweep", "s.toml", "-o", "whole.h5", cwd=folder)
    (folder / "out").mkdir()
    for shard in (1, 2, 3):
        line = ["sweep", "s.toml", "--shard", f"{shard}/3", "-o", f"out/{shard}.parquet"]
        run_well(*line, cwd=folder)
        again = run(*line, "--skip-complete", cwd=folder)
        assert "nothing to do" in again.stdout, again.stderr
    return folder


@pytest.fixture(scope="module")
def expected(folder):
    """All columns as the HDF5 file has them, a value a row; words as texts, none where there is nothing."""
    with h5py.File(folder / "whole.h5") as file:
        results, shape = file["results"], file["results/restitution"].shape
        columns = {"row": np.arange(ROWS)}
        along = {"target.material": 0, "striker.mass_kg": 1, "striker.tip_radius_m": 1, "striker.velocity_m_s": 2}
        for key, axis in along.items():
            values = file[f"axes/{key}"]
            values = values.asstr()[()] if h5py.check_string_dtype(values.dtype) else values[()]
            columns[key] = values[np.unravel_index(np.arange(ROWS), shape)[axis]]
        for name, data in results.items():
            if data.shape == shape and name not in ("model", "failure"):
                columns[name] = data[()].ravel()
        names = results["model"].attrs["names"].split()
        columns["model"] = [None if i == 255 else names[i] for i in results["model"][()].ravel()]
        reasons = file["failures"].asstr()[()]
        columns["failure"] = [None if i < 0 else reasons[i] for i in results["failure"][()].ravel()]
    assert 100 < sum(reason is not None for reason in columns["failure"]) < ROWS // 2
    return columns


def check(found, expected):
    """The same columns with the same bits; the keys that vary come first."""
    assert sorted(found) == sorted(expected)
    assert list(found)[:5] == ["row", *KEYS]
    for name, values in expected.items():
        if name in ("target.material", "model", "failure"):
            assert list(found[name]) == list(values), name
        else:
            np.testing.assert_array_equal(np.asarray(found[name], dtype=float), values, err_msg=name)


def test_pyarrow(folder, expected):
    import pyarrow.dataset

    whole = pq.read_table(folder / "whole.parquet")
    parts = pyarrow.dataset.dataset(folder / "out", format="parquet").to_table().sort_by("row")
    for table in (whole, parts):
        columns = {name: table[name].to_numpy(zero_copy_only=False) for name in table.column_names}
        for name in ("target.material", "model", "failure"):
            columns[name] = table[name].to_pylist()
        check(columns, expected)
    # a number that is not there is none, not NaN
    assert whole["restitution"].null_count == np.isnan(expected["restitution"]).sum()
    some = pq.read_table(folder / "whole.parquet", columns=["restitution", "row"], filters=[("row", "<", 10)])
    assert some.num_rows == 10


def test_polars(folder, expected):
    frame = polars.scan_parquet(folder / "out/*.parquet").sort("row").collect()
    words = {name for name in frame.columns if frame[name].dtype == polars.String}
    assert words == {"target.material", "model", "failure"}
    check({name: frame[name].to_list() if name in words else frame[name].to_numpy() for name in frame.columns}, expected)


def test_dask(folder, expected):
    dask = pytest.importorskip("dask.dataframe")
    frame = dask.read_parquet(folder / "out", engine="pyarrow").compute().sort_values("row")
    columns = {name: frame[name].to_numpy() for name in frame.columns}
    for name in ("target.material", "model", "failure"):
        columns[name] = [word if isinstance(word, str) else None for word in columns[name]]
    check(columns, expected)


def test_duckdb(folder, expected):
    relation = duckdb.sql(f"select * from '{folder}/out/*.parquet' order by row")
    columns = {}
    for name, values in relation.fetchnumpy().items():
        none = None if name in ("target.material", "model", "failure") else np.nan
        columns[name] = np.where(np.ma.getmaskarray(values), none, np.ma.getdata(values))
    check(columns, expected)


def test_the_query_of_the_documentation_runs(folder, expected, tmp_path):
    text = (ROOT / "docs/cluster.md").read_text()
    query = re.search(r"```python\n(import duckdb\n.*?)```", text, re.DOTALL)[1]
    script = tmp_path / "query.py"
    script.write_text(query)
    done = subprocess.run([sys.executable, script], cwd=folder, capture_output=True, text=True, check=True)
    for material in ("granite", "steel"):
        of = np.asarray(expected["target.material"]) == material
        mean = np.nanmean(expected["restitution"][of])
        assert re.search(rf"{material}\D+{mean:.4f}"[:-1], done.stdout), done.stdout


def test_the_footer_has_what_the_root_of_hdf5_has(folder):
    with h5py.File(folder / "whole.h5") as file:
        root = dict(file.attrs)
        labels = {name: (data.attrs["units"], data.attrs["long_name"]) for name, data in file["results"].items()}
    whole = json.loads(pq.read_schema(folder / "whole.parquet").metadata[b"hertzlamb"])
    part = json.loads(pq.read_schema(folder / "out/2.parquet").metadata[b"hertzlamb"])
    for name in ("file_type", "software_version", "sweep", "sweep_sha256", "rows", "failed"):
        assert whole[name] == root[name], name
    assert (part["file_type"], part["shard"], part["sweep_rows"]) == ("hertzlamb sweep part", "2/3", ROWS)
    assert part["first_row"] > 0 and part["sweep_sha256"] == whole["sweep_sha256"]
    for name, label in whole["columns"].items():
        if name in labels and name not in ("model", "failure"):
            assert (label["units"], label["long_name"]) == labels[name]
    assert list(whole["columns"]) == pq.read_schema(folder / "whole.parquet").names
    file = pq.ParquetFile(folder / "whole.parquet").metadata
    assert [file.row_group(i).num_rows for i in range(file.num_row_groups)] == [131_072, ROWS - 131_072]
    assert file.row_group(0).column(5).compression == "ZSTD"


def test_parts_merge_to_the_bytes_of_one_run(folder):
    for name in ("whole.parquet", "whole.h5"):
        run_well("sweep", "merge", "out", "-o", f"merged-{name}", cwd=folder)
        assert (folder / f"merged-{name}").read_bytes() == (folder / name).read_bytes()


def test_single_precision_is_the_rounded_double(folder, expected):
    names = "restitution,peak_force_n"
    run_well("sweep", "s.toml", "--float32", "--columns", names, "-o", "single.parquet", cwd=folder)
    table = pq.read_table(folder / "single.parquet")
    assert table.column_names == ["row", *KEYS, "peak_force_n", "restitution", "model", "failure"]
    found = table["restitution"].to_numpy(zero_copy_only=False)
    assert found.dtype == np.float32
    np.testing.assert_array_equal(found, expected["restitution"].astype(np.float32))
