"""Numbers of the package: those of the command, to the last bit."""

import pickle
import subprocess
import sys

import h5py
import numpy as np
import pytest

import hertzlamb as hl
from conftest import ROOT, run, run_well
from hertzlamb import _names
from hertzlamb._impact import DESCRIBED

SCENES = ROOT / "scenes"
BALL = {
    "target": {"material": "granite"},
    "striker": {"material": "bearing-steel", "mass_kg": 1.105e-4, "tip_radius_m": 1.5e-3, "velocity_m_s": 1.98},
    "probe": [{"r_m": 0.02, "z_m": 0.0}, {"r_m": 0.0, "z_m": 0.02}],
}
SECTION = {
    "target": {"youngs_modulus_pa": 2.09e11, "poisson_ratio": 0.3, "density_kg_m3": 7830},
    "striker": {"material": "copper", "mass_kg": 0.0122, "tip_radius_m": 0.004, "velocity_m_s": 100.0},
    "contact": {"model": "wave", "disc_radius_m": 0.004},
    "map": {"r_max_m": 0.016, "z_max_m": 0.016, "points": [9, 7], "frames": 5},
    "output": {"quantities": ["velocity_z", "von_mises"], "peaks": True},
}
# What sweeps have where a law of flow is asked for.
OF_FLOW = [
    "yield_pressure_pa",
    "yield_velocity_m_s",
    "velocity_over_yield",
    "velocity_over_trusted",
    "plastic_work_j",
    "peak_indentation_m",
    "residual_indentation_m",
    "dent_radius_m",
]
FEW = """
[scene.target]
material = "granite"
[scene.striker]
tip_radius_m = 0.005
mass_kg = 4.1e-3
[product.striker]
material = ["steel", "copper"]
velocity_m_s = { from = 0.1, to = 10.0, count = 40, spacing = "log" }
[random]
samples = 3
seed = 1
[random.contact]
tolerance = { distribution = "uniform", low = 1e-5, high = 1e-3 }
"""

pytestmark = pytest.mark.filterwarnings("ignore::hertzlamb.HertzlambWarning")


def toml(table, name=""):
    """A nested dictionary as TOML, for the command."""
    plain = "".join(
        f"{key} = {value!r}\n".replace("'", '"').replace("True", "true")
        for key, value in table.items()
        if not isinstance(value, dict) and not (isinstance(value, list) and isinstance(value[0], dict))
    )
    inner = ""
    for key, value in table.items():
        if isinstance(value, dict):
            inner += f"[{name}{key}]\n" + toml(value, f"{name}{key}.")
        elif isinstance(value, list) and isinstance(value[0], dict):
            inner += "".join(f"[[{name}{key}]]\n" + toml(row) for row in value)
    return plain + inner


def same(one, two):
    """Equal to the last bit, NaN too."""
    one, two = np.asarray(one), np.asarray(two)
    return one.shape == two.shape and one.dtype == two.dtype and one.tobytes() == two.tobytes()


def compare(run_here, command, path):
    """Scalars with the JSON object, arrays with the file of the command."""
    for name, value in run_here.numbers.items():
        assert command[name] == value, name
    for name, value in run_here.report.items():
        assert name == "wall_s" or command[name] == value, name
    compared = 0
    with h5py.File(path) as file:
        for name in ("time", "force", "displacement", "velocity", "deflection"):
            array = run_here._series.get(name)
            assert (array is None) == (name not in file)
            if array is not None:
                assert same(array, file[name][()]), name
                compared += 1
        groups = [("energy", run_here.energy), ("probes", run_here._probes), ("map", run_here._section)]
        for group, arrays in groups:
            assert (arrays is None) == (group not in file), group
            for name, array in (arrays or {}).items():
                assert same(array, file[group][name][()].astype(array.dtype)), (group, name)
                compared += 1
        assert file.attrs["scene"]
    return compared


@pytest.mark.parametrize("name", ["ball-drop", "prescribed-force", "copper-on-steel"])
def test_a_file_gives_what_the_command_gives(name, tmp_path):
    path = tmp_path / "out.h5"
    command = run_well("impact", SCENES / f"{name}.toml", "-o", path)
    here = hl.impact(SCENES / f"{name}.toml")
    assert compare(here, command, path) > 10


@pytest.mark.parametrize(
    ("asked", "given"),
    [
        (["--restitution", "0.56", "--error", "0.01"], {"restitution": 0.56, "error": 0.01}),
        (["--bounces", "0.32,0.18", "--error", "0.002"], {"bounces": (0.32, 0.18), "error": 0.002}),
        (["--peak-force", "120", "--unknown", "velocity_m_s"], {"peak_force_n": 120, "unknown": "velocity_m_s"}),
    ],
)
def test_what_is_inferred_is_that_of_the_command(asked, given):
    scene = SCENES / "plastic-drop.toml"
    assert hl.infer(scene, **given)._asdict() == run_well("infer", scene, *asked)
    with pytest.raises(hl.SceneError, match="2 measurements are given"):
        hl.infer(scene, restitution=0.5, bounces=(0.3, 0.1))


def test_a_dictionary_gives_what_the_command_gives_with_a_table(tmp_path, table):
    scene = tmp_path / "scene.toml"
    scene.write_text(toml(SECTION))
    path = tmp_path / "out.h5"
    command = run_well("impact", scene, "--table", table, "--kernel", "table", "-o", path)
    opened = hl.Table.open(table)
    here = hl.impact(SECTION, opened, kernel="table")
    assert here.section.stress_zz.shape == here.section.von_mises.shape == (5, 7, 9)
    assert here.section.von_mises_peak.shape == (7, 9)
    assert compare(here, command, path) > 20
    # the part of the table is kept: the second time, and nearer to the axis, with the same bits
    again = hl.impact(SECTION, opened, kernel="table")
    assert same(again.section.stress_zz, here.section.stress_zz)
    probe = {**SECTION, "map": None, "probe": [{"r_m": 0.004, "z_m": 0.004}]}
    fresh = hl.impact(probe, table, kernel="table")
    assert same(hl.impact(probe, opened, kernel="table").probes.stress_zz, fresh.probes.stress_zz)
    assert fresh.to_xarray()["von_mises_peak"].attrs["units"] == "Pa"
    # the velocity is that of the kernels, about that of differences, and none without being asked for
    differences = np.gradient(fresh.probes.displacement_z, fresh.time, axis=1)
    assert np.max(np.abs(differences - fresh.probes.velocity_z)) < 0.05 * np.max(np.abs(differences))
    with pytest.raises(AttributeError, match="no 'velocity_r'.*quantities"):
        _ = fresh.probes.velocity_r


def test_dictionary_path_and_text_are_one_scene(tmp_path):
    path = tmp_path / "ball.toml"
    path.write_text(toml(BALL))
    runs = [hl.impact(given) for given in (BALL, path, str(path), path.read_text())]
    for other in runs[1:]:
        assert other.numbers == runs[0].numbers
        assert same(other.probes.stress_rr, runs[0].probes.stress_rr)
    assert hl.impact(runs[0].scene).numbers == runs[0].numbers
    assert hl.resolve(BALL) == runs[0].scene


def test_every_result_has_an_attribute():
    described = hl.impact(BALL).numbers
    assert list(hl.Impact.__annotations__) == list(_names.OfRows.__annotations__) == list(described)
    fields = [*DESCRIBED["fields"], *DESCRIBED["more"]]
    assert list(_names.OfFields.__annotations__) == fields and list(_names.OfEnergy.__annotations__) == list(DESCRIBED["energy"])
    beside = [f"{field}_{what}" for field in fields for what in ("error", "peak", "peak_time", "peak_error")]
    assert list(_names.OfPlaces.__annotations__) == beside
    asked = {**SECTION, "output": {"quantities": [*DESCRIBED["more"]], "peaks": True}}
    section = hl.impact(asked).section
    block = {**SECTION["target"], "thickness_m": 0.1, "echoes": 2}
    probes = hl.impact({**asked, "target": block, "map": None, "probe": BALL["probe"]}).probes
    for arrays, own in ((probes, _names.OfProbes), (section, _names.OfSection)):
        assert set(arrays) == {*fields, *beside, *own.__annotations__}


def test_what_was_not_asked_for_says_so():
    record = hl.impact(SCENES / "prescribed-force.toml")
    assert np.isnan(record.restitution) and record.contacts == 0 and record.numbers["restitution"] is None
    plain = hl.impact({key: BALL[key] for key in ("target", "striker")})
    for ask in (lambda: record.velocity, lambda: plain.probes, lambda: plain.section, lambda: plain.plot_probes()):
        with pytest.raises(hl.SceneError, match="there is no velocity|has no probes|has no section"):
            ask()
    with pytest.raises(AttributeError, match="no attribute 'restitutoin'"):
        plain.restitutoin


def test_what_is_saved_holds_the_same_numbers(tmp_path):
    path = tmp_path / "command.h5"
    scene = tmp_path / "ball.toml"
    scene.write_text(toml(BALL))
    run_well("impact", scene, "-o", path, "--csv", tmp_path / "command.csv")
    here = hl.impact(BALL)
    here.save(tmp_path / "here.h5")
    here.save_csv(tmp_path / "here.csv")
    assert (tmp_path / "here.csv").read_bytes() == (tmp_path / "command.csv").read_bytes()
    found = []
    with h5py.File(path) as one, h5py.File(tmp_path / "here.h5") as two:
        one.visititems(lambda name, item: found.append(name))
        for name in found:
            if isinstance(one[name], h5py.Dataset) and one[name].dtype.kind != "O":
                assert same(one[name][()], two[name][()]), name
        assert dict(one.attrs) == dict(two.attrs)
    assert len(found) > 20
    with pytest.raises(hl.OutputExists):
        here.save(tmp_path / "here.h5")
    here.save(tmp_path / "here.h5", overwrite=True)


def test_a_sweep_and_any_part_of_it_give_what_the_command_gives(tmp_path):
    spec = tmp_path / "sweep.toml"
    spec.write_text(FEW)
    run_well("sweep", spec, "-o", tmp_path / "sweep.h5", "--csv", tmp_path / "sweep.csv")
    whole = hl.sweep(spec)
    assert whole.is_whole and len(whole.rows) == 240
    with h5py.File(tmp_path / "sweep.h5") as file:
        for name in [*hl.Impact.__annotations__]:
            if name in file["results"]:
                assert same(whole[name].reshape(2, 40, 3), file["results"][name][()].astype(float)), name
            else:
                assert name in OF_FLOW and np.all(np.isnan(whole[name])), name
        assert same(whole.to_xarray()["striker.velocity_m_s"].values, file["axes/striker.velocity_m_s"][()])
    part = hl.sweep(FEW, rows=slice(7, 200, 5), threads=1)
    assert len(part.rows) == 39
    assert same(part._numbers, whole._numbers[:, 7:200:5])
    assert same(part["contact.tolerance"], whole["contact.tolerance"][7:200:5])
    assert list(part["striker.material"]) == list(whole["striker.material"][7:200:5])
    whole.save(tmp_path / "here.csv")
    assert (tmp_path / "here.csv").read_bytes() == (tmp_path / "sweep.csv").read_bytes()
    whole.save(tmp_path / "here.h5")
    with h5py.File(tmp_path / "sweep.h5") as one, h5py.File(tmp_path / "here.h5") as two:
        assert same(one["results/restitution"][()], two["results/restitution"][()])
    whole.save(tmp_path / "here.parquet")
    table = pytest.importorskip("pyarrow.parquet").read_table(tmp_path / "here.parquet")
    assert same(table["restitution"].to_numpy(zero_copy_only=False), whole["restitution"])
    assert table["striker.material"].to_pylist() == list(whole["striker.material"])
    done = run("sweep", spec, "-o", tmp_path / "sweep.parquet")
    if "built without" not in done.stderr:
        assert table.equals(pytest.importorskip("pyarrow.parquet").read_table(tmp_path / "sweep.parquet"))
    with pytest.raises(ValueError, match="39 of 240 rows"):
        part.save(tmp_path / "part.h5")


def test_collide_gives_what_impact_gives_for_any_key():
    scene = {"target": {"material": "granite"}, "striker": {"material": "steel", "tip_radius_m": 5e-4}}
    velocity = np.geomspace(0.1, 10.0, 7)
    out = hl.collide(scene, velocity_m_s=velocity, mass_kg=[[4e-6], [8e-6]], target__poisson_ratio=0.21)
    assert out.restitution.shape == (2, 7) and not out.failures
    for i, mass in enumerate([4e-6, 8e-6]):
        for j in (0, 3, 6):
            striker = {**scene["striker"], "mass_kg": mass, "velocity_m_s": velocity[j]}
            one = hl.impact({"target": {"material": "granite", "poisson_ratio": 0.21}, "striker": striker})
            for name, value in one.numbers.items():
                assert out[name][i, j] == value or value is None and np.isnan(out[name][i, j]), name
            assert out.model[i, j] == one.model
    words = hl.collide(scene, velocity_m_s=1.0, mass_kg=1e-5, striker__material=["copper", "steel"])
    assert words.shape == (2,) and words.restitution[0] != words.restitution[1]
    ball = {"target": {"material": "granite"}, "striker": {"material": "steel", "shape": "ball"}}
    drop = hl.collide(ball, diameter_m=[1e-3, 2e-3], drop_height_m=0.1)
    one = hl.impact({**ball, "striker": {**ball["striker"], "diameter_m": 2e-3, "drop_height_m": 0.1}})
    assert drop.restitution[1] == one.restitution
    assert hl.collide(scene, velocity_m_s=[], mass_kg=1.0).restitution.shape == (0,)


COLUMNS = ["loss", "contacts", "peak_force_n"]


def test_chosen_columns_are_those_of_the_command(tmp_path):
    spec = tmp_path / "sweep.toml"
    spec.write_text(FEW.replace("samples = 3", "samples = 2"))
    run_well("sweep", spec, "-o", tmp_path / "few.h5", "--csv", tmp_path / "few.csv", "--columns", ",".join(COLUMNS))
    whole, few = hl.sweep(spec), hl.sweep(spec, columns=COLUMNS)
    assert [name for name in few if "." not in name] == ["peak_force_n", "loss", "contacts", "model"]
    assert few._numbers.size < whole._numbers.size / 5
    for name in COLUMNS:
        assert same(few[name], whole[name]) and few[name].flags.c_contiguous, name
    for each in (few, pickle.loads(pickle.dumps(few))):
        each.save(tmp_path / "here.csv", overwrite=True)
        assert (tmp_path / "here.csv").read_bytes() == (tmp_path / "few.csv").read_bytes()
        each.save(tmp_path / "here.h5", overwrite=True)
        with h5py.File(tmp_path / "few.h5") as one, h5py.File(tmp_path / "here.h5") as two:
            assert set(one["results"]) == set(two["results"]) >= set(COLUMNS)
            counted = [name for name in one.attrs if name not in ("created", "software_version")]
            assert counted and all(np.array_equal(one.attrs[name], two.attrs[name]) for name in counted)
    scene = {"target": {"material": "granite"}, "striker": {"material": "steel", "shape": "ball", "diameter_m": 3e-3}}
    velocity = np.geomspace(0.1, 2.0, 5)
    out, all_of_them = hl.collide(scene, columns=["restitution"], velocity_m_s=velocity), hl.collide(scene, velocity_m_s=velocity)
    assert same(out.restitution, all_of_them.restitution) and list(out) == ["striker.velocity_m_s", "restitution", "model"]
    assert list(out.to_xarray().data_vars) == ["restitution", "model"] and list(out.to_pandas())[1:] == ["restitution", "model", "failure"]
    assert hl.collide(scene, columns=["loss"], velocity_m_s=[]).loss.shape == (0,)
    with pytest.raises(AttributeError, match="loss is not among the requested columns, restitution"):
        _ = out.loss
    with pytest.raises(hl.SceneError, match="\"losss\" is not one of"):
        hl.collide(scene, columns=["losss"], velocity_m_s=velocity)
    with pytest.raises(TypeError):
        hl.collide(scene, columns="loss", velocity_m_s=velocity)


def test_numbers_are_saved_by_their_indices(tmp_path):
    whole = hl.sweep(FEW)
    whole.save(tmp_path / "one.csv")
    for order in (np.asfortranarray, lambda numbers: np.repeat(numbers, 2, axis=1)[:, ::2], lambda numbers: numbers[::-1].copy()[::-1]):
        other = hl.sweep(FEW)
        other._numbers = order(other._numbers)
        other.save(tmp_path / "two.csv", overwrite=True)
        assert (tmp_path / "one.csv").read_bytes() == (tmp_path / "two.csv").read_bytes()
    other._numbers = other._numbers[:, 1:]
    with pytest.raises(hl.HertzlambError, match="not those of 240 rows"):
        other.save(tmp_path / "two.csv", overwrite=True)


EACH_KEY = """
[scene.target]
poisson_ratio = 0.27
[scene.striker]
shape = "rod"
length_m = 0.1
diameter_m = 0.02
[list.target]
youngs_modulus_pa = [6e10, 7e10]
density_kg_m3 = [2600, 2700]
yield_strength_pa = [1e9, 2e9]
tensile_strength_pa = [1e8, 2e8]
fracture_toughness_pa_sqrt_m = [1e6, 2e6]
thickness_m = [1.0, 2.0]
[list.striker]
material = ["steel", "copper"]
tip_radius_m = [0.1, 0.2]
drop_height_m = [0.1, 0.2]
[list.contact]
tolerance = [1e-3, 1e-4]
step_s = [1e-6, 2e-6]
"""


def test_units_of_keys_are_those_of_the_command(tmp_path):
    pytest.importorskip("xarray")
    (tmp_path / "keys.toml").write_text(EACH_KEY)
    run_well("sweep", tmp_path / "keys.toml", "-o", tmp_path / "keys.h5")
    scene = {"target": {"poisson_ratio": 0.27}, "striker": {"shape": "rod", "length_m": 0.1, "diameter_m": 0.02}}
    keys = {
        "target__youngs_modulus_pa": [6e10, 7e10],
        "target__density_kg_m3": [2600, 2700],
        "target__fracture_toughness_pa_sqrt_m": [1e6, 2e6],
        "striker__material": ["steel", "copper"],
        "tip_radius_m": [0.1, 0.2],
        "drop_height_m": [0.1, 0.2],
        "step_s": [1e-6, 2e-6],
    }
    sweep, collisions = hl.sweep(EACH_KEY), hl.collide(scene, **keys)
    compared = set()
    with h5py.File(tmp_path / "keys.h5") as file:
        for data in (sweep.to_xarray(), hl.sweep(EACH_KEY, rows=slice(0, 1)).to_xarray(), collisions.to_xarray()):
            for name in file["axes"]:
                if "." in name and name in data.coords:
                    described = file["axes"][name].attrs
                    assert data[name].attrs == {key: described[key] for key in ("units", "long_name")}, name
                    compared.add(name)
        arrow = pytest.importorskip("pyarrow") and sweep.to_arrow()
        for name in compared:
            assert arrow.schema.field(name).metadata[b"units"].decode() == file["axes"][name].attrs["units"]
    assert len(compared) == 11 and sweep.to_xarray()["target.fracture_toughness_pa_sqrt_m"].attrs["units"] == "Pa m^(1/2)"


def test_a_force_is_given_as_arrays(tmp_path):
    time = np.linspace(0.0, 3.1e-5, 400)
    force = 37.0 * np.sin(np.pi * time / time[-1]) ** 2
    rest = {"target": {"material": "steel"}, "contact": {"disc_radius_m": 0.003}, "probe": [{"r_m": 0.004, "z_m": 0.001}]}
    csv = tmp_path / "pulse.csv"
    csv.write_text("time_s,force_n\n" + "".join(f"{t!r},{p!r}\n" for t, p in zip(time.tolist(), force.tolist())))
    for more in ({}, {"start_s": 2e-6, "end_s": 2.5e-5, "sign": -1}, {"low_pass_hz": 4e5, "baseline_s": 1e-6}):
        read = hl.impact({**rest, "force": {"file": str(csv), **more}})
        for samples in ({"time_s": time, "force_n": force}, {"time_s": time.tolist(), "force_n": tuple(force)}):
            given = hl.impact({**rest, "force": {**samples, **more}})
            assert given.numbers == read.numbers and same(given.force, read.force) and given.warnings == read.warnings
            assert same(given.probes.stress_rr, read.probes.stress_rr)
        # the scene is whole: in Python, in a file of it, and in the results
        assert "file" not in given.scene["force"] and hl.impact(given.scene).numbers == read.numbers
        (tmp_path / "scene.toml").write_text(toml(given.scene))
        path = tmp_path / "out.h5"
        assert run_well("impact", tmp_path / "scene.toml", "-o", path, "--force")["peak_force_n"] == read.peak_force_n
        given.save(path, overwrite=True)
        with h5py.File(path) as file:
            assert hl.impact(file.attrs["scene"]).numbers == read.numbers
        assert run("plot", path, "-o", tmp_path / "out.svg", "--force").returncode == 0


def test_arrays_that_are_no_force_are_named():
    rest = {"target": {"material": "steel"}, "contact": {"disc_radius_m": 0.003}}
    time, force = np.linspace(0.0, 1e-5, 5), np.array([0.0, 2.0, 5.0, 1.0, 0.0])
    for wrong, words in (
        ({"time_s": time}, "force.force_n is missing"),
        ({"time_s": time, "force_n": force[1:]}, "5 samples and force.force_n 4"),
        ({"time_s": time[::-1], "force_n": force}, "times must ascend"),
        ({"time_s": time - 1e-6, "force_n": force}, "force.start_s"),
        ({"time_s": time, "force_n": force * np.nan}, r"force.force_n\[1\] = NaN"),
        ({"time_s": [0.0, 1.0, "2"], "force_n": force[:3]}, "force.time_s = .* is not a list of numbers"),
        ({"time_s": time, "force_n": np.ma.array(force, mask=force > 4)}, "force.force_n has masked entries"),
        ({"time_s": time.astype("timedelta64[ns]"), "force_n": force}, "force.time_s .* time differences"),
        ({"time_s": time, "force_n": force, "file": "x.csv"}, "force.file cannot be combined with"),
        ({"time_s": time, "force_n": force, "columns": [1, 2]}, "force.columns cannot be combined with"),
        ({"time_s": np.arange(131_073.0), "force_n": np.ones(131_073)}, "131073 samples, more than the 131072"),
        ({}, "force.file is missing: .* time_s and force_n"),
    ):
        with pytest.raises(hl.SceneError, match=words):
            hl.impact({**rest, "force": wrong})


def test_the_longest_force_of_a_scene_is_read_back(tmp_path):
    count = 131_072
    time = np.cumsum(np.random.default_rng(3).uniform(0.9e-9, 1.1e-9, count))
    force = 1e3 * np.sin(np.pi * np.arange(count) / (count - 1)) * 0.9999999999
    run_here = hl.impact({"target": {"material": "steel"}, "contact": {"disc_radius_m": 0.003}, "force": {"time_s": time, "force_n": force}})
    run_here.save(tmp_path / "long.h5")
    with h5py.File(tmp_path / "long.h5") as file:
        text = file.attrs["scene"]
    assert 4e6 < len(text) < 8 << 20
    (tmp_path / "long.toml").write_text(text)
    assert run_well("impact", tmp_path / "long.toml")["impulse_n_s"] == run_here.impulse_n_s
    assert run("plot", tmp_path / "long.h5", "-o", tmp_path / "long.svg").returncode == 0


def test_counts_are_whole_numbers_in_tables_of_others():
    pd = pytest.importorskip("pandas")
    out = hl.collide(BALL | {"probe": None}, velocity_m_s=[1.0, -1.0, 2.0])
    frame = out.to_pandas()
    for name in ("contacts", "march_steps"):
        assert frame[name].dtype == pd.Int64Dtype() and list(frame[name].isna()) == [False, True, False]
        assert frame[name][0] == out[name][0]
    arrow = pytest.importorskip("pyarrow") and out.to_arrow()
    assert arrow.schema.field("contacts").type == "int64" and arrow["contacts"].to_pylist() == [1, None, 1]
    frame.loc[0, "loss"] = 0.5
    assert out.loss[0] != 0.5, "the frame is its own"
    polars = pytest.importorskip("polars")
    assert out.to_polars()["contacts"].to_list() == [1, None, 1] and out.to_polars()["contacts"].dtype == polars.Int64


def test_results_are_tables_of_others(table):
    pd, pa, xr = (pytest.importorskip(name) for name in ("pandas", "pyarrow", "xarray"))
    out = hl.sweep(FEW, rows=slice(0, 12))
    frame, arrow = out.to_pandas(), out.to_arrow()
    assert isinstance(frame, pd.DataFrame) and isinstance(arrow, pa.Table)
    assert list(frame.columns) == arrow.schema.names == [*out, "failure"]
    assert same(frame["loss"].to_numpy(), out.loss) and same(arrow["loss"].to_numpy(), out.loss)
    assert arrow.schema.field("peak_force_n").metadata[b"units"] == b"N"
    assert arrow["striker.material"].to_pylist() == ["steel"] * 12
    rows = out.to_xarray()
    assert rows.sizes == {"row": 12} and rows["peak_force_n"].attrs["units"] == "N"
    scene = {key: BALL[key] for key in ("target", "striker")}
    grid = hl.collide(scene, velocity_m_s=[[1.0], [2.0]], mass_kg=[1e-4, 2e-4, 3e-4]).to_xarray()
    assert grid["loss"].dims == ("dim_0", "dim_1") and grid["striker.mass_kg"].attrs["units"] == "kg"
    section = hl.impact(SECTION, table).section.to_xarray()
    assert section["von_mises"].dims == ("time", "z", "r") and section["von_mises_error"].dims == ("z", "r")
    assert isinstance(hl.materials().to_pandas().loc["granite", "density_kg_m3"], float)
    trace = hl.Table.open(table).trace(0.3, [0.5, 1.0], 0.6, cells=7).to_xarray()
    assert trace["stress_zz"].dims == ("point", "time") and isinstance(trace, xr.Dataset)
    polars = pytest.importorskip("polars")
    assert out.to_polars()["loss"].to_list() == list(out.loss) and isinstance(out.to_polars(), polars.DataFrame)


def test_threads_change_no_bit(table):
    opened = hl.Table.open(table)
    rng = np.random.default_rng(1)
    r, z = rng.uniform(0, 6, (2, 300))
    one, all_of_them = (opened.trace(0.3, r, z, threads=n) for n in (1, None))
    assert same(one.array, all_of_them.array)
    t = np.linspace(0, 5, 40)
    assert same(hl.kernels.step(0.3, 0.5, 0.6, t, threads=1).array, hl.kernels.step(0.3, 0.5, 0.6, t).array)
    assert same(hl.impact(BALL, threads=1).probes.stress_zz, hl.impact(BALL, threads=3).probes.stress_zz)


def test_kernels_are_right_and_broadcast():
    # w = 0.11959942786 from an independent Laplace-Hankel inversion
    k = hl.kernels.step(nu=0.3, r=0.5, z=0.6, t=2.0)
    assert k.displacement_z.shape == () and abs(k["displacement_z"] - 0.11959942786) < 1e-10
    t = np.linspace(0.0, 4.0, 9)
    k = hl.kernels.step(0.3, r=[[0.5], [1.5]], z=0.6, t=t)
    assert k.stress_zz.shape == (2, 9) and k.error.stress_zz.shape == (2, 9)
    assert k["displacement_z"][0, 4] == hl.kernels.step(0.3, 0.5, 0.6, 2.0).displacement_z
    still = hl.kernels.static(0.3, [0.5, 1.5], 0.6)
    rest = hl.kernels.remainder(0.3, r=[[0.5], [1.5]], z=0.6, t=t)
    assert same(k.array, still.array[:, None, :] + rest.array)
    assert np.all(k.array[:, 0] == 0)
    assert abs(still.displacement_z[0] - hl.kernels.step(0.3, 0.5, 0.6, 1e4).displacement_z) < 1e-6
    # Kausel's closed form over r0/c2
    kappa = hl.kernels.medium(0.3).shear_speed
    t2 = np.linspace(0, 2, 50)
    assert np.max(np.abs(hl.kernels.surface_centre(0.3, t2) - hl.kernels.surface_step(0.3, t2 / kappa))) < 1e-12
    h = 1e-4
    slope = (hl.kernels.surface_step(0.3, 1.0 + h) - hl.kernels.surface_step(0.3, 1.0 - h)) / (2 * h)
    assert abs(slope - hl.kernels.surface_impulse(0.3, 1.0)) < 1e-5
    assert hl.kernels.medium(0.3).arrivals(0.0, 3.0).first == 3.0


def test_spectra_are_right_and_broadcast():
    # mu r G on the surface at omega r/c2 = 1 and 3 from a direct integral of another program, moduli times exp(i atan(1/Q))
    c2 = hl.kernels.medium(0.25).shear_speed
    f = np.array([1.0, 3.0]) * c2 / (2 * np.pi)
    for quality, wanted in (
        (20.0, [3.290568780107e-02 - 1.133417449432e-01j, -1.063594356415e-01 + 6.746642474715e-02j]),
        (100.0, [3.838442232433e-02 - 1.147118626428e-01j, -1.172091402257e-01 + 6.738921343302e-02j]),
    ):
        own = hl.kernels.spectrum(0.25, 1.0, 0.0, f, profile="point", quality_factor=quality)
        assert own.displacement_z.shape == (2,) and np.max(np.abs(own.displacement_z - wanted)) < 1e-10
        same_law = hl.kernels.spectrum(0.25, 1.0, 0.0, f[1], profile="point", quality_factor=quality, reference_frequency=f[1])
        assert same_law.displacement_z == own.displacement_z[1]
    wide = hl.kernels.spectrum(0.3, [[0.5], [1.5]], 0.6, np.linspace(0, 2, 9))
    assert wide.stress_zz.shape == (2, 9) and wide.error.stress_zz.shape == (2, 9) and wide.frequency.shape == (2, 9)
    assert same(wide.array[:, 0].real, hl.kernels.static(0.3, [0.5, 1.5], 0.6).array)
    assert np.array_equal(wide.velocity_z, 2j * np.pi * wide.frequency * wide.displacement_z)
    assert same(pickle.loads(pickle.dumps(wide)).array, wide.array)
    with pytest.raises(hl.DomainError, match="frequency = 0 is outside"):
        hl.kernels.spectrum(0.3, 0.5, 0.6, 0.0, quality_factor=20)
    with pytest.raises(hl.DomainError, match="quality_factor = 0.5 is outside"):
        hl.kernels.spectrum(0.3, 0.5, 0.6, 1.0, quality_factor=0.5)
    with pytest.raises(hl.SceneError, match="without quality_factor"):
        hl.kernels.spectrum(0.3, 0.5, 0.6, 1.0, reference_frequency=1.0)


def test_attenuation_damps_fields_and_not_the_contact():
    soft = {**BALL, "target": {**BALL["target"], "quality_factor": 30, "reference_frequency_hz": 1e3}}
    elastic, damped = hl.impact(BALL), hl.impact(soft)
    assert damped.peak_force_n == elastic.peak_force_n
    # at the frequencies of a contact the block is stiffer than at the reference, and waves lose energy
    peaks = [np.max(np.abs(run.probes.displacement_z)) for run in (elastic, damped)]
    assert peaks[1] < peaks[0]
    assert any("quality_factor" in warning for warning in damped.warnings)
    with pytest.raises(hl.SceneError, match="reference_frequency_hz|quality_factor"):
        hl.impact({**BALL, "target": {**BALL["target"], "reference_frequency_hz": 1e5}})
    with pytest.raises(hl.SceneError, match="strain"):
        hl.impact({**soft, "output": {"quantities": ["strain_rr"]}})


def test_a_table_answers_as_the_command_says(table, tmp_path):
    opened = hl.Table.open(table)
    assert opened.info() == run_well("table", "info", table)
    u = opened.trace(0.3, r=[0.5, 4.0], z=[0.6, 0.0], cells=40)
    assert u["stress_zz"].shape == (2, 40) and u.time.shape == (40,)
    # the response to a pulse of ten cells, beside averages over cells from the exact kernels
    edges = np.append(u.time - 0.5 * u.cell_width, u.time[-1] + 0.5 * u.cell_width)
    sums = hl.kernels.step_integral(0.3, r=[[0.5], [4.0]], z=[[0.6], [0.0]], t=np.maximum(edges, 0.0))
    exact = np.diff(sums.array, axis=1) / u.cell_width + u.static.array[:, None, :]
    rises = np.diff(np.sin(np.pi * np.arange(11) / 10) ** 2)
    response = [sum(rise * each[:, 10 - m : 40 - m] for m, rise in enumerate(rises)) for each in (exact, u.array)]
    assert np.all(np.abs(response[0] - response[1]) <= u.error.array[:, None, :])
    assert np.max(np.abs(response[0][..., 1])) > 0.04
    assert opened.trace(0.3, 0.5, 0.6).stress_zz.ndim == 1
    for piece in (opened.id, "99 %", "0.3", "53 nodes"):
        assert piece in repr(opened)


def test_a_table_is_the_commands(tmp_path):
    grid = {
        "poisson_ratios": [0.3],
        "cell_width": 0.5,
        "pulse_lengths": [10.0],
        "tolerance": 1e-6,
        "r": {"max": 0.875, "spacing": 0.125},
        "z": {"max": 0.875, "spacing": 0.125},
    }
    told = []
    here = hl.tabulate(tmp_path / "here.h5", grid, progress=lambda done, total: told.append((done, total)))
    (tmp_path / "grid.toml").write_text(toml(grid))
    run_well("tabulate", "--grid", tmp_path / "grid.toml", "-o", tmp_path / "command.h5")
    assert run("table", "diff", tmp_path / "here.h5", tmp_path / "command.h5").returncode == 0
    assert told and all(0 <= done <= total for done, total in told)
    with pytest.raises(hl.OutputExists):
        hl.tabulate(tmp_path / "here.h5", grid)
    more = here.extend(nu=0.25)
    assert list(more.poisson_ratios) == [0.25, 0.3] and more.id != here.id
    stale = pickle.dumps(more)
    more.extend(nu=0.35)
    assert more.trace(0.25, 0.5, 0.5).nu == 0.25, "what was loaded stays"
    unread = hl.Table.open(more.path)
    more.extend(nu=0.4)
    for refused in (lambda: unread.trace(0.25, 0.5, 0.5), lambda: pickle.loads(stale)):
        with pytest.raises(hl.BadTable, match="another table"):
            refused()


def test_materials_are_the_commands():
    listed = run_well("materials")
    here = hl.materials()
    assert [row._asdict() for row in here] == listed
    assert here["granite"].density_kg_m3 == here[here.names.index("granite")].density_kg_m3
    assert here.column("poisson_ratio").shape == (len(here),)
    assert len(hl.materials("rock")) < len(here)


@pytest.mark.parametrize("first", ["h5py", "hertzlamb"])
def test_h5py_is_not_disturbed(first, tmp_path):
    second = "hertzlamb" if first == "h5py" else "h5py"
    code = f"""
import {first}, {second}, warnings
warnings.simplefilter("ignore")
import hertzlamb as hl, h5py, numpy as np
h5py.File("before.h5", "w").create_dataset("x", data=np.arange(5.0), compression="gzip")
run = hl.impact({BALL!r})
run.save("run.h5")
with h5py.File("run.h5") as file:
    assert (file["force"][()] == run.force).all()
with h5py.File("before.h5", "a") as file:
    file["x"].dims[0].label = "n"
    file.create_dataset("y", data=np.ones(3)).make_scale("y")
run.save("again.h5")
print(h5py.version.hdf5_version, sum(file in open("/proc/self/maps").read() for file in ["_core.abi3"]))
"""
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
