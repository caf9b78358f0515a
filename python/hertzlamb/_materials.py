"""Materials that a scene can name."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, overload

import numpy as np

from hertzlamb import _core

if TYPE_CHECKING:
    import pandas as pd
    from numpy.typing import NDArray


class Material(NamedTuple):
    """Properties of a material; an unknown property is None."""

    name: str
    """Name, as a scene uses it."""
    group: str
    """Group of materials, such as ``"metal"`` or ``"rock"``."""
    youngs_modulus_pa: float
    """Young's modulus in Pa."""
    poisson_ratio: float
    """Poisson's ratio."""
    density_kg_m3: float | None
    """Density in kg/m^3."""
    longitudinal_speed_m_s: float | None
    """Speed of the longitudinal wave in m/s."""
    shear_speed_m_s: float | None
    """Speed of the shear wave in m/s."""
    yield_strength_pa: float | None
    """Yield strength in Pa."""
    tensile_strength_pa: float | None
    """Tensile strength in Pa."""
    fracture_toughness_pa_sqrt_m: float | None
    """Fracture toughness in Pa m^(1/2)."""
    source: str
    """Source of the values."""


class Materials(Sequence[Material]):
    """Sequence of materials: index a row by number, slice or name; `column` returns a property of all rows.

    A name that is not in the table raises a `KeyError`.

    >>> import hertzlamb as hl
    >>> hl.materials()["granite"].density_kg_m3
    2650.0
    """

    def __init__(self, rows: Sequence[Material]) -> None:
        self._rows = tuple(rows)

    @overload
    def __getitem__(self, which: int | str) -> Material: ...

    @overload
    def __getitem__(self, which: slice) -> Materials: ...

    def __getitem__(self, which: int | str | slice) -> Material | Materials:
        if isinstance(which, slice):
            return Materials(self._rows[which])
        if isinstance(which, str):
            for row in self._rows:
                if row.name == which:
                    return row
            raise KeyError(f"no material {which!r}; the names are in .names")
        return self._rows[which]

    def __len__(self) -> int:
        return len(self._rows)

    def __iter__(self) -> Iterator[Material]:
        return iter(self._rows)

    @property
    def names(self) -> list[str]:
        """Names of the materials, in the order of the rows."""
        return [row.name for row in self._rows]

    def column(self, name: str) -> NDArray[Any]:
        """Property of all materials as an array (row,).

        Parameters
        ----------
        name : str
            An attribute of `Material`, such as ``"density_kg_m3"``.

        Returns
        -------
        ndarray
            Strings for ``name``, ``group`` and ``source``, otherwise floats in the unit of the name, NaN if unknown.

        Raises
        ------
        AttributeError
            There is no property of that name.
        """
        values = [getattr(row, name) for row in self._rows]
        if name in ("name", "group", "source"):
            return np.array(values, dtype=str)
        return np.array([np.nan if value is None else value for value in values], dtype=np.float64)

    def to_pandas(self) -> pd.DataFrame:
        """All properties as a pandas data frame, indexed by name."""
        import pandas as pd

        columns = {name: self.column(name) for name in Material._fields}
        return pd.DataFrame(columns).set_index("name")

    def __repr__(self) -> str:
        lines = [f"{'name':24} {'group':9} {'E [GPa]':>8} {'nu':>6} {'kg/m3':>7} {'c1 m/s':>7} {'c2 m/s':>7}"]
        for row in self._rows:
            speeds = (row.density_kg_m3, row.longitudinal_speed_m_s, row.shear_speed_m_s)
            shown = " ".join(f"{'-' if value is None else format(value, '.0f'):>7}" for value in speeds)
            lines.append(
                f"{row.name:24} {row.group:9} {row.youngs_modulus_pa / 1e9:8.3f} {row.poisson_ratio:6.3f} {shown}"
            )
        return "\n".join(lines)


def materials(search: str = "", *, file: str | os.PathLike[str] | None = None) -> Materials:
    """Lists the materials that a scene can name.

    Parameters
    ----------
    search : str
        Part of a name, a group or a source. Default: all materials.
    file : path, optional
        TOML file with additional materials.

    Returns
    -------
    Materials
        Moduli and strengths in Pa, densities in kg/m^3, wave speeds in m/s, and the source of the values.

    Raises
    ------
    SceneError
        The file cannot be read or contains an invalid material.
    """
    return Materials([Material(**row) for row in _core.materials(search, file)])
