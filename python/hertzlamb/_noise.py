"""Noise of many impacts."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from hertzlamb import _core

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from hertzlamb._impact import Scene

    Floats = NDArray[np.float64]


class Noise:
    """Ground motion of many impacts, returned by `hertzlamb.noise`. Arrays are read-only.

    Attributes
    ----------
    receiver : list of str
        Names of the receivers.
    frequency, force : ndarray (frequency,)
        Frequencies in Hz, and the mean of the squared force spectra in N^2 s^2.
    vertical_displacement, vertical_velocity, vertical_acceleration : ndarray (receiver, frequency)
        One-sided power spectral densities in m^2/Hz, (m/s)^2/Hz and (m/s^2)^2/Hz.
    horizontal_displacement, horizontal_velocity, horizontal_acceleration : ndarray (receiver, frequency)
        Those of both horizontal components together.
    error : ndarray (receiver, frequency)
        Relative error of the vertical power, the sum of ``error_sampling``, ``error_pulses``, ``error_contact_size``,
        ``error_response`` and ``error_quadrature``.
    distance, share : ndarray (receiver, edge), (receiver, frequency, edge)
        Distances in m, and the part of the vertical power from impacts within them.
    time, velocity : ndarray (time,), (receiver, time) or None
        Traces of the vertical velocity in m/s, positive down, if the description has ``output.step_s``.
    rate_per_s, radiated_power_w, impacts, solved_contacts : float, float, int, int
        Mean rate of the impacts, the power that they radiate, the number of bodies, and of contacts that were solved in full.
    arrays : dict
        All arrays by name, as in the file.
    """

    receiver: list[str]
    frequency: Floats
    force: Floats
    vertical_velocity: Floats
    error: Floats
    distance: Floats
    share: Floats
    time: Floats | None = None
    velocity: Floats | None = None

    def __init__(self, core: _core.Noise) -> None:
        self._core = core
        self.arrays: dict[str, Any] = core.arrays()
        self.__dict__.update(self.arrays)
        self.rate_per_s, self.radiated_power_w, self.impacts, self.solved_contacts = core.numbers()

    def save(self, path: str | os.PathLike[str], *, overwrite: bool = False) -> None:
        """Writes the noise to an HDF5 file, as ``hertzlamb noise -o`` does.

        Raises `OutputExists` if the file exists and ``overwrite`` is False.
        """
        self._core.save(path, overwrite)

    def __repr__(self) -> str:
        lines = [f"noise of {self.impacts} impacts, {self.rate_per_s:.6g} per s"]
        for name, power, error in zip(self.receiver, self.vertical_velocity, self.error, strict=True):
            loudest = power.argmax()
            lines.append(f"  {name:20} {power[loudest]:.4g} (m/s)^2/Hz +- {100 * error[loudest]:.1f} % at {self.frequency[loudest]:.6g} Hz")
        return "\n".join(lines)


def noise(
    description: Scene,
    *,
    threads: int | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> Noise:
    """Computes the ground motion of many impacts.

    Parameters
    ----------
    description : dict, path or str
        Half-space, striker, area or table of impacts, receivers and output, with the keys of a noise file
        (``data-schema/noise.md``).
    threads : int, optional
        Number of threads. Default: one for each processor.
    progress : callable, optional
        Called with the finished and the total units of work of each stage.

    Returns
    -------
    Noise
        Spectra with errors and shares, and traces on request.

    Raises
    ------
    SceneError
        The description is invalid; the message has the key, the value and the allowed range.
    ImpactError
        An impact has no results.

    Examples
    --------
    >>> import hertzlamb as hl
    >>> rain = hl.noise({
    ...     "target": {"material": "granite"},
    ...     "striker": {"material": "granite", "shape": "ball", "diameter_m": 0.02, "velocity_m_s": 1.0},
    ...     "area": {"shape": "disc", "radius_m": 50.0, "inner_radius_m": 1.0, "rate_per_m2_s": 2.0},
    ...     "receiver": [{"x_m": 0.0, "y_m": 0.0}],
    ...     "output": {"frequencies_hz": [10.0, 100.0]},
    ... })
    >>> rain.vertical_velocity.shape
    (1, 2)
    """
    return Noise(_core.noise(description, threads, progress))
