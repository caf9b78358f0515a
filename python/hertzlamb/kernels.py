"""Exact response of an elastic half-space to a force on a disc of its surface, in reduced units.

A force P is applied suddenly to a disc of radius r0. Lengths are in r0, times in r0/c1 (c1 the longitudinal wave speed),
displacements in P/(mu r0), stresses in P/r0^2; Poisson's ratio is the only parameter left. z points into the
half-space, compression is negative stress.

>>> import hertzlamb as hl
>>> k = hl.kernels.step(nu=0.3, r=0.5, z=0.6, t=2.0)
>>> round(float(k.displacement_z), 9)
0.119599428
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from hertzlamb import _core
from hertzlamb._arrays import numbers
from hertzlamb._fields import Fields
from hertzlamb._progress import Progress, told

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Floats = NDArray[np.float64]

Profile = Literal["hertz", "punch", "point"]
"""How the force is spread: as under a sphere, under a flat punch, or at a point."""

Deflection = Literal["centre", "mean"]
"""Which deflection of the disc: its centre's, or the mean weighted with the pressure."""

__all__ = [
    "Arrivals",
    "Kernel",
    "Medium",
    "impulse",
    "medium",
    "remainder",
    "static",
    "step",
    "step_integral",
    "surface_centre",
    "surface_impulse",
    "surface_step",
    "surface_step_integral",
]


def __dir__() -> list[str]:
    return __all__


class Kernel(Fields):
    """Six fields by name, with an estimate of the error of each in ``error``."""

    __slots__ = ("error",)

    error: Fields
    """Likely bounds on the absolute error of each value, by field."""

    def __init__(self, array: Floats, error: Floats) -> None:
        super().__init__(array)
        self.error = Fields(error)

    def __getstate__(self) -> dict[str, Floats]:
        return {"array": self.array, "error": self.error.array}

    def __setstate__(self, state: dict[str, Floats]) -> None:
        self.__init__(**state)  # type: ignore[misc]


def _of(
    order: str,
    nu: float,
    places: dict[str, ArrayLike],
    profile: str,
    tolerance: float,
    threads: int | None,
    progress: Progress,
) -> Kernel:
    shape, (r, z, t) = numbers(**places)
    with told(progress) as tell:
        value, error = _core.kernel(order, nu, r, z, t, profile, tolerance, threads, tell)
    return Kernel(value.reshape((*shape, 6)), error.reshape((*shape, 6)))


def step(
    nu: float,
    r: ArrayLike,
    z: ArrayLike,
    t: ArrayLike,
    *,
    profile: Profile = "hertz",
    tolerance: float = 1e-10,
    threads: int | None = None,
    progress: Progress = None,
) -> Kernel:
    """Fields after a force was applied suddenly and stays.

    Parameters
    ----------
    nu : float
        Poisson's ratio in (-1, 0.5).
    r, z, t : array_like
        Distance from the axis and depth in r0 and time in r0/c1, each in [0, 1e20]; broadcast.
    profile : {"hertz", "punch", "point"}
        How the force is spread over the disc; under a point force the unit of length is arbitrary.
    tolerance : float
        Accuracy in [1e-14, 0.1], of each field's peak over time.
    threads : int, optional
        Threads, all processors otherwise.
    progress : bool or callable, optional
        True for a bar; a function is called with what is done and how much there is.

    Returns
    -------
    Kernel
        Displacements in P/(mu r0) and stresses in P/r0^2 of the broadcast shape, with ``error``.
    """
    return _of("step", nu, {"r": r, "z": z, "t": t}, profile, tolerance, threads, progress)


def remainder(
    nu: float,
    r: ArrayLike,
    z: ArrayLike,
    t: ArrayLike,
    *,
    profile: Profile = "hertz",
    tolerance: float = 1e-10,
    threads: int | None = None,
    progress: Progress = None,
) -> Kernel:
    """`step` less the `static` field, which dies away: what a table holds. Parameters as for `step`."""
    return _of("remainder", nu, {"r": r, "z": z, "t": t}, profile, tolerance, threads, progress)


def impulse(
    nu: float,
    r: ArrayLike,
    z: ArrayLike,
    t: ArrayLike,
    *,
    tolerance: float = 1e-10,
    threads: int | None = None,
    progress: Progress = None,
) -> Kernel:
    """Fields after a unit impulse of the Hertz profile, the derivative of `step` in time.

    Displacements are in c1/(mu r0^2), stresses in c1/r0^3; parameters as for `step`.
    At fronts stresses have roots in the denominator.
    """
    return _of("impulse", nu, {"r": r, "z": z, "t": t}, "hertz", tolerance, threads, progress)


def step_integral(
    nu: float,
    r: ArrayLike,
    z: ArrayLike,
    t: ArrayLike,
    *,
    profile: Profile = "hertz",
    tolerance: float = 1e-10,
    threads: int | None = None,
    progress: Progress = None,
) -> Kernel:
    """Integral of `remainder` over time: differences of it are averages over cells. Parameters as for `step`.

    The constant of integration is the same for all t at one (r, z).
    """
    return _of("step_integral", nu, {"r": r, "z": z, "t": t}, profile, tolerance, threads, progress)


def static(nu: float, r: ArrayLike, z: ArrayLike, *, profile: Profile = "hertz") -> Fields:
    """The static fields under a unit force, in closed form.

    Parameters
    ----------
    nu : float
        Poisson's ratio in (-1, 0.5).
    r, z : array_like
        Distance from the axis and depth in r0; broadcast.
    profile : {"hertz", "punch", "point"}
        How the force is spread over the disc.

    Returns
    -------
    Fields
        Displacements in P/(mu r0) and stresses in P/r0^2 of the broadcast shape.
    """
    shape, (flat_r, flat_z) = numbers(r=r, z=z)
    return Fields(_core.static_field(nu, flat_r, flat_z, profile).reshape((*shape, 6)))


def _surface(order: str, nu: float, t: ArrayLike, deflection: str) -> Floats:
    shape, (flat,) = numbers(t=t)
    return _core.surface(order, nu, flat, deflection).reshape(shape)


def surface_step(nu: float, t: ArrayLike, *, deflection: Deflection = "centre") -> Floats:
    """Deflection of a disc under its own suddenly applied load, over its static value.

    Parameters
    ----------
    nu : float
        Poisson's ratio in (-1, 0.5).
    t : array_like
        Times in r0/c1; 0 before the load.
    deflection : {"centre", "mean"}
        That of the centre, or the mean weighted with the pressure.

    Returns
    -------
    ndarray
        W(t) of the shape of t: 0 for t <= 0, exactly 1 after the memory of the half-space
        (``medium(nu).centre_memory``). Times ``medium(nu).centre_compliance`` it is the deflection in P/(mu r0).
    """
    return _surface("step", nu, t, deflection)


def surface_impulse(nu: float, t: ArrayLike, *, deflection: Deflection = "centre") -> Floats:
    """Derivative of `surface_step` in time, in c1/r0."""
    return _surface("impulse", nu, t, deflection)


def surface_step_integral(nu: float, t: ArrayLike, *, deflection: Deflection = "centre") -> Floats:
    """Integral of `surface_step` from 0 to t, in r0/c1."""
    return _surface("step_integral", nu, t, deflection)


def surface_centre(nu: float, t: ArrayLike) -> Floats:
    """`surface_step` of the centre by the closed form of Kausel (2012), over time in r0/c2: an independent route."""
    shape, (flat,) = numbers(t=t)
    return _core.surface_centre(nu, flat).reshape(shape)


@dataclass(frozen=True)
class Arrivals:
    """Arrival times of the wave fronts at one place, in r0/c1: from the nearest and the farthest edge of the disc."""

    above: tuple[float, float] | None
    """Plane longitudinal and shear front from the disc straight above; None beside it."""
    p: tuple[float, float]
    """Longitudinal wave."""
    s: tuple[float, float]
    """Shear wave."""
    head: tuple[float | None, float | None]
    """Head wave, longitudinal along the surface; None inside the critical angle."""
    rayleigh: tuple[float, float]
    """Rayleigh wave along the surface."""
    first: float
    """The first of all."""
    last: float
    """The last of all; after it every field is smooth."""


@dataclass(frozen=True)
class Medium:
    """What follows from Poisson's ratio, speeds in c1, times in r0/c1."""

    nu: float
    """Poisson's ratio."""
    shear_speed: float
    """c2/c1."""
    rayleigh_speed: float
    """c_R/c1."""
    lambda_over_mu: float
    """Ratio of the Lame constants."""
    centre_compliance: float
    """Static deflection of the centre of a Hertz disc in P/(mu r0)."""
    centre_memory: float
    """Time after which it is exactly static again."""
    centre_relaxation_time: float
    """Integral of 1 - `surface_step`."""
    mean_compliance: float
    """The same of the mean deflection, weighted with the pressure."""
    mean_memory: float
    """Time after which it is exactly static again."""
    mean_relaxation_time: float
    """Integral of 1 - `surface_step` of the mean."""

    def arrivals(self, r: float, z: float, *, profile: Profile = "hertz") -> Arrivals:
        """Arrival times at a distance r from the axis and a depth z, in r0."""
        found = _core.arrivals(self.nu, r, z, profile)
        parts: dict[str, Any] = {name: tuple(v) if isinstance(v, list) else v for name, v in found.items()}
        return Arrivals(**parts)


def medium(nu: float) -> Medium:
    """What follows from Poisson's ratio nu in (-1, 0.5): wave speeds, compliances, memories, arrivals."""
    return Medium(**_core.medium(nu))
