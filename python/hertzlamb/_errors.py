"""Exceptions, with the values in their messages as attributes."""

from __future__ import annotations

import re
from typing import Any

_NUMBER = re.compile(r"[-+]?\d[\d.]*(?:e[-+]?\d+)?")


class _Sentence(str):
    """A message that equals another one if they differ in numbers only, so that Python's filters count both as one."""

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
    """A doubt about a result: physics beyond its validity, or an error above the tolerance.

    Python's default filter prints each kind once for each line of your program, whatever numbers it contains: a loop
    prints it once. ``run.warnings`` has all of them.
    """

    def __str__(self) -> str:
        return _Sentence(super().__str__())


class HertzlambError(Exception):
    """Base of all exceptions of this package."""

    def __init__(self, message: str, **fields: Any) -> None:
        super().__init__(message)
        for name, value in fields.items():
            setattr(self, name, value)

    def __reduce__(self) -> tuple[Any, ...]:
        return _again, (type(self), self.args, dict(self.__dict__))


def _again(kind: type[HertzlambError], arguments: tuple[str], fields: dict[str, Any]) -> HertzlambError:
    return kind(*arguments, **fields)


class SceneError(HertzlambError, ValueError):
    """A scene, a sweep or a grid that cannot be run.

    Attributes
    ----------
    key : str or None
        Full name of the key at fault, such as ``"striker.mass_kg"``.
    value : float or str or None
        The value found.
    suggestion : str or None
        The nearest name that exists.
    file : str or None
        The file at fault.
    """

    key: str | None = None
    value: float | str | None = None
    suggestion: str | None = None
    file: str | None = None


class OutsideTable(HertzlambError, ValueError):
    """A place or a Poisson's ratio that a kernel table does not serve.

    Attributes
    ----------
    axis : str
        ``"r/r0"``, ``"z/r0"``, ``"poisson_ratio"`` or ``"coarsening"``.
    value, low, high : float
        The value asked for and the range that the table serves.
    file : str or None
        The table.
    """

    axis: str
    value: float
    low: float
    high: float
    file: str | None = None


class DomainError(HertzlambError, ValueError):
    """A number or a name outside the range of an argument.

    Attributes
    ----------
    argument : str or None
        Name of the argument.
    value : float or str or None
        The value received.
    range : str or None
        The allowed range in interval notation, or the allowed names.
    """

    argument: str | None = None
    value: float | str | None = None
    range: str | None = None


class ImpactError(HertzlambError, ValueError):
    """An impact without results: the contact could not be solved, or a number is beyond the physics."""


class TooMuchMemory(HertzlambError, MemoryError):
    """Work that needs more memory than it may take; nothing was begun."""


class BadTable(HertzlambError, OSError):
    """A file that is no kernel table, or a damaged one.

    Attributes
    ----------
    file : str or None
        The file.
    """

    file: str | None = None

    def __str__(self) -> str:
        return str(self.args[0])


class OutputError(HertzlambError, OSError):
    """A file that could not be written; what was there is untouched.

    Attributes
    ----------
    file : str or None
        The file.
    """

    file: str | None = None

    def __str__(self) -> str:
        return str(self.args[0])


class OutputExists(OutputError, FileExistsError):
    """A file that exists already and was not to be replaced."""


class WorkError(HertzlambError, RuntimeError):
    """Work that failed for another reason."""


class ForkError(HertzlambError, RuntimeError):
    """A process forked from one that had begun to compute: its threads do not survive a fork."""
