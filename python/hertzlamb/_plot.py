"""Pictures with matplotlib, in the style of ``hertzlamb plot``."""

from __future__ import annotations

from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from hertzlamb import _core
from hertzlamb._impact import DESCRIBED, QUANTITIES

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from hertzlamb._impact import Impact
    from hertzlamb._sweep import Sweep

_FIELDS: dict[str, list[str]] = {**DESCRIBED["fields"], **DESCRIBED["more"]}
"""Unit and description of all fields and quantities of a point."""

_PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"), (1e-12, "p"))
_ODD = ("displacement_r", "velocity_r", "acceleration_r", "stress_rz", "strain_rz")
"""Quantities that change their sign across the axis."""
_MARK = "#555555"
"""Colour of vertical lines at marked times."""
_BAND = 0.22
"""Opacity of an error band, relative to its curve."""
_UNITS = {"pa_sqrt_m": "Pa m$^{1/2}$", "kg_m3": "kg/m$^3$", "m_s": "m/s", "n_s": "N s", "kg": "g", "pa": "Pa", "n": "N", "j": "J"}
_UNITS |= {"m": "m", "s": "s"}
"""Units by the suffixes of keys and results, the longest first; masses are shown in grams."""
_Drawn = TypeVar("_Drawn")


def _styled(draw: Callable[..., _Drawn]) -> Callable[..., _Drawn]:
    """Decorator that applies the style of the command's pictures."""

    @wraps(draw)
    def drawn(*arguments: Any) -> _Drawn:
        import matplotlib.pyplot as plt

        with plt.style.context(Path(__file__).with_name("style.mplstyle")):
            return draw(*arguments)

    return drawn


def _scale(values: NDArray[Any], unit: str) -> tuple[float, str]:
    """Factor for the values, and the unit with its prefix; values from 0.1 to 1 keep their unit, lengths excepted."""
    size = float(np.max(np.abs(values[np.isfinite(values)]), initial=0.0))
    if 0.1 <= size < 1.0 and unit != "m":
        return 1.0, unit
    factor, prefix = next((row for row in _PREFIXES if size >= row[0]), (1.0, ""))
    return 1.0 / factor, f"{prefix}{unit}"


def _told(value: float, unit: str) -> str:
    """Text of a value to four digits, with its unit and a prefix."""
    factor, prefix = next((row for row in _PREFIXES if abs(value) >= row[0]), (1.0, ""))
    return f"{value / factor:.4g} {prefix}{unit}"


def _title(run: Impact) -> str:
    """Title that names striker, target and velocity, with the words of the command's pictures."""
    striker = run.scene.get("striker")
    if striker is None:
        return "A given force on the half-space"
    shape = striker.get("shape")
    if shape == "ball":
        body = f"ball of {_told(striker['diameter_m'], 'm')}"
    elif shape == "rod":
        body = f"rod of {_told(striker['length_m'], 'm')}, {_told(striker['diameter_m'], 'm')} thick,"
    else:
        body = f"mass of {_told(1e3 * striker['mass_kg'], 'g')}, tip radius {_told(striker['tip_radius_m'], 'm')},"
    of, target = striker.get("material", ""), run.scene["target"].get("material", "")
    return " ".join(f"{of} {body} strikes {target} at {_told(striker['velocity_m_s'], 'm/s')}".split())


def _words(quantity: str) -> str:
    """Description of a quantity without its sign convention."""
    return _FIELDS[quantity][1].split(",")[0]


def _labelled(values: NDArray[Any], name: str, is_log: bool = False) -> tuple[float, str]:
    """Factor for the values of a key or a result, and its label with the unit."""
    section, _, key = name.rpartition(".")
    ending = next((ending for ending in _UNITS if key.endswith(f"_{ending}")), "")
    words = key.removesuffix(f"_{ending}").replace("youngs_modulus", "Young's modulus")
    words = words.replace("poisson_ratio", "Poisson's ratio").replace("_", " ")
    words = {"loss": "energy lost, 1 − e²"}.get(words, words) + (" of the half-space" if section == "target" else "")
    if not ending:
        return 1.0, words
    own = 1e3 if ending == "kg" else 1.0
    unit = _UNITS[ending]
    scale, unit = (1.0, unit) if is_log or "$" in unit else _scale(own * values, unit)
    return own * scale, f"{words} [{unit}]"


def _place(r: float, z: float) -> str:
    """Text for the position of a probe, with the words of the command's pictures."""
    r_told, z_told = f"r = {_told(r, 'm')}", f"z = {_told(z, 'm')}"
    if r > 0.0:
        return f"{r_told}, {z_told}" if z > 0.0 else f"on the surface, {r_told}"
    return f"on the axis, {z_told}" if z > 0.0 else "at the centre of the contact"


def _marked(axes: Axes, scale: float, marks: dict[str, float], end: float) -> None:
    """Draws a vertical line with its name above for each time in s in (0, end]; other times are skipped."""
    low, high = axes.get_ylim()
    for name, at in marks.items():
        if 0.0 < at <= end:
            axes.axvline(scale * at, color=_MARK, linewidth=0.75, linestyle="--")
            axes.text(scale * at, high, name, ha="center", va="bottom")
    axes.set_ylim(low, high)


def _axes(axes: Axes | None) -> Axes:
    if axes is not None:
        return axes
    import matplotlib.pyplot as plt

    return plt.subplots(layout="constrained")[1]


def _known(quantity: str, names: tuple[str, ...]) -> None:
    if quantity not in names:
        raise KeyError(f"{quantity!r} is not one of {', '.join(names)}")


@_styled
def force(run: Impact, axes: Axes | None) -> Axes:
    """Draws the force over time, until 10 % after the contact."""
    axes = _axes(axes)
    end = min(1.1 * run.contact_time_s, float(run.time[-1]))
    shown = run.time <= end
    (time_scale, time_unit), (scale, unit) = _scale(run.time[shown], "s"), _scale(run.force, "N")
    axes.plot(time_scale * run.time[shown], scale * run.force[shown])
    axes.set_xlabel(f"time [{time_unit}]")
    axes.set_ylabel(f"force [{unit}]")
    axes.set_xlim(0.0, time_scale * end)
    axes.set_ylim(bottom=0.0)
    faces = [run.scene["target"][key] for key in ("thickness_m", "radius_m") if key in run.scene["target"]]
    if faces:
        begin = run.time[max(int(np.argmax(run.force != 0.0)) - 1, 0)]
        _marked(axes, time_scale, {"first echo": begin + 2.0 * min(faces) / _speeds(run)["P"]}, end)
    axes.set_title(_title(run), pad=16 if faces else None)
    return axes


def _first_echoes(names: Any, times: Any) -> dict[str, float]:
    """The arrivals of the echoes with the fewest legs."""
    there = [(str(name), time) for name, time in zip(names, times, strict=True) if np.isfinite(time)]
    fewest = min((len(name) for name, _ in there), default=0)
    return {name: time for name, time in there if len(name) == fewest}


@_styled
def probes(run: Impact, quantity: str) -> Figure:
    """Draws a quantity over time with the arrivals, one panel for each probe."""
    found = run.probes
    import matplotlib.pyplot as plt

    _known(quantity, tuple(name for name in _FIELDS if name in found))
    values = getattr(found, quantity)
    count = len(found.r)
    figure, panels = plt.subplots(count, 1, sharex=True, squeeze=False, layout="constrained", figsize=(7, 1 + 1.8 * count))
    time_scale, time_unit = _scale(found.time, "s")
    for i, panel in enumerate(panels[:, 0]):
        scale, unit = _scale(values[i], _FIELDS[quantity][0])
        (line,) = panel.plot(time_scale * found.time, scale * values[i])
        if quantity in found.error:
            error = found.error[quantity][i]
            band = (scale * (values[i] - error), scale * (values[i] + error))
            panel.fill_between(time_scale * found.time, *band, color=line.get_color(), alpha=_BAND, linewidth=0)
        waves = dict(zip("PSR", found.arrival[i], strict=True))
        if "echo" in found:
            waves.update(_first_echoes(found.echo, found.echo_arrival[i]))
        _marked(panel, time_scale, {**waves, "valid until the echo": found.valid_until[i]}, found.time[-1])
        panel.set_ylabel(f"{_words(quantity)} [{unit}]")
        panel.set_title(_place(found.r[i], found.z[i]), loc="center", pad=16)
    panels[-1, 0].set_xlabel(f"time [{time_unit}]")
    panels[-1, 0].set_xlim(0.0, time_scale * found.time[-1])
    figure.suptitle(_title(run), x=0.01, ha="left")
    return figure


@_styled
def section(run: Impact, frame: int, quantity: str, axes: Axes | None) -> Axes:
    """Draws a frame of the section, mirrored at the axis, with the wave fronts from the edge of the disc."""
    found = run.section
    _known(quantity, tuple(name for name in _FIELDS if name in found))
    axes = _axes(axes)
    values = np.asarray(found[quantity][frame], dtype=np.float64)
    time = float(found.time[frame])
    length, length_unit = _scale(np.concatenate([found.r, found.z]), "m")
    # the field under the load is much larger than the waves, so the colour scale leaves it out
    beyond = np.hypot(*np.meshgrid(found.r, found.z)) > 3.0 * run.disc_radius_m
    size = np.abs(values[beyond] if np.any(beyond) else values)
    most = np.quantile(size, 0.995, keepdims=True)
    scale, unit = _scale(most, _FIELDS[quantity][0])
    limit = scale * float(most.max()) or 1.0
    sign = -1.0 if quantity in _ODD else 1.0
    r = np.concatenate([-found.r[:0:-1], found.r])
    both = np.concatenate([sign * values[:, :0:-1], values], axis=1)
    image = axes.pcolormesh(
        length * r, length * found.z, scale * both, vmin=-limit, vmax=limit, shading="gouraud"
    )
    for wave, speed in _speeds(run).items():
        angle = np.linspace(0.0, np.pi, 200)
        reach = speed * time
        x = np.cos(angle) * reach + np.sign(np.cos(angle)) * run.disc_radius_m
        axes.plot(length * x, length * reach * np.sin(angle), color="black", linewidth=0.75, linestyle="--")
        z = 0.985 * length * reach
        if z < length * found.z.max():
            axes.text(0.0, z, wave, ha="center", va="bottom")
    axes.set_xlim(-length * found.r.max(), length * found.r.max())
    axes.set_ylim(length * found.z.max(), 0.0)
    axes.set_aspect("equal")
    axes.set_xlabel(f"distance from the axis [{length_unit}]")
    axes.set_ylabel(f"depth [{length_unit}]")
    axes.set_title(f"{_words(quantity)} at {_told(time, 's')}")
    axes.figure.colorbar(image, ax=axes, label=f"{_words(quantity)} [{unit}]", extend="both", shrink=0.55)
    return axes


def _speeds(run: Impact) -> dict[str, float]:
    """Speeds in m/s of the longitudinal wave P and of the shear wave S in the target."""
    target = run.scene["target"]
    if "material" in target:
        base = next(row for row in _core.materials(target["material"]) if row["name"] == target["material"])
        target = {**base, **target}
    nu, modulus, density = (target[key] for key in ("poisson_ratio", "youngs_modulus_pa", "density_kg_m3"))
    shear = (modulus / (2.0 * (1.0 + nu) * density)) ** 0.5
    return {"P": shear / _core.medium(nu)["shear_speed"], "S": shear}


@_styled
def sweep(out: Sweep, quantity: str, axes: Axes | None) -> Axes:
    """Draws a result over the first numeric key; random samples are drawn as their median and a 5 to 95 % band."""
    _known(quantity, tuple(QUANTITIES))
    axes = _axes(axes)
    keys = {name: values for name, values in out._keys.items()}
    drawn = {key for axis, _, columns in out._axes if axis == "sample" for key in columns}
    numbers = [name for name, values in keys.items() if values.dtype.kind == "f" and name not in drawn]
    if not numbers:
        scale, label = _labelled(out[quantity], quantity)
        axes.hist(scale * out[quantity], bins="auto")
        axes.set_xlabel(label)
        axes.set_ylabel("scenes")
        return axes
    along = numbers[0]
    values = np.unique(keys[along])
    is_log = len(values) > 2 and values[0] > 0 and values[-1] > 30 * values[0]
    (x_scale, x_label), (scale, label) = _labelled(values, along, is_log), _labelled(out[quantity], quantity)
    rest = [name for name in keys if name != along and name not in drawn]
    labels = [", ".join(f"{name.split('.')[-1]} {keys[name][i]}" for name in rest) for i in range(len(out.rows))]
    for name in dict.fromkeys(labels):
        chosen = np.array([one == name for one in labels])
        x = np.unique(keys[along][chosen])
        rows = [scale * out[quantity][chosen & (keys[along] == value)] for value in x]
        (line,) = axes.plot(x_scale * x, [np.nanmedian(row) for row in rows], label=name or None)
        if drawn:
            low, high = ([np.nanquantile(row, part) for row in rows] for part in (0.05, 0.95))
            axes.fill_between(x_scale * x, low, high, color=line.get_color(), alpha=_BAND, linewidth=0)
    if is_log:
        axes.set_xscale("log")
    axes.set_xlabel(x_label)
    axes.set_ylabel(label)
    if rest:
        axes.legend()
    return axes
