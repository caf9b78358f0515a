"""Table of the checks."""

import math
import re

import numpy as np


def relative(found, exact):
    """Largest difference over the largest value."""
    found, exact = np.asarray(found), np.asarray(exact)
    return np.max(abs(found - exact)) / np.max(abs(exact))


class Report:
    """Rows `equation | comparison | error`, and whether all errors are within their bounds."""

    def __init__(self):
        self.rows = 0
        self.failed = []
        self.equations = set()
        print(f"{'equation':10} | {'comparison':92} | {'error':>8} | {'bound':>7}")
        print(f"{'-' * 10} | {'-' * 92} | {'-' * 8} | {'-' * 7}")

    def row(self, equation, what, error, bound):
        """One comparison; an error that is not a number fails."""
        self._add(equation, what, error, f"{bound:7.0e}", "" if float(error) <= bound else "  TOO LARGE")

    def fails(self, equation, what, error, least):
        """A form that must not hold, such as a misprint: its error has to be at least so large."""
        self._add(equation, what, error, f">{least:6.0e}", "" if float(error) >= least else "  TOO SMALL")

    def _add(self, equation, what, error, bound, mark):
        self.equations.update(equation.split(", "))
        self.rows += 1
        if mark or not math.isfinite(float(error)):
            self.failed.append((equation, what))
        print(f"{equation:10} | {what:92} | {float(error):8.1e} | {bound}{mark}", flush=True)

    def compare_with(self, text):
        """Every equation of the document has to have a row, and every row an equation."""
        anchors = re.findall(r'<a id="(T\d+)"></a>', text)
        missing = [name for name in anchors if name not in self.equations]
        unknown = sorted(name for name in self.equations if name.startswith("T") and name not in anchors)
        for name in missing:
            self.failed.append((name, "no comparison"))
        for name in unknown:
            self.failed.append((name, "not in the document"))
        # a number stays with its equation, wherever in the document it is put
        if set(anchors) != {f"T{i + 1}" for i in range(len(anchors))}:
            self.failed.append(("anchors", "are not T1, T2, ..., each once"))
        for name in set(re.findall(r"\((T\d+)\)", text)) - set(anchors):
            self.failed.append((name, "cited in the document, not in it"))
        print(f"{len(anchors)} equations, {len(missing)} without a comparison")

    def end(self):
        """Prints the outcome and returns the exit code."""
        for equation, what in self.failed:
            print(f"failed: {equation}: {what}")
        print(f"{self.rows} comparisons, {len(self.failed)} failed")
        return 1 if self.failed else 0
