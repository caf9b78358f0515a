"""Opens what the program writes with h5py, and compares it with what the program says."""

import shutil

import h5py
import numpy as np
import pytest
from conftest import run, run_well

HISTORIES = {"force": "N", "displacement": "m", "velocity": "m/s", "deflection": "m"}
PROBE_FIELDS = {
    "displacement_r": "m",
    "displacement_z": "m",
    "stress_rr": "Pa",
    "stress_tt": "Pa",
    "stress_zz": "Pa",
    "stress_rz": "Pa",
}
SUMMARY = """
    model scheme static_share deflection kernel steps step_s peak_force_n peak_force_time_s contact_time_s
    rebound_velocity_m_s restitution peak_displacement_m peak_deflection_m impulse_n_s radiated_energy_j
    energy_residual relative_error_estimate wall_s warnings
""".split()

MASS_KG, VELOCITY_M_S, DISC_RADIUS_M = 0.0122, 100.0, 0.004
SHEAR_MODULUS_PA = 2.09e11 / 2.6
# Dilatational wave speed of the paper's steel: E = 209 GPa, Poisson ratio 0.3, 7830 kg/m^3.
C1_M_S = np.sqrt(2.09e11 * 0.7 / (7830.0 * 1.3 * 0.4))

# The converged march of tests/golden/impacts.csv, row "copper rod on steel, table values", full.
CONVERGED = {
    "peak_force_n": 159053.22,
    "contact_time_s": 2.72280252e-05,
    "restitution": 0.980982862,
    "peak_displacement_m": 0.000908973186,
    "peak_deflection_m": 0.000129656921,
}


def units(dataset):
    value = dataset.attrs["units"]
    return value.decode() if isinstance(value, bytes) else value


def scales(dataset):
    """The paths of the dimension scales of a dataset, one for each axis."""
    return [dimension[0].name for dimension in dataset.dims]


@pytest.mark.parametrize("name", CONVERGED)
def test_summary_agrees_with_the_converged_march(impact, name):
    assert impact.summary[name] == pytest.approx(CONVERGED[name], rel=1e-4)


def test_summary_has_every_key_of_the_interface(impact):
    assert [key for key in SUMMARY if key not in impact.summary] == []


def test_histories(impact):
    with h5py.File(impact.path, "r") as file:
        time = file["time"]
        assert units(time) == "s"
        assert np.all(np.diff(time[()]) > 0) and time[0] == 0.0
        assert time[-1] > impact.summary["contact_time_s"]
        assert time.is_scale
        for name, unit in HISTORIES.items():
            assert file[name].shape == time.shape, name
            assert units(file[name]) == unit, name
            assert np.all(np.isfinite(file[name][()])), name
            assert scales(file[name]) == ["/time"], name


def test_histories_tell_the_summary(impact):
    with h5py.File(impact.path, "r") as file:
        time, force = file["time"][()], file["force"][()]
        velocity, displacement = file["velocity"][()], file["displacement"][()]
    # The summary interpolates between samples, so they agree to the square of the step.
    assert force.max() == pytest.approx(impact.summary["peak_force_n"], rel=1e-3)
    assert displacement.max() == pytest.approx(impact.summary["peak_displacement_m"], rel=1e-3)
    assert np.all(force >= 0.0)
    assert velocity[0] == pytest.approx(VELOCITY_M_S)
    # Newton: what the force has taken is what the rod has lost.
    impulse = np.concatenate([[0.0], np.cumsum((force[1:] + force[:-1]) / 2 * np.diff(time))])
    np.testing.assert_allclose(velocity, VELOCITY_M_S - impulse / MASS_KG, atol=2e-3 * VELOCITY_M_S)


def test_energy_over_time(impact):
    with h5py.File(impact.path, "r") as file:
        time, force, velocity = (file[name][()] for name in ("time", "force", "velocity"))
        kinetic, stored, radiated = (file["energy"][name] for name in ("kinetic", "stored", "radiated"))
        for dataset in (kinetic, stored, radiated):
            assert units(dataset) == "J" and dataset.shape == time.shape
            assert scales(dataset) == ["/energy/time"]
        kinetic, stored, radiated = kinetic[()], stored[()], radiated[()]
        assert "work" not in file["energy"]
    np.testing.assert_allclose(kinetic, 0.5 * MASS_KG * velocity**2, rtol=1e-9)
    modulus = 1 / ((1 - 0.34**2) / 1.23e11 + (1 - 0.3**2) / 2.09e11)
    stiffness = 4 / 3 * modulus * DISC_RADIUS_M**0.5
    spring = 0.4 * force ** (5 / 3) / stiffness ** (2 / 3)
    field = 0.5 * 0.3 * 0.7 / (SHEAR_MODULUS_PA * DISC_RADIUS_M) * force**2
    np.testing.assert_allclose(stored, spring + field, rtol=1e-9, atol=1e-9)
    assert radiated[0] == 0.0
    assert radiated[-1] == pytest.approx(impact.summary["radiated_energy_j"], rel=1e-3)
    # the centre's deflection, which is in the law, does not do the work of the pressure
    total = (kinetic + stored + radiated) / impact.summary["initial_energy_j"] - 1
    assert abs(total[0]) < 1e-9 and abs(total[-1]) < 1e-3
    middle = np.argmax(force)
    assert total[middle] == pytest.approx(-0.25 * field[middle] / kinetic[0], rel=0.2)


def test_probes(impact):
    with h5py.File(impact.path, "r") as file:
        probes = file["probes"]
        count, samples = len(probes["r"]), len(file["time"])
        assert count > 0 and probes["z"].shape == (count,)
        assert units(probes["r"]) == units(probes["z"]) == "m"
        for name, unit in PROBE_FIELDS.items():
            assert probes[name].shape == (count, samples), name
            assert units(probes[name]) == unit, name
            assert np.all(np.isfinite(probes[name][()])), name
            assert scales(probes[name]) == ["/probes/probe", "/probes/time"], name
            errors = probes[name + "_error"]
            assert errors.shape == (count,) and units(errors) == unit, name
            assert np.all(errors[()] >= 0.0) and np.all(np.isfinite(errors[()])), name


@pytest.mark.parametrize("kernel", ["table", "direct"])
def test_probes_rest_until_the_first_wave(tmp_path, paper_scene, table, kernel):
    out = tmp_path / "out.h5"
    kernels = ("--kernel", "table", "--table", table) if kernel == "table" else ("--kernel", "direct")
    run_well("impact", paper_scene, *kernels, "-o", out)
    with h5py.File(out, "r") as file:
        time, probes = file["time"][()], file["probes"]
        for i, (r, z) in enumerate(zip(probes["r"], probes["z"])):
            arrival = np.hypot(max(r - DISC_RADIUS_M, 0.0), z) / C1_M_S
            assert probes["arrival"][i, 0] == pytest.approx(arrival, rel=1e-9)
            for name in PROBE_FIELDS:
                history = np.abs(probes[name][i])
                # A table reaches over the front by half its stencil: there the file's own estimate is the promise.
                allowed = 1e-7 * history.max() if kernel == "direct" else probes[name + "_error"][i]
                assert history[time < arrival].max(initial=0.0) <= allowed, (name, r, z)


def test_probe_under_the_disc_carries_the_pressure(tmp_path, paper_scene, table):
    # On the surface stress_zz is minus the pressure, whatever the waves do: 3 P / (2 pi r0^2) at the centre.
    scene = tmp_path / "centre.toml"
    scene.write_text(without_probes(paper_scene) + "\n[[probe]]\nr_m = 0.0\nz_m = 0.0\n")
    out = tmp_path / "centre.h5"
    run_well("impact", scene, "--kernel", "table", "--table", table, "-o", out)
    with h5py.File(out, "r") as file:
        pressure = 1.5 * file["force"][()] / (np.pi * DISC_RADIUS_M**2)
        np.testing.assert_allclose(-file["probes/stress_zz"][0], pressure, atol=1e-4 * pressure.max())
        # No shear and no radial displacement on the axis.
        assert np.abs(file["probes/stress_rz"][0]).max() <= 1e-8 * pressure.max()
        assert np.abs(file["probes/displacement_r"][0]).max() == pytest.approx(0.0, abs=1e-12)


def test_surface_centre_moves_as_the_march_says(tmp_path, paper_scene, table):
    # The probe comes from the kernels of the fields, the deflection from the closed form.
    # Both files carry their errors: the two histories may differ by no more.
    scene = tmp_path / "centre.toml"
    scene.write_text(without_probes(paper_scene) + "\n[[probe]]\nr_m = 0.0\nz_m = 0.0\n")
    out = tmp_path / "centre.h5"
    summary = run_well("impact", scene, "--kernel", "table", "--table", table, "-o", out)
    with h5py.File(out, "r") as file:
        gap = np.abs(file["probes/displacement_z"][0] - file["deflection"][()]).max()
        stated = file["probes/displacement_z_error"][0]
    assert stated <= 1e-3 * summary["peak_deflection_m"]
    assert gap <= stated + summary["relative_error_estimate"] * summary["peak_deflection_m"]


def without_probes(scene):
    """The text of a scene up to its first probe or map."""
    lines = scene.read_text().splitlines()
    cut = next((i for i, line in enumerate(lines) if line.strip() in ("[[probe]]", "[map]")), len(lines))
    return "\n".join(lines[:cut])


def test_direct_kernels_give_the_same_probes(tmp_path, impact, paper_scene):
    # The two have their own output steps; they are compared at the instants that both have.
    out = tmp_path / "direct.h5"
    run_well("impact", paper_scene, "--kernel", "direct", "-o", out)
    with h5py.File(out, "r") as direct, h5py.File(impact.path, "r") as looked_up:
        picoseconds = [np.rint(file["time"][()] * 1e12).astype(int) for file in (direct, looked_up)]
        common, mine, theirs = np.intersect1d(*picoseconds, return_indices=True)
        assert len(common) > 20
        np.testing.assert_allclose(direct["force"][mine], looked_up["force"][theirs], rtol=1e-9, atol=1e-3)
        for name in PROBE_FIELDS:
            gap = np.abs(direct["probes"][name][:, mine] - looked_up["probes"][name][:, theirs]).max(axis=1)
            stated = direct["probes"][name + "_error"][()] + looked_up["probes"][name + "_error"][()]
            assert np.all(gap <= stated), name


def test_results_name_where_they_come_from(impact):
    with h5py.File(impact.path, "r") as file:
        text = " ".join(f"{name}={value}" for name, value in file.attrs.items())
    for part in ("wave", "implicit", "youngs_modulus_pa"):
        assert part in text


def test_results_name_the_table(impact, table):
    with h5py.File(impact.path, "r") as results, h5py.File(table, "r") as kernels:
        assert results.attrs["kernel"] == "table"
        assert results.attrs["table_id"] == kernels.attrs["id"]
        assert results.attrs["table_format_version"] == kernels.attrs["format_version"]


def test_same_input_same_numbers(tmp_path, impact, paper_scene, table):
    again = tmp_path / "again.h5"
    run_well("impact", paper_scene, "--kernel", "table", "--table", table, "-o", again)
    with h5py.File(again, "r") as a, h5py.File(impact.path, "r") as b:
        for name in ("force", "probes/stress_zz"):
            np.testing.assert_array_equal(a[name], b[name])


def test_forced_history(tmp_path, paper_scene, table):
    time_s = np.linspace(0.0, 2e-5, 401)
    force_n = 1e4 * np.sin(np.pi * time_s / 2e-5) ** 4
    (tmp_path / "pulse.csv").write_text(
        "time_s,force_n\n" + "".join(f"{t:.17g},{p:.17g}\n" for t, p in zip(time_s, force_n))
    )
    scene = tmp_path / "pulse.toml"
    scene.write_text(
        '[target]\nmaterial = "steel"\n[contact]\ndisc_radius_m = 0.004\n[force]\nfile = "pulse.csv"\n'
        "[[probe]]\nr_m = 0.0\nz_m = 0.0\n"
    )
    out = tmp_path / "pulse.h5"
    summary = run_well("impact", scene, "--kernel", "table", "--table", table, "-o", out)
    assert summary["peak_force_n"] == pytest.approx(1e4, rel=1e-3)
    with h5py.File(out, "r") as file:
        np.testing.assert_allclose(np.interp(time_s, file["time"], file["force"]), force_n, atol=1e-3 * force_n.max())
        # Nearly quasi-static: the centre follows 3 (1 - nu) P / (8 mu r0) to within the memory of the disc.
        static = 3 * 0.7 / 8 * 1e4 / (SHEAR_MODULUS_PA * DISC_RADIUS_M)
        assert file["probes/displacement_z"][0].max() == pytest.approx(static, rel=0.05)


def test_table_has_shapes_units_and_named_dimensions(table):
    with h5py.File(table, "r") as file:
        assert file.attrs["file_type"] == "hertzlamb kernel table"
        slice_ = file["slices/nu_0.3"]
        assert slice_.attrs["poisson_ratio"] == 0.3
        expected = {"r": "r0", "z": "r0", "slices/nu_0.3/time": "r0/c1"}
        assert {name: units(file[name]) for name in expected} == expected
        fields = [name.decode() for name in file["field"]]
        assert sorted(fields) == sorted(PROBE_FIELDS)
        remainder = slice_["remainder"]
        assert remainder.shape == (len(file["r"]), len(file["z"]), len(fields), len(slice_["time"]))
        assert scales(remainder) == ["/r", "/z", "/field", "/slices/nu_0.3/time"]
        assert "P/(mu r0)" in units(remainder) and "P/r0^2" in units(remainder)


def test_table_labels_every_dataset_and_every_axis(table):
    with h5py.File(table, "r") as file:
        found = []
        file.visititems(lambda name, item: found.append(item) if isinstance(item, h5py.Dataset) else None)
        assert len(found) > 15
        for dataset in found:
            assert dataset.attrs["units"] and dataset.attrs["long_name"], dataset.name
            if not dataset.is_scale:
                lengths = [len(dimension[0]) for dimension in dataset.dims]
                assert lengths == list(dataset.shape), dataset.name


def test_table_is_finite_throughout(table):
    with h5py.File(table, "r") as file:
        found = []
        file.visititems(lambda name, item: found.append(name) if isinstance(item, h5py.Dataset) else None)
        for name in found:
            if np.issubdtype(file[name].dtype, np.floating):
                assert np.all(np.isfinite(file[name][()])), name


def test_table_holds_minus_the_static_field_before_the_first_wave(table):
    # Outside the disc Johnson, Contact Mechanics, (3.42): the surface under a Hertz pressure, in P/(mu r0).
    with h5py.File(table, "r") as file:
        slice_ = file["slices/nu_0.3"]
        field = [name.decode() for name in file["field"]].index("displacement_z")
        width, starts = file.attrs["cell_width"], slice_["time"][()]
        for row, r in enumerate(file["r"]):
            before = starts + width < r - 1.0
            if not before.any():
                continue
            static = 0.7 / 2 * 3 / (4 * np.pi) * ((2 - r * r) * np.arcsin(1 / r) + np.sqrt(r * r - 1))
            np.testing.assert_allclose(slice_["remainder"][row, 0, field, before], -static, rtol=1e-6)


def test_table_verifies(table):
    found = run_well("table", "verify", table, "--sample", 20)
    assert found["nodes_checked"] == 20 and found["hash_right"]
    # single precision, and nothing but: some difference, below what is allowed
    assert 0 < found["largest_relative_difference"] < 2e-7 + 100 * 1e-8


def test_table_with_a_wrong_number_is_found_out(tmp_path, table):
    wrong = tmp_path / "wrong.h5"
    shutil.copy(table, wrong)
    with h5py.File(wrong, "r+") as file:
        file["slices/nu_0.3/remainder"][3, 3, 4, 40] += 1e-3
    done = run("table", "verify", wrong)
    assert done.returncode == 1, done.stdout
    assert "wrong.h5" in done.stderr
