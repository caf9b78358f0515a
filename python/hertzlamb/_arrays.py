"""Conversion of arguments to plain arrays; a mask, unit, date or imaginary part raises an error or becomes NaN."""

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
"""Largest number of entries converted from an array to a list, or from a list to an array."""

_NOT_NUMBERS = {
    "b": "true or false",
    "c": "complex",
    "m": "time differences of numpy: divide them by np.timedelta64(1, 's')",
    "M": "dates of numpy: subtract the first and divide by np.timedelta64(1, 's')",
    "S": "bytes",
    "V": "records",
}
"""Descriptions of numpy types that are not numbers, by the kind of the type."""


def _of_scene(name: str, why: str) -> HertzlambError:
    return SceneError(f"{name} {why}", key=name)


def _of_argument(name: str, why: str) -> HertzlambError:
    return DomainError(f"{name} {why}", argument=name)


def numbers(**given: ArrayLike) -> tuple[tuple[int, ...], list[Floats]]:
    """Broadcasts the arguments; returns the common shape and each argument flattened. A masked entry becomes NaN."""
    arrays = np.broadcast_arrays(*(_plain(name, values, _of_argument) for name, values in given.items()))
    return arrays[0].shape, [np.ascontiguousarray(array).reshape(-1) for array in arrays]


def of_key(name: str, values: ArrayLike) -> NDArray[Any]:
    """Converts the values of a scene key to floats or words. A masked number becomes NaN, so that its row fails."""
    array = _array(name, values, _of_scene)
    is_words = array.dtype.kind in "UT" or (
        array.dtype.kind == "O" and array.size > 0 and all(isinstance(each, str) for each in array.flat)
    )
    if not is_words:
        return _plain(name, values, _of_scene)
    if np.ma.is_masked(array):
        raise _of_scene(name, "has masked words: remove them, or compute them separately")
    return np.asarray(array, dtype=np.str_)


def listed(name: str, value: Any) -> Any:
    """Converts an array or scalar of a scene to plain Python: a number, a string, or a list of them."""
    array = _array(name, value, _of_scene)
    _refuse_kind(name, array, _of_scene, allowed="b")
    if np.ma.is_masked(array):
        raise _of_scene(name, "has masked entries: fill or remove them")
    if array.size > MOST:
        raise _of_scene(name, f"has {array.size} entries, more than the limit of {MOST}")
    return array.tolist()


def _array(name: str, values: Any, wrong: Wrong) -> NDArray[Any]:
    """Converts the values to a numpy array and keeps a mask."""
    unit = getattr(values, "unit", getattr(values, "units", None))
    if unit is not None and hasattr(values, "to"):
        raise wrong(name, f"has the unit {unit}: pass plain numbers in the unit at the end of the name")
    is_list = isinstance(values, (list, tuple, range))
    if is_list and len(values) > MOST:
        raise wrong(name, f"has {len(values)} entries; a list may have {MOST}: pass a numpy array")
    is_masked = is_list and any(isinstance(each, np.ma.MaskedArray) for each in values)
    try:
        array: NDArray[Any] = np.ma.asanyarray(values) if is_masked else np.asanyarray(values)
    except ValueError as error:
        raise wrong(name, f"is not an array: {error}") from None
    return array if isinstance(array, np.ma.MaskedArray) else np.asarray(array)


def _refuse_kind(name: str, array: NDArray[Any], wrong: Wrong, allowed: str = "") -> None:
    kind = array.dtype.kind
    if kind in _NOT_NUMBERS and kind not in allowed:
        raise wrong(name, f"of type {array.dtype} contains no numbers but {_NOT_NUMBERS[kind]}")


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
    """Converts a Python number to a float; a number too large for a float becomes infinite, as in a scene."""
    try:
        return float("nan" if value is None else value)
    except OverflowError:
        return float("inf") if value > 0 else -float("inf")
    except (TypeError, ValueError):
        raise wrong(name, f"= {str(value)[:60]!r} is not a number") from None
