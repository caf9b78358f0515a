"""Compares the program with published numbers: called by scripts/validate.

A row contains a published number, its source, our result, the difference over the published number (over the largest value if
there are several), the bound, and the reason for the difference.
"""

import argparse
import importlib.util
import re
import sys
from pathlib import Path

from validation import dashpot, impacts, inside, plastic, radiation, surface
from validation.table import Table

DOCUMENT = Path(__file__).resolve().parent.parent / "docs" / "validation.md"

TABLES = [
    Table("radiation", "radiated energy", radiation.radiation),
    Table("harmonic", "a disc under a harmonic force", radiation.harmonic),
    Table("surface", "the surface under a point force, the loaded disc", surface.closed),
    Table("programs", "other programs: SW4, CPS", surface.programs),
    Table("static", "static field", inside.static),
    Table("fronts", "the first front on the axis", inside.fronts),
    Table("impacts", "contact times, forces, loss", impacts.impacts),
    Table("measured", "measurements and formulas in use", impacts.measured),
    Table("dashpot", "the area dashpot of particle codes", dashpot.dashpot),
    Table("plastic", "contacts that yield", plastic.plastic),
    Table("lammps", "LAMMPS, run here", dashpot.lammps, quick=False, needs="lammps"),
    Table("pygrt", "pygrt-kit, run here", surface.package, quick=False, needs="pygrt"),
]


def put(text, table):
    """The document's text with a table between its marks."""
    pattern = rf"(<!-- table {table.name}: .*? -->\n).*?(<!-- end -->)"
    found = re.subn(pattern, lambda m: f"{m[1]}\n{table.markdown()}\n\n{m[2]}", text, flags=re.DOTALL)
    if found[1] != 1:
        raise SystemExit(f"docs/validation.md has {found[1]} places for the table {table.name}, not one")
    return found[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--markdown", action="store_true")
    parser.add_argument("--write", action="store_true")
    args = parser.parse_args()
    outside = rows = 0
    for table in TABLES:
        if args.quick and not table.quick:
            continue
        if table.needs and importlib.util.find_spec(table.needs) is None:
            print(f"{table.title}: skipped, there is no Python package {table.needs}", file=sys.stderr)
            continue
        table.run()
        rows += len(table.rows)
        outside += sum(not row.fits() for row in table.rows)
        print(f"\n{table.title}\n\n{table.markdown() if args.markdown else table.text()}", flush=True)
        if args.write:
            DOCUMENT.write_text(put(DOCUMENT.read_text(encoding="utf-8"), table), encoding="utf-8")
    print(f"\n{rows} rows, {outside} outside their bounds", file=sys.stderr if args.markdown else sys.stdout)
    return 1 if outside else 0


if __name__ == "__main__":
    sys.exit(main())
