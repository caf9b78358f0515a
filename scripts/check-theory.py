"""Checks the numbered equations of docs/theory.md by independent calculations: called by scripts/check-theory.

A row contains the equation, its comparison, the largest error and the stated bound.
A bound with > belongs to a form that must not hold, such as a misprint of the source paper.
Errors are relative unless the quantity is of order one.
"""

import sys
from pathlib import Path

<<<<<<< HEAD
from theory import energy, fields, impact, plastic, plates, radiation, responses, surface, transforms
=======
from theory import energy, fields, impact, inversion, plastic, plates, radiation, surface, transforms
>>>>>>> inv
from theory.report import Report


def main():
    report = Report()
<<<<<<< HEAD
    for section in (transforms, fields, plates, responses, surface, impact, radiation, plastic, energy):
=======
    for section in (transforms, fields, plates, surface, impact, radiation, plastic, energy, inversion):
>>>>>>> inv
        section.check(report)
    report.compare_with((Path(__file__).resolve().parent.parent / "docs" / "theory.md").read_text(encoding="utf-8"))
    return report.end()


if __name__ == "__main__":
    sys.exit(main())
