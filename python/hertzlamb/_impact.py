"""Single impacts: `impact`, `infer`, `resolve` and their results."""

from __future__ import annotations

import os
import tempfile
import warnings
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Protocol

from hertzlamb import _core
from hertzlamb._errors import HertzlambWarning, OutputExists, SceneError
from hertzlamb._names import OfEnergy, OfFields, OfProbes, OfSection
from hertzlamb._progress import Progress, told
from hertzlamb._sensors import Sensor
from hertzlamb._table import Table

if TYPE_CHECKING:
    import numpy as np
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

Scene = Mapping[str, Any] | str | os.PathLike[str]
"""A scene: nested dictionaries with the keys of a scene file, the path of a scene file, or TOML text."""

DESCRIBED: dict[str, Any] = _core.describe()
"""Unit and description of every name in the results, by the part of the results that contains it."""

QUANTITIES: dict[str, list[str]] = DESCRIBED["quantities"]
"""Unit, description and kind (``"real"`` or ``"count"``) of every scalar result."""


class _Results(Protocol):
    """Interface to the results of an impact: `_core.Outcome`, or `_Kept` after unpickling."""

    def numbers(self) -> dict[str, Any]: ...
    def report(self) -> dict[str, Any]: ...
    def warnings(self) -> list[str]: ...
    def scene(self) -> dict[str, Any]: ...
    def series(self) -> dict[str, Floats]: ...
    def energy(self) -> dict[str, Floats] | None: ...
    def probes(self) -> dict[str, Any] | None: ...
    def sensors(self) -> list[dict[str, Any]]: ...
    def section(self) -> dict[str, Any] | None: ...
    def save(self, path: os.PathLike[str] | str, overwrite: bool, csv: bool) -> None: ...


class _Kept:
    """Results of an unpickled impact: plain arrays, and the content of the output files."""

    def __init__(self, parts: dict[str, Any], files: dict[str, bytes]) -> None:
        self.parts, self.files = parts, files
        for part in ("series", "energy", "probes", "section"):
            for array in (parts[part] or {}).values():
                array.setflags(write=False)
        for sensor in parts["sensors"]:
            for value in sensor.values():
                if hasattr(value, "setflags"):
                    value.setflags(write=False)

    def numbers(self) -> dict[str, Any]:
        return dict(self.parts["numbers"])

    def report(self) -> dict[str, Any]:
        return dict(self.parts["report"])

    def warnings(self) -> list[str]:
        return list(self.parts["warnings"])

    def scene(self) -> dict[str, Any]:
        return dict(self.parts["scene"])

    def series(self) -> dict[str, Floats]:
        return dict(self.parts["series"])

    def energy(self) -> dict[str, Floats] | None:
        return None if self.parts["energy"] is None else dict(self.parts["energy"])

    def probes(self) -> dict[str, Any] | None:
        return None if self.parts["probes"] is None else dict(self.parts["probes"])

    def sensors(self) -> list[dict[str, Any]]:
        return [dict(sensor) for sensor in self.parts["sensors"]]

    def section(self) -> dict[str, Any] | None:
        return None if self.parts["section"] is None else dict(self.parts["section"])

    def save(self, path: os.PathLike[str] | str, overwrite: bool, csv: bool) -> None:
        try:
            with open(path, "wb" if overwrite else "xb") as file:
                file.write(self.files["impact.csv" if csv else "impact.h5"])
        except FileExistsError:
            message = f"{os.fspath(path)} exists already and is not replaced; pass overwrite=True to replace it"
            raise OutputExists(message, file=os.fspath(path)) from None


class _Group(Mapping[str, "NDArray[Any]"]):
    """Mapping of read-only arrays by name; each is also an attribute."""

    _more = ""
    """Advice on how to get more arrays, appended to the message about an unknown name."""

    def __init__(self, arrays: dict[str, Any]) -> None:
        self._arrays = arrays

    def __getitem__(self, name: str) -> NDArray[Any]:
        try:
            array: NDArray[Any] = self._arrays[name]
        except KeyError:
            raise KeyError(f"{name!r} is not one of {', '.join(self._arrays)}{self._more}") from None
        return array

    def __iter__(self) -> Any:
        return iter(self._arrays)

    def __len__(self) -> int:
        return len(self._arrays)

    if not TYPE_CHECKING:  # for type checkers, `_names` has the attributes

        def __getattr__(self, name: str) -> NDArray[Any]:
            if not name.startswith("_") and name in self._arrays:
                return self[name]
            there = ", ".join(self._arrays)
            raise AttributeError(f"{type(self).__name__} has no {name!r}; it has {there}{self._more}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._arrays]

    def __repr__(self) -> str:
        lines = [f"{name:24} {' x '.join(map(str, array.shape))}" for name, array in self._arrays.items()]
        return "\n".join([type(self).__name__.lstrip("_"), *lines])

    def __getstate__(self) -> dict[str, Any]:
        return {"_arrays": self._arrays}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self._arrays = state["_arrays"]


class Energy(_Group, OfEnergy):
    """Energies over time in J, by name and as attributes, each (time,).

    Attributes
    ----------
    kinetic : ndarray
        Kinetic energy of the striker; absent for a force record.
    work : ndarray
        Work of the force on the half-space; only for a force record.
    stored : ndarray
        Elastic energy that the contact returns.
    radiated : ndarray
        Work on the delayed part of the deflection; after the contact, the energy radiated as waves.
    plastic : ndarray
        Work of the plastic flow; only for a scene with ``contact.plasticity``.
    """


_ASK = '; the scene can request more, such as "output": {"quantities": ["velocity_z"]}'


class Errors(_Group, OfFields):
    """Estimated absolute errors of the fields by name, each (probe,) and in the unit of its field."""


class Probes(_Group, OfProbes):
    """Fields over time at the probes of a scene, by name and as attributes.

    Every item is a read-only array. An unknown name raises a `KeyError` as an item and an `AttributeError` as an
    attribute.

    Each quantity in ``output.quantities`` of the scene adds an array (probe, time) of its own name: velocities
    (``velocity_r``, ``velocity_z``, m/s), accelerations (m/s^2), strains, equivalent and principal stresses
    (``von_mises``, ``tresca``, ``max_shear``, ``principal_1`` to ``principal_3``, Pa).

    Attributes
    ----------
    r, z : ndarray (probe,)
        Distance from the axis and depth in m.
    arrival : ndarray (probe, 3)
        Arrival times in s of the first P, S and Rayleigh wave; infinite if there is no Rayleigh wave.
    valid_until : ndarray (probe,)
        Arrival time in s of the first echo from another face of the block that the fields do not have; infinite if the scene names no
        such face.
    echo : ndarray (wave,)
        Names of the waves between the faces of a plate: P or S for each leg, and for the last part of one that ends inside;
        only with ``echoes`` or ``until_s`` in the scene's ``target``.
    echo_arrival : ndarray (probe, wave)
        Their first arrival times in s; infinite where a wave does not arrive before the output ends.
    displacement_r, displacement_z : ndarray (probe, time)
        Displacements in m, positive away from the axis and into the half-space.
    stress_rr, stress_tt, stress_zz, stress_rz : ndarray (probe, time)
        Stresses in Pa, negative in compression.
    NAME_error : ndarray (probe,)
        Estimated absolute error of the field or quantity NAME, in its unit; also ``error[NAME]``.
    NAME_peak, NAME_peak_time, NAME_peak_error : ndarray (probe,)
        Value of largest magnitude over continuous time, with its sign, its time in s, and its estimated absolute error;
        only with ``output.peaks`` in the scene.
    """

    _more = _ASK

    def __init__(self, arrays: dict[str, Any], time: Floats) -> None:
        super().__init__(arrays)
        self._time = time

    def __setstate__(self, state: dict[str, Any]) -> None:
        self._arrays, self._time = state["_arrays"], state["_time"]

    def __getstate__(self) -> dict[str, Any]:
        return {"_arrays": self._arrays, "_time": self._time}

    @property
    def time(self) -> Floats:
        """Times in s since the first contact, (time,)."""
        return self._time

    @property
    def error(self) -> Errors:
        """Estimated absolute errors of all fields and quantities by name, each (probe,) and in the unit of its field."""
        ending = "_error"
        names = [name.removesuffix(ending) for name in self._arrays if name.endswith(ending)]
        return Errors({name: self._arrays[name + ending] for name in names})


class Section(_Group, OfSection):
    """Fields on a plane through the axis (a meridional section), by name and as attributes.

    Every item is a read-only array. An unknown name raises a `KeyError` as an item and an `AttributeError` as an
    attribute.

    Each quantity in ``output.quantities`` of the scene adds an array (frame, z, r) of its own name.

    Attributes
    ----------
    time : ndarray (frame,)
        Time of each frame in s since the first contact.
    z : ndarray (z,)
        Depths in m, in descending order.
    r : ndarray (r,)
        Distances from the axis in m, in ascending order.
    arrival : ndarray (3, z, r)
        Arrival times in s of the first P, S and Rayleigh wave; infinite if there is no Rayleigh wave.
    displacement_r, displacement_z : ndarray (frame, z, r), float32
        Displacements in m, positive away from the axis and into the half-space.
    stress_rr, stress_tt, stress_zz, stress_rz : ndarray (frame, z, r), float32
        Stresses in Pa, negative in compression.
    NAME_error : ndarray (z, r)
        Estimated absolute error of the field or quantity NAME, in its unit.
    NAME_peak, NAME_peak_time, NAME_peak_error : ndarray (z, r)
        Value of largest magnitude over continuous time, with its sign, its time in s, and its estimated absolute error;
        only with ``output.peaks`` in the scene.
    """

    _more = _ASK

    def to_xarray(self) -> xr.Dataset:
        """The section as an xarray data set with the dimensions time, z and r, and with units and descriptions."""
        from hertzlamb._xarray import of_section

        return of_section(self)


class Impact:
    """Results of one impact, returned by `hertzlamb.impact`.

    Scalars and arrays are in SI units; arrays are read-only. Scalars that do not exist for a force record, or for lack
    of a strength or a plasticity in the scene, are NaN (None in `numbers` and `report`).

    >>> import hertzlamb as hl
    >>> run = hl.impact({"target": {"material": "granite"}, "striker": {"material": "steel", "mass_kg": 4e-6,
    ...                  "tip_radius_m": 5e-4, "velocity_m_s": 1.0}})
    >>> run.force.shape == run.time.shape
    True
    """

    peak_force_n: float
    """Largest contact force in N."""
    peak_force_time_s: float
    """Time of the largest contact force in s."""
    contact_time_s: float
    """Duration of the first contact in s; for a force record, from its onset to the end of the force."""
    rebound_velocity_m_s: float
    """Velocity of departure in m/s, positive away from the half-space; NaN for a force record."""
    restitution: float
    """Coefficient of restitution, velocity of departure over velocity of approach; NaN for a force record."""
    loss: float
    """Fraction of the kinetic energy lost, 1 - restitution^2; NaN for a force record."""
    peak_displacement_m: float
    """Largest displacement of the striker in m; NaN for a force record."""
    peak_deflection_m: float
    """Largest deflection of the half-space in the contact law in m."""
    impulse_n_s: float
    """Impulse of the contact force in N s: the change of the striker's momentum, or the integral of the force record."""
    initial_energy_j: float
    """Kinetic energy before the impact in J; NaN for a force record."""
    radiated_energy_j: float
    """Energy that leaves as waves in J."""
    energy_residual: float
    """(initial - rebound - radiated energy)/initial energy; NaN for a force record."""
    contact_radius_m: float
    """Contact radius by Hertz's law at the largest force in m; NaN for a force record."""
    disc_radius_m: float
    """Radius r0 in m of the disc that loads the half-space, the unit of length of kernel tables."""
    mean_pressure_pa: float
    """Largest contact force over the area of the loaded disc in Pa; NaN for a force record."""
    yield_onset: float
    """`mean_pressure_pa` over the pressure at the onset of yield (von Mises under Hertz's pressure) in the body that yields first; NaN if no yield strength is known."""
    pressure_over_yield: float
    """`mean_pressure_pa` over the lower of the two yield strengths; NaN if none is known."""
    pressure_over_tensile: float
    """`mean_pressure_pa` over the lower of the two tensile strengths; NaN if none is known."""
    cone_crack_onset: float
    """Largest force over the force at which Auerbach's law expects a cone crack; NaN if no fracture toughness is known."""
    yield_pressure_pa: float
    """Largest mean pressure of the yielding contact in Pa; for ``jackson_green``, the pressure at the onset of yield below the surface. NaN without a plasticity."""
    yield_velocity_m_s: float
    """Velocity of approach in m/s above which the plastic law differs from the elastic one; NaN without a plasticity."""
    velocity_over_yield: float
    """Velocity of approach over `yield_velocity_m_s`; NaN without a plasticity."""
    velocity_over_trusted: float
    """Velocity of approach over the largest velocity for which the plastic law is trusted; NaN for laws without such a limit and without a plasticity."""
    plastic_work_j: float
    """Plastic work in J; NaN without a plasticity."""
    peak_indentation_m: float
    """Largest indentation in m; NaN without a plasticity."""
    residual_indentation_m: float
    """Permanent indentation in m; NaN without a plasticity."""
    dent_radius_m: float
    """Effective radius in m during unloading: the radius of a sphere whose contact with a plane equals that of the striker with its dent; NaN without a plasticity."""
    contacts: int
    """Number of contacts; 0 for a force record."""
    march_steps: int
    """Number of time steps over the contact; 0 for a closed form, for non-uniform steps and for a force record."""
    march_step_s: float
    """Time step in s; 0 for a closed form and for non-uniform steps, NaN for a force record."""
    relative_error_estimate: float
    """Estimated relative error of peak force, contact time, restitution and displacement."""

    def __init__(self, core: _Results) -> None:
        self._core = core

    if not TYPE_CHECKING:  # for type checkers, the annotations above are the attributes

        def __getattr__(self, name: str) -> float:
            # scalars, looked up once and kept
            if name in QUANTITIES:
                missing = {"real": float("nan"), "count": 0}
                for each, value in self._core.numbers().items():
                    self.__dict__[each] = missing[QUANTITIES[each][2]] if value is None else value
                return self.__dict__[name]
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *QUANTITIES]

    @property
    def numbers(self) -> dict[str, Any]:
        """All scalar results by name; None for a result that does not exist."""
        return self._core.numbers()

    @property
    def report(self) -> dict[str, Any]:
        """Report of the impact: model, scheme and kernel, the reason for each, and all scalar results.

        The keys are those of ``hertzlamb impact --json``.
        """
        return self._core.report()

    @property
    def model(self) -> str:
        """Name of the contact model that was used."""
        return str(self.report["model"])

    @property
    def warnings(self) -> list[str]:
        """Messages of all warnings about this impact."""
        return self._core.warnings()

    @property
    def scene(self) -> dict[str, Any]:
        """The scene with every default and material property written out."""
        return self._core.scene()

    @cached_property
    def _series(self) -> dict[str, Floats]:
        return self._core.series()

    @property
    def time(self) -> Floats:
        """Times in s since the first contact, (time,)."""
        return self._series["time"]

    @property
    def force(self) -> Floats:
        """Contact force in N, positive in compression, (time,)."""
        return self._series["force"]

    @property
    def displacement(self) -> Floats:
        """Displacement of the striker in m, positive into the half-space, (time,).

        Raises `SceneError` for a force record, which has no striker.
        """
        return self._of_striker("displacement")

    @property
    def velocity(self) -> Floats:
        """Velocity of the striker in m/s, positive into the half-space, (time,).

        Raises `SceneError` for a force record, which has no striker.
        """
        return self._of_striker("velocity")

    def _of_striker(self, name: str) -> Floats:
        if name not in self._series:
            raise SceneError(f"there is no {name}: the scene has a force record and no striker", key="striker")
        return self._series[name]

    @property
    def deflection(self) -> Floats:
        """Deflection of the half-space in the contact law in m, positive into the half-space, (time,)."""
        return self._series["deflection"]

    @cached_property
    def energy(self) -> Energy:
        """Energies over time in J by name and as attributes, each (time,); empty if they are not known.

        ``kinetic`` is the energy of the striker (for a force record: ``work``, the work of the force on the half-space),
        ``stored`` the elastic energy that the contact returns, ``radiated`` the work on the delayed part of the
        deflection, which after the contact is the energy radiated as waves, and ``plastic`` the work of the plastic flow
        if the scene has a plasticity.
        """
        return Energy(self._core.energy() or {})

    @cached_property
    def _probes(self) -> Probes | None:
        found = self._core.probes()
        return None if found is None else Probes(found, self.time)

    @cached_property
    def _section(self) -> Section | None:
        found = self._core.section()
        return None if found is None else Section(found)

    @property
    def probes(self) -> Probes:
        """Fields over time at the probes of the scene. Raises `SceneError` if the scene has no probes."""
        if self._probes is None:
            raise SceneError('the scene has no probes: add some, "probe": [{"r_m": 0.02, "z_m": 0.0}]', key="probe")
        return self._probes

    @cached_property
    def sensors(self) -> tuple[Sensor, ...]:
        """Histories of the sensors of the scene; empty without sensors."""
        return tuple(Sensor(parts, self.time) for parts in self._core.sensors())

    @property
    def section(self) -> Section:
        """Fields on the section that ``map`` of the scene defines. Raises `SceneError` if the scene has no ``map``."""
        if self._section is None:
            example = '"map": {"r_max_m": 0.02, "z_max_m": 0.02, "points": [41, 41], "frames": 20}'
            raise SceneError(f"the scene has no section: add one, {example}", key="map")
        return self._section

    def to_xarray(self) -> xr.Dataset:
        """Time series and fields at the probes as an xarray data set.

        Dimensions are time, probe and wave; variables have units and descriptions, and the scalar results and warnings
        are attributes. `Section.to_xarray` converts a section.
        """
        from hertzlamb._xarray import of_impact

        return of_impact(self)

    def to_stream(self) -> Any:
        """Outputs of the sensors as an ObsPy Stream, one Trace each; needs ObsPy.

        ``trace.stats.hertzlamb`` has the place, the quantity, the unit, and the arrivals in s. Write it as MiniSEED, which
        keeps steps down to 1 ns: ``run.to_stream().write("impact.mseed", "MSEED", reclen=2**20)``. With shorter records ObsPy
        reads steps below 1 us in parts, because it rounds the time of each record to 1 us. It rounds steps of SAC to 1 us.

        Raises `SceneError` if the scene has no sensors.
        """
        from hertzlamb._stream import stream

        if not self.sensors:
            raise SceneError('the scene has no sensors: add some, "sensor": [{"r_m": 0.02, "z_m": 0.0}]', key="sensor")
        return stream(self.sensors)

    def save(self, path: str | os.PathLike[str], *, overwrite: bool = False) -> None:
        """Writes all results to an HDF5 file.

        Datasets and attributes are bit-identical to those of ``hertzlamb impact -o``. The files may differ elsewhere if
        the command uses another version of the HDF5 library than this package.

        Parameters
        ----------
        path : path
            File to write, with the extension ``.h5``, ``.hdf5``, ``.hdf`` or ``.vtkhdf``.
        overwrite : bool
            Whether to replace an existing file.

        Raises
        ------
        OutputExists
            The file exists and ``overwrite`` is False.
        OutputError
            The file cannot be written.
        """
        self._core.save(path, overwrite, csv=False)

    def save_csv(self, path: str | os.PathLike[str], *, overwrite: bool = False) -> None:
        """Writes the time series and the fields at the probes to a text file.

        The file is byte-identical to that of ``hertzlamb impact --csv``. Parameters and errors are those of `save`; the
        file extension is ``.csv`` or ``.txt``.
        """
        self._core.save(path, overwrite, csv=True)

    def plot(self, *, axes: Axes | None = None) -> Axes:
        """Draws the contact force over time with matplotlib.

        Parameters
        ----------
        axes : matplotlib Axes, optional
            Axes to draw into. Default: new axes.
        """
        from hertzlamb._plot import force

        return force(self, axes)

    def plot_probes(self, quantity: str = "displacement_z") -> Figure:
        """Draws a field or quantity over time at every probe with matplotlib.

        Each probe has its own panel, with the error as a band and the wave arrivals as vertical lines.

        Parameters
        ----------
        quantity : str
            Name of an array (probe, time) of `probes`.

        Raises
        ------
        SceneError
            The scene has no probes.
        KeyError
            The probes have no such quantity.
        """
        from hertzlamb._plot import probes

        return probes(self, quantity)

    def plot_section(self, frame: int, quantity: str = "stress_zz", *, axes: Axes | None = None) -> Axes:
        """Draws one frame of a field on the section with matplotlib, with the P and S wave fronts.

        Parameters
        ----------
        frame : int
            Index of the frame; ``section.time[frame]`` is its time.
        quantity : str
            Name of an array (frame, z, r) of `section`.
        axes : matplotlib Axes, optional
            Axes to draw into. Default: new axes.

        Raises
        ------
        SceneError
            The scene has no ``map``.
        KeyError
            The section has no such quantity.
        IndexError
            The section has no such frame.
        """
        from hertzlamb._plot import section

        return section(self, frame, quantity, axes)

    def __repr__(self) -> str:
        lines = [f"impact, model {self.model} ({self.report['reason']})"]
        for name in ("peak_force_n", "contact_time_s", "restitution", "radiated_energy_j", "relative_error_estimate"):
            value = self.numbers[name]
            if value is not None:
                lines.append(f"  {name:24} {value:.7g}")
        lines.append(f"  {'time':24} {len(self.time)} samples to {self.time[-1]:.4g} s")
        if self._probes is not None:
            lines.append(f"  {'probes':24} {len(self._probes.r)}, kernels {self.report['kernel']}")
        lines.extend(f"  {sensor!r}" for sensor in self.sensors)
        if self._section is not None:
            lines.append(f"  {'section':24} {' x '.join(map(str, self._section.displacement_z.shape))} (frame, z, r)")
        lines.extend(f"  warning: {warning}" for warning in self.warnings)
        return "\n".join(lines)

    def __reduce__(self) -> tuple[Any, ...]:
        names = ("numbers", "report", "warnings", "scene", "series", "energy", "probes", "sensors", "section")
        parts = {name: getattr(self._core, name)() for name in names}
        if isinstance(self._core, _Kept):
            return _restored, (parts, self._core.files)
        files = {}
        with tempfile.TemporaryDirectory() as folder:
            self._core.save(Path(folder, "impact.h5"), False, csv=False)
            self._core.save(Path(folder, "impact.csv"), False, csv=True)
            files = {path.name: path.read_bytes() for path in Path(folder).iterdir() if path.is_file()}
        return _restored, (parts, files)


def _restored(parts: dict[str, Any], files: dict[str, bytes]) -> Impact:
    return Impact(_Kept(parts, files))


def impact(
    scene: Scene,
    table: Table | str | os.PathLike[str] | None = None,
    *,
    kernel: Literal["auto", "direct", "table"] = "auto",
    max_memory_gb: float | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Impact:
    """Computes one impact: contact force, rebound, and fields at the probes and on the section of the scene.

    Parameters
    ----------
    scene : dict, path or str
        Keys of a scene file as nested dictionaries, the path of a scene file, or TOML text. Relative file names in a
        dictionary or text, such as a force record, refer to the working directory. You can pass a measured force as
        lists or arrays: ``"force": {"time_s": times, "force_n": forces}``.
    table : Table or path, optional
        Kernel table for the fields. Default: no table, all kernels are computed.
    kernel : {"auto", "direct", "table"}
        Source of the kernels. ``"auto"`` compares the estimated cost and error of the table and of direct computation;
        ``"direct"`` computes all kernels; ``"table"`` uses the table only.
    max_memory_gb : float, optional
        Largest memory for the computation in GB (10^9 bytes). Default: the free memory of the machine.
    threads : int, optional
        Number of threads in [1, 1024]. Default: one for each available processor.
    progress : bool or callable, optional
        True shows a progress bar. A function is called with the number of finished points and the total.

    Returns
    -------
    Impact
        Results, bit-identical to those of ``hertzlamb impact``.

    Raises
    ------
    SceneError
        The scene is invalid; the exception contains the key, the value and the nearest name that exists. Also if
        ``kernel="table"`` and there is no table.
    OutsideTable
        A point is outside the table and ``kernel="table"``.
    BadTable
        The table cannot be read.
    ImpactError
        The contact has no results.
    TooMuchMemory
        The scene needs more memory than allowed.
    DomainError
        ``kernel`` or ``threads`` is invalid.

    Warns
    -----
    HertzlambWarning
        The physics is beyond its validity, or an error exceeds the tolerance. `Impact.warnings` has all messages.
    """
    opened = Table.open(table) if isinstance(table, (str, os.PathLike)) else table
    memory = None if max_memory_gb is None else 1e9 * max_memory_gb
    with told(progress) as tell:
        core = _core.impact(scene, None if opened is None else opened._core, kernel, memory, threads, tell)
    for warning in core.warnings():
        warnings.warn(HertzlambWarning(warning), stacklevel=2)
    return Impact(core)


class Inferred(NamedTuple):
    """Yield pressure or velocity inferred from a rebound, with other results of that contact, in SI units.

    An elastic impact determines no yield pressure: every pressure above its own contact pressure gives the same rebound.
    """

    unknown: str
    """Name of the inferred quantity, ``"yield_pressure_pa"`` or ``"velocity_m_s"``."""
    value: float
    """Inferred value in Pa or m/s."""
    low: float | None
    """Lower bound from the error of the measurement; None if no yielding contact gives such a value."""
    high: float | None
    """Upper bound from the error of the measurement; None if there is no bound, as for an elastic impact."""
    elastic: bool
    """Whether the measurement agrees with an elastic contact, within its error or the tolerance of the results."""
    velocity_over_yield: float
    """Velocity of approach over the velocity at the onset of yield."""
    yield_velocity_m_s: float
    """Velocity of approach at the onset of yield in m/s."""
    velocity_over_trusted: float | None
    """Velocity of approach over the largest velocity for which the law is trusted; None for laws without such a limit."""
    restitution: float
    """Coefficient of restitution, velocity of departure over velocity of approach."""
    contact_time_s: float
    """Duration of the contact in s."""
    peak_force_n: float
    """Largest contact force in N."""


def infer(
    scene: Scene,
    *,
    restitution: float | None = None,
    bounces: tuple[float, float] | None = None,
    contact_time_s: float | None = None,
    peak_force_n: float | None = None,
    error: float = 0.0,
    unknown: Literal["yield_pressure_pa", "velocity_m_s"] = "yield_pressure_pa",
) -> Inferred:
    """Infers the yield pressure or the velocity of a yielding contact from one measurement of its rebound.

    Pass exactly one of ``restitution``, ``bounces``, ``contact_time_s`` and ``peak_force_n``.

    Parameters
    ----------
    scene : dict, path or str
        Scene with a striker and ``contact.plasticity``; its value of the unknown quantity is ignored.
    restitution, contact_time_s, peak_force_n : float, optional
        Measured value: a ratio, s or N.
    bounces : two floats, optional
        Times in s between three successive bounces. Their ratio, second over first, is the restitution of the bounce in
        the middle; the first time determines its velocity.
    error : float
        Absolute error of the measurement in its unit; for ``bounces``, of each time.
    unknown : {"yield_pressure_pa", "velocity_m_s"}
        Quantity to infer.

    Returns
    -------
    Inferred
        Value and bounds, bit-identical to those of ``hertzlamb infer``. The bounds reflect the error of the measurement
        only, not the error of the law.

    Raises
    ------
    SceneError
        The number of measurements is not one, or the scene is invalid or has no striker.
    ImpactError
        The scene has no plasticity, or no yielding contact gives the measured value.
    DomainError
        ``unknown`` is not one of the two names.

    Examples
    --------
    >>> import hertzlamb as hl
    >>> drop = {"target": {"material": "aluminium-6061-t6"}, "striker": {"shape": "ball", "material": "bearing-steel",
    ...         "diameter_m": 0.005, "velocity_m_s": 1.57}, "contact": {"plasticity": "thornton"}}
    >>> found = hl.infer(drop, restitution=0.56)
    >>> found.unknown, round(found.value / 1e9, 3)
    ('yield_pressure_pa', 0.749)
    """
    pair = None
    if bounces is not None:
        try:
            first, second = bounces
        except (TypeError, ValueError):
            raise SceneError("bounces are two times in s between three bounces, such as (0.32, 0.18)", key="infer") from None
        pair = [first, second]
    one = {"restitution": restitution, "contact_time_s": contact_time_s, "peak_force_n": peak_force_n}
    given = {name: [value] for name, value in one.items() if value is not None} | ({"bounces": pair} if pair else {})
    if len(given) != 1:
        raise SceneError(f"{len(given)} measurements are given; pass one of {', '.join([*one, 'bounces'])}", key="infer")
    ((name, values),) = given.items()
    return Inferred(**_core.infer(scene, name, values, error, unknown))


def resolve(scene: Scene) -> dict[str, Any]:
    """Returns a scene with every default and material property written out, without computing it.

    Parameters
    ----------
    scene : dict, path or str
        Keys of a scene file as nested dictionaries, the path of a scene file, or TOML text.

    Returns
    -------
    dict
        The complete scene; pass it to `impact` for the same results.

    Raises
    ------
    SceneError
        The scene is invalid.
    """
    return _core.resolved(scene)
