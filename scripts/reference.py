"""Pages of the book that are made from the program itself, so that nothing is written twice.

Usage: reference.py PROGRAM FOLDER

Writes into FOLDER: python.md from the docstrings of python/hertzlamb, a page for each command in commands/ from its
--help, and the notebooks of docs/notebooks with their outputs in notebooks/.
"""

import ast
import base64
import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "python/hertzlamb"
# the order of the Python reference; what is not listed follows
FIRST = ["impact", "collide", "sweep", "infer", "resolve", "materials", "Table", "tabulate"]


# --- commands ------------------------------------------------------------------------------------------------------


def help_of(program, words):
    done = subprocess.run([program, *words, "--help"], capture_output=True, text=True, check=True)
    return done.stdout.replace(f"{Path(program).name} ", "hertzlamb ")


def subcommands(text):
    """Names and one-line descriptions under `Commands:` of a help text."""
    listed = re.search(r"^Commands:\n((?:  .*\n)+)", text, re.MULTILINE)
    found = re.findall(r"^  (\S+) +(.*)$", listed.group(1), re.MULTILINE) if listed else []
    return [(name, about) for name, about in found if name != "help"]


def command_page(program, name):
    """A command's help as a page, with those of its own commands."""
    text = help_of(program, [name])
    page = f"# hertzlamb {name}\n\n```text\n{text.rstrip()}\n```\n"
    for inner, _ in subcommands(text):
        page += f"\n## hertzlamb {name} {inner}\n\n```text\n{help_of(program, [name, inner]).rstrip()}\n```\n"
    return page


def commands(program, folder):
    folder.mkdir(parents=True)
    text = help_of(program, [])
    rows = [f"| [{name}](commands/{name}.md) | {about} |" for name, about in subcommands(text)]
    table = "\n".join(["| command | |", "|---|---|", *rows])
    (folder.parent / "commands.md").write_text(
        f"# Commands\n\nThese pages are the program's own help texts.\n\n{table}\n\n```text\n{text.rstrip()}\n```\n"
    )
    for name, _ in subcommands(text):
        (folder / f"{name}.md").write_text(command_page(program, name))


# --- Python --------------------------------------------------------------------------------------------------------


def exported(module):
    """The names of `__all__` of a module."""
    for node in ast.parse(module.read_text()).body:
        if isinstance(node, ast.Assign) and getattr(node.targets[0], "id", None) == "__all__":
            return ast.literal_eval(node.value)
    raise SystemExit(f"{module} has no __all__")


def definitions(path):
    nodes = ast.parse(path.read_text()).body
    return {node.name: node for node in nodes if isinstance(node, ast.FunctionDef | ast.ClassDef)}


def ends_section(lines, i):
    """Whether a paragraph begins here that is no item of the section before."""
    after = lines[i + 1] if i + 1 < len(lines) else ""
    is_text = lines[i].strip() and not lines[i].startswith(" ") and " : " not in lines[i]
    return is_text and not lines[i - 1].strip() and not after.startswith(" ")


def docstring(text):
    """A docstring in numpydoc as Markdown: its sections in bold, their items as a list, examples as code."""
    lines, out, code, in_section = text.splitlines(), [], False, False
    for i, line in enumerate(lines):
        underlined = i + 1 < len(lines) and re.fullmatch(r"-{3,}", lines[i + 1].strip())
        if re.fullmatch(r"-{3,}", line.strip()):
            continue
        starts_code = line.lstrip().startswith((">>>", "..."))
        if starts_code and not code:
            out += ["", "```python"]
            code = True
        elif code and not line.strip():
            out += ["```"]
            code = False
        if code:
            out.append(line)
        elif underlined:
            in_section = True
            out += ["", f"**{line.strip()}**", ""]
        elif in_section and ends_section(lines, i):
            in_section = False
            out.append(line)
        elif in_section and line and not line.startswith(" "):
            name, _, kind = line.partition(" : ")
            out.append(f"- `{name}`" + (f" ({kind})" if kind else ""))
        else:
            out.append(line)
    return "\n".join([*out, "```"] if code else out).strip()


def is_public(node):
    return not node.name.startswith("_")


def is_property(node):
    return any(getattr(mark, "id", "") == "property" for mark in node.decorator_list)


def call(node, owner=""):
    arguments = ast.unparse(node.args)
    if owner:
        arguments = re.sub(r"^(self|cls)(, )?(/, )?", "", arguments)
    returns = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    return f"```python\n{owner}{node.name}({arguments}){returns}\n```"


def attributes(node):
    """Annotated attributes of a class with the text that follows them, and its properties."""
    rows, body = [], node.body
    for here, after in zip(body, [*body[1:], None]):
        if isinstance(here, ast.AnnAssign) and isinstance(after, ast.Expr) and isinstance(after.value, ast.Constant):
            rows.append((here.target.id, ast.unparse(here.annotation), after.value.value))
        if isinstance(here, ast.FunctionDef) and is_public(here) and is_property(here) and ast.get_docstring(here):
            rows.append((here.name, ast.unparse(here.returns) if here.returns else "", ast.get_docstring(here)))
    cell = lambda text: " ".join(text.split()).replace("|", "\\|")  # noqa: E731
    return "\n".join(["| attribute | type | |", "|---|---|---|", *(f"| `{n}` | `{cell(t)}` | {cell(d)} |" for n, t, d in rows)]) if rows else ""


def entry(node, prefix=""):
    """One function or class with its methods."""
    text = docstring(ast.get_docstring(node) or "")
    if isinstance(node, ast.FunctionDef):
        return f"### {prefix}{node.name}\n\n{call(node, prefix)}\n\n{text}\n"
    parts = [f"### {prefix}{node.name}", text, attributes(node)]
    for method in node.body:
        if isinstance(method, ast.FunctionDef) and is_public(method) and not is_property(method) and ast.get_docstring(method):
            parts += [f"#### {node.name}.{method.name}", call(method, f"{node.name}."), docstring(ast.get_docstring(method))]
    return "\n\n".join(part for part in parts if part) + "\n"


def python(page):
    found = {}
    for path in sorted(PACKAGE.glob("_*.py")):
        found |= definitions(path)
    names = [name for name in exported(PACKAGE / "__init__.py") if name in found]
    names.sort(key=lambda name: (FIRST.index(name) if name in FIRST else len(FIRST), name))
    errors = [name for name in names if any(getattr(base, "id", "").startswith("Hertzlamb") for base in getattr(found[name], "bases", []))]
    kernels = definitions(PACKAGE / "kernels.py")
    about = ast.get_docstring(ast.parse((PACKAGE / "__init__.py").read_text()))
    of_kernels = ast.get_docstring(ast.parse((PACKAGE / "kernels.py").read_text()))
    parts = ["# Python reference\n", "This page is made from the docstrings of the package.\n", docstring(about), "\n## Functions and results\n"]
    parts += [entry(found[name]) for name in names if name not in errors and name != "HertzlambWarning"]
    parts += ["\n## hertzlamb.kernels\n", docstring(of_kernels)]
    parts += [entry(kernels[name], "kernels.") for name in exported(PACKAGE / "kernels.py") if name in kernels]
    parts += ["\n## Exceptions and warnings\n"]
    parts += [entry(found[name]) for name in ["HertzlambWarning", "HertzlambError", *errors] if name in found]
    page.write_text("\n".join(parts))


# --- notebooks -----------------------------------------------------------------------------------------------------


def notebook(path, folder):
    """A notebook as Markdown, its pictures as files."""
    parts, pictures = [], 0
    for cell in json.loads(path.read_text())["cells"]:
        source = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            parts.append(source)
            continue
        parts.append(f"```python\n{source}\n```")
        for output in cell["outputs"]:
            data = output.get("data", {})
            text = "".join(output.get("text", data.get("text/plain", [])))
            if "image/png" in data:
                name = f"{path.stem}-{pictures}.png"
                (folder / name).write_bytes(base64.b64decode(data["image/png"]))
                parts.append(f"![{path.stem}, picture {pictures + 1}]({name})")
                pictures += 1
            elif text.strip():
                parts.append(f"```text\n{text.rstrip()}\n```")
    (folder / f"{path.stem}.md").write_text("\n\n".join(parts) + "\n")


def main(program, folder):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    commands(program, folder / "commands")
    python(folder / "python.md")
    (folder / "notebooks").mkdir()
    for path in sorted((ROOT / "docs/notebooks").glob("*.ipynb")):
        notebook(path, folder / "notebooks")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    main(*sys.argv[1:])
