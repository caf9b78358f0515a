"""Many impacts: sweeps, and scenes any key of which is an array."""

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
"""Names of the contact models, by the number that stands for them."""

_COUNTS = [name for name, (_, _, kind) in QUANTITIES.items() if kind == "count"]
_FAILED = 255


class _Rows(Mapping[str, "NDArray[Any]"], OfRows):
    """Scalar results of many impacts, by name and as attributes."""

    _numbers: Floats
    """The results that are held, (result, row)."""
    _held: list[str]
    """Their names."""
    _chosen: list[str] | None
    """The names that ``columns`` asked for; None for all."""
    _models: NDArray[np.uint8]
    _failures: dict[int, str]
    _shape: tuple[int, ...]

    @cached_property
    def _keys(self) -> dict[str, NDArray[Any]]:
        """The keys that vary, of the shape of the results."""
        raise NotImplementedError

    @property
    def _names(self) -> list[str]:
        """Names of the results, in order."""
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
        """The name of the model of each row, of all models and that of none."""
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
                raise AttributeError(f"{name} is not among the columns asked for, {', '.join(self._names)}")
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._names]

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of every result."""
        return self._shape

    @property
    def model(self) -> NDArray[np.str_]:
        """Name of the contact model of each impact, empty for one that failed."""
        return self["model"]

    @property
    def failures(self) -> dict[int, str]:
        """Why impacts failed, by their number in the flattened results; their numbers are NaN."""
        return dict(self._failures)

    def _columns(self) -> dict[str, NDArray[Any]]:
        """All columns, flat; words as objects."""
        keys = {name: np.ascontiguousarray(values).reshape(-1) for name, values in self._keys.items()}
        columns = {name: values.astype(object) if values.dtype.kind == "U" else values for name, values in keys.items()}
        columns |= {name: self[name].reshape(-1) for name in self._names}
        columns["model"] = self._model_names(np.array([*MODELS, ""], dtype=object))
        failure = np.full(len(self._models), "", dtype=object)
        for row, reason in self._failures.items():
            failure[row] = reason
        return {**columns, "failure": failure}

    def to_pandas(self) -> pd.DataFrame:
        """A row for each impact: the keys that vary, the results, the model, and why it failed.

        Counts such as ``contacts`` are integers (``Int64``), missing where an impact failed.
        """
        import pandas as pd

        columns: dict[str, Any] = self._columns()
        for name, values in columns.items():
            if name in _COUNTS:
                columns[name] = pd.arrays.IntegerArray(*_counted(values))
        return pd.DataFrame(columns)

    def to_arrow(self) -> pa.Table:
        """The same as a table of Arrow, with units and meanings as metadata of its fields."""
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
        """The same as a data frame of polars."""
        import polars as pl

        columns = {}
        for name, values in self._columns().items():
            column = pl.Series(name, values.tolist() if values.dtype.kind == "O" else values)
            columns[name] = column.fill_nan(None).cast(pl.Int64) if name in _COUNTS else column
        return pl.DataFrame(columns)


def _counted(values: Floats) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """Counts as whole numbers, and where there is none."""
    missing = np.isnan(values)
    return np.where(missing, 0.0, values).astype(np.int64), missing


class Collisions(_Rows):
    """Scalar results of many impacts that `collide` has computed, each of the broadcast shape.

    ``out.restitution``, ``out["peak_force_n"]``: the names are those of `Impact`.
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
        """The results over the dimensions dim_0, dim_1 ..., with the keys that vary as coordinates."""
        from hertzlamb._xarray import of_collisions

        return of_collisions(self)

    def __repr__(self) -> str:
        shape = " x ".join(map(str, self._shape)) or "1"
        return f"{shape} impacts, {len(self._failures)} failed; {', '.join(self._given)} vary"

    def __reduce__(self) -> tuple[Any, ...]:
        names = (self._held, self._chosen)
        return Collisions, (self._numbers, self._models, self._failures, self._given, self._shape, names)


class Sweep(_Rows):
    """Rows of a sweep: scalar results by name, each (row,), and the keys that vary.

    ``out["restitution"]``, ``out.restitution``, ``out["striker.mass_kg"]``.
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
        """The sweep with its base scene spelled out."""
        return self._spec

    @property
    def rows(self) -> range:
        """Numbers of the rows in the whole sweep."""
        return self._range

    @property
    def axes(self) -> dict[str, int]:
        """Length of each axis of the whole sweep by name; the last runs fastest."""
        return {name: length for name, length, _ in self._axes}

    @property
    def is_whole(self) -> bool:
        """Whether all rows of the sweep are here, in order."""
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
        """The results over the axes of the sweep where it is whole, else over row; units and meanings as attributes."""
        from hertzlamb._xarray import of_sweep

        return of_sweep(self)

    def save(self, path: str | os.PathLike[str], *, overwrite: bool = False) -> None:
        """Writes the file of ``hertzlamb sweep`` for a whole sweep: HDF5, or Parquet or text for the file extensions ``.parquet`` and ``.csv``.

        It has the results that ``columns`` of `hertzlamb.sweep` named, as that of ``hertzlamb sweep --columns`` has.
        """
        if not self.is_whole:
            total = int(np.prod([length for _, length, _ in self._axes]))
            raise ValueError(f"these are {len(self._range)} of {total} rows: a sweep file holds all of them")
        plan = _core.plan(self._spec, self._chosen) if self._plan is None else self._plan
        plan.save(path, self._numbers, self._models, list(self._failures.items()), overwrite)

    def plot(self, quantity: str = "restitution", *, axes: Axes | None = None) -> Axes:
        """Draws a result over the first axis that is a number (matplotlib); of random draws, their spread."""
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
    """Computes a sweep, or any part of its rows.

    Parameters
    ----------
    sweep : dict, path or str
        The keys of a sweep file as nested dictionaries, the path of a file, or TOML text.
    rows : slice or range, optional
        Which rows, as those of a list; each has the same bits as in the whole.
    columns : sequence of str, optional
        Names of the results to keep, such as ``["restitution", "loss"]``, as ``--columns`` of the command; default: all.
        A row takes 8 bytes for each.
    threads : int, optional
        Threads, all processors otherwise.
    progress : bool or callable, optional
        True for a bar; a function is called with the rows that are done and how many there are.

    Returns
    -------
    Sweep
        Results by row; a row that failed is NaN, with its reason in ``failures``.

    Warns
    -----
    HertzlambWarning
        Rows have failed.
    """
    plan = _core.plan(sweep, columns)
    wanted = range(plan.rows)
    if isinstance(rows, range):
        wanted = rows
    elif isinstance(rows, slice):
        wanted = wanted[rows]
    elif rows is not None:
        raise TypeError(f"rows = {rows!r} is neither a slice nor a range: give one such as rows=slice(0, 1000)")
    if wanted.step < 1:
        raise ValueError(f"rows = {rows}: the step is at least 1")
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
    """Names of the results that are held, and those that were asked for."""
    return plan.results(), None if columns is None else list(columns)


def _section_of(key: str) -> str:
    """The section of a scene that has a key."""
    found = _core.sections_of(key, ["columns", "threads", "progress"])
    if len(found) == 1:
        return found[0]
    names = " or ".join(f"{section}__{key}" for section in found)
    raise TypeError(f"{key} is a key of {' and of '.join(found)}: give {names}")


def collide(
    scene: Scene,
    *,
    columns: Sequence[str] | None = None,
    threads: int | None = None,
    progress: Progress = None,
    **keys: ArrayLike,
) -> Collisions:
    """Computes many impacts of one scene: any of its keys may be an array.

    Only contacts are computed; the scene has no probes and no map.

    Parameters
    ----------
    scene : dict, path or str
        The scene as for `impact`; keys that vary may be left out of it.
    columns : sequence of str, optional
        Names of the results to keep, such as ``["restitution", "loss"]``; default: all. An impact takes 8 bytes for each.
    threads : int, optional
        Threads, all processors otherwise.
    progress : bool or callable, optional
        True for a bar; a function is called with the impacts that are done and how many there are.
    **keys : array_like
        Values of keys, numbers or words, broadcast: ``velocity_m_s=v``; where two sections have the key,
        ``target__poisson_ratio=nu``. NaN, infinity and masked entries are impacts that fail.

    Returns
    -------
    Collisions
        Results of the broadcast shape; an impact that failed is NaN, with its reason in ``failures``.

    Raises
    ------
    SceneError
        A key or a word that no scene has, or values that are not plain numbers or words.

    Warns
    -----
    HertzlambWarning
        Impacts have failed.

    Examples
    --------
    >>> import hertzlamb as hl, numpy as np
    >>> scene = {"target": {"material": "granite"}, "striker": {"material": "steel", "tip_radius_m": 5e-4}}
    >>> out = hl.collide(scene, velocity_m_s=np.geomspace(0.1, 10, 5), mass_kg=[[4e-6], [8e-6]])
    >>> out.restitution.shape
    (2, 5)
    """
    if not keys:
        raise TypeError("give at least one key as an array, such as velocity_m_s=...")
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
