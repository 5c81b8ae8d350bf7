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

SMALL: Final = 64_000
"""Bytes of a module whose tree and code are kept for the next controller."""
_LARGE: Final[WeakKeyDictionary[ModuleFile, dict[bool, Module]]] = WeakKeyDictionary()
"""By the only property of a dialect that a tree depends on."""


def tree_of(file: ModuleFile, dialect: Dialect) -> Module:
    """Return the tree of a module file."""
    if len(file.data) <= SMALL:
        return _small(file.data, file.path, dialect.has_radix)
    known = _LARGE.setdefault(file, {})
    tree = known.get(dialect.has_radix)
    if tree is None:
        tree = known[dialect.has_radix] = parse(file.data, path=file.path, dialect=dialect)
    return tree


@lru_cache(maxsize=128)
def _small(data: bytes, path: str, has_radix: bool) -> Module:
    return parse(data, path=path, dialect=Dialect() if has_radix else Dialect((5, 0)))
