"""Structure of the Rust code: one version of Rust, no circle of imports, few files in a folder, short functions.

Usage: check-structure.py [CRATE...], from the root of the repository.
Tables of data (files named *_data.rs) may be longer.
"""

import re
import sys
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MOST_LINES = 700
MOST_FUNCTION = 80
MOST_IN_FOLDER = 14


def modules(src):
    """Module path (a tuple) of each file of a crate."""
    found = {}
    for path in sorted(src.rglob("*.rs")):
        parts = list(path.relative_to(src).with_suffix("").parts)
        if parts[-1] in ("mod", "lib", "main"):
            parts.pop()
        found[tuple(parts)] = path
    return found


def leaves(tree):
    """All paths of a use tree such as a::{b::c, d}."""
    tree = tree.strip()
    depth, start, parts = 0, 0, []
    for i, letter in enumerate(tree):
        depth += {"{": 1, "}": -1}.get(letter, 0)
        if letter == "," and depth == 0:
            parts.append(tree[start:i])
            start = i + 1
    parts.append(tree[start:])
    if len(parts) > 1:
        return [leaf for part in parts if part.strip() for leaf in leaves(part)]
    if "{" not in tree:
        return [tree.split(" as ")[0].strip()] if tree else []
    head, inner = tree.split("{", 1)
    return [head + leaf for leaf in leaves(inner.rsplit("}", 1)[0])]


def without_comments(text):
    return re.sub(r"//[^\n]*", "", text)


def imports(text, module, known):
    """Modules that a file imports from, its own parts declared with `mod` included only where it uses them."""
    found = set()
    for use in re.findall(r"\buse\s+([^;]+);", without_comments(text)):
        for leaf in leaves(use):
            parts = [part.strip() for part in leaf.split("::")]
            if parts[0] == "crate":
                path = parts[1:]
            elif parts[0] in ("super", "self"):
                base = list(module)
                while parts and parts[0] in ("super", "self"):
                    if parts.pop(0) == "super":
                        base = base[:-1]
                path = base + parts
            elif (*module, parts[0]) in known:
                path = [*module, *parts]
            else:
                continue
            while path and tuple(path) not in known:
                path = path[:-1]
            if tuple(path) != module:
                found.add(tuple(path))
    return found


def test_part(text):
    """Where the tests of a file begin; its own tests may use `super`."""
    place = re.search(r"#\[cfg\(test\)\]\nmod \w+ \{", text)
    return place.start() if place else len(text)


def circles(known):
    """Lists of modules each of which imports the next, and the last the first.

    A module and its parts may know each other.
    """
    graph = {}
    for module, path in known.items():
        text = path.read_text()
        own = text[: test_part(text)]
        tests = text[test_part(text) :].replace("super::", "crate::" + "".join(f"{part}::" for part in module))
        others = (imports(own, module, known) | imports(tests, module, known)) - {module}
        graph[module] = {o for o in others if module != o[: len(module)] and o != module[: len(o)]}
    done = set()

    def walk(module, path):
        if module in path:
            yield path[path.index(module) :]
        elif module not in done:
            for other in sorted(graph.get(module, ())):
                yield from walk(other, [*path, module])
            done.add(module)

    for module in sorted(graph):
        yield from walk(module, [])


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
        known = modules(folder / "src")
        for circle in circles(known):
            names = [str(known[module].relative_to(ROOT)) for module in circle]
            faults.append(f"a circle of imports: {', '.join(names)}")
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
