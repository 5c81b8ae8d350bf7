"""The package list of docs/develop/architecture.md, drawn from the code.

`python -m tests.docs.picture` draws it again: the packages as the import contract has them, top to
bottom, and their folders, each with the first line of its docstring.
"""

import ast
import textwrap

import tomllib

from tests.docs.drawn import Picture
from tests.docs.tree import PACKAGE, ROOT, modules, package_of, tree_of

PICTURE = Picture("<!-- drawn by tests/docs/picture.py -->\n```text\n", "```\n<!-- drawn -->\n")
WIDTH = 100


def layers() -> list[list[str]]:
    """Packages of the import contract, top to bottom; those of one layer are independent."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    contracts = tomllib.loads(text)["tool"]["importlinter"]["contracts"]
    match = next(contract["layers"] for contract in contracts if contract["type"] == "layers")
    return [layer.split(" : ") for layer in match]


def says(package: str) -> str:
    """First line of a package's docstring."""
    path = modules()[package]
    return (ast.get_docstring(tree_of(path)) or "").split("\n")[0]


def entry(name: str, text: str, depth: int) -> list[str]:
    """A package or folder with its line, folded."""
    left = f"{'  ' * depth}{name}/".ljust(22)
    return textwrap.wrap(left + text, WIDTH, subsequent_indent=" " * 22)


def draw() -> str:
    """Return the text block."""
    out = []
    for layer in layers():
        out.append("─" * WIDTH)
        for name in layer:
            own = [module for module in modules() if package_of(module) == name]
            out += entry(name, says(f"rapidgen.{name}"), 0)
            for module in own:
                if module.count(".") > 1 and modules()[module].name == "__init__.py":
                    path = modules()[module].parent
                    depth = len(path.relative_to(PACKAGE).parts) - 1
                    out += entry(path.name, says(module), depth)
    return "\n".join([*out, "─" * WIDTH, ""])


if __name__ == "__main__":
    PICTURE.put(draw())
