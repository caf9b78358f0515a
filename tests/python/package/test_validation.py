"""docs/validation.md: every row is within its bound, and the tables that stand there are what scripts/validate prints."""

import math
import re
import sys

import pytest

from conftest import ROOT

sys.path.insert(0, str(ROOT / "scripts"))
pytest.importorskip("scipy")
import validate  # noqa: E402
from validation.table import Curve, Row  # noqa: E402

pytestmark = pytest.mark.filterwarnings("ignore::hertzlamb.HertzlambWarning")

TEXT = validate.DOCUMENT.read_text(encoding="utf-8")
QUICK = [table for table in validate.TABLES if table.quick]
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
DIFFERENCE = 3  # its digits may be those of rounding: the bound beside it is what holds


def standing(name):
    """The cells of a table as it stands in the document, without its header."""
    found = re.findall(rf"<!-- table {name}: .*? -->\n(.*?)<!-- end -->", TEXT, flags=re.DOTALL)
    assert len(found) == 1, f"docs/validation.md has {len(found)} tables {name}"
    lines = [line for line in found[0].splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]


def same(one, other):
    """Whether two cells agree but for the last digit of their numbers."""
    if NUMBER.sub("#", one) != NUMBER.sub("#", other):
        return False
    numbers = zip(NUMBER.findall(one), NUMBER.findall(other))
    return all(math.isclose(float(a), float(b), rel_tol=2e-5, abs_tol=1e-12) for a, b in numbers)


@pytest.mark.parametrize("table", QUICK, ids=lambda table: table.name)
def test_rows_hold_and_stand_in_the_document(table):
    table.run()
    assert table.rows
    assert [row.cells() for row in table.rows if not row.fits()] == []
    found = standing(table.name)
    wanted = [row.cells() for row in table.rows]
    assert [cells[0] for cells in found] == [cells[0] for cells in wanted]
    for there, here in zip(found, wanted):
        kept = [i for i in range(len(here)) if i != DIFFERENCE]
        assert all(same(there[i], here[i]) for i in kept), f"`scripts/validate --write` changes\n{there}\nto\n{here}"


def test_optional_tables_stand_in_the_document():
    for table in validate.TABLES:
        assert len(standing(table.name)) > 0, table.name


def test_a_row_outside_its_bound_does_not_fit():
    assert Row("", 2.0, "", 2.02, 0.011).fits()
    assert not Row("", 2.0, "", 2.02, 0.009).fits()
    assert not Row("", 2.0, "", math.nan, 1.0).fits()
    assert not Row("", 2.0, "", 1.0, 0.1, scale=5.0).fits()
    assert not Curve("", "", 2e-9, 1e-9).fits()
    assert not same("1.2345 m", "1.2346 m") and same("1.23456 m", "1.23457 m") and not same("1 s", "1 m")
