"""Going on in the middle of a routine: code that takes over the variables of a frame that is gone.

A program that an error stopped stands at the faulty statement and tries it again when it is
started [S4 overview 3-23]. The routine is compiled once more, beginning there: the rest of every
statement list around, and loops from their next pass on.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.code_info import Compiled
from rapidgen.runtime.compiler.context import Options
from rapidgen.runtime.compiler.linking import Linker
from rapidgen.runtime.compiler.loops import loop_bound, loop_variable
from rapidgen.runtime.compiler.routine import RoutineCompiler
from rapidgen.runtime.compiler.statements import compile_statement
from rapidgen.runtime.compiler.symbols import CannotCompile, Routine
from rapidgen.runtime.values import Value

Path = list[tuple[list[n.Statement], int]]
"""Statement lists from the routine's own inwards, and the place in each."""


@dataclass(frozen=True, slots=True)
class StoppedFrame:
    """Where a routine of a call stack is, and what its variables are."""

    routine: Routine
    path: Path
    values: dict[str, Value]
    """Python locals of the frame."""


def find(body: list[n.Statement], token: int) -> Path | None:
    """The statement that begins at a token."""
    for i, statement in enumerate(body):
        if isinstance(statement, n.Label):
            continue
        if statement.first == token:
            return [(body, i)]
        for inner in _lists(statement):
            result = find(inner, token)
            if result is not None:
                return [(body, i), *result]
    return None


def _lists(statement: n.Statement) -> Iterator[list[n.Statement]]:
    match statement:
        case n.If():
            yield from (branch.body for branch in statement.branches)
            yield statement.otherwise or []
        case n.CompactIf():
            yield [statement.statement]
        case n.For() | n.While():
            yield statement.body
        case n.Test():
            yield from (case.body for case in statement.cases)
            yield statement.default or []


def after(values: Iterable[float], current: float) -> Iterator[float]:
    """Values of a FOR variable behind the current one."""
    remaining: Iterator[float] = iter(values)
    for value in remaining:
        if value == current:
            break
    return remaining


class _Rest:
    """Writes the rest of a routine. CannotCompile: not from there.

    `calls`: the statement is a call that is under way, and its routine goes on, too.
    `alone`: nothing follows it.
    """

    def __init__(
        self, compiler: RoutineCompiler, standing: StoppedFrame, *, calls: bool, alone: bool
    ) -> None:
        if compiler.facts.goto:
            raise CannotCompile(
                "a routine with GOTO cannot go on in the middle", compiler.unit.node
            )
        self._emitter = compiler.emitter
        self._standing = standing
        self._calls = calls
        self._alone = alone
        declare = compiler.variables
        compiler.parameters = "F"
        compiler.variables = lambda: self._take_over(declare)
        compiler.body = lambda: self._rest(standing.path)

    def _take_over(self, declare: Callable[[], None]) -> None:
        """Take the values of the variables over."""
        emitter, values = self._emitter, self._standing.values
        marker = len(emitter.w.lines)
        declare()
        emitter.w.cut(marker)
        for name in sorted({d.code for d in emitter.unit.locals.values()} & values.keys()):
            emitter.w.emit(f"{name} = F[{name!r}]")

    def _rest(self, path: Path) -> None:
        emitter, w = self._emitter, self._emitter.w
        (body, i), *deeper = path
        if deeper:
            self._into(body[i], deeper)
        elif self._calls:
            w.token = body[i].first
            w.close()
            w.emit("R.go_on_below()")
            compile_statement(emitter, body[i])  # which is under way: no trace tells of it again
            w.close()
            w.emit("R.not_below()")
        else:
            emitter.statement(body[i])
        if not self._alone:
            for statement in body[i + 1 :]:
                emitter.statement(statement)

    def _into(self, statement: n.Statement, deeper: Path) -> None:
        if isinstance(statement, n.For):
            self._into_for(statement, deeper)
            return
        self._rest(deeper)
        if isinstance(statement, n.While) and not self._alone:
            self._emitter.statement(statement)

    def _into_for(self, node: n.For, deeper: Path) -> None:
        emitter, name = self._emitter, loop_variable(node)
        if name not in self._standing.values:
            raise CannotCompile("a FOR whose variable is lost cannot go on", node)
        emitter.w.emit(f"{name} = F[{name!r}]")
        with loop_bound(emitter.unit, node, complete=False, limits=None):
            self._rest(deeper)
        if not self._alone:
            emitter.w.close()
            emitter.resumed.add(node.first)
            emitter.statement(node)


def compile_backward(
    linker: Linker, routine: Routine, options: Options, file: str
) -> tuple[Callable[..., Value], Compiled]:
    """The BACKWARD handler of a procedure, with its parameters and variables [K §6.1].

    Errors in it are not for the procedure's own ERROR [K §7.1]. `file` is that of the procedure.
    """
    node = routine.node
    assert node is not None
    assert node.backward is not None
    body = replace(node, body=node.backward.body, backward=None, error=None)
    changed = replace(routine, node=body)
    entry = f"{routine.code}_back"
    return RoutineCompiler(linker, changed, options, entry, f"{file} backward").link()


def compile_rest(
    linker: Linker, standing: StoppedFrame, options: Options, file: str, *, calls: bool, alone: bool
) -> tuple[Callable[[dict[str, Value]], Value], Compiled]:
    """A function that goes on with a routine, given the values. `file` is the routine's."""
    routine = standing.routine
    at = "".join(f" {i}" for _, i in standing.path)
    file = f"{file} from{at}{' alone' if alone else ''}"
    compiler = RoutineCompiler(linker, routine, options, f"{routine.code}_rest", file)
    _Rest(compiler, standing, calls=calls, alone=alone)
    return compiler.link()
