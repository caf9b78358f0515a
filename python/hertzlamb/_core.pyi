"""Types of the compiled part of hertzlamb; the public functions, with defaults and documentation, are in `hertzlamb`."""

from collections.abc import Callable, Sequence
from os import PathLike
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

_Floats = NDArray[np.float64]
_Tell = Callable[[int, int], object] | None
_Path = str | PathLike[str]

__all__ = [
    "Force",
    "Noise",
    "Outcome",
    "Plan",
    "Response",
    "Table",
    "VERSION",
    "arrivals",
    "check_at_once",
    "describe",
    "extend",
    "force",
    "impact",
    "infer",
    "kernel",
    "materials",
    "medium",
    "noise",
    "plan",
    "plan_of_columns",
    "resolved",
    "sections_of",
    "spectrum",
    "static_field",
    "surface",
    "surface_centre",
    "tabulate",
]

VERSION: str

@final
class Outcome:
    def numbers(self) -> dict[str, Any]: ...
    def report(self) -> dict[str, Any]: ...
    def warnings(self) -> list[str]: ...
    def scene(self) -> dict[str, Any]: ...
    def series(self) -> dict[str, _Floats]: ...
    def energy(self) -> dict[str, _Floats] | None: ...
    def probes(self) -> dict[str, Any] | None: ...
    def sensors(self) -> list[dict[str, Any]]: ...
    def section(self) -> dict[str, Any] | None: ...
    def save(self, path: _Path, overwrite: bool, csv: bool) -> None: ...

def force(
    given: Any,
    time_s: _Floats,
    blows: list[list[_Floats]],
    noise: list[float],
    unknown_gains: list[int],
    impulse_n_s: list[float] | None,
    lambda_: float | None,
    window_s: list[float] | None,
    known: str | None,
    restitution: float | None,
) -> Force: ...
def noise(given: Any, threads: int | None, progress: Any) -> Noise: ...
@final
class Noise:
    def arrays(self) -> dict[str, Any]: ...
    def numbers(self) -> tuple[float, float, int, int]: ...
    def save(self, path: _Path, overwrite: bool) -> None: ...

@final
class Force:
    def report(self) -> dict[str, Any]: ...
    def arrays(self) -> dict[str, Any]: ...
    def scene(self) -> dict[str, Any]: ...
    def save(self, path: _Path, overwrite: bool) -> None: ...

@final
class Response:
    @staticmethod
    def poles_zeros(poles: list[complex], zeros: list[complex], gain: float) -> Response: ...
    @staticmethod
    def table(frequencies_hz: _Floats, amplitudes: _Floats, phases_rad: _Floats | None) -> Response: ...
    @staticmethod
    def filter(coefficients: _Floats, rate_hz: float) -> Response: ...
    @staticmethod
    def read(path: _Path) -> Response: ...
    @property
    def kind(self) -> str: ...
    @property
    def is_minimum_phase(self) -> bool: ...
    @property
    def limits_hz(self) -> list[float]: ...
    def at(self, frequencies_hz: _Floats) -> Any: ...
    def apply(self, step_s: float, samples: _Floats) -> tuple[_Floats, _Floats, float]: ...
    def remove(self, step_s: float, samples: _Floats, band_hz: list[float]) -> _Floats: ...

@final
class Table:
    @staticmethod
    def open(path: _Path) -> Table: ...
    @property
    def path(self) -> Any: ...
    def info(self) -> dict[str, Any]: ...
    @property
    def id(self) -> str: ...
    def trace(
        self,
        nu: float,
        r: _Floats,
        z: _Floats,
        coarsening: int,
        cells: int | None,
        smooth: bool,
        threads: int | None = None,
        progress: _Tell = None,
    ) -> tuple[_Floats, _Floats, _Floats, float]: ...

@final
class Plan:
    @property
    def rows(self) -> int: ...
    def axes(self) -> list[tuple[str, int, dict[str, Any]]]: ...
    def resolved(self) -> dict[str, Any]: ...
    def results(self) -> list[str]: ...
    def compute(
        self, start: int, step: int, count: int, threads: int | None = None, progress: _Tell = None
    ) -> tuple[_Floats, NDArray[np.uint8], list[tuple[int, str]]]: ...
    def save(
        self,
        path: _Path,
        numbers: _Floats,
        models: NDArray[np.uint8],
        failures: list[tuple[int, str]],
        overwrite: bool,
    ) -> None: ...

def impact(
    given: Any,
    table: Table | None,
    kernel: str,
    max_memory_bytes: float | None = None,
    threads: int | None = None,
    progress: _Tell = None,
) -> Outcome: ...
def infer(given: Any, measured: str, values: list[float], error: float, unknown: str) -> dict[str, Any]: ...
def resolved(given: Any) -> dict[str, Any]: ...
def sections_of(key: str, others: list[str]) -> list[str]: ...
def check_at_once(rows: int) -> None: ...
def plan(given: Any, columns: Sequence[str] | None = None) -> Plan: ...
def plan_of_columns(given: Any, keys: list[tuple[str, str, Any]], columns: Sequence[str] | None = None) -> Plan: ...
def kernel(
    order: str,
    nu: float,
    r: _Floats,
    z: _Floats,
    t: _Floats,
    profile: str,
    tolerance: float,
    threads: int | None = None,
    progress: _Tell = None,
) -> tuple[_Floats, _Floats]: ...
def spectrum(
    nu: float,
    r: _Floats,
    z: _Floats,
    f: _Floats,
    profile: str,
    attenuation: tuple[float, float | None] | None = None,
    threads: int | None = None,
    progress: _Tell = None,
) -> tuple[_Floats, _Floats, _Floats]: ...
def static_field(nu: float, r: _Floats, z: _Floats, profile: str) -> _Floats: ...
def surface(order: str, nu: float, t: _Floats, deflection: str) -> _Floats: ...
def surface_centre(nu: float, t: _Floats) -> _Floats: ...
def medium(nu: float) -> dict[str, float]: ...
def arrivals(nu: float, r: float, z: float, profile: str) -> dict[str, Any]: ...
def materials(search: str, file: _Path | None = None) -> list[dict[str, Any]]: ...
def describe() -> dict[str, Any]: ...
def tabulate(
    path: _Path,
    grid: Any,
    nu: list[float] | None = None,
    r_max: float | None = None,
    z_max: float | None = None,
    time_factor: float | None = None,
    accuracy: tuple[float, float] | None = None,
    overwrite: bool = False,
    threads: int | None = None,
    progress: _Tell = None,
) -> None: ...
def extend(
    path: _Path,
    nu: list[float] | None = None,
    r_max: float | None = None,
    z_max: float | None = None,
    time_factor: float | None = None,
    threads: int | None = None,
    progress: _Tell = None,
) -> None: ...
