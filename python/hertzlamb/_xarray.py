"""Results as xarray data sets, with coordinates, units and descriptions."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from hertzlamb._fields import FIELDS
from hertzlamb._impact import DESCRIBED

if TYPE_CHECKING:
    import xarray as xr

    from hertzlamb._impact import Impact, Section
    from hertzlamb._sweep import Collisions, Sweep
    from hertzlamb._table import Trace


def _attributes(part: str, name: str) -> dict[str, str]:
    unit, meaning = DESCRIBED[part][name][:2]
    return {"units": unit, "long_name": meaning}


_FIELDS: dict[str, list[str]] = {**DESCRIBED["fields"], **DESCRIBED["more"]}
_SUFFIXES = {
    "_error": "estimated absolute error: ",
    "_peak": "largest in magnitude over time: ",
    "_peak_time": "when it is largest in magnitude: ",
    "_peak_error": "estimated absolute error of the largest in magnitude over time: ",
}


def _fields(found: Mapping[str, Any], full: tuple[str, ...], place: tuple[str, ...]) -> dict[str, Any]:
    """Variables of fields over place and time, and of their errors and peaks over place."""
    variables: dict[str, Any] = {}
    for name, (unit, meaning) in _FIELDS.items():
        if name in found:
            variables[name] = (full, found[name], {"units": unit, "long_name": meaning})
        for suffix, words in _SUFFIXES.items():
            if name + suffix in found:
                own = "s" if suffix == "_peak_time" else unit
                variables[name + suffix] = (place, found[name + suffix], {"units": own, "long_name": words + meaning})
    return variables


def of_impact(run: Impact) -> xr.Dataset:
    import xarray as xr

    variables: dict[str, Any] = {}
    for name in ("force", "displacement", "velocity", "deflection"):
        values = run._series.get(name)
        if values is not None:
            variables[name] = ("time", values, _attributes("series", name))
    for name, values in run.energy.items():
        variables[f"energy_{name}"] = ("time", values, _attributes("energy", name))
    coordinates: dict[str, Any] = {"time": ("time", run.time, _attributes("series", "time"))}
    if run._probes is not None:
        probes = run._probes
        coordinates["probe"] = ("probe", np.arange(1, len(probes.r) + 1), {"long_name": "number of the probe, from 1"})
        coordinates["wave"] = ("wave", DESCRIBED["waves"])
        for name in ("r", "z"):
            coordinates[name] = ("probe", probes[name], _attributes("places", name))
        variables["arrival"] = (("probe", "wave"), probes.arrival, _attributes("arrival", "arrival"))
        variables["valid_until"] = ("probe", probes.valid_until, _attributes("arrival", "valid_until"))
        if "echo" in probes:
            coordinates["echo"] = ("echo", probes.echo)
            described = _attributes("arrival", "echo_arrival")
            variables["echo_arrival"] = (("probe", "echo"), probes.echo_arrival, described)
        variables.update(_fields(probes, ("probe", "time"), ("probe",)))
    if run.sensors:
        coordinates["sensor"] = ("sensor", np.arange(1, len(run.sensors) + 1), {"long_name": "number of the sensor, from 1"})
        for name in ("quantity", "unit", "output_unit"):
            coordinates[f"sensor_{name}"] = ("sensor", [getattr(sensor, name) for sensor in run.sensors])
        for name in ("mean", "output", "output_error"):
            values = np.array([getattr(sensor, name) for sensor in run.sensors])
            variables[f"sensor_{name}"] = (("sensor", "time"), values, _attributes("outputs", name))
        errors = [sensor.mean_error for sensor in run.sensors]
        variables["sensor_mean_error"] = ("sensor", errors, _attributes("outputs", "mean_error"))
    scalars = {name: value for name, value in run.report.items() if isinstance(value, (int, float, str))}
    return xr.Dataset(variables, coordinates, {**scalars, "warnings": "\n".join(run.warnings)})


def of_section(section: Section) -> xr.Dataset:
    import xarray as xr

    coordinates = {name: (name, section[name], _attributes("map", name)) for name in ("time", "z", "r")}
    variables = _fields(section, ("time", "z", "r"), ("z", "r"))
    arrival = (("wave", "z", "r"), section.arrival, _attributes("arrival", "arrival"))
    return xr.Dataset({**variables, "arrival": arrival}, {**coordinates, "wave": ("wave", DESCRIBED["waves"])})


def of_trace(trace: Trace) -> xr.Dataset:
    import xarray as xr

    def unit(name: str) -> str:
        return "P/(mu r0)" if name.startswith("displacement") else "P/r0^2"

    points = len(np.atleast_1d(trace.r))
    flat = {name: trace[name].reshape(points, -1) for name in FIELDS}
    variables: dict[str, Any] = {
        name: (("point", "time"), values, {"units": unit(name)}) for name, values in flat.items()
    }
    for name in FIELDS:
        variables[f"{name}_static"] = ("point", trace.static[name].reshape(-1), {"units": unit(name)})
        variables[f"{name}_error"] = ("point", trace.error[name].reshape(-1), {"units": unit(name)})
    coordinates: dict[str, Any] = {"time": ("time", trace.time, {"units": "r0/c1", "long_name": "middle of the cell"})}
    for name, values in (("r", trace.r), ("z", trace.z)):
        coordinates[name] = ("point", np.asarray(values).reshape(-1), {"units": "r0"})
    return xr.Dataset(variables, coordinates, {"poisson_ratio": trace.nu, "cell_width": trace.cell_width})


def of_collisions(out: Collisions) -> xr.Dataset:
    import xarray as xr

    dims = tuple(f"dim_{i}" for i in range(len(out.shape)))
    variables: dict[str, Any] = {name: (dims, out[name], _attributes("quantities", name)) for name in out._names}
    variables["model"] = (dims, out.model)
    keys = {name: (dims, values, _attributes("keys", name)) for name, values in out._keys.items()}
    return xr.Dataset(variables, keys)


def of_sweep(out: Sweep) -> xr.Dataset:
    import xarray as xr

    coordinates: dict[str, Any] = {}
    if out.is_whole:
        dims, shape = tuple(out.axes), tuple(out.axes.values())
        for axis, _, columns in out._axes:
            for name, values in columns.items():
                coordinates[name] = (axis, values, _attributes("keys", name))
    else:
        dims, shape = ("row",), (len(out.rows),)
        coordinates["row"] = ("row", np.asarray(out.rows), {"long_name": "row of the sweep, from 0"})
        for name, values in out._keys.items():
            coordinates[name] = ("row", values, _attributes("keys", name))
    variables: dict[str, Any] = {
        name: (dims, out[name].reshape(shape), _attributes("quantities", name)) for name in out._names
    }
    variables["model"] = (dims, out.model.reshape(shape))
    return xr.Dataset(variables, coordinates)
