"""The package as its text shows it: files, lines, who imports whom."""

import ast
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "rapidgen"


@cache
def modules() -> dict[str, Path]:
    """Files of the package by dotted name; a package's own file has the package's name."""
    result = {}
    for path in sorted(PACKAGE.rglob("*.py")):
        parts = path.relative_to(ROOT).with_suffix("").parts
        result[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return result


@cache
def tree_of(path: Path) -> ast.Module:
    """The syntax tree of a file."""
    return ast.parse(path.read_text(encoding="utf-8"))


def package_of(module: str) -> str:
    """Return the top package of a module, '' for files directly in rapidgen."""
    parts = module.split(".")
    return parts[1] if len(parts) > 1 and (PACKAGE / parts[1]).is_dir() else ""


@cache
def imports() -> dict[str, frozenset[str]]:
    """Modules of the package that each module imports anywhere, for types only as well."""
    known = modules()
    return {
        name: frozenset(result for result in _imported(path, known) if result != name)
        for name, path in known.items()
    }


def _imported(path: Path, known: dict[str, Path]) -> Iterator[str]:
    for node in ast.walk(tree_of(path)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in known)
        elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module in known:
            for alias in node.names:
                inside = f"{node.module}.{alias.name}"
                yield inside if inside in known else node.module


def circles(graph: Mapping[str, Iterable[str]]) -> list[list[str]]:
    """Nodes that lead to one another, each set once, the largest first."""
    backward: dict[str, set[str]] = {name: set() for name in graph}
    for name, result in graph.items():
        for other in result:
            backward[other].add(name)
    seen: set[str] = set()
    finished = [name for start in graph for name in _walk(start, graph, seen)]
    seen.clear()
    parts = [sorted(_walk(name, backward, seen)) for name in reversed(finished)]
    return sorted((part for part in parts if len(part) > 1), key=len, reverse=True)


def _walk(start: str, graph: Mapping[str, Iterable[str]], seen: set[str]) -> list[str]:
    """What is reached from a node and was not seen before, in the order in which it ends."""
    if start in seen:
        return []
    finished, stack = [], [(start, iter(graph[start]))]
    seen.add(start)
    while stack:
        here, remaining = stack[-1]
        following = next((name for name in remaining if name not in seen), None)
        if following is None:
            finished.append(here)
            stack.pop()
        else:
            seen.add(following)
            stack.append((following, iter(graph[following])))
    return finished
