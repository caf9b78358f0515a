"""How the package behaves: errors, threads, signals, pickles, forks, progress."""

import itertools
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
import warnings
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import hertzlamb as hl
from conftest import ROOT

FORCE = {
    "target": {"material": "granite"},
    "striker": {"material": "bearing-steel", "mass_kg": 1.105e-4, "tip_radius_m": 1.5e-3, "velocity_m_s": 0.2},
}
# steps of its own: no series serves
LONG = {
    "scene": {**FORCE, "contact": {"model": "growing", "step_s": 2e-8}},
    "random": {"samples": 100_000, "striker": {"velocity_m_s": {"distribution": "uniform", "low": 0.1, "high": 1.0}}},
}

pytestmark = pytest.mark.filterwarnings("ignore::hertzlamb.HertzlambWarning")


def long_works(table):
    """What takes long, by name."""
    t = np.linspace(0.1, 9.0, 4_000_000)
    field = {"map": {"r_max_m": 0.02, "z_max_m": 0.02, "points": [301, 301], "frames": 20}}
    return {
        "kernels": lambda **way: hl.kernels.step(0.3, 0.5, 0.6, t, tolerance=1e-13, **way),
        "impact": lambda **way: hl.impact({**FORCE, **field}, kernel="direct", **way),
        "sweep": lambda **way: hl.sweep(LONG, **way),
        "collide": lambda **way: hl.collide(LONG["scene"], velocity_m_s=np.linspace(0.1, 1, 100_000), **way),
        "trace": lambda **way: hl.Table.open(table).trace(0.3, np.full(20_000, 0.5), 0.6, coarsening=0, cells=3000, **way),
    }


def test_errors_have_fields(table):
    with pytest.raises(hl.SceneError, match="did you mean mass_kg") as caught:
        hl.impact({**FORCE, "striker": {"mas_kg": 1}})
    assert (caught.value.key, caught.value.suggestion) == ("striker.mas_kg", "mass_kg")
    with pytest.raises(ValueError) as caught:
        hl.impact({**FORCE, "target": {"material": "granit"}})
    assert (caught.value.value, caught.value.suggestion) == ("granit", "granite")
    with pytest.raises(hl.SceneError) as caught:
        hl.impact({**FORCE, "contact": {"tolerance": 3}})
    assert (caught.value.key, caught.value.value) == ("contact.tolerance", 3.0)
    with pytest.raises(hl.SceneError, match="contact.tolerance") as caught:
        hl.impact({**FORCE, "contact": {"tolerance": object()}})
    for wrong in (3, None, [1], {"target": 1}, {1: 2}, "[target", "no-such-file.toml"):
        with pytest.raises(hl.SceneError):
            hl.impact(wrong)
    opened = hl.Table.open(table)
    with pytest.raises(hl.OutsideTable) as caught:
        opened.trace(nu=0.3, r=[50.0], z=[0.0])
    e = caught.value
    assert (e.axis, e.value, e.low, e.high, e.file) == ("r/r0", 50.0, 0.0, 6.0, str(table))
    with pytest.raises(hl.OutsideTable) as caught:
        hl.impact({**FORCE, "probe": [{"r_m": 1.0, "z_m": 0.0}]}, opened, kernel="table")
    with pytest.raises(hl.BadTable) as caught:
        hl.Table.open(ROOT / "README.md")
    assert caught.value.file.endswith("README.md") and isinstance(caught.value, OSError)
    with pytest.raises(hl.DomainError) as caught:
        hl.kernels.medium(0.7)
    assert (caught.value.argument, caught.value.value, caught.value.range) == ("poisson_ratio", 0.7, "(-1, 0.5)")
    with pytest.raises(hl.DomainError, match="not one of hertz, punch, point"):
        hl.kernels.static(0.3, 1, 1, profile="hurtz")
    with pytest.raises(hl.ImpactError, match="Rayleigh"):
        hl.impact({**FORCE, "striker": {**FORCE["striker"], "velocity_m_s": 1e5}})
    with pytest.raises(hl.TooMuchMemory):
        hl.impact({**FORCE, "probe": [{"r_m": 0.01, "z_m": 0.0}] * 100}, max_memory_gb=1e-6)
    with pytest.raises(hl.TooMuchMemory):
        opened.trace(0.3, np.zeros(10_000_000), 1.0, cells=10**12)
    with pytest.raises(TypeError, match="target__poisson_ratio or striker__poisson_ratio"):
        hl.collide(FORCE, poisson_ratio=[0.2])
    with pytest.raises(hl.SceneError, match="unknown key speed"):
        hl.collide(FORCE, speed=[0.2])
    with pytest.raises(IndexError):
        hl.sweep(LONG, rows=range(99_999, 100_003))


def test_a_failed_row_is_nan_with_its_reason():
    with pytest.warns(hl.HertzlambWarning, match="1 of 3 impacts failed"):
        out = hl.collide(FORCE, velocity_m_s=[1.0, -1.0, 2.0])
    assert np.isnan(out.restitution[1]) and out.model[1] == "" and "velocity_m_s = -1" in out.failures[1]
    assert np.all(np.isfinite(out.restitution[[0, 2]]))


def test_what_is_not_a_number_is_a_failed_row_with_its_place():
    odd = [2.0, np.nan, 0.5, np.inf, -np.inf, 1e9]
    with pytest.warns(hl.HertzlambWarning, match="4 of 6 impacts failed, the first in row 1"):
        out = hl.collide(FORCE, velocity_m_s=odd)
    assert sorted(out.failures) == [1, 3, 4, 5] and "velocity_m_s = NaN is outside (0, inf)" in out.failures[1]
    whole = hl.collide(FORCE, velocity_m_s=[2.0, 0.5])
    assert list(out.peak_force_n[[0, 2]]) == list(whole.peak_force_n)
    # of any key, those that need a scene of their own too, and in the first row
    for key in ("target__youngs_modulus_pa", "target__longitudinal_speed_m_s", "target__thickness_m", "tolerance"):
        good = {"target__longitudinal_speed_m_s": 4500.0, "target__thickness_m": 1.0, "tolerance": 1e-3}.get(key, 5e10)
        base = {**FORCE, "target": {"youngs_modulus_pa": 4.5e10, "poisson_ratio": 0.25, "density_kg_m3": 2650.0}}
        if key == "target__longitudinal_speed_m_s":
            base["target"] = {"density_kg_m3": 2650.0, "shear_speed_m_s": 2600.0}
        out = hl.collide(base, **{key: [np.nan, good]})
        assert list(out.failures) == [0] and np.isfinite(out.restitution[1]), key
    # a number that is written down in a file of a sweep is still refused
    with pytest.raises(hl.SceneError, match="velocity_m_s = NaN"):
        hl.sweep({"scene": FORCE, "list": {"striker": {"velocity_m_s": [1.0, np.nan]}}})


def test_what_an_array_means_beside_its_numbers_is_not_dropped():
    masked = np.ma.array([[0.4, 0.6], [0.8, 1.0]], mask=[[0, 0], [1, 0]])
    for given in (masked, list(masked)):
        out = hl.collide(FORCE, velocity_m_s=given)
        assert list(out.failures) == [2] and np.isnan(out.restitution[1, 0]) and np.isfinite(out.restitution[0, 0])
    assert hl.kernels.static(0.3, np.ma.array([1.0, 2.0], mask=False), 0.5).stress_zz.shape == (2,)
    with pytest.raises(hl.DomainError, match="r"):
        hl.kernels.step(0.3, np.ma.array([1.0, 2.0], mask=[0, 1]), 0.5, 2.0)
    day = np.array(["2026-03-01", "2026-03-02"], dtype="datetime64[ns]")
    wrong = [day, day - day[0], np.array([1.0 + 2.0j]), np.array([True]), np.array([b"1"]), ["a", 2.0], object(), [[1.0], [1.0, 2.0]]]
    for values in wrong:
        with pytest.raises(hl.SceneError, match="velocity_m_s"):
            hl.collide(FORCE, velocity_m_s=values)
        for call in (hl.kernels.step, hl.kernels.remainder):
            with pytest.raises(hl.DomainError, match="^t "):
                call(0.3, 0.5, 0.6, values)
    for value in (day[0], day[1] - day[0], np.complex64(1.0), np.ma.masked, np.ma.array(1.0, mask=True)):
        with pytest.raises(hl.SceneError, match="striker.velocity_m_s"):
            hl.impact({**FORCE, "striker": {**FORCE["striker"], "velocity_m_s": value}})


class Quantity(np.ndarray):
    """An array with a unit, as astropy has it."""

    unit = "km / s"

    def to(self, unit):
        raise NotImplementedError


def test_units_of_others_are_refused():
    speed = np.array([0.1, 0.2]).view(Quantity)
    with pytest.raises(hl.SceneError, match="velocity_m_s has the unit km / s"):
        hl.collide(FORCE, velocity_m_s=speed)
    with pytest.raises(hl.SceneError, match="striker.velocity_m_s has the unit"):
        hl.impact({**FORCE, "striker": {**FORCE["striker"], "velocity_m_s": speed[:1]}})


def test_words_of_any_kind_of_array_are_words():
    pd = pytest.importorskip("pandas")
    names = ["copper", "steel"]
    for given in (names, np.array(names), np.array(names, dtype=object), pd.Series(names), pd.Categorical(names)):
        out = hl.collide(FORCE, striker__material=given)
        assert out.shape == (2,) and out.restitution[0] != out.restitution[1]
    assert hl.collide(FORCE, velocity_m_s=pd.Series([0.5, None])).failures.keys() == {1}


def test_numbers_beyond_all_floats_are_infinite():
    for value, shown in ((10**400, "inf"), (-(10**5000), "-inf")):
        with pytest.raises(hl.SceneError, match=f"striker.velocity_m_s = {shown} is outside"):
            hl.impact({**FORCE, "striker": {**FORCE["striker"], "velocity_m_s": value}})
        assert f"= {shown} is outside" in hl.collide(FORCE, velocity_m_s=[1.0, value]).failures[1]


def test_endless_and_huge_lists_are_refused_at_once():
    class Endless:
        """A list that goes on beyond its length, and a mapping without an end."""

        def __init__(self, length):
            self.length = length

        def __len__(self):
            return self.length

        def __iter__(self):
            return itertools.repeat({"r_m": 0.01, "z_m": 0.0})

    class EndlessMapping:
        def items(self):
            return ((f"k{i}", 1) for i in itertools.count())

    start = time.perf_counter()
    for probes in (itertools.count(), ({} for _ in itertools.count()), range(10**9), Endless(10**9), np.broadcast_to(0.0, 10**10)):
        with pytest.raises((hl.SceneError, hl.TooMuchMemory), match="probe"):
            hl.impact({**FORCE, "probe": probes})
    with pytest.raises(hl.SceneError, match="at most 1000 keys"):
        hl.impact({**FORCE, "output": EndlessMapping()})
    with pytest.raises(hl.SceneError, match="two times"):
        hl.infer(FORCE, bounces=itertools.count())
    for values in (itertools.count(), range(10**9)):
        with pytest.raises(hl.SceneError, match="velocity_m_s"):
            hl.collide(FORCE, velocity_m_s=values)
    with pytest.raises(hl.SceneError, match="number of rows in memory = 1000000000000 is outside"):
        hl.collide(FORCE, velocity_m_s=np.broadcast_to(1.0, (10**6, 10**6)))
    with pytest.raises(hl.SceneError, match="at most 8 MB"):
        hl.impact("x = " + "[" * 50_000_000)
    assert time.perf_counter() - start < 5.0
    assert hl.impact({**FORCE, "probe": Endless(2)}).probes.r.shape == (2,)


def test_arguments_outside_their_range_are_one_kind_of_error(table):
    opened = hl.Table.open(table)
    for threads in (0, -1, 1025, 10**30):
        calls = [
            lambda: hl.impact(FORCE, threads=threads),
            lambda: hl.collide(FORCE, velocity_m_s=[1.0], threads=threads),
            lambda: hl.sweep(LONG, rows=slice(0, 1), threads=threads),
            lambda: opened.trace(0.3, 0.5, 0.6, threads=threads),
            lambda: hl.kernels.step(0.3, 0.5, 0.6, np.arange(20.0), threads=threads),
        ]
        for call in calls:
            with pytest.raises(hl.DomainError, match=r"threads = -?\d+ is outside \[1, 1024\]") as caught:
                call()
            assert caught.value.argument == "threads" and float(caught.value.value) == float(threads)
    # the name of the argument is a note of the exception, and Python 3.10 has no notes
    with pytest.raises(TypeError, match="threads" if sys.version_info >= (3, 11) else "integer"):
        hl.impact(FORCE, threads=2.5)
    assert hl.impact(FORCE, threads=np.int64(1)).numbers == hl.impact(FORCE).numbers
    for name in ("cells", "coarsening"):
        with pytest.raises(hl.DomainError, match=f"{name} = -1 is outside"):
            opened.trace(0.3, 0.5, 0.6, **{name: -1})
    for rows in (5, [1, 2], np.arange(3), "0:3"):
        with pytest.raises(TypeError, match="neither a slice nor a range"):
            hl.sweep(LONG, rows=rows)


def test_a_misspelt_argument_of_collide_is_named():
    for wrong, right in (("velocty_m_s", "velocity_m_s"), ("thread", "threads"), ("colums", "columns"), ("poison_ratio", "poisson_ratio")):
        with pytest.raises(hl.SceneError, match=f"unknown key {wrong}; did you mean {right}") as caught:
            hl.collide(FORCE, **{wrong: [0.2]})
        assert caught.value.suggestion == right
    with pytest.raises(hl.SceneError, match="did you mean yield_strength_pa"):
        hl.collide(FORCE, target__yield_strenght_pa=[1e9])


LOOP = """
import sys, warnings
import hertzlamb as hl
scene = {scene!r}
for i in range(4):
    scene["striker"]["velocity_m_s"] = 1.0 + i
    {call}
"""


@pytest.mark.parametrize(
    ("call", "times"),
    [("hl.impact(scene)", 1), ("hl.collide(scene, diameter_m=[-i, 2e-3])", 1), ("warnings.simplefilter('always'); hl.impact(scene)", 4)],
)
def test_a_loop_prints_each_kind_of_warning_once(call, times):
    scene = {
        "target": {"material": "steel", "yield_strength_pa": 1e6},
        "striker": {"material": "steel", "shape": "ball", "diameter_m": 2e-3},
        "contact": {"disc_radius_m": 1e-3, "model": "wave"},
    }
    kinds = len(hl.impact({**scene, "striker": {**scene["striker"], "velocity_m_s": 1.0}}).warnings)
    assert kinds > 2
    if "collide" in call:
        del scene["striker"]["diameter_m"]
        kinds = 1
    code = LOOP.format(scene=scene, call=call)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stderr.count("HertzlambWarning: ") == kinds * times, done.stderr


def test_a_warning_is_an_error_where_a_filter_says_so():
    scene = {**FORCE, "target": {"material": "steel", "yield_strength_pa": 1e6}}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for _ in range(2):
            with pytest.raises(hl.HertzlambWarning, match="yield"):
                hl.impact(scene)
    with pytest.warns(hl.HertzlambWarning) as caught:
        run = hl.impact(scene)
    assert [each.message.args[0] for each in caught] == run.warnings


def test_warnings_are_warnings():
    with pytest.warns(hl.HertzlambWarning, match="yield"):
        run = hl.impact({**FORCE, "target": {"material": "steel", "yield_strength_pa": 1e6}})
    assert any("yield" in warning for warning in run.warnings) and "warning:" in repr(run)


def test_everything_is_picklable(table, tmp_path):
    run = hl.impact({**FORCE, "probe": [{"r_m": 0.01, "z_m": 0.0}]})
    again = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(run))))
    assert again.numbers == run.numbers and repr(again) == repr(run)
    assert (again.probes.stress_rr == run.probes.stress_rr).all() and not again.probes.stress_rr.flags.writeable
    run.save(tmp_path / "one.h5")
    again.save(tmp_path / "two.h5")
    assert (tmp_path / "one.h5").read_bytes() == (tmp_path / "two.h5").read_bytes()
    with pytest.raises(hl.OutputExists):
        again.save(tmp_path / "two.h5")
    out = hl.collide(FORCE, velocity_m_s=[1.0, 2.0])
    assert (pickle.loads(pickle.dumps(out)).restitution == out.restitution).all()
    part = hl.sweep(LONG, rows=slice(0, 3))
    again = pickle.loads(pickle.dumps(part))
    assert (again.restitution == part.restitution).all() and again.rows == part.rows
    opened = hl.Table.open(table)
    again = pickle.loads(pickle.dumps(opened))
    assert again.id == opened.id
    u = opened.trace(0.3, [0.5], [0.6], cells=5)
    v = pickle.loads(pickle.dumps(u))
    assert (v.array == u.array).all() and (v.error.array == u.error.array).all() and v.cell_width == u.cell_width
    k = hl.kernels.step(0.3, 0.5, 0.6, [1.0, 2.0])
    assert (pickle.loads(pickle.dumps(k)).error.array == k.error.array).all()
    for wrong in (lambda: hl.impact({"target": {}}), lambda: opened.trace(0.3, 9, 0), lambda: hl.Table.open("no")):
        with pytest.raises(hl.HertzlambError) as caught:
            wrong()
        back = pickle.loads(pickle.dumps(caught.value))
        assert type(back) is type(caught.value) and str(back) == str(caught.value)
        assert back.__dict__ == caught.value.__dict__ and back.__dict__


def test_arrays_are_read_only(table):
    run = hl.impact({**FORCE, "probe": [{"r_m": 0.01, "z_m": 0.0}]})
    u = hl.Table.open(table).trace(0.3, [0.5], [0.6], cells=5)
    arrays = [run.force, run.probes.stress_rr, run.energy.stored, u.stress_zz, u.time, u.error.stress_rr]
    for array in arrays:
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0


def test_threads_at_once_give_serial_bits(table):
    opened = hl.Table.open(table)
    scenes = [{**FORCE, "striker": {**FORCE["striker"], "velocity_m_s": 0.1 + 0.1 * i}} for i in range(8)]
    radii = np.linspace(0.1, 5, 8)

    def work(i):
        return hl.impact(scenes[i]).force.tobytes() + opened.trace(0.3, [radii[i]], [0.5]).array.tobytes()

    serial = [work(i) for i in range(8)]
    with ThreadPoolExecutor(8) as pool:
        assert list(pool.map(work, range(8))) == serial


@pytest.mark.parametrize("name", ["kernels", "impact", "sweep", "collide", "trace"])
def test_the_interpreter_is_free_meanwhile(name, table):
    done, beats = threading.Event(), []

    def beat():
        while not done.is_set():
            beats.append(time.perf_counter())
            time.sleep(0.005)

    thread = threading.Thread(target=beat)
    thread.start()
    try:
        start = time.perf_counter()
        with pytest.raises(StopIteration):
            long_works(table)[name](progress=until(start + 0.7))
    finally:
        done.set()
        thread.join()
    during = [beat for beat in beats if start < beat < start + 0.5]
    # a lock held throughout leaves none, a free one a hundred
    assert len(during) > 5, "another thread has hardly run"


def until(end):
    """Progress that stops the work after some time, as an exception in it does."""

    def tell(done, total):
        assert threading.current_thread() is threading.main_thread()
        assert 0 <= done <= total
        if time.perf_counter() > end:
            raise StopIteration("enough")

    return tell


@pytest.mark.parametrize("name", ["kernels", "impact", "sweep", "collide", "trace", "tabulate"])
def test_ctrl_c_is_heard_within_a_third_of_a_second(name, table, tmp_path):
    delays = []
    # a busy machine may take longer once; a call that does not listen takes longer each time
    while len(delays) < 3 and min(delays, default=1.0) >= 0.3:
        out = tmp_path / f"{len(delays)}.h5"
        works = {**long_works(table), "tabulate": lambda out=out: hl.tabulate(out, "standard")}
        sent = []

        def send(sent=sent):
            sent.append(time.perf_counter())
            os.kill(os.getpid(), signal.SIGINT)

        timer = threading.Timer(0.4, send)
        timer.start()
        try:
            with pytest.raises(KeyboardInterrupt):
                works[name]()
            delays.append(time.perf_counter() - sent[0])
        finally:
            timer.cancel()
    assert min(delays) < 0.3, delays


def test_stopped_work_leaves_the_processors_alone(tmp_path):
    threading.Timer(0.4, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        hl.tabulate(tmp_path / "out.h5", "standard")
    # a block that was begun is finished, which takes a second where others work too; all of them would take minutes
    busy, end = 1.0, time.perf_counter() + 10.0
    while busy > 0.05 and time.perf_counter() < end:
        before = time.process_time()
        time.sleep(0.5)
        busy = time.process_time() - before
    assert busy <= 0.05
    # and what was done is kept
    assert list(tmp_path.glob("*.journal"))


def test_progress_ends_at_the_total(capsys):
    told = []
    hl.collide(FORCE, velocity_m_s=np.linspace(0.1, 1, 50), progress=lambda *at: told.append(at))
    assert told[-1] == (50, 50)
    code = "import sys; sys.modules['tqdm'] = None; sys.modules['tqdm.auto'] = None\nimport hertzlamb as hl\n"
    code += f"hl.collide({FORCE!r}, velocity_m_s=[1.0, 2.0], progress=True)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0 and "2 of 2" in done.stderr, done.stderr


def in_child(work):
    """What a forked process says."""
    reader, writer = multiprocessing.get_context("fork").Pipe(duplex=False)

    def body():
        try:
            work()
            writer.send("done")
        except Exception as error:
            writer.send(f"{type(error).__name__}: {error}")

    child = multiprocessing.get_context("fork").Process(target=body)
    child.start()
    said = reader.recv() if reader.poll(20) else "nothing: it hangs"
    child.kill()
    child.join()
    return said


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_a_forked_process_says_why_it_cannot():
    hl.impact(FORCE)
    said = in_child(lambda: hl.impact(FORCE))
    assert said.startswith("ForkError") and "spawn" in said
    # a process that was forked before anything was computed works
    code = f"""
import os
import warnings
import hertzlamb as hl
warnings.simplefilter("ignore")
child = os.fork()
if child == 0:
    hl.impact({FORCE!r})
    os._exit(0)
assert os.waitpid(child, 0)[1] == 0
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr


def test_spawned_processes_work(table):
    context = multiprocessing.get_context("spawn")
    with context.Pool(2) as pool:
        found = pool.map(hl.impact, [FORCE, FORCE])
        traces = pool.starmap(hl.Table.trace, [(hl.Table.open(table), 0.3, 0.5, 0.6)])
    assert found[0].numbers == hl.impact(FORCE).numbers
    assert (traces[0].array == hl.Table.open(table).trace(0.3, 0.5, 0.6).array).all()
