"""Checks the numbered equations of docs/theory.md by independent calculations: called by scripts/check-theory.

A row contains the equation, its comparison, the largest error and the stated bound.
A bound with > belongs to a form that must not hold, such as a misprint of the source paper.
Errors are relative unless the quantity is of order one.
"""

import sys
from pathlib import Path

from theory import attenuation, energy, faces, fields, impact, inversion, noise, oracle, plastic, plates, radiation, responses, surface, transforms
from theory.report import Report


def main():
    report = Report()
    for section in (transforms, fields, plates, faces, responses, inversion, noise, oracle, attenuation, surface, impact, radiation, plastic, energy):
        section.check(report)
    report.compare_with((Path(__file__).resolve().parent.parent / "docs" / "theory.md").read_text(encoding="utf-8"))
    return report.end()


if __name__ == "__main__":
    sys.exit(main())
