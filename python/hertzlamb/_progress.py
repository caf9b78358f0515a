"""Progress reporting: a callback or a progress bar."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator
from typing import Any, Protocol

Progress = bool | Callable[[int, int], object] | None
"""None or False: no report. True: a progress bar. A function: called with the work done and the total."""


class _Bar(Protocol):
    def __call__(self, done: int, total: int) -> object: ...

    def close(self) -> None: ...


class _Tqdm:
    """Progress bar of tqdm, for a terminal or a notebook."""

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
    """Progress bar on standard error if tqdm is not installed; each update overwrites the line."""

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
    """Yields the function to call with the progress, or None; closes a bar at the end."""
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
