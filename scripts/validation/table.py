"""Rows of the comparisons, and their tables as text and Markdown."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field


@dataclass
class Row:
    """One number: published value, our result, bound on the difference, and reason for the difference."""

    quantity: str
    published: float
    source: str
    ours: float
    bound: float
    why: str = ""
    scale: float | None = None
    """What the difference is divided by: the published number without it."""
    digits: int = 6

    @property
    def difference(self) -> float:
        scale = abs(self.published) if self.scale is None else self.scale
        return (self.ours - self.published) / scale

    def cells(self) -> list[str]:
        show = f".{self.digits}g"
        return [
            self.quantity,
            f"{self.published:{show}} ({self.source})",
            f"{self.ours:{show}}",
            rounded(self.difference),
            power(self.bound),
            self.why,
        ]

    def fits(self) -> bool:
        return math.isfinite(self.difference) and abs(self.difference) <= self.bound


@dataclass
class Curve:
    """Many values of one kind at once: the largest difference over the largest value."""

    quantity: str
    source: str
    difference: float
    bound: float
    why: str = ""

    def cells(self) -> list[str]:
        return [self.quantity, self.source, "the same", rounded(self.difference), power(self.bound), self.why]

    def fits(self) -> bool:
        return math.isfinite(self.difference) and abs(self.difference) <= self.bound


def rounded(difference: float) -> str:
    """Two digits with a sign; a rounding error is marked as such, because its digits depend on the machine."""
    return "rounding" if abs(difference) < 2e-12 else f"{difference:+.1e}".replace("e-0", "e-").replace("e+00", "")


def power(bound: float) -> str:
    return f"{bound:g}".replace("e-0", "e-")


HEADER = ["quantity", "published (source)", "hertzlamb", "difference", "bound", "why they differ"]


@dataclass
class Table:
    """Rows with a name, by which docs/validation.md finds them."""

    name: str
    title: str
    make: Callable[[], list[Row | Curve]]
    quick: bool = True
    """Seconds: `tests/python/package/test_validation.py` runs it."""
    needs: str | None = None
    """A package without which it is skipped."""
    rows: list[Row | Curve] = field(default_factory=list)

    def run(self) -> None:
        self.rows = self.make()

    def markdown(self) -> str:
        lines = [HEADER, ["---"] * len(HEADER), *(row.cells() for row in self.rows)]
        return "\n".join("| " + " | ".join(cells) + " |" for cells in lines)

    def text(self) -> str:
        cells = [HEADER, *(row.cells() for row in self.rows)]
        widths = [max(len(line[i]) for line in cells) for i in range(len(HEADER))]
        lines = [" | ".join(c.ljust(w) for c, w in zip(line, widths)).rstrip() for line in cells]
        lines.insert(1, "-+-".join("-" * w for w in widths))
        marks = ["", "", *("" if row.fits() else "   OUTSIDE ITS BOUND" for row in self.rows)]
        return "\n".join(line + mark for line, mark in zip(lines, marks))
