"""Bad input: one sentence on standard error that names key, value and range, exit code 2, nothing written over."""

import os

import pytest
from conftest import run

SCENE = """
[target]
youngs_modulus_pa = 2.09e11
poisson_ratio = 0.3
density_kg_m3 = 7830.0
[striker]
youngs_modulus_pa = 1.23e11
poisson_ratio = 0.34
mass_kg = 0.0122
tip_radius_m = 0.004
velocity_m_s = 100.0
[contact]
disc_radius_m = 0.004
model = "wave"
tolerance = 1e-4
step_s = 2e-7
[[probe]]
r_m = 0.004
z_m = 0.002
"""


def refused(*arguments, names=(), cwd=None):
    done = run(*arguments, cwd=cwd)
    message = done.stderr.strip()
    assert done.returncode == 2, (done.returncode, message)
    assert done.stdout == ""
    assert message.count("\n") == 0, f"more than one line:\n{message}"
    assert "panicked" not in message and "Error(" not in message
    for name in names:
        assert str(name) in message, f"{name} is not named in: {message}"
    return message


def write(folder, text, name="scene.toml"):
    path = folder / name
    path.write_text(text)
    return path


def spelt(value):
    """How a message may be expected to name a value: TOML's nan is Rust's NaN, and 0.0 may be 0."""
    return [] if value == "nan" else [value.removesuffix(".0")]


def test_the_scene_itself_is_good(tmp_path, table):
    done = run("impact", write(tmp_path, SCENE), "--table", table, "-o", tmp_path / "out.h5")
    assert done.returncode == 0, done.stderr


QUANTITIES = {
    "youngs_modulus_pa": "2.09e11",
    "density_kg_m3": "7830.0",
    "mass_kg": "0.0122",
    "tip_radius_m": "0.004",
    "velocity_m_s": "100.0",
    "disc_radius_m": "0.004",
    "tolerance": "1e-4",
    "step_s": "2e-7",
}


@pytest.mark.parametrize("bad", ["-1.0", "0.0", "nan", "inf", "-inf"])
@pytest.mark.parametrize("key", QUANTITIES)
def test_positive_quantities(tmp_path, table, key, bad):
    good = f"{key} = {QUANTITIES[key]}"
    assert good in SCENE
    out = tmp_path / "out.h5"
    scene = write(tmp_path, SCENE.replace(good, f"{key} = {bad}", 1))
    refused("impact", scene, "--table", table, "-o", out, names=[key, *spelt(bad)])
    assert not out.exists()


@pytest.mark.parametrize("bad", ["-1.0", "0.5", "0.7", "-1.5", "nan", "inf"])
@pytest.mark.parametrize("good", ["poisson_ratio = 0.3\n", "poisson_ratio = 0.34\n"])
def test_poisson_ratio(tmp_path, table, good, bad):
    out = tmp_path / "out.h5"
    scene = write(tmp_path, SCENE.replace(good, f"poisson_ratio = {bad}\n"))
    refused("impact", scene, "--table", table, "-o", out, names=["poisson_ratio", *spelt(bad)])
    assert not out.exists()


@pytest.mark.parametrize(
    "good, bad, named",
    [
        ("r_m = 0.004\nz", "r_m = -0.001\nz", "r_m"),
        ("z_m = 0.002", "z_m = -0.001", "z_m"),
        ("r_m = 0.004\nz", "r_m = nan\nz", "r_m"),
        ("z_m = 0.002", "z_m = inf", "z_m"),
    ],
)
def test_probe_coordinates(tmp_path, table, good, bad, named):
    out = tmp_path / "out.h5"
    assert good in SCENE
    refused("impact", write(tmp_path, SCENE.replace(good, bad)), "--table", table, "-o", out, names=[named])
    assert not out.exists()


def test_probe_outside_the_table(tmp_path, table):
    out = tmp_path / "out.h5"
    scene = write(tmp_path, SCENE.replace("r_m = 0.004\nz", "r_m = 4.0\nz"))
    refused("impact", scene, "--kernel", "table", "--table", table, "-o", out, names=["r/r0", "1000", "[0, 6]"])
    assert not out.exists()


def test_unknown_material_suggests(tmp_path, table):
    text = SCENE.replace(
        "youngs_modulus_pa = 2.09e11\npoisson_ratio = 0.3\ndensity_kg_m3 = 7830.0", 'material = "steal"'
    )
    message = refused("impact", write(tmp_path, text), "--table", table, "-o", tmp_path / "out.h5", names=["steal"])
    assert "steel" in message


def test_unknown_key_suggests(tmp_path, table):
    text = SCENE.replace("velocity_m_s", "velocty_m_s")
    message = refused(
        "impact", write(tmp_path, text), "--table", table, "-o", tmp_path / "out.h5", names=["velocty_m_s"]
    )
    assert "velocity_m_s" in message


def test_unknown_model(tmp_path, table):
    text = SCENE.replace('"wave"', '"waves"')
    refused("impact", write(tmp_path, text), "--table", table, "-o", tmp_path / "out.h5", names=["waves", "hertz"])


def test_not_toml(tmp_path, table):
    refused("impact", write(tmp_path, "[target\n"), "--table", table, "-o", tmp_path / "out.h5", names=["scene.toml"])


def test_missing_scene(tmp_path, table):
    refused("impact", tmp_path / "none.toml", "--table", table, "-o", tmp_path / "out.h5", names=["none.toml"])


def test_missing_table(tmp_path):
    out = tmp_path / "out.h5"
    refused("impact", write(tmp_path, SCENE), "--table", tmp_path / "none.h5", "-o", out, names=["none.h5"])
    assert not out.exists()


@pytest.mark.parametrize("kept", [0.0, 0.01, 0.5, 0.99])
def test_truncated_table(tmp_path, table, kept):
    data = table.read_bytes()
    broken = tmp_path / "broken.h5"
    broken.write_bytes(data[: int(kept * len(data))])
    out = tmp_path / "out.h5"
    refused("impact", write(tmp_path, SCENE), "--kernel", "table", "--table", broken, "-o", out, names=["broken.h5"])
    assert not out.exists()


def test_results_are_not_a_table(tmp_path, impact):
    refused(
        "impact",
        write(tmp_path, SCENE),
        "--kernel",
        "table",
        "--table",
        impact.path,
        "-o",
        tmp_path / "out.h5",
        names=[impact.path.name],
    )


def test_existing_output_is_kept_without_force(tmp_path, table):
    out = tmp_path / "out.h5"
    out.write_text("precious")
    scene = write(tmp_path, SCENE)
    refused("impact", scene, "--table", table, "-o", out, names=["out.h5", "--force"])
    assert out.read_text() == "precious"
    done = run("impact", scene, "--table", table, "-o", out, "--force")
    assert done.returncode == 0, done.stderr
    assert out.read_bytes()[:4] == b"\x89HDF"


def test_existing_table_is_kept_without_force(tmp_path):
    out = tmp_path / "kernels.h5"
    out.write_text("precious")
    refused("tabulate", "--grid", "demo", "-o", out, names=["kernels.h5", "--force"])
    assert out.read_text() == "precious"


def test_output_in_a_missing_folder(tmp_path, table):
    refused("impact", write(tmp_path, SCENE), "--table", table, "-o", tmp_path / "none" / "out.h5", names=["none"])
    assert not (tmp_path / "none").exists()


def test_output_that_is_a_folder(tmp_path, table):
    (tmp_path / "out.h5").mkdir()
    refused("impact", write(tmp_path, SCENE), "--table", table, "-o", tmp_path / "out.h5", "--force", names=["out.h5", "folder"])


@pytest.mark.skipif(os.geteuid() == 0, reason="root writes everywhere")
def test_output_in_a_folder_without_write_permission(tmp_path, table):
    folder = tmp_path / "locked"
    folder.mkdir(mode=0o555)
    refused("impact", write(tmp_path, SCENE), "--table", table, "-o", folder / "out.h5", names=["locked"])


def test_nothing_is_left_behind_by_a_refusal(tmp_path, table):
    scene = write(tmp_path, SCENE.replace("mass_kg = 0.0122", "mass_kg = -1.0"))
    refused("impact", scene, "--table", table, "-o", tmp_path / "out.h5")
    assert [path.name for path in tmp_path.iterdir()] == ["scene.toml"]


@pytest.mark.parametrize(
    ("arguments", "names"),
    [
        (["nosuch"], "subcommand 'nosuch'"),
        (["impact"], "<SCENE>"),
        (["impact", "a.toml", "--nosuch"], "argument '--nosuch'"),
        (["tabulate", "--grid", "nosuch", "-o", "x.h5"], "demo, standard, wide"),
    ],
)
def test_bad_usage(tmp_path, arguments, names):
    done = run(*arguments, cwd=tmp_path)
    assert done.returncode == 2 and names in done.stderr
    assert list(tmp_path.iterdir()) == []
