"""Exact response of an elastic half-space to a force P on a disc of radius r0 on its surface, in reduced units.

Lengths are in r0, times in r0/c1 (c1 is the speed of the longitudinal wave), displacements in P/(mu r0) (mu is the shear
modulus) and stresses in P/r0^2, so that Poisson's ratio is the only parameter of the material. z points into the
half-space, radial displacement is positive away from the axis, and compression is negative stress.

>>> import hertzlamb as hl
>>> k = hl.kernels.step(nu=0.3, r=0.5, z=0.6, t=2.0)
>>> round(float(k.displacement_z), 9)
0.119599428
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from hertzlamb import _core
from hertzlamb._arrays import numbers
from hertzlamb._errors import SceneError
from hertzlamb._fields import Fields
from hertzlamb._progress import Progress, told

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Floats = NDArray[np.float64]
    Complexes = NDArray[np.complex128]

Profile = Literal["hertz", "punch", "point"]
"""Distribution of the force: the pressure under a sphere, the pressure under a flat punch, or a point force."""

Deflection = Literal["centre", "mean"]
"""Deflection of the disc: at its centre, or the mean weighted with the pressure."""

__all__ = [
    "Arrivals",
    "Kernel",
    "Medium",
    "Spectrum",
    "impulse",
    "medium",
    "remainder",
    "spectrum",
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
    """Six fields by name, each of the broadcast shape, with their estimated errors."""

    __slots__ = ("error",)

    error: Fields
    """Likely bounds on the absolute error of each value, by field, in its unit and shape."""

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
    """Step response: fields at time t after a constant force is applied at time 0.

    Parameters
    ----------
    nu : float
        Poisson's ratio in (-1, 0.5).
    r, z, t : array_like
        Distance from the axis and depth in r0, and time in r0/c1, each in [0, 1e20]; broadcast together.
    profile : {"hertz", "punch", "point"}
        Distribution of the force over the disc. For a point force the unit of length r0 is arbitrary.
    tolerance : float
        Target error in [1e-14, 0.1], relative to the peak of each field over time.
    threads : int, optional
        Number of threads in [1, 1024]. Default: one for each available processor.
    progress : bool or callable, optional
        True shows a progress bar. A function is called with the number of finished points and the total.

    Returns
    -------
    Kernel
        Displacements in P/(mu r0) and stresses in P/r0^2, each of the broadcast shape, with ``error``.

    Raises
    ------
    DomainError
        An argument is outside its range or not a number, or the field is infinite there: at r = 1, z = 0 under a punch
        and at r = z = 0 under a point force.
    ValueError
        The arrays cannot be broadcast together.
    TooMuchMemory
        The points need more memory than is free.
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
    """`step` minus `static`, the part that decays; kernel tables store it.

    Parameters, units, shapes and errors are those of `step`.
    """
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
    """Impulse response of the Hertz profile: fields after a unit impulse, the time derivative of `step`.

    Displacements are in c1/(mu r0^2) and stresses in c1/r0^3, for an impulse of 1. Stresses have inverse square-root
    singularities at wave fronts. Parameters, shapes and errors are those of `step`, without ``profile``.
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
    """Integral of `remainder` over time, in units of `remainder` times r0/c1.

    The constant of integration is arbitrary but the same for all t at one (r, z). Use differences: divided by the time
    between them, they are the means of `remainder`. Parameters, shapes and errors are those of `step`.
    """
    return _of("step_integral", nu, {"r": r, "z": z, "t": t}, profile, tolerance, threads, progress)


class Spectrum(Fields):
    """Six complex fields by name, each of the broadcast shape, with their estimated errors and the velocities."""

    __slots__ = ("error", "frequency")

    error: Fields
    """Likely bounds on the modulus of the error of each value, by field, in its unit and shape."""
    frequency: Floats
    """The frequencies in c1/r0, in the broadcast shape."""

    def __init__(self, array: Complexes, error: Floats, frequency: Floats) -> None:
        super().__init__(array)  # type: ignore[arg-type]
        self.error = Fields(error)
        frequency.setflags(write=False)
        self.frequency = frequency

    @property
    def velocity_r(self) -> Complexes:
        """Radial velocity (...) in P c1/(mu r0^2)."""
        return np.asarray(2j * np.pi * self.frequency * self.displacement_r, dtype=np.complex128)

    @property
    def velocity_z(self) -> Complexes:
        """Axial velocity (...) in P c1/(mu r0^2), positive into the half-space."""
        return np.asarray(2j * np.pi * self.frequency * self.displacement_z, dtype=np.complex128)

    def __getstate__(self) -> dict[str, Any]:
        return {"array": self.array, "error": self.error.array, "frequency": self.frequency}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__init__(**state)  # type: ignore[misc]


def spectrum(
    nu: float,
    r: ArrayLike,
    z: ArrayLike,
    f: ArrayLike,
    *,
    profile: Profile = "hertz",
    quality_factor: float | None = None,
    reference_frequency: float | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Spectrum:
    """Frequency response: complex fields under a force exp(i omega t) of unit amplitude, omega = 2 pi f.

    It is the Fourier transform, with exp(-i omega t), of the response to a unit impulse.

    Parameters
    ----------
    nu : float
        Poisson's ratio in (-1, 0.5).
    r, z : array_like
        Distance from the axis and depth in r0, each in [0, 1e20]; broadcast together with ``f``.
    f : array_like
        Frequency in c1/r0, from 0, above 0 with attenuation, up to 1e4 Rayleigh speeds over the
        distance from the load.
    profile : {"hertz", "punch", "point"}
        Distribution of the force over the disc. For a point force the unit of length r0 is arbitrary.
    quality_factor : float, optional
        Constant quality factor Q of P and S waves in [1, 1e15], by the causal law of Kjartansson (1979): all moduli are
        multiplied by (i f/f0)^(2 atan(1/Q)/pi). Default: no attenuation.
    reference_frequency : float, optional
        f0, the frequency in c1/r0 at which nu, mu and c1 are measured. Default: each f is its own, so that speeds do not
        depend on frequency.
    threads : int, optional
        Number of threads in [1, 1024]. Default: one for each available processor.
    progress : bool or callable, optional
        True shows a progress bar. A function is called with the number of finished frequencies and the total.

    Returns
    -------
    Spectrum
        Displacements in P/(mu r0) and stresses in P/r0^2, complex and of the broadcast shape, with ``error``,
        ``frequency``, ``velocity_r`` and ``velocity_z``.

    Raises
    ------
    DomainError
        An argument is outside its range or not a number, or the field is infinite there.
    ValueError
        The arrays cannot be broadcast together.
    TooMuchMemory
        The points need more memory than is free.

    Examples
    --------
    >>> import hertzlamb as hl
    >>> medium = hl.kernels.medium(0.25)
    >>> G = hl.kernels.spectrum(0.25, 1.0, 0.0, 3 * medium.shear_speed / (2 * np.pi), profile="point", quality_factor=20)
    >>> complex(G.displacement_z.round(9))
    (-0.106359436+0.067466425j)
    """
    shape, (flat_r, flat_z, flat_f) = numbers(r=r, z=z, f=f)
    if quality_factor is None:
        if reference_frequency is not None:
            raise SceneError("reference_frequency is given without quality_factor", key="reference_frequency")
        law = None
    else:
        law = (quality_factor, reference_frequency)
    with told(progress) as tell:
        real, imaginary, error = _core.spectrum(nu, flat_r, flat_z, flat_f, profile, law, threads, tell)
    value = (real + 1j * imaginary).reshape((*shape, 6))
    return Spectrum(value, error.reshape((*shape, 6)), np.array(flat_f.reshape(shape)))


def static(nu: float, r: ArrayLike, z: ArrayLike, *, profile: Profile = "hertz") -> Fields:
    """Static fields under a constant force, in closed form; the limit of `step` for large t.

    Parameters
    ----------
    nu : float
        Poisson's ratio in (-1, 0.5).
    r, z : array_like
        Distance from the axis and depth in r0, each in [0, 1e20]; broadcast together.
    profile : {"hertz", "punch", "point"}
        Distribution of the force over the disc.

    Returns
    -------
    Fields
        Displacements in P/(mu r0) and stresses in P/r0^2, each of the broadcast shape.

    Raises
    ------
    DomainError
        As for `step`.
    """
    shape, (flat_r, flat_z) = numbers(r=r, z=z)
    return Fields(_core.static_field(nu, flat_r, flat_z, profile).reshape((*shape, 6)))


def _surface(order: str, nu: float, t: ArrayLike, deflection: str) -> Floats:
    shape, (flat,) = numbers(t=t)
    return _core.surface(order, nu, flat, deflection).reshape(shape)


def surface_step(nu: float, t: ArrayLike, *, deflection: Deflection = "centre") -> Floats:
    """Deflection of a disc under a constant Hertz load applied at time 0, over its static value.

    Parameters
    ----------
    nu : float
        Poisson's ratio in (-1, 0.5).
    t : array_like
        Times in r0/c1.
    deflection : {"centre", "mean"}
        Deflection at the centre, or the mean weighted with the pressure.

    Returns
    -------
    ndarray
        W(t) of the shape of t, dimensionless and positive into the half-space: 0 for t <= 0, exactly 1 after
        ``medium(nu).centre_memory``. Multiply it by ``medium(nu).centre_compliance`` for the deflection in P/(mu r0);
        for the mean use ``mean_memory`` and ``mean_compliance``.

    Raises
    ------
    DomainError
        ``nu`` or ``deflection`` is not allowed, or ``t`` contains no numbers.
    """
    return _surface("step", nu, t, deflection)


def surface_impulse(nu: float, t: ArrayLike, *, deflection: Deflection = "centre") -> Floats:
    """Time derivative of `surface_step`, in c1/r0. Parameters, shape and errors are those of `surface_step`."""
    return _surface("impulse", nu, t, deflection)


def surface_step_integral(nu: float, t: ArrayLike, *, deflection: Deflection = "centre") -> Floats:
    """Integral of `surface_step` from 0 to t, in r0/c1. Parameters, shape and errors are those of `surface_step`."""
    return _surface("step_integral", nu, t, deflection)


def surface_centre(nu: float, t: ArrayLike) -> Floats:
    """`surface_step` at the centre by the closed form of Kausel (2012), an independent derivation for comparison.

    Parameters
    ----------
    nu : float
        Poisson's ratio in (-1, 0.5).
    t : array_like
        Times in r0/c2, where c2 is the speed of the shear wave (not r0/c1).

    Returns
    -------
    ndarray
        W(t) of the shape of t.

    Raises
    ------
    DomainError
        ``nu`` is not allowed, or ``t`` contains no numbers.
    """
    shape, (flat,) = numbers(t=t)
    return _core.surface_centre(nu, flat).reshape(shape)


@dataclass(frozen=True)
class Arrivals:
    """Arrival times of the wave fronts at one point in r0/c1.

    A pair contains the times of the fronts from the nearest and from the farthest edge of the disc.
    """

    above: tuple[float, float] | None
    """Plane longitudinal and plane shear front from the disc; None for points that are not below the disc."""
    p: tuple[float, float]
    """Longitudinal wave."""
    s: tuple[float, float]
    """Shear wave."""
    head: tuple[float | None, float | None]
    """Head wave, which travels along the surface with the longitudinal speed; None within the critical angle."""
    rayleigh: tuple[float, float]
    """Rayleigh wave along the surface."""
    first: float
    """First arrival of all waves."""
    last: float
    """Last arrival of all waves; the fields are smooth after it."""


@dataclass(frozen=True)
class Medium:
    """Properties of the half-space that depend only on Poisson's ratio; speeds are in c1, times in r0/c1."""

    nu: float
    """Poisson's ratio."""
    shear_speed: float
    """Speed of the shear wave, c2/c1."""
    rayleigh_speed: float
    """Speed of the Rayleigh wave, cR/c1."""
    lambda_over_mu: float
    """Ratio of the Lamé constants."""
    centre_compliance: float
    """Static deflection of the centre of a Hertz disc in P/(mu r0)."""
    centre_memory: float
    """Time after which the deflection of the centre equals its static value exactly."""
    centre_relaxation_time: float
    """Integral over time of 1 minus `surface_step` of the centre."""
    mean_compliance: float
    """Static mean deflection of a Hertz disc, weighted with the pressure, in P/(mu r0)."""
    mean_memory: float
    """Time after which the mean deflection equals its static value exactly."""
    mean_relaxation_time: float
    """Integral over time of 1 minus `surface_step` of the mean deflection."""

    def arrivals(self, r: float, z: float, *, profile: Profile = "hertz") -> Arrivals:
        """Arrival times of the wave fronts at one point.

        Parameters
        ----------
        r, z : float
            Distance from the axis and depth in r0, each in [0, 1e20].
        profile : {"hertz", "punch", "point"}
            Distribution of the force. For a point force the two times of each pair are equal.

        Returns
        -------
        Arrivals
            Times in r0/c1.

        Raises
        ------
        DomainError
            An argument is outside its range.
        """
        found = _core.arrivals(self.nu, r, z, profile)
        parts: dict[str, Any] = {name: tuple(v) if isinstance(v, list) else v for name, v in found.items()}
        return Arrivals(**parts)


def medium(nu: float) -> Medium:
    """Wave speeds, compliances, memories and arrival times of a half-space with Poisson's ratio nu.

    Parameters
    ----------
    nu : float
        Poisson's ratio in (-1, 0.5).

    Returns
    -------
    Medium
        Properties in reduced units.

    Raises
    ------
    DomainError
        ``nu`` is outside its range.
    """
    return Medium(**_core.medium(nu))
