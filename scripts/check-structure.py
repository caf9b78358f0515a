"""Structure of the Rust code: no two files import each other, no file over 700 lines, no function over 80.

Usage: check-structure.py [CRATE...], from the root of the repository.
Tables of data (files named *_data.rs) may be longer.
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MOST_LINES = 700
MOST_FUNCTION = 80
# parent and child may know each other here: a module and its parts
PARENTS_ALLOWED = {"figure", "halfspace", "study"}


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
    place = text.find("#[cfg(test)]\nmod ")
    return len(text) if place < 0 else place


def knots(crate, known):
    graph = {}
    for module, path in known.items():
        text = path.read_text()
        own = text[: test_part(text)]
        tests = text[test_part(text) :].replace("super::", "crate::" + "".join(f"{part}::" for part in module))
        graph[module] = (imports(own, module, known) | imports(tests, module, known)) - {module}
    for module, others in graph.items():
        for other in others:
            if module < other and module in graph.get(other, ()):
                related = module == other[: len(module)] or other == module[: len(other)]
                if not (related and crate in PARENTS_ALLOWED):
                    yield module, other


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
    faults, sizes = [], []
    for folder in sorted((ROOT / "crates").iterdir()):
        crate = folder.name
        if wanted and crate not in wanted or not (folder / "src").is_dir():
            continue
        known = modules(folder / "src")
        for one, two in knots(crate, known):
            names = [known[module].relative_to(ROOT) for module in (one, two)]
            faults.append(f"{names[0]} and {names[1]} import each other")
        for path in sorted(folder.rglob("*.rs")):
            text, name = path.read_text(), path.relative_to(ROOT)
            length = text.count("\n")
            sizes.append(length)
            if path.stem.endswith("_data"):
                continue
            if length > MOST_LINES:
                faults.append(f"{name} has {length} lines, more than {MOST_LINES}")
            for function, lines in functions(text):
                if lines > MOST_FUNCTION:
                    faults.append(f"{name}: fn {function} has {lines} lines, more than {MOST_FUNCTION}")
    for fault in faults:
        print(fault)
    sizes.sort()
    print(f"{len(sizes)} files, {sum(sizes)} lines, median {sizes[len(sizes) // 2]}; {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(set(sys.argv[1:])))
