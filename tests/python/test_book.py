"""The book: its commands run and print what it says, and every link leads somewhere."""

import shlex
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import PROGRAM, ROOT

sys.path.insert(0, str(ROOT / "scripts"))
import book  # noqa: E402


@pytest.mark.parametrize("chapter", book.CHAPTERS, ids=lambda chapter: chapter.stem)
def test_a_chapter_runs_as_it_stands(chapter, tmp_path):
    book.run_chapter(chapter, tmp_path, PROGRAM)
    for name in book.pictures(chapter):
        drawn, kept = tmp_path / name, book.PICTURES / name
        assert drawn.stat().st_size > 5000, name
        assert kept.exists(), f"{name}: scripts/book --pictures draws it"


@pytest.mark.parametrize("page", book.PAGES, ids=lambda page: page.stem)
def test_the_commands_of_a_page_run(page, tmp_path):
    book.run_chapter(page, tmp_path, PROGRAM)


def test_the_reference_of_the_benchmark_is_what_the_program_computes(tmp_path):
    chapter = book.ROOT / "docs/benchmark.md"
    assert book.tables(chapter) == ["benchmark.csv"]
    book.run_chapter(chapter, tmp_path, PROGRAM)
    made, kept = (np.loadtxt(path, delimiter=",", skiprows=1) for path in (tmp_path / "benchmark.csv", chapter.with_name("benchmark.csv")))
    assert made.shape == kept.shape
    for point in range(1, 6):
        a, b = (rows[rows[:, 0] == point] for rows in (made, kept))
        # what vanishes on the axis and at the surface is rounding
        off, largest = np.abs(a[:, 1:8] - b[:, 1:8]).max(axis=0), np.abs(b[:, 1:8]).max(axis=0)
        assert (off <= 1e-6 * np.maximum(largest, [0, *[1e-12] * 2, *[1e-3] * 4])).all(), point


def test_every_command_and_notebook_has_its_page(tmp_path):
    book.reference.main(PROGRAM, tmp_path / "reference")
    made = {str(path.relative_to(tmp_path)) for path in tmp_path.rglob("*.md")}
    listed = set(book.LINK.findall((book.ROOT / "docs/SUMMARY.md").read_text()))
    assert made <= listed, made - listed
    page = (tmp_path / "reference/python.md").read_text()
    assert "### impact" in page and "**Parameters**" in page and "### OutsideTable" in page


def test_every_picture_of_a_chapter_is_drawn_by_it():
    for chapter in book.CHAPTERS:
        shown = {target for target in book.LINK.findall(chapter.read_text()) if "pictures/" in target}
        assert {Path(target).name for target in shown} == set(book.pictures(chapter)), chapter


def test_links_between_documents_lead_somewhere():
    assert book.broken_links() == []


@pytest.mark.parametrize(
    ("told", "printed", "agrees"),
    [
        ("a 1.000\nb", "a 1.0001\nb\n", True),
        ("a 1.000", "a 1.002", False),
        ("a 1...", "a 1 and more", True),
        ("a\n...", "a\nb\nc", True),
        ("a", "a\nb", False),
        ("a\nb", "a", False),
        ("a", "b", False),
    ],
)
def test_what_is_told_is_compared_with_what_is_printed(told, printed, agrees):
    assert (book.difference(told, printed) is None) == agrees


def commands(document):
    """The hertzlamb commands in the shell blocks of a document, as lists of words."""
    for language, body in book.BLOCK.findall(document.read_text()):
        if language not in ("sh", "bash"):
            continue
        for line in body.replace("\\\n", " ").splitlines():
            words = shlex.split(line, comments=True)
            if words and Path(words[0]).name == "hertzlamb":
                yield words[1:]


TOO_LONG = ["README.md", "docs/guide.md", "docs/cluster.md", "docs/accuracy-and-speed.md"]


@pytest.mark.parametrize("name", TOO_LONG)
def test_what_takes_too_long_to_run_names_options_and_scenes_that_exist(name):
    found = list(commands(ROOT / name))
    assert found
    for words in found:
        parts = [words[0], *(word for word in words[1:2] if word in ("info", "verify", "merge", "diff", "status"))]
        shown = subprocess.run([PROGRAM, *parts, "--help"], capture_output=True, text=True)
        assert shown.returncode == 0, words
        for word in words[1:]:
            option = word.split("=")[0]
            assert not option.startswith("--") or option in shown.stdout, words
            assert not word.startswith("scenes/") or (ROOT / word).exists(), words


def test_the_readme_has_the_first_scene():
    text = (ROOT / "README.md").read_text()
    assert f"```toml\n{(ROOT / 'scenes/first-impact.toml').read_text()}```" in text
