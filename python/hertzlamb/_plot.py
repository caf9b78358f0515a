"""Pictures with matplotlib, where people look rather than read."""

from __future__ import annotations

from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from hertzlamb import _core
from hertzlamb._impact import QUANTITIES

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from hertzlamb._impact import Impact
    from hertzlamb._sweep import Sweep

_FIELDS: dict[str, list[str]] = {**_core.describe()["fields"], **_core.describe()["more"]}
"""Unit and meaning of what can be asked of a point."""

_PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"), (1e-12, "p"))
_ODD = ("displacement_r", "velocity_r", "acceleration_r", "stress_rz", "strain_rz")
"""What changes its sign across the axis."""
_MARK = "#555555"
_BAND = 0.22
"""Colour of what is marked, and how much of a curve's colour its band has."""
_Drawn = TypeVar("_Drawn")


def _styled(draw: Callable[..., _Drawn]) -> Callable[..., _Drawn]:
    """With the style of the pictures of the command."""

    @wraps(draw)
    def drawn(*arguments: Any) -> _Drawn:
        import matplotlib.pyplot as plt

        with plt.style.context(Path(__file__).with_name("style.mplstyle")):
            return draw(*arguments)

    return drawn


def _scale(values: NDArray[Any], unit: str) -> tuple[float, str]:
    """What to multiply values with, and the unit with its prefix."""
    size = float(np.max(np.abs(values[np.isfinite(values)]), initial=0.0))
    factor, prefix = next((row for row in _PREFIXES if size >= row[0]), (1.0, ""))
    return 1.0 / factor, f"{prefix}{unit}"


def _title(run: Impact) -> str:
    """What strikes what, in the words of the command's pictures."""
    striker = run.scene.get("striker")
    if striker is None:
        return "A given force on the half-space"

    def told(value: float, unit: str) -> str:
        scale, unit = _scale(np.array([value]), unit)
        return f"{scale * value:.4g} {unit}"

    shape = striker.get("shape")
    if shape == "ball":
        body = f"ball of {told(striker['diameter_m'], 'm')}"
    elif shape == "rod":
        body = f"rod of {told(striker['length_m'], 'm')}, {told(striker['diameter_m'], 'm')} thick,"
    else:
        body = f"mass of {told(1e3 * striker['mass_kg'], 'g')}, tip radius {told(striker['tip_radius_m'], 'm')},"
    of, target = striker.get("material", ""), run.scene["target"].get("material", "")
    return " ".join(f"{of} {body} strikes {target} at {told(striker['velocity_m_s'], 'm/s')}".split())


def _words(quantity: str) -> str:
    """What a quantity is, without its sign."""
    return _FIELDS[quantity][1].split(",")[0]


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
    """The force over time, to a little after the contact."""
    axes = _axes(axes)
    end = min(1.1 * run.contact_time_s, float(run.time[-1]))
    shown = run.time <= end
    (time_scale, time_unit), (scale, unit) = _scale(run.time[shown], "s"), _scale(run.force, "N")
    axes.plot(time_scale * run.time[shown], scale * run.force[shown])
    axes.set_xlabel(f"time [{time_unit}]")
    axes.set_ylabel(f"contact force [{unit}]")
    axes.set_xlim(0.0, time_scale * end)
    axes.set_ylim(bottom=0.0)
    axes.set_title(_title(run))
    return axes


@_styled
def probes(run: Impact, quantity: str) -> Figure:
    """A quantity at every probe over time, each in a panel of its own, with the arrivals."""
    found = run.probes
    import matplotlib.pyplot as plt

    _known(quantity, tuple(name for name in _FIELDS if name in found))
    values = getattr(found, quantity)
    count = len(found.r)
    figure, panels = plt.subplots(count, 1, sharex=True, squeeze=False, layout="constrained", figsize=(7, 1 + 1.8 * count))
    time_scale, time_unit = _scale(found.time, "s")
    place_scale, place_unit = _scale(np.concatenate([found.r, found.z]), "m")
    for i, panel in enumerate(panels[:, 0]):
        scale, unit = _scale(values[i], _FIELDS[quantity][0])
        (line,) = panel.plot(time_scale * found.time, scale * values[i])
        if quantity in found.error:
            error = found.error[quantity][i]
            band = (scale * (values[i] - error), scale * (values[i] + error))
            panel.fill_between(time_scale * found.time, *band, color=line.get_color(), alpha=_BAND, linewidth=0)
        low, high = panel.get_ylim()
        for wave, at in zip("PSR", found.arrival[i], strict=True):
            if at <= found.time[-1]:
                panel.axvline(time_scale * at, color=_MARK, linewidth=0.75, linestyle="--")
                panel.text(time_scale * at, high, wave, ha="center", va="bottom")
        panel.set_ylim(low, high)
        panel.set_ylabel(f"[{unit}]")
        panel.set_title(
            f"r = {place_scale * found.r[i]:g} {place_unit}, z = {place_scale * found.z[i]:g} {place_unit}",
            loc="right",
        )
    panels[-1, 0].set_xlabel(f"time [{time_unit}]")
    panels[-1, 0].set_xlim(0.0, time_scale * found.time[-1])
    figure.suptitle(_words(quantity))
    return figure


@_styled
def section(run: Impact, frame: int, quantity: str, axes: Axes | None) -> Axes:
    """A field on the section at a frame, mirrored at the axis, with the fronts from the edge of the disc."""
    found = run.section
    _known(quantity, tuple(name for name in _FIELDS if name in found))
    axes = _axes(axes)
    values = np.asarray(found[quantity][frame], dtype=np.float64)
    time = float(found.time[frame])
    length, length_unit = _scale(np.concatenate([found.r, found.z]), "m")
    # the largest values are under the load: waves are seen against what is away from it
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
    for speed, wave in zip(_speeds(run), ("P", "S"), strict=True):
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
    axes.set_xlabel(f"r [{length_unit}]")
    axes.set_ylabel(f"z [{length_unit}]")
    time_scale, time_unit = _scale(np.array([time]), "s")
    axes.set_title(f"{_words(quantity)} at {time_scale * time:.3g} {time_unit}")
    axes.figure.colorbar(image, ax=axes, label=f"[{unit}]", extend="both", shrink=0.55)
    return axes


def _speeds(run: Impact) -> tuple[float, float]:
    """Speeds of the longitudinal and of the shear wave in m/s."""
    target = run.scene["target"]
    if "material" in target:
        base = next(row for row in _core.materials(target["material"]) if row["name"] == target["material"])
        target = {**base, **target}
    nu, modulus, density = (target[key] for key in ("poisson_ratio", "youngs_modulus_pa", "density_kg_m3"))
    shear = (modulus / (2.0 * (1.0 + nu) * density)) ** 0.5
    return shear / _core.medium(nu)["shear_speed"], shear


@_styled
def sweep(out: Sweep, quantity: str, axes: Axes | None) -> Axes:
    """A result over the first key that is a number, a line for each choice of words; of draws, the median and 90 %."""
    _known(quantity, tuple(QUANTITIES))
    axes = _axes(axes)
    keys = {name: values for name, values in out._keys.items()}
    drawn = {key for axis, _, columns in out._axes if axis == "sample" for key in columns}
    numbers = [name for name, values in keys.items() if values.dtype.kind == "f" and name not in drawn]
    if not numbers:
        axes.hist(out[quantity], bins="auto")
        axes.set_xlabel(_label(quantity))
        axes.set_ylabel("draws")
        return axes
    along = numbers[0]
    rest = [name for name in keys if name != along and name not in drawn]
    labels = [", ".join(f"{name.split('.')[-1]} {keys[name][i]}" for name in rest) for i in range(len(out.rows))]
    for label in dict.fromkeys(labels):
        chosen = np.array([one == label for one in labels])
        x = np.unique(keys[along][chosen])
        rows = [out[quantity][chosen & (keys[along] == value)] for value in x]
        (line,) = axes.plot(x, [np.nanmedian(row) for row in rows], label=label or None)
        if drawn:
            low, high = ([np.nanquantile(row, part) for row in rows] for part in (0.05, 0.95))
            axes.fill_between(x, low, high, color=line.get_color(), alpha=_BAND, linewidth=0)
    values = np.unique(keys[along])
    if len(values) > 2 and values[0] > 0 and values[-1] > 20 * values[0]:
        axes.set_xscale("log")
    axes.set_xlabel(along)
    axes.set_ylabel(_label(quantity))
    if rest:
        axes.legend()
    return axes


def _label(quantity: str) -> str:
    unit = QUANTITIES[quantity][0]
    name = quantity.removesuffix("_" + unit.lower().replace("/", "_").replace(" ", "_")).replace("_", " ")
    return name if unit == "1" else f"{name} [{unit}]"
