"""What programs make of the names in them: every node with the scope that it stands in, and the
type that an expression has by where it stands."""

from collections.abc import Iterator, Mapping

from rapidgen.rapid.binding import ModuleScope, RoutineSymbol, Scope, match
from rapidgen.rapid.binding.expressions import declared_type, type_of
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import children

_RULED: Mapping[str, str] = {"AND": "bool", "OR": "bool", "XOR": "bool", "DIV": "num", "MOD": "num"}
"""What operands are by their operator alone."""


def scoped(module: ModuleScope) -> Iterator[tuple[n.Node, Scope]]:
    """Every node of a module, in the order of the text."""
    stack: list[tuple[n.Node, Scope]] = [(d, module) for d in reversed(module.tree.declarations)]
    while stack:
        node, scope = stack.pop()
        yield node, scope
        inside = scope
        if isinstance(node, n.RoutineDeclaration):
            inside = module.routine(node)
        elif isinstance(node, n.For) and not isinstance(scope, ModuleScope):
            inside = scope.loop(node)
        stack += [(child, inside) for child in reversed(list(children(node)))]


def read(node: n.Node, scope: Scope) -> Iterator[tuple[n.Expression, str]]:
    """Expressions in a node, and what they are by what stands beside them."""
    match node:
        case n.Binary():
            ruled = _RULED.get(node.operator, "")
            yield node.left, ruled or type_of(node.right, scope) or ""
            yield node.right, ruled or type_of(node.left, scope) or ""
        case n.Unary():
            yield node.operand, "bool" if node.operator == "NOT" else "num"
        case n.Branch() | n.CompactIf() | n.While():
            yield node.condition, "bool"
        case n.Assignment():
            yield node.value, declared_type(node.target, scope) or ""
            yield node.target, type_of(node.value, scope) or ""
        case n.Test():
            values = [value for case in node.cases for value in case.values]
            yield node.subject, next(filter(None, (type_of(v, scope) for v in values)), "")
        case n.For():
            yield from ((end, "num") for end in (node.start, node.end))
        case n.DataDeclaration():
            yield from ((size, "num") for size in node.dimensions)
            if node.initial is not None:
                name = n.Name(node.name_token, node.name_token, node.name)
                yield node.initial, declared_type(name, scope) or ""
        case n.Index():
            yield from ((index, "num") for index in node.indices)


def passed(
    arguments: list[n.Argument], routine: RoutineSymbol, scope: Scope
) -> Iterator[tuple[n.Expression, str, str]]:
    """Arguments of a known routine, with types (empty: any) and modes of their parameters."""
    parameters = routine.parameters or ()
    for pair in match(parameters, arguments, lambda _, alternatives: alternatives[0]).pairs:
        value = pair.argument.value
        if value is not None and pair.parameter >= 0:
            expected = parameters[pair.parameter]
            kind = (routine.module or scope.module).base(expected.type) or ""
            is_any = kind == "anytype" or expected.dimensions
            yield value, "" if is_any else kind, expected.mode
