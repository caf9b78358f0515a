"""Peaks between samples, and fields through a low pass, by the command and read back from its files."""

import h5py
import numpy as np
import pytest
from conftest import run, run_well

BEAD = """
[target]
material = "pmma"
[striker]
shape = "ball"
material = "soda-lime-glass"
diameter_m = 0.003
velocity_m_s = 1.5
{contact}
[output]
quantities = ["velocity_r", "velocity_z", "acceleration_z", "von_mises"]
{output}
"""
PLACES = [(0.055, 0.0), (0.06, 0.0), (0.065, 0.0), (0.07, 0.0), (0.01, 0.008)]


def computed(folder, name, contact="", output="peaks = true", places=PLACES):
    text = BEAD.format(contact=contact and f"[contact]\n{contact}\n", output=output)
    text += "".join(f"[[probe]]\nr_m = {r}\nz_m = {z}\n" for r, z in places)
    (folder / f"{name}.toml").write_text(text)
    summary = run_well("impact", f"{name}.toml", "-o", f"{name}.h5", cwd=folder)
    with h5py.File(folder / f"{name}.h5") as file:
        found = {key: data[()] for key, data in file["probes"].items() if isinstance(data, h5py.Dataset)}
        return summary, {**found, "attributes": dict(file.attrs)}


def test_peaks_are_smooth_over_distance_and_hold_for_any_step(tmp_path):
    _, found = computed(tmp_path, "usual")
    _, other = computed(tmp_path, "other", "step_s = 3.1e-8")
    _, fine = computed(tmp_path, "fine", "step_s = 3e-9", "")
    for name in ("displacement_r", "displacement_z", "velocity_r", "velocity_z", "stress_rr", "von_mises"):
        peak, error = abs(found[f"{name}_peak"]), found[f"{name}_peak_error"]
        largest = abs(fine[name]).max(axis=1)
        assert (abs(peak - largest) < error).all(), (name, peak, largest, error)
        assert (abs(peak - abs(other[f"{name}_peak"])) < np.minimum(error, 0.02 * peak)).all(), name
    # a needle at the Rayleigh front: over the samples it is a lottery
    sampled = abs(found["velocity_z"][:4]).max(axis=1)
    peak = abs(found["velocity_z_peak"][:4])
    assert (peak > sampled).all() and sampled.max() < 0.6 * peak.max()
    # falls as the root of the distance
    falls = peak * np.sqrt([r for r, _ in PLACES[:4]])
    assert np.ptp(falls) < 0.02 * falls.mean(), falls
    # samples are not taken for peaks where a crest lies between them
    assert (abs(found["displacement_z_peak"]) >= abs(found["displacement_z"]).max(axis=1)).all()


def test_a_sweep_has_the_peaks_of_its_impacts(tmp_path):
    _, one = computed(tmp_path, "one", "tolerance = 1e-3", places=PLACES[1:2])
    scene = (tmp_path / "one.toml").read_text().replace("velocity_m_s = 1.5\n", "")
    for section in ("target", "striker", "contact", "output"):
        scene = scene.replace(f"[{section}]", f"[scene.{section}]")
    scene = scene.replace("[[probe]]", "[[scene.probe]]")
    (tmp_path / "s.toml").write_text(scene + "[product.striker]\nvelocity_m_s = [1.5, 2.0]\n")
    run_well("sweep", "s.toml", "-o", "s.h5", cwd=tmp_path)
    with h5py.File(tmp_path / "s.h5") as file:
        for name in ("displacement_z", "velocity_z", "von_mises"):
            for own, suffix in (("_peak", "_peak"), ("_peak_time", "_peak_time"), ("_error", "_peak_error")):
                assert file[f"results/probe_1_{name}{own}"][0] == one[f"{name}{suffix}"][0], (name, own)


def test_a_low_pass_shows_what_a_filter_of_a_finer_output_shows(tmp_path):
    cutoff = 1.5e5
    _, fine = computed(tmp_path, "fine", "step_s = 4e-9", "")
    summary, found = computed(tmp_path, "seen", "", f"peaks = true\nlow_pass_hz = {cutoff}")
    assert summary["output_low_pass_hz"] == cutoff == found["attributes"]["output_low_pass_hz"]
    for name, within in (("displacement_z", 1e-3), ("velocity_z", 5e-3), ("stress_rr", 0.05)):
        for probe in (0, 4):
            values, time = fine[name][probe], fine["time"]
            padded = np.concatenate([np.zeros(len(values)), values, np.full(len(values), values[-1])])
            gain = 1 / (1 + (np.fft.rfftfreq(len(padded), time[1]) / cutoff) ** 8)
            exact = np.fft.irfft(np.fft.rfft(padded) * gain, len(padded))[len(values) : 2 * len(values)]
            inside = found["time"] < time[-1] - 5 / cutoff
            off = abs(np.interp(found["time"], time, exact) - found[name][probe])[inside].max()
            peak = abs(found[f"{name}_peak"][probe])
            assert off < min(found[f"{name}_error"][probe], within * peak), (name, probe, off / peak)
            assert abs(abs(exact).max() - peak) < found[f"{name}_peak_error"][probe]
    # the needle is gone: samples have the peak
    for name in ("velocity_z", "acceleration_z", "stress_rr"):
        sampled = abs(found[name]).max(axis=1)
        assert np.allclose(sampled, abs(found[f"{name}_peak"]), rtol=2e-3), name


@pytest.mark.parametrize("cutoff", [1e3, 1e9])
def test_a_cutoff_that_the_output_does_not_resolve_is_rejected(tmp_path, cutoff):
    text = BEAD.format(contact="", output=f"low_pass_hz = {cutoff}") + "[[probe]]\nr_m = 0.01\nz_m = 0.0\n"
    (tmp_path / "s.toml").write_text(text)
    done = run("impact", "s.toml", "-o", "s.h5", cwd=tmp_path)
    assert done.returncode == 2 and "output.low_pass_hz" in done.stderr and "step_s" in done.stderr
    assert not (tmp_path / "s.h5").exists()


def test_frames_of_a_section_are_seen_through_the_low_pass(tmp_path):
    section = '[map]\nr_max_m = 0.02\nz_max_m = 0.02\npoints = [3, 3]\nframes = 7\n'
    text = BEAD.format(contact="", output="peaks = true\nlow_pass_hz = 1e5") + section
    (tmp_path / "s.toml").write_text(text + "[[probe]]\nr_m = 0.02\nz_m = 0.01\n")
    run_well("impact", "s.toml", "-o", "s.h5", cwd=tmp_path)
    with h5py.File(tmp_path / "s.h5") as file:
        time, frames = file["time"][:], file["map/time"][:]
        at = [int(np.argmin(abs(time - t))) for t in frames]
        for name in ("displacement_z", "velocity_z", "von_mises"):
            probe = file[f"probes/{name}"][0]
            assert np.allclose(file[f"map/{name}"][:, 1, 2], probe[at], rtol=1e-5, atol=1e-6 * abs(probe).max()), name
            assert file[f"map/{name}_peak"][1, 2] == file[f"probes/{name}_peak"][0]
