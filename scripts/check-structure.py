"""Checks the structure of the Rust code: one Rust version, layered modules, few files in a folder, short functions.

lib.rs (or main.rs) lists the top modules of a crate from the bottom up; each module uses only those above it in the list.
The files of a top module have no circular dependencies.

Usage: check-structure.py [CRATE...], in the root of the repository.
Tables of data (files named *_data.rs) may be longer.
"""

import re
import sys
from collections import Counter
from pathlib import Path

from rust_modules import Crate

ROOT = Path(__file__).resolve().parent.parent
MOST_LINES = 700
MOST_FUNCTION = 80
MOST_IN_FOLDER = 14
# Crates whose modules are not in layers yet. This list must become empty.
NOT_YET = []


def module_faults(folder):
    """Sentences about the modules of a crate that use each other in a circle, or one that stands above them."""
    crate, root = Crate(folder / "src"), folder.parent.parent
    for circle in crate.circles():
        names = [str(crate.files[module].relative_to(root)) for module in circle]
        yield f"a circle of files: {', '.join(names)}"
    if folder.name in NOT_YET:
        return
    for path, module, other in crate.upward():
        yield f"{path.relative_to(root)}: `{module}` uses {other}, which is not above it in the list of modules"


def functions(text):
    """Name and length of each function, from its braces."""
    lines = text.split("\n")
    for i, line in enumerate(lines):
        match = re.match(r"(\s*)(?:pub(?:\([a-z]+\))?\s+)?(?:const\s+)?fn\s+(\w+)", line)
        if not match:
            continue
        end = f"{match.group(1)}}}"
        for j in range(i, len(lines)):
            if lines[j] == end:
                yield match.group(2), j - i + 1
                break
            if lines[j].endswith(";") and lines[j].startswith(match.group(1)) and j == i:
                break


def main(wanted):
    faults = []
    crates = [folder for folder in sorted((ROOT / "crates").iterdir()) if (folder / "src").is_dir()]
    for folder in crates:
        if wanted and folder.name not in wanted:
            continue
        if "\nrust-version.workspace = true\n" not in (folder / "Cargo.toml").read_text():
            faults.append(f"{folder.name}: its version of Rust is not that of the workspace")
        faults.extend(module_faults(folder))
        crowds = Counter(path.parent.relative_to(ROOT).as_posix() for path in (folder / "src").rglob("*.rs"))
        for place, count in sorted(crowds.items()):
            if count > MOST_IN_FOLDER:
                faults.append(f"{place} has {count} files, more than {MOST_IN_FOLDER}")
        for path in sorted(folder.rglob("*.rs")):
            text, name = path.read_text(), path.relative_to(ROOT)
            length = text.count("\n")
            if path.stem.endswith("_data"):
                continue
            if length > MOST_LINES:
                faults.append(f"{name} has {length} lines, more than {MOST_LINES}")
            for function, lines in functions(text):
                if lines > MOST_FUNCTION:
                    faults.append(f"{name}: fn {function} has {lines} lines, more than {MOST_FUNCTION}")
    for fault in faults:
        print(fault)
    print(f"{len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(set(sys.argv[1:])))
