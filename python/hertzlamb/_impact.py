"""One impact."""

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
from hertzlamb._table import Table

if TYPE_CHECKING:
    import numpy as np
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

Scene = Mapping[str, Any] | str | os.PathLike[str]
"""A scene: a dictionary with the keys of a scene file, the path of a file, or TOML text."""

DESCRIBED: dict[str, Any] = _core.describe()
"""Units and meanings of all names, by the part of the results that they are in."""

QUANTITIES: dict[str, list[str]] = DESCRIBED["quantities"]
"""Unit, meaning and kind of every scalar result."""


class _Results(Protocol):
    """What an impact is made of: `_core.Outcome`, or what a pickle has kept of one."""

    def numbers(self) -> dict[str, Any]: ...
    def report(self) -> dict[str, Any]: ...
    def warnings(self) -> list[str]: ...
    def scene(self) -> dict[str, Any]: ...
    def series(self) -> dict[str, Floats]: ...
    def energy(self) -> dict[str, Floats] | None: ...
    def probes(self) -> dict[str, Any] | None: ...
    def section(self) -> dict[str, Any] | None: ...
    def save(self, path: os.PathLike[str] | str, overwrite: bool, csv: bool) -> None: ...


class _Kept:
    """What a pickle has kept: plain arrays, and the files as bytes."""

    def __init__(self, parts: dict[str, Any], files: dict[str, bytes]) -> None:
        self.parts, self.files = parts, files
        for part in ("series", "energy", "probes", "section"):
            for array in (parts[part] or {}).values():
                array.setflags(write=False)

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

    def section(self) -> dict[str, Any] | None:
        return None if self.parts["section"] is None else dict(self.parts["section"])

    def save(self, path: os.PathLike[str] | str, overwrite: bool, csv: bool) -> None:
        try:
            with open(path, "wb" if overwrite else "xb") as file:
                file.write(self.files["impact.csv" if csv else "impact.h5"])
        except FileExistsError:
            message = f"{os.fspath(path)} exists already and is not replaced; give overwrite=True to replace it"
            raise OutputExists(message, file=os.fspath(path)) from None


class _Group(Mapping[str, "NDArray[Any]"]):
    """Arrays by name, also as attributes."""

    _more = ""
    """How to get more of them."""

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
            raise AttributeError(f"{type(self).__name__} has no {name!r}; there are {there}{self._more}")

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
    """Where the energy is over time in J: ``kinetic`` or ``work``, ``stored``, ``radiated`` and, where a contact yields, ``plastic``, each (time,)."""


_ASK = '; the scene asks for more, such as "output": {"quantities": ["velocity_z"]}'


class Errors(_Group, OfFields):
    """Estimated absolute errors of fields by name, each in the unit of its field, (probe,)."""


class Probes(_Group, OfProbes):
    """Fields over time at the probes of a scene, by name and as attributes.

    ``r`` and ``z`` in m (probe,); ``arrival`` in s (probe, 3) of the first P, S and Rayleigh wave, infinite where there is
    none; ``valid_until`` in s (probe,), when the first echo from a face of the block arrives;
    ``displacement_r``, ``displacement_z`` in m and ``stress_rr``, ``stress_tt``, ``stress_zz``, ``stress_rz`` in Pa,
    each (probe, time), with an estimate of the absolute error under the same name in ``error`` (probe,).
    What ``output.quantities`` of the scene asks for beside them has its own name (``velocity_z``, ``von_mises`` ...), and
    ``output.peaks`` adds ``NAME_peak`` and ``NAME_peak_time`` (probe,).
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
        """Estimated absolute error of each field, in its unit, (probe,)."""
        ending = "_error"
        names = [name.removesuffix(ending) for name in self._arrays if name.endswith(ending)]
        return Errors({name: self._arrays[name + ending] for name in names})


class Section(_Group, OfSection):
    """Fields on a meridional section, by name and as attributes.

    ``time`` (frame,), ``z`` (z,) descending and ``r`` (r,) in s and m; the six fields (frame, z, r) in single precision,
    their errors (z, r) under ``NAME_error``, and ``arrival`` (3, z, r) of the first P, S and Rayleigh wave.
    What ``output.quantities`` of the scene asks for beside them has its own name, and ``output.peaks`` adds ``NAME_peak``
    and ``NAME_peak_time`` (z, r).
    """

    _more = _ASK

    def to_xarray(self) -> xr.Dataset:
        """The section as a data set with the dimensions time, z and r."""
        from hertzlamb._xarray import of_section

        return of_section(self)


class Impact:
    """The results of one impact.

    Scalars are in SI units; `hertzlamb.impact` makes it. Arrays are read-only.

    >>> import hertzlamb as hl
    >>> run = hl.impact({"target": {"material": "granite"}, "striker": {"material": "steel", "mass_kg": 4e-6,
    ...                  "tip_radius_m": 5e-4, "velocity_m_s": 1.0}})
    >>> run.force.shape == run.time.shape
    True
    """

    peak_force_n: float
    """Largest contact force in N."""
    peak_force_time_s: float
    """When it is reached in s."""
    contact_time_s: float
    """Duration of the first contact, or of the force record, in s."""
    rebound_velocity_m_s: float
    """Velocity of departure in m/s, positive away from the half-space; NaN for a force record."""
    restitution: float
    """Velocity of departure over velocity of approach; NaN for a force record."""
    loss: float
    """Kinetic energy lost over kinetic energy before, 1 - restitution^2; NaN for a force record."""
    peak_displacement_m: float
    """Largest displacement of the striker in m; NaN for a force record."""
    peak_deflection_m: float
    """Largest deflection of the half-space in the contact law in m."""
    impulse_n_s: float
    """Momentum given to the striker in N s."""
    initial_energy_j: float
    """Kinetic energy before in J; NaN for a force record."""
    radiated_energy_j: float
    """Work that the force leaves in the half-space as waves in J."""
    energy_residual: float
    """(initial - rebound - radiated)/initial energy; NaN for a force record."""
    contact_radius_m: float
    """Contact radius of Hertz's law at the largest force in m; NaN for a force record."""
    disc_radius_m: float
    """Radius of the disc that loads the half-space in m: the unit of length of tables."""
    mean_pressure_pa: float
    """Largest contact force over the area of the loaded disc in Pa; NaN for a force record."""
    yield_onset: float
    """`mean_pressure_pa` over the pressure at which the first body begins to yield; NaN where no strength is known."""
    pressure_over_yield: float
    """`mean_pressure_pa` over the lower of both yield strengths; NaN where none is known."""
    pressure_over_tensile: float
    """`mean_pressure_pa` over the lower of both tensile strengths; NaN where none is known."""
    cone_crack_onset: float
    """Largest force over that of a cone crack by Auerbach's law; NaN where no toughness is known."""
    yield_pressure_pa: float
    """Mean pressure that the yielding contact does not exceed; of jackson_green the one at which it yields under the surface in Pa; NaN without a plasticity."""
    yield_velocity_m_s: float
    """Velocity of approach from which the law of flow differs from elasticity in m/s; NaN without a plasticity."""
    velocity_over_yield: float
    """Velocity of approach over the one from which the law of flow differs from elasticity; NaN without a plasticity."""
    velocity_over_trusted: float
    """Velocity of approach over the largest one for which the law of flow is trusted; NaN for laws without such a limit."""
    plastic_work_j: float
    """Work of the plastic flow in J; NaN without a plasticity."""
    peak_indentation_m: float
    """Largest indentation in m; NaN without a plasticity."""
    residual_indentation_m: float
    """Indentation that stays in m; NaN without a plasticity."""
    dent_radius_m: float
    """Radius of the sphere that meets a plane as the striker meets its dent in m; NaN without a plasticity."""
    contacts: int
    """Number of contacts; 0 for a force record."""
    march_steps: int
    """Steps of the march, 0 where no uniform step is taken."""
    march_step_s: float
    """Step of the march in s; NaN for a force record."""
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
        """All scalar results by name; None where one does not exist."""
        return self._core.numbers()

    @property
    def report(self) -> dict[str, Any]:
        """What ``hertzlamb impact --json`` prints: model, scheme, kernel, why, and all scalar results."""
        return self._core.report()

    @property
    def model(self) -> str:
        """The contact model that was used."""
        return str(self.report["model"])

    @property
    def warnings(self) -> list[str]:
        """What the user should know."""
        return self._core.warnings()

    @property
    def scene(self) -> dict[str, Any]:
        """The scene with every default and material spelled out."""
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
        """Displacement of the striker in m, positive into the half-space, (time,)."""
        return self._of_striker("displacement")

    @property
    def velocity(self) -> Floats:
        """Velocity of the striker in m/s, positive into the half-space, (time,)."""
        return self._of_striker("velocity")

    def _of_striker(self, name: str) -> Floats:
        if name not in self._series:
            raise SceneError(f"there is no {name}: the force is a record, without a striker", key="striker")
        return self._series[name]

    @property
    def deflection(self) -> Floats:
        """Deflection of the half-space in the contact law in m, positive inwards, (time,)."""
        return self._series["deflection"]

    @cached_property
    def energy(self) -> Energy:
        """Where the energy is over time; empty where it is not known."""
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
        """Fields at the probes of the scene; a `SceneError` where it has none."""
        if self._probes is None:
            raise SceneError('the scene has no probes: give it some, "probe": [{"r_m": 0.02, "z_m": 0.0}]', key="probe")
        return self._probes

    @property
    def section(self) -> Section:
        """Fields on the section that the scene's ``map`` asks for; a `SceneError` where it asks for none."""
        if self._section is None:
            example = '"map": {"r_max_m": 0.02, "z_max_m": 0.02, "points": [41, 41], "frames": 20}'
            raise SceneError(f"the scene has no section: give it one, {example}", key="map")
        return self._section

    def to_xarray(self) -> xr.Dataset:
        """Time series and fields at probes as a data set, with units, coordinates and the scalars as attributes."""
        from hertzlamb._xarray import of_impact

        return of_impact(self)

    def save(self, path: str | os.PathLike[str], *, overwrite: bool = False) -> None:
        """Writes the results file of ``hertzlamb impact -o``, HDF5: the same datasets and attributes, bit for bit.

        The bytes around them are those of the HDF5 library that is compiled into this package; the command may use another.
        """
        self._core.save(path, overwrite, csv=False)

    def save_csv(self, path: str | os.PathLike[str], *, overwrite: bool = False) -> None:
        """Writes the time series and the traces of the probes as text: byte for byte the file of ``hertzlamb impact --csv``."""
        self._core.save(path, overwrite, csv=True)

    def plot(self, *, axes: Axes | None = None) -> Axes:
        """Draws the force over time (matplotlib)."""
        from hertzlamb._plot import force

        return force(self, axes)

    def plot_probes(self, quantity: str = "displacement_z") -> Figure:
        """Draws a field or a velocity at every probe over time, with the arrivals of the waves (matplotlib)."""
        from hertzlamb._plot import probes

        return probes(self, quantity)

    def plot_section(self, frame: int, quantity: str = "stress_zz", *, axes: Axes | None = None) -> Axes:
        """Draws a field on the section at a frame, with the fronts of P and S waves (matplotlib)."""
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
        if self._section is not None:
            lines.append(f"  {'section':24} {' x '.join(map(str, self._section.displacement_z.shape))} (frame, z, r)")
        lines.extend(f"  warning: {warning}" for warning in self.warnings)
        return "\n".join(lines)

    def __reduce__(self) -> tuple[Any, ...]:
        names = ("numbers", "report", "warnings", "scene", "series", "energy", "probes", "section")
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
    """Computes one impact.

    Parameters
    ----------
    scene : dict, path or str
        The keys of a scene file as nested dictionaries, the path of a file, or TOML text. Files that a dictionary or a text
        names, such as a force record, are looked for in the working directory. A measured force needs no file:
        ``"force": {"time_s": times, "force_n": forces}`` with lists or arrays.
    table : Table or path, optional
        A kernel table for the fields at probes and on a section.
    kernel : {"auto", "direct", "table"}
        Where the kernels of the fields come from: the table or computed, by the estimated cost and error of both;
        computed; the table.
    max_memory_gb : float, optional
        Refuses a scene that needs more; what the machine has free otherwise.
    threads : int, optional
        Threads, all processors otherwise.
    progress : bool or callable, optional
        True for a bar; a function is called with the points that are done and how many there are.

    Returns
    -------
    Impact
        Scalars, time series, and fields at the points that the scene asks for, equal to the command's to the last bit.

    Raises
    ------
    SceneError
        With the key, the value and the nearest name that exists.
    OutsideTable
        A probe is outside the table and ``kernel="table"``.
    ImpactError
        The contact has no results.

    Warns
    -----
    HertzlambWarning
        Physics beyond its validity; also in ``run.warnings``.
    """
    opened = Table.open(table) if isinstance(table, (str, os.PathLike)) else table
    memory = None if max_memory_gb is None else 1e9 * max_memory_gb
    with told(progress) as tell:
        core = _core.impact(scene, None if opened is None else opened._core, kernel, memory, threads, tell)
    for warning in core.warnings():
        warnings.warn(HertzlambWarning(warning), stacklevel=2)
    return Impact(core)


class Inferred(NamedTuple):
    """A yield pressure or a velocity inferred from a rebound, in SI units, with the results of the contact that has it.

    An impact that stays elastic determines no yield pressure: every pressure from its own stress up has the same rebound.
    """

    unknown: str
    """The name of the value, ``"yield_pressure_pa"`` or ``"velocity_m_s"``."""
    value: float
    """The value for which the contact has the measure."""
    low: float | None
    """Lower bound from the error of the measure; None if no yielding contact gives such a value."""
    high: float | None
    """Upper bound from the error of the measure; None if there is none, as for an impact that stays elastic."""
    elastic: bool
    """Whether the measure is that of an elastic contact, within its error or the tolerance of the results."""
    velocity_over_yield: float
    """Velocity of approach over that at which yield begins."""
    yield_velocity_m_s: float
    """Velocity of approach in m/s at which yield begins."""
    velocity_over_trusted: float | None
    """Velocity of approach over the largest one for which the law is trusted; None for laws without such a limit."""
    restitution: float
    """Velocity of departure over velocity of approach."""
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
    """Yield pressure or velocity of a contact that yields, from one measure of its rebound.

    Parameters
    ----------
    scene : dict, path or str
        A scene with a ``plasticity``; what is sought is not taken from it.
    restitution, contact_time_s, peak_force_n : float, optional
        What was measured; one of these or ``bounces``.
    bounces : two floats, optional
        Times in s between three bounces: the second over the first is the restitution of the bounce between, whose
        velocity follows from the first.
    error : float
        Absolute error of the measure; of ``bounces``, of each of the two times.
    unknown : {"yield_pressure_pa", "velocity_m_s"}
        What is sought.

    Returns
    -------
    Inferred
        The value and its bounds, equal to those of ``hertzlamb infer`` to the last bit. They reflect the error of the
        measure, not that of the law.

    Raises
    ------
    SceneError
        Not one measure, or no striker.
    ImpactError
        No contact that yields has such a measure.

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
        raise SceneError(f"{len(given)} measures are given, not one of {', '.join([*one, 'bounces'])}", key="infer")
    ((name, values),) = given.items()
    return Inferred(**_core.infer(scene, name, values, error, unknown))


def resolve(scene: Scene) -> dict[str, Any]:
    """The scene with every default and material spelled out; a `SceneError` where it is none."""
    return _core.resolved(scene)
