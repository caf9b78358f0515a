"""The book: runs the commands in chapters, checks links, and prepares the pages.

Usage: book.py run [--pictures] [CHAPTER...]   runs the commands in chapters; --pictures stores their pictures
       book.py links                           checks every link between documents
       book.py source FOLDER PROGRAM           copies the documents to a folder for mdBook, with formulas as MathML and the
                                               pages of reference.py
       book.py pages FOLDER                    checks every link of finished pages

A TOML block that begins with `# file: NAME` is written to that file. Blocks of sh and Python are run in a folder with the
scenes, except blocks that begin with `# not run: REASON`. Both notes may also be in the line before the block, as
`<!-- file: NAME -->`. A text block after a block that is run is its expected output: `...` matches anything, and numbers may
have a relative difference of 1e-3.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

import reference

ROOT = Path(__file__).resolve().parent.parent
# they draw every picture that they show
CHAPTERS = [
    *(ROOT / f"docs/{name}.md" for name in ("first-impact", "hertz-and-lamb", "gallery", "benchmark")),
    *sorted((ROOT / "docs/cases").glob("*.md")),
]
# their commands run, too
PAGES = [ROOT / "README.md", ROOT / "docs/errors.md"]
PICTURES = ROOT / "docs/pictures"
# what the book holds beside docs/: as in the repository, so that links hold in both
SHELVES = ["docs", "data-schema", "scenes"]
SINGLE = ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md"]
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"!?\[(?:[^\]\[]|\[[^\]]*\])*\]\(([^)\s]+)\)")
NOTE = re.compile(r"(?:# |<!-- )(file|not run): (.*?)(?: -->)?")
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


# --- running -------------------------------------------------------------------------------------------------------


def run_chapter(chapter, folder, program):
    """Runs the blocks of a chapter in a folder; an error is an AssertionError."""
    (folder / "scenes").symlink_to(ROOT / "scenes")
    environment = {**os.environ, "PATH": f"{Path(program).resolve().parent}:{os.environ['PATH']}"}
    printed = ""
    text = chapter.read_text()
    for block in BLOCK.finditer(text):
        language, body = block.groups()
        notes = [text[: block.start()].rsplit("\n", 2)[-2:][0], body.split("\n", 1)[0]]
        note = next((found.group(1, 2) for line in notes if (found := NOTE.fullmatch(line))), (None, None))
        if note[0] == "not run":
            printed = None
            continue
        if language == "toml" and note[0] == "file":
            (folder / note[1]).write_text(body)
        elif language in ("sh", "python"):
            command = ["bash", "-euo", "pipefail", "-c"] if language == "sh" else [sys.executable, "-c"]
            done = subprocess.run([*command, body], cwd=folder, env=environment, capture_output=True, text=True)
            assert done.returncode == 0, f"{chapter.name}: this failed:\n{body}{done.stdout}{done.stderr}"
            printed = done.stdout
        elif language == "text" and printed is not None:
            problem = difference(body, printed)
            assert problem is None, f"{chapter.name}: {problem}; all of it:\n{printed}"


def difference(told, printed):
    """What is printed and not told, or told and not printed; None where they agree."""
    lines = printed.rstrip().split("\n")
    for line in told.rstrip().split("\n"):
        if line == "...":
            return None
        if not lines:
            return f"not printed: {line}"
        if not same(line, lines.pop(0)):
            return f"not printed so: {line}"
    return f"printed and not told: {lines[0]}" if lines else None


def same(told, printed):
    if told.endswith("..."):
        told = told.removesuffix("...")
        printed = printed[: len(told)]
    if NUMBER.sub("#", told) != NUMBER.sub("#", printed):
        return False
    pairs = zip(NUMBER.findall(told), NUMBER.findall(printed))
    return all(abs(float(a) - float(b)) <= 1e-3 * abs(float(a)) for a, b in pairs)


def pictures(chapter):
    """Names of the pictures that a chapter draws."""
    text = chapter.read_text()
    shown = re.findall(r"pictures/([\w-]+\.(?:svg|png|gif))\)", text)
    return [name for name in shown if f"-o {name}" in text or f'"{name}"' in text]


def tables(chapter):
    """Names of the CSV files beside a chapter that it writes and links to."""
    return re.findall(r"\]\(([\w-]+\.csv)\)", chapter.read_text())


def run(arguments):
    keep = "--pictures" in arguments
    names = [a for a in arguments if a != "--pictures"]
    program = os.environ.get("HERTZLAMB", str(ROOT / "target/release/hertzlamb"))
    for chapter in [Path(name).resolve() for name in names] or [*CHAPTERS, *PAGES]:
        with tempfile.TemporaryDirectory() as folder:
            run_chapter(chapter, Path(folder), program)
            for name in pictures(chapter):
                if keep:
                    shutil.copy(Path(folder) / name, PICTURES / name)
            for name in tables(chapter):
                if keep:
                    shutil.copy(Path(folder) / name, chapter.with_name(name))
        print(f"{chapter.relative_to(ROOT)}: runs")


# --- links ---------------------------------------------------------------------------------------------------------


def documents():
    """All documents of the repository."""
    listed = subprocess.run(["git", "ls-files", "*.md"], cwd=ROOT, check=True, capture_output=True, text=True)
    # mdBook itself checks its summary, whose links begin at the root
    return [ROOT / name for name in listed.stdout.split() if not name.endswith("SUMMARY.md") and (ROOT / name).exists()]


def anchors(text):
    """Anchors of a document: its headings and its explicit names."""
    found = set(re.findall(r'<a id="([^"]+)"', text))
    for heading in re.findall(r"^#+ (.*)$", BLOCK.sub("", text), re.MULTILINE):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "")
        found.add(re.sub(r"[^\w\- ]", "", plain.strip().lower()).replace(" ", "-"))
    return found


def without_code(text):
    return re.sub(r"`[^`\n]*`", "", BLOCK.sub("", text))


def broken_links():
    """Links between documents that lead nowhere."""
    broken = []
    for document in documents():
        text = document.read_text()
        for target in LINK.findall(without_code(text)):
            if re.match(r"[a-z]+:", target):
                continue
            path, _, anchor = target.partition("#")
            goal = (document.parent / unquote(path)).resolve() if path else document
            missing = not goal.exists() or ROOT not in [goal, *goal.parents]
            if missing or (anchor and goal.suffix == ".md" and anchor not in anchors(goal.read_text())):
                broken.append(f"{document.relative_to(ROOT)}: {target}")
    return broken


def links():
    broken = broken_links()
    if broken:
        raise SystemExit("links that lead nowhere:\n" + "\n".join(broken))


# --- pages ---------------------------------------------------------------------------------------------------------


def source(folder, program):
    """The documents, and the pages that are made from the program, as mdBook takes them."""
    folder = Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    readmes = [str(path.relative_to(ROOT)) for path in ROOT.glob("crates/*/README.md")]
    for name in [*SHELVES, *SINGLE, *readmes]:
        goal = folder / name
        goal.parent.mkdir(parents=True, exist_ok=True)
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, goal, ignore=shutil.ignore_patterns("book.*", "SUMMARY.md"))
        else:
            shutil.copy(ROOT / name, goal)
    reference.main(program, folder / "reference")
    built = folder.parent.parent / "page/hertzlamb.html"
    if built.exists():
        shutil.copy(built, folder / "hertzlamb.html")
        page = folder / "docs/page.md"
        page.write_text(page.read_text().replace("<!-- the page -->", "**[Open the page](../hertzlamb.html)**"))
    summary = (ROOT / "docs/SUMMARY.md").read_text()
    listed = {(folder / target).resolve() for target in LINK.findall(summary)}
    for document in folder.rglob("*.md"):
        if document.resolve() not in listed:
            document.unlink()
    for document in folder.rglob("*.md"):
        document.write_text(formulas(inward(document.read_text(), document, folder)))
    # mdBook makes README.md the index of its folder, and leaves the links to it as they are
    for document in folder.rglob("README.md"):
        document.rename(document.with_name("index.md"))
    (folder / "SUMMARY.md").write_text(summary.replace("README.md)", "index.md)"))


def inward(text, document, folder):
    """Without the links that leave the book, whose words stay; a README is the index of its folder."""

    def kept(match):
        target = match.group(2)
        if re.match(r"[a-z]+:|#", target):
            return match.group(0)
        goal = ROOT / document.relative_to(folder).parent / unquote(target.partition("#")[0])
        inside = (folder / goal.resolve().relative_to(ROOT)).is_file()
        return match.group(0).replace("README.md", "index.md") if inside else match.group(1)

    return re.sub(r"(?<!!)\[((?:[^\]\[]|\[[^\]]*\])*)\]\(([^)\s]+)\)", kept, text)


def formulas(text):
    """$...$ and $$...$$ as MathML, which browsers show without a script."""
    from latex2mathml.converter import convert

    def mathml(latex, display):
        # what Markdown would take as its own
        written = convert(latex, display=display).replace("*", "&#42;").replace("_", "&#95;").replace("\n", " ")
        return f"\n\n{written}\n\n" if display == "block" else written

    parts = re.split(r"(^```.*?^```$|`[^`\n]*`)", text, flags=re.MULTILINE | re.DOTALL)
    for i in range(0, len(parts), 2):
        shown = re.sub(r"\$\$(.+?)\$\$", lambda m: mathml(m.group(1), "block"), parts[i], flags=re.DOTALL)
        parts[i] = re.sub(r"\$([^$\n]+)\$", lambda m: mathml(m.group(1), "inline"), shown)
    return "".join(parts)


class Page(HTMLParser):
    """Links and anchors of a page."""

    def __init__(self, text):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("href", "src") and value:
                self.links.append(value)
            if name == "id" or (tag == "a" and name == "name"):
                self.anchors.add(value)


def pages(folder):
    folder = Path(folder).resolve()
    known = {path: Page(path.read_text()) for path in folder.rglob("*.html") if path.name not in ("404.html", "toc.html")}
    broken = []
    for path, page in known.items():
        for link in page.links:
            if re.match(r"[a-z]+:", link):
                continue
            target, _, anchor = link.partition("#")
            goal = (path.parent / unquote(target)).resolve() if target else path
            if not goal.is_file() or (anchor and goal in known and unquote(anchor) not in known[goal].anchors):
                broken.append(f"{path.relative_to(folder)}: {link}")
    if broken:
        raise SystemExit("links of pages that lead nowhere:\n" + "\n".join(sorted(set(broken))))
    print(f"{len(known)} pages, every link leads somewhere")


if __name__ == "__main__":
    command, *arguments = sys.argv[1:] or [""]
    commands = {"run": lambda: run(arguments), "links": links, "source": lambda: source(*arguments)}
    commands["pages"] = lambda: pages(*arguments)
    if command not in commands:
        raise SystemExit(__doc__)
    commands[command]()
