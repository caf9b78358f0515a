"""Sensors, responses and forces from traces in Python."""

import pickle
import types

import hertzlamb as hl
import numpy as np
import pytest

BALL = {
    "target": {"material": "granite"},
    "striker": {"material": "steel", "shape": "ball", "diameter_m": 4e-3, "velocity_m_s": 0.1},
}
PAIR = [complex(-3e5, 9e5), complex(-3e5, -9e5)]
RESPONSE = {"poles": [[p.real, p.imag] for p in PAIR], "zeros": [0], "gain": 2e6, "unit": "V"}
SENSORS = [
    {"r_m": 0.03, "z_m": 0.0, "face_radius_m": 2e-3, "quantity": "velocity_z", "response": RESPONSE},
    {"r_m": 0.05, "z_m": 0.0},
]


def test_sensors_are_objects_with_read_only_arrays():
    run = hl.impact({**BALL, "sensor": SENSORS})
    first, second = run.sensors
    assert (first.quantity, first.unit, first.output_unit, first.face_mean) == ("velocity_z", "m/s", "V", "discs")
    assert (second.quantity, second.output_unit, second.face_mean) == ("displacement_z", "m", "point")
    assert np.array_equal(second.mean, second.output) and not first.output.flags.writeable
    assert first.output_error.shape == first.time.shape and first.output_error[0] == 0 < first.output_error[-1]
    assert first.arrival[0] < first.arrival[1] <= first.arrival[2]
    data = run.to_xarray()
    assert data.sensor_output.sel(sensor=2).attrs["long_name"].startswith("output")
    assert np.array_equal(data.sensor_output[0], first.output)
    again = pickle.loads(pickle.dumps(run))
    assert np.array_equal(again.sensors[0].output, first.output) and not again.sensors[1].mean.flags.writeable
    assert "peak" in repr(first) and "Sensor" in repr(run)
    assert run.report["sensors"][0]["output_peak"] == first.output[np.argmax(np.abs(first.output))]
    assert hl.impact(BALL).sensors == ()


def test_a_response_of_the_scene_is_that_of_the_class():
    run = hl.impact({**BALL, "sensor": SENSORS})
    response = hl.Response.poles_zeros(PAIR, [0], 2e6)
    step = (run.time[-1] - run.time[0]) / (len(run.time) - 1)
    output, error = response.apply(step, run.sensors[0].mean)
    assert np.allclose(output, run.sensors[0].output, rtol=0, atol=1e-12 * np.abs(output).max())
    back = response.remove(step, output, [1e3, 5e3, 8e5, 1.2e6])
    plain = hl.Response.filter([1.0], 1 / step).remove(step, run.sensors[0].mean, [1e3, 5e3, 8e5, 1.2e6])
    assert np.abs(back - plain).max() < 1e-8 * np.abs(plain).max()
    s = 2j * np.pi * 1e5
    assert response(1e5) == pytest.approx(2e6 * s / ((s - PAIR[0]) * (s - PAIR[1])), rel=1e-12)
    assert response([1e3, 1e4]).shape == (2,)
    assert np.all(error >= 0)


def test_responses_from_tables_and_files(tmp_path):
    frequency = np.geomspace(1e3, 1e7, 400)
    pole = 2 * np.pi * 1e5
    low_pass = 1 / (1 + 2j * np.pi * frequency / pole)
    table = hl.Response.table(frequency, np.abs(low_pass))
    assert table.is_minimum_phase and table.limits_hz == (1e3, 1e7)
    assert abs(table(1e5) / (1 / (1 + 1j)) - 1) < 1e-2
    given = hl.Response.table(frequency, np.abs(low_pass), np.angle(low_pass))
    assert not given.is_minimum_phase
    path = tmp_path / "sensor.pz"
    path.write_text("ZEROS 1\nPOLES 1\n-1000.0 0.0\nCONSTANT 2.0\n")
    assert hl.Response.read(path)(1e6) == pytest.approx(2.0, rel=1e-3)
    for make, key in [
        (lambda: hl.Response.poles_zeros([1.0], [], 1.0), "response.poles"),
        (lambda: hl.Response.table([1.0, 1.0], [1.0, 1.0]), "frequency"),
        (lambda: hl.Response.filter([], 1e6), "response.coefficients"),
    ]:
        with pytest.raises(hl.HertzlambError) as error:
            make()
        assert key.split(".")[-1] in str(error.value)


def test_a_force_is_inferred_from_arrays_and_trace_objects():
    scene = {**BALL, "sensor": SENSORS}
    run = hl.impact(scene)
    rng = np.random.default_rng(7)
    step = 2e-7
    time = np.arange(-120, 250) * step
    traces = [np.interp(time, run.time, sensor.output, left=0.0) for sensor in run.sensors]
    traces = [trace + 0.01 * np.abs(trace).max() * rng.normal(size=len(time)) for trace in traces]
    force = hl.infer_force(time, traces, scene)
    assert abs(force.peak_force_n.value / run.peak_force_n - 1) < 0.01
    assert abs(force.contact_time_s.value / run.contact_time_s - 1) < 0.01
    assert abs(force.ball["velocity_m_s"].value / 0.1 - 1) < 0.02
    assert np.all(force.low <= force.force + 1e-9) and np.all(force.force <= force.high + 1e-9)
    assert force.predicted.shape == (2, len(time)) and force.l_curve.shape[1] == 3
    assert force.report["jackknife"]["peak_force_n"]
    objects = [types.SimpleNamespace(data=trace, stats=types.SimpleNamespace(delta=step)) for trace in traces]
    same = hl.infer_force(None, objects, scene)
    assert same.peak_force_n.value == pytest.approx(force.peak_force_n.value, rel=1e-9)
    assert same.start_s.value == pytest.approx(force.start_s.value + 120 * step, abs=1e-11)
    one = hl.infer_force(time, traces[1], {**BALL, "sensor": SENSORS[1:]})
    assert abs(one.peak_force_n.value / run.peak_force_n - 1) < 0.02
    drops = [[trace + 0.01 * np.abs(trace).max() * rng.normal(size=len(time)) for trace in traces] for _ in range(2)]
    assert len(hl.infer_force(time, drops, scene).report["shifts_s"]) == 2
    objects[0].stats.delta = objects[1].stats.delta = 0.0
    with pytest.raises(hl.SceneError, match="1 us"):
        hl.infer_force(None, objects, scene)
    with pytest.raises(hl.SceneError, match="2 sensors"):
        hl.infer_force(time, traces[0], scene)


def test_a_force_is_saved(tmp_path):
    scene = {**BALL, "sensor": SENSORS[1:]}
    run = hl.impact(scene)
    time = np.arange(-120, 250) * 2e-7
    trace = np.interp(time, run.time, run.sensors[0].output, left=0.0)
    trace += 0.02 * np.abs(trace).max() * np.random.default_rng(2).normal(size=len(time))
    force = hl.infer_force(time, trace, scene)
    force.save(tmp_path / "force.h5")
    with pytest.raises(hl.OutputExists):
        force.save(tmp_path / "force.h5")
    record = {"file": str(tmp_path / "force.h5"), "start_s": float(force.time[0])}
    again = hl.impact({"target": BALL["target"], "force": record, "contact": {"disc_radius_m": 1e-4}, "sensor": SENSORS[1:]})
    peak = np.abs(run.sensors[0].output).max()
    shifted = np.interp(run.time, again.time + force.time[0], again.sensors[0].output)
    inside = run.time < again.time[-1] + force.time[0]
    assert np.abs(shifted - run.sensors[0].output)[inside].max() < 0.1 * peak
