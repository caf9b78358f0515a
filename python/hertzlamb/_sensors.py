"""Sensors: histories over their faces, and responses."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from hertzlamb import _core

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Floats = NDArray[np.float64]


class Sensor:
    """The histories of one sensor of a scene. Arrays are read-only.

    Attributes
    ----------
    r, z, face_radius : float
        Distance of the centre of the face from the axis, depth, and radius of the face in m.
    quantity, unit : str
        Measured quantity, such as ``"velocity_z"``, and its unit.
    output_unit : str
        Unit of `output`: that of the response, or `unit` without one.
    face_mean : str
        Method of the mean over the face: ``"point"``, ``"discs"``, ``"circles"`` or ``"kernels"``.
    arrival : ndarray (3,)
        Arrival times in s of the first P, S and Rayleigh wave at the nearest point of the face.
    valid_until : float
        Arrival time in s of the first echo from the faces of the block; infinite if the scene names no such face.
    time : ndarray (time,)
        Times in s since the first contact.
    mean : ndarray (time,)
        Mean of the quantity over the face.
    mean_error : float
        Estimated absolute error of the mean.
    output : ndarray (time,)
        Output of the response; the mean without one.
    output_error : ndarray (time,)
        Estimated absolute error of each sample of the output.
    """

    r: float
    z: float
    face_radius: float
    quantity: str
    unit: str
    output_unit: str
    face_mean: str
    arrival: Floats
    valid_until: float
    time: Floats
    mean: Floats
    mean_error: float
    output: Floats
    output_error: Floats

    def __init__(self, parts: dict[str, Any], time: Floats) -> None:
        self.__dict__.update(parts, time=time)

    def __repr__(self) -> str:
        peak = self.output[np.argmax(np.abs(self.output))]
        return (
            f"Sensor {self.quantity} at r = {self.r:g} m, z = {self.z:g} m, face radius {self.face_radius:g} m: "
            f"peak {peak:.6g} {self.output_unit}, error up to {self.output_error.max():.1e}"
        )


class Response:
    """A linear response that is constant in time, from a motion in SI units to the output of a sensor.

    The time factor is e^(2 pi i f t), as in ``numpy.fft.rfft`` and SEED. `poles_zeros`, `table`, `filter` and `read` make
    responses; in a scene they are ``response`` of a sensor.

    >>> import numpy as np, hertzlamb as hl
    >>> pole = 2e5 * np.pi * complex(-0.707, (1 - 0.707**2) ** 0.5)  # a second-order high pass at 100 kHz
    >>> high_pass = hl.Response.poles_zeros([pole, pole.conjugate()], [0, 0], 1.0)
    >>> bool(abs(abs(high_pass(1e5)) - 1 / (2 * 0.707)) < 1e-12)
    True
    """

    def __init__(self, core: _core.Response) -> None:
        self._core = core

    @classmethod
    def poles_zeros(cls, poles: Sequence[complex], zeros: Sequence[complex], gain: float) -> Response:
        """gain prod(i w - z)/prod(i w - p), w = 2 pi f, roots in rad/s.

        A dictionary ``paz`` of ObsPy has ``paz["poles"]``, ``paz["zeros"]`` and ``paz["gain"] * paz["sensitivity"]``; its
        input is the velocity. Poles with a real part >= 0 raise a `SceneError`.
        """
        return cls(_core.Response.poles_zeros([complex(p) for p in poles], [complex(z) for z in zeros], float(gain)))

    @classmethod
    def table(cls, frequency_hz: ArrayLike, amplitude: ArrayLike, phase_rad: ArrayLike | None = None) -> Response:
        """Values at ascending frequencies; zero outside. Without phases it is of minimum phase, see `is_minimum_phase`.

        Complex values H, such as those of ObsPy's ``get_evalresp_response_for_frequencies``, are
        ``table(f, abs(H), numpy.unwrap(numpy.angle(H)))``.
        """
        frequency, size = (np.ascontiguousarray(column, dtype=float) for column in (frequency_hz, amplitude))
        phase = None if phase_rad is None else np.ascontiguousarray(phase_rad, dtype=float)
        return cls(_core.Response.table(frequency, size, phase))

    @classmethod
    def filter(cls, coefficients: ArrayLike, rate_hz: float) -> Response:
        """A digital filter (FIR) with coefficients at a sampling rate in Hz."""
        return cls(_core.Response.filter(np.ascontiguousarray(coefficients, dtype=float), float(rate_hz)))

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Response:
        """A pole-zero file of SAC, whose input is the displacement in m, or a table with a header of frequency, amplitude and phase."""
        return cls(_core.Response.read(path))

    @property
    def is_minimum_phase(self) -> bool:
        """Whether the phases were computed from the amplitudes."""
        return self._core.is_minimum_phase

    @property
    def limits_hz(self) -> tuple[float, float]:
        """Frequencies in Hz outside which the response is zero."""
        low, high = self._core.limits_hz
        return low, high

    def __call__(self, frequency_hz: ArrayLike) -> Any:
        """Complex values at frequencies in Hz, (...)."""
        given = np.asarray(frequency_hz, dtype=float)
        found = self._core.at(np.ascontiguousarray(given.reshape(-1))).reshape(given.shape)
        return found if given.shape else complex(found)

    def apply(self, step_s: float, samples: ArrayLike) -> tuple[Floats, Floats]:
        """Output and its estimated error for samples of the input, (time,), which was zero before the first.

        The error is that of the sampling alone.
        """
        output, error, _ = self._core.apply(float(step_s), np.ascontiguousarray(samples, dtype=float))
        return output, error

    def remove(self, step_s: float, samples: ArrayLike, band_hz: Sequence[float]) -> Floats:
        """The input whose output the samples are, (time,), in a band f1, f2, f3, f4 in Hz with cosine tapers.

        Order of operations: no taper of the record, no mean removed; the response is taken out; then the band.
        """
        return self._core.remove(float(step_s), np.ascontiguousarray(samples, dtype=float), [float(f) for f in band_hz])

    def __repr__(self) -> str:
        return f"Response.{self._core.kind}"
