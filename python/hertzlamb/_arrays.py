"""Arrays of the caller as plain numbers or words, without dropping a mask, a unit, a date or an imaginary part."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from hertzlamb._errors import DomainError, HertzlambError, SceneError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Floats = NDArray[np.float64]
    Wrong = Callable[[str, str], HertzlambError]

MOST = 10_000_000
"""Entries of an array at most that becomes a list, and of a list that becomes an array."""

_NOT_NUMBERS = {
    "b": "true or false",
    "c": "complex",
    "m": "time differences of numpy: divide them by np.timedelta64(1, 's')",
    "M": "dates of numpy: subtract the first and divide by np.timedelta64(1, 's')",
    "S": "bytes",
    "V": "records",
}
"""Kinds of numpy's types that are not numbers, in words."""


def _of_scene(name: str, why: str) -> HertzlambError:
    return SceneError(f"{name} {why}", key=name)


def _of_argument(name: str, why: str) -> HertzlambError:
    return DomainError(f"{name} {why}", argument=name)


def numbers(**given: ArrayLike) -> tuple[tuple[int, ...], list[Floats]]:
    """Arguments of a function broadcast together: their shape, and each of them in that shape, flat; a masked entry is NaN."""
    arrays = np.broadcast_arrays(*(_plain(name, values, _of_argument) for name, values in given.items()))
    return arrays[0].shape, [np.ascontiguousarray(array).reshape(-1) for array in arrays]


def of_key(name: str, values: ArrayLike) -> NDArray[Any]:
    """Values of a scene key as floats or words; a masked entry is NaN, so that its row fails."""
    array = _array(name, values, _of_scene)
    is_words = array.dtype.kind in "UT" or (
        array.dtype.kind == "O" and array.size > 0 and all(isinstance(each, str) for each in array.flat)
    )
    if not is_words:
        return _plain(name, values, _of_scene)
    if np.ma.is_masked(array):
        raise _of_scene(name, "has masked words: leave them out, or compute them apart")
    return np.asarray(array, dtype=np.str_)


def listed(name: str, value: Any) -> Any:
    """An array or a scalar in a scene as what Python has for it: a number, a word, or a list of such."""
    array = _array(name, value, _of_scene)
    _refuse_kind(name, array, _of_scene, allowed="b")
    if np.ma.is_masked(array):
        raise _of_scene(name, "has masked entries: fill them, or leave them out")
    if array.size > MOST:
        raise _of_scene(name, f"has {array.size} entries, more than {MOST}")
    return array.tolist()


def _array(name: str, values: Any, wrong: Wrong) -> NDArray[Any]:
    """The values as an array of numpy, with its mask."""
    unit = getattr(values, "unit", getattr(values, "units", None))
    if unit is not None and hasattr(values, "to"):
        raise wrong(name, f"has the unit {unit}: give plain numbers in the unit that the name ends with")
    is_list = isinstance(values, (list, tuple, range))
    if is_list and len(values) > MOST:
        raise wrong(name, f"has {len(values)} entries, more than {MOST} of a list: give an array of numpy")
    is_masked = is_list and any(isinstance(each, np.ma.MaskedArray) for each in values)
    try:
        array: NDArray[Any] = np.ma.asanyarray(values) if is_masked else np.asanyarray(values)
    except ValueError as error:
        raise wrong(name, f"is not an array: {error}") from None
    return array if isinstance(array, np.ma.MaskedArray) else np.asarray(array)


def _refuse_kind(name: str, array: NDArray[Any], wrong: Wrong, allowed: str = "") -> None:
    kind = array.dtype.kind
    if kind in _NOT_NUMBERS and kind not in allowed:
        raise wrong(name, f"of type {array.dtype} is not numbers but {_NOT_NUMBERS[kind]}")


def _plain(name: str, values: ArrayLike, wrong: Wrong) -> Floats:
    array = _array(name, values, wrong)
    _refuse_kind(name, array, wrong)
    mask = np.ma.getmask(array)
    bare = np.ma.getdata(array)
    if bare.dtype.kind in "OUT":
        floats = np.array([_number(name, each, wrong) for each in bare.flat], dtype=np.float64).reshape(bare.shape)
    else:
        floats = np.asarray(bare, dtype=np.float64)
    return floats if mask is np.ma.nomask else np.where(mask, np.nan, floats)


def _number(name: str, value: Any, wrong: Wrong) -> float:
    """A number of Python; one beyond all floats is infinite, as in a scene."""
    try:
        return float("nan" if value is None else value)
    except OverflowError:
        return float("inf") if value > 0 else -float("inf")
    except (TypeError, ValueError):
        raise wrong(name, f"= {str(value)[:60]!r} is not a number") from None
