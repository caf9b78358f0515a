"""Opens what `hertzlamb sweep` writes with h5py, and the section that VTK reads."""

import h5py
import numpy as np
import pytest
from conftest import ROOT, run_well

SWEEP = """
scene = "{scene}"
[product.striker]
velocity_m_s = {{ from = 1.0, to = 100.0, count = 3, spacing = "log" }}
material = ["copper", "steel"]
[random]
samples = 20
seed = 3
[random.striker]
mass_kg = {{ distribution = "normal", mean = 0.0122, deviation = 0.0001 }}
"""

SCENE = """
[target]
material = "steel"
[striker]
tip_radius_m = 0.004
[contact]
disc_radius_m = 0.004
"""


@pytest.fixture(scope="module")
def sweep(tmp_path_factory):
    folder = tmp_path_factory.mktemp("sweep")
    (folder / "scene.toml").write_text(SCENE)
    (folder / "sweep.toml").write_text(SWEEP.format(scene="scene.toml"))
    summary = run_well("sweep", folder / "sweep.toml", "-o", folder / "sweep.h5", "--csv", folder / "sweep.csv")
    assert summary["failed"] == 0
    with h5py.File(folder / "sweep.h5", "r") as file:
        yield file, folder


def test_dimensions_are_the_axes(sweep):
    file, _ = sweep
    dimensions = ["striker.material", "striker.velocity_m_s", "sample"]
    results = {name: data for name, data in file["results"].items() if data.ndim == 3}
    assert sorted(set(file["results"]) - set(results)) == sorted([*dimensions, "striker.mass_kg"])
    assert [dimension.label or dimension[0].name for dimension in file["results/striker.mass_kg"].dims] == ["/results/sample"]
    for name, dataset in results.items():
        assert dataset.shape == (2, 3, 20), name
        scales = [[scale.name for scale in dimension.values()] for dimension in dataset.dims]
        assert scales == [[f"/results/{name}"] for name in dimensions], name
        assert dataset.attrs["coordinates"] == "striker.mass_kg"
        assert dataset.attrs["units"] and dataset.attrs["long_name"], name
    assert list(file["axes/striker.material"].asstr()[()]) == ["copper", "steel"]
    np.testing.assert_allclose(file["axes/striker.velocity_m_s"][()], [1.0, 10.0, 100.0])


def test_rows_are_physics(sweep):
    file, _ = sweep
    mass = file["axes/striker.mass_kg"][()]
    velocity = file["axes/striker.velocity_m_s"][()]
    energy = 0.5 * mass * velocity[:, None] ** 2
    np.testing.assert_allclose(file["results/initial_energy_j"][()], np.stack([energy, energy]), rtol=1e-12)
    restitution = file["results/restitution"][()]
    np.testing.assert_allclose(file["results/loss"][()], 1 - restitution**2, atol=1e-12)
    assert np.all((restitution > 0.9) & (restitution <= 1.0))
    momentum = mass * velocity[:, None] * (1 + restitution[0])
    # the impulse is the integral of the force, to the tolerance of 1e-4; the restitution comes from elsewhere
    np.testing.assert_allclose(file["results/impulse_n_s"][0], momentum, rtol=1e-4)
    assert abs(mass.mean() - 0.0122) < 1e-4


def test_models_have_names_and_nothing_failed(sweep):
    file, _ = sweep
    names = file["results/model"].attrs["names"].split()
    used = {names[i] for i in np.unique(file["results/model"][()])}
    assert used <= {"quasi_static", "quasi_static_radiation", "wave"}
    assert np.all(file["results/failure"][()] == -1) and file["failures"].size == 0
    assert file.attrs["rows"] == 120 and file.attrs["file_type"] == "hertzlamb sweep"


def test_the_csv_has_the_same_numbers(sweep):
    file, folder = sweep
    table = np.genfromtxt(folder / "sweep.csv", delimiter=",", names=True, dtype=None, encoding=None)
    np.testing.assert_array_equal(table["peak_force_n"], file["results/peak_force_n"][()].ravel())


def test_the_section_opens_in_vtk(tmp_path):
    pyvista = pytest.importorskip("pyvista")
    scene = (ROOT / "scenes" / "section.toml").read_text()
    scene = scene.replace("points = [41, 41]", "points = [5, 4]").replace("frames = 60", "frames = 3")
    (tmp_path / "scene.toml").write_text(scene)
    path = tmp_path / "section.vtkhdf"
    run_well("impact", tmp_path / "scene.toml", "-o", path)
    reader = pyvista.HDFReader(str(path)).reader
    reader.UpdateInformation()
    with h5py.File(path, "r") as file:
        assert file["map/time"].size == 3
        for step in range(3):
            reader.SetStep(step)
            reader.Update()
            mesh = pyvista.wrap(reader.GetOutputDataObject(0))
            assert mesh.dimensions == (5, 4, 1)
            for name in ("displacement_z", "stress_rr"):
                np.testing.assert_array_equal(mesh.point_data[name], file["map"][name][step].ravel())
        np.testing.assert_allclose(mesh.points[-1], [file["map/r"][-1], -file["map/z"][-1], 0.0], atol=1e-12)


def test_a_part_has_the_rows_of_the_sweep(sweep):
    whole, folder = sweep
    summary = run_well("sweep", folder / "sweep.toml", "--rows", "37:95", "-o", folder / "part.h5")
    assert (summary["rows"], summary["first_row"], summary["sweep_rows"]) == (58, 37, 120)
    with h5py.File(folder / "part.h5", "r") as part:
        assert part.attrs["file_type"] == "hertzlamb sweep part"
        assert part.attrs["sweep_sha256"] == whole.attrs["sweep_sha256"]
        assert list(part["results/row"][()]) == list(range(37, 95))
        for name, data in whole["results"].items():
            if data.ndim == 3:
                np.testing.assert_array_equal(part["results"][name][()], data[()].ravel()[37:95], err_msg=name)
                assert part["results"][name].dims[0][0].name == "/results/row"
        # keys that vary, row by row
        place = np.unravel_index(np.arange(37, 95), (2, 3, 20))
        words = part["words/striker.material"].asstr()[()]
        material = whole["axes/striker.material"].asstr()[()]
        assert list(words[part["results/striker.material"][()]]) == list(material[place[0]])
        for name, axis in {"striker.velocity_m_s": 1, "striker.mass_kg": 2}.items():
            values = whole[f"axes/{name}"][()][place[axis]]
            np.testing.assert_array_equal(part["results"][name][()], values)
