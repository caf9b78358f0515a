"""Modules of a Rust crate, the modules that each of them uses, and their layers.

All paths count, both in `use` declarations and in expressions and types. Tests do not count.
A name that lib.rs or another module re-exports with `pub use` belongs to the module that defines it.
"""

import re

NOT_CODE = re.compile(
    r"""//[^\n]*
    | /\*.*?\*/
    | \b[bc]?r(?P<hashes>\#*)".*?"(?P=hashes)
    | \b[bc]?"(?:\\.|[^"\\])*"
    | "(?:\\.|[^"\\])*"
    | '(?:\\(?:u\{[^}]*\}|x..|.)|[^'\\])'""",
    re.DOTALL | re.VERBOSE,
)
TEST = re.compile(r"#\[cfg\(test\)\]")
# `mod name;`, whatever its visibility and attributes
DECLARED = re.compile(r"^\s*(?:pub(?:\([^)]*\))?\s+)?mod\s+(\w+)\s*;", re.MULTILINE)
# the beginning of a path that is seen from the crate or from this module, with the tree behind it
PATH = re.compile(r"(?<![\w:])(?:\$?crate|super|self)\s*::\s*")
MACRO = re.compile(r"#\[macro_export\]\s*macro_rules!\s*(\w+)")
USE = re.compile(r"\b(?P<public>pub(?:\([^)]*\))?\s+)?use\s+(?P<tree>[^;]+);")


def end_of_braces(text, start):
    """Index behind the brace that closes the first one from `start` on."""
    depth = 0
    for place in range(text.index("{", start), len(text)):
        depth += {"{": 1, "}": -1}.get(text[place], 0)
        if depth == 0:
            return place + 1
    return len(text)


def code_of(text):
    """A source file without comments, texts and tests."""
    text = NOT_CODE.sub(" ", text)
    while match := TEST.search(text):
        item = re.compile(r"[;{]").search(text, match.end())
        if item is None:
            return text[: match.start()]
        end = item.end() if item.group() == ";" else end_of_braces(text, item.start())
        text = text[: match.start()] + text[end:]
    return text


def leaves(tree):
    """Pairs (path, name that it gets) of a use tree such as `a::{b::c, d as e}`."""
    tree, depth, start, parts = tree.strip(), 0, 0, []
    for place, letter in enumerate(tree):
        depth += {"{": 1, "}": -1}.get(letter, 0)
        if letter == "," and depth == 0:
            parts.append(tree[start:place])
            start = place + 1
    parts.append(tree[start:])
    if len(parts) > 1:
        return [leaf for part in parts if part.strip() for leaf in leaves(part)]
    if "{" in tree:
        head, inner = tree.split("{", 1)
        head = [part.strip() for part in head.split("::") if part.strip()]
        return [((*head, *path), name) for path, name in leaves(inner.rsplit("}", 1)[0])]
    if not tree:
        return []
    path, _, name = tree.partition(" as ")
    path = tuple(part.strip() for part in path.split("::") if part.strip())
    if path[-1] == "self":
        path = path[:-1]
    return [(path, name.strip() or (path[-1] if path else ""))]


def absolute(path, module, known):
    """The same path from the root of the crate; None for one that leads out of the crate."""
    path, base = list(path), list(module)
    if path and path[0] in ("crate", "$crate"):
        return tuple(path[1:])
    if path and path[0] in ("super", "self"):
        while path and path[0] in ("super", "self"):
            if path.pop(0) == "super":
                base = base[:-1]
        return (*base, *path)
    if path and (*module, path[0]) in known:
        return (*module, *path)
    return None


class Crate:
    """The modules of the folder `src`, by their paths as tuples; the root is the empty one."""

    def __init__(self, src):
        self.files, self.code = {}, {}
        for path in sorted(src.rglob("*.rs")):
            parts = list(path.relative_to(src).with_suffix("").parts)
            if parts[-1] in ("mod", "lib", "main"):
                parts.pop()
            self.files[tuple(parts)] = path
            self.code[tuple(parts)] = code_of(path.read_text(encoding="utf-8"))
        # files that only tests declare are tests
        reached = [()]
        for module in reached:
            declared = ((*module, name) for name in DECLARED.findall(self.code.get(module, "")))
            reached.extend(child for child in declared if child in self.files)
        self.order = {child[0]: place for place, child in enumerate(m for m in reached if len(m) == 1)}
        self.files = {module: self.files[module] for module in reached if module in self.files}
        self.passed_on = {module: self.names_passed_on(module) for module in self.files}
        for module in self.files:
            self.passed_on[()].update((name, (*module, name)) for name in MACRO.findall(self.code[module]))

    def names_passed_on(self, module):
        """Where the names come from that a module imports, its own or for others."""
        found = {}
        for use in USE.finditer(self.code[module]):
            for path, name in leaves(use["tree"]):
                path = absolute(path, module, self.files)
                if path is not None:
                    found[name] = path
        return found

    def owner(self, path, seen=()):
        """The module in which the item of an absolute path is defined."""
        module = ()
        for place, name in enumerate(path):
            if (*module, name) in self.files:
                module = (*module, name)
                continue
            source = self.passed_on[module].get(name)
            if source is None or (module, name) in seen:
                return module
            return self.owner((*source, *path[place + 1 :]), (*seen, (module, name)))
        return module

    def paths(self, module):
        """Absolute paths of all that a module names of its crate."""
        code = self.code[module]
        for use in USE.finditer(code):
            for path, _ in leaves(use["tree"]):
                yield absolute(path, module, self.files)
        rest = USE.sub(" ", code)
        for match in PATH.finditer(rest):
            names = re.compile(r"\w+(?:\s*::\s*\w+)*").match(rest, match.end())
            path = match.group() + (names.group() if names else "")
            yield absolute([part.strip() for part in path.split("::") if part.strip()], module, self.files)
        for name in {child[len(module)] for child in self.files if len(child) > len(module) and child[: len(module)] == module}:
            for match in re.finditer(rf"(?<![\w:.]){name}\s*::\s*(\w+(?:\s*::\s*\w+)*)", rest):
                yield (*module, name, *(part.strip() for part in match.group(1).split("::")))

    def uses(self, module):
        """Other modules of the crate whose items a module names."""
        owners = {self.owner(path) for path in self.paths(module) if path is not None}
        return owners - {module}

    def circles(self):
        """Lists of modules each of which uses the next, and the last the first.

        A module and its parts may use each other.
        """
        graph = {
            module: {o for o in self.uses(module) if module != o[: len(module)] and o != module[: len(o)]}
            for module in self.files
        }
        done, found = set(), []

        def walk(module, path):
            if module in path:
                found.append(path[path.index(module) :])
            elif module not in done:
                for other in sorted(graph[module]):
                    walk(other, [*path, module])
                done.add(module)

        for module in sorted(graph):
            walk(module, [])
        return found

    def upward(self):
        """Triples (file, top module that it is in, top module that it uses) against the order in lib.rs or main.rs.

        There a top module stands below those that it uses; what the root itself defines stands above all.
        """
        for module, path in self.files.items():
            for other in sorted({used[:1] for used in self.uses(module)}) if module else ():
                if not other:
                    yield path, module[0], "the root of the crate"
                elif self.order[other[0]] > self.order[module[0]]:
                    yield path, module[0], other[0]
