"""hl.noise: the arrays of the file, and descriptions that cannot be used."""

import h5py
import numpy as np
import pytest

import hertzlamb as hl

RING = {
    "target": {"material": "granite"},
    "striker": {"material": "granite", "shape": "ball", "diameter_m": 0.02, "velocity_m_s": 1.0},
    "area": {"shape": "disc", "radius_m": 50.0, "inner_radius_m": 1.0, "rate_per_m2_s": 2.0},
    "receiver": [{"x_m": 0.0, "y_m": 0.0, "name": "middle"}],
    "output": {"frequencies_hz": [10.0, 100.0], "duration_s": 0.5, "step_s": 1e-3},
}


def test_arrays_are_those_of_the_file(tmp_path):
    found = hl.noise(RING, threads=1)
    found.save(tmp_path / "noise.h5")
    with h5py.File(tmp_path / "noise.h5") as file:
        for name, values in found.arrays.items():
            stored = {"time": "traces/time", "velocity": "traces/velocity"}.get(name, name)
            if name != "receiver":
                assert np.array_equal(file[stored][()], values), name
    assert found.receiver == ["middle"] and found.velocity.shape == (1, 500) and "middle" in repr(found)
    assert found.rate_per_s == pytest.approx(2 * np.pi * (50**2 - 1))
    with pytest.raises(hl.OutputExists):
        found.save(tmp_path / "noise.h5")


@pytest.mark.parametrize(("section", "key"), [("area", "area.rate_per_m2_s"), ("output", "output.frequencies_hz")])
def test_a_missing_key_is_named(section, key):
    lacking = {name: value for name, value in RING[section].items() if name != key.split(".")[1]}
    with pytest.raises(hl.SceneError) as error:
        hl.noise(RING | {section: lacking})
    assert error.value.key == key
