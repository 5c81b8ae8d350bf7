"""Generic traversal of a tree."""

from collections.abc import Iterator
from typing import Final, get_args

from rapidgen.rapid.syntax import nodes
from rapidgen.rapid.syntax.nodes import Node

_CHILDREN: Final[dict[type, tuple[str, ...]]] = {
    nodes.NumberLiteral: (),
    nodes.StringLiteral: (),
    nodes.BoolLiteral: (),
    nodes.Name: (),
    nodes.Index: ("base", "indices"),
    nodes.Member: ("base",),
    nodes.FunctionCall: ("arguments",),
    nodes.Aggregate: ("members",),
    nodes.Unary: ("operand",),
    nodes.Binary: ("left", "right"),
    nodes.Parenthesis: ("inner",),
    nodes.Placeholder: (),
    nodes.Star: (),
    nodes.Argument: ("value",),
    nodes.Component: (),
    nodes.RecordDeclaration: ("components",),
    nodes.AliasDeclaration: (),
    nodes.DataDeclaration: ("dimensions", "initial"),
    nodes.Parameter: (),
    nodes.ErrorHandler: ("numbers", "body"),
    nodes.Handler: ("body",),
    nodes.RoutineDeclaration: ("parameters", "data", "body", "backward", "error", "undo"),
    nodes.PlaceholderDeclaration: (),
    nodes.Assignment: ("target", "value"),
    nodes.ProcedureCall: ("arguments",),
    nodes.LateCall: ("procedure", "arguments"),
    nodes.Branch: ("condition", "body"),
    nodes.If: ("branches", "otherwise"),
    nodes.CompactIf: ("condition", "statement"),
    nodes.For: ("start", "end", "step", "body"),
    nodes.While: ("condition", "body"),
    nodes.Case: ("values", "body"),
    nodes.Test: ("subject", "cases", "default"),
    nodes.Label: (),
    nodes.Goto: (),
    nodes.Return: ("value",),
    nodes.Raise: ("number",),
    nodes.Retry: (),
    nodes.TryNext: (),
    nodes.Exit: (),
    nodes.Connect: ("target",),
    nodes.PlaceholderStatement: (),
    nodes.Module: ("declarations",),
}
"""Fields that hold a node, a list of nodes or None, in the order of the source."""
_STATEMENTS: Final = get_args(nodes.Statement)


def children(node: Node) -> list[Node]:
    """Return the nodes directly below a node, in source order."""
    result: list[Node] = []
    for name in _CHILDREN[type(node)]:
        value = getattr(node, name)
        if type(value) is list:
            result += value
        elif value is not None:
            result.append(value)
    return result


def walk(node: Node) -> Iterator[Node]:
    """Iterate over a node and all nodes below it, parents first."""
    stack = [node]
    pop = stack.pop
    while stack:
        node = pop()
        yield node
        if _CHILDREN[type(node)]:
            stack += reversed(children(node))


def walk_own(node: Node) -> Iterator[Node]:
    """Iterate over a node and all nodes below it within one statement."""
    yield node
    for child in children(node):
        if not isinstance(child, _STATEMENTS):
            yield from walk_own(child)
