"""Labels and GOTO [K §4.3, 4.6].

A GOTO may leave a statement list, but not enter one.
"""

from collections.abc import Iterator, Sequence

from rapidgen.rapid.checks.context import closest
from rapidgen.rapid.checks.findings import Findings
from rapidgen.rapid.syntax.nodes import (
    CompactIf,
    For,
    Goto,
    If,
    Label,
    RoutineDeclaration,
    Statement,
    Test,
    While,
)

Path = tuple[int, ...]
"""The lists that a statement is in, outermost first, by number."""


def inner_lists(statement: Statement) -> list[Sequence[Statement]]:
    """Return the statement lists inside a statement."""
    if isinstance(statement, If):
        bodies: list[Sequence[Statement]] = [b.body for b in statement.branches]
        return bodies if statement.otherwise is None else [*bodies, statement.otherwise]
    if isinstance(statement, For | While):
        return [statement.body]
    if isinstance(statement, Test):
        cases: list[Sequence[Statement]] = [c.body for c in statement.cases]
        return cases if statement.default is None else [*cases, statement.default]
    if isinstance(statement, CompactIf):
        return [[statement.statement]]
    return []


def _jumps(body: Sequence[Statement], path: Path) -> Iterator[tuple[Label | Goto, Path]]:
    """Iterate over labels and GOTOs of a list with their paths."""
    number = 0
    for statement in body:
        if isinstance(statement, Label | Goto):
            yield statement, path
            continue
        for inner in inner_lists(statement):
            number += 1
            yield from _jumps(inner, (*path, number))


def flat(body: Sequence[Statement]) -> Iterator[Statement]:
    """Iterate over statements of a list and its nested lists."""
    for statement in body:
        yield statement
        for inner in inner_lists(statement):
            yield from flat(inner)


def bodies(routine: RoutineDeclaration) -> list[tuple[str, Sequence[Statement]]]:
    """Return body and handlers of a routine with their display names."""
    result: list[tuple[str, Sequence[Statement]]] = [("body", routine.body)]
    if routine.backward:
        result.append(("BACKWARD", routine.backward.body))
    if routine.error:
        result.append(("ERROR", routine.error.body))
    if routine.undo:
        result.append(("UNDO", routine.undo.body))
    return result


def check_labels(findings: Findings, routine: RoutineDeclaration) -> None:
    """Report clashing, missing and unused labels, and GOTOs into blocks."""
    labels: dict[str, tuple[Label, Path]] = {}
    gotos: list[tuple[Goto, Path]] = []
    for number, (_, body) in enumerate(bodies(routine)):
        for node, path in _jumps(body, (number,)):
            if isinstance(node, Goto):
                gotos.append((node, path))
                continue
            key = node.name.lower()
            if key in labels:
                findings.report("RG305", f"the label '{node.name}' is set twice", node)
            elif key in findings.locals:
                findings.report(
                    "RG305",
                    f"'{node.name}' is a label and a datum of the same routine",
                    node,
                    notes=("[K §4.3]",),
                    related=findings.declared(findings.locals[key]),
                )
            elif key != "<id>":
                labels[key] = (node, path)
    reached = set()
    for goto, path in gotos:
        key = goto.name.lower()
        if key == "<id>":
            continue
        if key not in labels:
            likely = closest(goto.name, [label.name for label, _ in labels.values()])
            findings.report(
                "RG320",
                f"there is no label '{goto.name}' in this routine",
                goto,
                help=f"did you mean '{likely}'?" if likely else "",
                fixes=findings.spelling(likely, goto.last - 1),
            )
            continue
        reached.add(key)
        label, there = labels[key]
        if path[: len(there)] != there:
            findings.report(
                "RG320",
                f"GOTO '{goto.name}' would enter a block from outside",
                goto,
                help="set the label in this block or in one around it",
                notes=("a GOTO may leave a block, not enter one [K §4.6]",),
            )
    for key, (label, _) in labels.items():
        if key not in reached:
            findings.remark("RG324", f"nothing jumps to the label '{label.name}'", label)
