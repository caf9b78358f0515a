"""Sensors from outside: `hertzlamb impact`, `plot` and `infer --trace`, files read back with h5py."""

import json

import h5py
import numpy as np
import pytest
from conftest import ROOT, run

SCENE = """
[target]
youngs_modulus_pa = 70e9
poisson_ratio = 0.25
density_kg_m3 = 2700.0
[force]
file = "pulse.csv"
[contact]
disc_radius_m = {disc}
tolerance = {tolerance}
{step}
[output]
duration_s = {duration}
[[sensor]]
r_m = 0.05
z_m = 0.0
face_radius_m = {face}
{more}
"""

BALL = """
[target]
material = "aluminium"
thickness_m = 0.1
[striker]
material = "steel"
shape = "ball"
diameter_m = 3e-3
velocity_m_s = 0.4
"""


def impact(folder, text, *arguments):
    path = folder / "scene.toml"
    path.write_text(text)
    out = folder / "out.h5"
    told = run("impact", path, "-o", out, "--force", *arguments)
    assert told.returncode == 0, told.stderr
    return h5py.File(out), told


def test_a_mean_over_a_face_is_that_of_the_closed_form(tmp_path):
    rows = np.loadtxt(ROOT / "tests/golden/face.csv", delimiter=",", skiprows=1)
    shear = 70e9 / 2.5
    unit = 0.05 / np.sqrt(shear / 2700.0)
    for face, allowed in [(0.05, 1e-6), (0.2, 1e-6)]:
        case = rows[rows[:, 0] == face]
        length = case[0, 1] * unit
        time = np.linspace(0, length, 6001)
        force = np.sin(np.pi * time / length).clip(0) ** 1.5
        np.savetxt(tmp_path / "pulse.csv", np.column_stack([time, force]), delimiter=",", header="time_s,force_n", comments="", fmt="%.17g")
        text = SCENE.format(disc=5e-8, tolerance=1e-7, step=f"step_s = {length / 2000}", duration=case[-1, 2] * unit, face=face * 0.05, more="")
        with impact(tmp_path, text)[0] as file:
            found = np.interp(case[:, 2] * unit, file["time"], file["sensors/output"][0]) * shear * 0.05
            assert np.abs(found - case[:, 3]).max() < allowed * np.abs(case[:, 3]).max()
            error = file["sensors/output_error"][0] * shear * 0.05
            assert error[0] == 0 and error[-1] < 1e-4 * np.abs(case[:, 3]).max()
            assert file["sensors/face_mean"].asstr()[0] in ("kernels", "discs")


def test_files_reports_and_pictures_have_sensors(tmp_path):
    response = "[sensor.response]\nfile = \"sensor.csv\"\nunit = \"mV\"\n"
    (tmp_path / "sensor.csv").write_text("frequency_khz,amplitude_db\n1,20\n50,26\n100,40\n200,30\n2000,0\n")
    sensors = "[[sensor]]\nr_m = 0.03\nz_m = 0.0\nface_radius_m = 2e-3\nquantity = \"velocity_z\"\n" + response
    sensors += "[[sensor]]\nr_m = 0.0\nz_m = 0.02\nquantity = \"stress_zz\"\n"
    file, told = impact(tmp_path, BALL + sensors)
    with file:
        group = file["sensors"]
        assert file.attrs["format_version"] == "1.11"
        assert group["output"].shape == group["output_error"].shape == (2, len(file["time"]))
        assert list(group["output_unit"].asstr()) == ["mV", "Pa"]
        assert list(group["quantity"].asstr()) == ["velocity_z", "stress_zz"]
        assert list(group["face_mean"].asstr()) == ["discs", "point"]
        assert np.array_equal(group["mean"][1], group["output"][1])
        assert group["valid_until"][1] < group["valid_until"][0]
        early = file["time"][()] < group["arrival"][0, 0]
        assert np.all(group["mean"][0, early] == 0) and np.all(group["output_error"][0, early] == 0)
        # minimum phase: the table's amplitude at low frequencies
        assert "response" in file.attrs["scene"]
    report = json.loads(run("impact", tmp_path / "scene.toml", "--json").stdout)
    assert [own["output_unit"] for own in report["sensors"]] == ["mV", "Pa"]
    assert "sensor" in told.stdout
    for kind in ("sensors", "spectrum", "impact"):
        run("plot", tmp_path / "out.h5", "--kind", kind, "-o", tmp_path / f"{kind}.svg")
        assert "sensor" in (tmp_path / f"{kind}.svg").read_text()
    plan = run("impact", tmp_path / "scene.toml", "--dry-run").stdout
    assert "sensor 1" in plan and "sensor 2" in plan
    run("impact", tmp_path / "scene.toml", "--csv", tmp_path / "out.csv")
    header = [line for line in (tmp_path / "out.csv").read_text().splitlines() if not line.startswith("#")][0]
    assert "sensor1_output" in header and "sensor2_output" in header


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ("quantity = \"velocity\"", ["sensor[1].quantity", "velocity_z"]),
        ("face_radius_m = -1.0", ["sensor[1].face_radius_m", "[0, inf)"]),
        ("z_m = 0.2", ["sensor[1].z_m", "thickness_m"]),
        ("[sensor.response]\npoles = [[1.0, 0.0]]\nzeros = []\ngain = 1.0", ["sensor[1].response.poles"]),
        ("[sensor.response]\npoles = [[-1.0, 2.0]]\nzeros = []\ngain = 1.0", ["response.poles"]),
        ("[sensor.response]\nzeros = [0]\npoles = []\ngain = 1.0", ["response.zeros", "velocity"]),
        ("[sensor.response]\nfile = \"none.csv\"", ["none.csv"]),
        ("[sensor.response]\ncoefficients = [1.0]", ["rate_hz"]),
        ("[sensor.response]\ngain = 1.0\ncoefficients = [1.0]\nrate_hz = 1e6", ["more than one response"]),
        ("[sensor.response]\nunit = \"V\"", ["response.file"]),
    ],
)
def test_bad_sensors_are_one_sentence(tmp_path, more, words):
    keys = "r_m = 0.03\n" + ("" if "z_m" in more else "z_m = 0.0\n")
    (tmp_path / "scene.toml").write_text(BALL + "[[sensor]]\n" + keys + more + "\n")
    found = run("impact", tmp_path / "scene.toml")
    assert found.returncode == 2 and found.stderr.count("\n") == 1
    for word in words:
        assert word in found.stderr, found.stderr


def test_a_force_comes_back_from_a_noisy_trace(tmp_path):
    sensors = "[[sensor]]\nr_m = 0.04\nz_m = 0.0\nface_radius_m = 2e-3\nquantity = \"velocity_z\"\n"
    file, _ = impact(tmp_path, BALL + sensors)
    with file:
        time, output = file["time"][()], file["sensors/output"][0]
        truth = {name: float(file.attrs[name]) for name in ("peak_force_n", "contact_time_s", "impulse_n_s")}
    rng = np.random.default_rng(3)
    clock = np.arange(-150, 180) * 2e-7
    trace = np.interp(clock, time, output, left=0.0) + 0.01 * np.abs(output).max() * rng.normal(size=len(clock))
    np.savetxt(tmp_path / "trace.csv", np.column_stack([clock * 1e6 + 50, trace]), delimiter=",", header="time_us,a", comments="")
    found = run("infer", tmp_path / "scene.toml", "--trace", tmp_path / "trace.csv", "-o", tmp_path / "force.h5", "--json")
    report = json.loads(found.stdout)
    for name, allowed in (("peak_force_n", 0.02), ("contact_time_s", 0.01), ("impulse_n_s", 0.03)):
        assert abs(report["fit"][name]["value"] / truth[name] - 1) < allowed
    assert abs(report["fit"]["start_s"]["value"] - 50e-6) < 1e-7
    assert abs(report["ball"]["velocity_m_s"]["value"] / 0.4 - 1) < 0.03
    with h5py.File(tmp_path / "force.h5") as file:
        assert file.attrs["file_type"] == "hertzlamb force"
        force, low, high = (file[name][()] for name in ("force", "force_low", "force_high"))
        assert np.all(force >= 0) and np.all(low <= force + 1e-12) and np.all(force <= high + 1e-12)
        assert abs(force.max() / truth["peak_force_n"] - 1) < 0.03
        predicted = file["traces/predicted"][0]
        assert np.corrcoef(predicted, trace)[0, 1] > 0.99
        assert len(file["l_curve/lambda"]) == len(file["l_curve/residual"]) > 5
    again = run("infer", tmp_path / "scene.toml", "--trace", tmp_path / "trace.csv", "-o", tmp_path / "force.h5")
    assert again.returncode != 0 and "exists" in again.stderr
