"""The virtual file of a sweep: h5py and xarray read it as they read the copy, also from another folder."""

import shutil

import h5py
import numpy as np
import pytest
from conftest import run, run_well

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
[product.contact]
tolerance = [1e-3, 1e-4, 1e-5]
[random]
samples = 5000
seed = 5
[random.striker]
velocity_m_s = { distribution = "normal", mean = 2.0, deviation = 0.7 }
"""
# neither begins nor ends with a dimension of the sweep, but for the ends of all
CUTS = [0, 7, 4_999, 5_000, 12_345, 27_001, 30_000]


@pytest.fixture(scope="module", params=[[], ["--float32"]])
def folder(request, tmp_path_factory):
    """A folder with the parts in `100%b/out`, their copy and, in `elsewhere`, their virtual file."""
    folder = tmp_path_factory.mktemp("virtual")
    (folder / "s.toml").write_text(SWEEP)
    (folder / "100%b/out").mkdir(parents=True)
    (folder / "elsewhere").mkdir()
    for start, end in zip(CUTS, CUTS[1:], strict=False):
        part = f"100%b/out/{start}.h5"
        run_well("sweep", "s.toml", "--rows", f"{start}:{end}", "-o", part, *request.param, cwd=folder)
    run_well("sweep", "merge", "100%b/out", "-o", "copy.h5", cwd=folder)
    run_well("sweep", "merge", "100%b/out", "-o", "elsewhere/all.h5", "--virtual", cwd=folder)
    return folder


def same(one, two):
    assert list(one) == list(two)
    for name, item in one.items():
        other = two[name]
        assert {key: str(value) for key, value in item.attrs.items() if "LIST" not in key} == {
            key: str(value) for key, value in other.attrs.items() if "LIST" not in key
        }
        if isinstance(item, h5py.Group):
            same(item, other)
        else:
            assert item.dtype == other.dtype, name
            assert item[()].tobytes() == other[()].tobytes() or item.dtype.kind == "O", name
            assert item.dtype.kind != "O" or (item[()] == other[()]).all(), name


def test_h5py_reads_what_the_copy_has(folder, monkeypatch):
    monkeypatch.chdir(folder.parent)
    with h5py.File(folder / "copy.h5") as copy, h5py.File(folder / "elsewhere/all.h5") as refers:
        assert refers["results/restitution"].is_virtual and not copy["results/restitution"].is_virtual
        same(copy, refers)
        roots = dict(refers.attrs)
        assert roots.pop("parts").splitlines() == [f"../100%b/out/{start}.h5" for start in CUTS[:-1]]
        assert roots == dict(copy.attrs)
        assert 0 < refers.attrs["failed"] < 30_000


@pytest.mark.parametrize("engine", ["h5netcdf", "netcdf4"])
def test_xarray_reads_what_the_copy_has(folder, engine):
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("h5netcdf")
    pytest.importorskip("netCDF4")
    open_results = {"group": "results", "engine": engine}
    with (
        xarray.open_dataset(folder / "copy.h5", **open_results) as copy,
        xarray.open_dataset(folder / "elsewhere/all.h5", **open_results) as refers,
    ):
        xarray.testing.assert_identical(copy, refers)


def test_a_part_that_is_gone_is_no_zeros(folder, tmp_path):
    shutil.copytree(folder, tmp_path / "moved")
    moved = tmp_path / "moved"
    with h5py.File(moved / "elsewhere/all.h5") as refers:
        whole = refers["results/restitution"][()].ravel()
    (moved / "100%b/out/12345.h5").unlink()
    with h5py.File(moved / "elsewhere/all.h5") as refers:
        found, models = refers["results/restitution"][()].ravel(), refers["results/model"][()].ravel()
    assert np.isnan(found[12_345:27_001]).all() and (models[12_345:27_001] == 255).all()
    assert np.array_equal(found[:12_345], whole[:12_345], equal_nan=True)
    assert np.array_equal(found[27_001:], whole[27_001:], equal_nan=True)
    assert "refers to its parts" in run("plot", "elsewhere/all.h5", "-o", "x.svg", cwd=moved).stderr
