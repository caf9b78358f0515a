"""Plates: fields beside an inversion of the whole plate, files and messages."""

import csv

import h5py
import numpy as np
import pytest

from conftest import ROOT, run, run_well

DISC_M, FORCE_N, MODULUS_PA, DENSITY = 1e-3, 1000.0, 70e9, 2500.0


def golden():
    """Rows of the same plate, place and pulse, by these."""
    found = {}
    with (ROOT / "tests/golden/plate.csv").open() as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            key = tuple(float(row[name]) for name in ("poisson", "thickness_r0", "r_r0", "pulse_r0_c1"))
            time, value = float(row["time_r0_c1"]), float(row["w_whole_plate"])
            found.setdefault((*key, row["face"], row["legs_used"]), []).append((time, value))
    return found.items()


@pytest.mark.parametrize(("plate", "rows"), golden())
def test_fields_are_those_of_the_whole_plate(tmp_path, plate, rows):
    poisson, thickness, r, pulse, face, legs = plate
    shear = MODULUS_PA / (2 * (1 + poisson))
    speed = np.sqrt(2 * shear * (1 - poisson) / (1 - 2 * poisson) / DENSITY)
    unit_s = DISC_M / speed
    time = np.linspace(0, pulse * unit_s, 1500)
    force = FORCE_N * np.sin(np.pi * time / time[-1]) ** 4
    np.savetxt(tmp_path / "force.csv", np.c_[time, force], delimiter=",", header="time_s,force_n", comments="")
    times, expected = np.array(rows).T
    (tmp_path / "scene.toml").write_text(f"""
[target]
youngs_modulus_pa = {MODULUS_PA}
poisson_ratio = {poisson}
density_kg_m3 = {DENSITY}
thickness_m = {thickness * DISC_M!r}
echoes = {max(map(int, legs.split()))}
[force]
file = "force.csv"
[contact]
disc_radius_m = {DISC_M}
tolerance = 1e-5
[output]
duration_s = {float(1.001 * times[-1] * unit_s)!r}
[[probe]]
r_m = {r * DISC_M!r}
z_m = {thickness * DISC_M if face == "bottom" else 0.0!r}
""")
    run_well("impact", tmp_path / "scene.toml", "-o", tmp_path / "out.h5")
    with h5py.File(tmp_path / "out.h5") as file:
        unit = shear * DISC_M / FORCE_N
        found = np.interp(times, file["probes/time"][()] / unit_s, unit * file["probes/displacement_z"][0])
        error = unit * file["probes/displacement_z_error"][0]
    peak = np.abs(expected).max()
    # the reference interpolates the fronts, which are sharp on the axis
    assert np.abs(found - expected).max() < 2e-6 * peak
    assert error < 1e-4 * peak


SCENE = """
[target]
material = "steel"
{plate}
[striker]
shape = "ball"
material = "bearing-steel"
diameter_m = 0.002
velocity_m_s = 1.0
{rest}
"""
PROBES = "[[probe]]\nr_m = 0\nz_m = 0.03\n[[probe]]\nr_m = 0.02\nz_m = 0\n"


def computed(tmp_path, plate, rest=PROBES):
    """Warnings and the file of a scene."""
    (tmp_path / "scene.toml").write_text(SCENE.format(plate=plate, rest=rest))
    report = run_well("impact", tmp_path / "scene.toml", "-o", tmp_path / "out.h5", "--force")
    return report["warnings"], h5py.File(tmp_path / "out.h5")


def test_a_file_has_the_arrivals_by_name(tmp_path):
    warnings, file = computed(tmp_path, "thickness_m = 0.03\nechoes = 3")
    with file:
        names = [name.decode() for name in file["probes/echo"][()]]
        arrival = file["probes/echo_arrival"][()]
        assert file["probes/echo_arrival"].dims[1][0].name == "/probes/echo"
        first, valid = file["probes/arrival"][:, 0], file["probes/valid_until"][()]
        end = file["probes/time"][-1]
    assert arrival[0, names.index("PPP")] == pytest.approx(3 * first[0], rel=1e-6)
    assert np.isinf(arrival[1, names.index("PPP")]) and np.isfinite(arrival[1, names.index("PP")])
    # by default the output ends with the first echo that is left out
    assert valid.min() >= end > 0.9 * valid.min()
    assert not any("echoes from" in warning for warning in warnings)


def test_until_a_time(tmp_path):
    _, file = computed(tmp_path, "thickness_m = 0.03\nuntil_s = 3e-5")
    with file:
        assert file["probes/time"][-1] == pytest.approx(3e-5, rel=2e-2)
        assert (file["probes/valid_until"][()] >= 3e-5).all()


def test_a_probe_on_the_lower_face_names_the_key(tmp_path):
    warnings, file = computed(tmp_path, "thickness_m = 0.03")
    file.close()
    (sentence,) = [warning for warning in warnings if "free face" in warning]
    assert "echoes = 1 or more in [target]" in sentence


@pytest.mark.parametrize(
    ("plate", "words"),
    [
        ("echoes = 3", "thickness_m"),
        ("thickness_m = 0.03\nechoes = 0", "target.echoes = 0 is outside [1, 16]"),
        ("thickness_m = 0.03\nechoes = 17", "target.echoes = 17 is outside [1, 16]"),
        ("thickness_m = 0.03\nechoes = 2.5", "target.echoes"),
        ("thickness_m = 0.03\nechoes = 2\nuntil_s = 1e-5", "target.until_s cannot be combined with echoes"),
        ("thickness_m = 0.03\nuntil_s = 1e-3", "Rayleigh-Lamb"),
        ("thickness_m = 0.001\nechoes = 2", "before the contact ends"),
    ],
)
def test_what_a_plate_cannot_do_is_one_sentence(tmp_path, plate, words):
    (tmp_path / "scene.toml").write_text(SCENE.format(plate=plate, rest=""))
    done = run("impact", tmp_path / "scene.toml")
    assert done.returncode == 2 and words in done.stderr and done.stderr.count("\n") == 1, done.stderr


def test_a_sweep_of_contacts_rejects_echoes_and_one_with_probes_has_them(tmp_path):
    keys = SCENE.replace("[target]", "[scene.target]").replace("[striker]", "[scene.striker]")
    keys = keys.replace("velocity_m_s = 1.0\n", "")
    product = "[product]\nstriker.velocity_m_s = [0.5, 1.0]\n"
    plate = "thickness_m = 0.03\nechoes = 2"
    (tmp_path / "sweep.toml").write_text(keys.format(plate=plate, rest=product))
    done = run("sweep", tmp_path / "sweep.toml", "-o", tmp_path / "sweep.h5")
    assert done.returncode == 2 and "[[probe]]" in done.stderr, done.stderr
    probe = "[[scene.probe]]\nr_m = 0\nz_m = 0.03\n"
    (tmp_path / "sweep.toml").write_text(keys.format(plate=plate, rest=probe + product))
    run_well("sweep", tmp_path / "sweep.toml", "-o", tmp_path / "sweep.h5")
    _, file = computed(tmp_path, plate, "[output]\npeaks = true\n" + PROBES)
    with file, h5py.File(tmp_path / "sweep.h5") as rows:
        peak = file["probes/displacement_z_peak"][0]
        assert rows["results/probe_1_displacement_z_peak"][1] == pytest.approx(peak, rel=1e-4)
