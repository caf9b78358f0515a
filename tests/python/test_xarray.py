"""Every group of results and sweeps opens with xarray, by both of its engines, with coordinates and units."""

import h5py
import numpy as np
import pytest
from conftest import run_well

xarray = pytest.importorskip("xarray")
pytest.importorskip("h5netcdf")
pytest.importorskip("netCDF4")

ENGINES = ["h5netcdf", "netcdf4"]

SCENE = """
[target]
material = "steel"
[striker]
material = "copper"
mass_kg = 0.0122
tip_radius_m = 0.004
velocity_m_s = 10.0
[contact]
tolerance = 1e-3
[[probe]]
r_m = 0.004
z_m = 0.004
[[probe]]
r_m = 0.01
z_m = 0.0
[map]
r_max_m = 0.012
z_max_m = 0.01
points = [7, 6]
frames = 9
"""

SWEEP = """
[scene.target]
material = "steel"
[scene.striker]
tip_radius_m = 0.005
[product.striker]
velocity_m_s = [0.5, 1.0, 2.0]
material = ["steel", "copper"]
[list.contact]
tolerance = [1e-4, 1e-3]
loss_tolerance = [1e-2, 1e-1]
[random]
samples = 5
[random.striker]
mass_kg = { distribution = "uniform", low = 1e-3, high = 2e-3 }
"""


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    folder = tmp_path_factory.mktemp("xarray")
    (folder / "scene.toml").write_text(SCENE)
    run_well("impact", folder / "scene.toml", "-o", folder / "out.vtkhdf", "--csv", folder / "out.csv")
    return folder / "out.vtkhdf"


@pytest.fixture(scope="module")
def sweep(tmp_path_factory):
    folder = tmp_path_factory.mktemp("xarray-sweep")
    (folder / "sweep.toml").write_text(SWEEP)
    run_well("sweep", folder / "sweep.toml", "-o", folder / "sweep.h5")
    return folder / "sweep.h5"


def groups(path):
    found = ["/"]
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: found.append(f"/{name}") if isinstance(item, h5py.Group) else None)
    return found


@pytest.mark.parametrize("engine", ENGINES)
def test_every_group_opens(results, sweep, engine):
    for path in (results, sweep):
        for group in groups(path):
            with xarray.open_dataset(path, group=group, engine=engine) as data:
                data.load()


@pytest.mark.parametrize("engine", ENGINES)
def test_results_have_coordinates_and_units(results, engine):
    expected = {
        "/": {"force": (("time",), {"time"}, "N")},
        "/energy": {"radiated": (("time",), {"time"}, "J")},
        "/probes": {
            "stress_zz": (("probe", "time"), {"probe", "time", "r", "z"}, "Pa"),
            "displacement_r_error": (("probe",), {"probe", "r", "z"}, "m"),
        },
        "/map": {
            "displacement_z": (("time", "z", "r"), {"time", "z", "r"}, "m"),
            "stress_rz_error": (("z", "r"), {"z", "r"}, "Pa"),
        },
    }
    for group, variables in expected.items():
        with xarray.open_dataset(results, group=group, engine=engine, decode_times=False) as data:
            for name, (dims, coordinates, unit) in variables.items():
                assert data[name].dims == dims, name
                assert set(data[name].coords) == coordinates, name
                assert data[name].attrs["units"] == unit, name
    with xarray.open_dataset(results, group="/probes", engine=engine, decode_times=False) as probes:
        assert list(probes.wave.values) == ["P", "S", "R"]
        second = probes.displacement_z.sel(probe=2)
        assert float(second.r) == 0.01 and float(second.z) == 0.0
        assert float(probes.arrival.sel(probe=2, wave="P")) > 0.0
        with h5py.File(results, "r") as file:
            np.testing.assert_array_equal(second.values, file["probes/displacement_z"][1])
            np.testing.assert_array_equal(probes.time.values, file["time"][()])


@pytest.mark.parametrize("engine", ENGINES)
def test_sweeps_are_chosen_from_by_value(sweep, engine):
    with xarray.open_dataset(sweep, group="/results", engine=engine) as data:
        force = data.peak_force_n
        assert force.dims == ("striker.material", "striker.velocity_m_s", "list", "sample")
        assert {"contact.tolerance", "contact.loss_tolerance", "striker.mass_kg"} <= set(force.coords)
        assert force.attrs["units"] == "N" and data["striker.mass_kg"].attrs["units"] == "kg"
        chosen = force.sel({"striker.material": "copper", "striker.velocity_m_s": 2.0})
        with h5py.File(sweep, "r") as file:
            row = list(file["axes/striker.material"].asstr()).index("copper")
            np.testing.assert_array_equal(chosen.values, file["results/peak_force_n"][row, 2])
        assert chosen.shape == (2, 5) and np.all(chosen > 0)


def test_text_has_the_same_numbers(results):
    lines = results.with_name("out.csv").read_text().splitlines()
    assert lines[:2] == ["# probe1: r = 0.004 m, z = 0.004 m", "# probe2: r = 0.01 m, z = 0 m"]
    columns = lines[2].split(",")
    assert columns[:5] == ["time_s", "force_n", "displacement_m", "velocity_m_s", "deflection_m"]
    numbers = np.array([[float(x) for x in line.split(",")] for line in lines[3:]])
    with h5py.File(results, "r") as file:
        np.testing.assert_array_equal(numbers[:, columns.index("force_n")], file["force"][()])
        for probe in (1, 2):
            stress = numbers[:, columns.index(f"probe{probe}_stress_rz_pa")]
            np.testing.assert_array_equal(stress, file["probes/stress_rz"][probe - 1])


def test_steps_of_a_section_say_where_they_begin(results):
    with h5py.File(results, "r") as file:
        offsets = file["VTKHDF/Steps/PointDataOffsets"]
        assert sorted(offsets) == sorted(file["VTKHDF/PointData"])
        for name, data in offsets.items():
            assert data.dtype == np.int64, name
            np.testing.assert_array_equal(data[()], np.arange(9))


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("rows", [[], ["--rows", "7:31"]])
def test_the_root_of_a_sweep_opens_as_its_results(tmp_path, sweep, engine, rows):
    path = sweep
    if rows:
        path = tmp_path / "part.h5"
        run_well("sweep", sweep.parent / "sweep.toml", *rows, "-o", path)
    with xarray.open_dataset(path, engine=engine) as root, xarray.open_dataset(path, group="results", engine=engine) as group:
        assert root.attrs["format_version"] == ("1.3" if rows else "1.7")
        assert root.drop_vars("failures", errors="ignore").equals(group)
        assert root.restitution.dims == group.restitution.dims and root.restitution.attrs["units"] == "1"
