"""Which tokens start a line of formatted text, and how deep it is indented."""

from collections.abc import Sequence

from rapidgen.rapid.syntax.nodes import (
    For,
    If,
    Module,
    RecordDeclaration,
    RoutineDeclaration,
    Statement,
    Test,
    While,
)


def line_starts(module: Module) -> dict[int, int]:
    """Token index to indentation level, for each token that starts a line."""
    starts = {module.first: 0, module.last: 0}
    for declaration in module.declarations:
        starts[declaration.first] = 1
        if isinstance(declaration, RecordDeclaration):
            for component in declaration.components:
                starts[component.first] = 2
            starts[declaration.last] = 1
        elif isinstance(declaration, RoutineDeclaration):
            _routine(declaration, starts)
    return starts


def _routine(node: RoutineDeclaration, starts: dict[int, int]) -> None:
    starts[node.last] = 1
    for datum in node.data:
        starts[datum.first] = 2
    _statements(node.body, 2, starts)
    for handler in (node.backward, node.error, node.undo):
        if handler is not None:
            starts[handler.first] = 1
            _statements(handler.body, 2, starts)


def _statements(body: Sequence[Statement], level: int, starts: dict[int, int]) -> None:
    for node in body:
        starts[node.first] = level
        if isinstance(node, If):
            for branch in node.branches:
                starts[branch.first] = level
                _statements(branch.body, level + 1, starts)
            if node.otherwise is not None:
                starts[node.branches[-1].last + 1] = level
                _statements(node.otherwise, level + 1, starts)
            starts[node.last] = level
        elif isinstance(node, For | While):
            _statements(node.body, level + 1, starts)
            starts[node.last] = level
        elif isinstance(node, Test):
            for case in node.cases:
                starts[case.first] = level
                _statements(case.body, level + 1, starts)
            if node.default is not None:
                default = node.cases[-1].last + 1 if node.cases else node.subject.last + 1
                starts[default] = level
                _statements(node.default, level + 1, starts)
            starts[node.last] = level
