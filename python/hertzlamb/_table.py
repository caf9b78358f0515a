"""Kernel tables."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from hertzlamb import _core
from hertzlamb._arrays import numbers
from hertzlamb._fields import FIELDS, Fields
from hertzlamb._progress import Progress, told

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import ArrayLike, NDArray

    Floats = NDArray[np.float64]

PathLike = str | os.PathLike[str]


class Trace(Fields):
    """Step responses looked up in a table: six fields by name, each of shape (point, time), or (time,) for one point.

    A value is the average over a time cell; `time` has the middles of the cells.
    Reduced units: times in r0/c1, displacements in P/(mu r0), stresses in P/r0^2.
    """

    __slots__ = ("cell_width", "error", "nu", "r", "static", "time", "z")

    nu: float
    """Poisson's ratio."""
    r: Floats
    """Distances from the axis in r0."""
    z: Floats
    """Depths in r0."""
    time: Floats
    """Middles of the time cells in r0/c1, shape (time,)."""
    cell_width: float
    """Width of a cell in r0/c1."""
    static: Fields
    """The static fields, in closed form, shape (point,)."""
    error: Fields
    """Estimated absolute error of the response to a pulse of unit peak ten cells long, shape (point,)."""

    def __init__(self, array: Floats, **rest: Any) -> None:
        super().__init__(array)
        for name, value in rest.items():
            setattr(self, name, value)

    def __getstate__(self) -> dict[str, Any]:
        return {name: getattr(self, name) for name in ("array", *Trace.__slots__)}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__init__(**state)  # type: ignore[misc]

    def to_xarray(self) -> xr.Dataset:
        """The traces as a data set with the dimensions point and time."""
        from hertzlamb._xarray import of_trace

        return of_trace(self)


class Table:
    """A kernel table on disk, opened once and asked often.

    It is immutable and may be used by several threads; a pickle of it holds its path and its id, and opening refuses
    another table under that path.

    >>> import hertzlamb as hl
    >>> table = hl.Table.demo()
    >>> u = table.trace(nu=0.3, r=[0.5, 4.0], z=[0.6, 0.0])
    >>> u["stress_zz"].shape[0]
    2
    """

    def __init__(self, opened: _core.Table) -> None:
        self._core = opened
        self._info: dict[str, Any] | None = None

    @classmethod
    def open(cls, path: PathLike) -> Table:
        """Opens a table.

        Parameters
        ----------
        path : path
            A file made with `tabulate` or ``hertzlamb tabulate``.

        Raises
        ------
        BadTable
            The file is absent, no kernel table, of an unknown version, incomplete or damaged.
        """
        return cls(_core.Table.open(path))

    @classmethod
    def demo(cls, *, progress: Progress = None) -> Table:
        """A small table for nu = 0.3 that reaches to 6 r0, 14 MB: made once, in some seconds, in the cache directory.

        The directory is that of the environment variable ``HERTZLAMB_CACHE``, else ``hertzlamb`` in the user's caches.
        """
        folder = os.environ.get("HERTZLAMB_CACHE")
        if folder is None:
            caches = os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache")
            folder = os.path.join(caches, "hertzlamb")
        path = os.path.join(folder, f"demo-{_core.VERSION}.h5")
        if not os.path.exists(path):
            os.makedirs(folder, exist_ok=True)
            tabulate(path, "demo", progress=progress)
        return cls.open(path)

    @property
    def path(self) -> Path:
        """Where it is."""
        return Path(self._core.path)

    @property
    def id(self) -> str:
        """Identity of the settings that it was made with, 16 hexadecimal digits."""
        return self._core.id

    def info(self) -> dict[str, Any]:
        """Every setting and the errors measured, as ``hertzlamb table info --json`` prints them."""
        if self._info is None:
            self._info = self._core.info()
        return dict(self._info)

    @property
    def poisson_ratios(self) -> Floats:
        """Poisson's ratios tabulated."""
        return np.array(self.info()["poisson_ratios"])

    @property
    def r_max(self) -> float:
        """Largest distance from the axis in r0."""
        return float(self.info()["r_max"])

    @property
    def z_max(self) -> float:
        """Largest depth in r0."""
        return float(self.info()["z_max"])

    def trace(
        self,
        nu: float,
        r: ArrayLike,
        z: ArrayLike,
        *,
        cells: int | None = None,
        coarsening: int = 0,
        smooth: bool = False,
        threads: int | None = None,
        progress: Progress = None,
    ) -> Trace:
        """Step responses over time at points, looked up.

        Parameters
        ----------
        nu : float
            Poisson's ratio, within those of the table.
        r, z : array_like
            Distances from the axis and depths in r0; broadcast, flattened.
        cells : int, optional
            Time cells of each trace, any number; those of the table otherwise.
        coarsening : int
            A cell of the trace is 2**coarsening cells of the table, 0 to 20.
        smooth : bool
            Cells for forces that are smooth rather than linear within a cell.
        threads : int, optional
            Threads, all processors otherwise.
        progress : bool or callable, optional
            True for a bar; a function is called with what is done and how much there is.

        Returns
        -------
        Trace
            ``u.time`` (time,), ``u["stress_zz"]`` (point, time), ``u.static`` and ``u.error`` (point,).

        Raises
        ------
        OutsideTable
            With axis, value and range.
        """
        shape, (flat_r, flat_z) = numbers(r=r, z=z)
        with told(progress) as tell:
            array, still, error, width = self._core.trace(nu, flat_r, flat_z, coarsening, cells, smooth, threads, tell)
        time = (np.arange(array.shape[1]) + 0.5) * width
        time.setflags(write=False)
        return Trace(
            array.reshape((*shape, *array.shape[1:])),
            nu=nu,
            r=flat_r.reshape(shape),
            z=flat_z.reshape(shape),
            time=time,
            cell_width=width,
            static=Fields(still.reshape((*shape, 6))),
            error=Fields(error.reshape((*shape, 6))),
        )

    def extend(
        self,
        *,
        nu: Sequence[float] | float | None = None,
        r_max: float | None = None,
        z_max: float | None = None,
        time_factor: float | None = None,
        threads: int | None = None,
        progress: Progress = None,
    ) -> Table:
        """Adds slices for Poisson's ratios, or reach, to the file, and opens it anew; only what is missing is computed."""
        with told(progress) as tell:
            _core.extend(self.path, _ratios(nu), r_max, z_max, time_factor, threads, tell)
        return Table.open(self.path)

    def __repr__(self) -> str:
        i = self.info()
        lines = [f"kernel table {i['file']} ({i['bytes'] / 1e6:.1f} MB)"]
        lines.append(f"id              {i['id']}, format {i['format_version']}, written by {i['software_version']}")
        lines.append(f"Poisson ratios  {i['poisson_ratios']}")
        lines.append(f"r               0 .. {i['r_max']} r0, {i['r_nodes']} nodes")
        lines.append(f"z               0 .. {i['z_max']} r0, {i['z_nodes']} nodes")
        fewest, most = min(i["cells"]), max(i["cells"])
        cells = f"{fewest} to {most}" if fewest < most else str(most)
        lines.append(f"time            {cells} cells of {i['cell_width']} r0/c1 per slice, then a tail")
        lines.append(f"interpolation   {i['stencil_points']} points")
        for errors in i["relative_errors"]:
            name = max(FIELDS, key=lambda field: errors["on_slices"][field]["p99"])
            worst = errors["on_slices"][name]["p99"]
            lines.append(f"error           pulses of {errors['pulse_length']:g} r0/c1: 99 % below {worst:.1e} ({name})")
        return "\n".join(lines)

    def __reduce__(self) -> tuple[Any, ...]:
        return _reopened, (str(self.path.resolve()), self.id)


def _reopened(path: str, identity: str) -> Table:
    from hertzlamb._errors import BadTable

    table = Table.open(path)
    if table.id != identity:
        raise BadTable(f"{path} is another table now: its id is {table.id}, that of the pickle {identity}", file=path)
    return table


def _ratios(nu: Sequence[float] | float | None) -> list[float] | None:
    return None if nu is None else [float(each) for each in np.atleast_1d(nu)]


def tabulate(
    path: PathLike,
    grid: Literal["demo", "standard", "wide"] | PathLike | Mapping[str, Any] = "demo",
    *,
    nu: Sequence[float] | float | None = None,
    r_max: float | None = None,
    z_max: float | None = None,
    time_factor: float | None = None,
    tolerance: float | None = None,
    pulse_length: float | None = None,
    overwrite: bool = False,
    threads: int | None = None,
    progress: Progress = None,
) -> Table:
    """Makes a kernel table, the file that ``hertzlamb tabulate`` makes.

    Interrupted, it goes on where it stopped when the same is asked again.

    Parameters
    ----------
    path : path
        The file to write; it ends with ``.h5``.
    grid : str, path or dict
        A preset (``"demo"``, ``"standard"``, ``"wide"``), a TOML file or its keys as a dictionary.
    nu : float or sequence, optional
        Poisson's ratios instead of those of the grid.
    r_max, z_max : float, optional
        Largest distance from the axis and depth in r0.
    time_factor : float, optional
        The time cells end at this multiple of the last arrival.
    tolerance, pulse_length : float, optional
        Together: the spacing is chosen so that errors over the peak in time stay below the tolerance for pulses of this
        length in r0/c1.
    overwrite : bool
        Whether a file that is there is replaced.
    threads : int, optional
        Threads, all processors otherwise.
    progress : bool or callable, optional
        True for a bar; a function is called with what is done and how much there is.
    """
    if (tolerance is None) != (pulse_length is None):
        raise TypeError("tolerance and pulse_length are given together")
    accuracy = None if tolerance is None or pulse_length is None else (tolerance, pulse_length)
    with told(progress) as tell:
        _core.tabulate(
            path, grid, _ratios(nu), r_max, z_max, time_factor, accuracy, overwrite, threads, tell
        )
    return Table.open(path)
