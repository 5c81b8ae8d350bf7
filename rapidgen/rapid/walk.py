"""Going through a tree without knowing each kind of node."""

from collections.abc import Iterator
from dataclasses import fields

from rapidgen.rapid.nodes import Node

_PLAIN = ("first", "last", "name_token", "source", "diagnostics", "attributes", "scope", "kind")
_holders: dict[type, tuple[str, ...]] = {}
"""Fields that may hold nodes, by class of node."""


def children(node: Node) -> list[Node]:
    """Nodes directly below a node, in the order of the source."""
    found: list[Node] = []
    names = _holders.get(type(node))
    if names is None:
        names = tuple(f.name for f in fields(node) if f.name not in _PLAIN)
        _holders[type(node)] = names
    for name in names:
        value = getattr(node, name)
        if isinstance(value, Node):
            found.append(value)
        elif isinstance(value, list):
            found += value
    return found


def walk(node: Node) -> Iterator[Node]:
    """A node and all nodes below it; parents come before their children."""
    stack = [node]
    while stack:
        node = stack.pop()
        yield node
        stack += reversed(children(node))
