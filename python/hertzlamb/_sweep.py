"""Many impacts: `sweep`, `collide` and their results."""

from __future__ import annotations

import math
import os
import warnings
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from hertzlamb import _core
from hertzlamb._arrays import of_key
from hertzlamb._errors import HertzlambWarning
from hertzlamb._impact import DESCRIBED, QUANTITIES, Scene
from hertzlamb._names import OfRows
from hertzlamb._progress import Progress, told

if TYPE_CHECKING:
    import pandas as pd
    import polars as pl
    import pyarrow as pa
    import xarray as xr
    from matplotlib.axes import Axes
    from numpy.typing import ArrayLike, NDArray

    Floats = NDArray[np.float64]

MODELS: tuple[str, ...] = tuple(DESCRIBED["models"])
"""Names of the contact models; the index of a name is its number in the compiled part."""

_COUNTS = [name for name, (_, _, kind) in QUANTITIES.items() if kind == "count"]
_FAILED = 255


class _Rows(Mapping[str, "NDArray[Any]"], OfRows):
    """Mapping of arrays by name: varied keys, scalar results and ``"model"``; results are also attributes."""

    _numbers: Floats
    """Computed results, (result, row)."""
    _held: list[str]
    """Names of the computed results, (result,)."""
    _chosen: list[str] | None
    """Names passed as ``columns``; None for all."""
    _models: NDArray[np.uint8]
    _failures: dict[int, str]
    _shape: tuple[int, ...]

    @cached_property
    def _keys(self) -> dict[str, NDArray[Any]]:
        """Values of the varied keys, each of the shape of the results."""
        raise NotImplementedError

    @property
    def _names(self) -> list[str]:
        """Names of the results, in the order of files."""
        return [name for name in self._held if self._chosen is None or name in self._chosen]

    def __getitem__(self, name: str) -> NDArray[Any]:
        if name in self._names:
            result: Floats = self._numbers[self._held.index(name)]
            return result.reshape(self._shape)
        if name == "model":
            return self._model_names(np.array([*MODELS, ""])).reshape(self._shape)
        if name in self._keys:
            return self._keys[name]
        raise KeyError(f"{name!r} is not one of {', '.join(self)}")

    def _model_names(self, names: NDArray[Any]) -> NDArray[Any]:
        """Name of the model of each row, from the names of all models followed by that for a failed row."""
        of_all: NDArray[Any] = names[np.where(self._models == _FAILED, len(MODELS), self._models)]
        return of_all

    def __iter__(self) -> Any:
        return iter([*self._keys, *self._names, "model"])

    def __len__(self) -> int:
        return len(self._keys) + len(self._names) + 1

    if not TYPE_CHECKING:  # for type checkers, `_names` has the attributes

        def __getattr__(self, name: str) -> Floats:
            if name in QUANTITIES:
                if name in self._names:
                    return self[name]
                raise AttributeError(f"{name} is not among the requested columns, {', '.join(self._names)}")
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._names]

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of every result."""
        return self._shape

    @property
    def model(self) -> NDArray[np.str_]:
        """Name of the contact model of each impact, of the shape of the results; empty for a failed impact."""
        return self["model"]

    @property
    def failures(self) -> dict[int, str]:
        """Reason for each failed impact, by its index in the flattened results; the results of these impacts are NaN."""
        return dict(self._failures)

    def _columns(self) -> dict[str, NDArray[Any]]:
        """All columns, flattened; strings have the type object."""
        keys = {name: np.ascontiguousarray(values).reshape(-1) for name, values in self._keys.items()}
        columns = {name: values.astype(object) if values.dtype.kind == "U" else values for name, values in keys.items()}
        columns |= {name: self[name].reshape(-1) for name in self._names}
        columns["model"] = self._model_names(np.array([*MODELS, ""], dtype=object))
        failure = np.full(len(self._models), "", dtype=object)
        for row, reason in self._failures.items():
            failure[row] = reason
        return {**columns, "failure": failure}

    def to_pandas(self) -> pd.DataFrame:
        """All impacts as a pandas data frame.

        Each impact has one row; the columns are the varied keys, the results, ``model`` and ``failure`` (the reason, or
        an empty string). Counts such as ``contacts`` are integers (``Int64``), missing for failed impacts.
        """
        import pandas as pd

        columns: dict[str, Any] = self._columns()
        for name, values in columns.items():
            if name in _COUNTS:
                columns[name] = pd.arrays.IntegerArray(*_counted(values))
        return pd.DataFrame(columns)

    def to_arrow(self) -> pa.Table:
        """The columns of `to_pandas` as an Arrow table, with units and descriptions as metadata of the fields."""
        import pyarrow as pa

        fields, arrays = [], []
        for name, values in self._columns().items():
            unit, meaning = [*QUANTITIES.get(name, ()), *DESCRIBED["keys"].get(name, ()), "", ""][:2]
            if name in _COUNTS:
                whole, missing = _counted(values)
                array = pa.array(whole, mask=missing)
            else:
                array = pa.array(values, type=pa.string() if values.dtype.kind == "O" else None)
            metadata = {"units": unit, "long_name": meaning} if unit else None
            fields.append(pa.field(name, array.type, metadata=metadata))
            arrays.append(array)
        return pa.Table.from_arrays(arrays, schema=pa.schema(fields))

    def to_polars(self) -> pl.DataFrame:
        """The columns of `to_pandas` as a polars data frame."""
        import polars as pl

        columns = {}
        for name, values in self._columns().items():
            column = pl.Series(name, values.tolist() if values.dtype.kind == "O" else values)
            columns[name] = column.fill_nan(None).cast(pl.Int64) if name in _COUNTS else column
        return pl.DataFrame(columns)


def _counted(values: Floats) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """Counts as integers, and the mask of missing counts."""
    missing = np.isnan(values)
    return np.where(missing, 0.0, values).astype(np.int64), missing


class Collisions(_Rows):
    """Results of many impacts, returned by `collide`; each array has the broadcast shape of the varied keys.

    Write ``out.restitution`` or ``out["restitution"]`` for a result; names and units are those of `Impact`. Varied keys
    have their full name, ``out["striker.velocity_m_s"]``. Counts are floats, and the results of failed impacts are NaN.

    Raises
    ------
    AttributeError, KeyError
        There is no such name, or ``columns`` does not contain it.
    """

    def __init__(
        self,
        numbers: Floats,
        models: NDArray[np.uint8],
        failures: dict[int, str],
        keys: dict[str, NDArray[Any]],
        shape: tuple[int, ...],
        names: tuple[list[str], list[str] | None],
    ) -> None:
        self._numbers, self._models, self._failures = numbers, models, failures
        self._given, self._shape = keys, shape
        self._held, self._chosen = names

    @cached_property
    def _keys(self) -> dict[str, NDArray[Any]]:
        return {name: np.broadcast_to(values, self._shape) for name, values in self._given.items()}

    def to_xarray(self) -> xr.Dataset:
        """The results as an xarray data set with the dimensions dim_0, dim_1, ...; the varied keys are coordinates."""
        from hertzlamb._xarray import of_collisions

        return of_collisions(self)

    def __repr__(self) -> str:
        shape = " x ".join(map(str, self._shape)) or "1"
        return f"{shape} impacts, {len(self._failures)} failed; {', '.join(self._given)} vary"

    def __reduce__(self) -> tuple[Any, ...]:
        names = (self._held, self._chosen)
        return Collisions, (self._numbers, self._models, self._failures, self._given, self._shape, names)


class Sweep(_Rows):
    """Rows of a sweep, returned by `sweep`; each array is (row,).

    Write ``out.restitution`` or ``out["restitution"]`` for a result; names and units are those of `Impact`. Varied keys
    have their full name, ``out["striker.mass_kg"]``. Counts are floats, and the results of failed rows are NaN.

    Raises
    ------
    AttributeError, KeyError
        There is no such name, or ``columns`` does not contain it.
    """

    def __init__(
        self,
        numbers: Floats,
        models: NDArray[np.uint8],
        failures: dict[int, str],
        spec: dict[str, Any],
        axes: list[tuple[str, int, dict[str, NDArray[Any]]]],
        rows: range,
        names: tuple[list[str], list[str] | None],
        plan: _core.Plan | None = None,
    ) -> None:
        self._numbers, self._models, self._failures = numbers, models, failures
        self._held, self._chosen = names
        self._spec, self._axes, self._range, self._plan = spec, axes, rows, plan
        self._shape = (len(rows),)

    @property
    def spec(self) -> dict[str, Any]:
        """The sweep with every default and material property of its base scene written out."""
        return self._spec

    @property
    def rows(self) -> range:
        """Indices of the computed rows in the whole sweep, from 0."""
        return self._range

    @property
    def axes(self) -> dict[str, int]:
        """Length of each axis of the whole sweep by name; the last axis varies fastest."""
        return {name: length for name, length, _ in self._axes}

    @property
    def is_whole(self) -> bool:
        """Whether the object contains all rows of the sweep."""
        return self._range == range(int(np.prod([length for _, length, _ in self._axes])))

    @cached_property
    def _keys(self) -> dict[str, NDArray[Any]]:
        lengths = tuple(length for _, length, _ in self._axes)
        rows = np.arange(self._range.start, self._range.stop, self._range.step)
        places = np.unravel_index(rows, lengths)
        keys = {}
        for (_, _, columns), place in zip(self._axes, places, strict=True):
            for name, values in columns.items():
                keys[name] = np.asarray(values)[place]
        return keys

    def to_xarray(self) -> xr.Dataset:
        """The results as an xarray data set, with units and descriptions.

        The dimensions are the axes of the sweep if the object contains all rows, otherwise ``row``.
        """
        from hertzlamb._xarray import of_sweep

        return of_sweep(self)

    def save(self, path: str | os.PathLike[str], *, overwrite: bool = False) -> None:
        """Writes a whole sweep to a file, as ``hertzlamb sweep -o`` does.

        The file contains the results in ``columns`` of `hertzlamb.sweep`, as with ``hertzlamb sweep --columns``.

        Parameters
        ----------
        path : path
            File to write. The extension selects the format: ``.h5``, ``.hdf5`` or ``.hdf`` for HDF5, ``.parquet`` for
            Parquet, ``.csv`` or ``.txt`` for text.
        overwrite : bool
            Whether to replace an existing file.

        Raises
        ------
        ValueError
            The object does not contain all rows.
        OutputExists
            The file exists and ``overwrite`` is False.
        OutputError
            The file cannot be written, or the extension is none of these.
        """
        if not self.is_whole:
            total = int(np.prod([length for _, length, _ in self._axes]))
            raise ValueError(f"these are {len(self._range)} of {total} rows; a sweep file contains all of them")
        plan = _core.plan(self._spec, self._chosen) if self._plan is None else self._plan
        plan.save(path, self._numbers, self._models, list(self._failures.items()), overwrite)

    def plot(self, quantity: str = "restitution", *, axes: Axes | None = None) -> Axes:
        """Draws a result over the first numeric key with matplotlib.

        Each combination of the other keys has its own line. Random samples are drawn as their median with a band from
        the 5th to the 95th percentile, or as a histogram if no numeric key remains.

        Parameters
        ----------
        quantity : str
            Name of a result.
        axes : matplotlib Axes, optional
            Axes to draw into. Default: new axes.

        Raises
        ------
        KeyError
            There is no result of that name.
        """
        from hertzlamb._plot import sweep as draw

        return draw(self, quantity, axes)

    def __repr__(self) -> str:
        axes = " x ".join(f"{name} ({length})" for name, length in self.axes.items())
        return f"{len(self._range)} rows of the sweep over {axes}, {len(self._failures)} failed"

    def __reduce__(self) -> tuple[Any, ...]:
        names = (self._held, self._chosen)
        return Sweep, (self._numbers, self._models, self._failures, self._spec, self._axes, self._range, names)


def _warn(failures: list[tuple[int, str]], rows: int) -> None:
    if failures:
        row, reason = failures[0]
        message = f"{len(failures)} of {rows} impacts failed, the first in row {row} (rows count from 0): {reason}"
        warnings.warn(HertzlambWarning(message), stacklevel=3)


def sweep(
    sweep: Scene,
    *,
    rows: slice | range | None = None,
    columns: Sequence[str] | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Sweep:
    """Computes the contacts of a sweep, or of some of its rows.

    The base scene may not contain ``probe``, ``map`` or ``force``. For fields at probes in every row, run
    ``hertzlamb sweep``, or call `impact` once for each row.

    Parameters
    ----------
    sweep : dict, path or str
        Keys of a sweep file as nested dictionaries, the path of a sweep file, or TOML text.
    rows : slice or range, optional
        Rows to compute, with indices from 0 and a step of at least 1. Each row is bit-identical to the same row of the
        whole sweep. Default: all rows.
    columns : sequence of str, optional
        Names of the results to keep, such as ``["restitution", "loss"]``; each takes 8 bytes per row. Default: all.
    threads : int, optional
        Number of threads in [1, 1024]. Default: one for each available processor.
    progress : bool or callable, optional
        True shows a progress bar. A function is called with the number of finished rows and the total.

    Returns
    -------
    Sweep
        Results by row; the results of a failed row are NaN, and `Sweep.failures` contains the reason.

    Raises
    ------
    SceneError
        The sweep is invalid, has probes, a map or a force record, or ``columns`` contains an unknown name.
    IndexError
        ``rows`` is a range with rows that the sweep does not have.
    TypeError, ValueError
        ``rows`` is neither a slice nor a range, or its step is not positive.
    TooMuchMemory
        The rows need more memory than is free.

    Warns
    -----
    HertzlambWarning
        At least one row failed.

    Examples
    --------
    >>> import hertzlamb as hl
    >>> ball = {"shape": "ball", "material": "bearing-steel", "diameter_m": 0.003}
    >>> out = hl.sweep({"scene": {"target": {"material": "granite"}, "striker": ball},
    ...                 "product": {"striker": {"velocity_m_s": [0.5, 1.0, 2.0]}}})
    >>> out.restitution.shape, out.axes
    ((3,), {'striker.velocity_m_s': 3})
    """
    plan = _core.plan(sweep, columns)
    wanted = range(plan.rows)
    if isinstance(rows, range):
        wanted = rows
    elif isinstance(rows, slice):
        wanted = wanted[rows]
    elif rows is not None:
        raise TypeError(f"rows = {rows!r} is neither a slice nor a range: pass one such as rows=slice(0, 1000)")
    if wanted.step < 1:
        raise ValueError(f"rows = {rows}: the step must be at least 1")
    if len(wanted) > 0 and not 0 <= wanted[0] <= wanted[-1] < plan.rows:
        raise IndexError(f"rows = {rows}: the sweep has {plan.rows} rows, which count from 0")
    with told(progress) as tell:
        numbers, models, failures = plan.compute(
            wanted.start if len(wanted) else 0, wanted.step, len(wanted), threads, tell
        )
    _warn(failures, len(wanted))
    axes = [
        (name, length, {key: np.asarray(values) for key, values in columns.items()})
        for name, length, columns in plan.axes()
    ]
    return Sweep(numbers, models, dict(failures), plan.resolved(), axes, wanted, _named(plan, columns), plan)


def _named(plan: _core.Plan, columns: Sequence[str] | None) -> tuple[list[str], list[str] | None]:
    """Names of the computed results, and the requested ones."""
    return plan.results(), None if columns is None else list(columns)


def _section_of(key: str) -> str:
    """Section of a scene that contains a key."""
    found = _core.sections_of(key, ["columns", "threads", "progress"])
    if len(found) == 1:
        return found[0]
    names = " or ".join(f"{section}__{key}" for section in found)
    raise TypeError(f"{key} is a key of {' and of '.join(found)}: write {names}")


def collide(
    scene: Scene,
    *,
    columns: Sequence[str] | None = None,
    threads: int | None = None,
    progress: Progress = None,
    **keys: ArrayLike,
) -> Collisions:
    """Computes the contacts of many impacts of one scene; any of its keys may be an array.

    The scene may not contain ``probe``, ``map`` or ``force``; call `impact` for fields at probes.

    Parameters
    ----------
    scene : dict, path or str
        Scene as for `impact`; you may omit the keys that vary.
    columns : sequence of str, optional
        Names of the results to keep, such as ``["restitution", "loss"]``; each takes 8 bytes per impact. Default: all.
    threads : int, optional
        Number of threads in [1, 1024]. Default: one for each available processor.
    progress : bool or callable, optional
        True shows a progress bar. A function is called with the number of finished impacts and the total.
    **keys : array_like
        Values of scene keys, numbers or strings, which are broadcast: ``velocity_m_s=v``. If several sections have a
        key, prefix it with the section: ``target__poisson_ratio=nu``. NaN, infinity and masked numbers are impacts that
        fail.

    Returns
    -------
    Collisions
        Results of the broadcast shape; the results of a failed impact are NaN, and `Collisions.failures` contains the
        reason.

    Raises
    ------
    SceneError
        The scene is invalid, a key or string is unknown, or values are neither plain numbers nor strings. There are more
        than 10,000,000 impacts.
    TypeError
        No key is passed, or several sections have the key.
    ValueError
        The arrays cannot be broadcast together.
    TooMuchMemory
        The impacts need more memory than is free.

    Warns
    -----
    HertzlambWarning
        At least one impact failed.

    Examples
    --------
    >>> import hertzlamb as hl, numpy as np
    >>> scene = {"target": {"material": "granite"}, "striker": {"material": "steel", "tip_radius_m": 5e-4}}
    >>> out = hl.collide(scene, velocity_m_s=np.geomspace(0.1, 10, 5), mass_kg=[[4e-6], [8e-6]])
    >>> out.restitution.shape
    (2, 5)
    """
    if not keys:
        raise TypeError("pass at least one key as an array, such as velocity_m_s=...")
    # the section first: a misspelt argument is not an array
    places = {name: name.rpartition("__")[::2] for name in keys}
    sections = {name: section or _section_of(key) for name, (section, key) in places.items()}
    arrays = {name: of_key(name, values) for name, values in keys.items()}
    shape = np.broadcast_shapes(*(array.shape for array in arrays.values()))
    count = math.prod(shape)
    _core.check_at_once(count)
    names, varying = {}, []
    for name, array in arrays.items():
        section, key = sections[name], places[name][1]
        flat = np.broadcast_to(array, shape).reshape(-1)
        values = flat.tolist() if flat.dtype.kind == "U" else np.ascontiguousarray(flat)
        names[f"{section}.{key}"] = array
        varying.append((section, key, values))
    plan = _core.plan_of_columns(scene, varying, columns)
    if count == 0:
        empty = np.empty((len(plan.results()), 0)), np.empty(0, dtype=np.uint8)
        return Collisions(*empty, {}, names, shape, _named(plan, columns))
    with told(progress) as tell:
        numbers, models, failures = plan.compute(0, 1, count, threads, tell)
    _warn(failures, count)
    return Collisions(numbers, models, dict(failures), names, shape, _named(plan, columns))
