"""The materials that scenes can name."""

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
    """A material; None where a number is not known."""

    name: str
    group: str
    youngs_modulus_pa: float
    poisson_ratio: float
    density_kg_m3: float | None
    longitudinal_speed_m_s: float | None
    shear_speed_m_s: float | None
    yield_strength_pa: float | None
    tensile_strength_pa: float | None
    fracture_toughness_pa_sqrt_m: float | None
    source: str


class Materials(Sequence[Material]):
    """A table of materials: rows by number or name, columns as arrays.

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
        """The names."""
        return [row.name for row in self._rows]

    def column(self, name: str) -> NDArray[Any]:
        """A column as an array, NaN where a number is not known."""
        values = [getattr(row, name) for row in self._rows]
        if name in ("name", "group", "source"):
            return np.array(values, dtype=str)
        return np.array([np.nan if value is None else value for value in values], dtype=np.float64)

    def to_pandas(self) -> pd.DataFrame:
        """The table as a data frame with the names as index."""
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
    """The materials that scenes can name.

    Parameters
    ----------
    search : str
        Part of a name, a group or a source; all of them without it.
    file : path, optional
        A TOML file of further materials.

    Returns
    -------
    Materials
        Moduli and strengths in Pa, densities in kg/m^3, wave speeds in m/s, each with its source.
    """
    return Materials([Material(**row) for row in _core.materials(search, file)])
