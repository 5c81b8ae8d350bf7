"""Limits on circular imports and untyped code; `python -m tests.docs.figures` prints them."""

import importlib
import inspect
import io
import re
import tokenize
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

from rapidgen.runtime.values import Record
from tests.docs.tree import ROOT, circles, imports, modules

_NEEDS_ROS = {
    "rapidgen.ros.node",
    "rapidgen.ros.operator_interface",
    "rapidgen.ros.stream_interface",
}


@dataclass(frozen=True)
class Figure:
    """A count or a largest size in the source, and its limit."""

    what: str
    found: Callable[[], list[tuple[float, str]]]
    """Counted things with their size, the largest first; the figure is the sum or the largest."""
    limit: float
    together: bool = True

    def value(self) -> float:
        """The figure."""
        sizes = [size for size, _ in self.found()]
        return sum(sizes) if self.together else max(sizes, default=0)


def circle_sizes() -> list[tuple[float, str]]:
    """Files that import one another."""
    return [(len(part), " ".join(part)) for part in circles(imports())]


def words(word: str) -> list[tuple[float, str]]:
    """Places where a name or comment begins with the word; files without it are not tokenised."""
    return [
        (1, f"{name}:{token.start[0]}")
        for name, path in modules().items()
        if word in (text := path.read_text("utf-8"))
        for token in tokenize.generate_tokens(io.StringIO(text).readline)
        if (token.type == tokenize.NAME and token.string == word)
        or (token.type == tokenize.COMMENT and token.string.startswith(word))
    ]


def anything() -> list[tuple[float, str]]:
    """The word Any, imports of it too; the one alias of RAPID values apart."""
    alias = [
        (1, f"{name}:{number}")
        for name, path in modules().items()
        for number, line in enumerate(path.read_text("utf-8").splitlines(), 1)
        if line == "Value: TypeAlias = Any"
    ]
    return [place for place in words("Any") if place not in alias]


@cache
def classes() -> list[type]:
    """Classes of the package but for exceptions and RAPID records."""
    result = {
        thing
        for name in modules()
        if not name.endswith("__main__") and name not in _NEEDS_ROS
        for thing in vars(importlib.import_module(name)).values()
        if inspect.isclass(thing) and thing.__module__ == name
    }
    return [c for c in result if not issubclass(c, BaseException | Record)]


def of_ours(bases: tuple[type, ...]) -> list[type]:
    """Those of the package."""
    return [base for base in bases if base.__module__.startswith("rapidgen")]


def inheritance_depths() -> list[tuple[float, str]]:
    """How deep classes are below their first ancestor."""

    def depth(result: type) -> int:
        return max((1 + depth(base) for base in of_ours(result.__bases__)), default=0)

    return sorted(((depth(c), f"{c.__module__}.{c.__name__}") for c in classes()), reverse=True)


def ignored_imports() -> list[tuple[float, str]]:
    """Exceptions of the import contract."""
    text = (ROOT / "pyproject.toml").read_text("utf-8")
    return [(1, line.strip()) for line in text.splitlines() if re.search(r'"[\w.*]+ -> ', line)]


FIGURES = [
    Figure("files in the largest circle of imports", circle_sizes, 2, together=False),
    Figure("type: ignore", lambda: words("# type: ignore"), 15),
    Figure("the word Any besides the alias of RAPID values", anything, 60),
    Figure("NotImplementedError", lambda: words("NotImplementedError"), 0),
    Figure("depth of inheritance", inheritance_depths, 2, together=False),
    Figure("ignore_imports", ignored_imports, 0),
]

if __name__ == "__main__":
    for figure in FIGURES:
        found = sorted(figure.found(), reverse=True)
        print(f"{figure.what}: {figure.value():.4g}, limit {figure.limit}")
        print("".join(f"    {size:.4g}  {where}\n" for size, where in found[:5]), end="")
