"""docs/numbers.md has a row for every revision of the numbers."""

import re

import pytest
from conftest import ROOT


@pytest.mark.parametrize(
    ("heading", "source"),
    [
        ("Fields at points", "crates/impact/src/numbers.rs"),
        ("Results of contacts", "crates/contact/src/numbers.rs"),
        ("Kernel tables", "crates/tabulator/src/numbers.rs"),
    ],
)
def test_every_revision_has_a_row(heading, source):
    today = int(re.search(r"REVISION: u\d+ = (\d+);", (ROOT / source).read_text()).group(1))
    section = (ROOT / "docs/numbers.md").read_text().split(f"## {heading}\n")[1].split("\n## ")[0]
    rows = [int(row) for row in re.findall(r"^\| (\d+) \|", section, re.MULTILINE)]
    assert rows == sorted(rows) and set(rows) == set(range(1, today + 1))
