"""Exceptions, with the values in their messages as attributes."""

from __future__ import annotations

import re
from typing import Any

_NUMBER = re.compile(r"[-+]?\d[\d.]*(?:e[-+]?\d+)?")


class _Sentence(str):
    """A message that equals every message with the same words, whatever the numbers.

    Python's warning filters compare messages, so a loop prints each kind of warning once.
    """

    __slots__ = ()

    def _kind(self) -> str:
        return _NUMBER.sub("#", str.__str__(self))

    def __eq__(self, other: object) -> bool:
        return self._kind() == other._kind() if isinstance(other, _Sentence) else str.__eq__(self, other)

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return hash(self._kind())


class HertzlambWarning(UserWarning):
    """Warning about a result: the physics is beyond its validity, an error exceeds the tolerance, or rows failed.

    Two warnings of one kind differ only in their numbers. Python's default filter prints each kind once per line of
    your program, so a loop prints it once. `Impact.warnings` contains all warnings of an impact.
    """

    def __str__(self) -> str:
        return _Sentence(super().__str__())


class HertzlambError(Exception):
    """Base class of all exceptions of this package.

    The values in the message are attributes of the exception. Exceptions can be pickled.
    """

    def __init__(self, message: str, **fields: Any) -> None:
        super().__init__(message)
        for name, value in fields.items():
            setattr(self, name, value)

    def __reduce__(self) -> tuple[Any, ...]:
        return _again, (type(self), self.args, dict(self.__dict__))


def _again(kind: type[HertzlambError], arguments: tuple[str], fields: dict[str, Any]) -> HertzlambError:
    return kind(*arguments, **fields)


class SceneError(HertzlambError, ValueError):
    """Invalid scene, sweep or grid.

    Attributes
    ----------
    key : str or None
        Full name of the invalid key, such as ``"striker.mass_kg"``.
    value : float or str or None
        Rejected value.
    range : str or None
        Allowed range in interval notation, or the allowed names.
    suggestion : str or None
        Nearest name that exists.
    file : str or None
        Path of the file that contains the error; None for a dictionary or text.
    """

    key: str | None = None
    value: float | str | None = None
    range: str | None = None
    suggestion: str | None = None
    file: str | None = None


class OutsideTable(HertzlambError, ValueError):
    """Point, Poisson's ratio or coarsening outside the range of a kernel table.

    Attributes
    ----------
    axis : str
        ``"r/r0"``, ``"z/r0"``, ``"poisson_ratio"`` or ``"coarsening"``.
    value : float
        Requested value on that axis.
    low, high : float
        Range of the table on that axis.
    file : str or None
        Path of the table.
    """

    axis: str
    value: float
    low: float
    high: float
    file: str | None = None


class DomainError(HertzlambError, ValueError):
    """Argument of a function outside its range.

    Attributes
    ----------
    argument : str or None
        Name of the argument.
    value : float or str or None
        Rejected value.
    range : str or None
        Allowed range in interval notation, or the allowed names.
    """

    argument: str | None = None
    value: float | str | None = None
    range: str | None = None


class ImpactError(HertzlambError, ValueError):
    """Impact without results: the contact cannot be solved, or a result is outside the range of the physics.

    Attributes
    ----------
    key : str or None
        Name of the key or measure to change, such as ``"velocity_m_s"``.
    value : float or str or None
        Its value.
    range : str or None
        Allowed range in interval notation.
    """

    key: str | None = None
    value: float | str | None = None
    range: str | None = None


class TooMuchMemory(HertzlambError, MemoryError):
    """Computation that needs more memory than is free, or more than ``max_memory_gb``; usually raised before it starts."""


class BadTable(HertzlambError, OSError):
    """File that is not a kernel table, is damaged, or has an unknown format version.

    Attributes
    ----------
    file : str or None
        Path of the file.
    """

    file: str | None = None

    def __str__(self) -> str:
        return str(self.args[0])


class OutputError(HertzlambError, OSError):
    """File that could not be written; an existing file of that name is unchanged.

    Attributes
    ----------
    file : str or None
        Path of the file.
    """

    file: str | None = None

    def __str__(self) -> str:
        return str(self.args[0])


class OutputExists(OutputError, FileExistsError):
    """Output file that exists already; pass ``overwrite=True`` to replace it."""


class WorkError(HertzlambError, RuntimeError):
    """Computation that failed for another reason, such as a fault of the program."""


class ForkError(HertzlambError, RuntimeError):
    """Call in a process that was forked from one that had already computed.

    The threads of the package do not survive a fork. Start processes with the method ``spawn`` or ``forkserver``.
    """
