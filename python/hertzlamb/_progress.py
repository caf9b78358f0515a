"""Progress reporting: a callback or a progress bar."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator
from typing import Any, Protocol

Progress = bool | Callable[[int, int], object] | None
"""None or False: nothing is told. True: a bar. A function is called with what is done and how much there is."""


class _Bar(Protocol):
    def __call__(self, done: int, total: int) -> object: ...

    def close(self) -> None: ...


class _Tqdm:
    """The bar of tqdm, in a terminal or a notebook."""

    def __init__(self, make: Callable[..., Any]) -> None:
        self._make, self._bar = make, None

    def __call__(self, done: int, total: int) -> None:
        if self._bar is None:
            self._bar = self._make(total=total)
        bar: Any = self._bar
        if bar.total != total:
            bar.reset(total=total)
        bar.update(done - bar.n)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()


class _Line:
    """A line on standard error that is written over."""

    def __init__(self) -> None:
        self._shown = ""

    def __call__(self, done: int, total: int) -> None:
        filled = 40 * done // max(total, 1)
        line = f"[{'=' * filled}{' ' * (40 - filled)}] {done} of {total}"
        if line != self._shown:
            sys.stderr.write("\r" + line)
            sys.stderr.flush()
            self._shown = line

    def close(self) -> None:
        if self._shown:
            sys.stderr.write("\n")


def _bar() -> _Bar:
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return _Line()
    return _Tqdm(tqdm)


@contextlib.contextmanager
def told(progress: Progress) -> Iterator[Callable[[int, int], object] | None]:
    """The function to call, closed when the work is over."""
    if progress is None or progress is False:
        yield None
    elif progress is True:
        bar = _bar()
        try:
            yield bar
        finally:
            bar.close()
    else:
        yield progress
