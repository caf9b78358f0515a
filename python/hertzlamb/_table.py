"""Kernel tables: `Table`, `Trace` and `tabulate`."""

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
    """Step responses from a table: six fields by name, each of the broadcast shape of ``r`` and ``z`` followed by (time,).

    A value is the mean over a time cell. Units are reduced: times in r0/c1, displacements in P/(mu r0) and stresses in
    P/r0^2, negative in compression.
    """

    __slots__ = ("cell_width", "error", "nu", "r", "static", "time", "z")

    nu: float
    """Poisson's ratio."""
    r: Floats
    """Distances from the axis in r0, of the broadcast shape."""
    z: Floats
    """Depths in r0, of the broadcast shape."""
    time: Floats
    """Midpoints of the time cells in r0/c1, (time,)."""
    cell_width: float
    """Width of a time cell in r0/c1."""
    static: Fields
    """Static fields in closed form, of the broadcast shape."""
    error: Fields
    """Estimated absolute errors of the response to a pulse of unit peak that is ten cells long, of the broadcast shape."""

    def __init__(self, array: Floats, **rest: Any) -> None:
        super().__init__(array)
        for name, value in rest.items():
            setattr(self, name, value)

    def __getstate__(self) -> dict[str, Any]:
        return {name: getattr(self, name) for name in ("array", *Trace.__slots__)}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__init__(**state)  # type: ignore[misc]

    def to_xarray(self) -> xr.Dataset:
        """The traces as an xarray data set with the dimensions point and time, and with units; points are flattened."""
        from hertzlamb._xarray import of_trace

        return of_trace(self)


class Table:
    """A kernel table on disk.

    The object is immutable, and several threads can use it. A pickle contains the path and the id; unpickling raises
    `BadTable` if the path holds another table. `open`, `demo` and `tabulate` return tables.

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
        """Opens a kernel table.

        Parameters
        ----------
        path : path
            File written by `tabulate` or ``hertzlamb tabulate``.

        Raises
        ------
        BadTable
            The file does not exist, is not a kernel table, has an unknown format version, or is incomplete or damaged.
        """
        return cls(_core.Table.open(path))

    @classmethod
    def demo(cls, *, progress: Progress = None) -> Table:
        """Opens a small table for nu = 0.3 with r and z up to 6 r0 (14 MB).

        The first call computes the table in some seconds and stores it in a cache directory; later calls open that file.
        The directory is ``$HERTZLAMB_CACHE`` if this environment variable is set, otherwise ``hertzlamb`` in
        ``$XDG_CACHE_HOME``, or in ``~/.cache`` by default.

        Parameters
        ----------
        progress : bool or callable, optional
            True shows a progress bar. A function is called with the work done and the total.

        Raises
        ------
        BadTable
            The stored file is damaged.
        OutputError
            The file cannot be written.
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
        """Path of the file."""
        return Path(self._core.path)

    @property
    def id(self) -> str:
        """Hash of the settings of the table, 16 hexadecimal digits."""
        return self._core.id

    def info(self) -> dict[str, Any]:
        """Settings and measured errors of the table, with the keys of ``hertzlamb table info --json``.

        Raises
        ------
        BadTable
            The file changed after it was opened, or is damaged.
        """
        if self._info is None:
            self._info = self._core.info()
        return dict(self._info)

    @property
    def poisson_ratios(self) -> Floats:
        """Tabulated Poisson's ratios in ascending order, (slice,)."""
        return np.array(self.info()["poisson_ratios"])

    @property
    def r_max(self) -> float:
        """Largest distance from the axis in the table, in r0."""
        return float(self.info()["r_max"])

    @property
    def z_max(self) -> float:
        """Largest depth in the table, in r0."""
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
        """Step responses over time at points, interpolated in the table.

        Parameters
        ----------
        nu : float
            Poisson's ratio, within the range of the table.
        r, z : array_like
            Distances from the axis and depths in r0, within the range of the table; broadcast together.
        cells : int, optional
            Number of time cells, at least 1; it may exceed the number in the table. Default: as in the table.
        coarsening : int
            Each time cell combines 2**coarsening cells of the table, 0 to 20.
        smooth : bool
            True for the convolution with a force that is smooth within a cell. Default: a force that is linear within
            a cell.
        threads : int, optional
            Number of threads in [1, 1024]. Default: one for each available processor.
        progress : bool or callable, optional
            True shows a progress bar. A function is called with the number of finished points and the total.

        Returns
        -------
        Trace
            Fields of the broadcast shape followed by (time,), in reduced units, with ``time``, ``static`` and ``error``.

        Raises
        ------
        OutsideTable
            A point, ``nu`` or ``coarsening`` is outside the table; the exception contains axis, value and range.
        DomainError
            ``r`` or ``z`` contains something other than numbers, or ``cells``, ``coarsening`` or ``threads`` is outside
            its range.
        BadTable
            The file changed after it was opened, or is damaged.
        TooMuchMemory
            The trace needs more memory than is free.
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
        """Extends the file by Poisson's ratios or a larger range; only the missing parts are computed.

        Parameters
        ----------
        nu : float or sequence, optional
            Poisson's ratios in [-0.95, 0.495], each of which gets an exact slice without interpolation between ratios.
        r_max, z_max : float, optional
            New largest distance from the axis and largest depth in r0.
        time_factor : float, optional
            New end of the time cells, as a multiple of the last arrival.
        threads : int, optional
            Number of threads in [1, 1024]. Default: one for each available processor.
        progress : bool or callable, optional
            True shows a progress bar. A function is called with the work done and the total.

        Returns
        -------
        Table
            The extended table. The object on which you call the method no longer matches the file.

        Raises
        ------
        SceneError
            An argument is outside its range, or less than the present value: tables only grow.
        BadTable
            The file is damaged, or cannot be extended.
        OutputError
            The file cannot be written, or another run is writing it.
        """
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
        raise BadTable(f"{path} is another table now: its id is {table.id}, the pickle's id {identity}", file=path)
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
    """Computes a kernel table and writes it to a file, as ``hertzlamb tabulate`` does.

    You can interrupt the computation; the same call later resumes it.

    Parameters
    ----------
    path : path
        File to write, with the extension ``.h5``, ``.hdf5`` or ``.hdf``.
    grid : str, path or dict
        Preset (``"demo"``, ``"standard"`` or ``"wide"``), TOML file, or the keys of such a file as a dictionary.
    nu : float or sequence, optional
        Poisson's ratios in [-0.95, 0.495] that replace those of the grid.
    r_max, z_max : float, optional
        Largest distance from the axis and largest depth in r0. Default: those of the grid.
    time_factor : float, optional
        End of the time cells as a multiple of the last arrival. Default: that of the grid.
    tolerance, pulse_length : float, optional
        Target error relative to the peak in time, and the length of the pulses in r0/c1 for which it holds; the spacing
        of the grid is refined to reach it. Pass both or neither. Default: the spacing of the grid.
    overwrite : bool
        Whether to replace an existing file.
    threads : int, optional
        Number of threads in [1, 1024]. Default: one for each available processor.
    progress : bool or callable, optional
        True shows a progress bar. A function is called with the work done and the total.

    Returns
    -------
    Table
        The opened table.

    Raises
    ------
    SceneError
        The grid or one of the arguments is invalid.
    DomainError
        ``grid`` is not the name of a preset, or ``threads`` is outside its range.
    TypeError
        Only one of ``tolerance`` and ``pulse_length`` is passed.
    OutputExists
        The file exists and ``overwrite`` is False.
    OutputError
        The file cannot be written, or another run is writing it.
    """
    if (tolerance is None) != (pulse_length is None):
        raise TypeError("tolerance and pulse_length go together: pass both or neither")
    accuracy = None if tolerance is None or pulse_length is None else (tolerance, pulse_length)
    with told(progress) as tell:
        _core.tabulate(
            path, grid, _ratios(nu), r_max, z_max, time_factor, accuracy, overwrite, threads, tell
        )
    return Table.open(path)
