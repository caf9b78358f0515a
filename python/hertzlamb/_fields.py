"""The six fields of the half-space as one mapping."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

FIELDS = ("displacement_r", "displacement_z", "stress_rr", "stress_tt", "stress_zz", "stress_rz")
"""Names of the fields, in the order of the last axis of `Fields.array`."""


class Fields(Mapping[str, "Floats"]):
    """Mapping of the six fields by name, each a read-only array of shape (...).

    Write ``fields["stress_zz"]`` or ``fields.stress_zz``. The names are ``displacement_r``, ``displacement_z``,
    ``stress_rr``, ``stress_tt``, ``stress_zz`` and ``stress_rz``. Displacements are in P/(mu r0), stresses in P/r0^2,
    unless the function that returns the fields documents other units.

    Attributes
    ----------
    array : ndarray, shape (..., 6)
        The six fields in this order; the named fields are views into it.

    Raises
    ------
    KeyError
        The name is not one of the six.
    """

    __slots__ = ("array",)

    array: Floats

    def __init__(self, array: Floats) -> None:
        array.setflags(write=False)
        self.array = array

    def __getitem__(self, name: str) -> Floats:
        try:
            return self.array[..., FIELDS.index(name)]
        except ValueError:
            raise KeyError(f"{name!r} is not one of {', '.join(FIELDS)}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(FIELDS)

    def __len__(self) -> int:
        return len(FIELDS)

    @property
    def displacement_r(self) -> Floats:
        """Radial displacement (...), positive away from the axis."""
        return self.array[..., 0]

    @property
    def displacement_z(self) -> Floats:
        """Axial displacement (...), positive into the half-space."""
        return self.array[..., 1]

    @property
    def stress_rr(self) -> Floats:
        """Radial stress (...), negative in compression."""
        return self.array[..., 2]

    @property
    def stress_tt(self) -> Floats:
        """Hoop stress (...), negative in compression."""
        return self.array[..., 3]

    @property
    def stress_zz(self) -> Floats:
        """Axial stress (...), negative in compression."""
        return self.array[..., 4]

    @property
    def stress_rz(self) -> Floats:
        """Shear stress (...) in the plane of r (outwards) and z (into the half-space)."""
        return self.array[..., 5]

    def __repr__(self) -> str:
        return f"Fields of shape {self.array.shape[:-1]}: {', '.join(FIELDS)}"

    def __getstate__(self) -> dict[str, Any]:
        return {"array": self.array}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__init__(state["array"])  # type: ignore[misc]
