"""Places on a free face of the block: a half-space's fields are not valid there, and the command says so."""

import h5py
import numpy as np
import pytest

from conftest import run_well

SCENE = """
[target]
material = "aluminium-6061-t6"
{block}
[striker]
material = "bearing-steel"
shape = "ball"
diameter_m = 0.003
drop_height_m = 0.1
{rest}
"""
ON_FACE = "free face"
ECHO = "echoes from the faces"


def warned(tmp_path, block, rest):
    """Warnings of the command, which are in its file too, and the arrivals that this has at probes."""
    (tmp_path / "scene.toml").write_text(SCENE.format(block=block, rest=rest))
    report = run_well("impact", tmp_path / "scene.toml", "-o", tmp_path / "out.h5", "--force")
    with h5py.File(tmp_path / "out.h5") as file:
        assert file.attrs["warnings"] == "\n".join(report["warnings"])
        times = None
        if "probes" in file:
            times = file["probes/arrival"][:, 0], file["probes/valid_until"][()]
    return report["warnings"], times


def probes(*places):
    return "".join(f"[[probe]]\nr_m = {r}\nz_m = {z}\n" for r, z in places)


@pytest.mark.parametrize(
    ("block", "place", "key"),
    [
        ("thickness_m = 0.021", (0.0, 0.021), "z_m = thickness_m = 0.021 m"),
        ("thickness_m = 0.021", (0.013, 0.021), "z_m = thickness_m = 0.021 m"),
        ("radius_m = 0.017", (0.017, 0.004), "r_m = radius_m = 0.017 m"),
    ],
)
def test_a_probe_on_a_free_face_is_said_not_to_be_valid(tmp_path, block, place, key):
    warnings, (first, valid_until) = warned(tmp_path, block, probes((0.004, 0.0), place))
    (sentence,) = [warning for warning in warnings if ON_FACE in warning]
    assert sentence.startswith("probe 2 is on") and key in sentence and "about doubles" in sentence
    # nothing comes before the echo there, and something does elsewhere
    assert valid_until[1] == pytest.approx(first[1], rel=1e-12) and valid_until[0] > 2.0 * first[0]
    # the echo of the other probe is another sentence, without this one
    assert all("of 2 probes" not in w or "1 of 2 probes" in w for w in warnings if ECHO in w)


def test_a_probe_inside_or_without_a_face_is_not(tmp_path):
    for block in ("", "thickness_m = 0.0211", "thickness_m = 0.3\nradius_m = 0.3"):
        warnings, _ = warned(tmp_path, block, probes((0.0, 0.021), (0.013, 0.021)))
        assert not any(ON_FACE in warning for warning in warnings), block


def test_several_probes_are_one_sentence(tmp_path):
    warnings, _ = warned(tmp_path, "thickness_m = 0.021", probes((0.0, 0.01), (0.0, 0.021), (0.002, 0.021)))
    (sentence,) = [warning for warning in warnings if ON_FACE in warning]
    assert sentence.startswith("2 of 3 probes, the first probe 2, are on")


def test_a_section_that_reaches_a_face_says_so(tmp_path):
    section = "[map]\nr_max_m = 0.006\nz_max_m = {depth}\npoints = [3, 4]\nframes = 4\n[output]\nduration_s = {end}\n"
    p_wave = np.sqrt(69e9 * 0.67 / (1.33 * 0.34) / 2700.0)  # aluminium-6061-t6, to a per cent

    def found(block, depth, end):
        return warned(tmp_path, block, section.format(depth=depth, end=end))[0]

    at_face = found("thickness_m = 0.008", 0.008, 2e-5)
    assert sum(ON_FACE in w and "z_max_m = thickness_m" in w for w in at_face) == 1
    inside = found("thickness_m = 0.02", 0.008, 2e-5)
    assert not any(ON_FACE in w for w in inside)
    # the echo comes up again to the lower edge: 2 h - z
    (sentence,) = [w for w in inside if ECHO in w]
    told_s = float(sentence.split("reach the section from ")[1].split(" s")[0])
    assert told_s == pytest.approx(0.032 / p_wave, rel=0.02)
    assert not any(ECHO in w for w in found("thickness_m = 0.02", 0.008, 0.9 * told_s))
