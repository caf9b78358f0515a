"""The force behind traces of sensors."""

from __future__ import annotations

import os
import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from hertzlamb import _core
from hertzlamb._errors import HertzlambWarning, SceneError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from hertzlamb._impact import Scene

    Floats = NDArray[np.float64]


class Value(NamedTuple):
    """A value with its standard deviation."""

    value: float
    sd: float


class Force:
    """A force inferred from traces, returned by `hertzlamb.infer_force`. Arrays are read-only.

    The fit of the contact law's pulse (`peak_force_n`, `contact_time_s`, `start_s`, `impulse_n_s`) is the most accurate if
    the law is right; the history (`time`, `force`, `low`, `high`) has no law.

    Attributes
    ----------
    peak_force_n, contact_time_s, start_s, impulse_n_s : Value
        Fit: peak, duration, beginning in the clock of the traces, impulse; each with its standard deviation.
    time, force, low, high : ndarray (sample,)
        History of the force in N at times in s, with the ends of its 95 % band.
    history_peak_n, history_impulse_n_s : Value
        Peak and impulse of the history.
    variance_reduction, chi_squared, degrees_of_freedom, lambda_ : float
        Agreement of the history with the traces, and the weight of its squared second differences in 1/N^2.
    l_curve : ndarray (point, 3)
        Weight, norm of the residual in units of the noise, and norm of the second differences in N.
    predicted_time, predicted : ndarray (time,), (sensor, time)
        The traces that the history explains.
    gains : list of Value
        Factor of each trace; 1 with no error where it is known.
    ball : dict of Value or None
        ``radius_m``, ``mass_kg`` and ``velocity_m_s`` for a scene with an elastic striker.
    report : dict
        All numbers, as ``hertzlamb infer --trace --json`` prints them.
    """

    def __init__(self, core: _core.Force) -> None:
        self._core = core
        self.report: dict[str, Any] = core.report()
        fit, history = self.report["fit"], self.report["history"]
        self.peak_force_n = Value(**fit["peak_force_n"])
        self.contact_time_s = Value(**fit["contact_time_s"])
        self.start_s = Value(**fit["start_s"])
        self.impulse_n_s = Value(**fit["impulse_n_s"])
        self.history_peak_n = Value(**history["peak_force_n"])
        self.history_impulse_n_s = Value(**history["impulse_n_s"])
        self.variance_reduction: float = history["variance_reduction"]
        self.chi_squared: float = history["chi_squared"]
        self.degrees_of_freedom: float = history["degrees_of_freedom"]
        self.lambda_: float = history["lambda"]
        self.gains = [Value(**gain) for gain in history["gains"]]
        ball = self.report["ball"]
        self.ball = None if ball is None else {name: Value(**value) for name, value in ball.items()}
        arrays = core.arrays()
        self.time: Floats = arrays["time"]
        self.force: Floats = arrays["force"]
        self.low: Floats = arrays["low"]
        self.high: Floats = arrays["high"]
        self.l_curve: Floats = arrays["l_curve"]
        self.predicted_time: Floats = arrays["predicted_time"]
        self.predicted: Floats = arrays["predicted"]

    @property
    def scene(self) -> dict[str, Any]:
        """The scene with every default and material property written out."""
        return self._core.scene()

    def save(self, path: str | os.PathLike[str], *, overwrite: bool = False) -> None:
        """Writes the force to an HDF5 file, as ``hertzlamb infer --trace -o`` does.

        Raises `OutputExists` if the file exists and ``overwrite`` is False.
        """
        self._core.save(path, overwrite)

    def plot(self, *, axes: Axes | None = None) -> Axes:
        """Draws the history with its band and the peak of the fit with matplotlib."""
        import matplotlib.pyplot as plt

        axes = plt.subplots()[1] if axes is None else axes
        axes.fill_between(1e6 * self.time, self.low, self.high, alpha=0.3, label="95 % band")
        axes.plot(1e6 * self.time, self.force, label="history")
        middle = self.start_s.value + 0.5 * self.contact_time_s.value
        axes.errorbar(1e6 * middle, self.peak_force_n.value, 2 * self.peak_force_n.sd, fmt="o", label="peak of the fit")
        axes.set(xlabel="time (us)", ylabel="force (N)")
        axes.legend()
        return axes

    def __repr__(self) -> str:
        lines = ["force from traces"]
        for name in ("peak_force_n", "contact_time_s", "start_s", "impulse_n_s"):
            value, sd = getattr(self, name)
            lines.append(f"  {name:20} {value:.6g} +- {sd:.2g}")
        lines.append(f"  {'history':20} {len(self.force)} samples, {100 * self.variance_reduction:.2f} % of the variance")
        return "\n".join(lines)


def _trace(values: Any) -> tuple[Floats, float | None]:
    """Samples, and the step of an object with ``.data`` and ``.stats.delta``, such as an ObsPy Trace."""
    if hasattr(values, "data") and hasattr(values, "stats"):
        return np.ascontiguousarray(values.data, dtype=float), float(values.stats.delta)
    return np.ascontiguousarray(values, dtype=float), None


def _is_trace(values: Any) -> bool:
    """Whether it is one trace, rather than a list of traces."""
    return hasattr(values, "stats") or not (len(values) and (hasattr(values[0], "stats") or np.ndim(values[0])))


def infer_force(
    time: Any,
    values: Any,
    scene: Scene,
    *,
    noise: float | Sequence[float] | None = None,
    unknown_gains: Sequence[int] = (),
    impulse_n_s: tuple[float, float] | None = None,
    lambda_: float | None = None,
    window_s: tuple[float, float] | None = None,
    known: Literal["radius", "density", "mass"] | None = None,
    restitution: float | None = None,
) -> Force:
    """Infers the contact force from traces of the sensors of a scene.

    First the pulse of the contact law is fitted (Hertz's, or that of ``contact.plasticity``), then a force of any shape
    that is not negative and as smooth as the traces allow.

    Parameters
    ----------
    time : array (time,) or None
        Times in s, equidistant. None if the traces have their own step (``.stats.delta``).
    values : array (time,), (sensor, time) or (drop, sensor, time), a trace, or a list of traces
        Traces in the unit of each sensor's output, in the order of the scene. Repeated drops are aligned and averaged. A
        trace may be an array, or any object with ``.data`` and ``.stats.delta``, such as an ObsPy Trace.
    scene : dict, path or str
        Scene with the block, the sensors with their responses, and perhaps the striker. Without a striker it needs
        ``contact.disc_radius_m`` and a ``force``, whose samples are ignored.
    noise : float or one for each sensor, optional
        Standard deviation of white noise in the units of the traces. Default: the noise before the first arrival, which may
        be coloured.
    unknown_gains : sequence of int
        Sensors, from 0, whose gain is not known.
    impulse_n_s : pair of float, optional
        Known impulse in N s and its standard deviation.
    lambda_ : float, optional
        Weight of the squared second differences in 1/N^2. Default: the most likely one.
    window_s : pair of float, optional
        Times in s between which the force may differ from zero. Default: 1.3 fitted contact times.
    known : {"radius", "density", "mass"}, optional
        Property of the striker that is trusted; mass and velocity follow. Default: ``"radius"``.
    restitution : float, optional
        Known restitution, by which the impulse is a momentum (``report["momentum_n_s"]``).

    Returns
    -------
    Force
        Fit, history with a band, agreement, L-curve.

    Raises
    ------
    SceneError
        The scene or the traces are invalid, or the traces do not determine a force; the message has the way out.

    Warns
    -----
    HertzlambWarning
        The contact of the scene is beyond its law, or no force explains the traces. ``report["warnings"]`` has all messages.

    Examples
    --------
    >>> import numpy as np, hertzlamb as hl
    >>> scene = {"target": {"material": "aluminium"}, "striker": {"material": "steel", "shape": "ball", "diameter_m": 3e-3,
    ...          "velocity_m_s": 0.2}, "sensor": [{"r_m": 0.03, "z_m": 0.0}]}
    >>> run = hl.impact(scene)
    >>> time = np.arange(-1e-5, 4e-5, 1e-7)
    >>> trace = np.interp(time, run.time, run.sensors[0].output, left=0.0)
    >>> trace += 0.01 * np.max(np.abs(trace)) * np.random.default_rng(1).normal(size=len(time))
    >>> force = hl.infer_force(time, trace, scene)
    >>> bool(abs(force.peak_force_n.value / run.peak_force_n - 1) < 0.02)
    True
    """
    drops: list[Any] = [[values]] if _is_trace(values) else list(values)
    if _is_trace(drops[0]):
        drops = [drops]
    found = [[_trace(trace) for trace in drop] for drop in drops]
    steps = {step for drop in found for _, step in drop if step is not None}
    if time is None:
        if len(steps) != 1 or not min(steps) > 0:
            given = ", ".join(map(str, sorted(steps))) or "none"
            message = (
                f"time is None and the steps of the traces are {given}: pass the times in s. "
                "ObsPy reads a step of a SAC file below 1 us as 0 or rounds it"
            )
            raise SceneError(message, key="time")
        time = np.arange(len(found[0][0][0])) * steps.pop()
    force = Force(
        _core.force(
            scene,
            np.ascontiguousarray(time, dtype=float),
            [[samples for samples, _ in drop] for drop in found],
            [] if noise is None else [float(sigma) for sigma in np.atleast_1d(noise)],
            [sensor + 1 for sensor in unknown_gains],
            None if impulse_n_s is None else list(impulse_n_s),
            lambda_,
            None if window_s is None else list(window_s),
            known,
            restitution,
        )
    )
    for message in force.report["warnings"]:
        warnings.warn(message, HertzlambWarning, stacklevel=2)
    return force
