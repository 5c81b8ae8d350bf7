"""Trees of module files: each file is parsed once, for its check, its inference and its execution.

Callers must not change a tree. All controllers of the process share the trees of small modules;
that of a larger one lives as long as its `ModuleFile`.
"""

from functools import lru_cache
from typing import Final
from weakref import WeakKeyDictionary

from rapidgen.rapid.dialect import Dialect
from rapidgen.rapid.syntax.nodes import Module
from rapidgen.rapid.syntax.parser import parse
from rapidgen.system.model import ModuleFile
from rapidgen.system.releases import UNKNOWN_ROBOTWARE

SMALL: Final = 64_000
"""Bytes of a module whose tree and code are kept for the next controller."""
_LARGE: Final[WeakKeyDictionary[ModuleFile, dict[tuple[bool, str], Module]]] = WeakKeyDictionary()
"""By the properties of a dialect that a tree depends on."""


def tree_of(file: ModuleFile, dialect: Dialect) -> Module:
    """Return the tree of a module file."""
    if len(file.data) <= SMALL:
        return _small(file.data, file.path, dialect.has_radix, dialect.encoding)
    known = _LARGE.setdefault(file, {})
    key = (dialect.has_radix, dialect.encoding)
    tree = known.get(key)
    if tree is None:
        tree = known[key] = parse(file.data, path=file.path, dialect=dialect)
    return tree


@lru_cache(maxsize=128)
def _small(data: bytes, path: str, has_radix: bool, encoding: str) -> Module:
    release = UNKNOWN_ROBOTWARE if has_radix else (5, 0)
    return parse(data, path=path, dialect=Dialect(release, encoding=encoding))
