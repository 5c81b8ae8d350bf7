"""Coverage of task interleavings: which shared statements follow which.

Two tasks meet where both name a persistent, or command the robot. A pair is such a statement of one
task and the next such statement, of another task. The pairs are all that a schedule can decide.
"""

from dataclasses import dataclass
from typing import TypeAlias

from rapidgen.controller.controller import VirtualController
from rapidgen.rapid import parse
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.symbols import Routine
from rapidgen.system.model import System

Spot: TypeAlias = tuple[str, int]
"""Path of a module file, and line."""
Pair: TypeAlias = tuple[int, int]
"""Numbers of two spots, the earlier one first."""

ROBOT = ("stopmove", "startmove", "clearpath", "moveabsj", "movej", "movel", "movec", "storepath")
"""Instructions by which tasks meet at the robot."""


@dataclass(frozen=True, slots=True)
class RacePoints:
    """Lines where tasks meet, numbered; and the tokens of each module file.

    A token is -1 where tasks do not meet.
    """

    lines: dict[Spot, int]
    tokens: dict[str, list[int]]


def spots(system: System) -> RacePoints:
    """Return the lines where tasks of a driver meet."""
    texts = {module.path: module.data for task in system.tasks for module in task.modules}
    trees = {path: parse(data, path=path) for path, data in texts.items()}
    names = {
        declaration.name.casefold()
        for tree in trees.values()
        for declaration in tree.declarations
        if isinstance(declaration, n.DataDeclaration)
        and declaration.kind == "PERS"
        and not declaration.scope
    }
    names.update(ROBOT)
    result = {
        (path, tree.source.line(number))
        for path, tree in trees.items()
        for number, token in enumerate(tree.source.tokens)
        if token.casefold() in names
    }
    lines = {spot: number for number, spot in enumerate(sorted(result))}
    tokens = {
        path: [lines.get((path, tree.source.line(n)), -1) for n in range(len(tree.source.tokens))]
        for path, tree in trees.items()
    }
    return RacePoints(lines, tokens)


class RacePairs:
    """The pairs of one controller, recorded from now on."""

    def __init__(self, controller: VirtualController, spots: RacePoints) -> None:
        self._tokens = spots.tokens
        self._numbers: dict[int, int] = {}
        self._nodes: list[n.Statement] = []
        self._last: tuple[str, int] | None = None
        self._found: set[Pair] = set()
        controller.statements.listen(self._statement)

    def found(self) -> tuple[Pair, ...]:
        """Return the pairs so far, in order."""
        return tuple(sorted(self._found))

    def _statement(self, task: str, routine: Routine, node: n.Statement) -> bool:
        number = self._numbers.get(id(node))
        if number is None:
            number = self._number(routine, node)
        if number < 0:
            return True
        last = self._last
        if last is not None and last[0] != task:
            self._found.add((last[1], number))
        self._last = task, number
        return False

    def _number(self, routine: Routine, node: n.Statement) -> int:
        module = routine.module
        assert module is not None
        tokens = self._tokens.get(module.file.path)
        number = self._numbers[id(node)] = tokens[node.first] if tokens is not None else -1
        # While the reference is held, no other object has its id.
        self._nodes.append(node)
        return number
